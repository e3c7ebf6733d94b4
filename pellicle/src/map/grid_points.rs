//! Lines of x, y, z: the points of a grid, as instruments and other programs export a surface.

use super::map_file::MapFile;

/// The largest distance of a coordinate from its grid line, in grid spacings; printed coordinates have few digits.
const OFF_THE_LINE: f64 = 0.05;

/// The largest part of the points of a grid that may be missing.
const MISSING: f64 = 0.02;

/// Returns the map of the points if they form a regular rectangular grid, each point at most once and in any order. Its
/// sides are in the unit of the heights; those of the few points that are missing are NaN.
pub fn map(numbers: &[f64]) -> Option<MapFile> {
    let points = numbers.as_chunks::<3>().0;
    let [along_x, along_y] = [lines(points, 0)?, lines(points, 1)?];
    let shape = [along_x.count, along_y.count];
    let all = shape[0].checked_mul(shape[1])?;
    let missing_points = all.checked_sub(points.len())?;
    if missing_points as f64 > MISSING * all as f64 {
        return None;
    }
    let mut heights = vec![None; all];
    for point in points {
        let place = along_x.number(point[0])? * shape[1] + along_y.number(point[1])?;
        if heights.get_mut(place)?.replace(point[2]).is_some() {
            return None;
        }
    }
    let heights = heights.into_iter().map(|height| height.unwrap_or(f64::NAN));
    Some(MapFile {
        sides: Some([along_x.side(), along_y.side()]),
        has_one_unit: true,
        missing_points,
        ..MapFile::bare(shape, heights.collect())
    })
}

/// From this many lines on, three columns of which two look like coordinates are points.
const MANY_LINES: usize = 30;

/// Whether lines of three numbers are points x, y, z rather than a strip of a surface: there are many, and the first
/// two numbers repeat on other lines or only rise or fall.
pub fn are_points(numbers: &[f64]) -> bool {
    let points = numbers.as_chunks::<3>().0;
    let is_coordinate = |axis: usize| {
        let along: Vec<_> = points.iter().map(|point| point[axis]).collect();
        let mut distinct = along.clone();
        distinct.sort_by(f64::total_cmp);
        distinct.dedup_by(|one, other| one.total_cmp(other).is_eq());
        2 * distinct.len() <= along.len()
            || along.is_sorted_by(|one, other| one < other)
            || along.is_sorted_by(|one, other| one > other)
    };
    points.len() >= MANY_LINES && is_coordinate(0) && is_coordinate(1)
}

/// Equidistant coordinates.
struct GridLines {
    first: f64,
    distance: f64,
    count: usize,
}

impl GridLines {
    fn number(&self, coordinate: f64) -> Option<usize> {
        let number = (coordinate - self.first) / self.distance;
        let is_on = (number - number.round()).abs() < OFF_THE_LINE;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "at most the number of points, and not below 0"
        )]
        (is_on && number.is_finite()).then_some(number.round() as usize)
    }

    /// The side of the pixels around the points.
    fn side(&self) -> f64 {
        self.distance * self.count as f64
    }
}

/// Returns the distinct coordinates of the points along one axis, at least two.
fn lines(points: &[[f64; 3]], axis: usize) -> Option<GridLines> {
    let mut sorted: Vec<_> = points.iter().map(|point| point[axis]).collect();
    sorted.sort_by(f64::total_cmp);
    let steps = || sorted.windows(2).map(|pair| pair[1] - pair[0]);
    let widest = steps().fold(0.0, f64::max);
    let count = 1 + steps().filter(|step| *step > 0.5 * widest).count();
    let [first, last] = [*sorted.first()?, *sorted.last()?];
    let distance = (last - first) / (count - 1).max(1) as f64;
    (count > 1 && distance.is_finite()).then_some(GridLines {
        first,
        distance,
        count,
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

    #[test]
    fn points_not_on_a_grid_form_no_map() {
        let change = |n: usize, axis: usize, to: f64| {
            let mut points = points();
            points[n][axis] = to;
            map(points.as_flattened())
        };
        for (axis, to) in [(0, 2.25), (1, -0.75), (0, f64::NAN), (1, 1e300)] {
            assert_eq!(change(6, axis, to), None, "{axis}, {to}");
        }
        assert_eq!(map(&points().as_flattened()[..33]), None);
        assert_eq!(map(&[1.0; 30]), None);
        assert_eq!(map(&[]), None);
    }
}
