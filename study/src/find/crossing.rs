//! Where a function crosses zero: Chandrupatla's method, whose bracket shrinks on both sides.
//!
//! `T. R. Chandrupatla, Advances in Engineering Software 28, 145 (1997)`: a step is inverse quadratic interpolation
//! through the last three points where that is safe, else bisection. The first step here is that of the secant: in
//! logarithms many results are straight lines, and the next point is then the answer. A value that stays at zero, as an
//! area before any contact, leads nowhere: its bracket is halved. On which side of zero a zero counts, its sign says.

/// A point of the function: its argument and its value.
pub type Point = (f64, f64);

/// A bracket of a crossing.
#[derive(Debug, Clone, Copy)]
pub struct Bracket {
    /// The newest point.
    newest: Point,
    /// The point on the other side of zero.
    other: Point,
    /// The point that the newest replaced, if any.
    previous: Option<Point>,
}

impl Bracket {
    /// Returns a bracket of two points, none if their values are on the same side of zero.
    #[must_use]
    pub fn new(first: Point, second: Point) -> Option<Self> {
        (is_below(first) != is_below(second)).then_some(Self {
            newest: first,
            other: second,
            previous: None,
        })
    }

    /// The two points, that below zero first.
    #[must_use]
    pub fn sides(&self) -> [Point; 2] {
        if is_below(self.newest) {
            [self.newest, self.other]
        } else {
            [self.other, self.newest]
        }
    }

    /// The crossing, on the straight line between the two points.
    #[must_use]
    pub fn crossing(&self) -> f64 {
        let [(a, below), (b, above)] = self.sides();
        between([a, b], [below, above])
    }

    /// The arguments at its ends, the smaller first.
    #[must_use]
    pub fn ends(&self) -> [f64; 2] {
        let [(a, _), (b, _)] = self.sides();
        [a.min(b), a.max(b)]
    }

    /// Returns the next argument to try; none if the bracket is not wider than `width`.
    ///
    /// A step is at least half of `width` long: a try near the crossing is followed by one just behind it.
    #[must_use]
    pub fn next(&self, width: f64) -> Option<f64> {
        let ((a, _), (b, _)) = (self.newest, self.other);
        let least = 0.5 * width / (b - a).abs();
        if least >= 0.5 {
            return None;
        }
        let share = self.share().clamp(least, 1.0 - least);
        Some(a + share * (b - a))
    }

    /// The place of the next argument: 0 at the newest point, 1 at the other.
    fn share(&self) -> f64 {
        let ((a, at_a), (b, at_b)) = (self.newest, self.other);
        // A zero that the next point did not leave is no crossing of a line.
        let stays_at_zero = at_b.abs() <= 0.0 || self.previous.is_none() && at_a.abs() <= 0.0;
        if at_a.is_infinite() || at_b.is_infinite() || stays_at_zero {
            return 0.5;
        }
        let Some((c, at_c)) = self.previous else {
            return at_a / (at_a - at_b);
        };
        let (xi, phi) = ((a - b) / (c - b), (at_a - at_b) / (at_c - at_b));
        // Inverse quadratic interpolation is monotonic between a and b.
        if phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi {
            at_a / (at_b - at_a) * at_c / (at_b - at_c)
                + (c - a) / (b - a) * at_a / (at_c - at_a) * at_b / (at_c - at_b)
        } else {
            0.5
        }
    }

    /// Adds the value at the argument that was asked for.
    pub fn add(&mut self, point: Point) {
        if is_below(point) == is_below(self.newest) {
            self.previous = Some(self.newest);
        } else {
            self.previous = Some(self.other);
            self.other = self.newest;
        }
        self.newest = point;
    }
}

fn is_below((_, value): Point) -> bool {
    value.is_sign_negative()
}

/// The zero of the straight line through two points.
#[must_use]
pub fn between([a, b]: [f64; 2], [at_a, at_b]: [f64; 2]) -> f64 {
    let share = at_a / (at_a - at_b);
    a + if share.is_finite() {
        share.clamp(0.0, 1.0)
    } else {
        0.5
    } * (b - a)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The width of the final bracket, the crossing, and the number of values after those of the ends.
    fn crossing(of: impl Fn(f64) -> f64, ends: [f64; 2]) -> (f64, f64, usize) {
        let [a, b] = ends.map(|end| (end, of(end)));
        let mut bracket = Bracket::new(a, b).expect("a crossing");
        let mut count = 0;
        while let Some(next) = bracket.next(1e-3) {
            bracket.add((next, of(next)));
            count += 1;
        }
        let [(low, _), (high, _)] = bracket.sides();
        ((high - low).abs(), bracket.crossing(), count)
    }

    #[test]
    fn a_straight_line_takes_two_values_and_smooth_curves_a_few() {
        let (width, zero, count) = crossing(|x| x / 3.0 - 0.4, [-2.3, 2.3]);
        assert!(width <= 1e-3 && (zero - 1.2).abs() < 1e-12);
        assert_eq!(count, 2);
        let (width, zero, count) = crossing(|x| x.exp() - 5.0, [-2.3, 2.3]);
        // The curvature over the width of the final bracket.
        assert!(width <= 1e-3 && (zero - 5.0_f64.ln()).abs() < 1e-6);
        assert!(count <= 6, "{count}");
    }

    #[test]
    fn a_jump_takes_hardly_more_values_than_bisection() {
        let (width, zero, count) = crossing(|x| if x < 1.234 { -1e-6 } else { 5.0 }, [-2.3, 2.3]);
        assert!(width <= 1e-3 && (zero - 1.234).abs() < 1e-3);
        // log₂(4.6/10⁻³) = 12.2
        assert!(count <= 18, "{count}");
    }

    #[test]
    fn a_function_that_leaves_zero_is_bracketed_by_bisection() {
        let of = |x: f64| if x < 1.234 { -0.0 } else { x - 1.0 };
        let (width, zero, count) = crossing(of, [-2.3, 2.3]);
        assert!(width <= 1e-3 && (zero - 1.234).abs() < 1e-3);
        // log₂(4.6/10⁻³) = 12.2
        assert!(count <= 13, "{count}");
        let of = |x: f64| if x > 1.234 { 0.0 } else { x - 2.0 };
        let (width, zero, count) = crossing(of, [-2.3, 2.3]);
        assert!(width <= 1e-3 && (zero - 1.234).abs() < 1e-3 && count <= 13);
    }

    #[test]
    fn infinite_numbers_are_halved_away() {
        // A critical force that is above all loads from a value on.
        let of = |x: f64| if x < 1.234 { x - 2.0 } else { f64::INFINITY };
        let (width, zero, count) = crossing(of, [-2.3, 2.3]);
        assert!(width <= 1e-3 && (zero - 1.234).abs() < 1e-3);
        assert!(count <= 13, "{count}");
    }

    #[test]
    fn ends_on_the_same_side_are_no_bracket() {
        assert!(Bracket::new((0.0, 1.0), (1.0, 2.0)).is_none());
    }
}
