//! The kernel `M(y)` that layers add to the integral equation, as polynomials.
//!
//! `M` is analytic but for reflections at the depths of the interfaces, at least two thicknesses of the top layer from
//! the real axis on the imaginary one. So intervals that begin with two thicknesses and double are short compared with
//! their distance from them. An interval whose polynomial has not converged is halved.

use std::array;
use std::f64::consts::{FRAC_2_PI, PI};
use std::sync::OnceLock;

use pellicle_influence::ElasticBodies;

use super::quadrature::{composite, graded};

/// `Φ − 1` decays as `e^{−2s}` with the product s of wavenumber and top thickness: 1e-15 of its largest value.
const DECAY: f64 = 20.0;

/// Coefficients of a polynomial: on an interval as long as its distance from 0 they fall by 5.8 each, to 1e-18.
const COEFFICIENTS: usize = 24;

/// The last coefficients of a polynomial that has converged are below this part of the kernel's largest value.
const CONVERGED: f64 = 1e-14;

/// Most halvings of an interval.
const MOST_HALVINGS: u32 = 8;

/// Intervals, each twice as long as the one before.
pub(super) const OCTAVES: u32 = 12;

/// `2/π M(y)` of the layers of both bodies.
#[derive(Debug, Clone)]
pub(super) struct LayerKernel {
    bodies: ElasticBodies,
    /// Thickness of the thinner of the top layers, m.
    pub thickness: f64,
    octaves: [OnceLock<Vec<Polynomial>>; OCTAVES as usize],
}

/// Chebyshev polynomials on an interval.
#[derive(Debug, Clone)]
struct Polynomial {
    middle: f64,
    half: f64,
    coefficients: [f64; COEFFICIENTS],
}

/// The kernel up to some distance.
#[derive(Debug)]
pub(super) struct KernelTable<'a>(Vec<&'a Polynomial>);

impl LayerKernel {
    /// None if there are no layers.
    pub fn new(bodies: &ElasticBodies) -> Option<Self> {
        Some(Self {
            thickness: bodies.thinnest_top()?,
            bodies: bodies.clone(),
            octaves: [const { OnceLock::new() }; OCTAVES as usize],
        })
    }

    /// The largest distance that the octaves reach, m.
    pub fn reach(&self) -> f64 {
        self.end(OCTAVES - 1)
    }

    /// The kernel up to a distance y (m) within the reach.
    pub fn up_to(&self, y: f64) -> KernelTable<'_> {
        let mut pieces = Vec::new();
        for (octave, known) in (0..).zip(&self.octaves) {
            pieces.extend(known.get_or_init(|| self.octave(octave)));
            if y <= self.end(octave) {
                break;
            }
        }
        KernelTable(pieces)
    }

    fn end(&self, octave: u32) -> f64 {
        self.thickness * 2.0_f64.powi(octave.cast_signed() + 1)
    }

    fn octave(&self, octave: u32) -> Vec<Polynomial> {
        let end = self.end(octave);
        let start = if octave == 0 { 0.0 } else { end / 2.0 };
        // One piece per half period of the fastest wave.
        let waves: Vec<(f64, f64)> = composite(&graded(DECAY / self.thickness, PI / end))
            .into_iter()
            .map(|(k, weight)| (k, FRAC_2_PI * weight * self.bodies.response_minus_one(k)))
            .collect();
        let mut pieces = Vec::new();
        Polynomial::fit([start, end], &waves, MOST_HALVINGS, &mut pieces);
        pieces
    }
}

impl Polynomial {
    /// Fits the sum of waves (wavenumber, amplitude) on an interval, in two halves if need be.
    fn fit(ends: [f64; 2], waves: &[(f64, f64)], halvings: u32, pieces: &mut Vec<Self>) {
        let (middle, half) = (f64::midpoint(ends[0], ends[1]), (ends[1] - ends[0]) / 2.0);
        let count = COEFFICIENTS as f64;
        let angle = |i: usize| (i as f64 + 0.5) * PI / count;
        let values: [f64; COEFFICIENTS] = array::from_fn(|i| {
            let y = middle + half * angle(i).cos();
            waves
                .iter()
                .map(|(k, amplitude)| amplitude * (k * y).cos())
                .sum()
        });
        // cⱼ = 2/n Σ f(cos θᵢ) cos jθᵢ, half of it for j = 0
        let coefficients: [f64; COEFFICIENTS] = array::from_fn(|j| {
            let terms = values.iter().enumerate();
            let sum: f64 = terms
                .map(|(i, value)| value * (j as f64 * angle(i)).cos())
                .sum();
            sum * if j == 0 { 1.0 } else { 2.0 } / count
        });
        let largest: f64 = waves.iter().map(|(_, amplitude)| amplitude.abs()).sum();
        let last = coefficients[COEFFICIENTS - 3..]
            .iter()
            .fold(0.0_f64, |most, c| most.max(c.abs()));
        if last > CONVERGED * largest && halvings > 0 {
            Self::fit([ends[0], middle], waves, halvings - 1, pieces);
            Self::fit([middle, ends[1]], waves, halvings - 1, pieces);
        } else {
            pieces.push(Self {
                middle,
                half,
                coefficients,
            });
        }
    }

    /// Clenshaw's recurrence.
    fn value(&self, y: f64) -> f64 {
        let twice = 2.0 * (y - self.middle) / self.half;
        let [mut last, mut before] = [0.0; 2];
        for c in self.coefficients[1..].iter().rev() {
            (last, before) = (twice * last - before + c, last);
        }
        0.5 * twice * last - before + self.coefficients[0]
    }
}

impl KernelTable<'_> {
    /// `1/π (M(x + t) + M(x − t))`.
    pub fn pair(&self, x: f64, t: f64) -> f64 {
        0.5 * (self.value(x + t) + self.value((x - t).abs()))
    }

    fn value(&self, y: f64) -> f64 {
        let place = self
            .0
            .partition_point(|piece| piece.middle + piece.half < y);
        let piece = self.0.get(place).or(self.0.last());
        piece.map_or(0.0, |piece| piece.value(y))
    }
}
