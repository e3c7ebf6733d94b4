//! What an error of T is measured against.

use super::sampler::scale;
use super::{Area, RadialFunctions};

/// The scale of T, asked at ascending radii: the largest of `|T|`, of what is left far away, and of `P/t`, the mean of T up to there (the largest
/// P so far, where it falls again).
///
/// An error δT changes the coefficient at the distance r by `4a² c δT/r`, `c = (1−ν1²)/(πE1)`, a half an element's side. The loaded element itself
/// feels about `2πcH P(a/H)`. The displacement around a point force, T/t, falls with the distance, so `P(t)` is at most `(tH/a)² P(a/H)`, and
/// with `δT ≤ ε P(t)/t` no coefficient is wrong by more than ε of the largest, whatever the element; all of them together are wrong by ε
/// of their sum, but for the logarithm of the radius. On a rigid base, where T falls exponentially, nothing finer can be felt.
#[derive(Debug)]
pub(crate) struct Yardstick<'a> {
    functions: &'a RadialFunctions,
    largest_area: f64,
}

impl<'a> Yardstick<'a> {
    pub(crate) fn new(functions: &'a RadialFunctions) -> Self {
        Self {
            functions,
            largest_area: 0.0,
        }
    }

    /// The scale around t, where `|T|` is at most `largest`.
    pub(crate) fn at(&mut self, t: f64, largest: f64) -> f64 {
        let area = self.functions.area(t, Area::Whole).abs();
        self.largest_area = self.largest_area.max(area);
        scale(self.functions.limit, largest, t.ln()).max(self.largest_area / t)
    }
}
