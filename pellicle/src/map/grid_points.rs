//! Lines of x, y, z: the points of a grid, as instruments and other programs export a surface.

use super::grid_lines::GridLines;
use super::map_file::MapFile;

/// The largest distance of a point from its grid lines along x or y, in spacings, with which it is taken onto them.
pub const OFF_THE_LINES: f64 = 0.1;

/// The largest part of the points of a grid that may be missing.
const MISSING: f64 = 0.02;

/// From this many lines on, three columns are points: no map is three samples wide.
pub const MANY_LINES: usize = 8;

/// Points that form no map.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "which holds {lines} points x, y, z that form no rectangular grid, since {reason}; {otherwise}"
)]
pub struct PointsError {
    /// Number of points.
    pub lines: usize,
    /// Why they form none.
    pub reason: NoGrid,
    /// How three columns of heights are written instead.
    pub otherwise: &'static str,
}

/// Whether lines of three numbers that form no grid are points all the same: there are many, and not every one is the
/// same height thrice, of a surface that does not change along its shorter side.
pub fn are_points(numbers: &[f64]) -> bool {
    let points = numbers.as_chunks::<3>().0;
    let is_height = |[x, y, z]: &[f64; 3]| (x - y).abs() <= 0.0 && (y - z).abs() <= 0.0;
    points.len() >= MANY_LINES && !points.iter().all(is_height)
}

/// Why points form no map, as a clause that follows "since".
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum NoGrid {
    /// Coordinates that are missing, infinite or all the same.
    #[error("{axis} is the same everywhere or not finite somewhere")]
    NoLines {
        /// `x` or `y`.
        axis: char,
    },
    /// Points between the lines of a grid.
    #[error(
        "{axis} is up to {distance:.3} spacings off its lines, and at most {OFF_THE_LINES} is taken onto them"
    )]
    OffTheLines {
        /// `x` or `y`.
        axis: char,
        /// The largest distance, in spacings.
        distance: f64,
    },
    /// Two points at one place.
    #[error("two are at x = {x}, y = {y}")]
    Twice {
        /// Coordinate of the second along x.
        x: f64,
        /// Coordinate along y.
        y: f64,
    },
    /// Gaps that are too many.
    #[error("of {} by {} places more than a fiftieth is empty", shape[0], shape[1])]
    Gaps {
        /// Places along x and along y.
        shape: [usize; 2],
    },
}

/// Returns the map of the points, which form a regular rectangular grid, each point at most once and in any order. Its
/// sides are in the unit of the heights; those of the few points that are missing are NaN.
///
/// # Errors
///
/// [`NoGrid`], the reason why there is none.
pub fn map(numbers: &[f64]) -> Result<MapFile, NoGrid> {
    let points = numbers.as_chunks::<3>().0;
    let lines = |axis: usize| GridLines::through(points.iter().map(|point| point[axis]));
    let along_x = lines(0).ok_or(NoGrid::NoLines { axis: 'x' })?;
    let along_y = lines(1).ok_or(NoGrid::NoLines { axis: 'y' })?;
    let mut off_grid: f64 = 0.0;
    for (axis, name, lines) in [(0, 'x', &along_x), (1, 'y', &along_y)] {
        let distances = points.iter().map(|point| lines.nearest(point[axis]).1);
        let distance = distances.fold(0.0, f64::max);
        if distance > OFF_THE_LINES {
            return Err(NoGrid::OffTheLines {
                axis: name,
                distance,
            });
        }
        off_grid = off_grid.max(distance);
    }
    let shape = [along_x.count, along_y.count];
    let gaps = NoGrid::Gaps { shape };
    let all = shape[0].checked_mul(shape[1]).ok_or(gaps)?;
    if all as f64 - points.len() as f64 > MISSING * all as f64 {
        return Err(gaps);
    }
    let mut heights = vec![None; all];
    for &[x, y, height] in points {
        let place = along_x.nearest(x).0 * shape[1] + along_y.nearest(y).0;
        if heights[place].replace(height).is_some() {
            return Err(NoGrid::Twice { x, y });
        }
    }
    let heights = heights.into_iter().map(|height| height.unwrap_or(f64::NAN));
    Ok(MapFile {
        sides: Some([along_x.side(), along_y.side()]),
        has_one_unit: true,
        missing_points: all - points.len(),
        off_grid,
        ..MapFile::bare(shape, heights.collect())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 4 × 3 points at spacings of 0.1 and 0.25, written with four digits.
    fn points() -> Vec<[f64; 3]> {
        let point = |n: u32| {
            let (i, j) = (f64::from(n / 3), f64::from(n % 3));
            [2.0 + 0.1 * i + 0.0004, 0.25 * j - 1.0, 10.0 * i + j]
        };
        (0..12).map(point).collect()
    }

    #[test]
    fn points_of_a_grid_form_a_map_in_any_order() {
        let mut points = points();
        let expected = map(points.as_flattened()).unwrap();
        assert_eq!(expected.shape, [4, 3]);
        assert_eq!(expected.heights[..4], [0.0, 1.0, 2.0, 10.0]);
        let [x, y] = expected.sides.unwrap();
        assert!((x - 0.4).abs() < 1e-12 && (y - 0.75).abs() < 1e-12);
        points.reverse();
        points.swap(3, 7);
        let again = map(points.as_flattened()).unwrap();
        assert_eq!(again.heights, expected.heights);
    }

    /// 20 × 15 points of which each is up to so many spacings off its lines, in an order that is not sorted.
    fn scattered(off: f64) -> Vec<[f64; 3]> {
        let point = |n: u32| {
            let n = n * 7 % 300;
            let [i, j] = [n / 15, n % 15].map(f64::from);
            let [to_x, to_y] = [n * 37 % 101, n * 53 % 97].map(|k| f64::from(k) / 50.0 - 1.0);
            [
                0.094 * (i + off * to_x),
                0.2 * (j + off * to_y),
                100.0 * i + j,
            ]
        };
        (0..300).map(point).collect()
    }

    #[test]
    fn points_a_tenth_off_are_taken_onto_the_grid_and_farther_ones_are_not() {
        let exact = map(scattered(0.0).as_flattened()).unwrap();
        let wanted: Vec<_> = (0..300)
            .map(|n| f64::from(100 * (n / 15) + n % 15))
            .collect();
        assert_eq!((exact.shape, &exact.heights), ([20, 15], &wanted));
        let found = map(scattered(0.08).as_flattened()).unwrap();
        assert_eq!((found.shape, &found.heights), ([20, 15], &wanted));
        // Of the scatter, whose ends are −1 and 1, a part is taken up by the lines.
        assert!((0.06..0.1).contains(&found.off_grid), "{}", found.off_grid);
        for off in [0.15, 0.3, 0.5] {
            let refused = map(scattered(off).as_flattened()).unwrap_err();
            assert!(matches!(refused, NoGrid::OffTheLines { .. }), "{refused}");
        }
    }

    #[test]
    fn a_whole_line_may_be_missing_if_it_is_no_more_than_a_fiftieth() {
        let point = |n: u32| [f64::from(n / 20), f64::from(n % 20), f64::from(n)];
        let without = |line: u32| (0..1200).filter(move |n| n / 20 != line).map(point);
        let found = map(without(17).collect::<Vec<_>>().as_flattened()).unwrap();
        assert_eq!((found.shape, found.missing_points), ([60, 20], 20));
        let fewer = without(17).filter(|[x, ..]| *x < 45.0);
        let refused = map(fewer.collect::<Vec<_>>().as_flattened());
        assert_eq!(refused, Err(NoGrid::Gaps { shape: [45, 20] }));
    }

    #[test]
    fn points_not_on_a_grid_form_no_map() {
        let change = |n: usize, axis: usize, to: f64| {
            let mut points = points();
            points[n][axis] = to;
            map(points.as_flattened())
        };
        for (axis, to) in [(0, 2.25), (1, -0.75), (0, f64::NAN), (1, 1e300)] {
            assert!(change(6, axis, to).is_err(), "{axis}, {to}");
        }
        assert!(map(&points().as_flattened()[..33]).is_err());
        assert!(map(&[1.0; 30]).is_err());
        assert!(map(&[]).is_err());
    }

    #[test]
    fn a_profile_three_samples_wide_is_no_list_of_points() {
        let profile: Vec<_> = (0..30).map(|n| f64::from(n / 3).sin()).collect();
        assert!(map(&profile).is_err() && !are_points(&profile));
        assert!(are_points(scattered(0.5).as_flattened()) && !are_points(&profile[1..22]));
    }
}
