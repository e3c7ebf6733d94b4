//! The premises of a plan: the values of the model, the noise, and the indenters.

mod radius;

use pellicle_contact::ModelParameter;
use pellicle_identify::fit_file::FitFile;
use pellicle_identify::fit_file::model::ModelParameters;
use pellicle_identify::fit_file::unknown::UnknownCase;
use pellicle_identify::{Amount, NoiseLevels, Observable, Plan, Prediction, Reading, Unknown};

use super::candidate::CandidateCurve;
use crate::failure::Failure;
use crate::identification::curve_source;

/// Relative noise of the observable assumed if the fit file gives no noise.
const RELATIVE: f64 = 0.01;

/// The premises of a plan.
#[derive(Debug)]
pub struct Premises<'a> {
    /// The fit file.
    pub file: &'a FitFile,
    /// The unknowns, their assumed values, and the noise.
    pub plan: Plan,
    /// The observable of every curve.
    pub observe: Observable,
    /// Source of the noise.
    pub noise: NoiseSource,
    base: ModelParameters,
    cases: Vec<UnknownCase>,
    /// Unknown radii of indenters other than the model's, each with its index among the unknowns.
    others: Vec<(f64, usize)>,
    /// Radii given in tables, which a fit takes as known.
    known: Vec<f64>,
}

/// Source of the noise of a plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoiseSource {
    /// The fit file.
    Known,
    /// No source: it is assumed.
    Assumed,
}

/// What a plan knows about an indenter's radius.
#[derive(Debug, Clone, PartialEq)]
pub enum IndenterRadius {
    /// The radius of the model.
    OfModel,
    /// Another radius, known exactly.
    Known(String),
    /// Another radius, unknown like that of the model: its index among the unknowns, and its name.
    Sought(usize, String),
}

impl IndenterRadius {
    /// Returns the name of the radius, if that is not the key of the model's.
    #[must_use]
    pub fn name(&self) -> Option<String> {
        match self {
            Self::OfModel => None,
            Self::Known(name) | Self::Sought(_, name) => Some(name.clone()),
        }
    }
}

impl<'a> Premises<'a> {
    /// Builds the premises: the values of the model, the noise of the fit file.
    ///
    /// # Errors
    ///
    /// [`Failure`] if the tables of the fit file disagree, or if their observable cannot be planned.
    pub fn new(file: &'a FitFile, candidates: &[CandidateCurve]) -> Result<Self, Failure> {
        file.refuse_adhesion("to plan")?;
        let observe = (file.data.first()).map_or(Observable::default(), |table| table.observe);
        if let (Reading::Stiffness, Some(table)) = (observe.observed(), file.data.first()) {
            let wanted = "\"depth at force\" or \"force at depth\" to plan";
            return Err(table.wanted("observe", wanted).into());
        }
        let sought = file.unknowns.iter().map(UnknownCase::unknown);
        let nuisances = file.nuisances.parameters.iter();
        let nuisances = nuisances.map(|case| case.unknown().map(Unknown::as_nuisance));
        let cases = file.all_unknowns();
        let (noise, source) = noise(file)?;
        let plan = Plan {
            unknowns: sought.chain(nuisances).collect::<Result<_, _>>()?,
            truth: cases.iter().map(|case| case.start).collect(),
            nuisances: file.nuisances.linear(observe, &[])?,
            noise,
        };
        let mut premises = Self {
            file,
            plan,
            observe,
            noise: source,
            base: file.model.parameters()?,
            cases,
            others: Vec::new(),
            known: known_radii(file)?,
        };
        premises.seek_radii(candidates)?;
        Ok(premises)
    }

    /// The unknowns and nuisances on which a curve depends.
    #[must_use]
    pub fn sought(&self) -> Vec<ModelParameter> {
        self.cases.iter().map(|case| case.parameter).collect()
    }

    /// Returns the true values for a curve of this indenter.
    #[must_use]
    pub fn values(&self, indenter: &IndenterRadius, radius: Option<f64>) -> Vec<f64> {
        let mut values = self.plan.truth[..self.cases.len()].to_vec();
        if let (IndenterRadius::Sought(..), Some(radius), Some(place)) =
            (indenter, radius, self.place_of_radius())
        {
            values[place] = radius;
        }
        values
    }

    /// Returns the prediction with derivatives with respect to all unknowns of the plan; of the radii, only its own
    /// counts.
    #[must_use]
    pub fn spread(&self, mut prediction: Prediction, indenter: &IndenterRadius) -> Prediction {
        let nothing = vec![0.0; prediction.value.len()];
        let unknowns = self.plan.unknowns.len();
        prediction.derivatives.resize(unknowns, nothing);
        if let (IndenterRadius::Sought(own, _), Some(place)) = (indenter, self.place_of_radius()) {
            prediction.derivatives.swap(*own, place);
        }
        prediction
    }

    /// The unknowns of the fit file, the first among those of the plan.
    #[must_use]
    pub fn cases(&self) -> &[UnknownCase] {
        &self.cases
    }
}

/// The noise of the fit file. Levels it leaves to be estimated are zero; if it gives none for the observable, the noise
/// is assumed.
fn noise(file: &FitFile) -> Result<(NoiseLevels, NoiseSource), Failure> {
    let noise = curve_source::noise(file, &[], &[])?;
    let level = |amount| match amount {
        Amount::Given(level) => level,
        Amount::Estimated => 0.0,
    };
    let [observed, abscissa, relative] =
        [noise.observed, noise.abscissa, noise.relative].map(level);
    let is_assumed = noise.observed == Amount::Estimated && relative == 0.0;
    let levels = NoiseLevels {
        observed,
        abscissa,
        relative: if is_assumed { RELATIVE } else { relative },
        persistence: 0.0,
        white_fraction: 1.0,
    };
    let source = if is_assumed {
        NoiseSource::Assumed
    } else {
        NoiseSource::Known
    };
    Ok((levels, source))
}

/// The radii given in tables.
fn known_radii(file: &FitFile) -> Result<Vec<f64>, Failure> {
    let mut radii = Vec::new();
    for table in &file.data {
        let of = file.model.with(&table.set)?;
        let own = of.given_in(&table.set);
        let radius = of.radius().filter(|radius| own.contains(&radius.parameter));
        radii.extend(radius.and_then(|radius| of.value(radius)));
    }
    Ok(radii)
}
