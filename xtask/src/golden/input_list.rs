//! The runs that `xtask/golden/runs.toml` lists: command lines, and texts with one fault each.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;

use super::collection::{files_of, read};
use super::files::Files;
use super::run::{InputFile, Run};
use crate::XtaskError;

/// The folder of the list, whose other files are beside each run.
const FOLDER: &str = "xtask/golden";
const LIST: &str = "runs.toml";
/// The measured curves of the fit to tungsten.
const CURVES: &str = "identify/tests/curves";
const TUNGSTEN: &str = "tungsten";

/// The list with the files that its runs read.
#[derive(Debug)]
pub struct InputList {
    listed: Listed,
    files: Vec<InputFile>,
    curves: Vec<InputFile>,
}

/// What the list contains.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Listed {
    stream: String,
    commands: Vec<Vec<String>>,
    case: Faulty,
    study: Faulty,
    fit: Faulty,
    files: BTreeMap<String, String>,
}

/// A text, the command line that reads it from its file, and its faults.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Faulty {
    file: String,
    line: Vec<String>,
    text: String,
    /// Each a name, then texts that stand once, each followed by what replaces it.
    faults: Vec<Vec<String>>,
}

impl InputList {
    /// Reads the list; `root` is that of the workspace.
    pub fn read(root: &Path) -> Result<Self, XtaskError> {
        let path = root.join(FOLDER).join(LIST);
        let text = String::from_utf8_lossy(&read(&path)?).into_owned();
        let listed: Result<Listed, _> = toml::from_str(&text);
        let listed =
            listed.map_err(|cause| XtaskError::read(&path, std::io::Error::other(cause)))?;
        let mut files = folder(&root.join(FOLDER), |name| name != LIST)?;
        let case = (listed.case.file.clone(), listed.case.text.as_bytes().into());
        files.push(case);
        let small = listed.files.iter();
        files.extend(small.map(|(name, text)| (name.clone(), text.as_bytes().into())));
        Ok(Self {
            curves: folder(&root.join(CURVES), |name| {
                name.starts_with(TUNGSTEN)
                    && Path::new(name).extension().is_some_and(|end| end == "csv")
            })?,
            listed,
            files,
        })
    }

    /// All runs of the list.
    pub fn runs(&self) -> Vec<Run> {
        let Listed {
            commands,
            case,
            study,
            fit,
            ..
        } = &self.listed;
        let faulty = [("case", case), ("study", study), ("fit", fit)];
        let faulty = faulty.into_iter().flat_map(|(name, texts)| {
            let run = move |fault: &Vec<String>| self.faulty(name, texts, fault);
            texts.faults.iter().map(run)
        });
        commands
            .iter()
            .map(|line| self.command(line))
            .chain(faulty)
            .collect()
    }

    fn command(&self, line: &[String]) -> Run {
        let words: Vec<&str> = line.iter().map(String::as_str).collect();
        let mut files = self.files.clone();
        if words.iter().any(|word| word.starts_with(TUNGSTEN)) {
            files.extend(self.curves.iter().cloned());
        }
        let name = words.join(" ").replace('/', " of ");
        let mut run = Run::new(&format!("command/{name}"), &words, files);
        let out = words.iter().position(|word| *word == "--out");
        run.out = out
            .and_then(|at| words.get(at + 1))
            .map(|out| ((*out).into(), Files::All));
        if words.first() == Some(&"solve") {
            run.stdin.clone_from(&self.listed.stream);
        }
        run
    }

    fn faulty(&self, kind: &str, texts: &Faulty, fault: &[String]) -> Run {
        let name = fault.first().map_or("", String::as_str);
        let mut text = texts.text.clone();
        for replacement in fault.get(1..).unwrap_or_default().chunks(2) {
            if let [from, to] = replacement {
                text = text.replacen(from.as_str(), to, 1);
            }
        }
        let line: Vec<&str> = texts.line.iter().map(String::as_str).collect();
        let mut files = self.files.clone();
        files.retain(|(name, _)| *name != texts.file);
        files.push((texts.file.clone(), text.into_bytes().into()));
        Run::new(&format!("{kind}/{name}"), &line, files)
    }
}

/// The files of a folder whose names are wanted, by their names.
fn folder(path: &Path, is_wanted: impl Fn(&str) -> bool) -> Result<Vec<InputFile>, XtaskError> {
    let mut files = Vec::new();
    for path in files_of(path)? {
        let name = path
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        if is_wanted(&name) {
            files.push((name, read(&path)?.into()));
        }
    }
    Ok(files)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn list() -> InputList {
        InputList::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("..")).unwrap()
    }

    #[test]
    fn every_fault_replaces_texts_that_stand_once() {
        let Listed {
            case, study, fit, ..
        } = list().listed;
        for Faulty { text, faults, .. } in [case, study, fit] {
            assert!(faults.len() > 20);
            for fault in faults {
                let (name, replacements) = fault.split_first().unwrap();
                assert!(
                    !replacements.is_empty() && replacements.len() % 2 == 0,
                    "{name}"
                );
                for from in replacements.iter().step_by(2) {
                    assert_eq!(text.matches(from.as_str()).count(), 1, "{name}: {from}");
                }
            }
        }
    }

    #[test]
    fn the_fit_to_tungsten_finds_its_curves_and_a_command_what_it_writes() {
        let runs = list().runs();
        let run = |name: &str| runs.iter().find(|run| run.name == name).unwrap();
        let tungsten = run("command/identify tungsten-fit.toml --json");
        let curves = tungsten
            .files
            .iter()
            .filter(|(name, _)| name.starts_with("tungsten_sphere"));
        assert_eq!(curves.count(), 8);
        let study = run("command/study film-study.toml --out out --quiet");
        assert_eq!(study.out, Some(("out".into(), Files::All)));
        assert!(
            run("command/solve --stream case.toml")
                .stdin
                .contains("load.force")
        );
    }
}
