//! The forward model: penetrations of a contact as functions of its parameters, and their derivatives.
//!
//! A measured curve has up to a hundred thousand points, but the contact is solved at only a few loads. Axisymmetric
//! contacts need no grid; polynomials through a few of them give all points (`branch.rs`). Of others the energies
//! `E(Q) = ∫ D dQ` and the derivatives `∂E/∂θ` are extrapolated from two grids, and [`ForceCurve`]s through them give
//! `D = dE/dQ`, `dD/dQ` and `∂D/∂θ` at every point. As the parameters change, each load's domain scales with its
//! contact, so the same elements stay in contact and no jump comes from one that enters.
//!
//! [`ForceCurve`]: pellicle_contact::ForceCurve

mod axisymmetric;
mod branch;
mod calibration;
mod chebyshev;
mod curve;
mod fixed_number;
mod force_scale;
mod forward;
mod grid_error;
mod punch;
mod reading;
mod solved_curve;
mod stiffness;
mod validity;

use std::collections::BTreeSet;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use pellicle_contact::adhesion::{Adhesion, AdhesiveCurve};
use pellicle_contact::{ContactError, Model, ModelParameter};

use axisymmetric::AxisymmetricModel;
use branch::Branch;
pub use calibration::Calibration;
pub use curve::{ContactCurve, CurveOptions, Observable, Reading, StopFlag, Thinned};
pub use fixed_number::FixedNumber;
pub use force_scale::ForceScale;
pub use punch::ParameterAtPoint;
use solved_curve::{Nodes, SolvedCurve};
pub use validity::Invalidity;

use crate::Prediction;

/// Relative step of a parameter for differentiating a stiffness. The error is 1e-3 from its square, and as much from
/// the grid.
const STIFFNESS_STEP: f64 = 0.03;

/// The curves of several models that share the parameters to be found: a [`ForwardModel`](crate::ForwardModel).
#[derive(Debug)]
pub struct ContactCurves {
    curves: Vec<ContactCurve>,
    methods: Vec<Method>,
    parameters: Vec<ModelParameter>,
    /// One entry per curve.
    scales: Vec<Option<ForceScale>>,
    options: CurveOptions,
    loads_solved: AtomicUsize,
    operator_applications: AtomicUsize,
}

/// How the contacts of a curve are solved.
#[derive(Debug)]
enum Method {
    /// As circles, without a grid.
    Axisymmetric(Last<Branch>),
    /// At these loads on two grids each.
    Grid(Nodes, Last<SolvedCurve>),
    /// As flat punches of the radii of unloadings, without a grid.
    Punches,
}

/// The last solution of a curve, which predictions from other origins share.
type Last<T> = Mutex<Option<Remembered<T>>>;

/// A curve solved at some parameters, with derivatives by numbers of its model.
#[derive(Debug)]
struct Remembered<T> {
    parameters: Vec<f64>,
    sought: Vec<ModelParameter>,
    solved: Arc<T>,
}

impl Method {
    /// The one that applies to a curve and takes the least time.
    fn of(curve: &ContactCurve, options: &CurveOptions) -> Result<Self, ContactError> {
        if curve.observable == Observable::UnloadingStiffness {
            return Ok(Self::Punches);
        }
        if AxisymmetricModel::applies_to(curve) {
            return Ok(Self::Axisymmetric(Mutex::default()));
        }
        Ok(Self::Grid(Nodes::of(curve, options)?, Mutex::default()))
    }
}

impl ContactCurves {
    /// Curves, with the parameters in the order in which a fit passes their values.
    ///
    /// # Errors
    ///
    /// [`ContactError::NoParameter`] for a parameter that none of the models has; a curve without a positive abscissa.
    pub fn new(
        curves: Vec<ContactCurve>,
        parameters: Vec<ModelParameter>,
        options: CurveOptions,
    ) -> Result<Self, ContactError> {
        for wanted in &parameters {
            let has = |curve: &ContactCurve| curve.has(*wanted);
            if !curves.iter().any(has) {
                return Err(ContactError::NoParameter { wanted: *wanted });
            }
        }
        let methods = curves
            .iter()
            .map(|curve| Method::of(curve, &options))
            .collect::<Result<_, _>>()?;
        Ok(Self {
            scales: vec![None; curves.len()],
            curves,
            methods,
            parameters,
            options,
            loads_solved: AtomicUsize::new(0),
            operator_applications: AtomicUsize::new(0),
        })
    }

    /// The same curves with force scales, one or none for each curve. Their constants are further parameters, after
    /// those of the model and ordered by [`ForceScale::constant`].
    #[must_use]
    pub fn with_force_scales(mut self, mut scales: Vec<Option<ForceScale>>) -> Self {
        scales.resize(self.curves.len(), None);
        self.scales = scales;
        self
    }

    /// Loads solved so far; those of differences are not counted.
    #[must_use]
    pub fn loads_solved(&self) -> usize {
        self.loads_solved.load(Ordering::Relaxed)
    }

    /// Products with `K` so far, on the finer of the two grids of each load.
    #[must_use]
    pub fn operator_applications(&self) -> usize {
        self.operator_applications.load(Ordering::Relaxed)
    }

    /// The curves.
    #[must_use]
    pub fn curves(&self) -> &[ContactCurve] {
        &self.curves
    }

    /// The model of a curve at these parameters.
    ///
    /// # Errors
    ///
    /// As [`Model::with_parameters`].
    pub fn model(&self, curve: usize, parameters: &[f64]) -> Result<Model, ContactError> {
        let mut values = self.values_of(curve, parameters);
        values.retain(|(parameter, _)| *parameter != ModelParameter::WorkOfAdhesion);
        self.curves[curve].model.with_parameters(&values)
    }

    /// A curve with its model and its adhesion at these parameters.
    fn curve_at(&self, curve: usize, parameters: &[f64]) -> Result<ContactCurve, ContactError> {
        let values = self.values_of(curve, parameters);
        let work = values
            .iter()
            .find(|(of, _)| *of == ModelParameter::WorkOfAdhesion);
        let given = &self.curves[curve];
        let with_work = |adhesion: Adhesion| Adhesion {
            work: work.map_or(adhesion.work, |(_, work)| *work),
            ..adhesion
        };
        Ok(ContactCurve {
            model: self.model(curve, parameters)?,
            adhesion: given.adhesion.map(with_work),
            ..given.clone()
        })
    }

    /// The contacts with adhesion of a curve at these parameters; none without adhesion.
    ///
    /// # Errors
    ///
    /// As [`AdhesiveCurve::new`].
    pub fn adhesive(
        &self,
        curve: usize,
        parameters: &[f64],
    ) -> Result<Option<AdhesiveCurve>, ContactError> {
        let values = self.values_of(curve, parameters);
        AxisymmetricModel::of(&self.curves[curve], &values)?.adhesive()
    }

    /// The parameters of a curve with these values.
    fn values_of(&self, curve: usize, parameters: &[f64]) -> Vec<(ModelParameter, f64)> {
        let own: BTreeSet<usize> = self.own(curve).collect();
        let parameters = parameters.iter().copied();
        let pairs = self.parameters.iter().copied().zip(parameters);
        let sought = pairs.enumerate().filter(|(index, _)| !own.contains(index));
        sought.map(|(_, pair)| pair).collect()
    }

    /// The parameters that do not change a curve: its own, and those that its model does not have.
    fn own(&self, curve: usize) -> impl Iterator<Item = usize> + '_ {
        let of = &self.curves[curve];
        let parameters = self.parameters.iter().enumerate();
        let is_own = |(_, parameter): &(usize, &ModelParameter)| {
            of.own.contains(parameter) || !of.has(**parameter)
        };
        parameters.filter(is_own).map(|(index, _)| index)
    }

    /// The constants of the force scales among the parameters.
    pub(super) fn constants<'p>(&self, parameters: &'p [f64]) -> &'p [f64] {
        parameters.get(self.parameters.len()..).unwrap_or_default()
    }

    /// One curve at these parameters: its points as read, their slopes, and their derivatives with respect to the
    /// parameters of the model, the constants of the scales, and the numbers `fixed` of its model.
    pub(super) fn predicted(
        &self,
        curve: usize,
        parameters: &[f64],
        origins: &[f64],
        fixed: &[ModelParameter],
    ) -> Result<Prediction, ContactError> {
        let constants = self.constants(parameters);
        let scale = self.scales[curve];
        let factor = scale.map_or(1.0, |scale| scale.factor(constants));
        let origins = self.origins_of(curve, origins);
        let abscissae = self.curves[curve].abscissae_from(origins);
        let mut prediction = self.true_curve(curve, parameters, (&abscissae, factor), fixed)?;
        prediction.origins = origins.to_vec();
        let ContactCurve {
            observable, series, ..
        } = self.curves[curve];
        let change =
            scale.map(|of| of.apply(observable, (factor, series), &abscissae, &mut prediction));
        let by_fixed = prediction.derivatives.split_off(self.parameters.len());
        prediction.extend_by_constants(constants.len());
        if let (Some(scale), Some(change)) = (scale, change)
            && scale.constant < constants.len()
        {
            prediction.derivatives[self.parameters.len() + scale.constant] = change;
        }
        prediction.derivatives.extend(by_fixed);
        Ok(prediction)
    }

    /// The part of the origins of all points that belongs to a curve; empty if there are none.
    pub(super) fn origins_of<'o>(&self, curve: usize, origins: &'o [f64]) -> &'o [f64] {
        let points = |of: &ContactCurve| of.abscissae.len();
        let first: usize = self.curves[..curve].iter().map(points).sum();
        let last = first + points(&self.curves[curve]);
        origins.get(first..last).unwrap_or_default()
    }

    /// One curve at these parameters and abscissae, multiplied by `factor` where they are forces: its points, their
    /// slopes, and their derivatives with respect to the parameters of the model, then the numbers `fixed` of it.
    fn true_curve(
        &self,
        curve: usize,
        parameters: &[f64],
        (abscissae, factor): (&[f64], f64),
        fixed: &[ModelParameter],
    ) -> Result<Prediction, ContactError> {
        if self.options.stop.is_raised() {
            return Err(ContactError::Cancelled { step: 0 });
        }
        let own: BTreeSet<usize> = self.own(curve).collect();
        let all = self.parameters.iter().enumerate();
        let sought = all.filter(|(index, _)| !own.contains(index));
        let sought = sought.map(|(_, parameter)| parameter).chain(fixed);
        let sought: Vec<ModelParameter> = sought.copied().collect();
        let of = &self.curves[curve];
        let observable = of.observable;
        let series = of.series / factor;
        let read = || observable.true_abscissae(abscissae, factor);
        let mut prediction = match &self.methods[curve] {
            Method::Axisymmetric(last) => {
                let model = AxisymmetricModel::of(of, &self.values_of(curve, parameters))?;
                if model.punch_radius().is_some() {
                    model.under_punch(observable, (&read(), series), &sought)?
                } else {
                    let (abscissae, covers) = (read(), |branch: &Branch| branch.covers(&read()));
                    let branch = remembered(last, (parameters, &sought), covers, || {
                        let branch = model.branch(
                            observable,
                            (&abscissae, series),
                            &sought,
                            self.options.loads_per_decade,
                        )?;
                        (self.loads_solved).fetch_add(branch.len(), Ordering::Relaxed);
                        Ok(branch)
                    })?;
                    branch.read(&abscissae)
                }
            }
            Method::Grid(nodes, last) => {
                let model = self.model(curve, parameters)?;
                if observable == Observable::StiffnessAtContactRadius {
                    self.stiffnesses((curve, nodes), &model, &sought)?
                } else {
                    let solved = remembered(
                        last,
                        (parameters, &sought),
                        |_| true,
                        || self.solved(&nodes.with_forces_times(factor), &model, &sought),
                    )?;
                    observable.of(&solved, &read(), series)?
                }
            }
            Method::Punches => of.punch_stiffnesses(&self.model(curve, parameters)?, &sought)?,
        };
        for index in own {
            prediction
                .derivatives
                .insert(index, vec![0.0; abscissae.len()]);
        }
        Ok(prediction)
    }

    /// Solves a curve at its nodes and counts the work.
    fn solved(
        &self,
        nodes: &Nodes,
        model: &Model,
        sought: &[ModelParameter],
    ) -> Result<SolvedCurve, ContactError> {
        let solved = SolvedCurve::of(model, nodes, sought, &self.options)?;
        self.loads_solved.fetch_add(nodes.len(), Ordering::Relaxed);
        (self.operator_applications).fetch_add(solved.products, Ordering::Relaxed);
        Ok(solved)
    }

    /// Stiffnesses at contact radii, differentiated by solving again, because the contact radius has no derivative of
    /// its own.
    fn stiffnesses(
        &self,
        (curve, nodes): (usize, &Nodes),
        model: &Model,
        sought: &[ModelParameter],
    ) -> Result<Prediction, ContactError> {
        let ContactCurve {
            observable,
            abscissae,
            ..
        } = &self.curves[curve];
        let of = |model: &Model| {
            let solved = self.solved(nodes, model, &[])?;
            observable.of(&solved, abscissae, 0.0)
        };
        let mut prediction = of(model)?;
        for parameter in sought {
            let value = model.parameter(*parameter).unwrap_or(f64::NAN);
            let step = STIFFNESS_STEP * value;
            let at = |step: f64| of(&model.with_parameter(*parameter, value + step)?);
            let (more, less) = (at(step)?, at(-step)?);
            let pairs = more.value.iter().zip(&less.value);
            let slopes = pairs.map(|(more, less)| (more - less) / (2.0 * step));
            prediction.derivatives.push(slopes.collect());
        }
        Ok(prediction)
    }
}

/// The last solution of a curve if it was of these parameters and numbers and is fit for use, otherwise a new one.
fn remembered<T>(
    last: &Last<T>,
    (parameters, sought): (&[f64], &[ModelParameter]),
    is_fit: impl Fn(&T) -> bool,
    solve: impl FnOnce() -> Result<T, ContactError>,
) -> Result<Arc<T>, ContactError> {
    let mut last = last.lock().unwrap_or_else(PoisonError::into_inner);
    let is_same = |known: &&Remembered<T>| {
        known.parameters == parameters && known.sought == sought && is_fit(&known.solved)
    };
    if let Some(known) = last.as_ref().filter(is_same) {
        return Ok(known.solved.clone());
    }
    let solved = Arc::new(solve()?);
    *last = Some(Remembered {
        parameters: parameters.to_vec(),
        sought: sought.to_vec(),
        solved: solved.clone(),
    });
    Ok(solved)
}
