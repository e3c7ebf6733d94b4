//! explore
use pellicle_contact::*;
use pellicle_influence::{Cache, RadialTables};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::{CylinderSpec, Cylinders, Film, Lattice, Relief};
use std::sync::Arc;

fn layered(chi: f64, h: f64) -> Foundation {
    Foundation::coated(
        h,
        Material::new(chi, 0.3).unwrap(),
        Material::new(1.0, 0.3).unwrap(),
    )
    .unwrap()
}

fn run(
    name: &str,
    f: &Foundation,
    relief: [Relief; 2],
    indenter: Indenter,
    loads: &[Load],
    n: usize,
) {
    let tables = Arc::new(RadialTables::build(f).unwrap());
    for (law, relief) in ["lin", "log"].iter().zip(relief) {
        let model = Model {
            tables: tables.clone(),
            relief,
            indenter: indenter.clone(),
            cache: Cache::none(),
        };
        let path = solve_path(
            &model,
            Domain::Automatic,
            n,
            loads,
            &SolverOptions::default(),
            &mut (),
        )
        .unwrap();
        for step in &path.steps {
            println!(
                "{name} {law} side {:.3e} Q {:.4e} D {:.5e} pmax {:.3e} w {:.4e} area {:.4e} | worst {:.1e} ok {} apps {} stiff {} | levels {:?} | sec {:.3} | dQdD {:?}",
                path.grid.side(),
                step.solution.force,
                step.solution.penetration,
                step.summary.max_pressure,
                step.summary.largest_shortening,
                step.summary.contact_area,
                step.solution.certificate.worst(),
                step.solution.certificate.is_satisfied(),
                step.work.operator_applications,
                step.work.stiffness_applications,
                step.work
                    .levels
                    .iter()
                    .map(|l| l.operator_applications)
                    .collect::<Vec<_>>(),
                step.work.seconds,
                step.contact_stiffness
            );
        }
        for w in &path.warnings {
            println!("   {w}");
        }
    }
}

#[test]
fn timing() {
    let film = |h: f64, e: f64| {
        let f = Film::new(h, e).unwrap();
        [Relief::Film(f), Relief::Film(f.stiffening())]
    };
    let coat = Foundation::coated(
        10e-9,
        Material::new(70e9, 0.3).unwrap(),
        Material::new(7e9, 0.4).unwrap(),
    )
    .unwrap();
    for n in [256, 512, 1024] {
        for _ in 0..2 {
            run(
                "fig5",
                &coat,
                film(5e-9, 0.14e9),
                Pyramid::berkovich(400e-9).unwrap().into(),
                &[Load::Force(2.3e-3)],
                n,
            );
        }
        run(
            "hertz",
            &coat,
            film(5e-9, 0.14e9),
            Paraboloid::new(400e-9).unwrap().into(),
            &[Load::Force(2.3e-5)],
            n,
        );
    }
}

#[test]
fn explore() {
    let film = |h: f64, e: f64| {
        let f = Film::new(h, e).unwrap();
        [Relief::Film(f), Relief::Film(f.stiffening())]
    };
    let coat = Foundation::coated(
        10e-9,
        Material::new(70e9, 0.3).unwrap(),
        Material::new(7e9, 0.4).unwrap(),
    )
    .unwrap();
    let q = 2.3e-3;
    run(
        "fig5",
        &coat,
        film(5e-9, 0.14e9),
        Pyramid::berkovich(400e-9).unwrap().into(),
        &[
            Load::Force(q / 100.0),
            Load::Force(q / 10.0),
            Load::Force(q),
            Load::Penetration(2e-7),
            Load::Penetration(2e-8),
        ],
        256,
    );
    for (chi, lh) in [
        (1.0, 0.01),
        (10.0, 0.01),
        (0.1, 0.01),
        (100.0, 0.01),
        (1000.0, 0.05),
    ] {
        let f = layered(chi, lh);
        for (h, e) in [(1e-3, 0.1), (1e-3, 0.01), (1e-3, 0.001)] {
            run(
                &format!("chi {chi} h {h} E {e}"),
                &f,
                film(h, e),
                Paraboloid::new(1.0).unwrap().into(),
                &[Load::Force(1e-3), Load::Penetration(0.01)],
                128,
            );
        }
    }
    let pillars = |h: f64, e: f64| {
        let c = Cylinders::new(CylinderSpec {
            lattice: Lattice::Square,
            radius: 5e-3,
            height: h,
            period: 0.0125,
            offset: [0.0, 0.0],
            young_modulus: e,
        })
        .unwrap();
        [Relief::Cylinders(c), Relief::Cylinders(c.stiffening())]
    };
    let fig2 = |chi: f64, nu1, nu2| {
        Foundation::coated(
            1e-4,
            Material::new(1.0, nu1).unwrap(),
            Material::new(1.0 / chi, nu2).unwrap(),
        )
        .unwrap()
    };
    for e in [1.0, 0.01, 0.001] {
        run(
            &format!("fig2c E {e}"),
            &fig2(0.1, 0.4, 0.3),
            pillars(1e-4, e),
            Paraboloid::new(1.0).unwrap().into(),
            &[Load::Force(2.1426e-4)],
            256,
        );
        run(
            &format!("fig2d E {e}"),
            &fig2(10.0, 0.3, 0.4),
            pillars(1e-4, e),
            Paraboloid::new(1.0).unwrap().into(),
            &[Load::Force(2.1426e-5)],
            256,
        );
    }
}
