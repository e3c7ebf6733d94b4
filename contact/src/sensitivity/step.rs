//! Derivatives of a solved step by numbers of its model.

use pellicle_texture::nan_from_null;
use serde::{Deserialize, Serialize};

use super::ForceCurve;
use super::change::{Change, Changed, ModelDerivatives};
use crate::{
    Boundary, ContactError, DiscreteProblem, Load, LoadingPath, Solution,
    grid::region::Region,
    solver::gradient::pressure_per_penetration,
    vector::{dot, sum},
};

/// The derivatives of a step by one number θ of its model, per unit of θ.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Sensitivity {
    /// Value of θ, in SI units.
    #[serde(deserialize_with = "nan_from_null")]
    pub value: f64,
    /// `∂D/∂θ` at constant force, for fixed elements in contact, in m per unit of θ; none without contact, or if its
    /// linear system does not converge.
    pub penetration: Option<f64>,
    /// `∂D/∂θ` along the curve, without the steps due to elements that enter the contact, in m per unit of θ; none from
    /// [`Sensitivities::at`], under a prescribed penetration, or with fewer than six different forces.
    pub smooth_penetration: Option<f64>,
    /// `∂Q/∂θ` at constant penetration, for fixed elements in contact, in N per unit of θ; none if
    /// [`Self::penetration`] is none.
    pub force: Option<f64>,
    /// `∂E/∂θ` at constant force, in J per unit of θ; `E = ∫ D dQ`.
    #[serde(deserialize_with = "nan_from_null")]
    pub energy: f64,
}

/// Derivatives of the steps of a path by some numbers of its model; the derivatives of the model on the path's grid are
/// computed once.
///
/// ```
/// use std::sync::Arc;
/// use pellicle_contact::{
///     Domain, Load, Model, Paraboloid, SolverOptions, solve_path,
/// };
/// # use pellicle_influence::{Cache, RadialTables};
/// # use pellicle_kernel::{Foundation, Material};
/// # use pellicle_texture::Relief;
///
/// let body = Foundation::half_space(Material::new(210e9, 0.3)?);
/// let model = Model {
///     tables: Arc::new(RadialTables::build(&body)?),
///     relief: Relief::Bare,
///     indenter: Paraboloid::new(1e-5)?.into(),
///     cache: Cache::none(),
/// };
/// let options = SolverOptions::default();
/// let path = solve_path(&model, Domain::Automatic, 64, &[Load::Force(1e-3)], &options, &mut ())?;
/// let parameters = model.parameters(); // E, ν, R
/// let found = model.derivatives(&parameters)?.of_path(&path)?.at(0);
/// // Hertz: D ∝ E^(−2/3) R^(−1/3); D and its derivative on 64² elements are right to some 1e-3.
/// let logarithmic = |index: usize| {
///     found[index].penetration.unwrap() * found[index].value / path.steps[0].solution.penetration
/// };
/// assert!((logarithmic(0) + 2.0 / 3.0).abs() < 1e-2 && (logarithmic(2) + 1.0 / 3.0).abs() < 1e-2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Sensitivities<'a> {
    path: &'a LoadingPath,
    problem: DiscreteProblem,
    changes: Vec<(f64, Change)>,
}

impl ModelDerivatives {
    /// Computes on the grid of `path`, which solved this model, the coefficients for the derivatives of its steps.
    ///
    /// # Errors
    /// [`ContactError::Periodic`] for a periodic cell, [`ContactError::WithHardness`] for a path with a hardness; an
    /// error for coefficients that are not finite; those of [`Model::with_parameter`](crate::Model::with_parameter).
    pub fn of_path<'a>(&self, path: &'a LoadingPath) -> Result<Sensitivities<'a>, ContactError> {
        if path.boundary == Boundary::Periodic {
            return Err(ContactError::Periodic {
                what: "derivatives",
            });
        }
        if path.hardness.is_finite() {
            return Err(ContactError::WithHardness {
                what: "derivatives",
            });
        }
        Ok(Sensitivities {
            path,
            problem: self.model().discretize(&path.geometry())?.value,
            changes: self.on(&path.grid)?,
        })
    }
}

impl Sensitivities<'_> {
    /// Returns the derivatives of a step, in the order of the parameters. Each takes one product with `K_θ`; all share
    /// one linear system on the elements in contact.
    ///
    /// # Panics
    /// If there is no such step.
    #[must_use]
    pub fn at(&self, step: usize) -> Vec<Sensitivity> {
        let (region, pressure) = self.pressed(step);
        let part = self.problem.part(&region);
        let rates = part.and_then(|mut part| pressure_per_penetration(&mut part, &pressure));
        let area = self.path.grid.element_area();
        let of_change = |(value, change): &(f64, Change)| {
            let changed = change.under(&region, &pressure);
            let energy = area * change_of_energy(&pressure, &changed);
            let Changed { image, gap, .. } = changed;
            // s·((K_θ + η_θ) p + g0_θ) / Σ s
            let penetration =
                (rates.as_ref()).map(|rates| (dot(rates, &image) + dot(rates, &gap)) / sum(rates));
            // −A s·(…)
            let force =
                (rates.as_ref()).map(|rates| -area * (dot(rates, &image) + dot(rates, &gap)));
            Sensitivity {
                value: *value,
                penetration,
                smooth_penetration: None,
                force,
                energy,
            }
        };
        self.changes.iter().map(of_change).collect()
    }

    /// Returns the derivatives of all steps, which were solved under these loads; along the curve as well if all loads
    /// are forces, six or more, all different.
    ///
    /// # Panics
    /// If there are fewer loads than steps.
    #[must_use]
    pub fn of_steps(&self, loads: &[Load]) -> Vec<Vec<Sensitivity>> {
        let steps = 0..self.path.steps.len();
        let mut found: Vec<_> = steps.clone().map(|step| self.at(step)).collect();
        let force = |load: &Load| match load {
            Load::Force(force) => Some(*force),
            Load::Penetration(_) => None,
        };
        let forces: Option<Vec<f64>> = loads[steps.clone()].iter().map(force).collect();
        let Some(forces) = forces else {
            return found;
        };
        let mut order: Vec<usize> = steps.collect();
        order.sort_by(|a, b| forces[*a].total_cmp(&forces[*b]));
        let ascending: Vec<f64> = order.iter().map(|step| forces[*step]).collect();
        for index in 0..self.changes.len() {
            let energies = order.iter().map(|step| found[*step][index].energy);
            let Some(curve) = ForceCurve::through(&ascending, &energies.collect::<Vec<_>>()) else {
                break;
            };
            for (step, force) in found.iter_mut().zip(&forces) {
                step[index].smooth_penetration = Some(curve.derivative(*force));
            }
        }
        found
    }

    /// Returns only `∂E/∂θ` of a step, in J per unit of each number, without a linear system.
    ///
    /// # Panics
    /// If there is no such step.
    #[must_use]
    pub fn energies(&self, step: usize) -> Vec<f64> {
        let (region, pressure) = self.pressed(step);
        let area = self.path.grid.element_area();
        let of_change = |(_, change): &(f64, Change)| {
            area * change_of_energy(&pressure, &change.under(&region, &pressure))
        };
        self.changes.iter().map(of_change).collect()
    }

    /// The energy `E = ∫ D dQ` of a step, in J: `½ (D Q + A g0·p)`, since `(K + η) p + g0 = D` where p is not zero,
    /// plus `A Σ (∫ w* dp − ½ w* p)` for nonlinear springs.
    ///
    /// # Panics
    /// If there is no such step.
    #[must_use]
    pub fn energy(&self, step: usize) -> f64 {
        let (region, pressure) = self.pressed(step);
        let gap = region.cut(self.problem.initial_gap());
        let pairs = pressure.iter().zip(gap).filter(|(p, _)| **p > 0.0);
        let weighted: f64 = pairs.map(|(p, gap)| p * gap).sum();
        let springs = region.cut(self.problem.relief_compliance());
        let law = self.problem.spring_law();
        let nonlinear = springs.iter().zip(&pressure);
        let nonlinear =
            nonlinear.map(|(eta, p)| law.energy(*eta, *p) - 0.5 * law.shortening(*eta, *p) * p);
        let nonlinear: f64 = nonlinear.sum();
        let penetration = self.path.steps[step].solution.penetration;
        let area = self.path.grid.element_area();
        0.5 * area * (penetration * sum(&pressure) + weighted) + area * nonlinear
    }

    /// The region that holds a step's pressure, and the pressure on it.
    fn pressed(&self, step: usize) -> (Region, Vec<f64>) {
        let Solution { pressure, .. } = &self.path.steps[step].solution;
        let whole = Region::whole(self.path.grid.size());
        let region = whole.around_pressing(pressure).unwrap_or(whole);
        let part = region.cut(pressure);
        (region, part)
    }
}

/// `½ p·(K_θ + η_θ) p + g0_θ·p`.
fn change_of_energy(pressure: &[f64], changed: &Changed) -> f64 {
    changed.energy + dot(pressure, &changed.gap)
}
