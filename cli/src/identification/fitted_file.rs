//! The fit of a fit file: the problem, the fit and its result.

use pellicle_identify::Fit;

use super::result::FitResult;
use super::{Identification, tables};
use crate::evaluation::table;

/// The fit of a fit file.
#[derive(Debug)]
pub struct FittedFile {
    /// The problem.
    pub identification: Identification,
    /// The fit.
    pub fit: Fit,
    /// Its result.
    pub found: FitResult,
}

impl FittedFile {
    /// Whether the user stopped the fit, so that part of it is missing.
    #[must_use]
    pub fn is_stopped(&self) -> bool {
        self.fit.stopped.is_some()
    }

    /// The tables of the fit with the names of their files, including the points left out, if any.
    #[must_use]
    pub fn tables(&self) -> Vec<(&'static str, String)> {
        let excluded = tables::excluded(&self.identification);
        let excluded = excluded.map(|table| (tables::EXCLUDED, table));
        let all = tables::all(&self.identification, &self.fit).into_iter();
        let contacts = &self.found.indentation;
        let contacts = (!contacts.is_empty()).then(|| (table::FILE, table::table(contacts)));
        all.chain(excluded).chain(contacts).collect()
    }
}
