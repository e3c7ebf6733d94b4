//! Random self-affine surfaces as sums of waves.

use std::f64::consts::TAU;

use ndarray::Array2;

/// A generator of numbers between 0 and 1 (Steele, Lea and Flood's splitmix64).
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// A surface of an rms height of 1 that repeats after `period` samples, of which the first `samples` are returned along
/// x and y: random waves of `per_octave` in each octave from the period to two samples, their heights as those of a
/// self-affine surface of this Hurst exponent.
pub fn self_affine(random: &mut Random, [period, samples]: [u32; 2], hurst: f64) -> Array2<f64> {
    const PER_OCTAVE: u32 = 24;
    let mut waves = Vec::new();
    let mut longest = 1.0;
    while longest <= f64::from(period) / 4.0 {
        for _ in 0..PER_OCTAVE {
            let (size, angle) = (longest * 2.0_f64.powf(random.next()), TAU * random.next());
            let wave = [size * angle.cos(), size * angle.sin()].map(f64::round);
            let length = wave[0].hypot(wave[1]).max(1.0);
            waves.push((wave, length.powf(-hurst), TAU * random.next()));
        }
        longest *= 2.0;
    }
    let power: f64 = waves
        .iter()
        .map(|(_, height, _)| 0.5 * height * height)
        .sum();
    let shift = [random.next(), random.next()].map(|part| (part * f64::from(period)).round());
    // The sines of a sum are products of sines: two tables instead of a sine for each sample.
    let mut surface = Array2::zeros([samples as usize; 2]);
    for ([along_x, along_y], height, phase) in waves {
        let turns = |along: f64, shift: f64, phase: f64| -> Vec<[f64; 2]> {
            let angle = |k: u32| along * (f64::from(k) + shift) * TAU / f64::from(period) + phase;
            (0..samples).map(|k| angle(k).sin_cos().into()).collect()
        };
        let (x, y) = (
            turns(along_x, shift[0], phase),
            turns(along_y, shift[1], 0.0),
        );
        for ((i, j), h) in surface.indexed_iter_mut() {
            *h += height / power.sqrt() * (x[i][0] * y[j][1] + x[i][1] * y[j][0]);
        }
    }
    surface
}
