//! Spring constants and radii that files state in their headers, used and compared by fit files.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use pellicle::input::span::Source;
use pellicle_identify::fit_file::{FitFile, FitSources, Measurements};
use pellicle_identify::measured::curve::MeasuredCurve;
use pellicle_identify::measured::data_table::DataTable;

/// A short curve of a cantilever whose header states its spring constant and its radius.
fn text(spring: &str, radius: &str) -> String {
    let rows = "0 0\n20 1\n50 3\n90 6\n140 10\n";
    format!("k (N/m): {spring}\nTip radius (um): {radius}\nz (nm) F (nN)\n{rows}")
}

/// A fit file in a folder with curves of these spring constants and radii.
fn fit(
    folder: &Path,
    indenter: &str,
    rest: &str,
    curves: &[(&str, &str)],
) -> Result<FitFile, String> {
    for (index, (spring, radius)) in curves.iter().enumerate() {
        fs::write(folder.join(format!("{index}.txt")), text(spring, radius))
            .map_err(|error| error.to_string())?;
    }
    let toml = format!(
        "[model]\nfoundation = {{ substrate = {{ young_modulus = \"1 kPa\", poisson_ratio = 0.5 }} }}\n\
         indenter = {{ kind = \"sphere\"{indenter} }}\n\
         [[data]]\nfile = \"*.txt\"\ncolumns = {{ height = \"z\", force = \"F\" }}\n{rest}\n"
    );
    let source = Arc::new(Source::new("fit.toml", toml));
    let sources = FitSources::in_folder(folder);
    FitFile::parse(&source, "fit", &sources, Measurements::Required)
        .map_err(|error| error.to_string())
}

const MODULUS: &str =
    "[unknown]\n\"foundation.substrate.young_modulus\" = { from = \"1 Pa\", to = \"1 MPa\" }";

/// What the comparison of the radius of a fit file with those of its files says.
fn compared(file: &FitFile) -> Result<(), String> {
    let curves = MeasuredCurve::read_all(&file.data[0]).map_err(|error| error.to_string())?;
    let compare = |curve| file.refuse_other_radius(0, curve);
    let mut compared = curves.iter().map(compare);
    compared
        .find(Result::is_err)
        .unwrap_or(Ok(()))
        .map_err(|error| error.to_string())
}

#[test]
fn a_model_without_a_radius_has_that_of_the_files_if_they_agree() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = fit(folder.path(), "", MODULUS, &[("0.1", "5"), ("0.1", "5.02")]).expect("a fit");
    let stated = file.stated_radius.as_ref().expect("a radius");
    // One rounding of a product with the unit.
    assert!((stated.value - 5e-6).abs() < 1e-20);
    let parameters = file.model.parameters().expect("a model");
    let radius = parameters.radius().and_then(|of| parameters.value(of));
    assert!((radius.expect("a radius") - 5e-6).abs() < 1e-20);
    assert_eq!(compared(&file), Ok(()));
    let spring = file.data[0].spring_constant.expect("a spring constant");
    assert!((spring.mean - 0.1).abs() < 1e-17 && spring.sd.is_none());
    let other = fit(folder.path(), "", MODULUS, &[("0.1", "5"), ("0.1", "6")]);
    let found = other.expect_err("two radii");
    assert!(
        found.contains("key `data[0].file`") && found.contains("radii of 5.0000e-6 and 6.0000e-6"),
        "{found}"
    );
}

#[test]
fn files_of_one_table_with_two_spring_constants_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let curves = [("0.1", "5"), ("0.2", "5")];
    let found = fit(folder.path(), "", MODULUS, &curves).expect_err("two constants");
    assert!(
        found.contains("found 1.0000e-1 N/m, and 2.0000e-1 N/m in line 1")
            && found.contains("1.txt"),
        "{found}"
    );
}

#[test]
fn a_radius_is_compared_unless_it_is_sought_or_a_bare_number() {
    let folder = tempfile::tempdir().expect("a folder");
    let with = |indenter: &str, rest: &str| {
        let file = fit(folder.path(), indenter, rest, &[("0.1", "5")]).expect("a fit");
        compared(&file)
    };
    let other = ", radius = \"4 um\"";
    let found = with(other, MODULUS).expect_err("another radius");
    assert!(found.contains("key `model.indenter.radius`"), "{found}");
    assert_eq!(with(", radius = \"4.97 um\"", MODULUS), Ok(()));
    assert_eq!(with(", radius = 4e-6", MODULUS), Ok(()));
    let sought = "[unknown]\n\"indenter.radius\" = { from = \"1 um\", to = \"20 um\" }";
    assert_eq!(with(other, sought), Ok(()));
    // A table with a radius of its own is compared there.
    let set = |radius: &str| format!("set = {{ \"indenter.radius\" = {radius} }}\n{MODULUS}");
    assert_eq!(with(other, &set("\"5 um\"")), Ok(()));
    let found = with(other, &set("\"3 um\"")).expect_err("another radius");
    assert!(found.contains("key `data[0].set`"), "{found}");
}

#[test]
fn a_table_read_alone_takes_the_spring_constant_over() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("0.txt"), text("0.1", "5")).expect("a file");
    let table = "[[data]]\nfile = \"0.txt\"\ncolumns = { height = \"z\", force = \"F\" }\n";
    let source = Arc::new(Source::new("fit.toml", table.to_owned()));
    let tables = DataTable::parse_all(&source, folder.path()).expect("a table");
    let curve = &MeasuredCurve::read_all(&tables[0]).expect("a curve")[0];
    // δ = z − F/k = 140 nm − 10 nN/(0.1 N/m), rounded a few times at 1e-7 m.
    let depth = curve.depth().expect("a depth");
    assert!((depth[4] - 40e-9).abs() < 1e-21);
    let codes: Vec<_> = curve.warnings.iter().map(|warning| warning.code).collect();
    assert!(codes.contains(&"stated-spring-constant"), "{codes:?}");
}
