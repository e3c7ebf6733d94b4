//! Random rough surfaces, alone and in periodic cells, without and with a hardness: each is certified or refused with a
//! reason, and none stalls.
//!
//! 12 of each kind by default, and the hardest; `PELLICLE_RANDOM_ROUGH=1000 cargo test --release -p pellicle-contact
//! random_rough::` for more.

#![expect(
    clippy::unwrap_used,
    reason = "a scene that cannot be built fails its test"
)]
#![expect(
    clippy::print_stderr,
    reason = "`--nocapture` shows what a long run took"
)]

use std::f64::consts::TAU;
use std::sync::{
    Arc, Mutex,
    atomic::{AtomicU64, Ordering},
};

use pellicle_contact::{
    ContactError, Domain, FlatPunch, Indenter, Load, Model, Paraboloid, SolverOptions, Step,
    solve_path,
};
use pellicle_influence::{Cache, RadialTables};
use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};
use pellicle_texture::{HeightMap, MapCompliance, Relief, ReliefMap};
use rayon::prelude::*;

use super::random_cases::random::Random;

/// Number of foundations that the problems share.
const FOUNDATIONS: u64 = 16;
/// A problem whose first window does not carry the force at the hardness.
const WINDOW_TOO_SMALL: u64 = 99;
/// A problem whose elements at the hardness must be held and released together: one at a time, they cycled.
const CYCLED_ONE_BY_ONE: u64 = 814;
/// A cell on a coating 4000 times as stiff, nearly all of whose contact is at the hardness: not solved without added
/// springs.
const FEW_CARRY: u64 = 1649;
/// A cell whose force needs less than two elements at the hardness, but started with two.
const ONE_AND_A_PART: u64 = 4246;
/// Number of waves of a surface.
const WAVES: usize = 40;

/// The random part of a problem that is solved under various conditions.
struct Problem {
    model: Model,
    side: f64,
    elements: usize,
    force: f64,
    /// Whether the surface is periodic.
    is_periodic: bool,
}

/// Number of problems of each kind.
fn problems() -> u64 {
    std::env::var("PELLICLE_RANDOM_ROUGH").map_or(12, |count| count.parse().unwrap())
}

/// Up to two layers, moduli over six decades, on a half-space or a rigid base.
fn foundation(seed: u64) -> Foundation {
    let mut random = Random(seed);
    let count = random.below(3);
    let mut layers = Vec::new();
    for _ in 0..count {
        let material = Material::new(random.decades(1e-3, 1e3), [0.0, 0.3, 0.45][random.below(3)]);
        let thickness = random.decades(1e-3, 0.3);
        layers.push(Layer::new(thickness, material.unwrap(), Interface::Bonded).unwrap());
    }
    let base = if count > 0 && random.below(5) == 0 {
        Base::Rigid
    } else {
        Base::HalfSpace(Material::new(1.0, 0.5 * random.unit()).unwrap())
    };
    Foundation::new(layers, base).unwrap()
}

/// The tables, one for each foundation.
fn all_tables() -> Vec<Arc<RadialTables>> {
    let tables = (0..FOUNDATIONS).into_par_iter();
    tables
        .map(|seed| Arc::new(RadialTables::build(&foundation(seed)).unwrap()))
        .collect()
}

/// A self-affine map over a side of 1: waves of random directions and phases, from a few per side to two samples each,
/// with amplitudes as the wavenumber to the power −H.
fn map(random: &mut Random, samples: usize, is_periodic: bool) -> HeightMap {
    let hurst = 0.3 + 0.6 * random.unit();
    let (longest, shortest) = (1.0 + 4.0 * random.unit(), samples as f64 / 2.0);
    let slope = random.decades(1e-3, 1.0);
    let waves: Vec<_> = (0..WAVES)
        .map(|_| {
            let number = random.decades(longest, shortest);
            let angle = TAU * random.unit();
            let wave = [number * angle.cos(), number * angle.sin()];
            let wave = if is_periodic {
                wave.map(f64::round)
            } else {
                wave
            };
            (wave, number.powf(-hurst), TAU * random.unit())
        })
        .collect();
    let at = |k: usize| (k as f64 + 0.5) / samples as f64;
    let height = |x: f64, y: f64| {
        let waves = waves.iter();
        waves
            .map(|([m, n], amplitude, phase)| amplitude * (TAU * (m * x + n * y) + phase).cos())
            .sum::<f64>()
    };
    let heights: Vec<f64> = (0..samples * samples)
        .into_par_iter()
        .map(|e| slope / TAU * height(at(e / samples), at(e % samples)))
        .collect();
    HeightMap::new(heights, [samples; 2], [1.0; 2]).unwrap()
}

/// A rough surface, rigid or with springs, on some foundation, under a plane or a paraboloid, on grids of 16 to 256
/// elements per side, with as many samples or another number.
fn problem(random: &mut Random, tables: &[Arc<RadialTables>], is_periodic: bool) -> Problem {
    let tables = tables[random.below(tables.len())].clone();
    let elements = [16, 32, 48, 64, 96, 100, 128, 256][random.below(8)];
    let samples = if random.below(2) == 0 {
        elements
    } else {
        16 + random.below(100)
    };
    let map = map(random, samples, is_periodic);
    let heights = map.highest() - map.lowest();
    let softness = tables.foundation().compliance(TAU * elements as f64);
    let compliance = match random.below(3) {
        0 => MapCompliance::Uniform(softness * random.decades(1e-2, 1e2)),
        1 => MapCompliance::YoungModulus(heights / softness * random.decades(1e-2, 1e2)),
        _ => MapCompliance::Uniform(0.0),
    };
    let relief = ReliefMap::new(map, compliance).unwrap();
    let relief = match compliance {
        MapCompliance::YoungModulus(_) if random.below(2) == 0 => relief.stiffening().unwrap(),
        _ => relief,
    };
    let indenter: Indenter = if random.below(2) == 0 {
        FlatPunch::new(2.0).unwrap().into()
    } else {
        Paraboloid::new(random.decades(0.3, 100.0)).unwrap().into()
    };
    // The displacement under a pressure of 1 over the whole side.
    let yields = tables.foundation().compliance(TAU);
    let force = heights / yields * random.decades(1e-5, 3.0);
    Problem {
        model: Model {
            tables,
            relief: Relief::Map(relief),
            indenter,
            cache: Cache::none(),
        },
        side: 1.0,
        elements,
        force,
        is_periodic,
    }
}

impl Problem {
    fn solve(&self, hardness: f64) -> Result<Step, ContactError> {
        let domain = if self.is_periodic {
            Domain::Periodic(self.side)
        } else {
            Domain::Side(self.side)
        };
        let options = SolverOptions {
            hardness,
            ..SolverOptions::default()
        };
        let loads = [Load::Force(self.force)];
        let path = solve_path(
            &self.model,
            domain,
            self.elements,
            &loads,
            &options,
            &mut (),
        );
        path.map(|mut path| path.steps.remove(0))
    }

    fn describe(&self) -> String {
        let compliance = match &self.model.relief {
            Relief::Map(map) => format!("{:?}, {:?}", map.compliance(), map.map().shape()),
            _ => String::new(),
        };
        format!(
            "N = {}, force {:e}, {compliance}, {:?}, {:?}",
            self.elements,
            self.force,
            self.model.indenter,
            self.model.tables.foundation()
        )
    }
}

/// Solves the problem of every seed and prints the products; each must be certified, or refused if its hardness is too
/// low.
fn assert_each_is_certified(is_periodic: bool, has_hardness: bool) {
    let (tables, beyond) = (all_tables(), AtomicU64::new(0));
    let products = Mutex::new(Vec::new());
    let seeds: Vec<u64> = (0..problems())
        .chain([
            WINDOW_TOO_SMALL,
            CYCLED_ONE_BY_ONE,
            FEW_CARRY,
            ONE_AND_A_PART,
        ])
        .collect();
    let failures: Vec<String> = seeds
        .into_par_iter()
        .filter_map(|seed| {
            let mut random = Random(seed.wrapping_mul(0x2545_f491_4f6c_dd1d) ^ 0x51ed);
            let problem = problem(&mut random, &tables, is_periodic);
            let clock = std::time::Instant::now();
            let mut step = problem.solve(f64::INFINITY);
            if let (true, Ok(elastic)) = (has_hardness, &step) {
                let peak = elastic
                    .solution
                    .pressure
                    .iter()
                    .copied()
                    .fold(0.0, f64::max);
                let hardness = peak * random.decades(1e-2, 1.0);
                step = problem.solve(hardness);
                if let Err(ContactError::BeyondHardness { .. }) = step {
                    beyond.fetch_add(1, Ordering::Relaxed);
                    let carried = hardness * problem.side * problem.side;
                    let is_true = problem.force > carried;
                    return (!is_true).then(|| format!("{seed}: refused, carries {carried:e}"));
                }
            }
            let details = format!(
                "{:.1} s, {}",
                clock.elapsed().as_secs_f64(),
                problem.describe()
            );
            match step {
                Ok(step) if step.solution.certificate.is_satisfied() => {
                    let work = step.work.operator_applications;
                    products.lock().unwrap().push(work);
                    None
                }
                Ok(step) => Some(format!(
                    "{seed}: {:?}, {details}",
                    step.solution.certificate
                )),
                Err(reason) => Some(format!("{seed}: {reason}, {details}")),
            }
        })
        .collect();
    let (count, beyond) = (failures.len(), beyond.into_inner());
    let mut products = products.into_inner().unwrap();
    products.sort_unstable();
    let solved = products.len();
    let [median, ninth, most] = [solved / 2, solved * 9 / 10, solved.max(1) - 1]
        .map(|place| products.get(place).copied().unwrap_or(0));
    eprintln!(
        "{solved} certified, {beyond} refused, {count} failed; products on the finest grid with the certificate's: \
         median {median}, nine tenths {ninth}, most {most}"
    );
    assert!(
        failures.is_empty(),
        "{count} of {}\n{}",
        problems(),
        failures.join("\n")
    );
    assert!(2 * beyond < problems(), "{beyond} beyond the hardness");
}

#[test]
fn every_random_rough_surface_is_certified() {
    assert_each_is_certified(false, false);
}

#[test]
fn every_random_rough_surface_with_a_hardness_is_certified_or_refused() {
    assert_each_is_certified(false, true);
}

#[test]
fn every_random_rough_cell_is_certified() {
    assert_each_is_certified(true, false);
}

#[test]
fn every_random_rough_cell_with_a_hardness_is_certified_or_refused() {
    assert_each_is_certified(true, true);
}
