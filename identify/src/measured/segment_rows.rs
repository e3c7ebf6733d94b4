//! The rows of a measurement that lie in a segment.

use super::channel::Channel;
use super::curve::CurveWarning;
use super::curve_segment::{Branch, CurveSegment, SegmentEnd, Until};
use super::cycles::{end_of_loading, medians};
use super::depth_step::DepthStep;
use super::end_slopes::end_slopes;
use super::error::CurveError;
use super::exclusion::ExclusionReason::{
    AfterDepthStep, AfterLargestForce, AfterSegment, BeforeLargestForce, BeforeSegment,
    InvalidValue, Omitted, OtherSegment, Spike,
};
use super::exclusion::KeptRows;
use super::raw_curve::RawCurve;

/// An unloading given as a loading has its maximum force within the first 1/10 of its rows.
const FRACTION_OF_UNLOADING: usize = 10;

/// A force is a spike above so many times the median of it and its neighbours. A loading and unloading of three points
/// each rise by less to their largest force.
const SPIKE: f64 = 1.5;
/// It is above this part of the largest of these medians: below, noise may be as large.
const HIGH: f64 = 0.5;
/// The fewest rows in which one is sought.
const FEWEST_WITH_SPIKES: usize = 20;

/// A file that begins on the way back begins and later rises above this part of its range of forces.
const UPPER: f64 = 0.8;

/// Returns the rows of the branch of a segment, without the omitted ones, which are numbered from 1. The criteria are,
/// in this order: valid numbers, omitted rows, spikes, the value of the segment, its rows, markers and times, and its
/// branch.
pub(crate) fn branch(
    raw: &RawCurve<'_>,
    segment: &CurveSegment,
    omitted: &[usize],
) -> Result<KeptRows, CurveError> {
    let mut kept = KeptRows {
        rows: (0..raw.rows).collect(),
        ..KeptRows::default()
    };
    let valid = raw.valid_rows();
    kept.retain(InvalidValue, |row| valid.binary_search(&row).is_ok());
    if kept.rows.is_empty() {
        return Err(CurveError::NoNumbers { rows: raw.rows });
    }
    if let Some(row) = omitted.iter().copied().find(|row| *row > raw.rows) {
        return Err(CurveError::NoSuchRow {
            row,
            rows: raw.rows,
        });
    }
    kept.retain(Omitted, |row| !omitted.contains(&(row + 1)));
    let forces = raw.values(Channel::Force);
    if let Some(forces) = forces.filter(|_| raw.is_in_order()) {
        leave_out_spikes(&mut kept, forces);
    }
    keep_value(&mut kept, raw, segment)?;
    keep_between_rows(&mut kept, raw, segment)?;
    if let Some(forces) = raw.values(Channel::Force) {
        match turn_by_height(&kept.rows, raw, forces) {
            Some(turn) => keep_beside_turn(&mut kept, turn, segment.part),
            None => keep_part(&mut kept, forces, segment.part)?,
        }
    }
    Ok(kept)
}

/// Keeps the rows between the forces of a segment, and before its pop-in.
pub(crate) fn cut(
    kept: &mut KeptRows,
    raw: &RawCurve<'_>,
    segment: &CurveSegment,
    warnings: &mut Vec<CurveWarning>,
) {
    if let Some(forces) = raw.values(Channel::Force) {
        keep_between_forces(kept, forces, segment);
    }
    if segment.until == Until::LargestDepthStep {
        keep_before_step(kept, raw, warnings);
    }
}

fn leave_out_spikes(kept: &mut KeptRows, forces: &[f64]) {
    if kept.rows.len() < FEWEST_WITH_SPIKES {
        return;
    }
    let of_rows: Vec<f64> = kept.rows.iter().map(|row| forces[*row]).collect();
    let smooth = medians(&of_rows);
    let (_, largest) = range(smooth.iter().copied());
    let is_spike = |(force, median): (&f64, f64)| {
        *force > SPIKE * median.abs() && *force > HIGH * largest.abs()
    };
    let spikes: Vec<bool> = of_rows.iter().zip(smooth).map(is_spike).collect();
    let mut spikes = spikes.into_iter();
    kept.retain(Spike, |_| spikes.next() != Some(true));
}

fn keep_value(
    kept: &mut KeptRows,
    raw: &RawCurve<'_>,
    segment: &CurveSegment,
) -> Result<(), CurveError> {
    let Some(value) = &segment.value else {
        return Ok(());
    };
    let field = |row: usize| raw.segments.get(row).copied().unwrap_or_default();
    if !raw.segments.iter().any(|field| is_same(field, value)) {
        let (value, values) = (format!("\"{value}\""), listed(&raw.segments));
        return Err(CurveError::NoSuchSegment { value, values });
    }
    kept.retain(OtherSegment, |row| is_same(field(row), value));
    Ok(())
}

/// Whether two fields are equal as numbers or as text.
fn is_same(field: &str, value: &str) -> bool {
    let number = |text: &str| text.parse::<f64>().ok();
    field == value || number(field).is_some_and(|found| Some(found) == number(value))
}

/// Lists the first few distinct texts of a column.
fn listed(fields: &[&str]) -> String {
    const MOST: usize = 8;
    let mut different: Vec<&str> = Vec::new();
    for field in fields.iter().filter(|field| !field.is_empty()) {
        if different.len() <= MOST && !different.contains(field) {
            different.push(field);
        }
    }
    match different[..] {
        [] => "none".into(),
        _ if different.len() > MOST => {
            format!("\"{}\" and others", different[..MOST].join("\", \""))
        }
        _ => format!("\"{}\"", different.join("\", \"")),
    }
}

fn keep_between_rows(
    kept: &mut KeptRows,
    raw: &RawCurve<'_>,
    segment: &CurveSegment,
) -> Result<(), CurveError> {
    let row = |end: &'static str, given: &Option<SegmentEnd>| match given {
        Some(SegmentEnd::Row(row)) => Ok(Some(row - 1)),
        Some(SegmentEnd::Marker(marker)) => marked_row(raw, end, marker).map(Some),
        _ => Ok(None),
    };
    let (from, to) = (row("from", &segment.from)?, row("to", &segment.to)?);
    kept.retain(BeforeSegment, |row| from.is_none_or(|from| row >= from));
    kept.retain(AfterSegment, |row| to.is_none_or(|to| row <= to));
    let times = raw.values(Channel::Time).unwrap_or_default();
    let time = |row: usize| times.get(row).copied().unwrap_or(f64::NAN);
    if let Some(SegmentEnd::Time(from)) = segment.from {
        kept.retain(BeforeSegment, |row| time(row) >= from);
    }
    if let Some(SegmentEnd::Time(to)) = segment.to {
        kept.retain(AfterSegment, |row| time(row) <= to);
    }
    Ok(())
}

fn marked_row(raw: &RawCurve<'_>, end: &'static str, marker: &str) -> Result<usize, CurveError> {
    let found = raw.markers.iter().position(|field| *field == marker);
    found.ok_or_else(|| CurveError::NoSuchMarker {
        end,
        marker: marker.to_owned(),
        markers: listed(&raw.markers),
    })
}

/// The first and the last place of the largest height of a cantilever, where the largest force is far from the body:
/// that of a baseline which falls by more than the contact rises.
fn turn_by_height(rows: &[usize], raw: &RawCurve<'_>, forces: &[f64]) -> Option<[usize; 2]> {
    let heights = raw.values(Channel::Height)?;
    let [heights, forces] = [heights, forces].map(|values| {
        let of_rows = rows.iter().map(|row| values[*row]);
        of_rows.collect::<Vec<f64>>()
    });
    let (far, near) = range(heights.iter().copied());
    let (_, peak) = range(forces.iter().copied());
    let peak = forces.iter().position(|force| *force >= peak)?;
    let is_far = heights[peak] - far < 0.5 * (near - far);
    let [line, contact] = end_slopes(&heights, &forces);
    let is_line = contact > 0.0 && contact > line;
    let is_near = |height: &f64| *height >= near;
    let turn = [
        heights.iter().position(is_near)?,
        heights.iter().rposition(is_near)?,
    ];
    (is_far && is_line).then_some(turn)
}

fn keep_beside_turn(kept: &mut KeptRows, [first, last]: [usize; 2], part: Branch) {
    let (start, end) = match part {
        Branch::Whole => return,
        Branch::Loading => (0, first + 1),
        Branch::Unloading => (last, kept.rows.len()),
    };
    kept.keep_places(start, end, [BeforeLargestForce, AfterLargestForce]);
}

/// Keeps the rows up to the first maximum of the force, or from the last one on.
fn keep_part(kept: &mut KeptRows, forces: &[f64], part: Branch) -> Result<(), CurveError> {
    let (lowest, peak) = range(kept.rows.iter().map(|row| forces[*row]));
    // A constant force has no branches; the checks reject it.
    if lowest >= peak {
        return Ok(());
    }
    let is_peak = |row: &usize| forces[*row] >= peak;
    match part {
        Branch::Whole => {}
        Branch::Loading => {
            let of_rows: Vec<f64> = kept.rows.iter().map(|row| forces[*row]).collect();
            let start = after_way_back(&of_rows);
            let largest = range(of_rows[start..].iter().copied()).1;
            let peak = of_rows[start..].iter().position(|force| *force >= largest);
            let peak = start + peak.unwrap_or(0);
            refuse_unloading(&kept.rows[start..], forces, peak + 1 - start)?;
            let end = start + end_of_loading(&of_rows[start..=peak]) + 1;
            kept.keep_places(start, end, [BeforeLargestForce, AfterLargestForce]);
        }
        Branch::Unloading => {
            let start = kept.rows.iter().rposition(is_peak).unwrap_or(0);
            kept.keep_places(
                start,
                kept.rows.len(),
                [BeforeLargestForce, AfterLargestForce],
            );
        }
    }
    Ok(())
}

/// The smallest and the largest of some values.
fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let start = (f64::INFINITY, f64::NEG_INFINITY);
    values.fold(start, |(low, high), value| {
        (low.min(value), high.max(value))
    })
}

/// The place at which a loading begins: after the way back from the contact, in a file that begins with it, otherwise
/// at the first row.
fn after_way_back(forces: &[f64]) -> usize {
    let (lowest, highest) = range(forces.iter().copied());
    let first = forces.first().copied().unwrap_or(lowest);
    let turn = forces
        .iter()
        .position(|force| *force <= lowest)
        .unwrap_or(0);
    let (_, after) = range(forces[turn..].iter().copied());
    let part = |force: f64| (force - lowest) / (highest - lowest);
    if part(first) > UPPER && part(after) > UPPER {
        turn
    } else {
        0
    }
}

/// Rejects rows that begin in the upper half of their forces and soon reach the maximum.
fn refuse_unloading(rows: &[usize], forces: &[f64], end: usize) -> Result<(), CurveError> {
    let (Some(first), Some(last), Some(peak)) = (rows.first(), rows.last(), end.checked_sub(1))
    else {
        return Ok(());
    };
    let (lowest, _) = range(rows.iter().map(|row| forces[*row]));
    let (from, to, highest) = (forces[*first], forces[*last], forces[rows[peak]]);
    let begins_high = from - lowest > 0.5 * (highest - lowest);
    if begins_high && peak * FRACTION_OF_UNLOADING < rows.len() {
        return Err(CurveError::Unloading { from, to });
    }
    Ok(())
}

/// Keeps the points between the forces of the ends. A loading or unloading stays in one piece: the rows before the
/// force last enters this range and those after it first leaves are dropped.
fn keep_between_forces(kept: &mut KeptRows, forces: &[f64], segment: &CurveSegment) {
    let force = |end: &Option<SegmentEnd>, none| match end {
        Some(SegmentEnd::Force(force)) => *force,
        _ => none,
    };
    let from = force(&segment.from, f64::NEG_INFINITY);
    let to = force(&segment.to, f64::INFINITY);
    let below = |row: &usize| forces[*row] < from;
    let above = |row: &usize| forces[*row] > to;
    let behind_last = |rows: &[usize], outside: &dyn Fn(&usize) -> bool| {
        rows.iter().rposition(outside).map_or(0, |place| place + 1)
    };
    let first = |rows: &[usize], outside: &dyn Fn(&usize) -> bool| {
        rows.iter().position(outside).unwrap_or(rows.len())
    };
    let (start, length) = match segment.part {
        Branch::Loading => {
            let end = first(&kept.rows, &above);
            (behind_last(&kept.rows[..end], &below), end)
        }
        Branch::Unloading => {
            let start = behind_last(&kept.rows, &above);
            (start, start + first(&kept.rows[start..], &below))
        }
        Branch::Whole => {
            kept.retain(BeforeSegment, |row| !below(&row));
            kept.retain(AfterSegment, |row| !above(&row));
            return;
        }
    };
    kept.keep_places(start, length, [BeforeSegment, AfterSegment]);
}

fn keep_before_step(kept: &mut KeptRows, raw: &RawCurve<'_>, warnings: &mut Vec<CurveWarning>) {
    let depths = raw.values(Channel::Depth).unwrap_or_default();
    let depths: Vec<_> = kept
        .rows
        .iter()
        .filter_map(|row| depths.get(*row))
        .copied()
        .collect();
    let Some(step) = DepthStep::find(&depths, &kept.rows) else {
        return;
    };
    if step.stands_out() {
        kept.keep_places(0, step.last_before + 1, [BeforeSegment, AfterDepthStep]);
        return;
    }
    let message = format!(
        "the largest depth step, {:.3e} m, is less than ten times the median step, {:.3e} m: \
         it is not a pop-in, and the curve is not cut there",
        step.height, step.median
    );
    warnings.push(CurveWarning::new("no-depth-step", message));
}
