//! The nominal area of a contact, and the gaps on it.

use std::ops::Range;

use super::histogram::Histogram;
use super::islands::ContactPattern;
use crate::result::contact_field::ContactField;

/// The elements in nominal contact.
pub(super) struct Nominal {
    /// Columns of each row of the region.
    spans: Vec<Range<usize>>,
    /// Area in elements, which need not be a whole number.
    pub elements: f64,
}

/// The gaps on the nominal area.
pub(super) struct Gaps {
    /// Mean over all elements, 0 for those in contact.
    pub mean: f64,
    /// Gaps of the elements that are not in contact.
    pub histogram: Histogram,
}

impl Nominal {
    /// The whole cell, or the convex hull of the contact; none without contact.
    pub fn of(field: &ContactField<'_>, pattern: &ContactPattern) -> Option<Self> {
        let [count, size] = field.region.lengths();
        let (first, _) = pattern.extents().next()?;
        if field.region.repeats() {
            return Some(Self {
                spans: vec![0..size; count],
                elements: (count * size) as f64,
            });
        }
        // The corners of the outermost elements, by the line between rows on which they lie.
        let corners = |end: fn(&Range<usize>) -> f64| {
            let rows = pattern.extents();
            rows.flat_map(move |(i, extent)| [i, i + 1].map(|x| [x as f64, end(&extent)]))
        };
        let left = convex(corners(|extent| extent.start as f64));
        let right = convex(corners(|extent| -(extent.end as f64)));
        let rows = first..pattern.extents().last()?.0 + 1;
        let span = |i: usize| {
            let middle = i as f64 + 0.5;
            // An element belongs where its centre lies.
            columns(at(&left, middle), -at(&right, middle))
        };
        Some(Self {
            spans: (0..count)
                .map(|i| if rows.contains(&i) { span(i) } else { 0..0 })
                .collect(),
            elements: -under(&left) - under(&right),
        })
    }

    pub fn gaps(&self, field: &ContactField<'_>) -> Gaps {
        let (histogram, sum) = Histogram::of(field.region, field.pressure, |line, pressures| {
            let columns = self.spans[line].clone();
            let open = columns.filter(move |j| pressures[*j] <= 0.0);
            let gaps = field.gaps_of_line(line);
            let gaps = open.map(move |j| gaps(j).max(0.0));
            gaps.filter(|gap| gap.is_finite())
        });
        let elements: usize = self.spans.iter().map(Range::len).sum();
        Gaps {
            mean: sum / elements.max(1) as f64,
            histogram,
        }
    }
}

/// The columns whose centres lie between two places.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "from 0 to the size of the grid"
)]
fn columns(left: f64, right: f64) -> Range<usize> {
    (left - 0.5).ceil() as usize..(right + 0.5).floor() as usize
}

/// Returns the convex chain below some points, which are ordered by their first coordinate.
fn convex(points: impl Iterator<Item = [f64; 2]>) -> Vec<[f64; 2]> {
    let mut chain: Vec<[f64; 2]> = Vec::new();
    for point in points {
        // Of two points on one line, keeps the lower.
        match chain.last() {
            Some(last) if last[0] >= point[0] && last[1] <= point[1] => continue,
            Some(last) if last[0] >= point[0] => _ = chain.pop(),
            _ => {}
        }
        while let [.., a, b] = chain[..] {
            let turn = (b[0] - a[0]) * (point[1] - a[1]) - (b[1] - a[1]) * (point[0] - a[0]);
            if turn > 0.0 {
                break;
            }
            chain.pop();
        }
        chain.push(point);
    }
    chain
}

/// The height of a chain at a place between its ends.
fn at(chain: &[[f64; 2]], x: f64) -> f64 {
    let next = chain.partition_point(|point| point[0] < x).max(1);
    let [a, b] = [chain[next - 1], chain[next]];
    a[1] + (x - a[0]) / (b[0] - a[0]) * (b[1] - a[1])
}

/// The area between the axis and a chain.
fn under(chain: &[[f64; 2]]) -> f64 {
    let parts = chain.windows(2);
    parts
        .map(|ends| 0.5 * (ends[0][1] + ends[1][1]) * (ends[1][0] - ends[0][0]))
        .sum()
}

#[cfg(test)]
mod tests {
    use super::{at, columns, convex, under};

    #[test]
    fn the_lower_hull_of_points_is_convex_at_each_vertex() {
        let points = [
            [0.0, 2.0],
            [0.0, 1.0],
            [1.0, 0.0],
            [2.0, 0.0],
            [2.0, 3.0],
            [3.0, 0.0],
            [4.0, 2.0],
            [5.0, 2.0],
            [5.0, 5.0],
        ];
        let chain = convex(points.into_iter());
        // Points on a straight line between others are left out.
        assert_eq!(chain, [[0.0, 1.0], [1.0, 0.0], [3.0, 0.0], [5.0, 2.0]]);
        let heights = [0.0, 0.25, 1.0, 2.5, 4.5, 5.0].map(|x| at(&chain, x));
        assert_eq!(heights, [1.0, 0.75, 0.0, 0.0, 1.5, 2.0]);
        // Half of 1, zero, and half of 2 × 2
        assert!((under(&chain) - 2.5).abs() < 1e-15);
        assert!(points.iter().all(|[x, y]| at(&chain, *x) <= *y));
    }

    #[test]
    fn columns_between_two_points_are_those_whose_centres_lie_between_them() {
        // The centre of a column lies half an element beyond its index.
        for (left, right, wanted) in [
            (0.0, 3.0, 0..3),
            (0.4, 3.4, 0..3),
            (0.5, 2.5, 0..3),
            (0.6, 2.4, 1..2),
        ] {
            assert_eq!(columns(left, right), wanted, "{left} {right}");
        }
    }
}
