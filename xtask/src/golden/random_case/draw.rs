//! Random numbers, words and quantities, and the text that they make.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::RandomCase;
use crate::golden::run::InputFile;

/// How the quantities of a case are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Writing {
    /// Bare numbers in consistent units.
    Bare,
    /// Each with a unit.
    Units,
    /// Most with a unit, some bare, which gives warnings.
    Mixed,
}

/// Units of a dimension with the SI value of one.
type Units = [(&'static str, f64)];

const LENGTHS: &Units = &[("nm", 1e-9), ("um", 1e-6), ("mm", 1e-3), ("m", 1.0)];
const PRESSURES: &Units = &[("GPa", 1e9), ("MPa", 1e6), ("kPa", 1e3), ("Pa", 1.0)];
const FORCES: &Units = &[("mN", 1e-3), ("uN", 1e-6), ("nN", 1e-9), ("N", 1.0)];
const ANGLES: &Units = &[("deg", std::f64::consts::PI / 180.0), ("rad", 1.0)];
const COMPLIANCES: &Units = &[("nm/GPa", 1e-18), ("um/MPa", 1e-12)];

/// The source of everything random in a case.
#[derive(Debug)]
pub struct Draw {
    random: ChaCha8Rng,
    writing: Writing,
    /// The text so far.
    pub text: String,
    /// The files that it names so far.
    pub maps: Vec<InputFile>,
}

impl Draw {
    pub fn new(seed: u64) -> Self {
        let mut draw = Self {
            random: ChaCha8Rng::seed_from_u64(seed),
            writing: Writing::Units,
            text: String::new(),
            maps: Vec::new(),
        };
        draw.writing = draw.pick(&[
            Writing::Bare,
            Writing::Units,
            Writing::Units,
            Writing::Mixed,
        ]);
        draw
    }

    pub fn case(self) -> RandomCase {
        RandomCase {
            text: self.text,
            maps: self.maps,
        }
    }

    pub fn has_units(&self) -> bool {
        self.writing != Writing::Bare
    }

    /// Adds a line to the text.
    pub fn line(&mut self, text: impl AsRef<str>) {
        self.text.push_str(text.as_ref());
        self.text.push('\n');
    }

    /// Adds a line once in `count` times.
    pub fn sometimes(&mut self, count: u32, text: impl AsRef<str>) {
        if self.one_in(count) {
            self.line(text);
        }
    }

    pub fn length(&mut self, length: f64) -> String {
        self.quantity(length, LENGTHS)
    }

    pub fn pressure(&mut self, pressure: f64) -> String {
        self.quantity(pressure, PRESSURES)
    }

    pub fn force(&mut self, force: f64) -> String {
        self.quantity(force, FORCES)
    }

    /// An angle in radians.
    pub fn angle(&mut self, angle: f64) -> String {
        self.quantity(angle, ANGLES)
    }

    pub fn compliance(&mut self, compliance: f64) -> String {
        self.quantity(compliance, COMPLIANCES)
    }

    fn quantity(&mut self, value: f64, units: &Units) -> String {
        let is_bare = match self.writing {
            Writing::Bare => true,
            Writing::Units => false,
            Writing::Mixed => self.one_in(10),
        };
        if is_bare {
            return format!("{value:e}");
        }
        let (unit, size) = self.pick(units);
        format!("\"{:e} {unit}\"", value / size)
    }

    /// A number whose logarithm is uniform between two ends, with three digits, as people write them.
    pub fn decades(&mut self, [from, to]: [f64; 2]) -> f64 {
        let exact = from * (to / from).powf(self.part());
        format!("{exact:.2e}").parse().unwrap_or(exact)
    }

    /// A number from 0 to 1.
    pub fn part(&mut self) -> f64 {
        self.random.random()
    }

    /// A number from 0 to below `count`.
    pub fn below(&mut self, count: usize) -> usize {
        self.random.random_range(0..count)
    }

    pub fn one_in(&mut self, count: u32) -> bool {
        self.random.random_range(0..count) == 0
    }

    pub fn pick<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.random.random_range(0..all.len())]
    }
}
