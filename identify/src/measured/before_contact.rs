//! The stretch of an approach before the contact: its forces are those of no contact, which give the zero of the force,
//! its slope and the noise.
//!
//! The contact is first found as the break of a curve in two pieces, a line and a power law added to it,
//!
//! ```text
//! F = a + b x + A (x − c)₊ᵖ,   p = 1, 3/2 or 2,
//! ```
//!
//! with the `c` and the `p` of the least squares, over blocks of neighbouring points; unless adhesion pulls the
//! surfaces together there and the lowest force tells the place. `x` is the height of the piezo where there is one, for
//! a baseline runs along it, otherwise the depth. A fit then finds the contact itself; this one only says which points
//! lie before it.

use super::jump::Jump;
use crate::autoregressive::{dependence, persistence};
use crate::orthonormal_basis::{OrthonormalBasis, dot};

/// The stretch before the contact of a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BeforeContact {
    /// Number of points before the contact.
    pub points: usize,
    /// The place of the first point in contact among all points of the loading.
    pub first_in_contact: usize,
    /// Force without contact where the contact begins, N, as recorded.
    pub force: f64,
    /// Its standard error, N; neighbouring points may be correlated.
    pub force_sd: f64,
    /// Change of the force along the stretch, N/m.
    pub slope: f64,
    /// Its standard error, N/m.
    pub slope_sd: f64,
    /// Standard deviation of single forces about the line, N.
    pub noise: f64,
    /// The break, m, along the coordinate.
    pub contact: f64,
    /// The ends of the line along the coordinate, m.
    ends: [f64; 2],
}

/// Number of blocks of neighbouring points.
const BLOCKS: usize = 240;
/// Exponents of the second piece: flat punch, ball, cone.
const EXPONENTS: [f64; 3] = [1.0, 1.5, 2.0];
/// The line is fitted to the points whose distance from the break is at least this fraction of the stretch, the first
/// of these with which it is straight: the contact begins before the break, as the second piece is no exact law. Behind
/// a cantilever half as soft as the contact it begins a fifth of the stretch before.
const GUARDS: [f64; 5] = [0.1, 0.2, 0.3, 0.4, 0.5];
/// A stretch has at least so many points.
pub(super) const FEWEST_POINTS: usize = 10;
/// A stretch shows itself if it is at least this fraction of the length in contact,
const LEAST_LENGTH: f64 = 0.05;
/// or this one where it is bent, which no power law up to the fourth is with so small a slope;
const LENGTH_OF_BENT: f64 = 0.5;
/// flat: its slope below this fraction of the mean slope in contact. A cone rises by less only within a fourteenth of
/// its depth, a ball within a hundredth. A steeper stretch must fall, or rise by less than half of that slope, as a
/// punch does not, and be straight beyond doubt: the parabola added to its line, and this many standard errors of it,
/// smaller than this fraction of the line's rise. That of a ball that begins with the stretch is 0.6 of it, that of a
/// cone all of it;
const LARGEST_SLOPE: f64 = 0.15;
const STEEPEST: f64 = 0.5;
const DOUBT_ERRORS: f64 = 2.0;
const LARGEST_BEND: f64 = 0.2;
/// straight: a parabola added to its line is smaller than this many standard errors, or than the last digits,
const BEND_ERRORS: f64 = 4.0;
const DIGITS: f64 = 1e-4;
/// and if the force in contact is this many times the noise.
const LEAST_SIGNAL: f64 = 10.0;

/// What a stretch before the contact looks like.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StretchShape {
    /// A line, for certain.
    Straight,
    /// No line, but far from the contact: interference or drift.
    Bent,
    /// It may be a contact that begins gently.
    Unclear,
}

impl BeforeContact {
    /// Finds the stretch before the contact of a loading; none if there are too few points before the break.
    #[must_use]
    pub fn find(coordinate: &[f64], forces: &[f64]) -> Option<Self> {
        let (contact, first, end) = if let Some(jump) = Jump::find(coordinate, forces) {
            let end = coordinate[jump.neck.checked_sub(1)?];
            (coordinate[jump.place], jump.place, end)
        } else {
            let contact = contact(&blocks(coordinate), &blocks(forces))?;
            let first = coordinate.iter().rposition(|x| *x < contact)? + 1;
            (contact, first, contact)
        };
        let start = coordinate[..first]
            .iter()
            .copied()
            .fold(f64::INFINITY, f64::min);
        let largest = forces.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let along = |guard: &f64| {
            let end = end.min(contact - guard * (contact - start));
            Self::along(coordinate, forces, (first, contact), [start, end])
        };
        let lines: Vec<Self> = GUARDS.iter().filter_map(along).collect();
        let straight = lines
            .iter()
            .find(|line| line.is_straight(coordinate, forces, largest - line.force));
        let quietest = lines
            .iter()
            .min_by(|one, other| one.noise.total_cmp(&other.noise));
        straight.or(quietest).copied()
    }

    /// The line through the points between two distances before the contact; none if there are too few.
    #[must_use]
    pub fn between(
        self,
        coordinate: &[f64],
        forces: &[f64],
        [near, far]: [f64; 2],
    ) -> Option<Self> {
        let ends = [self.contact - far, self.contact - near];
        Self::along(
            coordinate,
            forces,
            (self.first_in_contact, self.contact),
            ends,
        )
    }

    /// The line through the points of a range before the contact.
    pub(super) fn along(
        coordinate: &[f64],
        forces: &[f64],
        (first, contact): (usize, f64),
        [start, end]: [f64; 2],
    ) -> Option<Self> {
        let pairs = coordinate[..first].iter().zip(forces);
        let inside = pairs.filter(|(x, _)| (start..=end).contains(*x));
        let (x, mut rest): (Vec<f64>, Vec<f64>) = inside.map(|(x, y)| (x - contact, *y)).unzip();
        if x.len() < FEWEST_POINTS {
            return None;
        }
        let line = OrthonormalBasis::of([vec![1.0; x.len()], x.clone()]);
        let components = line.remove_from(&mut rest);
        let [force, slope] = line.coefficients(&components)[..] else {
            return None;
        };
        let degrees = (x.len() - 2) as f64;
        let variance = dot(&rest, &rest) / degrees;
        let covariance = line.inverse_gram();
        let error =
            |k: usize| (variance * covariance[k][k] * dependence(persistence(&rest), 0.0)).sqrt();
        Some(Self {
            points: x.len(),
            first_in_contact: first,
            force,
            force_sd: error(0),
            slope,
            slope_sd: error(1),
            noise: variance.sqrt(),
            contact,
            ends: [start, end],
        })
    }

    /// What the stretch looks like: long, flat and straight enough to be told from a contact that begins gently, or
    /// not.
    #[must_use]
    pub fn shape(&self, coordinate: &[f64], forces: &[f64]) -> StretchShape {
        let before = &coordinate[..self.first_in_contact];
        let start = before.iter().copied().fold(f64::INFINITY, f64::min);
        let (mut end, mut largest) = (self.contact, f64::NEG_INFINITY);
        for (x, y) in coordinate.iter().zip(forces) {
            (end, largest) = (end.max(*x), largest.max(*y));
        }
        let rise = largest - self.force;
        let is_longer = |part: f64| self.ends[1] - start >= part * (end - self.contact);
        let is_below = |part: f64| self.slope * (end - self.contact) <= part * rise;
        let is_straight_beyond_doubt = || {
            let [bend, error] = self.bend(coordinate, forces);
            let rise = self.slope * (self.ends[1] - self.ends[0]);
            bend + DOUBT_ERRORS * error <= LARGEST_BEND * rise
        };
        let is_flat = is_below(LARGEST_SLOPE) || is_below(STEEPEST) && is_straight_beyond_doubt();
        let is_clear = rise >= LEAST_SIGNAL * self.noise;
        let is_straight = self.is_straight(coordinate, forces, rise);
        match is_straight {
            _ if !is_clear => StretchShape::Unclear,
            true if is_longer(LEAST_LENGTH) && is_flat => StretchShape::Straight,
            false if is_longer(LENGTH_OF_BENT) && is_below(LARGEST_SLOPE) => StretchShape::Bent,
            _ => StretchShape::Unclear,
        }
    }

    /// Whether the stretch is a line, but for its noise.
    fn is_straight(&self, coordinate: &[f64], forces: &[f64], rise: f64) -> bool {
        let [bend, error] = self.bend(coordinate, forces);
        bend <= f64::max(BEND_ERRORS * error, DIGITS * rise)
    }

    /// The size of a parabola added to the line, over the length of the stretch, and its standard error, N.
    fn bend(&self, coordinate: &[f64], forces: &[f64]) -> [f64; 2] {
        let [start, end] = self.ends;
        let pairs = coordinate[..self.first_in_contact].iter().zip(forces);
        let inside = pairs.filter(|(x, _)| (start..=end).contains(*x));
        let (t, mut rest): (Vec<f64>, Vec<f64>) = inside
            .map(|(x, y)| ((x - start) / (end - start), *y))
            .unzip();
        let square = t.iter().map(|t| t * t).collect();
        let parabola = OrthonormalBasis::of([vec![1.0; t.len()], t, square]);
        let components = parabola.remove_from(&mut rest);
        let coefficients = parabola.coefficients(&components);
        let variance = dot(&rest, &rest) / (rest.len() as f64 - 3.0).max(1.0);
        let error =
            (variance * parabola.inverse_gram()[2][2] * dependence(persistence(&rest), 0.0)).sqrt();
        [coefficients.get(2).map_or(0.0, |bend| bend.abs()), error]
    }

    /// The force of the line at a coordinate, N.
    #[must_use]
    pub fn force_at(&self, coordinate: f64) -> f64 {
        self.force + self.slope * (coordinate - self.contact)
    }
}

/// The break of a curve in two pieces; none if its second piece does not rise.
fn contact(x: &[f64], y: &[f64]) -> Option<f64> {
    let last = x.len().checked_sub(3)?;
    let misfit = |c: f64, exponent: f64| {
        let law = x.iter().map(|x| (x - c).max(0.0).powf(exponent)).collect();
        let basis = OrthonormalBasis::of([vec![1.0; x.len()], x.to_vec(), law]);
        let mut rest = y.to_vec();
        let components = basis.remove_from(&mut rest);
        let rises = basis.coefficients(&components)[2] > 0.0;
        if rises {
            dot(&rest, &rest)
        } else {
            f64::INFINITY
        }
    };
    let candidates = EXPONENTS
        .iter()
        .flat_map(|p| x[..last].iter().map(move |c| (*c, *p)));
    let judged = candidates.map(|(c, p)| (misfit(c, p), c));
    let (least, c) = judged.min_by(|(one, _), (other, _)| one.total_cmp(other))?;
    least.is_finite().then_some(c)
}

/// Means of neighbouring points.
fn blocks(values: &[f64]) -> Vec<f64> {
    let size = values.len().div_ceil(BLOCKS).max(1);
    let mean = |block: &[f64]| block.iter().sum::<f64>() / block.len() as f64;
    values.chunks(size).map(mean).collect()
}

#[cfg(test)]
mod tests {
    use super::super::baseline::is_pull_off;
    use super::*;

    fn is_shown(found: &BeforeContact, x: &[f64], y: &[f64]) -> bool {
        found.shape(x, y) == StretchShape::Straight
    }

    /// Forces of a law from a contact at 1 on, over 400 depths up to `end`, with a ripple for noise.
    fn approach(end: f64, exponent: f64, [offset, slope, ripple]: [f64; 3]) -> [Vec<f64>; 2] {
        let depths: Vec<f64> = (0..400).map(|i| end * f64::from(i) / 400.0).collect();
        let force = |(i, x): (usize, &f64)| {
            let noise = ripple * (2.4 * i as f64).sin();
            offset + slope * x + noise + (x - 1.0).max(0.0).powf(exponent)
        };
        let forces = depths.iter().enumerate().map(force).collect();
        [depths, forces]
    }

    #[test]
    fn the_line_before_the_contact_is_found_with_its_offset_slope_and_noise() {
        for exponent in [1.0, 1.3, 1.5, 2.0] {
            let [x, y] = approach(2.0, exponent, [-3.0, 0.05, 0.02]);
            let found = BeforeContact::find(&x, &y).unwrap();
            assert!(is_shown(&found, &x, &y), "{exponent}");
            assert!(
                (found.contact - 1.0).abs() < 0.08,
                "{exponent}: {}",
                found.contact
            );
            assert!(
                (found.force_at(1.0) + 2.95).abs() < 0.01,
                "{exponent}: {}",
                found.force
            );
            assert!((found.slope - 0.05).abs() < 4.0 * found.slope_sd + 1e-3);
            // The root mean square of a sine.
            assert!((found.noise / (0.02 / 2.0_f64.sqrt()) - 1.0).abs() < 0.1);
        }
    }

    #[test]
    fn a_curve_begun_in_contact_shows_no_stretch() {
        // A cubic under a ripple of a hundredth would pass: its first quarter is a line within that.
        for (exponent, most) in [(1.0, 0.02), (1.5, 0.02), (2.0, 0.02), (3.0, 1e-3)] {
            for ripple in [0.0, 1e-3, 1e-2, 0.02]
                .into_iter()
                .filter(|ripple| *ripple <= most)
            {
                let x: Vec<f64> = (0..300).map(|i| f64::from(i) / 300.0).collect();
                let law =
                    |(i, x): (usize, &f64)| x.powf(exponent) + ripple * (2.4 * i as f64).sin();
                let y: Vec<f64> = x.iter().enumerate().map(law).collect();
                let found = BeforeContact::find(&x, &y);
                let shown = found.is_some_and(|found| is_shown(&found, &x, &y));
                assert!(!shown, "{exponent} {ripple}: {found:?}");
            }
        }
    }

    #[test]
    fn a_neck_that_stretches_over_most_of_the_rows_is_no_stretch_before_the_contact() {
        // From the end of a retraction: 40 rows without contact, a neck of 60 rows down to the pull-off, the contact.
        let force = |i: i32| match i {
            ..40 => 0.0,
            40..100 => -0.4 - 0.01 * f64::from(i - 40),
            _ => -1.0 + 0.05 * f64::from(i - 99),
        };
        let ripple = |i: i32| 0.01 * (2.4 * f64::from(i)).sin();
        let x: Vec<f64> = (0..200).map(f64::from).collect();
        let y: Vec<f64> = (0..200).map(|i| force(i) + ripple(i)).collect();
        let found = BeforeContact::find(&x, &y).unwrap();
        assert_eq!(found.first_in_contact, 40);
        assert!(found.force.abs() < 0.01 && found.noise < 0.02, "{found:?}");
    }

    #[test]
    fn a_neck_within_the_nearer_half_of_the_rows_belongs_to_no_line() {
        // From the end of a retraction: 150 rows without contact, a neck of 28 rows, the contact. A line that takes a
        // few rows of the neck in has correlated residuals, which excuse its bend.
        let force = |i: i32| match i {
            ..150 => 0.0,
            150..178 => -7.5 + 4.0 * (f64::from(178 - i) / 28.0).powi(2),
            _ => -7.5 + 0.16 * f64::from(i - 177),
        };
        let ripple = |i: i32| 0.2 * (2.4 * f64::from(i)).sin();
        let x: Vec<f64> = (0..400).map(f64::from).collect();
        let y: Vec<f64> = (0..400).map(|i| force(i) + ripple(i)).collect();
        let found = BeforeContact::find(&x, &y).unwrap();
        assert!((177..182).contains(&found.first_in_contact), "{found:?}");
        // The root mean square of a sine.
        assert!(
            (found.noise / (0.2 / 2.0_f64.sqrt()) - 1.0).abs() < 0.1,
            "{found:?}"
        );
        assert!(is_shown(&found, &x, &y) && is_pull_off(7.5, found.noise, 28.0));
    }

    #[test]
    fn a_line_that_falls_towards_the_contact_is_no_pull_off() {
        // By 3 to 30 % of the largest force over the stretch: the lowest force is the last one before the contact.
        for slope in [-0.03, -0.1, -0.3] {
            let [x, y] = approach(2.0, 1.5, [1.0, slope, 0.002]);
            let found = BeforeContact::find(&x, &y).unwrap();
            assert!(is_shown(&found, &x, &y), "{slope}");
            assert!((found.contact - 1.0).abs() < 0.08, "{slope}: {found:?}");
            assert!((found.slope - slope).abs() < 4.0 * found.slope_sd + 1e-3);
        }
    }

    #[test]
    fn a_steep_line_shows_itself_if_it_is_straight_beyond_doubt() {
        // A tenth to four tenths of the mean slope of the contact.
        for (slope, ripple, wanted) in [
            (0.1, 0.02, true),
            (0.2, 1e-3, true),
            (0.4, 1e-3, true),
            (0.2, 0.1, false),
        ] {
            let [x, y] = approach(2.0, 1.5, [1.0, slope, ripple]);
            let found = BeforeContact::find(&x, &y).unwrap();
            assert_eq!(is_shown(&found, &x, &y), wanted, "{slope} {ripple}");
        }
    }

    #[test]
    fn a_range_before_the_contact_can_be_chosen() {
        let [x, y] = approach(2.0, 1.5, [1.0, 0.0, 0.01]);
        let found = BeforeContact::find(&x, &y).unwrap();
        let chosen = found.between(&x, &y, [0.2, 0.5]).unwrap();
        assert!((chosen.points as f64 - 60.0).abs() <= 2.0);
        assert!((chosen.force - 1.0).abs() < 0.01);
        assert!(found.between(&x, &y, [2.0, 3.0]).is_none());
    }
}
