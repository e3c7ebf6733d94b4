//! Roughness of waves and of self-affine surfaces with known values.

use std::f64::consts::TAU;

use approx::assert_relative_eq;

use super::*;

/// `C` times the number of waves, for each band.
fn power_of_waves(PowerSpectrum { power, waves, .. }: &PowerSpectrum) -> Vec<f64> {
    let bands = power.iter().zip(waves);
    bands.map(|(power, waves)| power * *waves as f64).collect()
}

fn map(shape: [usize; 2], extent: [f64; 2], height: impl Fn([f64; 2]) -> f64) -> HeightMap {
    let [rows, columns] = shape;
    let at = |i: usize, n: usize, side: f64| (i as f64 + 0.5) * side / n as f64;
    let heights = (0..rows * columns).map(|k| {
        let (i, j) = (k / columns, k % columns);
        height([at(i, rows, extent[0]), at(j, columns, extent[1])])
    });
    HeightMap::new(heights.collect(), shape, extent).unwrap()
}

/// Pseudo-random numbers from 0 to 1.
fn noise(shape: [usize; 2], extent: [f64; 2]) -> HeightMap {
    let mut state = 12_345_u64;
    let heights = (0..shape[0] * shape[1]).map(|_| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    });
    HeightMap::new(heights.collect(), shape, extent).unwrap()
}

#[test]
fn a_wave_has_its_height_slope_and_curvature_and_one_band() {
    let (a, extent) = (0.3, [2.0, 3.0]);
    // Two waves along x and three along y, on an odd number of samples along one side.
    let q = [TAU * 2.0 / extent[0], TAU * 3.0 / extent[1]];
    let square = q[0] * q[0] + q[1] * q[1];
    let wave = map([40, 51], extent, |[x, y]| {
        7.0 + a * (q[0] * x + q[1] * y).cos()
    });
    let rough = Roughness::of(&wave, MapRim::Repeats);
    let rms = a / 2.0_f64.sqrt();
    assert_relative_eq!(rough.rms_height, rms, max_relative = 1e-12);
    assert_relative_eq!(rough.rms_slope, rms * square.sqrt(), max_relative = 1e-12);
    assert_relative_eq!(
        rough.rms_curvature,
        rms * square / 2.0,
        max_relative = 1e-12
    );
    // C = L_x L_y (a/2)² for q and −q, zero for the others.
    let bands = power_of_waves(&rough.spectrum);
    let largest = bands.iter().copied().fold(0.0, f64::max);
    assert_relative_eq!(largest, 6.0 * a * a / 2.0, max_relative = 1e-12);
    let all: f64 = bands.iter().sum();
    assert_relative_eq!(all, largest, max_relative = 1e-12);
}

/// Parseval's theorem, every wave counted once: the sum of `C/(L_x L_y)` is `⟨h²⟩`.
#[test]
fn the_power_of_all_bands_is_the_mean_square_height() {
    for shape in [
        [32, 32],
        [31, 32],
        [32, 31],
        [7, 90],
        [1, 5],
        [5, 1],
        [2, 2],
        [1, 2],
    ] {
        let extent = [0.7, 1.9];
        let rough = Roughness::of(&noise(shape, extent), MapRim::Repeats);
        let spectrum = &rough.spectrum;
        let power: f64 = power_of_waves(spectrum).iter().sum();
        let square = rough.rms_height.powi(2);
        assert_relative_eq!(power / (0.7 * 1.9), square, max_relative = 1e-12);
        let waves: usize = spectrum.waves.iter().sum();
        assert_eq!(waves, shape[0] * shape[1] - 1, "{shape:?}");
        assert!(spectrum.wavenumber.is_sorted_by(|one, other| one < other));
    }
}

/// White noise has `C = ⟨h²⟩ w_x w_y` at all wavenumbers, under Hann's window too.
#[test]
fn noise_has_a_flat_spectrum_on_periodic_and_finite_maps() {
    let shape = [256, 256];
    for rim in [MapRim::Repeats, MapRim::Ends] {
        let rough = Roughness::of(&noise(shape, [1.0, 1.0]), rim);
        let level = rough.rms_height.powi(2) / 65536.0;
        // The relative scatter of a mean over n waves is 1/√n; under the window neighbouring waves are correlated.
        let bands = rough.spectrum.power.iter().zip(&rough.spectrum.waves);
        let many = bands.filter(|(_, waves)| **waves >= 1000);
        assert!(many.clone().count() >= 10);
        for (power, waves) in many {
            let scatter = 6.0 / (*waves as f64).sqrt();
            assert!(
                (power / level - 1.0).abs() < scatter,
                "{rim:?} {power} {waves}"
            );
        }
    }
}

#[test]
fn a_tilt_counts_in_height_and_slope_but_is_no_wave() {
    let plane = |[x, y]: [f64; 2]| 1e3 + 0.2 * x - 0.3 * y;
    let [x, y] = [2.0_f64, 1.0];
    for shape in [[20, 30], [9, 9], [2, 2]] {
        let rough = Roughness::of(&map(shape, [x, y], plane), MapRim::Ends);
        let [rows, columns] = shape.map(|n| n as f64);
        // Of n equal steps with a rise r in all: r²/12 (1 − 1/n²).
        let square = |rise: f64, n: f64| rise * rise / 12.0 * (1.0 - 1.0 / (n * n));
        let height = (square(0.2 * x, rows) + square(0.3 * y, columns)).sqrt();
        // Rounding error of heights of 1000.
        assert_relative_eq!(rough.rms_height, height, max_relative = 1e-10);
        assert_relative_eq!(rough.rms_slope, 0.13_f64.sqrt(), max_relative = 1e-10);
        assert!(power_of_waves(&rough.spectrum).iter().sum::<f64>() < 1e-20);
    }
}

/// Differences give `2/w sin(qw/2)` in place of `q`, its square
/// in place of `q²`, and the sums over the squares of sines and cosines lack the terms at the rim.
#[test]
fn slope_and_curvature_of_a_wave_are_those_of_its_differences() {
    let (n, waves) = (64, 5.0);
    let q = TAU * waves;
    let wave = map([n, 20], [1.0, 1.0], |[x, _]| (q * (x - 0.5)).cos());
    let rough = Roughness::of(&wave, MapRim::Ends);
    let (n, half) = (n as f64, 0.5 * q / n as f64);
    let by_differences = 2.0 * n * half.sin();
    let slope = by_differences * (0.5 * n / (n - 1.0)).sqrt();
    let rim = 2.0 * half.cos().powi(2);
    let curvature = 0.5 * by_differences * by_differences * ((0.5 * n - rim) / (n - 2.0)).sqrt();
    assert_relative_eq!(rough.rms_slope, slope, max_relative = 1e-10);
    assert_relative_eq!(rough.rms_curvature, curvature, max_relative = 1e-10);
}

#[test]
fn the_same_bits_whatever_the_number_of_threads() {
    let rough = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let noise = noise([120, 75], [1.0, 1.0]);
        (pool.build().unwrap()).install(|| Roughness::of(&noise, MapRim::Ends))
    };
    assert_eq!(rough(1), rough(5));
}
