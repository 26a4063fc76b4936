//! A chat server that fails in every way a server can: asked again, given up on, recorded.

use std::sync::{Arc, Mutex};
use std::time::Duration;

use scenefold::event::LanguageReply;
use scenefold::modality::human::{LanguageModel, LanguageRequest, Question, READING_PROMPT};
use scenefold::model::chat::{ApiKey, Chat, ChatOptions, Endpoint};
use serde_json::json;

use super::server::{Reply, Request, Server, completion};

const KEY: &str = "sk-test-0123456789abcdef-SECRET99";

fn question() -> LanguageRequest {
    let (system, user) = ("read".to_owned(), r#"{"sentence":"the \"mug\" is gone"}"#.to_owned());
    LanguageRequest { prompt: READING_PROMPT, question: Question::Chat { system, user } }
}

/// What came of asking once: the reply, the pauses that were made, the requests.
struct Asked {
    reply: LanguageReply,
    pauses: Vec<Duration>,
    requests: Vec<Request>,
}

fn options() -> ChatOptions {
    // Long enough for a busy machine; only the server that hangs makes anyone wait for it.
    ChatOptions { timeout: Duration::from_secs(20), ..ChatOptions::default() }
}

fn ask_with(options: ChatOptions, replies: Vec<Reply>) -> Asked {
    let server = Server::start(replies);
    let pauses = Arc::new(Mutex::new(Vec::new()));
    let noted = Arc::clone(&pauses);
    let endpoint = Endpoint::new(&server.base).unwrap();
    let key = Some(ApiKey::new(KEY).unwrap());
    let mut chat = Chat::new(endpoint, "m", key, options)
        .with_wait(move |pause| noted.lock().unwrap().push(pause));
    let reply = chat.answer(&question());
    let shown = format!("{chat:?} {chat:#?} {reply:?}");
    assert!(!shown.contains("SECRET99") && !shown.contains("0123456789abcdef"), "{shown}");
    let pauses = pauses.lock().unwrap().clone();
    Asked { reply, pauses, requests: server.requests() }
}

fn ask(replies: Vec<Reply>) -> Asked {
    ask_with(options(), replies)
}

fn good() -> Reply {
    Reply::Content(r#"{"kind":"other","changes":[]}"#.to_owned())
}

fn status(status: u16, body: &str) -> Reply {
    Reply::Http(status, "", "application/json", body.to_owned())
}

#[test]
fn an_answer_comes_at_the_first_attempt_and_the_key_goes_only_into_its_header() {
    let asked = ask(vec![good()]);
    assert_eq!(asked.reply.answer.as_deref(), Ok(r#"{"kind":"other","changes":[]}"#));
    assert_eq!((asked.reply.attempts, asked.pauses.len()), (1, 0));
    assert_eq!((&*asked.reply.back_end, &*asked.reply.model), ("server/1", "m"));
    assert_eq!(asked.requests[0].headers["authorization"], format!("Bearer {KEY}"));
    let sent: serde_json::Value = serde_json::from_str(&asked.reply.request).unwrap();
    assert_eq!(sent, asked.requests[0].body, "what is recorded is what was sent");
    let order = [r#""kind":"#, r#""changes":"#].map(|name| asked.reply.request.find(name));
    assert!(order[0] < order[1], "the schema keeps its order");
}

#[track_caller]
fn recovers_from(fault: Reply) -> Asked {
    let asked = ask(vec![fault, good()]);
    assert!(asked.reply.answer.is_ok(), "{:?}", asked.reply);
    assert_eq!((asked.reply.attempts, asked.pauses.len()), (2, 1));
    asked
}

#[test]
fn a_fault_that_may_pass_is_tried_again() {
    for code in [408, 429, 500, 502, 503, 504] {
        recovers_from(status(code, r#"{"error":{"message":"busy"}}"#));
    }
    recovers_from(Reply::Torn);
    recovers_from(Reply::Close);
    recovers_from(status(200, "{not json"));
    recovers_from(status(200, r#"{"object":"list"}"#));
    recovers_from(Reply::Http(200, "", "text/html", "<html>Sign in</html>".to_owned()));
    recovers_from(Reply::Http(200, "", "application/json", String::new()));
}

#[test]
fn a_server_that_hangs_is_not_waited_for() {
    let options = ChatOptions { timeout: Duration::from_millis(150), attempts: 2, ..options() };
    let asked = ask_with(options, vec![Reply::Hang, Reply::Hang]);
    let error = asked.reply.answer.unwrap_err();
    assert_eq!(error, "the server did not answer in time; no more attempts");
    assert_eq!((asked.reply.attempts, asked.pauses.len()), (2, 1));
}

#[test]
fn the_server_says_when_to_ask_again() {
    let busy = |headers| Reply::Http(429, headers, "application/json", String::new());
    let asked = recovers_from(busy("retry-after: 7\r\n"));
    assert_eq!(asked.pauses, [Duration::from_secs(7)]);
    let dated =
        "date: Wed, 21 Oct 2015 07:28:00 GMT\r\nretry-after: Wed, 21 Oct 2015 07:28:05 GMT\r\n";
    assert_eq!(recovers_from(busy(dated)).pauses, [Duration::from_secs(5)]);
    let asked = ask(vec![busy("retry-after: 86400\r\n")]);
    let error = asked.reply.answer.unwrap_err();
    assert!(error.ends_with("it asks to wait for 86400 s"), "{error}");
    assert_eq!(asked.pauses, []);
}

#[track_caller]
fn given_up(replies: Vec<Reply>, attempts: u32, because: &str) {
    let asked = ask(replies);
    let error = asked.reply.answer.unwrap_err();
    assert!(error.contains(because), "{error}");
    assert_eq!(asked.reply.attempts, attempts);
}

#[test]
fn what_cannot_pass_is_given_up_at_once() {
    let denied = format!(r#"{{"error":{{"message":"Incorrect API key provided: {KEY}"}}}}"#);
    given_up(vec![status(401, &denied)], 1, "status 401: Incorrect API key provided: [key]");
    given_up(vec![status(404, r#"{"error":"no model m"}"#)], 1, "status 404: no model m");
    given_up(vec![status(400, r#"{"detail":[{"loc":"x"}]}"#)], 1, "status 400: [{\"loc\":\"x\"}]");
    let moved = Reply::Http(302, "location: http://127.0.0.1:9/\r\n", "text/plain", String::new());
    given_up(vec![moved], 1, "status 302");
    given_up(vec![status(200, &completion("{", "length"))], 1, "cut off");
    given_up(vec![status(200, &completion("", "content_filter"))], 1, "filtered");
    let refusal = json!({"choices": [{"message": {"content": null, "refusal": "no"}}]});
    given_up(vec![status(200, &refusal.to_string())], 1, "refused");
    given_up(vec![status(200, r#"{"choices":[]}"#)], 1, "no choices");
    given_up(vec![Reply::Content("x".repeat(70_000))], 1, "too long");
    given_up(vec![status(200, &"x".repeat(600_000))], 1, "more than");
    given_up(vec![status(500, "\u{1b}[31mboom"); 3], 3, "status 500:  [31mboom; no more attempts");
}

#[test]
fn nobody_at_the_address_is_an_answer_too() {
    let unused = std::net::TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap();
    let endpoint = Endpoint::new(&format!("http://{unused}/v1")).unwrap();
    let mut chat = Chat::new(endpoint, "m", None, options()).with_wait(|_| ());
    let reply = chat.answer(&question());
    assert!(reply.answer.unwrap_err().starts_with("no answer from the server"));
    assert_eq!(reply.attempts, 3);
}

#[test]
fn servers_of_other_dialects_are_understood() {
    let refuses = |what: &str| status(422, &json!({"error": {"message": what}}).to_string());
    let asked = ask(vec![
        // As llama-cpp-python says it.
        status(500, r#"{"error":{"message":"{'loc': ('body', 'response_format', 'type')}"}}"#),
        refuses("Unsupported parameter: 'max_tokens'; use 'max_completion_tokens'"),
        refuses("'temperature' does not support 0 with this model"),
        refuses("response_format is not supported"),
        good(),
    ]);
    assert!(asked.reply.answer.is_ok(), "{:?}", asked.reply);
    assert_eq!((asked.reply.attempts, asked.pauses.len()), (5, 0));
    let kinds: Vec<_> =
        asked.requests.iter().map(|r| r.body["response_format"]["type"].clone()).collect();
    assert_eq!(kinds[..3], [json!("json_schema"), json!("json_object"), json!("json_object")]);
    let last = &asked.requests[4].body;
    assert!(last["response_format"].is_null() && last["temperature"].is_null());
    assert!(last["max_completion_tokens"].is_u64());
}
