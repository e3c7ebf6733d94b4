//! The kernel and the coefficients that the program prints are those of the crates.

use pellicle_tests::paper::figure_2;
use serde_json::Value;

use crate::runner::run;

const FIG2D: &str = include_str!("../../../cases/fig2d.toml");

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
