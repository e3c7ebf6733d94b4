//! Hankel transforms of orders 0 to 3 on a lattice of the logarithms of wavenumber and radius.
//!
//! `∫₀^∞ A(k) J_n(k r) k dk = r⁻² ∫ A(x/r) x² J_n(x) d ln x`, and with `ln k` and `ln r` on one lattice every radius
//! uses the same values of A: only as many are computed as the lattice has points. The trapezoidal rule converges
//! exponentially for integrands that are analytic in `ln x`. As in [`crate::radial`]'s transforms, a smooth taper ends
//! the integral; its only cost is a component of A at the wavelength of the Bessel functions. Below x = 1, where
//! nothing oscillates, a second smooth taper hands over to a coarser step.

use std::sync::LazyLock;

/// Step of `ln k`. At the end of the taper it is a fifth of a period.
pub const STEP: f64 = 0.01;

/// Step of `ln r`, in steps of `ln k`.
pub const RADIUS_STRIDE: isize = 8;

/// Step of `ln x` where nothing oscillates, in steps of `ln k`: the same as that of `ln r`, so that every radius
/// uses the same amplitudes.
pub const COARSE_STRIDE: usize = 8;

/// Number of orders of the Bessel functions.
pub const ORDERS: usize = 4;

/// The taper at the end: `½ erfc((x − 82)/13)`, whose Fourier transform is 4e-19 at wavenumber 1.
const TAPER: [f64; 2] = [82.0, 13.0];

/// Lattice point of `ln x` at which the taper is 2e-19.
pub const LAST: isize = 510;

/// The taper between the steps: `½ erfc((ln x + 1.6)/0.34)`. Its Fourier transform is below 3e-18 at the coarse
/// step's frequency, 2π/0.08.
const HANDOVER: [f64; 2] = [-1.6, 0.34];

/// Lattice points of `ln x` between which the second taper varies: 6 of its widths to either side.
pub const FINE_FIRST: isize = -364;
const COARSE_LAST: isize = 44;

/// Lattice point of `ln x` below which `x² A` is below 1e-16 of the integral even for an A that grows like 1/k.
pub const FIRST: isize = -3720;

/// Weights of the integrals `∫ A(x/r) x² J_n(x) d ln x`, n = 0 to 3.
pub type HankelWeights = [f64; ORDERS];

/// Weights at every [`COARSE_STRIDE`]-th lattice point of `ln x` from [`FIRST`].
pub static COARSE: LazyLock<Vec<HankelWeights>> = LazyLock::new(|| {
    let indices = (FIRST..=COARSE_LAST).step_by(COARSE_STRIDE);
    let width = COARSE_STRIDE as f64 * STEP;
    indices
        .map(|index| weights(index, width * handover(index)))
        .collect()
});

/// Weights at every lattice point of `ln x` from [`FINE_FIRST`] to [`LAST`].
pub static FINE: LazyLock<Vec<HankelWeights>> = LazyLock::new(|| {
    let indices = FINE_FIRST..=LAST;
    indices
        .map(|index| weights(index, STEP * (1.0 - handover(index))))
        .collect()
});

fn handover(index: isize) -> f64 {
    let [centre, width] = HANDOVER;
    libm::erfc((index as f64 * STEP - centre) / width) / 2.0
}

fn weights(index: isize, width: f64) -> HankelWeights {
    let x = (index as f64 * STEP).exp();
    let [centre, taper_width] = TAPER;
    let taper = libm::erfc((x - centre) / taper_width) / 2.0;
    let common = width * x * x * taper;
    let bessel = [libm::j0(x), libm::j1(x), libm::jn(2, x), libm::jn(3, x)];
    bessel.map(|bessel| common * bessel)
}

#[cfg(test)]
mod tests {
    use super::{COARSE, COARSE_STRIDE, FINE, FINE_FIRST, FIRST, STEP};

    /// `∫ e^{−k} J_n(k r) k dk` for n = 0 and 1: `1/ρ³` and `r/ρ³`, `ρ² = 1 + r²`.
    #[test]
    fn transforms_of_an_exponential_are_exact_to_rounding() {
        for index in (-700..=700).step_by(35) {
            let r = (index as f64 * STEP).exp();
            let mut sums = [0.0; 4];
            let coarse = (FIRST..).step_by(COARSE_STRIDE).zip(COARSE.iter());
            for (node, weights) in coarse.chain((FINE_FIRST..).zip(FINE.iter())) {
                let k = ((node - index) as f64 * STEP).exp();
                for (sum, weight) in sums.iter_mut().zip(weights) {
                    *sum += weight * (-k).exp() / (r * r);
                }
            }
            let rho = 1_f64.hypot(r);
            let expected = [1.0 / rho.powi(3), r / rho.powi(3)];
            // J_n is rounded to some 1e-16, times x² and the step up to 200, in a few hundred nodes; over r².
            let scale = 1.0_f64.min(1.0 / (r * r));
            for (found, expected) in sums.iter().zip(expected) {
                assert!(
                    (found - expected).abs() < 1e-12 * scale,
                    "{r}: {found:e}, {expected:e}"
                );
            }
            // J_2 = 2 J_1/x − J_0 and ∫ e^{−k} J_1 dk = (1 − 1/ρ)/r
            let second = 2.0 * (1.0 - 1.0 / rho) / (r * r) - expected[0];
            if r > 0.1 {
                assert!((sums[2] - second).abs() < 2e-12 * scale, "{r}");
            }
        }
    }
}
