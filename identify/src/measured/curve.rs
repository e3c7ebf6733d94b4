//! A measured curve: the points in use of one file, in SI units, and the number of excluded points by reason.

use std::path::PathBuf;

use super::baseline::BeforeContactRows;
use super::channel::Channel;
use super::error::CurveError;
use super::exclusion::ExcludedRows;
use super::spring::penetration;
use super::stated::StatedNumber;

/// A measured curve: the points in use of one file, in SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredCurve {
    /// The file.
    pub file: PathBuf,
    /// The headers of its columns; empty if there are none.
    pub header: Vec<String>,
    /// Number of rows of its table, not counting rows without any value.
    pub table_rows: usize,
    /// The row of each point, from 1.
    pub rows: Vec<usize>,
    /// The points left out, by reason.
    pub excluded: Vec<ExcludedRows>,
    /// The numbers that the file states above its table.
    pub stated: Vec<StatedNumber>,
    /// The stretch before the contact, if the file shows one.
    pub before_contact: Option<BeforeContactRows>,
    /// Warnings about the curve.
    pub warnings: Vec<CurveWarning>,
    pub(super) channels: Vec<(Channel, Vec<f64>)>,
}

impl MeasuredCurve {
    /// The values of a quantity at every point, SI; none if it has no column.
    #[must_use]
    pub fn values(&self, channel: Channel) -> Option<&[f64]> {
        let found = self.channels.iter().find(|(found, _)| *found == channel);
        found.map(|(_, values)| values.as_slice())
    }

    /// The same curve up to a number of points, without its warnings.
    #[must_use]
    pub(crate) fn up_to(&self, points: usize) -> Self {
        let kept = |(channel, values): &(Channel, Vec<f64>)| {
            (*channel, values[..points.min(values.len())].to_vec())
        };
        Self {
            rows: self.rows[..points].to_vec(),
            channels: self.channels.iter().map(kept).collect(),
            warnings: Vec::new(),
            ..self.clone()
        }
    }

    /// Penetrations, m; if computed from the height of a piezo, those at the mean spring constant.
    #[must_use]
    pub fn depth(&self) -> Option<&[f64]> {
        self.values(Channel::Depth)
    }

    /// Forces, N.
    #[must_use]
    pub fn force(&self) -> Option<&[f64]> {
        self.values(Channel::Force)
    }

    /// Times, s.
    #[must_use]
    pub fn time(&self) -> Option<&[f64]> {
        self.values(Channel::Time)
    }

    /// Contact stiffnesses, N/m.
    #[must_use]
    pub fn stiffness(&self) -> Option<&[f64]> {
        self.values(Channel::Stiffness)
    }

    /// Radii of the contact, m.
    #[must_use]
    pub fn contact_radius(&self) -> Option<&[f64]> {
        self.values(Channel::ContactRadius)
    }

    /// Approaches of the piezo relative to the first point, m, positive towards the body.
    #[must_use]
    pub fn approach(&self) -> Option<&[f64]> {
        self.values(Channel::Height)
    }

    /// Deflections of the cantilever, m; none without a column of them. If there is one, it gives the force.
    #[must_use]
    pub fn deflection(&self) -> Option<&[f64]> {
        self.values(Channel::Deflection)
    }

    /// Penetrations relative to the first point, m, at another spring constant, N/m, with unchanged forces; none
    /// without the height of a piezo.
    #[must_use]
    pub fn depth_with(&self, spring_constant: f64) -> Option<Vec<f64>> {
        Some(penetration(
            self.approach()?,
            self.force()?,
            spring_constant,
        ))
    }

    /// Checks that there are at least `wanted` points.
    pub(super) fn at_least(&self, wanted: usize) -> Result<(), CurveError> {
        let (found, rows) = (self.rows.len(), self.table_rows);
        if found < wanted {
            return Err(CurveError::TooFewPoints {
                found,
                rows,
                wanted,
            });
        }
        Ok(())
    }
}

/// A warning about a measured curve.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CurveWarning {
    /// A short name, for programs.
    pub code: &'static str,
    /// A sentence, for human readers.
    pub message: String,
}

impl CurveWarning {
    /// Creates a warning with this code and sentence.
    #[must_use]
    pub fn new(code: &'static str, message: impl Into<String>) -> Self {
        let message = message.into();
        Self { code, message }
    }
}
