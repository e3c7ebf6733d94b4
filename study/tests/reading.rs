//! Reading and planning of a study.

use super::*;

#[test]
fn a_product_changes_the_last_key_fastest_and_integers_stay_integers() {
    let study = study(TWO_KEYS).unwrap();
    assert_eq!(study.case_count(), 9);
    assert_eq!(
        study.words(0),
        "foundation.layer[0].thickness = 10 nm, grid.elements = 32"
    );
    assert_eq!(
        study.words(5),
        "foundation.layer[0].thickness = 20 nm, grid.elements = 128"
    );
    let case = study.case(5).unwrap();
    assert_eq!(
        (case.foundation.layer[0].thickness, case.grid.elements),
        (20e-9, 128)
    );
}

#[test]
fn zipped_values_are_taken_together() {
    let zipped = study(&TWO_KEYS.replace("[study]", "[study]\ncombine = \"zip\"")).unwrap();
    assert_eq!(zipped.case_count(), 3);
    assert_eq!(
        zipped.words(1),
        "foundation.layer[0].thickness = 20 nm, grid.elements = 64"
    );
}

#[test]
fn columns_of_a_sample_file_vary_together_and_combine_with_other_keys() {
    let text = "[study]\ncase = \"base.toml\"\n[study.vary]\ngrid.elements = [32, 64]\nfrom = \"samples.csv\"\n";
    let product = study(text).unwrap();
    assert_eq!((product.case_count(), product.varied_keys().len()), (6, 4));
    assert_eq!(
        product.words(4),
        "grid.elements = 64, indenter.radius = 4.0000 µm, foundation.layer[0].thickness = 12.000 nm, title = b"
    );
    let case = product.case(4).unwrap();
    assert_eq!(
        (case.foundation.layer[0].thickness, &*case.title),
        (12e-9, "b")
    );
    let radius = &product.varied_keys()[1];
    assert_eq!(
        (radius.heading().as_str(), &*radius.cell(1)),
        ("indenter.radius [m]", "4e-6")
    );
    // The same as from a list of these values.
    let listed = "[study]\ncase = \"base.toml\"\n[study.vary]\nindenter.radius = [\"3 um\", \"4 um\", \"5 um\"]\n";
    let listed = study(listed).unwrap();
    assert_eq!(case.indenter, listed.case(1).unwrap().indenter);
    let zip = text.replace("[study]", "[study]\ncombine = \"zip\"");
    let message = study(&zip).unwrap_err();
    assert!(
        message.contains("key `indenter.radius`: found 3 values, wanted 2"),
        "{message}"
    );
    let zip = study(&zip.replace("[32, 64]", "[32, 48, 64]")).unwrap();
    assert_eq!(
        (zip.case_count(), zip.case(2).unwrap().grid.elements),
        (3, 64)
    );
    let missing = study(&text.replace("samples", "sample")).unwrap_err();
    assert!(missing.contains("sample.csv: found"), "{missing}");
    let number = study(&text.replace("\"samples.csv\"", "3")).unwrap_err();
    assert!(
        number.contains("key `study.vary.from`: found 3"),
        "{number}"
    );
}

#[test]
fn the_base_case_may_be_in_the_same_file_and_ranges_have_units() {
    let text = format!(
        "[study.vary]\nload.force = {{ from = \"1 uN\", to = \"1 mN\", count = 4, spacing = \"log\" }}\n{BASE}"
    );
    let study = study(&text.replace("forces = [\"1 uN\", \"2 uN\"]", "")).unwrap();
    let force = |i| match study.case(i).unwrap().load.values {
        pellicle::case::load::LoadValues::Force(force) => force,
        other => panic!("{other:?}"),
    };
    // Both ends are exact; between them, one rounding of the power.
    assert_eq!([force(0), force(3)], [1e-6, 1e-3]);
    assert!((force(1) / 1e-5 - 1.0).abs() < 1e-15);
    assert_eq!(study.varied_keys()[0].heading(), "load.force [N]");
}

#[test]
fn an_invalid_study_is_reported_with_its_key() {
    for (text, wanted) in [
        ("[load]\nforce = 1", "key `study`: found no such key"),
        (
            "[study]\ncase = \"base.toml\"",
            "key `study.vary`: found no such key",
        ),
        (
            "[study]\ncase = \"base.toml\"\n[study.vary]\nload.force = 3",
            "key `load.force`: found 3, wanted a list of values",
        ),
        (
            "[study]\ncase = \"base.toml\"\ncombine = \"zip\"\n[study.vary]\na = [1]\nb = [1, 2]",
            "key `b`: found 2 values, wanted 1, as many as `a` has",
        ),
        (
            "[study]\ncase = \"base.toml\"\n[study.vary]\na = { from = 0, to = 1, count = 3, spacing = \"log\" }",
            "key `a.to`: found a range",
        ),
        (
            "[study]\ncase = \"base.toml\"\n[study.vary]\na = { from = \"1 nm\", to = \"1 N\", count = 3 }",
            "key `a.to`: found \"1 N\", wanted a value with a unit of the same kind",
        ),
        (
            "[study]\ncase = \"base.toml\"\n[study.vary]\na.0.b = [1]\n\"a[0].b\" = [2]",
            "key `a[0].b`: found the same key twice",
        ),
        (
            "[study]\ncase = \"base.toml\"\n[study.vary]\na = [1]\n[load]\nforce = 1",
            "key `load`: found an unknown key, wanted one of study",
        ),
    ] {
        let message = study(text).unwrap_err();
        assert!(message.contains(wanted), "{wanted} in {message}");
    }
    let nowhere = study("[study]\ncase = \"no.toml\"\n[study.vary]\na = [1]").unwrap_err();
    assert!(nowhere.contains("no.toml"), "{nowhere}");
}

#[test]
fn a_key_that_no_case_has_is_reported_before_any_work() {
    let text = TWO_KEYS.replace("grid.elements", "grid.elemnts");
    let study = study(&text).unwrap();
    let message = StudyPlan::new(&study, Shard::WHOLE)
        .unwrap_err()
        .to_string();
    assert!(
        message.contains("study.toml, line 7, key `grid.elemnts`"),
        "{message}"
    );
}

#[test]
fn a_value_from_the_command_line_of_a_key_that_varies_is_refused() {
    assert!(study_with(TWO_KEYS, &["indenter.radius=\"5 um\""]).is_ok());
    let refused = study_with(TWO_KEYS, &["grid.elements = 64"]).unwrap_err();
    let wanted = "found a value of grid.elements, which [study.vary] varies, wanted a key that it does not vary";
    assert!(refused.contains(wanted), "{refused}");
}

/// The study has a million cases.
#[test]
fn planning_a_million_cases_reads_only_as_many_as_there_are_values() {
    let plan = plan(MILLION, Shard { index: 3, count: 7 });
    assert_eq!(plan.identity.numbering.case_count(), 1_000_000);
    // The first case has one value of each key.
    assert_eq!((plan.refused.tried, plan.refused.count), (1999, 0));
    let stored = serde_json::to_string(&plan.identity).unwrap();
    assert!(stored.len() < 1000, "{}", stored.len());
    let rows = |case| plan.identity.rows.of(&plan.identity.numbering, case);
    assert_eq!((rows(999_999), rows(1_000_000)), (Some(2), None));
}

#[test]
fn an_invalid_value_is_found_before_anything_is_solved() {
    let text = TWO_KEYS.replace("\"30 nm\"", "\"-30 nm\"");
    let refused = plan(&text, Shard::WHOLE).refused;
    // Three values of each key, of which the first case has one each.
    assert_eq!((refused.tried, refused.count), (5, 1));
    let words = refused.words().unwrap();
    assert!(
        words.starts_with("case 7 is invalid and will be recorded as failed: "),
        "{words}"
    );
    assert!(words.contains("thickness`: found \"-30 nm\""), "{words}");
}

#[test]
fn a_text_that_a_spreadsheet_takes_for_a_formula_is_refused_and_numbers_with_a_sign_are_not() {
    let with =
        |line: &str| study(&TWO_KEYS.replace("[study.vary]\n", &format!("[study.vary]\n{line}\n")));
    for text in [
        "=cmd|'/C calc'!A0",
        "+1+1",
        "@SUM(1)",
        "\\tx",
        "a\\nb",
        "-x",
    ] {
        let refused = with(&format!("title = [\"a\", \"{text}\"]")).unwrap_err();
        let wanted = "wanted text without control characters that does not begin with =, +, - or @";
        assert!(refused.contains(wanted), "{refused}");
        assert!(refused.contains("key `title`"), "{refused}");
    }
    let refused = with("load = [{ \"a\\nb\" = \"1 N\" }]").unwrap_err();
    assert!(refused.contains("control characters"), "{refused}");
    let refused = with("\"=1+1\" = [2]").unwrap_err();
    assert!(
        refused.contains("found \"=1+1\", wanted a key of a case"),
        "{refused}"
    );
    let plain = [
        (
            "surface.offset = [[-1.5, 0], [\"-2 um\", \"0 um\"]]",
            ["[-1.5e0, 0]", "[-2 um, 0 um]"],
        ),
        ("indenter.radius = [\"-2 um\", -1.5]", ["-2e-6", "-1.5e0"]),
        ("title = [\"-2\", \"a\\\"b,c\"]", ["-2", "a\"b,c"]),
    ];
    for (line, cells) in plain {
        let study = with(line).unwrap();
        let varied = &study.varied_keys()[0];
        assert_eq!([0, 1].map(|i| varied.cell(i).into_owned()), cells);
    }
}

#[test]
fn each_list_of_loads_has_its_own_number_of_rows() {
    let text = "[study]\ncase = \"base.toml\"\n[study.vary]\ngrid.elements = [32, 64]\n\
                load.forces = [[\"1 uN\"], [\"1 uN\", \"2 uN\", \"3 uN\"]]\nsolver.tolerance = [1e-6, 1e-8]\n";
    let identity = plan(text, Shard::WHOLE).identity;
    let rows: Vec<_> = (0..8).filter_map(|case| identity.rows_of(case)).collect();
    assert_eq!(rows, [1, 1, 3, 3, 1, 1, 3, 3]);
}

#[test]
fn a_layer_in_only_some_cases_has_columns() {
    let layer = "{ thickness = \"10 nm\", young_modulus = \"70 GPa\", poisson_ratio = 0.3 }";
    let text = format!(
        "[study]\ncase = \"base.toml\"\n[study.vary]\nstress = [{{}}]\n\
         foundation.layer = [[{layer}], [{layer}, {layer}]]\n"
    );
    let header = plan(&text, Shard::WHOLE).identity.header;
    assert!(header.contains("layer[1]"), "{header}");
}

#[test]
fn the_values_of_a_key_are_read_once() {
    let study = study(TWO_KEYS).unwrap();
    let thickness = &study.varied_keys()[0];
    assert_eq!([0, 1, 3].map(|i| thickness.cell(i)), ["1e-8", "2e-8", ""]);
    // The same string, not built again from the values.
    assert!(std::ptr::eq(
        &raw const *thickness.cell(1),
        &raw const *thickness.cell(1)
    ));
}

#[test]
fn values_with_and_without_units_share_a_column_and_non_quantities_are_rejected() {
    let values = "[\"10 nm\", \"20 nm\", \"30 nm\"]";
    assert!(TWO_KEYS.contains(values));
    let with = |other: &str| study(&TWO_KEYS.replace(values, &format!("[\"10 nm\", {other}]")));
    let mixed = with("2e-8").unwrap();
    let thickness = &mixed.varied_keys()[0];
    assert!(
        thickness.heading().ends_with("[m]"),
        "{}",
        thickness.heading()
    );
    assert_eq!([0, 1].map(|i| thickness.cell(i)), ["1e-8", "2e-8"]);
    for odd in ["\"2 furlong\"", "\"2 N\""] {
        let refused = with(odd).unwrap_err();
        assert!(
            refused.contains("of the kind of the key's other values"),
            "{refused}"
        );
    }
}
