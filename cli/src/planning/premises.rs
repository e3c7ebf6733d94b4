//! What a plan takes for true: the values of the model, or those of a fit; its noise, and the indenters.

use pellicle_contact::ModelParameter;
use pellicle_identify::{
    Amount, Fit, IdentifyError, NoiseLevels, Plan, Prediction, Prior, Unknown,
};

use super::candidate::Candidate;
use crate::failure::Failure;
use crate::fit_file::FitFile;
use crate::fit_file::model::ModelParameters;
use crate::fit_file::unknown::UnknownCase;
use crate::identification::{Identification, curve_source};
use crate::measured::data_table::Observe;

/// Noise over the value of what is observed, where the fit file says nothing of noise.
const RELATIVE: f64 = 0.01;
/// Radii that differ by less are one.
const SAME: f64 = 1e-9;

/// What a plan takes for true.
#[derive(Debug)]
pub struct Premises<'a> {
    /// The fit file.
    pub file: &'a FitFile,
    /// What is sought, at which values, with which noise.
    pub plan: Plan,
    /// What is observed.
    pub observe: Observe,
    /// Where the noise is from.
    pub noise: NoiseSource,
    base: ModelParameters,
    cases: Vec<UnknownCase>,
    /// Radii of indenters that are sought besides that of the model, each with its place among the unknowns.
    others: Vec<(f64, usize)>,
    /// Radii that tables have of their own, which a fit takes for known.
    known: Vec<f64>,
}

/// Where the noise of a plan comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoiseSource {
    /// The fit file or a fit.
    Known,
    /// Nowhere: it is assumed.
    Assumed,
}

/// How a plan knows the radius of an indenter.
#[derive(Debug, Clone, PartialEq)]
pub enum Indenter {
    /// It is that of the model.
    OfModel,
    /// It is another one, and known exactly.
    Known(String),
    /// It is another one, and sought as that of the model is: its place among the unknowns, and its name.
    Sought(usize, String),
}

impl Indenter {
    /// The name of its radius, if that is not the key of the model's.
    #[must_use]
    pub fn name(&self) -> Option<String> {
        match self {
            Self::OfModel => None,
            Self::Known(name) | Self::Sought(_, name) => Some(name.clone()),
        }
    }
}

impl<'a> Premises<'a> {
    /// The premises before any measurement: the values of the model, the noise of the fit file.
    ///
    /// # Errors
    ///
    /// [`Failure`] if the tables of the fit file disagree, or do not observe what can be planned.
    pub fn of_file(file: &'a FitFile, candidates: &[Candidate]) -> Result<Self, Failure> {
        let cases = file.all_unknowns();
        let truth = cases.iter().map(|case| case.start).collect();
        let (noise, source) = noise(file)?;
        let mut premises = Self::new(file, cases, truth, noise)?;
        premises.noise = source;
        premises.seek_radii(candidates)?;
        Ok(premises)
    }

    /// The premises after a fit: its values, its noise, the scatter between repeats.
    ///
    /// # Errors
    ///
    /// [`Failure`] if the tables do not observe what can be planned.
    pub fn of_fit(
        of: &'a Identification,
        fit: &Fit,
        candidates: &[Candidate],
    ) -> Result<Self, Failure> {
        let estimates = || fit.estimates.iter();
        let truth = estimates().map(|estimate| estimate.value).collect();
        let mut premises = Self::new(&of.file, of.file.all_unknowns(), truth, fit.noise)?;
        // The unknowns of a fit file are sought by their logarithms.
        let scatter = estimates().map(|estimate| {
            let between = estimate.between_curves.as_ref();
            between.map_or(0.0, |between| between.standard_deviation / estimate.value)
        });
        premises.plan.scatter = scatter.collect();
        premises.plan.degrees_of_freedom = estimates()
            .map(|estimate| estimate.degrees_of_freedom)
            .collect();
        premises.seek_radii(candidates)?;
        Ok(premises)
    }

    fn new(
        file: &'a FitFile,
        cases: Vec<UnknownCase>,
        truth: Vec<f64>,
        noise: NoiseLevels,
    ) -> Result<Self, Failure> {
        let observe = file
            .data
            .first()
            .map_or(Observe::default(), |table| table.observe);
        if let (Observe::StiffnessAtContactRadius, Some(table)) = (observe, file.data.first()) {
            let wanted = "\"depth at force\" or \"force at depth\" to plan";
            return Err(table.wanted("observe", wanted).into());
        }
        let sought = file.unknowns.iter().map(UnknownCase::unknown);
        let nuisances = file.nuisances.parameters.iter();
        let nuisances = nuisances.map(|case| case.unknown().map(Unknown::as_nuisance));
        let plan = Plan {
            unknowns: sought.chain(nuisances).collect::<Result<_, _>>()?,
            scatter: vec![0.0; truth.len()],
            degrees_of_freedom: vec![f64::INFINITY; truth.len()],
            truth,
            nuisances: file.nuisances.linear()?,
            noise,
        };
        Ok(Self {
            file,
            plan,
            observe,
            noise: NoiseSource::Known,
            base: file.model.parameters()?,
            cases,
            others: Vec::new(),
            known: known_radii(file)?,
        })
    }

    /// The radius of each other indenter becomes an unknown, if that of the model is one.
    fn seek_radii(&mut self, candidates: &[Candidate]) -> Result<(), Failure> {
        let Some(place) = self.place_of_radius() else {
            return Ok(());
        };
        let radii = candidates.iter().filter_map(|candidate| candidate.radius);
        for radius in radii {
            if self.indenter(Some(radius)) != Indenter::Known(self.name_of(radius)) {
                continue;
            }
            if self.known.iter().any(|known| is_same(*known, radius)) {
                continue;
            }
            let unknown = scaled(&self.cases[place], self.name_of(radius), radius)?;
            let unknown = if place < self.file.unknowns.len() {
                unknown
            } else {
                unknown.as_nuisance()
            };
            let plan = &mut self.plan;
            self.others.push((radius, plan.unknowns.len()));
            plan.unknowns.push(unknown);
            plan.truth.push(radius);
            plan.scatter.push(plan.scatter[place]);
            plan.degrees_of_freedom.push(plan.degrees_of_freedom[place]);
        }
        Ok(())
    }

    /// How the radius of an indenter is known.
    #[must_use]
    pub fn indenter(&self, radius: Option<f64>) -> Indenter {
        let Some(radius) = radius else {
            return Indenter::OfModel;
        };
        if self.own_radius().is_some_and(|own| is_same(own, radius)) {
            return Indenter::OfModel;
        }
        let name = self.name_of(radius);
        let mut others = self.others.iter();
        match others.find(|(other, _)| is_same(*other, radius)) {
            Some((_, place)) => Indenter::Sought(*place, name),
            None => Indenter::Known(name),
        }
    }

    fn name_of(&self, radius: f64) -> String {
        let key = self.radius_key().unwrap_or_default();
        format!("{key} of {}", super::candidate::radius_words(radius))
    }

    /// The radius of the model as the fit file has it.
    fn own_radius(&self) -> Option<f64> {
        self.base.value(self.base.radius()?)
    }

    /// The key of the radius of the indenter, if it has one.
    #[must_use]
    pub fn radius_key(&self) -> Option<&str> {
        Some(self.base.radius()?.key.as_str())
    }

    /// The place of the radius of the model among the unknowns, if it is sought.
    #[must_use]
    pub fn place_of_radius(&self) -> Option<usize> {
        let of = self.base.radius()?;
        self.cases.iter().position(|case| case.key == of.key)
    }

    /// The place of the radius of an indenter among the unknowns, if it is sought.
    #[must_use]
    pub fn place(&self, indenter: &Indenter) -> Option<usize> {
        match indenter {
            Indenter::OfModel => self.place_of_radius(),
            Indenter::Sought(place, _) => Some(*place),
            Indenter::Known(_) => None,
        }
    }

    /// The model with an indenter of this radius.
    ///
    /// # Errors
    ///
    /// [`Failure`] if there is no such indenter.
    pub fn with_radius(&self, radius: Option<f64>) -> Result<ModelParameters, Failure> {
        let model = match (radius, self.base.radius()) {
            (Some(radius), Some(of)) => self.base.model.with_parameter(of.parameter, radius)?,
            _ => self.base.model.clone(),
        };
        Ok(ModelParameters {
            model,
            parameters: self.base.parameters.clone(),
        })
    }

    /// What is sought of a curve.
    #[must_use]
    pub fn sought(&self) -> Vec<ModelParameter> {
        self.cases.iter().map(|case| case.parameter).collect()
    }

    /// What is not sought of a curve of this indenter.
    #[must_use]
    pub fn own(&self, indenter: &Indenter) -> Vec<ModelParameter> {
        match (indenter, self.base.radius()) {
            (Indenter::Known(_), Some(of)) => vec![of.parameter],
            _ => Vec::new(),
        }
    }

    /// The true values for a curve of this indenter.
    #[must_use]
    pub fn values(&self, indenter: &Indenter, radius: Option<f64>) -> Vec<f64> {
        let mut values = self.plan.truth[..self.cases.len()].to_vec();
        if let (Indenter::Sought(..), Some(radius), Some(place)) =
            (indenter, radius, self.place_of_radius())
        {
            values[place] = radius;
        }
        values
    }

    /// The prediction with derivatives by all unknowns of the plan: by its own radius, and by no other one.
    #[must_use]
    pub fn spread(&self, mut prediction: Prediction, indenter: &Indenter) -> Prediction {
        let nothing = vec![0.0; prediction.value.len()];
        let unknowns = self.plan.unknowns.len();
        prediction.derivatives.resize(unknowns, nothing);
        if let (Indenter::Sought(own, _), Some(place)) = (indenter, self.place_of_radius()) {
            prediction.derivatives.swap(*own, place);
        }
        prediction
    }

    /// The unknowns of the fit file, which come first among those of the plan.
    #[must_use]
    pub fn cases(&self) -> &[UnknownCase] {
        &self.cases
    }
}

fn is_same(one: f64, other: f64) -> bool {
    (one / other - 1.0).abs() < SAME
}

/// The radii that tables have of their own.
fn known_radii(file: &FitFile) -> Result<Vec<f64>, Failure> {
    let mut radii = Vec::new();
    for table in &file.data {
        let of = file.model.with(&table.set)?;
        let own = crate::identification::own(table, &of);
        let radius = of.radius().filter(|radius| own.contains(&radius.parameter));
        radii.extend(radius.and_then(|radius| of.value(radius)));
    }
    Ok(radii)
}

/// What is known of the radius of the model, for another indenter: the same over its radius.
fn scaled(case: &UnknownCase, name: String, radius: f64) -> Result<Unknown, IdentifyError> {
    let part = radius / case.start;
    let unknown = Unknown::positive(name, case.range.map(|end| part * end))?.starting_at(radius)?;
    match case.prior {
        None => Ok(unknown),
        Some(Prior::Lognormal { median, factor }) => unknown.with_prior(Prior::Lognormal {
            median: part * median,
            factor,
        }),
        Some(Prior::Normal { mean, sd }) => unknown.with_prior(Prior::Normal {
            mean: part * mean,
            sd: part * sd,
        }),
    }
}

/// The noise of the fit file; what is left out of it is none, and all of it is assumed if it says nothing of what is
/// observed.
fn noise(file: &FitFile) -> Result<(NoiseLevels, NoiseSource), Failure> {
    let noise = curve_source::noise(file)?;
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
