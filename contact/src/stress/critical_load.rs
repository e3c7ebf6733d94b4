//! Critical loads: the smallest force at which a body yields or cracks, or an interface debonds.

use serde::{Deserialize, Serialize};

use super::body_extremes::{BodyStress, InterfaceStress, StressExtremes, interface_name};
use super::extreme::Extreme;
use super::extreme_finder::ExtremeFinder;
use super::load_search::{LoadSearch, LoadSearchResult, Solved};
use super::model::{Criterion, StressModel};
use super::plane_scan::Target;
use super::solved_loads::SolvedLoads;
use crate::{ContactError, Domain, LoadingPath, Model, Observer, SolverOptions};

/// Whether a strength is reached.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CriticalStatus {
    /// Under the critical force.
    Met,
    /// Without any load: the residual stress reaches the strength alone.
    AtRest,
    /// Under no load up to the largest of the path.
    #[default]
    NotReached,
    /// Already under the smallest load tried.
    BelowSmallest,
    /// Under the critical force, but there the contact is [beyond the model](crate::Status::BeyondModel).
    BeyondModel,
}

/// The load at which one criterion is first met.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CriticalLoad {
    /// The failure criterion.
    pub criterion: Criterion,
    /// The body or interface: `layer[0]`, `substrate`, `interface[0]`.
    pub name: String,
    /// Strength, in Pa.
    pub strength: f64,
    /// Whether the strength is reached; the default in a file older than this field.
    #[serde(default)]
    pub status: CriticalStatus,
    /// The smallest force at which the strength is reached, in N, 0 at rest; none if the status says otherwise.
    pub force: Option<f64>,
    /// The penetration under this force, in m.
    pub penetration: Option<f64>,
    /// The place of failure, (x, y, z) in m.
    pub at: Option<[f64; 3]>,
    /// Half-width of the interval around the force that contains the truth, for the error of the grid alone, in N.
    pub estimate: Option<f64>,
    /// Whether the stress settles as the grid is refined.
    pub resolved: bool,
    /// The ratio of stress to strength: 1 at a critical load, else under the largest or smallest load tried.
    pub utilisation: f64,
}

/// One criterion: the quantity, its depth range, and its extremes under the loads of the path.
struct CriterionSearch {
    criterion: Criterion,
    name: String,
    strength: f64,
    target: Target,
    known: Vec<Extreme<3>>,
}

/// Finds the critical load of every strength given, up to the largest load of a solved path with these extremes.
///
/// A stress may first grow and then fall with the load. If it comes near its strength but reaches it under no load of
/// the path, loads around the one with the largest stress are tried.
///
/// # Errors
/// [`ContactError::WithHardness`] with a hardness; [`ContactError::StressLeftOut`] if the extremes lack the quantity of
/// a strength that is given; those of [`solve_path`](crate::solve_path) and
/// [`stress_extremes`](super::body_extremes::stress_extremes); [`ContactError::Cancelled`] if the observer cancels.
///
/// # Panics
/// If a step has no extremes, or extremes of another stress model.
pub fn critical_loads(
    model: &Model,
    path: &LoadingPath,
    extremes: &[StressExtremes],
    domain: Domain,
    options: &SolverOptions,
    stress: &StressModel,
    observer: &mut dyn Observer,
) -> Result<Vec<CriticalLoad>, ContactError> {
    assert_eq!(extremes.len(), path.steps.len(), "extremes of each step");
    if options.hardness.is_finite() {
        return Err(ContactError::WithHardness {
            what: "critical loads",
        });
    }
    let options = SolverOptions {
        coarse_pressures: true,
        contact_stiffness: false,
        ..*options
    };
    let mut loads = SolvedLoads::new(model, path.grid.size(), options, observer);
    let mut rough = ExtremeFinder::rough_depths(path, stress.sliding)?;
    let mut found = Vec::new();
    for criterion in criteria(stress, extremes)? {
        let at_rest = criterion.at_rest(stress);
        if at_rest >= criterion.strength {
            found.push(criterion.failed_at_rest(at_rest));
            continue;
        }
        let steps = path.steps.iter().zip(&criterion.known);
        let solved = steps.map(|(step, extreme)| Solved {
            force: step.solution.force,
            penetration: step.solution.penetration,
            radius: step.summary.contact_radius,
            is_beyond: step.beyond().is_some(),
            extreme: *extreme,
            followed_on: None,
        });
        let mut solved: Vec<Solved> = solved.collect();
        solved.sort_by(|one, other| one.force.total_cmp(&other.force));
        let mut search = LoadSearch {
            loads: &mut loads,
            domain,
            sliding: stress.sliding,
            target: &criterion.target,
            strength: criterion.strength,
            residual: &stress.residual,
            at_rest,
            solved,
            follows: stress.residual.is_none(),
            rough: &mut rough,
        };
        let outcome = search.search()?;
        found.push(criterion.into_critical_load(&outcome, at_rest));
    }
    Ok(found)
}

/// Collects the criteria for which strengths are given.
fn criteria(
    stress: &StressModel,
    extremes: &[StressExtremes],
) -> Result<Vec<CriterionSearch>, ContactError> {
    let mut searches = Vec::new();
    let mut add = |criterion: Criterion,
                   name: &str,
                   strength: Option<f64>,
                   [top, bottom]: [f64; 2],
                   known: Option<Vec<Extreme<3>>>| {
        let Some(strength) = strength else {
            return Ok(());
        };
        let quantity = criterion.quantity();
        let quantities = vec![quantity];
        let quantity = quantity.name();
        searches.push(CriterionSearch {
            criterion,
            name: name.to_owned(),
            strength,
            target: Target {
                top,
                bottom,
                quantities,
            },
            known: known.ok_or(ContactError::StressLeftOut { quantity })?,
        });
        Ok::<(), ContactError>(())
    };
    for (index, body) in stress.bodies.iter().enumerate() {
        let (strengths, range) = (body.strengths, [body.top, body.bottom]);
        let known = |of: fn(&BodyStress) -> Option<Extreme<3>>| {
            let steps = extremes.iter().map(|step| of(&step.bodies[index]));
            steps.collect()
        };
        let (yielding, tension) = (
            known(|body| body.max_von_mises),
            known(|body| body.max_principal),
        );
        let strength = strengths.yield_strength;
        add(Criterion::Yield, &body.name, strength, range, yielding)?;
        let strength = strengths.tensile_strength;
        add(Criterion::Tension, &body.name, strength, range, tension)?;
    }
    for (index, interface) in stress.interfaces.iter().enumerate() {
        let (strengths, depth) = (interface.strengths, interface.depth);
        let name = interface_name(stress.bodies.first(), interface.index);
        let range = [depth; 2];
        let known = |of: fn(&InterfaceStress) -> Option<Extreme<2>>| {
            let steps = extremes.iter().map(|step| of(&step.interfaces[index]));
            steps
                .map(|extreme| Some(extreme?.at_depth(depth)))
                .collect()
        };
        let (shear, tension) = (
            known(|interface| interface.max_shear_traction),
            known(|interface| interface.max_tension),
        );
        let strength = strengths.shear_strength;
        add(Criterion::InterfaceShear, &name, strength, range, shear)?;
        let strength = strengths.tensile_strength;
        add(Criterion::InterfaceTension, &name, strength, range, tension)?;
    }
    Ok(searches)
}

impl CriterionSearch {
    /// The stress without a load, Pa.
    fn at_rest(&self, stress: &StressModel) -> f64 {
        let at_rest = self
            .target
            .at_rest(self.criterion.quantity(), &stress.residual);
        at_rest.max(0.0)
    }

    /// The critical load of a body that fails without one.
    fn failed_at_rest(self, at_rest: f64) -> CriticalLoad {
        CriticalLoad {
            criterion: self.criterion,
            name: self.name,
            strength: self.strength,
            status: CriticalStatus::AtRest,
            force: Some(0.0),
            penetration: Some(0.0),
            at: None,
            estimate: Some(0.0),
            resolved: true,
            utilisation: at_rest / self.strength,
        }
    }

    /// Turns the result of a search into a critical load.
    fn into_critical_load(self, outcome: &LoadSearchResult, at_rest: f64) -> CriticalLoad {
        let (met, last) = match outcome {
            LoadSearchResult::Met { solved, exponent } => (Some((solved, exponent)), Some(solved)),
            LoadSearchResult::Missed(last) => (None, last.as_ref()),
        };
        let extreme = last.map(|solved| solved.extreme);
        // δQ/Q = δσ/(σ − σ₀) / n, σ₀ the stress without a load. A stress grows no faster than its load for long, so a
        // larger n is one between two peaks.
        let error = met.and_then(|(solved, exponent)| {
            let Extreme {
                value, estimate, ..
            } = solved.extreme;
            Some(solved.force * estimate? / (value - at_rest).abs() / exponent.min(1.0))
        });
        let utilisation = extreme.map_or(0.0, |extreme| extreme.value.max(0.0) / self.strength);
        CriticalLoad {
            criterion: self.criterion,
            name: self.name,
            strength: self.strength,
            status: match met {
                Some((solved, _)) if solved.is_beyond => CriticalStatus::BeyondModel,
                Some(_) => CriticalStatus::Met,
                None if utilisation < 1.0 => CriticalStatus::NotReached,
                None => CriticalStatus::BelowSmallest,
            },
            force: met.map(|(solved, _)| solved.force),
            penetration: met.map(|(solved, _)| solved.penetration),
            at: met.map(|(solved, _)| solved.extreme.at),
            estimate: error,
            resolved: extreme.is_some_and(|extreme| extreme.resolved),
            utilisation,
        }
    }
}

#[cfg(test)]
mod tests;
