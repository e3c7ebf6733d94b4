//! What a reader must know of an evaluation.

use pellicle::display::{count, significant};
use pellicle_identify::fit_file::evaluation_file::{Evaluated, EvaluatedFile};
use pellicle_identify::indentation::{Drift, EvaluationSettings, IndentationNumber};

use crate::identification::findings::WarningResult;

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
                "the exponent of the unloading is held at its bound, {}: within its noise it lies beyond",
                curve.unloading.exponent
            );
            warn("exponent-at-bound", message);
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
        let depths = evaluated.contacts().iter();
        let depths = depths.filter_map(|of| of.get(IndentationNumber::ContactDepth));
        let [least, most] = settings.area_range.unwrap_or([0.0, f64::INFINITY]);
        let outside: Vec<f64> = depths
            .map(|of| of.value)
            .filter(|depth| !(least..=most).contains(depth))
            .collect();
        if let Some(first) = outside.first() {
            let [first, least, most] = [*first, least, most].map(|of| significant(of * 1e9, 4));
            let message = format!(
                "{}, such as {first} nm, lie outside those of the area function's calibration, {least} to {most} nm",
                count(outside.len(), "contact depth")
            );
            warn("area-not-calibrated", message);
        }
    }
    found.extend(without_drift(curves, settings));
    found
}

/// That no hold tells the drift, and none is taken out.
fn without_drift(
    curves: &[EvaluatedFile],
    settings: &EvaluationSettings,
) -> Option<WarningResult> {
    if settings.drift != Drift::OfHoldIfFound {
        return None;
    }
    let evaluated = || {
        let found = curves.iter().filter_map(|file| file.evaluated.as_ref().ok());
        found.filter_map(Evaluated::unloading)
    };
    let without = evaluated().filter(|curve| curve.drift.is_none()).count();
    (without > 0).then(|| WarningResult {
        code: "drift-not-known".into(),
        message: format!(
            "{without} of {} curves have no times or no hold at a small force, which would tell the drift of their depth: \
             it is taken as zero (`drift = \"off\"` confirms this, a rate such as \"0.02 nm/s\" is taken out)",
            evaluated().count()
        ),
    })
}
