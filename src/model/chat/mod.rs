//! An OpenAI-compatible chat server: `POST …/chat/completions` with a JSON schema for the answer.
//!
//! Asks once a question, again if that may help (no connection, timeout, 408, 429, 5xx, an
//! answer that is no chat completion), after a pause that grows, with jitter, or for as long as
//! `Retry-After` says; then gives up and says why. Servers differ in how a schema and a limit are
//! asked for; a refusal that names the field is followed by the next way of asking, which is
//! then kept.
//!
//! The key goes into one header and nowhere else: no record, no message, no `Debug`; what a
//! server says of it is cut out of what is recorded. Redirects are not followed, so that it goes
//! to nobody else.

mod body;
mod endpoint;
mod key;
mod pace;

use std::time::{Duration, Instant};

pub use endpoint::{Endpoint, EndpointError};
pub use key::{ApiKey, KeyError};

use self::body::{Dialect, Response, request_body};
use self::pace::Pace;
use crate::change::EvidenceRef;
use crate::event::{LanguageReply, MAX_ANSWER};
use crate::modality::human::{LanguageModel, LanguageRequest, Question};

/// Name and version of this back end in recordings.
pub const BACK_END: &str = "server/1";

/// How a server is asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ChatOptions {
    /// Longest wait for one answer.
    pub timeout: Duration,
    /// How many times a question is sent, at most.
    pub attempts: u32,
    /// First pause between two attempts; each later one is twice as long.
    pub pause: Duration,
    /// Longest pause, also if the server asks for a longer one: then no more is sent.
    pub longest_pause: Duration,
    /// Longest answer, in tokens.
    pub max_tokens: u32,
}

impl Default for ChatOptions {
    fn default() -> Self {
        Self {
            timeout: Duration::from_secs(30),
            attempts: 3,
            pause: Duration::from_millis(500),
            longest_pause: Duration::from_secs(20),
            max_tokens: 1024,
        }
    }
}

/// A chat server and a model on it.
pub struct Chat {
    agent: ureq::Agent,
    endpoint: Endpoint,
    model: String,
    key: Option<ApiKey>,
    options: ChatOptions,
    dialect: Dialect,
    /// How pauses are made; tests do not wait.
    wait: Box<dyn FnMut(Duration)>,
}

/// Bytes of a response that are read, at most: an answer with every byte escaped, and some.
const MAX_RESPONSE: u64 = 8 * MAX_ANSWER as u64;

impl Chat {
    /// A client of the server at `endpoint` that asks for `model`. Connects when first asked.
    pub fn new(endpoint: Endpoint, model: &str, key: Option<ApiKey>, options: ChatOptions) -> Self {
        let config = ureq::Agent::config_builder()
            .timeout_global(Some(options.timeout))
            .http_status_as_error(false)
            .max_redirects(0)
            .max_redirects_will_error(false)
            .user_agent(concat!("scenefold/", env!("CARGO_PKG_VERSION")));
        let config = match endpoint.is_on_this_machine() {
            true => config.proxy(None),
            false => config,
        };
        let agent = config.build().new_agent();
        let (model, dialect) = (model.to_owned(), Dialect::default());
        let wait = Box::new(std::thread::sleep);
        Self { agent, endpoint, model, key, options, dialect, wait }
    }

    /// Makes pauses by `wait` instead of sleeping.
    pub fn with_wait(self, wait: impl FnMut(Duration) + 'static) -> Self {
        Self { wait: Box::new(wait), ..self }
    }

    /// Sends the question until there is an answer, or no more point in it.
    fn ask(&mut self, system: &str, user: &str) -> Asked {
        let mut pace = Pace::new(&self.options, user);
        let mut attempts = 0;
        loop {
            let body =
                request_body(&self.model, system, user, self.options.max_tokens, self.dialect);
            attempts += 1;
            let failure = match self.send(&body) {
                Ok(answer) => return Asked { body, attempts, answer: Ok(answer) },
                Err(failure) => failure,
            };
            if let Some(dialect) = self.dialect.instead(&failure) {
                self.dialect = dialect;
                continue;
            }
            match pace.next(&failure) {
                Ok(pause) => (self.wait)(pause),
                Err(why) => {
                    let error = self.shown(&format!("{}{why}", failure.what));
                    return Asked { body, attempts, answer: Err(error) };
                }
            }
        }
    }

    /// Sends `body` once.
    fn send(&self, body: &str) -> Result<String, Failure> {
        let mut request = self
            .agent
            .post(self.endpoint.url())
            .header("content-type", "application/json")
            .header("accept", "application/json");
        if let Some(key) = &self.key {
            request = request.header("authorization", key.bearer());
        }
        let mut response = request.send(body).map_err(|error| Failure::transport(&error))?;
        let head = Response::of(response.status().as_u16(), response.headers());
        let bytes = response.body_mut().with_config().limit(MAX_RESPONSE).read_to_vec();
        head.content(&bytes.map_err(|error| Failure::transport(&error))?)
    }

    /// What may be recorded and printed of what a server said: short, and without the key.
    fn shown(&self, text: &str) -> String {
        const SHOWN: usize = 300;
        let text = match &self.key {
            Some(key) => key.cut_out_of(text),
            None => text.to_owned(),
        };
        text.chars().map(|c| if c.is_control() { ' ' } else { c }).take(SHOWN).collect()
    }
}

impl LanguageModel for Chat {
    fn answer(&mut self, request: &LanguageRequest) -> LanguageReply {
        let Question::Chat { system, user } = &request.question else {
            return LanguageReply::nobody(request);
        };
        let start = Instant::now();
        let Asked { body, attempts, answer } = self.ask(system, user);
        LanguageReply {
            of: EvidenceRef { topic: "".into(), order: 0 },
            back_end: BACK_END.into(),
            model: self.model.clone(),
            prompt: request.prompt.into(),
            request: body,
            answer,
            attempts,
            latency_nanos: u64::try_from(start.elapsed().as_nanos()).unwrap_or(u64::MAX),
        }
    }
}

impl std::fmt::Debug for Chat {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { endpoint, model, key, options, dialect, .. } = self;
        f.debug_struct("Chat")
            .field("endpoint", endpoint)
            .field("model", model)
            .field("key", key)
            .field("options", options)
            .field("dialect", dialect)
            .finish_non_exhaustive()
    }
}

/// What came of a question.
struct Asked {
    /// As it was sent last.
    body: String,
    attempts: u32,
    answer: Result<String, String>,
}

/// Why one attempt gave no answer.
#[derive(Clone, Debug, PartialEq)]
struct Failure {
    what: String,
    /// Whether the same question may be answered later.
    again: bool,
    /// How long the server asks to wait.
    retry_after: Option<Duration>,
    /// The server refused the request itself.
    refused: bool,
}

impl Failure {
    fn new(what: impl Into<String>, again: bool) -> Self {
        Self { what: what.into(), again, retry_after: None, refused: false }
    }

    fn transport(error: &ureq::Error) -> Self {
        let (what, again) = match error {
            ureq::Error::Timeout(_) => ("the server did not answer in time".to_owned(), true),
            ureq::Error::BodyExceedsLimit(_) => {
                (format!("the response has more than {MAX_RESPONSE} bytes"), false)
            }
            ureq::Error::BadUri(_) => ("the address of the server is no URL".to_owned(), false),
            other => (format!("no answer from the server: {other}"), true),
        };
        Self::new(what, again)
    }
}
