//! The program's numbers are those of the crates called directly, to the bit.

use pellicle_contact::{Domain, Load, SolverOptions, Step, solve_path};
use pellicle_tests::scene::figure_2;
use serde_json::Value;

use super::run;

/// Two of the paper's cases that are also test scenes.
const FIG2C: &str = include_str!("../../../cases/fig2c.toml");
const FIG2D: &str = include_str!("../../../cases/fig2d.toml");

fn by_program(case: &str, sets: &[&str]) -> Value {
    let sets = sets.iter().flat_map(|set| ["--set", *set]);
    let arguments: Vec<_> = ["run", "case.toml", "--json"]
        .into_iter()
        .chain(sets)
        .collect();
    let ran = run(case, &arguments);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    ran.json()
}

fn by_library(elements: usize) -> Step {
    let [_, _, panel, _] = figure_2();
    let (domain, options) = (Domain::Side(panel.side), SolverOptions::default());
    let path = solve_path(
        &panel.model,
        domain,
        elements,
        &[panel.load],
        &options,
        &mut (),
    );
    path.unwrap().steps.remove(0)
}

fn assert_same(step: &Value, key: &str, wanted: f64) {
    let found = step[key].as_f64().unwrap();
    assert_eq!(
        found.to_bits(),
        wanted.to_bits(),
        "{key}: {found:e}, {wanted:e}"
    );
}

#[test]
fn a_case_of_the_paper_gives_the_librarys_numbers_to_the_bit() {
    let summary = by_program(FIG2C, &["grid.elements=96"]);
    let (found, wanted) = (&summary["steps"][0], by_library(96));
    assert_same(found, "penetration", wanted.solution.penetration);
    assert_same(found, "force", wanted.solution.force);
    assert_same(found, "max_pressure", wanted.summary.max_pressure);
    assert_same(found, "contact_area", wanted.summary.contact_area);
    let between = wanted.summary.contact_area_between;
    assert_same(found, "contact_area_between", between);
    let certificate = &wanted.solution.certificate;
    assert_same(&found["certificate"], "worst", certificate.worst());
    let products = wanted.work.operator_applications as u64;
    assert_eq!(
        found["work"]["operator_applications"].as_u64(),
        Some(products)
    );
    let error = wanted.grid_error.penetration.unwrap();
    assert_same(
        &found["grid_error"]["penetration"],
        "estimate",
        error.estimate,
    );
}

#[test]
fn units_change_the_names_but_not_the_solution() {
    // R = 2 mm, E1 = 3 GPa: lengths times 2e-3 m, forces times 3e9 · 4e-6 N = 12 kN.
    let in_units = "
[foundation]
substrate = { young_modulus = \"30 GPa\", poisson_ratio = 0.3 }
[[foundation.layer]]
thickness = \"0.2 um\"
young_modulus = \"3 GPa\"
poisson_ratio = 0.4
[surface]
kind = \"cylinders\"
radius = \"10 um\"
height = \"0.2 um\"
period = \"25 um\"
[indenter]
kind = \"paraboloid\"
radius = \"2 mm\"
[load]
force = \"2.57112 N\"
[grid]
side = \"0.24 mm\"
elements = 96
";
    let [plain, in_units] = [
        by_program(FIG2C, &["grid.elements=96"]),
        by_program(in_units, &[]),
    ];
    let depth = |summary: &Value| summary["steps"][0]["penetration"].as_f64().unwrap();
    // The certificate's 1e-8.
    assert!((depth(&in_units) / 2e-3 / depth(&plain) - 1.0).abs() < 1e-7);
}

#[test]
fn a_result_that_is_not_certified_has_exit_code_one_and_a_load_of_zero_two() {
    // The smallest representable force: spread over the elements it underflows.
    let no_number = ["run", "case.toml", "--json", "--set", "load.force=5e-324"];
    let ran = run(FIG2C, &no_number);
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    let certificate = &ran.json()["steps"][0]["certificate"];
    assert_eq!(certificate["satisfied"], false);
    let no_load = ["run", "case.toml", "--json", "--set", "load.force=0"];
    let ran = run(FIG2C, &no_load);
    assert_eq!((ran.code, ran.stdout.as_str()), (Some(2), ""));
}

#[test]
fn the_force_of_a_penetration_is_the_same_in_program_and_library() {
    let [_, _, panel, _] = figure_2();
    let load = [Load::Penetration(6e-4)];
    let (domain, options) = (Domain::Side(panel.side), SolverOptions::default());
    let path = solve_path(&panel.model, domain, 64, &load, &options, &mut ()).unwrap();
    let sets = ["grid.elements=64", "load={ penetration = 6e-4 }"];
    let summary = by_program(FIG2C, &sets);
    assert_same(&summary["steps"][0], "force", path.steps[0].solution.force);
}

fn rows(arguments: &[&str]) -> Vec<Value> {
    let ran = run(FIG2D, arguments);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    ran.json().as_array().unwrap().clone()
}

fn same(found: &Value, wanted: f64) -> bool {
    found.as_f64().unwrap().to_bits() == wanted.to_bits()
}

#[test]
fn the_printed_compliance_is_the_kernels_to_the_bit() {
    let [_, _, _, panel] = figure_2();
    let foundation = panel.model.tables.foundation();
    let line = [
        "kernel",
        "case.toml",
        "--json",
        "--wavenumber",
        "1",
        "1e4",
        "1e6",
    ];
    for (row, k) in rows(&line).iter().zip([1.0, 1e4, 1e6]) {
        assert!(same(&row["compliance"], foundation.compliance(k)), "{k}");
        assert!(same(&row["response"], foundation.response(k)), "{k}");
    }
}

#[test]
fn the_printed_coefficients_are_the_tables_to_the_bit() {
    let [_, _, _, panel] = figure_2();
    let line = [
        "influence",
        "case.toml",
        "--json",
        "--set",
        "grid.elements=128",
        "--offset",
        "0,0",
        "3,1",
        "90,40",
    ];
    let side = panel.side / 128.0;
    for (row, offset) in rows(&line).iter().zip([[0, 0], [3, 1], [90, 40]]) {
        let wanted = panel.model.tables.coefficient(side, offset);
        assert!(same(&row["coefficient"], wanted), "{offset:?}");
    }
}
