//! The contribution of wavenumbers that a grid cannot distinguish from its own.

use std::f64::consts::PI;

use crate::element::direct::sinc;
use crate::numerics::chebyshev::{lagrange_weights, unit_nodes};

/// Aliases included on each side. Their terms alternate and fall like `n⁻³`; the remainder is a hundredth of the sum.
const REACH: i32 = 4;
/// Nodes of the interpolation along each direction: its error is 1e-3 of the sum on a homogeneous body, 7e-3 under
/// a stiff coating.
const NODES: usize = 4;

/// One value for each node.
pub type NodeWeights = [f64; NODES];

/// Bodies with a grid of square elements between them.
pub struct GriddedBodies<'a> {
    /// `C(k)`, in m/Pa.
    pub compliance: &'a (dyn Fn(f64) -> f64 + Sync),
    /// Half the side of an element, `a`, in m.
    pub half_side: f64,
}

impl GriddedBodies<'_> {
    /// `C(k) sinc(k_x a) sinc(k_y a)`, in m/Pa, for `k ≠ 0`.
    pub fn response(&self, wave: [f64; 2]) -> f64 {
        self.response_of(wave, wave.map(|k| self.sinc(k)))
    }

    /// The same with `sinc(k_x a)` and `sinc(k_y a)` given.
    pub fn response_of(&self, [kx, ky]: [f64; 2], [of_x, of_y]: [f64; 2]) -> f64 {
        (self.compliance)((kx * kx + ky * ky).sqrt()) * (of_x * of_y)
    }

    /// `sinc(k a)`.
    pub fn sinc(&self, k: f64) -> f64 {
        sinc(k * self.half_side)
    }

    /// `Σ C sinc sinc` over the aliases `k + (m, n) π/a` other than `k` itself.
    fn aliases(&self, [kx, ky]: [f64; 2]) -> f64 {
        let apart = PI / self.half_side;
        let mut sum = 0.0;
        for m in -REACH..=REACH {
            for n in -REACH..=REACH {
                if [m, n] != [0, 0] {
                    sum += self.response([kx + f64::from(m) * apart, ky + f64::from(n) * apart]);
                }
            }
        }
        sum
    }
}

/// The sum over the aliases as a polynomial in the squares of both wavenumbers, of which it is a smooth function.
pub struct Aliases {
    values: [NodeWeights; NODES],
}

impl Aliases {
    /// Samples the sum at the nodes.
    pub fn new(body: &GriddedBodies<'_>) -> Self {
        let largest = PI / (2.0 * body.half_side);
        let wavenumbers = unit_nodes::<NODES>().map(|node| node.sqrt() * largest);
        Self {
            values: wavenumbers.map(|kx| wavenumbers.map(|ky| body.aliases([kx, ky]))),
        }
    }

    /// The polynomial in `k_y²` at the `k_x` with these weights.
    pub fn along(&self, weights: &NodeWeights) -> AliasRow {
        let mut row = [0.0; NODES];
        for (weight, values) in weights.iter().zip(&self.values) {
            for (sum, value) in row.iter_mut().zip(values) {
                *sum += weight * value;
            }
        }
        AliasRow(row)
    }
}

/// The sum at one `k_x`.
pub struct AliasRow(NodeWeights);

impl AliasRow {
    /// The sum at the `k_y` with these weights, in m/Pa.
    pub fn at(&self, weights: &NodeWeights) -> f64 {
        self.0.iter().zip(weights).map(|(v, w)| v * w).sum()
    }
}

/// Lagrange weights of the nodes at the wavenumber that is `part` of the grid's largest, `π/2a`.
pub fn weights(part: f64) -> NodeWeights {
    lagrange_weights(part * part)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use pellicle_kernel::{Foundation, Material};

    use super::{Aliases, GriddedBodies, weights};
    use crate::bodies::ElasticBodies;

    fn bodies() -> Vec<ElasticBodies> {
        let material = |modulus, ratio| Material::new(modulus, ratio).unwrap();
        let coated = |h, e1, nu1| Foundation::coated(h, material(e1, nu1), material(1.0, 0.3));
        let foundations = [
            Foundation::half_space(material(1.0, 0.3)),
            coated(0.1, 100.0, 0.3).unwrap(),
            coated(0.5, 100.0, 0.0).unwrap(),
            coated(0.5, 0.01, 0.5).unwrap(),
            coated(5.0, 0.01, 0.5).unwrap(),
        ];
        foundations.map(ElasticBodies::from).into()
    }

    #[test]
    fn the_polynomial_equals_the_sum_between_its_nodes() {
        for bodies in &bodies() {
            let body = GriddedBodies {
                compliance: &|k| bodies.compliance(k),
                half_side: 0.5,
            };
            let aliases = Aliases::new(&body);
            for [x, y] in [[0.05, 0.0], [0.1, 1.0], [0.5, 0.6], [1.0, 1.0]] {
                let wave = [x, y].map(|part| part * PI);
                let exact = body.aliases(wave);
                let found = aliases.along(&weights(x)).at(&weights(y));
                let symbol = body.response(wave) + exact;
                assert!((found - exact).abs() < 1e-2 * symbol, "{found} {exact}");
            }
        }
    }
}
