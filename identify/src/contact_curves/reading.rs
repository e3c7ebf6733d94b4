//! How the quantities that an instrument reads follow from the penetration under a force.

use pellicle_contact::ContactError;

use super::curve::Observable;
use super::solved_curve::{CurvePoint, SolvedCurve};
use super::stiffness::StiffnessPoint;
use crate::Prediction;

/// Limit on Newton steps for the force at a depth. The problem is convex in logarithms, so a few suffice.
const MOST_STEPS: usize = 60;
/// Relative accuracy of that force.
const ACCURACY: f64 = 1e-13;

impl Observable {
    /// The observable at given abscissae of a solved curve with a compliance in series, m/N.
    pub(super) fn of(
        self,
        curve: &SolvedCurve,
        abscissae: &[f64],
        series: f64,
    ) -> Result<Prediction, ContactError> {
        let mut prediction = Prediction {
            value: Vec::new(),
            slope: Vec::new(),
            derivatives: Vec::new(),
            origins: Vec::new(),
        };
        for abscissa in abscissae {
            let (value, slope, changes) = self.at(curve, *abscissa, series)?;
            prediction.value.push(value);
            prediction.slope.push(slope);
            prediction.derivatives.resize(changes.len(), Vec::new());
            for (column, change) in prediction.derivatives.iter_mut().zip(changes) {
                column.push(change);
            }
        }
        Ok(prediction)
    }

    fn at(
        self,
        curve: &SolvedCurve,
        abscissa: f64,
        series: f64,
    ) -> Result<(f64, f64, Vec<f64>), ContactError> {
        match self {
            Self::DepthAtForce => {
                let CurvePoint {
                    penetration,
                    slope,
                    changes,
                } = curve.at(abscissa);
                Ok((penetration, slope + series, changes))
            }
            Self::ForceAtDepth if abscissa <= 0.0 => {
                // No force before the contact, whatever the parameters.
                let changes = curve.at(0.0).changes.len();
                Ok((0.0, 0.0, vec![0.0; changes]))
            }
            Self::ForceAtDepth => {
                let (force, point) = force_at(curve, abscissa, series)?;
                // z = D + c Q: dQ/dz = 1/(dD/dQ + c), ∂Q/∂θ|_z = −(dQ/dz) ∂D/∂θ|_Q
                let slope = 1.0 / (point.slope + series);
                let changes = point.changes.iter().map(|change| -change * slope);
                Ok((force, slope, changes.collect()))
            }
            Self::StiffnessAtContactRadius | Self::UnloadingStiffness => {
                let force = force_at_radius(curve, abscissa)?;
                let [_, rate] = curve.radius(force);
                let at = curve.stiffness_at(force);
                // dS/da = (dS/dQ)/(da/dQ)
                Ok((at.stiffness, at.slope / rate, Vec::new()))
            }
            // No contact, whatever the parameters.
            Self::StiffnessAtForce | Self::StiffnessAtDepth if abscissa <= 0.0 => {
                Ok((0.0, 0.0, vec![0.0; curve.at(0.0).changes.len()]))
            }
            Self::StiffnessAtForce => {
                let StiffnessPoint {
                    stiffness,
                    slope,
                    changes,
                } = curve.stiffness_at(abscissa);
                Ok((stiffness, slope, changes))
            }
            Self::StiffnessAtDepth => {
                let (force, point) = force_at(curve, abscissa, 0.0)?;
                let at = curve.stiffness_at(force);
                // dS/dD = S dS/dQ, and with ∂Q/∂θ|_D = −S ∂D/∂θ|_Q: ∂S/∂θ|_D = ∂S/∂θ|_Q − dS/dD ∂D/∂θ|_Q
                let by_depth = at.slope * at.stiffness;
                let pairs = at.changes.iter().zip(&point.changes);
                let changes = pairs.map(|(at_force, depth)| at_force - by_depth * depth);
                Ok((at.stiffness, by_depth, changes.collect()))
            }
        }
    }
}

/// Returns the force that gives a contact radius, by Newton's method in logarithms.
fn force_at_radius(curve: &SolvedCurve, radius: f64) -> Result<f64, ContactError> {
    let [least, most] = curve.ends();
    let mut force = most;
    for _ in 0..MOST_STEPS {
        let [found, rate] = curve.radius(force);
        let change = (radius / found).ln() * found / (force * rate);
        // A radius below that of the smallest force solved.
        if force <= least && change < 0.0 {
            return Ok(least);
        }
        force = (force * change.exp()).clamp(least, most);
        if change.abs() <= ACCURACY.sqrt() {
            return Ok(force);
        }
    }
    Err(ContactError::Force { force })
}

/// Returns the force that gives an approach, the penetration and what a compliance in series adds, by Newton's method
/// in logarithms.
fn force_at(
    curve: &SolvedCurve,
    approach: f64,
    series: f64,
) -> Result<(f64, CurvePoint), ContactError> {
    let [_, mut force] = curve.ends();
    for _ in 0..MOST_STEPS {
        let point = curve.at(force);
        let (found, slope) = (point.penetration + series * force, point.slope + series);
        // ln Q ← ln Q − (ln z(Q) − ln z)/(Q z′/z)
        let change = (approach / found).ln() * found / (force * slope);
        force *= change.exp();
        if change.abs() <= ACCURACY {
            return Ok((force, curve.at(force)));
        }
    }
    Err(ContactError::Penetration {
        penetration: approach,
    })
}
