//! Points at which the model of a fit does not hold are left out, counted, listed and reported, or the fit explains why
//! it has no result.

use std::f64::consts::PI;
use std::fs;

use serde_json::Value;

use super::runner::{ProgramOutput, TestFolder};

/// A ball on a 1 µm film on a practically rigid body, between a tenth of and ten times the load that squeezes the film
/// by its thickness.
const FILM: &str = r#"
[model]
foundation = { substrate = { young_modulus = "1 TPa", poisson_ratio = 0.3 } }
indenter = { kind = "paraboloid", radius = "100 um" }
surface = { kind = "film", thickness = "1 um", young_modulus = "1 MPa" }

[[data]]
file = "curve.csv"
columns = { depth = "depth", force = "force" }
units = { depth = "nm", force = "uN" }
segment = { from = "31.4159 uN", to = "3141.59 uN" }
noise = { relative = 0.01, depth = "0 nm", correlation = "none" }

[unknown]
"surface.young_modulus" = { from = "0.1 MPa", to = "10 MPa" }
"#;

/// A small ball on a soft body, around the load at which its slope at the contact's edge is 0.3.
const STEEP: &str = r#"
[model]
foundation = { substrate = { young_modulus = "1 GPa", poisson_ratio = 0.2 } }
indenter = { kind = "paraboloid", radius = "1 um" }

[[data]]
file = "curve.csv"
columns = { depth = "depth", force = "force" }
units = { depth = "nm", force = "uN" }
segment = { from = "3.75 uN", to = "375 uN" }
noise = { relative = 0.01, depth = "0 nm", correlation = "none" }

[unknown]
"foundation.substrate.young_modulus" = { from = "0.1 GPa", to = "10 GPa" }
"#;

const SQUEEZED: &str = "springs squeezed by more than their height";
const TOO_STEEP: &str = "indenter too steep where the contact ends";

/// Points that no body can have are simulated only if this is added to a fit file.
const KEEP: &str = "\n[report]\noutside = \"keep\"\n";

/// Fits measurements simulated from the file `simulated` with the file `fit`.
fn fitted(simulated: &str, fit: &str) -> (TestFolder, ProgramOutput, Value) {
    let folder = TestFolder::new();
    fs::write(folder.path("fit.toml"), simulated).unwrap();
    let simulate = ["identify", "fit.toml", "--simulate", "--out", "curve.csv"];
    let ran = folder.run(&simulate);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    fs::write(folder.path("fit.toml"), fit).unwrap();
    let ran = folder.run(&["identify", "fit.toml", "--out", "fit"]);
    let found = fs::read_to_string(folder.path("fit").join("fit.json"));
    let found = found.unwrap_or_else(|error| panic!("{error}: {}", ran.stderr));
    (folder, ran, serde_json::from_str(&found).unwrap())
}

/// The forces of a simulated curve, N, spaced as in its fit file.
fn forces(least: f64) -> impl Iterator<Item = f64> {
    (0..100).map(move |i| least * 100_f64.powf(f64::from(i) / 99.0))
}

fn codes(found: &Value) -> Vec<&str> {
    let warnings = found["warnings"].as_array().unwrap().iter();
    warnings.map(|one| one["code"].as_str().unwrap()).collect()
}

fn assert_left_out(folder: &TestFolder, found: &Value, reason: &str, count: usize) {
    assert_eq!(found["verdict"], "fitted");
    let expected = serde_json::json!([{ "reason": reason, "count": count }]);
    assert_eq!(found["fit"]["excluded"], expected);
    assert_eq!(found["fit"]["points"], 100 - count);
    assert_eq!(found["curves"][0]["points"], 100 - count);
    let rows = |name: &str| fs::read_to_string(folder.path("fit").join(name)).unwrap();
    let listed = rows("excluded.csv");
    assert_eq!(listed.lines().count(), 1 + count, "{listed}");
    // The points left out are the last rows of the table: the largest forces.
    for (line, row) in listed.lines().skip(1).zip(101 - count..) {
        assert!(line.starts_with(&format!("curve.csv,{row},")), "{line}");
        assert!(line.ends_with(reason), "{line}");
    }
    assert_eq!(rows("fit.csv").lines().count(), 101 - count);
    assert!(rows("report.html").contains(reason));
    assert_eq!(codes(found), ["outside-model", "outside-model"]);
}

#[test]
fn points_where_a_film_is_squeezed_by_its_thickness_are_excluded() {
    // A paraboloid on springs: p = (D − r²/2R)/η, so Q = π R D²/η, and ηp = h at Q = π R h²/η = π R h E.
    let limit = PI * 100e-6 * 1e-6 * 1e6;
    let count = forces(31.4159e-6).filter(|force| *force > limit).count();
    assert_eq!(count, 50);
    let (folder, ran, found) = fitted(FILM, FILM);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert_left_out(&folder, &found, SQUEEZED, count);
    assert!(
        ran.stderr.contains("50 points from 0.322 to 3.14 mN"),
        "{}",
        ran.stderr
    );
    let modulus = found["unknowns"][0]["value"].as_f64().unwrap();
    // Four standard errors: 1 % of noise in D ∝ E^−½ at 50 points, with a free zero.
    assert!((modulus / 1e6 - 1.0).abs() < 0.03, "{modulus}");
}

#[test]
fn logarithmic_springs_are_never_squeezed_to_zero_thickness() {
    // Beside a rigid body such springs would end at their height, in a knee that six loads per decade cannot follow.
    let softer = FILM.replace("\"1 TPa\"", "\"20 MPa\"");
    let logarithmic = softer.replace("\"1 MPa\" }", "\"1 MPa\", law = \"logarithmic\" }");
    assert_ne!(logarithmic, softer);
    let (_, _, linear) = fitted(&softer, &softer);
    assert_eq!(linear["fit"]["excluded"][0]["reason"], SQUEEZED);
    let (folder, ran, found) = fitted(&logarithmic, &logarithmic);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert_eq!(found["fit"]["excluded"], serde_json::json!([]));
    assert_eq!(codes(&found), [""; 0]);
    assert!(!folder.path("fit").join("excluded.csv").exists());
}

#[test]
fn points_where_a_ball_is_steep_at_the_contact_edge_are_excluded() {
    // a/R = 0.3 with a³ = 3QR/4E*.
    let limit = 4.0 / 3.0 * 1e9 / 0.96 * 1e-12 * 0.3_f64.powi(3);
    let count = forces(3.75e-6).filter(|force| *force > limit).count();
    assert_eq!(count, 50);
    let (folder, ran, found) = fitted(STEEP, STEEP);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert_left_out(&folder, &found, TOO_STEEP, count);
}

#[test]
fn points_where_a_gel_is_pressed_to_its_base_are_excluded() {
    // A thin gel below a punch: D is in proportion to the force, and reaches the thickness at half of the largest one.
    let case = r#"
[model]
foundation = { substrate = "rigid", layer = [{ thickness = "1 um", young_modulus = "1 MPa", poisson_ratio = 0.3 }] }
indenter = { kind = "paraboloid", radius = "1 mm" }

[[data]]
file = "curve.csv"
columns = { depth = "depth", force = "force" }
units = { depth = "nm", force = "mN" }
segment = { from = "0.1 mN", to = "10 mN" }
noise = { relative = 0.01, depth = "0 nm", correlation = "none" }

[unknown]
"foundation.layer[0].young_modulus" = { from = "0.1 MPa", to = "10 MPa" }
"#;
    let (folder, ran, found) = fitted(&format!("{case}{KEEP}"), case);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert_eq!(found["verdict"], "fitted");
    let [excluded] = &found["fit"]["excluded"].as_array().unwrap()[..] else {
        panic!("{}", found["fit"])
    };
    assert_eq!(
        excluded["reason"],
        "surface pressed below the top of the rigid base"
    );
    // A thin layer is a bed of springs p = M u/H, so Q = π R M D²/H with M = E (1 − ν)/((1 + ν)(1 − 2ν)); the layer is
    // thin to about a tenth. D = H at Q = π R M H = 4.2 mN.
    let confined = 1e6 * 0.7 / (1.3 * 0.4);
    let limit = PI * 1e-3 * confined * 1e-6;
    let count = forces(1e-4).filter(|force| *force > limit).count();
    let found = excluded["count"].as_u64().unwrap();
    assert!(found.abs_diff(count as u64) <= 2, "{found} {count}");
    assert!(folder.path("fit").join("excluded.csv").exists());
    // The simulation leaves out the same points, and says so; the others are as before.
    let before = fs::read_to_string(folder.path("curve.csv")).unwrap();
    fs::write(folder.path("fit.toml"), case).unwrap();
    let simulate = [
        "identify",
        "fit.toml",
        "--simulate",
        "--force",
        "--out",
        "curve.csv",
    ];
    let ran = folder.run(&simulate);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let words = format!(
        "outside the model, surface pressed below the top of the rigid base: {found} points from"
    );
    assert!(ran.stderr.contains(&words), "{}", ran.stderr);
    let kept = fs::read_to_string(folder.path("curve.csv")).unwrap();
    assert_eq!(kept.lines().count() as u64, 101 - found);
    assert!(before.starts_with(&kept));
}

#[test]
fn a_berkovich_curve_is_fitted_with_one_warning_of_its_slope_and_one_of_its_pressure() {
    let case = r#"
[model]
foundation = { substrate = { young_modulus = "160 GPa", poisson_ratio = 0.22 }, layer = [{ thickness = "0.7 um", young_modulus = "210 GPa", poisson_ratio = 0.25 }] }
indenter = { kind = "berkovich", tip_radius = "40 nm" }

[[data]]
file = "curve.csv"
columns = { depth = "depth", force = "force" }
units = { depth = "nm", force = "mN" }
segment = { from = "0.05 mN", to = "6 mN" }
noise = { depth = "0.3 nm", relative = 0.004, correlation = "none" }

[unknown]
"foundation.layer[0].young_modulus" = { from = "20 GPa", to = "600 GPa" }
"#;
    let (_, ran, found) = fitted(case, case);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert_eq!(found["verdict"], "fitted");
    assert_eq!(found["fit"]["excluded"], serde_json::json!([]));
    assert_eq!(codes(&found), ["steep-indenter", "sharp-tip"]);
    let unknown = &found["unknowns"][0];
    let modulus = unknown["value"].as_f64().unwrap();
    // Simulated with 210 GPa; 0.3 nm of noise at 100 points leave some 0.4 %.
    assert!((modulus / 210e9 - 1.0).abs() < 0.02, "{modulus}");
}

#[test]
fn points_kept_by_the_fit_file_are_fitted_with_a_warning() {
    let keep = format!("{STEEP}[report]\noutside = \"keep\"\n");
    let (folder, ran, found) = fitted(STEEP, &keep);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert_eq!(found["fit"]["points"], 100);
    assert_eq!(found["fit"]["excluded"], serde_json::json!([]));
    assert_eq!(codes(&found), ["outside-model", "outside-model"]);
    assert!(!folder.path("fit").join("excluded.csv").exists());
}

#[test]
fn a_fit_with_too_few_valid_points_says_why_and_which_key_changes_it() {
    // Every load squeezes the film by more than its thickness.
    let higher = |fit: &str| {
        let fit = fit.replace("\"31.4159 uN\"", "\"400 uN\"");
        fit.replace("\"3141.59 uN\"", "\"4 mN\"")
    };
    let (_, ran, found) = fitted(&higher(FILM), &higher(FILM));
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    assert_eq!(found["verdict"], "outside-model");
    assert!(!ran.stderr.contains("not converged"), "{}", ran.stderr);
    assert!(
        ran.stderr.contains("report.outside = \"keep\""),
        "{}",
        ran.stderr
    );
    assert!(
        ran.stderr.contains("100 points from 0.400 to 4.00 mN"),
        "{}",
        ran.stderr
    );
    assert!(
        ran.stderr.contains("too few points are left"),
        "{}",
        ran.stderr
    );
    assert!(ran.stderr.contains(SQUEEZED), "{}", ran.stderr);
    // Noise told to be far below the grid's error leaves no point out, but refuses data of 1 % noise. A ball itself
    // needs no grid.
    let exact = STEEP.replace("relative = 0.01, depth = \"0 nm\"", "depth = \"1e-7 nm\"");
    let (_, ran, found) = fitted(STEEP, &exact);
    assert_eq!((ran.code, &found["verdict"]), (Some(3), &"misfit".into()));
    assert!(!ran.stderr.contains("grid"), "{}", ran.stderr);
    let exact = exact.replace("radius = \"1 um\"", "radii = [\"1 um\", \"1.0001 um\"]");
    let (_, ran, found) = fitted(STEEP, &exact);
    assert_eq!(ran.code, Some(3), "{}", ran.stderr);
    assert_eq!(found["verdict"], "misfit");
    let reason = "the noise given is smaller than the error of the grid at 50 points";
    assert!(ran.stderr.contains(reason), "{}", ran.stderr);
}
