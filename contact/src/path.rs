//! A loading path: many loads on one model, each solved from coarse to fine on a domain that holds the contact.
//!
//! Each load starts from its own solution on coarser grids. In measurements this took one to three products fewer than
//! a start from the previous load, used directly or as a correction. So the loads are independent, bit for bit, and on
//! grids too small to keep all threads busy as many loads are solved at once as there are threads.

mod ascent;
mod capacity;
mod dilute;
pub mod domain;
mod effort;
mod hierarchy;
pub mod level;
pub mod levels;
mod loading_path;
mod part;
mod start;
pub mod warnings;

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use pellicle_texture::Grid;
use rayon::prelude::*;

pub use self::loading_path::LoadingPath;
use crate::{
    Boundary, ContactError, Domain, Load, Model, Observer, Progress, Signal, SolverOptions, Step,
    choose_side_at,
    path::hierarchy::Hierarchy,
    result::{
        cut_off::{CutOff, Surroundings},
        map_resolution::MapResolution,
        model_limits::ModelLimits,
    },
    solver::Watch,
};

/// Factor by which a chosen domain is enlarged, and the most enlargements, if it cuts off contact that the coarse grid
/// of the choice missed.
const ENLARGEMENT: f64 = 1.5;
const ENLARGEMENTS: usize = 8;
/// Most elements of all loads solved at the same time: each takes about 100 bytes in addition to its solution.
const ELEMENTS_AT_ONCE: usize = 1 << 21;

/// Solves `model` for each of `loads` on `elements` × `elements` elements.
///
/// A step that misses its tolerance is not an error: it is in the path, with an unsatisfied certificate and a warning.
/// If the observer cancels on a report of any load, all loads in progress are cancelled, and the path holds the steps
/// before the first unfinished one.
///
/// # Errors
/// An invalid load, tolerance, side or grid; elements so large that none is under the indenter; coefficients that miss
/// their accuracy; a contact that outgrows every domain; in a periodic cell a penetration that is not that of a body
/// over a [rigid base](ContactError::InfiniteMean), or [beyond all gaps](ContactError::BeyondGaps).
pub fn solve_path(
    model: &Model,
    domain: Domain,
    elements: usize,
    loads: &[Load],
    options: &SolverOptions,
    observer: &mut dyn Observer,
) -> Result<LoadingPath, ContactError> {
    let options = options.checked_for(elements)?;
    for load in loads {
        load.checked()?;
        let has_finite_mean = model.tables.bodies().has_finite_mean();
        if let (Load::Penetration(_), Boundary::Periodic, false) =
            (load, domain.boundary(), has_finite_mean)
        {
            return Err(ContactError::InfiniteMean);
        }
    }
    // Runs entirely on a thread of the pool: entering a parallel loop from outside costs two thread switches.
    rayon::scope(|_| solve_on_domains(model, domain, elements, loads, options, observer))
}

/// Solves the path on the given or chosen domain, and on larger ones if a chosen one cuts off the contact after all.
fn solve_on_domains(
    model: &Model,
    domain: Domain,
    elements: usize,
    loads: &[Load],
    options: SolverOptions,
    observer: &mut dyn Observer,
) -> Result<LoadingPath, ContactError> {
    let (mut side, mut enlargements) = match domain {
        Domain::Side(side) | Domain::Periodic(side) => (side, 0),
        Domain::Oblong([x, y]) => (x.max(y), 0),
        Domain::Chosen(side) => (side, ENLARGEMENTS),
        Domain::Automatic => (
            choose_side_at(model, loads, options.hardness)?,
            ENLARGEMENTS,
        ),
    };
    loop {
        let grid = domain.grid(side, elements)?;
        warnings::check_elements(model, &grid, loads)?;
        check_averaging(options.averaging_length, &grid)?;
        if let Err(refused) =
            capacity::check(model, (&grid, domain.boundary()), loads, options.hardness)
        {
            if enlargements == 0 || !capacity::extends_beyond(model, &grid) {
                return Err(refused);
            }
            enlargements -= 1;
            side *= ENLARGEMENT;
            continue;
        }
        let domain_on = (grid, domain.boundary());
        let hierarchy = Hierarchy::new(model, domain_on, loads, &options);
        let mut run = PathRun {
            lanes: hierarchy.lanes(loads_at_once(elements, loads.len()))?,
            steps: Vec::new(),
            solve_seconds: 0.0,
            interrupted: false,
        };
        run.solve_all(loads, options, observer)?;
        let path = run.finish(model, domain, loads, options.hardness)?;
        let by_domain = |step: &Step| step.cut_off == Some(CutOff::Domain);
        if path.interrupted || enlargements == 0 || !path.steps.iter().any(by_domain) {
            return Ok(path);
        }
        enlargements -= 1;
        side *= ENLARGEMENT;
    }
}

/// Refuses to average the pressure over less than an element.
fn check_averaging(length: Option<f64>, grid: &Grid) -> Result<(), ContactError> {
    let element_side = grid.element_side();
    match length {
        // False for NaN.
        Some(length) if length >= element_side => Ok(()),
        Some(length) => Err(ContactError::AveragingLength {
            length,
            element_side,
        }),
        None => Ok(()),
    }
}

/// Number of loads, of `loads` in total, that a path solves at the same time on `elements` × `elements` elements: one
/// on a grid large enough to keep several threads busy.
#[must_use]
pub fn loads_at_once(elements: usize, loads: usize) -> usize {
    let most = (ELEMENTS_AT_ONCE / elements.pow(2)).max(1);
    rayon::current_num_threads().min(most).min(loads.max(1))
}

/// A path in progress on one domain.
struct PathRun<'a> {
    lanes: Vec<Hierarchy<'a>>,
    steps: Vec<Step>,
    solve_seconds: f64,
    interrupted: bool,
}

impl PathRun<'_> {
    /// Solves all loads; each lane takes the next open load.
    fn solve_all(
        &mut self,
        loads: &[Load],
        options: SolverOptions,
        observer: &mut dyn Observer,
    ) -> Result<(), ContactError> {
        let (clock, spent_before) = (Instant::now(), self.coefficients_seconds());
        let queue = Queue {
            loads,
            options,
            taken: AtomicUsize::new(0),
            finished: AtomicUsize::new(0),
            is_over: AtomicBool::new(false),
            is_cancelled: AtomicBool::new(false),
            observer: Mutex::new(observer),
        };
        let lanes = self.lanes.par_iter_mut();
        let outcomes: Vec<Vec<_>> = lanes.map(|lane| queue.solve_remaining(lane)).collect();
        let on_coefficients = self.coefficients_seconds() - spent_before;
        self.solve_seconds = clock.elapsed().as_secs_f64() - on_coefficients;
        self.interrupted = queue.is_cancelled.into_inner();
        let mut outcomes: Vec<_> = outcomes.into_iter().flatten().collect();
        outcomes.sort_by_key(|(index, _)| *index);
        // Loads are taken in order, so untaken ones are the last.
        for (_, outcome) in outcomes {
            match outcome {
                Ok(step) => self.steps.push(step),
                Err(ContactError::Cancelled { .. }) => break,
                _ if self.interrupted => break,
                Err(error) => return Err(error),
            }
        }
        Ok(())
    }

    /// Time spent on coefficients of all grids while no load was being solved; a single lane computes them when first
    /// needed or during a solution.
    fn coefficients_seconds(&self) -> f64 {
        self.lanes.iter().map(Hierarchy::coefficients_seconds).sum()
    }

    /// Adds the warnings that need whole solutions and returns the path.
    fn finish(
        mut self,
        model: &Model,
        domain: Domain,
        loads: &[Load],
        hardness: f64,
    ) -> Result<LoadingPath, ContactError> {
        let coefficients_seconds = self.coefficients_seconds();
        let hierarchy = self.lanes.swap_remove(0);
        drop(self.lanes);
        let coefficients_origin = hierarchy.coefficients_origin();
        let (grid, elasticity) = hierarchy.into_finest()?;
        let mut surroundings = Surroundings::of(model, grid);
        if domain.boundary() == Boundary::Free {
            for step in &mut self.steps {
                step.cut_off = surroundings.limit_reached(&step.solution);
            }
        }
        let mut resolution = MapResolution::new(model, &grid, domain.boundary());
        let mut limits = ModelLimits::new(model, grid, domain.boundary());
        for step in &mut self.steps {
            let elements = resolution.elements_per_wave(step.summary.contact_radius);
            let error = std::mem::take(&mut step.grid_error);
            step.grid_error = error.with_elements_per_wave(elements);
            step.limits = limits.ratios(step);
        }
        let warnings = warnings::warnings(model, &grid, domain, loads, &self.steps);
        Ok(LoadingPath {
            grid,
            warnings,
            coefficients_seconds,
            coefficients_origin,
            solve_seconds: self.solve_seconds,
            steps: self.steps,
            interrupted: self.interrupted,
            boundary: domain.boundary(),
            hardness,
            tables: model.tables.clone(),
            elasticity,
            relief: model.relief.clone(),
            indenter: model.indenter.clone(),
        })
    }
}

/// The loads of a path, from which each lane takes the next open one.
struct Queue<'a, 'b> {
    loads: &'a [Load],
    options: SolverOptions,
    taken: AtomicUsize,
    finished: AtomicUsize,
    /// Whether no more loads are to be taken, because one was cancelled or failed.
    is_over: AtomicBool,
    is_cancelled: AtomicBool,
    observer: Mutex<&'b mut dyn Observer>,
}

impl Queue<'_, '_> {
    /// Solves loads until none is left; returns the results with the index of the load.
    fn solve_remaining(
        &self,
        lane: &mut Hierarchy<'_>,
    ) -> Vec<(usize, Result<Step, ContactError>)> {
        let mut outcomes = Vec::new();
        while !self.is_over.load(Ordering::Relaxed) {
            let index = self.taken.fetch_add(1, Ordering::Relaxed);
            let Some(load) = self.loads.get(index) else {
                break;
            };
            let mut watch = Watch {
                observer: &mut SharedObserver(self),
                step: index,
                // Filled in by `SharedObserver`.
                finished: 0,
                steps: self.loads.len(),
            };
            let outcome = lane.solve(*load, self.options, &mut watch);
            if outcome.is_ok() {
                self.finished.fetch_add(1, Ordering::Relaxed);
            } else {
                self.is_over.store(true, Ordering::Relaxed);
            }
            outcomes.push((index, outcome));
        }
        outcomes
    }
}

/// The path's observer for one of several lanes: forwards one report at a time, with the number of loads that all lanes
/// have finished.
struct SharedObserver<'a, 'b, 'c>(&'a Queue<'b, 'c>);

impl Observer for SharedObserver<'_, '_, '_> {
    fn progress(&mut self, progress: &Progress) -> Signal {
        let queue = self.0;
        let mut observer = (queue.observer.lock()).unwrap_or_else(PoisonError::into_inner);
        if queue.is_cancelled.load(Ordering::Relaxed) {
            return Signal::Cancel;
        }
        let signal = observer.progress(&Progress {
            finished: queue.finished.load(Ordering::Relaxed),
            ..*progress
        });
        if signal == Signal::Cancel {
            queue.is_cancelled.store(true, Ordering::Relaxed);
        }
        signal
    }
}

#[cfg(test)]
mod tests;
