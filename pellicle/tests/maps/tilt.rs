//! A tilted scan and a level one.

use ndarray::Array2;

use super::surfaces::{Random, self_affine};
use super::{case, solved, step};

const CASE: &str = r#"
[foundation]
substrate = { young_modulus = "70 GPa", poisson_ratio = 0.2 }
[surface]
kind = "rough"
file = "scan"
side = "10 um"
[indenter]
kind = "paraboloid"
radius = "50 um"
[load]
force = "0.3 mN"
[grid]
elements = 64
side = "10 um"
"#;

/// A level scan of 64 × 64 samples with an rms height of 15 nm, and the same with a slope of 0.1 along x.
fn scans() -> [Array2<f64>; 2] {
    let level = self_affine(&mut Random(3), [64, 64], 0.8) * 15e-9;
    let mut tilted = level.clone();
    for ((i, _), height) in tilted.indexed_iter_mut() {
        *height += 0.1 * (i as f64 + 0.5) * 10e-6 / 64.0;
    }
    [level, tilted]
}

#[test]
fn a_levelled_scan_gives_the_same_contact_whatever_its_tilt() {
    let text = CASE.replace("[indenter]", "level = \"plane\"\n[indenter]");
    let [level, tilted] = scans().map(|map| step(&text, &[("scan", &map)]));
    for (step, codes) in [&level, &tilted] {
        assert!(
            !codes
                .iter()
                .any(|code| code == "tilted-map" || code == "cut-off"),
            "{codes:?}"
        );
        // Rounding of heights of 1 µm over 20 nm of penetration.
        assert!((step.penetration / level.0.penetration - 1.0).abs() < 1e-7);
    }
}

#[test]
fn a_tilt_that_decides_the_contact_is_told_once_with_its_size_and_key() {
    let [level, tilted] = scans().map(|map| solved(CASE, &[("scan", &map)]));
    let told = |summary: &pellicle::summary::RunSummary| -> Vec<String> {
        let warnings = summary.warnings.iter();
        let about = warnings.filter(|warning| warning.message.contains("`level = \"plane\"`"));
        about
            .map(|warning| warning.code.clone() + ": " + &warning.message)
            .collect()
    };
    assert_eq!(told(&level), [""; 0]);
    let told = told(&tilted);
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(
        told[0].starts_with("tilted-map: ") && told[0].contains("0.099 (5.7 degrees)"),
        "{told:?}"
    );
    // The statistics are those of the heights as solved.
    let rms = |summary: &pellicle::summary::RunSummary| {
        let roughness = summary
            .roughness
            .as_ref()
            .and_then(|of| of.surface.as_ref());
        roughness.expect("a rough surface").rms_height
    };
    // 0.1 of 10 µm over √12.
    assert!((rms(&tilted) / 0.289e-6 - 1.0).abs() < 0.02 && rms(&level) < 20e-9);
}

#[test]
fn the_key_level_has_two_words() {
    let [level, _] = scans();
    let text = CASE.replace("[indenter]", "level = \"linear\"\n[indenter]");
    let refused = case(&text, &[("scan", &level)]).unwrap_err();
    assert!(
        refused.contains("wanted one of \"plane\", \"none\""),
        "{refused}"
    );
}
