//! Chebyshev's points along the contacts of an axisymmetric indenter, and polynomials through values there.
//!
//! The polynomials are in `ln d`, the logarithm of the penetration that a contact's radius needs on a half-space, in
//! which force, penetration and stiffness are nearly straight lines in logarithms, also where a sphere is sunk to its
//! rim. Beyond the circle at which a cone's tip ends they are in the root of the distance from it: there `d` begins as
//! a series of such roots.

use std::f64::consts::PI;
use std::ops::RangeInclusive;

use pellicle_contact::axisymmetric::AxisymmetricProfile;

use super::punch::root;

/// A piece has as many points as this many factors e in the radius, and those within it.
const FACTORS: f64 = 2.7;

/// Step of a place for the slope of a polynomial.
const STEP: f64 = 1e-5;

/// A quantity that is prescribed, and one that is read.
pub type Pair = [f64; 2];

/// The points of a piece.
#[derive(Debug)]
pub struct ChebyshevNodes {
    /// Contact radii, m.
    pub radii: Vec<f64>,
    /// Points in [−1, 1], ascending.
    places: Vec<f64>,
    /// The first place at which polynomials have slopes: not where roots begin.
    first_slope: f64,
}

impl ChebyshevNodes {
    /// The pieces between two contact radii (m) with a number of points per factor e in the radius. With six the
    /// polynomials are exact to 1e-7 or better (`tests/contact_curves/axisymmetric.rs`): a change from one layer to the
    /// next is analytic within a strip of half-width π/2 in `ln a`.
    pub fn between(
        profile: AxisymmetricProfile,
        [first, last]: [f64; 2],
        per_factor: f64,
    ) -> Vec<Self> {
        let piece = |ends, kink| Self::piece(profile, ends, kink, per_factor);
        match profile.kink().filter(|kink| *kink > 0.0 && *kink < last) {
            Some(kink) if kink > first => {
                vec![piece([first, kink], None), piece([kink, last], Some(kink))]
            }
            kink => vec![piece([first, last], kink)],
        }
    }

    /// A piece between two radii, at or beyond the kink if one is given.
    fn piece(
        profile: AxisymmetricProfile,
        [first, last]: [f64; 2],
        kink: Option<f64>,
        per_factor: f64,
    ) -> Self {
        let log = |radius| profile.half_space_penetration(radius).ln();
        let ends = [log(first), log(last)];
        let zero = kink.map(log);
        // u = √(ln d − ln d(kink))
        let to = |log: f64| zero.map_or(log, |zero| (log - zero).max(0.0).sqrt());
        let back = |u: f64| zero.map_or(u, |zero| zero + u * u);
        let count = per_factor * (FACTORS + (last / first).ln());
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a small number of points"
        )]
        let count = count.ceil() as usize;
        let step = PI / (count - 1) as f64;
        let places: Vec<f64> = (0..count).map(|i| -(i as f64 * step).cos()).collect();
        let [from, till] = ends.map(to);
        let radius = |place: &f64| {
            let u = 0.5 * (from * (1.0 - place) + till * (1.0 + place));
            profile.half_space_radius(back(u).exp())
        };
        let mut radii: Vec<f64> = places.iter().map(radius).collect();
        radii[0] = first;
        radii[count - 1] = last;
        let is_root = zero.is_some_and(|zero| ends[0] <= zero);
        Self {
            radii,
            places,
            first_slope: if is_root { 2.0 * STEP - 1.0 } else { -1.0 },
        }
    }

    /// The polynomials through some pairs at a place.
    pub fn at(&self, place: f64, pairs: &[Pair]) -> Pair {
        let same = |node: &f64| node.total_cmp(&place).is_eq();
        if let Some(at) = self.places.iter().position(same) {
            return pairs[at];
        }
        // Barycentric weights (−1)ʲ/(x − xⱼ), half at the ends.
        let last = pairs.len() - 1;
        let (mut sum, mut all) = ([0.0; 2], 0.0);
        for (j, (node, [one, other])) in self.places.iter().zip(pairs).enumerate() {
            let sign = if j % 2 == 0 { 1.0 } else { -1.0 };
            let share = if j == 0 || j == last { 0.5 } else { 1.0 };
            let weight = sign * share / (place - node);
            all += weight;
            sum = [sum[0] + weight * one, sum[1] + weight * other];
        }
        sum.map(|sum| sum / all)
    }

    /// The derivative of what is read by what is prescribed at a place, by a difference, at the ends also from just
    /// beyond.
    pub fn slope(&self, place: f64, pairs: &[Pair]) -> f64 {
        let place = place.max(self.first_slope);
        let [less, more] = [place - STEP, place + STEP].map(|place| self.at(place, pairs));
        (more[1] - less[1]) / (more[0] - less[0])
    }

    /// The place at which what is prescribed has a value; the nearer end if it lies beyond.
    pub fn place(&self, value: f64, pairs: &[Pair]) -> f64 {
        let (first, last) = (pairs[0][0], pairs[pairs.len() - 1][0]);
        if value <= first {
            return -1.0;
        }
        let miss = |place: f64| (self.at(place, pairs)[0] - value) / (last - first);
        let found = (value < last).then(|| root(miss, [-1.0, 1.0]));
        found.flatten().unwrap_or(1.0)
    }

    /// Smallest and largest prescribed value.
    pub fn span(pairs: &[Pair]) -> RangeInclusive<f64> {
        pairs[0][0]..=pairs[pairs.len() - 1][0]
    }
}
