//! The numbers, words and truth values of JSON, each with its path.

use std::collections::BTreeMap;

use serde_json::Value;

use super::steady::steady;

/// Ends of keys whose values differ from run to run or from build to build.
const UNSTEADY: [&str; 4] = ["seconds", "version", "program", "threads"];
/// Keys whose text names an element of a list, so that its path does not depend on its place.
const NAMES: [&str; 5] = ["code", "check", "name", "key", "body"];

/// All leaves below `path`, such as `stdout.steps.0.penetration` or `stdout.warnings.cut-off.message`.
pub fn leaves(path: &str, value: &Value) -> BTreeMap<String, Value> {
    let mut found = BTreeMap::new();
    collect(path.to_owned(), value, &mut found);
    found
}

fn collect(path: String, value: &Value, found: &mut BTreeMap<String, Value>) {
    match value {
        Value::Object(map) => {
            for (key, value) in map {
                if !UNSTEADY.iter().any(|end| key.ends_with(end)) {
                    collect(format!("{path}.{key}"), value, found);
                }
            }
        }
        Value::Array(list) => {
            for (label, value) in labels(list).iter().zip(list) {
                collect(format!("{path}.{label}"), value, found);
            }
        }
        Value::String(text) => {
            found.insert(path, steady(text).into());
        }
        leaf => {
            found.insert(path, leaf.clone());
        }
    }
}

/// The names of the elements of a list, numbered where they repeat, or else their places.
fn labels(list: &[Value]) -> Vec<String> {
    let name = |element: &Value| {
        NAMES
            .iter()
            .find_map(|key| element[key].as_str().map(str::to_owned))
    };
    let Some(mut names) = list.iter().map(name).collect::<Option<Vec<_>>>() else {
        return (0..list.len()).map(|place| place.to_string()).collect();
    };
    let mut seen: BTreeMap<String, usize> = BTreeMap::new();
    for name in &mut names {
        let count = seen.entry(name.clone()).or_insert(0);
        *count += 1;
        if *count > 1 {
            *name = format!("{name}#{count}");
        }
    }
    names
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn paths(value: &Value) -> Vec<String> {
        leaves("out", value).into_keys().collect()
    }

    #[test]
    fn every_value_but_times_has_its_path() {
        let value = json!({
            "version": "1", "timing": {"solve_seconds": 2.0},
            "steps": [{"force": 0.1, "work": {"seconds": 2.0, "products": 7}}],
        });
        assert_eq!(
            paths(&value),
            ["out.steps.0.force", "out.steps.0.work.products"]
        );
    }

    #[test]
    fn an_element_with_a_name_keeps_its_path_when_others_come_before_it() {
        let warning = |code: &str| json!({"code": code, "step": 0});
        let list = [warning("steep"), warning("cut-off"), warning("steep")];
        let labelled = ["out.cut-off.code", "out.cut-off.step", "out.steep#2.code"];
        let found = paths(&json!(list));
        assert!(
            labelled
                .iter()
                .all(|path| found.contains(&(*path).to_owned())),
            "{found:?}"
        );
        let fewer = paths(&json!(list[1..]));
        assert!(fewer.iter().all(|path| found.contains(path)), "{fewer:?}");
    }
}
