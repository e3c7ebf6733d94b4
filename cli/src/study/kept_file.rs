//! The files of kept fields, written while the cases are solved and gathered from the parts of a study.
//!
//! A file has its full length from the start, and every case its place in it, whenever it is solved: nothing is sorted
//! or copied at the end, and a case that is solved again after a kill is written over itself. As long as cases are
//! missing the header says that there are none, so that nobody reads what is not there yet.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use pellicle_contact::{DeformedSurface, LoadingPath, SampledModel};

use super::case_status::CaseStatus;
use super::gather::OtherTable;
use super::identity::StudyIdentity;
use super::kept_layout::{HEAD, KeptField, KeptLayout};
use super::numbering::CaseNumbering;
use super::shard::Shard;
use crate::failure::Failure;
use crate::output::file;

/// Place and length of the number of cases in the header.
const CASES_AT: usize = 4;
const CASES_END: usize = CASES_AT + 4;

/// The kept fields of a part of a study, one file for each number of elements.
#[derive(Debug)]
pub struct KeptFields {
    layout: KeptLayout,
    numbering: CaseNumbering,
    files: Vec<KeptFile>,
    /// The place of each case in its file.
    records: Vec<u32>,
}

/// One file under way.
#[derive(Debug)]
struct KeptFile {
    elements: usize,
    cases: u32,
    path: PathBuf,
    file: Mutex<File>,
    /// Byte of the first case.
    start: u64,
    /// Whether anything was written since it was last forced to the disk.
    is_unforced: AtomicBool,
}

impl KeptFields {
    /// Opens the files of a part of whose cases so many are done, and creates those that are missing; none if nothing
    /// is kept.
    ///
    /// # Errors
    ///
    /// [`Failure`] if one cannot be opened, is something else, or is missing while cases are done.
    pub fn open(
        folder: &Path,
        identity: &StudyIdentity,
        done: usize,
    ) -> Result<Option<Self>, Failure> {
        let Some(layout) = identity.kept.clone() else {
            return Ok(None);
        };
        let numbering = identity.numbering.clone();
        let grids = layout.grids();
        let mut counts = vec![0; grids.len()];
        let mut records = vec![0; numbering.len()];
        for case in identity.cases() {
            let grid = layout.grid_of(&numbering, case);
            let place = grid.and_then(|grid| grids.binary_search(&grid).ok());
            if let Some(place) = place {
                records[case] = counts[place];
                counts[place] += 1;
            }
        }
        let open = |(elements, cases): (&usize, &u32)| {
            KeptFile::open(folder, identity, &layout, (*elements, *cases), done)
        };
        let files = grids.iter().zip(&counts).filter(|(_, cases)| **cases > 0);
        let files = files.map(open).collect::<Result<_, _>>()?;
        Ok(Some(Self {
            layout,
            numbering,
            files,
            records,
        }))
    }

    /// Whether a case needs more than its pressure.
    #[must_use]
    pub fn need_the_surface(&self) -> bool {
        let mut fields = self.layout.fields.iter();
        fields.any(|field| field.is_of_the_surface())
    }

    /// Writes the fields of a case that is solved.
    ///
    /// # Errors
    ///
    /// [`Failure::Write`] if they cannot be written.
    pub fn add(&self, case: usize, status: CaseStatus, path: &LoadingPath) -> Result<(), Failure> {
        let Some((file, at)) = self.place(case) else {
            return Ok(());
        };
        file.write(at, &head(case, status, path.grid.side()))?;
        let kept = self.layout.steps.unwrap_or(1);
        let first = match self.layout.steps {
            Some(_) => 0,
            None => path.steps.len().saturating_sub(1),
        };
        let is_wanted = |field: KeptField| self.layout.fields.contains(&field);
        let needs_surface = self.need_the_surface();
        let geometry = (needs_surface || is_wanted(KeptField::Profile)).then(|| path.geometry());
        for place in 0..kept {
            let step = first + place;
            let geometry = geometry.as_ref();
            let surface = geometry.filter(|_| needs_surface);
            let surface = surface.and_then(|geometry| path.surface(geometry, step));
            for (i, field) in self.layout.fields.iter().enumerate() {
                let values = values(*field, path, step, geometry, surface.as_ref());
                let at = at + self.offset(file, i, place);
                match values {
                    Some(values) => file.write(at, &big_endian(values))?,
                    None => file.write(at, &missing(file.elements))?,
                }
            }
        }
        Ok(())
    }

    /// Fills the fields of a case without a result with NaN.
    ///
    /// # Errors
    ///
    /// [`Failure::Write`] if they cannot be written.
    pub fn add_failed(&self, case: usize) -> Result<(), Failure> {
        let Some((file, at)) = self.place(case) else {
            return Ok(());
        };
        file.write(at, &head(case, CaseStatus::Failed, f64::NAN))?;
        let missing = missing(file.elements);
        let planes = self.layout.fields.len() * self.layout.steps.unwrap_or(1);
        let mut at = (0..planes).map(|i| at + (HEAD + i * missing.len()) as u64);
        at.try_for_each(|at| file.write(at, &missing))
    }

    /// Forces what was written to the disk.
    ///
    /// # Errors
    ///
    /// [`Failure::Write`] if the system cannot.
    pub fn force(&self) -> Result<(), Failure> {
        self.files.iter().try_for_each(KeptFile::force)
    }

    /// Says in the files that all cases are there.
    ///
    /// # Errors
    ///
    /// [`Failure::Write`] if it cannot be written.
    pub fn finish(&self) -> Result<(), Failure> {
        self.force()?;
        self.files.iter().try_for_each(|file| {
            file.write(CASES_AT as u64, &file.cases.to_be_bytes())?;
            file.force()
        })
    }

    /// File and first byte of a case; none if its grid is invalid.
    fn place(&self, case: usize) -> Option<(&KeptFile, u64)> {
        let elements = self.layout.grid_of(&self.numbering, case)?;
        let file = self.files.iter().find(|file| file.elements == elements)?;
        let record = u64::from(*self.records.get(case)?);
        let length = self.layout.record_bytes(elements) as u64;
        Some((file, file.start + record * length))
    }

    /// Bytes from the beginning of a case to a step of a field.
    fn offset(&self, file: &KeptFile, field: usize, step: usize) -> u64 {
        let plane = file.elements * file.elements * size_of::<f64>();
        (HEAD + field * self.layout.field_bytes(file.elements) + step * plane) as u64
    }
}

impl KeptFile {
    fn open(
        folder: &Path,
        identity: &StudyIdentity,
        layout: &KeptLayout,
        (elements, cases): (usize, u32),
        done: usize,
    ) -> Result<Self, Failure> {
        let path = folder.join(KeptLayout::file(elements, identity.shard));
        let failed = |cause| Failure::write(&path, cause);
        let beginning = layout.beginning(&identity.study, elements, 0);
        let beginning = beginning.map_err(failed)?;
        let start = beginning.len() as u64;
        let length = start + u64::from(cases) * layout.record_bytes(elements) as u64;
        if fs::symlink_metadata(&path).is_err() {
            if done > 0 {
                let reason = "it is missing, and the table has cases: give --fresh to begin again";
                return Err(Failure::damaged(&path, &reason));
            }
            file::write_whole(&path, |file| {
                file.write_all(&beginning)?;
                file.flush()?;
                file.get_ref().as_file().set_len(length)
            })?;
        } else if !begins_with(&path, &beginning, Some(length)) {
            return Err(Failure::NotKept { path });
        }
        let file = OpenOptions::new().read(true).write(true).open(&path);
        Ok(Self {
            elements,
            cases,
            file: Mutex::new(file.map_err(failed)?),
            path,
            start,
            is_unforced: AtomicBool::new(false),
        })
    }

    fn write(&self, at: u64, bytes: &[u8]) -> Result<(), Failure> {
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        let mut write = || {
            file.seek(SeekFrom::Start(at))?;
            file.write_all(bytes)
        };
        write().map_err(|cause| Failure::write(&self.path, cause))?;
        self.is_unforced.store(true, Ordering::Release);
        Ok(())
    }

    fn force(&self) -> Result<(), Failure> {
        if !self.is_unforced.swap(false, Ordering::Acquire) {
            return Ok(());
        }
        let file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        // The others write on meanwhile.
        let other = file.try_clone();
        drop(file);
        other
            .and_then(|file| file.sync_data())
            .map_err(|cause| Failure::write(&self.path, cause))
    }
}

/// Whether a file has this beginning, whatever number of cases it says it holds, and this length if one is given.
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

fn head(case: usize, status: CaseStatus, side: f64) -> Vec<u8> {
    // At most a million cases, and a few statuses.
    let number = |number: usize| u32::try_from(number).unwrap_or(u32::MAX).to_be_bytes();
    let status = CaseStatus::ALL.iter().position(|known| *known == status);
    let side = side.to_be_bytes();
    [
        &number(case + 1)[..],
        &number(status.unwrap_or_default()),
        &side,
    ]
    .concat()
}

fn big_endian(values: &[f64]) -> Vec<u8> {
    values
        .iter()
        .flat_map(|value| value.to_be_bytes())
        .collect()
}

fn missing(elements: usize) -> Vec<u8> {
    f64::NAN.to_be_bytes().repeat(elements * elements)
}

/// The values of a field in a step; none if there is no such step.
fn values<'a>(
    field: KeptField,
    path: &'a LoadingPath,
    step: usize,
    geometry: Option<&'a SampledModel>,
    surface: Option<&'a DeformedSurface>,
) -> Option<&'a [f64]> {
    let solved = path.steps.get(step)?;
    match field {
        KeptField::Pressure => Some(&solved.solution.pressure),
        KeptField::Displacement => surface.map(|surface| &surface.displacement[..]),
        KeptField::Gap => surface.map(|surface| &surface.gap[..]),
        KeptField::Shortening => surface.map(|surface| &surface.shortening[..]),
        KeptField::Profile => geometry.map(|geometry| geometry.relief.profile()),
    }
}

/// Refuses files of something else in the places of the gathered ones: those of the study that was gathered here before
/// give way if `other` says so.
///
/// # Errors
///
/// [`Failure::NotKept`] of the first of them.
pub fn check_whole(
    folder: &Path,
    whole: &StudyIdentity,
    before: Option<&StudyIdentity>,
    other: OtherTable,
) -> Result<(), Failure> {
    let Some(layout) = &whole.kept else {
        return Ok(());
    };
    let given_way: Vec<_> = match (before, other) {
        (Some(before), OtherTable::Replace) => before.kept_files(folder),
        _ => Vec::new(),
    };
    for elements in layout.grids() {
        let path = folder.join(KeptLayout::file(elements, Shard::WHOLE));
        let beginning = layout.beginning(&whole.study, elements, 0);
        let beginning = beginning.map_err(|cause| Failure::write(&path, cause))?;
        let is_there = fs::symlink_metadata(&path).is_ok();
        if is_there && !given_way.contains(&path) && !begins_with(&path, &beginning, None) {
            return Err(Failure::NotKept { path });
        }
    }
    Ok(())
}

/// Writes the files of the whole study from those of its parts, of which no case is missing.
///
/// # Errors
///
/// [`Failure`] if a part's file is not there, or nothing can be written.
pub fn gather(
    folder: &Path,
    whole: &StudyIdentity,
    parts: &[StudyIdentity],
) -> Result<(), Failure> {
    let Some(layout) = &whole.kept else {
        return Ok(());
    };
    let grids = layout.grids().into_iter();
    grids
        .map(|elements| gather_grid(folder, whole, layout, parts, elements))
        .collect()
}

fn gather_grid(
    folder: &Path,
    whole: &StudyIdentity,
    layout: &KeptLayout,
    parts: &[StudyIdentity],
    elements: usize,
) -> Result<(), Failure> {
    let path = folder.join(KeptLayout::file(elements, Shard::WHOLE));
    let failed = |cause| Failure::write(&path, cause);
    let beginning = |cases| layout.beginning(&whole.study, elements, cases);
    let is_of_grid = |case: &usize| layout.grid_of(&whole.numbering, *case) == Some(elements);
    let cases = (0..whole.numbering.len()).filter(is_of_grid);
    let wanted = beginning(0).map_err(failed)?;
    // In the order of the parts, from the first; none of a part without such a case.
    let mut files: Vec<Option<File>> = Vec::new();
    let count = whole_count(parts);
    files.resize_with(count, || None);
    for part in parts {
        if !part.cases().any(|case| is_of_grid(&case)) {
            continue;
        }
        let path = folder.join(KeptLayout::file(elements, part.shard));
        if !begins_with(&path, &wanted, None) {
            return Err(Failure::NotKept { path });
        }
        let open = || {
            let mut file = File::open(&path)?;
            file.seek(SeekFrom::Start(wanted.len() as u64))?;
            Ok(file)
        };
        let file = open().map_err(|cause: io::Error| Failure::damaged(&path, &cause))?;
        files[part.shard.index - 1] = Some(file);
    }
    let mut record = vec![0; layout.record_bytes(elements)];
    file::write_whole(&path, |file| {
        file.write_all(&beginning(cases.clone().count())?)?;
        for case in cases {
            let part = Shard::of(case, count);
            let mut part = files[part.index - 1].as_ref();
            let part = part.as_mut().ok_or(io::ErrorKind::NotFound)?;
            // A part holds its cases in order, too.
            part.read_exact(&mut record)?;
            file.write_all(&record)?;
        }
        Ok(())
    })
}

fn whole_count(parts: &[StudyIdentity]) -> usize {
    parts.first().map_or(1, |part| part.shard.count)
}
