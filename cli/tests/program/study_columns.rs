//! The columns of a study's table present only for some of its cases.

use std::collections::BTreeMap;
use std::fs;

use super::runner::TestFolder;

/// A bare surface, a rough one, and one with a hardness.
const MIXED: &str = r#"
[study]
combine = "zip"
[study.vary]
surface = [{ kind = "bare" }, { kind = "rough", file = "rough.npy", side = "40 um" }, { kind = "bare" }]
solver = [{}, {}, { hardness = "20 MPa" }]
[foundation]
substrate = { young_modulus = "3 GPa", poisson_ratio = 0.35 }
[indenter]
kind = "sphere"
radius = "0.5 mm"
[load]
force = "2 mN"
[grid]
elements = 64
side = "30 um"
"#;

/// The rows of a table, each with its cells by column name.
fn rows(text: &str) -> Vec<BTreeMap<String, String>> {
    let mut table = csv::Reader::from_reader(text.as_bytes());
    table.deserialize().map(Result::unwrap).collect()
}

#[test]
fn each_case_fills_only_the_columns_of_its_own_curve() {
    let folder = TestFolder::with_case(MIXED);
    let surface = [
        "surface",
        "--out",
        "rough.npy",
        "--side",
        "40 um",
        "--rms",
        "20 nm",
        "--size",
        "64",
    ];
    assert_eq!(folder.run(&surface).code, Some(0));
    let ran = folder.run(&["study", "case.toml", "--quiet", "--folders"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let read =
        |name: &str| fs::read_to_string(folder.path(&format!("results/case/{name}"))).unwrap();
    let table = rows(&read("results.csv"));
    assert_eq!(table.len(), 3);
    let further = [
        "area at hardness [m^2]",
        "area fraction at hardness",
        "plastic depth [m]",
        "contact fraction",
        "mean gap [m]",
        "islands",
        "corrected contact area [m^2]",
    ];
    let mut filled = Vec::new();
    for (i, row) in table.iter().enumerate() {
        let curve = &rows(&read(&format!("cases/case-{:04}/curve.csv", i + 1)))[0];
        for (name, cell) in curve {
            assert_eq!(row.get(name), Some(cell), "case {}, {name}", i + 1);
        }
        filled.push(
            further
                .iter()
                .filter(|name| !row[**name].is_empty())
                .count(),
        );
        let is_own = |name: &&&str| curve.contains_key(**name);
        assert_eq!(filled[i], further.iter().filter(is_own).count());
    }
    assert_eq!(filled, [0, 4, 3]);
}
