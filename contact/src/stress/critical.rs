//! Critical loads: the smallest force at which a body yields or cracks, or an interface comes off.
//!
//! A stress grows about as a power of the load, so that the secant between two solved loads in logarithms meets a
//! strength in a few steps; each is a contact solved on its own grids, and its stresses searched.

use serde::{Deserialize, Serialize};

use super::extremes::Extreme;
use super::finder::Finder;
use super::model::{Criterion, StressModel};
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

/// One criterion and the place of its quantity among the targets.
struct Asked {
    criterion: Criterion,
    name: String,
    strength: f64,
    target: usize,
    quantity: usize,
}

/// A load with the extreme of each criterion under it.
#[derive(Clone)]
struct Solved {
    /// Force in N, or penetration in m, whichever is prescribed.
    load: f64,
    force: f64,
    penetration: f64,
    extremes: Vec<Extreme<3>>,
}

/// The critical load of every strength given, up to the largest load of a solved path.
///
/// # Errors
/// As [`solve_path`] and [`stress_extremes`](super::extremes::stress_extremes); [`ContactError::Cancelled`] by the
/// observer.
pub fn critical_loads(
    model: &Model,
    path: &LoadingPath,
    domain: Domain,
    loads: &[Load],
    options: &SolverOptions,
    stress: &StressModel,
    observer: &mut dyn Observer,
) -> Result<Vec<CriticalLoad>, ContactError> {
    let (targets, asked) = criteria(stress);
    let mut search = LoadSearch {
        model,
        domain,
        elements: path.grid.size(),
        options: SolverOptions {
            coarse_pressures: true,
            contact_stiffness: false,
            ..*options
        },
        stress,
        is_force: loads.iter().all(|load| matches!(load, Load::Force(_))),
        targets,
        asked,
        solved: Vec::new(),
        observer,
    };
    if search.asked.is_empty() {
        return Ok(Vec::new());
    }
    for index in 0..path.steps.len() {
        let solved = search.stresses(path, index)?;
        search.take(solved);
    }
    (0..search.asked.len())
        .map(|index| search.critical(index))
        .collect()
}

/// The quantities to look for, and the criteria that ask for them.
fn criteria(stress: &StressModel) -> (Vec<Target>, Vec<Asked>) {
    let (mut targets, mut asked) = (Vec::new(), Vec::new());
    let mut ask =
        |[top, bottom]: [f64; 2], name: &str, wanted: [(Option<f64>, Criterion, Quantity); 2]| {
            let mut quantities = Vec::new();
            for (strength, criterion, quantity) in wanted {
                let Some(strength) = strength else { continue };
                asked.push(Asked {
                    criterion,
                    name: name.to_owned(),
                    strength,
                    target: targets.len(),
                    quantity: quantities.len(),
                });
                quantities.push(quantity);
            }
            if !quantities.is_empty() {
                targets.push(Target {
                    top,
                    bottom,
                    quantities,
                });
            }
        };
    for body in &stress.bodies {
        let strengths = body.strengths;
        ask(
            [body.top, body.bottom],
            &body.name,
            [
                (
                    strengths.yield_strength,
                    Criterion::Yield,
                    Quantity::VonMises,
                ),
                (
                    strengths.tensile_strength,
                    Criterion::Tension,
                    Quantity::MaxPrincipal,
                ),
            ],
        );
    }
    for interface in &stress.interfaces {
        let strengths = interface.strengths;
        ask(
            [interface.depth; 2],
            &format!("interface[{}]", interface.index),
            [
                (
                    strengths.shear_strength,
                    Criterion::InterfaceShear,
                    Quantity::ShearTraction,
                ),
                (
                    strengths.tensile_strength,
                    Criterion::InterfaceTension,
                    Quantity::Tension,
                ),
            ],
        );
    }
    (targets, asked)
}

/// The loads solved so far, and how to solve another.
struct LoadSearch<'a> {
    model: &'a Model,
    domain: Domain,
    elements: usize,
    options: SolverOptions,
    stress: &'a StressModel,
    is_force: bool,
    targets: Vec<Target>,
    asked: Vec<Asked>,
    /// By rising load.
    solved: Vec<Solved>,
    observer: &'a mut dyn Observer,
}

impl LoadSearch<'_> {
    /// The critical load of one criterion.
    fn critical(&mut self, index: usize) -> Result<CriticalLoad, ContactError> {
        let Some(mut upper) = self.first_reached(index) else {
            let largest = self.solved.last().cloned();
            return Ok(self.result(index, None, largest.as_ref()));
        };
        let mut tried = 0;
        let mut lower = loop {
            if let Some(lower) = self.last_before(upper.load) {
                break lower;
            }
            if tried == MOST_SMALLER {
                return Ok(self.result(index, None, Some(&upper)));
            }
            tried += 1;
            let smaller = self.solve(SMALLER * upper.load, self.domain)?;
            if self.utilisation(index, &smaller) >= 1.0 {
                upper = smaller;
            }
        };
        let mut exponent = self.exponent(index, &lower, &upper);
        let mut latest = self.nearer(index, &lower, &upper).clone();
        let mut narrow = None;
        for trial in 0..MOST_SOLVED {
            let (low, high) = (lower.load, upper.load);
            if high / low <= NARROW && narrow.is_none() {
                narrow = Some(self.domain_for(high)?);
            }
            let load = exponent
                .filter(|_| trial < MOST_SECANTS)
                .map(|n| latest.load * self.utilisation(index, &latest).powf(-1.0 / n))
                .filter(|load| *load > low && *load < high)
                .unwrap_or((low * high).sqrt());
            let solved = self.solve(load, narrow.unwrap_or(self.domain))?;
            let utilisation = self.utilisation(index, &solved);
            exponent = self.exponent(index, &solved, &latest).or(exponent);
            let is_found = exponent.is_some_and(|n| (utilisation.ln() / n).abs() <= ACCURACY);
            // A stress that jumps with the load is bracketed.
            if is_found || (high / low).ln() <= ACCURACY {
                return Ok(self.result(index, exponent, Some(&solved)));
            }
            latest = solved.clone();
            if utilisation >= 1.0 {
                upper = solved;
            } else {
                lower = solved;
            }
        }
        Ok(self.result(index, None, Some(&upper)))
    }

    /// The smallest load solved under which the strength is reached.
    fn first_reached(&self, index: usize) -> Option<Solved> {
        let mut reached = self
            .solved
            .iter()
            .filter(|solved| self.utilisation(index, solved) >= 1.0);
        reached.next().cloned()
    }

    /// The largest load solved below another.
    fn last_before(&self, load: f64) -> Option<Solved> {
        self.solved
            .iter()
            .rfind(|solved| solved.load < load && solved.load > 0.0)
            .cloned()
    }

    /// Which of two loads comes nearer to the strength.
    fn nearer<'s>(&self, index: usize, one: &'s Solved, other: &'s Solved) -> &'s Solved {
        let apart = |solved: &Solved| self.utilisation(index, solved).ln().abs();
        if apart(one) < apart(other) {
            one
        } else {
            other
        }
    }

    /// `n` of a utilisation that grows as `loadⁿ` between two loads; none where it does not grow.
    fn exponent(&self, index: usize, one: &Solved, other: &Solved) -> Option<f64> {
        let [first, second] = [one, other].map(|solved| self.utilisation(index, solved).ln());
        let exponent = (second - first) / (other.load / one.load).ln();
        (exponent.is_finite() && exponent > 0.0).then_some(exponent)
    }

    fn utilisation(&self, index: usize, solved: &Solved) -> f64 {
        solved.extremes[index].value.max(0.0) / self.asked[index].strength
    }

    /// One domain for loads up to this one: as given, or chosen for it.
    fn domain_for(&self, load: f64) -> Result<Domain, ContactError> {
        if let Domain::Side(_) = self.domain {
            return Ok(self.domain);
        }
        Ok(Domain::Side(choose_side(self.model, &[self.load(load)])?))
    }

    fn load(&self, value: f64) -> Load {
        if self.is_force {
            Load::Force(value)
        } else {
            Load::Penetration(value)
        }
    }

    /// Solves a load and finds its stresses.
    fn solve(&mut self, load: f64, domain: Domain) -> Result<Solved, ContactError> {
        let domain = match domain {
            Domain::Chosen(_) => Domain::Automatic,
            domain => domain,
        };
        let loads = [self.load(load)];
        let path = solve_path(
            self.model,
            domain,
            self.elements,
            &loads,
            &self.options,
            self.observer,
        )?;
        if path.steps.is_empty() {
            return Err(ContactError::Cancelled { step: 0 });
        }
        let solved = self.stresses(&path, 0)?;
        self.take(solved.clone());
        Ok(solved)
    }

    /// The extremes under a step of a path.
    fn stresses(&self, path: &LoadingPath, step: usize) -> Result<Solved, ContactError> {
        let step = &path.steps[step];
        let found = Finder::new(path, step, self.stress.sliding).find(&self.targets)?;
        let extremes = self
            .asked
            .iter()
            .map(|asked| found[asked.target][asked.quantity]);
        let solution = &step.solution;
        Ok(Solved {
            load: if self.is_force {
                solution.force
            } else {
                solution.penetration
            },
            force: solution.force,
            penetration: solution.penetration,
            extremes: extremes.collect(),
        })
    }

    fn take(&mut self, solved: Solved) {
        let place = self
            .solved
            .partition_point(|other| other.load < solved.load);
        self.solved.insert(place, solved);
    }

    /// The result: a critical load where the growth of the stress there is known, else the last load tried.
    fn result(&self, index: usize, exponent: Option<f64>, solved: Option<&Solved>) -> CriticalLoad {
        let Asked {
            criterion,
            ref name,
            strength,
            ..
        } = self.asked[index];
        let found = exponent.and(solved);
        let extreme = solved.map(|solved| solved.extremes[index]);
        let relative = extreme.and_then(|extreme| Some(extreme.estimate? / extreme.value.abs()));
        CriticalLoad {
            criterion,
            name: name.clone(),
            strength,
            force: found.map(|solved| solved.force),
            penetration: found.map(|solved| solved.penetration),
            at: found.map(|solved| solved.extremes[index].at),
            // δQ/Q = δσ/σ / n
            estimate: found
                .zip(relative)
                .zip(exponent)
                .map(|((solved, relative), n)| solved.force * relative / n),
            resolved: extreme.is_some_and(|extreme| extreme.resolved),
            utilisation: solved.map_or(0.0, |solved| self.utilisation(index, solved)),
        }
    }
}
