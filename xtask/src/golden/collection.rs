//! All runs: the files of `cases`, the commands and faulty texts of `runs.toml`, and random cases.

use std::fs;
use std::path::{Path, PathBuf};

use super::files::Files;
use super::input_list::InputList;
use super::random_case::{RandomCase, random_case};
use super::run::{InputFile, Run};
use crate::XtaskError;

/// Number of random cases.
pub const RANDOM_CASES: u64 = 300;

/// Options of runs whose whole folder is kept: every field and picture of the last step.
const WHOLE: &str =
    "run case.toml --out out --fields last --pictures last --formats npz,vti,nc,gsf";
/// Options of runs whose summary and arrays are kept.
const NUMBERS: &str = "run case.toml --json --out out --fields last --pictures none --formats npz";

/// All runs; `root` is that of the workspace.
pub fn all(root: &Path) -> Result<Vec<Run>, XtaskError> {
    let mut runs = Vec::new();
    for folder in ["cases", "cases/paper"] {
        for path in files_of(&root.join(folder))? {
            let stem = path.file_stem().unwrap_or_default().to_string_lossy();
            let case: InputFile = ("case.toml".into(), read(&path)?.into());
            let whole = run(
                &format!("{folder}/{stem}"),
                WHOLE,
                vec![case.clone()],
                Files::All,
            );
            runs.push(whole);
            let line = ["check", "case.toml"];
            runs.push(Run::new(&format!("check/{stem}"), &line, vec![case]));
        }
    }
    runs.extend(InputList::read(root)?.runs());
    runs.extend((0..RANDOM_CASES).map(random));
    Ok(runs)
}

fn random(seed: u64) -> Run {
    let RandomCase { text, maps } = random_case(seed);
    let case = ("case.toml".to_owned(), text.into_bytes().into());
    let files = [vec![case], maps].concat();
    run(&format!("random/{seed:03}"), NUMBERS, files, Files::Numbers)
}

fn run(name: &str, line: &str, files: Vec<InputFile>, kept: Files) -> Run {
    let words: Vec<&str> = line.split(' ').collect();
    Run {
        out: Some(("out".into(), kept)),
        ..Run::new(name, &words, files)
    }
}

/// The content of a file.
pub fn read(path: &Path) -> Result<Vec<u8>, XtaskError> {
    fs::read(path).map_err(|cause| XtaskError::read(path, cause))
}

/// The files of a folder by name, without its folders.
pub fn files_of(folder: &Path) -> Result<Vec<PathBuf>, XtaskError> {
    let unreadable = |cause| XtaskError::read(folder, cause);
    let entries = fs::read_dir(folder).map_err(unreadable)?;
    let paths = entries.map(|entry| entry.map(|entry| entry.path()));
    let paths: Vec<PathBuf> = paths.collect::<Result<_, _>>().map_err(unreadable)?;
    let mut files: Vec<PathBuf> = paths.into_iter().filter(|path| path.is_file()).collect();
    files.sort();
    Ok(files)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn every_run_has_its_own_name_and_every_case_file_is_run() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let runs = all(&root).unwrap();
        let names: BTreeSet<&str> = runs.iter().map(|run| run.name.as_str()).collect();
        assert_eq!(names.len(), runs.len());
        for name in [
            "cases/hertz",
            "cases/paper/fig6-film",
            "check/fig2a",
            "random/299",
        ] {
            assert!(names.contains(name), "{name}");
        }
        let folders: BTreeSet<String> = names.iter().map(|name| name.replace('/', "-")).collect();
        assert_eq!(
            folders.len(),
            runs.len(),
            "each run has a folder of its own"
        );
    }
}
