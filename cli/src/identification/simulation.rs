//! Simulated measurements of a fit file: the curve of its model, with its noise, in the format that it reads.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use pellicle::display::significant;
use pellicle_identify::fit_file::FitFile;
use pellicle_identify::fit_file::report::OutsidePoints;
use pellicle_identify::measured::channel::Channel;
use pellicle_identify::measured::columns::{ColumnName, ColumnUnit};
use pellicle_identify::measured::curve_segment::SegmentEnd;
use pellicle_identify::measured::data_table::DataTable;
use pellicle_identify::{
    ContactCurve, ContactCurves, CurveOptions, ForwardError, ForwardModel, Invalidity, Observable,
    Reading,
};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::units;
use crate::failure::Failure;

/// Number of points of a measurement, evenly spaced in the logarithm of the force.
const POINTS: u32 = 100;
/// Relative noise of the observed quantity if the fit file gives no noise.
const RELATIVE: f64 = 0.01;
/// Time between two points, s.
const INTERVAL: f64 = 0.1;

/// A simulated measurement.
pub struct Simulation {
    /// The table, in the columns and units that the fit file reads.
    pub text: String,
    /// Sentences on the points that are left out because they are beyond the model.
    pub warnings: Vec<String>,
}

/// Simulates the measurements of a table, with noise of this seed. Points beyond the model are left out, unless the fit
/// file keeps them.
///
/// # Errors
///
/// [`Failure`] if the fit file does not give the range of forces, the contact cannot be solved, or every point is
/// beyond the model.
pub fn measurement(file: &FitFile, table: usize, seed: u64) -> Result<Simulation, Failure> {
    let data = &file.data[table];
    file.refuse_adhesion("to simulate")?;
    let forces = forces(file, data)?;
    let curves = curves(file, data, &forces)?;
    let depths = curves.predict(&[]).map_err(|error| match error {
        ForwardError::OutOfRange { source } => Failure::NotSimulated(source.to_string()),
        other => Failure::NotSimulated(other.to_string()),
    })?;
    let beyond = match file.report.outside {
        OutsidePoints::LeaveOut => curves.beyond_model(&[])?,
        OutsidePoints::Keep => vec![None; forces.len()],
    };
    let mut normal = Normal(ChaCha8Rng::seed_from_u64(seed.wrapping_add(table as u64)));
    let noise = data.noise;
    let is_given = noise.depth.is_some() || noise.force.is_some() || noise.relative.is_some();
    let relative = noise
        .relative
        .unwrap_or(if is_given { 0.0 } else { RELATIVE });
    let [of_depth, of_force] = match data.observe {
        Observable::ForceAtDepth => [0.0, relative],
        _ => [relative, 0.0],
    };
    let points = forces.iter().zip(&depths.value).map(|(force, depth)| {
        let mut noisy = |value: f64, absolute: Option<f64>, relative: f64| {
            let deviation = absolute.unwrap_or(0.0).hypot(relative * value);
            value + deviation * normal.next()
        };
        [
            noisy(*depth, noise.depth, of_depth),
            noisy(*force, noise.force, of_force),
        ]
    });
    // Every point takes its noise, so that leaving some out changes no other.
    let points: Vec<_> = points.collect();
    let kept = points.iter().zip(&beyond);
    let kept = kept.filter(|(_, beyond)| beyond.is_none());
    let kept: Vec<[f64; 2]> = kept.map(|(point, _)| *point).collect();
    let warnings = left_out(&forces, &beyond);
    if kept.is_empty() {
        return Err(Failure::NotSimulated(warnings.join("; ")));
    }
    Ok(Simulation {
        text: text(data, &kept),
        warnings,
    })
}

/// A sentence for each reason for which points are left out, with their number and forces.
fn left_out(forces: &[f64], beyond: &[Option<Invalidity>]) -> Vec<String> {
    let mut by_reason: BTreeMap<String, Vec<f64>> = BTreeMap::new();
    for (force, reason) in forces.iter().zip(beyond) {
        if let Some(reason) = reason {
            by_reason
                .entry(reason.to_string())
                .or_default()
                .push(*force);
        }
    }
    let sentences = by_reason.into_iter().map(|(reason, forces)| {
        let count = forces.len();
        let scale = units::scale(forces[count - 1], "N");
        let [least, most] =
            [forces[0], forces[count - 1]].map(|force| significant(force / scale.divisor, 3));
        format!(
            "outside the model, {reason}: {count} points from {least} to {most} {} are left out; \
             report.outside = \"keep\" simulates them",
            scale.label
        )
    });
    sentences.collect()
}

/// The file of a table: the named one, or a numbered one if there are several tables.
#[must_use]
pub fn path(out: &Path, table: usize, tables: usize) -> PathBuf {
    if tables == 1 {
        return out.to_owned();
    }
    let stem = out.file_stem().unwrap_or_default().to_string_lossy();
    let ending = out.extension().map(|ending| ending.to_string_lossy());
    let ending = ending.map_or_else(String::new, |ending| format!(".{ending}"));
    out.with_file_name(format!("{stem}-{}{ending}", table + 1))
}

/// Returns forces between the ends of the segment, or else between those of the design.
fn forces(file: &FitFile, data: &DataTable) -> Result<Vec<f64>, Failure> {
    let segment = &data.segment;
    let design = &file.report.design.forces;
    let [least, most] = match (&segment.from, &segment.to) {
        (Some(SegmentEnd::Force(from)), Some(SegmentEnd::Force(to))) => [*from, *to],
        _ => [
            design.iter().copied().fold(f64::INFINITY, f64::min),
            design.iter().copied().fold(0.0, f64::max),
        ],
    };
    if !(least > 0.0 && most > least) {
        let wanted = "two positive forces from and to, between which measurements are simulated";
        return Err(data.wanted("segment", wanted).into());
    }
    let part = |i: u32| f64::from(i) / f64::from(POINTS - 1);
    Ok((0..POINTS)
        .map(|i| least * (most / least).powf(part(i)))
        .collect())
}

/// The curve of a table's model at these forces.
fn curves(file: &FitFile, data: &DataTable, forces: &[f64]) -> Result<ContactCurves, Failure> {
    if data.observe.observed() == Reading::Stiffness {
        let wanted = "\"depth at force\" or \"force at depth\" to simulate";
        return Err(data.wanted("observe", wanted).into());
    }
    let curve = ContactCurve {
        model: file.model.with(&data.set)?.model,
        observable: Observable::DepthAtForce,
        abscissae: forces.to_vec(),
        own: Vec::new(),
        origins: Vec::new(),
        thinned: None,
        adhesion: None,
        series: 0.0,
    };
    let options = CurveOptions::default();
    Ok(ContactCurves::new(vec![curve], Vec::new(), options)?)
}

/// Writes the table in the columns and units that the fit file reads.
fn text(data: &DataTable, points: &[[f64; 2]]) -> String {
    let mut columns: Vec<(usize, String, f64, Channel)> = Vec::new();
    let mut named = 0;
    for (channel, name, unit) in &data.columns.channels {
        let (factor, unit) = match unit {
            Some(ColumnUnit::Named(factor, text)) => (*factor, text.clone()),
            Some(ColumnUnit::Value(factor) | ColumnUnit::Calibration(factor, ..)) => {
                (*factor, String::new())
            }
            None => (1.0, channel.dimension().si_unit().to_owned()),
        };
        let (place, name) = match name {
            ColumnName::Number(number) => (*number, channel.key().to_owned()),
            ColumnName::Header(name) => (usize::MAX, name.clone()),
        };
        let head = if unit.is_empty() || name.contains(['(', '[']) {
            name
        } else {
            format!("{name} [{unit}]")
        };
        columns.push((place, head, factor, *channel));
    }
    // Columns without a number fill the remaining places.
    for index in 0..columns.len() {
        if columns[index].0 == usize::MAX {
            named += 1;
            while columns.iter().any(|(place, ..)| *place == named) {
                named += 1;
            }
            columns[index].0 = named;
        }
    }
    let count = columns.iter().map(|(place, ..)| *place).max().unwrap_or(0);
    let at = |place: usize| columns.iter().find(|(known, ..)| *known == place);
    let heads = (1..=count).map(|place| at(place).map_or("-", |(_, head, ..)| head));
    let mut text = heads.collect::<Vec<_>>().join(",") + "\n";
    for (index, [depth, force]) in points.iter().enumerate() {
        let cell = |place: usize| {
            let value = match at(place) {
                Some((.., factor, Channel::Depth)) => depth / factor,
                Some((.., factor, Channel::Force)) => force / factor,
                Some((.., factor, Channel::Time)) => index as f64 * INTERVAL / factor,
                _ => 0.0,
            };
            format!("{value:e}")
        };
        text += &((1..=count).map(cell).collect::<Vec<_>>().join(",") + "\n");
    }
    text
}

/// Standard normal numbers.
struct Normal(ChaCha8Rng);

impl Normal {
    fn next(&mut self) -> f64 {
        StandardNormal.sample(&mut self.0)
    }
}
