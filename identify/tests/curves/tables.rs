//! Tables in texts: headers that are repeated, units below headings, numbers for missing values.

use super::codes;
use super::invented::{PLAIN, read, rows, twenty};

#[test]
fn a_table_goes_on_behind_its_repeated_header_and_a_new_test_does_not() {
    let head = "Depth (nm)\tForce (uN)\n";
    let lines: Vec<String> = twenty().map(|depth| rows([depth], "\t", "\n")).collect();
    let up = lines.concat();
    let down: String = lines.iter().rev().map(String::as_str).collect();
    let of = |text: &str| {
        read(
            "file = \"a.txt\"\ncolumns = { depth = 1, force = 2 }",
            text.as_bytes(),
        )
        .unwrap()
    };
    let wanted = of(&format!("{head}{up}"));
    let pages: Vec<String> = lines
        .chunks(5)
        .map(|page| format!("{head}{}", page.concat()))
        .collect();
    for text in [pages.concat(), pages.join("\n")] {
        let found = of(&text);
        assert_eq!((found.depth(), codes(&found).len()), (wanted.depth(), 0));
    }
    let whole = of(&format!("Loading\n{head}{up}Unloading\n{head}{down}"));
    assert_eq!((whole.table_rows, codes(&whole).len()), (40, 0));
    let twice = of(&format!("Test 1\n{head}{up}Test 2\n{head}{up}"));
    assert_eq!(
        (twice.table_rows, codes(&twice)),
        (20, vec!["several-tables"])
    );
}

#[test]
fn numbers_for_missing_values_are_left_out_and_told() {
    let wanted = rows(twenty(), "\t", "\n");
    for code in ["-9999\t-9999\n", "3\t-9999\n", "9.9e37\t4\n", "-32768\t1\n"] {
        let mut lines: Vec<&str> = wanted.split_inclusive('\n').collect();
        lines.insert(0, code);
        lines.insert(7, code);
        let found = read(PLAIN, lines.concat().as_bytes()).unwrap();
        assert_eq!((found.rows.len(), found.rows[0]), (20, 2), "{code}");
        assert!(codes(&found).contains(&"missing-code"), "{code}");
    }
}

#[test]
fn a_unit_below_a_heading_is_that_of_the_heading() {
    let read = |heads: &str| {
        let text = format!("{heads}\n{}", rows(twenty(), "\t", "\n"));
        let table = "file = \"a.txt\"\ncolumns = { depth = 1, force = 2 }";
        read(table, text.as_bytes())
    };
    for heads in [
        "Depth (um)\tForce (uN)\nµm\tuN",
        "Depth\tForce\num\tuN",
        "Depth (um)\tForce\n\tuN",
    ] {
        assert!((read(heads).unwrap().depth().unwrap()[0] - 0.5e-6).abs() < 1e-18);
    }
    let angstroms = read("Depth (Angstrom)\tForce (uN)").unwrap();
    assert!((angstroms.depth().unwrap()[0] - 0.5e-10).abs() < 1e-20);
    let two = read("Depth (nm)\tForce (uN)\num\tuN").unwrap_err();
    assert_eq!(two.code(), "other-unit");
    assert!(
        two.to_string()
            .contains("in nm in its heading and in um below it"),
        "{two}"
    );
}
