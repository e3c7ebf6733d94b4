//! The largest values of quantities in depth ranges: planes first, then points, then the same peak on coarser grids.

use super::edge_extreme::{edge_extreme, is_near_edge};
use super::extreme::Extreme;
use super::field::StressField;
use super::model::Sliding;
use super::peak_search::{PeakSearch, StressPeak};
use super::quantity::StressQuantity;
use super::starting_points::{StartingPoint, Target, is_nearly, starting_points};
use crate::result::peak::place_near;
use crate::{ContactError, ErrorEstimate, LoadingPath, PeakPlace, Step};

/// Largest number of peaks followed for one quantity.
const PEAKS: usize = 4;
/// Peaks that agree to this relative difference are mirror images of one peak.
const ALIKE: f64 = 1e-9;
/// Peaks below this part of the largest under the element centres cannot be the largest between them.
const NEARLY_AT_CENTRES: f64 = 0.99;
/// An extreme within this many elements of the surface and near something sharp grows with the grid.
const ELEMENTS_FROM_SURFACE: f64 = 2.0;
/// A tension sampled on the surface within this many elements of the contact's edge is not that of the continuum, which
/// has a cusp there.
const BESIDE_EDGE: isize = 3;
/// The pressures of the two outermost elements are up to 15 % off, and so are stresses under sliding on the surface
/// there.
const OUTERMOST: isize = 2;
/// Part of an element within which a place counts as on an axis.
const ON_AXIS: f64 = 1e-3;
/// Factor by which the depth of an extreme may differ on a coarser grid.
const DEPTH_RATIO: f64 = 1.4;

/// The search for the extremes under one step of a path.
pub struct ExtremeFinder<'a> {
    path: &'a LoadingPath,
    step: &'a Step,
    field: StressField,
    /// Coarser grids, coarsest first.
    coarser: Vec<StressField>,
}

impl<'a> ExtremeFinder<'a> {
    pub fn new(path: &'a LoadingPath, step: &'a Step, sliding: Sliding) -> Self {
        let of =
            |grid, pressure: &[f64]| StressField::of(path.tables.clone(), grid, pressure, sliding);
        let coarser = step.coarser.iter();
        Self {
            path,
            step,
            field: of(path.grid, &step.solution.pressure),
            coarser: coarser
                .map(|coarse| of(coarse.grid, &coarse.pressure))
                .collect(),
        }
    }

    /// Finds the largest values of the quantities of each target.
    pub fn find(&self, targets: &[Target]) -> Result<Vec<Vec<Extreme<3>>>, ContactError> {
        if self.field.loaded().size == 0 {
            let unloaded = |target: &Target| {
                vec![
                    Extreme {
                        value: 0.0,
                        at: [0.0, 0.0, target.top],
                        resolved: true,
                        estimate: Some(0.0)
                    };
                    target.quantities.len()
                ]
            };
            return Ok(targets.iter().map(unloaded).collect());
        }
        let found = starting_points(&self.field, targets)?;
        let of_target = |(index, target): (usize, &Target)| {
            let of_quantity = |quantity: &StressQuantity| {
                let own = found
                    .iter()
                    .filter(|start| start.target == index && start.quantity == *quantity);
                self.extreme(target, *quantity, &own.copied().collect::<Vec<_>>())
            };
            target.quantities.iter().map(of_quantity).collect()
        };
        targets.iter().enumerate().map(of_target).collect()
    }

    /// Finds the extreme among starting points, which are sorted by falling value.
    fn extreme(
        &self,
        target: &Target,
        quantity: StressQuantity,
        starting_points: &[StartingPoint],
    ) -> Result<Extreme<3>, ContactError> {
        let element = self.field.grid().element_side();
        let loaded = self.field.loaded().size as f64 * element;
        let depths: Vec<f64> = target
            .depths(loaded, element)
            .iter()
            .map(|depth| depth.z)
            .collect();
        let range = [depths[0], depths[depths.len() - 1]];
        let mut search = PeakSearch::new(&self.field, quantity, range);
        let mut followed: Vec<(StressPeak, usize)> = Vec::new();
        for start in distinct(starting_points, &depths, element) {
            let peak = search.climb(start.at, depths[start.depth])?;
            let is_new = |(other, _): &(StressPeak, usize)| {
                (other.value - peak.value).abs() > ALIKE * peak.value.abs()
            };
            if followed.iter().all(is_new) {
                followed.push((peak, start.depth));
            }
        }
        let largest = followed
            .iter()
            .map(|(peak, _)| peak.value)
            .fold(f64::NEG_INFINITY, f64::max);
        let mut best: Option<StressPeak> = None;
        for (start, depth) in followed {
            if start.value < largest - (1.0 - NEARLY_AT_CENTRES) * largest.abs() {
                continue;
            }
            let [x, y, z] = start.at;
            let bracket = [
                depths[depth.saturating_sub(1)],
                z,
                depths[(depth + 1).min(depths.len() - 1)],
            ];
            let peak = search.peak([x, y], bracket)?;
            if best.is_none_or(|best| peak.value > best.value) {
                best = Some(peak);
            }
        }
        let Some(best) = best else {
            return Err(ContactError::StressNotFinite);
        };
        let mut values = Vec::new();
        for coarse in &self.coarser {
            values.push((
                coarse.grid().size(),
                coarse_value(coarse, quantity, range, best)?,
            ));
        }
        values.push((self.field.grid().size(), best.value));
        let judged = self.judged(best, &values);
        if target.top == 0.0 && quantity == StressQuantity::MaxPrincipal {
            return self.or_at_edge(judged);
        }
        let [x, y, z] = judged.at;
        let slides = self.field.slides();
        let is_outermost = slides && z < element && is_near_edge(&self.field, [x, y], OUTERMOST);
        Ok(Extreme {
            resolved: judged.resolved && !is_outermost,
            ..judged
        })
    }

    /// Replaces the largest tension of the topmost body by that at the contact's edge if this is larger, or if the
    /// value
    /// was sampled beside the edge.
    fn or_at_edge(&self, sampled: Extreme<3>) -> Result<Extreme<3>, ContactError> {
        let Self {
            path,
            step,
            field,
            coarser,
        } = self;
        let at_edge = edge_extreme(path, step, field, coarser.last())?;
        let [x, y, z] = sampled.at;
        let is_beside = z < field.grid().element_side() && is_near_edge(field, [x, y], BESIDE_EDGE);
        Ok(match at_edge {
            Some(edge) if edge.value >= sampled.value || (is_beside && edge.resolved) => edge,
            _ => Extreme {
                resolved: sampled.resolved && !is_beside,
                ..sampled
            },
        })
    }

    /// Returns the extreme with its error, from pairs of elements per side and value.
    fn judged(&self, peak: StressPeak, values: &[(usize, f64)]) -> Extreme<3> {
        let Self { path, step, .. } = self;
        let [x, y, z] = peak.at;
        let side = path.grid.element_side();
        let is_near = place_near(&path.relief, &path.indenter, side, [x, y]) != PeakPlace::Inside;
        let is_at_edge = z < ELEMENTS_FROM_SURFACE * side && is_near;
        let meets_outline = step
            .grid_error
            .levels
            .iter()
            .any(|level| level.meets_outline);
        let accuracy = step.solution.certificate.worst() + path.tables.error_estimate();
        let error = ErrorEstimate::of_values(values, meets_outline, is_at_edge, accuracy);
        // A peak nearer to the axis than rounding resolves lies on it.
        let snapped = |along: f64| {
            if along.abs() < ON_AXIS * side {
                0.0
            } else {
                along
            }
        };
        Extreme {
            value: peak.value,
            at: [snapped(x), snapped(y), z],
            resolved: error.is_some_and(|error| error.resolved) && step.grid_error.resolves_waves(),
            estimate: error.map(|error| error.estimate),
        }
    }
}

/// Returns the value of the same peak on a coarser grid.
fn coarse_value(
    field: &StressField,
    quantity: StressQuantity,
    [top, bottom]: [f64; 2],
    peak: StressPeak,
) -> Result<f64, ContactError> {
    let [x, y, z] = peak.at;
    let is_at_end = z <= top || z >= bottom;
    let bracket = if is_at_end {
        [z; 3]
    } else {
        [(z / DEPTH_RATIO).max(top), z, (z * DEPTH_RATIO).min(bottom)]
    };
    Ok(PeakSearch::new(field, quantity, [top, bottom])
        .peak([x, y], bracket)?
        .value)
}

/// Selects the starting points, sorted by falling value, that come near the largest and belong to no larger one's peak.
fn distinct(starting_points: &[StartingPoint], depths: &[f64], element: f64) -> Vec<StartingPoint> {
    let mut kept: Vec<StartingPoint> = Vec::new();
    for start in starting_points {
        if kept.len() == PEAKS || !is_nearly(start.value, starting_points[0].value) {
            break;
        }
        let belongs = |other: &StartingPoint| {
            let apart = (other.at[0] - start.at[0]).hypot(other.at[1] - start.at[1]);
            other.depth.abs_diff(start.depth) == 1
                && apart <= element.max(depths[start.depth] / 2.0)
        };
        if !kept.iter().any(belongs) {
            kept.push(*start);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use pellicle_influence::{Depth, RadialTables};
    use pellicle_kernel::{Foundation, Material};
    use pellicle_texture::Grid;

    use super::*;

    #[test]
    fn starting_points_of_one_peak_are_followed_once_and_none_far_below_the_largest() {
        let depths = [0.0, 0.1, 0.4, 1.0];
        let kept = |starting_points: &[(f64, [f64; 2], usize)]| {
            let starting_points: Vec<_> = starting_points
                .iter()
                .map(|(value, at, depth)| StartingPoint {
                    target: 0,
                    quantity: StressQuantity::VonMises,
                    value: *value,
                    at: *at,
                    depth: *depth,
                })
                .collect();
            let kept = distinct(&starting_points, &depths, 0.1);
            kept.iter().map(|kept| kept.value).collect::<Vec<_>>()
        };
        let first = (10.0, [0.0; 2], 1);
        // At the next depth within an element, and within half the depth; farther; at the same depth; two depths away.
        assert_eq!(kept(&[first, (9.9, [0.06, 0.06], 0)]), [10.0]);
        assert_eq!(kept(&[first, (9.9, [0.1, 0.15], 2)]), [10.0]);
        assert_eq!(kept(&[first, (9.9, [0.08, 0.08], 0)]), [10.0, 9.9]);
        assert_eq!(kept(&[first, (9.9, [0.15, 0.15], 2)]), [10.0, 9.9]);
        assert_eq!(kept(&[first, (9.9, [0.01, 0.0], 1)]), [10.0, 9.9]);
        assert_eq!(kept(&[first, (9.9, [0.01, 0.0], 3)]), [10.0, 9.9]);
        assert_eq!(kept(&[first, (9.7, [0.9, 0.0], 1)]), [10.0]);
        let apart = [0, 1, 2, 3, 4].map(|i| (10.0, [f64::from(i), 0.0], 1));
        assert_eq!(kept(&apart).len(), 4);
    }

    /// Hertz's pressure of radius and peak 1 on a square of side 3.
    fn hertz(size: usize) -> StressField {
        let body = Foundation::half_space(Material::new(1.0, 0.3).unwrap());
        let grid = Grid::new(3.0, size).unwrap();
        let pressure = (0..grid.len()).map(|e| {
            let [x, y] = [e / size, e % size].map(|i| grid.centre(i));
            (1.0 - x * x - y * y).max(0.0).sqrt()
        });
        let tables = Arc::new(RadialTables::build(&body).unwrap());
        StressField::of(
            tables,
            grid,
            &pressure.collect::<Vec<_>>(),
            Sliding::default(),
        )
    }

    #[test]
    fn a_peak_is_found_again_on_a_coarser_grid_at_its_depth_or_near_it() {
        let field = hertz(15);
        let value = |range, z| {
            let peak = StressPeak {
                value: 1.0,
                at: [0.1, 0.0, z],
            };
            coarse_value(&field, StressQuantity::Compression, range, peak).unwrap()
        };
        let there = |z| {
            let state = field.at([0.0; 2], Depth::below(z)).unwrap();
            -state.stress[2]
        };
        // The compression falls with depth. At an end of the range the value is that of the end; inside, a bracket of a
        // factor of 1.4 around the depth holds a larger one.
        for end in [0.8, 2.0] {
            assert!((value([0.8, 2.0], end) / there(end) - 1.0).abs() < 1e-9);
        }
        // The peak is interpolated up to an eighth of the bracket beyond the bracket.
        let top = 0.8 / DEPTH_RATIO;
        let beyond = top - 0.125 * (0.8 * DEPTH_RATIO - top);
        let found = value([0.3, 2.0], 0.8);
        assert!(
            found > 0.999 * there(top) && found < 1.001 * there(beyond),
            "{found}"
        );
        assert!((value([0.7, 2.0], 0.8) / there(0.7) - 1.0).abs() < 1e-9);
    }

    /// A half-space of Poisson's ratio 0.3 under an indenter at a depth, on a square of side 1 and grids of up to 32
    /// elements.
    fn solved(indenter: impl Into<crate::Indenter>, depth: f64) -> LoadingPath {
        let model =
            crate::Model::on_half_space([1.0, 0.3], pellicle_texture::Relief::Bare, indenter);
        let options = crate::SolverOptions {
            coarse_pressures: true,
            ..crate::SolverOptions::default()
        };
        let (domain, load) = (crate::Domain::Side(1.0), crate::Load::Penetration(depth));
        crate::solve_path(&model, domain, 32, &[load], &options, &mut ()).unwrap()
    }

    #[test]
    fn under_a_ball_the_largest_stresses_are_those_of_hertz_each_in_its_range() {
        let a: f64 = 0.3;
        let path = solved(crate::Paraboloid::new(1.0).unwrap(), a * a);
        // p0 = 2 E* a/(π R)
        let p0 = 2.0 * a / (std::f64::consts::PI * 0.91);
        let body = Target {
            top: 0.0,
            bottom: f64::INFINITY,
            quantities: vec![StressQuantity::VonMises, StressQuantity::MaxShear],
        };
        // −σ_zz = p0/(1 + z²/a²) on the axis, and no shear there.
        let depth = 0.5 * a;
        let interface = Target {
            top: depth,
            bottom: depth,
            quantities: vec![StressQuantity::Compression],
        };
        let deep = Target {
            top: a,
            bottom: 2.0 * a,
            quantities: vec![StressQuantity::Compression],
        };
        let finder = ExtremeFinder::new(&path, &path.steps[0], Sliding::default());
        let found = finder.find(&[body, interface, deep]).unwrap();
        // Johnson 1985: 0.62 p0 and 0.31 p0 at 0.48 a.
        for (extreme, wanted, z) in [
            (found[0][0], 0.62, 0.481 * a),
            (found[0][1], 0.31, 0.481 * a),
            (found[1][0], 0.8, depth),
            (found[2][0], 0.5, a),
        ] {
            // Ten elements per radius.
            assert!(
                (extreme.value / p0 / wanted - 1.0).abs() < 0.02,
                "{extreme:?}"
            );
            assert!((extreme.at[2] / z - 1.0).abs() < 0.05, "{extreme:?}");
            assert_eq!(extreme.at[..2], [0.0; 2]);
            let estimate = extreme.estimate.unwrap();
            assert!(estimate < 0.1 * extreme.value, "{extreme:?}");
        }
        assert_eq!([found[0].len(), found[1].len(), found[2].len()], [2, 1, 1]);
    }

    #[test]
    fn an_extreme_at_an_edge_is_not_resolved_and_one_close_to_the_axis_is_moved_to_it() {
        let path = solved(crate::FlatPunch::new(0.2).unwrap(), 0.01);
        let finder = ExtremeFinder::new(&path, &path.steps[0], Sliding::default());
        let side = path.grid.element_side();
        let values = [(8, 1.5), (16, 1.125), (32, 1.03125)];
        let judged = |at: [f64; 3]| finder.judged(StressPeak { value: 1.03125, at }, &values);
        for (at, is_resolved) in [
            ([0.2, 0.0, 1.9 * side], false),
            ([0.2, 0.0, 2.1 * side], true),
            ([0.0, -0.2, 0.0], false),
            ([0.05, 0.05, 0.0], true),
        ] {
            let found = judged(at);
            assert_eq!(found.resolved, is_resolved, "{at:?}");
            assert_eq!((found.value, found.at[2]), (1.03125, at[2]));
            let accuracy =
                path.steps[0].solution.certificate.worst() + path.tables.error_estimate();
            let wanted = ErrorEstimate::of_values(&values, true, !is_resolved, accuracy);
            assert_eq!(found.estimate, wanted.map(|wanted| wanted.estimate));
        }
        let snapped = judged([0.9e-3 * side, -1.1e-3 * side, 0.1]);
        assert_eq!(snapped.at, [0.0, -1.1e-3 * side, 0.1]);
        let snapped = judged([1.1e-3 * side, -0.9e-3 * side, 0.1]);
        assert_eq!(snapped.at, [1.1e-3 * side, 0.0, 0.1]);
    }
}
