//! What a reader must know of an evaluation.

use pellicle::display::{count, significant};
use pellicle_identify::fit_file::evaluation_file::{Evaluated, EvaluatedFile};
use pellicle_identify::indentation::{
    DepthZero, Drift, EvaluatedCurve, EvaluationSettings, IndentationNumber, IndentationNumbers,
    Uncertain,
};

use crate::identification::findings::WarningResult;

/// Contact depths within this factor of those of a calibration are inside. Its own contacts are there again with other
/// last digits: a calibration takes the frame out of their stiffnesses, an evaluation out of the whole unloading.
const BEYOND: f64 = 1.01;

/// The warnings of all curves.
#[must_use]
pub fn all(curves: &[EvaluatedFile], settings: &EvaluationSettings) -> Vec<WarningResult> {
    let mut found = Vec::new();
    for file in curves {
        let name = file.measured.file.display();
        let mut warn = |code: &'static str, message: String| {
            found.push(WarningResult {
                code: code.into(),
                message: format!("{name}: {message}"),
            });
        };
        for warning in &file.measured.warnings {
            warn(warning.code, warning.message.clone());
        }
        let evaluated = match &file.evaluated {
            Ok(evaluated) => evaluated,
            Err(error) => {
                warn("not-evaluated", error.to_string());
                continue;
            }
        };
        let curve = evaluated.unloading();
        if let Some(curve) = curve.filter(|curve| curve.unloading.is_at_bound) {
            let message = format!(
                "the exponent of the unloading is at its bound, {}, wanted one above 1 and below 2: is `unloading` the right \
                 part, and does the depth still creep?",
                significant(curve.unloading.exponent, 4)
            );
            warn("exponent-at-bound", message);
        }
        let begun = curve.map_or(0.0, begun);
        if begun > BEGUN {
            let message = format!(
                "the file begins at {} % of its largest force, without the loading: a larger force before it is not known, \
                 nor are works, and the depth and hardness at the largest force would be others",
                significant(100.0 * begun, 2)
            );
            warn("unloading-alone", message);
        }
        let hold = curve.and_then(|curve| curve.drift.as_ref());
        if let Some(hold) = hold.filter(|hold| hold.bends()) {
            let [one, other] = hold.halves.map(|half| significant(half.value * 1e9, 2));
            let message = format!(
                "the depth drifts by {one} nm/s in the first half of the hold and by {other} nm/s in the second: the body \
                 still recovers there, and the rate is not that of the instrument alone"
            );
            warn("drift-not-steady", message);
        }
        let is_confirmed = settings.depth_zero == DepthZero::AsRecorded;
        let off = curve.filter(|_| !is_confirmed).and_then(zero_off);
        if let Some(message) = off {
            warn("depth-zero", message);
        }
        let depths = evaluated.contacts().iter();
        let depths = depths.filter_map(|of| of.get(IndentationNumber::ContactDepth));
        let [least, most] = settings.area_range.unwrap_or([0.0, f64::INFINITY]);
        let outside: Vec<f64> = depths
            .map(|of| of.value)
            .filter(|depth| *depth < least / BEYOND || *depth > most * BEYOND)
            .collect();
        if let Some(first) = outside.first() {
            let [first, least, most] = [*first, least, most].map(|of| significant(of * 1e9, 4));
            let message = format!(
                "{} outside those of the area function's calibration, {least} to {most} nm, such as {first} nm",
                count(outside.len(), "contact depth")
            );
            warn("area-not-calibrated", message);
        }
    }
    found.extend(without_drift(curves, settings));
    found.extend(pile_up(curves));
    found
}

/// A curve of which no smaller part of the largest force comes before it has no loading.
const BEGUN: f64 = 0.5;

/// The least force of the loading over the largest.
fn begun(curve: &EvaluatedCurve) -> f64 {
    let loading = &curve.force[..=curve.phases.top.start];
    let least = loading.iter().copied().fold(f64::INFINITY, f64::min);
    least / curve.unloading.force
}

/// A loading begins elsewhere than at zero if it does so by more than this part of the contact depth, which changes a
/// modulus by as much, and by so many standard uncertainties.
const ZERO_PART: f64 = 0.03;
const ZERO_DEVIATIONS: f64 = 4.0;

/// That the loading does not begin at the zero of the depth.
fn zero_off(curve: &EvaluatedCurve) -> Option<String> {
    let Uncertain { value, sd } = curve.begins?;
    let depth = curve.numbers.get(IndentationNumber::ContactDepth)?.value;
    let least = (ZERO_PART * depth).max(ZERO_DEVIATIONS * sd);
    let [value, sd] = [value, sd].map(|of| significant(of * 1e9, 2));
    (curve.begins?.value.abs() > least).then(|| {
        format!(
            "the loading, extrapolated, begins at {value} ± {sd} nm, not at zero: is the zero of the depth right? \
             `depth_zero = \"first contact\"` takes this out, \"as recorded\" confirms the file's"
        )
    })
}

/// Above this final depth over the largest, a body that does not harden piles up around its imprint: A. Bolshakov and
/// G. M. Pharr, J. Mater. Res. 13, 1049 (1998).
const PILES_UP: f64 = 0.7;

/// That the area may be larger than the area function says.
fn pile_up(curves: &[EvaluatedFile]) -> Option<WarningResult> {
    let contacts = curves
        .iter()
        .filter_map(|file| file.evaluated.as_ref().ok());
    let contacts: Vec<_> = contacts.flat_map(Evaluated::contacts).collect();
    let left = |of: &IndentationNumbers| {
        let value = |number| of.get(number).map(|of| of.value);
        let deepest = value(IndentationNumber::MaxDepth)?;
        let last = value(IndentationNumber::FinalDepth).or_else(|| {
            // Of a paraboloid's unloading, h_f = h_max − 3/2 P/S.
            let force = value(IndentationNumber::MaxForce)?;
            Some(deepest - 1.5 * force / value(IndentationNumber::ContactStiffness)?)
        });
        Some(last? / deepest)
    };
    let ratios: Vec<f64> = contacts.iter().filter_map(|of| left(of)).collect();
    let above: Vec<f64> = ratios.iter().copied().filter(|of| *of > PILES_UP).collect();
    let most = above.iter().copied().fold(0.0, f64::max);
    (!above.is_empty()).then(|| WarningResult {
        code: "pile-up".into(),
        message: format!(
            "{} of {} keep up to {} % of their depth: a material that hardens little piles up around such imprints, and the \
             true area is then larger than that of the area function, by up to 60 %; moduli fall by half of that, and \
             hardnesses by all of it",
            above.len(),
            count(ratios.len(), "imprint"),
            significant(100.0 * most, 2)
        ),
    })
}

/// That no hold tells the drift, and none is taken out.
fn without_drift(curves: &[EvaluatedFile], settings: &EvaluationSettings) -> Option<WarningResult> {
    if settings.drift != Drift::OfHoldIfFound {
        return None;
    }
    let evaluated = || {
        let found = curves
            .iter()
            .filter_map(|file| file.evaluated.as_ref().ok());
        found.filter_map(Evaluated::unloading)
    };
    // The drift of a cycle is that of its whole curve.
    let rate = |curve: &EvaluatedCurve| curve.numbers.get(IndentationNumber::DriftRate);
    let is_none = |curve: &&EvaluatedCurve| rate(curve).is_none_or(|rate| rate.value == 0.0);
    let without = evaluated().filter(is_none).count();
    (without > 0).then(|| WarningResult {
        code: "drift-not-known".into(),
        message: format!(
            "{without} of {} curves have no times or no hold at a small force, which would tell the drift of their depth: \
             it is taken as zero (`drift = \"off\"` confirms this, a rate such as \"0.02 nm/s\" is taken out)",
            evaluated().count()
        ),
    })
}
