//! Indenters that end: punches of any outline, and scans cut out of something larger.

use ndarray::Array2;
use pellicle_contact::Status;

use super::{solved, step};

const CASE: &str = r#"
[foundation]
substrate = { young_modulus = 1.0, poisson_ratio = 0.0 }
[indenter]
kind = "map"
file = "punch"
side = SIDE
[load]
force = 0.01
[grid]
elements = 256
GRID
"#;

fn case(side: f64, grid: &str) -> String {
    CASE.replace("SIDE", &side.to_string())
        .replace("GRID", grid)
}

/// `F/(2 a_c E*)` with the capacity of the unit square, 0.366793 of its side (Hwang and Mascagni 2004).
const SQUARE_PUNCH: f64 = 0.01 / 1.15231;

#[test]
fn a_square_punch_ends_at_its_outline_and_is_not_cut_off() {
    let (step, codes) = step(&case(1.0, ""), &[("punch", &Array2::zeros([32, 32]))]);
    assert_eq!(step.status, Status::Certified);
    assert!(
        !codes
            .iter()
            .any(|code| code == "cut-off" || code == "steep-indenter"),
        "{codes:?}"
    );
    let error = step.grid_error.penetration.expect("an estimate");
    assert!(
        (step.penetration - SQUARE_PUNCH).abs() < error.estimate,
        "{} ± {}",
        step.penetration,
        error.estimate
    );
}

/// The step is sampled 128 times along the side, so its wall is a bevel of a sample.
#[test]
fn a_punch_given_by_a_step_is_no_narrower_than_its_bevel_whatever_the_interpolation() {
    let is_punch = |k: usize| (32..96).contains(&k);
    let map = Array2::from_shape_fn([128, 128], |(i, j)| {
        0.2 * f64::from(u8::from(!(is_punch(i) && is_punch(j))))
    });
    for interpolation in ["bicubic", "linear"] {
        let text = case(2.0, "side = 2.0");
        let text = text.replace(
            "[load]",
            &format!("interpolation = \"{interpolation}\"\n[load]"),
        );
        let (step, _) = step(&text, &[("punch", &map)]);
        // The top is a sample narrower than the punch, 1.6 %.
        let ratio = step.penetration / SQUARE_PUNCH;
        assert!((1.0..1.03).contains(&ratio), "{interpolation} {ratio}");
    }
}

#[test]
fn the_scan_of_a_ball_is_cut_off_where_the_contact_reaches_its_end() {
    let scan = Array2::from_shape_fn([32, 32], |(i, j)| {
        let [x, y] = [i, j].map(|k| (k as f64 - 15.5) / 32.0);
        0.01 * (x * x + y * y)
    });
    let summary = solved(&case(1.0, "side = 2.0"), &[("punch", &scan)]);
    assert_eq!(summary.steps[0].status, Status::CutOff);
    let told = summary
        .warnings
        .iter()
        .find(|warning| warning.code == "cut-off");
    assert!(told.is_some_and(|warning| warning.message.contains("the indenter's map")));
}
