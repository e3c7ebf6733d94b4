//! `pellicle explore`, without a browser: its address, its end, and what it says if it cannot begin.
#![cfg(unix)]

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Command, Stdio};

use super::runner::{CASE, ProgramOutput, TestFolder};

/// The status line of the page at an address.
fn status(address: &str) -> String {
    let host = address.split('/').nth(2).unwrap();
    let path = address.split_once(host).unwrap().1;
    let mut stream = TcpStream::connect(host).unwrap();
    write!(stream, "GET {path} HTTP/1.1\r\nHost: {host}\r\n\r\n").unwrap();
    let mut answer = String::new();
    stream.read_to_string(&mut answer).unwrap();
    answer.lines().next().unwrap().to_owned()
}

#[test]
fn the_page_is_at_the_address_that_is_printed_until_ctrl_c() {
    let folder = TestFolder::with_case(CASE);
    let mut command = folder.command(&["explore", "case.toml", "--no-browser"]);
    let mut program = command
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut address = String::new();
    let mut printed = BufReader::new(program.stdout.take().unwrap());
    printed.read_line(&mut address).unwrap();
    assert_eq!(status(address.trim()), "HTTP/1.1 200 OK");
    let port = address.split([':', '/']).nth(4).unwrap();
    let second = folder.run(&["explore", "case.toml", "--no-browser", "--port", port]);
    assert_eq!(second.code, Some(2));
    assert!(
        second.stderr.contains("the page cannot be served: "),
        "{}",
        second.stderr
    );
    let id = program.id().to_string();
    assert!(
        Command::new("kill")
            .args(["-INT", &id])
            .status()
            .unwrap()
            .success()
    );
    let ended: ProgramOutput = program.wait_with_output().unwrap().into();
    assert_eq!(ended.code, Some(130), "{}", ended.stderr);
    assert_eq!(folder.names(), ["case.toml"]);
}

#[test]
fn a_case_that_cannot_be_read_opens_no_page() {
    let folder = TestFolder::new();
    let ran = folder.run(&["explore", "case.toml", "--no-browser"]);
    assert_eq!((ran.code, &*ran.stdout), (Some(2), ""));
    assert!(
        ran.stderr.contains("cannot be read as a case file"),
        "{}",
        ran.stderr
    );
}
