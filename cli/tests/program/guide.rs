//! The guide: its commands, run one after the other as written.
#![cfg(unix)]

use std::env;
use std::fs;
use std::path::Path;
use std::process::Command;

use super::runner::{TestFolder, names};

const GUIDE: &str = include_str!("../../../docs/guide.md");

/// The code blocks of the guide: language and text.
fn blocks() -> Vec<(&'static str, &'static str)> {
    let blocks = GUIDE.split("```").skip(1).step_by(2);
    blocks.filter_map(|block| block.split_once('\n')).collect()
}

/// The search path, with the program's folder first.
fn path() -> String {
    let folder = Path::new(env!("CARGO_BIN_EXE_pellicle")).parent().unwrap();
    format!("{}:{}", folder.display(), env::var("PATH").unwrap())
}

/// Set it to write the listings as printed now into the guide.
const UPDATE: &str = "PELLICLE_UPDATE_GUIDE";

#[test]
fn every_command_of_the_guide_works_as_described_and_prints_what_it_lists() {
    let (folder, path) = (TestFolder::new(), path());
    let (mut printed, mut guide) = (String::new(), GUIDE.to_owned());
    for (language, text) in blocks() {
        // A block with a file name is saved under it.
        let name = text.strip_prefix("# ").and_then(|text| text.lines().next());
        match (language, name) {
            ("toml", Some(name)) => fs::write(folder.path(name), text).unwrap(),
            ("sh", _) => {
                let lines = text.lines();
                printed = lines.map(|line| run(&folder, &path, line)).collect();
            }
            ("text", _) => guide = guide.replace(text, &listing_now(text, &printed)),
            _ => {}
        }
    }
    if env::var_os(UPDATE).is_some() {
        fs::write(
            concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/guide.md"),
            &guide,
        )
        .unwrap();
    }
    let differing = GUIDE
        .lines()
        .zip(guide.lines())
        .find(|(old, new)| old != new);
    assert_eq!(
        differing, None,
        "(in the guide, printed now); {UPDATE}=1 writes what is printed"
    );
    let studies = ["results/thickness", "results/study"].map(|study| names(&folder.path(study)));
    assert_eq!(studies[0], ["report.html", "results.csv", "study.json"]);
    // Tables and identities of the whole and its parts, a page, and for each the fields on two grids.
    assert_eq!(studies[1].len(), 13);
}

/// Runs a line of the guide and returns what it prints.
fn run(folder: &TestFolder, path: &str, line: &str) -> String {
    let mut command = Command::new("sh");
    let command = command.args(["-c", line]).current_dir(folder.path("."));
    let ran = TestFolder::ran(command.env("PATH", path).env("PELLICLE_CACHE", ""));
    assert_eq!(ran.code, Some(0), "{line}: {}", ran.stderr);
    ran.stdout + &ran.stderr
}

/// The part of a print-out from the first to the last line of a listing, which are found by their words. Lines that
/// differ from the listing by seconds alone are those of the listing.
fn listing_now(listing: &str, printed: &str) -> String {
    let words = |line: &str| {
        line.split(|c: char| c.is_ascii_digit())
            .next()
            .unwrap()
            .to_owned()
    };
    let untimed = |line: &str| match line.rsplit_once(", ") {
        Some((start, end)) if end.ends_with(" s") => start.to_owned(),
        _ => line.to_owned(),
    };
    let listed: Vec<_> = listing.lines().collect();
    let printed: Vec<_> = printed.lines().collect();
    let place = |wanted: &str| printed.iter().position(|line| words(line) == words(wanted));
    let ends = [listed[0], listed[listed.len() - 1]].map(place);
    let [Some(first), Some(last)] = ends else {
        panic!("{listing} is not in {printed:#?}")
    };
    let now = printed[first..=last].iter().map(|line| {
        let alike = listed
            .iter()
            .find(|listed| untimed(listed) == untimed(line));
        format!("{}\n", alike.unwrap_or(line))
    });
    now.collect()
}

#[test]
fn the_first_case_of_the_guide_matches_the_template() {
    let template = TestFolder::new().run(&["init", "coating"]).stdout;
    let case = blocks()
        .into_iter()
        .find(|(language, _)| *language == "toml");
    let lines = |text: &str| -> Vec<String> {
        let lines = text
            .lines()
            .filter(|line| !line.starts_with('#') && !line.is_empty());
        lines
            .filter(|line| !line.starts_with("title"))
            .map(str::to_owned)
            .collect()
    };
    assert_eq!(lines(case.unwrap().1), lines(&template));
}

#[test]
fn recipes_match_the_case_files_of_their_names() {
    for name in ["dlc-on-steel.toml", "crn-sliding.toml", "soft-metal.toml"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("../cases")
            .join(name);
        let case = fs::read_to_string(path).unwrap();
        let head = format!("# {name}");
        let recipe = blocks()
            .into_iter()
            .find(|(_, text)| text.lines().next() == Some(&head));
        let lines = |text: &str| -> Vec<String> {
            let lines = text.lines().filter(|line| !line.starts_with('#'));
            lines
                .filter(|line| !line.is_empty())
                .map(str::to_owned)
                .collect()
        };
        assert_eq!(lines(recipe.unwrap().1), lines(&case));
    }
}
