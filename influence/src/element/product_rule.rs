//! Integrals over a far element by a product of Gauss–Legendre rules.
//!
//! Lengths are in units of half the element's side, as in [`crate::element::edges`]. Two effects limit the p-point
//! rule at the distance ρ:
//! - the singularity of `1/ρ` at the field point leaves about `(2ρ)^(−2p)`;
//! - around a layer `T` contains terms `e^(−κρ)` of any rate κ, for which the error of the rule is
//!   `c_p κ^(2p) e^(−κρ)`, at most `c_p (2p/(eρ))^(2p)`, where `c_p = 2^(2p+1) (p!)⁴ / ((2p+1) ((2p)!)³)`. Around a
//!   soft layer on a stiff base the displacement far away, Φ(0), is small, so the relative error is large.

use std::f64::consts::E;
use std::sync::LazyLock;

use serde::{Deserialize, Serialize};

use crate::numerics::quadrature::{Node, legendre_of};
use crate::numerics::rounding;

/// Points per direction of the rules, and the offsets (the larger of the two) from which the singularity allows them.
const RULES: [(i32, usize); 5] = [(6, 5), (5, 8), (4, 20), (3, 96), (2, 2048)];

/// Allowed error of a rule, relative to `min(1, Φ(0))`.
const TOLERANCE: f64 = 1e-13;

static LINES: LazyLock<[ProductRule; 5]> = LazyLock::new(|| {
    [
        legendre_of::<6>(),
        legendre_of::<5>(),
        legendre_of::<4>(),
        legendre_of::<3>(),
        legendre_of::<2>(),
    ]
    .map(|line| ProductRule { line })
});

/// The offsets, in elements, from which each rule is valid for one foundation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Borders([usize; 5]);

impl Borders {
    /// The offsets for `1/ρ` alone.
    pub(crate) const HOMOGENEOUS: Self =
        Self([RULES[0].1, RULES[1].1, RULES[2].1, RULES[3].1, RULES[4].1]);

    /// The offsets for a layered foundation whose far displacement is `floor = min(1, Φ(0))` times that
    /// of its surface material.
    pub(crate) fn new(floor: f64) -> Self {
        Self(RULES.map(|(points, border)| {
            let power = f64::from(2 * points);
            // c_p (2p/(eρ))^(2p) = tolerance · floor
            let ratio = error_constant(points) / (TOLERANCE * floor);
            let distance = power / E * ratio.powf(1.0 / power);
            border.max(rounding::ceil(distance / 2.0))
        }))
    }

    /// The rule for an element `offset` elements away; `None` if that is too near for any.
    pub(crate) fn rule(&self, offset: [usize; 2]) -> Option<&'static ProductRule> {
        let distance = offset[0].max(offset[1]);
        let passed = self.0.iter().take_while(|border| **border <= distance);
        LINES.get(passed.count().checked_sub(1)?)
    }

    /// Each rule at its border.
    pub(crate) fn each(&self) -> impl Iterator<Item = AtBorder> {
        let borders = self.0.into_iter().zip(LINES.iter()).enumerate();
        borders.map(|(index, (border, rule))| AtBorder {
            rule,
            finer: index.checked_sub(1).and_then(|finer| LINES.get(finer)),
            offset: [border, 0],
        })
    }
}

/// A rule at the nearest offset for which it is used.
pub(crate) struct AtBorder {
    pub rule: &'static ProductRule,
    /// The rule with one more point, if there is one.
    pub finer: Option<&'static ProductRule>,
    pub offset: [usize; 2],
}

/// `c_p = 2^(2p+1) (p!)⁴ / ((2p+1) ((2p)!)³)`: the error of the p-point rule is this times a derivative of order 2p.
fn error_constant(points: i32) -> f64 {
    let factorial = |n: i32| -> f64 { (1..=n).map(f64::from).product() };
    let twice = 2 * points;
    2_f64.powi(twice + 1) * factorial(points).powi(4)
        / (f64::from(twice + 1) * factorial(twice).powi(3))
}

/// The same rule in both directions.
#[derive(Debug)]
pub(crate) struct ProductRule {
    line: Vec<Node>,
}

impl ProductRule {
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
    use super::Borders;

    fn count(borders: Borders, offset: [usize; 2]) -> Option<usize> {
        Some(borders.rule(offset)?.points(offset).count())
    }

    #[test]
    fn far_elements_get_fewer_points() {
        let count = |offset| count(Borders::HOMOGENEOUS, offset);
        assert_eq!(count([4, 4]), None);
        assert_eq!(count([5, 0]), Some(36));
        assert_eq!(count([0, 9]), Some(25));
        assert_eq!(count([95, 95]), Some(16));
        assert_eq!(count([96, 1]), Some(9));
        assert_eq!(count([4095, 4095]), Some(4));
    }

    #[test]
    fn soft_layers_get_more_points() {
        for offset in [[6, 0], [12, 3], [40, 40], [200, 0]] {
            let soft = count(Borders::new(1e-6), offset).unwrap_or(1000);
            assert!(soft > count(Borders::HOMOGENEOUS, offset).unwrap_or(1000));
        }
    }
}
