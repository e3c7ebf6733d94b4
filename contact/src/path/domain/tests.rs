//! The estimated side where it has a closed form: twice 1.5 contact radii, to a hundredth.

use std::f64::consts::PI;
use std::sync::Arc;

use pellicle_influence::{Cache, RadialTables};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::{
    CylinderSpec, Cylinders, Film, HeightMap, Lattice, MapCompliance, Relief, ReliefMap,
};

use super::{
    Guess, default_side, default_side_at, elastic_force, estimated_force,
    estimated_force_at_radius, relief_volume,
};
use crate::{FlatPunch, Indenter, Load, Model, Paraboloid, Profile as _, Sphere};

fn model(foundation: &Foundation, relief: Relief, indenter: impl Into<Indenter>) -> Model {
    Model {
        tables: Arc::new(RadialTables::build(foundation).unwrap()),
        relief,
        indenter: indenter.into(),
        cache: Cache::in_memory(),
    }
}

/// Plane-strain modulus `modulus`, so that `C(k) = 2/(modulus k)`.
fn half_space(modulus: f64) -> Foundation {
    Foundation::half_space(Material::new(modulus, 0.0).unwrap())
}

fn paraboloid(radius: f64) -> Paraboloid {
    Paraboloid::new(radius).unwrap()
}

#[track_caller]
fn assert_side(model: &Model, loads: &[Load], radius: f64) {
    let side = default_side(model, loads);
    // The search stops less than a hundredth above the radius; 64 points of a smooth integrand add less than 1e-3.
    assert!(
        side > 2.997 * radius && side < 3.034 * radius,
        "{side} for the radius {radius}"
    );
}

#[test]
fn a_penetration_extends_to_where_the_indenter_is_that_high() {
    let model = model(&half_space(1.0), Relief::Bare, paraboloid(2.0));
    // a² = 2 R D; the largest of all loads determines the side
    for depth in [1e-9_f64, 0.01, 50.0] {
        let loads = [0.5 * depth, depth, -depth].map(Load::Penetration);
        assert_side(&model, &loads, (4.0 * depth).sqrt());
    }
}

#[test]
fn without_contact_the_indenter_is_one_thickness_high_at_the_edge() {
    let coating = Material::new(1.0, 0.3).unwrap();
    let coated = Foundation::coated(0.02, coating, Material::new(2.0, 0.3).unwrap()).unwrap();
    // ρ² = 2 R H, with H = 1 m if there is no thickness; the side is twice ρ, not three times.
    for (foundation, height) in [(coated, 0.02_f64), (half_space(1.0), 1.0)] {
        let model = model(&foundation, Relief::Bare, paraboloid(2.0));
        for load in [-1.0, 0.0].map(Load::Penetration) {
            assert_side(&model, &[load], (4.0 * height).sqrt() * 2.0 / 3.0);
        }
    }
}

#[test]
fn the_contact_radius_of_a_force_is_that_of_hertz_in_any_unit() {
    // Q = 4/3 E* a³/R
    for (modulus, radius) in [(1.0, 1.0), (2e11, 1e-6), (1e-3, 40.0)] {
        let model = model(&half_space(modulus), Relief::Bare, paraboloid(radius));
        let a = 0.1 * radius;
        let force = 4.0 / 3.0 * modulus * a.powi(3) / radius;
        assert_side(&model, &[Load::Force(force)], a);
    }
}

#[test]
fn the_guess_on_a_homogeneous_body_is_hertz_with_no_pressure_outside() {
    let model = model(&half_space(2.0), Relief::Bare, paraboloid(1.0));
    let a = 0.1_f64;
    // Q = 4/3 E* a³/R, p0 = 2 E* a/(π R)
    let guess = Guess::new(&model, Load::Force(8.0 / 3.0 * a.powi(3))).unwrap();
    let peak = 4.0 * a / PI;
    for ratio in [0.0_f64, 0.3, 0.8] {
        let wanted = peak * (1.0 - ratio * ratio).sqrt();
        let found = guess.pressure([0.6 * ratio * a, -0.8 * ratio * a]);
        // The radius is accurate to a hundredth, and the peak to its square.
        assert!((found / wanted - 1.0).abs() < 0.03, "{found} {wanted}");
    }
    assert_eq!(guess.pressure([1.02 * a, 0.0]), 0.0);
    for load in [0.0, -1.0].map(Load::Penetration) {
        assert!(Guess::new(&model, load).is_none());
    }
}

#[test]
fn a_coated_body_has_the_modulus_of_waves_as_long_as_the_contact() {
    let coating = Material::new(30.0, 0.3).unwrap();
    let foundation = Foundation::coated(0.05, coating, Material::new(1.0, 0.4).unwrap()).unwrap();
    let a = 0.1_f64;
    // E* = 2 a/C(1/a)
    let modulus = 2.0 * a / foundation.compliance(1.0 / a);
    let model = model(&foundation, Relief::Bare, paraboloid(1.0));
    assert_side(&model, &[Load::Force(4.0 / 3.0 * modulus * a.powi(3))], a);
}

/// `π a⁴/(4 R)`: the volume between a paraboloid and the plane at its height at `a`.
fn volume(a: f64, radius: f64) -> f64 {
    PI * a.powi(4) / (4.0 * radius)
}

#[test]
fn a_film_and_the_body_under_it_are_springs_in_series() {
    let a = 0.2_f64;
    for young in [1e-6, 0.3] {
        let film = Film::new(0.02, young).unwrap();
        let springs = volume(a, 2.0) / (0.02 / young);
        let elastic = 4.0 / 3.0 * 5.0 * a.powi(3) / 2.0;
        let model = model(&half_space(5.0), Relief::Film(film), paraboloid(2.0));
        let force = 1.0 / (1.0 / springs + 1.0 / elastic);
        assert_side(&model, &[Load::Force(force)], a);
    }
}

#[test]
fn a_stiffening_film_has_the_secant_stiffness_at_the_mean_pressure() {
    let (a, height, young) = (0.2_f64, 0.02, 0.3);
    let film = Film::new(height, young).unwrap().stiffening();
    let law = film.spring_law();
    let model = model(&half_space(1e9), Relief::Film(film), paraboloid(2.0));
    let found = estimated_force_at_radius(&model, a);
    // On a nearly rigid body: F = V/η with the secant w(p)/p = η at p = F/π a².
    let pressure = found / (PI * a * a);
    let secant = law.shortening(height / young, pressure) / pressure;
    assert!(
        (found / (volume(a, 2.0) / secant) - 1.0).abs() < 1e-3,
        "{found}"
    );
}

#[test]
fn cylinders_carry_the_force_on_their_area_fraction_and_press_into_the_body() {
    let spec = CylinderSpec {
        lattice: Lattice::Square,
        radius: 0.005,
        height: 1e-3,
        period: 0.02,
        offset: [0.0, 0.0],
        young_modulus: 0.5,
    };
    let share = PI / 16.0;
    // h/E_a, and (1 − φ) C(1/r) = (1 − φ) 2 r/E*
    let compliance = 1e-3 / 0.5 + (1.0 - share) * 2.0 * 0.005 / 5.0;
    let a = 0.01_f64;
    let springs = share * volume(a, 2.0) / compliance;
    let elastic = 4.0 / 3.0 * 5.0 * a.powi(3) / 2.0;
    let relief = Relief::Cylinders(Cylinders::new(spec).unwrap());
    let model = model(&half_space(5.0), relief, paraboloid(2.0));
    let force = 1.0 / (1.0 / springs + 1.0 / elastic);
    assert_side(&model, &[Load::Force(force)], a);
}

#[test]
fn a_punch_touches_up_to_its_rim_under_any_load() {
    let punch = FlatPunch::new(0.3).unwrap();
    for relief in [Relief::Bare, Relief::Film(Film::new(0.02, 0.1).unwrap())] {
        let model = model(&half_space(1.0), relief, punch);
        for load in [Load::Force(1e-9), Load::Force(1e3), Load::Penetration(0.1)] {
            assert_side(&model, &[load], 0.3);
        }
    }
}

#[test]
fn the_slope_of_a_paraboloid_is_its_distance_over_its_radius() {
    let indenter = Indenter::from(paraboloid(2.0));
    for rho in [1e-6, 0.3, 5.0] {
        // The central difference of a square is exact; its rounding is 1e-16 over the step of 1e-3.
        assert!((indenter.mean_slope(rho) / (rho / 2.0) - 1.0).abs() < 1e-12);
    }
}

#[test]
fn forces_and_volumes_of_a_paraboloid_are_the_closed_forms() {
    let film = Relief::Film(Film::new(0.02, 0.3).unwrap());
    let model = model(&half_space(5.0), film, paraboloid(2.0));
    for a in [1e-3_f64, 0.2] {
        // Midpoint rule with 64 parts: error at most 1/64².
        let elastic = 4.0 / 3.0 * 5.0 * a.powi(3) / 2.0;
        assert!((elastic_force(&model, a) / elastic - 1.0).abs() < 3e-4);
        assert!((relief_volume(&model, a) / volume(a, 2.0) - 1.0).abs() < 3e-4);
    }
}

#[test]
fn the_estimated_force_is_that_of_a_contact_to_where_the_height_is_the_penetration() {
    let model = model(&half_space(3.0), Relief::Bare, paraboloid(2.0));
    for depth in [1e-6_f64, 0.01] {
        // Hertz: Q = 4/3 E* a³/R = 4/3 E* √R D^1.5, with the radius √(R D) instead of √(2 R D)
        let hertz = 4.0 / 3.0 * 3.0 * 2.0_f64.sqrt() * depth.powf(1.5);
        let ratio = estimated_force(&model, depth) / hertz;
        assert!((ratio / 8.0_f64.sqrt() - 1.0).abs() < 0.01, "{ratio}");
        let radius = (2.0 * 2.0 * depth).sqrt();
        let at_radius = estimated_force_at_radius(&model, radius);
        assert!((estimated_force(&model, depth) / at_radius - 1.0).abs() < 1e-9);
    }
    assert_eq!(
        [0.0, -0.1].map(|depth| estimated_force(&model, depth)),
        [0.0; 2]
    );
}

#[test]
fn the_estimated_force_of_a_flat_end_is_that_of_a_punch() {
    // F = 2 a E* D
    let punch = model(&half_space(3.0), Relief::Bare, FlatPunch::new(2.0).unwrap());
    for depth in [1e-6_f64, 0.01] {
        let ratio = estimated_force(&punch, depth) / (2.0 * 2.0 * 3.0 * depth);
        // The radius is taken a hundredth inside the rim, and known to a hundredth.
        assert!((ratio - 1.0).abs() < 0.021, "{ratio}");
    }
    // A ball is pressed in beyond its equator: more than to the equator, less than twice as much more than a punch.
    let ball = model(&half_space(3.0), Relief::Bare, Sphere::new(2.0).unwrap());
    let [to, beyond] = [1.9, 3.0].map(|depth| estimated_force(&ball, depth));
    assert!(
        to < beyond && beyond < to + 2.0 * 2.0 * 2.0 * 3.0 * 1.1,
        "{to} {beyond}"
    );
}

#[test]
fn the_domain_contains_the_area_that_carries_the_force_at_the_hardness() {
    let model = model(&half_space(1.0), Relief::Bare, paraboloid(1.0));
    let a = 0.2_f64;
    let force = 4.0 / 3.0 * a.powi(3);
    // Twice 1.5 radii of a disc of area Q/p_max, if that is wider than the elastic contact.
    let hardness = force / (PI * 0.3_f64.powi(2));
    let loads = [Load::Force(force), Load::Penetration(1e-3)];
    let side = default_side_at(&model, &loads, hardness);
    assert!((side / 0.9 - 1.0).abs() < 1e-12, "{side}");
    let hard = default_side_at(&model, &loads, 100.0 * hardness);
    assert_eq!(hard, default_side(&model, &loads));
}

#[test]
fn a_map_without_springs_counts_as_bare() {
    let map = |eta: f64| {
        let heights = HeightMap::new(vec![0.0; 16], [4, 4], [1.0, 1.0]).unwrap();
        Relief::Map(ReliefMap::new(heights, MapCompliance::Uniform(eta)).unwrap())
    };
    let on = |relief: Relief| {
        estimated_force_at_radius(&model(&half_space(5.0), relief, paraboloid(2.0)), 0.2)
    };
    assert_eq!(on(map(0.0)), on(Relief::Bare));
    // A map of springs of uniform compliance is a film.
    let film = Film::new(0.02, 0.1).unwrap();
    let ratio = on(map(0.2)) / on(Relief::Film(film));
    assert!((ratio - 1.0).abs() < 1e-12, "{ratio}");
}
