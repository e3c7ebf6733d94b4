//! The power spectrum of a map, averaged over directions.
//!
//! `C(q) = L_x L_y |ĥ(q)|²`, so that `∫ C d²q/(2π)² = Σ C/(L_x L_y) = ⟨h²⟩` (Jacobs, Junge, Pastewka 2017). Waves are
//! collected in bands of equal width in the logarithm of the wavenumber.

use std::f64::consts::TAU;

use pellicle_fourier::{Complex, Transformed};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::HeightMap;

/// Bands per octave of the wavenumber.
const BANDS_PER_OCTAVE: f64 = 8.0;
/// Columns transformed together: they fill four cache lines.
const BLOCK: usize = 16;
/// Fewest samples along an axis for Hann's window; with fewer, the mean of its square is not 1.
const FEWEST_UNDER_WINDOW: usize = 3;

/// How a map continues beyond its rim.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapRim {
    /// Unknown: the spectrum is that of the heights above their mean plane, under Hann's window.
    Ends,
    /// Periodic: the spectrum is that of the heights above their mean.
    Repeats,
}

/// The power spectral density, one number for each band of the wavenumber, from long waves to short ones; bands without
/// a wave that fits in the map are left out.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PowerSpectrum {
    /// Mean wavenumber `|q|`, 1/m.
    pub wavenumber: Vec<f64>,
    /// Mean power spectral density `C`, m⁴.
    pub power: Vec<f64>,
    /// Number of waves in all directions; `q` and `−q` count as two.
    pub waves: Vec<usize>,
}

/// Sums over the waves of a band.
#[derive(Clone, Copy, Default)]
struct Band {
    wavenumber: f64,
    power: f64,
    waves: usize,
}

/// `⟨|∇h|²⟩` and `⟨(∇²h/2)²⟩`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Moments {
    pub slope: f64,
    pub curvature: f64,
}

/// Sums over waves.
#[derive(Clone)]
struct WaveSums {
    moments: Moments,
    bands: Vec<Band>,
}

impl PowerSpectrum {
    /// Computes the spectrum of levelled samples, and the sums over its waves for slopes and curvatures.
    pub(super) fn of(mut samples: Vec<f64>, map: &HeightMap, rim: MapRim) -> (Self, Moments) {
        let (shape, extent) = (map.shape(), map.extent());
        if rim == MapRim::Ends {
            apply_window(&mut samples, shape);
        }
        let waves = transform_rows(samples, shape);
        let sums = sums_over_columns(&waves, shape, extent);
        let area = extent[0] * extent[1];
        let mut spectrum = Self::default();
        for band in sums.bands.into_iter().filter(|band| band.waves > 0) {
            let waves = band.waves as f64;
            spectrum.wavenumber.push(band.wavenumber / waves);
            spectrum.power.push(area * band.power / waves);
            spectrum.waves.push(band.waves);
        }
        (spectrum, sums.moments)
    }
}

/// Multiplies by Hann's window along both axes, `√(8/3) sin²`, whose square has the mean 1.
fn apply_window(samples: &mut [f64], [rows, columns]: [usize; 2]) {
    let window = |n: usize| -> Vec<f64> {
        let at = |i: usize| {
            let sine = (std::f64::consts::PI * (i as f64 + 0.5) / n as f64).sin();
            (8.0_f64 / 3.0).sqrt() * sine * sine
        };
        (0..n)
            .map(|i| if n < FEWEST_UNDER_WINDOW { 1.0 } else { at(i) })
            .collect()
    };
    let [across, along] = [window(rows), window(columns)];
    let rows = samples.par_chunks_mut(columns).zip(across);
    rows.for_each(|(row, factor)| {
        let row = row.iter_mut().zip(&along);
        row.for_each(|(h, other)| *h *= factor * other);
    });
}

/// The Fourier coefficients of each row up to its shortest wave; the others are their conjugates.
fn transform_rows(mut samples: Vec<f64>, [_, columns]: [usize; 2]) -> Vec<Complex<f64>> {
    let transform = f64::real_forward(columns);
    let width = columns / 2 + 1;
    let mut waves = vec![Complex::default(); samples.len() / columns * width];
    let rows = samples.par_chunks_mut(columns);
    rows.zip(waves.par_chunks_mut(width))
        .for_each(|(row, waves)| {
            let done = transform.process(row, waves);
            debug_assert!(done.is_ok(), "lengths are those of the plan");
        });
    waves
}

/// Transforms the columns, a block of them at a time, and sums over the waves.
fn sums_over_columns(
    waves: &[Complex<f64>],
    [rows, columns]: [usize; 2],
    extent: [f64; 2],
) -> WaveSums {
    let transform = f64::forward(rows);
    let width = columns / 2 + 1;
    let bands = Bands::new([rows, columns], extent);
    let of_block = |block: usize| {
        let mut sums = bands.empty_sums();
        let mut lines = vec![Complex::default(); BLOCK * rows];
        let first = block * BLOCK;
        let count = BLOCK.min(width - first);
        for (i, row) in waves.chunks(width).enumerate() {
            for (k, wave) in row[first..first + count].iter().enumerate() {
                lines[k * rows + i] = *wave;
            }
        }
        for (k, line) in lines.chunks_mut(rows).take(count).enumerate() {
            transform.process(line);
            bands.add(&mut sums, first + k, line);
        }
        sums
    };
    let blocks = (0..width.div_ceil(BLOCK)).into_par_iter().map(of_block);
    let blocks: Vec<WaveSums> = blocks.collect();
    blocks.into_iter().fold(bands.empty_sums(), WaveSums::and)
}

/// The bands of the waves that fit in a map.
struct Bands {
    shape: [usize; 2],
    /// `2π/L` along both axes, 1/m.
    step: [f64; 2],
    longest: f64,
    count: usize,
}

impl Bands {
    fn new(shape: [usize; 2], extent: [f64; 2]) -> Self {
        let step = extent.map(|side| TAU / side);
        let shortest = step[0].hypot(step[1]) * (shape[0].max(shape[1]) / 2) as f64;
        let mut bands = Self {
            shape,
            step,
            longest: step[0].min(step[1]),
            count: 0,
        };
        bands.count = bands.band(shortest.max(bands.longest)) + 1;
        bands
    }

    /// The band of a wavenumber; the longest wave is in the middle of the first band.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "not negative, and far below the largest index"
    )]
    fn band(&self, wavenumber: f64) -> usize {
        (BANDS_PER_OCTAVE * (wavenumber / self.longest).log2() + 0.5) as usize
    }

    fn empty_sums(&self) -> WaveSums {
        WaveSums {
            moments: Moments::default(),
            bands: vec![Band::default(); self.count],
        }
    }

    /// Adds the waves of one column of the computed half. Every column but the first and that of the shortest wave
    /// counts twice.
    fn add(&self, sums: &mut WaveSums, n: usize, waves: &[Complex<f64>]) {
        let [rows, columns] = self.shape;
        let images = if n == 0 || 2 * n == columns { 1 } else { 2 };
        let samples = (rows * columns) as f64;
        let along = n as f64 * self.step[1];
        for (m, wave) in waves.iter().enumerate() {
            if m == 0 && n == 0 {
                continue;
            }
            let across = m.min(rows - m) as f64 * self.step[0];
            let square = across * across + along * along;
            // |ĥ|²
            let power = f64::from(images) * wave.norm_sqr() / (samples * samples);
            sums.moments.slope += square * power;
            sums.moments.curvature += 0.25 * square * square * power;
            let wavenumber = square.sqrt();
            let band = &mut sums.bands[self.band(wavenumber)];
            band.wavenumber += f64::from(images) * wavenumber;
            band.power += power;
            band.waves += if images == 1 { 1 } else { 2 };
        }
    }
}

impl WaveSums {
    fn and(mut self, other: Self) -> Self {
        self.moments.slope += other.moments.slope;
        self.moments.curvature += other.moments.curvature;
        for (band, more) in self.bands.iter_mut().zip(other.bands) {
            band.wavenumber += more.wavenumber;
            band.power += more.power;
            band.waves += more.waves;
        }
        self
    }
}
