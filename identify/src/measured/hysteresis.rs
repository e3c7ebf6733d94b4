//! The work that an unloading gives back. The models are contacts with an undeformed surface. An elastic body unloads
//! along its loading curve; after plastic flow the unloading is contact with an imprint, which none of them describes.

use super::channel::Channel;
use super::curve::CurveWarning;
use super::curve_segment::{Branch, CurveSegment};
use super::error::CurveError;
use super::raw_curve::RawCurve;
use super::segment_rows::branch;

/// An unloading that gives back less than this part of the work of the loading, over the same depths, is not elastic.
/// Unloadings of the files in the tests give back 79 % (hard body), 59 % (cell), 38 % (steel) and 12 % (tungsten after
/// its pop-in), elastic ones all of it, but for noise and a drift of the baseline.
pub(crate) const LEAST_RETURNED: f64 = 0.9;

/// Rejects an unloading, given by its rows, after a loading in the same table that was not elastic. If the table has no
/// loading, a warning says what is not known.
pub(super) fn check_unloading(
    raw: &RawCurve<'_>,
    segment: &CurveSegment,
    unloading: &[usize],
) -> Result<Option<CurveWarning>, CurveError> {
    if segment.part != Branch::Unloading || !has_both(raw) {
        return Ok(None);
    }
    match part_returned(raw, unloading) {
        Some(part) if part < LEAST_RETURNED => Err(CurveError::Hysteresis { part }),
        Some(_) => Ok(None),
        None => Ok(Some(CurveWarning::new(
            "unloading-alone",
            "the table has no loading to compare the unloading with: after plastic flow or creep it would be contact \
             with an imprint, not with the undeformed surface of the model",
        ))),
    }
}

fn has_both(raw: &RawCurve<'_>) -> bool {
    raw.values(Channel::Depth).is_some() && raw.values(Channel::Force).is_some()
}

/// The part of the work of the loading that the unloading, given by its rows, gives back; none where both have no
/// depths in common.
pub(crate) fn part_returned(raw: &RawCurve<'_>, unloading: &[usize]) -> Option<f64> {
    let (depths, forces) = (raw.values(Channel::Depth)?, raw.values(Channel::Force)?);
    let points = |rows: &[usize]| {
        let point = |row: &usize| (depths[*row], forces[*row]);
        Branchwise::new(rows.iter().map(point).collect())
    };
    let whole = CurveSegment {
        part: Branch::Whole,
        ..CurveSegment::default()
    };
    // A hold at the largest force does work, too.
    let rows = branch(raw, &whole, &[]).ok()?.rows;
    let largest = rows
        .iter()
        .map(|row| forces[*row])
        .fold(f64::NEG_INFINITY, f64::max);
    let end = rows.iter().position(|row| forces[*row] >= largest)?;
    points(&rows[..=end]).part_returned_by(&points(unloading))
}

/// The points (m, N) of one branch of a curve, in the order of their depths.
struct Branchwise(Vec<(f64, f64)>);

impl Branchwise {
    fn new(mut points: Vec<(f64, f64)>) -> Self {
        points.sort_by(|one, other| one.0.total_cmp(&other.0));
        Self(points)
    }

    /// The work of the unloading over that of this loading, `∫ (F_u − F_0) dD / ∫ (F_l − F_0) dD` over the depths that
    /// both have, where `F_0` is the mean force over the first tenth of the depths of the loading, before contact or
    /// hardly after it. Forces below it count as `F_0`: adhesion is no sign of an imprint. None where both have no
    /// depths in common.
    fn part_returned_by(&self, unloading: &Self) -> Option<f64> {
        let [first, last] = self.ends()?;
        let [lowest, deepest] = unloading.ends()?;
        let (from, to) = (first.max(lowest), last.min(deepest));
        let is_early = |(depth, _): &&(f64, f64)| *depth <= first + 0.1 * (last - first);
        let early = self.0.iter().filter(is_early).map(|(_, force)| *force);
        let base = early.clone().sum::<f64>() / early.count() as f64;
        let work = self.work([from, to], base);
        (to > from && work > 0.0).then(|| unloading.work([from, to], base) / work)
    }

    /// The least and the largest depth.
    fn ends(&self) -> Option<[f64; 2]> {
        Some([self.0.first()?.0, self.0.last()?.0])
    }

    /// `∫ max(F − F_0, 0) dD` between two depths, by trapezes.
    fn work(&self, [from, to]: [f64; 2], base: f64) -> f64 {
        let strip = |pair: &[(f64, f64)]| {
            let [(d0, f0), (d1, f1)] = [pair[0], pair[1]];
            let (start, end) = (d0.max(from), d1.min(to));
            if end <= start {
                return 0.0;
            }
            let at = |depth: f64| (f0 + (f1 - f0) * (depth - d0) / (d1 - d0) - base).max(0.0);
            0.5 * (at(start) + at(end)) * (end - start)
        };
        self.0.windows(2).map(strip).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points of a force over depths from `from` to 1.
    fn branch(from: f64, force: impl Fn(f64) -> f64) -> Branchwise {
        let depth = |i: i32| from + (1.0 - from) * f64::from(i) / 100.0;
        Branchwise::new((0..=100).map(|i| (depth(i), force(depth(i)))).collect())
    }

    #[test]
    fn an_elastic_unloading_gives_back_all_work_and_one_of_an_imprint_a_part() {
        let loading = branch(-0.5, |depth| depth.max(0.0).powf(1.5));
        let returned = |unloading: &Branchwise| loading.part_returned_by(unloading).unwrap();
        // The same curve at other depths, by trapezes of a hundredth.
        let elastic = branch(-0.3, |depth| depth.max(0.0).powf(1.5));
        assert!((returned(&elastic) - 1.0).abs() < 1e-3);
        // Adhesion before contact changes nothing.
        let adhesive = branch(
            -0.3,
            |depth| if depth < 0.0 { -0.2 } else { depth.powf(1.5) },
        );
        assert!((returned(&adhesive) - 1.0).abs() < 1e-3);
        // ∫ ((D − ½)/½)^1.5 dD over ∫ D^1.5 dD from ½ to 1: ½ over 1 − ½^2.5
        let imprint = branch(0.5, |depth| (2.0 * (depth - 0.5)).powf(1.5));
        let exact = 0.5 / (1.0 - 0.5_f64.powf(2.5));
        assert!((returned(&imprint) / exact - 1.0).abs() < 1e-3);
        assert!(loading.part_returned_by(&Branchwise::new(vec![])).is_none());
    }
}
