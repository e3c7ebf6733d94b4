//! What the tests of the readers share: a table read from a few lines.

use std::sync::Arc;

use super::diagnosis::Diagnosis;
use super::document;
use super::place::Source;
use super::reader::Reader;

/// Reads the text as one table; a diagnosis comes back as its sentence.
pub fn read_table<T>(
    text: &str,
    read: impl FnOnce(Reader<'_>) -> Result<T, Diagnosis>,
) -> Result<T, String> {
    // A key of its own keeps a text without keys from being an empty file.
    let source = Arc::new(Source::new("case.toml", format!("{text}\n[unused]\n")));
    let mut root = document::parse(&source).map_err(|diagnosis| diagnosis.to_string())?;
    if let document::Value::Table(table) = &mut root.value {
        table.entries.retain(|entry| entry.key != "unused");
    }
    Reader::root(&root)
        .and_then(read)
        .map_err(|diagnosis| diagnosis.to_string())
}
