//! Stresses where the contact is small: beside the elements of a coarse grid, or beside the depth of a body.

use serde_json::Value;

use super::runner::TestFolder;

/// Pillars between the centres of the elements of the coarsest grid of the solution, on which no element touches.
const PILLARS: &str = r#"[foundation]
substrate = { young_modulus = "210 GPa", poisson_ratio = 0.3 }
[surface]
kind = "cylinders"
radius = "1 um"
height = "0.5 um"
period = "30 um"
offset = ["3.75 um", "3.75 um"]
[indenter]
kind = "sphere"
radius = "200 um"
[load]
penetration = "60 nm"
[grid]
side = "60 um"
elements = 64
[stress]
"#;

/// A contact of 0.1 µm on a body of some kind.
fn small_contact(foundation: &str) -> Value {
    let rest = "[indenter]\nkind = \"sphere\"\nradius = \"1 um\"\n[load]\nforce = \"10 uN\"\n\
                [grid]\nelements = 32\n[stress]\n";
    let folder = TestFolder::with_case(format!("{foundation}{rest}"));
    folder.run(&["run", "case.toml", "--json"]).json()
}

fn value(body: &Value, name: &str) -> f64 {
    body[name]["value"].as_f64().unwrap()
}

/// A layer 500 contact radii thick is a half-space to some thousandths, the part of the radius in the thickness. The
/// contact is found on the same grid, and so are its stresses.
#[test]
fn in_a_body_of_five_hundred_contact_radii_stresses_are_those_of_a_half_space() {
    let half_space = small_contact(
        "[foundation]\nsubstrate = { young_modulus = \"3 GPa\", poisson_ratio = 0.35 }\n",
    );
    let layer = small_contact(
        "[foundation]\nsubstrate = \"rigid\"\n[[foundation.layer]]\nthickness = \"50 um\"\n\
         young_modulus = \"3 GPa\"\npoisson_ratio = 0.35\ninterface = \"frictionless\"\n",
    );
    let body = |summary: &Value| summary["steps"][0]["stress"]["bodies"][0].clone();
    let (wanted, found) = (body(&half_space), body(&layer));
    for name in [
        "max_von_mises",
        "max_principal",
        "min_principal",
        "max_shear",
    ] {
        let ratio = value(&found, name) / value(&wanted, name);
        assert!((ratio - 1.0).abs() < 0.01, "{name}: {ratio}");
    }
}

#[test]
fn a_grid_of_the_solution_without_contact_is_left_out_of_the_errors_of_stresses() {
    let folder = TestFolder::with_case(PILLARS);
    let summary = folder.run(&["run", "case.toml", "--json"]).json();
    let step = &summary["steps"][0];
    let body = &step["stress"]["bodies"][0];
    let pressure = step["max_pressure"].as_f64().unwrap();
    assert_eq!(step["contact_elements"], 1);
    // Under one element the largest compression is the pressure, as under any uniform one: the others are 0.8 of it.
    let ratio = -value(body, "min_principal") / pressure;
    assert!((ratio - 1.0).abs() < 1e-9, "{ratio}");
    // Under a uniform circle it is 0.33 of the pressure (Johnson 1985, §3.4). A square has corners, and the search
    // takes depths of quarters of an element, on both sides of the peak.
    let ratio = value(body, "max_shear") / pressure;
    assert!((ratio / 0.33 - 1.0).abs() < 0.06, "{ratio}");
    assert_eq!(body["max_shear"]["resolved"], false);
}
