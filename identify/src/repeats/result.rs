//! The result of a fit of repeats.

use faer::Mat;

use super::{Common, CurveFit, MixedModel, Repeats, State, common_departure::common_p};
use crate::{
    BetweenCurves, Coefficient, Departure, Estimate, Fit, FitVerdict, FitWarning, FitWork,
    FittedPoints, Goodness, IdentifyError, KnownCombination, Outlier, REFUSAL, Verdict,
    departure::largest_deviation,
    distribution::student_quantile,
    goodness::{NoiseScale, OtherTests, Residuals},
    known_combination::{expression, not_identifiable},
    orthonormal_basis::dot,
    outlier,
    predictor::Predictor,
    profile::Open,
    result::correlation,
    verdict::{self, Ends},
};

impl Repeats<'_> {
    pub(super) fn result(
        &self,
        predictor: &Predictor,
        state: &State,
        curves: &[CurveFit],
        common: &Common,
        converged: bool,
    ) -> Result<Fit, IdentifyError> {
        let model = self.mixed_model(curves, state);
        let goodness = self.goodness(state, curves);
        let points = self.points(state, curves);
        let outliers = self.outliers(state, &points);
        let is_fitted = |one: &Outlier| {
            let spans = self.problem.spans();
            let fitted = curves.iter().map(|curve| &spans[curve.index]);
            fitted.into_iter().any(|span| span.contains(&one.point))
        };
        let verdict = FitVerdict::of(converged, &goodness, outliers.iter().any(is_fitted));
        let covariance = self.covariance(common);
        let estimates: Result<Vec<Estimate>, IdentifyError> = (0..self.problem.unknowns().len())
            .map(|unknown| self.estimate(state, curves, common, &model, unknown))
            .collect();
        Ok(Fit {
            verdict,
            stopped: None,
            estimates: estimates?,
            coefficients: self.coefficients(state, curves, common),
            correlation: correlation(&covariance),
            covariance,
            noise: state.levels,
            departure: self.departure(&goodness, curves, &points),
            goodness,
            outliers,
            points,
            excluded: state.exclusions.clone(),
            odd: self.odd(state, curves)?,
            work: FitWork {
                curves_solved: predictor.predictions(),
                search: predictor.predictions(),
            },
            warnings: self.warnings(state),
        })
    }

    pub(super) fn goodness(&self, state: &State, curves: &[CurveFit]) -> Goodness {
        let known = self.problem.noise().is_known();
        let degrees = curves.iter().map(|curve| curve.degrees).sum();
        let sum = |k: usize| curves.iter().map(|curve| curve.lower_half[k]).sum::<f64>();
        let points = |curve: &CurveFit| self.problem.spans()[curve.index].len();
        Residuals {
            series: curves
                .iter()
                .map(|curve| &curve.whitened[..points(curve)])
                .collect(),
            chi_squared: curves.iter().map(|c| dot(&c.whitened, &c.whitened)).sum(),
            points: curves.iter().map(points).sum(),
            degrees,
            known,
        }
        .judge(&OtherTests {
            lower_half: NoiseScale::of(self.problem, degrees, [degrees; 2])
                .probability([sum(0), sum(1)]),
            smooth: None,
            persistence: self.persistence_p(state),
            common: common_p(
                &curves
                    .iter()
                    .map(|curve| &curve.departure)
                    .collect::<Vec<_>>(),
            ),
        })
    }

    /// What the residuals of all curves have in common, if independent curves would not leave it.
    fn departure(
        &self,
        goodness: &Goodness,
        curves: &[CurveFit],
        points: &FittedPoints,
    ) -> Option<Departure> {
        let probability = goodness.common_p.filter(|p| *p < REFUSAL)?;
        let residuals: Vec<_> = curves
            .iter()
            .map(|curve| {
                let of_curve = &self.problem.curves()[curve.index];
                let span = self.problem.spans()[curve.index].clone();
                (of_curve.abscissa(), &points.residual[span])
            })
            .collect();
        let (range, largest) = largest_deviation(&residuals)?;
        Some(Departure {
            curves: curves.len(),
            range,
            largest,
            probability,
        })
    }

    /// The outliers of all curves, also of those left out.
    fn outliers(&self, state: &State, points: &FittedPoints) -> Vec<Outlier> {
        let series = outlier::Series {
            residual: &points.residual,
            observed: self.problem.observed(),
            deviation: &state.levels.deviations(&state.at, self.problem.errors()),
            is_told: self.problem.noise().is_given(),
        };
        outlier::outliers(&series, self.problem.spans())
    }

    /// The covariance of the unknowns; those not identifiable have an infinite variance.
    fn covariance(&self, common: &Common) -> Vec<Vec<f64>> {
        let unknowns = self.problem.unknowns().len();
        let entry = |i: usize, j: usize| {
            if self.null_space.moves(i) || self.null_space.moves(j) {
                return if i == j { f64::INFINITY } else { 0.0 };
            }
            self.entry(&common.covariance, i, j)
        };
        (0..unknowns)
            .map(|i| (0..unknowns).map(|j| entry(i, j)).collect())
            .collect()
    }

    /// An entry of the covariance of the determined unknowns; zero for those that are held.
    fn entry(&self, covariance: &Mat<f64>, i: usize, j: usize) -> f64 {
        let place = |unknown: usize| self.determined.iter().position(|&k| k == unknown);
        match (place(i), place(j)) {
            (Some(a), Some(b)) => covariance[(a, b)],
            _ => 0.0,
        }
    }

    fn estimate(
        &self,
        state: &State,
        curves: &[CurveFit],
        common: &Common,
        model: &MixedModel,
        unknown: usize,
    ) -> Result<Estimate, IdentifyError> {
        let parameter = &self.problem.unknowns()[unknown];
        let (x, value) = (state.at.position[unknown], state.at.parameters[unknown]);
        let mut estimate = Estimate {
            name: parameter.name().to_owned(),
            role: parameter.role(),
            value,
            interval: [None, None],
            wald: None,
            degrees_of_freedom: curves.len() as f64 - 1.0,
            verdict: Verdict::NotIdentifiable,
            why: String::new(),
            known_combination: None,
            profile: Vec::new(),
            between_curves: self.between_curves(state, curves, common, unknown),
        };
        if self.null_space.moves(unknown) {
            let known = self.combination(state, curves, common, unknown)?;
            estimate.why = not_identifiable(known.as_ref());
            estimate.known_combination = known;
            return Ok(estimate);
        }
        let half = self.half_width(state, curves, common, model, unknown)?;
        let [low, high] = parameter.bounds();
        let end = |inside: bool, end: f64| if inside { Ok(end) } else { Err(Open::Bound) };
        let ends: Ends = [
            end(x - half >= low, x - half),
            end(x + half <= high, x + half),
        ];
        let standard_error = self.entry(&common.covariance, unknown, unknown).sqrt();
        estimate.interval = ends.map(|end| end.ok().map(|x| parameter.value_beyond(x)));
        estimate.wald = Some([x - half, x + half].map(|x| parameter.value_beyond(x)));
        (estimate.verdict, estimate.why) = verdict::judge(parameter, x, &ends, standard_error);
        Ok(estimate)
    }

    /// The prior variance of an unknown, in its coordinate.
    fn prior_variance(&self, state: &State, unknown: usize) -> Option<f64> {
        let parameter = &self.problem.unknowns()[unknown];
        let value = state.at.parameters[unknown];
        let slope = parameter.prior()?.deviation_slope(value) * parameter.value_slope(value);
        Some(slope.powi(-2))
    }

    /// `√(t² C_c + z² C_p)`.
    pub(super) fn half_width(
        &self,
        state: &State,
        curves: &[CurveFit],
        common: &Common,
        model: &MixedModel,
        unknown: usize,
    ) -> Result<f64, IdentifyError> {
        let Some(column) = self.determined.iter().position(|&j| j == unknown) else {
            return Ok(f64::INFINITY);
        };
        let whole = common.covariance[(column, column)];
        // The unknown's own prior contributes 1/v to the information 1/C; the curves contribute at most the rest.
        let beside_prior = self
            .prior_variance(state, unknown)
            .map_or(whole, |prior| whole * (1.0 - whole / prior).max(0.0));
        let from_curves = model
            .variance_from_curves(column, &common.scatter)?
            .min(beside_prior);
        let t = student_quantile(self.options.level, (curves.len() as f64 - 1.0).max(1.0));
        let z = student_quantile(self.options.level, f64::INFINITY);
        Ok((t * t * from_curves + z * z * (whole - from_curves)).sqrt())
    }

    fn between_curves(
        &self,
        state: &State,
        curves: &[CurveFit],
        common: &Common,
        unknown: usize,
    ) -> Option<BetweenCurves> {
        let column = self.determined.iter().position(|&j| j == unknown)?;
        let place = self.scattered().iter().position(|&k| k == column)?;
        let parameter = &self.problem.unknowns()[unknown];
        let x = state.at.position[unknown];
        let relative = parameter.value_slope(state.at.parameters[unknown]);
        Some(BetweenCurves {
            standard_deviation: common.scatter[place] * relative,
            values: curves
                .iter()
                .map(|curve| (curve.index, parameter.value_beyond(x + curve.own[column])))
                .collect(),
        })
    }

    /// The unknown times powers of others: a product that is invariant along the null directions.
    fn combination(
        &self,
        state: &State,
        curves: &[CurveFit],
        common: &Common,
        unknown: usize,
    ) -> Result<Option<KnownCombination>, IdentifyError> {
        let Some(hold) = self.null_space.hold_for(unknown)? else {
            return Ok(None);
        };
        let mut factors = hold.exponents.clone();
        factors.push((unknown, 1.0));
        // Var(Σ c_k x_k); held unknowns add nothing.
        let variance: f64 = factors
            .iter()
            .flat_map(|&(i, ci)| factors.iter().map(move |&(k, ck)| (i, k, ci * ck)))
            .map(|(i, k, c)| c * self.entry(&common.covariance, i, k))
            .sum();
        let t = student_quantile(self.options.level, (curves.len() as f64 - 1.0).max(1.0));
        let half = t * variance.sqrt();
        let value: f64 = factors
            .iter()
            .map(|&(k, c)| state.at.parameters[k].powf(c))
            .product();
        Ok(Some(KnownCombination {
            expression: expression(self.problem.unknowns(), unknown, &hold.exponents),
            value,
            interval: [Some(value * (-half).exp()), Some(value * half.exp())],
        }))
    }

    fn coefficients(
        &self,
        state: &State,
        curves: &[CurveFit],
        common: &Common,
    ) -> Vec<Coefficient> {
        let quantile = student_quantile(self.options.level, f64::INFINITY);
        let coefficient = |name: &str, curve, value: f64, error: f64| Coefficient {
            name: name.to_owned(),
            curve,
            value,
            interval: [value - quantile * error, value + quantile * error],
        };
        let mut coefficients = Vec::new();
        for (place, (&k, &value)) in self.shared.iter().zip(&state.nuisances).enumerate() {
            let column = self.determined.len() + place;
            let error = common.covariance[(column, column)].sqrt();
            coefficients.push(coefficient(
                &self.problem.columns()[k].name,
                None,
                value,
                error,
            ));
        }
        for curve in curves {
            let columns = self.shares[curve.index].problem.columns();
            for (column, &[value, error]) in columns.iter().zip(&curve.nuisances) {
                coefficients.push(coefficient(&column.name, column.curve, value, error));
            }
        }
        coefficients
    }

    fn warnings(&self, state: &State) -> Vec<FitWarning> {
        let unknowns = self.problem.unknowns();
        (0..unknowns.len())
            .filter(|&j| unknowns[j].bounds().contains(&state.at.position[j]))
            .map(FitWarning::AtBound)
            .collect()
    }

    fn points(&self, state: &State, curves: &[CurveFit]) -> FittedPoints {
        let observed = self.problem.observed();
        let mut model = state.at.value.clone();
        let mut whitened = vec![0.0; model.len()];
        for curve in curves {
            let span = self.problem.spans()[curve.index].clone();
            whitened[span.clone()].copy_from_slice(&curve.whitened[..span.len()]);
            model[span].copy_from_slice(&curve.model);
        }
        FittedPoints {
            residual: observed.iter().zip(&model).map(|(y, f)| y - f).collect(),
            model,
            whitened,
        }
    }
}
