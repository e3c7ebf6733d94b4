//! The steps of a wear: each of two stages, of a length that their error allows.

use std::sync::Arc;

use pellicle_influence::{ElasticBody, Sector};
use pellicle_texture::{Grid, Relief};

use super::stage::{Stage, WearingSurface, largest};
use super::worn_relief::WornRelief;
use super::{OfDistance, StepWear, Wear};
use crate::{
    ContactError, Domain, LimitRatio, Load, LoadingPath, Model, ModelLimit, SolverOptions, Step,
    solve_path,
};

/// `γ` of the method.
const GAMMA: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;
/// The weights of the pressures at the start and the two stages of a step in a formula of third order for linear
/// problems, less those of the method, `0, 1 − γ, γ`: with nodes `c = 0, γ, 1` they fulfil `Σ b = 1`, `Σ b c = 1/2` and
/// `Σ b A c = 1/6`.
const BEYOND_METHOD: [f64; 3] = [
    -std::f64::consts::SQRT_2 / 3.0,
    2.0 / 3.0,
    (std::f64::consts::SQRT_2 - 2.0) / 3.0,
];
/// The same for the quadrature that is exact for parabolas. It counts where an element comes into contact during the
/// step, which no formula follows with a higher order: such an element errs alone and is worn right in the next steps.
/// *Measured* on a ball, a film and pillars: with these weights alone depths keep their tolerance.
const ON_ENTERING: [f64; 3] = [
    0.5 - 1.0 / (6.0 * GAMMA),
    1.0 / (6.0 * GAMMA * (1.0 - GAMMA)) - (1.0 - GAMMA),
    (2.0 - 3.0 * GAMMA) / (6.0 * (1.0 - GAMMA)) - GAMMA,
];
/// The first step wears at most this part of the penetration.
const FIRST_PART: f64 = 0.05;
/// Largest factors by which a step becomes shorter and longer, and the part of the length at which the error would be
/// the tolerance.
const SHORTEST: f64 = 0.2;
const LONGEST: f64 = 2.0;
const SAFETY: f64 = 0.9;
/// A step with a stage that is not certified is tried again with a shorter one, unless it is shorter than this part of
/// the distance.
const LEAST_PART: f64 = 1e-4;
/// What a step may err by, over the tolerance: the errors of several steps add up, and that of a pressure on stiff
/// springs exceeds that of the depths.
const STEP_PART: f64 = 0.2;
/// More steps than this between two distances are a mistake.
const MOST_STEPS: usize = 10_000;

/// A wear in progress.
pub(super) struct WearRun<'a> {
    model: &'a Model,
    domain: Domain,
    elements: usize,
    load: Load,
    wear: &'a Wear,
    /// The options of the results.
    options: SolverOptions,
    grid: Grid,
    surface: WearingSurface,
    distance: f64,
    /// Depth and pressure of the elements that are solved for.
    depth: Vec<f64>,
    pressure: Vec<f64>,
    /// A sliding distance before the last one, and the pressure there.
    earlier: Option<(f64, Vec<f64>)>,
    /// Length of the next step, m.
    length: f64,
    /// Whether all stages so far are certified.
    is_certified: bool,
}

impl<'a> WearRun<'a> {
    pub fn new(
        model: &'a Model,
        (domain, elements): (Domain, usize),
        load: Load,
        (wear, options): (&'a Wear, SolverOptions),
        unworn: &LoadingPath,
    ) -> Result<Self, ContactError> {
        let grid = unworn.grid;
        let on = (grid, domain.boundary());
        let surface = WearingSurface::new(model, on, load, (wear, options))?;
        let nothing = vec![0.0; surface.most().len()];
        let mut run = Self {
            model,
            domain,
            elements,
            load,
            wear,
            options,
            grid,
            surface,
            distance: 0.0,
            depth: nothing.clone(),
            pressure: nothing,
            earlier: None,
            length: f64::INFINITY,
            is_certified: true,
        };
        if let Some(step) = unworn.steps.first() {
            run.pressure = run.surface.cut(&step.solution.pressure);
            let fastest = wear.coefficient * largest(&run.pressure);
            let scale = step.solution.penetration.abs();
            if scale > 0.0 && fastest > 0.0 {
                run.length = FIRST_PART * scale / fastest;
            }
        }
        Ok(run)
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
        for (index, distance) in self.wear.distances.iter().enumerate() {
            watch.step = index;
            match self.advance(*distance, watch) {
                Err(ContactError::Cancelled { .. }) => break,
                other => other?,
            }
            if *distance == 0.0
                && let Some(step) = unworn.take()
            {
                let depth = vec![0.0; self.grid.len()];
                found.steps.push(self.with_wear(step, depth));
                continue;
            }
            let depth = self.surface.whole(&self.depth);
            let (path, steps) = self.solve(&depth, watch)?.take_steps();
            let Some(step) = steps.into_iter().next() else {
                break;
            };
            self.pressure = self.surface.cut(&step.solution.pressure);
            let is_last = is_enough(&step);
            let step = self.with_wear(step, depth);
            found.append(step, &path);
            if is_last {
                break;
            }
        }
        Ok(found)
    }

    /// A step at the distance reached, with the depth of wear of each element.
    fn with_wear(&mut self, step: Step, depth: Vec<f64>) -> Step {
        let area = self.grid.element_area();
        let most = self.surface.whole(self.surface.most());
        let elements = depth.iter().zip(&most).zip(&step.solution.pressure);
        let unwearing = elements
            .filter(|((depth, most), p)| depth >= most && **p > 0.0)
            .count();
        let work = std::mem::take(&mut self.surface.work);
        let max_depth = largest(&depth);
        let mut limits = step.limits;
        let of = ElasticBody::Foundation;
        let top = self.model.tables.bodies().of(of).layers().first();
        if let Some(top) = top.filter(|_| self.model.relief == Relief::Bare) {
            limits.push(LimitRatio {
                limit: ModelLimit::WornLayer { of },
                ratio: max_depth / top.thickness(),
            });
        }
        let wear = StepWear {
            distance: self.distance,
            volume: area * depth.iter().sum::<f64>(),
            max_depth,
            depth,
            unwearing: area * unwearing as f64,
            is_certified: self.is_certified,
            contacts: work.contacts,
            products: work.products,
        };
        Step {
            wear: Some(wear),
            limits,
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
            let ([first, end], error) = self.step(length, watch)?;
            // The error is of third order.
            let factor = if error > 0.0 {
                (SAFETY / error.cbrt()).clamp(SHORTEST, LONGEST)
            } else {
                LONGEST
            };
            let is_certified = first.is_certified && end.is_certified;
            if !is_certified && length > LEAST_PART * target {
                self.length = SHORTEST * length;
                continue;
            }
            if error <= 1.0 {
                self.is_certified &= is_certified;
                self.earlier = Some(((1.0 - GAMMA) * length, first.pressure));
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

    /// The two stages of a step of a length, and its error over the tolerated one.
    fn step(
        &mut self,
        length: f64,
        watch: &mut OfDistance<'_>,
    ) -> Result<([Stage; 2], f64), ContactError> {
        let per_pressure = self.wear.coefficient * length;
        let nearby = match &self.earlier {
            Some((before, earlier)) => onward(earlier, &self.pressure, GAMMA * length / before),
            None => self.pressure.clone(),
        };
        let own = GAMMA * per_pressure;
        let first = self.surface.stage(&self.depth, own, nearby, watch)?;
        // d₀ + (1 − γ) k Δ p₁
        let middle = self.depth.iter().zip(&first.pressure);
        let middle = middle.zip(self.surface.most());
        let middle: Vec<f64> = middle
            .map(|((depth, p), most)| (depth + (1.0 - GAMMA) * per_pressure * p).min(*most))
            .collect();
        let nearby = onward(&self.pressure, &first.pressure, (1.0 - GAMMA) / GAMMA);
        let end = self.surface.stage(&middle, own, nearby, watch)?;
        let pressures = self.pressure.iter().zip(&first.pressure).zip(&end.pressure);
        let wearing = pressures.zip(end.depth.iter().zip(self.surface.most()));
        let wearing = wearing.filter(|(_, (depth, most))| depth < most);
        let difference = wearing.fold(0.0_f64, |most, (((p0, p1), p2), _)| {
            let [at_start, at_first, at_end] = if *p0 > 0.0 && *p1 > 0.0 {
                BEYOND_METHOD
            } else {
                ON_ENTERING
            };
            most.max((at_start * p0 + at_first * p1 + at_end * p2).abs())
        });
        let tolerated = STEP_PART * self.wear.tolerance * largest(&end.depth);
        let error = per_pressure * difference;
        let error = if error > 0.0 { error / tolerated } else { 0.0 };
        Ok(([first, end], error))
    }

    /// Solves the contact on the surface after wear of a depth (m).
    fn solve(
        &self,
        depth: &[f64],
        watch: &mut OfDistance<'_>,
    ) -> Result<LoadingPath, ContactError> {
        let most = self.surface.whole(self.surface.most());
        let (depth, wears) = (
            Arc::new(depth.to_vec()),
            most.iter().map(|most| *most > 0.0),
        );
        let model = Model {
            relief: Relief::custom(WornRelief {
                base: self.model.relief.clone(),
                grid: self.grid,
                wears: Arc::new(wears.collect()),
                depth,
                is_mirrored: self.model.sector() == Sector::Quadrant,
            }),
            ..self.model.clone()
        };
        let (domain, loads) = (self.domain, [self.load]);
        solve_path(&model, domain, self.elements, &loads, &self.options, watch)
    }
}

/// The pressures after two, continued in proportion by `factor` times the way between them, and no less than 0.
fn onward(before: &[f64], latest: &[f64], factor: f64) -> Vec<f64> {
    let pressures = before.iter().zip(latest);
    pressures
        .map(|(before, latest)| (latest + factor * (latest - before)).max(0.0))
        .collect()
}
