//! Integrals over a far element by a product of Gauss–Legendre rules.
//!
//! Lengths are in units of half the element's side, as in [`crate::edges`]. An integrand of the radius that is singular only at
//! the field point, `2m` half sides away, leaves the p-point rule an error of about `(4m)^(−2p)`: 2e-16 for m = 5, p = 6, below 4e-15 at
//! the other borders.

use std::sync::LazyLock;

use crate::gauss::{Node, legendre_of};

/// Offsets (the larger of the two) from which the rules of 6, 5, 4, 3 and 2 points a direction hold.
const BORDERS: [usize; 5] = [NEAREST, 8, 20, 96, 2048];

/// The smallest offset, in elements, at which a product rule can be used.
pub(crate) const NEAREST: usize = 5;

static RULES: LazyLock<[ProductRule; 5]> = LazyLock::new(|| {
    [
        legendre_of::<6>(),
        legendre_of::<5>(),
        legendre_of::<4>(),
        legendre_of::<3>(),
        legendre_of::<2>(),
    ]
    .map(|line| ProductRule { line })
});

/// The same rule in both directions.
#[derive(Debug)]
pub(crate) struct ProductRule {
    line: Vec<Node>,
}

impl ProductRule {
    /// The rule for an element `offset` elements away; `offset` is at least [`NEAREST`] in one direction.
    pub(crate) fn at(offset: [usize; 2]) -> &'static Self {
        let distance = offset[0].max(offset[1]);
        let held = BORDERS.iter().filter(|border| **border <= distance);
        &RULES[held.count().saturating_sub(1)]
    }

    /// Square of the radius, in half sides, and weight of every point of the element `offset` elements away.
    pub(crate) fn points(&self, offset: [usize; 2]) -> impl Iterator<Item = (f64, f64)> {
        let [x, y] = offset.map(|count| 2.0 * count as f64);
        self.line.iter().flat_map(move |across| {
            let x_squared = (x + across.position).powi(2);
            self.line.iter().map(move |along| {
                let radius_squared = x_squared + (y + along.position).powi(2);
                (radius_squared, across.weight * along.weight)
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::ProductRule;

    #[test]
    fn far_elements_get_fewer_points() {
        let count = |offset| ProductRule::at(offset).points(offset).count();
        assert_eq!(count([5, 0]), 36);
        assert_eq!(count([0, 9]), 25);
        assert_eq!(count([95, 95]), 16);
        assert_eq!(count([96, 1]), 9);
        assert_eq!(count([4095, 4095]), 4);
    }
}
