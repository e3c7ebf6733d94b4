//! A fit file drafted from measured files: one file in, and a fit that runs at once.
//!
//! The files are read by the readers of [`measured`](crate::measured), which check every guess: the drafted `[[data]]`
//! table is read back before it is returned. A guess says what it rests on in a comment. What no file can tell, such as
//! Poisson's ratio, has a stated default under the words of [`NOT_IN_THE_FILE`].

mod column_guess;
mod data_text;
mod error;
mod evaluation_text;
mod file_names;
mod group;
mod guesses;
mod history;
mod model_text;
mod power_law;
mod spring_guess;
mod story;
mod survey;
mod table_columns;
mod words;

use std::path::{Path, PathBuf};

pub use self::error::DraftError;
pub use self::guesses::guesses;

use self::group::Group;
use self::survey::Survey;

/// What stands beside a default that no file tells.
pub const NOT_IN_THE_FILE: &str = "not in the file: put yours";

/// What a curve is taken for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DraftKind {
    /// What its columns tell: a cantilever's if there is the height of a piezo, otherwise an instrument's that measures
    /// the depth; if its unloading gives back too little work for an elastic contact, that is evaluated.
    Guessed,
    /// The approach of a force microscope, in soft matter.
    Afm,
    /// A load and its unloading, to be evaluated by Oliver and Pharr.
    Unloading,
}

/// A drafted fit file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Draft {
    /// Its text.
    pub text: String,
    /// What it was guessed from and what is to be put in, one sentence each.
    pub remarks: Vec<String>,
}

impl Draft {
    /// Drafts a fit file, to be written into a folder, from these files; those that are not curves are left out, with a
    /// remark, where another one is.
    ///
    /// # Errors
    ///
    /// [`DraftError`] of the first file if none is a curve.
    pub fn new(files: &[PathBuf], folder: &Path, kind: DraftKind) -> Result<Self, DraftError> {
        let mut surveys = Vec::new();
        let mut failures = Vec::new();
        for file in files {
            match Survey::of(file, kind) {
                Ok(survey) => surveys.push(survey),
                Err(error) => failures.push(error),
            }
        }
        // A fit file is of one kind: that of the first file.
        let is_unloading = surveys.first().is_some_and(|first| first.is_unloading);
        surveys
            .iter_mut()
            .for_each(|survey| survey.is_unloading = is_unloading);
        let groups = Group::all(surveys, folder, kind, &mut failures);
        let Some(first) = groups.first() else {
            return Err(failures.into_iter().next().unwrap_or(DraftError::NoFiles));
        };
        let left_out = |error: &DraftError| format!("left out: {error}");
        let remarks = first.story().into_iter();
        Ok(Self {
            text: if is_unloading {
                evaluation_text::fit_file(&groups)
            } else {
                model_text::fit_file(&groups)
            },
            remarks: remarks.chain(failures.iter().map(left_out)).collect(),
        })
    }
}
