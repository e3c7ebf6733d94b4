//! Runs of bodies that wear.

use super::runner::TestFolder;

const WORN: &str = r#"
[foundation]
substrate = { young_modulus = "210 GPa", poisson_ratio = 0.3 }
[surface]
kind = "film"
thickness = "1 um"
young_modulus = "3 GPa"
[indenter]
kind = "sphere"
radius = "3 mm"
[load]
force = "1 N"
[grid]
elements = 32
side = "200 um"
[wear]
coefficient = "1e-6 mm^3/Nm"
distances = ["0.5 m", "1 m"]
"#;

#[test]
fn a_run_with_wear_prints_distance_and_depth_and_its_checked_case_gives_the_same() {
    let folder = TestFolder::with_case(WORN);
    let ran = folder.run(&["run", "case.toml", "--out", "first"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let head = ran.stderr.lines().nth(2).unwrap();
    for name in ["sliding distance", "depth of wear", "max pressure"] {
        assert!(head.contains(&format!(" {name}")), "{head}");
    }
    assert!(ran.stderr.contains("500.00 mm") && ran.stderr.contains("1.0000 m"));
    let checked = folder.run(&["check", "case.toml"]).stdout;
    assert!(
        checked.contains("coefficient = \"1e-15 m^2/N\""),
        "{checked}"
    );
    std::fs::write(folder.path("checked.toml"), checked).unwrap();
    let again = folder.run(&["run", "checked.toml", "--out", "second"]);
    assert_eq!(again.code, Some(0), "{}", again.stderr);
    let worn = |results| folder.summary(results)["steps"][1]["wear"].clone();
    assert_eq!(worn("first"), worn("second"));
}
