//! What a run gave: its exit code and every value it printed, one run a line in the file.

use std::collections::BTreeMap;
use std::process::Output;

use serde::{Deserialize, Serialize};
use serde_json::Value;

/// Keys whose values differ from run to run.
const TIMES: [&str; 4] = ["seconds", "timing", "version", "program"];

/// The exit code and the values of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// Exit code; none if a signal ended the run.
    pub exit: Option<i32>,
    /// The printed JSON without times, the cells of a table, or the first line of the error.
    pub values: Value,
}

impl Outcome {
    /// The outcome of a finished run, from the table it wrote, its JSON, or its error message.
    pub fn of(ran: &Output, table: Option<&str>) -> Self {
        let printed = table.map_or_else(
            || serde_json::from_slice(&ran.stdout).ok(),
            |table| Some(cells(table)),
        );
        let mut values = printed.unwrap_or_else(|| {
            let message = String::from_utf8_lossy(&ran.stderr);
            Value::from(message.lines().next().unwrap_or_default())
        });
        drop_times(&mut values);
        Self {
            exit: ran.status.code(),
            values,
        }
    }

    /// Number of values.
    pub fn count(&self) -> usize {
        leaves(&self.values).len()
    }
}

/// The cells of a CSV table, row by row.
fn cells(table: &str) -> Value {
    let rows = table.lines().map(|row| {
        let cells = row.split(',').map(|cell| {
            cell.parse::<f64>()
                .map_or_else(|_| cell.into(), Value::from)
        });
        Value::Array(cells.collect())
    });
    Value::Array(rows.collect())
}

fn drop_times(value: &mut Value) {
    match value {
        Value::Object(map) => {
            map.retain(|key, _| !TIMES.contains(&key.as_str()));
            map.values_mut().for_each(drop_times);
        }
        Value::Array(list) => list.iter_mut().for_each(drop_times),
        _ => {}
    }
}

/// All numbers, words and truth values with their paths, such as `steps.0.penetration`.
pub fn leaves(value: &Value) -> BTreeMap<String, Value> {
    let mut found = BTreeMap::new();
    collect(value, String::new(), &mut found);
    found
}

fn collect(value: &Value, path: String, found: &mut BTreeMap<String, Value>) {
    let below = |key: &str| match path.as_str() {
        "" => key.to_owned(),
        path => format!("{path}.{key}"),
    };
    match value {
        Value::Object(map) => map
            .iter()
            .for_each(|(key, value)| collect(value, below(key), found)),
        Value::Array(list) => list
            .iter()
            .enumerate()
            .for_each(|(index, value)| collect(value, below(&index.to_string()), found)),
        leaf => {
            found.insert(path, leaf.clone());
        }
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
    use super::*;

    #[test]
    fn times_are_dropped_and_every_other_value_has_its_path() {
        let text = br#"{"version": "1", "steps": [{"force": 0.1, "work": {"seconds": 2.0, "products": 7}}]}"#;
        let ran = Output {
            status: std::process::ExitStatus::default(),
            stdout: text.to_vec(),
            stderr: Vec::new(),
        };
        let outcome = Outcome::of(&ran, None);
        let found = leaves(&outcome.values);
        let paths: Vec<&str> = found.keys().map(String::as_str).collect();
        assert_eq!(paths, ["steps.0.force", "steps.0.work.products"]);
        assert_eq!((outcome.exit, outcome.count()), (Some(0), 2));
        let kept = BTreeMap::from([("one".to_owned(), outcome)]);
        assert_eq!(from_text(&to_text(&kept)).unwrap(), kept);
    }

    #[test]
    fn a_table_and_an_error_message_are_kept_too() {
        let ran = Output {
            status: std::process::ExitStatus::default(),
            stdout: Vec::new(),
            stderr: b"no such key\nhelp: another".to_vec(),
        };
        assert_eq!(Outcome::of(&ran, None).values, "no such key");
        let table = Outcome::of(&ran, Some("force,status\n0.5,certified\n"));
        assert_eq!(
            table.values,
            serde_json::json!([["force", "status"], [0.5, "certified"]])
        );
    }
}
