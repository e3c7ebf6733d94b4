//! Where a model holds: the points at which none of its numbers is [impossible](pellicle_contact::ModelLimit), its
//! springs are shortened by less than their height, its indenter is flat enough, its contact is resolved, and its error
//! is small compared with the noise.
//!
//! The contact is solved once more at the loads of each curve. Between neighbouring loads, ratios, shortening, slope
//! and elements follow powers of the load, so they are interpolated linearly in logarithms, and extrapolated likewise
//! beyond the first and last loads.

use std::fmt;

use pellicle_contact::{
    ContactError, ContactSlope, FEWEST_ELEMENTS, LARGEST_SHORTENING, LARGEST_SLOPE, LimitRatio,
    LoadingPath, Model, ModelLimit, Step, relative_shortening,
};
use rayon::prelude::*;

use super::axisymmetric::AxisymmetricModel;
use super::solved_curve::{Nodes, held};
use super::{ContactCurve, ContactCurves, CurveOptions, Method, Observable, Reading};
use crate::{Fit, Prediction};

/// The error of a prediction is estimated from a second one, with the grid finer and the loads more numerous by this
/// factor.
pub(super) const FINER: f64 = 1.5;
/// An error above this fraction of a point's standard deviation is too large: it adds a quarter to the variance. Any
/// limit is arbitrary; from about here on, a point says more about the grid than about the body.
const LARGEST_ERROR: f64 = 0.5;

/// Why a model does not hold at a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Invalidity {
    /// A layer is shortened by more than its thickness.
    LayerThickness,
    /// The surface is pressed below the top of a rigid base.
    RigidBase,
    /// The indenter is sunk by more than its radius.
    IndenterRadius,
    /// The mean pressure exceeds Young's modulus of what carries it.
    Modulus,
    /// Springs of the linear law are shortened by more than their height.
    Squeezed,
    /// The indenter is steeper than [`LARGEST_SLOPE`] where the contact ends; never a self-similar one, which is as
    /// steep at every point.
    Steep,
    /// The contact is less than [`FEWEST_ELEMENTS`] across on the coarser of the two grids.
    Unresolved,
    /// The contact has jumped out: its force or its penetration is below that of the last contact with adhesion.
    LetGo,
    /// The prediction may be wrong by more than half a standard deviation of the noise.
    Inaccurate,
}

impl fmt::Display for Invalidity {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.write_str(match self {
            Self::LayerThickness => "layer shortened by more than its thickness",
            Self::RigidBase => "surface pressed below the top of the rigid base",
            Self::IndenterRadius => "indenter sunk by more than its radius",
            Self::Modulus => "mean pressure above the Young's modulus of what carries it",
            Self::Squeezed => "springs squeezed by more than their height",
            Self::Steep => "indenter too steep where the contact ends",
            Self::Unresolved => "contact not resolved by the grid",
            Self::LetGo => "beyond the pull-off of the model",
            Self::Inaccurate => "error of the prediction above half the noise",
        })
    }
}

/// The state of a contact at one of the loads of a curve.
#[derive(Debug, Clone, Copy)]
struct Condition {
    /// Abscissa of the curve, N or m.
    abscissa: f64,
    /// Numbers over their limits, by [`BEYOND`].
    ratios: [f64; BEYOND.len()],
    /// Largest shortening of the springs over their height.
    shortening: Option<f64>,
    /// Slope of the indenter where the contact ends.
    slope: Option<f64>,
    /// Elements of the coarser grid across the contact.
    elements: f64,
}

/// The reasons why a point is beyond the model, in the order in which they are given.
const BEYOND: [Invalidity; 4] = [
    Invalidity::RigidBase,
    Invalidity::LayerThickness,
    Invalidity::IndenterRadius,
    Invalidity::Modulus,
];

/// The reason that belongs to a limit.
fn reason(limit: ModelLimit) -> Invalidity {
    match limit {
        // No measured curve wears.
        ModelLimit::LayerThickness { .. } | ModelLimit::WornLayer { .. } => {
            Invalidity::LayerThickness
        }
        ModelLimit::RigidBase { .. } => Invalidity::RigidBase,
        ModelLimit::IndenterRadius => Invalidity::IndenterRadius,
        ModelLimit::Modulus { .. } => Invalidity::Modulus,
    }
}

/// The numbers of a step over their limits; 0 where one is not known because it is small.
fn ratios(step: &Step) -> [f64; BEYOND.len()] {
    BEYOND.map(|wanted| {
        let is_wanted = |found: &&LimitRatio| reason(found.limit) == wanted;
        let found = step.limits.iter().find(is_wanted);
        found.map_or(0.0, |found| found.ratio)
    })
}

/// The slope of a step that depends on the load.
fn slope(model: &Model, step: &Step) -> Option<f64> {
    let slope = step.slope.filter(|slope| slope.value() > 0.0)?;
    match (slope, model.indenter.self_similar_slope()) {
        (ContactSlope::AtEdge(_), Some(_)) => None,
        _ => Some(slope.value()),
    }
}

impl ContactCurves {
    /// For each point of all curves, the reason why the model does not hold there at a fit; `None` where it holds.
    /// `at_fit` is the prediction of these curves at the fit's values, and `noise` the standard deviation of each
    /// point.
    ///
    /// Each load is solved once more, and on a finer grid; neither is counted in the loads solved.
    ///
    /// # Errors
    ///
    /// [`ContactError`] where the contact cannot be solved at the fit.
    pub fn invalid_points(
        &self,
        fit: &Fit,
        at_fit: &Prediction,
        noise: &[f64],
    ) -> Result<Vec<Option<Invalidity>>, ContactError> {
        let values: Vec<f64> = fit.estimates.iter().map(|of| of.value).collect();
        let finer = self.finer(&values, &at_fit.origins)?;
        let pairs = at_fit.value.iter().zip(&finer.value);
        // Second order in the element's side: of an error e, the difference shows e − e/F².
        let seen = 1.0 - 1.0 / (FINER * FINER);
        let errors = pairs.map(|(value, finer)| (value - finer).abs() / seen);
        let inaccurate: Vec<bool> = (errors.zip(noise))
            .map(|(error, noise)| error > LARGEST_ERROR * noise)
            .collect();
        let mut found = Vec::new();
        for (index, curve) in self.curves.iter().enumerate() {
            let origins = self.origins_of(index, &at_fit.origins);
            let abscissae = curve.abscissae_from(origins);
            if curve.adhesion.is_some() {
                found.extend(self.invalid_with_adhesion(index, &values, &abscissae)?);
                continue;
            }
            let conditions = self.conditions(index, &values)?;
            let judge = |abscissa: &f64| invalid(&conditions, *abscissa);
            let judged = abscissae.iter().map(judge);
            match self.methods[index] {
                Method::Grid(..) => found.extend(judged),
                _ => found.extend(judged.map(resolved)),
            }
        }
        let pairs = found.into_iter().zip(inaccurate);
        Ok(pairs
            .map(|(found, inaccurate)| found.or(inaccurate.then_some(Invalidity::Inaccurate)))
            .collect())
    }

    /// For each point of all curves, the reason why it is beyond the model at these values; `None` where it is not.
    ///
    /// Each load is solved once more, which is not counted in the loads solved.
    ///
    /// # Errors
    ///
    /// [`ContactError`] where the contact cannot be solved.
    pub fn beyond_model(&self, values: &[f64]) -> Result<Vec<Option<Invalidity>>, ContactError> {
        let mut found = Vec::new();
        for (index, curve) in self.curves.iter().enumerate() {
            let conditions = self.conditions(index, values)?;
            let beyond = |abscissa: &f64| beyond(&conditions, *abscissa);
            found.extend(curve.abscissae.iter().map(beyond));
        }
        Ok(found)
    }

    /// As [`Self::invalid_points`] for a curve with adhesion, whose layers and indenter are judged by the contact
    /// without adhesion that has the same radius.
    fn invalid_with_adhesion(
        &self,
        index: usize,
        values: &[f64],
        abscissae: &[f64],
    ) -> Result<Vec<Option<Invalidity>>, ContactError> {
        let curve = self.curve_at(index, values)?;
        let constants = self.constants(values);
        let factor = self.scales[index].map_or(1.0, |scale| scale.factor(constants));
        let abscissae = curve.observable.true_abscissae(abscissae, factor);
        let of = (abscissae.as_slice(), curve.series / factor);
        let model = AxisymmetricModel::of(&curve, &[])?;
        let branch = model.branch(curve.observable, of, &[], self.options.loads_per_decade)?;
        let forces = branch.forces_without(&abscissae);
        let without = ContactCurve {
            observable: Observable::DepthAtForce,
            abscissae: forces.iter().copied().flatten().collect(),
            adhesion: None,
            origins: Vec::new(),
            series: 0.0,
            ..curve
        };
        let conditions = self.conditions_of(&without, None, 1.0)?;
        let judge = |force: &Option<f64>| match force {
            None => Some(Invalidity::LetGo),
            Some(force) => resolved(invalid(&conditions, *force)),
        };
        Ok(forces.iter().map(judge).collect())
    }

    /// Predicts the same points from the same origins, with a finer grid and more loads.
    pub(super) fn finer(
        &self,
        values: &[f64],
        origins: &[f64],
    ) -> Result<Prediction, ContactError> {
        let curves = (0..self.curves.len()).map(|index| self.curve_at(index, values));
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a small number of elements"
        )]
        let half = (FINER * self.options.elements as f64 / 2.0).round() as usize;
        let options = CurveOptions {
            elements: 2 * half,
            loads_per_decade: FINER * self.options.loads_per_decade,
            ..self.options.clone()
        };
        let curves = curves.collect::<Result<Vec<_>, ContactError>>()?;
        let all = Self::new(curves, Vec::new(), options)?.with_force_scales(self.scales.clone());
        let mut together = Prediction {
            value: Vec::new(),
            slope: Vec::new(),
            derivatives: Vec::new(),
            origins: origins.to_vec(),
        };
        for index in 0..all.curves.len() {
            let one = all.predicted(index, self.constants(values), origins, &[])?;
            together.value.extend(one.value);
            together.slope.extend(one.slope);
        }
        Ok(together)
    }

    /// The state of the contact at the loads of a curve; empty where no contact is solved.
    fn conditions(&self, curve: usize, values: &[f64]) -> Result<Vec<Condition>, ContactError> {
        let nodes = match &self.methods[curve] {
            Method::Punches => return Ok(Vec::new()),
            Method::Axisymmetric(_) => None,
            Method::Grid(nodes, _) => Some(nodes),
        };
        let constants = self.constants(values);
        let factor = self.scales[curve].map_or(1.0, |scale| scale.factor(constants));
        self.conditions_of(&self.curve_at(curve, values)?, nodes, factor)
    }

    /// The same of a curve whose forces as read are too small by a factor, on a grid at these loads, or at own ones.
    fn conditions_of(
        &self,
        curve: &ContactCurve,
        nodes: Option<&Nodes>,
        factor: f64,
    ) -> Result<Vec<Condition>, ContactError> {
        let nodes = match nodes {
            Some(nodes) => nodes.with_forces_times(factor),
            None => Nodes::of(curve, &self.options)?.with_forces_times(factor),
        };
        let (model, of) = (&curve.model, (curve.observable, curve.series));
        let solved = nodes.domains(model).into_par_iter();
        let solved = solved.map(|domain| {
            let path = held(model, domain, self.options.elements)?;
            Ok(condition(model, of, domain.0 / factor, &path))
        });
        let all: Vec<Result<Condition, ContactError>> = solved.collect();
        all.into_iter().collect()
    }
}

/// A reason, unless it is one of the grid, on which only the limits of the model were found.
fn resolved(reason: Option<Invalidity>) -> Option<Invalidity> {
    reason.filter(|reason| *reason != Invalidity::Unresolved)
}

/// The state of a contact under a force that was read as `force`.
fn condition(
    model: &Model,
    (observable, series): (Observable, f64),
    force: f64,
    path: &LoadingPath,
) -> Condition {
    let step = &path.steps[0];
    let area = step.summary.contact_area;
    Condition {
        abscissa: match observable.abscissa() {
            Reading::Force => force,
            Reading::Depth => step.solution.penetration + series * force,
            Reading::ContactRadius | Reading::Stiffness => (area / std::f64::consts::PI).sqrt(),
        },
        ratios: ratios(step),
        shortening: relative_shortening(model, step),
        slope: slope(model, step),
        // 2a over the side of an element twice as wide.
        elements: step.summary.contact_radius / path.grid.element_side(),
    }
}

/// The reason why the model does not hold at an abscissa, if it does not. Before the contact it holds.
fn invalid(conditions: &[Condition], abscissa: f64) -> Option<Invalidity> {
    if abscissa <= 0.0 {
        return None;
    }
    let at = |of: fn(&Condition) -> Option<f64>| interpolated(conditions, abscissa, of);
    let above = |found: Option<f64>, limit: f64| found.is_some_and(|found| found > limit);
    let elements = at(|of| Some(of.elements));
    if let Some(beyond) = beyond(conditions, abscissa) {
        Some(beyond)
    } else if above(at(|of| of.shortening), LARGEST_SHORTENING) {
        Some(Invalidity::Squeezed)
    } else if above(at(|of| of.slope), LARGEST_SLOPE) {
        Some(Invalidity::Steep)
    } else if elements.is_some_and(|found| found < FEWEST_ELEMENTS as f64) {
        Some(Invalidity::Unresolved)
    } else {
        None
    }
}

/// The number that is impossible at an abscissa, if one is.
fn beyond(conditions: &[Condition], abscissa: f64) -> Option<Invalidity> {
    let is_beyond = |index: &usize| {
        let ratio = interpolated(conditions, abscissa, |of| Some(of.ratios[*index]));
        ratio.is_some_and(|ratio| ratio >= 1.0)
    };
    let index = (0..BEYOND.len()).find(is_beyond)?;
    Some(BEYOND[index])
}

/// A positive quantity at an abscissa, on the straight line in logarithms through the two loads beside it.
fn interpolated(
    conditions: &[Condition],
    abscissa: f64,
    of: impl Fn(&Condition) -> Option<f64>,
) -> Option<f64> {
    let last = conditions.len().checked_sub(2)?;
    let first = conditions.partition_point(|one| one.abscissa < abscissa);
    let first = first.saturating_sub(1).min(last);
    let (low, high) = (&conditions[first], &conditions[first + 1]);
    let (below, above) = (of(low)?, of(high)?);
    let part = (abscissa / low.abscissa).ln() / (high.abscissa / low.abscissa).ln();
    let found = below * (above / below).powf(part);
    if found.is_nan() {
        // Not known at one of them: as at the nearer one.
        return Some(if part < 0.5 { below } else { above });
    }
    Some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Power laws that exceed their limits above loads of 0.9, 2 and 60, and elements too few below 0.1.
    fn conditions() -> Vec<Condition> {
        [0.03_f64, 0.3, 3.0, 30.0]
            .map(|load| Condition {
                abscissa: load,
                ratios: [0.0, (load / 60.0).sqrt(), 0.0, 0.0],
                shortening: Some((load / 2.0).cbrt()),
                slope: Some(LARGEST_SLOPE * (load / 0.9).powf(0.2)),
                elements: FEWEST_ELEMENTS as f64 * (load / 0.1).cbrt(),
            })
            .to_vec()
    }

    #[test]
    fn validity_limits_follow_powers_of_the_load_between_and_beyond_the_loads() {
        let conditions = conditions();
        for (load, wanted) in [
            (0.01, Some(Invalidity::Unresolved)),
            (0.0999, Some(Invalidity::Unresolved)),
            (0.1001, None),
            (0.899, None),
            (0.901, Some(Invalidity::Steep)),
            (1.999, Some(Invalidity::Steep)),
            (2.001, Some(Invalidity::Squeezed)),
            (59.0, Some(Invalidity::Squeezed)),
            (61.0, Some(Invalidity::LayerThickness)),
        ] {
            assert_eq!(invalid(&conditions, load), wanted, "{load}");
            let beyond_wanted = wanted.filter(|wanted| BEYOND.contains(wanted));
            assert_eq!(beyond(&conditions, load), beyond_wanted, "{load}");
        }
    }

    #[test]
    fn conditions_that_a_model_lacks_never_fail() {
        let mut conditions = conditions();
        for one in &mut conditions {
            (one.shortening, one.slope, one.ratios) = (None, None, [0.0; 4]);
        }
        assert_eq!(invalid(&conditions, 100.0), None);
    }
}
