//! Stresses under solved pressures: extremes against closed forms and against sampling.

use std::sync::Arc;
use std::time::Instant;

use pellicle_contact::{
    BodyPart, BodyStrengths, Domain, Extreme, InterfacePart, InterfaceStrengths, Load, LoadingPath,
    Model, Paraboloid, Sliding, SolverOptions, StressExtremes, StressField, StressModel,
    solve_path, stress_extremes,
};
use pellicle_influence::{Cache, Depth, RadialTables};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::Relief;

/// A paraboloid of radius 1 on a foundation, in its contact.
fn solved(foundation: &Foundation, elements: usize, force: f64) -> LoadingPath {
    let model = Model {
        tables: Arc::new(RadialTables::build(foundation).unwrap()),
        relief: Relief::Bare,
        indenter: Paraboloid::new(1.0).unwrap().into(),
        cache: Cache::none(),
    };
    let options = SolverOptions {
        coarse_pressures: true,
        ..SolverOptions::default()
    };
    solve_path(
        &model,
        Domain::Automatic,
        elements,
        &[Load::Force(force)],
        &options,
        &mut (),
    )
    .unwrap()
}

#[test]
fn probe() {
    let body = Foundation::half_space(Material::new(1.0, 0.3).unwrap());
    for elements in [64, 128, 256, 512] {
        let path = solved(&body, elements, 1e-3);
        let step = &path.steps[0];
        let (p0, a) = {
            let e = 1.0 / (1.0 - 0.09);
            let a = (3.0 * 1e-3 / (4.0 * e) as f64).cbrt();
            (3.0 * 1e-3 / (2.0 * std::f64::consts::PI * a * a), a)
        };
        let clock = Instant::now();
        let stress = StressModel {
            sliding: Sliding::default(),
            bodies: vec![BodyPart {
                name: "substrate".into(),
                top: 0.0,
                bottom: f64::INFINITY,
                strengths: BodyStrengths::default(),
            }],
            interfaces: Vec::new(),
        };
        let found = stress_extremes(&path, 0, &stress).unwrap();
        println!(
            "{elements} {:?} a/h {}",
            clock.elapsed(),
            a / path.grid.element_side()
        );
        let body = &found.bodies[0];
        for (name, e) in [
            ("mises", body.max_von_mises),
            ("s1", body.max_principal),
            ("s3", body.min_principal),
            ("tau", body.max_shear),
        ] {
            println!(
                "  {name} {:.6} at {:?} {} {:?}",
                e.value / p0,
                e.at.map(|x| x / a),
                e.resolved,
                e.estimate.map(|x| x / p0)
            );
        }
        println!("  p {}", step.summary.max_pressure / p0);
    }
}
