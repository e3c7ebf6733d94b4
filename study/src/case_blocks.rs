//! The blocks of rows of a results table, one per case, read without keeping the rows in memory.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom};
use std::path::Path;

use crate::StudyError;
use crate::case_status::CaseStatus;
use crate::identity::StudyIdentity;

/// The rows of one case in a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CaseBlock {
    /// The case, counted from 0.
    pub case: usize,
    /// Its status.
    pub status: CaseStatus,
    /// Byte at which the rows begin.
    pub start: u64,
    /// Their length in bytes, including line ends.
    pub length: usize,
}

/// The complete blocks of a table.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CaseBlocks {
    /// The blocks, in the order of the file.
    pub blocks: Vec<CaseBlock>,
    /// Bytes up to the end of the last block; 0 if not even the first line is complete.
    pub end: u64,
}

impl CaseBlocks {
    /// Reads the complete blocks of the table at `path`.
    ///
    /// # Errors
    ///
    /// [`StudyError::File`] if it cannot be read, or its first line is not that of this study.
    pub fn read(path: &Path, identity: &StudyIdentity) -> Result<Self, StudyError> {
        let failed = |cause: io::Error| StudyError::damaged(path, &cause);
        let file = File::open(path).map_err(failed)?;
        Self::of(BufReader::new(file), identity)
            .map_err(failed)?
            .ok_or_else(|| StudyError::damaged(path, &"its first line is not that of this study"))
    }

    /// Reads the complete blocks of a text; `None` if the first line is not that of this study.
    ///
    /// # Errors
    ///
    /// Errors of the reader.
    pub fn of(text: impl BufRead, identity: &StudyIdentity) -> io::Result<Option<Self>> {
        let header = identity.header.as_bytes();
        let mut rows = RowReader::new(text);
        if !rows.next()? {
            return Ok(header.starts_with(&rows.row).then(Self::default));
        }
        if rows.row != header {
            return Ok(None);
        }
        let mut found = Self {
            blocks: Vec::new(),
            end: rows.at,
        };
        let columns = count_cells(header);
        while let Some((case, status)) = rows.block(columns, identity)? {
            let start = found.end;
            found.end = rows.at;
            // The rows of a case were in memory when they were written, so their length fits a usize.
            let length = usize::try_from(rows.at - start).map_err(io::Error::other)?;
            found.blocks.push(CaseBlock {
                case,
                status,
                start,
                length,
            });
        }
        Ok(Some(found))
    }

    /// Whether the blocks are in the order of their cases, with each case once.
    #[must_use]
    pub fn are_in_order(&self) -> bool {
        self.blocks.is_sorted_by(|a, b| a.case < b.case)
    }
}

/// Copies the bytes of a block from its file.
///
/// # Errors
///
/// Errors of the system.
pub fn copy(block: &CaseBlock, mut file: &File, bytes: &mut Vec<u8>) -> io::Result<()> {
    bytes.resize(block.length, 0);
    file.seek(SeekFrom::Start(block.start))?;
    file.read_exact(bytes)
}

/// Reads the complete rows of a text one by one.
struct RowReader<R> {
    text: R,
    /// Byte after the last complete row.
    at: u64,
    /// The row, without its end.
    row: Vec<u8>,
}

impl<R: BufRead> RowReader<R> {
    fn new(text: R) -> Self {
        Self {
            text,
            at: 0,
            row: Vec::new(),
        }
    }

    /// Reads the next row; false if the row has no end. A line end between quotes does not end a row.
    fn next(&mut self) -> io::Result<bool> {
        self.row.clear();
        let (mut is_quoted, mut seen) = (false, 0);
        loop {
            let read = self.text.read_until(b'\n', &mut self.row)?;
            if read == 0 || self.row.last() != Some(&b'\n') {
                return Ok(false);
            }
            for byte in &self.row[seen..] {
                is_quoted ^= *byte == b'"';
            }
            seen = self.row.len();
            if !is_quoted {
                self.at += seen as u64;
                self.row.pop();
                return Ok(true);
            }
        }
    }

    /// Returns the next block if it is complete: all rows of one case of this part.
    fn block(
        &mut self,
        columns: usize,
        identity: &StudyIdentity,
    ) -> io::Result<Option<(usize, CaseStatus)>> {
        let Some((case, status)) = self.case(columns)? else {
            return Ok(None);
        };
        let Some(rows) = identity.rows_of(case) else {
            return Ok(None);
        };
        let rows = if status == CaseStatus::Failed {
            1
        } else {
            rows
        };
        for _ in 1..rows {
            if self.case(columns)? != Some((case, status)) {
                return Ok(None);
            }
        }
        Ok(Some((case, status)))
    }

    /// Returns case and status of the next row.
    fn case(&mut self, columns: usize) -> io::Result<Option<(usize, CaseStatus)>> {
        if !self.next()? {
            return Ok(None);
        }
        if count_cells(&self.row) != columns {
            return Ok(None);
        }
        // Neither is ever quoted.
        let mut cells = self.row.splitn(3, |byte| *byte == b',');
        let mut cell = || str::from_utf8(cells.next()?).ok();
        let case = cell().and_then(|case| case.parse::<usize>().ok()?.checked_sub(1));
        Ok(case.zip(cell().and_then(CaseStatus::of)))
    }
}

/// Counts the cells of one row; a comma between quotes does not end a cell.
fn count_cells(row: &[u8]) -> usize {
    let mut is_quoted = false;
    let ends = row.iter().filter(|byte| {
        is_quoted ^= **byte == b'"';
        !is_quoted && **byte == b','
    });
    ends.count() + 1
}
