//! The files of kept fields, written while the cases are solved, and merged from the parts of a study.
//!
//! A file has its full length from the start, and every case has a fixed place in it, so nothing is sorted or copied at
//! the end, and a case solved again after a kill overwrites itself. While cases are missing, the header gives their
//! number as 0, so that nobody reads missing data.

use std::fs::{self, File};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use pellicle_files::disk::DiskFile;
use pellicle_files::whole;

use crate::StudyError;
use crate::identity::StudyIdentity;
use crate::kept_layout::KeptLayout;
use crate::kept_record::{FieldKeeper, KeptRecords};
use crate::shard::Shard;

/// Position and length in the header of the number of cases.
const CASES_AT: usize = 4;
const CASES_END: usize = CASES_AT + 4;

/// The kept fields of a part of a study, one file for each number of elements.
#[derive(Debug)]
pub struct KeptFields {
    records: KeptRecords,
    files: Vec<KeptFile>,
    /// Index of each case in its file.
    places: Vec<u32>,
}

/// One file being written.
#[derive(Debug)]
struct KeptFile {
    elements: usize,
    cases: u32,
    /// Length of a case in bytes.
    record: u64,
    path: PathBuf,
    file: Mutex<DiskFile>,
    /// Byte at which the first case begins.
    start: u64,
    /// Whether anything was written since the file was last forced to disk.
    is_unforced: AtomicBool,
}

impl KeptFields {
    /// Opens the files of a part of which `done` cases are solved, and creates missing files. Returns `None` if nothing
    /// is kept.
    ///
    /// # Errors
    ///
    /// [`StudyError`] if one cannot be opened, is not of this study, or is missing while cases are done.
    pub fn open(
        folder: &Path,
        identity: &StudyIdentity,
        done: usize,
    ) -> Result<Option<Self>, StudyError> {
        let Some(records) = KeptRecords::of(identity) else {
            return Ok(None);
        };
        let layout = records.layout();
        let grids = layout.grids();
        let mut counts = vec![0; grids.len()];
        let mut places = vec![0; identity.numbering.case_count()];
        for case in identity.cases() {
            let grid = records.elements_of(case);
            let grid = grid.and_then(|grid| grids.binary_search(&grid).ok());
            if let Some(grid) = grid {
                places[case] = counts[grid];
                counts[grid] += 1;
            }
        }
        let open = |(elements, cases): (&usize, &u32)| {
            KeptFile::open(folder, identity, layout, (*elements, *cases), done)
        };
        let files = grids.iter().zip(&counts).filter(|(_, cases)| **cases > 0);
        let files = files.map(open).collect::<Result<_, _>>()?;
        Ok(Some(Self {
            records,
            files,
            places,
        }))
    }

    /// Writes the number of cases into the files, as all are complete.
    ///
    /// # Errors
    ///
    /// [`StudyError::File`] if it cannot be written.
    pub fn finish(&self) -> Result<(), StudyError> {
        self.force()?;
        self.files.iter().try_for_each(|file| {
            file.write(CASES_AT as u64, &file.cases.to_be_bytes())?;
            file.force()
        })
    }

    /// File and first byte of a case; `None` if its grid is invalid.
    fn place(&self, case: usize) -> Option<(&KeptFile, u64)> {
        let elements = self.records.elements_of(case)?;
        let file = self.files.iter().find(|file| file.elements == elements)?;
        let place = u64::from(*self.places.get(case)?);
        Some((file, file.start + place * file.record))
    }
}

impl FieldKeeper for KeptFields {
    fn records(&self) -> &KeptRecords {
        &self.records
    }

    fn write(&self, case: usize, at: u64, bytes: &[u8]) -> Result<(), StudyError> {
        let place = self.place(case);
        place.map_or(Ok(()), |(file, start)| file.write(start + at, bytes))
    }

    fn force(&self) -> Result<(), StudyError> {
        self.files.iter().try_for_each(KeptFile::force)
    }
}

impl KeptFile {
    fn open(
        folder: &Path,
        identity: &StudyIdentity,
        layout: &KeptLayout,
        (elements, cases): (usize, u32),
        done: usize,
    ) -> Result<Self, StudyError> {
        let path = folder.join(KeptLayout::file(elements, identity.shard));
        let failed = |cause| StudyError::write(&path, cause);
        let beginning = layout.beginning(&identity.study, elements, 0);
        let beginning = beginning.map_err(failed)?;
        let start = beginning.len() as u64;
        let record = layout.record_bytes(elements) as u64;
        let length = start + u64::from(cases) * record;
        if fs::symlink_metadata(&path).is_err() {
            if done > 0 {
                let reason =
                    "it is missing although the table has cases: give --fresh to begin again";
                return Err(StudyError::damaged(&path, &reason));
            }
            whole::write_whole(&path, |file| {
                file.write_all(&beginning)?;
                file.flush()?;
                file.get_ref().as_file().set_len(length)
            })?;
        } else if !begins_with(&path, &beginning, Some(length)) {
            return Err(StudyError::NotKept { path });
        }
        let file = DiskFile::open(&path);
        Ok(Self {
            elements,
            cases,
            record,
            file: Mutex::new(file.map_err(failed)?),
            path,
            start,
            is_unforced: AtomicBool::new(false),
        })
    }

    fn write(&self, at: u64, bytes: &[u8]) -> Result<(), StudyError> {
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        let mut write = || {
            file.seek(SeekFrom::Start(at))?;
            file.write_all(bytes)
        };
        write().map_err(|cause| StudyError::write(&self.path, cause))?;
        self.is_unforced.store(true, Ordering::Release);
        Ok(())
    }

    fn force(&self) -> Result<(), StudyError> {
        if !self.is_unforced.swap(false, Ordering::Acquire) {
            return Ok(());
        }
        let file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        // Other threads can write meanwhile.
        let other = file.try_clone();
        drop(file);
        other
            .and_then(|file| file.sync_data())
            .map_err(|cause| StudyError::write(&self.path, cause))
    }
}

/// Whether a file has this beginning, apart from the number of cases, and this length if one is given.
fn begins_with(path: &Path, beginning: &[u8], length: Option<u64>) -> bool {
    let is_long =
        |data: &fs::Metadata| data.is_file() && length.is_none_or(|length| data.len() == length);
    if !fs::symlink_metadata(path).is_ok_and(|data| is_long(&data)) {
        return false;
    }
    let mut found = vec![0; beginning.len()];
    let read = File::open(path).and_then(|mut file| file.read_exact(&mut found));
    if read.is_err() {
        return false;
    }
    found[CASES_AT..CASES_END].copy_from_slice(&beginning[CASES_AT..CASES_END]);
    found == beginning
}

/// Refuses files of something else in the places of the merged ones, except those in `replaceable`.
///
/// # Errors
///
/// [`StudyError::NotKept`] for the first of them.
pub fn check_whole(
    folder: &Path,
    whole: &StudyIdentity,
    replaceable: &[PathBuf],
) -> Result<(), StudyError> {
    let Some(layout) = &whole.kept else {
        return Ok(());
    };
    for elements in layout.grids() {
        let path = folder.join(KeptLayout::file(elements, Shard::WHOLE));
        let beginning = layout.beginning(&whole.study, elements, 0);
        let beginning = beginning.map_err(|cause| StudyError::write(&path, cause))?;
        let is_there = fs::symlink_metadata(&path).is_ok();
        if is_there && !replaceable.contains(&path) && !begins_with(&path, &beginning, None) {
            return Err(StudyError::NotKept { path });
        }
    }
    Ok(())
}

/// Merges the files of the parts, of which no case is missing, into those of the whole study.
///
/// # Errors
///
/// [`StudyError`] if a part's file is missing, or nothing can be written.
pub fn gather(
    folder: &Path,
    whole: &StudyIdentity,
    parts: &[StudyIdentity],
) -> Result<(), StudyError> {
    let Some(layout) = &whole.kept else {
        return Ok(());
    };
    let mut grids = layout.grids().into_iter();
    grids.try_for_each(|elements| gather_grid(folder, whole, layout, parts, elements))
}

fn gather_grid(
    folder: &Path,
    whole: &StudyIdentity,
    layout: &KeptLayout,
    parts: &[StudyIdentity],
    elements: usize,
) -> Result<(), StudyError> {
    let path = folder.join(KeptLayout::file(elements, Shard::WHOLE));
    let failed = |cause| StudyError::write(&path, cause);
    let beginning = |cases| layout.beginning(&whole.study, elements, cases);
    let is_of_grid = |case: &usize| layout.grid_of(&whole.numbering, *case) == Some(elements);
    let cases = (0..whole.numbering.case_count()).filter(is_of_grid);
    let wanted = beginning(0).map_err(failed)?;
    // In the order of the parts; `None` for a part without such a case.
    let mut files: Vec<Option<File>> = Vec::new();
    let count = whole_count(parts);
    files.resize_with(count, || None);
    for part in parts {
        if !part.cases().any(|case| is_of_grid(&case)) {
            continue;
        }
        let path = folder.join(KeptLayout::file(elements, part.shard));
        if !begins_with(&path, &wanted, None) {
            return Err(StudyError::NotKept { path });
        }
        let open = || {
            let mut file = File::open(&path)?;
            file.seek(SeekFrom::Start(wanted.len() as u64))?;
            Ok(file)
        };
        let file = open().map_err(|cause: io::Error| StudyError::damaged(&path, &cause))?;
        files[part.shard.index - 1] = Some(file);
    }
    let mut record = vec![0; layout.record_bytes(elements)];
    let written = whole::write_whole(&path, |file| {
        file.write_all(&beginning(cases.clone().count())?)?;
        for case in cases {
            let part = Shard::of(case, count);
            let mut part = files[part.index - 1].as_ref();
            let part = part.as_mut().ok_or(io::ErrorKind::NotFound)?;
            // A part holds its cases in the same order.
            part.read_exact(&mut record)?;
            file.write_all(&record)?;
        }
        Ok(())
    });
    Ok(written?)
}

fn whole_count(parts: &[StudyIdentity]) -> usize {
    parts.first().map_or(1, |part| part.shard.count)
}
