//! Who may talk to the server: the page that the program opened, at its own address, and nobody else.

use std::io;

use crate::http::Request;

/// The secret in the address of the page, and the port.
///
/// Another user of the machine does not know the token. A page from elsewhere, which the browser would let send
/// requests here, neither knows it nor has this origin; and a foreign name that leads to this machine is no `Host` of
/// it.
#[derive(Debug)]
pub struct Gate {
    token: String,
    port: u16,
}

/// Bytes of a token: beyond guessing.
const TOKEN_BYTES: usize = 16;

impl Gate {
    /// A gate with a new token.
    ///
    /// # Errors
    ///
    /// [`io::Error`] if the system has no random numbers.
    pub fn new(port: u16) -> io::Result<Self> {
        let mut bytes = [0; TOKEN_BYTES];
        getrandom::fill(&mut bytes).map_err(io::Error::other)?;
        let token = format!("{:032x}", u128::from_ne_bytes(bytes));
        Ok(Self { token, port })
    }

    /// The address of the page.
    #[must_use]
    pub fn address(&self) -> String {
        format!("http://127.0.0.1:{}/{}/", self.port, self.token)
    }

    /// What a request of the page asks for: its path without the token; none of any other request.
    #[must_use]
    pub fn path<'a>(&self, request: &'a Request) -> Option<&'a str> {
        let hosts = ["127.0.0.1", "localhost"].map(|name| format!("{name}:{}", self.port));
        let is_host = |of: &String| hosts.contains(of);
        let is_origin = |of: &String| hosts.iter().any(|host| *of == format!("http://{host}"));
        let is_own = request.host.as_ref().is_some_and(is_host)
            && request.origin.as_ref().is_none_or(is_origin);
        let path = request.path.strip_prefix('/')?.strip_prefix(&self.token)?;
        is_own.then_some(path)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn request(gate: &Gate, host: Option<&str>, origin: Option<&str>) -> Request {
        Request {
            method: "GET".into(),
            path: format!("/{}/form", gate.token),
            host: host.map(Into::into),
            origin: origin.map(Into::into),
            body: Vec::new(),
        }
    }

    #[test]
    fn only_the_page_at_its_own_address_passes() {
        let gate = Gate::new(7).unwrap();
        let passes = |host, origin| gate.path(&request(&gate, host, origin)) == Some("/form");
        let own = Some("127.0.0.1:7");
        assert!(passes(own, None) && passes(Some("localhost:7"), Some("http://localhost:7")));
        for host in [None, Some("127.0.0.1"), Some("127.0.0.1:8"), Some("evil:7")] {
            assert!(!passes(host, None), "{host:?}");
        }
        for origin in [
            "null",
            "https://127.0.0.1:7",
            "http://127.0.0.1:8",
            "http://evil:7",
            "",
        ] {
            assert!(!passes(own, Some(origin)), "{origin}");
        }
        for path in ["/", "/form", "//form", "/0/form"] {
            let without = Request {
                path: path.into(),
                ..request(&gate, own, None)
            };
            assert_eq!(gate.path(&without), None, "{path}");
        }
        assert_ne!(gate.token, Gate::new(7).unwrap().token);
    }
}
