//! What a reader must know of an evaluation.

use pellicle::display::significant;
use pellicle_identify::fit_file::evaluation_file::EvaluatedFile;
use pellicle_identify::indentation::{Drift, EvaluationSettings, IndentationNumber, Uncertain};

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
        let curve = match &file.evaluated {
            Ok(curve) => curve,
            Err(error) => {
                warn("not-evaluated", error.to_string());
                continue;
            }
        };
        if curve.unloading.is_at_bound {
            let message = format!(
                "the exponent of the unloading is held at its bound, {}: within its noise it lies beyond",
                curve.unloading.exponent
            );
            warn("exponent-at-bound", message);
        }
        if let Some(hold) = curve.drift.as_ref().filter(|hold| hold.bends()) {
            let [one, other] = hold.halves.map(|half| significant(half.value * 1e9, 2));
            let message = format!(
                "the depth drifts by {one} nm/s in the first half of the hold and by {other} nm/s in the second: the body \
                 still recovers there, and the rate is not that of the instrument alone"
            );
            warn("drift-not-steady", message);
        }
        let depth = curve.number(IndentationNumber::ContactDepth);
        if let (Some(Uncertain { value, .. }), Some([least, most])) = (depth, settings.area_range)
            && !(least..=most).contains(&value)
        {
            let [value, least, most] = [value, least, most].map(|of| significant(of * 1e9, 4));
            let message = format!(
                "a contact depth of {value} nm lies outside those of the area function's calibration, {least} to {most} nm"
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
    let evaluated = || curves.iter().filter_map(|file| file.evaluated.as_ref().ok());
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
