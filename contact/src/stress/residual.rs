//! Residual stress: what layers carry without any load, such as a coating deposited hot or bombarded with ions.

use pellicle_influence::{Depth, SubsurfaceState};

/// The equibiaxial residual stress of each body, `σ_xx = σ_yy = σ_r` and nothing else, tension positive.
///
/// It adds to the stresses under the load, since the equations are linear. It is uniform along the surface, so it loads
/// no interface away from the coating's ends and moves no surface: contact and tractions do not change.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ResidualStress {
    /// Depth of the bottom (m) and stress (Pa) of each body, from the surface down.
    bodies: Vec<(f64, f64)>,
}

impl ResidualStress {
    /// The stresses (Pa) of bodies from the surface down, each with the depth (m) of its bottom. Below the last of them
    /// there is none.
    #[must_use]
    pub fn new(bodies: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let bodies: Vec<_> = bodies.into_iter().collect();
        let is_any = bodies.iter().any(|(_, stress)| *stress != 0.0);
        Self {
            bodies: if is_any { bodies } else { Vec::new() },
        }
    }

    /// The stress `σ_r` at a depth, Pa.
    #[must_use]
    pub fn at(&self, depth: Depth) -> f64 {
        let mut bodies = self.bodies.iter();
        let own = bodies.find(|(bottom, _)| depth.is_above(*bottom));
        own.map_or(0.0, |(_, stress)| *stress)
    }

    /// Whether no body has any.
    #[must_use]
    pub fn is_none(&self) -> bool {
        self.bodies.is_empty()
    }

    /// The state at a depth without a load.
    #[must_use]
    pub fn state(&self, depth: Depth) -> SubsurfaceState {
        self.added(SubsurfaceState::default(), depth)
    }

    /// A state under a load at a depth, with the residual stress.
    pub(super) fn added(&self, mut state: SubsurfaceState, depth: Depth) -> SubsurfaceState {
        if !self.is_none() {
            let own = self.at(depth);
            let [xx, yy, ..] = &mut state.stress;
            *xx += own;
            *yy += own;
        }
        state
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_side_of_an_interface_has_the_stress_of_its_body() {
        let residual = ResidualStress::new([(1.0, -2.0), (3.0, 0.5)]);
        let found = [
            Depth::below(0.0),
            Depth::above(1.0),
            Depth::below(1.0),
            Depth::above(3.0),
            Depth::below(3.0),
            Depth::below(9.0),
        ]
        .map(|depth| residual.at(depth));
        assert_eq!(found, [-2.0, -2.0, 0.5, 0.5, 0.0, 0.0]);
        assert!(ResidualStress::new([(1.0, 0.0)]).is_none() && !residual.is_none());
    }

    #[test]
    fn principal_stresses_are_shifted_and_von_mises_stress_follows() {
        // On an axis: σ_xx = σ_yy = s and σ_zz.
        let (s, zz, own) = (-0.3, -1.0, -2.0);
        let state = SubsurfaceState {
            stress: [s, s, zz, 0.0, 0.0, 0.0],
            ..SubsurfaceState::default()
        };
        let found = ResidualStress::new([(1.0, own)]).added(state, Depth::below(0.5));
        assert_eq!(found.principal(), [zz, s + own, s + own]);
        // |σ_zz − σ_xx|
        assert!((found.von_mises() - (s + own - zz).abs()).abs() < 1e-15);
    }
}
