//! Maps in periodic cells whose opposite edges do not fit.

use ndarray::Array2;

use super::surfaces::{Random, self_affine};
use super::{case, step};

const CASE: &str = r#"
[foundation]
substrate = { young_modulus = "70 GPa", poisson_ratio = 0.2 }
[surface]
kind = "rough"
file = "scan"
side = "10 um"
[indenter]
kind = "paraboloid"
radius = "1 km"
[load]
force = "1 mN"
[grid]
elements = 128
side = "10 um"
boundary = "periodic"
"#;

fn codes(map: &Array2<f64>) -> Vec<String> {
    let case = case(CASE, &[("scan", &(map * 10e-9))]).expect("a valid case");
    let warnings = case.warnings(10e-6).into_iter();
    warnings.map(|warning| warning.code.to_owned()).collect()
}

fn is_told(map: &Array2<f64>) -> bool {
    codes(map).iter().any(|code| code == "not-periodic-map")
}

/// Hurst exponents from 0.5 to 1, waves down to two samples, 64 samples along a side.
#[test]
fn of_random_surfaces_none_that_repeats_is_called_cut_and_every_cut_one_is() {
    let random = &mut Random(1);
    for _ in 0..200 {
        let hurst = 0.5 + 0.5 * random.next();
        assert!(!is_told(&self_affine(random, [64, 64], hurst)), "{hurst}");
        assert!(is_told(&self_affine(random, [200, 64], hurst)), "{hurst}");
    }
}

#[test]
fn walls_of_a_pattern_that_repeats_are_no_step_across_the_rim() {
    let pillars = |samples| {
        Array2::from_shape_fn([samples; 2], |(i, j)| {
            f64::from(u8::from(i % 16 < 8 && j % 16 < 8))
        })
    };
    assert!(!is_told(&pillars(64)));
    // Two periods and a half: the step across the rim is a wall like those inside.
    assert!(!is_told(&pillars(40)));
    let wave = Array2::from_shape_fn([64, 64], |(i, _)| (i as f64 * 0.13).sin());
    assert!(is_told(&wave));
    assert!(!is_told(&Array2::zeros([32, 32])));
}

/// The part of the force on three elements along the rim, 9 % of the cell.
#[test]
fn tapered_edges_carry_no_more_than_their_part_of_the_load() {
    // As scans are: tilted by some rms heights.
    let mut map = self_affine(&mut Random(5), [400, 128], 0.8) * 20e-9;
    let tilt = |i: usize, j: usize| 100e-9 * (i as f64 - 0.8 * j as f64) / 128.0;
    for ((i, j), height) in map.indexed_iter_mut() {
        *height += tilt(i, j);
    }
    let on_rim = |edges: &str| {
        let text = CASE.replace("[indenter]", &format!("edges = \"{edges}\"\n[indenter]"));
        let case = case(&text, &[("scan", &map)]).unwrap();
        let run = case.solve(&mut ()).unwrap();
        let pressure = &run.path.steps[0].solution.pressure;
        let is_rim = |k: usize| !(3..125).contains(&(k / 128)) || !(3..125).contains(&(k % 128));
        let on_rim = pressure.iter().enumerate().filter(|(k, _)| is_rim(*k));
        on_rim.map(|(_, p)| p).sum::<f64>() / pressure.iter().sum::<f64>()
    };
    let [measured, tapered] = [on_rim("as measured"), on_rim("taper")];
    assert!(measured > 0.5, "{measured}");
    // A few islands of contact, so the part scatters.
    assert!((0.0..0.2).contains(&tapered), "{tapered}");
}

#[test]
fn the_edges_of_a_free_map_are_not_changed() {
    let map = self_affine(&mut Random(5), [64, 64], 0.8) * 10e-9;
    let text = CASE.replace("[indenter]", "edges = \"taper\"\n[indenter]");
    let (_, codes) = step(&text, &[("scan", &map)]);
    assert!(!codes.iter().any(|code| code == "not-periodic-map"));
    let free = text.replace("boundary = \"periodic\"", "");
    let refused = case(&free, &[("scan", &map)]).unwrap_err();
    assert!(
        refused.contains("`surface.edges`") && refused.contains("\"as measured\""),
        "{refused}"
    );
}
