//! The case of a run as a table of keys and values with their units.

use std::fmt::Write as _;

use serde_json::Value;

use crate::case::units::Units;
use crate::display::{Unit, quantity, significant};
use crate::picture::svg::escaped;

/// The rows of the table.
#[must_use]
pub fn rows(case: &Value, units: Units) -> String {
    let mut rows = String::new();
    push(&mut rows, "", case, units);
    rows
}

/// A row for every value in a tree of tables and lists of tables.
fn push(rows: &mut String, path: &str, value: &Value, units: Units) {
    let below = |key: &str| match path {
        "" => key.to_owned(),
        path => format!("{path}.{key}"),
    };
    match value {
        Value::Object(entries) => {
            // By their names, as no reader knows the order of a case file by heart.
            let mut entries: Vec<_> = entries.iter().collect();
            entries.sort_by_key(|(key, _)| *key);
            for (key, value) in entries {
                if !(path.is_empty() && key == "title") {
                    push(rows, &below(key), value, units);
                }
            }
        }
        Value::Array(items) if items.iter().any(Value::is_object) => {
            for (i, item) in items.iter().enumerate() {
                push(rows, &format!("{path}[{i}]"), item, units);
            }
        }
        value => {
            let (path, text) = (escaped(path), escaped(&text(path, value, units)));
            // A String is never full.
            let written = writeln!(rows, "<tr><th>{path}</th><td>{text}</td></tr>");
            debug_assert!(written.is_ok());
        }
    }
}

fn text(path: &str, value: &Value, units: Units) -> String {
    match value {
        Value::Array(items) if items.is_empty() => "none".into(),
        Value::Array(items) => {
            let items = items.iter().map(|item| text(path, item, units));
            items.collect::<Vec<_>>().join(", ")
        }
        Value::String(text) => text.clone(),
        Value::Number(number) if number.is_f64() => {
            let path = path
                .strip_suffix(".from")
                .or(path.strip_suffix(".to"))
                .unwrap_or(path);
            real(key_of(path), number.as_f64().unwrap_or(f64::NAN), units)
        }
        other => other.to_string(),
    }
}

/// A number as its key wants it.
fn real(key: &str, value: f64, units: Units) -> String {
    let unit = match key {
        "young_modulus" => Some(Unit::Pascal),
        "force" | "forces" => Some(Unit::Newton),
        "thickness" | "radius" | "height" | "period" | "offset" | "tip_radius" | "side"
        | "sides" | "height_unit" | "penetration" | "penetrations" => Some(Unit::Metre),
        _ => None,
    };
    match unit {
        Some(unit) => quantity(value, unit, units),
        None if key.ends_with("_angle") => format!("{}°", significant(value.to_degrees(), 5)),
        None if value != 0.0 && value.abs() < 1e-3 => format!("{value:e}"),
        None => value.to_string(),
    }
}

/// The last key of a path.
fn key_of(path: &str) -> &str {
    path.rsplit('.').next().unwrap_or(path)
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn every_value_has_a_row_and_its_unit() {
        let case = json!({
            "title": "not again",
            "foundation": {"substrate": "rigid", "layer": [{"thickness": 1e-8, "poisson_ratio": 0.3}]},
            "indenter": {"kind": "<cone>", "half_angle": std::f64::consts::FRAC_PI_3},
            "load": {"forces": [1e-3, 2e-3]},
            "grid": {"elements": 64},
        });
        let rows = rows(&case, Units::Si);
        for row in [
            "<tr><th>foundation.layer[0].thickness</th><td>10.000 nm</td></tr>",
            "<tr><th>foundation.layer[0].poisson_ratio</th><td>0.3</td></tr>",
            "<tr><th>indenter.kind</th><td>&lt;cone&gt;</td></tr>",
            "<tr><th>indenter.half_angle</th><td>60.000°</td></tr>",
            "<tr><th>load.forces</th><td>1.0000 mN, 2.0000 mN</td></tr>",
            "<tr><th>grid.elements</th><td>64</td></tr>",
        ] {
            assert!(rows.contains(row), "{row} in {rows}");
        }
        assert!(!rows.contains("not again"));
    }
}
