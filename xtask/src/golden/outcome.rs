//! The values of a run by their paths, and the file that keeps those of all runs.

use std::collections::BTreeMap;
use std::process::Output;

use serde_json::Value;

use super::leaves::leaves;
use super::steady::steady;

/// Values by their paths: `exit`, `stdout…`, `stderr`, and those of the files written.
pub type Outcome = BTreeMap<String, Value>;

/// The exit code and what a run printed: JSON value by value, lines of JSON likewise, other text whole.
pub fn of(ran: &Output) -> Outcome {
    let stdout = String::from_utf8_lossy(&ran.stdout);
    let mut outcome = printed(&stdout);
    // A run that a signal ended has no exit code.
    outcome.insert("exit".into(), ran.status.code().into());
    if !ran.stderr.is_empty() {
        let stderr = String::from_utf8_lossy(&ran.stderr);
        outcome.insert("stderr".into(), steady(&stderr).into());
    }
    outcome
}

fn printed(stdout: &str) -> Outcome {
    if stdout.is_empty() {
        return Outcome::new();
    }
    if let Ok(value) = serde_json::from_str(stdout) {
        return leaves("stdout", &value);
    }
    let lines: Result<Vec<Value>, _> = stdout.lines().map(serde_json::from_str).collect();
    match lines {
        Ok(lines) => leaves("stdout", &Value::Array(lines)),
        Err(_) => Outcome::from([("stdout".into(), steady(stdout).into())]),
    }
}

/// One run a line, so that versions of the file can be compared line by line.
pub fn to_text(outcomes: &BTreeMap<String, Outcome>) -> String {
    let lines = outcomes
        .iter()
        .map(|outcome| serde_json::json!(outcome).to_string() + "\n");
    lines.collect()
}

/// Reads what [`to_text`] wrote.
pub fn from_text(text: &str) -> Result<BTreeMap<String, Outcome>, serde_json::Error> {
    text.lines().map(serde_json::from_str).collect()
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn output(stdout: &str, stderr: &str) -> Output {
        Output {
            status: std::process::ExitStatus::default(),
            stdout: stdout.into(),
            stderr: stderr.into(),
        }
    }

    #[test]
    fn json_lines_of_json_and_text_are_kept_with_the_exit_code() {
        for (stdout, wanted) in [
            ("{\"force\": 0.1}", json!({"exit": 0, "stdout.force": 0.1})),
            (
                "{\"a\": 1}\n{\"a\": 2}\n",
                json!({"exit": 0, "stdout.0.a": 1, "stdout.1.a": 2}),
            ),
            (
                "force 1 N in 2 s\n",
                json!({"exit": 0, "stdout": "force 1 N in … s\n"}),
            ),
            ("", json!({"exit": 0})),
        ] {
            assert_eq!(json!(of(&output(stdout, ""))), wanted);
        }
        let refused = of(&output("", "no such key\nhelp: another"));
        assert_eq!(refused["stderr"], "no such key\nhelp: another");
    }

    #[test]
    fn the_file_keeps_every_bit_of_a_number() {
        let numbers = [0.1 + 0.2, f64::MIN_POSITIVE, 1.0 / 3.0, 5e-324, 1.797e308];
        let values = numbers.iter().enumerate();
        let values = values.map(|(i, number)| (i.to_string(), json!(number)));
        let kept = BTreeMap::from([("run".to_owned(), values.collect())]);
        assert_eq!(from_text(&to_text(&kept)).unwrap(), kept);
    }
}
