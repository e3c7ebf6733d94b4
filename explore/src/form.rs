//! The fields of the page: the declarations of a case as JSON.

use pellicle::declare::{Field, KindsShape, Presence, Shape, TableShape};
use pellicle::input::dimension::{Dimension, Sign};
use serde_json::{Value, json};

/// The fields of a table, with how they belong together.
#[must_use]
pub fn table(of: &TableShape) -> Value {
    json!({
        "is": "table",
        "fields": of.fields.iter().map(field).collect::<Vec<_>>(),
        "one_of": of.one_of,
        "together": of.together,
    })
}

fn field(of: &Field) -> Value {
    let mut field = shape(&of.shape);
    field["key"] = of.key.into();
    field["meaning"] = of.meaning.into();
    field["missing"] = match &of.presence {
        Presence::Required => Value::Null,
        Presence::Default(words) => words.as_str().into(),
    };
    field
}

fn shape(of: &Shape) -> Value {
    match of {
        Shape::Quantity(dimension, sign) => quantity(*dimension, *sign),
        Shape::Number => json!({ "is": "number" }),
        Shape::Range(range) => json!({ "is": "number", "from": range.start(), "to": range.end() }),
        Shape::Count(range) => json!({ "is": "count", "from": range.start(), "to": range.end() }),
        Shape::Words(words) => json!({ "is": "words", "words": words }),
        Shape::Switch => json!({ "is": "switch" }),
        Shape::Text => json!({ "is": "text" }),
        Shape::List(item, count) => json!({ "is": "list", "item": shape(item), "count": count }),
        Shape::Table(fields) => table(fields),
        Shape::Kinds(of) => kinds(of),
        Shape::Either(shapes) => {
            json!({ "is": "either", "of": shapes.iter().map(shape).collect::<Vec<_>>() })
        }
    }
}

fn quantity(dimension: Dimension, sign: Sign) -> Value {
    let sign = match sign {
        Sign::Any => "any",
        Sign::NotNegative => "not-negative",
        Sign::Positive => "positive",
    };
    let units = dimension.unit_names().iter();
    let units: Vec<_> = units.filter(|unit| !unit.contains(' ')).collect();
    json!({
        "is": "quantity", "sign": sign, "units": units,
        "example": dimension.example().trim_matches('"'), "angle": dimension == Dimension::Angle,
    })
}

fn kinds(of: &KindsShape) -> Value {
    let kind = |(word, meaning, fields): &(&'static str, &'static str, TableShape)| {
        let mut kind = table(fields);
        kind["word"] = (*word).into();
        kind["meaning"] = (*meaning).into();
        kind
    };
    json!({
        "is": "kinds", "choice": of.key, "default": of.default,
        "kinds": of.kinds.iter().map(kind).collect::<Vec<_>>(),
        "shared": table(&of.shared),
    })
}
