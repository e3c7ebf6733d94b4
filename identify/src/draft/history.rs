//! What happens in a curve: loading, holds, unloading, a pop-in.

use crate::measured::channel::Channel;
use crate::measured::curve_segment::{Branch, CurveSegment};
use crate::measured::cycles::peaks;
use crate::measured::depth_step::DepthStep;
use crate::measured::hysteresis::{LEAST_RETURNED, part_returned};
use crate::measured::raw_curve::RawCurve;
use crate::measured::segment_rows::branch;

/// Holds are looked for in the means of so many blocks of rows.
const BLOCKS: usize = 240;
/// A force is held while it changes by less than this part of its mean change over a block.
const HELD: f64 = 0.03;
/// A hold has at least so many blocks,
const SHORTEST_HOLD: usize = 5;
/// and a force of at least this part of the range: below there is no contact.
const LEAST_FORCE: f64 = 0.02;
/// A pop-in is larger than this many times the median of the steps around it,
const TIMES_AROUND: f64 = 10.0;
/// so many on each side.
const AROUND: usize = 12;

/// A contact stiffness up to this many times the slope of the loading is that of an elastic contact; on fused silica,
/// the most elastic of hard bodies, a Berkovich tip finds 1.2.
const ELASTIC_RATIO: f64 = 1.1;

/// What happens in a curve.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct History {
    /// The largest force, N, and its row, from 1.
    pub(super) peak: (f64, usize),
    /// The rows of the table.
    pub(super) rows: usize,
    /// Number of cycles of loading and unloading.
    pub(super) cycles: usize,
    /// The holds, in their order.
    pub(super) holds: Vec<Hold>,
    /// The part of the work that the unloading gives back, if there is one.
    pub(super) returned: Option<f64>,
    /// A pop-in of the loading.
    pub(super) pop_in: Option<PopIn>,
    /// The measured contact stiffness over the slope of the loading: 1 of an elastic contact.
    stiffness_ratio: Option<f64>,
}

/// A stretch of nearly constant force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Hold {
    /// Its first and last row, from 1.
    pub(super) rows: [usize; 2],
    /// Its mean force, N.
    pub(super) force: f64,
    /// Its duration, s, where the time is known.
    pub(super) seconds: Option<f64>,
}

/// A sudden step of the depth in the loading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PopIn {
    /// The last row before it, from 1.
    pub(super) row: usize,
    /// Its height, m.
    pub(super) height: f64,
    /// The force at which it happens, N.
    pub(super) force: f64,
}

impl History {
    /// The history of the columns of a file.
    pub(super) fn of(raw: &RawCurve<'_>) -> Option<Self> {
        let forces = raw.values(Channel::Force)?;
        let valid = raw.valid_rows();
        let peak = *valid
            .iter()
            .max_by(|one, other| forces[**one].total_cmp(&forces[**other]))?;
        let whole = CurveSegment {
            part: Branch::Unloading,
            ..CurveSegment::default()
        };
        let unloading = branch(raw, &whole, &[]).ok()?.rows;
        // An unloading of a few rows is the noise of a hold.
        let returned = (unloading.len() > AROUND)
            .then(|| part_returned(raw, &unloading))
            .flatten();
        Some(Self {
            peak: (forces[peak], peak + 1),
            rows: raw.rows,
            cycles: peaks(&valid.iter().map(|row| forces[*row]).collect::<Vec<_>>()).len(),
            holds: holds(raw, forces, &valid),
            returned,
            pop_in: pop_in(raw, forces),
            stiffness_ratio: stiffness_ratio(raw, forces),
        })
    }

    /// Whether the contact is stiffer than its loading: a part of the depth is that of an imprint.
    pub(super) fn is_stiffer_than_loading(&self) -> bool {
        self.stiffness_ratio
            .is_some_and(|ratio| ratio > ELASTIC_RATIO)
    }

    /// Whether the unloading gives back so little work that the contact has left an imprint.
    pub(super) fn is_plastic(&self) -> bool {
        self.returned.is_some_and(|part| part < LEAST_RETURNED)
    }
}

fn holds(raw: &RawCurve<'_>, forces: &[f64], valid: &[usize]) -> Vec<Hold> {
    let size = valid.len().div_ceil(BLOCKS).max(1);
    let blocks: Vec<&[usize]> = valid.chunks(size).collect();
    let mean =
        |rows: &&[usize]| rows.iter().map(|row| forces[*row]).sum::<f64>() / rows.len() as f64;
    let means: Vec<f64> = blocks.iter().map(mean).collect();
    let lowest = means.iter().copied().fold(f64::INFINITY, f64::min);
    let largest = means.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let travel: f64 = means.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum();
    let limit = HELD * travel / means.len() as f64;
    let is_held = |block: usize| {
        let next = means.get(block + 1).copied().unwrap_or(means[block]);
        (next - means[block]).abs() < limit
            && means[block] - lowest > LEAST_FORCE * (largest - lowest)
    };
    let mut found: Vec<[usize; 2]> = Vec::new();
    for block in (0..means.len()).filter(|block| is_held(*block)) {
        match found.last_mut() {
            Some(last) if last[1] + 1 == block => last[1] = block,
            _ => found.push([block, block]),
        }
    }
    let times = raw.values(Channel::Time);
    let hold = |[first, last]: &[usize; 2]| {
        let (start, end) = (*blocks[*first].first()?, *blocks[*last].last()?);
        let inside = &means[*first..=*last];
        Some(Hold {
            rows: [start + 1, end + 1],
            force: inside.iter().sum::<f64>() / inside.len() as f64,
            seconds: times.map(|times| times[end] - times[start]),
        })
    };
    let long = found
        .iter()
        .filter(|[first, last]| last - first + 1 >= SHORTEST_HOLD);
    long.filter_map(hold).collect()
}

/// The mean contact stiffness over the slope of the force, both over the upper half of the forces of the loading.
fn stiffness_ratio(raw: &RawCurve<'_>, forces: &[f64]) -> Option<f64> {
    let (stiffness, depths) = (raw.values(Channel::Stiffness)?, raw.values(Channel::Depth)?);
    let rows = branch(raw, &CurveSegment::default(), &[]).ok()?.rows;
    let largest = rows.iter().map(|row| forces[*row]).fold(0.0, f64::max);
    let upper: Vec<usize> = rows
        .into_iter()
        .filter(|row| forces[*row] > 0.5 * largest)
        .collect();
    let mean =
        |values: &[f64]| upper.iter().map(|row| values[*row]).sum::<f64>() / upper.len() as f64;
    let (d0, f0) = (mean(depths), mean(forces));
    let (mut product, mut square) = (0.0, 0.0);
    for row in &upper {
        product += (depths[*row] - d0) * (forces[*row] - f0);
        square += (depths[*row] - d0).powi(2);
    }
    Some(mean(stiffness) * square / product).filter(|ratio| ratio.is_finite())
}

/// The largest depth step of the loading if it stands out from the steps of the whole and from those around it: at the
/// beginning of a loading all steps are large.
fn pop_in(raw: &RawCurve<'_>, forces: &[f64]) -> Option<PopIn> {
    let rows = branch(raw, &CurveSegment::default(), &[]).ok()?.rows;
    let depths = raw.values(Channel::Depth)?;
    let depths: Vec<f64> = rows.iter().map(|row| depths[*row]).collect();
    let step = DepthStep::find(&depths, &rows).filter(DepthStep::stands_out)?;
    let place = step.last_before;
    let [from, to] = [
        place.saturating_sub(AROUND),
        (place + AROUND).min(depths.len() - 1),
    ];
    let mut around: Vec<f64> = depths[from..=to]
        .windows(2)
        .map(|d| (d[1] - d[0]).abs())
        .collect();
    around.sort_by(f64::total_cmp);
    let median = *around.get(around.len() / 2)?;
    let is_inside = place >= AROUND && place + AROUND < depths.len();
    (is_inside && step.height > TIMES_AROUND * median).then(|| PopIn {
        row: rows[place] + 1,
        height: step.height,
        force: forces[rows[place]],
    })
}
