//! The relief as it is after some wear, known at the element centres of one grid.

use std::sync::Arc;

use pellicle_texture::{Grid, Relief, ReliefShape};

/// A relief lowered by the depth of wear, its springs shorter by the same.
///
/// Between the centres of the grid, as coarser grids need, depths are interpolated between elements that can wear; at
/// the centres they are exact. Beyond the grid nothing is worn, as nothing is pressed.
#[derive(Debug, Clone)]
pub struct WornRelief {
    pub base: Relief,
    pub grid: Grid,
    /// Whether an element can wear: those between the tops of a relief cannot.
    pub wears: Arc<Vec<bool>>,
    /// Depth of wear, m.
    pub depth: Arc<Vec<f64>>,
    /// Whether the relief and its wear are symmetric in x and y.
    pub is_mirrored: bool,
}

impl WornRelief {
    /// The value at a point of a field on the grid, by bilinear interpolation between elements that can wear; between
    /// the outer centres and the edge that of the nearest, and beyond the edge 0.
    fn value(&self, field: &[f64], point: [f64; 2]) -> f64 {
        let lengths = self.grid.lengths();
        let beyond = |axis: usize| point[axis].abs() > self.grid.sides()[axis] / 2.0;
        if beyond(0) || beyond(1) {
            return 0.0;
        }
        let [(i, u), (j, v)] = [0, 1].map(|axis: usize| {
            let last = lengths[axis] - 1;
            let place = (point[axis] - self.grid.centre_along(axis, 0)) / self.grid.element_side();
            let place = place.clamp(0.0, last as f64);
            // A centre itself is met to rounding.
            let nearest = place.round();
            if (place - nearest).abs() < ON_CENTRE {
                return (crate::stress::nearest(nearest).unsigned_abs(), 0.0);
            }
            let first = crate::stress::nearest(place.floor())
                .unsigned_abs()
                .min(last);
            (first, place - place.floor())
        });
        if u == 0.0 && v == 0.0 {
            return field[i * lengths[1] + j];
        }
        let (mut sum, mut total) = (0.0, 0.0);
        for (row, of_row) in [(i, 1.0 - u), (i + 1, u)] {
            for (column, of_column) in [(j, 1.0 - v), (j + 1, v)] {
                let element = row.min(lengths[0] - 1) * lengths[1] + column.min(lengths[1] - 1);
                if self.wears[element] {
                    sum += of_row * of_column * field[element];
                    total += of_row * of_column;
                }
            }
        }
        if total > 0.0 { sum / total } else { 0.0 }
    }

    /// The values at some points of a relief with these compliances there; 0 between its tops.
    fn values(&self, field: &[f64], compliances: &[f64], points: &[[f64; 2]]) -> Vec<f64> {
        let has_springs = self.base.spring_modulus().is_some();
        let points = points.iter().zip(compliances);
        points
            .map(|(point, compliance)| {
                if has_springs && *compliance == 0.0 {
                    0.0
                } else {
                    self.value(field, *point)
                }
            })
            .collect()
    }
}

/// A point within this part of an element of a centre is the centre.
const ON_CENTRE: f64 = 1e-6;

impl ReliefShape for WornRelief {
    fn profile(&self, points: &[[f64; 2]]) -> Vec<f64> {
        let depths = self.values(&self.depth, &self.base.compliance_at(points), points);
        let base = self.base.profile_at(points).into_iter().zip(depths);
        base.map(|(profile, depth)| profile - depth).collect()
    }

    fn compliance(&self, points: &[[f64; 2]]) -> Vec<f64> {
        let per_length = self.base.spring_modulus().map_or(0.0, f64::recip);
        let base = self.base.compliance_at(points);
        let depths = self.values(&self.depth, &base, points);
        // η = (h − d)/E
        let springs = base.iter().zip(depths);
        springs
            .map(|(compliance, depth)| (compliance - per_length * depth).max(0.0))
            .collect()
    }

    fn is_mirrored(&self) -> bool {
        self.is_mirrored
    }

    fn unworn(&self) -> Option<&Relief> {
        Some(&self.base)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pellicle_texture::Film;

    #[test]
    fn depths_lower_the_profile_and_shorten_the_springs() {
        let grid = Grid::new(2.0, 2).unwrap();
        let worn = WornRelief {
            base: Relief::Film(Film::new(1.0, 4.0).unwrap()),
            grid,
            wears: Arc::new(vec![true; 4]),
            depth: Arc::new(vec![0.0, 0.2, 0.4, 2.0]),
            is_mirrored: false,
        };
        let centres = grid.sample(false, |point| point);
        assert_eq!(worn.profile(&centres), [0.0, -0.2, -0.4, -2.0]);
        let compliance = worn.compliance(&centres);
        let wanted = [0.25, 0.2, 0.15, 0.0];
        for (found, wanted) in compliance.iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-15, "{compliance:?}");
        }
        // Between the centres, between the outer ones and the edge, and beyond it.
        let between = worn.profile(&[[0.0, 0.0], [0.9, 0.9], [-0.5, 0.25], [1.1, 0.9]]);
        let wanted = [-0.65, -2.0, -0.15, 0.0];
        for (found, wanted) in between.iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-15, "{between:?}");
        }
    }
}
