//! `solve --stream`: values in, summaries out, line by line.

use std::io::{BufRead, BufReader, Write};
use std::process::Stdio;

use serde_json::Value;

use super::runner::{CASE, ProgramOutput, TestFolder};

/// Writes one line at a time and reads its answer before the next; returns the exit code and the answers.
fn answers(folder: &TestFolder, lines: &[&str]) -> (Option<i32>, Vec<Value>) {
    let mut command = folder.command(&["solve", "case.toml", "--stream"]);
    let command = command.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = command.spawn().unwrap();
    let mut input = child.stdin.take().unwrap();
    let mut output = BufReader::new(child.stdout.take().unwrap()).lines();
    let answer = |line: &&str| {
        writeln!(input, "{line}").unwrap();
        serde_json::from_str(&output.next().unwrap().unwrap()).unwrap()
    };
    let answers = lines.iter().map(answer).collect();
    drop(input);
    assert!(output.next().is_none());
    (child.wait().unwrap().code(), answers)
}

/// Returns the summary without its times.
fn numbers(mut summary: Value) -> Value {
    summary["timing"].take();
    for step in summary["steps"].as_array_mut().unwrap() {
        step["work"]["seconds"].take();
    }
    summary
}

#[test]
fn every_line_is_answered_with_the_summary_of_a_run_before_the_next_is_read() {
    let folder = TestFolder::with_case(CASE);
    let lines = [
        "{\"load.force\": \"2 uN\", \"grid.elements\": 48}",
        "{\"foundation.layer[0].thickness\": \"20 nm\", \"load\": {\"forces\": [\"1 uN\", \"2 uN\"]}}",
        "{}",
    ];
    let (code, answers) = answers(&folder, &lines);
    assert_eq!(code, Some(0));
    for (answer, sets) in answers.into_iter().zip([
        &["load.force=2 uN", "grid.elements=48"][..],
        &[
            "foundation.layer[0].thickness=20 nm",
            "load={forces = [\"1 uN\", \"2 uN\"]}",
        ],
        &[],
    ]) {
        let sets = sets.iter().flat_map(|set| ["--set", set]);
        let line: Vec<_> = ["run", "case.toml", "--json"]
            .into_iter()
            .chain(sets)
            .collect();
        let ran: ProgramOutput = folder.run(&line);
        let run = serde_json::from_str(&ran.stdout).unwrap();
        assert_eq!(numbers(answer), numbers(run), "{line:?}");
    }
}

#[test]
fn an_error_is_an_answer_with_its_line_and_the_next_line_is_solved() {
    let folder = TestFolder::with_case(CASE);
    let lines = [
        "{\"load.froce\": \"2 uN\"}",
        "{\"load.force\": null}",
        "[1]",
        "{\"load.force\": ",
        "{\"surface.radius\": \"26 nm\"}",
        "{}",
    ];
    let (code, answers) = answers(&folder, &lines);
    assert_eq!(code, Some(1));
    let wanted = [
        "standard input, line 1, key `load.froce`: found an unknown key",
        "standard input, line 2, key `load.force`: found null",
        "standard input, line 3: found other JSON, wanted an object of keys and values",
        "standard input, line 4: found EOF while parsing",
        "overlap",
    ];
    for (i, wanted) in wanted.into_iter().enumerate() {
        assert_eq!(
            (&answers[i]["line"], &answers[i]["status"]),
            (&(i + 1).into(), &"failed".into())
        );
        let error = answers[i]["error"].as_str().unwrap();
        assert!(error.contains(wanted), "{wanted} in {error}");
    }
    assert_eq!(answers[5]["status"], "certified");
}

#[test]
fn a_key_twice_and_bytes_that_are_no_text_are_answered_and_the_stream_goes_on() {
    let folder = TestFolder::with_case(CASE);
    let lines: [&[u8]; 7] = [
        b"{\"load.force\": \"2 uN\", \"load.force\": \"1 uN\"}",
        b"{\"load\": {\"force\": \"2 uN\", \"force\": \"1 uN\"}}",
        b"{\"load.force\": \"2 uN\", \"load\": {\"force\": \"1 uN\"}}",
        b"{\"foundation.layer[0].thickness\": 2, \"foundation.layer.0.thickness\": 3}",
        b"{\"title\": \"\xff\"}",
        b"\xfe\xff\x00{",
        b"{}",
    ];
    let mut command = folder.command(&["solve", "case.toml", "--stream"]);
    let command = command.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = command.spawn().unwrap();
    let mut input = child.stdin.take().unwrap();
    input.write_all(&lines.join(&b'\n')).unwrap();
    drop(input);
    let output: ProgramOutput = child.wait_with_output().unwrap().into();
    assert_eq!(output.code, Some(1), "{}", output.stderr);
    let answers: Vec<Value> = (output.stdout.lines())
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    let wanted = [
        "standard input, line 1: found the key `load.force` twice",
        "standard input, line 2: found the key `force` twice",
        "line 3: found the keys `load.force` and `load`, which overlap, wanted each key once",
        "line 4: found the keys `foundation.layer[0].thickness` and `foundation.layer.0.thickness`, which overlap",
        "line 5: found the byte 0xff, which is not UTF-8, wanted JSON in UTF-8",
        "line 6: found the byte 0xfe, which is not UTF-8",
    ];
    assert_eq!(answers.len(), lines.len());
    for (answer, wanted) in answers.iter().zip(wanted) {
        let error = answer["error"].as_str().unwrap();
        assert!(error.contains(wanted), "{wanted} in {error}");
    }
    assert_eq!(answers[6]["status"], "certified");
}

#[test]
fn a_warning_quotes_the_value_and_its_line() {
    let folder = TestFolder::with_case(CASE);
    let (_, answers) = answers(&folder, &["{\"load.force\": 2e-6, \"title\": \"x\"}"]);
    let message = answers[0]["warnings"][0]["message"].as_str().unwrap();
    let wanted = "standard input, line 1, key `load.force`: 2e-6 among values with units";
    assert!(message.starts_with(wanted), "{message}");
}

#[test]
fn without_the_stream_option_nothing_is_solved() {
    let folder = TestFolder::with_case(CASE);
    let ran = folder.run(&["solve", "case.toml"]);
    assert_eq!(ran.code, Some(2));
    assert!(ran.stderr.contains("--stream"), "{}", ran.stderr);
}
