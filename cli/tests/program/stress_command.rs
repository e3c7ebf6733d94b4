//! `stress`: its output against closed forms and the files of a run.

use std::f64::consts::PI;

use serde_json::Value;

use super::runner::{CASE, ProgramOutput, TestFolder, keys};

/// Hertz's contact with R = 1 and E/(1 − ν²) = 1.
const HERTZ: &str = "[foundation]\nsubstrate = { young_modulus = 0.91, poisson_ratio = 0.3 }\n\
    [indenter]\nkind = \"paraboloid\"\nradius = 1\n[load]\nforces = [1e-4, 1e-3]\n[grid]\nelements = 64\n";

fn rows(ran: &ProgramOutput) -> Vec<Value> {
    let rows = ran.json();
    rows.as_array().unwrap().clone()
}

fn number(row: &Value, place: &str) -> f64 {
    row.pointer(place).unwrap().as_f64().unwrap()
}

#[test]
fn stresses_on_the_axis_match_hertz_at_the_load_of_the_step() {
    let folder = TestFolder::with_case(HERTZ);
    for (step, force) in [(&["--step", "0"][..], 1e-4_f64), (&[], 1e-3)] {
        let radius = (0.75 * force).cbrt();
        let peak = 1.5 * force / (PI * radius * radius);
        let depths = [0.0, 0.5 * radius, 3.0 * radius];
        let points = depths.map(|z| format!("0,0,{z:e}"));
        let line = ["stress", "case.toml", "--json", "--at"].into_iter();
        let line = line
            .chain(points.iter().map(String::as_str))
            .chain(step.iter().copied());
        let rows = rows(&folder.run(&line.collect::<Vec<_>>()));
        for (row, z) in rows.iter().zip(depths) {
            let z = z / radius;
            // σ_zz = −p0/(1 + ζ²), σ_rr = −p0 [(1 + ν)(1 − ζ arctan 1/ζ) − 1/2(1 + ζ²)] (Johnson 1985, 3.45)
            let along = -1.0 / (1.0 + z * z);
            let arc = if z > 0.0 { z * (1.0 / z).atan() } else { 0.0 };
            let across = -1.3 * (1.0 - arc) - 0.5 * along;
            // About 21 of the 64 elements lie in the radius; the grid error is of second order.
            let close = |found: f64, wanted: f64| {
                assert!((found / peak - wanted).abs() < 5e-3, "{row}, {wanted}");
            };
            close(number(row, "/sigma/zz"), along);
            close(number(row, "/sigma/xx"), across);
            close(number(row, "/sigma/yy"), across);
            close(number(row, "/von_mises"), (along - across).abs());
            close(number(row, "/principal/0"), along.max(across));
            close(number(row, "/principal/2"), along.min(across));
            close(number(row, "/sigma/xz"), 0.0);
        }
    }
}

#[test]
fn interface_points_have_a_row_per_side_with_the_body_names() {
    let folder = TestFolder::with_case(CASE);
    let ran = folder.run(&[
        "stress",
        "case.toml",
        "--json",
        "--at",
        "-10 nm,2e-8,10 nm",
        "0,0,1 um",
    ]);
    assert_eq!(ran.stderr, "");
    let rows = rows(&ran);
    let sides: Vec<_> = rows
        .iter()
        .map(|row| row["side"].as_str().unwrap())
        .collect();
    assert_eq!(sides, ["above", "below", "above"]);
    for row in &rows {
        assert_eq!(
            keys(row),
            ["at", "side", "u", "sigma", "von_mises", "principal"]
        );
        assert_eq!(keys(&row["sigma"]), ["xx", "yy", "zz", "xy", "xz", "yz"]);
        assert_eq!(row["u"].as_array().unwrap().len(), 3);
    }
    assert_eq!(rows[0]["at"], serde_json::json!([-1e-8, 2e-8, 1e-8]));
    // Tractions are continuous; the stress along the interface jumps by the ratio of moduli.
    let of = |row: usize, place| number(&rows[row], place);
    assert!((of(0, "/sigma/zz") / of(1, "/sigma/zz") - 1.0).abs() < 1e-9);
    assert!(of(0, "/sigma/xx") > 2.0 * of(1, "/sigma/xx"));
    let shown = folder.run(&["stress", "case.toml", "--at", "0,0,1 um"]);
    assert!(
        shown
            .stdout
            .starts_with("step 0; x, y, z and displacements in m, stresses in Pa")
    );
}

#[test]
fn stresses_at_a_point_match_the_files_of_a_run() {
    let sliding =
        "stress={friction=0.3, direction=\"20 deg\", depths=[\"5 nm\"], extent=\"400 nm\"}";
    let folder = TestFolder::with_case(CASE);
    let ran = folder.run(&[
        "run",
        "case.toml",
        "--set",
        sliding,
        "--formats",
        "nc",
        "--pictures",
        "none",
        "--out",
        "a",
    ]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    // With one plane, the fields are at the end of the file, the largest principal stress last.
    let bytes = std::fs::read(folder.path("a/stress-000.nc")).unwrap();
    let from_end = bytes
        .rchunks(8)
        .map(|number| number.try_into().unwrap_or_default());
    let values: Vec<_> = from_end.map(f64::from_be_bytes).collect();
    let size = 32;
    let at =
        |field: usize, [i, j]: [usize; 2]| values[(11 - field) * size * size - 1 - (i * size + j)];
    let centre = |i: usize| 12.5e-9 * (i as f64 - 15.5);
    for place in [[16, 16], [3, 20]] {
        let [x, y] = place.map(centre);
        let point = format!("{x:e},{y:e},5 nm");
        let row = &rows(&folder.run(&[
            "stress",
            "case.toml",
            "--set",
            sliding,
            "--json",
            "--at",
            &point,
        ]))[0];
        for (field, name) in [
            "/u/0",
            "/u/1",
            "/u/2",
            "/sigma/xx",
            "/sigma/yy",
            "/sigma/zz",
        ]
        .iter()
        .enumerate()
        {
            let (found, wanted) = (number(row, name), at(field, place));
            assert!(
                (found - wanted).abs() < 1e-8 * wanted.abs(),
                "{name}: {found:e}, {wanted:e}"
            );
        }
    }
}

#[test]
fn unbounded_displacements_are_null_with_a_warning() {
    let slides = "poisson_ratio = 0.3\ninterface = \"frictionless\"";
    let folder = TestFolder::with_case(CASE.replace("poisson_ratio = 0.3", slides));
    let ran = folder.run(&[
        "stress",
        "case.toml",
        "--json",
        "--set",
        "stress.friction=0.1",
        "--at",
        "0,0,5 nm",
        "0,0,20 nm",
    ]);
    assert!(
        ran.stderr
            .contains("warning: the interface below layer 0 is frictionless"),
        "{}",
        ran.stderr
    );
    let rows = rows(&ran);
    assert!(rows[0]["u"][0].is_null() && rows[0]["u"][1].is_null());
    assert!(rows[0]["u"][2].is_number() && rows[0]["sigma"]["xx"].is_number());
    assert!(rows[1]["u"][0].is_number());
}

#[test]
fn invalid_points_and_steps_are_rejected_in_one_sentence() {
    let folder = TestFolder::with_case(CASE);
    for (line, sentence) in [
        (&["--at", "0,0"][..], "wanted three lengths"),
        (&["--at", "0,0,-1 nm"], "wanted a depth of zero or more"),
        (&["--at", "0,0,1 GPa"], "wanted a length"),
        (
            &["--at", "0,0,0", "--step", "1"],
            "found step 1 on the command line, wanted 0 to 0",
        ),
        (
            &[
                "--at",
                "0,0,11 nm",
                "--set",
                "foundation.substrate=\"rigid\"",
            ],
            "wanted 0 to 1e-8, the depth of the rigid base",
        ),
        (&[], "--at"),
    ] {
        let ran = folder.run(&[&["stress", "case.toml"], line].concat());
        assert_eq!((ran.code, &ran.stdout[..]), (Some(2), ""), "{}", ran.stderr);
        assert!(ran.stderr.contains(sentence), "{line:?}: {}", ran.stderr);
    }
    let on_base = folder.run(&[
        "stress",
        "case.toml",
        "--json",
        "--at",
        "0,0,10 nm",
        "--set",
        "foundation.substrate=\"rigid\"",
    ]);
    let rows = rows(&on_base);
    assert_eq!(rows.len(), 1);
    // The point does not move.
    assert!(number(&rows[0], "/u/2").abs() < 1e-20);
}
