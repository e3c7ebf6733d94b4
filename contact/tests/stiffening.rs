//! Springs with the logarithmic law: closed forms, the linear limit, independence of the start, and the work.

#![expect(
    clippy::unwrap_used,
    reason = "a scene that cannot be built fails its test"
)]

use std::sync::Arc;

use pellicle_contact::{
    ActiveSetSolver, Domain, GradientSolver, Indenter, Load, LoadingPath, Model, Paraboloid,
    Pyramid, Solution, Solver, SolverOptions, Watch, reference, solve_path,
};
use pellicle_influence::{Cache, RadialTables};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::{CylinderSpec, Cylinders, Film, Lattice, Relief};

/// Tolerance of solutions that are differentiated or compared with each other.
const TIGHT: f64 = 1e-13;

fn material(young: f64, poisson: f64) -> Material {
    Material::new(young, poisson).unwrap()
}

fn model(foundation: &Foundation, relief: Relief, indenter: impl Into<Indenter>) -> Model {
    Model {
        tables: Arc::new(RadialTables::build(foundation).unwrap()),
        relief,
        indenter: indenter.into(),
        cache: Cache::in_memory(),
    }
}

fn on(model: &Model, relief: Relief) -> Model {
    Model {
        relief,
        ..model.clone()
    }
}

fn solve(model: &Model, side: f64, elements: usize, load: Load, tolerance: f64) -> LoadingPath {
    let (domain, options) = (
        Domain::Side(side),
        SolverOptions {
            tolerance,
            ..SolverOptions::default()
        },
    );
    let path = solve_path(model, domain, elements, &[load], &options, &mut ()).unwrap();
    let certificate = path.steps[0].solution.certificate;
    assert!(certificate.is_satisfied(), "{certificate:?}");
    path
}

fn film(height: f64, young: f64) -> Film {
    Film::new(height, young).unwrap()
}

/// The pillars of the paper's Fig. 2, with this modulus.
fn pillars(young_modulus: f64) -> Cylinders {
    let spec = CylinderSpec {
        lattice: Lattice::Square,
        radius: 5e-3,
        height: 1e-4,
        period: 0.0125,
        offset: [0.0, 0.0],
        young_modulus,
    };
    Cylinders::new(spec).unwrap()
}

/// The coating of the paper's Fig. 5 under its indenter.
fn fig_5(relief: Relief) -> Model {
    let coated = Foundation::coated(10e-9, material(70e9, 0.3), material(7e9, 0.4)).unwrap();
    model(&coated, relief, Pyramid::berkovich(400e-9).unwrap())
}

/// The force of Fig. 5, and a side that holds the contact with a linear film.
const FIG_5: (Load, f64) = (Load::Force(2.3e-3), 3.8e-6);

/// The coatings of the paper's Fig. 2 (c) and (d) under its indenter, each with its force and the side of a domain.
fn fig_2(relief: impl Fn() -> Relief) -> [(Model, Load, f64); 2] {
    let coated = |base, [top, below]: [f64; 2]| {
        Foundation::coated(1e-4, material(1.0, top), material(base, below)).unwrap()
    };
    let paraboloid = Paraboloid::new(1.0).unwrap();
    let (soft, stiff) = (coated(10.0, [0.4, 0.3]), coated(0.1, [0.3, 0.4]));
    [
        (
            model(&soft, relief(), paraboloid),
            Load::Force(2.1426e-4),
            0.12,
        ),
        (
            model(&stiff, relief(), paraboloid),
            Load::Force(2.1426e-5),
            0.2,
        ),
    ]
}

#[test]
fn on_springs_alone_pressure_and_force_are_the_closed_forms() {
    // The body's displacement is 1e-9 of the film's shortening.
    let base = Foundation::half_space(material(1e9, 0.3));
    let (height, young) = (0.01, 1.0);
    let springs = film(height, young).stiffening();
    let pressed = model(&base, Relief::Film(springs), Paraboloid::new(1.0).unwrap());
    for depth in [0.002, 0.009, 0.0099] {
        let wanted = reference::winkler::force_on_stiffening(1.0, height, young, depth);
        let errors = [64, 128, 256].map(|elements| {
            let path = solve(&pressed, 0.36, elements, Load::Penetration(depth), 1e-8);
            let pressure = &path.steps[0].solution.pressure;
            for (place, p) in path.grid.centres().zip(pressure) {
                let [x, y] = place;
                let shortening = (depth - 0.5 * (x * x + y * y)).max(0.0);
                let closed = -young * (-shortening / height).ln_1p();
                // The certificate's 1e-8 of D plus the body's displacement, over the compliance under pressure.
                let slack = 2e-9 * young / (height - shortening);
                assert!((p - closed).abs() < slack, "{place:?}: {p} {closed}");
            }
            (path.steps[0].solution.force / wanted - 1.0).abs()
        });
        // The midpoint rule for a pressure with a kink at the edge, with 11 elements or more per contact radius: second
        // order, with scatter from the position of the edge between elements.
        assert!(errors[0] < 2e-3 && errors[2] < 2e-4, "{depth}: {errors:?}");
    }
}

#[test]
fn the_energy_falls_below_that_of_the_linear_law_by_the_cube_of_the_pressure() {
    let base = Foundation::half_space(material(1.0, 0.3));
    let linear = model(&base, Relief::Bare, Paraboloid::new(1.0).unwrap());
    let (eta, load) = (0.02, Load::Force(1e-3));
    // At the force of the linear film, the energy falls to first order by A Σ η p³/6E, and dE/dQ = D.
    let energy = |relief: Relief, force: f64| {
        let model = on(&linear, relief);
        let path = solve(&model, 0.5, 64, Load::Force(force), TIGHT);
        let derivatives = model.derivatives(&[]).unwrap();
        let energy = derivatives.of_path(&path).unwrap().energy(0);
        (energy, path)
    };
    let Load::Force(force) = load else { return };
    for young in [10.0, 100.0] {
        let springs = film(eta * young, young);
        let (linear_energy, path) = energy(Relief::Film(springs), force);
        let (stiffening_energy, _) = energy(Relief::Film(springs.stiffening()), force);
        let solution = &path.steps[0].solution;
        let cubes: f64 = solution.pressure.iter().map(|p| p.powi(3)).sum();
        let wanted = path.grid.element_area() * eta * cubes / (6.0 * young);
        let ratio = (linear_energy - stiffening_energy) / wanted;
        // The next term of the series: p/E, with p up to 0.05.
        assert!((ratio - 1.0).abs() < 0.05 / young, "{young}: {ratio}");
    }
}

#[test]
fn the_film_of_figure_5_is_squeezed_but_not_beyond_its_thickness() {
    let (load, side) = FIG_5;
    let springs = film(5e-9, 0.14e9);
    let [linear, stiffening] = [springs, springs.stiffening()]
        .map(|film| solve(&fig_5(Relief::Film(film)), side, 128, load, 1e-8));
    let [linear_step, stiffening_step] = [&linear, &stiffening].map(|path| &path.steps[0]);
    assert!(linear_step.summary.largest_shortening > 15.0 * 5e-9);
    assert!((0.99 * 5e-9..=5e-9).contains(&stiffening_step.summary.largest_shortening));
    let codes = |path: &LoadingPath| path.warnings.iter().any(|w| w.code() == "film-shortening");
    assert!(codes(&linear) && !codes(&stiffening));
    // A stiffer film: less penetration, less area, more pressure.
    assert!(stiffening_step.solution.penetration < linear_step.solution.penetration);
    assert!(stiffening_step.summary.contact_area < linear_step.summary.contact_area);
    assert!(stiffening_step.summary.max_pressure > linear_step.summary.max_pressure);
    let surface = stiffening.surface(&stiffening.geometry(), 0).unwrap();
    let largest = surface.shortening.iter().copied().fold(0.0, f64::max);
    assert!((largest / stiffening_step.summary.largest_shortening - 1.0).abs() < 1e-12);
}

#[test]
fn a_solution_by_the_linear_law_is_not_certified_by_the_stiffening_law() {
    let springs = film(5e-9, 0.14e9);
    let (load, side) = FIG_5;
    let [mut linear, mut stiffening] = [springs, springs.stiffening()].map(|film| {
        let model = fig_5(Relief::Film(film));
        let sampled = model.sample(side, 32).unwrap();
        model.discretize(&sampled).unwrap().value
    });
    let start = vec![0.0; linear.elements()];
    let mut nobody = ();
    let mut watch = Watch::alone(&mut nobody);
    let iterate = GradientSolver::default()
        .solve(&mut linear, load, &start, &mut watch)
        .unwrap();
    let own = Solution::judge(&mut linear, load, iterate.pressure.clone(), 1e-8);
    let other = Solution::judge(&mut stiffening, load, iterate.pressure, 1e-8);
    assert!(own.certificate.is_satisfied());
    assert!(other.certificate.worst() > 0.01, "{:?}", other.certificate);
}

#[test]
fn products_are_at_most_twice_those_of_the_linear_law() {
    let springs = film(5e-9, 0.14e9);
    let (load, side) = FIG_5;
    let mut cases = vec![(
        [springs, springs.stiffening()].map(|film| fig_5(Relief::Film(film))),
        load,
        side,
    )];
    for young in [1.0, 0.01] {
        let cylinders = pillars(young);
        let linear = fig_2(|| Relief::Cylinders(cylinders));
        let stiffening = fig_2(|| Relief::Cylinders(cylinders.stiffening()));
        for ((linear, load, side), (stiffening, ..)) in linear.into_iter().zip(stiffening) {
            cases.push(([linear, stiffening], load, side));
        }
    }
    for (models, load, side) in cases {
        let [linear, stiffening] = models.map(|model| {
            let path = solve(&model, side, 256, load, 1e-8);
            path.steps[0].work.operator_applications
        });
        assert!(stiffening <= 2 * linear, "{linear} {stiffening}");
    }
}

#[test]
fn the_contact_stiffness_is_the_slope_between_solutions_of_the_same_contact_set() {
    let springs = film(5e-9, 0.14e9).stiffening();
    let cylinders = pillars(0.01).stiffening();
    let mut cases = vec![(fig_5(Relief::Film(springs)), FIG_5.0, FIG_5.1)];
    cases.extend(fig_2(|| Relief::Cylinders(cylinders)));
    for (model, load, side) in cases {
        let at = |load| solve(&model, side, 48, load, TIGHT).steps.remove(0);
        let step = at(load);
        let set = |pressure: &[f64]| pressure.iter().map(|p| *p > 0.0).collect::<Vec<_>>();
        let depth = step.solution.penetration;
        let slope = [1e-4, 1e-5, 1e-6].into_iter().find_map(|part| {
            let [less, more] =
                [-part, part].map(|part| at(Load::Penetration(depth * (1.0 + part))));
            let all = [&less, &more, &step].map(|step| set(&step.solution.pressure));
            let slope = (more.solution.force - less.solution.force) / (2.0 * part * depth);
            (all[0] == all[2] && all[1] == all[2]).then_some(slope)
        });
        // The square of the relative step, and 1e-13 of each solution over the step.
        let stiffness = step.contact_stiffness.unwrap();
        let slope = slope.expect("a contact set that stands still");
        assert!(
            (stiffness / slope - 1.0).abs() < 1e-5,
            "{stiffness} {slope}"
        );
    }
}

#[test]
fn every_start_and_both_methods_give_the_same_solution() {
    let springs = film(5e-9, 0.14e9).stiffening();
    let mut cases = vec![(fig_5(Relief::Film(springs)), FIG_5.0, FIG_5.1)];
    cases.extend(fig_2(|| Relief::Cylinders(pillars(0.01).stiffening())));
    let depth = |case: &(Model, Load, f64)| {
        let path = solve(&case.0, case.2, 32, case.1, 1e-8);
        Load::Penetration(path.steps[0].solution.penetration)
    };
    let by_depth: Vec<_> = cases
        .iter()
        .map(|case| (case.0.clone(), depth(case), case.2))
        .collect();
    for (model, load, side) in cases.into_iter().chain(by_depth) {
        let sampled = model.sample(side, 32).unwrap();
        let mut problem = model.discretize(&sampled).unwrap().value;
        let options = SolverOptions {
            tolerance: 1e-11,
            ..SolverOptions::default()
        };
        let (mut gradient, mut dense) = (GradientSolver::new(options), ActiveSetSolver { options });
        let elements = problem.elements();
        let mut run = |solver: &mut dyn Solver, start: &[f64]| {
            let (mut nobody, problem) = ((), &mut problem);
            let mut watch = Watch::alone(&mut nobody);
            let iterate = solver.solve(problem, load, start, &mut watch).unwrap();
            Solution::judge(problem, load, iterate.pressure, options.tolerance)
        };
        let wanted = run(&mut dense, &vec![0.0; elements]);
        assert!(
            wanted.certificate.is_satisfied(),
            "{:?}",
            wanted.certificate
        );
        let peak = wanted.pressure.iter().copied().fold(0.0, f64::max);
        let ragged = (0..elements)
            .map(|e| peak * f64::from(u8::from(e % 7 == 3)))
            .collect();
        let starts = [
            vec![0.0; elements],
            vec![100.0 * peak; elements],
            ragged,
            wanted.pressure.clone(),
        ];
        for start in &starts {
            let found = run(&mut gradient, start);
            assert!(found.certificate.is_satisfied(), "{:?}", found.certificate);
            for (p, wanted) in found.pressure.iter().zip(&wanted.pressure) {
                // 1e-11 of D over the smallest compliance, that of one element next to others.
                assert!((p - wanted).abs() < 1e-7 * peak, "{p} {wanted} {peak}");
            }
        }
    }
}
