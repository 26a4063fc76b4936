//! [`Endpoint`]: where a server is asked.

/// The address of the chat completions of a server.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Endpoint {
    url: String,
    on_this_machine: bool,
}

/// Why a text is no address of a server. Does not hold the text, which may hold a password.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EndpointError {
    /// Neither `http://` nor `https://`.
    #[error("it must begin with http:// or https://, such as http://localhost:8000/v1")]
    Scheme,
    /// No host, or characters that no URL has.
    #[error("it is no URL: give scheme, host, port and path, such as http://localhost:8000/v1")]
    Host,
    /// A user, a password, a query or a fragment.
    #[error("a user, password, query or fragment cannot be part of it; give a key by --key-env")]
    Secret,
}

impl Endpoint {
    /// The server at `base`, which ends in `/v1` for most; `/chat/completions` is added.
    ///
    /// ```
    /// use scenefold::model::chat::Endpoint;
    /// let endpoint = Endpoint::new("http://localhost:11434/v1/").unwrap();
    /// assert_eq!(endpoint.url(), "http://localhost:11434/v1/chat/completions");
    /// ```
    pub fn new(base: &str) -> Result<Self, EndpointError> {
        const PATH: &str = "/chat/completions";
        let base = base.trim();
        let rest = base.strip_prefix("https://").or_else(|| base.strip_prefix("http://"));
        let rest = rest.ok_or(EndpointError::Scheme)?;
        let base = base.trim_end_matches('/');
        if rest.contains(['@', '?', '#']) {
            return Err(EndpointError::Secret);
        }
        let authority = rest.split('/').next().unwrap_or_default();
        let plain = base.bytes().all(|byte| byte.is_ascii_graphic());
        if authority.is_empty() || authority.starts_with(':') || !plain {
            return Err(EndpointError::Host);
        }
        let url = match base.ends_with(PATH) {
            true => base.to_owned(),
            false => format!("{base}{PATH}"),
        };
        url.parse::<ureq::http::Uri>().map_err(|_| EndpointError::Host)?;
        Ok(Self { url, on_this_machine: is_loopback(authority) })
    }

    /// The full address.
    pub fn url(&self) -> &str {
        &self.url
    }

    /// Whether the server runs here: no proxy is asked for it then.
    pub fn is_on_this_machine(&self) -> bool {
        self.on_this_machine
    }
}

fn is_loopback(authority: &str) -> bool {
    let host = match authority.strip_prefix('[') {
        Some(v6) => v6.split(']').next().unwrap_or_default(),
        None => authority.split(':').next().unwrap_or_default(),
    };
    let address = host.parse::<std::net::IpAddr>();
    host.eq_ignore_ascii_case("localhost") || address.is_ok_and(|ip| ip.is_loopback())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(base: &str, url: &str, here: bool) {
        let endpoint = Endpoint::new(base).unwrap();
        assert_eq!((endpoint.url(), endpoint.is_on_this_machine()), (url, here));
    }

    #[test]
    fn the_address_is_completed() {
        check("https://api.openai.com/v1", "https://api.openai.com/v1/chat/completions", false);
        check("http://localhost:8000/v1//", "http://localhost:8000/v1/chat/completions", true);
        check("http://[::1]:80", "http://[::1]:80/chat/completions", true);
        check("http://127.0.0.2/x/chat/completions", "http://127.0.0.2/x/chat/completions", true);
        check(
            "http://localhost.example.org/v1",
            "http://localhost.example.org/v1/chat/completions",
            false,
        );
    }

    #[test]
    fn what_is_no_address_is_refused() {
        assert_eq!(Endpoint::new("localhost:8000"), Err(EndpointError::Scheme));
        assert_eq!(Endpoint::new("ftp://host"), Err(EndpointError::Scheme));
        assert_eq!(Endpoint::new("http://"), Err(EndpointError::Host));
        assert_eq!(Endpoint::new("http://:80/v1"), Err(EndpointError::Host));
        assert_eq!(Endpoint::new("http://a b/v1"), Err(EndpointError::Host));
        for secret in ["http://me:pw@host/v1", "http://host/v1?key=pw", "http://host/v1#pw"] {
            let error = Endpoint::new(secret).unwrap_err();
            assert_eq!(error, EndpointError::Secret);
            assert!(!format!("{error} {error:?}").contains("pw"));
        }
    }
}
