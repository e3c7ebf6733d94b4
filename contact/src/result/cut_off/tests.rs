//! The blocks around a domain: their places, the pressures in them, and how far they move the surface.

use pellicle_influence::{Cache, RadialTables};
use pellicle_kernel::{Foundation, Material};

use super::*;
use crate::{Certificate, Paraboloid};

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
fn pressures_are_summed_up_in_the_blocks_that_their_elements_lie_in() {
    let (grid, around) = (Grid::new(1.0, 10).unwrap(), Around::new(1.0, 4));
    let even = around.summed(&grid, &[3.0; 100]);
    assert!(even.len() == 16 && even.iter().all(|p| (p - 3.0).abs() < 1e-13));
    // From 0.2 to 0.3, of which 0.25 is the end of a block; and from −0.3 to −0.2.
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
fn a_surface_farther_away_moves_as_under_the_force_alone() {
    let body = Foundation::half_space(Material::new(1.0, 0.0).unwrap());
    let model = Model {
        tables: Arc::new(RadialTables::build(&body).unwrap()),
        relief: Relief::Bare,
        indenter: Paraboloid::new(1.0).unwrap().into(),
        cache: Cache::none(),
    };
    let outlook = Outlook::of(&model, 1.0);
    // f = ρ²/2R, least in the middle of an edge
    assert!((outlook.lowest - 0.125).abs() < 1e-15);
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
    let solution = Solution {
        penetration: 0.15,
        force: 0.03,
        pressure,
        certificate: Certificate {
            complementarity: 0.0,
            gap_in_contact: 0.0,
            overlap: 0.0,
            load: 0.0,
            gap_at_limit: 0.0,
            over_limit: 0.0,
            min_pressure: 0.0,
            tolerance: 1e-8,
        },
    };
    // u = Q/(π E* r), which the blocks hold to a hundredth; the gap is least at the nearest block.
    let moved = blocks.smallest_gap + 0.03 / (std::f64::consts::PI * nearest);
    let is_closer = |limit: f64| blocks.is_closer_than(limit, &model, &grid, &solution);
    assert!(!is_closer(moved - 3e-4) && is_closer(moved + 3e-4));
    assert!(!is_closer(blocks.smallest_gap));
}
