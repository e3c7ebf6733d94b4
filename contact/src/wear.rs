//! Wear of the surface that an indenter slides over: Archard's law at every element.
//!
//! Over the sliding distance s the surface loses the depth d, with the coefficient k of the wear (m²/N):
//!
//! ```text
//! dd/ds = k p,    g = K p + η(d) p + g0 + d − D
//! ```
//!
//! The heights of a relief fall, and springs as long as the relief is high, `η = (h − d)/E`, become shorter; where they
//! are worn through, wear ends, and the body below does not wear. A surface that is the body's own, bare or rough, and
//! springs of a given compliance wear without end. The load stays as it is prescribed.
//!
//! An implicit step of length Δ has `d = d₀ + k γ Δ p`: this is the contact itself with springs of the additional
//! compliance `k γ Δ` under every element, so that each stage is one solution of the same problem, stable whatever Δ,
//! and under a force Q the worn volume is `k Q s` as exactly as the pressures carry the force. Steps are those of the
//! diagonally implicit method of two stages, L-stable and of second order, `γ = 1 − 1/√2` (R. Alexander, SIAM J.
//! Numer. Anal. 14, 1977, 1006–1021); its difference from a method of first order chooses their length.

mod worn_relief;

use std::sync::Arc;

use pellicle_texture::{Grid, Relief};

use self::worn_relief::WornRelief;
pub use crate::result::step_wear::StepWear;

use crate::path::warnings::warnings;
use crate::result::cut_off::CutOff;
use crate::{
    ContactError, Domain, Load, LoadingPath, Model, Observer, Progress, Signal, SolverOptions,
    Step, solve_path,
};

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
/// Factor by which a chosen domain is enlarged, and how often at most, if the contact outgrows it.
const ENLARGEMENT: f64 = 1.5;
const ENLARGEMENTS: usize = 8;
/// More steps than this between two distances are a mistake.
const MOST_STEPS: usize = 10_000;

/// A wear to compute.
#[derive(Debug, Clone, PartialEq)]
pub struct Wear {
    /// Depth of wear per pressure and sliding distance, m²/N.
    pub coefficient: f64,
    /// The sliding distances of the results, m, from 0 and rising.
    pub distances: Vec<f64>,
    /// Error of the depths in each step, over the largest depth.
    pub tolerance: f64,
}

impl Wear {
    /// The usual tolerance: steps of a tenth of it change depths by less than this part of the largest.
    pub const TOLERANCE: f64 = 1e-3;

    /// Checks the numbers.
    ///
    /// # Errors
    /// [`ContactError::Wear`] with the first that is not valid.
    pub fn checked(&self) -> Result<(), ContactError> {
        let refuse = |quantity, found, wanted| {
            Err(ContactError::Wear {
                quantity,
                found,
                wanted,
            })
        };
        let positive = "a positive finite number";
        if !(self.coefficient > 0.0 && self.coefficient.is_finite()) {
            return refuse("coefficient", self.coefficient, positive);
        }
        if !(self.tolerance > 0.0 && self.tolerance <= 0.1) {
            return refuse("tolerance", self.tolerance, "a number above 0, up to 0.1");
        }
        let mut before = 0.0;
        for distance in &self.distances {
            if !(*distance >= before && distance.is_finite()) {
                return refuse("distance", *distance, "distances from 0 that do not fall");
            }
            before = *distance;
        }
        Ok(())
    }
}

/// Solves the contact after each sliding distance, on `elements` × `elements` elements: a path of one step a distance.
/// If the observer cancels, it holds those solved so far.
///
/// # Errors
/// [`ContactError::Wear`] for invalid numbers; [`ContactError::WearOfStiffening`] for springs that stiffen;
/// [`ContactError::WithHardness`] with a hardness; those of [`solve_path`].
pub fn solve_wear(
    model: &Model,
    domain: Domain,
    elements: usize,
    load: Load,
    wear: &Wear,
    options: &SolverOptions,
    observer: &mut dyn Observer,
) -> Result<LoadingPath, ContactError> {
    wear.checked()?;
    if options.hardness.is_finite() {
        return Err(ContactError::WithHardness { what: "wear" });
    }
    if !model.relief.spring_law().is_linear() {
        return Err(ContactError::WearOfStiffening);
    }
    let mut watch = OfDistance {
        observer,
        step: 0,
        steps: wear.distances.len(),
        is_cancelled: false,
    };
    let unworn = solve_path(model, domain, elements, &[load], options, &mut watch)?;
    let (mut domain, mut enlargements) = match domain {
        Domain::Automatic | Domain::Chosen(_) => (Domain::Side(unworn.grid.side()), ENLARGEMENTS),
        other => (other, 0),
    };
    let mut unworn = Some(unworn);
    loop {
        let first = match unworn.take() {
            Some(first) => first,
            None => solve_path(model, domain, elements, &[load], options, &mut watch)?,
        };
        let mut run = WearRun::new(model, (domain, elements), load, (wear, *options), &first);
        let mut found = run.all(first, &mut watch)?;
        found.interrupted |= watch.is_cancelled;
        let by_domain = |step: &Step| step.cut_off == Some(CutOff::Domain);
        if found.interrupted || enlargements == 0 || !found.steps.iter().any(by_domain) {
            let loads = vec![load; found.steps.len()];
            found.warnings = warnings(model, &found.grid, domain, &loads, &found.steps);
            return Ok(found);
        }
        enlargements -= 1;
        if let Domain::Side(side) = &mut domain {
            *side *= ENLARGEMENT;
        }
    }
}

/// Tells the observer of a path the number of the distance.
struct OfDistance<'a> {
    observer: &'a mut dyn Observer,
    step: usize,
    steps: usize,
    is_cancelled: bool,
}

impl Observer for OfDistance<'_> {
    fn progress(&mut self, progress: &Progress) -> Signal {
        let signal = self.observer.progress(&Progress {
            step: self.step,
            finished: self.step,
            steps: self.steps,
            ..*progress
        });
        self.is_cancelled |= signal == Signal::Cancel;
        signal
    }
}

/// A wear in progress.
struct WearRun<'a> {
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
    fn new(
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

    /// The contacts at all distances.
    fn all(
        &mut self,
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
            let step = self.with_wear(step);
            found.append(step, &path);
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
            let is_consistent = change <= CONSISTENT * self.wear.tolerance * largest(&depth);
            if (is_consistent && !more) || pass == MOST_PASSES {
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
