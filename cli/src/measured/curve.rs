//! A measured curve: the points of one file that are used, in SI units, and what became of the others.

use std::path::PathBuf;

use super::channel::Channel;
use super::error::CurveError;
use super::exclusion::ExcludedRows;
use super::spring::penetration;

/// A measured curve: the points of one file that are used, in SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredCurve {
    /// The file.
    pub file: PathBuf,
    /// The heads of its columns; empty if it has none.
    pub header: Vec<String>,
    /// Rows of its table; rows without any value do not count.
    pub table_rows: usize,
    /// The row of each point, from 1.
    pub rows: Vec<usize>,
    /// The points left out, by reason.
    pub excluded: Vec<ExcludedRows>,
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

    /// Penetrations, m; from the height of a piezo they are those at the mean spring constant.
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

    /// Approaches of the piezo from the first point on, m, positive towards the body.
    #[must_use]
    pub fn approach(&self) -> Option<&[f64]> {
        self.values(Channel::Height)
    }

    /// Deflections of the cantilever, m; none unless they have a column, and then the force comes from them.
    #[must_use]
    pub fn deflection(&self) -> Option<&[f64]> {
        self.values(Channel::Deflection)
    }

    /// Forces, N, at another spring constant, N/m, where they come from the deflection, which leaves the penetration as
    /// it is; none otherwise.
    #[must_use]
    pub fn force_with(&self, spring_constant: f64) -> Option<Vec<f64>> {
        let force = |deflection: &f64| spring_constant * deflection;
        Some(self.deflection()?.iter().map(force).collect())
    }

    /// Penetrations from the first point on, m, at another spring constant, N/m, where the forces are what they are;
    /// none without the height of a piezo.
    #[must_use]
    pub fn depth_with(&self, spring_constant: f64) -> Option<Vec<f64>> {
        Some(penetration(
            self.approach()?,
            self.force()?,
            spring_constant,
        ))
    }

    /// Looks whether the points are enough to fit so many unknowns: two more, one for the size of the noise and one
    /// left to judge the fit by.
    ///
    /// # Errors
    ///
    /// [`CurveError::TooFewPoints`] if they are not.
    pub fn enough_points(&self, unknowns: usize) -> Result<(), CurveError> {
        self.at_least(unknowns + 2)
    }

    /// Looks whether there are so many points.
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
    /// A sentence, for people.
    pub message: String,
}

impl CurveWarning {
    /// A warning with this code and sentence.
    #[must_use]
    pub fn new(code: &'static str, message: impl Into<String>) -> Self {
        let message = message.into();
        Self { code, message }
    }
}
