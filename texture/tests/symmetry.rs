//! Sampled reliefs have the symmetries of their lattices, element for element.

#![allow(
    clippy::float_cmp,
    reason = "the fields hold the very numbers of the relief"
)]

use pellicle_texture::{CylinderSpec, Cylinders, Grid, Lattice, Relief, SampledRelief};
use proptest::prelude::*;

fn sample(lattice: Lattice, radius: f64, offset: [f64; 2], grid: &Grid) -> SampledRelief {
    let spec = CylinderSpec {
        lattice,
        radius,
        height: 0.5,
        period: 1.0,
        offset,
        young_modulus: 2.0,
    };
    Relief::Cylinders(Cylinders::new(spec).expect("a valid relief")).sample(grid)
}

/// The mask with every element `(i, j)` taken from `source(i, j)`.
fn moved(mask: &[bool], size: usize, source: impl Fn(usize, usize) -> (usize, usize)) -> Vec<bool> {
    let from = |n: usize| {
        let (i, j) = source(n / size, n % size);
        mask[i * size + j]
    };
    (0..mask.len()).map(from).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn a_square_lattice_has_the_symmetries_of_the_square(radius in 0.05..0.5, side in 0.5..9.0, size in 1_usize..60) {
        let grid = Grid::new(side, size).unwrap();
        let sampled = sample(Lattice::Square, radius, [0.0, 0.0], &grid);
        let last = size - 1;
        // Two reflections generate all eight.
        prop_assert_eq!(sampled.mask(), moved(sampled.mask(), size, |i, j| (last - i, j)));
        prop_assert_eq!(sampled.mask(), moved(sampled.mask(), size, |i, j| (j, i)));
    }

    #[test]
    fn a_hexagonal_lattice_is_mirrored_in_both_axes(radius in 0.05..0.49, side in 0.5..9.0, size in 1_usize..60) {
        let grid = Grid::new(side, size).unwrap();
        let sampled = sample(Lattice::Hexagonal, radius, [0.0, 0.0], &grid);
        let last = size - 1;
        prop_assert_eq!(sampled.mask(), moved(sampled.mask(), size, |i, j| (last - i, j)));
        prop_assert_eq!(sampled.mask(), moved(sampled.mask(), size, |i, j| (i, last - j)));
    }

    #[test]
    fn a_hexagonal_lattice_turns_into_itself_by_sixty_degrees(x in -5.0..5.0_f64, y in -5.0..5.0_f64) {
        let (sine, cosine) = (std::f64::consts::PI / 3.0).sin_cos();
        let distance = |point| Lattice::Hexagonal.distance_to_centre(1.0, point);
        let turned = distance([cosine * x - sine * y, sine * x + cosine * y]);
        // A few roundings of coordinates up to 7, each 1e-15.
        prop_assert!((turned - distance([x, y])).abs() < 1e-14);
    }

    #[test]
    fn moving_the_offset_by_whole_elements_moves_the_mask(di in 0_usize..8, dj in 0_usize..8, radius in 0.05..0.45) {
        // Steps of 1/8 are exact in binary, so rounding decides nothing.
        let grid = Grid::new(4.0, 32).unwrap();
        let still = sample(Lattice::Square, radius, [0.0, 0.0], &grid);
        let shifted = sample(Lattice::Square, radius, [di as f64 / 8.0, dj as f64 / 8.0], &grid);
        // One period is eight elements: the square lattice repeats, so indices wrap.
        prop_assert_eq!(shifted.mask(), moved(still.mask(), 32, |i, j| ((i + 32 - di) % 32, (j + 32 - dj) % 32)));
    }
}

#[test]
fn tops_are_level_and_soft_and_valleys_are_deep_and_rigid() {
    let sampled = sample(
        Lattice::Hexagonal,
        0.3,
        [0.1, 0.2],
        &Grid::new(3.0, 40).unwrap(),
    );
    let fields = sampled
        .mask()
        .iter()
        .zip(sampled.profile())
        .zip(sampled.compliance());
    for ((&on, &profile), &compliance) in fields {
        assert_eq!(
            (profile, compliance),
            if on { (0.0, 0.25) } else { (-0.5, 0.0) }
        );
    }
}
