//! A forecast of the work, memory and warnings of a case, from a trial on a coarse grid.
//!
//! The trial solves for the smallest and the largest load on at most 64 × 64 elements. It gives the size of the contact
//! and the warnings about the model. Its domain is that of the solution.

pub mod need;
pub mod stress_cost;
mod trial;

use pellicle_contact::{
    Domain, LoadingPath, Model, Step, Warning, arc_under_resolved, default_side,
    domain_much_larger, map_under_resolved, model_warnings,
};
use pellicle_texture::Grid;

use self::need::Need;
use self::stress_cost::StressCost;
use self::trial::TRIAL;
use crate::case::Case;
use crate::display::significant;

/// Growth of the number of products of a hard case when the elements are halved; in an easy case it hardly grows.
/// *Measured* on the cases of Fig. 2 of the paper, N = 128 to 1024: 1.0 to 1.1 on soft coatings, 1.2 to 1.6 on stiff
/// ones.
const GROWTH: f64 = 1.5;

/// With fewer elements than this from the centre of a contact to its edge, the area is uncertain by a tenth or more: a
/// circle of radius 5 holds some 80 elements, of which 30 are cut by its rim.
const MIN_ELEMENTS_PER_RADIUS: f64 = 5.0;

/// The result of a trial.
#[derive(Debug)]
pub struct Forecast {
    /// Side of the domain, m.
    pub side: f64,
    /// Elements per side of the trial.
    pub trial: usize,
    /// The memory that a run will need.
    pub need: Need,
    /// What the stresses cost beside the contact; none without stresses, or if the trial failed.
    pub stress: Option<StressCost>,
    /// The solution of the largest load on that grid; none if the trial failed.
    pub step: Option<Step>,
    /// The warnings to expect from the solution, as far as the trial shows.
    pub warnings: Vec<String>,
}

impl Forecast {
    /// Runs a trial of a case.
    #[must_use]
    pub fn new(case: &Case, model: &Model) -> Self {
        let trial = case.grid.at_most(TRIAL);
        let loads = case.loads();
        let (side, path) = match case.side(model) {
            Ok(side) => {
                let domain = case.grid.cell().unwrap_or(Domain::Side(side));
                (side, trial::solve(case, model, domain, trial))
            }
            Err(error) => (default_side(model, &loads), Err(error)),
        };
        let of_case = case.warnings(side).into_iter();
        let mut warnings: Vec<_> = of_case.map(|warning| warning.message).collect();
        warnings.extend(resolution(model, side, case.grid.elements));
        match &path {
            Ok(path) => {
                warnings.extend(far_too_large(case, model, path));
                warnings.extend(long_elements(case, model, path));
                warnings.extend(smallest(path, side / case.grid.elements as f64));
                let last = path.steps.len().saturating_sub(1);
                let words = |warning: &Warning| case.sentence(warning);
                let warns =
                    |warning| of_the_model(warning, words, last, case.grid.longer_side().is_some());
                warnings.extend(path.warnings.iter().filter_map(warns));
            }
            Err(error) => warnings.push(format!("the trial failed: {error}")),
        }
        warnings.extend(maps(case, side));
        let path = path.ok();
        Self {
            side,
            trial,
            need: Need::of(case, model, rayon::current_num_threads(), path.as_ref()),
            stress: path.as_ref().and_then(|path| {
                let [least, most] = products(path.steps.last()?, trial, case.grid.elements);
                StressCost::of(case, path, (least * most).sqrt())
            }),
            step: path.and_then(|mut path| path.steps.pop()),
            warnings,
        }
    }

    /// Lower and upper estimates of the products with `K` of a step whose finest grid has this many elements per side.
    #[must_use]
    pub fn products(&self, elements: usize) -> Option<[f64; 2]> {
        let step = self.step.as_ref()?;
        Some(products(step, self.trial, elements))
    }
}

/// Lower and upper estimates of the products with `K` on this many elements per side, from a step on those of a trial.
fn products(step: &Step, trial: usize, elements: usize) -> [f64; 2] {
    let least = step.work.operator_applications as f64;
    let halvings = (elements as f64 / trial as f64).log2().max(0.0);
    [least, least * GROWTH.powf(halvings)]
}

/// The warning that the domain is far too large for the contact of the largest load. The contact is that of the trial;
/// where the trial is too coarse, an estimate if that is smaller.
fn far_too_large(case: &Case, model: &Model, path: &LoadingPath) -> Option<String> {
    let loads = case.loads();
    let found = path.steps.last()?.summary.contact_radius;
    let estimated = default_side(model, &loads) / 3.0;
    let radius = if found < MIN_ELEMENTS_PER_RADIUS * path.grid.element_side() {
        found.min(estimated)
    } else {
        found
    };
    let grid = Grid::new(path.grid.side(), case.grid.elements).ok()?;
    let warning = domain_much_larger(model, &grid, &loads, radius);
    warning.map(|warning| case.sentence(&warning))
}

/// The warning that the elements are too long for the waves of a map around the contact of the largest load.
fn long_elements(case: &Case, model: &Model, path: &LoadingPath) -> Option<String> {
    let radius = path.steps.last()?.summary.contact_radius;
    let grid = Grid::oblong(path.grid.side(), case.grid.lengths()?).ok()?;
    let warning = map_under_resolved(model, &grid, path.boundary, radius)?;
    let words = case.sentence(&warning);
    Some(words.trim_start_matches("step 0: ").to_owned())
}

/// The warning that the contact of the smallest load has too few elements.
fn smallest(path: &LoadingPath, element_side: f64) -> Option<String> {
    let [first, .., _] = &path.steps[..] else {
        return None;
    };
    let elements = first.summary.contact_radius / element_side;
    (elements > 0.0 && elements < MIN_ELEMENTS_PER_RADIUS).then(|| {
        format!(
            "at the smallest load, the contact's radius is some {} elements: solve small loads separately, or with more elements",
            significant(elements, 1)
        )
    })
}

/// A warning of the trial's last step in words, if it is about the model and not about the coarse grid. A chosen domain
/// is large enough: a warning that the contact is near its edge comes from the coarse grid alone.
fn of_the_model(
    warning: &Warning,
    words: impl Fn(&Warning) -> String,
    last: usize,
    is_given: bool,
) -> Option<String> {
    if matches!(warning, Warning::DomainEdge { .. }) && !is_given {
        return None;
    }
    if matches!(warning, Warning::SteepTip { .. }) {
        return Some(words(warning));
    }
    let (Warning::DomainEdge { step, .. }
    | Warning::CutOff { step, .. }
    | Warning::FilmShortening { step, .. }
    | Warning::LayerShortening { step, .. }
    | Warning::BeyondModel { step, .. }
    | Warning::SteepIndenter { step, .. }) = *warning
    else {
        return None;
    };
    let words = words(warning);
    let words = words
        .strip_prefix(&format!("step {step}: "))
        .unwrap_or(&words);
    (step == last).then(|| format!("at the largest load, {words}"))
}

/// The warnings about features that the elements do not resolve on a domain of this side; none if the side is invalid.
fn resolution(model: &Model, side: f64, elements: usize) -> Vec<String> {
    let grid = Grid::new(side, elements);
    let of_model = |grid: Grid| {
        let mut warnings = model_warnings(model, &grid);
        warnings.extend(arc_under_resolved(model, &grid));
        warnings
    };
    let warnings = grid.map(of_model).unwrap_or_default();
    warnings.iter().map(ToString::to_string).collect()
}

/// The warnings about maps that end within the domain.
fn maps(case: &Case, side: f64) -> Vec<String> {
    let ends = |map: &crate::case::map::MapCase| map.sides.iter().any(|length| *length < side);
    if !case.grid.boundary.is_free() {
        return Vec::new();
    }
    let relief = case.surface.map().filter(|map| ends(map)).map(|map| {
        format!(
            "the map {} is smaller than the domain: its edge values are extended outwards",
            map.file
        )
    });
    let indenter = case.indenter.map().filter(|map| ends(map)).map(|map| {
        format!(
            "the map {} is smaller than the domain: nothing touches beyond its edge",
            map.file
        )
    });
    relief.into_iter().chain(indenter).collect()
}

#[cfg(test)]
mod tests {

    use pellicle_influence::Cache;

    use crate::case::grid::BoundaryCase;

    use super::need::tests::hertz;
    use super::*;

    #[test]
    fn the_trial_of_a_periodic_cell_is_periodic() {
        let mut case = hertz(TRIAL);
        let model = case.model(&Cache::in_memory()).unwrap().value;
        let side = 3e-4;
        case.grid.side = Some(side);
        case.grid.boundary = BoundaryCase::Periodic;
        let step = Forecast::new(&case, &model).step.unwrap();
        let penetration = |domain| {
            let path = trial::solve(&case, &model, domain, TRIAL).unwrap();
            path.steps[0].solution.penetration
        };
        assert_eq!(
            step.solution.penetration,
            penetration(Domain::Periodic(side))
        );
        // The penetration from the mean plane is smaller.
        assert!(step.solution.penetration < 0.9 * penetration(Domain::Side(side)));
    }
}
