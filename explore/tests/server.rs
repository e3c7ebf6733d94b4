//! The server without a browser: who is let in, what is bounded, and that its numbers are those of a run.

mod client;

use std::io::Write;
use std::net::TcpStream;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use pellicle::Case;
use pellicle::result::quantities::QUANTITIES;
use serde_json::{Value, json};

use self::client::{Answer, Page};

const COATING: &str = "title = \"ball\"\n[foundation]\nsubstrate = { young_modulus = \"7 GPa\", poisson_ratio = 0.4 }\n\
    [[foundation.layer]]\nthickness = \"1 um\"\nyoung_modulus = \"70 GPa\"\npoisson_ratio = 0.3\nyield_strength = \"1 GPa\"\n\
    [indenter]\nkind = \"paraboloid\"\nradius = \"1 mm\"\n[load]\nforces = [\"1 mN\", \"10 mN\"]\n[grid]\nelements = 32\n";

/// The summary of the case of a text, as `run --json` has it.
fn solved(text: &str) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("case.toml");
    std::fs::write(&path, text).unwrap();
    let run = Case::from_toml(&path).unwrap().solve(&mut ()).unwrap();
    serde_json::to_value(&run.summary).unwrap()
}

fn ask(text: &str, more: &Value) -> Value {
    static ASKED: AtomicU64 = AtomicU64::new(0);
    let number = ASKED.fetch_add(1, Ordering::Relaxed);
    let mut ask = json!({ "page": "a", "number": number, "name": "case.toml", "text": text });
    ask.as_object_mut()
        .unwrap()
        .extend(more.as_object().unwrap().clone());
    ask
}

/// Asserts that every number of an answer is that of a summary to the bit; returns how many there are.
fn same_numbers(answer: &Value, summary: &Value) -> usize {
    let steps = answer["result"]["steps"].as_array().unwrap();
    assert_eq!(steps.len(), summary["steps"].as_array().unwrap().len());
    let mut compared = 0;
    for (step, expected) in steps.iter().zip(summary["steps"].as_array().unwrap()) {
        for number in step["numbers"].as_array().unwrap() {
            let key = number["key"].as_str().unwrap();
            let place = format!("/{}", key.replace('.', "/"));
            assert_eq!(Some(&number["value"]), expected.pointer(&place), "{key}");
            if QUANTITIES
                .iter()
                .any(|of| of.key == key && of.error.is_some())
            {
                assert_eq!(
                    number["error"], expected["grid_error"][key]["estimate"],
                    "{key}"
                );
            }
            compared += 1;
        }
    }
    compared
}

#[test]
fn an_answer_has_the_numbers_of_a_run_to_the_bit() {
    let page = Page::open();
    let edits = json!({ "edits": [
        { "do": "set", "key": "foundation.layer[0].thickness", "to": "1.37 um" },
        { "do": "kind", "key": "indenter", "to": "sphere" },
        { "do": "table", "key": "stress" },
    ] });
    let answer = page.solve(&ask(COATING, &edits));
    let text = answer["text"].as_str().unwrap();
    assert!(
        text.contains("1.37 um") && text.contains("\"sphere\"") && text.contains("[stress]"),
        "{text}"
    );
    let summary = solved(text);
    assert!(same_numbers(&answer, &summary) > 16);
    let result = &answer["result"];
    assert_eq!(
        (&result["status"], &result["elements"]),
        (&json!("certified"), &json!(32))
    );
    assert_eq!(result["warnings"], summary["warnings"]);
    let stress = &result["steps"][1]["stresses"][0];
    assert_eq!(
        stress["value"],
        summary["steps"][1]["stress"]["bodies"][0]["max_von_mises"]["value"]
    );
    assert_eq!(result["critical"], json!(["1 critical load"]));
}

#[test]
fn a_sketch_is_the_case_with_fewer_elements_and_without_stresses() {
    let page = Page::open();
    let text = format!("{COATING}[stress]\n");
    let answer = page.solve(&ask(&text, &json!({ "elements": 16 })));
    let result = &answer["result"];
    assert_eq!(
        (&result["elements"], &result["is_sketch"]),
        (&json!(16), &json!(true))
    );
    assert_eq!(result["steps"][0]["stresses"], Value::Null);
    let coarse = text
        .replace("elements = 32", "elements = 16")
        .replace("[stress]\n", "");
    same_numbers(&answer, &solved(&coarse));
    assert_eq!(answer["text"], text, "the case itself has its own elements");
    // A mean over less than an element of the sketch is that of the case alone.
    let mean = format!("{COATING}[output]\nmean_pressure_over = \"3 um\"\n");
    let mean = mean.replace("elements = 32", "elements = 96");
    let sketch = page.solve(&ask(&mean, &json!({ "elements": 16 })));
    assert_eq!(sketch["result"]["is_sketch"], json!(true), "{sketch}");
    let own = page.solve(&ask(COATING, &json!({ "elements": 64 })));
    assert_eq!(
        (&own["result"]["elements"], &own["result"]["is_sketch"]),
        (&json!(32), &json!(false))
    );
}

#[test]
fn a_bad_value_is_answered_with_its_key_and_the_sentence_of_the_reader() {
    let page = Page::open();
    for (key, to, sentence) in [
        (
            "foundation.layer[0].thickness",
            "-1 um",
            "found \"-1 um\", wanted a positive length",
        ),
        (
            "foundation.layer[0].poisson_ratio",
            "0.6",
            "Poisson's ratio",
        ),
        ("indenter.kind", "bal", "found \"bal\", wanted"),
        ("load.froce", "1 mN", "unknown key"),
    ] {
        let edits = json!({ "edits": [{ "do": "set", "key": key, "to": to }] });
        let answer = page.solve(&ask(COATING, &edits));
        let error = &answer["error"];
        assert_eq!(error["key"], key, "{error}");
        assert!(
            error["sentence"].as_str().unwrap().contains(sentence),
            "{error}"
        );
        assert!(
            answer["text"].as_str().unwrap().contains(to),
            "the text has the value all the same"
        );
    }
    let answer = page.solve(&ask("[load\n", &json!({})));
    assert!(
        answer["error"]["sentence"]
            .as_str()
            .unwrap()
            .contains("wanted TOML"),
        "{answer}"
    );
}

#[test]
fn only_the_page_itself_is_served() {
    let page = Page::open();
    let token = page.token();
    let host = page.host();
    let status = |path: &str, headers: &str| {
        page.raw(&format!("GET {path} HTTP/1.1\r\n{headers}\r\n"))
            .status
    };
    let own = format!("Host: {host}\r\n");
    assert_eq!(status(&format!("/{token}/"), &own), 200);
    assert_eq!(
        status(
            &format!("/{token}/page.js"),
            &format!("{own}Origin: http://{host}\r\n")
        ),
        200
    );
    for path in [
        "/",
        "/page.js",
        "/0123456789abcdef0123456789abcdef/",
        "/form",
    ] {
        assert_eq!(status(path, &own), 403, "{path}");
    }
    let port = page.port();
    for headers in [
        format!("Host: example.org:{port}\r\n"),
        "Host: 127.0.0.1\r\n".into(),
        String::new(),
        format!("{own}Origin: http://example.org\r\n"),
        format!("{own}Origin: null\r\n"),
        format!("{own}Origin: https://{host}\r\n"),
    ] {
        assert_eq!(
            status(&format!("/{token}/form"), &headers),
            403,
            "{headers:?}"
        );
    }
    assert_eq!(status(&format!("/{token}/secret"), &own), 404);
    assert_eq!(
        status(&format!("/{token}/solve"), &own),
        404,
        "a solution is asked for by POST"
    );
    let loaded = page.raw(&format!("GET /{token}/ HTTP/1.1\r\n{own}\r\n"));
    let elsewhere = loaded.body.matches("://").count() + loaded.body.matches("src=\"//").count();
    assert_eq!(elsewhere, 0, "nothing comes from the network");
    assert!(
        loaded
            .head
            .contains("Content-Security-Policy: default-src 'none'")
    );
}

#[test]
fn what_is_no_request_is_refused_and_the_page_lives_on() {
    let page = Page::open();
    let (token, host) = (page.token(), page.host());
    let post =
        |headers: &str| format!("POST /{token}/solve HTTP/1.1\r\nHost: {host}\r\n{headers}\r\n");
    let large = post("Content-Length: 10485760\r\n") + &"x".repeat(10 << 20);
    for (sent, status) in [
        (large, 413),
        (post("Content-Length: 99999999999999999999999\r\n"), 413),
        (post("Content-Length: -5\r\n"), 400),
        (post("Content-Length: 1\r\nContent-Length: 2\r\n"), 400),
        (post("Transfer-Encoding: chunked\r\n"), 411),
        (post("Content-Length: 2\r\n") + "{}", 400),
        (post("Content-Length: 3\r\n") + "\u{fffd}", 400),
        (post(&format!("X: {}\r\n", "y".repeat(20 << 10))), 431),
        (post(&"X: y\r\n".repeat(100)), 431),
        ("\0\u{1}\u{2}\u{3}\r\n\r\n".into(), 400),
        ("GET / HTTP/9.9\r\n\r\n".into(), 400),
    ] {
        let answer = page.raw(&sent);
        assert_eq!(answer.status, status, "{:.80}: {}", sent, answer.body);
    }
    // One that says nothing, and one that leaves in the middle.
    drop(TcpStream::connect(&host).unwrap());
    TcpStream::connect(&host)
        .unwrap()
        .write_all(b"POST /")
        .unwrap();
    assert!(page.solve(&ask(COATING, &json!({})))["result"].is_object());
}

#[test]
fn a_flood_of_requests_is_served_or_refused() {
    let page = Arc::new(Page::open());
    let request = format!(
        "GET /{}/form HTTP/1.1\r\nHost: {}\r\n\r\n",
        page.token(),
        page.host()
    );
    // All are connected before the first one asks.
    let mut connected = Vec::new();
    // As many as the files that a process may usually open; tests/browser/page.py sends a thousand.
    for _ in 0..500 {
        connected.extend(TcpStream::connect(page.host()));
    }
    let asking = connected.into_iter().map(|stream| {
        let request = request.clone();
        thread::Builder::new()
            .stack_size(64 << 10)
            .spawn(move || Answer::of(stream, &request).map(|answer| answer.status))
    });
    let statuses: Vec<_> = asking
        .collect::<Vec<_>>()
        .into_iter()
        .map(|asked| asked.unwrap().join().unwrap())
        .collect();
    // None: the connection was closed before the request was read.
    let served = statuses
        .iter()
        .filter(|status| **status == Some(200))
        .count();
    assert!(served > 0, "{statuses:?}");
    assert!(
        statuses
            .iter()
            .all(|status| matches!(status, None | Some(200 | 503))),
        "{statuses:?}"
    );
    assert!(page.most_threads() < 64, "{}", page.most_threads());
    assert!(page.solve(&ask(COATING, &json!({})))["result"].is_object());
}

#[test]
fn a_newer_request_stops_an_older_one_of_its_page() {
    let page = Arc::new(Page::open());
    // Some seconds of work.
    let long = COATING.replace("elements = 32", "elements = 1024");
    let long = long.replace(
        "[\"1 mN\", \"10 mN\"]",
        "{ from = \"1 mN\", to = \"9 mN\", count = 400 }",
    );
    let older = {
        let (page, ask) = (Arc::clone(&page), ask(&long, &json!({})));
        thread::spawn(move || page.solve(&ask))
    };
    thread::sleep(Duration::from_millis(300));
    let start = Instant::now();
    let newer = page.solve(&ask(COATING, &json!({})));
    assert!(newer["result"].is_object());
    let older = older.join().unwrap();
    assert_eq!(older["superseded"], true, "{older}");
    assert_eq!(older["result"], Value::Null);
    assert!(
        start.elapsed() < Duration::from_secs(20),
        "400 steps would take minutes"
    );
}

#[test]
fn the_server_ends_when_it_is_stopped_and_when_its_page_closes() {
    let page = Page::open();
    let open = page.hold();
    thread::sleep(Duration::from_millis(200));
    drop(open);
    assert_eq!(page.ended(), pellicle_explore::Ending::PagesClosed);
    let page = Page::open();
    let _open = page.hold();
    page.stop();
    assert_eq!(page.ended(), pellicle_explore::Ending::Stopped);
}
