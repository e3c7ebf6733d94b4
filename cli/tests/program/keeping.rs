//! Nothing is lost or overwritten: folders are claimed before the work, files of others are kept, and tables read back
//! as written.

use std::fs;
use std::process::{Child, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use super::runner::{CASE, ProgramOutput, TestFolder, names};

/// Three cases that take almost no time.
const STUDY: &str =
    "[study]\ncase = \"case.toml\"\n[study.vary]\nload.force = [\"1 uN\", \"2 uN\", \"3 uN\"]\n";

fn read(folder: &TestFolder, name: &str) -> String {
    fs::read_to_string(folder.path(name)).unwrap()
}

fn refused(ran: &ProgramOutput, words: &str) {
    assert_eq!(ran.code, Some(2), "{}", ran.stderr);
    assert!(ran.stderr.contains(words), "{words} in: {}", ran.stderr);
}

#[test]
fn simultaneous_runs_of_one_case_have_separate_folders() {
    let folder = TestFolder::with_case(CASE);
    let forces = ["1 uN", "2 uN", "3 uN", "4 uN"];
    let start = |force| {
        let set = format!("load.force={force}");
        let line = ["run", "case.toml", "--quiet", "--set", &set];
        folder.command(&line).spawn().unwrap()
    };
    let children: Vec<Child> = forces.map(start).into();
    for mut child in children {
        assert_eq!(child.wait().unwrap().code(), Some(0));
    }
    let places = names(&folder.path("results"));
    assert_eq!(places, ["case", "case-2", "case-3", "case-4"]);
    let force = |name: &String| {
        let summary = folder.summary(&format!("results/{name}"));
        summary["case"]["load"]["force"].as_f64().unwrap()
    };
    let mut found: Vec<_> = places.iter().map(force).collect();
    found.sort_by(f64::total_cmp);
    assert_eq!(found, [1e-6, 2e-6, 3e-6, 4e-6]);
}

#[test]
fn an_empty_folder_is_used_also_as_dot_and_through_a_link() {
    let folder = TestFolder::with_case(CASE);
    fs::create_dir(folder.path("empty")).unwrap();
    let mut command = folder.command(&["run", "../case.toml", "--quiet", "--out", "."]);
    let ran = TestFolder::ran(command.current_dir(folder.path("empty")));
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert!(folder.path("empty/summary.json").exists());
    #[cfg(unix)]
    {
        fs::create_dir(folder.path("elsewhere")).unwrap();
        std::os::unix::fs::symlink("elsewhere", folder.path("link")).unwrap();
        let ran = folder.run(&["run", "case.toml", "--quiet", "--out", "link"]);
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        assert!(folder.path("elsewhere/summary.json").exists());
        assert!(folder.path("link").is_symlink());
    }
}

#[test]
fn force_replaces_every_file_of_the_older_run_and_no_others() {
    let folder = TestFolder::with_case(CASE);
    let run = |more: &[&str]| {
        folder.run(&[&["run", "case.toml", "--quiet", "--out", "a"], more].concat())
    };
    assert_eq!(run(&[]).code, Some(0));
    let files = names(&folder.path("a"));
    let three = "load={forces=[\"1 uN\", \"2 uN\", \"3 uN\"]}";
    assert_eq!(run(&["--force", "--set", three]).code, Some(0));
    assert!(names(&folder.path("a")).len() > files.len());
    fs::write(folder.path("a/thesis.tex"), "mine").unwrap();
    assert_eq!(run(&["--force"]).code, Some(0));
    let mut expected = [files, vec!["thesis.tex".into()]].concat();
    expected.sort();
    assert_eq!(names(&folder.path("a")), expected);
    assert_eq!(read(&folder, "a/thesis.tex"), "mine");
}

#[test]
fn a_file_of_the_user_with_the_name_of_a_result_is_not_replaced() {
    let folder = TestFolder::with_case(CASE);
    let line = ["run", "case.toml", "--quiet", "--out", "a", "--force"];
    assert_eq!(folder.run(&line).code, Some(0));
    let curve = read(&folder, "a/curve.csv");
    let longer = format!("{curve}1,2,3\n");
    for (name, text) in [
        ("a/curve.csv", "time,force\n1,2\n"),
        ("a/curve.csv", &longer),
        ("a/section-001.png", "mine"),
    ] {
        fs::write(folder.path(name), text).unwrap();
        refused(&folder.run(&line), name);
        assert_eq!(read(&folder, name), text);
        fs::write(folder.path("a/curve.csv"), &curve).unwrap();
    }
    fs::remove_file(folder.path("a/section-001.png")).unwrap();
    assert_eq!(folder.run(&line).code, Some(0));
}

#[test]
fn a_summary_of_another_origin_is_not_replaced_by_a_run_or_a_study() {
    let folder = TestFolder::with_study(CASE, STUDY);
    let foreign = ["a", "results/many/cases/case-0002"];
    for place in foreign {
        fs::create_dir_all(folder.path(place)).unwrap();
        fs::write(folder.path(place).join("summary.json"), "{}").unwrap();
        fs::write(folder.path(place).join("thesis.tex"), "mine").unwrap();
    }
    refused(
        &folder.run(&["run", "case.toml", "--out", "a", "--force"]),
        "other than a results folder",
    );
    refused(&folder.study(&["--folders"]), "other than a results folder");
    for place in foreign {
        assert_eq!(
            names(&folder.path(place)),
            ["summary.json", "thesis.tex"],
            "{place}"
        );
    }
}

#[test]
fn a_study_replaces_only_folders_of_its_own_cases() {
    let folder = TestFolder::with_study(CASE, STUDY);
    let case = "results/many/cases/case-0002";
    let place = folder.path(case);
    let out = place.to_str().unwrap().to_owned();
    let other = [
        "run",
        "case.toml",
        "--quiet",
        "--out",
        &out,
        "--set",
        "title=other",
    ];
    assert_eq!(folder.run(&other).code, Some(0));
    refused(&folder.study(&["--folders"]), "another case");
    assert_eq!(folder.summary(case)["title"], "other");
    let same = ["run", "case.toml", "--quiet", "--out", &out, "--force"];
    let set = ["--set", "load.force=2 uN"];
    assert_eq!(folder.run(&[&same[..], &set].concat()).code, Some(0));
    fs::write(place.join("thesis.tex"), "mine").unwrap();
    let ran = folder.study(&["--folders"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert_eq!(
        fs::read_to_string(place.join("thesis.tex")).unwrap(),
        "mine"
    );
}

#[test]
fn commas_and_quotes_in_a_value_are_read_back() {
    let titles = ["a b", "-2", "e,f", "g\"h", "\"i\"", "k"];
    let list = serde_json::to_string(&titles).unwrap();
    let folder = TestFolder::with_study(
        CASE,
        &format!("[study]\ncase = \"case.toml\"\n[study.vary]\ntitle = {list}\n"),
    );
    // The second time the table is read and nothing is left to do.
    for _ in 0..2 {
        let report = folder.run(&["study", "many.toml", "--json"]).json();
        assert_eq!(
            (&report["cases"], &report["certified"]),
            (&6.into(), &6.into())
        );
    }
    let mut reader = csv::Reader::from_path(folder.path("results/many/results.csv")).unwrap();
    let rows = reader.records().map(|row| row.unwrap()[2].to_owned());
    assert_eq!(rows.collect::<Vec<_>>(), titles);
    let listed = folder.study(&["--list"]).stdout;
    assert_eq!(listed.lines().next(), Some("case 1: title = a b"));
}

#[test]
fn gather_replaces_no_table_of_another_study_or_of_the_user() {
    let folder = TestFolder::with_study(CASE, STUDY);
    let whole = "results/many/results.csv";
    for shard in ["1/2", "2/2"] {
        assert_eq!(folder.study(&["--shard", shard]).code, Some(0));
    }
    fs::write(folder.path(whole), "mine\n").unwrap();
    for more in [&[][..], &["--force"]] {
        let line = [&["gather", "results/many"], more].concat();
        refused(&folder.run(&line), "results.csv");
        assert_eq!(read(&folder, whole), "mine\n");
    }
    // Another, finished study, whose folder received the parts.
    fs::write(folder.path("many.toml"), STUDY.replace("3 uN", "4 uN")).unwrap();
    assert_eq!(folder.study(&["--out", "other"]).code, Some(0));
    for name in ["results.csv", "study.json"] {
        fs::copy(
            folder.path("other").join(name),
            folder.path("results/many").join(name),
        )
        .unwrap();
    }
    let other = read(&folder, whole);
    refused(&folder.run(&["gather", "results/many"]), "--force");
    assert_eq!(read(&folder, whole), other);
    let forced = folder.run(&["gather", "results/many", "--force"]);
    assert_eq!(forced.code, Some(0), "{}", forced.stderr);
    assert_ne!(read(&folder, whole), other);
}

#[test]
fn parts_of_two_studies_are_not_mixed_in_one_folder() {
    let folder = TestFolder::with_study(CASE, STUDY);
    assert_eq!(folder.study(&[]).code, Some(0));
    let whole = read(&folder, "results/many/results.csv");
    fs::write(folder.path("many.toml"), STUDY.replace("3 uN", "4 uN")).unwrap();
    refused(&folder.study(&["--shard", "1/2"]), "--fresh");
    assert_eq!(read(&folder, "results/many/results.csv"), whole);
    assert_eq!(folder.study(&["--shard", "1/2", "--fresh"]).code, Some(0));
    let part = ["results-1-of-2.csv", "study-1-of-2.json"];
    // The existing table stays until the complete new one replaces it.
    let before = ".pellicle-before-results.csv";
    let there = names(&folder.path("results/many"));
    assert_eq!(there, [&[before], &part[..]].concat());
    assert_eq!(read(&folder, &format!("results/many/{before}")), whole);
    assert_eq!(folder.study(&["--shard", "2/2"]).code, Some(0));
    assert_eq!(folder.run(&["gather", "results/many"]).code, Some(0));
    assert_eq!(read(&folder, "results/many/results.csv").lines().count(), 4);
    let there = names(&folder.path("results/many"));
    assert!(!there.contains(&before.to_owned()), "{there:?}");
}

#[test]
fn a_table_of_the_user_is_not_overwritten() {
    let folder = TestFolder::with_study(CASE, STUDY);
    fs::create_dir_all(folder.path("a")).unwrap();
    fs::write(folder.path("a/results.csv"), "mine\n").unwrap();
    for more in [&[][..], &["--fresh"], &["--shard", "1/2"]] {
        refused(
            &folder.study(&[&["--out", "a"], more].concat()),
            "results.csv",
        );
        assert_eq!(read(&folder, "a/results.csv"), "mine\n");
    }
}

#[test]
fn simultaneous_gathers_all_succeed() {
    let folder = TestFolder::with_study(CASE, STUDY);
    for shard in ["1/2", "2/2"] {
        assert_eq!(folder.study(&["--shard", shard]).code, Some(0));
    }
    let start = |_| {
        let mut command = folder.command(&["gather", "results/many"]);
        command.stderr(Stdio::null()).spawn().unwrap()
    };
    let children: Vec<Child> = (0..4).map(start).collect();
    for mut child in children {
        assert_eq!(child.wait().unwrap().code(), Some(0));
    }
    assert_eq!(read(&folder, "results/many/results.csv").lines().count(), 4);
    assert_eq!(names(&folder.path("results/many")).len(), 7);
}

#[test]
fn writing_a_template_keeps_an_existing_file_of_a_temporary_name() {
    let folder = TestFolder::new();
    fs::write(folder.path(".partial-case.toml"), "mine").unwrap();
    let ran = folder.run(&["init", "--out", "case.toml"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert_eq!(folder.names(), [".partial-case.toml", "case.toml"]);
    assert_eq!(read(&folder, ".partial-case.toml"), "mine");
}

#[cfg(unix)]
#[test]
fn links_in_a_foreign_folder_are_not_followed() {
    use std::os::unix::fs::symlink;
    let folder = TestFolder::with_study(CASE, STUDY);
    fs::write(folder.path("bashrc"), "mine").unwrap();
    assert_eq!(
        folder.run(&["run", "case.toml", "--out", "a"]).code,
        Some(0)
    );
    assert_eq!(folder.study(&[]).code, Some(0));
    let link = |name: &str| {
        drop(fs::remove_file(folder.path(name)));
        symlink(folder.path("bashrc"), folder.path(name)).unwrap();
    };
    for name in ["report.html", "section-000.svg", "section-000.png"] {
        link(&format!("a/{name}"));
        link(&format!("a/.partial-{name}"));
    }
    assert_eq!(folder.run(&["plot", "a"]).code, Some(0));
    link(".partial-new.toml");
    assert_eq!(folder.run(&["init", "--out", "new.toml"]).code, Some(0));
    link("results/many/.partial-study.json");
    assert_eq!(folder.study(&[]).code, Some(0));
    link("results/many/results.csv");
    for more in [&[][..], &["--fresh"]] {
        assert_eq!(folder.study(more).code, Some(2));
    }
    assert_eq!(read(&folder, "bashrc"), "mine");
}

/// Waits until a condition holds that a child has to meet first.
fn wait_for(child: &mut Child, is_so: impl Fn() -> bool) {
    let start = Instant::now();
    while !is_so() {
        assert!(start.elapsed() < Duration::from_mins(1), "never so");
        assert!(child.try_wait().unwrap().is_none(), "ended too early");
        sleep(Duration::from_millis(5));
    }
}

#[test]
fn remains_of_a_killed_run_are_marked_and_removed_by_the_next() {
    let folder = TestFolder::with_case(CASE);
    let long = [
        "--set",
        "grid.elements=2048",
        "--set",
        "solver.tolerance=1e-13",
    ];
    let line = [&["run", "case.toml", "--quiet"][..], &long].concat();
    let mut child = folder.command(&line).spawn().unwrap();
    let place = folder.path("results/case");
    let is_claimed = || place.is_dir() && names(&place).len() == 2;
    wait_for(&mut child, is_claimed);
    // Other runs pass over a folder that is claimed.
    assert_eq!(folder.run(&["run", "case.toml", "--quiet"]).code, Some(0));
    assert_eq!(names(&folder.path("results")), ["case", "case-2"]);
    child.kill().unwrap();
    child.wait().unwrap();
    let lock = fs::read_to_string(place.join(".pellicle-lock")).unwrap();
    assert!(
        lock.contains("pellicle") && lock.contains("next run"),
        "{lock}"
    );
    let other = ["run", "case.toml", "--quiet", "--out", "results/other"];
    assert_eq!(folder.run(&other).code, Some(0));
    assert_eq!(names(&folder.path("results")), ["case-2", "other"]);
}

#[cfg(unix)]
#[test]
fn a_case_whose_name_without_extension_is_that_of_a_folder_has_its_own_results() {
    let folder = TestFolder::new();
    for name in ["..toml", "...toml"] {
        fs::write(folder.path(name), CASE).unwrap();
        let ran = folder.run(&[
            "run",
            name,
            "--quiet",
            "--pictures",
            "none",
            "--fields",
            "none",
        ]);
        assert_eq!(ran.code, Some(0), "{name}: {}", ran.stderr);
        fs::write(
            folder.path(name),
            format!("{CASE}{}", "[study.vary]\nload.force = [\"2 uN\"]\n"),
        )
        .unwrap();
        let ran = folder.run(&[
            "study",
            name,
            "--quiet",
            "--fresh",
            "--out",
            &format!("study{name}"),
        ]);
        assert_eq!(ran.code, Some(0), "{name}: {}", ran.stderr);
    }
    assert_eq!(names(&folder.path("results")), ["...toml", "..toml"]);
    assert_eq!(folder.summary("results/..toml")["title"], "Test");
}
