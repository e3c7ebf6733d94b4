//! The quantities whose extremes are searched for, each with its sign chosen so that the largest value is wanted.

use pellicle_influence::SubsurfaceState;
use serde::{Serialize, Serializer};

/// A quantity at a point of a body or an interface, whose largest value is sought.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum StressQuantity {
    /// Von Mises' stress.
    VonMises,
    /// The largest principal stress.
    MaxPrincipal,
    /// Minus the least principal stress.
    MinPrincipal,
    /// Tresca's largest shear.
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
    /// All quantities by the names of their extremes in results: those of bodies, then those of interfaces.
    pub const NAMES: [(&'static str, Self); 7] = [
        ("max_von_mises", Self::VonMises),
        ("max_principal", Self::MaxPrincipal),
        ("min_principal", Self::MinPrincipal),
        ("max_shear", Self::MaxShear),
        ("max_shear_traction", Self::ShearTraction),
        ("max_tension", Self::Tension),
        ("max_compression", Self::Compression),
    ];

    /// The name of its extreme in results.
    #[must_use]
    pub fn name(self) -> &'static str {
        let mut names = Self::NAMES.iter();
        let named = names.find(|(_, quantity)| *quantity == self);
        named.map_or("", |(name, _)| name)
    }

    /// The value of the quantity, in Pa.
    pub(super) fn of(self, state: &SubsurfaceState) -> f64 {
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
    pub(super) fn roughly(self, state: &SubsurfaceState) -> f64 {
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
    pub(super) fn bound(self) -> Option<[f64; 2]> {
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

impl Serialize for StressQuantity {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
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
