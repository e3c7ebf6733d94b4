//! Checks of a curve before a fit: errors if it cannot be used, warnings if it is doubtful.

use pellicle::display::count;

use super::channel::Channel;
use super::columns::ColumnUnit;
use super::curve::{CurveWarning, MeasuredCurve};
use super::cycles::scatter;
use super::data_table::DataTable;
use super::error::CurveError;
use super::exclusion::ExclusionReason;
use super::spring::contact_slope;

/// Means of so many blocks of forces without contact differ by less than so many of their standard deviations; with
/// fewer points this is not asked.
const BLOCKS: usize = 16;
const FLAT_DEVIATIONS: f64 = 6.0;
const FEWEST_FOR_FLATNESS: usize = 64;
/// The smallest number of points of a curve.
const LEAST_POINTS: usize = 3;
/// With fewer points than this, the noise cannot be estimated usefully.
const FEW_POINTS: usize = 10;
/// Largest area under a curve, relative to its rectangle, without a warning. It is 2/5 for Hertz, 1/3 for a cone, 1/2
/// for a flat punch, and 3/5 for Hertz with depth and force swapped.
const LARGEST_AREA: f64 = 0.55;
/// The usual ranges of depth and force; no indentation of a coating lies outside them.
const USUAL: [(Channel, f64, f64, &str); 2] = [
    (Channel::Depth, 1e-11, 1e-3, "m"),
    (Channel::Force, 1e-13, 1e3, "N"),
];

/// Rejects data that are not a curve.
pub(super) fn refuse(curve: &MeasuredCurve) -> Result<(), CurveError> {
    curve.at_least(LEAST_POINTS)?;
    let (Some(depth), Some(force)) = (curve.depth(), curve.force()) else {
        return Ok(());
    };
    let (lowest, highest) = range(force);
    if lowest >= highest {
        return Err(CurveError::ConstantForce { force: highest });
    }
    let (noise, is_flat) = noise_and_flatness(force);
    if is_flat && curve.stiffness().is_none() {
        return Err(CurveError::NoContact { noise });
    }
    if contact_slope(depth, force) < 0.0 {
        return Err(CurveError::DepthFalls);
    }
    Ok(())
}

/// Rejects forces that nowhere rise above their noise, those of all rows: the largest of a flat stretch would end its
/// loading anywhere.
pub(super) fn refuse_flat(forces: &[f64]) -> Result<(), CurveError> {
    let finite: Vec<f64> = forces.iter().copied().filter(|f| f.is_finite()).collect();
    if finite.len() < FEWEST_FOR_FLATNESS {
        return Ok(());
    }
    match noise_and_flatness(&finite) {
        (noise, true) if noise > 0.0 => Err(CurveError::NoContact { noise }),
        _ => Ok(()),
    }
}

/// The standard deviation of white noise on forces, and whether they are nothing else: the means of blocks differ by no
/// more than theirs.
fn noise_and_flatness(force: &[f64]) -> (f64, bool) {
    let noise = scatter(force);
    let size = force.len().div_ceil(BLOCKS);
    let means = force.chunks(size);
    let means = means.map(|block| block.iter().sum::<f64>() / block.len() as f64);
    let (lowest, highest) = means.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), mean| {
        (low.min(mean), high.max(mean))
    });
    let is_flat = highest - lowest < FLAT_DEVIATIONS * noise / (size as f64).sqrt();
    (noise, is_flat && force.len() >= FEWEST_FOR_FLATNESS)
}

/// The warnings about a curve.
pub(super) fn warnings(curve: &MeasuredCurve, data: &DataTable) -> Vec<CurveWarning> {
    let mut warnings = Vec::new();
    let mut warn = |code, message: String| warnings.push(CurveWarning::new(code, message));
    let points = curve.rows.len();
    if points < FEW_POINTS {
        warn(
            "few-points",
            format!("{points} points: too few to estimate their noise"),
        );
    }
    if curve.before_contact.is_some_and(|before| before.is_bent) {
        let message = "the forces before the contact are no line, as with interference or drift: the line through them is \
                       subtracted, but the contact and the modulus are uncertain; baseline = { from = .., to = .. } in \
                       [[data]] takes a part nearer to the contact";
        warn("bent-baseline", message.into());
    }
    let left_out = |reason: ExclusionReason| {
        let found = curve.excluded.iter().find(|found| found.reason == reason);
        found.map_or(0, |found| found.count)
    };
    let spikes = left_out(ExclusionReason::Spike);
    if spikes > 0 {
        let message = format!(
            "{} with a force more than half above those beside it: left out as a spike",
            count(spikes, "row")
        );
        warn("spike", message);
    }
    let invalid = left_out(ExclusionReason::InvalidValue);
    if invalid * 10 > curve.table_rows {
        let rows = curve.table_rows;
        warn(
            "many-invalid",
            format!("{invalid} of {rows} rows hold an invalid value and are left out"),
        );
    }
    if curve
        .time()
        .is_some_and(|time| time.windows(2).any(|pair| pair[1] < pair[0]))
    {
        warn(
            "time-falls",
            "the time falls between some points: the rows are not in the order of measurement"
                .into(),
        );
    }
    let area = relative_area(curve).filter(|_| !data.is_unloading());
    if let Some(area) = area.filter(|area| *area > LARGEST_AREA) {
        let message = format!(
            "the force rises ever more slowly with the depth (area under the curve {area:.2} of its rectangle, \
             elastic contacts have 0.5 or less): are the columns swapped, or is this not a contact?"
        );
        warn("concave-curve", message);
    }
    for (channel, least, most, unit) in USUAL {
        let is_bare = data.columns.channels.iter().any(|(found, _, given)| {
            *found == channel && matches!(given, Some(ColumnUnit::Value(_)))
        });
        let Some((lowest, highest)) = curve.values(channel).filter(|_| !is_bare).map(range) else {
            continue;
        };
        let size = highest - lowest;
        if size < least || size > most {
            let key = channel.key();
            let message = format!(
                "a {key} range of {size:.3e} {unit} is unusual for an indentation: is its unit right?"
            );
            warn("unusual-size", message);
        }
    }
    warnings
}

fn range(values: &[f64]) -> (f64, f64) {
    let start = (f64::INFINITY, f64::NEG_INFINITY);
    values
        .iter()
        .fold(start, |(low, high), v| (low.min(*v), high.max(*v)))
}

/// The area under force over depth above the lower end, relative to the rectangle between both ends.
fn relative_area(curve: &MeasuredCurve) -> Option<f64> {
    let (depth, force) = (curve.depth()?, curve.force()?);
    let (first, last) = (force.first()?, force.last()?);
    let lower = first.min(*last);
    let rectangle = (depth.last()? - depth.first()?) * (last - first).abs();
    let strips = depth.windows(2).zip(force.windows(2));
    let strip = |(d, f): (&[f64], &[f64])| 0.5 * (f[0] + f[1] - 2.0 * lower) * (d[1] - d[0]);
    let area: f64 = strips.map(strip).sum();
    let has_area = rectangle != 0.0 && (last > first) == (rectangle > 0.0);
    (depth.len() >= FEW_POINTS && has_area).then(|| area / rectangle)
}
