//! Self-affine rough surfaces, sums of waves with random phases.
//!
//! A periodic surface of side `L` is a sum over the waves that fit in it, `q = 2π (m, n)/L`, whose amplitudes fall as a
//! power of the wavenumber between a longest and a shortest wave:
//!
//! ```text
//! h(x, y) = Σ a cos(q·(x, y) + φ),    a ~ |q|^−(1 + H),    φ uniform
//! ```
//!
//! so that its power spectrum falls as `|q|^−2(1 + H)`, `H` being the Hurst exponent (Persson et al. 2005). `q` and
//! `−q` are one wave with independent phases, so its amplitude is that power times the cosine of a random angle: the
//! root mean square of the samples is exact, that of the slopes scatters by some hundredths from seed to seed.

use pellicle_fourier::{Complex, Transformed};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

/// A self-affine surface to be made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SelfAffine {
    /// Samples along each side, at least 2.
    pub size: usize,
    /// Number of periods per side of the longest and of the shortest wave: the first at most the second, the second at
    /// most half of the samples.
    pub waves: [f64; 2],
    /// Hurst exponent `H`.
    pub hurst: f64,
    /// Root mean square of the heights, in their own unit.
    pub rms: f64,
    /// Seed of the phases: the same seed gives the same surface.
    pub seed: u64,
}

impl SelfAffine {
    /// The heights about their mean, in the unit of `rms`: `size`² samples, index `i · size + j`, first index along x.
    /// None if no whole number of waves lies in the band.
    #[must_use]
    pub fn heights(&self) -> Option<Vec<f64>> {
        let size = self.size;
        let mut field = self.spectrum();
        transform_lines(&mut field, size);
        let mut field = transposed(&field, size);
        transform_lines(&mut field, size);
        let mut heights: Vec<f64> = transposed(&field, size).iter().map(|z| z.re).collect();
        let squares: f64 = heights.iter().map(|h| h * h).sum();
        let factor = self.rms / (squares / heights.len() as f64).sqrt();
        heights.iter_mut().for_each(|h| *h *= factor);
        factor.is_finite().then_some(heights)
    }

    /// Returns the complex amplitude of each wave. `q` and `−q` have independent phases; the real part of their sum is
    /// one wave.
    fn spectrum(&self) -> Vec<Complex<f64>> {
        let size = self.size;
        // The frequency of an index, from −size/2 to size/2.
        let frequency = |index: usize| {
            let beyond = if 2 * index > size { size } else { 0 };
            index as f64 - beyond as f64
        };
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        let waves = (0..size).flat_map(|i| (0..size).map(move |j| [i, j]));
        waves
            .map(|wave| {
                let phase = std::f64::consts::TAU * random.random::<f64>();
                let [m, n] = wave.map(frequency);
                let q = m.hypot(n);
                let [longest, shortest] = self.waves;
                if q >= longest && q <= shortest {
                    Complex::from_polar(q.powf(-1.0 - self.hurst), phase)
                } else {
                    Complex::default()
                }
            })
            .collect()
    }
}

fn transform_lines(field: &mut [Complex<f64>], size: usize) {
    let transform = f64::inverse(size);
    let lines = field.par_chunks_mut(size);
    lines.for_each(|line| transform.process(line));
}

fn transposed(field: &[Complex<f64>], size: usize) -> Vec<Complex<f64>> {
    let elements = (0..size * size).into_par_iter();
    elements
        .map(|e| field[e % size * size + e / size])
        .collect()
}

#[cfg(test)]
mod tests {
    use pellicle_texture::{HeightMap, MapRim, Roughness};

    use super::*;

    const SURFACE: SelfAffine = SelfAffine {
        size: 64,
        waves: [4.0, 20.0],
        hurst: 0.7,
        rms: 2.5,
        seed: 3,
    };

    /// The amplitude of a wave in the heights, by direct summation.
    fn amplitude(heights: &[f64], size: usize, [m, n]: [usize; 2]) -> f64 {
        let terms = heights.iter().enumerate().map(|(e, h)| {
            let turns = (m * (e / size) + n * (e % size)) as f64 / size as f64;
            Complex::from_polar(*h, -std::f64::consts::TAU * turns)
        });
        terms.sum::<Complex<f64>>().norm()
    }

    #[test]
    fn the_mean_is_zero_and_the_rms_height_as_requested() {
        let heights = SURFACE.heights().unwrap();
        let mean = heights.iter().sum::<f64>() / 4096.0;
        let square = heights.iter().map(|h| h * h).sum::<f64>() / 4096.0;
        assert!(mean.abs() < 1e-13);
        approx::assert_relative_eq!(square.sqrt(), 2.5, max_relative = 1e-13);
    }

    #[test]
    fn the_spectrum_is_zero_outside_the_band() {
        let heights = SURFACE.heights().unwrap();
        let amplitude = |m, n| amplitude(&heights, 64, [m, n]);
        let inside = amplitude(10, 3);
        for [m, n] in [[0, 0], [0, 3], [2, 3], [20, 1], [15, 15], [32, 32]] {
            assert!(amplitude(m, n) < 1e-12 * inside, "{m} {n}");
        }
        assert!(amplitude(0, 4) > inside && amplitude(20, 0) > 1e-2 * inside);
    }

    /// Each wave is the sum of two of random phases: `E |z + z̄'|² = 2 a²`.
    #[test]
    fn the_spectrum_decays_with_the_power_set_by_the_hurst_exponent() {
        let at = |q: usize| {
            let surfaces = (0..200).map(|seed| SelfAffine { seed, ..SURFACE });
            let squares = surfaces.map(|surface| {
                let heights = surface.heights().unwrap();
                amplitude(&heights, 64, [q, 0]).powi(2)
            });
            squares.sum::<f64>() / 200.0
        };
        let exponent = (at(16) / at(5)).ln() / (16.0_f64 / 5.0).ln();
        // The mean of 200 squares is known to a tenth.
        assert!((exponent + 3.4).abs() < 0.25, "{exponent}");
    }

    /// The spectrum in a summary follows `C ~ q^−2(1 + H)` between the ends of the band.
    #[test]
    fn the_spectrum_of_the_map_has_the_slope_of_the_hurst_exponent() {
        for (seed, hurst) in [(1, 0.8), (2, 0.3), (3, 1.0)] {
            let size = 512;
            let surface = SelfAffine {
                size,
                waves: [4.0, 200.0],
                hurst,
                rms: 1.0,
                seed,
            };
            let map = HeightMap::new(surface.heights().unwrap(), [size; 2], [1.0, 1.0]).unwrap();
            let spectrum = Roughness::of(&map, MapRim::Repeats).spectrum;
            let (powers, waves) = (&spectrum.power, &spectrum.waves);
            let bands = spectrum.wavenumber.iter().zip(powers);
            let ends = [8.0, 180.0].map(|waves| std::f64::consts::TAU * waves);
            let inside = bands.clone().zip(waves);
            let inside = inside.filter(|((q, _), _)| (ends[0]..ends[1]).contains(*q));
            // Least squares of ln C over ln q; the weight of a band is its number of waves.
            let mut sums = [0.0; 5];
            for ((q, power), waves) in inside {
                let (x, y, weight) = (q.ln(), power.ln(), *waves as f64);
                for (sum, term) in sums.iter_mut().zip([1.0, x, y, x * x, x * y]) {
                    *sum += weight * term;
                }
            }
            let [n, x, y, xx, xy] = sums;
            let exponent = (n * xy - x * y) / (n * xx - x * x);
            // |z + z̄'|² scatters by its own size, over some 60,000 pairs of waves spread over ln q by 0.5: 0.01.
            assert!(
                (exponent + 2.0 * (1.0 + hurst)).abs() < 0.04,
                "{hurst}: {exponent}"
            );
            let mut beyond = bands.filter(|(q, _)| **q > 1.1 * ends[1] * 200.0 / 180.0);
            let largest = powers.iter().copied().fold(0.0, f64::max);
            assert!(
                beyond.clone().count() > 3 && beyond.all(|(_, power)| *power < 1e-24 * largest)
            );
        }
    }

    #[test]
    fn the_same_seed_gives_the_same_surface() {
        let other = SelfAffine { seed: 4, ..SURFACE };
        assert_eq!(SURFACE.heights(), SURFACE.heights());
        assert_ne!(SURFACE.heights(), other.heights());
    }

    #[test]
    fn a_band_without_a_wave_gives_no_surface() {
        let empty = SelfAffine {
            waves: [4.1, 4.11],
            ..SURFACE
        };
        assert_eq!(empty.heights(), None);
    }
}
