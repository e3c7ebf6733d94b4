//! The phases of an indentation, by its forces: loading, hold at the largest force, unloading, hold for the drift.

use std::collections::VecDeque;
use std::ops::Range;

use super::IndentationError;
use crate::measured::cycles::{NORMAL_OVER_MEDIAN, hold_width, median, medians, scatter};

/// Points within this part of the largest force belong to its neighbourhood, in which a hold is sought.
const NEAR_LARGEST: f64 = 0.005;
/// A hold has so many times the points that the unloading would have there, and this many more.
const HOLD_FACTOR: f64 = 3.0;
const HOLD_POINTS: f64 = 5.0;
/// The force of a hold for the drift stays within this part of the largest force, or within so many standard
/// deviations.
const DRIFT_WIDTH: f64 = 0.02;
const DRIFT_DEVIATIONS: f64 = 8.0;
/// Its own forces lie within so many of their standard deviations.
const STEADY_DEVIATIONS: f64 = 4.0;
/// In an unloading it is below this part of the largest force, and above that, where the indenter may have lost the
/// contact. In a loading, where a body creeps under a force that it bears for the first time, below a tenth.
const DRIFT_FORCES: Range<f64> = 0.02..0.6;
const DRIFT_FORCES_OF_LOADING: Range<f64> = 0.02..0.1;
/// It lasts so many times as long as the unloading takes to fall by that width, and has so many points.
const DRIFT_PASSAGES: f64 = 3.0;
const DRIFT_POINTS: usize = 10;

/// The phases of a curve, as places of its points.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Phases {
    /// The hold at the largest force, its last point included; one point without a hold.
    pub top: Range<usize>,
    /// Whether there is a hold at the largest force.
    pub is_held: bool,
    /// The points of the unloading that are fitted.
    pub fitted: Range<usize>,
    /// The end of the unloading: its last point before the force no longer falls.
    pub end: usize,
}

/// Finds the phases of a curve of these forces. `part` is the part of the largest force between whose ends, from above,
/// the unloading is fitted.
///
/// # Errors
///
/// [`IndentationError::Unfinished`] if the force does not fall to its lower end, [`IndentationError::FewPoints`] if
/// fewer than `fewest` points lie there.
pub(super) fn phases(
    force: &[f64],
    part: [f64; 2],
    fewest: usize,
) -> Result<Phases, IndentationError> {
    let smooth = medians(force);
    let largest = smooth.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let near = |f: &f64| *f >= (1.0 - NEAR_LARGEST) * largest;
    let end = smooth.iter().rposition(near).unwrap_or(0);
    let below = |f: &f64| *f < (1.0 - 4.0 * NEAR_LARGEST) * largest;
    let start = smooth[..end].iter().rposition(below).map_or(0, |at| at + 1);
    let (top, is_held) = hold(force, start..end + 1, [largest, part[1] * largest]);
    let level = if is_held {
        median(&force[top.clone()])
    } else {
        largest
    };
    let [high, low] = part.map(|part| part * level);
    let after = &force[top.end..];
    let first = after.iter().position(|f| *f <= high);
    let last = after.iter().position(|f| *f < low);
    let lowest = after.iter().copied().fold(level, f64::min);
    let (Some(first), Some(last)) = (first, last) else {
        let ends = lowest / level;
        return Err(IndentationError::Unfinished {
            ends,
            wanted: part[1],
        });
    };
    if last < first + fewest {
        return Err(IndentationError::FewPoints {
            found: last.saturating_sub(first),
            from: part[0],
            to: part[1],
            wanted: fewest,
        });
    }
    let fitted = top.end + first..top.end + last;
    // The unloading ends where the force is lowest, or at the last point.
    let place = after.iter().position(|f| *f <= lowest);
    Ok(Phases {
        end: top.end + place.unwrap_or(after.len() - 1),
        top,
        is_held,
        fitted,
    })
}

/// The hold within the neighbourhood of the largest force, before an unloading to the lowest; without a hold the point
/// of the largest force. Below, the steps may be those of a hold for the drift.
fn hold(force: &[f64], near: Range<usize>, [largest, lowest]: [f64; 2]) -> (Range<usize>, bool) {
    let peak = near
        .clone()
        .max_by(|a, b| force[*a].total_cmp(&force[*b]))
        .unwrap_or(near.start);
    let after = &force[near.end..];
    let unloaded = after.iter().position(|force| *force < lowest);
    let steps = after[..unloaded.unwrap_or(after.len())]
        .windows(2)
        .map(|pair| pair[0] - pair[1])
        .filter(|step| *step > 0.0);
    let mut steps: Vec<f64> = steps.take(100).collect();
    let step = if steps.is_empty() {
        largest
    } else {
        steps.sort_by(f64::total_cmp);
        steps[steps.len() / 2]
    };
    let expected = 2.0 * NEAR_LARGEST * largest / step;
    if (near.len() as f64) < HOLD_FACTOR * expected + HOLD_POINTS {
        return (peak..peak + 1, false);
    }
    let level = median(&force[near.clone()]);
    let width = hold_width(force, largest);
    let mut held = near.clone().filter(|at| force[*at] >= level - width);
    let first = held.next().unwrap_or(peak);
    let last = held.next_back().unwrap_or(first);
    (first..last + 1, true)
}

/// The longest hold at a constant force in the unloading if there is one, otherwise early in the loading; none if none
/// is clear.
pub(super) fn drift_hold(time: &[f64], force: &[f64], phases: &Phases) -> Option<Range<usize>> {
    let level = median(&force[phases.top.clone()]);
    let width = (DRIFT_WIDTH * level).max(DRIFT_DEVIATIONS * scatter(force));
    let after = (phases.top.end..force.len(), DRIFT_FORCES);
    let before = (0..phases.top.start, DRIFT_FORCES_OF_LOADING);
    [after, before].into_iter().find_map(|(range, parts)| {
        let within = parts.start * level..parts.end * level;
        let found = longest(&time[range.clone()], &force[range.clone()], width, within)?;
        let found = steady(found.start + range.start..found.end + range.start, force);
        let duration = time[found.end - 1] - time[found.start];
        // What the unloading takes from its start to this force, or the loading from no force.
        let (travel, fall) = if found.start >= phases.top.end {
            let fall = level - median(&force[found.clone()]);
            (time[found.start] - time[phases.top.end - 1], fall)
        } else {
            (time[found.start] - time[0], median(&force[found.clone()]))
        };
        let passage = travel * width / fall;
        (duration >= DRIFT_PASSAGES * passage && found.len() >= DRIFT_POINTS).then_some(found)
    })
}

/// The part of a hold from its first to its last point at its force: the run includes the ends of the unloadings beside
/// it, on which the depth changes.
fn steady(run: Range<usize>, force: &[f64]) -> Range<usize> {
    let level = median(&force[run.clone()]);
    let far: Vec<f64> = run.clone().map(|at| (force[at] - level).abs()).collect();
    let width = STEADY_DEVIATIONS * NORMAL_OVER_MEDIAN * median(&far);
    let mut held = run.clone().filter(|at| (force[*at] - level).abs() <= width);
    let first = held.next().unwrap_or(run.start);
    first..held.next_back().unwrap_or(first) + 1
}

/// The longest run, in time, of forces within a width, all within a range.
fn longest(time: &[f64], force: &[f64], width: f64, within: Range<f64>) -> Option<Range<usize>> {
    let force = medians(force);
    let (mut least, mut most): (VecDeque<usize>, VecDeque<usize>) = Default::default();
    let (mut start, mut best): (usize, Option<Range<usize>>) = (0, None);
    for end in 0..force.len() {
        if !within.contains(&force[end]) {
            least.clear();
            most.clear();
            start = end + 1;
            continue;
        }
        push(&mut least, end, |old| force[old] >= force[end]);
        push(&mut most, end, |old| force[old] <= force[end]);
        while force[most[0]] - force[least[0]] > width {
            start += 1;
            for ends in [&mut least, &mut most] {
                if ends[0] < start {
                    ends.pop_front();
                }
            }
        }
        let length = |run: &Range<usize>| time[run.end - 1] - time[run.start];
        let run = start..end + 1;
        if best.as_ref().is_none_or(|best| length(&run) > length(best)) {
            best = Some(run);
        }
    }
    best
}

/// Adds a place to a queue after removing the places that it makes useless.
fn push(queue: &mut VecDeque<usize>, place: usize, is_useless: impl Fn(usize) -> bool) {
    while queue.back().is_some_and(|old| is_useless(*old)) {
        queue.pop_back();
    }
    queue.push_back(place);
}
