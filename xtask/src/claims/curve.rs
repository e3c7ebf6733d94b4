//! A loading curve as the checks look at it.

use super::ClaimsError;

/// One point a load, in order of increasing force.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Curve {
    /// Force `Q`.
    pub(super) force: Vec<f64>,
    /// Penetration `D`.
    pub(super) penetration: Vec<f64>,
    /// Largest pressure.
    pub(super) max_pressure: Vec<f64>,
    /// Contact area.
    pub(super) contact_area: Vec<f64>,
    /// `∂D/∂Q`, the reciprocal of the contact stiffness that the program reports for each load.
    pub(super) gradient: Vec<f64>,
}

impl Curve {
    /// The curve, if it has at least three loads that increase, and as many numbers of each kind.
    ///
    /// # Errors
    /// [`ClaimsError::Curve`] if not.
    pub(super) fn checked(self) -> Result<Self, ClaimsError> {
        let points = self.force.len();
        let others = [
            &self.penetration,
            &self.max_pressure,
            &self.contact_area,
            &self.gradient,
        ];
        let complete = others.iter().all(|list| list.len() == points);
        let rising = self.force.windows(2).all(|pair| pair[0] < pair[1]);
        let positive = self
            .force
            .iter()
            .chain(&self.gradient)
            .all(|&x| x > 0.0 && x.is_finite());
        if points < 3 || !complete || !rising || !positive {
            return Err(ClaimsError::Curve { points });
        }
        Ok(self)
    }

    /// The largest force.
    pub(super) fn last_force(&self) -> f64 {
        self.force[self.force.len() - 1]
    }

    /// One of the curve's lists at a force between its first and last, on straight lines between the points.
    pub(super) fn at(&self, force: f64, list: &[f64]) -> f64 {
        let above = self
            .force
            .partition_point(|&q| q < force)
            .clamp(1, self.force.len() - 1);
        let [q0, q1] = [self.force[above - 1], self.force[above]];
        let [y0, y1] = [list[above - 1], list[above]];
        y0 + (y1 - y0) * (force - q0) / (q1 - q0)
    }
}
