//! The unit that was probably meant: where a result is beyond the model by far, and one value of the case in another
//! unit would make it sensible.
//!
//! Each value that has a unit is tried in units that differ by a prefix: loads in smaller ones, moduli and lengths in
//! larger ones. A confusion of upper and lower case, `MN` for `mN`, comes before smaller factors. What is sensible is
//! found by a solution on a coarse grid.

use pellicle_contact::{Domain, Load, Model, SolverOptions, Status, solve_path};
use pellicle_influence::Cache;

use super::Case;
use super::key_dimension;
use super::load::LoadValues;
use crate::input::dimension::Dimension;
use crate::input::quantity;

/// Elements per side of the coarse grid, and most products on it.
const ELEMENTS: usize = 32;
const MAX_PRODUCTS: usize = 150;
/// Ratio of a number to its limit from which a unit is asked for: a thousandfold force sinks a ball a hundredfold, so
/// that a sensible one comes near its limit at least.
const FAR: f64 = 2.0;
/// Most questions.
const MOST: usize = 2;

/// Prefixes of units and their powers of ten.
const PREFIXES: [(&str, i32); 9] = [
    ("p", -12),
    ("n", -9),
    ("u", -6),
    ("µ", -6),
    ("m", -3),
    ("", 0),
    ("k", 3),
    ("M", 6),
    ("G", 9),
];

/// A value of the case and what may be meant by it.
struct Slip<'a> {
    key: String,
    /// The value as it is written.
    text: &'a str,
    /// The other unit.
    unit: String,
    /// The other value, in SI units.
    value: f64,
    dimension: Dimension,
    /// What it replaces; none for the load.
    parameter: Option<pellicle_contact::ModelParameter>,
    /// Powers of ten between them; 0 for a confusion of upper and lower case.
    distance: i32,
}

impl Slip<'_> {
    /// Rank among the slips, from likely to unlikely: confusions, then loads, moduli and lengths, small factors first.
    fn rank(&self) -> (bool, usize, i32) {
        let kind = match (self.parameter, self.dimension) {
            (None, _) => 0,
            (Some(_), Dimension::Pressure) => 1,
            (Some(_), _) => 2,
        };
        (self.distance > 0, kind, self.distance)
    }

    /// The load that this value of a load stands for; a nominal pressure acts on this area (m²).
    fn load(&self, nominal_area: f64) -> Load {
        match self.dimension {
            Dimension::Length => Load::Penetration(self.value),
            Dimension::Pressure => Load::Force(self.value * nominal_area),
            _ => Load::Force(self.value),
        }
    }
}

/// Units that are rarely meant where a smaller one is given.
const RARE: [&str; 3] = ["m", "km", "TPa"];

/// The question whether another unit was meant, as a sentence that follows a colon; none if no single unit explains a
/// result beyond the model.
#[must_use]
pub fn question(case: &Case) -> Option<String> {
    let model = case.model(&Cache::none()).ok()?.value;
    let load = case.loads().into_iter().min_by(|one, other| {
        let [one, other] = [one, other].map(value_of);
        one.total_cmp(&other)
    })?;
    // Where a smaller load is sensible, the units are.
    if !is_far_beyond(case, &model, load) {
        return None;
    }
    let mut slips = slips(case, &model);
    slips.sort_by_key(Slip::rank);
    let mut found: Vec<Slip<'_>> = Vec::new();
    for slip in slips {
        let is_known = found.iter().any(|known| known.key == slip.key);
        if found.len() < MOST && !is_known && explains(case, &model, load, &slip) {
            let is_confusion = slip.distance == 0;
            found.push(slip);
            if is_confusion {
                break;
            }
        }
    }
    let of_slip = |slip: &Slip<'_>| {
        format!(
            "{} is given as {}: was {} meant?",
            slip.key, slip.text, slip.unit
        )
    };
    let questions: Vec<String> = found.iter().map(of_slip).collect();
    (!questions.is_empty()).then(|| questions.join(" Or "))
}

fn value_of(load: &Load) -> f64 {
    match load {
        Load::Force(value) | Load::Penetration(value) => *value,
    }
}

/// The values of the case in other units.
fn slips<'a>(case: &'a Case, model: &Model) -> Vec<Slip<'a>> {
    let of_load = LoadValues::KEYS.iter().flat_map(|key| {
        let path = format!("load.{key}");
        let Some(dimension) = key_dimension::of_path(&path) else {
            return Vec::new();
        };
        other_units(case, &path, dimension, None)
    });
    let parameters = case.parameters(model).unwrap_or_default().into_iter();
    let of_parameters = parameters.flat_map(|of| match of.dimension {
        Some(dimension @ (Dimension::Length | Dimension::Pressure)) => {
            other_units(case, &of.key, dimension, Some(of.parameter))
        }
        _ => Vec::new(),
    });
    of_load.chain(of_parameters).collect()
}

/// A value of the case in units that make the contact less extreme: a load in smaller ones, any other in larger ones.
fn other_units<'a>(
    case: &'a Case,
    key: &str,
    dimension: Dimension,
    parameter: Option<pellicle_contact::ModelParameter>,
) -> Vec<Slip<'a>> {
    let written = case.document.texts(key).into_iter().filter_map(|text| {
        let value = quantity::parse(text, dimension).ok()?;
        Some((text, value))
    });
    let Some((text, value)) = written.min_by(|one, other| one.1.total_cmp(&other.1)) else {
        return Vec::new();
    };
    let Some((given, exponent)) = unit_of(text, dimension) else {
        return Vec::new();
    };
    let base = dimension.si_unit();
    let others = PREFIXES.iter().filter_map(|(prefix, other)| {
        let shift = other - exponent;
        let is_milder = (shift < 0) == parameter.is_none();
        let is_usual = *prefix != "µ"
            && dimension
                .unit_names()
                .contains(&&*format!("{prefix}{base}"));
        let is_rare = parameter.is_some() && RARE.contains(&&*format!("{prefix}{base}"));
        if is_rare || shift == 0 || shift.abs() > 9 || !is_milder || !is_usual {
            return None;
        }
        let is_confusion = *prefix != given && prefix.eq_ignore_ascii_case(given);
        Some(Slip {
            key: key.to_owned(),
            text,
            unit: format!("{prefix}{base}"),
            value: value * 10_f64.powi(shift),
            dimension,
            parameter,
            distance: if is_confusion { 0 } else { shift.abs() },
        })
    });
    others.collect()
}

/// The prefix of the unit of a quantity, and its power of ten; none for other units, such as inches.
fn unit_of(text: &str, dimension: Dimension) -> Option<(&'static str, i32)> {
    let unit = text.trim_end().strip_suffix(dimension.si_unit())?;
    let prefix = unit.trim_start_matches(|c: char| c.is_ascii_digit() || "+-._ eE".contains(c));
    let known = PREFIXES.iter().find(|(known, _)| *known == prefix.trim());
    known.copied()
}

/// Whether the smallest load of a case is far beyond the model, so that a unit may be the reason.
fn is_far_beyond(case: &Case, model: &Model, load: Load) -> bool {
    let step = solved(case, model, load);
    let beyond = step.and_then(|(step, _)| step.beyond());
    beyond.is_some_and(|beyond| beyond.ratio >= FAR)
}

/// Whether the contact is sensible with another unit.
fn explains(case: &Case, model: &Model, load: Load, slip: &Slip<'_>) -> bool {
    let (model, load) = match (slip.parameter, load) {
        (None, _) => (Some(model.clone()), slip.load(case.grid.nominal_area())),
        (Some(parameter), _) => (model.with_parameter(parameter, slip.value).ok(), load),
    };
    let found = model.and_then(|model| solved(case, &model, load));
    found.is_some_and(|(step, codes)| {
        let doubts = ["steep-indenter", "layer-shortening"];
        step.status() == Status::Certified && !codes.iter().any(|code| doubts.contains(code))
    })
}

/// The step of one load on a coarse grid, and the codes of its warnings.
fn solved(
    case: &Case,
    model: &Model,
    load: Load,
) -> Option<(pellicle_contact::Step, Vec<&'static str>)> {
    let domain = case.grid.cell().unwrap_or(Domain::Automatic);
    let options = SolverOptions {
        max_applications: MAX_PRODUCTS,
        coarse_pressures: false,
        ..case.solver_options()
    };
    let elements = case.grid.at_most(ELEMENTS);
    let path = solve_path(model, domain, elements, &[load], &options, &mut ()).ok()?;
    let codes = path.warnings.iter().map(pellicle_contact::Warning::code);
    let codes = codes.collect();
    Some((path.steps.into_iter().next()?, codes))
}
