//! The combined response of all aliases of a wave, to full precision.
//!
//! With `α = k_x a`, `β = k_y a` the terms are
//!
//! ```text
//! C(q) sinc(α + πm) sinc(β + πn),    q = |(α + πm, β + πn)|/a,    (m, n) ≠ (0, 0)
//! ```
//!
//! They alternate in sign with m and n and fall like `q⁻³`. Tapering an alternating series smoothly changes its sum
//! exponentially little, so 40 aliases on each side suffice. The sum is even and smooth in α and β, and its nearest
//! singularity lies at the first alias, so it is stored as a polynomial in α² and β².

use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::LazyLock;

use libm::erfc;
use rayon::prelude::*;

use crate::bodies::ElasticBodies;
use crate::element::direct::sinc;
use crate::numerics::chebyshev::{lagrange_weights, unit_nodes};

/// Number of aliases on each side.
const REACH: usize = 40;
/// Position of the taper's half value, as a fraction of the reach, and steepness of the taper: 1e-16 of the last
/// aliases remain, and 1e-16 of the first are removed.
const MIDDLE: f64 = 0.5;
const STEEPNESS: f64 = 11.5;
/// `2 q H` from which on `Φ − 1` is below rounding.
const FADED: f64 = 20.0;
/// Nodes of the polynomial along each axis: the first alias is at 14 in the metric of their ellipse, 14⁻¹⁶ = 5e-19, and
/// nearer where a coating is much thinner than an element.
const NODES: usize = 16;

/// The sum for every wave of a grid.
pub struct AliasSum {
    values: [[f64; NODES]; NODES],
}

/// The same for waves of one α.
pub struct AliasSumRow([f64; NODES]);

impl AliasSum {
    /// The sums for elements of half side `a`.
    pub fn new(bodies: &ElasticBodies, half_side: f64) -> Self {
        let foundation = bodies.foundation();
        let moduli =
            std::iter::once(foundation.surface_material()).chain(bodies.counterbody().copied());
        // 2/(E* k) of the surface materials alone
        let homogeneous: f64 = moduli.map(|body| 2.0 / body.plane_strain_modulus()).sum();
        let layered = LayeredPart::of(bodies, half_side);
        let along = wave_nodes();
        let rows = along.par_iter().zip(&*HOMOGENEOUS).map(|(x, of_node)| {
            let values = along.iter().zip(of_node);
            let values =
                values.map(|(y, sum)| homogeneous * half_side * sum + layered.sum([*x, *y]));
            values.collect::<Vec<f64>>()
        });
        let rows: Vec<Vec<f64>> = rows.collect();
        Self {
            values: std::array::from_fn(|i| std::array::from_fn(|j| rows[i][j])),
        }
    }

    /// The polynomial in β² at this α.
    pub fn along(&self, alpha: f64) -> AliasSumRow {
        let weights = weights(alpha);
        AliasSumRow(std::array::from_fn(|j| {
            (weights.iter().zip(&self.values))
                .map(|(weight, row)| weight * row[j])
                .sum()
        }))
    }
}

impl AliasSumRow {
    /// The sum at this β, in m/Pa.
    pub fn at(&self, beta: f64) -> f64 {
        let terms = weights(beta).into_iter().zip(&self.0);
        terms.map(|(weight, value)| weight * value).sum()
    }
}

/// The sums at the nodes on a homogeneous body, in units of `2a/E*`: the same for every grid.
static HOMOGENEOUS: LazyLock<[[f64; NODES]; NODES]> =
    LazyLock::new(|| wave_nodes().map(|x| wave_nodes().map(|y| sum([x, y], f64::recip))));

/// The layers' correction to the sums on a homogeneous body.
struct LayeredPart<'a> {
    bodies: &'a ElasticBodies,
    half_side: f64,
    /// `q a` beyond which the correction is below rounding.
    largest: f64,
}

impl<'a> LayeredPart<'a> {
    fn of(bodies: &'a ElasticBodies, half_side: f64) -> Self {
        let top = bodies.foundation().layers().first();
        Self {
            bodies,
            half_side,
            // Φ − 1 falls like exp(−2 q H)
            largest: top.map_or(0.0, |layer| FADED * half_side / layer.thickness()),
        }
    }

    fn sum(&self, wave: [f64; 2]) -> f64 {
        if self.largest <= FRAC_PI_2 {
            // All aliases are shorter.
            return 0.0;
        }
        let foundation = self.bodies.foundation();
        let per_wave = 2.0 / foundation.surface_material().plane_strain_modulus();
        sum(wave, |q| {
            if q > self.largest {
                return 0.0;
            }
            let wavenumber = q / self.half_side;
            per_wave / wavenumber * foundation.response_minus_one(wavenumber)
        })
    }
}

/// The sum over the aliases of one wave, of a response to `q a`.
fn sum(wave: [f64; 2], response: impl Fn(f64) -> f64) -> f64 {
    let [along_x, along_y] = wave.map(aliases_along);
    let mut sum = 0.0;
    for (m, (x, x_weight)) in along_x.iter().enumerate() {
        for (n, (y, y_weight)) in along_y.iter().enumerate() {
            if [m, n] != [REACH; 2] {
                sum += x_weight * y_weight * response((x * x + y * y).sqrt());
            }
        }
    }
    sum
}

/// `α + πm` of every alias along one axis, and its factor in the sum: `sinc`, tapered.
fn aliases_along(alpha: f64) -> [(f64, f64); 2 * REACH + 1] {
    std::array::from_fn(|i| {
        let x = alpha + PI * (i as f64 - REACH as f64);
        (x, FADE[i.abs_diff(REACH)] * sinc(x))
    })
}

/// `α` at the nodes.
fn wave_nodes() -> [f64; NODES] {
    unit_nodes::<NODES>().map(|node| FRAC_PI_2 * node.sqrt())
}

/// 1 for the first aliases, 0 for the last, and smooth between.
static FADE: LazyLock<[f64; REACH + 1]> = LazyLock::new(|| {
    std::array::from_fn(|m| erfc(STEEPNESS * (m as f64 / REACH as f64 - MIDDLE)) / 2.0)
});

/// Lagrange weights of the nodes at `x`, from 0 to π/2.
fn weights(x: f64) -> [f64; NODES] {
    lagrange_weights((x / FRAC_PI_2).powi(2))
}

#[cfg(test)]
mod tests {
    use pellicle_kernel::{Foundation, Material};

    use super::*;

    /// Elements a hundred times as large as the coating is thick, equally large, and a tenth as large.
    #[test]
    fn the_polynomial_equals_the_sum_between_its_nodes() {
        let material = |modulus| Material::new(modulus, 0.3).unwrap();
        for thickness in [0.01, 1.0, 10.0] {
            let coated = Foundation::coated(thickness, material(30.0), material(1.0)).unwrap();
            let bodies = ElasticBodies::from(coated);
            let aliases = AliasSum::new(&bodies, 0.5);
            for wave in [[0.1, 0.0], [0.4, 1.5], [1.0, 0.9], [FRAC_PI_2, FRAC_PI_2]] {
                let found = aliases.along(wave[0]).at(wave[1]);
                let wanted = sum(wave, |q| bodies.compliance(q / 0.5));
                let own = bodies.compliance(wave[0].hypot(wave[1]) / 0.5);
                assert!(
                    (found - wanted).abs() < 1e-11 * own,
                    "{thickness} {wave:?}: {found} {wanted}"
                );
            }
        }
    }
}
