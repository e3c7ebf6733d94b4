//! `pellicle identify` of unloadings at several depths: a modulus that changes with them.

use std::f64::consts::PI;
use std::fmt::Write as _;

use super::identify_unloadings::run;

/// The warning about the trend of the modulus in the evaluation, with the area `24.5 h²`, of contacts on a homogeneous
/// body of 72 GPa and 9.5 GPa by a tip of area `24.5 h² + blunt h`, with a compliance of the frame (m/N).
fn trend(blunt: f64, frame: f64) -> Option<String> {
    let (reduced, hardness) = (69.6e9, 9.5e9);
    let mut rows = "depth [nm],load [mN],stiffness [kN/m]\n".to_owned();
    for contact_depth in [150e-9, 220e-9, 330e-9, 480e-9, 700e-9, 1e-6_f64] {
        let area = 24.5 * contact_depth.powi(2) + blunt * contact_depth;
        let (force, stiffness) = (hardness * area, 2.0 * reduced * (area / PI).sqrt());
        let depth = contact_depth + 0.75 * force / stiffness + frame * force;
        let seen = 1.0 / (1.0 / stiffness + frame);
        writeln!(rows, "{},{},{}", depth * 1e9, force * 1e3, seen * 1e-3).unwrap();
    }
    let fit = "[evaluation]\narea_function = [24.5]\npoisson_ratio = 0.17\n\
               indenter = { young_modulus = \"1141 GPa\", poisson_ratio = 0.07 }\n\
               [[data]]\nfile = \"depths.csv\"\ncolumns = { depth = 1, force = 2, stiffness = 3 }\n\
               observe = \"unloading\"\n";
    let (_, ran) = run(fit, &[("depths.csv", &rows)]);
    let found = ran.printed();
    let warnings = found["warnings"].as_array().unwrap().iter();
    let mut warnings = warnings.filter(|warning| warning["code"] == "modulus-over-depth");
    Some(warnings.next()?["message"].as_str().unwrap().to_owned())
}

#[test]
fn a_modulus_that_changes_with_the_depth_is_told_of_with_its_likely_cause() {
    assert_eq!(trend(0.0, 0.0), None);
    let blunt = trend(2e-6, 0.0).unwrap();
    assert!(
        blunt.contains("S²/P, in which there is no area, by +0 %"),
        "{blunt}"
    );
    assert!(
        blunt.contains("the area function's: `[evaluation.calibrate]`"),
        "{blunt}"
    );
    let frame = trend(0.0, 0.6e-6).unwrap();
    assert!(frame.contains("the frame's compliance"), "{frame}");
}
