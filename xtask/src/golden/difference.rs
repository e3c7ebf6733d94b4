//! What moved between two sets of outcomes.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use serde_json::Value;

use super::outcome::{Outcome, leaves};

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

/// All differences, by run and path.
pub fn differences(
    before: &BTreeMap<String, Outcome>,
    now: &BTreeMap<String, Outcome>,
) -> Vec<Difference> {
    let mut found = Vec::new();
    let runs: BTreeSet<&String> = before.keys().chain(now.keys()).collect();
    for run in runs {
        let of = |outcomes: &BTreeMap<String, Outcome>| {
            outcomes.get(run).map_or_else(BTreeMap::new, |outcome| {
                let mut values = leaves(&outcome.values);
                values.insert("exit".into(), outcome.exit.into());
                values
            })
        };
        let (before, now) = (of(before), of(now));
        let paths: BTreeSet<&String> = before.keys().chain(now.keys()).collect();
        for path in paths {
            let (before, now) = (before.get(path), now.get(path));
            if before != now {
                found.push(Difference {
                    run: run.clone(),
                    path: path.clone(),
                    before: before.cloned(),
                    now: now.cloned(),
                });
            }
        }
    }
    found
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            run,
            path,
            before,
            now,
        } = self;
        let shown = |value: &Option<Value>| {
            value
                .as_ref()
                .map_or_else(|| "nothing".into(), Value::to_string)
        };
        write!(f, "{run}: {path}: {} → {}", shown(before), shown(now))?;
        let number = |value: &Option<Value>| value.as_ref().and_then(Value::as_f64);
        if let (Some(before), Some(now)) = (number(before), number(now)) {
            let change = (now - before) / before.abs().max(now.abs());
            write!(f, " ({change:+.1e})")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn moved_new_and_lost_values_are_listed_and_equal_ones_are_not() {
        let outcome = |values| Outcome {
            exit: Some(0),
            values,
        };
        let of = |values| BTreeMap::from([("case".to_owned(), outcome(values))]);
        let before = of(json!({"force": 1.0, "depth": 2.0, "area": 3.0}));
        let now = of(json!({"force": 1.0, "depth": 2.5, "warning": "steep"}));
        let found = differences(&before, &now);
        let told: Vec<String> = found.iter().map(Difference::to_string).collect();
        let wanted = [
            "case: area: 3.0 → nothing",
            "case: depth: 2.0 → 2.5 (+2.0e-1)",
            "case: warning: nothing → \"steep\"",
        ];
        assert_eq!(told, wanted);
        assert!(differences(&now, &now).is_empty());
    }
}
