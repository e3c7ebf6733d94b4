//! The reading of measured curves: from the bytes of a file to the points in use, as specified by a `[[data]]` table.

use std::path::{Path, PathBuf};

use pellicle::input::decode::{Decoded, TextEncoding};
use pellicle::input::diagnosis::Diagnosis;

use super::baseline;
use super::binary::refuse_binary;
use super::channel::Channel;
use super::checks;
use super::curve::{CurveWarning, MeasuredCurve};
use super::data_table::DataTable;
use super::error::CurveError;
use super::hysteresis::check_unloading;
use super::raw_curve::RawCurve;
use super::segment_rows::{branch, cut};
use super::sources::MeasurementSources;
use super::spring;
use super::stated::StatedNumber;
use super::text_options::TextOptions;
use super::text_table::TextTable;

impl MeasuredCurve {
    /// Reads all files of a table.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first file that does not give a curve, at the key to change.
    pub fn read_all(data: &DataTable) -> Result<Vec<Self>, Diagnosis> {
        if let Some(diagnosis) = data.without_files() {
            return Err(diagnosis);
        }
        let curve = |path: &PathBuf| {
            let curve = Self::read(path, data);
            curve.map_err(|error| data.diagnosis(path, &error))
        };
        data.files.iter().map(curve).collect()
    }

    /// Reads a file as specified by a table.
    ///
    /// # Errors
    ///
    /// [`CurveError`] if the file does not give a curve.
    pub fn read(path: &Path, data: &DataTable) -> Result<Self, CurveError> {
        let bytes = data
            .sources
            .read(path)
            .map_err(|error| CurveError::Unreadable {
                cause: error.to_string(),
            })?;
        Self::parse(path, &bytes, data)
    }

    /// Reads the numbers that a file states above its table; none if it cannot be read.
    pub(super) fn stated(
        path: &Path,
        data: (&MeasurementSources, &TextOptions),
    ) -> Vec<StatedNumber> {
        let (sources, text) = data;
        let Ok(bytes) = sources.read(path) else {
            return Vec::new();
        };
        let decoded = text.encoding.decode(&bytes);
        let table = decoded.ok().and_then(|decoded| {
            let table = TextTable::find(&decoded.text, text);
            table.ok().map(|table| table.stated)
        });
        table.unwrap_or_default()
    }

    /// Reads the bytes of a file.
    fn parse(path: &Path, bytes: &[u8], data: &DataTable) -> Result<Self, CurveError> {
        let decoded = decoded(path, bytes, data.text.encoding)?;
        let table = TextTable::find(&decoded.text, &data.text)?;
        let mut raw = RawCurve::read(&table, &data.columns, &data.text)?;
        let mut warnings = of_text(decoded.guessed, &table, data);
        warnings.extend(raw.missing.iter().map(|(channel, code)| {
            let message = format!("of the {} {code}; left out", channel.key());
            CurveWarning::new("missing-code", message)
        }));
        if let Some(spring) = data.spring_constant {
            warnings.extend(spring.compared_with(&table.stated)?);
            spring::add_penetration(&mut raw, data.height_direction, spring)?;
        }
        let forces = raw.values(Channel::Force);
        if let Some(forces) = forces.filter(|_| raw.is_in_order()) {
            checks::refuse_flat(forces)?;
        }
        let mut kept = branch(&raw, &data.segment, data.omit.of(path))?;
        let before_contact = baseline::subtract(&mut raw, &kept.rows, data)?;
        cut(&mut kept, &raw, &data.segment, &mut warnings);
        warnings.extend(check_unloading(&raw, &data.segment, &kept.rows)?);
        let mut curve = Self {
            file: path.to_owned(),
            header: table.header.iter().map(|head| head.text.clone()).collect(),
            table_rows: raw.rows,
            channels: points(&raw, &kept.rows),
            rows: kept.rows.iter().map(|row| row + 1).collect(),
            excluded: kept.excluded,
            stated: table.stated,
            before_contact,
            warnings,
        };
        curve.begin_at_zero(data);
        checks::refuse(&curve)?;
        let more = checks::warnings(&curve, data);
        curve.warnings.extend(more);
        Ok(curve)
    }

    /// Shifts height and penetration to be zero at the first point.
    fn begin_at_zero(&mut self, data: &DataTable) {
        let Some(spring) = data.spring_constant else {
            return;
        };
        for (channel, heights) in &mut self.channels {
            let first = heights.first().copied().unwrap_or(0.0);
            if *channel == Channel::Height {
                heights.iter_mut().for_each(|height| *height -= first);
                if let Some(before) = &mut self.before_contact {
                    before.contact -= first;
                }
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
}

/// The text of a file.
///
/// # Errors
///
/// [`CurveError`] if it is empty, binary or in another encoding.
pub(crate) fn decoded<'a>(
    path: &Path,
    bytes: &'a [u8],
    encoding: TextEncoding,
) -> Result<Decoded<'a>, CurveError> {
    if !encoding.has_zero_bytes(bytes) {
        refuse_binary(path, bytes)?;
    }
    let decoded = encoding.decode(bytes)?;
    if decoded.text.trim().is_empty() {
        return Err(CurveError::Empty);
    }
    Ok(decoded)
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

/// Warnings about the text itself: a guessed encoding, more than one table.
fn of_text(guessed: Option<&str>, table: &TextTable<'_>, data: &DataTable) -> Vec<CurveWarning> {
    let mut warnings = Vec::new();
    if let Some(encoding) = guessed {
        let message = format!(
            "the file is not UTF-8 and is read as {encoding}: give text.encoding = \"{encoding}\" to confirm"
        );
        warnings.push(CurveWarning::new("encoding-guessed", message));
    }
    if table.tables > 1 && data.text.table.is_none() {
        let message = format!(
            "the first of {} tables in the file is read: give text.table = 1 to confirm",
            table.tables
        );
        warnings.push(CurveWarning::new("several-tables", message));
    }
    warnings
}
