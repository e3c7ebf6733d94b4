//! The sampled area fraction converges to the closed form at the known rate for lattice points in discs.

use pellicle_texture::{CylinderSpec, Cylinders, Grid, Lattice, Relief};

fn cylinders(lattice: Lattice, offset: [f64; 2]) -> Cylinders {
    let (radius, period) = (0.4, 1.0);
    Cylinders::new(CylinderSpec {
        lattice,
        radius,
        height: 0.01,
        period,
        offset,
        young_modulus: 1.0,
    })
    .expect("a valid relief")
}

/// Fraction of the points of an n × n sampling of the lattice's rectangular cell that lie on a cylinder.
fn fraction_in_cell(cylinders: &Cylinders, n: u32) -> f64 {
    let cell = cylinders.lattice().cell(cylinders.period());
    let at = |axis: usize, i: u32| (f64::from(i) + 0.5) * cell[axis] / f64::from(n);
    let hits = (0..n * n)
        .filter(|k| cylinders.contains([at(0, k / n), at(1, k % n)]))
        .count();
    hits as f64 / f64::from(n * n)
}

/// Root mean square error of the sampled fraction over 20 offsets and four neighbouring resolutions from n upwards.
fn error(lattice: Lattice, n: u32) -> f64 {
    let samples = (0..80).map(|k| (n + k % 4, f64::from(k / 4)));
    let squares = samples.map(|(n, k)| {
        let cylinders = cylinders(lattice, [0.618_034 * k, 0.754_878 * k]);
        (fraction_in_cell(&cylinders, n) - cylinders.area_fraction()).powi(2)
    });
    (squares.sum::<f64>() / 80.0).sqrt()
}

#[test]
fn the_sampled_fraction_converges_to_the_closed_form_with_order_three_halves() {
    for lattice in [Lattice::Square, Lattice::Hexagonal] {
        let (coarse, fine) = (error(lattice, 16), error(lattice, 128));
        let order = (coarse / fine).log2() / 3.0;
        // The number of points of a grid in a disc of r/h elements at a random place scatters by about (r/h)^½ (D. G.
        // Kendall, Quart. J. Math. 19, 1948), so the fraction errs by h^(3/2); 80 samples leave the order uncertain by
        // about 0.1.
        assert!(
            (1.3..1.7).contains(&order),
            "{lattice:?}: order {order}, {coarse:e} then {fine:e}"
        );
        assert!(fine < 5e-4, "{lattice:?}: {fine:e}");
    }
}

#[test]
fn a_grid_of_whole_periods_samples_the_closed_form() {
    let relief = Relief::Cylinders(cylinders(Lattice::Square, [0.0, 0.0]));
    let sampled = relief.sample(&Grid::new(4.0, 400).unwrap());
    // 100 elements per period, offset at a centre: the discrepancy is below one element per period and side, 1e-3 of
    // the area.
    assert!((sampled.mask_fraction() - relief.area_fraction()).abs() < 1e-3);
}
