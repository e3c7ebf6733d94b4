//! Derivatives of a solved step by numbers of its model.

use serde::{Deserialize, Serialize};

use super::change::{Change, Changed, ModelDerivatives};
use crate::{
    Boundary, ContactError, DiscreteProblem, LoadingPath, Solution,
    grid::window::Window,
    solver::gradient::pressure_per_penetration,
    vector::{dot, sum},
};

/// The answer of a step to one number θ of its model, per unit of θ.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Sensitivity {
    /// Value of θ, in SI units.
    pub value: f64,
    /// `∂E/∂θ` at constant force, in J per unit of θ; `E = ∫ D dQ`.
    pub energy: f64,
    /// `∂D/∂θ` at constant force, in m per unit of θ; none without contact, or where the system for it does not
    /// converge.
    pub penetration: Option<f64>,
    /// `∂Q/∂θ` at constant penetration, in N per unit of θ; none where [`Self::penetration`] is.
    pub force: Option<f64>,
}

/// Derivatives of the steps of a path by some numbers of its model; what those change on the path's grid is computed
/// once.
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
    /// The derivatives of the steps of `path`, which solved this model: their coefficients on its grid.
    ///
    /// # Errors
    /// [`ContactError::Periodic`] of a periodic cell, [`ContactError::WithHardness`] of a pressure that is cut;
    /// coefficients that are not finite; as
    /// [`Model::with_parameter`](crate::Model::with_parameter).
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
    /// The derivatives of a step, in the order of the parameters: one product with `K_θ` each, and one linear system on
    /// the elements in contact for all of them.
    ///
    /// # Panics
    /// If there is no such step.
    #[must_use]
    pub fn at(&self, step: usize) -> Vec<Sensitivity> {
        let (window, pressure) = self.pressed(step);
        let part = self.problem.window(&window);
        let rates = part.and_then(|mut part| pressure_per_penetration(&mut part, &pressure));
        let area = self.path.grid.element_area();
        let of_change = |(value, change): &(f64, Change)| {
            let changed = change.under(&window, &pressure);
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
                energy,
                penetration,
                force,
            }
        };
        self.changes.iter().map(of_change).collect()
    }

    /// `∂E/∂θ` of a step alone, in J per unit of each number: no linear system.
    ///
    /// # Panics
    /// If there is no such step.
    #[must_use]
    pub fn energies(&self, step: usize) -> Vec<f64> {
        let (window, pressure) = self.pressed(step);
        let area = self.path.grid.element_area();
        let of_change = |(_, change): &(f64, Change)| {
            area * change_of_energy(&pressure, &change.under(&window, &pressure))
        };
        self.changes.iter().map(of_change).collect()
    }

    /// The energy `E = ∫ D dQ` of a step, in J: `½ (D Q + A g0·p)`, since `(K + η) p + g0 = D` where p is not zero, and
    /// `A Σ (∫ w* dp − ½ w* p)` of springs that are not linear.
    ///
    /// # Panics
    /// If there is no such step.
    #[must_use]
    pub fn energy(&self, step: usize) -> f64 {
        let (window, pressure) = self.pressed(step);
        let gap = window.cut(self.problem.initial_gap());
        let pairs = pressure.iter().zip(gap).filter(|(p, _)| **p > 0.0);
        let weighted: f64 = pairs.map(|(p, gap)| p * gap).sum();
        let springs = window.cut(self.problem.relief_compliance());
        let law = self.problem.spring_law();
        let bent = springs.iter().zip(&pressure);
        let bent = bent.map(|(eta, p)| law.energy(*eta, *p) - 0.5 * law.shortening(*eta, *p) * p);
        let bent: f64 = bent.sum();
        let penetration = self.path.steps[step].solution.penetration;
        let area = self.path.grid.element_area();
        0.5 * area * (penetration * sum(&pressure) + weighted) + area * bent
    }

    /// The window that holds a step's pressure, and the pressure on it.
    fn pressed(&self, step: usize) -> (Window, Vec<f64>) {
        let Solution { pressure, .. } = &self.path.steps[step].solution;
        let whole = Window::whole(self.path.grid.size());
        let window = whole.around_pressing(pressure).unwrap_or(whole);
        let part = window.cut(pressure);
        (window, part)
    }
}

/// `½ p·(K_θ + η_θ) p + g0_θ·p`.
fn change_of_energy(pressure: &[f64], changed: &Changed) -> f64 {
    changed.energy + dot(pressure, &changed.gap)
}
