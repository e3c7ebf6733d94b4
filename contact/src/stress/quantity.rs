//! The quantities whose extremes are searched for, each with its sign chosen so that the largest value is wanted.

use pellicle_influence::SubsurfaceState;

/// A quantity at a point of a body or an interface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum StressQuantity {
    VonMises,
    MaxPrincipal,
    /// Minus the least principal stress.
    MinPrincipal,
    MaxShear,
    /// `τ = |(σ_xz, σ_yz)|`.
    ShearTraction,
    /// `σ_zz`.
    Tension,
    /// `−σ_zz`.
    Compression,
}

/// The quantities in a body.
pub const OF_BODIES: [StressQuantity; 4] = [
    StressQuantity::VonMises,
    StressQuantity::MaxPrincipal,
    StressQuantity::MinPrincipal,
    StressQuantity::MaxShear,
];

/// The quantities on an interface.
pub const OF_INTERFACES: [StressQuantity; 3] = [
    StressQuantity::ShearTraction,
    StressQuantity::Tension,
    StressQuantity::Compression,
];

impl StressQuantity {
    /// The value of the quantity, in Pa.
    pub fn of(self, state: &SubsurfaceState) -> f64 {
        let [_, _, zz, _, xz, yz] = state.stress;
        match self {
            Self::VonMises => state.von_mises(),
            Self::MaxPrincipal => state.principal()[0],
            Self::MinPrincipal => -state.principal()[2],
            Self::MaxShear => state.max_shear(),
            Self::ShearTraction => xz.hypot(yz),
            Self::Tension => zz,
            Self::Compression => -zz,
        }
    }

    /// The value to 1e-7 of von Mises' stress, in a third of the time.
    pub fn roughly(self, state: &SubsurfaceState) -> f64 {
        match self {
            Self::MaxPrincipal => outer_principal(state)[0],
            Self::MinPrincipal => -outer_principal(state)[1],
            Self::MaxShear => {
                let [largest, least] = outer_principal(state);
                (largest - least) / 2.0
            }
            Self::VonMises | Self::ShearTraction | Self::Tension | Self::Compression => {
                self.of(state)
            }
        }
    }

    /// Factors of the mean stress and of von Mises' stress whose sum bounds the value from above; none if the value
    /// itself costs no more.
    pub fn bound(self) -> Option<[f64; 2]> {
        match self {
            // Principal stresses differ from their mean by at most ⅔ of von Mises' stress, and from one another by at
            // most 2/√3 of it.
            Self::MaxPrincipal => Some([1.0, 2.0 / 3.0]),
            Self::MinPrincipal => Some([-1.0, 2.0 / 3.0]),
            Self::MaxShear => Some([0.0, 1.0 / 3.0_f64.sqrt()]),
            Self::VonMises => Some([0.0, 1.0]),
            Self::ShearTraction | Self::Tension | Self::Compression => None,
        }
    }
}

/// The largest and the least principal stress by the cubic formula, which loses half of the digits where two of the
/// three nearly coincide.
fn outer_principal(state: &SubsurfaceState) -> [f64; 2] {
    let mean = state.hydrostatic();
    let [xx, yy, zz, xy, xz, yz] = state.stress;
    let [xx, yy, zz] = [xx, yy, zz].map(|stress| stress - mean);
    let determinant =
        xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
    let mises = state.von_mises();
    if mises <= 0.0 {
        return [mean; 2];
    }
    // σ = σ_m + ⅔ σ_v cos θ,  cos 3θ = 27/2 det(s)/σ_v³
    let cosine = (13.5 * determinant / mises.powi(3)).clamp(-1.0, 1.0);
    let angle = cosine.acos() / 3.0;
    let radius = 2.0 / 3.0 * mises;
    [angle, angle + std::f64::consts::TAU / 3.0].map(|angle| mean + radius * angle.cos())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_are_attained_and_never_exceeded_and_rough_values_agree() {
        let stresses = [
            [1.0, -2.0, 0.5, 3.0, -1.0, 2.0],
            [-4.0, -4.0, -5.0, 0.1, 0.0, 1.0],
            [2.0, -1.0, -1.0, 0.0, 0.0, 0.0],
            [-2.0, 1.0, 1.0, 0.0, 0.0, 0.0],
            [1.0, 0.0, -1.0, 0.0, 0.0, 0.0],
        ];
        for quantity in OF_BODIES.into_iter().chain(OF_INTERFACES) {
            let slack = stresses.map(|stress| {
                let state = SubsurfaceState {
                    displacement: [0.0; 3],
                    stress,
                };
                let [of_mean, of_mises] = quantity.bound()?;
                let bound = of_mean * state.hydrostatic() + of_mises * state.von_mises();
                Some(bound - quantity.of(&state))
            });
            for stress in stresses {
                let state = SubsurfaceState {
                    displacement: [0.0; 3],
                    stress,
                };
                let error = quantity.roughly(&state) - quantity.of(&state);
                assert!(
                    error.abs() < 1e-7 * state.von_mises(),
                    "{quantity:?}: {error}"
                );
            }
            if quantity.bound().is_some() {
                let least = slack.into_iter().flatten().fold(f64::INFINITY, f64::min);
                assert!(least.abs() < 1e-14, "{quantity:?}: {slack:?}");
            }
        }
    }
}
