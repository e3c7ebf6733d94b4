//! Hankel transforms of orders 0 to 3 on a lattice of the logarithms of wavenumber and radius.
//!
//! `∫₀^∞ A(k) J_n(k r) k dk = r⁻² ∫ A(x/r) x² J_n(x) d ln x`, and with `ln k` and `ln r` on one lattice every radius
//! uses the same values of A: only as many are computed as the lattice has points. The trapezoidal rule converges
//! exponentially for integrands that are analytic in `ln x`. As in [`crate::radial`]'s transforms, a smooth taper ends
//! the integral; its only cost is a component of A at the wavelength of the Bessel functions. Below x = 1, where
//! nothing oscillates, a second smooth taper hands over to a coarser step.

use std::sync::LazyLock;

/// Number of orders of the Bessel functions.
pub const ORDERS: usize = 4;

/// Step of `ln k` of the exact lattice. At the end of its taper it is a fifth of a period.
pub const STEP: f64 = 0.01;

/// Weights of the integrals `∫ A(x/r) x² J_n(x) d ln x`, n = 0 to 3.
pub type HankelWeights = [f64; ORDERS];

/// A lattice of `ln k` and `ln r`, and the rule for integrals on it.
#[derive(Debug)]
pub struct LogLattice {
    /// Step of `ln k`.
    pub step: f64,
    /// Step of `ln r`, in steps of `ln k`.
    pub radius_stride: isize,
    /// Number of points of the interpolation over `ln r`.
    pub stencil: usize,
    /// Amplitudes count as 0 where the wavenumber times the reach is above this value.
    pub decayed: f64,
    /// Step of `ln x` where nothing oscillates, in steps of `ln k`: the same as that of `ln r`, so that every radius
    /// uses the same amplitudes.
    pub coarse_stride: usize,
    /// Centre and width of the taper at the end, `½ erfc((x − c)/w)`.
    taper: [f64; 2],
    /// Centre and width of the taper between the steps, `½ erfc((ln x − c)/w)`.
    handover: [f64; 2],
    /// Lattice points of `ln x` at the beginning and at the end.
    pub first: isize,
    pub last: isize,
    /// Lattice points of `ln x` between which the second taper varies.
    pub fine_first: isize,
    coarse_last: isize,
}

/// The lattice of fields to 1e-11.
///
/// - The taper's Fourier transform is 4e-19 at wavenumber 1, and it ends at 2e-19.
/// - That of the taper between the steps is below 3e-18 at the coarse step's frequency, 2π/0.08; 6 of its widths lie on
///   either side of its centre.
/// - At the beginning `x² A` is below 1e-16 of the integral even for an A that grows like 1/k.
/// - Functions are analytic in `ln r` up to ±iπ/2, so that 20 points with steps of 0.08 leave 1e-13.
pub const EXACT: LogLattice = LogLattice {
    step: STEP,
    radius_stride: 8,
    stencil: 20,
    decayed: 60.0,
    coarse_stride: 8,
    taper: [82.0, 13.0],
    handover: [-1.6, 0.34],
    first: -3720,
    last: 510,
    fine_first: -364,
    coarse_last: 44,
};

/// The lattice of stresses to 2e-6: *measured* in [`super::rough`].
///
/// - The taper's Fourier transform is 1e-8 at wavenumber 1, and it ends at 5e-8.
/// - Nothing oscillates within a coarse step up to x = 2.
/// - At the beginning `x² A` is below 1e-6 of the integral even for an A that grows like 1/k.
/// - Twelve points with steps of 0.12 leave 3e-9.
pub const ROUGH: LogLattice = LogLattice {
    step: 0.04,
    radius_stride: 3,
    stencil: 12,
    decayed: 20.0,
    coarse_stride: 3,
    taper: [33.0, 8.6],
    handover: [0.0, 0.25],
    first: -357,
    last: 105,
    fine_first: -27,
    coarse_last: 27,
};

/// The weights of a lattice.
#[derive(Debug)]
pub struct LatticeWeights {
    /// At every [`coarse_stride`](LogLattice::coarse_stride)-th lattice point of `ln x` from the first.
    pub coarse: Vec<HankelWeights>,
    /// At every lattice point from [`fine_first`](LogLattice::fine_first) to the last.
    pub fine: Vec<HankelWeights>,
}

/// The weights of [`EXACT`].
pub static EXACT_WEIGHTS: LazyLock<LatticeWeights> = LazyLock::new(|| EXACT.weights());

/// The weights of [`ROUGH`].
pub static ROUGH_WEIGHTS: LazyLock<LatticeWeights> = LazyLock::new(|| ROUGH.weights());

impl LogLattice {
    fn weights(&self) -> LatticeWeights {
        let indices = (self.first..=self.coarse_last).step_by(self.coarse_stride);
        let width = self.coarse_stride as f64 * self.step;
        let coarse = indices.map(|index| self.weights_at(index, width * self.handover(index)));
        let indices = self.fine_first..=self.last;
        let fine =
            indices.map(|index| self.weights_at(index, self.step * (1.0 - self.handover(index))));
        LatticeWeights {
            coarse: coarse.collect(),
            fine: fine.collect(),
        }
    }

    fn handover(&self, index: isize) -> f64 {
        let [centre, width] = self.handover;
        libm::erfc((index as f64 * self.step - centre) / width) / 2.0
    }

    fn weights_at(&self, index: isize, width: f64) -> HankelWeights {
        let x = (index as f64 * self.step).exp();
        let [centre, taper_width] = self.taper;
        let taper = libm::erfc((x - centre) / taper_width) / 2.0;
        let common = width * x * x * taper;
        let bessel = [libm::j0(x), libm::j1(x), libm::jn(2, x), libm::jn(3, x)];
        bessel.map(|bessel| common * bessel)
    }
}

#[cfg(test)]
mod tests {
    use super::{EXACT, EXACT_WEIGHTS, LatticeWeights, LogLattice, ROUGH, ROUGH_WEIGHTS};

    /// `∫ e^{−k} J_n(k r) k dk` for n = 0 and 1: `1/ρ³` and `r/ρ³`, `ρ² = 1 + r²`.
    #[test]
    fn transforms_of_an_exponential_are_exact_to_the_accuracy_of_the_lattice() {
        // J_n is rounded to some 1e-16, times x² and the step up to 200, in a few hundred nodes; over r².
        assert_transforms(&EXACT, &EXACT_WEIGHTS, 1e-12);
        assert_transforms(&ROUGH, &ROUGH_WEIGHTS, 1e-6);
    }

    fn assert_transforms(lattice: &LogLattice, weights: &LatticeWeights, accuracy: f64) {
        for place in -20..=20 {
            let r = (0.35 * f64::from(place)).exp();
            let mut sums = [0.0; 4];
            let coarse = (lattice.first..).step_by(lattice.coarse_stride);
            let coarse = coarse.zip(weights.coarse.iter());
            for (node, weights) in coarse.chain((lattice.fine_first..).zip(weights.fine.iter())) {
                let k = (node as f64 * lattice.step).exp() / r;
                for (sum, weight) in sums.iter_mut().zip(weights) {
                    *sum += weight * (-k).exp() / (r * r);
                }
            }
            let rho = 1_f64.hypot(r);
            let expected = [1.0 / rho.powi(3), r / rho.powi(3)];
            let scale = 1.0_f64.min(1.0 / (r * r));
            for (found, expected) in sums.iter().zip(expected) {
                assert!(
                    (found - expected).abs() < accuracy * scale,
                    "{r}: {found:e}, {expected:e}"
                );
            }
            // J_2 = 2 J_1/x − J_0 and ∫ e^{−k} J_1 dk = (1 − 1/ρ)/r
            let second = 2.0 * (1.0 - 1.0 / rho) / (r * r) - expected[0];
            if r > 0.1 {
                assert!((sums[2] - second).abs() < 2.0 * accuracy * scale, "{r}");
            }
        }
    }
}
