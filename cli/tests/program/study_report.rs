//! `report.html` of a study: it contains every column and every reason, needs no network, and cannot be altered by the
//! contents of a case.

use std::fs;

use serde_json::Value;

use super::runner::{CASE, TestFolder};

const STUDY: &str = r#"[study]
case = "case.toml"

[study.vary]
load.force = ["1 uN", "2 uN", "4 uN"]
surface.radius = ["10 nm", "20 nm", "26 nm", "27 nm"]
title = ["plain", "</script><script>alert(1)</script>"]
"#;

fn page(folder: &TestFolder) -> String {
    fs::read_to_string(folder.path("results/many/report.html")).unwrap()
}

/// The data drawn by the page's script.
fn data(page: &str) -> Value {
    let (_, rest) = page.split_once("id=\"data\">").unwrap();
    serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap()
}

#[test]
fn the_study_report_has_its_columns_and_the_reasons_of_failures() {
    let folder = TestFolder::with_study(CASE, STUDY);
    assert_eq!(folder.study(&[]).code, Some(1));
    let page = page(&folder);
    for text in [
        "24 cases: 12 certified, 12 failed",
        "<strong>load.force [N]</strong>",
        "<strong>surface.radius [m]</strong>",
        "<th>penetration [m]</th>",
        "<th>contact stiffness",
        "overlap",
        "<td class=\"number\">12</td><td class=\"number\">case 5</td>",
    ] {
        assert!(page.contains(text), "{text}");
    }
    // Nothing is loaded, and no text of a case becomes part of the page.
    assert!(page.contains("default-src 'none'"));
    for foreign in [
        "http:",
        "https:",
        "src=",
        "alert(1)</script>",
        "<script>alert",
    ] {
        assert!(!page.contains(foreign), "{foreign}");
    }
    let data = data(&page);
    let columns = data["columns"].as_array().unwrap();
    let place = |name: &str| {
        columns
            .iter()
            .position(|column| column["name"] == name)
            .unwrap()
    };
    let words = &columns[place("title")]["values"]["words"];
    assert_eq!(words[1], "</script><script>alert(1)</script>");
    let (force, depth) = (place("load.force [N]"), place("penetration [m]"));
    assert_eq!(
        columns[force]["values"]["numbers"],
        serde_json::json!([1e-6, 4e-6])
    );
    assert_eq!(
        (&columns[force]["is_key"], &columns[depth]["is_key"]),
        (&true.into(), &false.into())
    );
    // The values of the table, to six digits.
    let table = fs::read_to_string(folder.path("results/many/results.csv")).unwrap();
    let mut table = csv::Reader::from_reader(table.as_bytes());
    let heads = table.headers().unwrap().clone();
    let at = heads
        .iter()
        .position(|name| name == "penetration [m]")
        .unwrap();
    let rows = data["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 24);
    for (row, cells) in rows.iter().zip(table.records()) {
        let cells = cells.unwrap();
        assert_eq!(row[0].to_string(), cells[0]);
        match (row[1][depth].as_f64(), cells[at].parse::<f64>()) {
            (Some(drawn), Ok(written)) => assert!((drawn / written - 1.0).abs() < 1e-5),
            (drawn, written) => assert!(drawn.is_none() && written.is_err()),
        }
    }
}

#[test]
fn the_study_report_works_while_parts_are_missing_and_replaces_no_foreign_file() {
    let folder = TestFolder::with_study(CASE, STUDY);
    let nothing = folder.study(&["--report"]);
    assert_eq!(nothing.code, Some(2));
    assert!(!folder.path("results").exists());
    assert_eq!(folder.study(&["--shard", "1/2"]).code, Some(1));
    assert!(!folder.path("results/many/report.html").exists());
    let ran = folder.study(&["--report"]);
    assert_eq!(
        (ran.code, ran.stdout.as_str()),
        (Some(0), "results/many/report.html\n")
    );
    assert!(page(&folder).contains("12 to do"));
    assert_eq!(folder.study(&["--shard", "2/2"]).code, Some(1));
    assert_eq!(folder.run(&["gather", "results/many"]).code, Some(1));
    let gathered = page(&folder);
    assert!(gathered.contains("24 cases: 12 certified, 12 failed<"));
    // The merged table and those of the parts count once.
    assert_eq!(folder.study(&["--report"]).code, Some(0));
    assert_eq!(page(&folder), gathered);
    fs::write(folder.path("results/many/report.html"), "mine").unwrap();
    let refused = folder.study(&["--report"]);
    assert_eq!(refused.code, Some(2), "{}", refused.stderr);
    assert_eq!(folder.study(&["--fresh"]).code, Some(1));
    assert_eq!(page(&folder), "mine");
}
