//! A quadrant or a half stands for the whole surface: the same solution with another operator, another preconditioner
//! and a quarter or half of the elements.

#![expect(
    clippy::unwrap_used,
    reason = "a scene that cannot be built fails its test"
)]

use std::sync::Arc;

use pellicle_contact::{
    Domain, FlatPunch, Indenter, Load, LoadingPath, Model, Observer, Paraboloid, Progress, Pyramid,
    Signal, Solution, SolverOptions, Step, solve_path,
};
use pellicle_influence::{Cache, RadialTables, Sector};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::{CylinderSpec, Cylinders, Film, Grid, Lattice, Relief};

const SIDE: f64 = 0.4;

fn paraboloid() -> Indenter {
    Paraboloid::new(1.0).unwrap().into()
}

/// An indenter on a coating of the given modulus, 0.01 thick on a body of plane-strain modulus 1.
fn model(modulus: f64, relief: Relief, indenter: Indenter) -> Model {
    let material = |modulus: f64| Material::new(modulus, 0.0).unwrap();
    let foundation = Foundation::coated(0.01, material(modulus), material(1.0)).unwrap();
    Model {
        tables: Arc::new(RadialTables::build(&foundation).unwrap()),
        relief,
        indenter,
        cache: Cache::in_memory(),
    }
}

fn cylinders(lattice: Lattice, offset: [f64; 2]) -> Relief {
    let spec = CylinderSpec {
        lattice,
        radius: 0.02,
        height: 1e-3,
        period: 0.05,
        offset,
        young_modulus: 1.0,
    };
    Relief::Cylinders(Cylinders::new(spec).unwrap())
}

fn solve(model: &Model, elements: usize, load: Load, mirror_symmetry: bool) -> LoadingPath {
    let options = SolverOptions {
        tolerance: 1e-10,
        mirror_symmetry,
        ..SolverOptions::default()
    };
    let domain = Domain::Side(SIDE);
    solve_path(model, domain, elements, &[load], &options, &mut ()).unwrap()
}

/// Asserts that both ways give the same solution, and that the solution of the sector solves the whole problem.
fn compare(model: &Model, elements: usize, load: Load) {
    let [part, whole] = [true, false].map(|mirror| solve(model, elements, load, mirror));
    let what = format!("{:?}, {:?}, {elements}", model.indenter, model.relief);
    let [part, whole] = [&part.steps[0], &whole.steps[0]];
    let peak = whole.summary.max_pressure;
    for (one, other) in part.solution.pressure.iter().zip(&whole.solution.pressure) {
        // Gaps are closed to 1e-10 of the penetration; single pressures agree to about 1e3 times that.
        assert!((one - other).abs() < 1e-6 * peak, "{what}: {one} {other}");
    }
    let numbers = |step: &Step| {
        [
            step.solution.penetration,
            step.solution.force,
            step.summary.max_pressure,
            step.summary.mean_pressure,
            step.summary.contact_area,
            step.summary.contact_area_on_relief,
            step.summary.contact_radius,
            step.contact_stiffness.unwrap_or(0.0),
        ]
    };
    for (one, other) in numbers(part).into_iter().zip(numbers(whole)) {
        // The stiffness is accurate to about 1e-6.
        assert!((one - other).abs() <= 1e-5 * other, "{what}: {one} {other}");
    }
    // Of several equal peaks, each way may find a different one.
    let grid = Grid::new(SIDE, elements).unwrap();
    let [u, v] = part.summary.max_pressure_at;
    let half = 0.5 * grid.element_side();
    // An interpolated peak may lie between four elements.
    let is_peak = |[x, y]: [f64; 2]| (x - u).abs().max((y - v).abs()) < 1.001 * half;
    let place = grid.centres().position(is_peak).unwrap();
    assert!(whole.solution.pressure[place] > (1.0 - 1e-2) * peak);
    assert_eq!(
        part.summary.elements_to_edge,
        whole.summary.elements_to_edge
    );
    let products = [part, whole].map(|step| step.work.operator_applications);
    assert!(products[0] <= products[1] + 4, "{what}: {products:?}");
    let sampled = model.sample(SIDE, elements).unwrap();
    let mut problem = model.discretize(&sampled).unwrap().value;
    let judged = Solution::judge(&mut problem, load, part.solution.pressure.clone(), 1e-10);
    assert!(part.solution.certificate.is_satisfied(), "{what}");
    // Two products differ by rounding, about 1e-15 of the penetration.
    let worst = judged.certificate.worst();
    assert!(
        worst < 1.001e-10 && judged.certificate.min_pressure >= 0.0,
        "{what}: {worst:e}"
    );
}

#[test]
fn a_quadrant_gives_the_solution_of_the_whole_grid() {
    let pillars = || cylinders(Lattice::Square, [0.0, 0.0]);
    let film = Relief::Film(Film::new(1e-3, 0.1).unwrap());
    let punch: Indenter = FlatPunch::new(0.1).unwrap().into();
    let vickers: Indenter = Pyramid::vickers(0.01).unwrap().into();
    let force = Load::Force(1e-3);
    for (modulus, relief, indenter, load) in [
        (1.0, Relief::Bare, paraboloid(), force),
        (0.1, pillars(), paraboloid(), force),
        (
            10.0,
            cylinders(Lattice::Hexagonal, [0.025, 0.0]),
            paraboloid(),
            force,
        ),
        (1.0, film, paraboloid(), Load::Penetration(5e-3)),
        (1.0, Relief::Bare, punch, force),
        (1.0, pillars(), vickers, Load::Penetration(8e-3)),
    ] {
        compare(&model(modulus, relief, indenter), 64, load);
    }
}

#[test]
fn a_quadrant_of_an_odd_number_of_elements_gives_the_solution_of_the_whole_grid() {
    let pillars = cylinders(Lattice::Square, [0.025, 0.025]);
    for elements in [6, 34, 50, 90] {
        compare(
            &model(1.0, pillars.clone(), paraboloid()),
            elements,
            Load::Force(1e-3),
        );
    }
}

#[test]
fn a_quadrant_gives_the_solution_of_the_whole_grid_under_a_stiff_coating() {
    for modulus in [100.0, 1000.0] {
        for relief in [Relief::Bare, cylinders(Lattice::Square, [0.0, 0.0])] {
            compare(&model(modulus, relief, paraboloid()), 64, Load::Force(1e-2));
        }
    }
}

#[test]
fn a_contact_that_fills_the_domain_or_is_one_element_on_each_side_is_found() {
    let half_space = model(1.0, Relief::Bare, paraboloid());
    for force in [1e-1, 1e-9] {
        compare(&half_space, 64, Load::Force(force));
    }
    let nothing = solve(&half_space, 64, Load::Penetration(-1e-3), true);
    assert_eq!(nothing.steps[0].summary.contact_elements, 0);
}

/// Records the elements of each grid, and those in contact at the end.
#[derive(Default)]
struct Watcher {
    grids: Vec<usize>,
    contact_elements: usize,
}

impl Observer for Watcher {
    fn progress(&mut self, progress: &Progress) -> Signal {
        self.grids.push(progress.elements);
        self.contact_elements = progress.working_set;
        Signal::Continue
    }
}

#[test]
fn progress_is_reported_for_the_whole_grid() {
    let model = model(1.0, Relief::Bare, paraboloid());
    let mut watcher = Watcher::default();
    let (domain, loads) = (Domain::Side(SIDE), [Load::Force(1e-3)]);
    let options = SolverOptions::default();
    let path = solve_path(&model, domain, 64, &loads, &options, &mut watcher).unwrap();
    watcher.grids.dedup();
    assert_eq!(watcher.grids, [16, 32, 64]);
    assert_eq!(
        watcher.contact_elements,
        path.steps[0].summary.contact_elements
    );
}

#[test]
fn a_half_gives_the_solution_of_the_whole_grid() {
    let film = Relief::Film(Film::new(1e-3, 0.1).unwrap());
    let pillars = || cylinders(Lattice::Square, [0.0, 0.0]);
    let berkovich = || Pyramid::berkovich(0.01).unwrap();
    let sharp = Pyramid::modified_berkovich(0.0).unwrap();
    let five_faces = Pyramid::new(5, 1.2, 0.02).unwrap();
    for (modulus, relief, indenter, load) in [
        (1.0, Relief::Bare, berkovich(), Load::Force(1e-3)),
        (0.1, pillars(), berkovich(), Load::Force(1e-3)),
        (10.0, pillars(), five_faces, Load::Penetration(8e-3)),
        (1.0, film, sharp, Load::Penetration(5e-3)),
    ] {
        let model = model(modulus, relief, indenter.into());
        assert_eq!(model.sector(), Sector::Half);
        for elements in [64, 90] {
            compare(&model, elements, load);
        }
    }
}

#[test]
fn a_half_gives_the_solution_under_stiff_coatings_and_for_one_element_to_all_in_contact() {
    let berkovich = || Indenter::from(Pyramid::berkovich(0.01).unwrap());
    for modulus in [100.0, 1000.0] {
        compare(
            &model(modulus, Relief::Bare, berkovich()),
            64,
            Load::Force(1e-2),
        );
    }
    let half_space = model(1.0, Relief::Bare, berkovich());
    for force in [1e-1, 1e-9] {
        compare(&half_space, 64, Load::Force(force));
    }
}

#[test]
fn an_asymmetric_problem_is_solved_on_the_whole_grid() {
    let berkovich: Indenter = Pyramid::berkovich(0.01).unwrap().into();
    let aside = || cylinders(Lattice::Square, [0.01, 0.0]);
    for model in [
        model(1.0, aside(), berkovich),
        model(1.0, aside(), paraboloid()),
    ] {
        assert_eq!(model.sector(), Sector::Whole);
        let [one, other] = [true, false].map(|mirror| solve(&model, 64, Load::Force(1e-4), mirror));
        assert_eq!(one.steps[0].solution, other.steps[0].solution);
    }
}
