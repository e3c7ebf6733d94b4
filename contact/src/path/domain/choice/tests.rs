//! Trials and choices of the square, and verdicts from a coarse grid.

use pellicle_kernel::{Foundation, Material};

use super::*;
use crate::Paraboloid;

fn search() -> SideSearch {
    SideSearch {
        first: 2.0,
        power: 0,
        small: None,
        large: None,
    }
}

#[test]
fn a_search_ends_with_the_smallest_square_that_holds_the_contact() {
    for needed in [-7, 0, 1, 9] {
        for stride in [1, 3, 8] {
            let mut search = search();
            let mut trials = 0;
            let side = loop {
                trials += 1;
                assert!(trials < 12, "{needed} {stride}");
                let verdict = if search.power < needed {
                    SquareVerdict::TooSmall(stride)
                } else {
                    SquareVerdict::TooLarge(-stride)
                };
                if let ControlFlow::Break(side) = search.advance(verdict) {
                    break side;
                }
            };
            assert_eq!(side, 2.0 * FACTOR.powi(needed));
        }
    }
    assert_eq!(
        search().advance(SquareVerdict::Fits),
        ControlFlow::Break(2.0)
    );
}

#[test]
fn the_square_of_a_small_contact_shrinks_to_its_usual_extent() {
    for extent in 1..SMALLEST_EXTENT {
        let SquareVerdict::TooLarge(powers) = shrunk_to_fit(extent) else {
            panic!("too large")
        };
        let grown = extent as f64 * FACTOR.powi(-powers);
        assert!(
            grown <= USUAL_EXTENT && FACTOR * grown > USUAL_EXTENT,
            "{extent}"
        );
    }
}

#[test]
fn a_square_that_cuts_off_grows_half_way_to_where_the_height_is_the_penetration() {
    let model = Model::on_half_space([1.0, 0.3], Relief::Bare, Paraboloid::new(2.0).unwrap());
    // ρ² = 2 R D is 1.5^6.2 half sides away.
    let side = 0.02;
    let depth = (0.5 * side * FACTOR.powf(6.2)).powi(2) / 4.0;
    assert_eq!(enlarged(&model, side, depth), 3);
    assert_eq!(
        [0.0, -1.0, 1e-9].map(|depth| enlarged(&model, side, depth)),
        [1; 3]
    );
}

/// A ball of radius 1 on a coating with this relative stiffness and thickness.
fn on_coating(stiffness: f64, thickness: f64, relief: Relief) -> Model {
    let [coating, base] = [stiffness, 1.0].map(|modulus| Material::new(modulus, 0.3).unwrap());
    let body = Foundation::coated(thickness, coating, base).unwrap();
    Model::on(&body, relief, Paraboloid::new(1.0).unwrap())
}

#[test]
fn the_chosen_square_contains_the_contact_and_is_not_far_larger() {
    let film = Relief::Film(pellicle_texture::Film::new(0.01, 0.02).unwrap());
    for model in [
        on_coating(100.0, 0.02, Relief::Bare),
        on_coating(0.1, 0.05, film),
    ] {
        let loads = [
            Load::Force(1e-4),
            Load::Force(1e-3),
            Load::Penetration(-1.0),
        ];
        let side = choose_side(&model, &loads).unwrap();
        let first = default_side_at(&model, &loads, f64::INFINITY);
        let powers = (side / first).ln() / FACTOR.ln();
        assert!((powers - powers.round()).abs() < 1e-9 && powers.abs() < 4.0);
        let load = Load::Force(1e-3);
        let grid = Grid::new(side, TRIAL).unwrap();
        let step = solve(&model, grid, load, [1e-6, f64::INFINITY]).unwrap();
        let to_edge = step.summary.elements_to_edge.unwrap();
        assert!(
            to_edge >= EDGE_MARGIN && TRIAL / 2 - to_edge >= SMALLEST_EXTENT,
            "{to_edge}"
        );
        // A square nearly filled by the contact is too small, and one with few elements in contact too large.
        let radius = 0.5 * side * (TRIAL / 2 - to_edge) as f64 / (TRIAL / 2) as f64;
        let judged = |factor: f64| judge(&model, factor * radius, load, f64::INFINITY).unwrap();
        assert!(matches!(judged(1.9), SquareVerdict::TooSmall(1..)));
        assert!(matches!(judged(30.0), SquareVerdict::TooLarge(..=-1)));
        assert_eq!(judged(3.0), SquareVerdict::Fits);
    }
}

#[test]
fn a_coarse_grid_decides_what_fits_to_within_half_an_element() {
    let model = Model::on_half_space([1.0, 0.0], Relief::Bare, Paraboloid::new(1.0).unwrap());
    // D = a²/R
    let (radius, load) = (0.1, Load::Penetration(0.01));
    let fits = |size: usize, side_per_radius: f64| {
        let grid = Grid::new(side_per_radius * radius, size).unwrap();
        fits_clearly(&model, grid, load, f64::INFINITY).unwrap()
    };
    // A radius of 16 of the trial's 32 elements; one of 6.4, which is too few; and an edge two elements away.
    for size in FIRST_TRIALS {
        assert_eq!(
            [4.0, 10.0, 2.1].map(|side| fits(size, side)),
            [true, false, false],
            "{size}"
        );
    }
    assert_eq!(
        choose_side(&model, &[load]).unwrap(),
        default_side_at(&model, &[load], f64::INFINITY)
    );
    assert!(is_known_beforehand(&model));
    assert!(!is_known_beforehand(&on_coating(2.0, 0.1, Relief::Bare)));
    // A hardness widens the contact: Q/p_max is the smallest area.
    let force = Load::Force(1e-3);
    let side = choose_side_at(&model, &[force], 0.01).unwrap();
    assert!(side > 2.2 * (1e-3 / 0.01 / std::f64::consts::PI).sqrt());
}

#[test]
fn a_coarse_grid_is_not_used_if_it_may_miss_a_feature() {
    let spec = pellicle_texture::CylinderSpec {
        lattice: pellicle_texture::Lattice::Square,
        radius: 0.05,
        height: 0.1,
        period: 0.2,
        offset: [0.0, 0.0],
        young_modulus: 1.0,
    };
    let cylinders = pellicle_texture::Cylinders::new(spec).unwrap();
    let pillars = on_coating(2.0, 0.1, Relief::Cylinders(cylinders));
    let grid = |elements: usize| Grid::new(1.6, elements).unwrap();
    // Elements of 0.1 are wider than a pillar's radius.
    assert!(!is_resolved_by(&pillars, &grid(16)) && is_resolved_by(&pillars, &grid(32)));
    let bare = on_coating(2.0, 0.1, Relief::Bare);
    assert!(is_resolved_by(&bare, &grid(16)));
    let pin = Model {
        indenter: crate::FlatPunch::new(0.06).unwrap().into(),
        ..bare.clone()
    };
    // Centres at (0.05, 0.05) are outside a pin of radius 0.06, those at (0.025, 0.025) under it.
    assert!(!is_resolved_by(&pin, &grid(16)) && is_resolved_by(&pin, &grid(32)));
    // The four centres around the axis lie at f = 0.05².
    let resolves = |depth: f64| resolves_the_tip(&bare, &grid(16), depth);
    assert!(resolves(f64::NAN) && resolves(0.0026) && !resolves(0.0024));
}
