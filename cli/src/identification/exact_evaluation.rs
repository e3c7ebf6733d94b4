//! What the evaluations of unloadings take as exact, and how the stiffnesses of a fit follow it.
//!
//! A fit compares the stiffness `y = S/β` of each contact with that of a punch, `y(a)`, of the radius `a = √(A/π)`. The
//! punch's less the measured one changes by
//!
//! ```text
//! ½ a y′ d ln A           the areas, all by the same part
//! y d ln β
//! −y S dC                 the frame's compliance, 1/S = 1/S_measured − C, and through the contact depth by
//! ½ a y′ d ln A/dh · dh,  dh = −(1 − ε) P dC, and of ε itself dh = −P/S dε
//! ```
//!
//! What the imprint thins the film by is held.

use std::f64::consts::PI;

use pellicle_identify::Prediction;
use pellicle_identify::fit_file::evaluation_file::Evaluated;
use pellicle_identify::indentation::{
    Epsilon, EvaluationSettings, IndentationNumber, IndentationNumbers,
};

use super::Identification;
use super::taken_as_exact::ExactNumber;

/// The areas of all contacts, by one factor.
pub const AREA: &str = "evaluation.area_function";
/// The compliance of the frame, in parts of the least compliance of a contact.
pub const FRAME: &str = "evaluation.frame_compliance";
/// β, by which stiffnesses are divided.
pub const BETA: &str = "evaluation.beta";
/// ε of the contact depth.
const EPSILON: &str = "evaluation.epsilon";
/// Relative step of a depth for differentiating an area, to 1e-8.
const STEP: f64 = 1e-4;

/// A contact in a fit.
struct Contact<'c> {
    numbers: &'c IndentationNumbers,
    /// The table that it is from.
    table: usize,
    /// Whether the instrument gives its radius.
    has_radius: bool,
    /// `S/β`, N/m.
    measured: f64,
    /// `½ a y′`, N/m: the change of the punch's stiffness by `d ln A`.
    by_area: f64,
}

impl Contact<'_> {
    fn value(&self, of: IndentationNumber) -> f64 {
        self.numbers.get(of).unwrap_or_default().value
    }

    fn stiffness(&self) -> f64 {
        self.value(IndentationNumber::ContactStiffness)
    }

    /// `ε P/S`, m.
    fn sink_in(&self) -> f64 {
        self.value(IndentationNumber::MaxDepth) - self.value(IndentationNumber::ContactDepth)
    }

    /// The change of the punch's stiffness by the contact depth, N/m².
    fn by_depth(&self, settings: &EvaluationSettings) -> f64 {
        let Some(function) = settings.area.as_ref().filter(|_| !self.has_radius) else {
            return 0.0;
        };
        let depth = self.value(IndentationNumber::ContactDepth);
        let [above, below] = [1.0 + STEP, 1.0 - STEP].map(|part| function.area(part * depth).ln());
        self.by_area * (above - below) / (2.0 * STEP * depth)
    }
}

impl Identification {
    /// The numbers of `[evaluation]` without an uncertainty, each with `∂y/∂ln f` at all points. In place of a frame's
    /// compliance, which may be zero, stands the least compliance of a contact.
    pub(super) fn exact_evaluations(&self, at_fit: &Prediction) -> Vec<(ExactNumber, Vec<f64>)> {
        let Some(settings) = &self.file.evaluation else {
            return Vec::new();
        };
        let all = self.fitted_contacts(at_fit);
        let number = |key: &str, unit: &str, value: f64| ExactNumber {
            key: key.into(),
            unit: unit.into(),
            value,
            exponents: Vec::new(),
        };
        let each = |change: &dyn Fn(&Contact) -> f64| all.iter().map(change).collect::<Vec<f64>>();
        let mut found = Vec::new();
        if settings.area_covariance.is_empty() && all.iter().any(|of| !of.has_radius) {
            let of_function = |of: &Contact| if of.has_radius { 0.0 } else { of.by_area };
            found.push((number(AREA, "1", 1.0), each(&of_function)));
        }
        for table in 0..self.file.data.len() {
            let of_table = |of: &Contact| of.table == table && of.has_radius;
            let areas = all.iter().filter(|of| of_table(of));
            let areas = areas.map(|of| of.value(IndentationNumber::Area));
            let largest = (areas.fold(0.0, f64::max) / PI).sqrt();
            if largest > 0.0 {
                let key = format!("data[{table}].columns.contact_radius");
                let change = |of: &Contact| f64::from(u8::from(of_table(of))) * 2.0 * of.by_area;
                found.push((number(&key, "m", largest), each(&change)));
            }
        }
        if settings.frame_compliance.sd == 0.0 {
            let stiffest = all.iter().map(Contact::stiffness).fold(0.0, f64::max);
            let change = |of: &Contact| {
                // (1 − ε) P
                let sink = of.value(IndentationNumber::MaxForce) - of.sink_in() * of.stiffness();
                let moved = -of.measured * of.stiffness() - of.by_depth(settings) * sink;
                moved / stiffest
            };
            found.push((number(FRAME, "m/N", 1.0 / stiffest), each(&change)));
        }
        if settings.beta.sd == 0.0 {
            let change = |of: &Contact| of.measured;
            found.push((number(BETA, "1", settings.beta.value), each(&change)));
        }
        let epsilon = match settings.epsilon {
            Epsilon::Fixed(epsilon) => Some(epsilon).filter(|of| of.sd == 0.0),
            Epsilon::Exponent => None,
        };
        if let Some(epsilon) = epsilon {
            let change = |of: &Contact| -of.by_depth(settings) * of.sink_in();
            found.push((number(EPSILON, "1", epsilon.value), each(&change)));
        }
        // Where the instrument gives the radii, no contact depth enters.
        found.retain(|(_, change)| change.iter().any(|change| change.abs() > 0.0));
        found
    }

    /// The contacts in the order of the points.
    fn fitted_contacts(&self, at_fit: &Prediction) -> Vec<Contact<'_>> {
        let of_files = self.evaluated.iter().flat_map(|file| {
            let has_radius = file.measured.contact_radius().is_some();
            let contacts = file.evaluated.iter().flat_map(Evaluated::contacts);
            contacts.map(move |numbers| (numbers, file.table, has_radius))
        });
        let readings = self.sources.iter().flat_map(|source| {
            let pairs = source.abscissa.iter().zip(&source.observed);
            pairs.map(|(radius, measured)| (*radius, *measured))
        });
        let points = readings.zip(&at_fit.slope).zip(of_files);
        let contact = |(((radius, measured), slope), (numbers, table, has_radius))| Contact {
            numbers,
            table,
            has_radius,
            measured,
            by_area: 0.5 * radius * slope,
        };
        points.map(contact).collect()
    }
}
