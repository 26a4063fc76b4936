//! A chat server of our own: checks every request against the published API, and answers with
//! whatever a test wants, faults above all.

use std::collections::BTreeMap;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;

use serde_json::{Value, json};

/// How one request is answered.
#[derive(Clone, Debug)]
pub enum Reply {
    /// A completion with this content.
    Content(String),
    /// This body, with status, further headers and content type.
    Http(u16, &'static str, &'static str, String),
    /// Nothing, for ever.
    Hang,
    /// The beginning of a completion that was announced to be longer.
    Torn,
    /// The connection is closed at once.
    Close,
}

/// One request as it came.
#[derive(Clone, Debug)]
pub struct Request {
    pub headers: BTreeMap<String, String>,
    pub body: Value,
}

/// A running server; it ends when its replies are used up or it is dropped.
pub struct Server {
    pub base: String,
    requests: Arc<Mutex<Vec<Request>>>,
    thread: Option<JoinHandle<Vec<TcpStream>>>,
}

impl Server {
    /// Answers one request after the other with `replies`, and then no more.
    pub fn start(replies: Vec<Reply>) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let base = format!("http://{}/v1", listener.local_addr().unwrap());
        let requests = Arc::new(Mutex::new(Vec::new()));
        let seen = Arc::clone(&requests);
        let thread = std::thread::spawn(move || {
            // Connections that are left hanging are held until the thread is joined.
            let mut held = Vec::new();
            for reply in replies {
                let (stream, _) = listener.accept().unwrap();
                let Some(request) = read(&stream) else { break };
                seen.lock().unwrap().push(request);
                held.extend(answer(stream, &reply));
            }
            held
        });
        Self { base, requests, thread: Some(thread) }
    }

    /// What was asked, once every reply was given.
    pub fn requests(mut self) -> Vec<Request> {
        if let Some(thread) = self.thread.take() {
            drop(thread.join().unwrap());
        }
        self.requests.lock().unwrap().clone()
    }
}

/// A chat completion, as the API documents it.
pub fn completion(content: &str, finish_reason: &str) -> String {
    json!({
        "id": "chatcmpl-1", "object": "chat.completion", "created": 1, "model": "m",
        "choices": [{"index": 0, "message": {"role": "assistant", "content": content},
            "finish_reason": finish_reason}],
        "usage": {"prompt_tokens": 1, "completion_tokens": 1, "total_tokens": 2},
    })
    .to_string()
}

fn read(stream: &TcpStream) -> Option<Request> {
    let mut reader = BufReader::new(stream);
    let mut line = String::new();
    reader.read_line(&mut line).ok()?;
    assert_eq!(line.trim_end(), "POST /v1/chat/completions HTTP/1.1");
    let mut headers = BTreeMap::new();
    loop {
        let mut line = String::new();
        reader.read_line(&mut line).ok()?;
        let Some((name, value)) = line.trim_end().split_once(": ") else { break };
        headers.insert(name.to_lowercase(), value.to_owned());
    }
    let length: usize = headers["content-length"].parse().unwrap();
    let mut body = vec![0; length];
    reader.read_exact(&mut body).ok()?;
    let request = Request { headers, body: serde_json::from_slice(&body).unwrap() };
    check(&request);
    Some(request)
}

/// The reference of the API: which fields there are, and what they hold.
fn check(request: &Request) {
    let Request { headers, body } = request;
    assert_eq!(headers["content-type"], "application/json");
    assert!(headers.contains_key("host") && headers["user-agent"].starts_with("scenefold/"));
    for name in body.as_object().unwrap().keys() {
        let known = [
            "model",
            "messages",
            "temperature",
            "max_tokens",
            "max_completion_tokens",
            "response_format",
        ];
        assert!(known.contains(&name.as_str()), "{name}");
    }
    assert!(!body["model"].as_str().unwrap().is_empty());
    let roles: Vec<&str> = body["messages"].as_array().unwrap().iter().map(check_message).collect();
    assert_eq!(roles, ["system", "user"]);
    if let Some(temperature) = body.get("temperature") {
        assert!((0.0..=2.0).contains(&temperature.as_f64().unwrap()));
    }
    let limits = [body.get("max_tokens"), body.get("max_completion_tokens")];
    let limits: Vec<u64> = limits.into_iter().flatten().map(|n| n.as_u64().unwrap()).collect();
    assert_eq!(limits.len(), 1);
    if let Some(format) = body.get("response_format") {
        check_format(format);
    }
}

fn check_message(message: &Value) -> &str {
    assert!(message["content"].is_string());
    assert_eq!(message.as_object().unwrap().len(), 2);
    message["role"].as_str().unwrap()
}

fn check_format(format: &Value) {
    let schema = match format["type"].as_str().unwrap() {
        "json_schema" => {
            let schema = &format["json_schema"];
            let name = schema["name"].as_str().unwrap();
            assert!((1..=64).contains(&name.len()));
            assert!(name.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '_' | '-')));
            assert_eq!(schema["strict"], true);
            &schema["schema"]
        }
        "json_object" => &format["schema"],
        other => panic!("{other}"),
    };
    assert_eq!(schema["type"], "object");
}

/// The stream, if it is to be held open.
fn answer(mut stream: TcpStream, reply: &Reply) -> Option<TcpStream> {
    let head = |status: u16, headers: &str, kind: &str, length: usize| {
        format!(
            "HTTP/1.1 {status} X\r\ncontent-type: {kind}\r\ncontent-length: {length}\r\n\
             connection: close\r\n{headers}\r\n"
        )
    };
    let text = match reply {
        Reply::Content(content) => {
            let body = completion(content, "stop");
            head(200, "", "application/json; charset=utf-8", body.len()) + &body
        }
        Reply::Http(status, headers, kind, body) => head(*status, headers, kind, body.len()) + body,
        Reply::Torn => {
            let body = completion("{", "stop");
            head(200, "", "application/json", body.len() + 100) + &body[..body.len() / 2]
        }
        Reply::Hang => return Some(stream),
        Reply::Close => return None,
    };
    // A client that gave up is no concern of the server's.
    let _ = stream.write_all(text.as_bytes());
    None
}
