//! A field of a coarse grid on a finer one over the same square.

use rayon::prelude::*;

use crate::grid::window::Window;

/// A field of a level on a window of it, and the outline of the whole level's relief.
#[derive(Clone, Copy)]
pub struct Field<'a> {
    pub window: Window,
    pub values: &'a [f64],
    pub mask: &'a [bool],
}

/// The field on a window `onto` of a grid over the same square, whose relief has the outline `mask`.
///
/// Bilinear between the centres of elements on the same side of the outline, constant beyond the outermost; 0 where the
/// four centres around lie all on the other side, or outside the field's window. Values of −∞ count for nothing.
#[must_use]
pub fn prolong(field: &Field<'_>, onto: &Window, mask: &[bool]) -> Vec<f64> {
    let places = [0, 1].map(|axis: usize| {
        let first = onto.origin()[axis];
        let along = first..first + onto.size();
        let places = along.map(|i| BetweenCentres::of(i, field.window.grid(), onto.grid()));
        places.collect::<Vec<_>>()
    });
    let mut fine = vec![0.0; onto.size() * onto.size()];
    let rows = fine.par_chunks_mut(onto.size()).zip(&places[0]).enumerate();
    rows.for_each(|(row, (values, x))| {
        let mask = onto.line(mask, row);
        for ((value, side), y) in values.iter_mut().zip(mask).zip(&places[1]) {
            *value = interpolate(field, *side, [x, y]);
        }
    });
    fine
}

/// The mean of the four values around a place that lie on one side of the outline, by their bilinear weights.
fn interpolate(field: &Field<'_>, side: bool, [x, y]: [&BetweenCentres; 2]) -> f64 {
    let (mut sum, mut weights) = (0.0, 0.0);
    for (i, along_x) in x.ends() {
        for (j, along_y) in y.ends() {
            if let Some(place) = field.window.place([i, j])
                && field.mask[i * field.window.grid() + j] == side
                && field.values[place] > f64::NEG_INFINITY
            {
                sum += along_x * along_y * field.values[place];
                weights += along_x * along_y;
            }
        }
    }
    if weights > 0.0 { sum / weights } else { 0.0 }
}

/// A fine centre between two coarse ones along one axis.
struct BetweenCentres {
    low: usize,
    high: usize,
    /// Weight of the second.
    weight: f64,
}

impl BetweenCentres {
    /// The place of the `i`-th of `to` centres among `from`.
    fn of(i: usize, from: usize, to: usize) -> Self {
        let position =
            ((i as f64 + 0.5) * from as f64 / to as f64 - 0.5).clamp(0.0, (from - 1) as f64);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped to 0 ..= from − 1"
        )]
        let low = position as usize;
        Self {
            low,
            high: (low + 1).min(from - 1),
            weight: position - low as f64,
        }
    }

    /// Both centres with their weights.
    fn ends(&self) -> [(usize, f64); 2] {
        [(self.low, 1.0 - self.weight), (self.high, self.weight)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_is_prolonged_exactly_between_the_outermost_centres() {
        let (from, to) = (8, 15);
        let plane = |i: usize, j: usize, n: usize| {
            (2.0 * i as f64 + 1.0) / n as f64 + 3.0 * (2.0 * j as f64 + 1.0) / n as f64
        };
        let coarse: Vec<f64> = (0..from * from)
            .map(|e| plane(e / from, e % from, from))
            .collect();
        let field = Field {
            window: Window::whole(from),
            values: &coarse,
            mask: &vec![true; from * from],
        };
        let fine = prolong(&field, &Window::whole(to), &vec![true; to * to]);
        for (i, j) in [(1, 1), (7, 3), (13, 9)] {
            approx::assert_relative_eq!(fine[i * to + j], plane(i, j, to), max_relative = 1e-14);
        }
    }

    #[test]
    fn on_a_window_the_field_is_that_of_the_whole_grid() {
        let coarse: Vec<f64> = (0..256).map(|e| (f64::from(e)).sin()).collect();
        let mask: Vec<bool> = (0..1024).map(|e| e % 5 > 1).collect();
        let field = Field {
            window: Window::whole(16),
            values: &coarse,
            mask: &mask[..256],
        };
        let whole = prolong(&field, &Window::whole(32), &mask);
        let onto = Window::whole(32).around(|[i, j]| i == 13 && j == 20);
        assert_eq!(prolong(&field, &onto, &mask), onto.cut(&whole));
        // A part of the field that holds all that its interpolation looks at.
        let part = Window::whole(16).around(|[i, j]| i == 6 && j == 10);
        let field = Field {
            window: part,
            values: &part.cut(&coarse),
            ..field
        };
        let inner = Window::whole(32).around(|[i, j]| i == 13 && j == 21);
        assert!(inner.size() < 2 * part.size() - 2);
        assert_eq!(prolong(&field, &inner, &mask), inner.cut(&whole));
    }

    #[test]
    fn nothing_is_interpolated_across_an_outline() {
        let (from, to) = (16, 32);
        let mask = |n: usize| (0..n * n).map(|e| 4 * (e / n) < n).collect::<Vec<bool>>();
        let coarse: Vec<f64> = mask(from)
            .iter()
            .map(|on| if *on { 3.0 } else { -1.0 })
            .collect();
        let field = Field {
            window: Window::whole(from),
            values: &coarse,
            mask: &mask(from),
        };
        let fine = prolong(&field, &Window::whole(to), &mask(to));
        for (value, on) in fine.iter().zip(mask(to)) {
            approx::assert_relative_eq!(*value, if on { 3.0 } else { -1.0 });
        }
    }
}
