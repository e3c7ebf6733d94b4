//! Folders that are claimed, filled, lost and left behind.

use pellicle::summary;
use pellicle_files::staging::{COMPLETE, EMPTYING, FILLING};
use tempfile::TempDir;

use super::claim_lock::MADE;
use super::*;

fn summary(title: &str) -> String {
    format!(
        r#"{{"schema": "{}", "program": "pellicle", "case": {{}}, "title": "{title}"}}"#,
        summary::SCHEMA
    )
}

fn fill(
    completeness: Completeness,
    title: &str,
) -> impl FnOnce(&Path) -> Result<Completeness, Failure> {
    move |folder| {
        fs::write(folder.join(summary::FILE), summary(title)).unwrap();
        fs::write(folder.join(format!("section-{title}.svg")), title).unwrap();
        Ok(completeness)
    }
}

fn put(
    path: &Path,
    existing: Existing,
    completeness: Completeness,
    title: &'static str,
) -> PathBuf {
    let folder = ResultsFolder::claim(path, existing).unwrap();
    folder.write(fill(completeness, title)).unwrap()
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<_> = names.collect();
    names.sort();
    names
}

fn parent() -> (TempDir, PathBuf) {
    let parent = tempfile::tempdir().unwrap();
    let path = parent.path().join("deep").join("a");
    (parent, path)
}

#[test]
fn existing_results_are_kept_unless_replacement_is_allowed() {
    let (_parent, path) = parent();
    put(&path, Existing::Keep, Completeness::Whole, "001");
    let kept = ResultsFolder::claim(&path, Existing::Keep);
    assert!(matches!(kept, Err(Failure::File(FileError::Exists { .. }))));
    fs::write(path.join("thesis.tex"), "").unwrap();
    put(&path, Existing::Replace, Completeness::Whole, "002");
    assert_eq!(
        names(&path),
        ["section-002.svg", "summary.json", "thesis.tex"]
    );
}

#[test]
fn partial_results_never_replace_complete_ones() {
    let (_parent, path) = parent();
    assert_eq!(
        put(&path, Existing::Replace, Completeness::Part, "001"),
        path
    );
    for place in ["stopped", "stopped-2"] {
        let put = put(&path, Existing::Replace, Completeness::Part, "002");
        assert_eq!(put, path.join(place));
        assert_eq!(names(&put), ["section-002.svg", "summary.json"]);
    }
    assert_eq!(
        names(&path),
        ["section-001.svg", "stopped", "stopped-2", "summary.json"]
    );
}

#[test]
fn a_claimed_folder_is_exclusive_and_leaves_nothing_on_failure() {
    let (parent, path) = parent();
    let folder = ResultsFolder::claim(&path, Existing::Keep).unwrap();
    for existing in [Existing::Keep, Existing::Replace] {
        let second = ResultsFolder::claim(&path, existing);
        assert!(matches!(second, Err(Failure::File(FileError::Busy { .. }))));
    }
    let failed = folder.write(|scratch| {
        fs::write(scratch.join("half"), "").unwrap();
        assert!(names(&path).iter().all(|name| name.starts_with('.')));
        Err(Failure::OneResult)
    });
    assert!(failed.is_err());
    assert_eq!(names(parent.path()), [""; 0]);
}

#[test]
fn an_empty_folder_is_used_and_a_foreign_one_never_replaced() {
    let path = tempfile::tempdir().unwrap();
    drop(ResultsFolder::claim(path.path(), Existing::Keep).unwrap());
    for name in ["thesis.tex", summary::FILE] {
        fs::write(path.path().join(name), "").unwrap();
        for existing in [Existing::Keep, Existing::Replace] {
            let claimed = ResultsFolder::claim(path.path(), existing);
            assert!(matches!(
                claimed,
                Err(Failure::File(FileError::NoResults { .. }))
            ));
        }
    }
}

#[test]
fn files_that_appear_meanwhile_are_kept_and_so_are_the_results() {
    let (_parent, path) = parent();
    let folder = ResultsFolder::claim(&path, Existing::Keep).unwrap();
    fs::write(path.join(summary::FILE), "mine").unwrap();
    let written = folder.write(fill(Completeness::Whole, "001")).unwrap();
    assert_eq!(written, path.join("results"));
    assert_eq!(
        fs::read_to_string(path.join(summary::FILE)).unwrap(),
        "mine"
    );
}

/// A folder as a kill leaves it: `inside` are the files in the hidden folder of this name, `beside` those beside it.
fn left(hidden: &str, inside: &[&str], beside: &[&str]) -> (TempDir, PathBuf) {
    let (parent, path) = parent();
    let hidden = path.join(format!("{hidden}0"));
    fs::create_dir_all(&hidden).unwrap();
    fs::write(path.join(LOCK), MADE).unwrap();
    let places = inside.iter().map(|name| hidden.join(name));
    for place in places.chain(beside.iter().map(|name| path.join(name))) {
        fs::write(place, summary("left")).unwrap();
    }
    (parent, path)
}

#[test]
fn half_written_results_of_a_killed_run_are_removed_by_the_next() {
    let (parent, path) = left(FILLING, &["fields-000.npz", ".pellicle-0.partial"], &[]);
    sweep_beside(&path.with_file_name("b"));
    assert_eq!(names(&parent.path().join("deep")), [""; 0]);
    let (_parent, path) = left(FILLING, &["fields-000.npz"], &["curve.csv", summary::FILE]);
    put(&path, Existing::Replace, Completeness::Whole, "001");
    assert_eq!(names(&path), ["section-001.svg", "summary.json"]);
}

#[test]
fn complete_results_of_a_killed_run_are_moved_into_place_by_the_next() {
    let new = ["fields-001.npz", summary::FILE];
    let (_parent, path) = left(COMPLETE, &new, &["fields-000.npz", "curve.csv", "notes"]);
    sweep_beside(&path);
    assert_eq!(names(&path), ["fields-001.npz", "notes", "summary.json"]);
    let (_parent, path) = left(EMPTYING, &new, &["curve.csv"]);
    let claimed = ResultsFolder::claim(&path, Existing::Keep);
    assert!(matches!(
        claimed,
        Err(Failure::File(FileError::Exists { .. }))
    ));
    assert_eq!(
        names(&path),
        ["curve.csv", "fields-001.npz", "summary.json"]
    );
}

#[test]
fn folders_of_other_origin_are_not_removed() {
    let (_parent, path) = left(FILLING, &["thesis.tex"], &[]);
    sweep_beside(&path);
    assert_eq!(names(&path), [format!("{FILLING}0")]);
    fs::remove_file(path.join(format!("{FILLING}0/thesis.tex"))).unwrap();
    // Without a lock, no process has claimed it.
    sweep_beside(&path);
    assert_eq!(names(&path), [format!("{FILLING}0")]);
}

#[cfg(target_os = "linux")]
#[test]
fn older_results_are_complete_until_the_new_ones_are() {
    use std::sync::atomic::{AtomicBool, Ordering};
    let (_parent, path) = parent();
    put(&path, Existing::Replace, Completeness::Whole, "000");
    fs::write(path.join("thesis.tex"), "").unwrap();
    let is_done = AtomicBool::new(false);
    std::thread::scope(|scope| {
        let watching = scope.spawn(|| {
            let mut looks = 0;
            while !is_done.load(Ordering::Relaxed) {
                assert!(path.join(summary::FILE).exists(), "after {looks} looks");
                looks += 1;
            }
        });
        for title in ["001", "002"].repeat(100) {
            put(&path, Existing::Replace, Completeness::Whole, title);
        }
        is_done.store(true, Ordering::Relaxed);
        watching.join().unwrap();
    });
    let wanted = ["section-002.svg", "summary.json", "thesis.tex"];
    assert_eq!(names(&path), wanted);
    assert_eq!(names(path.parent().unwrap()), ["a"]);
}

#[test]
fn of_folders_left_by_a_kill_during_the_exchange_the_files_of_others_are_kept() {
    // Before the exchange the new results are beside the older ones, after it the older ones.
    for beside in [
        &["fields-001.npz", summary::FILE][..],
        &["fields-000.npz", "notes"],
    ] {
        let (_parent, path) = left(FILLING, &[], &["curve.csv", summary::FILE]);
        let swapped = path.with_file_name(".pellicle-swap-x-a");
        let of_another = path.with_file_name(".pellicle-swap-x-b-a");
        for folder in [&swapped, &of_another] {
            fs::create_dir(folder).unwrap();
            for name in [beside, &[LOCK]].concat() {
                fs::write(folder.join(name), summary("left")).unwrap();
            }
        }
        drop(ResultsFolder::claim(&path, Existing::Replace).unwrap());
        let notes = beside.contains(&"notes").then_some("notes");
        let wanted = ["curve.csv"]
            .into_iter()
            .chain(notes)
            .chain([summary::FILE]);
        assert_eq!(names(&path), wanted.collect::<Vec<_>>());
        assert!(!swapped.exists() && of_another.exists());
    }
}
