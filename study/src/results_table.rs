//! The results table of a study; it survives a kill at any moment.
//!
//! A case is a block of rows, one per loading step, passed to the system in one write, so it survives the end of the
//! process. [`ResultsTable::unforced`] allows another thread to force the table to disk from time to time, while others
//! write, so that it also survives a power failure. Either can leave an incomplete block at the end of the file: its
//! last row has no end, or rows are missing. It is removed when the study continues, and its case and any after it are
//! solved again. When every case is done, the blocks are sorted into a new file that replaces the old one.

use std::fs::{self, File};
use std::io::{self, BufReader, ErrorKind, Seek, Write};
use std::path::{Path, PathBuf};

use pellicle_files::disk::DiskFile;
use pellicle_files::whole;

use crate::StudyError;
use crate::case_blocks::{self, CaseBlock, CaseBlocks};
use crate::case_status::{CaseStatus, Tally};
use crate::folder::{self, Begin, StudyFolder};
use crate::identity::StudyIdentity;
use crate::remaining::RemainingCases;

/// The table on disk, open for this process alone as long as it holds the folder.
#[derive(Debug)]
pub struct ResultsTable {
    path: PathBuf,
    file: DiskFile,
    place: StudyFolder,
    /// Length in bytes of the complete blocks.
    length: u64,
    /// Whether anything was written since the file was last forced to disk.
    is_unforced: bool,
    statuses: Vec<Option<CaseStatus>>,
    tally: Tally,
}

impl ResultsTable {
    /// Opens the table of a study's part and removes an incomplete block. Creates the table if it is missing, and
    /// empties it if the study begins again.
    ///
    /// # Errors
    ///
    /// [`StudyError`] if it cannot be opened, or belongs to something else.
    pub fn open(place: StudyFolder, identity: &StudyIdentity) -> Result<Self, StudyError> {
        let path = identity.table(&place.folder);
        let failed = |cause| StudyError::write(&path, cause);
        let file = open(&path).map_err(failed)?;
        if place.begin == Begin::Again {
            file.set_len(0).map_err(failed)?;
        }
        let blocks = CaseBlocks::read(&path, identity)?;
        let done_before = blocks.blocks.len();
        let started = StudyIdentity {
            done_before,
            ..identity.clone()
        };
        started.write(&place.folder)?;
        let mut table = Self {
            length: blocks.end,
            is_unforced: false,
            statuses: vec![None; identity.numbering.case_count()],
            tally: Tally::default(),
            file,
            path: path.clone(),
            place,
        };
        for block in &blocks.blocks {
            table.count(block.case, block.status);
        }
        table.mend(&identity.header).map_err(failed)?;
        Ok(table)
    }

    /// Cuts off the incomplete block, and writes the first line if it is missing.
    fn mend(&mut self, header: &str) -> io::Result<()> {
        if self.file.as_file().metadata()?.len() > self.length {
            self.file.set_len(self.length)?;
        }
        if self.length == 0 {
            let line = format!("{header}\n");
            self.file.write_all(line.as_bytes())?;
            self.length = line.len() as u64;
        }
        self.file.sync_all()
    }

    fn count(&mut self, case: usize, status: CaseStatus) {
        // A case written twice after a power failure counts once.
        if let Some(place) = self.statuses.get_mut(case)
            && place.replace(status).is_none()
        {
            self.tally.add(status);
        }
    }

    /// Returns the cases without rows, with which the study continues.
    #[must_use]
    pub fn remaining(&self, identity: &StudyIdentity) -> RemainingCases {
        let done = self.statuses.iter().map(Option::is_some).collect();
        RemainingCases::new(identity, done)
    }

    /// Appends the rows of a case. They survive the process, and a power failure once they are forced to disk.
    ///
    /// # Errors
    ///
    /// [`StudyError::File`] if they cannot be written; the table is unchanged.
    pub fn add(&mut self, case: usize, status: CaseStatus, rows: &str) -> Result<(), StudyError> {
        if let Err(cause) = self.file.write_all(rows.as_bytes()) {
            // Another case may still fit and must not follow half a block. If this fails too, the next start finds the
            // half block and removes it.
            drop(self.file.set_len(self.length));
            return Err(StudyError::write(&self.path, cause));
        }
        self.length += rows.len() as u64;
        self.is_unforced = true;
        self.count(case, status);
        Ok(())
    }

    /// Returns the file if anything was written since the last call; the caller forces it to disk.
    ///
    /// # Errors
    ///
    /// [`StudyError::File`] if the system cannot duplicate the file handle.
    pub fn unforced(&mut self) -> Result<Option<UnforcedFile>, StudyError> {
        if !std::mem::take(&mut self.is_unforced) {
            return Ok(None);
        }
        let file = self.file.try_clone();
        let file = file.map_err(|cause| StudyError::write(&self.path, cause))?;
        let path = self.path.clone();
        Ok(Some(UnforcedFile { file, path }))
    }

    /// The number of finished cases by status.
    #[must_use]
    pub fn tally(&self) -> Tally {
        self.tally
    }

    /// Returns the path of the table.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Returns the folder of the study.
    #[must_use]
    pub fn place(&self) -> &StudyFolder {
        &self.place
    }

    /// Sorts the cases once all are done, and closes the table. The folder stays locked until then.
    ///
    /// # Errors
    ///
    /// [`StudyError`] if the table cannot be read or written.
    pub fn finish(mut self, identity: &StudyIdentity) -> Result<(), StudyError> {
        if let Some(unforced) = self.unforced()? {
            unforced.force()?;
        }
        let found = blocks_of(self.file.as_file(), identity);
        let found = found.map_err(|cause| StudyError::damaged(&self.path, &cause))?;
        let blocks =
            found.ok_or_else(|| StudyError::damaged(&self.path, &"it has changed meanwhile"))?;
        if !blocks.are_in_order() {
            write_in_order(
                &self.path,
                &identity.header,
                vec![(self.file.into_file(), blocks.blocks)],
            )?;
        }
        folder::discard_before(&self.place.folder, identity)
    }
}

/// A table with rows that may not be on disk yet.
#[derive(Debug)]
pub struct UnforcedFile {
    file: DiskFile,
    path: PathBuf,
}

impl UnforcedFile {
    /// Forces the rows to disk.
    ///
    /// # Errors
    ///
    /// [`StudyError::File`] if the system cannot do so.
    pub fn force(&self) -> Result<(), StudyError> {
        let forced = self.file.sync_data();
        forced.map_err(|cause| StudyError::write(&self.path, cause))
    }
}

/// The blocks of an open table; `None` if its first line is not that of this study.
fn blocks_of(mut file: &File, identity: &StudyIdentity) -> io::Result<Option<CaseBlocks>> {
    file.rewind()?;
    CaseBlocks::of(BufReader::new(file), identity)
}

/// Writes a table of the blocks of these tables, in the order of their cases; if a case is repeated, its last block
/// counts.
///
/// # Errors
///
/// [`StudyError::File`] if it cannot be written.
pub fn write_in_order(
    path: &Path,
    header: &str,
    parts: Vec<(File, Vec<CaseBlock>)>,
) -> Result<(), StudyError> {
    let (mut files, mut blocks) = (Vec::new(), Vec::new());
    for (i, (file, found)) in parts.into_iter().enumerate() {
        files.push(file);
        blocks.extend(found.into_iter().map(|block| (i, block)));
    }
    // The sort is stable: of equal cases, the last stays last.
    blocks.sort_by_key(|(_, block)| block.case);
    let is_repeated = |i: usize| {
        let next: Option<&(usize, CaseBlock)> = blocks.get(i + 1);
        next.is_some_and(|(_, next)| next.case == blocks[i].1.case)
    };
    let mut rows = Vec::new();
    let written = whole::write_whole(path, |file| {
        writeln!(file, "{header}")?;
        for (i, (part, block)) in blocks.iter().enumerate() {
            if !is_repeated(i) {
                case_blocks::copy(block, &files[*part], &mut rows)?;
                file.write_all(&rows)?;
            }
        }
        // Some systems cannot replace an open file.
        files.clear();
        Ok(())
    });
    Ok(written?)
}

/// Opens the table for reading and appending. A symbolic link is not followed.
fn open(path: &Path) -> io::Result<DiskFile> {
    if fs::symlink_metadata(path).is_ok_and(|data| !data.is_file()) {
        return Err(io::Error::new(ErrorKind::InvalidInput, "it is not a file"));
    }
    DiskFile::append(path)
}
