//! Small invented files: every way to write the same curve, and every possible fault.

use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::sync::Arc;

use pellicle::input::span::Source;
use pellicle_identify::measured::curve::MeasuredCurve;
use pellicle_identify::measured::data_table::DataTable;
use pellicle_identify::measured::error::CurveError;
use pellicle_identify::measured::exclusion::ExclusionReason;
use proptest::prelude::*;

use super::{codes, excluded};

pub const PLAIN: &str = "file = \"a.txt\"\ncolumns = { depth = 1, force = 2 }\nunits = { depth = \"nm\", force = \"uN\" }\n";

/// Reads a file `a.txt` with these bytes according to a table.
pub fn read(table: &str, bytes: &[u8]) -> Result<MeasuredCurve, CurveError> {
    let folder = tempfile::tempdir().expect("a folder can be made");
    fs::write(folder.path().join("a.txt"), bytes).expect("the folder takes files");
    let tables = tables(table, folder.path()).expect("the table is right");
    MeasuredCurve::read(&tables[0].files[0], &tables[0])
}

fn tables(table: &str, folder: &Path) -> Result<Vec<DataTable>, String> {
    let source = Arc::new(Source::new("fit.toml", format!("[[data]]\n{table}\n")));
    let tables = DataTable::parse_all(&source, folder);
    tables.map_err(|diagnosis| diagnosis.to_string())
}

/// Returns the fault of a table with the file `a.txt`.
fn fault(table: &str) -> String {
    let folder = tempfile::tempdir().expect("a folder can be made");
    fs::write(folder.path().join("a.txt"), "1 2\n2 4\n3 7\n").expect("the folder takes files");
    tables(table, folder.path()).expect_err("the table is wrong")
}

fn code(table: &str, text: &str) -> &'static str {
    read(table, text.as_bytes()).expect_err("no curve").code()
}

/// Rows of depth in nm and force in µN, `F = D²`, one at each depth.
pub fn rows(depths: impl IntoIterator<Item = f64>, separator: &str, end: &str) -> String {
    let row = |depth: f64| format!("{depth}{separator}{}{end}", depth * depth);
    depths.into_iter().map(row).collect()
}

pub fn twenty() -> impl Iterator<Item = f64> {
    (0..20).map(|i| 0.5 + f64::from(i))
}

#[test]
fn a_curve_is_read_the_same_in_every_format() {
    let wanted = read(PLAIN, rows(twenty(), " ", "\n").as_bytes()).unwrap();
    assert_eq!((wanted.rows.len(), codes(&wanted).len()), (20, 0));
    let same = |table: &str, bytes: &[u8]| {
        let found = read(&format!("{PLAIN}{table}"), bytes).unwrap();
        assert_eq!(found.depth(), wanted.depth());
        assert_eq!(
            (found.force(), &found.warnings),
            (wanted.force(), &wanted.warnings)
        );
    };
    for separator in ["\t", ";", ",", ", ", "   "] {
        for end in ["\n", "\r\n", "\r", "\n\n"] {
            same("", rows(twenty(), separator, end).as_bytes());
        }
    }
    let comma = rows(twenty(), ";", "\n").replace('.', ",");
    same("text = { decimal = \",\" }", comma.as_bytes());
    same(
        "text = { decimal = \",\", separator = \";\" }",
        comma.as_bytes(),
    );
    let head = format!(
        "\u{feff}Depth (nm);\"Load, µN\"\n{}",
        rows(twenty(), ";", "\n")
    );
    same("", head.as_bytes());
    let utf_16 =
        |order: fn(u16) -> [u8; 2]| head.encode_utf16().flat_map(order).collect::<Vec<_>>();
    same("", &utf_16(u16::to_le_bytes));
    same("", &utf_16(u16::to_be_bytes));
    same(
        "text = { encoding = \"utf-16le\" }",
        &utf_16(u16::to_le_bytes),
    );
    let quoted = rows(twenty(), "\",\"", "\"\n\"");
    same("", format!("\"{quoted}").as_bytes());
    let prose = format!(
        "Tip: ball\nPoints: 2 3\n\nx (nm) y (uN)\n{}Mean 3 at 4 of 5 runs\n",
        rows(twenty(), " ", "\n")
    );
    same("", prose.as_bytes());
    same("text = { skip_until = \"x   (nm)\" }", prose.as_bytes());
}

proptest! {
    #[test]
    fn numbers_survive_any_decimal_mark_and_separator(
        steps in prop::collection::vec((1e-3..10.0_f64, 1e-3..10.0_f64), 3..40),
        separator in prop::sample::select(vec![";", "\t", "  "]),
        end in prop::sample::select(vec!["\n", "\r\n"]),
    ) {
        let (mut depth, mut force) = (0.0, 0.0);
        let points: Vec<_> = steps.iter().map(|(d, f)| {
            (depth, force) = (depth + d, force + f);
            (depth, force)
        }).collect();
        let line = |(d, f): &(f64, f64)| format!("{d:e}{separator}{f}{end}");
        let text: String = points.iter().map(line).collect();
        // Slow rows after steep ones would be a hold, which is no part of a loading.
        let table = "file = \"a.txt\"\ncolumns = { depth = 1, force = 2 }\nunits = { depth = 1, force = 1 }\nsegment = { part = \"whole\" }\n";
        let comma = read(&format!("{table}text = {{ decimal = \",\" }}"), text.replace('.', ",").as_bytes());
        let point = read(table, text.as_bytes()).unwrap();
        // Bare numbers are SI, so the bits are those of the text.
        let (depths, forces): (Vec<_>, Vec<_>) = points.into_iter().unzip();
        for curve in [&point, &comma.unwrap()] {
            prop_assert_eq!(curve.depth().unwrap(), &depths[..]);
            prop_assert_eq!(curve.force().unwrap(), &forces[..]);
        }
    }

    #[test]
    fn arbitrary_bytes_are_read_or_refused_without_panic(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        if let Ok(curve) = read(PLAIN, &bytes) {
            prop_assert_eq!(curve.depth().unwrap().len(), curve.rows.len());
        }
    }

    #[test]
    fn every_row_is_kept_or_counted(
        rows in prop::collection::vec((0..12_i32, -3..9_i32, any::<bool>()), 4..60),
        from in 1..4_u8,
        part in prop::sample::select(vec!["loading", "unloading", "whole"]),
    ) {
        let line = |(d, f, valid): &(i32, i32, bool)| match valid {
            true => format!("{d},{f}\n"),
            false => format!("{d},1.79e308\n"),
        };
        let text: String = rows.iter().map(line).collect();
        let table = format!("{PLAIN}segment = {{ part = \"{part}\", from = \"{from} uN\" }}");
        if let Ok(curve) = read(&table, text.as_bytes()) {
            let counted: usize = curve.excluded.iter().map(|found| found.count).sum();
            prop_assert_eq!(counted + curve.rows.len(), rows.len());
            prop_assert!(curve.rows.is_sorted());
            prop_assert!(curve.force().unwrap().iter().all(|force| *force >= f64::from(from) * 1e-6));
            for (row, force) in curve.rows.iter().zip(curve.force().unwrap()) {
                // One rounding of the product.
                let written = f64::from(rows[row - 1].1) * 1e-6;
                prop_assert!((force - written).abs() <= 1e-21);
            }
        }
    }
}

#[test]
fn a_hundred_thousand_points_are_read() {
    let mut text = String::from("depth [nm],load [mN],time [s]\n");
    for i in 0..100_000 {
        let x = f64::from(i) * 1e-3;
        writeln!(text, "{x:.3},{:.6},{:.2}", x * x * 1e-4, x * 10.0).unwrap();
    }
    let table = "file = \"a.txt\"\ncolumns = { depth = \"depth\", force = \"load\", time = \"time\" }\n\
        segment = { from = \"0.01 mN\", until = \"largest depth step\" }";
    let curve = read(table, text.as_bytes()).unwrap();
    // 1e-4 x² ≥ 0.01 from x = 10 on.
    assert_eq!((curve.rows[0], curve.rows.len()), (10_001, 90_000));
    assert_eq!(codes(&curve), ["no-depth-step"]);
}

#[test]
fn five_points_are_a_curve_with_a_warning_and_two_are_too_few() {
    let curve = read(PLAIN, rows([1.0, 2.0, 3.0, 4.0, 5.0], " ", "\n").as_bytes()).unwrap();
    assert_eq!(codes(&curve), ["few-points"]);
    let (found, rows_read, wanted) = (2, 2, 3);
    let too_few = CurveError::TooFewPoints {
        found,
        rows: rows_read,
        wanted,
    };
    let two = rows([1.0, 2.0], " ", "\n");
    assert_eq!(read(PLAIN, two.as_bytes()).unwrap_err(), too_few);
    assert_eq!(too_few.code(), "too-few-points");
}

#[test]
fn invalid_values_are_left_out_and_counted() {
    let text = "depth,load,mark\n1,1,\n2,4,a\n3,NaN,\n---,5,\n4,1.79769313486232E+308,\n,,\n5,25\n6,,\n7,49,\n8,inf,\n9,81,\n";
    let curve = read(PLAIN, text.as_bytes()).unwrap();
    assert_eq!(curve.rows, [1, 2, 6, 8, 10]);
    assert_eq!(excluded(&curve, ExclusionReason::InvalidValue), 5);
    assert_eq!(codes(&curve), ["few-points", "many-invalid"]);
    // The user may set the limit.
    let curve = read(
        &format!("{PLAIN}text = {{ invalid_above = 40 }}"),
        text.as_bytes(),
    )
    .unwrap();
    assert_eq!(curve.rows, [1, 2, 6]);
}

#[test]
fn a_spike_is_left_out_and_ends_no_loading() {
    let mut lines: Vec<String> = rows(twenty().map(|depth| 2.0 * depth), " ", "\n")
        .lines()
        .map(str::to_owned)
        .collect();
    lines[11] = "23 2e3".into();
    let curve = read(PLAIN, lines.join("\n").as_bytes()).unwrap();
    assert_eq!((curve.rows.len(), codes(&curve)), (19, vec!["spike"]));
    assert_eq!(excluded(&curve, ExclusionReason::Spike), 1);
}

#[test]
fn swapped_columns_are_refused_by_name_and_warned_of_by_shape() {
    let text = format!("Load;Depth\n{}", rows(twenty(), ";", "\n"));
    assert_eq!(code(PLAIN, &text), "other-quantity");
    // Without names only the shape decides: the slope of a contact's force increases.
    let swapped = PLAIN.replace("depth = 1, force = 2", "depth = 2, force = 1");
    let curve = read(&swapped, rows(twenty(), ";", "\n").as_bytes()).unwrap();
    assert_eq!(codes(&curve), ["concave-curve"]);
}

#[test]
fn an_unloading_is_refused_as_a_loading_and_read_if_requested() {
    let unloading = rows(twenty().map(|depth| 20.0 - depth), ";", "\n");
    assert_eq!(code(PLAIN, &unloading), "unloading");
    let curve = read(
        &format!("{PLAIN}segment = {{ part = \"unloading\" }}"),
        unloading.as_bytes(),
    )
    .unwrap();
    assert_eq!(
        (curve.rows.len(), codes(&curve)),
        (20, vec!["unloading-alone"])
    );
}

#[test]
fn a_depth_that_falls_as_the_force_rises_is_refused_unless_its_sign_is_reversed() {
    let text = rows(twenty().map(|depth| -depth), ";", "\n");
    assert_eq!(code(PLAIN, &text), "depth-falls");
    for unit in ["\"-nm\"", "\"-1 nm\"", "-1e-9"] {
        let table = PLAIN.replace("\"nm\"", unit);
        let curve = read(&table, text.as_bytes()).unwrap();
        assert!(
            curve.depth().unwrap().iter().all(|depth| *depth > 0.0),
            "{unit}"
        );
    }
}

#[test]
fn data_that_are_not_a_curve_are_refused_with_a_code() {
    assert_eq!(code(PLAIN, ""), "empty-file");
    assert_eq!(code(PLAIN, " \r\n\n"), "empty-file");
    assert_eq!(code(PLAIN, "no numbers here\n"), "no-table");
    assert_eq!(code(PLAIN, "1 2\n2 nan\n"), "too-few-points");
    assert_eq!(code(PLAIN, "1 nan\n2 nan\n3 nan\n"), "no-numbers");
    assert_eq!(code(PLAIN, "1 5\n2 5\n3 5\n4 5\n"), "constant-force");
    assert_eq!(code(PLAIN, "1 5\n2\x00 6\n3 5\n"), "binary-file");
    let skip = format!("{PLAIN}text = {{ skip_until = \"TIME\" }}");
    assert_eq!(code(&skip, "1 5\n2 6\n3 7\n"), "skip-until-not-found");
}

#[test]
fn a_size_unusual_for_an_indentation_gives_a_warning() {
    let table = PLAIN.replace("\"nm\"", "\"m\"");
    let curve = read(&table, rows(twenty(), ";", "\n").as_bytes()).unwrap();
    assert_eq!(codes(&curve), ["unusual-size"]);
}

#[test]
fn stiffness_over_contact_radius_needs_no_force() {
    let table = "file = \"a.txt\"\ncolumns = { stiffness = 2, contact_radius = 1 }\n\
        units = { stiffness = \"uN/nm\", contact_radius = \"nm\" }\nobserve = \"stiffness at contact radius\"";
    let curve = read(table, rows(twenty(), ";", "\n").as_bytes()).unwrap();
    assert_eq!((curve.rows.len(), curve.force()), (20, None));
    // 1.5² µN/nm, exact in binary except for the unit's rounding.
    assert!((curve.stiffness().unwrap()[1] - 2250.0).abs() < 1e-12);
}

#[test]
fn repeats_are_read_in_order_of_their_file_names() {
    let folder = tempfile::tempdir().unwrap();
    for (name, first) in [("b.txt", 2.0), ("a.txt", 1.0), ("c.csv", 3.0)] {
        let text = rows([first, 4.0, 5.0], ";", "\n");
        fs::write(folder.path().join(name), text).unwrap();
    }
    let table = PLAIN.replace("a.txt", "*.txt");
    let curves = MeasuredCurve::read_all(&tables(&table, folder.path()).unwrap()[0]).unwrap();
    let first: Vec<_> = curves
        .iter()
        .map(|curve| curve.depth().unwrap()[0])
        .collect();
    assert_eq!(first, [1e-9, 2e-9]);
    let without = tables(&PLAIN.replace("a.txt", "t*.txt"), folder.path()).unwrap();
    let fault = MeasuredCurve::read_all(&without[0])
        .unwrap_err()
        .to_string();
    assert!(
        fault.contains("key `data[0].file`: found \"t*.txt\""),
        "{fault}"
    );
    assert!(fault.contains("no file matches"), "{fault}");
}

#[test]
fn the_other_keys_of_a_table_are_read() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a.txt"), "1 2\n").unwrap();
    let table = format!(
        "{PLAIN}observe = \"force at depth\"\nset = {{ \"indenter.radius\" = \"1 um\" }}\n\
         noise = {{ depth = \"0.05 nm\", relative = 0.01, correlation = \"none\" }}"
    );
    let read = tables(&table, folder.path()).unwrap().remove(0);
    assert_eq!(
        format!("{:?} {:?}", read.observe, read.noise.correlation),
        "ForceAtDepth None"
    );
    assert_eq!(
        (read.noise.depth, read.noise.force, read.noise.relative),
        (Some(0.05e-9), None, Some(0.01))
    );
    assert_eq!(read.set.entries[0].key, "indenter.radius");
}

#[test]
fn a_wrong_key_of_a_table_is_reported_at_its_position() {
    let with = |line: &str| fault(&format!("{PLAIN}{line}"));
    for (line, wanted) in [
        (
            "colums = { depth = 1 }",
            "key `data[0].colums`: found an unknown key",
        ),
        ("text = { decimal = \";\" }", "key `data[0].text.decimal`"),
        (
            "text = { decimal = \",\", separator = \",\" }",
            "found a comma for both",
        ),
        ("text = { encoding = \"latin-99\" }", "\"windows-1252\""),
        (
            "segment = { from = \"2 mN\", to = \"1 mN\" }",
            "wanted an end beyond `from`",
        ),
        ("segment = { from = 0.5 }", "the number of a row"),
        (
            "segment = { from = \"5 nm\" }",
            "a force or a time with its unit",
        ),
        (
            "segment = { from = { force = 1, row = 2 } }",
            "one of force, time, row and marker",
        ),
        ("segment = { from = \"1 s\" }", "key `data[0].columns.time`"),
        (
            "segment = { to = { marker = \"end\" } }",
            "key `data[0].columns.marker`",
        ),
        ("segment = { value = 1 }", "key `data[0].columns.segment`"),
        (
            "segment = { part = \"whole\", until = \"largest depth step\" }",
            "until for a loading alone",
        ),
        (
            "noise = { relative = 2 }",
            "a fraction of 0 or more, below 1",
        ),
        (
            "observe = \"stiffness at contact radius\"",
            "key `data[0].columns.stiffness`",
        ),
        ("spring_constant = 1", "key `data[0].columns.height`"),
        ("set = 3", "a table of keys of the model"),
    ] {
        let found = with(line);
        assert!(found.contains(wanted), "{line}: {found}");
    }
    let columns = "columns = { stiffness = 1, contact_radius = 2 }";
    let rest =
        "observe = \"stiffness at contact radius\"\nsegment = { until = \"largest depth step\" }";
    let found = fault(&format!("file = \"a.txt\"\n{columns}\n{rest}"));
    assert!(found.contains("key `data[0].columns.depth`"), "{found}");
    let found = fault("file = \"a.txt\"\ncolumns = { depth = 0, force = 2 }");
    assert!(found.contains("an integer from 1 to 10000"), "{found}");
    let found =
        fault("file = \"a.txt\"\ncolumns = { depth = 1, force = 2 }\nunits = { time = \"s\" }");
    assert!(found.contains("key `data[0].columns.time`"), "{found}");
    let found =
        fault("file = \"a.txt\"\ncolumns = { depth = 1, force = 2 }\nunits = { depth = \"mN\" }");
    assert!(
        found.contains("key `data[0].units.depth`") && found.contains("wanted a finite length"),
        "{found}"
    );
    assert!(fault("file = \"a.txt\"").contains("key `data[0].columns`: found no such key"));
}
