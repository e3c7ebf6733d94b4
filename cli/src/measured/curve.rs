//! A measured curve: the points of one file that are used, in SI units, and what became of the others.

use std::path::{Path, PathBuf};

use super::binary::refuse_binary;
use super::channel::Channel;
use super::checks;
use super::cut::cut;
use super::data_table::DataTable;
use super::error::CurveError;
use super::exclusion::Exclusion;
use super::raw_curve::RawCurve;
use super::spring::{self, penetration};
use super::text_table::TextTable;
use super::warning::CurveWarning;

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
    /// What was left out.
    pub excluded: Vec<Exclusion>,
    /// What is worth knowing.
    pub warnings: Vec<CurveWarning>,
    channels: Vec<(Channel, Vec<f64>)>,
}

impl MeasuredCurve {
    /// Reads the file as a table says.
    ///
    /// # Errors
    ///
    /// [`CurveError`] if it gives no curve.
    pub fn read(path: &Path, data: &DataTable) -> Result<Self, CurveError> {
        let bytes = data
            .sources
            .read(path)
            .map_err(|error| CurveError::Unreadable {
                cause: error.to_string(),
            })?;
        Self::parse(path, &bytes, data)
    }

    /// Reads the bytes of a file.
    ///
    /// # Errors
    ///
    /// [`CurveError`] if they give no curve.
    pub fn parse(path: &Path, bytes: &[u8], data: &DataTable) -> Result<Self, CurveError> {
        let encoding = data.text.encoding;
        if !encoding.has_zero_bytes(bytes) {
            refuse_binary(path, bytes)?;
        }
        let decoded = encoding.decode(bytes)?;
        if decoded.text.trim().is_empty() {
            return Err(CurveError::Empty);
        }
        let table = TextTable::find(&decoded.text, &data.text)?;
        let mut raw = RawCurve::read(&table, &data.columns, &data.text)?;
        if let Some(spring) = data.spring_constant {
            spring::add_penetration(&mut raw, data.height_direction, spring)?;
        }
        let mut warnings = of_text(decoded.guessed, &table, data);
        let kept = cut(&raw, &data.segment, &mut warnings)?;
        let mut curve = Self {
            file: path.to_owned(),
            header: table.header.iter().map(|head| head.text.clone()).collect(),
            table_rows: raw.rows,
            channels: points(&raw, &kept.rows),
            rows: kept.rows.iter().map(|row| row + 1).collect(),
            excluded: kept.excluded,
            warnings,
        };
        curve.begin_at_zero(data);
        checks::refuse(&curve)?;
        let more = checks::warnings(&curve, &data.columns);
        curve.warnings.extend(more);
        Ok(curve)
    }

    /// The height counts from the first point, and the penetration from there too.
    fn begin_at_zero(&mut self, data: &DataTable) {
        let Some(spring) = data.spring_constant else {
            return;
        };
        for (channel, heights) in &mut self.channels {
            let first = heights.first().copied().unwrap_or(0.0);
            if *channel == Channel::Height {
                heights.iter_mut().for_each(|height| *height -= first);
            }
        }
        let depth = self.depth_with(spring.mean).unwrap_or_default();
        let found = self
            .channels
            .iter_mut()
            .find(|(channel, _)| *channel == Channel::Depth);
        if let Some((_, old)) = found {
            *old = depth;
        }
    }

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

fn points(raw: &RawCurve<'_>, rows: &[usize]) -> Vec<(Channel, Vec<f64>)> {
    let kept = |values: &[f64]| {
        rows.iter()
            .filter_map(|row| values.get(*row))
            .copied()
            .collect()
    };
    let channels = raw.channels.iter();
    channels
        .map(|(channel, values)| (*channel, kept(values)))
        .collect()
}

/// What the text itself gives reason to say.
fn of_text(guessed: Option<&str>, table: &TextTable<'_>, data: &DataTable) -> Vec<CurveWarning> {
    let mut warnings = Vec::new();
    if let Some(encoding) = guessed {
        let message = format!(
            "the file is not UTF-8 and is read as {encoding}: text.encoding = \"{encoding}\" says so"
        );
        warnings.push(CurveWarning::new("encoding-guessed", message));
    }
    if table.tables > 1 && data.text.table.is_none() {
        let message = format!(
            "the first of {} tables in the file is read: text.table = 1 says so",
            table.tables
        );
        warnings.push(CurveWarning::new("several-tables", message));
    }
    warnings
}
