//! The choice of the domain, and contacts cut off by their domain or a map.

#![expect(
    clippy::unwrap_used,
    reason = "a scene that cannot be built fails its test"
)]

use std::sync::Arc;

use pellicle_contact::{
    ContactError, CutOff, Domain, FlatPunch, Indenter, IndenterMap, Load, LoadingPath, Model,
    Paraboloid, SolverOptions, Sphere, Status, Warning, choose_side, solve_path,
};
use pellicle_influence::{Cache, RadialTables};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::{
    CylinderSpec, Cylinders, Film, HeightMap, Lattice, MapCompliance, Relief, ReliefMap,
};

/// A model on a homogeneous body of plane-strain modulus `modulus`.
fn model(modulus: f64, relief: Relief, indenter: impl Into<Indenter>) -> Model {
    let body = Foundation::half_space(Material::new(modulus, 0.0).unwrap());
    Model {
        tables: Arc::new(RadialTables::build(&body).unwrap()),
        relief,
        indenter: indenter.into(),
        cache: Cache::none(),
    }
}

fn paraboloid(radius: f64) -> Indenter {
    Paraboloid::new(radius).unwrap().into()
}

/// Force of a Hertzian contact of radius `a` under a paraboloid of radius 1 on a modulus of 1.
fn hertz(a: f64) -> Load {
    Load::Force(4.0 / 3.0 * a.powi(3))
}

fn solve(model: &Model, domain: Domain, elements: usize, load: Load) -> LoadingPath {
    let options = SolverOptions::default();
    solve_path(model, domain, elements, &[load], &options, &mut ()).unwrap()
}

fn codes(path: &LoadingPath) -> Vec<&'static str> {
    path.warnings.iter().map(Warning::code).collect()
}

/// A surface of `samples`² heights over a square of side `side`, from a function of the place.
fn map(samples: usize, side: f64, height: impl Fn(f64, f64) -> f64) -> HeightMap {
    let at = |i: usize| ((i as f64 + 0.5) / samples as f64 - 0.5) * side;
    let heights = (0..samples * samples).map(|e| height(at(e / samples), at(e % samples)));
    HeightMap::new(heights.collect(), [samples; 2], [side; 2]).unwrap()
}

/// Two waves and a pseudo-random part, with a total of about `amplitude`.
fn rough(amplitude: f64, side: f64) -> HeightMap {
    map(96, side, |x, y| {
        let (x, y) = (x / side, y / side);
        let waves = (31.0 * x + 17.0 * y).sin() + (67.0 * x - 41.0 * y).cos();
        let chance = (1e4 * (x * 12.9898 + y * 78.233).sin()).fract();
        amplitude * (waves + chance) / 3.0
    })
}

#[test]
fn a_ball_on_a_domain_smaller_than_its_contact_is_cut_off() {
    // 1 mm, 1 mN, 1 µm: the contact radius is 1.5 µm or more, and all elements are in contact
    let model = model(
        200e9,
        Relief::Bare,
        Indenter::from(Sphere::new(1e-3).unwrap()),
    );
    let load = Load::Force(1e-3);
    let path = solve(&model, Domain::Side(1e-6), 32, load);
    let step = &path.steps[0];
    assert!(step.solution.certificate.is_satisfied());
    assert_eq!(step.cut_off, Some(CutOff::Domain));
    assert_eq!(step.status(), Status::CutOff);
    assert!(codes(&path).contains(&"cut-off"), "{:?}", codes(&path));
    // the chosen domain holds the contact
    let path = solve(&model, Domain::Automatic, 32, load);
    assert_eq!(path.steps[0].status(), Status::Certified);
}

#[test]
fn a_contact_that_ends_at_or_just_before_the_edge_is_not_cut_off() {
    let punch = model(1.0, Relief::Bare, FlatPunch::new(0.1).unwrap());
    // the outermost elements carry pressure, and behind them there is no punch
    let path = solve(&punch, Domain::Side(0.2), 32, Load::Penetration(1e-3));
    assert_eq!(path.steps[0].summary.elements_to_edge, Some(0));
    assert_eq!(path.steps[0].status(), Status::Certified);
    assert!(codes(&path).contains(&"domain-edge"));
    // a punch that extends beyond the edge is cut off
    let path = solve(&punch, Domain::Side(0.18), 32, Load::Penetration(1e-3));
    assert_eq!(path.steps[0].status(), Status::CutOff);
    // the gap behind the edge is less than the penetration, but the surface is displaced
    let ball = model(1.0, Relief::Bare, paraboloid(1.0));
    let path = solve(&ball, Domain::Side(0.22), 64, hertz(0.1));
    assert_eq!(path.steps[0].status(), Status::Certified);
}

/// A square lattice of pillars so high that only they are touched, the four next to the axis at ± 0.05.
fn pillars() -> Model {
    let spec = CylinderSpec {
        lattice: Lattice::Square,
        radius: 0.012,
        height: 0.1,
        period: 0.1,
        offset: [0.05, 0.05],
        young_modulus: 50.0,
    };
    let relief = Relief::Cylinders(Cylinders::new(spec).unwrap());
    model(1.0, relief, paraboloid(1.0))
}

#[test]
fn pillars_beyond_the_domain_that_would_be_touched_cut_the_contact_off() {
    // At least 12 pillars are touched in a larger domain; here the edge of the domain runs between them.
    let load = Load::Penetration(0.03);
    let path = solve(&pillars(), Domain::Side(0.2), 64, load);
    let to_edge = path.steps[0].summary.elements_to_edge;
    assert!(to_edge > Some(3), "{to_edge:?}");
    assert_eq!(path.steps[0].cut_off, Some(CutOff::Domain));
    let path = solve(&pillars(), Domain::Automatic, 64, load);
    assert_eq!(path.steps[0].status(), Status::Certified);
    assert!(path.steps[0].summary.contact_radius > 0.15);
}

#[test]
fn a_domain_in_a_valley_between_pillars_is_not_chosen() {
    // the first guess, for evenly spread pillars, is far smaller than a period
    let load = Load::Force(1e-7);
    let path = solve(&pillars(), Domain::Automatic, 64, load);
    assert_eq!(path.steps[0].status(), Status::Certified);
    let radius = path.steps[0].summary.contact_radius;
    assert!(radius > 0.05 && radius < 0.09, "{radius}");
}

#[test]
fn a_contact_at_the_end_of_a_map_is_cut_off_by_it() {
    let flat = ReliefMap::new(map(20, 0.2, |_, _| 0.0), MapCompliance::Uniform(0.0)).unwrap();
    let on_map = model(1.0, Relief::Map(flat), paraboloid(1.0));
    let with_map = model(
        1.0,
        Relief::Bare,
        Indenter::from(IndenterMap::new(map(41, 0.2, |x, y| 0.5 * (x * x + y * y)))),
    );
    for (model, by) in [(on_map, CutOff::ReliefMap), (with_map, CutOff::IndenterMap)] {
        for (radius, cut_off) in [(0.06, None), (0.12, Some(by))] {
            // on a domain larger than the map, on one of the map's size, and on a chosen one
            for domain in [Domain::Side(0.4), Domain::Side(0.2), Domain::Automatic] {
                if cut_off.is_none() && domain == Domain::Side(0.4) {
                    continue;
                }
                let path = solve(&model, domain, 64, hertz(radius));
                assert_eq!(path.steps[0].cut_off, cut_off, "{domain:?} {radius}");
            }
        }
    }
}

#[test]
fn the_domain_does_not_depend_on_the_grid() {
    let rough = ReliefMap::new(rough(4e-3, 0.4), MapCompliance::Uniform(0.0)).unwrap();
    let model = model(1.0, Relief::Map(rough), paraboloid(1.0));
    for force in [1e-5, 3e-4] {
        let load = Load::Force(force);
        let side = choose_side(&model, &[load]).unwrap();
        for elements in [31, 64, 200] {
            let path = solve(&model, Domain::Automatic, elements, load);
            assert_eq!(path.grid.side().to_bits(), side.to_bits(), "{elements}");
        }
    }
}

#[test]
fn a_first_guess_far_too_small_or_too_large_is_corrected() {
    // Springs of a map so soft that they spread the contact to ten times that on the bare body; a tip at the corner of
    // a map.
    let soft = ReliefMap::new(rough(1e-3, 40.0), MapCompliance::Uniform(1e4)).unwrap();
    let on_springs = model(1.0, Relief::Map(soft), paraboloid(1.0));
    let tip = |x: f64, y: f64| 0.5 * ((x - 0.45).powi(2) + (y - 0.45).powi(2));
    let at_corner = model(
        1.0,
        Relief::Bare,
        Indenter::from(IndenterMap::new(map(100, 1.0, tip))),
    );
    for (model, load) in [(&on_springs, hertz(0.1)), (&at_corner, hertz(0.04))] {
        let path = solve(model, Domain::Automatic, 64, load);
        // The equations are solved on the whole contact, although so soft a map lets the paraboloid sink by its radius.
        let step = &path.steps[0];
        assert!(step.solution.certificate.is_satisfied() && step.cut_off.is_none());
        let radius = step.summary.contact_radius;
        let part = radius / path.grid.side();
        assert!(part > 0.12 && part < 0.5, "{part} of {:?}", path.grid);
    }
}

#[test]
fn the_domain_is_the_same_in_any_unit() {
    let film = |length: f64, stress: f64| Film::new(2e-3 * length, 0.05 * stress).unwrap();
    let side = |length: f64, stress: f64| {
        let relief = Relief::Film(film(length, stress));
        let model = model(stress, relief, paraboloid(length));
        let force = Load::Force(1e-3 * stress * length * length);
        choose_side(&model, &[force]).unwrap() / length
    };
    let wanted = side(1.0, 1.0);
    for (length, stress) in [(1e-9, 1e12), (3e-5, 7e9), (1e3, 1e-6)] {
        approx::assert_relative_eq!(side(length, stress), wanted, max_relative = 1e-11);
    }
}

#[test]
fn prescribed_values_are_returned_bit_for_bit() {
    let model = model(1.0, Relief::Bare, paraboloid(1.0));
    for value in [1e-3, 0.7e-3, 1.1e-3] {
        let forced = solve(&model, Domain::Automatic, 32, Load::Force(value));
        assert_eq!(forced.steps[0].solution.force.to_bits(), value.to_bits());
        let pushed = solve(&model, Domain::Automatic, 32, Load::Penetration(value));
        let depth = pushed.steps[0].solution.penetration;
        assert_eq!(depth.to_bits(), value.to_bits());
    }
}

#[test]
fn a_domain_far_larger_than_the_contact_is_reported_as_such() {
    // 1 mm, 100 mm
    let ball = Indenter::from(Sphere::new(1e-3).unwrap());
    let ball = model(200e9, Relief::Bare, ball);
    let load = Load::Force(1e-3);
    let options = SolverOptions::default();
    let refused = solve_path(&ball, Domain::Side(0.1), 64, &[load], &options, &mut ());
    assert!(matches!(
        refused,
        Err(ContactError::ElementsTooLarge { radius, wanted, .. })
            if radius > 1e-6 && radius < 2e-6 && wanted > 2.9 * radius && wanted < 3.1 * radius
    ));
    // only on the finest grid are elements small enough for some to be under the ball
    let path = solve(&ball, Domain::Side(0.1), 256, load);
    let told = ["domain-much-larger", "peak-not-resolved", "not-resolved"];
    assert_eq!(codes(&path), told);
    assert!(path.warnings[0].to_string().contains("choose a side near"));
    // few elements on a coarse grid do not mean that the side is wrong
    let path = solve(&ball, Domain::Automatic, 8, load);
    assert!(!codes(&path).contains(&"domain-much-larger"));
}

#[test]
fn the_error_for_a_domain_that_cannot_be_chosen_asks_for_its_side() {
    let error = ContactError::DomainTooSmall {
        side: 1e-5,
        trials: 100,
    };
    assert!(error.to_string().ends_with("give its side"), "{error}");
}
