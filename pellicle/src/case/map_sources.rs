//! The data that a case names but does not contain: maps in the files of a folder, and arrays and shapes supplied by
//! the caller.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use pellicle_contact::Indenter;
use pellicle_texture::CustomRelief;

use crate::map::{MapError, MapFile, PointsError};

/// The maps that a case may name as `file`, and the shapes behind `kind = "function"`, which no file can hold.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MapSources {
    folder: PathBuf,
    arrays: BTreeMap<String, Result<MapFile, PointsError>>,
    indenter: Option<Indenter>,
    relief: Option<CustomRelief>,
}

impl MapSources {
    /// The files of a folder.
    #[must_use]
    pub fn in_folder(folder: &Path) -> Self {
        Self {
            folder: folder.to_owned(),
            ..Self::default()
        }
    }

    /// The folder.
    #[must_use]
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Adds an array under this name, read instead of a file as if it were in a NumPy file: `heights[i * shape[1] + j]`
    /// is sample `(i, j)`, first index along x.
    #[must_use]
    pub fn with_array(mut self, name: &str, shape: [usize; 2], heights: Vec<f64>) -> Self {
        let array = MapFile::of_array(shape, heights);
        self.arrays.insert(name.to_owned(), array);
        self
    }

    /// Adds an indenter for `[indenter]` with `kind = "function"`.
    #[must_use]
    pub fn with_indenter(mut self, indenter: Indenter) -> Self {
        self.indenter = Some(indenter);
        self
    }

    /// Adds a relief for `[surface]` with `kind = "function"`.
    #[must_use]
    pub fn with_relief(mut self, relief: CustomRelief) -> Self {
        self.relief = Some(relief);
        self
    }

    /// The supplied indenter, if any.
    #[must_use]
    pub fn indenter(&self) -> Option<&Indenter> {
        self.indenter.as_ref()
    }

    /// The supplied relief, if any.
    #[must_use]
    pub fn relief(&self) -> Option<&CustomRelief> {
        self.relief.as_ref()
    }

    /// Returns the map of this name: the array if there is one, or else the file.
    ///
    /// # Errors
    ///
    /// A [`MapError`] if the array or the file is no map.
    pub fn read(&self, name: &str) -> Result<Cow<'_, MapFile>, MapError> {
        match self.arrays.get(name) {
            Some(Ok(array)) => Ok(Cow::Borrowed(array)),
            Some(Err(scattered)) => Err(MapError::Points(*scattered)),
            None => MapFile::read(&self.folder.join(name)).map(Cow::Owned),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_array_takes_precedence_over_the_file_of_its_name() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("a.csv"), "1,2\n").unwrap();
        let files = MapSources::in_folder(folder.path());
        assert_eq!(files.read("a.csv").unwrap().shape, [2, 1]);
        let arrays = files.with_array("a.csv", [1, 3], vec![5.0, 6.0, 7.0]);
        assert_eq!(arrays.read("a.csv").unwrap().heights, [5.0, 6.0, 7.0]);
        assert!(arrays.read("b.csv").is_err());
    }
}
