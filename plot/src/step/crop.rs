//! The part of the domain that a picture shows: the contact with a margin.

use std::ops::Range;

/// Margin around the contact, as a fraction of its extent.
const MARGIN: f64 = 0.12;

/// Fewest elements across a picture.
const MIN_ELEMENTS: usize = 12;

/// A square of elements: `x` and `y` have the same length.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Crop {
    /// Elements along x.
    pub x: Range<usize>,
    /// Elements along y.
    pub y: Range<usize>,
}

impl Crop {
    /// Returns the square around the axis that reaches `part` of the way to the edge of a field of `size` × `size`;
    /// from 1 on, the whole field.
    #[must_use]
    pub fn around_axis(size: usize, part: f64) -> Self {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "between 0 and half the size"
        )]
        let reach = (part.clamp(0.0, 1.0) * (size / 2) as f64).ceil() as usize;
        let range = size / 2 - reach..(size / 2 + reach).max(1);
        Self {
            x: range.clone(),
            y: range,
        }
    }

    /// Returns the square around the elements under pressure in a field of `size` × `size`; the whole field if there
    /// are none.
    #[must_use]
    pub fn around_contact(pressure: &[f64], size: usize) -> Self {
        let all = 0..size;
        let Some([x, y]) = extent(pressure, size) else {
            return Self {
                x: all.clone(),
                y: all,
            };
        };
        let extent = x.len().max(y.len());
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a part of size"
        )]
        let margin = (MARGIN * extent as f64).ceil() as usize;
        // The same margin on both sides, so that a contact centred on the axis stays centred.
        let margin = margin.max(MIN_ELEMENTS.saturating_sub(extent).div_ceil(2));
        let length = (extent + 2 * margin).min(size);
        Self {
            x: widen(&x, length, size),
            y: widen(&y, length, size),
        }
    }
}

/// The smallest ranges along x and y that contain every element under pressure.
fn extent(pressure: &[f64], size: usize) -> Option<[Range<usize>; 2]> {
    let in_contact = || (0..pressure.len()).filter(|&e| pressure[e] > 0.0);
    let range = |index: fn(usize, usize) -> usize| {
        let indices = || in_contact().map(|e| index(e, size));
        Some(indices().min()?..indices().max()? + 1)
    };
    Some([range(|e, size| e / size)?, range(|e, size| e % size)?])
}

/// A range of the given length about the middle of another, shifted to lie within the field.
fn widen(range: &Range<usize>, length: usize, size: usize) -> Range<usize> {
    let middle = range.start.midpoint(range.end);
    let start = middle.saturating_sub(length / 2).min(size - length);
    start..start + length
}

#[cfg(test)]
mod tests {
    use super::*;

    fn crop(contact: &[[usize; 2]]) -> Crop {
        let mut pressure = vec![0.0; 100 * 100];
        for [i, j] in contact {
            pressure[i * 100 + j] = 1.0;
        }
        Crop::around_contact(&pressure, 100)
    }

    #[test]
    fn a_contact_in_the_middle_stays_in_the_middle() {
        let crop = crop(&[[40, 50], [59, 50]]);
        assert_eq!(
            crop,
            Crop {
                x: 37..63,
                y: 37..63
            }
        );
    }

    #[test]
    fn a_fraction_of_the_way_to_the_edge_is_that_fraction_of_the_elements() {
        assert_eq!(Crop::around_axis(100, 0.5).x, 25..75);
        assert_eq!(Crop::around_axis(100, 7.0).y, 0..100);
        assert_eq!(Crop::around_axis(8, 0.01).x, 3..5);
    }

    #[test]
    fn a_contact_at_the_edge_is_shown_within_the_domain() {
        let crop = crop(&[[0, 99]]);
        assert_eq!(
            crop,
            Crop {
                x: 0..13,
                y: 87..100
            }
        );
    }

    #[test]
    fn without_contact_everything_is_shown() {
        assert_eq!(
            crop(&[]),
            Crop {
                x: 0..100,
                y: 0..100
            }
        );
    }
}
