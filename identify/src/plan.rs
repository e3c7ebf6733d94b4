//! The expected accuracy of a measurement, before it is made.
//!
//! At the true parameters, the information of a measurement is `JᵀJ` of its whitened derivatives, with the nuisances of
//! each curve eliminated. The information of several measurements adds up, a prior is one more row, and the inverse of
//! the sum is the (Wald) covariance that a fit will have.

mod information;

pub use information::Information;

use crate::{
    Curve, ForwardError, IdentifyError, KnownCombination, LinearNuisance, NoiseLevels,
    NullDirections, Prediction, Role, Unknown, Verdict,
    curve::check_length,
    distribution::student_quantile,
    known_combination::expression,
    null_direction::{Hold, NullSpace},
    orthonormal_basis::OrthonormalBasis,
    verdict,
};

/// The assumptions of a plan.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The unknowns to be sought.
    pub unknowns: Vec<Unknown>,
    /// The true values of the unknowns.
    pub truth: Vec<f64>,
    /// Linear nuisances; those common to all curves are common to all measurements.
    pub nuisances: Vec<LinearNuisance>,
    /// The noise of every point.
    pub noise: NoiseLevels,
}

/// The expected estimate of an unknown.
#[derive(Debug, Clone, PartialEq)]
pub struct Expected {
    /// Its name.
    pub name: String,
    /// Whether it is an answer or a nuisance.
    pub role: Role,
    /// Its true value.
    pub value: f64,
    /// Standard error in its coordinate, that of `ln θ` for a positive unknown; infinite if the data do not determine
    /// it.
    pub standard_error: f64,
    /// Half width of the interval in its coordinate, ignoring bounds.
    pub half_width: f64,
    /// The interval from the covariance; `None` on a side that is open or beyond its bound.
    pub interval: [Option<f64>; 2],
    /// How well the measurements will determine it.
    pub verdict: Verdict,
    /// The combination that is known if the unknown is not identifiable.
    pub known_combination: Option<KnownCombination>,
}

impl Plan {
    /// Computes the information of curves that follow this prediction of their model, which has derivatives with
    /// respect to all unknowns.
    ///
    /// # Errors
    ///
    /// [`IdentifyError::NoPlan`] where the prediction is not complete, [`IdentifyError::Length`] where a list of the
    /// plan does not match the unknowns, [`IdentifyError::Number`] for invalid noise, [`IdentifyError::NoTime`] for a
    /// drift of curves without times.
    pub fn information(
        &self,
        prediction: &Prediction,
        curves: &[Curve],
    ) -> Result<Information, IdentifyError> {
        let unknowns = self.unknowns.len();
        check_length("list of true values", &self.truth, unknowns)?;
        let points = curves.iter().map(Curve::points).sum();
        if !prediction.is_complete(points, unknowns) {
            let source = ForwardError::Incomplete;
            return Err(IdentifyError::NoPlan { source });
        }
        self.noise.check()?;
        Information::of(self, prediction, curves)
    }

    /// Computes the expected estimate of each unknown from several measurements together, with intervals of this level.
    ///
    /// None of these measurements changes along the `directions`.
    ///
    /// # Errors
    ///
    /// [`IdentifyError::Decomposition`] where a number is not finite.
    pub fn expected(
        &self,
        measurements: &[&Information],
        directions: &NullDirections,
        level: f64,
    ) -> Result<Vec<Expected>, IdentifyError> {
        let jacobian = Information::jacobian(self, measurements);
        let space = directions.among(&self.unknowns)?;
        (0..self.unknowns.len())
            .map(|unknown| self.one_expected(unknown, &jacobian, &space, level))
            .collect()
    }

    fn one_expected(
        &self,
        index: usize,
        jacobian: &[Vec<f64>],
        space: &NullSpace,
        level: f64,
    ) -> Result<Expected, IdentifyError> {
        let unknown = &self.unknowns[index];
        let hold = space.hold_for(index)?;
        let held = hold.as_ref().map_or(&[][..], |hold| &hold.held);
        let standard_error = match &hold {
            Some(_) => standard_error(jacobian, index, held),
            None => f64::INFINITY,
        };
        let position = unknown.position(self.truth[index]);
        let half = student_quantile(level, f64::INFINITY) * standard_error;
        let ends = verdict::wald_ends(unknown, position, half);
        let mut expected = Expected {
            name: unknown.name().to_owned(),
            role: unknown.role(),
            value: self.truth[index],
            standard_error,
            half_width: half,
            interval: ends.map(|end| end.ok().map(|x| unknown.value_beyond(x))),
            verdict: verdict::judge(unknown, position, &ends, standard_error).0,
            known_combination: None,
        };
        if space.moves(index) {
            expected.known_combination = hold.map(|hold| self.combination(&expected, index, &hold));
            expected.verdict = Verdict::NotIdentifiable;
            expected.standard_error = f64::INFINITY;
            expected.half_width = f64::INFINITY;
            expected.interval = [None, None];
        }
        Ok(expected)
    }

    /// The known combination: the unknown times powers of the held unknowns, with its interval while they are held.
    fn combination(&self, expected: &Expected, unknown: usize, hold: &Hold) -> KnownCombination {
        let factor = |&(k, exponent): &(usize, f64)| self.truth[k].powf(exponent);
        let factor: f64 = hold.exponents.iter().map(factor).product();
        KnownCombination {
            expression: expression(&self.unknowns, unknown, &hold.exponents),
            value: expected.value * factor,
            interval: expected.interval.map(|end| end.map(|end| end * factor)),
        }
    }
}

/// `√((JᵀJ)⁻¹_jj)` with some unknowns held. The unknown comes last, so that it is the column to be dropped if it
/// depends on the others.
fn standard_error(jacobian: &[Vec<f64>], unknown: usize, held: &[usize]) -> f64 {
    let others = (0..jacobian.len()).filter(|j| *j != unknown && !held.contains(j));
    let columns: Vec<_> = others
        .chain([unknown])
        .map(|j| jacobian[j].clone())
        .collect();
    let last = columns.len() - 1;
    OrthonormalBasis::of(columns).inverse_gram()[last][last].sqrt()
}
