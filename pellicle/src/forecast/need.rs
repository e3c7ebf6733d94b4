//! The memory that a case needs.

use pellicle_contact::{Domain, LoadingPath, Method, Model, loads_at_once, solved_grid};
use pellicle_texture::Grid;

use super::stress_cost::StressCost;
use super::trial::{self, TRIAL, contact_share};
use crate::case::Case;

/// Base memory of any run, bytes: the program, its fonts and tables.
const BYTES: f64 = 40e6;

/// Memory of a solution per element, in bytes, on a quadrant, on a half and on the whole grid: for any element, and in
/// addition for one in the square around the contact. *Measured* as the largest resident set at N = 2048 on Hertz'
/// contact, pillars, films, punches and pyramids, the contact filling 16 to 100 % of the domain's side squared: 14 to
/// 54 on a quadrant, where these constants give 30 to 80; 61 to 220 on the whole grid, where they give 61 to 220.
/// Hertz' contact at N = 8192 takes 2.93 GB, forecast 3.17; pillars 2.12, forecast 2.22. A Berkovich pyramid on a half
/// at N = 2048, its contact 18 and 72 % of the domain: 28 and 78, where the constants give 36 and 85.
const BYTES_PER_ELEMENT_SOLVED: [[f64; 2]; 3] = [[20.0, 60.0], [20.0, 90.0], [20.0, 200.0]];

/// Memory of a loading step per element, in bytes: its pressure.
const BYTES_PER_ELEMENT_AND_STEP: f64 = 8.0;

/// Memory of writing per element, in bytes, on a quadrant, on a half and on the whole grid: for one loading step, and
/// for each further one written at the same time. *Measured* as above: 67 to 87 for one step on a quadrant, 120 on the
/// half of the pyramid, 108 on the whole grid; 113 to 132, 208 and 167 to 229 for two at a time with a third kept.
const BYTES_PER_ELEMENT_WRITTEN: [[f64; 2]; 3] = [[88.0, 42.0], [125.0, 75.0], [110.0, 100.0]];

/// Memory of internal stresses per element, in bytes, without and with friction. *Measured* as above on Hertz' contact
/// at N = 512 and 1024, the planes as wide as the domain: 195 to 253 and 325 to 403.
const BYTES_PER_ELEMENT_STRESSED: [f64; 2] = [270.0, 410.0];

/// Memory per sample of a map, in bytes: in the case, in the model and beside the solution.
const BYTES_PER_SAMPLE: f64 = 24.0;

/// Elements per side above which a trial is solved without stresses: smaller grids need so little memory that the size
/// of the contact does not matter.
const TRIAL_ELEMENTS: usize = 512;

/// The memory that a case needs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Need {
    /// Bytes.
    pub bytes: u64,
    /// Elements per side.
    pub elements: usize,
}

impl Need {
    /// Estimates the memory of a case on a domain; `writers` threads write its results, 0 if they are not written. A
    /// trial gives the size of the contact.
    #[must_use]
    pub fn new(case: &Case, model: &Model, domain: Domain, writers: usize) -> Self {
        let elements = case.grid.elements;
        let is_tried = elements > TRIAL_ELEMENTS || case.stress.is_some();
        let trial = is_tried.then(|| trial::solve(case, model, domain, case.grid.at_most(TRIAL)));
        let trial = trial.and_then(Result::ok);
        Self::of(case, model, writers, trial.as_ref())
    }

    /// Estimates the memory with a trial of the smallest and the largest load; without one, the contact may fill the
    /// domain.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a number of bytes"
    )]
    #[must_use]
    pub fn of(case: &Case, model: &Model, writers: usize, trial: Option<&LoadingPath>) -> Self {
        let share = trial.map_or(1.0, contact_share);
        let (elements, steps) = (case.grid.elements, case.steps());
        let (options, boundary) = (case.solver_options(), case.grid.boundary.into());
        let grid = Grid::oblong(1.0, case.grid.lengths().unwrap_or([elements; 2]));
        let images = grid.map_or(1, |grid| {
            solved_grid(model, &grid, boundary, &options).images()
        });
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
        let searched = trial.and_then(|trial| StressCost::of(case, trial, 0.0));
        let searched = searched.map_or(0.0, |cost| cost.bytes);
        let kept = BYTES_PER_ELEMENT_AND_STEP * steps.saturating_sub(1) as f64;
        let area = case.grid.count() as f64;
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
                + searched
                + (solved.max(written).max(stressed) + kept) * area
                + dense) as u64,
            elements,
        }
    }

    /// Elements per side with which the case would fit, a multiple of 16; 0 if no number would.
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

#[cfg(test)]
pub(crate) mod tests {

    use std::path::Path;
    use std::sync::Arc;

    use pellicle_influence::Cache;

    use super::*;
    use crate::case::grid::BoundaryCase;
    use crate::input::span::Source;

    /// Hertz' contact of `cases/hertz.toml`.
    pub fn hertz(elements: usize) -> Case {
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
    fn the_memory_forecast_of_a_large_grid_is_at_most_two_fifths_too_large() {
        // Largest resident sets, measured for the solution alone and with writing.
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
    fn a_symmetric_periodic_cell_is_still_forecast_on_the_whole_grid() {
        let mut case = hertz(TRIAL_ELEMENTS);
        let model = case.model(&Cache::in_memory()).unwrap().value;
        let bytes = |case: &Case| Need::new(case, &model, Domain::Side(1e-3), 0).bytes;
        let of_quadrant = bytes(&case);
        case.grid.boundary = BoundaryCase::Periodic;
        assert!(bytes(&case) > of_quadrant);
    }

    #[test]
    fn the_suggested_grid_fits_in_memory() {
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
