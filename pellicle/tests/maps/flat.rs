//! A plane without end pressed on rough and textured bodies.

use super::surfaces::{Random, self_affine};
use super::{case, step};

const CASE: &str = r#"
[foundation]
substrate = { young_modulus = "70 GPa", poisson_ratio = 0.2 }
[surface]
SURFACE
[indenter]
INDENTER
[load]
force = "1 mN"
[grid]
elements = 64
GRID
"#;

const ROUGH: &str = "kind = \"rough\"\nfile = \"rough\"\nside = \"10 um\"";
const PERIODIC: &str = "side = \"10 um\"\nboundary = \"periodic\"";

fn text(surface: &str, indenter: &str, grid: &str) -> String {
    let text = CASE
        .replace("SURFACE", surface)
        .replace("INDENTER", indenter);
    text.replace("GRID", grid)
}

#[test]
fn a_plane_is_a_paraboloid_of_infinite_radius_in_a_cell_and_on_a_free_map() {
    let rough = self_affine(&mut Random(4), [32, 32], 0.8) * 20e-9;
    for grid in [PERIODIC, "side = \"10 um\""] {
        let [flat, ball] = [
            "kind = \"flat\"",
            "kind = \"paraboloid\"\nradius = \"1 km\"",
        ]
        .map(|indenter| step(&text(ROUGH, indenter, grid), &[("rough", &rough)]).0);
        for [one, other] in [
            [flat.penetration, ball.penetration],
            [flat.summary.max_pressure, ball.summary.max_pressure],
            [flat.summary.contact_area, ball.summary.contact_area],
        ] {
            // The ball rises by 1e-13 m over the map, on 20 nm of heights.
            assert!((one / other - 1.0).abs() < 1e-4, "{grid} {one} {other}");
        }
    }
    // Without a side the domain is the map.
    let (whole, codes) = step(&text(ROUGH, "kind = \"flat\"", ""), &[("rough", &rough)]);
    let (given, _) = step(
        &text(ROUGH, "kind = \"flat\"", "side = \"10 um\""),
        &[("rough", &rough)],
    );
    assert_eq!(whole.penetration.to_bits(), given.penetration.to_bits());
    assert!(
        !codes.iter().any(|code| code == "domain-much-larger"),
        "{codes:?}"
    );
}

#[test]
fn an_elastic_plane_is_softer() {
    let rough = self_affine(&mut Random(4), [32, 32], 0.8) * 20e-9;
    let elastic = "kind = \"flat\"\nyoung_modulus = \"70 GPa\"\npoisson_ratio = 0.2";
    let [rigid, elastic] = ["kind = \"flat\"", elastic]
        .map(|indenter| step(&text(ROUGH, indenter, PERIODIC), &[("rough", &rough)]).0);
    let halved = elastic.summary.max_pressure / rigid.summary.max_pressure;
    assert!((0.4..0.9).contains(&halved), "{halved}");
}

#[test]
fn a_plane_on_a_smooth_body_or_on_pillars_without_end_is_refused_with_the_reason() {
    let pillars = "kind = \"cylinders\"\nradius = \"1 um\"\nheight = \"1 um\"\nperiod = \"5 um\"";
    let film = "kind = \"film\"\nthickness = \"1 um\"\nyoung_modulus = \"1 GPa\"";
    for (surface, grid, told) in [
        ("kind = \"bare\"", "", "whose contact has no edge"),
        ("kind = \"bare\"", PERIODIC, "whose contact has no edge"),
        (film, PERIODIC, "whose contact has no edge"),
        (pillars, "", "which no force presses"),
    ] {
        let refused = case(&text(surface, "kind = \"flat\"", grid), &[]).unwrap_err();
        assert!(
            refused.contains("`indenter.kind`") && refused.contains(told),
            "{refused}"
        );
    }
    let (pressed, _) = step(&text(pillars, "kind = \"flat\"", PERIODIC), &[]);
    assert!(pressed.summary.contact_area > 0.0);
}
