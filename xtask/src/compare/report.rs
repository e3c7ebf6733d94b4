//! The whole comparison and the files that keep it.

use std::fmt;
use std::fs;
use std::path::Path;
use std::thread;

use serde::Serialize;

use super::environment::write;
use super::{Row, table};
use crate::XtaskError;

/// The machine and every row so far.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// Processor, where the system tells.
    pub processor: Option<String>,
    /// Processors that may be used at once.
    pub cores: Option<usize>,
    /// The rows, problem by problem, Pellicle's first.
    pub rows: Vec<Row>,
}

impl Report {
    /// A report on this machine, with no row yet.
    #[must_use]
    pub fn new() -> Self {
        let information = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
        Self {
            processor: processor(&information),
            cores: thread::available_parallelism().ok().map(usize::from),
            rows: Vec::new(),
        }
    }

    /// Writes `rivals.md` and `rivals.json` to a folder.
    ///
    /// # Errors
    /// Files that cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), XtaskError> {
        write(&folder.join("rivals.md"), &self.to_string())?;
        let json = serde_json::to_string_pretty(self)?;
        write(&folder.join("rivals.json"), &json)
    }
}

impl Default for Report {
    fn default() -> Self {
        Self::new()
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let processor = self.processor.as_deref().unwrap_or("an unknown processor");
        let cores = self.cores.map_or_else(|| "?".to_owned(), |n| n.to_string());
        writeln!(f, "{processor}, {cores} cores.\n")?;
        f.write_str(&table::table(&self.rows))?;
        let missing = table::missing(&self.rows);
        if missing.is_empty() {
            return Ok(());
        }
        write!(f, "\nMissing:\n\n{missing}")
    }
}

/// The model named in the first `model name` line of the processors' description.
fn processor(information: &str) -> Option<String> {
    let line = information
        .lines()
        .find_map(|line| line.strip_prefix("model name"))?;
    let name = line.trim_start_matches([' ', '\t', ':']).trim();
    Some(name.to_owned())
}

#[cfg(test)]
mod tests {
    use super::super::Outcome;
    use super::super::row::tests::row;
    use super::*;

    #[test]
    fn the_report_is_written_as_markdown_and_as_json() {
        let folder = tempfile::tempdir().unwrap();
        let report = Report {
            processor: Some("A".to_owned()),
            cores: Some(2),
            rows: vec![row("slippy", Outcome::Missing("no wheel".into()))],
        };
        report.write(folder.path()).unwrap();
        let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
        assert!(read("rivals.md").starts_with("A, 2 cores.\n\n| case |"));
        assert!(read("rivals.md").ends_with("Missing:\n\n- slippy: no wheel\n"));
        let json: serde_json::Value = serde_json::from_str(&read("rivals.json")).unwrap();
        assert_eq!(json["rows"][0]["outcome"]["missing"], "no wheel");
    }

    #[test]
    fn the_first_processor_is_named() {
        let information = "processor\t: 0\nmodel name\t: Some CPU @ 2 GHz\nmodel name\t: other\n";
        assert_eq!(processor(information).as_deref(), Some("Some CPU @ 2 GHz"));
        assert_eq!(processor(""), None);
    }
}
