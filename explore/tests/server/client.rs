//! A client of the server, byte by byte.

use std::fs;
use std::io::{Read, Write};
use std::net::{Shutdown, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use pellicle::summary::RunSummary;
use pellicle_explore::{Ending, Server, Setup};
use pellicle_influence::Cache;
use serde_json::Value;

/// A server and its address.
pub struct Page {
    address: String,
    stop: Arc<AtomicBool>,
    threads: Arc<AtomicUsize>,
    serving: JoinHandle<Ending>,
}

impl Page {
    /// A server of this process, with no templates.
    pub fn open() -> Self {
        let setup = Setup {
            case: None,
            templates: Vec::new(),
            folder: "".into(),
            cache: Cache::in_memory(),
            critical,
        };
        let server = Server::listen(None, setup).unwrap();
        let (stop, threads) = (
            Arc::new(AtomicBool::new(false)),
            Arc::new(AtomicUsize::new(0)),
        );
        let (stopped, most) = (Arc::clone(&stop), Arc::clone(&threads));
        Self {
            address: server.address(),
            serving: thread::spawn(move || {
                let is_stopped = || {
                    most.fetch_max(connections(), Ordering::Relaxed);
                    stopped.load(Ordering::Relaxed)
                };
                server.serve(is_stopped).unwrap()
            }),
            stop,
            threads,
        }
    }

    pub fn host(&self) -> String {
        self.address.split('/').nth(2).unwrap().to_owned()
    }

    pub fn port(&self) -> String {
        self.host().split(':').nth(1).unwrap().to_owned()
    }

    pub fn token(&self) -> String {
        self.address.split('/').nth(3).unwrap().to_owned()
    }

    /// The answer to these bytes.
    pub fn raw(&self, request: &str) -> Answer {
        Answer::of(TcpStream::connect(self.host()).unwrap(), request).unwrap()
    }

    /// The answer to a request of the page.
    pub fn solve(&self, ask: &Value) -> Value {
        let (token, host, body) = (self.token(), self.host(), ask.to_string());
        let length = body.len();
        let answer = self.raw(&format!(
            "POST /{token}/solve HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\nContent-Length: {length}\r\n\r\n{body}"
        ));
        assert_eq!(answer.status, 200, "{}", answer.body);
        serde_json::from_str(&answer.body).unwrap()
    }

    /// The connection of an open page.
    pub fn hold(&self) -> TcpStream {
        let mut stream = TcpStream::connect(self.host()).unwrap();
        let (token, host) = (self.token(), self.host());
        write!(stream, "GET /{token}/open HTTP/1.1\r\nHost: {host}\r\n\r\n").unwrap();
        stream.read_exact(&mut [0; 15]).unwrap();
        stream
    }

    pub fn stop(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }

    /// How the server ended, once it has.
    pub fn ended(self) -> Ending {
        self.serving.join().unwrap()
    }

    /// The most threads with the name of a connection at a time.
    pub fn most_threads(&self) -> usize {
        self.threads.load(Ordering::Relaxed)
    }
}

fn critical(run: &RunSummary) -> String {
    run.critical.as_ref().map_or_else(String::new, |loads| {
        format!("{} critical load\n", loads.len())
    })
}

/// Threads of this process that serve a connection.
fn connections() -> usize {
    let Ok(threads) = fs::read_dir("/proc/self/task") else {
        return 0;
    };
    let name = |thread: fs::DirEntry| fs::read_to_string(thread.path().join("comm")).ok();
    let names = threads.flatten().filter_map(name);
    names.filter(|name| name.trim() == "connection").count()
}

/// What a server sent.
#[derive(Debug)]
pub struct Answer {
    pub status: u16,
    pub head: String,
    pub body: String,
}

impl Answer {
    /// The answer to these bytes; none if the connection was closed without one.
    pub fn of(mut stream: TcpStream, request: &str) -> Option<Self> {
        stream
            .set_read_timeout(Some(Duration::from_secs(100)))
            .unwrap();
        // The server may close before it has read everything.
        drop(stream.write_all(request.as_bytes()));
        drop(stream.shutdown(Shutdown::Write));
        let mut bytes = Vec::new();
        drop(stream.read_to_end(&mut bytes));
        let text = String::from_utf8(bytes).unwrap();
        let (head, body) = text.split_once("\r\n\r\n")?;
        let status = head.split(' ').nth(1)?.parse().ok()?;
        Some(Self {
            status,
            head: head.to_owned(),
            body: body.to_owned(),
        })
    }
}
