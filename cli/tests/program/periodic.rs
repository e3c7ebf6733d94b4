//! `grid.boundary = "periodic"`.

use std::fs::File;

use ndarray::Array2;
use ndarray_npy::WriteNpyExt;
use serde_json::Value;

use super::runner::{CASE, TestFolder};

const SAMPLES: usize = 20;

/// A rough rigid body on a coating, in a periodic cell, with the given lines `grid` and `load`.
fn case(grid: &str, load: &str) -> String {
    format!(
        "[foundation]
substrate = {{ young_modulus = 1, poisson_ratio = 0.3 }}

[[foundation.layer]]
thickness = 0.05
young_modulus = 4
poisson_ratio = 0.3

[indenter]
kind = \"map\"
file = \"rough.npy\"
side = 1

[load]
{load}

[grid]
elements = 32
{grid}
"
    )
}

const CELL: &str = "boundary = \"periodic\"\nside = 1";

/// A folder with a map whose samples are shifted around the cell.
fn folder(text: &str, moved: [usize; 2]) -> TestFolder {
    let folder = TestFolder::with_case(text);
    let map = Array2::from_shape_fn([SAMPLES; 2], |(i, j)| {
        let [x, y] = [i + moved[0], j + moved[1]].map(|i| (i % SAMPLES) as f64);
        0.01 * ((0.7 * x).sin() * (1.3 * y).cos() + (0.2 * x * y).sin())
    });
    map.write_npy(File::create(folder.path("rough.npy")).unwrap())
        .unwrap();
    folder
}

fn summary(folder: &TestFolder) -> Value {
    folder.run(&["run", "case.toml", "--json"]).json()
}

/// Five samples are eight elements, so the elements shift with the samples, also across the border of the cell.
#[test]
fn shifting_the_origin_of_the_cell_changes_nothing() {
    let text = case(CELL, "force = 0.01");
    let found = [[0, 0], [5, 0], [10, 15]].map(|moved| summary(&folder(&text, moved)));
    assert_eq!(found[0]["grid"]["boundary"], "periodic");
    assert_eq!(found[0]["case"]["grid"]["boundary"], "periodic");
    for key in ["penetration", "max_pressure", "contact_area"] {
        let [wanted, once, twice] = found
            .each_ref()
            .map(|summary| summary["steps"][0][key].as_f64().unwrap());
        approx::assert_relative_eq!(once, wanted, max_relative = 1e-6);
        approx::assert_relative_eq!(twice, wanted, max_relative = 1e-6);
    }
    let rough = found
        .each_ref()
        .map(|summary| &summary["steps"][0]["rough_contact"]);
    assert_eq!(rough[0]["nominal_area"], 1.0);
    // Islands continue across the border.
    let islands = rough.map(|rough| &rough["islands"]);
    assert!(islands[0]["count"].as_u64().unwrap() > 1);
    assert_eq!([islands[1], islands[2]], [islands[0]; 2]);
    for key in ["perimeter", "mean_gap", "corrected_area"] {
        let [wanted, once, twice] = rough.map(|rough| rough[key].as_f64().unwrap());
        approx::assert_relative_eq!(once, wanted, max_relative = 1e-6);
        approx::assert_relative_eq!(twice, wanted, max_relative = 1e-6);
    }
    let slopes = found.each_ref().map(|summary| {
        assert_eq!(summary["roughness"]["indenter"]["derivatives"], "spectrum");
        summary["roughness"]["indenter"]["rms_slope"]
            .as_f64()
            .unwrap()
    });
    approx::assert_relative_eq!(slopes[1], slopes[0], max_relative = 1e-12);
    approx::assert_relative_eq!(slopes[2], slopes[0], max_relative = 1e-12);
}

#[test]
fn keys_incompatible_with_a_periodic_cell_are_rejected() {
    for (text, key, wanted) in [
        (
            case(CELL, "penetration = 0.01"),
            "load.penetration",
            "force or forces",
        ),
        (
            case(CELL, "force = 0.01\nsensitivities = true"),
            "load.sensitivities",
            "false",
        ),
        (
            case("boundary = \"periodic\"", "force = 0.01"),
            "grid.side",
            "the side of the periodic cell",
        ),
        (
            case("boundary = \"periodic\"\nside = 2", "force = 0.01"),
            "indenter.",
            "as large as the cell",
        ),
        (
            case(CELL, "force = 0.01") + "[stress]\n",
            "stress",
            "no stresses",
        ),
    ] {
        let ran = folder(&text, [0, 0]).run(&["run", "case.toml"]);
        assert_eq!(ran.code, Some(2), "{text}");
        assert!(
            ran.stderr.contains(key) && ran.stderr.contains(wanted),
            "{}",
            ran.stderr
        );
    }
}

#[test]
fn the_period_of_cylinders_must_divide_the_cell() {
    let cell = |side: &str| {
        CASE.replace(
            "side = \"400 nm\"",
            &format!("side = \"{side}\"\nboundary = \"periodic\""),
        )
    };
    let ran = TestFolder::with_case(cell("400 nm")).run(&["run", "case.toml", "--json"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let hexagonal = cell("400 nm").replace("period =", "lattice = \"hexagonal\"\nperiod =");
    let ran = TestFolder::with_case(hexagonal).run(&["run", "case.toml"]);
    assert_eq!(ran.code, Some(2));
    assert!(ran.stderr.contains("surface.lattice"), "{}", ran.stderr);
    let ran = TestFolder::with_case(cell("410 nm")).run(&["run", "case.toml"]);
    assert_eq!(ran.code, Some(2));
    assert!(ran.stderr.contains("surface.period"), "{}", ran.stderr);
    assert!(
        ran.stderr.contains("divides the side of the cell"),
        "{}",
        ran.stderr
    );
}
