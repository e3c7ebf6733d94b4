//! Interpolation between the samples of a map, along one axis at a time.
//!
//! Bicubic: between two samples, the cubic with their heights and slopes (Hermite). The slope at a sample is that of
//! the polynomial through it and three neighbours on either side, fewer near the rim. It belongs to the sample, so the
//! surface is smooth (C¹) across every line of samples, where a bilinear one has a ridge. Cubics are reproduced exactly
//! wherever there are three neighbours on either side, and the error on a smooth surface falls with the fourth power of
//! the distance between samples. A wave of four samples keeps 97 % of its height midway between two samples; a bilinear
//! map leaves 71 %.

/// The interpolation between the samples of a map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Interpolation {
    /// Piecewise bicubic and smooth: the slopes are continuous.
    #[default]
    Bicubic,
    /// Piecewise bilinear: no height lies outside the range of the four samples around it, and every line of samples is
    /// a ridge.
    Linear,
}

/// Largest number of samples that a height depends on along one axis.
const MOST: usize = 8;

/// Neighbours on either side used for the slope at a sample, where there are that many.
const REACH: usize = 3;

/// Weights of the differences `f(k) − f(−k)`, k = 1, 2, …, in the slope of the polynomial through `2m + 1` equally
/// spaced samples, m = 1, 2, 3.
const CENTRAL: [&[f64]; REACH] = [
    &[0.5],
    &[2.0 / 3.0, -1.0 / 12.0],
    &[0.75, -0.15, 1.0 / 60.0],
];

/// Slope of the parabola through the first three samples, at the first of them.
const ONE_SIDED: [f64; 3] = [-1.5, 2.0, -0.5];

/// The samples that a height depends on along one axis, and their weights.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stencil {
    first: usize,
    count: usize,
    weights: [f64; MOST],
}

impl Stencil {
    /// The stencil of the cubic at the fraction `t` of the way from sample `before` to the next, on an axis of
    /// `samples` samples.
    pub(crate) fn cubic(before: usize, t: f64, samples: usize) -> Self {
        if t == 0.0 {
            // Common case: a grid whose elements are the samples of the map.
            let mut weights = [0.0; MOST];
            weights[0] = 1.0;
            return Self {
                first: before,
                count: 1,
                weights,
            };
        }
        let mut stencil = Self::empty(before, samples);
        // f = f0 + t² (3 − 2t) (f1 − f0) + t (1 − t)² f0′ − t² (1 − t) f1′
        let rest = 1.0 - t;
        stencil.add(before, 1.0);
        stencil.add_cubic(
            before,
            samples,
            [t * t * (3.0 - 2.0 * t), t * rest * rest, -t * t * rest],
        );
        stencil
    }

    /// A stencil of zero weights on the samples that a cubic between `before` and the next depends on.
    fn empty(before: usize, samples: usize) -> Self {
        let after = (before + 1).min(samples - 1);
        let first = before.saturating_sub(REACH);
        let last = (after + REACH).min(samples - 1);
        Self {
            first,
            count: last - first + 1,
            weights: [0.0; MOST],
        }
    }

    /// Adds `rise (f1 − f0) + before_slope f0′ + after_slope f1′`.
    fn add_cubic(
        &mut self,
        before: usize,
        samples: usize,
        [rise, before_slope, after_slope]: [f64; 3],
    ) {
        let after = (before + 1).min(samples - 1);
        self.add(before, -rise);
        self.add(after, rise);
        self.add_slope(before, samples, before_slope);
        self.add_slope(after, samples, after_slope);
    }

    /// The stencil of the slope at a sample, in heights per distance between samples.
    pub(crate) fn slope(sample: usize, samples: usize) -> Self {
        let mut stencil = Self::empty(sample, samples);
        stencil.add_slope(sample, samples, 1.0);
        stencil
    }

    /// Weights of the samples, from the first on.
    pub(crate) fn terms(&self) -> impl Iterator<Item = (usize, f64)> {
        let weights = self.weights.iter().copied().take(self.count);
        (self.first..).zip(weights)
    }

    fn add(&mut self, sample: usize, weight: f64) {
        self.weights[sample - self.first] += weight;
    }

    /// Adds `weight` times the slope at a sample, in heights per distance between samples.
    fn add_slope(&mut self, sample: usize, samples: usize, weight: f64) {
        let reach = REACH.min(sample).min(samples - 1 - sample);
        match (reach, samples) {
            (0, 1) => {}
            (0, 2) => {
                self.add(0, -weight);
                self.add(1, weight);
            }
            (0, _) => {
                // At the last sample the others come in the opposite order, and the slope has the opposite sign.
                let is_first = sample == 0;
                for (k, one_sided) in ONE_SIDED.into_iter().enumerate() {
                    let (at, sign) = if is_first {
                        (k, 1.0)
                    } else {
                        (sample - k, -1.0)
                    };
                    self.add(at, sign * weight * one_sided);
                }
            }
            _ => {
                for (k, central) in (1..).zip(CENTRAL[reach - 1]) {
                    self.add(sample + k, weight * central);
                    self.add(sample - k, -weight * central);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(f: impl Fn(f64) -> f64, samples: usize, at: f64) -> f64 {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a sample of the test"
        )]
        let before = (at.floor() as usize).min(samples - 2);
        let stencil = Stencil::cubic(before, at - before as f64, samples);
        stencil
            .terms()
            .map(|(i, weight)| weight * f(i as f64))
            .sum()
    }

    #[test]
    fn cubics_are_reproduced_where_a_sample_has_two_neighbours_and_parabolas_everywhere() {
        let cubic = |x: f64| 1.0 - 2.0 * x + 0.5 * x * x - 0.125 * x * x * x;
        let parabola = |x: f64| 1.0 - 2.0 * x + 0.5 * x * x;
        for k in 0..=90 {
            let at = f64::from(k) / 10.0;
            // Values up to 50, a dozen roundings.
            assert!(
                (value(parabola, 10, at) - parabola(at)).abs() < 1e-13,
                "{at}"
            );
            let error = (value(cubic, 10, at) - cubic(at)).abs();
            assert!(
                error < 1e-13 || !(2.0..=7.0).contains(&at),
                "{at}: {error:e}"
            );
        }
    }

    #[test]
    fn a_wave_of_four_samples_keeps_97_percent_of_its_height_midway() {
        let wave = |x: f64| (std::f64::consts::FRAC_PI_2 * (x - 8.5)).cos();
        let found = value(wave, 20, 8.5);
        // ½ √½ · 2 + ¼ · 22/15 · √½, from the heights and slopes of the two samples beside the crest.
        let expected = 0.5_f64.sqrt() * (1.0 + 22.0 / 60.0);
        assert!((found - expected).abs() < 1e-14, "{found}");
        assert!((expected - 0.966).abs() < 5e-4);
    }

    #[test]
    fn few_samples_reduce_the_order_of_interpolation() {
        let line = |x: f64| 3.0 - x;
        assert_eq!(value(line, 2, 0.25), 2.75);
        let stencil = Stencil::cubic(0, 0.0, 1);
        assert_eq!(stencil.terms().collect::<Vec<_>>(), [(0, 1.0)]);
        let parabola = |x: f64| x * x;
        assert!((value(parabola, 3, 1.5) - 2.25).abs() < 1e-15);
    }
}
