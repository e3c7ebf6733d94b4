//! Two maps in one cell: in register, or with the indenter's summit on the axis.

use ndarray::Array2;

use super::step;
use super::surfaces::{Random, self_affine};

const CASE: &str = r#"
[foundation]
substrate = { young_modulus = "70 GPa", poisson_ratio = 0.2 }
[surface]
kind = "rough"
file = "lower"
side = "10 um"
[indenter]
INDENTER
[load]
force = "5 mN"
[grid]
elements = 64
side = "10 um"
boundary = "periodic"
"#;

/// Two rough surfaces of 32 × 32 samples: the one below, and the one above it, upwards.
fn maps() -> [Array2<f64>; 2] {
    let random = &mut Random(12);
    [0.8, 0.6].map(|hurst| self_affine(random, [32, 32], hurst) * 20e-9)
}

fn solved(lower: &Array2<f64>, upper: &Array2<f64>, indenter: &str) -> [f64; 4] {
    let text = CASE.replace("INDENTER", indenter);
    let (step, _) = step(&text, &[("lower", lower), ("upper", upper)]);
    let [x, y] = step.summary.max_pressure_at;
    [step.summary.max_pressure, step.summary.contact_area, x, y]
}

#[test]
fn maps_as_given_are_pressed_together_as_a_flat_on_their_difference() {
    let [lower, upper] = maps();
    let of_map =
        |origin: &str| format!("kind = \"map\"\nfile = \"upper\"\nside = \"10 um\"\n{origin}");
    let difference = solved(&(&lower - &upper), &upper, "kind = \"flat\"");
    let in_register = solved(&lower, &upper, &of_map("origin = \"as given\""));
    for (one, other) in difference.into_iter().zip(in_register) {
        // The solutions are certified to 1e-8 of their scales.
        assert!(
            (one / other - 1.0).abs() < 1e-6,
            "{difference:?} {in_register:?}"
        );
    }
    let summit = solved(&lower, &upper, &of_map(""));
    assert!(
        (summit[0] / difference[0] - 1.0).abs() > 0.05,
        "{summit:?} {difference:?}"
    );
    let bits = |numbers: [f64; 4]| numbers.map(f64::to_bits);
    let by_name = solved(&lower, &upper, &of_map("origin = \"summit\""));
    assert_eq!(bits(summit), bits(by_name));
}
