//! The spectrum of the mean square slope along lines of a surface, and the shortest wave in it.
//!
//! Every line of samples, less its mean and trend, is tapered (Hann) and transformed. The squared amplitude times the
//! squared wavenumber is the mean square slope of a wave. Lines in both directions are taken together, so a direction
//! without slope does not count. A parabola has no wave shorter than a third of its line, however finely it is sampled.

use std::sync::Arc;

use pellicle_fourier::{Complex, RealToComplex, Transformed};

use crate::HeightMap;

/// Share of the mean square slope in waves longer than the shortest one. A self-affine surface reaches it within 3 %
/// of its cutoff wavelength for a Hurst exponent of 0.3, and within 17 % for 0.8. With a larger share the ridges of a
/// pyramid, whose spectrum has a long tail, count as short waves: over 64 elements its shortest wave has six elements
/// by this share, and two by 99 %.
const SHARE: f64 = 0.97;

/// The smallest number of samples of a line with a useful spectrum.
const MIN_SAMPLES: usize = 16;

/// Slopes below this part of the largest height over the distance between samples are rounding: a tilted plane has no
/// waves.
const ROUNDING: f64 = 1e-13;

/// The mean square slope of a surface by the length of its waves.
#[derive(Clone, Debug, Default)]
pub struct SlopeSpectrum {
    /// Pairs of a wavelength, in m, and the mean square slope in waves of this length, up to a common factor.
    waves: Vec<[f64; 2]>,
    /// Largest slope that rounding may cause.
    rounding: f64,
}

impl SlopeSpectrum {
    /// The spectrum of the samples of a map.
    ///
    /// ```
    /// use pellicle_texture::{HeightMap, SlopeSpectrum};
    ///
    /// // A wave of 16 samples, 64 samples on a side of 1 m.
    /// let wave = |k: u32| 0.1 * (std::f64::consts::TAU * f64::from(k / 64) / 16.0).cos();
    /// let map = HeightMap::new((0..64 * 64).map(wave).collect(), [64, 64], [1.0, 1.0])?;
    /// assert_eq!(SlopeSpectrum::of(&map).shortest_wave(), Some(0.25));
    /// # Ok::<(), pellicle_texture::TextureError>(())
    /// ```
    #[must_use]
    pub fn of(map: &HeightMap) -> Self {
        let ([rows, columns], pixel, heights) = (map.shape(), map.pixel(), map.heights());
        let mut spectrum = Self::default();
        let along_y = heights.chunks_exact(columns).map(<[f64]>::to_vec);
        spectrum.add(pixel[1], along_y);
        let column = |j: usize| (0..rows).map(|i| heights[i * columns + j]).collect();
        spectrum.add(pixel[0], (0..columns).map(column));
        spectrum
    }

    /// Adds the mean over equally long lines along one direction, of samples this far apart (m). Lines of fewer than 16
    /// samples are ignored.
    pub fn add(&mut self, spacing: f64, lines: impl Iterator<Item = Vec<f64>>) {
        let mut plan: Option<Arc<dyn RealToComplex<f64>>> = None;
        let (mut slopes, mut samples, mut count): (Vec<f64>, _, _) = (Vec::new(), 0, 0.0);
        for mut line in lines.filter(|line| line.len() >= MIN_SAMPLES) {
            let largest = line
                .iter()
                .fold(0.0, |largest, h| f64::max(largest, h.abs()));
            self.rounding = self.rounding.max(ROUNDING * largest / spacing);
            taper(&mut line);
            samples = line.len();
            let transform = plan.get_or_insert_with(|| f64::real_forward(samples));
            let mut amplitudes = transform.make_output_vec();
            if transform.process(&mut line, &mut amplitudes).is_err() {
                continue;
            }
            count += 1.0;
            slopes.resize(amplitudes.len(), 0.0);
            let square =
                |(k, amplitude): (usize, &Complex<f64>)| (k * k) as f64 * amplitude.norm_sqr();
            let squares = amplitudes.iter().enumerate().map(square);
            let sums = slopes.iter_mut().zip(squares);
            sums.for_each(|(sum, square)| *sum += square);
        }
        let length = samples as f64 * spacing;
        // ⟨(∂h/∂x)²⟩ ∝ Σ (k/L)² |ĥ|², ĥ = amplitude/n
        let scale = (length * samples as f64).powi(-2) / count;
        let waves = slopes.iter().enumerate().skip(1).map(|(k, slope)| {
            // The taper spreads a wave to its two neighbours.
            let number = (k - 1).max(1);
            [length / number as f64, scale * slope]
        });
        self.waves.extend(waves);
    }

    /// The wavelength, m, above which waves have 97 % of the mean square slope; none for a plane.
    #[must_use]
    pub fn shortest_wave(&self) -> Option<f64> {
        let mut waves = self.waves.clone();
        waves.sort_by(|a, b| b[0].total_cmp(&a[0]));
        let all: f64 = waves.iter().map(|[_, slope]| slope).sum();
        let mut longer = 0.0;
        let shortest = waves.iter().find(|[_, slope]| {
            longer += slope;
            longer >= SHARE * all
        });
        shortest
            .filter(|_| all > self.rounding.powi(2))
            .map(|[length, _]| *length)
    }
}

/// Subtracts the mean and the linear trend, and tapers the rest to zero at both ends.
fn taper(line: &mut [f64]) {
    let count = line.len() as f64;
    let middle = 0.5 * (count - 1.0);
    let mean = line.iter().sum::<f64>() / count;
    // Σ (i − middle)² = n (n² − 1)/12
    let moment: f64 = line
        .iter()
        .enumerate()
        .map(|(i, height)| (i as f64 - middle) * height)
        .sum();
    let trend = moment * 12.0 / (count * (count * count - 1.0));
    for (i, height) in line.iter_mut().enumerate() {
        let phase = std::f64::consts::TAU * (i as f64 + 0.5) / count;
        *height = (*height - mean - trend * (i as f64 - middle)) * (0.5 - 0.5 * phase.cos());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The shortest wave of 64 × 80 samples of a surface, in samples.
    fn found(surface: impl Fn(f64, f64) -> f64) -> Option<f64> {
        let heights = (0..64 * 80_u32).map(|n| surface(f64::from(n / 80), f64::from(n % 80)));
        let map = HeightMap::new(heights.collect(), [64, 80], [64.0, 80.0]).unwrap();
        SlopeSpectrum::of(&map).shortest_wave()
    }

    #[test]
    fn the_shortest_of_several_waves_is_found_along_either_axis_and_on_a_trend() {
        let wave = |x: f64, length: f64| (std::f64::consts::TAU * x / length + 0.3).cos();
        let short_x = found(|x, y| 5.0 * wave(x, 31.0) + wave(x, 5.0) + wave(y, 20.0) + 3.0 * x);
        let short_y = found(|x, y| 5.0 * wave(x, 31.0) + wave(y, 4.0) - 9.0 * y);
        // In 64 samples, the waves nearest to 5 are 64/13 and 64/12.
        assert!((4.9..5.4).contains(&short_x.unwrap()), "{short_x:?}");
        assert!((3.9..4.3).contains(&short_y.unwrap()), "{short_y:?}");
    }

    #[test]
    fn a_smooth_surface_has_no_short_wave_however_finely_it_is_sampled() {
        let at = |x: f64, n: f64| (x + 0.5) / n - 0.5;
        let bowl = found(|x, y| at(x, 64.0).powi(2) + at(y, 80.0).powi(2));
        assert!(bowl.unwrap() > 20.0, "{bowl:?}");
        let cone = found(|x, y| at(x, 64.0).hypot(at(y, 80.0)));
        assert!(cone.unwrap() > 15.0, "{cone:?}");
        // Rounding noise along y, far below the slopes along x.
        let roller = found(|x, y| at(x, 64.0).powi(2) + 1e-12 * (1.7 * y * y).sin());
        assert!(roller.unwrap() > 20.0, "{roller:?}");
    }

    #[test]
    fn a_plane_has_no_wave() {
        assert_eq!(found(|_, _| 3.0), None);
        assert_eq!(found(|x, y| 0.1 + 0.3 * x - 0.7 * y), None);
        let small = HeightMap::new(vec![1.0, 2.0], [2, 1], [2.0, 1.0]).unwrap();
        assert_eq!(SlopeSpectrum::of(&small).shortest_wave(), None);
    }
}
