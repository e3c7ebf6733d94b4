//! A fit file drafted from measured curves: one file in and a modulus out.
//!
//! Every curve but those of instruments is that of Hertz, so the modulus is known.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use rand::SeedableRng as _;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution as _, StandardNormal};
use serde_json::Value;

use super::runner::{ProgramOutput, TestFolder};

const RADIUS: f64 = 5e-6;
pub const STIFFNESS: f64 = 0.05;

/// `F = 4/3 E* √R D^1.5`.
fn hertz(reduced: f64, radius: f64, depth: f64) -> f64 {
    4.0 / 3.0 * reduced * radius.sqrt() * depth.max(0.0).powf(1.5)
}

/// Heights, m, and forces, N, of an approach to a body of 10 kPa, ν = 0.5: 500 nm before the contact and 300 nm in it,
/// with 20 pN of noise.
pub fn approach(seed: u64) -> Vec<[f64; 2]> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut rows = Vec::new();
    for i in 0..320 {
        let depth = -5e-7 + 2.5e-9 * f64::from(i);
        let force = hertz(1e4 / 0.75, RADIUS, depth);
        let noise: f64 = StandardNormal.sample(&mut random);
        rows.push([4e-6 + depth + force / STIFFNESS, force + 2e-11 * noise]);
    }
    rows
}

/// Depths, nm, and forces, mN, of a ball of 10 µm on 70 GPa, ν = 0.25, with 0.2 nm of noise.
fn ball() -> Vec<[f64; 2]> {
    let mut random = ChaCha8Rng::seed_from_u64(3);
    let reduced = 70e9 / (1.0 - 0.0625);
    let one = |i: i32| {
        let depth = 1e-9 * f64::from(i);
        let noise: f64 = StandardNormal.sample(&mut random);
        [1e9 * depth + 0.2 * noise, 1e3 * hertz(reduced, 1e-5, depth)]
    };
    (1..120).map(one).collect()
}

/// A table with these headings, separator and decimal mark.
pub fn table(head: &str, rows: &[[f64; 2]], separator: char, decimal: char) -> String {
    let mut text = head.to_owned();
    for [x, y] in rows {
        let row = format!("{x:.4};{y:.5}").replace('.', &decimal.to_string());
        writeln!(text, "{}", row.replace(';', &separator.to_string())).unwrap();
    }
    text
}

pub fn in_nanometres(rows: &[[f64; 2]]) -> Vec<[f64; 2]> {
    rows.iter().map(|[x, y]| [1e9 * x, 1e9 * y]).collect()
}

/// Drafts a fit from this text as `curve.txt`, and returns the folder, what is printed and the fit file.
fn drafted(kind: &str, text: &str) -> (TestFolder, ProgramOutput, String) {
    let folder = TestFolder::new();
    fs::write(folder.path("curve.txt"), text).unwrap();
    let ran = folder.run(&["init", kind, "--from", "curve.txt"]);
    let fit = fs::read_to_string(folder.path("curve.toml")).unwrap_or_default();
    (folder, ran, fit)
}

/// Value, ends of the interval and verdict of the first unknown of `curve.toml`.
fn fitted(folder: &TestFolder) -> ([f64; 3], Value) {
    let ran = folder.run(&["identify", "curve.toml", "--json"]);
    let found: Value =
        serde_json::from_str(&ran.stdout).unwrap_or_else(|_| panic!("{}", ran.stderr));
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let of = &found["unknowns"][0];
    let numbers = [&of["value"], &of["interval"][0], &of["interval"][1]];
    (numbers.map(|number| number.as_f64().unwrap()), found)
}

fn assert_holds([value, low, high]: [f64; 3], wanted: f64, within: f64) {
    assert!(low < wanted && wanted < high, "{low} {value} {high}");
    assert!((value / wanted - 1.0).abs() < within, "{value}");
}

#[test]
fn an_approach_whose_file_states_its_cantilever_and_tip_gives_its_modulus_at_once() {
    let head = "k (N/m): 0.05\nTip radius (um): 5\nZ (nm)\tForce (nN)\n";
    let text = table(head, &in_nanometres(&approach(1)), '\t', '.');
    let (folder, ran, fit) = drafted("fit", &text);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    for part in [
        "columns = { height = \"Z (nm)\", force = \"Force (nN)\" }  # columns 1, 2 of 2",
        "spring_constant = \"50 mN/m\"  # line 1: k (N/m): 0.05",
        "radius = \"5 um\"  # line 2: Tip radius (um): 5",
        "poisson_ratio = 0.5 }  # Poisson's ratio, not in the file: put yours",
        "The contact begins near row 19",
    ] {
        assert!(fit.contains(part), "{part}:\n{fit}");
    }
    assert!(
        ran.stderr.contains("pellicle identify curve.toml"),
        "{}",
        ran.stderr
    );
    // The noise alone leaves 1 %.
    assert_holds(fitted(&folder).0, 1e4, 0.02);
}

#[test]
fn what_no_file_tells_has_a_default_that_says_so() {
    let rows = approach(2).into_iter();
    let rows: Vec<_> = rows.map(|[z, f]| [1e9 * z, f / STIFFNESS / 8e-8]).collect();
    let (folder, ran, fit) = drafted(
        "fit-afm",
        &table("Z (nm),Deflection (V)\n", &rows, ',', '.'),
    );
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let lines: Vec<&str> = fit
        .lines()
        .filter(|line| line.contains("not in the file: put yours"))
        .collect();
    for key in ["poisson_ratio", "radius", "deflection", "spring_constant"] {
        let has = |line: &&&str| line.contains(key);
        assert!(lines.iter().any(|line| has(&line)), "{key}: {lines:#?}");
    }
    let warned = |found: &Value| {
        let warnings = found["warnings"].as_array().unwrap().clone();
        warnings.into_iter().find(|of| of["code"] == "guesses")
    };
    let warning = warned(&fitted(&folder).1).unwrap();
    for key in [
        "`substrate` (Poisson's ratio)",
        "`radius`",
        "`spring_constant`",
    ] {
        assert!(
            warning["message"].as_str().unwrap().contains(key),
            "{warning}"
        );
    }
    // With them put right, the modulus is, and without the words nothing is warned of.
    let own = fit.replace("deflection = \"100 nm/V\"", "deflection = \"80 nm/V\"");
    let own = own.replace(
        "spring_constant = \"100 mN/m\"",
        "spring_constant = \"0.05 N/m\"",
    );
    assert!(own.contains("80 nm/V") && own.contains("0.05 N/m"), "{fit}");
    let own = own.replace("not in the file: put yours", "mine");
    fs::write(folder.path("curve.toml"), own).unwrap();
    let (numbers, found) = fitted(&folder);
    assert_holds(numbers, 1e4, 0.02);
    assert_eq!(warned(&found), None);
}

#[test]
fn plain_columns_decimal_commas_and_two_lines_of_headings_are_understood() {
    let rows = ball();
    for (head, separator, decimal, said) in [
        ("", ' ', '.', "columns = { depth = 1, force = 2 }"),
        (
            "Weg [nm];Kraft [mN]\n",
            ';',
            ',',
            "text = { decimal = \",\" }  # numbers have a comma",
        ),
        (
            "Depth\tLoad\nnm\tmN\n",
            '\t',
            '.',
            "columns = { depth = \"Depth\", force = \"Load\" }",
        ),
    ] {
        let (folder, ran, fit) = drafted("fit", &table(head, &rows, separator, decimal));
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        let has_units = fit
            .contains("units = { depth = \"nm\", force = \"mN\" }  # not in the file: put yours");
        assert!(
            fit.contains(said) && has_units == head.is_empty(),
            "{said}:\n{fit}"
        );
        assert!(
            fit.contains("the force grows as the depth to the 3/2: a ball"),
            "{fit}"
        );
        assert_holds(fitted(&folder).0, 70e9, 0.01);
    }
}

#[test]
fn what_is_no_curve_is_refused_in_a_sentence_and_nothing_is_written() {
    for (text, wanted) in [
        ("", "found an empty file"),
        ("To the laboratory:\nthe curves follow.\n", "found no table"),
        ("1\n2\n3\n4\n", "found no table"),
        (
            "Angle (deg)\tSpeed\n1\t2\n2\t3\n3\t4\n4\t5\n",
            "found the columns \"Angle (deg)\", \"Speed\", wanted a force",
        ),
        (
            "Depth (nm)\tLoad (mN)\n1\t5\n2\t5\n3\t5\n4\t5\n",
            "in every point",
        ),
    ] {
        let (folder, ran, _) = drafted("fit", text);
        assert_eq!(ran.code, Some(2), "{text}: {}", ran.stderr);
        assert!(
            ran.stderr.contains(wanted) && ran.stderr.contains("curve.txt"),
            "{text}: {}",
            ran.stderr
        );
        assert_eq!(ran.stderr.trim().lines().count(), 1, "{}", ran.stderr);
        assert_eq!(folder.names(), ["curve.txt"]);
    }
    let folder = TestFolder::new();
    let none = folder.run(&["init", "fit", "--from", "none*.txt"]);
    assert!(
        none.code == Some(2) && none.stderr.contains("found no file"),
        "{}",
        none.stderr
    );
    let other = folder.run(&["init", "coating", "--from", "curve.txt"]);
    assert!(
        other.code == Some(2) && other.stderr.contains("wanted fit"),
        "{}",
        other.stderr
    );
}

#[test]
fn a_draft_replaces_no_file_and_names_its_curve_from_its_own_folder() {
    let text = table("Depth (nm) Load (mN)\n", &ball(), ' ', '.');
    let (folder, ..) = drafted("fit", &text);
    let again = folder.run(&["init", "fit", "--from", "curve.txt"]);
    assert_eq!(again.code, Some(2), "{}", again.stderr);
    fs::create_dir(folder.path("fits")).unwrap();
    let out = folder.run(&[
        "init",
        "fit",
        "--from",
        "curve.txt",
        "--out",
        "fits/own.toml",
    ]);
    assert_eq!(out.code, Some(0), "{}", out.stderr);
    let fit = fs::read_to_string(folder.path("fits/own.toml")).unwrap();
    assert!(fit.contains("file = \"../curve.txt\"\n"), "{fit}");
    assert_eq!(
        folder.run(&["identify", "fits/own.toml", "--json"]).code,
        Some(0)
    );
}

#[test]
fn a_folder_of_repeats_is_one_pattern_and_other_files_are_tables_of_their_own() {
    let folder = TestFolder::new();
    fs::create_dir(folder.path("cells")).unwrap();
    let text = |seed| {
        table(
            "Z (nm)\tForce (nN)\n",
            &in_nanometres(&approach(seed)),
            '\t',
            '.',
        )
    };
    for seed in 1..4 {
        fs::write(folder.path(&format!("cells/cell{seed}.txt")), text(seed)).unwrap();
    }
    fs::write(folder.path("cells/notes.md"), "three cells").unwrap();
    let ran = folder.run(&["init", "fit-afm", "--from", "cells"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let fit = fs::read_to_string(folder.path("cells/cells.toml")).unwrap();
    assert!(
        fit.contains("file = \"*.txt\"  # 3 files: repeats"),
        "{fit}"
    );
    // Another order of columns, and a file of text.
    let other = table("Force (nN)\tZ (nm)\n", &[], '\t', '.');
    let rows = in_nanometres(&approach(4));
    let rows: Vec<_> = rows.iter().map(|[z, f]| [*f, *z]).collect();
    fs::write(
        folder.path("cells/other.txt"),
        other + &table("", &rows, '\t', '.'),
    )
    .unwrap();
    fs::write(folder.path("cells/notes.txt"), "three cells").unwrap();
    let ran = folder.run(&["init", "fit-afm", "--from", "cells", "--out", "all.toml"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert!(
        ran.stderr
            .contains("left out: cells/notes.txt: found no table"),
        "{}",
        ran.stderr
    );
    let fit = fs::read_to_string(folder.path("all.toml")).unwrap();
    let files: Vec<&str> = fit
        .lines()
        .filter(|line| line.starts_with("file = "))
        .collect();
    assert_eq!(files.len(), 2, "{files:?}");
    assert!(
        files[0].starts_with("file = \"cells/cell*.txt\""),
        "{files:?}"
    );
    assert_eq!(files[1], "file = \"cells/other.txt\"");
}

#[test]
fn a_stiffness_over_force_needs_no_zero_of_the_depth() {
    // A cone of 70.3° on 170 GPa, ν = 0.28, with the depth off by 20 nm: F = (2/π) E* tan α D², S = dF/dD.
    let factor =
        2.0 / std::f64::consts::PI * 170e9 / (1.0 - 0.28 * 0.28) * 70.3_f64.to_radians().tan();
    let mut text = "Depth (nm)\tLoad (mN)\tStiffness (N/m)\n".to_owned();
    for i in 1..=40 {
        let depth = 5e-8 * f64::from(i);
        let wave = 1.0 + 2e-3 * (2.4 * f64::from(i)).sin();
        let [force, stiffness] = [factor * depth * depth, wave * 2.0 * factor * depth];
        writeln!(
            text,
            "{:.3}\t{:.6}\t{stiffness:.2}",
            1e9 * depth + 20.0,
            1e3 * force
        )
        .unwrap();
    }
    let (folder, ran, fit) = drafted("fit", &text);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert!(fit.contains("observe = \"stiffness at force\""), "{fit}");
    let own = fit.replace("poisson_ratio = 0.25 }", "poisson_ratio = 0.28 }");
    fs::write(folder.path("curve.toml"), own).unwrap();
    assert_holds(fitted(&folder).0, 170e9, 2e-3);
}

#[test]
fn an_imprint_is_found_out_and_its_unloading_evaluated() {
    let curves = Path::new(env!("CARGO_MANIFEST_DIR")).join("../identify/tests/curves");
    let text = fs::read_to_string(curves.join("synthetic_fused_silica.txt")).unwrap();
    let (folder, ran, fit) = drafted("fit", &text);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert!(
        fit.contains("observe = \"unloading\"") && fit.contains("[evaluation]"),
        "{fit}"
    );
    assert!(ran.stderr.contains("an imprint is left"), "{}", ran.stderr);
    let own = fit.replace(
        "frame_compliance = \"0 nm/mN\"",
        "frame_compliance = \"0.3 nm/mN\"",
    );
    let own = own.replace("poisson_ratio = 0.25  #", "poisson_ratio = 0.17  #");
    fs::write(folder.path("curve.toml"), own).unwrap();
    let ran = folder.run(&["identify", "curve.toml", "--json"]);
    let found: Value = serde_json::from_str(&ran.stdout).unwrap();
    let modulus = &found["indentation"][0]["indentation_modulus"]["value"];
    // The file has 72 GPa.
    assert!(
        (modulus.as_f64().unwrap() / 72e9 - 1.0).abs() < 0.01,
        "{found}"
    );
}

#[test]
fn templates_of_fits_run_with_their_curves() {
    for (kind, make) in [
        (
            "fit",
            &["identify", "a.toml", "--simulate", "--out", "curve.txt"][..],
        ),
        ("fit-afm", &["init", "approach", "--out", "approach.txt"]),
        (
            "fit-unloading",
            &["init", "indentation", "--out", "indentation.txt"],
        ),
    ] {
        let folder = TestFolder::new();
        assert_eq!(folder.run(&["init", kind, "--out", "a.toml"]).code, Some(0));
        let made = folder.run(make);
        assert_eq!(made.code, Some(0), "{}", made.stderr);
        let ran = folder.run(&["identify", "a.toml", "--json"]);
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    }
}
