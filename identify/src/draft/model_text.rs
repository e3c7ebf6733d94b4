//! The text of a drafted fit file: its model, with a start for the modulus by a closed form, and its unknown.

use pellicle::display::Unit;

use super::NOT_IN_THE_FILE;
use super::group::{Group, SOFT_RADIUS};
use super::power_law::PowerLaw;
use super::words::{quantity, quoted, stated};
use crate::measured::channel::Channel;

/// Poisson's ratio of soft matter, and of a hard body.
const POISSON_RATIOS: [f64; 2] = [0.5, 0.25];
/// The radius of a ball or a punch on an instrument that measures the depth, m, if the file states none.
const HARD_RADIUS: f64 = 10e-6;
/// The half-angle of the cone with the area of Berkovich's pyramid, degrees.
const HALF_ANGLE: f64 = 70.3;
/// The modulus is sought within this factor of its start: a radius wrong by a factor of thousand moves it by thirty.
const WITHIN: f64 = 1e3;
/// A modulus where the curve gives none, Pa, of a soft and of a hard body.
const MODULI: [f64; 2] = [1e4, 1e11];

/// An indenter with its dimension.
#[derive(Debug, Clone, Copy)]
enum Indenter {
    Ball(f64),
    Punch(f64),
    Cone,
}

/// The text of a fit file with these tables.
pub(super) fn fit_file(groups: &[Group]) -> String {
    let Some(first) = groups.first() else {
        return String::new();
    };
    let law = law(first);
    let (indenter, why) = indenter(first, law);
    let poisson_ratio = POISSON_RATIOS[usize::from(!first.is_soft)];
    let modulus = modulus(first, law, indenter, poisson_ratio);
    let tables: String = groups.iter().map(Group::text).collect();
    format!(
        "# A modulus from measured curves. Each guess says what it rests on; what no file tells has a default and\n\
         # the words \"not in the file: put yours\".\n\n\
         [model.foundation]\n\
         # The modulus is a start: {start}.\n\
         substrate = {{ young_modulus = {modulus}, poisson_ratio = {poisson_ratio} }}  # Poisson's ratio, {NOT_IN_THE_FILE}\n\n\
         # A coating on it, if there is one: remove the signs and put yours.\n\
         # [[model.foundation.layer]]\n\
         # thickness = \"1 um\"\n\
         # young_modulus = {modulus}\n\
         # poisson_ratio = {poisson_ratio}\n\n\
         [model.indenter]\n\
         {indenter}\
         {elastic}\n\
         {tables}\
         [unknown]\n\
         # A layer's: \"foundation.layer[0].young_modulus\".\n\
         \"foundation.substrate.young_modulus\" = {{ from = {from}, to = {to} }}\n",
        start = if law.is_some() {
            "by the closed form of this indenter on a body without layers"
        } else {
            "a usual one"
        },
        modulus = quoted(&quantity(modulus, Unit::Pascal)),
        from = quoted(&quantity(modulus / WITHIN, Unit::Pascal)),
        to = quoted(&quantity(modulus * WITHIN, Unit::Pascal)),
        indenter = indenter.text(first, why),
        elastic = if first.is_soft {
            ""
        } else {
            "# Rigid; of diamond: young_modulus = \"1141 GPa\" and poisson_ratio = 0.07.\n"
        },
    )
}

/// The power law of the first curve.
fn law(group: &Group) -> Option<PowerLaw> {
    let (depths, forces) = (group.curve.depth()?, group.curve.force()?);
    let zero = group
        .curve
        .before_contact
        .map_or(0.0, |before| before.zero()[0]);
    let forces: Vec<f64> = forces.iter().map(|force| force - zero).collect();
    if group.survey.has(Channel::Stiffness) {
        return PowerLaw::with_exponent(2.0, depths, &forces);
    }
    if group.is_soft || group.survey.stated_radius().is_some() {
        return PowerLaw::with_exponent(1.5, depths, &forces);
    }
    PowerLaw::best(depths, &forces)
}

/// The indenter, and what its shape rests on.
fn indenter(group: &Group, law: Option<PowerLaw>) -> (Indenter, &'static str) {
    if let Some(radius) = group.survey.stated_radius() {
        return (Indenter::Ball(radius.value), "the file states a radius");
    }
    if group.is_soft {
        return (Indenter::Ball(SOFT_RADIUS), NOT_IN_THE_FILE);
    }
    if group.survey.has(Channel::Stiffness) {
        return (Indenter::Cone, NOT_IN_THE_FILE);
    }
    match law.map_or(1.5, |law| law.exponent) {
        1.0 => (
            Indenter::Punch(HARD_RADIUS),
            "the force grows as the depth: a flat punch, or put yours",
        ),
        2.0 => (
            Indenter::Cone,
            "the force grows as the square of the depth: a sharp tip, or put yours",
        ),
        _ => (
            Indenter::Ball(HARD_RADIUS),
            "the force grows as the depth to the 3/2: a ball, or put yours",
        ),
    }
}

impl Indenter {
    fn text(self, group: &Group, why: &str) -> String {
        let radius_why = match group.survey.stated_radius() {
            Some(stated) => format!("line {}: {}", stated.line, stated.text),
            None => NOT_IN_THE_FILE.to_owned(),
        };
        let radius = |radius: f64| quoted(&stated(radius, Unit::Metre));
        match self {
            Self::Ball(r) => format!(
                "kind = \"paraboloid\"  # {why}\nradius = {}  # {radius_why}\n",
                radius(r)
            ),
            Self::Punch(r) => format!(
                "kind = \"flat-punch\"  # {why}\nradius = {}  # {radius_why}\n",
                radius(r)
            ),
            Self::Cone => format!(
                "kind = \"cone\"  # {why}\nhalf_angle = \"{HALF_ANGLE} deg\"  # that of Berkovich's area; {NOT_IN_THE_FILE}\n"
            ),
        }
    }
}

/// A start for the modulus, Pa: `E = E* (1 − ν²)` with `F = 4/3 E* √R D^{3/2}` (Hertz), `F = 2 E* a D` (flat punch) or
/// `F = (2/π) E* tan α D²` (cone; Sneddon 1965).
fn modulus(group: &Group, law: Option<PowerLaw>, indenter: Indenter, poisson_ratio: f64) -> f64 {
    let usual = MODULI[usize::from(!group.is_soft)];
    let reduced = law.map(|law| match indenter {
        Indenter::Ball(radius) => 0.75 * law.coefficient / radius.sqrt(),
        Indenter::Punch(radius) => 0.5 * law.coefficient / radius,
        Indenter::Cone => {
            0.5 * std::f64::consts::PI * law.coefficient / HALF_ANGLE.to_radians().tan()
        }
    });
    let found = reduced.map(|reduced| reduced * (1.0 - poisson_ratio * poisson_ratio));
    found
        .filter(|found| found.is_finite() && *found > 0.0)
        .unwrap_or(usual)
}
