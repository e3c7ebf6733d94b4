//! What the steps of a piecewise constant traction take from the stresses under element centres.
//!
//! A traction along x that is constant on elements of side h has, besides each wave of wavenumber k, waves of
//! k + 2πm/h, whose amplitudes are `(−1)^m k h/(2πm)` to first order. A stress whose symbol is even in k gets as much
//! from m as from −m with the other sign; one whose symbol is odd loses, under the centres,
//!
//! ```text
//! (h/π) ∂q/∂x Σ (−1)^{m+1} A(2πm z/h)/m
//! ```
//!
//! with A e^{−kz} the wave's stress in a half-space: `2 − kz` for `σ_xx`, `2ν` for `σ_yy`, `kz` for `σ_zz`, and 1
//! for `σ_xy`, where the derivative is along y. On the surface `σ_xx` loses `(2 ln 2/π) h ∂q/∂x`: some percent many
//! elements inside a contact. The sums are `Σ (−1)^{m+1} xᵐ/m = ln(1 + x)` and `Σ (−1)^{m+1} xᵐ = x/(1 + x)` with `x =
//! e^{−2πz/h}`.
//!
//! Central differences of the traction give it back to second order, as a part of the field of each element at the two
//! centres beside it. It falls by 500 with each element of depth, so that nothing jumps where it is left out. Only the
//! search for extremes adds it: the fields of planes and points are those of the steps themselves.

use std::f64::consts::{PI, TAU};

use pellicle_kernel::Foundation;

use super::depth::Depth;

/// Depth, in sides of an element, from which the loss is below 2e-6 of `h ∂q/∂x`.
const DEEPEST: f64 = 2.0;

/// The part of the stresses of an element under a unit traction along x that its steps take from the centre one element
/// farther along x (`σ_xx`, `σ_yy`, `σ_zz`) and along y (`σ_xy`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TractionSteps {
    pub along_x: [f64; 3],
    pub along_y: f64,
}

impl TractionSteps {
    /// In a body at a depth, for elements of side `element_side` (m); none where nothing is lost or the
    /// depth is below the top layer.
    pub fn of(foundation: &Foundation, depth: Depth, element_side: f64) -> Option<Self> {
        let top = foundation.layers().first();
        let is_in_top = top.is_none_or(|top| depth.is_above(top.thickness()));
        let poisson_ratio = foundation.surface_material().poisson_ratio();
        Self::at(depth.z / element_side, poisson_ratio).filter(|_| is_in_top)
    }

    /// At a depth in sides of an element, in a body of this Poisson's ratio; none at depths where nothing is lost.
    fn at(depth: f64, poisson_ratio: f64) -> Option<Self> {
        if depth >= DEEPEST {
            return None;
        }
        let x = (-TAU * depth).exp();
        let [plain, with_depth] = [x.ln_1p(), TAU * depth * x / (1.0 + x)];
        // The element's traction counts with ∓½ in the central difference at the centres beside it.
        let lost = |sum: f64| -0.5 * sum / PI;
        Some(Self {
            along_x: [
                lost(2.0 * plain - with_depth),
                lost(2.0 * poisson_ratio * plain),
                lost(with_depth),
            ],
            along_y: lost(plain),
        })
    }
}

#[cfg(test)]
mod tests {
    use pellicle_kernel::Material;

    use super::*;
    use crate::CentreStresses;

    #[test]
    fn half_of_two_ln_two_over_pi_is_lost_on_the_surface_and_nothing_two_elements_below() {
        let steps = TractionSteps::at(0.0, 0.3).unwrap();
        let ln_2 = 2.0_f64.ln();
        let wanted = [-ln_2 / PI, -0.3 * ln_2 / PI, 0.0];
        for (found, wanted) in steps.along_x.iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-15);
        }
        assert!((steps.along_y + 0.5 * ln_2 / PI).abs() < 1e-15);
        let deep = TractionSteps::at(1.999, 0.3).unwrap();
        assert!(deep.along_x.iter().all(|lost| lost.abs() < 2e-5));
        assert_eq!(TractionSteps::at(2.0, 0.3), None);
    }

    /// Tractions of one wave on a half-space of ν = 0.3 are compared with the wave's own stresses, `σ_xx =
    /// (2 − kz) e^{−kz}`, `σ_yy = 2ν e^{−kz}` and `σ_zz = kz e^{−kz}`, all times −sin kx for q = cos kx.
    #[test]
    fn under_a_wave_of_traction_stresses_under_centres_are_second_order() {
        let body = Foundation::half_space(Material::new(1.0, 0.3).unwrap());
        for depth in [0.0, 0.1, 0.3, 0.7, 1.4] {
            let errors = [12, 24].map(|wave: usize| {
                let size = 8 * wave;
                let k = TAU / wave as f64;
                let middle = size as f64 / 2.0;
                // The wave fades towards the ends of a strip along y.
                let fade = |x: f64| (-(3.2 * (x - middle) / middle).powi(2)).exp();
                let q = |x: f64| (1.0 + (k * (x - middle)).sin()) * fade(x);
                let pressure: Vec<f64> = (0..size * size).map(|e| q((e / size) as f64)).collect();
                let mut stresses = CentreStresses::new(&body, 1.0, size, [1.0, 0.0]);
                stresses.move_to(Depth::below(depth)).unwrap();
                let place = [(size / 2).cast_signed(); 2];
                let all = stresses.at(&pressure, size, place);
                let mut pressed = CentreStresses::new(&body, 1.0, size, [0.0; 2]);
                pressed.move_to(Depth::below(depth)).unwrap();
                let normal = pressed.at(&pressure, size, place);
                let found = [0, 1, 2].map(|i: usize| all.stress[i] - normal.stress[i]);
                // q rises as sin k(x − x₀): the wave's stress at its zero is +A e^{−kz}.
                let kz = k * depth;
                let wave = [2.0 - kz, 0.6, kz].map(|a| a * (-kz).exp());
                [0, 1, 2].map(|i: usize| found[i] - wave[i])
            });
            // Second order: (kh)²/7 for waves of 12 and 24 elements, where the steps alone lose 0.44 kh.
            for (coarse, fine) in errors[0].iter().zip(errors[1]) {
                assert!(
                    coarse.abs() < 0.039 && fine.abs() < 0.0098,
                    "{depth}: {errors:?}"
                );
            }
        }
    }
}
