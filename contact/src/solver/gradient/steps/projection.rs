//! The Euclidean projection onto the admissible pressures.

use crate::solver::gradient::load_control::LoadControl;
use crate::vector::{by_parts, each, sum};

/// Replaces `x`, a value for each element that may press, by the nearest pressure `p ≥ 0` that satisfies the load
/// control: `p = max(x − θ, 0)`, where `θ` gives the prescribed total (0 where none is prescribed).
///
/// `θ` is the root of a convex, piecewise linear, falling function; Newton's method from below reaches it in a finite
/// number of steps (Michelot 1986).
pub fn project(control: LoadControl, x: &mut [f64]) {
    let theta = match control {
        LoadControl::Total(total) => shift_to_total(x, total),
        LoadControl::Penetration(_) => 0.0,
    };
    each(x, |value| *value = (*value - theta).max(0.0));
    control.rescale(x);
}

/// The `θ` with `Σ max(x − θ, 0) = total`.
fn shift_to_total(x: &[f64], total: f64) -> f64 {
    let mut theta = (sum(x) - total) / x.len() as f64;
    loop {
        let parts = by_parts(x.len(), |part| {
            let above = x[part].iter().filter(|value| **value > theta);
            above.fold((0, 0.0), |(count, sum), value| (count + 1, sum + value))
        });
        let (count, above) = parts
            .iter()
            .fold((0_usize, 0.0), |all, part| (all.0 + part.0, all.1 + part.1));
        let next = (above - total) / count as f64;
        // Strictly increasing until the set above θ is unchanged; rounding may then decrease it.
        if count == 0 || next <= theta {
            return theta;
        }
        theta = next;
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    #[test]
    fn a_point_projects_onto_the_simplex_where_its_optimality_conditions_hold() {
        let x = [0.9, -0.4, 0.25, 0.7, 0.05];
        let mut p = x;
        project(LoadControl::Total(1.0), &mut p);
        assert_relative_eq!(p.iter().sum::<f64>(), 1.0, max_relative = 1e-15);
        // x − p is the same θ wherever p > 0, and x ≤ θ elsewhere.
        let theta = x[0] - p[0];
        for (x, p) in x.iter().zip(&p) {
            if *p > 0.0 {
                assert_relative_eq!(x - p, theta, max_relative = 1e-14);
            } else {
                assert!(*x <= theta);
            }
        }
    }

    #[test]
    fn pressures_short_of_the_total_are_raised_everywhere() {
        let mut x = [0.1, 0.2, -0.3];
        project(LoadControl::Total(9.0), &mut x);
        // θ = (0 − 9)/3
        for (found, wanted) in x.iter().zip([3.1, 3.2, 2.7]) {
            assert_relative_eq!(*found, wanted, max_relative = 1e-14);
        }
    }
}
