//! Dilute contact: if the contact is a small part of the grid, products are restricted to candidates, and the solution
//! is that of the whole grid.

#![expect(
    clippy::unwrap_used,
    reason = "a scene that cannot be built fails its test"
)]

use std::sync::Arc;

use pellicle_contact::{
    DiscreteProblem, Domain, FlatPunch, GradientSolver, Indenter, Load, LoadingPath, Model,
    Profile, Solution, Solver, SolverOptions, Watch, solve_path,
};
use pellicle_influence::{Cache, CoefficientTable, RadialTables, SurfaceElasticity};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::{HeightMap, MapCompliance, Relief, ReliefMap};

const ELEMENTS: usize = 512;
/// Number of waves of the rough surface.
const WAVES: u32 = 60;

fn half_space() -> Foundation {
    Foundation::half_space(Material::new(1.0, 0.0).unwrap())
}

fn coated() -> Foundation {
    let [coating, base] = [0.2, 1.0].map(|modulus| Material::new(modulus, 0.45).unwrap());
    Foundation::coated(0.02, coating, base).unwrap()
}

/// A map of side 1: waves of equal slope in all directions, 8 to 64 per side.
fn rough() -> ReliefMap {
    let height = |x: f64, y: f64| -> f64 {
        let waves = (0..WAVES).map(|wave| {
            let wave = f64::from(wave);
            // The golden ratio and the square root of two scatter directions and phases.
            let (direction, phase) = (3.883_222 * wave, 8.885_766 * wave * wave);
            let number = 8.0 * 8.0_f64.powf(wave / f64::from(WAVES));
            let along = x * direction.cos() + y * direction.sin();
            (std::f64::consts::TAU * number * along + phase).sin() / number
        });
        0.02 * waves.sum::<f64>()
    };
    let places = (0..ELEMENTS).map(|i| (i as f64 + 0.5) / ELEMENTS as f64 - 0.5);
    let heights = places
        .clone()
        .flat_map(|x| places.clone().map(move |y| height(x, y)));
    let map = HeightMap::new(heights.collect(), [ELEMENTS; 2], [1.0; 2]).unwrap();
    ReliefMap::new(map, MapCompliance::Uniform(0.0)).unwrap()
}

fn model(foundation: &Foundation, relief: Relief, indenter: Indenter) -> Model {
    Model {
        tables: Arc::new(RadialTables::build(foundation).unwrap()),
        relief,
        indenter,
        cache: Cache::none(),
    }
}

fn solve(model: &Model, load: Load) -> LoadingPath {
    let options = SolverOptions::default();
    let path = solve_path(
        model,
        Domain::Side(1.0),
        ELEMENTS,
        &[load],
        &options,
        &mut (),
    );
    let path = path.unwrap();
    let certificate = path.steps[0].solution.certificate;
    assert!(certificate.is_satisfied(), "{certificate:?}");
    path
}

fn on_rough(foundation: &Foundation, load: Load) -> LoadingPath {
    let plane = Indenter::FlatPunch(FlatPunch::new(2.0).unwrap());
    solve(&model(foundation, Relief::Map(rough()), plane), load)
}

/// The same problem solved on the whole grid.
fn on_the_whole_grid(path: &LoadingPath, load: Load) -> Solution {
    let geometry = path.geometry();
    let side = path.grid.element_side();
    let table = CoefficientTable::assemble(&path.tables, side, ELEMENTS).unwrap();
    let surface = SurfaceElasticity::new(Arc::new(table), path.tables.bodies().clone());
    let gap = geometry
        .indenter_profile
        .iter()
        .zip(geometry.relief.profile());
    let gap = gap.map(|(f, profile)| f - profile).collect();
    let eta = geometry.relief.compliance().to_vec();
    let area = path.grid.element_area();
    let surface = Arc::new(surface);
    let mut problem = DiscreteProblem::elastic(surface, ELEMENTS, eta, gap, area).unwrap();
    let start = vec![0.0; ELEMENTS * ELEMENTS];
    let options = SolverOptions::default();
    let mut solver = GradientSolver::new(options);
    let iterate = solver.solve(&mut problem, load, &start, &mut Watch::alone(&mut ()));
    Solution::judge(
        &mut problem,
        load,
        iterate.unwrap().pressure,
        options.tolerance,
    )
}

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |most: f64, value| most.max(value.abs()))
}

#[test]
fn the_solution_is_that_of_the_whole_grid_with_few_of_its_products() {
    for foundation in [half_space(), coated()] {
        for load in [Load::Force(4e-4), Load::Penetration(8e-3)] {
            let path = on_rough(&foundation, load);
            let step = &path.steps[0];
            let pressing = step.solution.pressure.iter().filter(|p| **p > 0.0).count();
            let share = pressing as f64 / (ELEMENTS * ELEMENTS) as f64;
            assert!((5e-4..0.02).contains(&share), "{share}");
            let work = &step.work;
            assert!(
                work.operator_applications == 1 && work.candidate_applications > 5,
                "{work:?}"
            );
            // The same holds on every coarser grid that is solved on candidates.
            let levels = work.levels.iter();
            let dilute: Vec<_> = levels
                .filter(|level| level.candidate_applications > 0)
                .collect();
            assert!(!dilute.is_empty());
            assert!(
                dilute.iter().all(|level| level.operator_applications == 1),
                "{work:?}"
            );
            let whole = on_the_whole_grid(&path, load);
            assert!(whole.certificate.is_satisfied());
            let apart = (step.solution.penetration - whole.penetration).abs();
            assert!(apart <= 2e-8 * whole.penetration, "{apart:e}");
            // Gaps are closed to 1e-8 of the penetration on single elements, which are far stiffer than the contact.
            let both = step.solution.pressure.iter().zip(&whole.pressure);
            let apart = largest(both.map(|(one, other)| one - other));
            let peak = largest(whole.pressure.iter().copied());
            assert!(apart <= 1e-6 * peak, "{apart:e} of {peak:e}");
        }
    }
}

/// Three blunt tips, and between them a needle at the centre of one element of the finest grid, unseen by coarser
/// grids.
#[derive(Debug)]
struct TipsAndNeedle;

/// Row and column of the needle's element.
const NEEDLE: [usize; 2] = [266, 135];

impl Profile for TipsAndNeedle {
    fn height(&self, x: f64, y: f64) -> f64 {
        let above = |[a, b]: [f64; 2], radius: f64| (x - a).hypot(y - b).powi(2) / (2.0 * radius);
        let tips = [[0.0, 0.0], [0.4, 0.4], [-0.4, -0.38]].map(|tip| above(tip, 0.2));
        let needle = NEEDLE.map(|i| (i as f64 + 0.5) / ELEMENTS as f64 - 0.5);
        tips.into_iter().fold(5e-4 + above(needle, 1e-6), f64::min)
    }
}

#[test]
fn a_summit_with_no_candidate_nearby_is_found_and_included() {
    let indenter = Indenter::custom(TipsAndNeedle);
    let load = Load::Penetration(1e-3);
    let path = solve(&model(&half_space(), Relief::Bare, indenter), load);
    let step = &path.steps[0];
    assert!(step.work.candidate_applications > 0);
    let needle = NEEDLE[0] * ELEMENTS + NEEDLE[1];
    let whole = on_the_whole_grid(&path, load);
    let [found, expected] = [&step.solution.pressure, &whole.pressure].map(|p| p[needle]);
    assert!(
        found > 0.0 && (found - expected).abs() < 1e-6 * expected,
        "{found} {expected}"
    );
}

#[test]
fn every_number_of_threads_gives_the_same_bits() {
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let path = pool
            .unwrap()
            .install(|| on_rough(&half_space(), Load::Force(4e-4)));
        let step = &path.steps[0];
        let bits = step.solution.pressure.iter().map(|p| p.to_bits());
        (bits.collect::<Vec<_>>(), step.work.candidate_applications)
    };
    assert!(with(1) == with(3));
}
