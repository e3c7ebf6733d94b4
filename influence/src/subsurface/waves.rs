//! The waves in a body at the wavenumbers of the [lattice](super::log_lattice), and their sums at one depth,
//! functions of the radius.
//!
//! The waves are solved for once; every further depth takes its amplitudes from them. Lengths are in sides of an
//! element, so that the lattice is the same for every depth.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use pellicle_kernel::{Amplitudes, Foundation, Interior, KernelError};
use rayon::prelude::*;

use super::log_lattice::{
    EXACT, EXACT_WEIGHTS, HankelWeights, LatticeWeights, LogLattice, ROUGH, ROUGH_WEIGHTS,
};
use super::point_kernels::PointLoad;
use super::radial_panels::{Layout, RadialPanels};

/// Largest number of points of the interpolation over `ln r`.
const MOST_POINTS: usize = EXACT.stencil;

/// The interiors of a foundation that some depth has needed, by the index of the wavenumber.
#[derive(Debug)]
pub struct Waves {
    foundation: Foundation,
    /// Unit of lengths, m: the side of an element.
    unit: f64,
    lattice: &'static LogLattice,
    weights: &'static LatticeWeights,
    interiors: BTreeMap<isize, Interior>,
}

/// Amplitudes on the part of the lattice from which the functions at some radii are computed.
#[derive(Clone, Debug)]
pub struct Sampled {
    layout: Layout,
    lattice: &'static LogLattice,
    weights: &'static LatticeWeights,
    /// Indices of the first and last radius of the lattice.
    radii: [isize; 2],
    /// At the wavenumbers from the lowest on; for long waves, only at one in the coarse stride.
    amplitudes: Vec<Option<Amplitudes>>,
    /// Factors of the amplitudes.
    factors: Vec<f64>,
}

impl Waves {
    pub fn new(foundation: &Foundation, unit: f64) -> Self {
        Self {
            foundation: foundation.clone(),
            unit,
            lattice: &EXACT,
            weights: &EXACT_WEIGHTS,
            interiors: BTreeMap::new(),
        }
    }

    /// Waves on the lattice of rough stresses, with lengths in any unit (m).
    pub fn rough(foundation: &Foundation, unit: f64) -> Self {
        Self {
            lattice: &ROUGH,
            weights: &ROUGH_WEIGHTS,
            ..Self::new(foundation, unit)
        }
    }

    pub fn foundation(&self) -> &Foundation {
        &self.foundation
    }

    /// Unit of lengths, m.
    pub fn unit(&self) -> f64 {
        self.unit
    }

    /// The amplitudes that `of` gives for each interior, with the factor of their wavenumber (in 1 over sides).
    pub fn sampled(
        &mut self,
        layout: Layout,
        of: impl Fn(&Interior) -> Option<Amplitudes>,
        factor: impl Fn(isize) -> f64,
    ) -> Result<Sampled, KernelError> {
        let lattice = self.lattice;
        let stride = lattice.radius_step();
        let [first, last] = layout.ends().map(|radius| index_of(radius.ln() / stride));
        let margin = lattice.margin();
        let radii = [first - margin + 1, last + margin];
        // ln k = ln x − ln r
        let lowest = lattice.first - lattice.radius_stride * radii[1];
        let every_from = lattice.fine_first - lattice.radius_stride * radii[1];
        let decayed = index_of((lattice.decayed / layout.reach()).ln() / lattice.step);
        let highest = (lattice.last - lattice.radius_stride * radii[0]).min(decayed);
        let coarse = (lowest..every_from).step_by(lattice.coarse_stride);
        self.solve(coarse.chain(every_from..=highest))?;
        let at = |index| self.interiors.get(&index).and_then(&of);
        Ok(Sampled {
            layout,
            lattice,
            weights: self.weights,
            radii,
            amplitudes: (lowest..=highest).map(at).collect(),
            factors: (lowest..=highest).map(factor).collect(),
        })
    }

    /// Solves for the waves with these indices that are still missing.
    fn solve(&mut self, indices: impl Iterator<Item = isize>) -> Result<(), KernelError> {
        let is_missing = |index: &isize| !self.interiors.contains_key(index);
        let missing: Vec<isize> = indices.filter(is_missing).collect();
        let interior = |index: isize| {
            let wavenumber = (index as f64 * self.lattice.step).exp() / self.unit;
            Ok((index, self.foundation.interior(wavenumber)?))
        };
        let found = missing.into_par_iter().map(interior);
        let found = found.collect::<Result<Vec<_>, KernelError>>()?;
        self.interiors.extend(found);
        Ok(())
    }
}

/// The largest integer not above a real number.
#[expect(
    clippy::cast_possible_truncation,
    reason = "logarithms of floating-point numbers over steps of 0.01 are below 1e5"
)]
fn index_of(place: f64) -> isize {
    place.floor() as isize
}

impl Sampled {
    /// Depth with which the waves decay, in sides of an element.
    pub fn reach(&self) -> f64 {
        self.layout.reach()
    }

    /// The functions of the radius under a load, each divided by `rⁿ` with the order n of its Bessel function: the
    /// integral of a unit force on each point of a unit square.
    pub fn panels<L: PointLoad<F>, const F: usize>(&self) -> RadialPanels<F> {
        let [first, last] = self.radii;
        let with_factor = self.amplitudes.iter().zip(&self.factors);
        let amplitudes: Vec<[f64; F]> = with_factor
            .map(|(amplitudes, factor)| {
                let values = amplitudes.as_ref().map_or([0.0; F], L::combined);
                values.map(|value| value * factor)
            })
            .collect();
        let weights_of = |weights: &Vec<HankelWeights>| -> Vec<[f64; F]> {
            weights
                .iter()
                .map(|weights| L::ORDERS.map(|order| weights[order]))
                .collect()
        };
        let (lattice, weights) = (self.lattice, self.weights);
        let (coarse, fine) = (weights_of(&weights.coarse), weights_of(&weights.fine));
        let stride = lattice.radius_step();
        let at_radius = |index: isize| -> [f64; F] {
            let from = (lattice.radius_stride * (last - index)).unsigned_abs();
            let to_fine = from + (lattice.fine_first - lattice.first).unsigned_abs();
            let mut sums = [0.0; F];
            let mut add = |weights: &[f64; F], values: &[f64; F]| {
                for ((sum, weight), value) in sums.iter_mut().zip(weights).zip(values) {
                    *sum += weight * value;
                }
            };
            let values = amplitudes.iter().skip(from).step_by(lattice.coarse_stride);
            coarse
                .iter()
                .zip(values)
                .for_each(|(weights, values)| add(weights, values));
            let values = amplitudes.iter().skip(to_fine);
            fine.iter()
                .zip(values)
                .for_each(|(weights, values)| add(weights, values));
            let r = (index as f64 * stride).exp();
            let mut orders = L::ORDERS.into_iter();
            sums.map(|sum| {
                let order = orders.next().unwrap_or_default();
                // r^{−2−n}
                sum / (TAU * (0..order).fold(r * r, |power, _| power * r))
            })
        };
        let table: Vec<[f64; F]> = (first..=last).into_par_iter().map(at_radius).collect();
        RadialPanels::new(&self.layout, |radius| {
            interpolated(&table, radius.ln() / stride - first as f64, lattice.stencil)
        })
    }
}

impl LogLattice {
    /// Step of `ln r`.
    fn radius_step(&self) -> f64 {
        self.radius_stride as f64 * self.step
    }

    /// Number of lattice radii on either side of an interpolated one.
    fn margin(&self) -> isize {
        (self.stencil / 2).cast_signed()
    }
}

/// The values at a position between those of a table, from this number of neighbours.
fn interpolated<const F: usize>(table: &[[f64; F]], place: f64, points: usize) -> [f64; F] {
    let first = (index_of(place) + 1).unsigned_abs() - points / 2;
    let weights = lagrange_weights(place - first as f64, points);
    let mut sums = [0.0; F];
    for (values, weight) in table[first..].iter().zip(&weights[..points]) {
        for (sum, value) in sums.iter_mut().zip(values) {
            *sum += weight * value;
        }
    }
    sums
}

/// The weights of the values at 0, 1, … in the polynomial through them, evaluated at t.
fn lagrange_weights(t: f64, points: usize) -> [f64; MOST_POINTS] {
    let mut weights = [1.0; MOST_POINTS];
    // w_j = Π_{m ≠ j} (t − m)/(j − m), with (j − m) from one side and (m − j) from the other
    let mut product = 1.0;
    for (j, weight) in weights[..points].iter_mut().enumerate() {
        *weight = product;
        product *= (t - j as f64) / (j + 1) as f64;
    }
    product = 1.0;
    for (j, weight) in weights[..points].iter_mut().enumerate().rev() {
        *weight *= product;
        product *= (j as f64 - t) / (points - j) as f64;
    }
    weights
}

#[cfg(test)]
mod tests {
    use pellicle_kernel::{Foundation, Material};

    use super::{Layout, MOST_POINTS, Waves, interpolated, lagrange_weights};

    #[test]
    fn further_depths_reuse_the_waves_of_the_first() {
        let [coating, base] = [5.0, 1.0].map(|modulus| Material::new(modulus, 0.3).unwrap());
        let foundation = Foundation::coated(3.0, coating, base).unwrap();
        let mut waves = Waves::new(&foundation, 0.5);
        let mut solved = |depth: f64| {
            let before = waves.interiors.len();
            let layout = Layout::new(depth / 0.5, [0.0, 700.0]);
            let at = |interior: &pellicle_kernel::Interior| {
                Some(interior.at(depth, pellicle_kernel::Side::Above))
            };
            waves.sampled(layout, at, |_| 1.0).unwrap();
            waves.interiors.len() - before
        };
        let first = solved(2.0);
        assert!((1000..3000).contains(&first), "{first}");
        assert_eq!(solved(2.0), 0);
        // At a greater depth no wave decays later, and the last panel ends within a tenth of the same radius.
        let second = solved(4.0);
        assert!(second < 20, "{second}");
    }

    #[test]
    fn polynomials_are_interpolated_exactly() {
        for t in [9.0, 9.3, 9.999] {
            let weights = lagrange_weights(t, MOST_POINTS);
            let value = |x: f64| ((x - 9.0) / 10.0).powi(7);
            let sum: f64 = weights
                .iter()
                .enumerate()
                .map(|(j, w)| w * value(j as f64))
                .sum();
            // Rounding of 20 weights of order 1.
            assert!((sum - value(t)).abs() < 1e-15, "{t}");
        }
        let table: Vec<[f64; 1]> = (0..2 * MOST_POINTS).map(|i| [i as f64]).collect();
        let found = interpolated(&table, 15.25, MOST_POINTS)[0];
        assert!((found - 15.25).abs() < 1e-13, "{found}");
    }
}
