//! The estimates of the unknowns: values, intervals, verdicts, and the combinations that remain known.

use super::{
    Fitting,
    intervals::{Interval, Reach, Sought},
};
use crate::{
    Estimate, KnownCombination, ProfilePoint, Unknown, Verdict,
    known_combination::{expression, not_identifiable},
    refinement::Refined,
    result::correlation,
    verdict,
};

/// Above this correlation with a prior-driven parameter, the prior drives both.
const CORRELATED_ABOVE: f64 = 0.9;

impl Fitting<'_> {
    /// The estimates of all unknowns.
    pub(super) fn estimates(
        &self,
        refined: &Refined,
        sought: &[Sought],
        intervals: Vec<Interval>,
    ) -> Vec<Estimate> {
        let mut estimates: Vec<Estimate> = sought
            .iter()
            .zip(intervals)
            .map(|(one, interval)| self.estimate(refined, one, &interval))
            .collect();
        self.name_driving_unknowns(refined, &mut estimates);
        estimates
    }

    fn estimate(&self, refined: &Refined, one: &Sought, interval: &Interval) -> Estimate {
        let unknown = &self.problem.unknowns()[one.unknown];
        let value = refined.minimum.at.parameters[one.unknown];
        let value_at = |x: f64| unknown.value_beyond(x);
        let half = one.quantile * one.standard_error;
        let mut estimate = Estimate {
            name: unknown.name().to_owned(),
            role: unknown.role(),
            value,
            interval: interval.ends.map(|end| end.ok().map(value_at)),
            wald: Some([value_at(one.position - half), value_at(one.position + half)])
                .filter(|wald| wald.iter().all(|end| end.is_finite())),
            degrees_of_freedom: one.degrees,
            verdict: Verdict::NotIdentifiable,
            why: String::new(),
            known_combination: None,
            profile: profile(unknown, interval),
            between_curves: None,
        };
        if self.null_space.moves(one.unknown) {
            let combination = self.combination(refined, one, &estimate);
            estimate.why = not_identifiable(combination.as_ref());
            estimate.known_combination = combination;
            estimate.interval = [None, None];
            estimate.wald = None;
        } else {
            (estimate.verdict, estimate.why) =
                verdict::judge(unknown, one.position, &interval.ends, one.standard_error);
        }
        match interval.reach {
            Reach::Whole => {}
            Reach::BestFit => estimate.leave_to_covariance(),
            Reach::Nowhere => estimate.leave_without_interval(),
        }
        estimate
    }

    /// The known combination: the unknown times powers of the held unknowns, with its interval while they are held.
    fn combination(
        &self,
        refined: &Refined,
        one: &Sought,
        estimate: &Estimate,
    ) -> Option<KnownCombination> {
        let hold = one.hold.as_ref()?;
        let factor: f64 = hold
            .exponents
            .iter()
            .map(|&(k, exponent)| refined.minimum.at.parameters[k].powf(exponent))
            .product();
        Some(KnownCombination {
            expression: expression(self.problem.unknowns(), one.unknown, &hold.exponents),
            value: estimate.value * factor,
            interval: estimate.interval.map(|end| end.map(|value| value * factor)),
        })
    }

    /// Names, for each unknown, the prior-driven parameter that carries its uncertainty.
    fn name_driving_unknowns(&self, refined: &Refined, estimates: &mut [Estimate]) {
        let correlation = correlation(&self.covariance(refined));
        let driven: Vec<(usize, String)> = estimates
            .iter()
            .enumerate()
            .filter(|(_, estimate)| estimate.verdict == Verdict::PriorDriven)
            .map(|(k, estimate)| (k, estimate.name.clone()))
            .collect();
        for (j, estimate) in estimates.iter_mut().enumerate() {
            for (k, name) in driven.iter().filter(|(k, _)| *k != j) {
                if correlation[j][*k].abs() > CORRELATED_ABOVE {
                    estimate.why.push_str(" Its uncertainty is mostly that of ");
                    estimate.why.push_str(name);
                    estimate.why.push('.');
                }
            }
        }
    }
}

fn profile(unknown: &Unknown, interval: &Interval) -> Vec<ProfilePoint> {
    interval
        .points
        .iter()
        .map(|&(x, delta_chi_squared)| ProfilePoint {
            value: unknown.value_beyond(x),
            delta_chi_squared,
        })
        .collect()
}
