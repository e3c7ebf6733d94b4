//! The record of a case in a file of kept fields: number, status and side, followed by the fields one after the other.
//!
//! The program writes it at its place in the file, field by field. A worker of an engine, possibly on another machine,
//! makes the same bytes in memory, and the process that gathers the rows writes them.

use std::fmt::Debug;
use std::sync::{Mutex, PoisonError};

use pellicle_contact::{DeformedSurface, LoadingPath, SampledModel};

use crate::KeptField;
use crate::StudyError;
use crate::case_status::CaseStatus;
use crate::identity::StudyIdentity;
use crate::kept_layout::{HEAD, KeptLayout};
use crate::numbering::CaseNumbering;

/// The layout and the numbering of the records of a study's cases.
#[derive(Debug, Clone)]
pub struct KeptRecords {
    layout: KeptLayout,
    numbering: CaseNumbering,
}

impl KeptRecords {
    /// Returns the records of a study; `None` if it keeps nothing.
    #[must_use]
    pub fn of(identity: &StudyIdentity) -> Option<Self> {
        Some(Self {
            layout: identity.kept.clone()?,
            numbering: identity.numbering.clone(),
        })
    }

    /// The fields and their order.
    #[must_use]
    pub fn layout(&self) -> &KeptLayout {
        &self.layout
    }

    /// Elements per side of a case; `None` if they are invalid.
    #[must_use]
    pub fn elements_of(&self, case: usize) -> Option<usize> {
        self.layout.grid_of(&self.numbering, case)
    }

    /// Whether any kept field is computed from the pressure.
    #[must_use]
    pub fn need_the_surface(&self) -> bool {
        let mut fields = self.layout.fields.iter();
        fields.any(|field| field.is_of_the_surface())
    }
}

/// A store for the fields of cases.
pub trait FieldKeeper: Debug + Sync {
    /// Returns the layout and the numbering of the records.
    fn records(&self) -> &KeptRecords;

    /// Writes bytes of a case, beginning at byte `at` of its record.
    ///
    /// # Errors
    ///
    /// [`StudyError::File`] if they cannot be written.
    fn write(&self, case: usize, at: u64, bytes: &[u8]) -> Result<(), StudyError>;

    /// Forces everything written to disk, if the store is on one.
    ///
    /// # Errors
    ///
    /// [`StudyError::File`] if the system cannot do so.
    fn force(&self) -> Result<(), StudyError>;
}

/// Stores the fields of a solved case.
///
/// # Errors
///
/// Those of the keeper.
pub fn add(
    keeper: &dyn FieldKeeper,
    case: usize,
    status: CaseStatus,
    path: &LoadingPath,
) -> Result<(), StudyError> {
    let records = keeper.records();
    let Some(elements) = records.elements_of(case) else {
        return Ok(());
    };
    keeper.write(case, 0, &head(case, status, path.grid.side()))?;
    let layout = &records.layout;
    let kept = layout.steps.unwrap_or(1);
    let first = match layout.steps {
        Some(_) => 0,
        None => path.steps.len().saturating_sub(1),
    };
    let needs_surface = records.need_the_surface();
    let needs_geometry = needs_surface || layout.fields.contains(&KeptField::Profile);
    let geometry = needs_geometry.then(|| path.geometry());
    for place in 0..kept {
        let step = first + place;
        let geometry = geometry.as_ref();
        let surface = geometry.filter(|_| needs_surface);
        let surface = surface.and_then(|geometry| path.surface(geometry, step));
        for (i, field) in layout.fields.iter().enumerate() {
            let values = values(*field, path, step, geometry, surface.as_ref());
            let bytes = values.map_or_else(|| missing(elements), big_endian);
            keeper.write(case, layout.offset(elements, i, place), &bytes)?;
        }
    }
    Ok(())
}

/// Stores NaN for the fields of a case without a result.
///
/// # Errors
///
/// Those of the keeper.
pub fn add_failed(keeper: &dyn FieldKeeper, case: usize) -> Result<(), StudyError> {
    let records = keeper.records();
    let Some(elements) = records.elements_of(case) else {
        return Ok(());
    };
    keeper.write(case, 0, &head(case, CaseStatus::Failed, f64::NAN))?;
    let missing = missing(elements);
    let planes = records.layout.fields.len() * records.layout.steps.unwrap_or(1);
    let mut places = (0..planes).map(|i| (HEAD + i * missing.len()) as u64);
    places.try_for_each(|at| keeper.write(case, at, &missing))
}

/// A record in memory, one case at a time.
#[derive(Debug)]
pub struct RecordInMemory {
    records: KeptRecords,
    bytes: Mutex<Vec<u8>>,
}

impl RecordInMemory {
    /// Returns `None` if the study keeps nothing.
    #[must_use]
    pub fn of(identity: &StudyIdentity) -> Option<Self> {
        let records = KeptRecords::of(identity)?;
        let bytes = Mutex::default();
        Some(Self { records, bytes })
    }

    /// Returns and clears what was stored since the last call; empty for a case whose grid is invalid.
    #[must_use]
    pub fn take(&self) -> Vec<u8> {
        std::mem::take(&mut self.bytes.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl FieldKeeper for RecordInMemory {
    fn records(&self) -> &KeptRecords {
        &self.records
    }

    fn write(&self, case: usize, at: u64, bytes: &[u8]) -> Result<(), StudyError> {
        let mut record = self.bytes.lock().unwrap_or_else(PoisonError::into_inner);
        let elements = self.records.elements_of(case).unwrap_or(0);
        record.resize(self.records.layout.record_bytes(elements), 0);
        let start = usize::try_from(at).unwrap_or(usize::MAX);
        // Every field lies within its record.
        if let Some(place) = record.get_mut(start..start.saturating_add(bytes.len())) {
            place.copy_from_slice(bytes);
        }
        Ok(())
    }

    fn force(&self) -> Result<(), StudyError> {
        Ok(())
    }
}

fn head(case: usize, status: CaseStatus, side: f64) -> Vec<u8> {
    // There are at most a million cases and a few statuses.
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

/// The values of a field in a step; `None` if there is no such step.
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
