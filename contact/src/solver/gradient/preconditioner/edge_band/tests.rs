//! The band of a set on every kind of grid: where it lies, and that the filtered residual vanishes on it.

use pellicle_influence::{Sector, SectorGrid};

use super::{ACCURACY, EdgeBand, Stencil};

const SIZE: usize = 41;

fn inside([i, j]: [usize; 2]) -> bool {
    let [x, y] = [i, j].map(|along| along as f64);
    let island = |at: [f64; 2], radius: f64| (x - at[0]).hypot(y - at[1]) < radius;
    island([0.0, 7.0], 5.2) || island([17.0, 2.0], 3.4) || island([24.0, 25.0], 10.3)
}

/// The inner elements, shifted by some columns.
fn set(grid: SectorGrid, moved: usize) -> Vec<bool> {
    let elements = 0..grid.elements();
    elements
        .map(|e| inside([e / SIZE, e % SIZE + moved]))
        .collect()
}

/// Whether an element lies outside the set, at most three elements from it and at least three from the border; the
/// axes of a sector are not a border.
fn is_of_band([i, j]: [usize; 2], grid: SectorGrid) -> bool {
    let around = |k: usize| k.saturating_sub(3)..=k + 3;
    let near = around(i).any(|i| around(j).any(|j| inside([i, j])));
    let lies_within = |axis: usize, k: usize| {
        let first = if grid.mirrored()[axis] { 0 } else { 3 };
        (first..grid.lengths()[axis] - 3).contains(&k)
    };
    near && !inside([i, j]) && lies_within(0, i) && lies_within(1, j)
}

fn coefficients() -> Stencil {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| match i * i + j * j {
            0 => 2.5,
            square => -0.25 / (square as f64).powf(1.5),
        })
    })
}

/// The sum of a field on a sector times the coefficients around an element.
fn sum_around(field: &[f64], [i, j]: [usize; 2], coefficients: &Stencil) -> f64 {
    let mirrored = |k: i64| usize::try_from(if k < 0 { -1 - k } else { k }).unwrap();
    let [i, j] = [i, j].map(|k| i64::try_from(k).unwrap());
    let offsets = (-3..=3_i64).flat_map(|m| (-3..=3_i64).map(move |n| (m, n)));
    let terms = offsets.map(|(m, n)| {
        let [m_abs, n_abs] = [m, n].map(|k| usize::try_from(k.abs()).unwrap());
        coefficients[m_abs][n_abs] * field[mirrored(i + m) * SIZE + mirrored(j + n)]
    });
    terms.sum()
}

#[test]
fn the_filtered_residual_vanishes_on_the_band() {
    let coefficients = coefficients();
    let waves = |e: usize| 1.0 + 0.5 * (0.2 * (e / SIZE) as f64 + 0.3 * (e % SIZE) as f64).sin();
    for sector in [Sector::Whole, Sector::Half, Sector::Quadrant] {
        let grid = SectorGrid::new(sector, SIZE);
        let elements = grid.elements();
        let filtered: Vec<f64> = (0..elements).map(waves).collect();
        let mut band = EdgeBand::new(grid);
        band.take_coefficients(&coefficients);
        band.surround(&set(grid, 0));
        let mut written = vec![0.0; elements];
        band.balance(&filtered, &mut written);
        // No values of the earlier set remain.
        let mut again = vec![0.0; elements];
        band.surround(&set(grid, 4));
        band.balance(&filtered, &mut vec![0.0; elements]);
        band.surround(&set(grid, 0));
        band.balance(&filtered, &mut again);
        assert!(written == again, "{sector:?}");
        // All of the band, and the elements next to an axis.
        let (mut missed, mut whole) = ([0.0; 2], [0.0; 2]);
        for e in 0..elements {
            let place = [e / SIZE, e % SIZE];
            if !is_of_band(place, grid) {
                assert!(written[e] == 0.0, "{place:?}");
                continue;
            }
            let sum = filtered[e] + sum_around(&written, place, &coefficients);
            for part in 0..=usize::from(place.contains(&0)) {
                missed[part] += sum * sum;
                whole[part] += filtered[e] * filtered[e];
            }
        }
        assert!(whole[0] > 100.0 && missed[0] > 0.0, "{sector:?}: a band");
        // The margin is for single precision.
        assert!(
            missed[0] < (1.0 + 1e-3) * f64::from(ACCURACY).powi(2) * whole[0],
            "{sector:?}: {missed:?}"
        );
        assert!(
            missed[1] <= 0.04 * whole[1],
            "{sector:?}: {missed:?} of {whole:?}"
        );
    }
}

/// The answer to what makes the result vanish on the band, at most three elements from it.
#[test]
fn what_balances_the_band_is_answered_on_the_set_around_it() {
    let coefficients = coefficients();
    for sector in [Sector::Whole, Sector::Half, Sector::Quadrant] {
        let grid = SectorGrid::new(sector, SIZE);
        let elements = grid.elements();
        let filtered: Vec<f64> = (0..elements).map(|e| 1.0 + (e as f64).sin()).collect();
        let mut band = EdgeBand::new(grid);
        band.take_coefficients(&coefficients);
        band.surround(&set(grid, 0));
        let (mut s, mut settled) = (vec![0.0; elements], filtered.clone());
        band.balance(&filtered, &mut s);
        band.settle(&mut settled);
        let mut answered = 0;
        for e in 0..elements {
            let place = [e / SIZE, e % SIZE];
            let lies_within = |axis: usize| {
                let first = if grid.mirrored()[axis] { 0 } else { 3 };
                (first..grid.lengths()[axis] - 3).contains(&place[axis])
            };
            let is_answered = inside(place) && lies_within(0) && lies_within(1);
            let answer = if is_answered {
                sum_around(&s, place, &coefficients)
            } else {
                0.0
            };
            answered += usize::from(answer != 0.0);
            // single precision of sums of order 1
            assert!(
                (settled[e] - filtered[e] - answer).abs() < 1e-5,
                "{sector:?} {place:?}"
            );
        }
        assert!(answered > 100, "{sector:?}: {answered}");
    }
}

/// A cell of grooves is solved on few elements along them.
#[test]
fn a_grid_too_narrow_for_the_stencil_has_no_band() {
    for lengths in [[18, 2], [2, 18], [36, 1], [1, 36]] {
        let mut band = EdgeBand::new(SectorGrid::oblong(lengths));
        let set: Vec<bool> = (0..36).map(|e| e % 20 < 7).collect();
        band.surround(&set);
        assert!(band.is_empty(), "{lengths:?}");
    }
}
