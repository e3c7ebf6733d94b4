//! Roughness of a height map: root mean square height, slope and curvature, and the power spectrum.
//!
//! With `h` the height above the mean, `q = 2π (m/L_x, n/L_y)` the wave vector of a wave that fits in the map and
//! `ĥ` its Fourier coefficient, `h = Σ ĥ exp(i q·x)`:
//!
//! ```text
//! rms height² = ⟨h²⟩ = Σ |ĥ|²     rms slope² = ⟨|∇h|²⟩ = Σ |q|² |ĥ|²     rms curvature² = ⟨(∇²h/2)²⟩ = Σ |q|⁴ |ĥ|²/4
//! ```
//!
//! The sums over waves hold for a map that repeats periodically. On a map that ends they would include the jump across
//! the rim, so slopes and curvatures are taken there from differences between neighbouring samples. The differences
//! underestimate the slope of a wave of wavelength `ℓ` by the factor `sinc(w/ℓ)`, where `w` is the pixel.
//!
//! Heights and slopes are those of the map as it is: of a tilted map they include the tilt. Only the spectrum of a map
//! that ends is that of its heights above the least-squares plane, since a plane is no sum of waves.

mod spectrum;

pub use spectrum::{MapRim, PowerSpectrum};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::{HeightMap, MeanPlane, mean_plane::above_mean, nan_from_null};
use spectrum::Moments;

/// The roughness of the samples of a map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Roughness {
    /// Root mean square of the heights above their mean, m: a tilt counts.
    #[serde(deserialize_with = "nan_from_null")]
    pub rms_height: f64,
    /// Root mean square of the gradient's length.
    #[serde(deserialize_with = "nan_from_null")]
    pub rms_slope: f64,
    /// Root mean square of the mean curvature, 1/m.
    #[serde(deserialize_with = "nan_from_null")]
    pub rms_curvature: f64,
    /// The source of slopes and curvatures.
    pub derivatives: DerivativeSource,
    /// The power spectrum, averaged over directions.
    pub spectrum: PowerSpectrum,
}

/// The source of the slopes and curvatures of a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum DerivativeSource {
    /// From the waves of a periodic map.
    Spectrum,
    /// From differences between neighbouring samples of a map that ends.
    Differences,
}

impl Roughness {
    /// Computes the roughness of the samples of a map.
    ///
    /// ```
    /// use pellicle_texture::{HeightMap, MapRim, Roughness};
    ///
    /// // A wave of height 0.1 and length 1/2, 64 samples on a side of 1.
    /// let wave = |k: u32| 0.1 * (std::f64::consts::TAU * f64::from(k / 64) / 32.0).cos();
    /// let map = HeightMap::new((0..64 * 64).map(wave).collect(), [64, 64], [1.0, 1.0])?;
    /// let rough = Roughness::of(&map, MapRim::Repeats);
    /// // 0.1/√2 in height, times 4π in slope, up to the rounding of a few thousand sums.
    /// assert!((rough.rms_height - 0.1 / 2.0_f64.sqrt()).abs() < 1e-14);
    /// assert!((rough.rms_slope / rough.rms_height - 4.0 * std::f64::consts::PI).abs() < 1e-11);
    /// # Ok::<(), pellicle_texture::TextureError>(())
    /// ```
    #[must_use]
    pub fn of(map: &HeightMap, rim: MapRim) -> Self {
        let mut samples = above_mean(map);
        let squares = sum_of_lines(&samples, map.shape(), |row| row.iter().map(|h| h * h).sum());
        let differences = match rim {
            MapRim::Ends => Some(difference_moments(&samples, map)),
            MapRim::Repeats => None,
        };
        let count = samples.len() as f64;
        if rim == MapRim::Ends {
            MeanPlane::of_samples(&samples, map).subtract_from(&mut samples);
        }
        let (spectrum, sums) = PowerSpectrum::of(samples, map, rim);
        let (derivatives, Moments { slope, curvature }) = match differences {
            Some(differences) => (DerivativeSource::Differences, differences),
            None => (DerivativeSource::Spectrum, sums),
        };
        Self {
            rms_height: (squares / count).sqrt(),
            rms_slope: slope.sqrt(),
            rms_curvature: curvature.sqrt(),
            derivatives,
            spectrum,
        }
    }
}

/// The sum of one number per row of a field, in the order of the rows.
fn sum_of_lines(field: &[f64], shape: [usize; 2], of: impl Fn(&[f64]) -> f64 + Send + Sync) -> f64 {
    let rows = field.par_chunks(shape[1]).map(of);
    rows.collect::<Vec<_>>().into_iter().sum()
}

/// Computes `⟨|∇h|²⟩` and `⟨(∇²h/2)²⟩` from differences between neighbouring samples.
fn difference_moments(samples: &[f64], map: &HeightMap) -> Moments {
    let ([rows, columns], pixel) = (map.shape(), map.pixel());
    let row = |i: usize| &samples[i * columns..(i + 1) * columns];
    let sums: Vec<[f64; 3]> = (0..rows)
        .into_par_iter()
        .map(|i| {
            let here = row(i);
            let square = |pair: &[f64]| ((pair[1] - pair[0]) / pixel[1]).powi(2);
            let along = here.windows(2).map(square).sum();
            let (mut across, mut bends) = (0.0, 0.0);
            if i + 1 < rows {
                let pairs = here.iter().zip(row(i + 1));
                across = pairs.map(|(a, b)| ((b - a) / pixel[0]).powi(2)).sum();
            }
            if (1..rows.saturating_sub(1)).contains(&i) {
                let (before, after) = (row(i - 1), row(i + 1));
                for j in 1..columns.saturating_sub(1) {
                    let bend = (before[j] + after[j] - 2.0 * here[j]) / pixel[0].powi(2)
                        + (here[j - 1] + here[j + 1] - 2.0 * here[j]) / pixel[1].powi(2);
                    bends += (0.5 * bend).powi(2);
                }
            }
            [across, along, bends]
        })
        .collect();
    let mean = |which: usize, terms: usize| {
        let sum: f64 = sums.iter().map(|sums| sums[which]).sum();
        sum / terms.max(1) as f64
    };
    let within = |n: usize, rim: usize| n.saturating_sub(rim);
    Moments {
        slope: mean(0, within(rows, 1) * columns) + mean(1, rows * within(columns, 1)),
        curvature: mean(2, within(rows, 2) * within(columns, 2)),
    }
}

#[cfg(test)]
mod tests;
