//! The key `baseline`: the line of forces before the contact, subtracted from all forces.

use pellicle::declare::shape::{Field, Shape, TableShape};
use pellicle::input::diagnosis::Diagnosis;
use pellicle::input::dimension::{Dimension, Sign};
use pellicle::input::value_reader::ValueReader;

use super::before_contact::{BeforeContact, FEWEST_POINTS, StretchShape};
use super::channel::Channel;
use super::curve_segment::Branch;
use super::cycles::peaks;
use super::data_table::DataTable;
use super::error::CurveError;
use super::raw_curve::RawCurve;
use super::spring;

/// The stretch that gives the baseline.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub enum Baseline {
    /// The whole stretch before the contact of a cantilever's curve that shows one, be it bent: its interference and
    /// its drift give such curves a slope.
    #[default]
    OfCantilever,
    /// Nothing is subtracted.
    Off,
    /// The whole stretch before the contact.
    BeforeContact,
    /// The part of it between two distances before the contact, m.
    Between([f64; 2]),
}

/// The stretch before the contact of a measured curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BeforeContactRows {
    /// Its line and its noise, of the forces as recorded.
    pub line: BeforeContact,
    /// Whether the line is subtracted from all forces.
    pub is_subtracted: bool,
    /// Whether a line was subtracted from forces that are no line.
    pub is_bent: bool,
    /// The row of the contact's point next to the stretch, from 1: the first one, or the last one of an unloading.
    pub contact_row: usize,
    /// Whether the stretch comes after the contact, as that of an unloading.
    pub is_after: bool,
    /// The depth, or the approach of a cantilever, at the break where the contact seems to begin, m.
    pub contact: f64,
    /// How far the lowest force of the file, on the way in or out, lies below the line, N: adhesion.
    pub pull_off: f64,
}

/// A pull-off is more than this many standard deviations of single forces,
const PULL_OFF_NOISE: f64 = 8.0;
/// and more than this part of the largest force.
const PULL_OFF_PART: f64 = 0.005;

impl Baseline {
    /// What it may be.
    #[must_use]
    pub fn shape() -> Shape {
        let words = vec!["before contact", "off"];
        Shape::Either(vec![Shape::Words(words), Shape::Table(Self::ends())])
    }

    /// The keys of a range of distances.
    fn ends() -> TableShape {
        let end = |key, meaning| {
            let length = Shape::Quantity(Dimension::Length, Sign::NotNegative);
            Field::required(key, meaning, length)
        };
        TableShape::of([end("from", "its nearer end"), end("to", "its farther end")])
    }

    /// Reads `"off"`, `"before contact"` or a range of distances before the contact.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first fault.
    pub fn read(field: &ValueReader<'_>) -> Result<Self, Diagnosis> {
        const WANTED: &str = "\"off\", \"before contact\" or { from = \"100 nm\", to = \"400 nm\" } before the contact";
        if !field.is_table() {
            return match field.text() {
                Ok("off") => Ok(Self::Off),
                Ok("before contact") => Ok(Self::BeforeContact),
                _ => Err(field.wanted(WANTED)),
            };
        }
        let table = field.clone().table()?;
        table.only(&Self::ends().keys())?;
        let end = |key| {
            table
                .required(key, WANTED)?
                .quantity(Dimension::Length, Sign::NotNegative)
        };
        let [near, far] = [end("from")?, end("to")?];
        if near >= far {
            return Err(table
                .required("to", WANTED)?
                .wanted("a distance beyond `from`"));
        }
        Ok(Self::Between([near, far]))
    }
}

impl BeforeContactRows {
    /// Whether a row, from 1, lies on its side of the contact.
    #[must_use]
    pub fn has(&self, row: usize) -> bool {
        if self.is_after {
            row > self.contact_row
        } else {
            row < self.contact_row
        }
    }

    /// The force without contact where it begins, and its standard error, N: what is left after a subtraction.
    #[must_use]
    pub fn zero(&self) -> [f64; 2] {
        let left = if self.is_subtracted {
            0.0
        } else {
            self.line.force
        };
        [left, self.line.force_sd]
    }

    /// The pull-off, N, if there is one beyond the noise.
    #[must_use]
    pub fn adhesion(&self, largest_force: f64) -> Option<f64> {
        Some(self.pull_off).filter(|found| is_pull_off(*found, self.line.noise, largest_force))
    }
}

/// Whether a force so far below the zero (N) is a pull-off rather than noise.
#[must_use]
pub fn is_pull_off(below: f64, noise: f64, largest_force: f64) -> bool {
    below > (PULL_OFF_NOISE * noise).max(PULL_OFF_PART * largest_force)
}

/// Finds the stretch before the contact of a loading, or after that of an unloading, in these rows, and subtracts its
/// line from the forces, if a table asks for it.
pub(super) fn subtract(
    raw: &mut RawCurve<'_>,
    rows: &[usize],
    data: &DataTable,
) -> Result<Option<BeforeContactRows>, CurveError> {
    let found = find(raw, rows, data);
    let straight = found.filter(|(_, shape)| *shape == StretchShape::Straight);
    let straight = straight.map(|(found, _)| found);
    let is_of_cantilever = raw.values(Channel::Height).is_some();
    let is_bent = found.is_some_and(|(_, shape)| shape == StretchShape::Bent);
    let range = match data.baseline {
        Baseline::OfCantilever if is_of_cantilever && (straight.is_some() || is_bent) => None,
        Baseline::Off | Baseline::OfCantilever => return Ok(straight),
        Baseline::BeforeContact => None,
        Baseline::Between(range) => Some(range),
    };
    let none = CurveError::NoBaseline {
        range,
        wanted: FEWEST_POINTS,
    };
    let (mut found, _) = found.ok_or(none.clone())?;
    let (coordinate, forces) = curve(raw).ok_or(none.clone())?;
    if let Some(range) = range {
        let [x, y] = [coordinate, forces].map(|values| chosen(values, rows));
        found.line = found.line.between(&x, &y, range).ok_or(none)?;
    }
    found.is_subtracted = true;
    found.is_bent = is_bent && range.is_none();
    let pairs = coordinate.iter().zip(forces);
    let left = pairs
        .map(|(x, force)| force - found.line.force_at(*x))
        .collect();
    raw.replace(Channel::Force, left);
    if let Some(constant) = data.spring_constant {
        spring::subtract_deflection(raw, constant);
    }
    Ok(Some(found))
}

/// The stretch, and what it looks like.
fn find(
    raw: &RawCurve<'_>,
    rows: &[usize],
    data: &DataTable,
) -> Option<(BeforeContactRows, StretchShape)> {
    let (coordinate, forces) = curve(raw)?;
    let is_after = data.segment.part == Branch::Unloading;
    let rows: Vec<usize> = match data.segment.part {
        _ if data.is_unloading() => up_to_first_peak(rows, forces).to_vec(),
        Branch::Loading => rows.to_vec(),
        // From its end on, as an approach.
        Branch::Unloading => rows.iter().rev().copied().collect(),
        Branch::Whole => return None,
    };
    let rows = &rows;
    let [x, y] = [coordinate, forces].map(|values| chosen(values, rows));
    let line = BeforeContact::find(&x, &y)?;
    let below = |(x, force): (&f64, &f64)| line.force_at(*x) - force;
    let depths = coordinate.iter().zip(forces).map(below);
    let found = BeforeContactRows {
        contact_row: rows.get(line.first_in_contact)? + 1,
        is_after,
        contact: line.contact,
        is_subtracted: false,
        is_bent: false,
        pull_off: depths.fold(0.0, f64::max),
        line,
    };
    Some((found, line.shape(&x, &y)))
}

/// The rows of the first loading, before which the contact begins.
fn up_to_first_peak<'r>(rows: &'r [usize], forces: &[f64]) -> &'r [usize] {
    let peaks = peaks(&chosen(forces, rows));
    &rows[..peaks.first().map_or(rows.len(), |place| place + 1)]
}

/// The coordinate along which a baseline runs, and the forces.
fn curve<'r>(raw: &'r RawCurve<'_>) -> Option<(&'r [f64], &'r [f64])> {
    let coordinate = raw
        .values(Channel::Height)
        .or_else(|| raw.values(Channel::Depth))?;
    Some((coordinate, raw.values(Channel::Force)?))
}

fn chosen(values: &[f64], rows: &[usize]) -> Vec<f64> {
    rows.iter()
        .filter_map(|row| values.get(*row))
        .copied()
        .collect()
}
