//! What is sent to a server and what comes back, as bytes: no IO.

use serde::Deserialize;

use super::Failure;
use super::pace::retry_after;
use crate::event::MAX_ANSWER;
use crate::modality::human::ANSWER_SCHEMA;

/// How a server wants to be asked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Dialect {
    format: Format,
    limit: Limit,
    /// Some models take no temperature.
    warm: bool,
}

/// How an answer is held to the schema.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Format {
    /// `{"type":"json_schema","json_schema":{…}}`: `OpenAI`, vLLM, Ollama, llama.cpp.
    #[default]
    JsonSchema,
    /// `{"type":"json_object","schema":…}`: llama-cpp-python.
    JsonObject,
    /// Not at all; the answer is checked all the same.
    Free,
}

/// How the length of an answer is limited.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Limit {
    #[default]
    MaxTokens,
    /// The newer models of `OpenAI` take only this.
    MaxCompletionTokens,
}

impl Dialect {
    /// Another way of asking, if the server refused this one and named what it does not know.
    pub fn instead(self, failure: &Failure) -> Option<Self> {
        let names = |word: &str| failure.refused && failure.what.contains(word);
        if names("response_format") || names("json_schema") {
            let format = match self.format {
                Format::JsonSchema => Format::JsonObject,
                Format::JsonObject => Format::Free,
                Format::Free => return None,
            };
            return Some(Self { format, ..self });
        }
        if names("max_tokens") && self.limit == Limit::MaxTokens {
            return Some(Self { limit: Limit::MaxCompletionTokens, ..self });
        }
        (names("temperature") && !self.warm).then_some(Self { warm: true, ..self })
    }
}

/// The body of a request. Written by hand, since the order of the schema counts and a map of
/// JSON values does not keep it.
pub(super) fn request_body(
    model: &str,
    system: &str,
    user: &str,
    max_tokens: u32,
    dialect: Dialect,
) -> String {
    let text = |text: &str| serde_json::Value::from(text).to_string();
    let (model, system, user) = (text(model), text(system), text(user));
    let schema = ANSWER_SCHEMA.replace('\n', "");
    let format = match dialect.format {
        Format::JsonSchema => format!(
            r#","response_format":{{"type":"json_schema","json_schema":{{"name":"reading","strict":true,"schema":{schema}}}}}"#
        ),
        Format::JsonObject => {
            format!(r#","response_format":{{"type":"json_object","schema":{schema}}}"#)
        }
        Format::Free => String::new(),
    };
    let limit = match dialect.limit {
        Limit::MaxTokens => "max_tokens",
        Limit::MaxCompletionTokens => "max_completion_tokens",
    };
    let temperature = if dialect.warm { "" } else { r#","temperature":0"# };
    format!(
        r#"{{"model":{model},"messages":[{{"role":"system","content":{system}}},{{"role":"user","content":{user}}}]{temperature},"{limit}":{max_tokens}{format}}}"#
    )
}

/// Status and headers of a response.
pub(super) struct Response {
    status: u16,
    content_type: String,
    retry_after: Option<std::time::Duration>,
}

#[derive(Deserialize)]
struct Completion {
    choices: Vec<Choice>,
}

#[derive(Deserialize)]
struct Choice {
    message: Message,
    finish_reason: Option<String>,
}

#[derive(Deserialize)]
struct Message {
    content: Option<String>,
    refusal: Option<String>,
}

impl Response {
    pub fn of(status: u16, headers: &ureq::http::HeaderMap) -> Self {
        let header = |name: &str| headers.get(name).and_then(|value| value.to_str().ok());
        let content_type = header("content-type").unwrap_or_default().to_lowercase();
        let retry_after =
            header("retry-after").and_then(|value| retry_after(value, header("date")));
        Self { status, content_type, retry_after }
    }

    /// The text that the model answered.
    pub fn content(&self, body: &[u8]) -> Result<String, Failure> {
        let status = self.status;
        if status != 200 {
            return Err(self.refusal(body));
        }
        let mime = self.content_type.split(';').next().unwrap_or_default().trim();
        if mime != "application/json" {
            let what = format!("the server answered with content type {mime:?} instead of JSON");
            return Err(Failure::new(what, true));
        }
        let completion: Completion = serde_json::from_slice(body).map_err(|error| {
            Failure::new(format!("the server's answer is no chat completion: {error}"), true)
        })?;
        completion.answer()
    }

    fn refusal(&self, body: &[u8]) -> Failure {
        let status = self.status;
        let said = said(body);
        let colon = if said.is_empty() { "" } else { ": " };
        Failure {
            what: format!("the server answered with status {status}{colon}{said}"),
            again: matches!(status, 408 | 425 | 429 | 500..=599),
            retry_after: self.retry_after,
            // llama-cpp-python answers with 500 where others do with 422.
            refused: matches!(status, 400 | 422 | 500 | 501),
        }
    }
}

impl Completion {
    fn answer(self) -> Result<String, Failure> {
        let failed = |what: &str| Err(Failure::new(what, false));
        let Some(Choice { message, finish_reason }) = self.choices.into_iter().next() else {
            return failed("the server's answer has no choices");
        };
        if message.refusal.is_some_and(|refusal| !refusal.is_empty()) {
            return failed("the model refused to answer");
        }
        match finish_reason.as_deref() {
            Some("length") => return failed("the answer was cut off at the limit of tokens"),
            Some("content_filter") => return failed("the answer was filtered out by the server"),
            _ => {}
        }
        match message.content {
            Some(content) if content.len() > MAX_ANSWER => failed("the answer is too long"),
            Some(content) => Ok(content),
            None => failed("the server's answer has no content"),
        }
    }
}

/// What a server says went wrong: `{"error":{"message":…}}`, `{"error":…}`, `{"detail":…}`, or
/// text.
fn said(body: &[u8]) -> String {
    let text = String::from_utf8_lossy(&body[..body.len().min(4096)]);
    let Ok(value) = serde_json::from_str::<serde_json::Value>(&text) else {
        return text.trim().to_owned();
    };
    let place = ["/error/message", "/error", "/detail", "/message"];
    match place.iter().find_map(|place| value.pointer(place)) {
        Some(serde_json::Value::String(message)) => message.clone(),
        Some(other) => other.to_string(),
        None => text.trim().to_owned(),
    }
}
