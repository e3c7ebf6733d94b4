//! Wear against closed forms, against an independent integration, and its balance of volume.

#![expect(
    clippy::unwrap_used,
    reason = "a scene that cannot be built fails its test"
)]

mod springs;
mod worn_through;

use std::sync::Arc;

use pellicle_contact::wear::{StepWear, Wear, solve_wear};
use pellicle_contact::{
    ContactError, Domain, Indenter, Load, LoadingPath, Model, Observer, Paraboloid, Plane,
    Progress, Signal, SolverOptions, Status, Step,
};
use pellicle_influence::{Cache, RadialTables};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::{
    CylinderSpec, Cylinders, Film, Grid, HeightMap, Lattice, MapCompliance, Relief, ReliefMap,
    ReliefShape,
};

/// A relief on a body of this modulus under an indenter.
fn model(young_modulus: f64, relief: Relief, indenter: impl Into<Indenter>) -> Model {
    let body = Foundation::half_space(Material::new(young_modulus, 0.0).unwrap());
    Model {
        tables: Arc::new(RadialTables::build(&body).unwrap()),
        relief,
        indenter: indenter.into(),
        cache: Cache::in_memory(),
    }
}

fn wear(distances: &[f64], tolerance: f64) -> Wear {
    Wear {
        coefficient: 1.0,
        distances: distances.to_vec(),
        tolerance,
    }
}

fn solve(
    model: &Model,
    domain: Domain,
    elements: usize,
    force: f64,
    wear: &Wear,
) -> Vec<(Step, StepWear)> {
    let options = SolverOptions::default();
    let load = Load::Force(force);
    let path = solve_wear(model, domain, elements, load, wear, &options, &mut ());
    steps(path.unwrap())
}

fn steps(path: LoadingPath) -> Vec<(Step, StepWear)> {
    let steps = path.steps.into_iter();
    steps
        .map(|step| {
            let wear = step.wear.clone().unwrap();
            (step, wear)
        })
        .collect()
}

/// Beside springs of unit modulus and height a body of this modulus is rigid to 1e-9.
const RIGID: f64 = 1e9;

#[test]
fn the_worn_volume_is_that_of_archard_and_the_contact_flattens() {
    let ball = model(1.0, Relief::Bare, Paraboloid::new(1.0).unwrap());
    // A Hertzian contact of radius 0.1, worn by up to three times its penetration.
    let force = 4.0 / 3.0 * 1e-3;
    let wear = wear(&[0.0, 0.1, 0.6, 3.0], 1e-2);
    let found = solve(&ball, Domain::Automatic, 32, force, &wear);
    assert_eq!(found.len(), 4);
    for ((step, contact), distance) in found.iter().zip(&wear.distances) {
        assert_eq!(contact.distance.to_bits(), distance.to_bits());
        assert!(step.status() == Status::Certified && contact.unwearing == 0.0);
        // k Q s
        let wanted = force * distance;
        assert!(
            (contact.volume - wanted).abs() <= 1e-12 * wanted,
            "{distance}: {}",
            contact.volume
        );
        assert!(contact.depth.iter().all(|depth| *depth >= 0.0));
    }
    let peaks = found.iter().map(|of| of.0.summary.max_pressure);
    assert!(peaks.is_sorted_by(|before, after| after < before));
    let areas = found.iter().map(|of| of.0.summary.contact_area);
    assert!(areas.is_sorted_by(|before, after| after > before));
    // Nothing is worn at first.
    let first = &found[0].1;
    assert_eq!((first.max_depth, first.contacts), (0.0, 0));
}

#[test]
fn a_uniform_film_under_a_plane_stays_uniform() {
    let film = Relief::Film(Film::new(1.0, 1.0).unwrap());
    let flat = model(RIGID, film, Plane);
    let wear = wear(&[1.0, 5.0], Wear::TOLERANCE);
    for (_, contact) in solve(&flat, Domain::Periodic(1.0), 16, 0.1, &wear) {
        // k p s
        let wanted = 0.1 * contact.distance;
        for depth in &contact.depth {
            assert!((depth / wanted - 1.0).abs() < 1e-12, "{depth}");
        }
    }
}

#[test]
fn half_the_tolerance_changes_depths_by_less_than_the_tolerance() {
    let film = Relief::Film(Film::new(0.02, 0.3).unwrap());
    for (relief, distance) in [(film, 2.0), (Relief::Bare, 0.3)] {
        let ball = model(1.0, relief, Paraboloid::new(1.0).unwrap());
        let solve = |tolerance| {
            let wear = wear(&[distance], tolerance);
            solve(&ball, Domain::Side(0.5), 32, 1e-3, &wear).remove(0).1
        };
        for tolerance in [2.0 * Wear::TOLERANCE, Wear::TOLERANCE] {
            let [rough, fine] = [tolerance, tolerance / 2.0].map(solve);
            let differences =
                (rough.depth.iter().zip(&fine.depth)).map(|(one, other)| (one - other).abs());
            let change = differences.fold(0.0, f64::max) / fine.max_depth;
            assert!(
                fine.contacts >= rough.contacts && change < tolerance,
                "{change:e} {tolerance:e}"
            );
        }
    }
}

#[test]
fn a_stage_takes_few_products_and_mirrored_elements_are_not_solved_for() {
    let ball = model(1.0, Relief::Bare, Paraboloid::new(1.0).unwrap());
    let wear = wear(&[0.1, 0.3, 1.0, 3.0], Wear::TOLERANCE);
    let solve = |mirror_symmetry| {
        let options = SolverOptions {
            mirror_symmetry,
            ..SolverOptions::default()
        };
        let (domain, load) = (Domain::Side(0.6), Load::Force(4.0 / 3.0 * 1e-3));
        steps(solve_wear(&ball, domain, 64, load, &wear, &options, &mut ()).unwrap())
    };
    let (quadrant, whole) = (solve(true), solve(false));
    let total = |of: fn(&StepWear) -> usize| quadrant.iter().map(|step| of(&step.1)).sum::<usize>();
    let (contacts, products) = (total(|wear| wear.contacts), total(|wear| wear.products));
    assert!(
        contacts <= MOST_CONTACTS && products <= 6 * contacts,
        "{contacts} {products}"
    );
    for ((_, one), (_, other)) in quadrant.iter().zip(&whole) {
        let differences = one.depth.iter().zip(&other.depth);
        let change = differences.fold(0.0_f64, |most, (one, other)| most.max((one - other).abs()));
        // Roundings decide whether a step is taken, so both are only within the tolerance.
        let part = change / one.max_depth;
        assert!(part < Wear::TOLERANCE, "{part:e}");
        // Bit for bit symmetric.
        assert!(
            (0..64 * 64).all(|k| one.depth[k].to_bits() == one.depth[64 * 64 - 1 - k].to_bits())
        );
    }
}

/// As measured, 346, with a tenth to spare; with an estimate of first order and a tolerance of 1e-3 they were 800.
const MOST_CONTACTS: usize = 380;

#[test]
fn a_wear_that_is_cancelled_keeps_the_distances_it_has_reached() {
    struct After(usize);
    impl Observer for After {
        fn progress(&mut self, progress: &Progress) -> Signal {
            if progress.step < self.0 {
                Signal::Continue
            } else {
                Signal::Cancel
            }
        }
    }
    let ball = model(1.0, Relief::Bare, Paraboloid::new(1.0).unwrap());
    let (wear, options) = (
        wear(&[0.0, 0.01, 0.02, 0.03], 1e-2),
        SolverOptions::default(),
    );
    let (domain, load) = (Domain::Side(0.5), Load::Force(1e-3));
    let solve = |observer: &mut dyn Observer| {
        solve_wear(&ball, domain, 32, load, &wear, &options, observer).unwrap()
    };
    let (cut, whole) = (solve(&mut After(2)), solve(&mut ()));
    assert!(cut.interrupted && !whole.interrupted);
    assert_eq!(cut.steps.len(), 2);
    for (one, other) in cut.steps.iter().zip(&whole.steps) {
        assert_eq!(one.wear, other.wear);
    }
}

#[test]
fn a_penetration_held_gives_less_force_as_the_surface_wears() {
    let ball = model(1.0, Relief::Bare, Paraboloid::new(1.0).unwrap());
    let (load, options) = (Load::Penetration(0.01), SolverOptions::default());
    let wear = wear(&[0.0, 0.05, 0.2], 1e-2);
    let found =
        steps(solve_wear(&ball, Domain::Side(0.4), 32, load, &wear, &options, &mut ()).unwrap());
    let forces = found.iter().map(|of| of.0.solution.force);
    assert!(forces.is_sorted_by(|before, after| after < before));
    assert!(found.iter().all(|of| of.1.max_depth < 0.01));
}

#[test]
fn wear_that_is_not_computed_is_refused() {
    let film = Film::new(0.02, 0.3).unwrap();
    let solve = |film: Film, wear: &Wear, hardness| {
        let model = model(1.0, Relief::Film(film), Paraboloid::new(1.0).unwrap());
        let options = SolverOptions {
            hardness,
            ..SolverOptions::default()
        };
        let (domain, load) = (Domain::Side(1.0), Load::Force(1e-3));
        solve_wear(&model, domain, 16, load, wear, &options, &mut ()).unwrap_err()
    };
    let valid = wear(&[1.0], 1e-2);
    let none = f64::INFINITY;
    let found = solve(film.stiffening(), &valid, none);
    assert!(matches!(found, ContactError::WearOfStiffening), "{found}");
    let found = solve(film, &valid, 1.0);
    assert!(
        matches!(found, ContactError::WithHardness { .. }),
        "{found}"
    );
    let coefficient = |coefficient| Wear {
        coefficient,
        ..valid.clone()
    };
    for faulty in [
        coefficient(0.0),
        coefficient(-1.0),
        coefficient(f64::NAN),
        wear(&[2.0, 1.0], 1e-2),
        wear(&[-1.0], 1e-2),
        wear(&[1.0], 0.0),
    ] {
        let found = solve(film, &faulty, none);
        assert!(matches!(found, ContactError::Wear { .. }), "{found}");
    }
}

/// A ball far worn in has the volume of its cap, `V = π a⁴/(4R)`, whatever the elasticity: the domain grows with it.
#[test]
fn a_domain_that_was_chosen_grows_with_the_contact_that_is_worn_in() {
    let ball = model(1.0, Relief::Bare, Paraboloid::new(1.0).unwrap());
    let (load, options) = (Load::Force(1e-6), SolverOptions::default());
    let volume: f64 = 1e-6;
    let wear = wear(&[volume / 1e-6], 1e-2);
    let path = solve_wear(&ball, Domain::Automatic, 32, load, &wear, &options, &mut ()).unwrap();
    let found = &steps(path.clone())[0];
    let radius = (4.0 * volume / std::f64::consts::PI).powf(0.25);
    assert!((found.1.volume / volume - 1.0).abs() < 1e-12);
    assert!(
        (found.0.summary.contact_radius / radius - 1.0).abs() < 0.05,
        "{found:?}"
    );
    assert!(path.grid.side() > 2.0 * radius);
    assert!((found.1.max_depth / (radius * radius / 2.0) - 1.0).abs() < 0.05);
}

#[test]
fn a_layer_worn_deeper_than_it_is_thick_is_beyond_the_model() {
    let thickness = 1e-3;
    let material = |modulus| Material::new(modulus, 0.3).unwrap();
    let body = Foundation::coated(thickness, material(4.0), material(1.0)).unwrap();
    let model = Model {
        tables: Arc::new(RadialTables::build(&body).unwrap()),
        ..model(1.0, Relief::Bare, Paraboloid::new(1.0).unwrap())
    };
    let wear = wear(&[1e-3, 0.04, 1.0], 2e-2);
    let (domain, load, options) = (
        Domain::Automatic,
        Load::Force(1e-5),
        SolverOptions::default(),
    );
    let path = solve_wear(&model, domain, 32, load, &wear, &options, &mut ()).unwrap();
    let worn: Vec<f64> = path
        .steps
        .iter()
        .map(|step| step.wear.as_ref().unwrap().max_depth / thickness)
        .collect();
    assert!(
        worn[0] < 0.1 && (0.1..1.0).contains(&worn[1]) && worn[2] > 1.0,
        "{worn:?}"
    );
    let status = |place: usize| path.steps[place].status();
    assert_eq!(
        [0, 1, 2].map(status),
        [Status::Certified, Status::Certified, Status::BeyondModel]
    );
    let codes = path.warnings.iter().map(|of| (of.step(), of.code()));
    let of_wear: Vec<_> = codes
        .filter(|(_, code)| ["layer-worn", "beyond-model"].contains(code))
        .collect();
    assert_eq!(
        of_wear,
        [(Some(1), "layer-worn"), (Some(2), "beyond-model")]
    );
}
