//! One stage of a step: the contact on a surface that the pressure itself makes softer, solved from a pressure nearby.

use pellicle_texture::Grid;

use super::{OfDistance, Wear};
use crate::grid::region::Region;
use crate::path::level::Level;
use crate::path::levels::solved_grid;
use crate::solver::Watch;
use crate::{Boundary, ContactError, Load, Model, SolverOptions};

/// Most solutions of a stage whose springs shorten, each with the lengths that the last one left, or are worn through.
const MOST_PASSES: usize = 16;
/// Lengths are those of the stage if they change no gap by more than this part of the tolerated error.
const CONSISTENT: f64 = 0.01;

/// The end of a stage: fields of the elements solved for.
#[derive(Debug, Clone)]
pub(super) struct Stage {
    /// Depth of wear, m.
    pub depth: Vec<f64>,
    /// In Pa.
    pub pressure: Vec<f64>,
    /// Whether the certificates of its contacts are satisfied, and the springs as long as it leaves them.
    pub is_certified: bool,
}

/// The work of some stages.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct StageWork {
    pub contacts: usize,
    pub products: usize,
}

/// The surface that wears, on the elements solved for: all of a grid, or of its half or quadrant if everything is
/// symmetric.
pub(super) struct WearingSurface {
    level: Level,
    region: Region,
    load: Load,
    options: SolverOptions,
    /// `η` (m/Pa) and `g0` (m) without wear.
    compliance: Vec<f64>,
    initial_gap: Vec<f64>,
    /// `1/E` of springs that are as long as the relief is high, 1/Pa; 0 of others.
    per_length: f64,
    /// Largest depth of wear, m: the height of the spring, infinite without one.
    most: Vec<f64>,
    /// Error of the depths in each step, over the largest depth.
    tolerance: f64,
    pub work: StageWork,
}

impl WearingSurface {
    pub fn new(
        model: &Model,
        (grid, boundary): (Grid, Boundary),
        load: Load,
        (wear, options): (&Wear, SolverOptions),
    ) -> Result<Self, ContactError> {
        let options = SolverOptions {
            contact_stiffness: false,
            coarse_pressures: false,
            ..options
        };
        let region = Region::bounded(solved_grid(model, &grid, boundary, &options), boundary);
        let level = Level::new(model, (grid.side(), region), f64::INFINITY, true)?;
        let [compliance, initial_gap] = level.relief().map(<[f64]>::to_vec);
        let modulus = model.relief.spring_modulus();
        Ok(Self {
            level,
            region,
            load,
            options,
            most: match modulus {
                // h = η E
                Some(modulus) => compliance.iter().map(|eta| eta * modulus).collect(),
                None => vec![f64::INFINITY; compliance.len()],
            },
            compliance,
            initial_gap,
            per_length: modulus.map_or(0.0, f64::recip),
            tolerance: wear.tolerance,
            work: StageWork::default(),
        })
    }

    /// Largest depth of wear of each element, m.
    pub fn most(&self) -> &[f64] {
        &self.most
    }

    /// The part of a field of the grid on the elements solved for.
    pub fn cut(&self, field: &[f64]) -> Vec<f64> {
        self.region.grid().cut(field)
    }

    /// The field of the grid of which this is that part.
    pub fn whole(&self, part: &[f64]) -> Vec<f64> {
        self.region.scatter(part.to_vec())
    }

    /// Solves `d = d₀ + c p` with the contact on the surface worn to d, from a pressure nearby.
    pub fn stage(
        &mut self,
        start: &[f64],
        per_pressure: f64,
        mut pressure: Vec<f64>,
        watch: &mut OfDistance<'_>,
    ) -> Result<Stage, ContactError> {
        let through = start.iter().zip(&self.most);
        let mut is_through: Vec<bool> = through.map(|(depth, most)| depth >= most).collect();
        let (mut pass, mut is_certified) = (0, true);
        loop {
            // The length of the springs is that left by the pressure known.
            let lengths = self.worn(start, per_pressure, &pressure, &is_through);
            self.wear_to(start, &lengths, per_pressure, &is_through);
            let mut watching = Watch {
                step: watch.step,
                finished: watch.step,
                steps: watch.steps,
                observer: watch,
            };
            let (load, options) = (self.load, self.options);
            let solved = (self.level).solve_near(&pressure, load, options, &mut watching);
            let (solution, products) = solved?;
            self.work.contacts += 1;
            self.work.products += products;
            is_certified &= solution.certificate.is_satisfied();
            pressure = solution.pressure;
            let tolerated = CONSISTENT * self.tolerance;
            // An element is through if it would be worn deeper. It is not if the pressure on what lies below, which
            // others may have taken over, would not wear it as deep.
            let mut changed = false;
            for (element, is_through) in is_through.iter_mut().enumerate() {
                let most = self.most[element];
                let depth = start[element] + per_pressure * pressure[element];
                let is_deeper = if *is_through {
                    depth >= (1.0 - tolerated) * most
                } else {
                    depth > most
                };
                changed |= is_deeper != *is_through;
                *is_through = is_deeper;
            }
            let depth = self.worn(start, per_pressure, &pressure, &is_through);
            // The change of the gaps by lengths that are not yet those of the stage.
            let changes = depth.iter().zip(&lengths).zip(&pressure);
            let change = changes.fold(0.0_f64, |most, ((one, other), p)| {
                most.max((one - other).abs() * self.per_length * p)
            });
            pass += 1;
            let is_consistent = !changed && change <= tolerated * largest(&depth);
            if is_consistent || pass == MOST_PASSES {
                return Ok(Stage {
                    depth,
                    pressure,
                    is_certified: is_certified && is_consistent,
                });
            }
        }
    }

    /// Puts the surface at a stage: worn to `depth` except where it is worn through, its springs shorter, and softer by
    /// what the stage wears.
    fn wear_to(&mut self, depth: &[f64], shorter: &[f64], per_pressure: f64, is_through: &[bool]) {
        let worn = depth.iter().zip(&self.most).zip(is_through);
        let worn = worn.map(|((depth, most), is_through)| if *is_through { most } else { depth });
        // g0 + d
        let gaps = self.initial_gap.iter().zip(worn);
        let gaps = gaps.map(|(gap, depth)| gap + depth).collect();
        // η = (h − d)/E + c
        let springs = self.compliance.iter().zip(shorter).zip(is_through);
        let springs = springs.map(|((compliance, shorter), is_through)| {
            let left = (compliance - self.per_length * shorter).max(0.0);
            left + if *is_through { 0.0 } else { per_pressure }
        });
        self.level.take_relief(springs.collect(), gaps);
    }

    /// `d₀ + c p`, up to what can be worn.
    fn worn(
        &self,
        start: &[f64],
        per_pressure: f64,
        pressure: &[f64],
        is_through: &[bool],
    ) -> Vec<f64> {
        let elements = start.iter().zip(pressure);
        let elements = elements.zip(self.most.iter().zip(is_through));
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
}

/// The largest value, at least 0.
pub(super) fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| most.max(*value))
}
