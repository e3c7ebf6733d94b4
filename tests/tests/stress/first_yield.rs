//! First yield of coated bodies, compared with independently integrated stresses under a pressure known to 22 digits.

use std::sync::Arc;

use pellicle_contact::axisymmetric::{
    AxisymmetricElasticity, AxisymmetricPressure, AxisymmetricProfile,
};
use pellicle_contact::{
    BodyPart, BodyStrengths, CriticalLoad, Domain, Load, LoadingPath, Model, Paraboloid, Sliding,
    SolverOptions, StressExtremes, StressModel, critical_loads, solve_path, stress_extremes,
};
use pellicle_influence::{Cache, Depth, RadialTables};
use pellicle_kernel::{Foundation, Material, Side};
use pellicle_texture::Relief;
use pellicle_validation::data::contact::{AxisymmetricContact, AxisymmetricIndenter, axisymmetric};
use pellicle_validation::independent::hankel::{fields, of_contact};
use rayon::prelude::*;

/// The body of a case.
fn body(case: &AxisymmetricContact) -> Foundation {
    let coating = Material::new(case.e1, case.nu1).unwrap();
    let substrate = Material::new(1.0, case.nu2).unwrap();
    Foundation::coated(case.thickness, coating, substrate).unwrap()
}

type Place = (f64, [f64; 2]);

fn larger(one: Place, other: Place) -> Place {
    if other.0 > one.0 { other } else { one }
}

/// The largest von Mises stress between two depths of a body, on one side of interfaces, and its position: searched on
/// planes, then on successively finer ones around the best.
fn largest(
    body: &Foundation,
    pressure: &AxisymmetricPressure,
    [top, bottom]: [f64; 2],
    side: Side,
) -> Place {
    let pressure = of_contact(pressure);
    let (mut depths, mut radii) = ([top, bottom], [0.0, 1.3]);
    let mut best = (0.0, [0.0; 2]);
    for _ in 0..6 {
        let along = |[start, end]: [f64; 2], i: u32| start + (end - start) * f64::from(i) / 8.0;
        let places: Vec<f64> = (0..=8).map(|i| along(radii, i)).collect();
        let at_depth = |i: u32| {
            let z = along(depths, i);
            let states = fields(body, &pressure, Depth { z, side }, &places).unwrap();
            let stresses = states.iter().zip(&places);
            let stresses = stresses.map(|(state, r)| (state.von_mises(), [*r, z]));
            stresses.fold((0.0, [0.0; 2]), larger)
        };
        let of_depths: Vec<_> = (0..=8_u32).into_par_iter().map(at_depth).collect();
        best = of_depths.into_iter().fold(best, larger);
        let narrowed = |[start, end]: [f64; 2], at: f64, [least, most]: [f64; 2]| {
            let step = (end - start) / 5.0;
            [(at - step).max(least), (at + step).min(most)]
        };
        depths = narrowed(depths, best.1[1], [top, bottom]);
        radii = narrowed(radii, best.1[0], [0.0, 1.3]);
    }
    best
}

/// Elements per side of a domain of about three contact radii.
const ELEMENTS: usize = 128;
/// (1/40)² times a factor below one.
const GRID: f64 = 4e-4;
/// A maximum is flat: the error of its position is the root of that of its value.
const FLAT: f64 = 0.02;

#[test]
fn a_coated_body_yields_first_at_the_force_and_place_of_the_independent_integral() {
    let cases = axisymmetric().unwrap();
    let is_wanted = |case: &&AxisymmetricContact| {
        case.shape == AxisymmetricIndenter::Paraboloid && (0.1..2.0).contains(&case.thickness)
    };
    let mut compared = 0;
    for case in cases.iter().filter(is_wanted) {
        let body = body(case);
        let paraboloid = AxisymmetricProfile::Paraboloid { radius: 1.0 };
        let elasticity = AxisymmetricElasticity::new(&body.clone().into());
        let solution = elasticity.contact(paraboloid, 1.0).unwrap();
        assert!((solution.force / case.force - 1.0).abs() < 1e-11);
        let height = case.thickness;
        // Hankel's integrals are not evaluated up to the surface.
        let coating = largest(&body, &solution.pressure, [0.06, height], Side::Above);
        let base = largest(
            &body,
            &solution.pressure,
            [height, height + 2.0],
            Side::Below,
        );
        let contact = Contact {
            model: Model {
                tables: Arc::new(RadialTables::build(&body).unwrap()),
                relief: Relief::Bare,
                indenter: Paraboloid::new(1.0).unwrap().into(),
                cache: Cache::none(),
            },
            stress: stress(height, base.0),
        };
        let found = contact.extremes(case.force);
        let of_bodies = found.bodies.iter().map(|body| body.max_von_mises.unwrap());
        for (found, (value, at)) in of_bodies.zip([coating, base]) {
            if at[1] > 0.061 {
                assert!(
                    (found.value / value - 1.0).abs() < GRID,
                    "{case:?} {found:?} {value}"
                );
                assert!(distance(found.at, at) < FLAT, "{case:?} {found:?} {at:?}");
                compared += 1;
            }
        }
        // The substrate's strength is its largest stress under a force known to 22 digits.
        let critical = contact.first_yield(1.6 * case.force);
        let force = critical.force.unwrap();
        assert!(
            (force / case.force - 1.0).abs() < GRID,
            "{case:?} {critical:?}"
        );
        assert!(
            distance(critical.at.unwrap(), base.1) < FLAT,
            "{case:?} {critical:?}"
        );
    }
    assert!(compared >= 7, "{compared}");
}

fn distance([x, y, z]: [f64; 3], [radius, depth]: [f64; 2]) -> f64 {
    (x.hypot(y) - radius).hypot(z - depth)
}

/// The strength is that of the substrate.
fn stress(height: f64, strength: f64) -> StressModel {
    let part = |name: &str, top, bottom, yield_strength| BodyPart {
        name: name.into(),
        top,
        bottom,
        strengths: BodyStrengths {
            yield_strength,
            tensile_strength: None,
        },
    };
    StressModel {
        sliding: Sliding::default(),
        bodies: vec![
            part("layer[0]", 0.0, height, None),
            part("substrate", height, f64::INFINITY, Some(strength)),
        ],
        interfaces: Vec::new(),
        ..StressModel::default()
    }
}

struct Contact {
    model: Model,
    stress: StressModel,
}

impl Contact {
    fn solve(&self, force: f64) -> LoadingPath {
        let (loads, options) = ([Load::Force(force)], SolverOptions::default());
        solve_path(
            &self.model,
            Domain::Automatic,
            ELEMENTS,
            &loads,
            &options,
            &mut (),
        )
        .unwrap()
    }

    fn extremes(&self, force: f64) -> StressExtremes {
        stress_extremes(&self.solve(force), 0, &self.stress).unwrap()
    }

    fn first_yield(&self, largest_force: f64) -> CriticalLoad {
        let path = self.solve(largest_force);
        let extremes = [stress_extremes(&path, 0, &self.stress).unwrap()];
        let critical = critical_loads(
            &self.model,
            &path,
            &extremes,
            Domain::Automatic,
            &SolverOptions::default(),
            &self.stress,
            &mut (),
        );
        critical.unwrap().remove(0)
    }
}
