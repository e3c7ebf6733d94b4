//! `grid.boundary = "periodic"`.

use std::f64::consts::TAU;
use std::fs::{self, File};

use ndarray::{Array1, Array2};
use ndarray_npy::{NpzReader, WriteNpyExt};
use serde_json::Value;

use super::netcdf_reader::variables;
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

/// A cell of 20 × 10 or 10 × 20 µm with a rough surface of as many samples as elements.
fn oblong(lengths: [usize; 2]) -> TestFolder {
    let text = format!(
        "[foundation]\nsubstrate = {{ young_modulus = \"70 GPa\", poisson_ratio = 0.2 }}\n\
         [surface]\nkind = \"rough\"\nfile = \"scan.npy\"\nsides = [\"{x} um\", \"{y} um\"]\n\
         [indenter]\nkind = \"paraboloid\"\nradius = \"1 km\"\n[load]\npressure = \"5 MPa\"\n\
         [grid]\nsides = [\"{x} um\", \"{y} um\"]\nelements = [{x}, {y}]\nboundary = \"periodic\"\n\
         [output]\nformats = [\"npz\", \"vti\", \"nc\", \"gsf\"]\n",
        x = lengths[0],
        y = lengths[1],
    );
    let folder = TestFolder::with_case(text);
    let map = Array2::from_shape_fn(lengths, |(i, j)| {
        let [x, y] = [i as f64 / lengths[0] as f64, j as f64 / lengths[1] as f64];
        2e-8 * (TAU * (2.0 * x + y)).sin() + 1e-8 * (TAU * (x - 3.0 * y)).cos()
    });
    map.write_npy(File::create(folder.path("scan.npy")).unwrap())
        .unwrap();
    folder
}

#[test]
fn the_files_of_an_oblong_cell_have_its_shape() {
    for lengths in [[48, 32], [32, 48]] {
        let folder = oblong(lengths);
        let ran = folder.run(&["run", "case.toml", "--out", "a"]);
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        let [x, y] = lengths;
        let told = &ran.stderr;
        let line = format!("grid {x} × {y} on a periodic cell of sides {x}.000 µm and {y}.000 µm");
        assert!(told.contains(&line), "{told}");
        let page = fs::read_to_string(folder.path("a/report.html")).unwrap();
        let line = format!("{x} × {y} elements on an oblong cell of sides");
        assert!(page.contains(&line));
        let summary = folder.summary("a");
        assert_eq!(summary["grid"]["lengths"], serde_json::json!(lengths));
        let step = &summary["steps"][0];
        let area = 48.0 * 32.0 * 1e-12;
        approx::assert_relative_eq!(
            step["force"].as_f64().unwrap(),
            5e6 * area,
            max_relative = 1e-12
        );
        let file = |end: &str| folder.path(&format!("a/{end}"));
        let mut npz = NpzReader::new(File::open(file("fields-000.npz")).unwrap()).unwrap();
        let pressure: Array2<f64> = npz.by_name("pressure").unwrap();
        assert_eq!(pressure.dim(), (x, y));
        // The elements are 1 µm wide.
        approx::assert_relative_eq!(pressure.sum() * 1e-12, 5e6 * area, max_relative = 1e-7);
        for (axis, length) in [("x", x), ("y", y)] {
            let centres: Array1<f64> = npz.by_name(axis).unwrap();
            assert_eq!(centres.len(), length);
            approx::assert_relative_eq!(
                centres[0],
                (0.5 - length as f64 / 2.0) * 1e-6,
                max_relative = 1e-9
            );
        }
        let nc = variables(fs::read(file("fields-000.nc")).unwrap());
        assert_eq!(
            nc["pressure"][0],
            pressure.iter().copied().collect::<Vec<_>>()
        );
        assert_eq!([nc["x"][0].len(), nc["y"][0].len()], lengths);
        let vti = fs::read(file("fields-000.vti")).unwrap();
        let vti = String::from_utf8_lossy(&vti);
        assert!(vti.contains(&format!("WholeExtent=\"0 {x} 0 {y} 0 0\"")));
        let gsf = fs::read(file("pressure-000.gsf")).unwrap();
        for (found, wanted) in gsf_pressure(&gsf, lengths).iter().zip(&pressure) {
            // Single precision.
            assert!((found - wanted).abs() <= 1e-7 * wanted, "{found} {wanted}");
        }
        // Pictures are drawn again from the files.
        let again = folder.run(&["plot", "a"]);
        assert_eq!(again.code, Some(0), "{}", again.stderr);
    }
}

/// The values of a file whose rows run along x from the highest y down.
fn gsf_pressure(bytes: &[u8], [x, y]: [usize; 2]) -> Array2<f64> {
    let head = String::from_utf8_lossy(bytes);
    assert!(head.contains(&format!("XRes = {x}\nYRes = {y}\n")));
    let values = &bytes[bytes.len() - 4 * x * y..];
    Array2::from_shape_fn([x, y], |(i, j)| {
        let at = 4 * ((y - 1 - j) * x + i);
        f64::from(f32::from_le_bytes(values[at..at + 4].try_into().unwrap()))
    })
}

#[test]
fn elements_that_would_not_be_square_are_refused_with_numbers_that_fit() {
    let folder = oblong([48, 32]);
    let ran = folder.run(&["run", "case.toml", "--set", "grid.elements=49"]);
    assert_eq!(ran.code, Some(2));
    let told = "such as [48, 32] or [51, 34]";
    assert!(
        ran.stderr.contains("grid.elements") && ran.stderr.contains(told),
        "{}",
        ran.stderr
    );
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
    let fitting = hexagonal.replace("side = \"400 nm\"", "sides = [4e-7, 6.928571428571429e-7]");
    let elements = ["--set", "grid.elements=[56, 97]", "--json"];
    let ran = TestFolder::with_case(fitting).run(&[&["run", "case.toml"][..], &elements].concat());
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let ran = TestFolder::with_case(hexagonal).run(&["run", "case.toml"]);
    assert_eq!(ran.code, Some(2));
    assert!(ran.stderr.contains("surface.lattice"), "{}", ran.stderr);
    // The sides to write instead, and they do.
    let told = "grid.elements = [56, 97]";
    assert!(ran.stderr.contains(told), "{}", ran.stderr);
    let ran = TestFolder::with_case(cell("410 nm")).run(&["run", "case.toml"]);
    assert_eq!(ran.code, Some(2));
    assert!(ran.stderr.contains("surface.period"), "{}", ran.stderr);
    assert!(
        ran.stderr.contains("divides the sides of the cell"),
        "{}",
        ran.stderr
    );
}
