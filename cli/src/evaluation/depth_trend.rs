//! A modulus that changes with the depth, on a body that is evaluated as homogeneous.
//!
//! ```text
//! E ∝ S/√A,        S²/P ∝ E²/H
//! ```
//!
//! No area enters `S²/P`: where it stays while the modulus changes, the area function is wrong, else the stiffness or
//! the body (D. L. Joslin and W. C. Oliver, J. Mater. Res. 5, 123 (1990)).

use pellicle::display::significant;
use pellicle_identify::fit_file::evaluation_file::{Evaluated, EvaluatedFile};
use pellicle_identify::indentation::{IndentationNumber, IndentationNumbers};

use crate::identification::findings::WarningResult;

/// Fewest contacts, and the least ratio of their depths, that tell a trend from scatter.
const FEWEST: usize = 3;
const LEAST_RANGE: f64 = 1.5;
/// A modulus that changes by less is as good as those of most laboratories.
const LEAST_CHANGE: f64 = 0.1;
/// Standard deviations of a slope that is no chance.
const DEVIATIONS: f64 = 4.0;

/// A contact: logarithms of its depth, its modulus, and its `S²/P`.
struct Contact {
    depth: f64,
    modulus: f64,
    without_area: f64,
}

fn contact(of: &IndentationNumbers) -> Option<Contact> {
    let ln = |number| Some(of.get(number)?.value.ln());
    let (force, stiffness) = (
        ln(IndentationNumber::MaxForce)?,
        ln(IndentationNumber::ContactStiffness)?,
    );
    let found = Contact {
        depth: ln(IndentationNumber::ContactDepth)?,
        modulus: ln(IndentationNumber::IndentationModulus)?,
        without_area: 2.0 * stiffness - force,
    };
    let is_finite = found.depth.is_finite() && found.modulus.is_finite();
    (is_finite && found.without_area.is_finite()).then_some(found)
}

/// The slope of a number over the depth, both in logarithms, and its standard deviation from the scatter.
fn slope(contacts: &[Contact], of: impl Fn(&Contact) -> f64) -> [f64; 2] {
    let count = contacts.len() as f64;
    let mean = |of: &dyn Fn(&Contact) -> f64| contacts.iter().map(of).sum::<f64>() / count;
    let [middle, level] = [mean(&|contact| contact.depth), mean(&of)];
    let sum = |of: &dyn Fn(&Contact) -> f64| contacts.iter().map(of).sum::<f64>();
    let spread = sum(&|contact| (contact.depth - middle).powi(2));
    let slope = sum(&|contact| (contact.depth - middle) * (of(contact) - level)) / spread;
    let rest = |contact: &Contact| of(contact) - level - slope * (contact.depth - middle);
    let scatter = sum(&|contact| rest(contact).powi(2)) / (count - 2.0);
    [slope, (scatter / spread).sqrt()]
}

/// The warning, if the modulus changes with the depth.
#[must_use]
pub fn warning(curves: &[EvaluatedFile]) -> Option<WarningResult> {
    let evaluated = curves
        .iter()
        .filter_map(|file| file.evaluated.as_ref().ok());
    let numbers = evaluated.flat_map(Evaluated::contacts);
    let mut contacts: Vec<Contact> = numbers.filter_map(contact).collect();
    contacts.sort_by(|one, other| one.depth.total_cmp(&other.depth));
    let (first, last) = (contacts.first()?, contacts.last()?);
    let range = last.depth - first.depth;
    if contacts.len() < FEWEST || range < LEAST_RANGE.ln() {
        return None;
    }
    let [modulus, sd] = slope(&contacts, |contact| contact.modulus);
    let [without_area, _] = slope(&contacts, |contact| contact.without_area);
    let change = (modulus * range).exp_m1();
    if change.abs() < LEAST_CHANGE || modulus.abs() < DEVIATIONS * sd {
        return None;
    }
    let percent = |change: f64| format!("{:+.0} %", 100.0 * change);
    let [from, to] = [first, last].map(|of| significant(of.depth.exp() * 1e9, 3));
    // A wrong area leaves S²/P; other causes change it by twice the logarithm.
    let cause = if without_area.abs() < modulus.abs() {
        "on a homogeneous body this is the area function's: `[evaluation.calibrate]` finds it on a known body"
    } else {
        "on a homogeneous body this is the frame's compliance or the zero of the depth; a film on a base does so by \
         itself, `[model.foundation]` then gives the film's own modulus"
    };
    Some(WarningResult {
        code: "modulus-over-depth".into(),
        message: format!(
            "the modulus changes by {} from a contact depth of {from} to {to} nm, and S²/P, in which there is no area, by \
             {}: {cause}",
            percent(change),
            percent((without_area * range).exp_m1()),
        ),
    })
}
