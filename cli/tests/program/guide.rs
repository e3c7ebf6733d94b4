//! The guide and its recipes: their commands, run one after the other as written.
#![cfg(unix)]

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::runner::{TestFolder, names};

/// A page and its text.
struct Page {
    path: PathBuf,
    text: String,
}

fn page(name: &str) -> Page {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../docs")
        .join(name);
    let text = fs::read_to_string(&path).unwrap();
    Page { path, text }
}

/// The guide, then the recipes in the order in which it names them.
fn pages() -> Vec<Page> {
    let mut pages = vec![page("guide.md")];
    let rows = pages[0].text.lines();
    let rows = rows.filter_map(|line| line.strip_prefix("| [")?.split(['(', ')']).nth(1));
    let recipes: Vec<Page> = rows.map(page).collect();
    let written = fs::read_dir(pages[0].path.with_file_name("recipes"))
        .unwrap()
        .count();
    assert_eq!(
        recipes.len(),
        written,
        "the guide's table names every recipe"
    );
    pages.extend(recipes);
    pages
}

/// The code blocks of a page: language and text.
fn blocks(page: &Page) -> Vec<(&str, &str)> {
    let blocks = page.text.split("```").skip(1).step_by(2);
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
    let folder = TestFolder::new();
    check(&pages(), &folder);
    let studies = ["results/thickness", "results/study"].map(|study| names(&folder.path(study)));
    assert_eq!(studies[0], ["report.html", "results.csv", "study.json"]);
    // Tables and identities of the whole and its parts, a page, and for each the fields on two grids.
    assert_eq!(studies[1].len(), 13);
}

#[test]
fn every_command_of_the_gallery_draws_its_picture() {
    let (folder, gallery) = (TestFolder::new(), page("gallery.md"));
    let drawings = gallery.text.split("<!-- ").skip(1);
    let drawings = drawings.filter_map(|part| part.split(" -->").next());
    let drawings: Vec<_> = drawings.map(str::to_owned).collect();
    check(&[gallery], &folder);
    assert!(!drawings.is_empty());
    for drawing in drawings {
        assert!(folder.path(&drawing).is_file(), "{drawing}");
    }
}

/// Runs the commands of pages, one after the other in a folder.
fn check(pages: &[Page], folder: &TestFolder) {
    let path = path();
    let mut differing = Vec::new();
    for page in pages {
        let now = run_page(page, folder, &path);
        if env::var_os(UPDATE).is_some() {
            fs::write(&page.path, &now).unwrap();
        }
        let lines = page.text.lines().zip(now.lines());
        let changed = lines.filter(|(old, new)| old != new);
        differing.extend(changed.map(|(old, new)| (old.to_owned(), new.to_owned())));
    }
    assert!(
        differing.is_empty(),
        "{differing:#?} (in the guide, printed now); {UPDATE}=1 writes what is printed"
    );
}

/// Runs the commands of a page and returns its text with the listings as printed now.
fn run_page(page: &Page, folder: &TestFolder, path: &str) -> String {
    let (mut printed, mut now) = (String::new(), page.text.clone());
    for (language, text) in blocks(page) {
        // A block with a file name is saved under it.
        let name = text.strip_prefix("# ").and_then(|text| text.lines().next());
        match (language, name) {
            ("toml", Some(name)) => fs::write(folder.path(name), text).unwrap(),
            ("sh", _) => {
                let lines = text.lines();
                printed = lines.map(|line| run(folder, path, line)).collect();
            }
            ("text", _) => now = now.replace(text, &listing_now(text, &printed)),
            _ => {}
        }
    }
    now
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
    let guide = &pages()[0];
    let case = blocks(guide)
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
    let pages = pages();
    for name in ["dlc-on-steel.toml", "crn-sliding.toml", "soft-metal.toml"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("../cases")
            .join(name);
        let case = fs::read_to_string(path).unwrap();
        let head = format!("# {name}");
        let recipe = pages
            .iter()
            .flat_map(blocks)
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
