//! What moved between two sets of outcomes, the largest first.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use serde_json::Value;

use super::outcome::Outcome;

/// A value that moved, appeared or went.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    /// Name of the run.
    pub run: String,
    /// Path of the value.
    pub path: String,
    /// Before; none if it is new.
    pub before: Option<Value>,
    /// Now; none if it went.
    pub now: Option<Value>,
}

/// All differences between two sets of outcomes.
#[derive(Debug)]
pub struct Comparison {
    /// The differences: texts, then what went and what is new, then numbers, the largest relative difference first.
    pub differences: Vec<Difference>,
    /// Number of values compared.
    pub count: usize,
}

impl Comparison {
    /// Compares run by run and path by path. Of a run whose input differs, only that is told.
    pub fn of(before: &BTreeMap<String, Outcome>, now: &BTreeMap<String, Outcome>) -> Self {
        let runs: BTreeSet<&String> = before.keys().chain(now.keys()).collect();
        let none = Outcome::new();
        let in_run = |run: &String| {
            let [before, now] = [before, now].map(|all| all.get(run).unwrap_or(&none));
            in_run(run, before, now)
        };
        let mut differences: Vec<Difference> = runs.into_iter().flat_map(in_run).collect();
        let order = |difference: &Difference| difference.relative().unwrap_or(f64::INFINITY);
        differences.sort_by(|a, b| {
            let groups = a.group().cmp(&b.group());
            groups.then(order(b).total_cmp(&order(a)))
        });
        let count = now.values().map(BTreeMap::len).sum();
        Self { differences, count }
    }

    /// Whether every value has the same bits.
    #[must_use]
    pub fn is_same(&self) -> bool {
        self.differences.is_empty()
    }

    /// A line for each of the first `most` differences, and a line for each quantity that moved.
    pub fn report(&self, most: usize) -> String {
        let mut lines: Vec<String> = self
            .differences
            .iter()
            .take(most)
            .map(ToString::to_string)
            .collect();
        if self.differences.len() > most {
            lines.push(format!("… and {} more", self.differences.len() - most));
        }
        lines.extend(self.quantities());
        lines.push(if self.is_same() {
            format!("same bits: {} values", self.count)
        } else {
            format!("{} of {} values moved", self.differences.len(), self.count)
        });
        lines.join("\n")
    }

    /// The numbers that moved, by the name of their quantity, the one that moved most first.
    fn quantities(&self) -> Vec<String> {
        let mut groups: BTreeMap<&str, Vec<&Difference>> = BTreeMap::new();
        for difference in &self.differences {
            if difference.relative().is_some() {
                groups
                    .entry(difference.quantity())
                    .or_default()
                    .push(difference);
            }
        }
        // The differences are in order, so the first of each group is its largest.
        let mut groups: Vec<_> = groups.into_iter().collect();
        let largest = |all: &[&Difference]| all[0].relative().unwrap_or_default();
        groups.sort_by(|(_, a), (_, b)| largest(b).total_cmp(&largest(a)));
        let line = |(quantity, all): (&str, Vec<&Difference>)| {
            let runs: BTreeSet<&String> = all.iter().map(|difference| &difference.run).collect();
            let (count, most) = (all.len(), largest(&all));
            format!(
                "{quantity}: {count} numbers in {} runs, at most {most:.1e} ({})",
                runs.len(),
                all[0].run
            )
        };
        groups.into_iter().map(line).collect()
    }
}

fn in_run(run: &str, before: &Outcome, now: &Outcome) -> Vec<Difference> {
    let difference = |path: &String| {
        let (before, now) = (before.get(path), now.get(path));
        (before != now).then(|| Difference {
            run: run.into(),
            path: path.clone(),
            before: before.cloned(),
            now: now.cloned(),
        })
    };
    let input = "input".to_owned();
    if let Some(other) = difference(&input) {
        return vec![other];
    }
    let paths: BTreeSet<&String> = before.keys().chain(now.keys()).collect();
    paths.into_iter().filter_map(difference).collect()
}

/// Kinds of differences in the order in which they are told.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Group {
    Text,
    Gone,
    New,
    Number,
}

impl Difference {
    fn group(&self) -> Group {
        match (&self.before, &self.now) {
            (Some(_), None) => Group::Gone,
            (None, Some(_)) => Group::New,
            _ if self.relative().is_some() => Group::Number,
            _ => Group::Text,
        }
    }

    /// |now − before| / max(|before|, |now|), for two numbers.
    #[must_use]
    pub fn relative(&self) -> Option<f64> {
        let number = |value: &Option<Value>| value.as_ref().and_then(Value::as_f64);
        let (before, now) = (number(&self.before)?, number(&self.now)?);
        if self.path == "exit" {
            return None;
        }
        Some((now - before).abs() / before.abs().max(now.abs()).max(f64::MIN_POSITIVE))
    }

    /// The last part of the path that is not a place in a list.
    fn quantity(&self) -> &str {
        let is_place = |part: &&str| part.parse::<usize>().is_ok();
        let mut parts = self.path.split('.').rev().skip_while(is_place);
        parts.next().unwrap_or(&self.path)
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}: ", self.run, self.path)?;
        if let (Some(Value::String(before)), Some(Value::String(now))) = (&self.before, &self.now) {
            let (line, before, now) = first_difference(before, now);
            return write!(f, "{before:?} → {now:?} (line {line})");
        }
        let shown = |value: &Option<Value>| match value {
            None => "nothing".to_owned(),
            Some(Value::String(text)) => format!("{:?}", text.lines().next().unwrap_or_default()),
            Some(value) => value.to_string(),
        };
        write!(f, "{} → {}", shown(&self.before), shown(&self.now))?;
        match self.relative() {
            Some(relative) => write!(f, " ({relative:.1e})"),
            None => Ok(()),
        }
    }
}

/// The number and texts of the first line in which two texts differ.
fn first_difference<'a>(before: &'a str, now: &'a str) -> (usize, &'a str, &'a str) {
    let mut lines = (before.lines().chain([""]))
        .zip(now.lines().chain([""]))
        .enumerate();
    let first = lines.find(|(_, (before, now))| before != now);
    first.map_or((1, before, now), |(index, (before, now))| {
        (index + 1, before, now)
    })
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn outcomes(values: &Value) -> BTreeMap<String, Outcome> {
        let values = values.as_object().unwrap().clone();
        BTreeMap::from([("case".to_owned(), values.into_iter().collect())])
    }

    #[test]
    fn moved_new_and_lost_values_are_listed_by_size_and_equal_ones_are_not() {
        let before = outcomes(&json!({
            "exit": 0, "steps.0.force": 1.0, "steps.0.depth": 2.0, "steps.1.depth": 1.0, "area": 3.0,
            "stderr": "a\nb\nc", "gone": true, "steps.0.pressure": 1.0,
        }));
        let now = outcomes(&json!({
            "exit": 1, "steps.0.force": 1.0, "steps.0.depth": 2.5, "steps.1.depth": 1.0_f64.next_up(),
            "area": 3.0, "stderr": "a\nB\nd", "warning": "steep", "steps.0.pressure": 10.0,
        }));
        let compared = Comparison::of(&before, &now);
        let told = compared.report(5);
        let wanted = "case: exit: 0 → 1
case: stderr: \"b\" → \"B\" (line 2)
case: gone: true → nothing
case: warning: nothing → \"steep\"
case: steps.0.pressure: 1.0 → 10.0 (9.0e-1)
… and 2 more
pressure: 1 numbers in 1 runs, at most 9.0e-1 (case)
depth: 2 numbers in 1 runs, at most 2.0e-1 (case)
7 of 8 values moved";
        assert_eq!(told, wanted);
        let last = compared.differences.last().unwrap();
        assert_eq!(last.path, "steps.1.depth", "a single bit is a difference");
        let same = Comparison::of(&now, &now);
        assert!(same.is_same());
        assert_eq!(same.report(5), "same bits: 8 values");
    }

    #[test]
    fn of_a_run_with_another_input_only_that_is_told() {
        let before = outcomes(&json!({"input": "a", "force": 1.0}));
        let now = outcomes(&json!({"input": "b", "force": 2.0}));
        let told = Comparison::of(&before, &now).report(9);
        assert!(told.starts_with("case: input: \"a\" → \"b\""), "{told}");
        assert!(!told.contains("force"), "{told}");
    }

    #[test]
    fn a_lost_run_and_a_new_one_are_listed() {
        let of = outcomes(&json!({"force": 1.0}));
        let none = BTreeMap::new();
        assert_eq!(Comparison::of(&of, &none).differences[0].now, None);
        assert_eq!(Comparison::of(&none, &of).differences[0].before, None);
    }
}
