//! `pellicle study --find`: answers, files and exit codes.

use std::fs;

use super::runner::TestFolder;

const BALL: &str = r#"
[foundation]
substrate = { young_modulus = "206 GPa", poisson_ratio = 0.3 }
[indenter]
kind = "paraboloid"
radius = "5 mm"
[load]
force = "1 N"
[grid]
elements = 64
"#;

const FIND: [&str; 6] = [
    "study",
    "case.toml",
    "--find",
    "max_pressure < 1 GPa",
    "--by",
    "load.force",
];

#[test]
fn the_answer_is_on_the_terminal_and_in_the_files_of_its_folder() {
    let folder = TestFolder::with_case(BALL);
    let ran = folder.run(&FIND);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    // p₀³ = 6 Q E*²/(π³ R²): 2.5211 N
    let answer = ran.stdout.lines().next().unwrap();
    assert!(answer.starts_with("largest load.force = 2.52"), "{answer}");
    assert!(
        answer.ends_with("with max pressure < 1.0000 GPa"),
        "{answer}"
    );
    assert!(
        ran.stderr
            .contains("case 1: load.force = 100.00 mN: max pressure = 341."),
        "{}",
        ran.stderr
    );
    let read =
        |name: &str| fs::read_to_string(folder.path(&format!("results/case-find/{name}"))).unwrap();
    let table = read("find.csv");
    let header = "case,status,load.force [N],max pressure [Pa],max pressure error [Pa],max pressure resolved,warnings,message";
    assert_eq!(table.lines().next(), Some(header));
    let found: serde_json::Value = serde_json::from_str(&read("find.json")).unwrap();
    assert_eq!(found["verdict"], "found");
    assert_eq!(found["cases"], table.lines().count() - 1);
    // The same question again: every case is known, and the answer is the same; without the rest, if that is asked.
    let quiet = folder.run(&[&FIND[..], &["--quiet"]].concat());
    assert_eq!(
        (quiet.stdout, quiet.stderr.as_str()),
        (ran.stdout.clone(), "")
    );
    let again = folder.run(&[&FIND[..], &["--json"]].concat()).json();
    assert_eq!(again, found);
}

#[test]
fn no_answer_is_exit_code_1_and_a_wrong_question_2() {
    let folder = TestFolder::with_case(BALL);
    let with = |condition: &'static str, more: &[&'static str]| {
        let mut arguments = FIND.to_vec();
        arguments[3] = condition;
        folder.run(&[&arguments[..], more].concat())
    };
    let ran = with("max_pressure < 30 GPa", &["--between", "0.5 N", "1 N"]);
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    assert!(
        ran.stdout
            .starts_with("max pressure < 30.000 GPa holds at both ends:"),
        "{}",
        ran.stdout
    );
    assert!(
        ran.stdout.contains("`--between` gives another range"),
        "{}",
        ran.stdout
    );
    for (condition, more) in [
        ("max_presure < 30 GPa", &[][..]),
        ("max_pressure < 30 um", &[]),
        ("max_pressure < 30 GPa", &["--between", "1 N", "-1 um"]),
        ("max_pressure < 30 GPa", &["--within", "2"]),
        ("max_pressure < 30 GPa", &["--report"]),
        ("contact_area < 1 um^2", &[]),
    ] {
        let ran = with(condition, more);
        assert_eq!(ran.code, Some(2), "{condition} {more:?}: {}", ran.stderr);
    }
    let ran = with("max_pressure < 1 GPa", &["--list"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert!(
        ran.stdout
            .contains("load.force from 100.00 mN to 10.000 N; 2 cases"),
        "{}",
        ran.stdout
    );
}
