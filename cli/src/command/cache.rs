//! `pellicle cache`: shows the folder and size of the cache, or clears it.

use std::path::Path;

use pellicle::display::significant;
use pellicle_files::json;
use pellicle_influence::Usage;
use serde::Serialize;

use crate::arguments::CacheArguments;
use crate::command::Outcome;
use crate::failure::Failure;
use crate::{cache, terminal};

/// The contents of the cache, after clearing.
#[derive(Debug, Serialize)]
struct Contents {
    /// The folder; none if nothing is cached on disk.
    folder: Option<String>,
    /// Number of files.
    files: usize,
    /// Total size of the files.
    bytes: u64,
}

/// Prints the folder and the size of the cache; with `--clear`, removes its files first.
///
/// # Errors
///
/// [`Failure::Cache`] if the folder cannot be listed or a file cannot be removed.
pub fn cache(arguments: &CacheArguments) -> Result<Outcome, Failure> {
    let cache = cache::open();
    let failure = |cause| Failure::Cache {
        path: cache.folder().unwrap_or(Path::new("")).to_owned(),
        cause,
    };
    if arguments.clear {
        let removed = cache.clear().map_err(failure)?;
        terminal::report(&format!("removed {}", size(removed)));
    }
    let usage = cache.usage().map_err(failure)?;
    let contents = Contents {
        folder: cache.folder().map(|folder| folder.display().to_string()),
        files: usage.files,
        bytes: usage.bytes,
    };
    let text = if arguments.json {
        json(&contents)?
    } else {
        table(&contents, usage)
    };
    terminal::print(&text)?;
    Ok(Outcome::Done)
}

fn table(contents: &Contents, usage: Usage) -> String {
    match &contents.folder {
        Some(folder) => format!("{folder}\n{}\n", size(usage)),
        None => format!("no cache on disk: {} is empty\n", cache::VARIABLE),
    }
}

fn size(usage: Usage) -> String {
    let Usage { files, bytes } = usage;
    let word = if files == 1 { "file" } else { "files" };
    let megabytes = significant(bytes as f64 / 1e6, 3);
    format!("{files} {word}, {megabytes} MB")
}
