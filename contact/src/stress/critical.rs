//! Critical loads: the smallest force at which a body yields or cracks, or an interface comes off.
//!
//! A stress grows about as a power of the load, so that the secant between two solved loads in logarithms meets a
//! strength in a few steps; each is a contact solved on its own grids, and its stresses searched.

use serde::{Deserialize, Serialize};

use super::extremes::{BodyStress, Extreme, InterfaceStress, StressExtremes};
use super::finder::Finder;
use super::model::{Criterion, Sliding, StressModel};
use super::quantity::Quantity;
use super::scan::Target;
use crate::{
    ContactError, Domain, Load, LoadingPath, Model, Observer, SolverOptions, choose_side,
    solve_path,
};

/// Relative accuracy of a critical load.
const ACCURACY: f64 = 5e-5;
/// Loads solved for one criterion, at most.
const MOST_SOLVED: usize = 24;
/// Of these, as many by secants before the bracket is halved.
const MOST_SECANTS: usize = 8;
/// Factor between loads below the smallest of the path, and how many of them are tried.
const SMALLER: f64 = 0.25;
const MOST_SMALLER: usize = 8;
/// Where so much of a strength is reached at most, other loads may reach it; how many of them are tried.
const NEARLY: f64 = 0.7;
const MOST_PROBES: usize = 8;
/// Loads apart by less than this in their logarithms are alike at a peak of the stress.
const FLAT: f64 = 0.1;
/// A bracket this narrow is searched on one domain, so that no change of grid blurs the search.
const NARROW: f64 = 1.5;

/// The load at which one criterion is first met.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CriticalLoad {
    /// How the coating fails.
    pub criterion: Criterion,
    /// The body or interface: `layer[0]`, `substrate`, `interface[0]`.
    pub name: String,
    /// In Pa.
    pub strength: f64,
    /// The smallest force at which the strength is reached, in N; none where it is not reached under the largest load,
    /// or reached under the smallest load tried already.
    pub force: Option<f64>,
    /// The penetration under it, in m.
    pub penetration: Option<f64>,
    /// Where, (x, y, z) in m.
    pub at: Option<[f64; 3]>,
    /// Half the interval around the force that contains the truth as far as the grid is concerned, in N.
    pub estimate: Option<f64>,
    /// Whether the stress settles as the grid is refined.
    pub resolved: bool,
    /// The ratio of stress to strength: 1 at a critical load, else under the largest or smallest load tried.
    pub utilisation: f64,
}

/// One criterion: the quantity, the depths that it is looked for in, and its extremes under the loads of the path.
struct Asked {
    criterion: Criterion,
    name: String,
    strength: f64,
    target: Target,
    known: Vec<Extreme<3>>,
}

/// The extreme under a load.
#[derive(Clone, Copy)]
struct Solved {
    /// In N.
    force: f64,
    /// In m.
    penetration: f64,
    extreme: Extreme<3>,
}

/// The critical load of every strength given, up to the largest load of a solved path, whose steps have these
/// extremes.
///
/// A stress may first grow and then fall with the load. Where it reaches its strength under no load of the path but
/// comes near, loads around the largest are tried.
///
/// # Errors
/// As [`solve_path`] and [`stress_extremes`](super::extremes::stress_extremes); [`ContactError::Cancelled`] by the
/// observer.
///
/// # Panics
/// If a step has no extremes, or those of another model of stress.
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
    let mut found = Vec::new();
    for asked in criteria(stress, extremes) {
        let solutions = path.steps.iter().map(|step| &step.solution);
        let solved = solutions
            .zip(&asked.known)
            .map(|(solution, extreme)| Solved {
                force: solution.force,
                penetration: solution.penetration,
                extreme: *extreme,
            });
        let mut search = LoadSearch {
            model,
            domain,
            elements: path.grid.size(),
            options: SolverOptions {
                coarse_pressures: true,
                contact_stiffness: false,
                ..*options
            },
            sliding: stress.sliding,
            solved: solved.collect(),
            asked: &asked,
            observer: &mut *observer,
        };
        search
            .solved
            .sort_by(|one, other| one.force.total_cmp(&other.force));
        found.push(search.critical()?);
    }
    Ok(found)
}

/// The criteria that strengths ask for.
fn criteria(stress: &StressModel, extremes: &[StressExtremes]) -> Vec<Asked> {
    let mut asked = Vec::new();
    let mut ask = |criterion, name: &str, strength: Option<f64>, [top, bottom]: [f64; 2], known| {
        let quantity = match criterion {
            Criterion::Yield => Quantity::VonMises,
            Criterion::Tension => Quantity::MaxPrincipal,
            Criterion::InterfaceShear => Quantity::ShearTraction,
            Criterion::InterfaceTension => Quantity::Tension,
        };
        asked.extend(strength.map(|strength| Asked {
            criterion,
            name: name.to_owned(),
            strength,
            target: Target {
                top,
                bottom,
                quantities: vec![quantity],
            },
            known,
        }));
    };
    for (index, body) in stress.bodies.iter().enumerate() {
        let (strengths, range) = (body.strengths, [body.top, body.bottom]);
        let known = |of: fn(&BodyStress) -> Extreme<3>| {
            let steps = extremes.iter().map(|step| of(&step.bodies[index]));
            steps.collect::<Vec<_>>()
        };
        let yielding = known(|body| body.max_von_mises);
        ask(
            Criterion::Yield,
            &body.name,
            strengths.yield_strength,
            range,
            yielding,
        );
        let tension = known(|body| body.max_principal);
        ask(
            Criterion::Tension,
            &body.name,
            strengths.tensile_strength,
            range,
            tension,
        );
    }
    for (index, interface) in stress.interfaces.iter().enumerate() {
        let (strengths, depth) = (interface.strengths, interface.depth);
        let name = format!("interface[{}]", interface.index);
        let known = |of: fn(&InterfaceStress) -> Extreme<2>| {
            let steps = extremes
                .iter()
                .map(|step| of(&step.interfaces[index]).at_depth(depth));
            steps.collect::<Vec<_>>()
        };
        let shear = known(|interface| interface.max_shear_traction);
        ask(
            Criterion::InterfaceShear,
            &name,
            strengths.shear_strength,
            [depth; 2],
            shear,
        );
        let tension = known(|interface| interface.max_tension);
        ask(
            Criterion::InterfaceTension,
            &name,
            strengths.tensile_strength,
            [depth; 2],
            tension,
        );
    }
    asked
}

/// The loads solved so far for one criterion, and how to solve another.
struct LoadSearch<'a> {
    model: &'a Model,
    domain: Domain,
    elements: usize,
    options: SolverOptions,
    sliding: Sliding,
    asked: &'a Asked,
    /// By rising force.
    solved: Vec<Solved>,
    observer: &'a mut dyn Observer,
}

impl LoadSearch<'_> {
    /// The critical load.
    fn critical(&mut self) -> Result<CriticalLoad, ContactError> {
        let reached = match self.first_reached() {
            Some(reached) => Some(reached),
            None => self.reached_between()?,
        };
        let Some(mut upper) = reached else {
            return Ok(self.result(None, self.largest()));
        };
        let mut tried = 0;
        let mut lower = loop {
            if let Some(lower) = self.last_before(upper.force) {
                break lower;
            }
            if tried == MOST_SMALLER {
                return Ok(self.result(None, Some(&upper)));
            }
            tried += 1;
            let smaller = self.solve(SMALLER * upper.force, self.domain)?;
            if self.utilisation(&smaller) >= 1.0 {
                upper = smaller;
            }
        };
        let mut exponent = self.exponent(&lower, &upper);
        let mut latest = self.nearer(lower, upper);
        let mut narrow = None;
        for trial in 0..MOST_SOLVED {
            let (low, high) = (lower.force, upper.force);
            if high / low <= NARROW && narrow.is_none() {
                narrow = Some(self.domain_for(high)?);
            }
            let force = exponent
                .filter(|_| trial < MOST_SECANTS)
                .map(|n| latest.force * self.utilisation(&latest).powf(-1.0 / n))
                .filter(|force| *force > low && *force < high)
                .unwrap_or((low * high).sqrt());
            let solved = self.solve(force, narrow.unwrap_or(self.domain))?;
            let utilisation = self.utilisation(&solved);
            exponent = self.exponent(&solved, &latest).or(exponent);
            let is_found = exponent.is_some_and(|n| (utilisation.ln() / n).abs() <= ACCURACY);
            // A stress that jumps with the load is bracketed.
            if is_found || (high / low).ln() <= ACCURACY {
                return Ok(self.result(exponent, Some(&solved)));
            }
            latest = solved;
            if utilisation >= 1.0 {
                upper = solved;
            } else {
                lower = solved;
            }
        }
        Ok(self.result(None, Some(&upper)))
    }

    /// The smallest load solved under which the strength is reached.
    fn first_reached(&self) -> Option<Solved> {
        let mut solved = self.solved.iter();
        solved
            .find(|solved| self.utilisation(solved) >= 1.0)
            .copied()
    }

    /// A load under which the strength is reached though it is not under those solved so far: a stiff coat that takes
    /// the indenter's shape is bent no further, and under more load its stress falls.
    fn reached_between(&mut self) -> Result<Option<Solved>, ContactError> {
        let nearly = self
            .largest()
            .filter(|best| self.utilisation(best) >= NEARLY);
        let Some(mut best) = nearly.copied() else {
            return Ok(None);
        };
        let below = self.last_before(best.force);
        let mut ends = [
            below.map_or(SMALLER * best.force, |solved| solved.force),
            self.first_after(best.force),
        ];
        for trial in 0..MOST_PROBES {
            // In turn below the best and above it; the stress at a peak is flat.
            let side = trial % 2;
            if (ends[side] / best.force).ln().abs() <= FLAT {
                continue;
            }
            let solved = self.solve((ends[side] * best.force).sqrt(), self.domain)?;
            if self.utilisation(&solved) >= 1.0 {
                return Ok(Some(solved));
            }
            if self.utilisation(&solved) > self.utilisation(&best) {
                ends[1 - side] = best.force;
                best = solved;
            } else if best.force >= ends[1] {
                // It grows up to the largest load.
                break;
            } else {
                ends[side] = solved.force;
            }
        }
        Ok(None)
    }

    /// The load solved with the largest stress.
    fn largest(&self) -> Option<&Solved> {
        let solved = self.solved.iter();
        solved.max_by(|one, other| self.utilisation(one).total_cmp(&self.utilisation(other)))
    }

    /// The smallest force solved above another, or that one.
    fn first_after(&self, force: f64) -> f64 {
        let mut solved = self.solved.iter();
        let after = solved.find(|solved| solved.force > force);
        after.map_or(force, |solved| solved.force)
    }

    /// The largest load solved below another.
    fn last_before(&self, force: f64) -> Option<Solved> {
        let is_before = |solved: &&Solved| solved.force < force && solved.force > 0.0;
        self.solved.iter().rfind(is_before).copied()
    }

    /// The one of two loads that comes nearer to the strength.
    fn nearer(&self, one: Solved, other: Solved) -> Solved {
        let apart = |solved: &Solved| self.utilisation(solved).ln().abs();
        if apart(&one) < apart(&other) {
            one
        } else {
            other
        }
    }

    /// `n` of a utilisation that grows as `forceⁿ` between two loads; none where it does not grow.
    fn exponent(&self, one: &Solved, other: &Solved) -> Option<f64> {
        let [first, second] = [one, other].map(|solved| self.utilisation(solved).ln());
        let exponent = (second - first) / (other.force / one.force).ln();
        (exponent.is_finite() && exponent > 0.0).then_some(exponent)
    }

    fn utilisation(&self, solved: &Solved) -> f64 {
        solved.extreme.value.max(0.0) / self.asked.strength
    }

    /// One domain for loads up to this one: as given, or chosen for it.
    fn domain_for(&self, force: f64) -> Result<Domain, ContactError> {
        if let Domain::Side(_) = self.domain {
            return Ok(self.domain);
        }
        Ok(Domain::Side(choose_side(
            self.model,
            &[Load::Force(force)],
        )?))
    }

    /// Solves a load and finds its stress.
    fn solve(&mut self, force: f64, domain: Domain) -> Result<Solved, ContactError> {
        let domain = match domain {
            Domain::Chosen(_) => Domain::Automatic,
            domain => domain,
        };
        let (loads, observer) = ([Load::Force(force)], &mut *self.observer);
        let (model, options) = (self.model, &self.options);
        let path = solve_path(model, domain, self.elements, &loads, options, observer)?;
        let [step] = &path.steps[..] else {
            return Err(ContactError::Cancelled { step: 0 });
        };
        let targets = std::slice::from_ref(&self.asked.target);
        let found = Finder::new(&path, step, self.sliding).find(targets)?;
        let solved = Solved {
            force,
            penetration: step.solution.penetration,
            extreme: found[0][0],
        };
        let place = self.solved.partition_point(|other| other.force < force);
        self.solved.insert(place, solved);
        Ok(solved)
    }

    /// The result: a critical load where the growth of the stress there is known, else the last load tried.
    fn result(&self, exponent: Option<f64>, solved: Option<&Solved>) -> CriticalLoad {
        let found = exponent.and(solved);
        let extreme = solved.map(|solved| solved.extreme);
        let relative = extreme.and_then(|extreme| Some(extreme.estimate? / extreme.value.abs()));
        CriticalLoad {
            criterion: self.asked.criterion,
            name: self.asked.name.clone(),
            strength: self.asked.strength,
            force: found.map(|solved| solved.force),
            penetration: found.map(|solved| solved.penetration),
            at: found.map(|solved| solved.extreme.at),
            // δQ/Q = δσ/σ / n
            estimate: found
                .zip(relative)
                .zip(exponent)
                .map(|((solved, relative), n)| solved.force * relative / n),
            resolved: extreme.is_some_and(|extreme| extreme.resolved),
            utilisation: solved.map_or(0.0, |solved| self.utilisation(solved)),
        }
    }
}
