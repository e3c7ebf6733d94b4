//! Stresses in the summary, on the terminal and in tables; critical loads.

use std::f64::consts::PI;
use std::fs;

use serde_json::Value;

use super::runner::{CASE, TestFolder, keys};

/// Hertz's contact with R = 1, E/(1 − ν²) = 1 and a yield strength.
fn hertz(yield_strength: f64) -> String {
    format!(
        "[foundation]\nsubstrate = {{ young_modulus = 0.91, poisson_ratio = 0.3, yield_strength = {yield_strength:e} }}\n\
         [indenter]\nkind = \"paraboloid\"\nradius = 1\n[load]\nforces = [1e-4, 1e-3]\n[grid]\nelements = 64\n[stress]\n"
    )
}

/// Largest pressure under a force.
fn peak(force: f64) -> f64 {
    (6.0 * force).cbrt() / PI
}

fn summary(folder: &TestFolder, more: &[&str]) -> Value {
    folder
        .run(&[&["run", "case.toml", "--json"], more].concat())
        .json()
}

#[test]
fn a_half_space_yields_at_the_load_and_depth_of_hertz() {
    // Von Mises is 0.6200 p0 at 0.481 a for ν = 0.3 (Johnson 1985, §4.2).
    let force = 5e-4;
    let strength = 0.62 * peak(force);
    let folder = TestFolder::with_case(hertz(strength));
    let summary = summary(&folder, &[]);
    for step in summary["steps"].as_array().unwrap() {
        let (force, stress) = (step["force"].as_f64().unwrap(), &step["stress"]);
        assert_eq!(
            keys(stress),
            ["friction", "direction_degrees", "bodies", "interfaces"]
        );
        let body = &stress["bodies"][0];
        assert_eq!(body["name"], "substrate");
        let (found, used) = (&body["max_von_mises"], &body["utilisation"]);
        assert_eq!(keys(found), ["value", "at", "resolved", "estimate"]);
        let [value, depth] =
            [&found["value"], &found["at"][2]].map(|value| value.as_f64().unwrap());
        // Grid error with ten to twenty elements in the radius.
        assert!((value / (0.62 * peak(force)) - 1.0).abs() < 5e-3, "{value}");
        let radius = (0.75 * force).cbrt();
        assert!(
            (depth / radius / 0.481 - 1.0).abs() < 0.05,
            "{}",
            depth / radius
        );
        assert!((used["yield"].as_f64().unwrap() - value / strength).abs() < 1e-12);
        assert!(used["tension"].is_null());
    }
    let critical = summary["critical"].as_array().unwrap();
    assert_eq!(critical.len(), 1);
    let load = &critical[0];
    assert_eq!(
        (&load["criterion"], &load["name"]),
        (&"yield".into(), &"substrate".into())
    );
    // The strength is proportional to the cube root of the force, so its error counts three times.
    let found = load["force"].as_f64().unwrap();
    assert!((found / force - 1.0).abs() < 1.5e-2, "{found}");
    assert!((load["utilisation"].as_f64().unwrap() - 1.0).abs() < 1e-4);
}

#[test]
fn stresses_are_listed_by_body_and_interface_and_strengths_in_sentences() {
    let strengths =
        "poisson_ratio = 0.3\nyield_strength = \"100 GPa\"\ninterface_shear_strength = \"1 MPa\"";
    let text = CASE.replace("poisson_ratio = 0.3", strengths);
    let folder = TestFolder::with_case(format!(
        "{text}\n[stress]\nfriction = 0.2\ndirection = \"90 deg\"\n"
    ));
    let ran = folder.run(&[
        "run",
        "case.toml",
        "--out",
        "a",
        "--pictures",
        "none",
        "--fields",
        "none",
    ]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let summary = folder.summary("a");
    let stress = &summary["steps"][0]["stress"];
    assert_eq!(
        (
            stress["friction"].as_f64(),
            stress["direction_degrees"].as_f64()
        ),
        (Some(0.2), Some(90.0))
    );
    let names: Vec<_> = stress["bodies"]
        .as_array()
        .unwrap()
        .iter()
        .map(|body| body["name"].clone())
        .collect();
    assert_eq!(names, ["layer[0]", "substrate"]);
    let interface = &stress["interfaces"][0];
    let wanted = [
        "name",
        "index",
        "depth",
        "max_shear_traction",
        "max_tension",
        "max_compression",
        "utilisation",
    ];
    assert_eq!(keys(interface), wanted);
    assert_eq!(interface["depth"], 1e-8);
    assert_eq!(
        interface["max_shear_traction"]["at"]
            .as_array()
            .unwrap()
            .len(),
        2
    );
    for words in [
        "stress in layer[0]",
        "stress on interface 0",
        "of the shear strength",
        "the interface fails in shear at ",
        "the coating yields under no load up to 1.0000 µN: ",
    ] {
        assert!(ran.stderr.contains(words), "{words} in {}", ran.stderr);
    }
    let curve = fs::read_to_string(folder.path("a/curve.csv")).unwrap();
    let header = curve.lines().next().unwrap();
    let columns = [
        "max von Mises layer[0] [Pa],max von Mises layer[0] error [Pa],max von Mises layer[0] resolved",
        "max shear traction interface[0] [Pa],max shear traction interface[0] error [Pa]",
    ];
    assert!(
        columns.iter().all(|column| header.contains(column)),
        "{header}"
    );
    let cells: Vec<_> = curve.lines().nth(1).unwrap().split(',').collect();
    let column = |name: &str| {
        let place = header.split(',').position(|column| column == name);
        cells[place.unwrap_or_else(|| panic!("{name} in {header}"))]
    };
    // The same numbers as in the summary.
    let found = &stress["bodies"][1]["max_von_mises"];
    let [value, error] = ["", " error"].map(|what| {
        let cell = column(&format!("max von Mises substrate{what} [Pa]"));
        cell.parse::<f64>().ok()
    });
    assert_eq!(value, found["value"].as_f64());
    let resolved = found["resolved"].as_bool().unwrap();
    assert_eq!(error, found["estimate"].as_f64().filter(|_| resolved));
    assert_eq!(
        column("max von Mises substrate resolved"),
        resolved.to_string()
    );
    assert_eq!(
        column("critical force yield layer[0] status"),
        "not-reached"
    );
    assert_eq!(column("critical force yield layer[0] [N]"), "");
    assert_eq!(column("critical force shear interface[0] status"), "met");
}

#[test]
fn without_a_stress_table_no_stresses_are_computed() {
    let folder = TestFolder::with_case(CASE);
    let summary = summary(&folder, &[]);
    assert!(summary["steps"][0].get("stress").is_none() && summary.get("critical").is_none());
}

#[test]
fn a_study_varies_friction_and_strength_and_has_critical_loads_as_columns() {
    let study = hertz(0.1)
        .replace("forces = [1e-4, 1e-3]", "force = 1e-3")
        .replace("elements = 64", "elements = 32")
        + "[study.vary]\nstress.friction = [0.0, 0.4]\n\"foundation.substrate.yield_strength\" = [0.02, 0.03]\n";
    let folder = TestFolder::with_case(study);
    let ran = folder.run(&["study", "case.toml", "--quiet"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let table = fs::read_to_string(folder.path("results/case/results.csv")).unwrap();
    let mut lines = table
        .lines()
        .map(|line| line.split(',').collect::<Vec<_>>());
    let header = lines.next().unwrap();
    let column = |name: &str| {
        header
            .iter()
            .position(|found| found.starts_with(name))
            .unwrap()
    };
    let [critical, mises, friction] = [
        "critical force yield substrate [",
        "max von Mises substrate [",
        "stress.friction",
    ]
    .map(column);
    let rows: Vec<_> = lines.collect();
    assert_eq!(rows.len(), 4);
    let of = |row: usize, column: usize| rows[row][column].parse::<f64>().unwrap();
    assert_eq!([0, 2].map(|row| rows[row][friction]), ["0e0", "4e-1"]);
    // 3/2 of the strength takes the cube of that ratio in force.
    assert!((of(1, critical) / of(0, critical) / 1.5_f64.powi(3) - 1.0).abs() < 0.03);
    // The strength does not affect the stress; friction does, and lowers the critical load.
    assert!((of(0, mises) / of(1, mises) - 1.0).abs() < 1e-12);
    assert!(of(2, mises) > of(0, mises) && of(2, critical) < of(0, critical));
}

#[test]
fn check_and_list_tell_the_time_of_stresses_in_advance() {
    let folder = TestFolder::with_study(
        hertz(1.0),
        &(hertz(1.0) + "[study.vary]\nstress.friction = [0.0, 0.1, 0.2]\n"),
    );
    let checked = folder.run(&["check", "case.toml"]).stdout;
    for line in [
        "# CPU time of stresses, about ",
        "# CPU time of critical loads, about ",
    ] {
        assert!(checked.contains(line), "{checked}");
    }
    let listed = folder.run(&["study", "many.toml", "--list"]);
    let words = "of CPU time, by the forecast of 3 of 3 cases";
    assert!(listed.stderr.contains(words), "{}", listed.stderr);
    assert_eq!(listed.stdout.lines().count(), 3);
}

#[test]
fn only_the_wanted_stresses_are_in_the_results() {
    let folder = TestFolder::with_case(format!(
        "{CASE}\n[stress]\nonly = [\"max_tension\", \"max_shear\"]\n"
    ));
    let flags = ["--formats", "npz", "--out", "a"];
    let ran = folder.run(&[&["run", "case.toml"][..], &flags].concat());
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let summary = folder.summary("a");
    assert_eq!(
        summary["case"]["stress"]["only"],
        serde_json::json!(["max_shear", "max_tension"])
    );
    let stress = &summary["steps"][0]["stress"];
    for body in stress["bodies"].as_array().unwrap() {
        assert_eq!(keys(body), ["name", "max_shear", "utilisation"]);
    }
    let wanted = ["name", "index", "depth", "max_tension", "utilisation"];
    assert_eq!(keys(&stress["interfaces"][0]), wanted);
    let curve = fs::read_to_string(folder.path("a/curve.csv")).unwrap();
    let header = curve.lines().next().unwrap();
    for (name, is_there) in [
        ("max shear layer[0] [Pa]", true),
        ("max tension interface[0] [Pa]", true),
        ("max von Mises", false),
        ("principal", false),
        ("max shear traction", false),
        ("compression", false),
    ] {
        assert_eq!(header.contains(name), is_there, "{name} in {header}");
    }
    assert!(
        curve
            .lines()
            .all(|row| row.split(',').count() == header.split(',').count())
    );
    let report = fs::read_to_string(folder.path("a/report.html")).unwrap();
    assert!(report.contains("largest tension") && !report.contains("largest compression"));
    assert!(!report.contains("<td>largest von Mises stress"));
    // A key of the command line is one of the file.
    let set = "stress.only=[\"max_sheer\"]";
    let refused = folder.run(&["run", "case.toml", "--set", set]);
    assert_eq!(refused.code, Some(2));
    let hint = "did you mean \"max_shear\"?";
    assert!(refused.stderr.contains(hint), "{}", refused.stderr);
}

#[test]
fn a_strength_that_is_not_reached_is_told_from_one_that_is_not_given() {
    // Under 1e-3 the largest pressure is 0.058, and von Mises' stress 0.036: 0.02 is met, 100 is not.
    let body = |more: &str| format!("{{ young_modulus = 0.91, poisson_ratio = 0.3{more} }}");
    let layer =
        "{ thickness = 0.05, young_modulus = 0.91, poisson_ratio = 0.3, yield_strength = 100 }";
    let bodies = ["", ", yield_strength = 0.02", ", yield_strength = 100"].map(body);
    let study = hertz(0.1).replace("forces = [1e-4, 1e-3]", "force = 1e-3")
        + &format!(
            "[study.vary]\n\"foundation.substrate\" = [{}]\n\"foundation.layer\" = [[], [{layer}]]\n",
            bodies.join(", ")
        );
    let folder = TestFolder::with_case(study);
    let ran = folder.run(&["study", "case.toml", "--quiet"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let table = folder.path("results/case/results.csv");
    let mut reader = csv::Reader::from_path(table).unwrap();
    let header = reader.headers().unwrap().clone();
    let rows: Vec<_> = reader.records().map(Result::unwrap).collect();
    let column = |name: &str| -> Vec<String> {
        let place = header.iter().position(|column| column == name);
        let place = place.unwrap_or_else(|| panic!("{name} in {header:?}"));
        rows.iter().map(|row| row[place].to_owned()).collect()
    };
    let of_base = "critical force yield substrate";
    let statuses = ["", "", "met", "met", "not-reached", "not-reached"];
    assert_eq!(column(&format!("{of_base} status")), statuses);
    let statuses = ["", "not-reached"].repeat(3);
    assert_eq!(column("critical force yield layer[0] status"), statuses);
    let [forces, errors] =
        ["", " error"].map(|what| column(&format!("{of_base}{what} [case units]")));
    let resolved = column(&format!("{of_base} resolved"));
    for (i, force) in forces.iter().enumerate() {
        let is_met = (2..4).contains(&i);
        assert_eq!(force.is_empty(), !is_met, "{forces:?}");
        assert_eq!(
            errors[i].is_empty(),
            !is_met || resolved[i] != "true",
            "{errors:?}"
        );
    }
    assert_eq!(resolved[0], "");
    // The exact force of Hertz, (0.02/0.62 π)³/6, is within the interval.
    let exact = (0.02 / 0.62 * PI).powi(3) / 6.0;
    let [force, error] = [&forces[2], &errors[2]].map(|cell| cell.parse::<f64>().unwrap());
    assert!((force - exact).abs() < error, "{force} ± {error}, {exact}");
}

#[test]
fn unresolved_stresses_and_critical_loads_are_warned_of_by_name() {
    let messages = |case: String| {
        let folder = TestFolder::with_case(case);
        let summary = summary(&folder, &[]);
        let warnings = summary["warnings"].as_array().unwrap();
        let of = |code: &str| -> Vec<String> {
            let coded = warnings.iter().filter(|warning| warning["code"] == code);
            coded
                .map(|warning| warning["message"].as_str().unwrap().to_owned())
                .collect()
        };
        (of("stress-not-resolved"), of("critical-load-not-resolved"))
    };
    let case = hertz(0.1);
    let (stresses, loads) = messages(case.clone());
    assert!(
        stresses.is_empty() && loads.is_empty(),
        "{stresses:?} {loads:?}"
    );
    // At the rim of a punch all stresses grow with the grid.
    let punch = case.replace(
        "\"paraboloid\"\nradius = 1",
        "\"flat-punch\"\nradius = 0.05",
    );
    let (stresses, loads) = messages(punch);
    assert_eq!(stresses.len(), 2);
    assert!(
        stresses[1].starts_with(
            "step 1: stresses are not resolved by the grid: max_von_mises of substrate, "
        ),
        "{stresses:?}"
    );
    assert_eq!(
        loads,
        [
            "critical loads are not resolved by the grid, a finer one may move them: yield of substrate"
        ]
    );
}
