//! The power law of an unloading, fitted with the machinery of all fits.
//!
//! `P = α (h − h_f)^m`, written for the depth at a force, with the largest force `P₁`, the depth `h₁` on the law there
//! and the slope `S = dP/dh` there as parameters, which are nearly uncorrelated:
//!
//! ```text
//! h = h₁ − d (1 − (P/P₁)^{1/m}),     d = h₁ − h_f = m P₁/S
//! ```

use crate::{
    Correlation, Curve, FitOptions, ForwardError, ForwardModel, Intervals, Noise, Prediction,
    Problem, Unknown, identify,
};

use super::{IndentationError, Uncertain};

/// The exponents of contacts: above 1, that of a flat punch, up to 2, that of a cone. G. M. Pharr and A. Bolshakov,
/// J. Mater. Res. 17, 2660 (2002), find 1.2 to 1.6.
pub(super) const EXPONENTS: [f64; 2] = [1.0, 2.0];
/// The exponents sought, beyond those: an exponent outside by more than its uncertainty is no contact's.
const SOUGHT: [f64; 2] = [0.5, 5.0];
/// An exponent is at a bound within this of it: no contact of an imprint is so nearly that of a flat punch.
const AT_BOUND: f64 = 1e-3;
/// So many standard deviations outside can be noise.
const DEVIATIONS: f64 = 3.0;
/// The slope is sought within this factor of that of a secant.
const REACH: f64 = 30.0;

/// The power law fitted to an unloading.
#[derive(Debug, Clone, PartialEq)]
pub struct UnloadingFit {
    /// The largest force, N.
    pub force: f64,
    /// `S`, the slope there, N/m.
    pub stiffness: f64,
    /// `m`.
    pub exponent: f64,
    /// `h₁`, the depth on the law there, m.
    pub depth: f64,
    /// Covariance of `S`, `m` and `h₁`.
    pub covariance: [[f64; 3]; 3],
    /// Standard deviation of a single depth about the law, m.
    pub noise: f64,
    /// How many neighbouring depths count as one.
    pub dependence: f64,
    /// Whether the exponent is at a bound, or held there because the noise has carried it beyond.
    pub is_at_bound: bool,
}

/// The law at the forces of an unloading.
struct PowerLaw<'a> {
    forces: &'a [f64],
    largest: f64,
}

impl ForwardModel for PowerLaw<'_> {
    fn predict(&self, parameters: &[f64]) -> Result<Prediction, ForwardError> {
        let [stiffness, exponent, depth] = parameters[..] else {
            return Err(ForwardError::Incomplete);
        };
        let mut found = Prediction {
            derivatives: vec![Vec::new(); 3],
            ..Prediction::default()
        };
        let span = exponent * self.largest / stiffness;
        for force in self.forces {
            let part = force / self.largest;
            // u = (P/P₁)^{1/m}: ∂u/∂m = −u ln(P/P₁)/m²
            let u = part.powf(1.0 / exponent);
            found.value.push(depth - span * (1.0 - u));
            found.slope.push(span * u / (exponent * force));
            let by_exponent = -self.largest / stiffness * (1.0 - u)
                - span * u * part.ln() / (exponent * exponent);
            let columns = [span / stiffness * (1.0 - u), by_exponent, 1.0];
            for (column, value) in found.derivatives.iter_mut().zip(columns) {
                column.push(value);
            }
        }
        Ok(found)
    }
}

impl UnloadingFit {
    /// Fits the law to depths (m) at forces (N), in the order measured, under a largest force.
    ///
    /// # Errors
    ///
    /// [`IndentationError::NoFit`] if it has no fit, [`IndentationError::ExponentAtBound`] if no contact has its
    /// exponent.
    pub(super) fn of(
        depths: &[f64],
        forces: &[f64],
        largest: f64,
    ) -> Result<Self, IndentationError> {
        let [least, most] = EXPONENTS;
        let found = Self::within(SOUGHT, depths, forces, largest)?;
        let reach = DEVIATIONS * found.covariance[1][1].sqrt();
        let bound = found.exponent.clamp(least, most);
        if (found.exponent - bound).abs() > reach {
            let found = found.exponent;
            return Err(IndentationError::ExponentAtBound { found, bound });
        }
        if (least..most).contains(&found.exponent) {
            let is_at_bound = found.exponent < least + AT_BOUND;
            return Ok(Self {
                is_at_bound,
                ..found
            });
        }
        let at_bound = Self::within([least, most], depths, forces, largest)?;
        Ok(Self {
            is_at_bound: true,
            ..at_bound
        })
    }

    /// Fits the law with an exponent in a range, to points from the deepest on.
    pub(super) fn within(
        range: [f64; 2],
        depths: &[f64],
        forces: &[f64],
        largest: f64,
    ) -> Result<Self, IndentationError> {
        let failed = |error: &dyn std::fmt::Display| IndentationError::NoFit {
            reason: error.to_string(),
        };
        let last = depths.len() - 1;
        let secant = (forces[0] - forces[last]) / (depths[0] - depths[last]);
        if !(secant > 0.0 && secant.is_finite()) {
            return Err(failed(
                &"with drift and frame taken out the depth does not fall with the force: are both right?",
            ));
        }
        let length = depths[0] - depths[last];
        let [low, high] = [-REACH, REACH].map(|reach| depths[0] + reach * length);
        let unknowns = [
            Unknown::positive("S", [secant / REACH, secant * REACH])
                .and_then(|of| of.starting_at(1.3 * secant)),
            Unknown::positive("m", range).and_then(|of| of.starting_at(1.4)),
            Unknown::signed("h", [low, high]).and_then(|of| of.starting_at(depths[0])),
        ];
        let unknowns = unknowns.into_iter().collect::<Result<Vec<_>, _>>();
        let unknowns = unknowns.map_err(|error| failed(&error))?;
        let noise = Noise {
            correlation: Correlation::Estimated,
            ..Noise::default()
        };
        let curve = Curve::new(forces.to_vec(), depths.to_vec());
        let problem = curve.and_then(|curve| Problem::new(vec![curve], unknowns, &[], noise));
        let problem = problem.map_err(|error| failed(&error))?;
        let options = FitOptions {
            intervals: Intervals::Wald,
            starts: 1,
            ..FitOptions::default()
        };
        let model = PowerLaw { forces, largest };
        let fit = identify(&model, &problem, &options).map_err(|error| failed(&error))?;
        let [stiffness, exponent, depth] = [0, 1, 2].map(|k| fit.estimates[k].value);
        // The coordinates are ln S, ln m and 4h/(high − low).
        let scale = [stiffness, exponent, (high - low) / 4.0];
        let entry = |i: usize, j: usize| {
            let found = fit.covariance[i][j] * scale[i] * scale[j];
            if found.is_finite() { found } else { 0.0 }
        };
        Ok(Self {
            force: largest,
            stiffness,
            exponent,
            depth,
            covariance: [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j))),
            noise: fit.noise.observed,
            dependence: fit.noise.dependence(),
            is_at_bound: false,
        })
    }

    /// The depth (m) at which the law has no force.
    #[must_use]
    pub fn final_depth(&self) -> f64 {
        self.depth - self.exponent * self.force / self.stiffness
    }

    /// The depth (m) at which the law has no force, with its standard uncertainty.
    pub(super) fn without_force(&self) -> Uncertain {
        let span = self.force / self.stiffness;
        // h₁ − m P₁/S by S, m and h₁
        let slopes = [self.exponent * span / self.stiffness, -span, 1.0];
        let rows = self.covariance.iter().zip(slopes);
        let variance: f64 = rows
            .flat_map(|(row, a)| row.iter().zip(slopes).map(move |(c, b)| a * c * b))
            .sum();
        Uncertain {
            value: self.final_depth(),
            sd: variance.max(0.0).sqrt(),
        }
    }

    /// The force (N) of the law at a depth (m).
    #[must_use]
    pub fn force_at(&self, depth: f64) -> f64 {
        let part = (depth - self.final_depth()) * self.stiffness / (self.exponent * self.force);
        self.force * part.max(0.0).powf(self.exponent)
    }
}
