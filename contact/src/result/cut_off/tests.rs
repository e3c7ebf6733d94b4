//! The blocks around a domain: their positions, their pressures, and the displacement that these cause.

use pellicle_influence::{Cache, RadialTables};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::{HeightMap, MapCompliance, ReliefMap};

use super::*;
use crate::{Certificate, FlatPunch, IndenterMap, Paraboloid, Profile};

/// A solution without residuals.
fn solution(penetration: f64, force: f64, pressure: Vec<f64>) -> Solution {
    Solution {
        penetration,
        force,
        pressure,
        certificate: Certificate {
            complementarity: 0.0,
            gap_in_contact: 0.0,
            overlap: 0.0,
            load: 0.0,
            min_pressure: 0.0,
            gap_at_limit: None,
            over_limit: None,
            tolerance: 1e-8,
        },
    }
}

#[test]
fn blocks_surround_a_square_of_half_their_side() {
    let around = Around::new(1.0, 4);
    assert_eq!((around.count(), around.first()), (8, 2));
    assert_eq!([0, 4, 7].map(|i| around.centre(i)), [-0.875, 0.125, 0.875]);
    for (block, wanted) in [
        ([2, 5], true),
        ([1, 3], false),
        ([5, 6], false),
        ([0, 7], false),
    ] {
        assert_eq!(around.is_within(block), wanted, "{block:?}");
    }
}

#[test]
fn pressures_are_summed_over_the_blocks_that_contain_their_elements() {
    let (grid, around) = (Grid::new(1.0, 10).unwrap(), Around::new(1.0, 4));
    let even = around.summed(&grid, &[3.0; 100]);
    assert!(even.len() == 16 && even.iter().all(|p| (p - 3.0).abs() < 1e-13));
    // The element extends from 0.2 to 0.3, where 0.25 is the end of a block, and from −0.3 to −0.2.
    let mut pressure = [0.0; 100];
    pressure[72] = 8.0;
    let found = around.summed(&grid, &pressure);
    // Quarters of the force over the area of a block: 8 (0.1/0.25)²/4
    for (block, p) in found.iter().enumerate() {
        let is_part = matches!([block / 4, block % 4], [2 | 3, 0 | 1]);
        let wanted = if is_part { 0.32 } else { 0.0 };
        assert!((p - wanted).abs() < 1e-13, "{block}: {p}");
    }
}

#[test]
fn the_surface_farther_away_is_displaced_as_by_the_total_force() {
    let body = Foundation::half_space(Material::new(1.0, 0.0).unwrap());
    let model = Model {
        tables: Arc::new(RadialTables::build(&body).unwrap()),
        relief: Relief::Bare,
        indenter: Paraboloid::new(1.0).unwrap().into(),
        cache: Cache::none(),
    };
    let coarse_check = CoarseCheck::of(&model, 1.0);
    // f = ρ²/2R, least in the middle of an edge
    assert!((coarse_check.lowest - 0.125).abs() < 1e-15);
    let blocks = Blocks::of(&model, &Relief::Bare, Around::new(1.0, FEW_BLOCKS));
    let nearest = 0.53125_f64.hypot(0.03125);
    assert!((blocks.smallest_gap - nearest * nearest / 2.0).abs() < 1e-15);
    assert_eq!(blocks.lowest, blocks.smallest_gap);
    let within = blocks.gaps.iter().filter(|gap| gap.is_infinite());
    assert_eq!(within.count(), FEW_BLOCKS * FEW_BLOCKS);
    // Four elements in the middle carry a force of 0.03.
    let grid = Grid::new(1.0, 32).unwrap();
    let mut pressure = vec![0.0; 1024];
    for e in [15 * 32 + 15, 15 * 32 + 16, 16 * 32 + 15, 16 * 32 + 16] {
        pressure[e] = 0.03 * 256.0;
    }
    let solution = solution(0.15, 0.03, pressure);
    // u = Q/(π E* r), which the blocks reproduce to a hundredth; the gap is least at the nearest block.
    let moved = blocks.smallest_gap + 0.03 / (std::f64::consts::PI * nearest);
    let is_closer = |limit: f64| blocks.is_closer_than(limit, &model, &grid, &solution);
    assert!(!is_closer(moved - 3e-4) && is_closer(moved + 3e-4));
    assert!(!is_closer(blocks.smallest_gap));
}

/// A half-space under an indenter.
fn model(indenter: Indenter, relief: Relief) -> Model {
    let body = Foundation::half_space(Material::new(1.0, 0.0).unwrap());
    Model {
        tables: Arc::new(RadialTables::build(&body).unwrap()),
        relief,
        indenter,
        cache: Cache::none(),
    }
}

/// Samples of a paraboloid of radius 1 at the centres of a map's squares of side 0.1.
fn bowl([rows, columns]: [usize; 2]) -> HeightMap {
    let at = |i: usize, count: usize| 0.1 * (i as f64 + 0.5 - count as f64 / 2.0);
    let heights = (0..rows * columns).map(|k| {
        let [x, y] = [at(k / columns, rows), at(k % columns, columns)];
        f64::midpoint(x * x, y * y)
    });
    let extent = [rows, columns].map(|count| 0.1 * count as f64);
    HeightMap::new(heights.collect(), [rows, columns], extent).unwrap()
}

#[test]
fn the_end_of_a_map_is_reached_by_any_element_within_one_element_of_it() {
    // Elements of side 1/20: the centre of the 16th from the axis lies at 0.775.
    let (grid, size) = (Grid::new(2.0, 40).unwrap(), 40);
    let pressed = |place: [usize; 2]| {
        let mut pressure = vec![0.0; size * size];
        pressure[place[0] * size + place[1]] = 1.0;
        pressure
    };
    for (shape, along) in [([15, 25], 0), ([25, 15], 1)] {
        let indenter = IndenterMap::new(bowl(shape)).into();
        let compliance = MapCompliance::Uniform(0.0);
        let relief = Relief::Map(ReliefMap::new(bowl(shape), compliance).unwrap());
        let punch = FlatPunch::new(9.0).unwrap().into();
        let of_indenter = model(indenter, Relief::Bare);
        let of_relief = model(punch, relief);
        for (model, wanted) in [
            (&of_indenter, CutOff::IndenterMap),
            (&of_relief, CutOff::ReliefMap),
        ] {
            // The map ends at ±0.75 along one axis. The neighbour of the 15th element from the axis, at 0.725, lies
            // beyond it; that of the 14th, at 0.675, does not.
            for [near, far] in [[20 + 13, 20 + 14], [19 - 13, 19 - 14]] {
                let place = |i: usize| if along == 0 { [i, 18] } else { [18, i] };
                let found = [near, far].map(|i| map_reached(model, &grid, &pressed(place(i))));
                assert_eq!(found, [None, Some(wanted)], "{wanted:?} along {along}");
            }
        }
    }
}

#[test]
fn the_lowest_height_is_that_of_the_four_elements_around_the_axis() {
    let ball = model(Paraboloid::new(1.0).unwrap().into(), Relief::Bare);
    // Centres at 1/8 along both axes; with an odd number the middle one lies on the axis.
    let lowest = |size| lowest_height(&ball, &Grid::new(1.0, size).unwrap());
    assert_eq!([lowest(4), lowest(5)], [1.0 / 64.0, 0.0]);
    let pin = model(FlatPunch::new(0.1).unwrap().into(), Relief::Bare);
    let touches = |size| can_touch(&pin, &Grid::new(1.0, size).unwrap());
    assert!(!touches(4) && touches(8) && touches(5));
}

#[test]
fn every_surrounding_square_has_twice_the_side_of_the_previous_one() {
    let ball = model(Paraboloid::new(1.0).unwrap().into(), Relief::Bare);
    let around = Surroundings::of(&ball, Grid::new(3.0, 8).unwrap());
    assert_eq!(
        [0, 1, 4].map(|doublings| around.side(doublings)),
        [3.0, 6.0, 48.0]
    );
}

#[test]
fn the_coarse_check_is_conclusive_if_the_gap_exceeds_the_penetration_by_a_tenth() {
    let ball = model(Paraboloid::new(1.0).unwrap().into(), Relief::Bare);
    let grid = Grid::new(1.0, 32).unwrap();
    let mut coarse_check = CoarseCheck::of(&ball, 1.0);
    let mut is_clear = |penetration: f64, force: f64| {
        let mut pressure = vec![0.0; 1024];
        pressure[15 * 32 + 15] = force * 1024.0;
        let solution = solution(penetration, force, pressure);
        coarse_check.is_clear(&ball, 1.0, &grid, &solution)
    };
    // Up to the height at the edge, 0.125, that alone suffices. Beyond it, the gap at the nearest blocks, 0.1416, plus
    // their displacement by a force, Q/(π E* r) or 0.036 here, must be more than 1.1 times the penetration.
    assert!(is_clear(0.125, 0.0) && is_clear(0.128, 0.0) && !is_clear(0.13, 0.0));
    assert!(is_clear(0.157, 0.06) && !is_clear(0.166, 0.06));
}

/// A solution at a penetration with pressure on some elements of a square of 10 × 10.
fn pressed_by_ball(on: &[[usize; 2]], penetration: f64) -> Solution {
    let mut pressure = vec![0.0; 100];
    on.iter().for_each(|[i, j]| pressure[i * 10 + j] = 1e-9);
    solution(penetration, 1e-11, pressure)
}

#[test]
fn pressure_at_the_rim_is_cut_off_if_the_gap_behind_it_is_less_than_the_penetration() {
    let ball = model(Paraboloid::new(1.0).unwrap().into(), Relief::Bare);
    let grid = Grid::new(0.2, 10).unwrap();
    let around = Surroundings::of(&ball, grid);
    // Behind the rim x = ±0.11, beside the middle y = 0.03: f = (x² + y²)/2
    let behind = f64::midpoint(0.11 * 0.11, 0.03 * 0.03);
    for rim in [
        [0, 6],
        [9, 6],
        [6, 0],
        [6, 9],
        [0, 3],
        [9, 3],
        [3, 0],
        [3, 9],
    ] {
        let continues = |depth: f64| around.presses_at_the_rim(&pressed_by_ball(&[rim], depth));
        assert!(
            continues(1.001 * behind) && !continues(0.999 * behind),
            "{rim:?}"
        );
    }
    // The place behind a corner is farther away; an element inside is not on the rim.
    let corner = f64::midpoint(0.11 * 0.11, 0.09 * 0.09);
    for rim in [[0, 0], [0, 9], [9, 0], [9, 9]] {
        let continues = |depth: f64| around.presses_at_the_rim(&pressed_by_ball(&[rim], depth));
        assert!(
            continues(1.001 * corner) && !continues(0.999 * corner),
            "{rim:?}"
        );
    }
    let inner: Vec<[usize; 2]> = (1..9).flat_map(|i| (1..9).map(move |j| [i, j])).collect();
    assert!(!around.presses_at_the_rim(&pressed_by_ball(&inner, 1.0)));
}

/// A ball of radius 0.1 and, at 0.15 along x, one of radius 1 whose tip is higher by 0.01.
#[derive(Debug)]
struct Tips;

impl Profile for Tips {
    fn height(&self, x: f64, y: f64) -> f64 {
        let other = 0.01 + f64::midpoint((x - 0.15) * (x - 0.15), y * y);
        (5.0 * (x * x + y * y)).min(other)
    }
}

#[test]
fn an_overlap_farther_away_cuts_a_contact_off() {
    let tips = model(Indenter::custom(Tips), Relief::Bare);
    let ball = model(Paraboloid::new(1.0).unwrap().into(), Relief::Bare);
    let grid = Grid::new(0.2, 10).unwrap();
    let middle = [[4, 4], [4, 5], [5, 4], [5, 5]];
    let cuts = |model: &Model, depth: f64| {
        let found = Surroundings::of(model, grid).limit_reached(&pressed_by_ball(&middle, depth));
        assert!(found.is_none_or(|found| found == CutOff::Domain));
        found.is_some()
    };
    // The surface hardly moves: the other tip, beyond the domain's edge, touches from a depth of 0.01, give or take the
    // size of the blocks and the overlap that counts.
    assert!(!cuts(&tips, 0.004) && !cuts(&tips, 0.009));
    assert!(cuts(&tips, 0.013) && cuts(&tips, 0.02));
    // A single ball touches only beside the domain's edge, from 0.005.
    assert!(!cuts(&ball, 0.004) && cuts(&ball, 0.02));
    // Without contact, or without a penetration, nothing is cut off.
    let mut around = Surroundings::of(&tips, grid);
    assert!(!around.cut_off(&pressed_by_ball(&[], 0.02)));
    assert!(!around.cut_off(&pressed_by_ball(&middle, f64::NAN)));
    assert!(!around.cut_off(&pressed_by_ball(&middle, f64::INFINITY)));
    assert!(around.cut_off(&pressed_by_ball(&middle, 0.02)));
}

#[test]
fn the_first_square_is_the_last_if_the_indenter_is_higher_around_it() {
    let ball = model(Paraboloid::new(1.0).unwrap().into(), Relief::Bare);
    let frame = SquareFrame::of(&ball, 1.0);
    assert!(frame.is_the_last(&ball, 1.0, 0.12) && !frame.is_the_last(&ball, 1.0, 0.13));
    // Nothing is known of a user-defined shape before its blocks are made.
    let tips = model(Indenter::custom(Tips), Relief::Bare);
    let frame = SquareFrame::of(&tips, 1.0);
    assert!(!frame.is_the_last(&tips, 1.0, -1.0));
}

/// A plane that slopes down towards −x and, twice as steeply, towards −y.
#[derive(Debug)]
struct Slant;

impl Profile for Slant {
    fn height(&self, x: f64, y: f64) -> f64 {
        1.0 + x + 2.0 * y
    }
}

#[test]
fn the_gap_behind_each_side_of_the_rim_is_checked() {
    let slant = model(Indenter::custom(Slant), Relief::Bare);
    let around = Surroundings::of(&slant, Grid::new(0.2, 10).unwrap());
    for (rim, x, y) in [
        ([0, 6], -0.11, 0.03),
        ([9, 6], 0.11, 0.03),
        ([6, 0], 0.03, -0.11),
        ([6, 9], 0.03, 0.11),
    ] {
        let continues = |depth: f64| around.presses_at_the_rim(&pressed_by_ball(&[rim], depth));
        let behind = Slant.height(x, y);
        assert!(
            continues(behind + 1e-3) && !continues(behind - 1e-3),
            "{rim:?}"
        );
    }
    // The lowest of the four elements around the axis, at ±0.01.
    assert!((lowest_height(&slant, &Grid::new(0.2, 10).unwrap()) - 0.97).abs() < 1e-15);
}
