//! A forecast of the work, memory and warnings of a case, from a trial on a coarse grid.
//!
//! The trial solves for the smallest and the largest load on at most 64 × 64 elements. It gives the size of the contact
//! and the warnings about the model. The domain is that of the solution.

use pellicle_contact::{
    ContactError, Domain, Load, LoadingPath, Method, Model, SolverOptions, Step, Warning,
    default_side, domain_much_larger, loads_at_once, model_warnings, solve_path, solved_grid,
};
use pellicle_texture::Grid;

use crate::case::{Case, grid::BoundaryCase};
use crate::display::significant;

/// Elements per side of the trial.
const TRIAL: usize = 64;

/// Products after which the trial gives up, to stay quick.
const MOST_PRODUCTS: usize = 150;

/// Growth of the products of a hard case when the elements are halved; those of an easy case hardly grow. *Measured* on
/// the cases of Fig. 2 of the paper, N = 128 to 1024: 1.0 to 1.1 on soft coatings, 1.2 to 1.6 on stiff ones.
const GROWTH: f64 = 1.5;

/// With fewer elements than this from the centre of a contact to its edge, the area is uncertain by a tenth or more: a
/// circle of radius 5 holds some 80 elements, of which 30 are cut by its rim.
const FEWEST_PER_CONTACT: f64 = 5.0;

/// Memory of any run, bytes: the program, its fonts and tables.
const BYTES: f64 = 40e6;

/// Memory of a solution per element, in bytes, on a quadrant, on a half and on the whole grid: of any element, and of
/// one in the square around the contact. *Measured* as the largest resident set at N = 2048 on Hertz' contact, pillars,
/// films, punches and pyramids, the contact filling 16 to 100 % of the domain's side squared: 14 to 54 on a quadrant,
/// where these give 30 to 80; 61 to 220, where these give 61 to 220, on the whole grid. Hertz' contact at N = 8192
/// takes 2.93 GB, forecast 3.17; pillars 2.12, forecast 2.22. A Berkovich pyramid on a half at N = 2048, its contact 18
/// and 72 % of the domain: 28 and 78, where these give 36 and 85.
const BYTES_PER_ELEMENT_SOLVED: [[f64; 2]; 3] = [[20.0, 60.0], [20.0, 90.0], [20.0, 200.0]];

/// Memory of a loading step per element, in bytes: its pressure.
const BYTES_PER_ELEMENT_AND_STEP: f64 = 8.0;

/// Memory of writing per element, in bytes, on a quadrant, on a half and on the whole grid: of one loading step, and of
/// each that is written beside it. *Measured* as above: 67 to 87 for one step on a quadrant, 120 on the half of the
/// pyramid, 108 on the whole grid; 113 to 132, 208 and 167 to 229 for two at a time and a third kept.
const BYTES_PER_ELEMENT_WRITTEN: [[f64; 2]; 3] = [[88.0, 42.0], [125.0, 75.0], [110.0, 100.0]];

/// Memory of stresses inside per element, in bytes, without friction and with it. *Measured* as above on Hertz' contact
/// at N = 512 and 1024, the planes as wide as the domain: 195 to 253 and 325 to 403.
const BYTES_PER_ELEMENT_STRESSED: [f64; 2] = [270.0, 410.0];

/// Memory of a sample of a map, in bytes: in the case, in the model and beside the solution.
const BYTES_PER_SAMPLE: f64 = 24.0;

/// Grids of fewer elements per side need so little memory that the size of the contact does not matter.
const LEAST_TRIED: usize = 512;

/// The memory that a case needs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Need {
    /// Bytes.
    pub bytes: u64,
    /// Elements per side.
    pub elements: usize,
}

impl Need {
    /// The memory of a case on a domain whose results are written by `writers` threads, 0 if they are not written. A
    /// trial gives the size of the contact.
    #[must_use]
    pub fn new(case: &Case, model: &Model, domain: Domain, writers: usize) -> Self {
        let elements = case.grid.elements;
        let trial = (elements > LEAST_TRIED).then(|| solve(case, model, domain, TRIAL));
        let share = trial
            .and_then(Result::ok)
            .as_ref()
            .map_or(1.0, contact_share);
        Self::of(case, model, writers, share)
    }

    /// The same, where the square around the contact takes this share of the domain.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a number of bytes"
    )]
    fn of(case: &Case, model: &Model, writers: usize, share: f64) -> Self {
        let (elements, steps) = (case.grid.elements, case.load.loads().len());
        let (options, boundary) = (case.solver_options(), case.grid.boundary.into());
        let images = solved_grid(model, elements, boundary, &options).images();
        let of_sector = |[quadrant, half, whole]: [[f64; 2]; 3]| match images {
            4 => quadrant,
            2 => half,
            _ => whole,
        };
        let [any, in_contact] = of_sector(BYTES_PER_ELEMENT_SOLVED);
        let solved = (any + in_contact * share) * loads_at_once(elements, steps) as f64;
        let [one, each_more] = of_sector(BYTES_PER_ELEMENT_WRITTEN);
        let output = &case.output;
        let shown = output.fields.count(steps).max(output.pictures.count(steps));
        let written = match writers.min(shown) {
            0 => 0.0,
            writers => one + each_more * (writers - 1) as f64,
        };
        let stressed = case.stress.as_ref().map_or(0.0, |stress| {
            BYTES_PER_ELEMENT_STRESSED[usize::from(stress.friction > 0.0)]
        });
        let kept = BYTES_PER_ELEMENT_AND_STEP * steps.saturating_sub(1) as f64;
        let area = (elements as f64).powi(2);
        let maps = [case.surface.map(), case.indenter.map()]
            .into_iter()
            .flatten();
        let samples: usize = maps.map(|map| map.samples().len()).sum();
        // The dense matrix and its factors.
        let dense = match options.method {
            Method::Gradient => 0.0,
            Method::ActiveSet => 16.0 * area.powi(2),
        };
        Self {
            bytes: (BYTES
                + BYTES_PER_SAMPLE * samples as f64
                + (solved.max(written).max(stressed) + kept) * area
                + dense) as u64,
            elements,
        }
    }

    /// Elements per side with which the case would fit, a multiple of 16; 0 if none would.
    #[must_use]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "less than the elements of the case"
    )]
    pub fn fitting(&self, available: u64) -> usize {
        let ratio = (available as f64 - BYTES).max(0.0) / (self.bytes as f64 - BYTES).max(1.0);
        let fitting = self.elements as f64 * ratio.min(1.0).sqrt();
        (fitting / 16.0) as usize * 16
    }
}

/// The result of a trial.
#[derive(Debug)]
pub struct Forecast {
    /// Side of the domain, m.
    pub side: f64,
    /// Elements per side of the trial.
    pub trial: usize,
    /// The memory that a run will need.
    pub need: Need,
    /// The solution of the largest load on that grid; none if the trial failed.
    pub step: Option<Step>,
    /// The warnings to expect of the solution, as far as the trial can tell.
    pub warnings: Vec<String>,
}

impl Forecast {
    /// Runs a trial of a case.
    #[must_use]
    pub fn new(case: &Case, model: &Model) -> Self {
        let trial = case.grid.elements.min(TRIAL);
        let loads = case.load.loads();
        let (side, path) = match case.side(model) {
            Ok(side) => {
                let domain = match case.grid.boundary {
                    BoundaryCase::Free => Domain::Side(side),
                    BoundaryCase::Periodic => Domain::Periodic(side),
                };
                (side, solve(case, model, domain, trial))
            }
            Err(error) => (default_side(model, &loads), Err(error)),
        };
        let of_case = case.warnings(side).into_iter();
        let mut warnings: Vec<_> = of_case.map(|warning| warning.message).collect();
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
        let share = path.as_ref().map_or(1.0, contact_share);
        Self {
            side,
            trial,
            need: Need::of(case, model, rayon::current_num_threads(), share),
            step: path.ok().and_then(|mut path| path.steps.pop()),
            warnings,
        }
    }

    /// Lower and upper estimate of the products with `K` of a step on a finest grid of this many elements per side.
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
        coarse_pressures: false,
        ..case.solver_options()
    };
    let loads = extremes(&case.load.loads());
    solve_path(model, domain, elements, &loads, &options, &mut ())
}

/// Share of the domain that the square around the largest contact takes.
fn contact_share(path: &LoadingPath) -> f64 {
    let radii = path.steps.iter().map(|step| step.summary.contact_radius);
    let share = 2.0 * radii.fold(0.0, f64::max) / path.grid.side();
    share.powi(2).min(1.0)
}

/// The smallest load and the largest; one load if there is only one.
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

/// The warning that the domain is far too large for the contact of the largest load, which the trial found, or which is
/// estimated where the trial is too coarse.
fn far_too_large(case: &Case, model: &Model, path: &LoadingPath) -> Option<String> {
    let loads = case.load.loads();
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

/// The warning that the contact of the smallest load has too few elements.
fn smallest(path: &LoadingPath, element_side: f64) -> Option<String> {
    let [first, .., _] = &path.steps[..] else {
        return None;
    };
    let elements = first.summary.contact_radius / element_side;
    (elements > 0.0 && elements < FEWEST_PER_CONTACT).then(|| {
        format!(
            "at the smallest load, the contact's radius is some {} elements: solve small loads separately, or with more elements",
            significant(elements, 1)
        )
    })
}

/// A warning of the trial's last step about the model, in words, and none about its coarse grid. A chosen domain is
/// large enough: a warning that the contact is near its edge comes from the coarse grid alone.
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

/// The warnings about what the elements do not resolve on a domain of this side; none if the side is invalid.
fn resolution(model: &Model, side: f64, elements: usize) -> Vec<String> {
    let grid = Grid::new(side, elements);
    let warnings = grid.map(|grid| model_warnings(model, &grid));
    let warnings = warnings.unwrap_or_default();
    warnings.iter().map(ToString::to_string).collect()
}

/// The warnings about maps that end within the domain.
fn maps(case: &Case, side: f64) -> Vec<String> {
    let ends = |map: &crate::case::map::MapCase| map.sides.iter().any(|length| *length < side);
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
    use std::path::Path;
    use std::sync::Arc;

    use pellicle_influence::Cache;

    use super::*;
    use crate::input::span::Source;

    /// Hertz' contact of `cases/hertz.toml`.
    fn hertz(elements: usize) -> Case {
        let indenter = "kind = \"paraboloid\"\nradius = \"10 mm\"";
        pressed(indenter, "10 N", elements)
    }

    fn pressed(indenter: &str, force: &str, elements: usize) -> Case {
        let text = format!(
            "[foundation]\nsubstrate = {{ young_modulus = \"70 GPa\", poisson_ratio = 0.22 }}\n\
             [indenter]\n{indenter}\n[load]\nforce = \"{force}\"\n"
        );
        let source = Arc::new(Source::new("case.toml", text));
        let set = format!("grid.elements={elements}");
        Case::parse(&source, "case", Path::new(""), &[set]).unwrap()
    }

    #[test]
    fn the_memory_of_a_large_grid_is_forecast_and_at_most_two_fifths_more() {
        // The largest resident sets, measured: solved alone, and written too.
        let berkovich = || pressed("kind = \"berkovich\"\ntip_radius = 0.0", "10 mN", 2048);
        for (case, writers, measured) in [
            (hertz(2048), 0, 174e6),
            (hertz(8192), 0, 2.927e9),
            (hertz(8192), 1, 4.637e9),
            (berkovich(), 0, 368e6),
            (berkovich(), 1, 543.8e6),
        ] {
            let model = case.model(&Cache::in_memory()).unwrap().value;
            let domain = case.domain(&model).unwrap();
            let forecast = Need::new(&case, &model, domain, writers).bytes as f64;
            let ratio = forecast / measured;
            assert!(
                (1.0..1.4).contains(&ratio),
                "{}: {ratio}",
                case.grid.elements
            );
        }
    }

    #[test]
    fn a_periodic_cell_is_forecast_on_the_whole_grid_though_all_is_mirrored() {
        let mut case = hertz(LEAST_TRIED);
        let model = case.model(&Cache::in_memory()).unwrap().value;
        let bytes = |case: &Case| Need::new(case, &model, Domain::Side(1e-3), 0).bytes;
        let of_quadrant = bytes(&case);
        case.grid.boundary = BoundaryCase::Periodic;
        assert!(bytes(&case) > of_quadrant);
    }

    #[test]
    fn the_trial_of_a_periodic_cell_is_one() {
        let mut case = hertz(TRIAL);
        let model = case.model(&Cache::in_memory()).unwrap().value;
        let side = 3e-4;
        case.grid.side = Some(side);
        case.grid.boundary = BoundaryCase::Periodic;
        let step = Forecast::new(&case, &model).step.unwrap();
        let penetration = |domain| {
            let path = solve(&case, &model, domain, TRIAL).unwrap();
            path.steps[0].solution.penetration
        };
        assert_eq!(
            step.solution.penetration,
            penetration(Domain::Periodic(side))
        );
        // Measured from the mean plane, it is less.
        assert!(step.solution.penetration < 0.9 * penetration(Domain::Side(side)));
    }

    #[test]
    fn what_is_said_to_fit_fits() {
        let case = hertz(4096);
        let model = case.model(&Cache::in_memory()).unwrap().value;
        let domain = case.domain(&model).unwrap();
        let need = Need::new(&case, &model, domain, 1);
        let available = 300_000_000;
        let fitting = need.fitting(available);
        let fits = Need::new(&hertz(fitting), &model, domain, 1);
        assert!(fits.bytes <= available && fits.bytes > available / 2);
        assert_eq!(need.fitting(0), 0);
    }
}
