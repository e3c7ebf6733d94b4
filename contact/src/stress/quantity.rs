//! The quantities whose extremes are looked for, each so that its largest value is wanted.

use pellicle_influence::SubsurfaceState;

/// A quantity at a point of a body or an interface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Quantity {
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

/// In a body.
pub const OF_BODIES: [Quantity; 4] = [
    Quantity::VonMises,
    Quantity::MaxPrincipal,
    Quantity::MinPrincipal,
    Quantity::MaxShear,
];

/// On an interface.
pub const OF_INTERFACES: [Quantity; 3] = [
    Quantity::ShearTraction,
    Quantity::Tension,
    Quantity::Compression,
];

impl Quantity {
    /// Its value, in Pa.
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

    /// A value that it does not exceed, without principal stresses.
    pub fn bound(self, state: &SubsurfaceState) -> f64 {
        match self {
            // Principal stresses lie within ⅔ of von Mises' stress of their mean, and within 2/√3 of it of one another.
            Self::MaxPrincipal => state.hydrostatic() + 2.0 / 3.0 * state.von_mises(),
            Self::MinPrincipal => -state.hydrostatic() + 2.0 / 3.0 * state.von_mises(),
            Self::MaxShear => state.von_mises() / 3.0_f64.sqrt(),
            Self::VonMises | Self::ShearTraction | Self::Tension | Self::Compression => {
                self.of(state)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_quantity_exceeds_its_bound_and_some_stress_reaches_each() {
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
                quantity.bound(&state) - quantity.of(&state)
            });
            let least = slack.into_iter().fold(f64::INFINITY, f64::min);
            assert!(least.abs() < 1e-14, "{quantity:?}: {slack:?}");
        }
    }
}
