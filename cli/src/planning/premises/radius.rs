//! The indenter radii of a plan: which ones are unknown, and the model with another radius.

use pellicle_contact::ModelParameter;
use pellicle_identify::fit_file::model::ModelParameters;
use pellicle_identify::fit_file::unknown::UnknownCase;
use pellicle_identify::{IdentifyError, Prior, Unknown};

use super::{IndenterRadius, Premises};
use crate::failure::Failure;
use crate::planning::candidate::{CandidateCurve, radius_words};

/// Relative difference below which two radii are the same.
const SAME: f64 = 1e-9;

impl Premises<'_> {
    /// Makes the radius of each other indenter an unknown, if that of the model is one.
    pub(super) fn seek_radii(&mut self, candidates: &[CandidateCurve]) -> Result<(), Failure> {
        let Some(place) = self.place_of_radius() else {
            return Ok(());
        };
        let radii = candidates.iter().filter_map(|candidate| candidate.radius);
        for radius in radii {
            if self.indenter(Some(radius)) != IndenterRadius::Known(self.name_of(radius)) {
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
        }
        Ok(())
    }

    /// Returns what is known about an indenter's radius; without a radius, it is that of the model.
    #[must_use]
    pub fn indenter(&self, radius: Option<f64>) -> IndenterRadius {
        let Some(radius) = radius else {
            return IndenterRadius::OfModel;
        };
        if self.own_radius().is_some_and(|own| is_same(own, radius)) {
            return IndenterRadius::OfModel;
        }
        let name = self.name_of(radius);
        let mut others = self.others.iter();
        match others.find(|(other, _)| is_same(*other, radius)) {
            Some((_, place)) => IndenterRadius::Sought(*place, name),
            None => IndenterRadius::Known(name),
        }
    }

    fn name_of(&self, radius: f64) -> String {
        let key = self.radius_key().unwrap_or_default();
        format!("{key} of {}", radius_words(radius))
    }

    /// Radius of the model as given in the fit file.
    fn own_radius(&self) -> Option<f64> {
        self.base.value(self.base.radius()?)
    }

    /// The key of the indenter's radius, if it has one.
    #[must_use]
    pub fn radius_key(&self) -> Option<&str> {
        Some(self.base.radius()?.key.as_str())
    }

    /// Index of the model's radius among the unknowns, if it is one of them.
    #[must_use]
    pub fn place_of_radius(&self) -> Option<usize> {
        let of = self.base.radius()?;
        self.cases.iter().position(|case| case.key == of.key)
    }

    /// Index of an indenter's radius among the unknowns, if it is one of them.
    #[must_use]
    pub fn place(&self, indenter: &IndenterRadius) -> Option<usize> {
        match indenter {
            IndenterRadius::OfModel => self.place_of_radius(),
            IndenterRadius::Sought(place, _) => Some(*place),
            IndenterRadius::Known(_) => None,
        }
    }

    /// Returns the model with an indenter of this radius.
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
            adhesion: self.base.adhesion,
            parameters: self.base.parameters.clone(),
        })
    }

    /// The parameters of the model that a curve of this indenter overrides: its radius, if it is known.
    #[must_use]
    pub fn own(&self, indenter: &IndenterRadius) -> Vec<ModelParameter> {
        match (indenter, self.base.radius()) {
            (IndenterRadius::Known(_), Some(of)) => vec![of.parameter],
            _ => Vec::new(),
        }
    }
}

fn is_same(one: f64, other: f64) -> bool {
    (one / other - 1.0).abs() < SAME
}

/// Builds the unknown for another indenter's radius: range and prior are those of the model's radius, scaled.
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
