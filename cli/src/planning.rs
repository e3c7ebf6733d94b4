//! Planning of measurements: the expected intervals from the curves of a design, alone, in pairs and together.

pub mod candidate;
pub mod comparison;
pub mod design;
pub mod files;
pub mod picture;
pub mod premises;
pub mod result;
pub mod text;

use pellicle_contact::{Domain, Load, Model, SolverOptions, Warning, solve_path};
use pellicle_identify::{
    ContactCurve, ContactCurves, Curve, CurveOptions, ForwardError, ForwardModel, IdentifyError,
    Information, NullDirections, Observable, Prediction, StopFlag,
};

use self::candidate::CandidateCurve;
use self::premises::Premises;
use crate::failure::Failure;
use crate::identification::findings::WarningResult;
use crate::identification::null_directions;

/// Time between two points of a curve, s; for a drift only the shape matters.
const INTERVAL: f64 = 0.1;

/// Elements per side of the solution that gives the warnings about a model.
const ELEMENTS: usize = 64;

/// A planned measurement: its information, and the directions in which it does not change.
#[derive(Debug)]
pub struct Judged {
    /// The curve.
    pub candidate: CandidateCurve,
    /// Indices, among the unknowns of the plan, of the radii that it depends on.
    pub radii: Vec<usize>,
    /// Its information about the unknowns.
    pub information: Information,
    /// Directions in which it does not change.
    pub directions: NullDirections,
}

/// The curves of a design, each evaluated alone.
#[derive(Debug)]
pub struct Planning<'a> {
    /// The assumed values, noise and indenters.
    pub premises: Premises<'a>,
    /// The curves that could be solved.
    pub judged: Vec<Judged>,
    /// Number of loads solved.
    pub loads_solved: usize,
    /// Warnings for the reader.
    pub warnings: Vec<WarningResult>,
}

impl<'a> Planning<'a> {
    /// Evaluates every candidate; `report` receives the number done, `stop` ends it.
    ///
    /// # Errors
    ///
    /// [`Failure`] if no candidate can be solved, or if the user stops.
    pub fn new(
        premises: Premises<'a>,
        candidates: &[CandidateCurve],
        stop: &StopFlag,
        report: &dyn Fn(usize),
    ) -> Result<Self, Failure> {
        let mut planning = Self {
            premises,
            judged: Vec::new(),
            loads_solved: 0,
            warnings: Vec::new(),
        };
        let mut failed = None;
        for (done, candidate) in candidates.iter().enumerate() {
            if stop.is_raised() {
                return Err(IdentifyError::Stopped { predictions: done }.into());
            }
            if let Err(failure) = planning.judge(candidate) {
                planning.warn("not-solved", candidate, &failure);
                failed = Some(failure);
            }
            report(done + 1);
        }
        match failed {
            Some(failure) if planning.judged.is_empty() => Err(failure),
            _ => Ok(planning),
        }
    }

    fn warn(&mut self, code: &str, candidate: &CandidateCurve, what: &dyn std::fmt::Display) {
        self.warnings.push(WarningResult {
            code: code.into(),
            message: format!("{}: {what}", candidate.words()),
        });
    }

    /// Solves a candidate and keeps its information.
    fn judge(&mut self, candidate: &CandidateCurve) -> Result<(), Failure> {
        let premises = &self.premises;
        let indenter = premises.indenter(candidate.radius);
        let parameters = premises.with_radius(candidate.radius)?;
        let name = indenter.name();
        let is_radius = |key: &str| premises.radius_key() == Some(key);
        let directions = null_directions::named(&parameters, |of| {
            is_radius(&of.key).then(|| name.clone()).flatten()
        })?;
        let curve = ContactCurve {
            model: parameters.model.clone(),
            observable: Observable::DepthAtForce,
            abscissae: candidate.loads(),
            own: premises.own(&indenter),
            origins: Vec::new(),
            thinned: None,
            adhesion: None,
            series: 0.0,
        };
        let curves = ContactCurves::new(vec![curve], premises.sought(), CurveOptions::default())?;
        let values = premises.values(&indenter, candidate.radius);
        let solved = curves.predict(&values).map_err(not_solved)?;
        let load = Load::Force(candidate.forces[1]);
        let warnings = warnings_at(&curves.model(0, &values)?, load)?;
        let (abscissae, prediction) = observed(premises.observe, candidate.loads(), solved);
        let prediction = premises.spread(prediction, &indenter);
        let curve = timed(abscissae, &prediction)?;
        let information = premises.plan.information(&prediction, &[curve])?;
        self.judged.push(Judged {
            candidate: candidate.clone(),
            radii: premises.place(&indenter).into_iter().collect(),
            information,
            directions,
        });
        self.loads_solved += curves.loads_solved();
        for warning in warnings {
            self.warn(warning.code(), candidate, &words(&warning));
        }
        Ok(())
    }
}

/// Returns the warnings about a model under a load.
fn warnings_at(model: &Model, load: Load) -> Result<Vec<Warning>, Failure> {
    let options = SolverOptions {
        contact_stiffness: false,
        ..SolverOptions::default()
    };
    let domain = Domain::Automatic;
    let path = solve_path(model, domain, ELEMENTS, &[load], &options, &mut ())?;
    let is_of_model = |warning: &Warning| {
        matches!(
            warning,
            Warning::FilmShortening { .. } | Warning::SteepIndenter { .. }
        )
    };
    Ok(path.warnings.into_iter().filter(is_of_model).collect())
}

/// Returns the warning without its step number; there is only one step.
fn words(warning: &Warning) -> String {
    let words = warning.to_string();
    words.trim_start_matches("step 0: ").to_owned()
}

/// The failure for a model without a prediction.
fn not_solved(error: ForwardError) -> Failure {
    match error {
        ForwardError::OutOfRange { source } => Failure::NotPlanned(source.to_string()),
        other => Failure::NotPlanned(other.to_string()),
    }
}

/// Builds a curve of the expected values, with its points evenly spaced in time.
fn timed(abscissae: Vec<f64>, prediction: &Prediction) -> Result<Curve, IdentifyError> {
    let times = (0..abscissae.len()).map(|i| i as f64 * INTERVAL).collect();
    Curve::new(abscissae, prediction.value.clone())?.with_time(times)
}

/// Returns depths at forces, or converts them to forces at these depths.
fn observed(observe: Observable, forces: Vec<f64>, depths: Prediction) -> (Vec<f64>, Prediction) {
    if observe != Observable::ForceAtDepth {
        return (forces, depths);
    }
    let Prediction {
        value,
        slope,
        derivatives,
        ..
    } = depths;
    // ∂Q/∂θ|_D = −(dQ/dD) ∂D/∂θ|_Q
    let at_depth = |column: Vec<f64>| {
        let pairs = column.iter().zip(&slope);
        pairs.map(|(change, slope)| -change / slope).collect()
    };
    let prediction = Prediction {
        value: forces,
        derivatives: derivatives.into_iter().map(at_depth).collect(),
        slope: slope.iter().map(|slope| slope.recip()).collect(),
        origins: Vec::new(),
    };
    (value, prediction)
}
