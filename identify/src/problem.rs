//! The problem of a fit: curves, unknowns and nuisances.

use std::ops::Range;

use crate::{
    Curve, IdentifyError, LinearNuisance, Noise, NoiseLevels, NullDirections, PointErrors, Unknown,
    nuisance::NuisanceColumn, orthonormal_basis::dot,
};

/// Scatter of the parameters between curves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scatter {
    /// All curves have the same parameters and differ only by noise.
    None,
    /// The curves are repeats at different places or on different specimens: their parameters scatter about common
    /// ones, and a curve whose residuals are far larger than those of the rest is left out.
    BetweenCurves,
}

/// Measured curves, the unknowns sought from them, and their nuisances.
#[derive(Debug, Clone)]
pub struct Problem {
    curves: Vec<Curve>,
    unknowns: Vec<Unknown>,
    noise: Noise,
    null_directions: NullDirections,
    scatter: Scatter,
    columns: Vec<NuisanceColumn>,
    spans: Vec<Range<usize>>,
    observed: Vec<f64>,
    /// The known errors of each point; empty where no curve has some.
    errors: Vec<PointErrors>,
}

impl Problem {
    /// A problem with curves that have the same parameters.
    ///
    /// # Errors
    ///
    /// [`IdentifyError::NoUnknown`], [`IdentifyError::Twice`] and [`IdentifyError::TooFewPoints`] for unknowns that
    /// cannot be found; [`IdentifyError::NoTime`], [`IdentifyError::Length`] and [`IdentifyError::Number`] for
    /// nuisances and noise that do not match the curves.
    pub fn new(
        curves: Vec<Curve>,
        unknowns: Vec<Unknown>,
        nuisances: &[LinearNuisance],
        noise: Noise,
    ) -> Result<Self, IdentifyError> {
        noise.check()?;
        check_names(&unknowns)?;
        let mut columns = Vec::new();
        for nuisance in nuisances {
            columns.extend(nuisance.columns(&curves)?);
        }
        let spans = spans(curves.iter().map(Curve::points));
        let observed: Vec<f64> = curves.iter().flat_map(Curve::observed).copied().collect();
        let free = columns.iter().filter(|c| c.prior.is_none()).count()
            + unknowns.iter().filter(|u| u.prior().is_none()).count();
        // As many points as unknowns leave nothing to estimate the noise from.
        let spare = usize::from(!noise.is_given());
        if observed.len() < free + spare {
            return Err(IdentifyError::TooFewPoints {
                points: observed.len(),
                wanted: free,
            });
        }
        Ok(Self {
            errors: errors(&curves),
            curves,
            unknowns,
            noise,
            null_directions: NullDirections::default(),
            scatter: Scatter::None,
            columns,
            spans,
            observed,
        })
    }

    /// The same problem with the directions along which no curve changes.
    #[must_use]
    pub fn with_null_directions(mut self, null_directions: NullDirections) -> Self {
        self.null_directions = null_directions;
        self
    }

    /// The same problem with the given scatter between curves.
    #[must_use]
    pub fn with_scatter(mut self, scatter: Scatter) -> Self {
        self.scatter = scatter;
        self
    }

    /// The curves.
    #[must_use]
    pub fn curves(&self) -> &[Curve] {
        &self.curves
    }

    /// The parameters to be found.
    #[must_use]
    pub fn unknowns(&self) -> &[Unknown] {
        &self.unknowns
    }

    /// The noise.
    #[must_use]
    pub fn noise(&self) -> &Noise {
        &self.noise
    }

    /// Number of points of all curves.
    #[must_use]
    pub fn points(&self) -> usize {
        self.observed.len()
    }

    pub(crate) fn null_directions(&self) -> &NullDirections {
        &self.null_directions
    }

    /// Whether the sizes of the noise are given, none of them estimated.
    #[must_use]
    pub fn noise_is_given(&self) -> bool {
        self.noise.is_given()
    }

    /// Whether its curves are repeats whose parameters may scatter.
    #[must_use]
    pub fn has_scatter(&self) -> bool {
        self.scatter == Scatter::BetweenCurves
    }

    pub(crate) fn scatter(&self) -> Scatter {
        self.scatter
    }

    /// The problem without the priors of its unknowns.
    pub(crate) fn without_priors(&self) -> Self {
        Self {
            unknowns: self.unknowns.iter().map(Unknown::without_prior).collect(),
            ..self.clone()
        }
    }

    /// The problem with the zeros of its abscissae held.
    pub(crate) fn without_abscissa_zeros(&self) -> Self {
        let mut held = self.clone();
        held.columns.retain(|column| !column.by_slope);
        held
    }

    /// The problem of one curve alone: with its own nuisances, and without the priors of unknowns, which apply to the
    /// values common to all curves.
    pub(crate) fn of_curve(&self, index: usize) -> Self {
        let span = self.spans[index].clone();
        let own = |column: &&NuisanceColumn| column.curve == Some(index);
        let curves = vec![self.curves[index].clone()];
        Self {
            spans: spans(curves.iter().map(Curve::points)),
            errors: errors(&curves),
            curves,
            unknowns: self.unknowns.iter().map(Unknown::without_prior).collect(),
            noise: self.noise,
            null_directions: NullDirections::default(),
            scatter: Scatter::None,
            columns: self
                .columns
                .iter()
                .filter(own)
                .map(|column| column.part(&span))
                .collect(),
            observed: self.observed[span].to_vec(),
        }
    }

    /// Number of points of the longest curve.
    pub(crate) fn points_of_longest(&self) -> usize {
        self.curves.iter().map(Curve::points).max().unwrap_or(0)
    }

    /// Coefficients of the linear nuisances.
    pub(crate) fn columns(&self) -> &[NuisanceColumn] {
        &self.columns
    }

    /// Whether the abscissa of a curve has a zero to be found.
    pub(crate) fn has_abscissa_zeros(&self) -> bool {
        self.columns.iter().any(|column| column.by_slope)
    }

    /// The range of points of each curve.
    pub(crate) fn spans(&self) -> &[Range<usize>] {
        &self.spans
    }

    /// The observables of all curves.
    pub(crate) fn observed(&self) -> &[f64] {
        &self.observed
    }

    /// The known errors of each point; empty where no curve has some.
    pub(crate) fn errors(&self) -> &[PointErrors] {
        &self.errors
    }

    /// Noise levels before any residual is known.
    pub(crate) fn first_levels(&self) -> NoiseLevels {
        let root_mean_square = |values: &[f64]| (dot(values, values) / values.len() as f64).sqrt();
        let [observed, abscissa] =
            [&self.observed, &self.abscissa()].map(|of| root_mean_square(of));
        self.noise.first_guess(observed, abscissa)
    }

    /// The abscissae of all curves.
    pub(crate) fn abscissa(&self) -> Vec<f64> {
        self.curves
            .iter()
            .flat_map(Curve::abscissa)
            .copied()
            .collect()
    }
}

/// The range of each curve's points among all points, from the number of points of each curve.
pub(crate) fn spans(points: impl Iterator<Item = usize>) -> Vec<Range<usize>> {
    let mut first = 0;
    points
        .map(|count| {
            let span = first..first + count;
            first = span.end;
            span
        })
        .collect()
}

/// The known errors of the points of curves; zeros where other curves have some, empty where none has.
fn errors(curves: &[Curve]) -> Vec<PointErrors> {
    if curves.iter().all(|curve| curve.errors().is_empty()) {
        return Vec::new();
    }
    let of = |curve: &Curve| {
        let mut errors = curve.errors().to_vec();
        errors.resize(curve.points(), PointErrors::default());
        errors
    };
    curves.iter().flat_map(of).collect()
}

fn check_names(unknowns: &[Unknown]) -> Result<(), IdentifyError> {
    if unknowns.is_empty() {
        return Err(IdentifyError::NoUnknown);
    }
    for (index, unknown) in unknowns.iter().enumerate() {
        if unknowns[..index]
            .iter()
            .any(|other| other.name() == unknown.name())
        {
            return Err(IdentifyError::Twice {
                name: unknown.name().to_owned(),
            });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(points: usize) -> Curve {
        let abscissa: Vec<f64> = (1..=points).map(|i| i as f64).collect();
        Curve::new(abscissa.clone(), abscissa).unwrap()
    }

    #[test]
    fn duplicate_names_and_too_few_points_are_refused() {
        let x = || Unknown::positive("x", [1.0, 2.0]).unwrap();
        let noise = Noise::white(1.0);
        assert!(matches!(
            Problem::new(vec![curve(5)], vec![x(), x()], &[], noise),
            Err(IdentifyError::Twice { .. })
        ));
        // Two points determine two parameters, but not their noise.
        let shift = [LinearNuisance::shift()];
        let of = |points, noise| Problem::new(vec![curve(points)], vec![x()], &shift, noise);
        assert!(of(2, noise).is_ok());
        for (points, noise) in [(1, noise), (2, Noise::default())] {
            let found = of(points, noise);
            let wanted = matches!(found, Err(IdentifyError::TooFewPoints { wanted: 2, .. }));
            assert!(wanted, "{points}");
        }
        assert!(matches!(
            Problem::new(vec![curve(2)], vec![], &[], noise),
            Err(IdentifyError::NoUnknown)
        ));
    }
}
