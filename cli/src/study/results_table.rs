//! The table of a study's results, which survives a kill at any moment.
//!
//! A case is a block of rows, one per loading step, passed to the system in one write and then flushed to the disk. A
//! kill can leave at most an incomplete block at the end of the file: its last row has no end, or rows are missing. It
//! is removed when the study continues. When every case is done, the blocks are sorted into a new file that replaces
//! the old one.

use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Read, Seek, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::case_status::{CaseStatus, Tally};
use super::folder::{self, Begin, StudyFolder};
use super::identity::StudyIdentity;
use crate::failure::Failure;
use crate::output::file;

/// The table on disk, open for this process alone as long as it holds the place.
#[derive(Debug)]
pub struct ResultsTable {
    path: PathBuf,
    file: File,
    place: StudyFolder,
    header: String,
    done: BTreeMap<usize, CaseStatus>,
}

impl ResultsTable {
    /// Opens the table of a study's part and removes an incomplete block; creates it if it is missing or to be started
    /// afresh.
    ///
    /// # Errors
    ///
    /// [`Failure`] if it cannot be opened, or is another table.
    pub fn open(place: StudyFolder, identity: &StudyIdentity) -> Result<Self, Failure> {
        let path = identity.table(&place.folder);
        let failed = |cause| Failure::write(&path, cause);
        let file = open(&path).map_err(failed)?;
        if place.begin == Begin::Again {
            file.set_len(0).map_err(failed)?;
        }
        identity.write(&place.folder)?;
        let text = whole(&file).map_err(failed)?;
        let blocks = CaseBlocks::of(&text, identity)
            .ok_or_else(|| Failure::damaged(&path, &"its first line is not that of this study"))?;
        let mut table = Self {
            header: identity.header.clone(),
            done: blocks.statuses(),
            file,
            path: path.clone(),
            place,
        };
        table.mend(&text, blocks.end).map_err(failed)?;
        Ok(table)
    }

    /// Cuts off the incomplete block, and writes the first line if it is missing.
    fn mend(&mut self, text: &[u8], end: usize) -> io::Result<()> {
        if end < text.len() {
            self.file.set_len(end as u64)?;
        }
        if end == 0 {
            self.file
                .write_all(format!("{}\n", self.header).as_bytes())?;
        }
        self.file.sync_all()
    }

    /// Those of the cases that the table has no rows of yet: a study goes on with them.
    #[must_use]
    pub fn remaining(&self, cases: &[usize]) -> Vec<usize> {
        let is_missing = |case: &usize| !self.done.contains_key(case);
        cases.iter().copied().filter(is_missing).collect()
    }

    /// Appends the rows of a case, which are on the disk when this returns.
    ///
    /// # Errors
    ///
    /// [`Failure::Write`] if they are not.
    pub fn add(&mut self, case: usize, status: CaseStatus, rows: &str) -> Result<(), Failure> {
        let written = self.file.write_all(rows.as_bytes());
        written
            .and_then(|()| self.file.sync_data())
            .map_err(|cause| Failure::write(&self.path, cause))?;
        self.done.insert(case, status);
        Ok(())
    }

    /// The number of finished cases by status.
    #[must_use]
    pub fn tally(&self) -> Tally {
        Tally::of(self.done.values().copied())
    }

    /// Its path.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The place of the study.
    #[must_use]
    pub fn place(&self) -> &StudyFolder {
        &self.place
    }

    /// Sorts the cases, once all are done, and closes the table. The place stays locked until then.
    ///
    /// # Errors
    ///
    /// [`Failure`] if the table cannot be read or written.
    pub fn finish(self, identity: &StudyIdentity) -> Result<(), Failure> {
        let text = whole(&self.file).map_err(|cause| Failure::damaged(&self.path, &cause))?;
        let blocks = CaseBlocks::of(&text, identity)
            .ok_or_else(|| Failure::damaged(&self.path, &"it has changed meanwhile"))?;
        // Some systems cannot replace an open file.
        drop(self.file);
        if !blocks.are_in_order() {
            write_in_order(&self.path, &identity.header, &blocks.in_order(&text))?;
        }
        folder::forget_before(&self.place.folder, identity)
    }
}

/// Everything in an open file.
fn whole(mut file: &File) -> io::Result<Vec<u8>> {
    let mut text = Vec::new();
    file.rewind()?;
    file.read_to_end(&mut text)?;
    Ok(text)
}

/// The bytes of a table.
///
/// # Errors
///
/// [`Failure::Damaged`] if there is none.
pub fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    fs::read(path).map_err(|cause| Failure::damaged(path, &cause))
}

/// Writes a table of these blocks, in the order of their cases.
///
/// # Errors
///
/// [`Failure::Write`] if it cannot be written.
pub fn write_in_order(
    path: &Path,
    header: &str,
    blocks: &BTreeMap<usize, &[u8]>,
) -> Result<(), Failure> {
    file::write_whole(path, |file| {
        writeln!(file, "{header}")?;
        blocks.values().try_for_each(|rows| file.write_all(rows))
    })
}

/// Opens the table for reading and appending. A link in its place is not followed.
fn open(path: &Path) -> io::Result<File> {
    if fs::symlink_metadata(path).is_ok_and(|data| !data.is_file()) {
        return Err(io::Error::new(ErrorKind::InvalidInput, "it is not a file"));
    }
    OpenOptions::new()
        .read(true)
        .append(true)
        .create(true)
        .open(path)
}

/// The complete blocks of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct CaseBlocks {
    /// Case, status and bytes of its lines, in the order of the file.
    blocks: Vec<(usize, CaseStatus, Range<usize>)>,
    /// Bytes up to the end of the last block; 0 if not even the first line is complete.
    pub end: usize,
}

impl CaseBlocks {
    /// The complete blocks of a text; none if the first line is not that of this study.
    #[must_use]
    pub fn of(text: &[u8], identity: &StudyIdentity) -> Option<Self> {
        let (mut blocks, mut end) = (Vec::new(), 0);
        let mut lines = RowReader { text, at: 0 };
        let Some(first) = lines.next() else {
            return identity
                .header
                .as_bytes()
                .starts_with(text)
                .then_some(Self { blocks, end });
        };
        if text[first.clone()] != *identity.header.as_bytes() {
            return None;
        }
        end = lines.at;
        let columns = fields(identity.header.as_bytes())?.len();
        while let Some((case, status)) = lines.block(columns, identity) {
            blocks.push((case, status, end..lines.at));
            end = lines.at;
        }
        Some(Self { blocks, end })
    }

    /// The statuses of the cases.
    #[must_use]
    pub fn statuses(&self) -> BTreeMap<usize, CaseStatus> {
        let statuses = self.blocks.iter();
        statuses.map(|(case, status, _)| (*case, *status)).collect()
    }

    /// The lines of every case; for a repeated case, the last block.
    #[must_use]
    pub fn in_order<'t>(&self, text: &'t [u8]) -> BTreeMap<usize, &'t [u8]> {
        let blocks = self.blocks.iter();
        blocks
            .map(|(case, _, range)| (*case, &text[range.clone()]))
            .collect()
    }

    fn are_in_order(&self) -> bool {
        self.blocks.is_sorted_by(|a, b| a.0 < b.0)
    }
}

/// Reads the complete rows of a text one by one.
struct RowReader<'t> {
    text: &'t [u8],
    at: usize,
}

impl RowReader<'_> {
    /// The next row that has an end, without it. A line end between quotes does not end a row.
    fn next(&mut self) -> Option<Range<usize>> {
        let mut is_quoted = false;
        let ends = |byte: &u8| {
            is_quoted ^= *byte == b'"';
            *byte == b'\n' && !is_quoted
        };
        let length = self.text[self.at..].iter().position(ends)?;
        let line = self.at..self.at + length;
        self.at = line.end + 1;
        Some(line)
    }

    /// The next block, if it is complete: all lines of one case of this part.
    fn block(&mut self, columns: usize, identity: &StudyIdentity) -> Option<(usize, CaseStatus)> {
        let (case, status) = self.row(columns)?;
        let rows = *identity
            .rows
            .get(case)
            .filter(|_| identity.shard.holds(case))?;
        let rows = if status == CaseStatus::Failed {
            1
        } else {
            rows
        };
        for _ in 1..rows {
            self.row(columns).filter(|row| *row == (case, status))?;
        }
        Some((case, status))
    }

    /// Case and status of the next line.
    fn row(&mut self, columns: usize) -> Option<(usize, CaseStatus)> {
        let line = self.next()?;
        let fields = fields(&self.text[line])?;
        if fields.len() != columns {
            return None;
        }
        let case = fields.first()?.parse::<usize>().ok()?.checked_sub(1)?;
        Some((case, CaseStatus::of(fields.get(1)?)?))
    }
}

/// The cells of one row; none if it is not text.
fn fields(line: &[u8]) -> Option<Vec<String>> {
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .from_reader(line);
    let record = reader.records().next()?.ok()?;
    Some(record.iter().map(str::to_owned).collect())
}
