//! Output of `kernel`, `influence`, `check` and `init`.

use std::fs;

use serde_json::Value;

use super::runner::{CASE, TestFolder, keys};

fn json(folder: &TestFolder, arguments: &[&str]) -> Value {
    let ran = folder.run(arguments);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert_eq!(ran.stderr, "");
    serde_json::from_str(&ran.stdout).unwrap()
}

#[test]
fn kernel_prints_wavenumber_compliance_and_response() {
    let folder = TestFolder::with_case(CASE);
    let line = [
        "kernel",
        "case.toml",
        "--json",
        "--wavenumber",
        "1e6",
        "2e7,3e8",
        "--wavenumber",
        "4e9",
    ];
    let rows = json(&folder, &line);
    let rows = rows.as_array().unwrap();
    assert_eq!(rows.len(), 4);
    for (row, k) in rows.iter().zip([1e6, 2e7, 3e8, 4e9]) {
        assert_eq!(keys(row), ["wavenumber", "compliance", "response"]);
        assert_eq!(row["wavenumber"].as_f64(), Some(k));
        assert!(row["compliance"].as_f64().unwrap() > 0.0);
    }
}

#[test]
fn influence_prints_offset_and_coefficient() {
    let folder = TestFolder::with_case(CASE);
    let line = ["influence", "case.toml", "--json", "--offset", "0,0", "3,1"];
    let rows = json(&folder, &line);
    let rows = rows.as_array().unwrap();
    assert_eq!(rows.len(), 2);
    assert_eq!(keys(&rows[1]), ["offset", "coefficient"]);
    assert_eq!(rows[1]["offset"], serde_json::json!([3, 1]));
    let at = |i: usize| rows[i]["coefficient"].as_f64().unwrap();
    assert!(at(0) > at(1));
}

#[test]
fn influence_prints_the_fields_of_an_element_on_both_sides_of_an_interface() {
    let folder = TestFolder::with_case(CASE);
    let line = [
        "influence",
        "case.toml",
        "--json",
        "--offset",
        "0,0",
        "-2,1",
        "--depth",
        "0",
        "10 nm",
    ];
    let rows = json(&folder, &line);
    let rows = rows.as_array().unwrap();
    let names = [
        "offset",
        "depth",
        "side",
        "element_side",
        "normal",
        "tangential",
    ];
    let fields = ["ux", "uy", "uz", "sxx", "syy", "szz", "sxy", "sxz", "syz"];
    for row in rows {
        assert_eq!(keys(row), names);
        assert_eq!(keys(&row["normal"]), fields);
        assert_eq!(keys(&row["tangential"]), fields);
    }
    let places: Vec<_> = rows
        .iter()
        .map(|row| (row["offset"].to_string(), row["side"].as_str()))
        .collect();
    let wanted = [("[0,0]", "above"), ("[-2,1]", "above")];
    let below = [("[0,0]", "below"), ("[-2,1]", "below")];
    let wanted: Vec<_> = [wanted, wanted, below].concat();
    let wanted: Vec<_> = wanted
        .iter()
        .map(|(offset, side)| ((*offset).to_owned(), Some(*side)))
        .collect();
    assert_eq!(places, wanted);
    let value = |row: usize, load: &str, field: &str| rows[row][load][field].as_f64().unwrap();
    // The surface under the element carries the loads, and sinks by the influence coefficient.
    assert!((value(0, "normal", "szz") + 1.0).abs() < 1e-12);
    assert!((value(0, "tangential", "sxz") + 1.0).abs() < 1e-12);
    let coefficient = &json(
        &folder,
        &["influence", "case.toml", "--json", "--offset", "0,0"],
    )[0];
    let sinks = value(0, "normal", "uz") / coefficient["coefficient"].as_f64().unwrap();
    assert!((sinks - 1.0).abs() < 1e-11, "{sinks}");
    // Tractions are continuous across the interface.
    let passes = value(2, "normal", "szz") / value(4, "normal", "szz");
    assert!((passes - 1.0).abs() < 1e-10, "{passes}");
    let shown = folder.run(&[
        "influence",
        "case.toml",
        "--offset",
        "1,0",
        "--depth",
        "1 um",
    ]);
    assert!(shown.stdout.contains("depth [m]") && shown.stdout.contains("tangential"));
    let refused = folder.run(&[
        "influence",
        "case.toml",
        "--offset",
        "1,0",
        "--depth",
        "-1 nm",
    ]);
    assert_eq!(refused.code, Some(2), "{}", refused.stderr);
    assert!(
        refused.stderr.contains("wanted a depth of zero or more"),
        "{}",
        refused.stderr
    );
}

#[test]
fn a_depth_inside_a_rigid_base_is_refused() {
    let substrate = "{ young_modulus = \"7 GPa\", poisson_ratio = 0.4 }";
    let folder = TestFolder::with_case(CASE.replace(substrate, "\"rigid\""));
    let line = [
        "influence",
        "case.toml",
        "--offset",
        "0,0",
        "--depth",
        "11 nm",
    ];
    let refused = folder.run(&line);
    assert_eq!(refused.code, Some(2), "{}", refused.stderr);
    assert!(
        refused
            .stderr
            .contains("for a depth in the body, wanted 0 to"),
        "{}",
        refused.stderr
    );
}

#[test]
fn text_tables_name_their_units() {
    let folder = TestFolder::with_case(CASE);
    let kernel = folder.run(&["kernel", "case.toml", "--wavenumber", "1e6"]);
    assert!(kernel.stdout.contains("C(k) [m/Pa]"), "{}", kernel.stdout);
    let influence = folder.run(&["influence", "case.toml", "--offset", "0,0"]);
    assert!(
        influence.stdout.contains("k [m/Pa]"),
        "{}",
        influence.stdout
    );
}

#[test]
fn check_prints_a_case_with_every_default_filled_in() {
    let folder = TestFolder::with_case(CASE);
    let checked = folder.run(&["check", "case.toml"]);
    assert_eq!(checked.code, Some(0), "{}", checked.stderr);
    for text in [
        "thickness = \"10 nm\"",
        "young_modulus = \"70 GPa\"",
        "radius = \"4 um\"",
        "force = \"1 uN\"",
        "side = \"400 nm\"",
        "offset = [\"0 m\", \"0 m\"]",
        "tolerance = ",
        "lattice = \"square\"",
        "interface = \"bonded\"",
        "# elements per radius of a cylinder",
        "# elements per contact radius, about",
        "# products with K per step, about",
        "# memory, about",
        "# a trial of the largest load on 32 × 32 elements: Q = 1.0000 µN",
    ] {
        assert!(
            checked.stdout.contains(text),
            "{text} in: {}",
            checked.stdout
        );
    }
    let again = TestFolder::with_case(&checked.stdout).run(&["check", "case.toml"]);
    assert_eq!((again.code, again.stdout), (Some(0), checked.stdout));
}

#[test]
fn check_estimates_the_work_of_stresses() {
    let folder = TestFolder::with_case(CASE);
    let sets = ["--set", "stress={depths=[0, \"10 nm\"], extent=\"100 nm\"}"];
    let strength = ["--set", "foundation.substrate.yield_strength=1 GPa"];
    let checked = folder.run(&[&["check", "case.toml"], &sets[..], &strength].concat());
    assert_eq!(checked.code, Some(0), "{}", checked.stderr);
    for text in [
        "[stress]",
        "# stresses per step, about              3 planes of 8 × 8 points",
        "#   down to                             10.000 nm",
        "# critical loads                        1, each by solving",
        "yield_strength = \"1 GPa\"",
        "extent = \"100 nm\"",
        "depths = [\"0 m\", \"10 nm\"]",
    ] {
        assert!(
            checked.stdout.contains(text),
            "{text} in: {}",
            checked.stdout
        );
    }
}

#[test]
fn check_gives_the_warnings_of_the_solution() {
    let folder = TestFolder::with_case(CASE);
    let warns = |sets: &[&str], words: &str| {
        let sets: Vec<_> = sets.iter().flat_map(|set| ["--set", set]).collect();
        let checked = folder.run(&[&["check", "case.toml"][..], &sets].concat());
        assert_eq!(checked.code, Some(0), "{}", checked.stderr);
        assert!(
            checked.stderr.contains(words),
            "{words} in: {}",
            checked.stderr
        );
    };
    warns(
        &["surface.radius=5 nm"],
        "0.4 elements per radius of a cylinder",
    );
    warns(
        &["foundation.layer.0.thickness=0.1 nm"],
        "layer 0 is 0.008 elements thick",
    );
    warns(
        &["load.force=200 uN"],
        "at the largest load, the contact is cut off by the edge of the domain",
    );
    let small = "load={forces=[\"1 nN\", \"1 uN\"]}";
    warns(
        &[small],
        "at the smallest load, the contact's radius is some",
    );
    let film = "surface={kind=\"film\", thickness=\"1 nm\", young_modulus=\"1 MPa\"}";
    warns(&[film], "at the largest load, the relief shortens by");
    let cone = "indenter={kind=\"cone\", half_angle=\"45 deg\"}";
    warns(&[cone], "beyond small strains");
    let quiet = folder.run(&["check", "case.toml"]);
    assert_eq!(
        quiet
            .stderr
            .lines()
            .filter(|line| !line.contains("radius of a cylinder"))
            .count(),
        0
    );
}

#[test]
fn check_and_run_choose_the_same_domain_on_every_grid() {
    // Rough enough that the contact found differs between grids.
    let heights = |i: usize| {
        let height = |j: usize| {
            let (x, y) = (i as f64, j as f64);
            let waves = (0.9 * x + 0.4 * y).sin() + (0.5 * x - 1.3 * y).cos();
            let chance = (1e4 * (12.9898 * x + 78.233 * y).sin()).rem_euclid(1.0);
            format!("{:.3}", 40.0 * (waves + chance) / 3.0)
        };
        (0..48).map(height).collect::<Vec<_>>().join(",") + "\n"
    };
    let rough = TestFolder::with_case(ROUGH);
    let map: String = (0..48).map(heights).collect();
    fs::write(rough.path("map.csv"), map).unwrap();
    assert_one_domain(&rough);
    assert_one_domain(&TestFolder::with_case(
        CASE.replace("side = \"400 nm\"\n", ""),
    ));
}

/// A ball on a rough body.
const ROUGH: &str = r#"
[foundation]
substrate = { young_modulus = "70 GPa", poisson_ratio = 0.2 }
[surface]
kind = "map"
file = "map.csv"
side = "30 um"
height_unit = "3 nm"
compliance = 0
[indenter]
kind = "sphere"
radius = "100 um"
[load]
force = "0.1 mN"
"#;

#[track_caller]
fn assert_one_domain(folder: &TestFolder) {
    let side = |text: &str| {
        let line = text.lines().find_map(|line| line.strip_prefix("side = \""));
        line.map(|line| {
            let (number, unit) = line.trim_end_matches('"').split_once(' ').unwrap();
            // The point is moved, so that the number is rounded once.
            let power = ["nm", "um"]
                .into_iter()
                .zip([-9, -6])
                .find(|(known, _)| *known == unit);
            format!("{number}e{}", power.unwrap().1)
                .parse::<f64>()
                .unwrap()
        })
    };
    let mut sides = Vec::new();
    for elements in ["grid.elements=32", "grid.elements=101"] {
        let checked = folder.run(&["check", "case.toml", "--set", elements]);
        sides.extend(side(&checked.stdout));
        let ran = folder.run(&["run", "case.toml", "--json", "--quiet", "--set", elements]);
        let summary: Value = serde_json::from_str(&ran.stdout).unwrap();
        sides.extend(summary["grid"]["side"].as_f64());
    }
    assert_eq!(sides.len(), 4);
    assert!(
        sides
            .iter()
            .all(|side| side.to_bits() == sides[0].to_bits()),
        "{sides:?}"
    );
}

#[test]
fn every_template_passes_its_check() {
    for kind in [
        "cylinders",
        "film",
        "coating",
        "berkovich",
        "vickers",
        "cube-corner",
        "cone",
        "flat-punch",
        "hertz",
    ] {
        let template = TestFolder::new().run(&["init", kind]);
        assert_eq!(template.code, Some(0), "{}", template.stderr);
        let checked = TestFolder::with_case(template.stdout).run(&["check", "case.toml"]);
        assert_eq!(checked.code, Some(0), "{kind}: {}", checked.stderr);
    }
}

#[test]
fn a_template_replaces_a_file_only_with_force() {
    let folder = TestFolder::with_case("mine");
    assert_eq!(folder.run(&["init", "--out", "case.toml"]).code, Some(2));
    assert_eq!(
        fs::read_to_string(folder.path("case.toml")).unwrap(),
        "mine"
    );
    assert_eq!(
        folder.run(&["init", "--out", "case.toml", "--force"]).code,
        Some(0)
    );
    assert_eq!(folder.names(), ["case.toml"]);
}
