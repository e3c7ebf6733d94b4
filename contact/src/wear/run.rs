//! The steps of a wear: each of two stages, and each stage a contact on a surface that the pressure makes softer.

use std::sync::Arc;

use pellicle_texture::{Grid, Relief};

use super::worn_relief::WornRelief;
use super::{OfDistance, StepWear, Wear};
use crate::{ContactError, Domain, Load, LoadingPath, Model, SolverOptions, Step, solve_path};

/// `γ` of the method.
const GAMMA: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;
/// The first step wears at most this part of the penetration.
const FIRST_PART: f64 = 0.05;
/// Largest factors by which a step becomes shorter and longer, and the part of the length at which the error would be
/// the tolerance.
const SHORTEST: f64 = 0.2;
const LONGEST: f64 = 3.0;
const SAFETY: f64 = 0.9;
/// Most solutions of a stage whose springs shorten, each with the lengths that the last one left, or are worn through.
const MOST_PASSES: usize = 12;
/// Lengths are those of the stage if they change no gap by more than this part of the tolerated error.
const CONSISTENT: f64 = 0.01;
/// More steps than this between two distances are a mistake.
const MOST_STEPS: usize = 10_000;

/// A wear in progress.
pub(super) struct WearRun<'a> {
    model: &'a Model,
    domain: Domain,
    elements: usize,
    load: Load,
    wear: &'a Wear,
    /// The options of the results, and of the contacts on the way.
    user: SolverOptions,
    options: SolverOptions,
    grid: Grid,
    /// Largest depth of wear of each element, m: the height of its spring, infinite without one.
    most: Vec<f64>,
    /// Whether an element can wear.
    wears: Arc<Vec<bool>>,
    distance: f64,
    depth: Vec<f64>,
    /// The latest pressures, Pa.
    pressure: Vec<f64>,
    /// Length of the next step, m.
    length: f64,
    is_certified: bool,
    contacts: usize,
}

/// The end of a stage.
struct Stage {
    depth: Vec<f64>,
    pressure: Vec<f64>,
}

impl<'a> WearRun<'a> {
    pub fn new(
        model: &'a Model,
        (domain, elements): (Domain, usize),
        load: Load,
        (wear, options): (&'a Wear, SolverOptions),
        unworn: &LoadingPath,
    ) -> Self {
        let grid = unworn.grid;
        let most = match model.relief.spring_modulus() {
            // h = η E
            Some(modulus) => {
                let sampled = model.relief.sample(&grid);
                let heights = sampled.compliance().iter();
                heights.map(|compliance| compliance * modulus).collect()
            }
            None => vec![f64::INFINITY; grid.len()],
        };
        let mut run = Self {
            model,
            domain,
            elements,
            load,
            wear,
            user: options,
            options: SolverOptions {
                contact_stiffness: false,
                coarse_pressures: false,
                ..options
            },
            grid,
            wears: Arc::new(most.iter().map(|most| *most > 0.0).collect()),
            most,
            distance: 0.0,
            depth: vec![0.0; grid.len()],
            pressure: vec![0.0; grid.len()],
            length: f64::INFINITY,
            is_certified: true,
            contacts: 0,
        };
        if let Some(step) = unworn.steps.first() {
            run.pressure.clone_from(&step.solution.pressure);
            let fastest = wear.coefficient * largest(&run.pressure);
            let scale = step.solution.penetration.abs();
            if scale > 0.0 && fastest > 0.0 {
                run.length = FIRST_PART * scale / fastest;
            }
        }
        run
    }

    /// The contacts at all distances; if `is_enough` is true of one, it is the last.
    pub fn until(
        &mut self,
        is_enough: impl Fn(&Step) -> bool,
        unworn: LoadingPath,
        watch: &mut OfDistance<'_>,
    ) -> Result<LoadingPath, ContactError> {
        let (mut found, unworn) = unworn.take_steps();
        let mut unworn = unworn.into_iter().next();
        let user = self.user;
        for (index, distance) in self.wear.distances.iter().enumerate() {
            watch.step = index;
            match self.advance(*distance, watch) {
                Err(ContactError::Cancelled { .. }) => break,
                other => other?,
            }
            if *distance == 0.0
                && let Some(step) = unworn.take()
            {
                found.steps.push(self.with_wear(step));
                continue;
            }
            let relief = self.relief(&self.depth, &self.depth, None);
            let (path, steps) = self.solve(relief, user, watch)?.take_steps();
            let Some(step) = steps.into_iter().next() else {
                break;
            };
            self.pressure.clone_from(&step.solution.pressure);
            let is_last = is_enough(&step);
            let step = self.with_wear(step);
            found.append(step, &path);
            if is_last {
                break;
            }
        }
        Ok(found)
    }

    /// A step at the distance reached.
    fn with_wear(&mut self, step: Step) -> Step {
        let area = self.grid.element_area();
        let worn_through = (self.depth.iter().zip(&self.most))
            .filter(|(depth, most)| **depth > 0.0 && depth >= most)
            .count();
        let wear = StepWear {
            distance: self.distance,
            volume: area * self.depth.iter().sum::<f64>(),
            max_depth: largest(&self.depth),
            depth: self.depth.clone(),
            worn_through: area * worn_through as f64,
            is_certified: self.is_certified,
            contacts: std::mem::take(&mut self.contacts),
        };
        Step {
            wear: Some(wear),
            ..step
        }
    }

    /// Wears up to a distance, in steps whose error is tolerated.
    fn advance(&mut self, target: f64, watch: &mut OfDistance<'_>) -> Result<(), ContactError> {
        for _ in 0..MOST_STEPS {
            let left = target - self.distance;
            if left <= 0.0 {
                return Ok(());
            }
            let is_last = self.length >= left;
            let length = self.length.min(left);
            let (end, error) = self.step(length, watch)?;
            let factor = if error > 0.0 {
                (SAFETY / error.sqrt()).clamp(SHORTEST, LONGEST)
            } else {
                LONGEST
            };
            if error <= 1.0 {
                self.distance = if is_last {
                    target
                } else {
                    self.distance + length
                };
                (self.depth, self.pressure) = (end.depth, end.pressure);
                // A step that ends at a distance says little of longer ones.
                self.length = if is_last {
                    self.length.max(factor * length)
                } else {
                    factor * length
                };
            } else {
                self.length = factor * length;
            }
        }
        Err(ContactError::Wear {
            quantity: "distance",
            found: target,
            wanted: "one that fewer steps reach",
        })
    }

    /// One step of a length, and its error over the tolerated one.
    fn step(
        &mut self,
        length: f64,
        watch: &mut OfDistance<'_>,
    ) -> Result<(Stage, f64), ContactError> {
        let per_pressure = self.wear.coefficient * length;
        let start = self.depth.clone();
        let first = self.stage(&start, GAMMA * per_pressure, watch)?;
        // d₀ + (1 − γ) k Δ p₁
        let middle = start.iter().zip(&first.pressure).zip(&self.most);
        let middle: Vec<f64> = middle
            .map(|((depth, p), most)| (depth + (1.0 - GAMMA) * per_pressure * p).min(*most))
            .collect();
        let end = self.stage(&middle, GAMMA * per_pressure, watch)?;
        // The method of first order d₀ + k Δ p₁ differs by k γ Δ (p₂ − p₁).
        let pressures = first.pressure.iter().zip(&end.pressure);
        let wearing = pressures.zip(end.depth.iter().zip(&self.most));
        let wearing = wearing.filter(|(_, (depth, most))| depth < most);
        let difference = wearing.fold(0.0_f64, |most, ((one, other), _)| {
            most.max((one - other).abs())
        });
        let tolerated = self.wear.tolerance * largest(&end.depth);
        let error = GAMMA * per_pressure * difference;
        Ok((end, if error > 0.0 { error / tolerated } else { 0.0 }))
    }

    /// Solves `d = d₀ + c p` with the contact on the surface worn to d.
    fn stage(
        &mut self,
        start: &[f64],
        per_pressure: f64,
        watch: &mut OfDistance<'_>,
    ) -> Result<Stage, ContactError> {
        let follows = self.model.relief.spring_modulus().map_or(0.0, f64::recip);
        let mut pressure = self.pressure.clone();
        let mut is_through = vec![false; start.len()];
        let mut pass = 0;
        loop {
            // The length of the springs is that left by the pressure known.
            let lengths = self.worn(start, per_pressure, &pressure, &is_through);
            let softer = is_through
                .iter()
                .map(|is| if *is { 0.0 } else { per_pressure });
            let heights: Vec<f64> = (start.iter().zip(&self.most).zip(&is_through))
                .map(|((depth, most), is)| if *is { *most } else { *depth })
                .collect();
            let relief = self.relief(&heights, &lengths, Some(softer.collect()));
            let path = self.solve(relief, self.options, watch)?;
            let Some(step) = path.steps.into_iter().next() else {
                return Err(ContactError::Cancelled { step: watch.step });
            };
            self.is_certified &= step.solution.certificate.is_satisfied();
            pressure = step.solution.pressure;
            let mut more = false;
            for (element, is_through) in is_through.iter_mut().enumerate() {
                let depth = start[element] + per_pressure * pressure[element];
                if depth > self.most[element] && !*is_through {
                    (*is_through, more) = (true, true);
                }
            }
            let depth = self.worn(start, per_pressure, &pressure, &is_through);
            // The change of the gaps by lengths that are not yet those of the stage.
            let changes = depth.iter().zip(&lengths).zip(&pressure);
            let change = changes.fold(0.0_f64, |most, ((one, other), p)| {
                most.max((one - other).abs() * follows * p)
            });
            pass += 1;
            let is_consistent =
                !more && change <= CONSISTENT * self.wear.tolerance * largest(&depth);
            if is_consistent || pass == MOST_PASSES {
                self.is_certified &= is_consistent;
                return Ok(Stage { depth, pressure });
            }
        }
    }

    /// `d₀ + c p`, up to what can be worn.
    fn worn(
        &self,
        start: &[f64],
        per_pressure: f64,
        pressure: &[f64],
        is_through: &[bool],
    ) -> Vec<f64> {
        let elements = start
            .iter()
            .zip(pressure)
            .zip(self.most.iter().zip(is_through));
        elements
            .map(|((depth, p), (most, is_through))| {
                if *is_through {
                    *most
                } else {
                    (depth + per_pressure * p).min(*most)
                }
            })
            .collect()
    }

    fn relief(&self, depth: &[f64], shorter: &[f64], softer: Option<Vec<f64>>) -> Relief {
        Relief::custom(WornRelief {
            base: self.model.relief.clone(),
            grid: self.grid,
            wears: self.wears.clone(),
            depth: Arc::new(depth.to_vec()),
            shorter: Arc::new(shorter.to_vec()),
            softer: softer.map(Arc::new),
        })
    }

    fn solve(
        &mut self,
        relief: Relief,
        options: SolverOptions,
        watch: &mut OfDistance<'_>,
    ) -> Result<LoadingPath, ContactError> {
        self.contacts += 1;
        let model = Model {
            relief,
            ..self.model.clone()
        };
        solve_path(
            &model,
            self.domain,
            self.elements,
            &[self.load],
            &options,
            watch,
        )
    }
}

/// The largest value, at least 0.
fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| most.max(*value))
}
