//! The position of a fine region's elements among those of a coarser grid over the same square.

use crate::grid::region::Region;

/// The lines of a fine region among those of a coarse one, along both axes.
pub struct Prolongation {
    lines: [Vec<FineLine>; 2],
}

/// A line of fine centres among lines of coarse ones, all by their index in the coarse region.
#[derive(Debug, Clone, Copy)]
pub struct FineLine {
    /// The coarse line that contains it; may lie outside the region.
    pub within: isize,
    /// The two lines around it, none outside the region, and their linear weights.
    pub around: [(Option<usize>, f64); 2],
    /// The four lines around it, and the weights of the cubic through their values. Across an axis of a sector they are
    /// mirror images; elsewhere the outermost line is repeated.
    pub among: [(usize, f64); 4],
}

impl Prolongation {
    /// From the elements of a region of a coarse grid to those of a region of a finer one.
    #[must_use]
    pub fn new(from: &Region, onto: &Region) -> Self {
        Self {
            lines: [0, 1].map(|axis: usize| {
                let first = onto.origin()[axis];
                let fine = first..first + onto.lengths()[axis];
                fine.map(|i| FineLine::of(i, onto.grid().lengths()[axis], from, axis))
                    .collect()
            }),
        }
    }

    /// The fine lines along x.
    #[must_use]
    pub fn rows(&self) -> &[FineLine] {
        &self.lines[0]
    }

    /// The fine lines along y.
    #[must_use]
    pub fn columns(&self) -> &[FineLine] {
        &self.lines[1]
    }
}

impl FineLine {
    /// The `i`-th of `fine` lines of a grid.
    fn of(i: usize, fine: usize, from: &Region, axis: usize) -> Self {
        let first = from.origin()[axis].cast_signed();
        let coarse = from.grid().lengths()[axis];
        let last = from.lengths()[axis].cast_signed() - 1;
        let lines = from.grid().lengths()[axis].cast_signed();
        let within = ((2 * i + 1) * coarse / (2 * fine)).cast_signed() - first;
        // Centres lie at half-integers.
        let position = (i as f64 + 0.5) * coarse as f64 / fine as f64 - 0.5;
        #[expect(clippy::cast_possible_truncation, reason = "an index of a grid, or −1")]
        let low = position.floor() as isize;
        let t = position - position.floor();
        let line = |index: isize| {
            let image = from.grid().on_this_side(axis, index);
            image.clamp(0, lines - 1) - first
        };
        let inside = |line: isize| usize::try_from(line).ok().filter(|_| line <= last);
        let nearest = |line: isize| line.clamp(0, last).cast_unsigned();
        Self {
            within,
            around: [(inside(line(low)), 1.0 - t), (inside(line(low + 1)), t)],
            among: [
                (nearest(line(low - 1)), -t * (1.0 - t) * (2.0 - t) / 6.0),
                (nearest(line(low)), (1.0 + t) * (1.0 - t) * (2.0 - t) / 2.0),
                (nearest(line(low + 1)), (1.0 + t) * t * (2.0 - t) / 2.0),
                (nearest(line(low + 2)), -(1.0 + t) * t * (1.0 - t) / 6.0),
            ],
        }
    }
}

#[cfg(test)]
mod tests {
    use pellicle_influence::{Sector, SectorGrid};

    use super::*;

    /// The interpolated value of a function of the coarse line's position, in coarse elements.
    fn linear(line: &FineLine, field: impl Fn(f64) -> f64) -> f64 {
        let terms = line.around.iter();
        terms
            .map(|(at, weight)| weight * field(at.unwrap() as f64))
            .sum()
    }

    fn cubic(line: &FineLine, field: impl Fn(f64) -> f64) -> f64 {
        let terms = line.among.iter();
        terms.map(|(at, weight)| weight * field(*at as f64)).sum()
    }

    #[test]
    fn linear_functions_are_prolonged_exactly_and_cubics_from_four_lines() {
        let (from, to) = (8, 15);
        let prolongation = Prolongation::new(&Region::whole(from), &Region::whole(to));
        for i in 3_u8..12 {
            let place = (f64::from(i) + 0.5) * 8.0 / 15.0 - 0.5;
            let line = &prolongation.rows()[usize::from(i)];
            let straight = |x: f64| 2.0 - 3.0 * x;
            approx::assert_relative_eq!(linear(line, straight), straight(place), epsilon = 1e-13);
            let curve = |x: f64| x * x * (x - 4.0) + 1.0;
            approx::assert_relative_eq!(cubic(line, curve), curve(place), epsilon = 1e-12);
        }
    }

    #[test]
    fn a_coarse_region_counts_lines_from_its_own_first_line() {
        let belongs = |[i, j]: [usize; 2]| (20..24).contains(&i) && (30..34).contains(&j);
        let from = Region::whole(64).around(belongs);
        let prolongation = Prolongation::new(&from, &Region::whole(128));
        let both = [prolongation.rows(), prolongation.columns()];
        for (lines, origin) in both.into_iter().zip(from.origin()) {
            assert!(origin > 0);
            for (i, line) in lines.iter().enumerate() {
                assert_eq!(line.within, (i / 2).cast_signed() - origin.cast_signed());
            }
        }
    }

    #[test]
    fn lines_beyond_a_region_are_left_out_or_replaced_by_its_outermost() {
        let belongs = |[i, j]: [usize; 2]| (20..24).contains(&i) && (30..34).contains(&j);
        let from = Region::whole(64).around(belongs);
        let last = from.size() - 1;
        let prolongation = Prolongation::new(&from, &Region::whole(128));
        for (i, line) in prolongation.rows().iter().enumerate() {
            // The centres of a coarse line's fine lines lie a quarter before and a quarter after its own.
            let place = (i as f64 - 0.5) / 2.0 - from.origin()[0] as f64;
            let low = place.floor();
            let held = |k: f64| k >= 0.0 && k <= last as f64;
            for ((found, weight), k) in line.around.into_iter().zip([low, low + 1.0]) {
                let inside = held(k).then_some(k);
                assert_eq!(found.map(|found| found as f64), inside, "{i}");
                assert!((weight - (1.0 - (place - k).abs())).abs() < 1e-13);
            }
            for ((found, _), k) in line.among.into_iter().zip([-1.0, 0.0, 1.0, 2.0]) {
                let nearest = (low + k).clamp(0.0, last as f64);
                assert!((found as f64 - nearest).abs() < 0.5, "{i}: {found}");
            }
        }
    }

    #[test]
    fn the_coarse_line_that_holds_a_fine_one_is_the_nearest() {
        let prolongation = Prolongation::new(&Region::whole(8), &Region::whole(16));
        let within: Vec<_> = prolongation
            .columns()
            .iter()
            .map(|line| line.within)
            .collect();
        let halves: Vec<isize> = (0..16).map(|i| i / 2).collect();
        assert_eq!(within, halves);
    }

    #[test]
    fn across_an_axis_of_a_sector_lies_the_mirror_image() {
        let even = |x: f64| (x + 0.5).powi(2);
        for sector in [Sector::Half, Sector::Quadrant] {
            let [from, to] = [8, 16].map(|size| Region::all_of(SectorGrid::new(sector, size)));
            let prolongation = Prolongation::new(&from, &to);
            let [rows, _] = to.lengths();
            assert_eq!(
                (prolongation.rows().len(), prolongation.columns().len()),
                (rows, 16)
            );
            let lines = [prolongation.rows()[0], prolongation.columns()[0]];
            let mirrored = lines.iter().zip(to.grid().mirrored());
            for (line, _) in mirrored.filter(|(_, mirrored)| *mirrored) {
                // The parabola about the axis at −½.
                approx::assert_relative_eq!(cubic(line, even), even(-0.25), epsilon = 1e-13);
            }
        }
    }
}
