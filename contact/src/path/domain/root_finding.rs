//! The zero of an increasing function of a length, independent of the unit of length.

/// Most evaluations of a search; a smooth function takes about twenty.
const LONGEST_SEARCH: usize = 400;
/// Relative accuracy at which the search ends: rounding, so that the length is the same in another unit.
const PRECISION: f64 = 1e-14;

/// The zero of a function that grows nearly in proportion to the logarithm of its argument; it may be infinite on
/// either side.
///
/// Returns 0 if the function is positive down to the smallest length, and the largest length if it is negative
/// everywhere.
pub fn where_zero(value: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = bracket(&value);
    // The values at the two ends; that of a retained end is halved: the Illinois form of the secant method (Dowell and
    // Jarratt 1971).
    let (mut below, mut above) = (value(low), value(high));
    let mut kept = 0_i32;
    for _ in 0..LONGEST_SEARCH {
        if high - low <= PRECISION * high || low == 0.0 {
            break;
        }
        let middle = between(low, high, below, above);
        let found = value(middle);
        if found >= 0.0 {
            (high, above) = (middle, found);
            kept = kept.max(0) + 1;
            if kept > 1 {
                below *= 0.5;
            }
        } else {
            (low, below) = (middle, found);
            kept = kept.min(0) - 1;
            if kept < -1 {
                above *= 0.5;
            }
        }
    }
    high
}

/// Lengths on either side of the zero, found with increasing factors.
fn bracket(value: &impl Fn(f64) -> f64) -> (f64, f64) {
    let (mut length, mut factor) = (1.0_f64, 2.0_f64);
    let is_reached = value(length) >= 0.0;
    loop {
        let next = if is_reached {
            length / factor
        } else {
            length * factor
        };
        if next < f64::MIN_POSITIVE || next.is_infinite() {
            return if is_reached {
                (0.0, length)
            } else {
                (length, length)
            };
        }
        if (value(next) >= 0.0) != is_reached {
            return (length.min(next), length.max(next));
        }
        (length, factor) = (next, factor * factor);
    }
}

/// The zero of a straight line over the logarithm; the geometric mean if there is no line or it leads to an end.
fn between(low: f64, high: f64, below: f64, above: f64) -> f64 {
    let ratio = high / low;
    let part = below / (below - above);
    let middle = low * ratio.powf(part);
    if below.is_finite() && above.is_finite() && middle > low && middle < high {
        middle
    } else {
        low * ratio.sqrt()
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::where_zero;

    #[test]
    fn the_root_of_a_power_law_is_found_in_any_unit_in_few_evaluations() {
        for exponent in [-150, -30, -6, 0, 3, 150] {
            for power in [0.5, 1.0, 3.0] {
                let wanted = 1.7 * 10.0_f64.powi(exponent);
                let evaluations = Cell::new(0);
                let found = where_zero(|length| {
                    evaluations.set(evaluations.get() + 1);
                    power * (length / wanted).ln()
                });
                assert!((found / wanted - 1.0).abs() < 1e-13, "{found:e}");
                assert!(evaluations.get() < 60, "{}", evaluations.get());
            }
        }
    }

    #[test]
    fn halving_the_retained_end_finds_the_root_of_a_curved_function_in_few_evaluations() {
        // ln of a sum of powers, the sinh of a logarithm, and a function that is flat on one side.
        let functions: [fn(f64) -> f64; 3] = [
            |rho| (0.5 * rho.powi(2) + 5e5 * rho.powi(9)).ln(),
            |rho| rho.ln().sinh() + 2.0,
            |rho| (rho / 3e4).ln().exp() - 1.0,
        ];
        let counts = functions.map(|of| {
            let evaluations = Cell::new(0);
            where_zero(|length| {
                evaluations.set(evaluations.get() + 1);
                of(length)
            });
            evaluations.get()
        });
        // As measured, plus two that rounding may add.
        let most = [25, 16, 18];
        assert!(
            counts.iter().zip(most).all(|(count, most)| *count <= most),
            "{counts:?}"
        );
    }

    #[test]
    fn roots_at_a_jump_and_of_a_curved_function_are_found() {
        let step = |length: f64| {
            if length <= 3e-6 {
                f64::NEG_INFINITY
            } else {
                f64::INFINITY
            }
        };
        assert!((where_zero(step) / 3e-6 - 1.0).abs() < 1e-13);
        // ln of ρ² + 1e6 ρ⁹ at 2
        let polynomial = |rho: f64| (0.5 * rho.powi(2) + 5e5 * rho.powi(9)).ln();
        let found = where_zero(polynomial);
        assert!(polynomial(found).abs() < 1e-12, "{found}");
    }

    #[test]
    fn a_function_without_a_root_ends_the_search() {
        assert!(where_zero(|_| -1.0) > 1e150);
        assert!(where_zero(|_| 1.0) < 1e-150);
    }
}
