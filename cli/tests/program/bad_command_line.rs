//! Wrong command lines: exit code 2, a sentence that states the fault, nothing written.

use super::runner::{CASE, TestFolder};

#[test]
fn a_wrong_value_on_the_command_line_is_reported_there() {
    let folder = TestFolder::with_case(CASE);
    for set in [
        "load.force=-1",
        "load.force",
        "load.froce=1",
        "grid.elements.x=1",
        "=",
        "foundation.layer.7.thickness=1",
    ] {
        let ran = folder.run(&["run", "case.toml", "--set", set]);
        assert_eq!(ran.code, Some(2), "{set}");
        assert!(
            ran.stderr.contains("--set") && ran.stderr.contains("wanted"),
            "{}",
            ran.stderr
        );
    }
    assert_eq!(folder.names(), ["case.toml"]);
}

#[test]
fn a_wrong_command_line_exits_with_2() {
    let folder = TestFolder::with_case(CASE);
    for line in [
        &["walk"][..],
        &["run"],
        &["run", "case.toml", "--threads", "0"],
        &["kernel", "case.toml"],
        &["kernel", "case.toml", "--wavenumber", "0"],
        &["kernel", "case.toml", "--wavenumber", "nan"],
        &["influence", "case.toml", "--offset", "1"],
        &["influence", "case.toml", "--offset", "a,b"],
        &["plot", "nowhere"],
    ] {
        let ran = folder.run(line);
        assert_eq!(ran.code, Some(2), "{line:?}: {}", ran.stderr);
        assert_eq!(ran.stdout, "", "{line:?}");
    }
}

#[test]
fn a_withdrawn_option_or_key_is_answered_with_what_to_use_instead() {
    let fit = "[model]\nfoundation = { substrate = { young_modulus = \"10 GPa\", poisson_ratio = 0.3 } }\n\
               indenter = { kind = \"paraboloid\", radius = \"10 um\" }\n[unknown]\n\
               \"indenter.radius\" = { from = \"1 um\", to = \"1 mm\" }\n[report]\nposterior = 4000\n";
    let folder = TestFolder::with_case(CASE);
    std::fs::write(folder.path("fit.toml"), fit).unwrap();
    for (line, words) in [
        (
            &["study", "study.toml", "--resume"][..],
            ["--resume: found", "wanted no option", "--fresh"],
        ),
        (
            &["plot", "results", "--colour-map", "magma"],
            ["--colour-map magma: found", "wanted viridis", "greys"],
        ),
        (
            &["identify", "fit.toml", "--plan"],
            ["key `report.posterior`", "withdrawn key, wanted", "emcee"],
        ),
    ] {
        // The drawing of a file breaks no sentence, but precedes it with marks.
        let ran = folder.run(line);
        assert_eq!((ran.code, ran.stdout.as_str()), (Some(2), ""), "{line:?}");
        for word in words {
            assert!(ran.stderr.contains(word), "{word}: {}", ran.stderr);
        }
    }
    assert_eq!(folder.names(), ["case.toml", "fit.toml"]);
}

#[test]
fn setting_a_second_load_is_rejected_with_what_to_write() {
    let curve = CASE.replace("force = \"1 uN\"", "forces = [\"1 uN\", \"2 uN\"]");
    let folder = TestFolder::with_case(curve);
    let ran = folder.run(&["run", "case.toml", "--set", "load.force=3 uN"]);
    assert_eq!(ran.code, Some(2));
    assert!(
        ran.stderr.contains("found force and forces"),
        "{}",
        ran.stderr
    );
    let hint = "--set load='{ force = \"3 mN\" }'";
    assert!(ran.stderr.contains(hint), "{}", ran.stderr);
}

#[test]
fn study_list_rejects_whatever_the_study_rejects() {
    let study = format!("{CASE}\n[study.vary]\n\"indenter.radius\" = [\"-1 um\"]\n");
    let folder = TestFolder::with_case(study);
    let [listed, solved] = [
        &["study", "case.toml", "--list"][..],
        &["study", "case.toml"],
    ]
    .map(|line| folder.run(line));
    assert_eq!((listed.code, solved.code), (Some(2), Some(2)));
    assert_eq!(listed.stderr, solved.stderr);
    assert!(listed.stdout.is_empty());
}
