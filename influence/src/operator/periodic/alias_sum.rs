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

use std::f64::consts::{FRAC_PI_2, PI, SQRT_2};
use std::sync::LazyLock;

use libm::erfc;
use pellicle_kernel::Foundation;
use rayon::prelude::*;

use super::compliance_table::ComplianceTable;
use super::squared_table::SquaredTable;
use crate::bodies::ElasticBodies;
use crate::element::direct::sinc;
use crate::numerics::chebyshev::{lagrange_weights, unit_nodes};

/// Number of aliases on each side.
const REACH: usize = 40;
/// Position of the taper's half value, as a fraction of the reach, and steepness of the taper: 1e-16 of the last
/// aliases remain, and 1e-16 of the first are removed.
const MIDDLE: f64 = 0.5;
const STEEPNESS: f64 = 11.5;
/// The largest wavenumber of an alias, in units of `π/a`.
pub const SHORTEST: f64 = SQRT_2 * (REACH as f64 + 0.5);
/// Nodes of the polynomial along each axis. On a homogeneous body the first alias is at 14 in the metric of their
/// ellipse; the response of a stiff coating has poles at 7, 7⁻²⁰ = 1e-17. 16 nodes left errors of 3e-11 there.
const NODES: usize = 20;

/// The sum for every wave of a grid.
pub struct AliasSum {
    values: [[f64; NODES]; NODES],
}

/// The same for waves of one α.
pub struct AliasSumRow(NodeWeights);

/// One value for each node.
pub type NodeWeights = [f64; NODES];

impl AliasSum {
    /// The sums for elements of half side `a`, from the compliance over the waves of their cell.
    pub fn new(bodies: &ElasticBodies, compliance: &ComplianceTable, half_side: f64) -> Self {
        if compliance.is_homogeneous_beyond(FRAC_PI_2 / half_side) {
            // All aliases are shorter.
            return Self::on_homogeneous(bodies, half_side);
        }
        // The first alias of the shortest wave, and the last of another.
        let ends = [FRAC_PI_2, PI * SHORTEST];
        let response = SquaredTable::new(ends, |q| compliance.at(q / half_side));
        let along = wave_nodes();
        // The sum is symmetric in α and β.
        let rows = along.par_iter().enumerate().map(|(i, x)| {
            let values = along[..=i].iter();
            let values = values.map(|y| sum([*x, *y], |square| response.at(square)));
            values.collect::<Vec<f64>>()
        });
        let rows: Vec<Vec<f64>> = rows.collect();
        Self {
            values: std::array::from_fn(|i| std::array::from_fn(|j| rows[i.max(j)][i.min(j)])),
        }
    }

    /// The sums on the surface materials alone.
    fn on_homogeneous(bodies: &ElasticBodies, half_side: f64) -> Self {
        let of_surface = |body: &Foundation| 2.0 / body.surface_material().plane_strain_modulus();
        // 2/(E* k) of the surface materials alone
        let homogeneous: f64 = bodies.each().map(of_surface).iter().sum();
        let value = |of_node: &f64| homogeneous * half_side * of_node;
        Self {
            values: HOMOGENEOUS.each_ref().map(|row| row.each_ref().map(value)),
        }
    }

    /// The polynomial in β² at the α with these [`weights`].
    pub fn along(&self, weights: &NodeWeights) -> AliasSumRow {
        AliasSumRow(std::array::from_fn(|j| {
            (weights.iter().zip(&self.values))
                .map(|(weight, row)| weight * row[j])
                .sum()
        }))
    }
}

impl AliasSumRow {
    /// The sum at the β with these [`weights`], in m/Pa.
    pub fn at(&self, weights: &NodeWeights) -> f64 {
        let terms = weights.iter().zip(&self.0);
        terms.map(|(weight, value)| weight * value).sum()
    }
}

/// The sums at the nodes on a homogeneous body, in units of `2a/E*`: the same for every grid.
static HOMOGENEOUS: LazyLock<[[f64; NODES]; NODES]> = LazyLock::new(|| {
    wave_nodes().map(|x| wave_nodes().map(|y| sum([x, y], |square| square.sqrt().recip())))
});

/// The sum over the aliases of one wave, of a response as a function of `(q a)²`.
fn sum(wave: [f64; 2], response: impl Fn(f64) -> f64) -> f64 {
    let [along_x, along_y] = wave.map(aliases_along);
    let mut sum = 0.0;
    for (m, (x, x_weight)) in along_x.iter().enumerate() {
        for (n, (y, y_weight)) in along_y.iter().enumerate() {
            if [m, n] != [REACH; 2] {
                sum += x_weight * y_weight * response(x * x + y * y);
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
pub fn weights(x: f64) -> NodeWeights {
    lagrange_weights((x / FRAC_PI_2).powi(2))
}

#[cfg(test)]
mod tests {
    use pellicle_kernel::{Base, Interface, Layer, Material};

    use super::*;

    /// Elements a hundred times as large as the coating is thick, down to a tenth.
    #[test]
    fn the_polynomial_equals_the_sum_between_its_nodes() {
        let material = |modulus| Material::new(modulus, 0.3).unwrap();
        for modulus in [30.0, 1e5] {
            for thickness in [0.01, 0.15, 1.0, 10.0] {
                let coating = material(modulus);
                let coated = Foundation::coated(thickness, coating, material(1.0)).unwrap();
                assert_equals_the_sum(&coated.into());
            }
        }
    }

    /// Sublayers a hundredth of an element thick, and incompressible ones on a rigid base.
    #[test]
    fn the_sum_of_a_graded_layer_equals_that_of_its_compliance() {
        let layer = |i: i32, ratio: f64| {
            let material = Material::new(4.0 - 0.02 * f64::from(i), ratio).unwrap();
            Layer::new(0.01, material, Interface::Bonded).unwrap()
        };
        for (base, ratio) in [
            (Base::HalfSpace(Material::new(1.0, 0.3).unwrap()), 0.3),
            (Base::Rigid, 0.5),
        ] {
            let layers = (0..50).map(|i| layer(i, ratio)).collect();
            let foundation = Foundation::new(layers, base).unwrap();
            let indenter = Some(Material::new(2.0, 0.2).unwrap());
            assert_equals_the_sum(&ElasticBodies::new(foundation, indenter));
        }
    }

    fn assert_equals_the_sum(bodies: &ElasticBodies) {
        let compliance = ComplianceTable::of_cell(bodies, 1.0, 64);
        let aliases = AliasSum::new(bodies, &compliance, 0.5);
        for wave in [[0.1, 0.0], [0.4, 1.5], [1.0, 0.9], [FRAC_PI_2, FRAC_PI_2]] {
            let [along_x, along_y] = wave.map(weights);
            let found = aliases.along(&along_x).at(&along_y);
            let wanted = sum(wave, |square| bodies.compliance(square.sqrt() / 0.5));
            let own = bodies.compliance(wave[0].hypot(wave[1]) / 0.5);
            let response = own * sinc(wave[0]) * sinc(wave[1]) + wanted;
            assert!(
                (found - wanted).abs() < 1e-12 * response.abs(),
                "{wave:?}: {found} {wanted} {bodies:?}"
            );
        }
    }
}
