//! Random cases from nanometres to metres with a chosen domain: none is refused for it, and none is cut off by it.
//!
//! 20 by default; `PELLICLE_RANDOM_DOMAINS=2000 cargo test --release -p pellicle-contact random_domains::` for
//! more.

#![expect(
    clippy::unwrap_used,
    reason = "a scene that cannot be built fails its test"
)]

use std::sync::Arc;

use pellicle_contact::{
    CutOff, Domain, FlatPunch, Indenter, IndenterMap, Load, Model, Paraboloid, Pyramid,
    SolverOptions, Sphere, solve_path,
};
use pellicle_influence::{Cache, RadialTables};
use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};
use pellicle_texture::{
    CylinderSpec, Cylinders, Film, HeightMap, Lattice, MapCompliance, Relief, ReliefMap,
};
use rayon::prelude::*;

use super::random_cases::random::Random;

const ELEMENTS: usize = 48;
/// Thickness of a coating over the length of a case, its modulus over the body's, and whether the body is rigid.
const FOUNDATIONS: [Option<(f64, f64, bool)>; 6] = [
    None,
    Some((0.1, 1e3, false)),
    Some((0.02, 1e-3, false)),
    Some((0.01, 30.0, false)),
    Some((0.3, 1.0, true)),
    Some((1e-3, 1e5, false)),
];

/// Number of cases.
fn cases() -> u64 {
    std::env::var("PELLICLE_RANDOM_DOMAINS").map_or(20, |count| count.parse().unwrap())
}

/// The unit of length (m) of a foundation, whose modulus is the unit of stress.
fn length(foundation: usize) -> f64 {
    [1.0, 1e-6, 1e-3, 1e-8, 1e-5, 1.0][foundation]
}

fn tables(foundation: usize) -> Arc<RadialTables> {
    let body = Material::new(1.0, 0.3).unwrap();
    let foundation = match FOUNDATIONS[foundation] {
        None => Foundation::half_space(body),
        Some((thickness, modulus, is_rigid)) => {
            let coating = Material::new(modulus, 0.4).unwrap();
            let thickness = thickness * length(foundation);
            let layer = Layer::new(thickness, coating, Interface::Bonded).unwrap();
            let base = if is_rigid {
                Base::Rigid
            } else {
                Base::HalfSpace(body)
            };
            Foundation::new(vec![layer], base).unwrap()
        }
    };
    Arc::new(RadialTables::build(&foundation).unwrap())
}

fn heights(random: &mut Random, side: f64, amplitude: f64) -> HeightMap {
    let samples = 8 + random.below(120);
    let heights = (0..samples * samples).map(|_| amplitude * random.unit());
    HeightMap::new(heights.collect(), [samples; 2], [side; 2]).unwrap()
}

fn relief(random: &mut Random, length: f64) -> Relief {
    let height = length * random.decades(1e-5, 1e-1);
    let modulus = random.decades(1e-4, 1e4);
    match random.below(6) {
        0 => Relief::Bare,
        1 => Relief::Film(Film::new(height, modulus).unwrap()),
        2 => {
            let period = length * random.decades(0.02, 2.0);
            let spec = CylinderSpec {
                lattice: [Lattice::Square, Lattice::Hexagonal][random.below(2)],
                radius: period * random.decades(0.1, 0.49),
                height,
                period,
                offset: [random.unit() * period, random.unit() * period],
                young_modulus: modulus,
            };
            Relief::Cylinders(Cylinders::new(spec).unwrap())
        }
        kind => {
            // so large that no contact reaches the end of the map
            let map = heights(random, 1e3 * length, height);
            let compliance = match kind {
                3 => MapCompliance::Uniform(0.0),
                4 => MapCompliance::Uniform(height / modulus),
                _ => MapCompliance::YoungModulus(modulus),
            };
            Relief::Map(ReliefMap::new(map, compliance).unwrap())
        }
    }
}

fn indenter(random: &mut Random, length: f64) -> Indenter {
    let radius = length * random.decades(0.1, 10.0);
    match random.below(6) {
        0 | 1 => Paraboloid::new(radius).unwrap().into(),
        2 => Sphere::new(radius).unwrap().into(),
        3 => Pyramid::berkovich(0.1 * radius).unwrap().into(),
        4 => FlatPunch::new(0.1 * radius).unwrap().into(),
        _ => {
            // a paraboloid measured off its tip
            let (samples, side) = (60, radius);
            let [x0, y0] = [0, 1].map(|_| 0.3 * side * (random.unit() - 0.5));
            let at = |i: usize| ((i as f64 + 0.5) / 60.0 - 0.5) * side;
            let height = |e: usize| {
                let (x, y) = (at(e / samples) - x0, at(e % samples) - y0);
                (x * x + y * y) / (2.0 * radius)
            };
            let heights = (0..samples * samples).map(height).collect();
            let map = HeightMap::new(heights, [samples; 2], [side; 2]).unwrap();
            Indenter::from(IndenterMap::new(map))
        }
    }
}

#[test]
fn every_random_case_has_a_domain_that_holds_its_contact() {
    let tables: Vec<_> = (0..FOUNDATIONS.len()).map(tables).collect();
    let failures: Vec<String> = (0..cases())
        .into_par_iter()
        .filter_map(|seed| {
            let mut random = Random(seed.wrapping_mul(0x2545_f491_4f6c_dd1d));
            let foundation = random.below(FOUNDATIONS.len());
            let length = length(foundation);
            let model = Model {
                tables: tables[foundation].clone(),
                relief: relief(&mut random, length),
                indenter: indenter(&mut random, length),
                cache: Cache::none(),
            };
            let load = Load::Force(length * length * random.decades(1e-8, 1e-3));
            let (domain, options) = (Domain::Automatic, SolverOptions::default());
            let found = solve_path(&model, domain, ELEMENTS, &[load], &options, &mut ());
            let outcome = match found {
                Err(error) => error.to_string(),
                Ok(path) => {
                    let step = &path.steps[0];
                    let part = step.summary.contact_radius / path.grid.side();
                    let holds = step.cut_off != Some(CutOff::Domain);
                    // A step that did not converge does not test its domain.
                    let is_solved = step.solution.certificate.is_satisfied();
                    if !is_solved || (holds && part > 0.08 && part < 0.7) {
                        return None;
                    }
                    format!("{:?}, {part} of {:?}", step.cut_off, path.grid)
                }
            };
            let indenter = format!("{:?}", model.indenter);
            let relief = format!("{:?}", model.relief);
            Some(format!(
                "{seed}: {outcome}; {load:?}, foundation {foundation}, {indenter:.90} on {relief:.90}"
            ))
        })
        .collect();
    for failure in &failures {
        eprintln!("{failure}");
    }
    assert!(failures.is_empty(), "{} of {}", failures.len(), cases());
}
