//! Reliefs worn down to the body that carries them.

use super::*;
use pellicle_contact::solve_path;

#[test]
fn pillars_are_worn_through_and_the_body_below_does_not_wear() {
    let spec = CylinderSpec {
        lattice: Lattice::Square,
        radius: 0.3,
        height: 1e-3,
        period: 1.0,
        offset: [0.0; 2],
        young_modulus: 0.1,
    };
    let flat = model(1.0, Relief::Cylinders(Cylinders::new(spec).unwrap()), Plane);
    let found = solve(
        &flat,
        Domain::Periodic(1.0),
        16,
        1e-4,
        &wear(&[1.0, 100.0], 1e-2),
    );
    let [(_, some), (last, all)] = &found[..] else {
        panic!("{}", found.len())
    };
    // Before a pillar is through: k Q s.
    assert!((some.volume / 1e-4 - 1.0).abs() < 1e-12 && some.unwearing == 0.0);
    assert!(all.depth.iter().all(|depth| (0.0..=1e-3).contains(depth)));
    let tops = all.depth.iter().filter(|depth| **depth > 0.0).count() as f64;
    assert!(
        all.unwearing > 0.95 * tops / 256.0,
        "{} {tops}",
        all.unwearing
    );
    assert!(last.solution.certificate.is_satisfied());
}

#[test]
fn where_a_film_is_worn_through_the_indenter_rides_on_the_body_and_wear_ends() {
    let (height, force, side) = (1e-3, 7.2e-4, 0.16);
    let ball = Paraboloid::new(1.0).unwrap();
    let film = Relief::Film(Film::new(height, 1.0).unwrap());
    let worn = model(20.0, film, ball);
    let distances = wear(&[0.1, 1.0], Wear::TOLERANCE);
    let found = solve(&worn, Domain::Side(side), 64, force, &distances);
    // In the end only the body carries, as if bare, and the film is worn until it just touches: d = h − g where the gap
    // g of the bare contact is below h.
    let options = SolverOptions::default();
    let loads = [Load::Force(force)];
    let bare = model(20.0, Relief::Bare, ball);
    let path = solve_path(&bare, Domain::Side(side), 64, &loads, &options, &mut ()).unwrap();
    let (bare, surface) = (&path.steps[0], path.surface(&path.geometry(), 0).unwrap());
    let left = surface
        .gap
        .iter()
        .map(|gap| (height - gap).clamp(0.0, height));
    let left: Vec<f64> = left.collect();
    let volume = left.iter().sum::<f64>() * (side / 64.0).powi(2);
    for (step, contact) in &found {
        assert_eq!(step.status(), Status::Certified);
        let sunk = step.solution.penetration - height;
        assert!(
            (sunk / bare.solution.penetration - 1.0).abs() < 1e-2,
            "{sunk:e}"
        );
        let ratio = step.summary.max_pressure / bare.summary.max_pressure;
        assert!((ratio - 1.0).abs() < 5e-3, "{ratio}");
        assert!(
            (contact.volume / volume - 1.0).abs() < 5e-3,
            "{} {volume}",
            contact.volume
        );
        let pairs = contact.depth.iter().zip(&left);
        let error = pairs.fold(0.0_f64, |most, (depth, left)| {
            most.max((depth - left).abs())
        });
        assert!(error < 0.02 * height, "{error:e}");
        // What does not wear is in contact.
        assert!(contact.unwearing > 0.0 && contact.unwearing <= step.summary.contact_area);
    }
}

#[test]
fn a_worn_film_has_no_waves_of_a_map() {
    let film = Relief::Film(Film::new(1e-3, 1.0).unwrap());
    let worn = model(20.0, film, Paraboloid::new(1.0).unwrap());
    let distances = wear(&[0.1], Wear::TOLERANCE);
    for (step, _) in solve(&worn, Domain::Side(0.16), 48, 7.2e-4, &distances) {
        assert_eq!(step.grid_error.elements_per_wave, None);
    }
}
