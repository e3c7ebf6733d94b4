//! The case of a run as keys and values with their units.

use pellicle::case::key_dimension;
use pellicle::display::dimensional;
use pellicle::input::units::Units;
use serde_json::Value;

/// Returns the keys and values of the case, sorted by key.
pub fn rows(case: &Value, units: Units) -> Vec<(String, String)> {
    let mut rows = Vec::new();
    push(&mut rows, "", case, units);
    rows
}

/// Adds a row for every value in a tree of tables and lists of tables.
fn push(rows: &mut Vec<(String, String)>, path: &str, value: &Value, units: Units) {
    let below = |key: &str| match path {
        "" => key.to_owned(),
        path => format!("{path}.{key}"),
    };
    match value {
        Value::Object(entries) => {
            // Sorted by name, since readers do not remember the order of a case file.
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
        value => rows.push((path.to_owned(), text(path, value, units))),
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
            real(path, number.as_f64().unwrap_or(f64::NAN), units)
        }
        other => other.to_string(),
    }
}

/// Formats a number as suits its place.
fn real(path: &str, value: f64, units: Units) -> String {
    match key_dimension::of_path(path) {
        Some(dimension) => dimensional(value, dimension, units),
        None if value != 0.0 && value.abs() < 1e-3 => format!("{value:e}"),
        None => value.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn every_value_has_a_row_and_its_unit() {
        let case = json!({
            "title": "not again",
            "foundation": {"substrate": "rigid", "layer": [{
                "thickness": 1e-8, "poisson_ratio": 0.3, "interface_shear_strength": 7e8, "hardness": 2e10,
                "interface": {"normal_compliance": 2e-18, "shear_compliance": 0.0},
            }]},
            "stress": {"direction": std::f64::consts::FRAC_PI_2, "depths": [0.0, 1e-6]},
            "indenter": {"kind": "<cone>", "half_angle": std::f64::consts::FRAC_PI_3},
            "load": {"forces": [1e-3, 2e-3]},
            "grid": {"elements": 64},
        });
        let rows = rows(&case, Units::Si);
        for row in [
            ("foundation.layer[0].thickness", "10.000 nm"),
            ("foundation.layer[0].poisson_ratio", "0.3"),
            ("foundation.layer[0].interface_shear_strength", "700.00 MPa"),
            ("foundation.layer[0].hardness", "20.000 GPa"),
            (
                "foundation.layer[0].interface.normal_compliance",
                "2.0000 nm/GPa",
            ),
            ("foundation.layer[0].interface.shear_compliance", "0 nm/GPa"),
            ("stress.direction", "90.000°"),
            ("stress.depths", "0 m, 1.0000 µm"),
            ("foundation.substrate", "rigid"),
            ("indenter.half_angle", "60.000°"),
            ("load.forces", "1.0000 mN, 2.0000 mN"),
            ("grid.elements", "64"),
        ] {
            let row = (row.0.to_owned(), row.1.to_owned());
            assert!(rows.contains(&row), "{row:?} in {rows:?}");
        }
        assert!(rows.is_sorted() && rows.iter().all(|(key, _)| key != "title"));
    }
}
