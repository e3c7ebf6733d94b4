//! Maps of rough bodies: the templates, and elements longer than the waves of a map.

use super::runner::TestFolder;

#[test]
fn the_rough_templates_and_their_map_run_unchanged() {
    let folder = TestFolder::new();
    for line in [
        &["init", "rough-map", "--out", "rough-surface.csv"][..],
        &["init", "rough", "--out", "rough.toml"],
        &["init", "rough-periodic", "--out", "periodic.toml"],
    ] {
        assert_eq!(folder.run(line).code, Some(0));
    }
    let ran = folder.run(&["run", "rough.toml", "--json"]);
    let warned = |code| {
        let summary = ran.json();
        summary["warnings"]
            .as_array()
            .unwrap()
            .iter()
            .any(|warning| warning["code"] == code)
    };
    assert!(!warned("coarse-map") && !warned("bare-number") && !warned("domain-edge"));
    let ran = folder.run(&[
        "run",
        "periodic.toml",
        "--json",
        "--set",
        "grid.elements=64",
    ]);
    let summary = ran.json();
    let codes = summary["warnings"].as_array().unwrap().iter();
    assert!(
        !codes
            .map(|warning| &warning["code"])
            .any(|code| code == "not-periodic-map")
    );
    for step in summary["steps"].as_array().unwrap() {
        let kappa = step["area_law"]["kappa"].as_f64().unwrap();
        // Between theories with √(8/π) and √(2π), with some islands of few elements.
        assert!((1.4..3.2).contains(&kappa), "{kappa}");
    }
}

/// A half-space under a nearly flat indenter, with a rough surface of 32 samples and waves down to two of them.
const ROUGH: &str = r#"[foundation]
substrate = { young_modulus = "70 GPa", poisson_ratio = 0.2 }
[surface]
kind = "rough"
file = "rough.npy"
side = "2.5 um"
[indenter]
kind = "paraboloid"
radius = "1 km"
[load]
force = "0.1 mN"
[grid]
elements = 16
side = "2.5 um"
boundary = "periodic"
"#;

#[test]
fn elements_longer_than_the_waves_of_a_rough_map_are_warned_of_and_nothing_is_claimed() {
    let folder = TestFolder::with_case(ROUGH);
    let made = folder.run(&[
        "surface",
        "--out",
        "rough.npy",
        "--side",
        "2.5 um",
        "--rms",
        "2.5 nm",
        "--size",
        "32",
        "--seed",
        "3",
    ]);
    assert_eq!(made.code, Some(0), "{}", made.stderr);
    let run = |elements: usize| {
        let set = format!("grid.elements={elements}");
        folder
            .run(&["run", "case.toml", "--json", "--set", &set])
            .json()
    };
    let numbers = [
        ("penetration", "penetration"),
        ("contact_area", "contact_area"),
        ("max_pressure", "max_pressure"),
    ];
    // Seven elements to a wave of two samples at 112; at 320, 20.
    let fine = run(320);
    let truth = |number: &str| fine["steps"][0][number].as_f64().unwrap();
    for elements in [16, 32, 64, 112] {
        let summary = run(elements);
        let step = &summary["steps"][0];
        let value = |number: &str| step[number].as_f64().unwrap();
        let warnings = summary["warnings"].as_array().unwrap();
        let warning = warnings
            .iter()
            .find(|warning| warning["code"] == "map-under-resolved");
        assert_eq!(warning.is_some(), elements < 80, "{elements}: {warnings:?}");
        let per_wave = step["grid_error"]["elements_per_wave"].as_f64().unwrap();
        // 97 % of the slopes are in waves longer than 2.0 to 2.5 samples of 32.
        let expected = elements as f64 / 32.0;
        assert!(
            (2.0 * expected..2.5 * expected).contains(&per_wave),
            "{per_wave}"
        );
        if let Some(warning) = warning {
            let message = warning["message"].as_str().unwrap();
            let wanted = (5.0 / per_wave * elements as f64).ceil();
            assert!(
                message.contains(&format!("which are {wanted} elements per side")),
                "{message}"
            );
        }
        for (number, error) in numbers {
            let error = &step["grid_error"][error];
            // A single grid of 16 elements has no error.
            let resolved = error["resolved"].as_bool().unwrap_or(false);
            assert!(
                !(resolved && warning.is_some()),
                "{elements}, {number}: {error}"
            );
            let apart = (value(number) - truth(number)).abs();
            assert!(
                !resolved || apart <= error["estimate"].as_f64().unwrap(),
                "{elements}, {number}: {apart:e}"
            );
        }
        // Force over area; and the force on a cell.
        assert!(value("mean_pressure") <= value("max_pressure"));
        assert!((value("mean_pressure") * value("contact_area") / 1e-4 - 1.0).abs() < 1e-12);
        assert!((value("nominal_pressure") * 6.25e-12 / 1e-4 - 1.0).abs() < 1e-12);
        let fraction = step["rough_contact"]["contact_fraction"].as_f64().unwrap();
        assert!(
            (value("nominal_pressure") / value("mean_pressure") / fraction - 1.0).abs() < 1e-12
        );
        assert!(step["rough_contact"]["pressures"].get("mean").is_none());
    }
}
