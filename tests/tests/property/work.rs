//! The work of solutions, in products with `K`, on problems where methods are known to fail; and equal bits for any
//! number of threads.

use std::sync::Arc;

use pellicle_contact::{
    Domain, Indenter, Load, Model, Paraboloid, SolverOptions, Step, solve_path,
};
use pellicle_influence::{Cache, RadialTables};
use pellicle_kernel::{Foundation, Material};
use pellicle_tests::scene::figure_2;
use pellicle_texture::{CylinderSpec, Cylinders, Lattice, Relief};

/// A paraboloid of radius 1 on `foundation`, on the square of side 1.
fn model(foundation: &Foundation, relief: Relief) -> Model {
    Model {
        tables: Arc::new(RadialTables::build(foundation).unwrap()),
        relief,
        indenter: Indenter::Paraboloid(Paraboloid::new(1.0).unwrap()),
        cache: Cache::none(),
    }
}

/// Rigid cylinders of period 1/16 and radius 0.4 periods.
fn pillars(height: f64) -> Relief {
    let spec = CylinderSpec {
        lattice: Lattice::Square,
        radius: 0.4 / 16.0,
        height,
        period: 1.0 / 16.0,
        offset: [0.0, 0.0],
        young_modulus: 1e30,
    };
    Relief::Cylinders(Cylinders::new(spec).unwrap())
}

fn solve(model: &Model, elements: usize, force: f64) -> Step {
    let options = SolverOptions {
        contact_stiffness: false,
        ..SolverOptions::default()
    };
    let loads = [Load::Force(force)];
    let path = solve_path(
        model,
        Domain::Side(1.0),
        elements,
        &loads,
        &options,
        &mut (),
    )
    .unwrap();
    path.steps[0].clone()
}

fn assert_cost(name: &str, step: &Step, most: usize) {
    let certificate = &step.solution.certificate;
    assert!(certificate.is_satisfied(), "{name}: {certificate:?}");
    let taken = step.work.operator_applications;
    assert!(taken <= most, "{name}: {taken} products, at most {most}");
}

#[test]
fn a_homogeneous_body_takes_few_products_bare_and_with_pillars() {
    let body = Foundation::half_space(Material::new(1.0, 0.0).unwrap());
    let bare = solve(&model(&body, Relief::Bare), 256, 0.0045);
    assert_cost("Hertz", &bare, 9);
    let islands = solve(&model(&body, pillars(0.00225)), 256, 0.0045);
    assert_cost("pillars", &islands, 12);
}

#[test]
fn a_thin_stiff_coating_on_a_soft_body_is_certified_where_descent_alone_stalls() {
    // Design: H = 0.01, E1 = 1, Q = 4·0.2³/3 · E2/(1 − ν²), 100 and 1000 times as stiff as the body; and where a
    // plate's near coefficients all but cancel.
    for stiffness in [10.0, 20.0, 100.0, 1000.0] {
        let material = |young_modulus| Material::new(young_modulus, 0.3).unwrap();
        let body = Foundation::coated(0.01, material(1.0), material(1.0 / stiffness)).unwrap();
        let force = 4.0 / 3.0 * 0.2_f64.powi(3) / stiffness / 0.91;
        for elements in [64, 128, 256] {
            let name = format!("{stiffness}, N = {elements}");
            let bare = solve(&model(&body, Relief::Bare), elements, force);
            assert_cost(&format!("bare, {name}"), &bare, 40);
            let islands = solve(&model(&body, pillars(0.002)), elements, force);
            assert_cost(&format!("pillars, {name}"), &islands, 60);
        }
    }
}

#[test]
fn every_number_of_threads_gives_the_same_bits() {
    let [_, stiff, soft, _] = figure_2();
    let material = |young_modulus| Material::new(young_modulus, 0.3).unwrap();
    let plate = Foundation::coated(0.01, material(1.0), material(1e-3)).unwrap();
    let plate = model(&plate, pillars(0.002));
    let force = 4.0 / 3.0 * 0.2_f64.powi(3) / 1000.0 / 0.91;
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.unwrap().install(|| {
            let panels = [&stiff, &soft].map(|panel| {
                let domain = Domain::Side(panel.side);
                let options = SolverOptions::default();
                // Large enough for parallel sums.
                let path = solve_path(&panel.model, domain, 300, &[panel.load], &options, &mut ());
                path.unwrap().steps.remove(0)
            });
            // More loads than are solved at the same time.
            let loads: Vec<Load> = (1..=20)
                .map(|k| Load::Force(force / f64::from(k)))
                .collect();
            let (domain, options) = (Domain::Automatic, SolverOptions::default());
            let curve = solve_path(&plate, domain, 48, &loads, &options, &mut ());
            let single = [solve(&plate, 96, force)];
            let steps = panels.into_iter().chain(single).chain(curve.unwrap().steps);
            steps
                .map(|step| {
                    let bits = step.solution.pressure.iter().map(|p| p.to_bits());
                    let stiffness = step.contact_stiffness.map(f64::to_bits);
                    (bits.collect::<Vec<_>>(), stiffness)
                })
                .collect::<Vec<_>>()
        })
    };
    let alone = with(1);
    // Two threads divide the fields evenly, three and seven do not; 24 is more than the loads solved at once.
    for threads in [2, 3, 4, 7, 24] {
        assert!(with(threads) == alone, "{threads} threads");
    }
}
