//! The numbers of a run as JSON, from their declarations: each with its unit, its grid error and its words.

use pellicle::display::{Unit, error_of, position, quantity, significant};
use pellicle::input::units::Units;
use pellicle::result::extremes::{Limit, OF_BODIES, OF_INTERFACES};
use pellicle::result::quantities::QUANTITIES;
use pellicle::result::quantity::{self, Measure, Part, Quantity};
use pellicle::summary::{RunSummary, StepSummary, StressSummary};
use pellicle_contact::Extreme;
use serde_json::{Value, json};

/// A loading step: its numbers and stresses, and the words that mark it if it is not certified.
#[must_use]
pub fn step(run: &RunSummary, step: &StepSummary) -> Value {
    let told = QUANTITIES.iter().filter(|of| of.part != Part::Solution);
    let numbers: Vec<_> = told.filter_map(|of| number(run, step, of)).collect();
    let stresses = (step.stress.as_ref()).map(|stress| stresses(run, stress));
    json!({ "numbers": numbers, "stresses": stresses, "mark": step.mark() })
}

fn number(run: &RunSummary, step: &StepSummary, of: &Quantity) -> Option<Value> {
    let value = match (of.value)(step)? {
        quantity::Value::Number(value) => json!(value),
        quantity::Value::Count(count) => json!(count),
        quantity::Value::Truth(truth) => json!(truth),
        quantity::Value::Place(at) => json!(at),
    };
    let error = of.error_in(step);
    let note = match (error, of.measure, value.as_f64()) {
        // A prescribed number.
        (Some(error), ..) if error.estimate == 0.0 => String::new(),
        (Some(error), ..) if !error.resolved => "not resolved by the grid".into(),
        (Some(error), Measure::Of(unit), Some(value)) => {
            error_of(value, error.estimate, unit, run.units)
        }
        (None, ..) if of.error.is_some() => "one grid only".into(),
        _ => String::new(),
    };
    Some(json!({
        "key": of.key, "name": of.name, "symbol": of.symbol, "meaning": of.meaning,
        "unit": of.measure.si_unit().map(|unit| run.units.name(unit)),
        "value": value, "text": of.words(step, run)?,
        "error": error.map(|error| error.estimate), "resolved": error.map(|error| error.resolved),
        "note": note,
    }))
}

/// The extremes in bodies and on interfaces.
fn stresses(run: &RunSummary, stress: &StressSummary) -> Vec<Value> {
    let row = Row {
        units: run.units,
        element_side: run.grid.element_side,
    };
    let mut rows = Vec::new();
    for body in &stress.extremes.bodies {
        for of in OF_BODIES {
            let extreme = (of.value)(body);
            let used = used(of.limit, &body.utilisation);
            rows.extend(extreme.map(|extreme| row.of(&body.name, of.name, &extreme, &used)));
        }
    }
    for interface in &stress.extremes.interfaces {
        for of in OF_INTERFACES {
            let extreme = (of.value)(interface);
            let used = used(of.limit, &interface.utilisation);
            rows.extend(extreme.map(|extreme| row.of(&interface.name, of.name, &extreme, &used)));
        }
    }
    rows
}

/// What the rows of a run share.
struct Row {
    units: Units,
    element_side: f64,
}

impl Row {
    fn of<const AXES: usize>(
        &self,
        place: &str,
        name: &str,
        extreme: &Extreme<AXES>,
        used: &str,
    ) -> Value {
        let value = extreme.value;
        let note = match extreme.estimate {
            _ if value == 0.0 => String::new(),
            _ if !extreme.resolved => "not resolved by the grid".into(),
            Some(error) => error_of(value, error, Unit::Pascal, self.units),
            None => "one grid only".into(),
        };
        json!({
            "key": format!("{place} {name}"), "place": place, "name": name,
            "unit": self.units.name(Unit::Pascal.ascii()),
            "value": value, "text": quantity(value, Unit::Pascal, self.units),
            "error": extreme.estimate, "resolved": extreme.resolved, "note": note,
            "at": position(extreme.at, self.element_side, self.units), "used": used,
        })
    }
}

/// `0.34 of the yield strength`; nothing if no strength limits it, or none is given.
fn used<U>(limit: Option<Limit<U>>, utilisation: &U) -> String {
    let words = limit.and_then(|limit| {
        let ratio = significant((limit.used)(utilisation)?, 3);
        Some(format!("{ratio} of the {} strength", limit.strength))
    });
    words.unwrap_or_default()
}
