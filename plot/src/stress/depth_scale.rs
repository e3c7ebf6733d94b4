//! The depth axis of a section through layers: every body is tall enough to be seen, however thin.

use crate::axes::labels;
use crate::axes::panel::Axis;
use crate::axes::ticks;

/// Least fraction of the height for a body if there are few bodies; the sum of these minima if there are many.
const MIN_SHARE: f64 = 0.22;
const SHARED: f64 = 0.6;

/// Least distance of a tick from the ends of its body, and approximate distance between ticks, as fractions of the
/// height.
const FROM_ENDS: f64 = 0.05;
const BETWEEN: f64 = 0.12;

/// A depth axis, linear within each body.
#[derive(Debug, Clone, PartialEq)]
pub struct DepthScale {
    /// Depths of the surface, the interfaces and the lowest plane, each with its position down the picture.
    ends: Vec<(f64, f64)>,
    /// Whether one body is enlarged more than another.
    pub is_uneven: bool,
}

impl DepthScale {
    /// Builds the scale of bodies bounded by these increasing depths; the first is that of the surface.
    #[must_use]
    pub fn new(depths: &[f64]) -> Self {
        let thicknesses: Vec<f64> = depths.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let (shares, is_uneven) = shares(&thicknesses);
        let mut down = 0.0;
        let mut ends = vec![(depths.first().copied().unwrap_or(0.0), 0.0)];
        for (depth, share) in depths.iter().skip(1).zip(shares) {
            down += share;
            ends.push((*depth, down));
        }
        Self { ends, is_uneven }
    }

    /// The number of bodies.
    #[must_use]
    pub fn bodies(&self) -> usize {
        self.ends.len() - 1
    }

    /// Positions of a body's top and bottom down the picture, from 0 to 1.
    #[must_use]
    pub fn within(&self, body: usize) -> [f64; 2] {
        [self.ends[body].1, self.ends[body + 1].1]
    }

    /// Position of a depth in a body down the picture, from 0 to 1.
    #[must_use]
    pub fn down(&self, body: usize, depth: f64) -> f64 {
        let [(top, from), (bottom, to)] = [self.ends[body], self.ends[body + 1]];
        from + (to - from) * (depth - top) / (bottom - top)
    }

    /// Depth in a body at a position down the picture.
    #[must_use]
    pub fn depth(&self, body: usize, down: f64) -> f64 {
        let [(top, from), (bottom, to)] = [self.ends[body], self.ends[body + 1]];
        top + (bottom - top) * (down - from) / (to - from)
    }

    /// Returns the axis, with the depths of all interfaces and round depths between them, divided by `divisor`.
    #[must_use]
    pub fn axis(&self, divisor: f64, title: String) -> Axis {
        let mut ticks = Vec::new();
        for body in 0..self.bodies() {
            let [(top, from), (bottom, to)] = [self.ends[body], self.ends[body + 1]];
            let label = |depth: f64| labels::tick(depth / divisor, (bottom - top) / divisor);
            ticks.push((from, label(top)));
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "at most 1 / BETWEEN"
            )]
            let count = ((to - from) / BETWEEN) as usize;
            let round = ticks::linear(top / divisor, bottom / divisor, count);
            let between = round.into_iter().map(|depth| depth * divisor);
            let placed = between.map(|depth| (self.down(body, depth), label(depth)));
            ticks.extend(placed.filter(|(at, _)| *at > from + FROM_ENDS && *at < to - FROM_ENDS));
        }
        if let [.., before, last] = &self.ends[..] {
            let label = labels::tick(last.0 / divisor, (last.0 - before.0) / divisor);
            ticks.push((last.1, label));
        }
        Axis {
            from: 1.0,
            to: 0.0,
            title,
            ticks,
            is_logarithmic: false,
        }
    }
}

/// Fractions of the height: proportional to the thickness, except that no body gets less than the minimum; and whether
/// any body was raised to it.
fn shares(thicknesses: &[f64]) -> (Vec<f64>, bool) {
    let least = MIN_SHARE.min(SHARED / thicknesses.len() as f64);
    let mut is_raised = vec![false; thicknesses.len()];
    loop {
        let raised = is_raised.iter().filter(|is| **is).count();
        let free = thicknesses.iter().zip(&is_raised).filter(|(_, is)| !**is);
        let whole = free.fold(0.0, |sum, (thickness, _)| sum + thickness);
        let rest = 1.0 - least * raised as f64;
        let share = |i: usize| {
            if is_raised[i] {
                least
            } else {
                rest * thicknesses[i] / whole
            }
        };
        let shares: Vec<f64> = (0..thicknesses.len()).map(share).collect();
        let next = (0..shares.len()).find(|i| !is_raised[*i] && shares[*i] < least);
        match next {
            Some(i) => is_raised[i] = true,
            None => return (shares, raised > 0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thick_bodies_are_to_scale_and_thin_ones_have_a_minimum_height() {
        let even = DepthScale::new(&[0.0, 1.0, 3.0]);
        assert!(!even.is_uneven);
        assert!((even.down(1, 2.0) - 2.0 / 3.0).abs() < 1e-15);
        let thin = DepthScale::new(&[0.0, 1e-4, 1.0]);
        assert!(thin.is_uneven);
        assert_eq!(thin.within(0), [0.0, MIN_SHARE]);
        assert!((thin.depth(1, thin.down(1, 0.3)) - 0.3).abs() < 1e-15);
        let many: Vec<f64> = (0..10).map(|i| f64::from(i) * 1e-3).chain([1.0]).collect();
        let many = DepthScale::new(&many);
        assert!((many.within(9)[1] - 1.0).abs() < 1e-12 && many.within(9)[0] < 0.6);
    }

    #[test]
    fn ticks_mark_the_interfaces_and_other_ticks_keep_clear_of_them() {
        let axis = DepthScale::new(&[0.0, 2.1e-6, 20e-6]).axis(1e-6, "depth".into());
        let labels: Vec<&str> = axis.ticks.iter().map(|(_, label)| &label[..]).collect();
        assert_eq!(labels[0], "0");
        assert!(
            labels.contains(&"2.1") && labels.contains(&"10"),
            "{labels:?}"
        );
        assert!(axis.ticks.windows(2).all(|pair| pair[0].0 < pair[1].0));
    }
}
