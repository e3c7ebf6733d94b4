//! `pellicle plot` of a study and of a search.

use std::fs;

use super::read_back::read_back;
use super::runner::TestFolder;

/// The largest force is beyond what the domain holds, so its cases are gaps.
const STUDY: &str = r#"
[study.vary]
load.force = { from = "0.1 N", to = "1 kN", count = 5, spacing = "log" }
indenter.radius = ["5 mm", "10 mm"]
[foundation]
substrate = { young_modulus = "206 GPa", poisson_ratio = 0.3 }
[indenter]
kind = "paraboloid"
[load]
[grid]
elements = 32
side = "400 um"
"#;

fn studied() -> TestFolder {
    let folder = TestFolder::with_case(STUDY);
    let ran = folder.run(&["study", "case.toml", "--quiet", "--tolerate-failures"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    folder
}

/// Width and pixels per metre of a PNG.
fn png(bytes: &[u8]) -> (u32, u32) {
    let number = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap());
    let physical = bytes.windows(4).position(|four| four == b"pHYs").unwrap();
    (number(16), number(physical + 4))
}

#[test]
fn a_study_is_drawn_for_paper_with_its_gaps_and_units() {
    let folder = studied();
    let ran = folder.run(&["plot", "results/case", "--width", "85", "--dpi", "600"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let read = |name: &str| fs::read(folder.path(&format!("results/case/{name}"))).unwrap();
    let svg = String::from_utf8(read("study-max_pressure.svg")).unwrap();
    for words in [
        "width=\"85mm\"",
        "load.force, ",
        "max pressure, ",
        "indenter.radius = 5 mm",
        "no certified result",
    ] {
        assert!(svg.contains(words), "{words}");
    }
    assert_eq!(png(&read("study-max_pressure.png")), (2008, 23622));
    let map = [
        "plot",
        "results/case",
        "--as",
        "map",
        "--result",
        "contact_area",
        "--format",
        "svg",
    ];
    assert_eq!(folder.run(&map).code, Some(0));
    let svg = String::from_utf8(read("study-contact_area.svg")).unwrap();
    assert!(svg.contains("of 10 cases: no certified result"), "{svg}");
    assert!(!folder.path("results/case/study-contact_area.png").exists());
    let two = [
        "plot",
        "results/case",
        "--result",
        "force",
        "--result",
        "penetration",
    ];
    assert_eq!(folder.run(&two).code, Some(0));
    assert!(
        folder
            .path("results/case/study-force-penetration.svg")
            .exists()
    );
}

/// Curves have lines, bars and letters, a map the raster of its colour bar; pdfium renders both as the PNG shows them.
#[test]
fn a_pdf_shows_what_the_png_shows_at_the_same_width_on_paper() {
    let folder = studied();
    for form in ["curves", "map"] {
        let ran = folder.run(&[
            "plot",
            "results/case",
            "--as",
            form,
            "--width",
            "85",
            "--dpi",
            "144",
            "--format",
            "pdf",
            "--format",
            "png",
        ]);
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        let picture = |ending| folder.path(&format!("results/case/study-max_pressure.{ending}"));
        read_back("pdfium_picture.py", &[picture("pdf"), picture("png")]);
    }
}

#[test]
fn what_a_study_does_not_have_is_told_in_a_sentence() {
    let folder = studied();
    let faults: [(&[&str], &str); 5] = [
        (
            &["--result", "max_presure"],
            "found --result no result `max_presure` of this case, wanted",
        ),
        (
            &["--over", "grid.elements"],
            "found --over grid.elements, wanted a key that varies: load.force, indenter.radius",
        ),
        (&["--over", "load.force"], "found 2 keys that vary"),
        (
            &[
                "--as",
                "map",
                "--result",
                "force",
                "--result",
                "penetration",
            ],
            "found 2 results, wanted one for a map",
        ),
        (&["--dpi", "5000"], "wanted pixels per inch from 50 to 1200"),
    ];
    for (options, wanted) in faults {
        let ran = folder.run(&[&["plot", "results/case"][..], options].concat());
        assert_eq!(ran.code, Some(2), "{options:?}");
        assert!(ran.stderr.contains(wanted), "{}", ran.stderr);
    }
}

#[test]
fn a_search_is_drawn_with_its_limit_and_answer() {
    let case = STUDY.split("[foundation]").nth(1).unwrap();
    let case = format!("[foundation]{case}")
        .replace("[load]", "radius = \"5 mm\"\n[load]\nforce = \"1 N\"");
    let folder = TestFolder::with_case(case);
    let ran = folder.run(&[
        "study",
        "case.toml",
        "--find",
        "contact_area < 1000 um^2",
        "--by",
        "load.force",
    ]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let ran = folder.run(&["plot", "results/case-find", "--format", "svg"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let svg = fs::read_to_string(folder.path("results/case-find/find.svg")).unwrap();
    for words in [
        "load.force, ",
        "contact area, µm²",
        "limit",
        "answer, with the interval",
    ] {
        assert!(svg.contains(words), "{words}");
    }
}
