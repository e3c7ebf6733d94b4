//! Files of nanoindenters: `FischerScope`, Hysitron, Agilent.

use pellicle_identify::measured::exclusion::ExclusionReason;

use super::{check_ends, codes, excluded, one, refused};

const FISCHER: &str = r#"
file = "FS1.txt"
columns = { depth = "h", force = "F", time = "t" }
units = { depth = "um", force = "mN", time = "s" }
"#;

#[test]
fn a_fischerscope_file_has_decimal_commas_prose_and_several_tables() {
    let text = r#"text = { decimal = ",", skip_until = "F h t", encoding = "latin-1" }"#;
    let curve = one(&format!("{FISCHER}{text}"));
    assert_eq!((curve.table_rows, curve.rows.len()), (1200, 1170));
    assert_eq!(excluded(&curve, ExclusionReason::AfterLargestForce), 30);
    assert_eq!(curve.header, ["F", "h", "t"]);
    check_ends(curve.force(), 0.416459e-3, 299.995e-3);
    check_ends(curve.depth(), 0.031365e-6, 1.53517e-6);
    check_ends(curve.time(), 0.1, 117.0);
    // The file itself states that there are three.
    assert_eq!(codes(&curve), ["several-tables"]);
    let text = r#"text = { decimal = ",", skip_until = "F h t", encoding = "latin-1", table = 3 }
        segment = { part = "unloading" }"#;
    let found = refused(&format!("{FISCHER}{text}"));
    assert!(
        found.contains("key `data[0].segment.part`") && found.contains("contact with an imprint"),
        "{found}"
    );
}

#[test]
fn without_skip_until_the_longest_tables_are_read_not_the_statistics_before_them() {
    let text = "text = { decimal = \",\" }";
    let curve = one(&format!("{FISCHER}{text}"));
    assert_eq!((curve.table_rows, curve.rows.len()), (1200, 1170));
    assert_eq!(codes(&curve), ["encoding-guessed", "several-tables"]);
}

#[test]
fn a_fischerscope_file_read_with_other_options_names_the_missing_option() {
    let found = refused(&format!("{FISCHER}text = {{ encoding = \"latin-1\" }}"));
    assert!(found.contains("decimal = \",\" gives one"), "{found}");
    let found = refused(&format!("{FISCHER}text = {{ encoding = \"utf-8\" }}"));
    assert!(
        found.contains("fit.toml, line 6, key `data[0].text.encoding`")
            && found.contains("that is not utf-8"),
        "{found}"
    );
    let text = "text = { decimal = \",\", skip_until = \"F h t\", table = 4 }";
    let found = refused(&format!("{FISCHER}{text}"));
    assert!(
        found.contains("found 3 tables, wanted the number of one of them, not 4"),
        "{found}"
    );
    let table =
        "file = \"FS1.txt\"\ncolumns = { depth = 2, force = 1 }\ntext = { decimal = \",\" }";
    let found = refused(table);
    assert!(
        found.contains("no unit of depth in the file, wanted one in units"),
        "{found}"
    );
}

const HYSITRON: &str = r#"
file = "RobinSteel0000LC.txt"
columns = { depth = "Depth (nm)", force = 2, time = "Time" }
"#;

#[test]
fn a_hysitron_file_states_its_units_and_has_empty_lines_in_its_table() {
    let curve = one(&format!(
        "{HYSITRON}text = {{ encoding = \"windows-1252\" }}"
    ));
    // The file says "Number of Points = 5304".
    // The last 299 rows up to the largest force hold it.
    assert_eq!((curve.table_rows, curve.rows.len()), (5304, 2303));
    assert_eq!(curve.header[1], "Load (µN)");
    check_ends(curve.depth(), 0.814723e-9, 154.985743e-9);
    check_ends(curve.force(), 1.836146e-6, 2999.057895e-6);
    check_ends(curve.time(), 0.0, 12.040218);
    assert_eq!(codes(&curve).len(), 0);
}

#[test]
fn a_loading_between_two_forces_excludes_other_forces_and_the_approach() {
    let segment = "segment = { from = \"1 uN\", to = \"0.5 mN\" }";
    let curve = one(&format!("{HYSITRON}{segment}"));
    let force = curve.force().unwrap();
    assert!(force.iter().all(|force| (1e-6..=0.5e-3).contains(force)));
    // The approach also begins at 1.8 µN, but falls below 1 µN again.
    assert!(curve.rows[0] > 100, "{}", curve.rows[0]);
    let (first, last) = (curve.rows[0], curve.rows[curve.rows.len() - 1]);
    assert_eq!(last - first + 1, curve.rows.len());
    let before = excluded(&curve, ExclusionReason::BeforeSegment);
    assert_eq!(before + 1, first);
}

#[test]
fn a_unit_that_contradicts_the_header_is_refused_naming_both() {
    let found = refused(&format!("{HYSITRON}units = {{ force = \"mN\" }}"));
    assert!(
        found.contains("key `data[0].units.force`")
            && found.contains("found force in µN in the header")
            && found.contains("and in mN here"),
        "{found}"
    );
    // A bare number is a factor given by the user.
    let curve = one(&format!("{HYSITRON}units = {{ force = 1e-3 }}"));
    check_ends(curve.force(), 1.836146e-3, 2999.057895e-3);
}

#[test]
fn a_name_shared_by_two_columns_and_a_column_in_volts_are_refused() {
    let with = |depth: &str, force: &str| {
        let columns = format!("columns = {{ depth = {depth}, force = {force} }}");
        refused(&format!("file = \"RobinSteel0000LC.txt\"\n{columns}"))
    };
    let found = with("\"Depth\"", "2");
    assert!(
        found.contains("found the columns 1, 4 with the name \"Depth\""),
        "{found}"
    );
    let found = with("4", "2");
    assert!(
        found.contains("the column \"Depth (V)\", which is in V, wanted in units what one V is"),
        "{found}"
    );
    let found = with("2", "1");
    assert!(
        found.contains("\"Load (µN)\", which is a force") && found.contains("swapped?"),
        "{found}"
    );
    let found = with("1", "6");
    assert!(
        found.contains("key `data[0].columns.force`") && found.contains("from 1 to 5, not 6"),
        "{found}"
    );
    let found = with("\"Tiefe\"", "2");
    assert!(
        found.contains("no column \"Tiefe\" among \"Depth (nm)\", \"Load (µN)\""),
        "{found}"
    );
}

#[test]
fn an_agilent_file_ends_in_rows_without_values_and_has_stiffness() {
    let columns = "columns = { depth = \"Displacement Into Surface\", force = \"Load On Sample\", \
        time = 3, stiffness = \"Harmonic Contact Stiffness\" }";
    let curve = one(&format!(
        "file = \"micromechanics_popin_test012.csv\"\n{columns}"
    ));
    assert_eq!((curve.table_rows, curve.rows.len()), (375, 375));
    assert_eq!(curve.header[3], "Harmonic Contact Stiffness [N/m]");
    check_ends(curve.depth(), 3.0160153696765186e-9, 996.7193754128892e-9);
    check_ends(curve.force(), 0.002980259826350935e-3, 90.33206153184508e-3);
    check_ends(curve.stiffness(), 139.89868309297657, 725772.5895295932);
    let segment = "segment = { until = \"largest depth step\" }";
    let curve = one(&format!(
        "file = \"micromechanics_popin_test012.csv\"\n{columns}\n{segment}"
    ));
    assert_eq!(*curve.rows.last().unwrap(), 128);
    check_ends(curve.depth(), 3.0160153696765186e-9, 23.082065562820755e-9);
}
