//! The JSON schema of `summary.json`: its numbers from their declarations, the case from that of a case file, the rest
//! as in `schema.json`.

use serde_json::{Map, Value, json};

use crate::declare::schema;
use crate::result::extremes::{OF_BODIES, OF_INTERFACES};
use crate::result::quantities::QUANTITIES;
use crate::result::quantity::{Measure, Part, Quantity};

/// All but what is declared elsewhere.
const REST: &str = include_str!("schema.json");

/// The schema.
#[must_use]
pub fn of_summary() -> Value {
    // A test reads the text, so it is never null.
    let mut schema: Value = serde_json::from_str(REST).unwrap_or_default();
    let mut case = schema::of_case();
    if let (Some(into), Some(from)) = (
        schema["properties"]["case"].as_object_mut(),
        case.as_object_mut(),
    ) {
        from.remove("$schema");
        from.remove("title");
        into.append(from);
    }
    for quantity in QUANTITIES {
        add(&mut schema["$defs"]["step"], quantity);
    }
    let stress = &mut schema["$defs"]["step"]["properties"]["stress"]["properties"];
    for of in OF_BODIES {
        let extreme = extreme(of.meaning, "#/$defs/extreme_at_3");
        stress["bodies"]["items"]["properties"][of.quantity.name()] = extreme;
    }
    for of in OF_INTERFACES {
        let extreme = extreme(of.meaning, "#/$defs/extreme_at_2");
        stress["interfaces"]["items"]["properties"][of.quantity.name()] = extreme;
    }
    schema
}

fn extreme(meaning: &str, is: &str) -> Value {
    json!({ "description": meaning, "$ref": is })
}

/// Adds a number to the schema of a step, at its place.
fn add(step: &mut Value, quantity: &Quantity) {
    let (tables, key) = quantity.key.rsplit_once('.').unwrap_or(("", quantity.key));
    let mut table = step;
    for name in tables.split_terminator('.') {
        table = &mut table["properties"][name];
    }
    let unit = match quantity.measure {
        Measure::Of(unit) => format!(", {}", unit.symbol()),
        Measure::Place => ", m".into(),
        Measure::Ratio | Measure::Count | Measure::Truth => String::new(),
    };
    let mut property = shape(quantity.measure);
    let when = match quantity.part {
        part if part.words() == "always" => String::new(),
        part => format!("; {}", part.words()),
    };
    property["description"] = format!("{}{unit}{when}", quantity.meaning).into();
    if !table["properties"].is_object() {
        table["properties"] = Value::Object(Map::new());
    }
    table["properties"][key] = property;
    // What not every result has is left out there; a table of rough contact or wear is left out as a whole.
    let is_required =
        quantity.part.is_everywhere() || matches!(quantity.part, Part::Rough | Part::Wear);
    if let Some(required) = table["required"].as_array_mut().filter(|_| is_required) {
        required.push(key.into());
    }
}

fn shape(measure: Measure) -> Value {
    let number = json!({ "type": ["number", "null"] });
    match measure {
        Measure::Of(_) | Measure::Ratio => number,
        Measure::Count => json!({ "type": "integer", "minimum": 0 }),
        Measure::Truth => json!({ "type": "boolean" }),
        Measure::Place => json!({
            "type": "array", "items": number, "minItems": 2, "maxItems": 2,
        }),
    }
}
