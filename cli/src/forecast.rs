//! What solving a case will take and what its model is worth, judged by a trial on a coarse grid.
//!
//! The trial solves for the smallest and the largest load, on at most 64 × 64 elements, which takes some milliseconds. It finds the contact's size, and what
//! the solution's own warnings would say of the model. The domain is the very one of the solution.

use pellicle_contact::{
    ContactError, Domain, Load, LoadingPath, Method, Model, SolverOptions, Step, Warning,
    choose_side, default_side, domain_much_larger, model_warnings, solve_path,
};
use pellicle_texture::Grid;

use crate::case::Case;
use crate::display::significant;

/// Elements per side of the trial.
const TRIAL: usize = 64;

/// Products after which the trial gives up: it is to be quick.
const MOST_PRODUCTS: usize = 150;

/// By how much the products of a hard case grow when the elements are halved; those of an easy case hardly do. *Measured* on the cases of
/// Fig. 2 of the paper, N = 128 to 1024: 1.0 to 1.1 on soft coatings, 1.2 to 1.6 on stiff ones.
const GROWTH: f64 = 1.5;

/// Fewer elements than this from the middle of a contact to its edge leave an area uncertain by a tenth and more: a circle of radius 5 holds
/// some 80 elements, of which 30 are cut by its rim.
const FEWEST_PER_CONTACT: f64 = 5.0;

/// What a trial found.
#[derive(Debug)]
pub struct Forecast {
    /// Side of the domain, m.
    pub side: f64,
    /// Elements per side of the trial.
    pub trial: usize,
    /// The solution of the largest load on them; none if the trial failed.
    pub step: Option<Step>,
    /// What the solution will warn of, as far as the trial can tell.
    pub warnings: Vec<String>,
}

impl Forecast {
    /// Tries a case.
    #[must_use]
    pub fn new(case: &Case, model: &Model) -> Self {
        let trial = case.grid.elements.min(TRIAL);
        let loads = case.load.steps();
        let chosen = case
            .grid
            .side
            .map_or_else(|| choose_side(model, &loads), Ok);
        let (side, path) = match chosen {
            Ok(side) => (side, solve(case, model, Domain::Side(side), trial)),
            Err(error) => (default_side(model, &loads), Err(error)),
        };
        let doubts = case.doubts(side).into_iter().map(|doubt| doubt.message);
        let mut warnings: Vec<_> = doubts.collect();
        warnings.extend(resolution(model, side, case.grid.elements));
        match &path {
            Ok(path) => {
                warnings.extend(far_too_large(case, model, path));
                warnings.extend(smallest(path, side / case.grid.elements as f64));
                let last = path.steps.len().saturating_sub(1);
                let warns = |warning| of_the_model(warning, last, case.grid.side.is_some());
                warnings.extend(path.warnings.iter().filter_map(warns));
            }
            Err(error) => warnings.push(format!("the trial failed: {error}")),
        }
        warnings.extend(maps(case, side));
        Self {
            side,
            trial,
            step: path.ok().and_then(|mut path| path.steps.pop()),
            warnings,
        }
    }

    /// Products with `K` that a step will take on the finest grid of so many elements: from, to.
    #[must_use]
    pub fn products(&self, elements: usize) -> Option<[f64; 2]> {
        let step = self.step.as_ref()?;
        let least = step.work.operator_applications as f64;
        let halvings = (elements as f64 / self.trial as f64).log2().max(0.0);
        Some([least, least * GROWTH.powf(halvings)])
    }
}

fn solve(
    case: &Case,
    model: &Model,
    domain: Domain,
    elements: usize,
) -> Result<LoadingPath, ContactError> {
    let options = SolverOptions {
        method: Method::Gradient,
        max_applications: MOST_PRODUCTS,
        ..case.solver.options()
    };
    let loads = extremes(&case.load.steps());
    solve_path(model, domain, elements, &loads, &options, &mut ())
}

/// The smallest load and the largest; the one if there is but one.
fn extremes(loads: &[Load]) -> Vec<Load> {
    let size = |load: &Load| match load {
        Load::Force(value) | Load::Penetration(value) => *value,
    };
    let smallest = loads.iter().min_by(|a, b| size(a).total_cmp(&size(b)));
    let largest = loads.iter().max_by(|a, b| size(a).total_cmp(&size(b)));
    let mut extremes: Vec<_> = smallest.into_iter().chain(largest).copied().collect();
    extremes.dedup();
    extremes
}

/// Whether the domain is far too large for the largest load's contact: as the trial has it, or as estimated where the trial is too coarse to tell.
fn far_too_large(case: &Case, model: &Model, path: &LoadingPath) -> Option<String> {
    let loads = case.load.steps();
    let found = path.steps.last()?.summary.contact_radius;
    let estimated = default_side(model, &loads) / 3.0;
    let radius = if found < FEWEST_PER_CONTACT * path.grid.element_side() {
        found.min(estimated)
    } else {
        found
    };
    let grid = Grid::new(path.grid.side(), case.grid.elements).ok()?;
    let warning = domain_much_larger(model, &grid, &loads, radius);
    warning.map(|warning| warning.to_string())
}

/// Whether the domain that the largest load needs leaves the smallest too few elements.
fn smallest(path: &LoadingPath, element_side: f64) -> Option<String> {
    let [first, .., _] = &path.steps[..] else {
        return None;
    };
    let elements = first.summary.contact_radius / element_side;
    (elements > 0.0 && elements < FEWEST_PER_CONTACT).then(|| {
        format!(
            "at the smallest load, the contact's radius is some {} elements: solve small loads by themselves, or with more elements",
            significant(elements, 1)
        )
    })
}

/// What the trial's last step says of the model and not of its own coarse grid; a chosen domain is never near the edge but to a grid too coarse to tell.
fn of_the_model(warning: &Warning, last: usize, is_given: bool) -> Option<String> {
    if matches!(warning, Warning::DomainEdge { .. }) && !is_given {
        return None;
    }
    let (Warning::DomainEdge { step, .. }
    | Warning::CutOff { step, .. }
    | Warning::FilmShortening { step, .. }
    | Warning::SteepIndenter { step, .. }) = *warning
    else {
        return None;
    };
    let words = warning.to_string();
    let words = words
        .strip_prefix(&format!("step {step}: "))
        .unwrap_or(&words);
    (step == last).then(|| format!("at the largest load, {words}"))
}

/// What elements of the case will not resolve on a domain of this side; nothing of a side that is none.
fn resolution(model: &Model, side: f64, elements: usize) -> Vec<String> {
    let grid = Grid::new(side, elements);
    let warnings = grid.map(|grid| model_warnings(model, &grid));
    let warnings = warnings.unwrap_or_default();
    warnings.iter().map(ToString::to_string).collect()
}

/// Maps that end within the domain.
fn maps(case: &Case, side: f64) -> Vec<String> {
    let ends = |map: &crate::case::map::MapCase| map.sides.iter().any(|length| *length < side);
    let relief = case.surface.map().filter(|map| ends(map)).map(|map| {
        format!(
            "the map {} is smaller than the domain: its rim is continued outwards",
            map.file
        )
    });
    let indenter = case.indenter.map().filter(|map| ends(map)).map(|map| {
        format!(
            "the map {} is smaller than the domain: nothing touches beyond its rim",
            map.file
        )
    });
    relief.into_iter().chain(indenter).collect()
}
