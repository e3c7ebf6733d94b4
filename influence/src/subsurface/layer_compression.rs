//! Estimates of how much each layer is shortened below a point of a loaded surface, and of the pressure that reaches
//! the body below it.
//!
//! Under a uniform pressure on a disc of radius r, a field on the disc's axis whose waves have the amplitude `A(k)` is
//!
//! ```text
//! F(r) = r ∫₀^∞ A(k) J₁(k r) dk = ∫₀^∞ A(x/r) J₁(x) dx
//! ```
//!
//! On a line below any point a pressure acts as its mean over each circle about the point does, and this mean is a sum
//! of discs. With `ln k` and `ln r` on one lattice, and A taken to be linear in `ln k` between lattice points, all
//! radii use the same amplitudes and the same weights.

use std::f64::consts::{PI, TAU};
use std::sync::LazyLock;

use pellicle_kernel::{Foundation, KernelError, Side};

use crate::error::InfluenceError;

/// Step of `ln k` and `ln r`. A is linear over a step to about δ²/8 = 0.2 %.
const STEP: f64 = 0.125;

/// Lattice points of `ln x` between which A varies in the integral. Below x = 0.01 lies 2e-5 of it; beyond x = 90 the
/// weight of J₁ averages out.
const FIRST: i32 = -37;
const LAST: i32 = 36;

/// Distance, in sides of a square, up to which it is divided. A ring as wide as a square misses parts of the circles
/// that it stands for; with 1.5, the shortening of a film as thin as an element is 6 % too small.
const NEAR: f64 = 3.0;
/// Side of a square, in smallest tabulated radii, below which it is no longer divided but acts like a disc of its area.
const SMALLEST: f64 = 0.1;

/// Simpson intervals in a step for the weights: 24 in the last period of J₁.
const SIMPSON: i32 = 40;

/// `∫ hat_m(ln x) J₁(x) dx` over the hat functions of the lattice points from [`FIRST`] to [`LAST`]; the last one is 1
/// beyond its lattice point.
static WEIGHTS: LazyLock<Vec<f64>> = LazyLock::new(|| (FIRST..=LAST).map(weight).collect());

/// `∫ hat_m(ln x) J₁(x) dx = (1/δ) [∫_{m−1}^{m} J₀ d ln x − ∫_m^{m+1} J₀ d ln x]`, by parts.
fn weight(m: i32) -> f64 {
    let rising = if m == FIRST { 1.0 } else { mean_j0(m - 1) };
    let falling = if m == LAST { 0.0 } else { mean_j0(m) };
    rising - falling
}

/// The mean of `J₀(x)` over `ln x` from lattice point `m` to the next.
fn mean_j0(m: i32) -> f64 {
    let node = |i: i32| {
        let j0 = libm::j0((STEP * (f64::from(m) + f64::from(i) / f64::from(SIMPSON))).exp());
        match i {
            0 | SIMPSON => j0,
            _ if i % 2 == 1 => 4.0 * j0,
            _ => 2.0 * j0,
        }
    };
    (0..=SIMPSON).map(node).sum::<f64>() / f64::from(3 * SIMPSON)
}

/// The compression of the layers of a foundation below a point: tables over the radius of a disc under unit pressure.
///
/// The estimates are within 5 % of the exact fields (`contact/src/result/model_limits/tests.rs`). Tables of a
/// coated body take some 0.1 ms, an estimate some 30 ns per loaded element.
///
/// ```
/// use pellicle_influence::LayerCompression;
/// use pellicle_kernel::{Foundation, Material};
///
/// let (film, glass) = (Material::new(1e9, 0.4)?, Material::new(70e9, 0.2)?);
/// let body = Foundation::coated(100e-9, film, glass)?;
/// let tables = LayerCompression::new(&body, [10e-9, 10e-6])?;
/// // A wide disc cannot squeeze the film sideways: p t (1 + ν)(1 − 2ν)/(E (1 − ν)) under 100 MPa.
/// let column = tables.below_disc(10e-6, 100e6);
/// assert!((column.shortenings[0] / 4.67e-9 - 1.0).abs() < 0.02);
/// assert!((column.pressures[0] / 100e6 - 1.0).abs() < 0.02);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct LayerCompression {
    foundation: Foundation,
    /// Index of the first radius on the lattice.
    first: i32,
    /// Numbers per radius: the shortenings of the layers, then the pressures below them, over a unit pressure.
    tables: Vec<Vec<f64>>,
}

/// The layers below one point of the surface.
#[derive(Debug, Clone, PartialEq)]
pub struct LayerColumn {
    /// Shortening of each layer, surface first: `u_z` at its top less `u_z` at its bottom, in m.
    pub shortenings: Vec<f64>,
    /// `−σ_zz` at the bottom of each layer, in Pa.
    pub pressures: Vec<f64>,
}

impl LayerCompression {
    /// Tables for discs with radii (m) from one positive number to another.
    ///
    /// # Errors
    ///
    /// Radii that are not positive and finite; waves that the kernel cannot compute.
    pub fn new(foundation: &Foundation, [least, most]: [f64; 2]) -> Result<Self, InfluenceError> {
        let first = index_below(least)?;
        let last = index_below(most)?.max(first) + 1;
        // ln k = ln x − ln r
        let amplitudes = (FIRST - last)..=(LAST - first);
        let amplitudes = amplitudes.map(|index| amplitudes_at(foundation, index));
        let amplitudes = amplitudes.collect::<Result<Vec<_>, KernelError>>()?;
        let table = |radius: i32| {
            let skipped = usize::try_from(last - radius).unwrap_or_default();
            let nodes = amplitudes[skipped..].iter().zip(WEIGHTS.iter());
            let mut sums = vec![0.0; 2 * foundation.layers().len()];
            for (amplitudes, weight) in nodes {
                for (sum, amplitude) in sums.iter_mut().zip(amplitudes) {
                    *sum += weight * amplitude;
                }
            }
            sums
        };
        Ok(Self {
            foundation: foundation.clone(),
            first,
            tables: (first..=last).map(table).collect(),
        })
    }

    /// The layers below the centre of a disc of a radius (m) under a uniform pressure (Pa).
    #[must_use]
    pub fn below_disc(&self, radius: f64, pressure: f64) -> LayerColumn {
        let mut sums = vec![0.0; 2 * self.foundation.layers().len()];
        self.add_disc(radius, pressure, &mut sums);
        column(sums)
    }

    /// The layers below a point under square elements of side `side` (m), each given by the place of its centre
    /// relative to the point (m) and its pressure (Pa), and under a `uniform` pressure (Pa) on the whole surface.
    #[must_use]
    pub fn below(
        &self,
        elements: impl IntoIterator<Item = ([f64; 2], f64)>,
        side: f64,
        uniform: f64,
    ) -> LayerColumn {
        let mut sums = self.under_uniform(uniform);
        for (place, pressure) in elements {
            self.add_element(place, side, pressure, &mut sums);
        }
        column(sums)
    }

    /// Adds the numbers under a square, which acts like a part of the ring as wide as itself; close to the point it is
    /// divided first.
    fn add_element(&self, [x, y]: [f64; 2], side: f64, pressure: f64, sums: &mut [f64]) {
        let distance = x.hypot(y);
        let is_small = side < SMALLEST * self.smallest();
        if distance <= NEAR * side && !is_small {
            let third = side / 3.0;
            for i in [-third, 0.0, third] {
                for j in [-third, 0.0, third] {
                    self.add_element([x + i, y + j], third, pressure, sums);
                }
            }
        } else if distance < side / 2.0 {
            self.add_disc(side / PI.sqrt(), pressure, sums);
        } else {
            // The square's share of the ring: h²/(2π ρ h).
            let part = pressure * side / (TAU * distance);
            self.add_disc(distance + side / 2.0, part, sums);
            self.add_disc(distance - side / 2.0, -part, sums);
        }
    }

    /// The smallest tabulated radius, m.
    fn smallest(&self) -> f64 {
        (STEP * f64::from(self.first)).exp()
    }

    /// Under a uniform pressure a layer cannot move sideways: `p t (1 + ν)(1 − 2ν)/(E (1 − ν))`.
    fn under_uniform(&self, pressure: f64) -> Vec<f64> {
        let shortening = |layer: &pellicle_kernel::Layer| {
            let (young, nu) = (
                layer.material().young_modulus(),
                layer.material().poisson_ratio(),
            );
            let confined = (1.0 + nu) * (1.0 - 2.0 * nu) / (young * (1.0 - nu));
            pressure * layer.thickness() * confined
        };
        let layers = self.foundation.layers();
        let shortenings = layers.iter().map(shortening);
        shortenings.chain(layers.iter().map(|_| pressure)).collect()
    }

    /// Adds the numbers under a disc; linear in `ln r` between lattice points, in r² below the first.
    fn add_disc(&self, radius: f64, pressure: f64, sums: &mut [f64]) {
        if radius <= 0.0 {
            return;
        }
        let place = radius.ln() / STEP - f64::from(self.first);
        let last = self.tables.len() - 2;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a place in a table, clamped to it"
        )]
        let index = (place.max(0.0) as usize).min(last);
        let part = (place - index as f64).clamp(0.0, 1.0);
        // A disc smaller than all tabulated ones lies within one element.
        let scale = if place < 0.0 {
            (STEP * place).exp()
        } else {
            1.0
        };
        let pair = self.tables[index].iter().zip(&self.tables[index + 1]);
        for (sum, (below, above)) in sums.iter_mut().zip(pair) {
            *sum += pressure * scale * (below + part * (above - below));
        }
    }
}

fn column(mut sums: Vec<f64>) -> LayerColumn {
    let pressures = sums.split_off(sums.len() / 2);
    LayerColumn {
        shortenings: sums,
        pressures,
    }
}

/// Index of the lattice radius at or below a radius.
fn index_below(radius: f64) -> Result<i32, InfluenceError> {
    if !(radius.is_finite() && radius > 0.0) {
        return Err(InfluenceError::ElementSide { found: radius });
    }
    #[expect(
        clippy::cast_possible_truncation,
        reason = "eight times the logarithm of a floating-point number is below 6000"
    )]
    let index = (radius.ln() / STEP).floor() as i32;
    Ok(index)
}

/// `u_z` at the top of each layer less `u_z` at its bottom, then `−σ_zz` at each bottom, per unit pressure.
fn amplitudes_at(foundation: &Foundation, index: i32) -> Result<Vec<f64>, KernelError> {
    let interior = foundation.interior((STEP * f64::from(index)).exp())?;
    let layers = 0..foundation.layers().len();
    let depth = |layer| foundation.interface_depth(layer);
    let states = layers.map(|layer| {
        let top = interior.at(depth(layer), Side::Below).normal;
        let bottom = interior.at(depth(layer + 1), Side::Above).normal;
        (
            top.vertical_displacement - bottom.vertical_displacement,
            -bottom.normal_stress,
        )
    });
    let (shortenings, pressures): (Vec<_>, Vec<_>) = states.unzip();
    Ok([shortenings, pressures].concat())
}

#[cfg(test)]
mod tests {
    use pellicle_kernel::{Base, Interface, Layer, Material};

    use super::*;

    #[test]
    fn the_weights_integrate_powers_of_the_wavenumber() {
        // ∫ J₁ dx = 1 and ∫ J₁/x dx = 1; A = 1/k is curved between lattice points by δ²/8.
        let sum = |of: fn(f64) -> f64| -> f64 {
            let nodes = (FIRST..).zip(WEIGHTS.iter());
            nodes
                .map(|(m, weight)| weight * of((STEP * f64::from(m)).exp()))
                .sum()
        };
        assert!((sum(|_| 1.0) - 1.0).abs() < 1e-12);
        assert!((sum(|x| 1.0 / x) - 1.0).abs() < 0.01);
    }

    #[test]
    fn a_small_disc_on_a_thick_layer_sinks_in_as_into_a_half_space() {
        let material = Material::new(2.0, 0.3).unwrap();
        let layer = Layer::new(1e3, material, Interface::Bonded).unwrap();
        let body = Foundation::new(vec![layer], Base::Rigid).unwrap();
        let tables = LayerCompression::new(&body, [0.1, 10.0]).unwrap();
        // The centre of a disc sinks by 2 (1 − ν²) p r/E.
        for radius in [0.1, 0.77, 5.0] {
            let found = tables.below_disc(radius, 3.0).shortenings[0];
            let wanted = 2.0 * 0.91 * 3.0 * radius / 2.0;
            // The rigid base holds back r/H of it.
            assert!((found / wanted - 1.0).abs() < 0.012, "{radius} {found}");
        }
    }

    #[test]
    fn elements_of_a_disc_act_together_as_the_disc() {
        let [film, base] = [0.1, 1.0].map(|young| Material::new(young, 0.3).unwrap());
        let body = Foundation::coated(0.3, film, base).unwrap();
        let side = 0.05;
        let tables = LayerCompression::new(&body, [side / 2.0, 4.0]).unwrap();
        let centres = (-40..=40).flat_map(|i| (-40..=40).map(move |j| [i, j]));
        let inside = centres.filter(|[i, j]| i * i + j * j <= 400);
        let elements = inside.map(|place| (place.map(|i| side * f64::from(i)), 2.0));
        let found = tables.below(elements, side, 0.0);
        let wanted = tables.below_disc(1.0, 2.0);
        // 1257 elements have the area of the disc to a thousandth.
        let errors = [
            found.shortenings[0] / wanted.shortenings[0] - 1.0,
            found.pressures[0] / wanted.pressures[0] - 1.0,
        ];
        assert!(errors.iter().all(|error| error.abs() < 0.01), "{errors:?}");
        // A uniform pressure confines the film; below the widest disc the base contracts sideways by p (1 + ν)(1 −
        // 2ν)/(2E) (Love 1929), and the film is shortened by 2ν/(1 − ν) times that strain less.
        let uniform = tables.below([], side, 2.0);
        let widest = LayerCompression::new(&body, [100.0, 200.0]).unwrap();
        let widest = widest.below_disc(150.0, 2.0);
        let strain = 2.0 * 1.3 * 0.4 / 2.0;
        let wanted = uniform.shortenings[0] - 0.3 * 0.6 / 0.7 * strain;
        // The lattice of radii and wavenumbers.
        assert!((widest.shortenings[0] / wanted - 1.0).abs() < 0.005);
        assert_eq!(uniform.pressures, [2.0]);
    }
}
