//! The largest pressure averaged over a disc.
//!
//! An element counts by the part of it that the disc covers, so the average of a uniform pressure is exact, and that of
//! a smooth one is of second order in the element's side. The disc is centred on every element, and the averages are
//! interpolated around the largest one as the [peak](super::peak) is.
//!
//! The area of a disc of radius r within `[0, x] × [0, y]` is `∫ min(y, √(r² − t²)) dt` up to x.

use std::f64::consts::PI;

use rayon::prelude::*;

use crate::{grid::region::Place, result::contact_field::ContactField, result::peak};

/// A disc whose radius exceeds so many sides of the grid is not summed: the average is the force over its area, or in a
/// cell the nominal pressure.
const WIDEST: f64 = 2.0;

/// A row of a disc on the elements: the row's distance from the middle, and the covered parts from the middle outwards.
struct DiscRow {
    offset: isize,
    /// Elements on each side of the middle, itself included, that are covered whole; 0 for none.
    whole: usize,
    /// The parts of the next ones that are covered.
    parts: Vec<f64>,
}

/// Returns the largest pressure averaged over a disc of this diameter (m), Pa; none if an element is wider.
pub fn largest(field: &ContactField<'_>, diameter: f64) -> Option<f64> {
    let radius = 0.5 * diameter / field.grid.element_side();
    if radius < 0.5 {
        return None;
    }
    let longer = field.grid.lengths().into_iter().max().unwrap_or(0) as f64;
    if radius > WIDEST * longer {
        // It covers all of the pressure, or many cells.
        let whole = field.region.scatter(field.pressure.to_vec());
        let sum: f64 = whole.iter().sum();
        let within = if field.region.repeats() {
            field.grid.lengths().into_iter().product::<usize>() as f64
        } else {
            PI * radius * radius
        };
        return Some(sum / within);
    }
    let disc = disc(radius);
    let area: f64 = disc.iter().map(DiscRow::area).sum();
    let sums = RowSums::around(field, disc.len() / 2)?;
    let rows = sums.centres[0].clone().into_par_iter();
    let best_of_row = |row: isize| {
        let columns = sums.centres[1].clone();
        let at = columns.map(|column| (sums.over(&disc, [row, column]), [row, column]));
        at.reduce(larger)
    };
    // The order of rows is fixed, and so is the first of equal ones.
    let best: Vec<_> = rows.filter_map(best_of_row).collect();
    let (sum, [i, j]) = best.into_iter().reduce(larger)?;
    let around = |[u, v]: Place| sums.over(&disc, [i + u, j + v]);
    let rise = peak::vertex(&around).map_or(0.0, |(rise, _)| rise);
    Some((sum + rise) / area)
}

fn larger(one: (f64, Place), other: (f64, Place)) -> (f64, Place) {
    if other.0 > one.0 { other } else { one }
}

/// The rows of a disc of this radius (in elements) around the middle of an element.
fn disc(radius: f64) -> Vec<DiscRow> {
    #[expect(clippy::cast_possible_truncation, reason = "a number of elements")]
    let reach = (radius - 0.5).ceil() as isize;
    let row = |offset: isize| {
        let parts = (0..=reach).map(|along| covered(radius, [offset, along]));
        let parts: Vec<f64> = parts.collect();
        let is_whole = |part: &&f64| **part >= 1.0;
        let whole = parts.iter().take_while(is_whole).count();
        let parts = parts[whole..].iter().copied();
        DiscRow {
            offset,
            whole,
            parts: parts.take_while(|part| *part > 0.0).collect(),
        }
    };
    (-reach..=reach).map(row).collect()
}

/// The part of an element, so many rows and columns from the middle, that a disc covers.
fn covered(radius: f64, at: [isize; 2]) -> f64 {
    let [[x0, x1], [y0, y1]] = at.map(|at| [at as f64 - 0.5, at as f64 + 0.5]);
    if at
        .map(|at| at.abs() as f64 + 0.5)
        .iter()
        .map(|x| x * x)
        .sum::<f64>()
        <= radius * radius
    {
        return 1.0;
    }
    let to = |x: f64, y: f64| x.signum() * y.signum() * quadrant(radius, x.abs(), y.abs());
    (to(x1, y1) - to(x0, y1) - to(x1, y0) + to(x0, y0)).clamp(0.0, 1.0)
}

/// Area of a disc within `[0, x] × [0, y]`.
fn quadrant(radius: f64, x: f64, y: f64) -> f64 {
    let (x, y) = (x.min(radius), y.min(radius));
    // Where the circle falls to y.
    let falls = ((radius - y) * (radius + y)).sqrt();
    if x <= falls {
        return x * y;
    }
    // ∫ √(r² − t²) dt = ½ (t √(r² − t²) + r² asin(t/r))
    let under = |t: f64| {
        let height = ((radius - t) * (radius + t)).sqrt();
        0.5 * (t * height + radius * radius * (t / radius).asin())
    };
    falls * y + under(x) - under(falls)
}

impl DiscRow {
    fn area(&self) -> f64 {
        let whole = (2 * self.whole).saturating_sub(1) as f64;
        let twice = |(k, part): (usize, &f64)| {
            if self.whole + k == 0 {
                *part
            } else {
                2.0 * part
            }
        };
        whole + self.parts.iter().enumerate().map(twice).sum::<f64>()
    }
}

/// Sums along the rows of a pressure around the elements that press; in a cell around all, with their images.
struct RowSums {
    /// Rows and columns on which a disc may be centred.
    centres: [std::ops::Range<isize>; 2],
    /// First row and column of the sums.
    first: [isize; 2],
    /// Elements in a row.
    width: usize,
    pressure: Vec<f64>,
    /// Sums of the elements before each, one more than there are in a row.
    sums: Vec<f64>,
}

impl RowSums {
    /// None without contact.
    fn around(field: &ContactField<'_>, reach: usize) -> Option<Self> {
        let whole = field.region.scatter(field.pressure.to_vec());
        let lengths = field.grid.lengths().map(usize::cast_signed);
        let centres = if field.region.repeats() {
            whole
                .iter()
                .any(|p| *p > 0.0)
                .then_some([0..lengths[0], 0..lengths[1]])?
        } else {
            pressing(&whole, field.grid.row())?
        };
        // One more for the neighbours of the largest average.
        let margin = reach.cast_signed() + 1;
        let first = [0, 1].map(|axis: usize| centres[axis].start - margin);
        let [height, width] =
            [0, 1].map(|axis: usize| centres[axis].len() + 2 * margin.unsigned_abs());
        let rows = (0..height.cast_signed()).map(|row| first[0] + row);
        let columns = || (0..width.cast_signed()).map(|column| first[1] + column);
        let places = rows.flat_map(|row| columns().map(move |column| [row, column]));
        let repeats = field.region.repeats();
        let at = |place| image(place, lengths, repeats).map_or(0.0, |element| whole[element]);
        let pressure: Vec<f64> = places.map(at).collect();
        let sums = pressure.chunks_exact(width).flat_map(|row| {
            let before = row.iter().scan(0.0, |sum, p| {
                *sum += p;
                Some(*sum)
            });
            std::iter::once(0.0).chain(before)
        });
        Some(Self {
            centres,
            first,
            width,
            sums: sums.collect(),
            pressure,
        })
    }

    /// Sum of the pressures under a disc centred on an element, by the parts that it covers.
    fn over(&self, disc: &[DiscRow], [i, j]: Place) -> f64 {
        let middle = (j - self.first[1]).unsigned_abs();
        let of_row = |row: &DiscRow| {
            let line = (i + row.offset - self.first[0]).unsigned_abs();
            let sums = &self.sums[line * (self.width + 1)..][..=self.width];
            let whole = if row.whole == 0 {
                0.0
            } else {
                sums[middle + row.whole] - sums[middle + 1 - row.whole]
            };
            let pressure = &self.pressure[line * self.width..][..self.width];
            let parts = row.parts.iter().enumerate().map(|(k, part)| {
                let along = row.whole + k;
                let beside = if along == 0 {
                    0.0
                } else {
                    pressure[middle - along]
                };
                part * (pressure[middle + along] + beside)
            });
            whole + parts.sum::<f64>()
        };
        disc.iter().map(of_row).sum()
    }
}

/// The element at a place of a grid with these lengths, or its image if the grid repeats; none elsewhere.
fn image(place: Place, lengths: [isize; 2], repeats: bool) -> Option<usize> {
    let along = |axis: usize| {
        let (i, length) = (place[axis], lengths[axis]);
        let i = if repeats { i.rem_euclid(length) } else { i };
        (0..length).contains(&i).then_some(i.unsigned_abs())
    };
    Some(along(0)? * lengths[1].unsigned_abs() + along(1)?)
}

/// Rows and columns of the smallest rectangle with all elements that press; none without.
fn pressing(pressure: &[f64], row: usize) -> Option<[std::ops::Range<isize>; 2]> {
    let mut found: Option<[[usize; 2]; 2]> = None;
    for (line, values) in pressure.chunks_exact(row).enumerate() {
        let first = values.iter().position(|p| *p > 0.0);
        let last = values.iter().rposition(|p| *p > 0.0);
        let (Some(first), Some(last)) = (first, last) else {
            continue;
        };
        let [[top, _], [left, right]] = found.unwrap_or([[line, line], [first, last]]);
        found = Some([[top, line], [left.min(first), right.max(last)]]);
    }
    found.map(|found| found.map(|[first, last]| first.cast_signed()..last.cast_signed() + 1))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    #[test]
    fn the_parts_of_a_disc_sum_to_its_area() {
        for radius in [0.5, 0.6, 0.75, 1.0, 1.5, 2.3, 17.9] {
            let found: f64 = disc(radius).iter().map(DiscRow::area).sum();
            let wanted = PI * radius * radius;
            assert!(
                (found / wanted - 1.0).abs() < 1e-13,
                "{radius}: {found} {wanted}"
            );
        }
    }

    #[test]
    fn an_element_is_covered_as_its_points_are() {
        // 1000² points of each element.
        let radius = 1.8;
        for at in [[0, 1], [1, 1], [0, 2], [2, 1], [1, 2]] {
            let place = |k: u32| (f64::from(k) + 0.5) / 1000.0 - 0.5;
            let inside = (0..1_000_000_u32).filter(|k| {
                let [x, y] = [
                    at[0] as f64 + place(k / 1000),
                    at[1] as f64 + place(k % 1000),
                ];
                x.hypot(y) < radius
            });
            let wanted = inside.count() as f64 / 1e6;
            let found = covered(radius, at);
            assert!((found - wanted).abs() < 1e-4, "{at:?}: {found} {wanted}");
        }
    }
}
