//! `run` and `plot`: the results folder, complete or not at all.

use std::fs;

use ndarray::{Array1, Array2};
use ndarray_npy::NpzReader;
use serde_json::Value;

use super::runner::{CASE, TestFolder, names};

/// The files of a run of one step.
const FILES: [&str; 12] = [
    "convergence.png",
    "convergence.svg",
    "curve.csv",
    "fields-000.npz",
    "pressure-000.png",
    "pressure-000.svg",
    "pressure-3d-000.png",
    "pressure-3d-000.svg",
    "report.html",
    "section-000.png",
    "section-000.svg",
    "summary.json",
];

#[test]
fn a_run_writes_a_folder_named_after_the_case_and_the_next_is_numbered() {
    let folder = TestFolder::with_case(CASE);
    for _ in 0..2 {
        let ran = folder.run(&["run", "case.toml"]);
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        assert_eq!(ran.stdout, "");
    }
    assert_eq!(names(&folder.path("results")), ["case", "case-2"]);
    for name in ["case", "case-2"] {
        assert_eq!(names(&folder.path("results").join(name)), FILES);
    }
}

#[test]
fn a_results_folder_is_replaced_only_with_force() {
    let folder = TestFolder::with_case(CASE);
    let run = |more: &[&str]| folder.run(&[&["run", "case.toml", "--out", "a"], more].concat());
    assert_eq!(run(&[]).code, Some(0));
    let old = fs::read(folder.path("a/summary.json")).unwrap();
    let refused = run(&[]);
    assert_eq!(refused.code, Some(2));
    assert!(refused.stderr.contains("--force"), "{}", refused.stderr);
    assert_eq!(fs::read(folder.path("a/summary.json")).unwrap(), old);
    assert_eq!(run(&["--force", "--set", "title=again"]).code, Some(0));
    assert!(
        fs::read_to_string(folder.path("a/summary.json"))
            .unwrap()
            .contains("again")
    );
    assert_eq!(folder.names(), ["a", "case.toml"]);
}

#[test]
fn a_folder_of_another_origin_is_never_replaced() {
    let folder = TestFolder::with_case(CASE);
    let ran = folder.run(&["run", "case.toml", "--out", ".", "--force"]);
    assert_eq!(ran.code, Some(2), "{}", ran.stderr);
    assert_eq!(folder.names(), ["case.toml"]);
}

#[test]
fn an_unconverged_result_is_written_and_marked() {
    let folder = TestFolder::with_case(CASE);
    // The smallest force that a number can hold: divided over the elements it underflows.
    let ran = folder.run(&[
        "run",
        "case.toml",
        "--out",
        "a",
        "--set",
        "load.force=5e-324 N",
    ]);
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    assert!(ran.stderr.contains("not converged"), "{}", ran.stderr);
    assert_eq!(names(&folder.path("a")), FILES);
    let summary = folder.summary("a");
    assert_eq!(summary["steps"][0]["certificate"]["satisfied"], false);
}

#[test]
fn a_contact_cut_off_by_the_domain_is_written_and_marked() {
    let folder = TestFolder::with_case(CASE);
    let side = "grid.side=40 nm";
    let ran = folder.run(&["run", "case.toml", "--out", "a", "--set", side]);
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    assert!(ran.stderr.contains("cut off"), "{}", ran.stderr);
    let summary = folder.summary("a");
    let step = &summary["steps"][0];
    assert_eq!(step["certificate"]["satisfied"], true);
    assert_eq!(
        (&step["status"], &summary["status"]),
        (&"cut-off".into(), &"cut-off".into())
    );
    let page = fs::read_to_string(folder.path("a/report.html")).unwrap();
    assert!(page.contains("Cut off:"));
}

#[test]
fn json_alone_prints_the_summary_and_writes_nothing() {
    let folder = TestFolder::with_case(CASE);
    let ran = folder.run(&["run", "case.toml", "--json"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert_eq!(folder.names(), ["case.toml"]);
    let summary: Value = serde_json::from_str(&ran.stdout).unwrap();
    let keys: Vec<_> = summary.as_object().unwrap().keys().collect();
    let wanted = [
        "schema", "program", "version", "title", "case", "status", "grid", "steps", "timing",
        "warnings",
    ];
    assert_eq!(keys, wanted);
    assert_eq!(summary["case"]["foundation"]["layer"][0]["thickness"], 1e-8);
    assert_eq!(summary["grid"]["elements"], 32);
    assert_eq!(summary["steps"][0]["certificate"]["satisfied"], true);
}

#[test]
fn quiet_is_silent_and_json_with_a_folder_does_both() {
    let folder = TestFolder::with_case(CASE);
    let ran = folder.run(&["run", "case.toml", "--quiet"]);
    assert_eq!(
        (ran.code, ran.stdout.as_str(), ran.stderr.as_str()),
        (Some(0), "", "")
    );
    let ran = folder.run(&["run", "case.toml", "--json", "--out", "b"]);
    assert_eq!(
        ran.stdout,
        fs::read_to_string(folder.path("b/summary.json")).unwrap()
    );
}

#[test]
fn the_curve_has_units_in_its_header_and_one_row_per_step() {
    let folder = TestFolder::with_case(CASE);
    let ran = folder.run(&[
        "run",
        "case.toml",
        "--out",
        "a",
        "--set",
        "load={forces=[\"1 uN\", \"2 uN\", \"4 uN\"]}",
    ]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let curve = fs::read_to_string(folder.path("a/curve.csv")).unwrap();
    let lines: Vec<_> = curve.lines().collect();
    assert!(
        lines[0].starts_with("step,force [N],force error [N],force resolved,penetration [m],"),
        "{curve}"
    );
    assert_eq!(lines.len(), 4);
    let columns = |line: &str| line.split(',').count();
    assert!(
        lines.iter().all(|line| columns(line) == columns(lines[0])),
        "{curve}"
    );
    let names = names(&folder.path("a"));
    for name in [
        "curve.png",
        "curve.svg",
        "section-002.png",
        "fields-002.npz",
    ] {
        assert!(names.contains(&name.to_owned()), "{name} in {names:?}");
    }
}

#[test]
fn the_fields_are_arrays_of_the_grid() {
    let folder = TestFolder::with_case(CASE);
    folder.run(&["run", "case.toml", "--out", "a"]);
    let mut npz = NpzReader::new(fs::File::open(folder.path("a/fields-000.npz")).unwrap()).unwrap();
    let x: Array1<f64> = npz.by_name("x").unwrap();
    assert_eq!(
        (
            x.len(),
            npz.by_name::<ndarray::OwnedRepr<f64>, ndarray::Ix1>("y")
                .unwrap()
        ),
        (32, x)
    );
    for name in ["pressure", "displacement", "gap", "shortening", "profile"] {
        let field: Array2<f64> = npz.by_name(name).unwrap();
        assert_eq!(field.dim(), (32, 32), "{name}");
    }
    let mask: Array2<bool> = npz.by_name("mask").unwrap();
    let pressure: Array2<f64> = npz.by_name("pressure").unwrap();
    // A cylinder stands on the axis and carries pressure.
    assert!(mask[[16, 16]] && pressure[[16, 16]] > 0.0);
    let contact: Array2<bool> = npz.by_name("contact").unwrap();
    assert_eq!(contact, pressure.mapv(|pressure| pressure > 0.0));
    assert_ne!(contact, mask);
    let area = (400e-9_f64 / 32.0).powi(2);
    // The force agrees within the certificate's tolerance.
    assert!((pressure.sum() * area / 1e-6 - 1.0).abs() < 1e-8);
}

#[test]
fn pictures_are_redrawn_from_the_files_alone() {
    let folder = TestFolder::with_case(CASE);
    folder.run(&["run", "case.toml", "--out", "a"]);
    let pictures = || {
        let names = FILES
            .iter()
            .filter(|name| ["png", "svg", "html"].iter().any(|end| name.ends_with(end)));
        let read = |name: &&str| {
            (
                name.to_string(),
                fs::read(folder.path("a").join(name)).unwrap(),
            )
        };
        names.map(read).collect::<Vec<_>>()
    };
    let before = pictures();
    for (name, _) in &before {
        fs::remove_file(folder.path("a").join(name)).unwrap();
    }
    assert_eq!(folder.run(&["plot", "a"]).code, Some(0));
    assert!(pictures() == before, "the pictures drawn again are others");
    fs::write(folder.path("a/fields-000.npz"), "damaged").unwrap();
    let ran = folder.run(&["plot", "a"]);
    assert_eq!(ran.code, Some(2));
    assert!(ran.stderr.contains("fields-000.npz"), "{}", ran.stderr);
}

#[test]
fn the_report_is_self_contained_and_shows_warnings() {
    let folder = TestFolder::with_case(CASE);
    folder.run(&[
        "run",
        "case.toml",
        "--out",
        "a",
        "--set",
        "title=<b>5 & 6</b>",
    ]);
    let page = fs::read_to_string(folder.path("a/report.html")).unwrap();
    // The namespace of SVG is the only address on the page, and nothing is fetched from it.
    let addresses = page.replace("http://www.w3.org/2000/svg", "");
    assert!(!addresses.contains("http:") && !addresses.contains("https:"));
    assert!(page.contains("<title>&#60;b&#62;5 &#38; 6&#60;/b&#62;</title>"));
    let summary = folder.summary("a");
    let warnings = summary["warnings"].as_array().unwrap();
    assert!(!warnings.is_empty());
    for warning in warnings {
        let message = warning["message"].as_str().unwrap();
        let shown = message.replace('`', "");
        let page = page.replace("<code>", "").replace("</code>", "");
        assert!(page.contains(&shown), "{warning}");
    }
    assert!(page.contains("an <code>edge_radius</code> of the texture"));
    assert!(page.contains("Satisfied: the worst of these"));
}
