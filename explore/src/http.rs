//! One request of HTTP/1.1 from a connection, and its response: every size and time is bounded.

use std::io::{self, Read, Write};
use std::net::{Shutdown, TcpStream};
use std::time::{Duration, Instant};

/// The largest body of a request, bytes: many times the text of any case.
pub const MAX_BODY: usize = 1 << 20;

/// The largest request line with its headers, bytes, and the number of headers; a browser sends a tenth of it.
const MAX_HEAD: usize = 16 << 10;
const MAX_HEADERS: usize = 64;

/// Time in which a request must arrive, and in which its response must be taken.
const PATIENCE: Duration = Duration::from_secs(10);

/// Time and bytes for which the rest of a refused request is read: a connection closed earlier loses the response.
const LINGER: (Duration, usize) = (Duration::from_millis(500), 16 << 20);

/// A request.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Request {
    /// `GET` or `POST`, or what was sent instead.
    pub method: String,
    /// The path, and a query if there is one.
    pub path: String,
    /// The header `Host`.
    pub host: Option<String>,
    /// The header `Origin`.
    pub origin: Option<String>,
    /// The body.
    pub body: Vec<u8>,
}

/// The reason why a request cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum Unreadable {
    /// The connection ended or broke.
    #[error("the connection ended: {0}")]
    Gone(#[from] io::Error),
    /// It is not HTTP.
    #[error("found no request of HTTP/1.1: {0}")]
    Malformed(String),
    /// It has too long a head.
    #[error("found headers of more than {MAX_HEAD} bytes")]
    Head,
    /// It has a body of unknown length.
    #[error("found a body of unknown length, wanted the header Content-Length")]
    Length,
    /// It has too long a body.
    #[error("found a body of {0} bytes, wanted at most {MAX_BODY}")]
    Body(usize),
    /// It did not arrive in time.
    #[error("found no whole request within {} s", PATIENCE.as_secs())]
    Late,
}

impl Unreadable {
    /// The response; none if nobody waits for one.
    #[must_use]
    pub fn response(&self) -> Option<Response> {
        let status = match self {
            Self::Gone(_) => return None,
            Self::Malformed(_) => Status::BadRequest,
            Self::Head => Status::HeadTooLarge,
            Self::Length => Status::LengthRequired,
            Self::Body(_) => Status::BodyTooLarge,
            Self::Late => Status::Timeout,
        };
        Some(Response::text(status, self.to_string()))
    }
}

/// Reads a request.
///
/// # Errors
///
/// [`Unreadable`] if it is malformed, too large or late.
pub fn read(stream: &TcpStream) -> Result<Request, Unreadable> {
    let until = Instant::now() + PATIENCE;
    let mut bytes = Vec::new();
    let (mut request, head, length) = loop {
        if let Some(parsed) = parse(&bytes)? {
            break parsed;
        }
        if bytes.len() >= MAX_HEAD {
            return Err(Unreadable::Head);
        }
        more(stream, &mut bytes, until)?;
    };
    if length > MAX_BODY {
        return Err(Unreadable::Body(length));
    }
    while bytes.len() < head + length {
        more(stream, &mut bytes, until)?;
    }
    request.body = bytes[head..head + length].to_vec();
    Ok(request)
}

/// Reads the next bytes.
fn more(mut stream: &TcpStream, bytes: &mut Vec<u8>, until: Instant) -> Result<(), Unreadable> {
    let left = until.saturating_duration_since(Instant::now());
    if left.is_zero() {
        return Err(Unreadable::Late);
    }
    stream.set_read_timeout(Some(left))?;
    let mut part = [0; 16 << 10];
    match stream.read(&mut part) {
        Ok(0) => Err(io::Error::from(io::ErrorKind::UnexpectedEof).into()),
        Ok(count) => {
            bytes.extend_from_slice(&part[..count]);
            Ok(())
        }
        Err(error) if is_timeout(&error) => Err(Unreadable::Late),
        Err(error) => Err(error.into()),
    }
}

/// Whether a read or write ended because of its timeout.
pub(crate) fn is_timeout(error: &io::Error) -> bool {
    matches!(
        error.kind(),
        io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut
    )
}

/// The head of a request, with the numbers of bytes of head and body; none if there is more to come.
fn parse(bytes: &[u8]) -> Result<Option<(Request, usize, usize)>, Unreadable> {
    let mut headers = [httparse::EMPTY_HEADER; MAX_HEADERS];
    let mut parsed = httparse::Request::new(&mut headers);
    let malformed = |what: &dyn ToString| Unreadable::Malformed(what.to_string());
    let head = match parsed.parse(bytes) {
        Ok(httparse::Status::Complete(head)) => head,
        Ok(httparse::Status::Partial) => return Ok(None),
        Err(httparse::Error::TooManyHeaders) => return Err(Unreadable::Head),
        Err(error) => return Err(malformed(&error)),
    };
    // Of a header given twice, neither can be trusted.
    let header = |name: &str| {
        let mut of_name = (parsed.headers.iter()).filter(|of| of.name.eq_ignore_ascii_case(name));
        let value = of_name
            .next()
            .map(|of| String::from_utf8_lossy(of.value).into_owned());
        match of_name.next() {
            Some(_) => Err(malformed(&format!("two headers {name}"))),
            None => Ok(value),
        }
    };
    if header("Transfer-Encoding")?.is_some() {
        return Err(Unreadable::Length);
    }
    let length = match header("Content-Length")? {
        None => 0,
        Some(text) if text.bytes().all(|byte| byte.is_ascii_digit()) => {
            text.parse().unwrap_or(usize::MAX)
        }
        Some(text) => return Err(malformed(&format!("Content-Length: {text}"))),
    };
    let request = Request {
        method: parsed.method.unwrap_or_default().to_owned(),
        path: parsed.path.unwrap_or_default().to_owned(),
        host: header("Host")?,
        origin: header("Origin")?,
        body: Vec::new(),
    };
    Ok(Some((request, head, length)))
}

/// The status of a response.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// Served.
    Ok,
    /// Not HTTP, or no request of the page.
    BadRequest,
    /// From elsewhere, or without the token.
    Forbidden,
    /// No such path.
    NotFound,
    /// Too slow.
    Timeout,
    /// Of unknown length.
    LengthRequired,
    /// Too large a body.
    BodyTooLarge,
    /// Too large a head.
    HeadTooLarge,
    /// Too many connections.
    Busy,
}

impl Status {
    fn line(self) -> &'static str {
        match self {
            Self::Ok => "200 OK",
            Self::BadRequest => "400 Bad Request",
            Self::Forbidden => "403 Forbidden",
            Self::NotFound => "404 Not Found",
            Self::Timeout => "408 Request Timeout",
            Self::LengthRequired => "411 Length Required",
            Self::BodyTooLarge => "413 Content Too Large",
            Self::HeadTooLarge => "431 Request Header Fields Too Large",
            Self::Busy => "503 Service Unavailable",
        }
    }
}

/// What every response says: nothing is kept, nothing is loaded from elsewhere, no other page may show this one.
const HEADERS: &str = "Connection: close\r\n\
    Cache-Control: no-store\r\n\
    Content-Security-Policy: default-src 'none'; connect-src 'self'; script-src 'self'; style-src 'self' 'unsafe-inline'; \
    img-src data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'\r\n\
    Cross-Origin-Resource-Policy: same-origin\r\n\
    Referrer-Policy: no-referrer\r\n\
    X-Content-Type-Options: nosniff\r\n";

/// A response.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Response {
    /// Its status.
    pub status: Status,
    kind: &'static str,
    body: Vec<u8>,
}

impl Response {
    /// A file of this media type.
    #[must_use]
    pub fn of(kind: &'static str, body: impl Into<Vec<u8>>) -> Self {
        let (status, body) = (Status::Ok, body.into());
        Self { status, kind, body }
    }

    /// A sentence.
    #[must_use]
    pub fn text(status: Status, sentence: impl Into<String>) -> Self {
        Self {
            status,
            kind: "text/plain; charset=utf-8",
            body: (sentence.into() + "\n").into(),
        }
    }

    /// Sends it and closes the connection; if nobody takes it, it is lost.
    pub fn send(&self, stream: &TcpStream) {
        if write(stream, &self.bytes()).is_ok() {
            linger(stream);
        }
    }

    /// Sends it without waiting for anything.
    pub fn send_and_forget(&self, stream: &TcpStream) {
        if stream.set_nonblocking(true).is_ok() {
            drop(write_all(stream, &self.bytes()));
        }
    }

    fn bytes(&self) -> Vec<u8> {
        let (line, kind, length) = (self.status.line(), self.kind, self.body.len());
        let head = format!(
            "HTTP/1.1 {line}\r\nContent-Type: {kind}\r\nContent-Length: {length}\r\n{HEADERS}\r\n"
        );
        [head.as_bytes(), &self.body].concat()
    }
}

/// Begins a stream of events, which the page reads as long as it is open.
///
/// # Errors
///
/// [`io::Error`] if the connection is closed.
pub fn begin_events(stream: &TcpStream) -> io::Result<()> {
    let head = format!("HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\n{HEADERS}\r\n:\n\n");
    write(stream, head.as_bytes())
}

fn write(stream: &TcpStream, bytes: &[u8]) -> io::Result<()> {
    stream.set_write_timeout(Some(PATIENCE))?;
    write_all(stream, bytes)
}

fn write_all(mut stream: &TcpStream, bytes: &[u8]) -> io::Result<()> {
    stream.write_all(bytes)?;
    stream.flush()
}

/// Reads on until the other side closes, too.
fn linger(mut stream: &TcpStream) {
    let (time, bytes) = LINGER;
    let until = Instant::now() + time;
    let mut part = [0; 16 << 10];
    let mut read = 0;
    if stream.shutdown(Shutdown::Write).is_err() || stream.set_read_timeout(Some(time)).is_err() {
        return;
    }
    while let Ok(count @ 1..) = stream.read(&mut part) {
        read += count;
        if read > bytes || Instant::now() > until {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_head_is_read_once_it_is_whole() {
        let text = b"POST /a HTTP/1.1\r\nhost: here\r\nContent-Length: 3\r\n\r\nabc";
        assert!(parse(&text[..40]).unwrap().is_none());
        let (request, head, length) = parse(text).unwrap().unwrap();
        assert_eq!((request.path.as_str(), head, length), ("/a", 51, 3));
        assert_eq!(request.host.as_deref(), Some("here"));
    }

    #[test]
    fn a_request_of_unclear_length_is_refused() {
        let refused = |headers: &str| parse(format!("POST / HTTP/1.1\r\n{headers}\r\n").as_bytes());
        for headers in [
            "Content-Length: 1\r\nContent-Length: 2\r\n",
            "Content-Length: -1\r\n",
            "Content-Length: +1\r\n",
            "Transfer-Encoding: chunked\r\n",
            "Host: a\r\nhost: b\r\n",
            "no colon\r\n",
        ] {
            assert!(refused(headers).is_err(), "{headers:?}");
        }
        let long = format!("Content-Length: {}\r\n", "9".repeat(40));
        assert!(matches!(refused(&long), Ok(Some((_, _, usize::MAX)))));
    }
}
