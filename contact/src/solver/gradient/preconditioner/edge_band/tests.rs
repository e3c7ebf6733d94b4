//! The band of a set on every kind of grid: where it lies, and that the filtered residual vanishes on it.

use pellicle_influence::{ElasticOperator, Sector, SectorGrid};

use super::{ACCURACY, EdgeBand, Stencil};
use crate::{
    Boundary, DiscreteProblem,
    grid::region::Region,
    problem::support::choice::given,
    solver::gradient::{load_control::LoadControl, tests::begun, working_set::WorkingSet},
};

const SIZE: usize = 41;

/// A rigid body.
struct Rigid;

impl ElasticOperator for Rigid {
    fn size(&self) -> usize {
        SIZE
    }

    fn apply_into(&mut self, _: &[f64], displacement: &mut [f64]) {
        displacement.fill(0.0);
    }
}

fn inside([i, j]: [usize; 2]) -> bool {
    let [x, y] = [i, j].map(|along| along as f64);
    let island = |at: [f64; 2], radius: f64| (x - at[0]).hypot(y - at[1]) < radius;
    island([0.0, 7.0], 5.2) || island([17.0, 2.0], 3.4) || island([24.0, 25.0], 10.3)
}

/// The set of the inner elements, shifted by some columns.
fn set(grid: SectorGrid, moved: usize) -> WorkingSet {
    let presses = |e: usize| f64::from(u8::from(inside([e / SIZE, e % SIZE + moved])));
    let pressure: Vec<f64> = (0..grid.elements()).map(presses).collect();
    let field = |value: f64| vec![value; grid.elements()];
    let support = given(Box::new(Rigid), Region::all_of(grid));
    let problem = DiscreteProblem::on(support, field(0.0), field(1.0), 1.0);
    begun(
        &mut problem.unwrap(),
        LoadControl::Penetration(0.0),
        &pressure,
    )
    .1
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

#[test]
fn the_filtered_residual_vanishes_on_the_band() {
    let coefficients: Stencil = std::array::from_fn(|i| {
        std::array::from_fn(|j| match i * i + j * j {
            0 => 2.5,
            square => -0.25 / (square as f64).powf(1.5),
        })
    });
    let waves = |e: usize| 1.0 + 0.5 * (0.2 * (e / SIZE) as f64 + 0.3 * (e % SIZE) as f64).sin();
    for sector in [Sector::Whole, Sector::Half, Sector::Quadrant] {
        let grid = SectorGrid::new(sector, SIZE);
        let elements = grid.elements();
        let filtered: Vec<f64> = (0..elements).map(waves).collect();
        let mut band = EdgeBand::new(&Region::all_of(grid));
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
        let mirrored = |k: i64| usize::try_from(if k < 0 { -1 - k } else { k }).unwrap();
        // All of the band, and the elements next to an axis.
        let (mut missed, mut whole) = ([0.0; 2], [0.0; 2]);
        for e in 0..elements {
            let place = [e / SIZE, e % SIZE];
            if !is_of_band(place, grid) {
                assert!(written[e] == 0.0, "{place:?}");
                continue;
            }
            let [i, j] = place.map(|k| i64::try_from(k).unwrap());
            let mut sum = filtered[e];
            for (m, n) in (-3..=3_i64).flat_map(|m| (-3..=3_i64).map(move |n| (m, n))) {
                let [m_abs, n_abs] = [m, n].map(|k| usize::try_from(k.abs()).unwrap());
                sum +=
                    coefficients[m_abs][n_abs] * written[mirrored(i + m) * SIZE + mirrored(j + n)];
            }
            for part in 0..=usize::from(place.contains(&0)) {
                missed[part] += sum * sum;
                whole[part] += filtered[e] * filtered[e];
            }
        }
        assert!(whole[0] > 100.0 && missed[0] > 0.0, "{sector:?}: a band");
        // The margin is for rounding.
        assert!(
            missed[0] < (1.0 + 1e-9) * ACCURACY.powi(2) * whole[0],
            "{sector:?}: {missed:?}"
        );
        assert!(
            missed[1] <= 0.04 * whole[1],
            "{sector:?}: {missed:?} of {whole:?}"
        );
    }
}

/// A cell of grooves is solved on few elements along them.
#[test]
fn a_grid_too_narrow_for_the_stencil_has_no_band() {
    // As many elements as those of a square, from which the set is taken.
    const SIDE: usize = 6;
    let field = |value: f64| vec![value; SIDE * SIDE];
    let support = given(Box::new(Rigid), Region::whole(SIDE));
    let problem = DiscreteProblem::on(support, field(0.0), field(1.0), 1.0);
    let presses = |e: usize| f64::from(u8::from(e % 20 < 7));
    let pressure: Vec<f64> = (0..SIDE * SIDE).map(presses).collect();
    let control = LoadControl::Penetration(0.0);
    let (_, set) = begun(&mut problem.unwrap(), control, &pressure);
    for lengths in [[18, 2], [2, 18], [36, 1], [1, 36]] {
        let cell = Region::bounded(SectorGrid::oblong(lengths), Boundary::Periodic);
        let mut band = EdgeBand::new(&cell);
        band.surround(&set);
        assert!(set.len() > 0 && band.is_empty(), "{lengths:?}");
    }
}
