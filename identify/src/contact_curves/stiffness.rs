//! The contact stiffness `S = dQ/dD` under a force, from the energy `E(Q)` whose derivative is the penetration:
//!
//! ```text
//! S = 1/E″        dS/dQ = −E‴ S²        ∂S/∂θ|_Q = −(∂E/∂θ)″ S²
//! ```

use super::solved_curve::SolvedCurve;

/// `S`, `dS/dQ` and each `∂S/∂θ` at a force.
pub struct StiffnessPoint {
    pub stiffness: f64,
    pub slope: f64,
    pub changes: Vec<f64>,
}

impl SolvedCurve {
    /// The stiffness at a positive force. Beyond the forces solved it follows the power law at the nearest.
    pub fn stiffness_at(&self, force: f64) -> StiffnessPoint {
        let inside = force.clamp(self.ends[0], self.ends[1]);
        let stiffness = 1.0 / self.energy.second_derivative(inside);
        let slope = -self.energy.third_derivative(inside) * stiffness * stiffness;
        let changes = self.changes.iter();
        let changes = changes.map(|of| -of.second_derivative(inside) * stiffness * stiffness);
        // S ∝ Q^n with n = Q S′/S
        let part = (force / inside).powf(inside * slope / stiffness);
        StiffnessPoint {
            stiffness: part * stiffness,
            slope: part * slope * inside / force,
            changes: changes.map(|change| part * change).collect(),
        }
    }
}
