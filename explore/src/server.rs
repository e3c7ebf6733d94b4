//! The server of the page: on this machine only, for the page only, and with bounds on everything.

use std::io::{self, Read};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

use crate::engine::{Ask, Engine, Setup};
use crate::gate::Gate;
use crate::http::{self, Request, Response, Status, begin_events, is_timeout};
use crate::pages::Pages;

/// Most connections at a time: a page has at most six.
const MOST_CONNECTIONS: usize = 32;

/// Most of them that may tell that a page is open; the others answer.
const MOST_OPEN_PAGES: usize = 16;

/// Interval at which the end is checked.
const LOOK: Duration = Duration::from_millis(50);

/// The same of a connection that only tells that a page is open.
const LOOK_OF_PAGE: Duration = Duration::from_millis(500);

const INDEX: &str = include_str!("page/index.html");
const SCRIPT: &str = include_str!("page/page.js");
const STYLE: &str = include_str!("page/page.css");

/// A server that listens.
#[derive(Debug)]
pub struct Server {
    listener: TcpListener,
    site: Arc<Site>,
}

/// Why a server ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// The last page was closed.
    PagesClosed,
    /// The caller stopped it.
    Stopped,
}

/// What the connections share.
#[derive(Debug)]
struct Site {
    engine: Engine,
    gate: Gate,
    pages: Pages,
    connections: AtomicUsize,
    open_pages: AtomicUsize,
}

impl Server {
    /// Listens on this port of this machine, or on a free one.
    ///
    /// # Errors
    ///
    /// [`io::Error`] if the port is taken.
    pub fn listen(port: Option<u16>, setup: Setup) -> io::Result<Self> {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port.unwrap_or_default()))?;
        let gate = Gate::new(listener.local_addr()?.port())?;
        let site = Site {
            engine: Engine::new(setup),
            gate,
            pages: Pages::default(),
            connections: AtomicUsize::new(0),
            open_pages: AtomicUsize::new(0),
        };
        Ok(Self {
            listener,
            site: Arc::new(site),
        })
    }

    /// The address of the page, with its token.
    #[must_use]
    pub fn address(&self) -> String {
        self.site.gate.address()
    }

    /// Serves until all pages are closed, or until the caller stops it.
    ///
    /// # Errors
    ///
    /// [`io::Error`] if the system gives no more connections.
    pub fn serve(self, is_stopped: impl Fn() -> bool) -> io::Result<Ending> {
        let Self { listener, site } = self;
        let address = listener.local_addr()?;
        let accepting = {
            let site = Arc::clone(&site);
            thread::Builder::new().spawn(move || accept(&listener, &site))?
        };
        let ending = loop {
            if is_stopped() {
                break Ending::Stopped;
            }
            if site.pages.are_closed() {
                break Ending::PagesClosed;
            }
            if accepting.is_finished() {
                return Err(io::Error::other("the server of the page has ended"));
            }
            thread::sleep(LOOK);
        };
        site.engine.end();
        // Wakes the thread that accepts connections; if there is none, it has ended.
        drop(TcpStream::connect(address));
        drop(accepting.join());
        Ok(ending)
    }
}

fn accept(listener: &TcpListener, site: &Arc<Site>) {
    for stream in listener.incoming() {
        if site.engine.is_ending() {
            return;
        }
        // The client has gone, or the process has too many files open, which others close.
        let Ok(stream) = stream else {
            thread::sleep(LOOK);
            continue;
        };
        let Some(seat) = Seat::take(site, |site| &site.connections, MOST_CONNECTIONS) else {
            let words = "found too many connections at a time, wanted fewer";
            Response::text(Status::Busy, words).send_and_forget(&stream);
            continue;
        };
        // If there is no thread for it, the connection closes.
        let connection = thread::Builder::new().name("connection".into());
        drop(connection.spawn(move || seat.site.connected(&stream)));
    }
}

/// One of a bounded number of places, which is free again when this is dropped.
struct Seat {
    site: Arc<Site>,
    of: fn(&Site) -> &AtomicUsize,
}

impl Seat {
    fn take(site: &Arc<Site>, of: fn(&Site) -> &AtomicUsize, most: usize) -> Option<Self> {
        let one_more = |taken| (taken < most).then_some(taken + 1);
        let (set, fetch) = (Ordering::SeqCst, Ordering::SeqCst);
        of(site).fetch_update(set, fetch, one_more).ok()?;
        Some(Self {
            site: Arc::clone(site),
            of,
        })
    }
}

impl Drop for Seat {
    fn drop(&mut self) {
        (self.of)(&self.site).fetch_sub(1, Ordering::SeqCst);
    }
}

impl Site {
    fn connected(self: &Arc<Self>, stream: &TcpStream) {
        match http::read(stream) {
            Ok(request) if self.is_of_an_open_page(&request) => self.stay(stream),
            Ok(request) => self.respond(&request).send(stream),
            Err(unreadable) => {
                if let Some(response) = unreadable.response() {
                    response.send(stream);
                }
            }
        }
    }

    fn is_of_an_open_page(&self, request: &Request) -> bool {
        request.method == "GET" && self.gate.path(request) == Some("/open")
    }

    fn respond(&self, request: &Request) -> Response {
        let Some(path) = self.gate.path(request) else {
            let words =
                "found a request from elsewhere, wanted the address that `pellicle explore` shows";
            return Response::text(Status::Forbidden, words);
        };
        match (request.method.as_str(), path) {
            ("GET", "/") => Response::of("text/html; charset=utf-8", INDEX),
            ("GET", "/page.js") => Response::of("text/javascript; charset=utf-8", SCRIPT),
            ("GET", "/page.css") => Response::of(
                "text/css; charset=utf-8",
                [pellicle_files::PAGE_STYLE, STYLE].join("\n"),
            ),
            ("GET", "/form") => json(&self.engine.form()),
            ("POST", "/solve") => match serde_json::from_slice::<Ask>(&request.body) {
                Ok(ask) => {
                    let turn = self.pages.turn(&ask.page, ask.number);
                    json(&self.engine.answer(&ask, &turn))
                }
                Err(error) => Response::text(Status::BadRequest, error.to_string()),
            },
            _ => Response::text(Status::NotFound, "found no such page"),
        }
    }

    /// Counts a page as open until its connection ends.
    fn stay(self: &Arc<Self>, mut stream: &TcpStream) {
        let Some(_seat) = Seat::take(self, |site| &site.open_pages, MOST_OPEN_PAGES) else {
            let words = "found too many open pages, wanted fewer";
            return Response::text(Status::Busy, words).send(stream);
        };
        let _page = self.pages.open();
        if begin_events(stream).is_err() || stream.set_read_timeout(Some(LOOK_OF_PAGE)).is_err() {
            return;
        }
        while !self.engine.is_ending() {
            match stream.read(&mut [0; 64]) {
                Ok(1..) => {}
                Err(error) if is_timeout(&error) => {}
                Ok(0) | Err(_) => return,
            }
        }
    }
}

fn json(value: &serde_json::Value) -> Response {
    Response::of("application/json", value.to_string())
}
