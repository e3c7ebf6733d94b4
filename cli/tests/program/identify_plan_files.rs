//! The files of a plan, invalid input, and the example of its page.

use std::fs;

use serde_json::Value;

use super::identify_plan::{E1, E2, MODEL, fit_file};
use super::runner::{TestFolder, names};

#[test]
fn a_plan_writes_a_complete_folder_of_its_own() {
    let folder = TestFolder::new();
    let more = "[report]\ndesign = { forces = [\"1 mN\"], radii = [\"1 um\", \"5 um\"] }";
    fs::write(folder.path("fit.toml"), fit_file(MODEL, &[E1, E2], more)).unwrap();
    let ran = folder.run(&["identify", "fit.toml", "--plan"]);
    assert_eq!(
        (ran.code, ran.stdout.as_str()),
        (Some(0), ""),
        "{}",
        ran.stderr
    );
    for text in [
        "R 1 µm, 0.01 to 1 mN",
        "± ",
        "E, layer 0",
        "results/fit-plan",
    ] {
        assert!(ran.stderr.contains(text), "{text}: {}", ran.stderr);
    }
    let results = folder.path("results/fit-plan");
    let files = [
        "plan-intervals.png",
        "plan-intervals.svg",
        "plan.csv",
        "plan.json",
    ];
    assert_eq!(names(&results), files);
    let read = |name: &str| fs::read_to_string(results.join(name)).unwrap();
    let plan: Value = serde_json::from_str(&read("plan.json")).unwrap();
    assert_eq!(plan["schema"], "pellicle-plan/1");
    // Each curve alone and both together, with two unknowns each.
    assert_eq!(read("plan.csv").lines().count(), 1 + 3 * 2);
    assert!(read("plan-intervals.svg").contains("Coating &amp; ball: what to measure"));
    // A second plan does not replace the first, unless forced.
    let again = folder.run(&["identify", "fit.toml", "--plan", "--quiet"]);
    assert_eq!(again.code, Some(0), "{}", again.stderr);
    assert!(folder.path("results/fit-plan-2/plan.json").is_file());
    let out = [
        "identify",
        "fit.toml",
        "--plan",
        "--quiet",
        "--out",
        "results/fit-plan",
    ];
    assert_eq!(folder.run(&out).code, Some(2));
    let forced = folder.run(&[&out[..], &["--force"]].concat());
    assert_eq!(forced.code, Some(0), "{}", forced.stderr);
    assert_eq!(names(&results), files);
    // With --json, no files are left.
    let ran = folder.run(&["identify", "fit.toml", "--plan", "--json"]);
    assert!(ran.stdout.starts_with('{'));
    assert_eq!(names(&folder.path("results")).len(), 2);
}

#[test]
fn a_bad_design_is_refused_in_one_sentence() {
    let folder = TestFolder::new();
    let cone = MODEL.replace(
        "\"paraboloid\", radius = \"10 um\"",
        "\"cone\", half_angle = \"70 deg\"",
    );
    let stiffness = "[[data]]\nfile = \"none.csv\"\ncolumns = { stiffness = 1, contact_radius = 2 }\n\
                     observe = \"stiffness at contact radius\"\n";
    let refusals = [
        (
            MODEL,
            "",
            "design = { force = [\"1 mN\"] }",
            "did you mean `forces`",
        ),
        (MODEL, "", "design = { forces = [\"1 um\"] }", "force"),
        (
            MODEL,
            "",
            "design = { forces = [\"1 mN\"], points = 2 }",
            "3 to 10000",
        ),
        (
            MODEL,
            "",
            "design = { radii = [\"1 um\"] }",
            "largest force",
        ),
        (MODEL, "", "level = 0.9", "largest force"),
        (
            &cone,
            "",
            "design = { forces = [\"1 mN\"], radii = [\"1 um\"] }",
            "no radius",
        ),
        (
            MODEL,
            stiffness,
            "design = { forces = [\"1 mN\"] }",
            "to plan",
        ),
        (
            MODEL,
            "",
            "design = { forces = { from = \"1 uN\", to = \"1 mN\", count = 60 }, radii = [\"1 um\", \"2 um\"] }",
            "at most 100 curves",
        ),
    ];
    for (model, data, report, said) in refusals {
        let more = format!("{data}[report]\n{report}");
        fs::write(folder.path("fit.toml"), fit_file(model, &[E1], &more)).unwrap();
        let ran = folder.run(&["identify", "fit.toml", "--plan", "--json"]);
        assert_eq!(
            (ran.code, ran.stdout.as_str()),
            (Some(2), ""),
            "{report}: {}",
            ran.stderr
        );
        assert!(ran.stderr.contains(said), "{report}: {}", ran.stderr);
        assert!(!ran.stderr.contains("panicked"), "{}", ran.stderr);
    }
    let ran = folder.run(&["identify", "fit.toml", "--plan", "--simulate", "--out", "a"]);
    assert_eq!(ran.code, Some(2));
}

/// The page of the documentation about planning.
const GUIDE: &str = include_str!("../../../docs/identification.md");

#[test]
fn the_documented_plan_gives_the_documented_output() {
    let folder = TestFolder::new();
    let blocks: Vec<_> = GUIDE.split("```").skip(1).step_by(2).collect();
    let after = |start: &str| {
        let found = blocks.iter().find_map(|block| block.split_once(start));
        found.unwrap().1
    };
    fs::write(
        folder.path("coating-design.toml"),
        after("# coating-design.toml\n"),
    )
    .unwrap();
    let ran = folder.run(&["identify", "coating-design.toml", "--plan"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let said = after("before any measurement: what to measure");
    // All lines except that with the time: two digits of sums in a fixed order.
    for line in said
        .lines()
        .skip(1)
        .filter(|line| !line.contains(" loads, "))
    {
        assert!(ran.stderr.contains(line), "{line}: {}", ran.stderr);
    }
}
