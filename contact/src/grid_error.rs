//! How far the grid can be trusted: the change of each number from level to level, extrapolated.
//!
//! A number that converges like `q_h = q + c hᵒ` has on three levels, each with half the element of the one
//! before, `o = log₂((q₂ − q₁)/(q₃ − q₂))`, and the error of the last is about `|q₃ − q₂|/(2ᵒ − 1)` (Richardson).

/// The values on one grid level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LevelValues {
    /// Elements per side.
    pub elements: usize,
    /// Penetration, in m.
    pub penetration: f64,
    /// Contact area, in m².
    pub contact_area: f64,
    /// Largest pressure, in Pa.
    pub max_pressure: f64,
}

/// The estimated error of one number on the finest grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Estimated error, in the unit of the number itself.
    pub estimate: f64,
    /// Observed order of convergence in the element's side; none from two levels, or where changes grow.
    pub order: Option<f64>,
    /// Whether the changes shrink from level to level, so that the estimate means something.
    pub resolved: bool,
}

/// The estimated errors of the penetration, the contact area and the largest pressure; none from one level.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct GridError {
    /// Of the penetration, in m.
    pub penetration: Option<Estimate>,
    /// Of the contact area, in m².
    pub contact_area: Option<Estimate>,
    /// Of the largest pressure, in Pa. Not resolved for a peak at an edge, which grows without end.
    pub max_pressure: Option<Estimate>,
    /// What the estimates are made of, coarsest level first.
    pub levels: Vec<LevelValues>,
}

/// Below this order the changes do not shrink fast enough to call a number resolved: at 0.5 the estimate is
/// 2.4 times the last change.
const LOWEST_RESOLVED_ORDER: f64 = 0.5;
/// Piecewise constant pressure converges at most with this order, so more is luck and is not extrapolated.
const HIGHEST_ORDER: f64 = 2.0;

impl GridError {
    /// Estimates from the values on all levels, coarsest first.
    #[must_use]
    pub fn new(levels: Vec<LevelValues>) -> Self {
        let of = |value: fn(&LevelValues) -> f64| estimate(&levels, value);
        Self {
            penetration: of(|level| level.penetration),
            contact_area: of(|level| level.contact_area),
            max_pressure: of(|level| level.max_pressure),
            levels,
        }
    }
}

/// The estimate of one number from the last two or three levels.
fn estimate(levels: &[LevelValues], value: fn(&LevelValues) -> f64) -> Option<Estimate> {
    let [.., before, last] = levels else {
        return None;
    };
    let change = (value(last) - value(before)).abs();
    let [.., first, _, _] = levels else {
        // Two levels show a change, not how it shrinks: first order is assumed, and nothing called resolved.
        return Some(Estimate {
            estimate: change,
            order: None,
            resolved: false,
        });
    };
    let change_before = (value(before) - value(first)).abs();
    if change == 0.0 && change_before == 0.0 {
        return Some(Estimate {
            estimate: 0.0,
            order: None,
            resolved: true,
        });
    }
    let ratio = last.elements as f64 / before.elements as f64;
    // o = ln(change before / change) / ln(ratio)
    let order = (change_before / change).ln() / ratio.ln();
    if order.is_nan() || order < LOWEST_RESOLVED_ORDER {
        return Some(Estimate {
            estimate: change,
            order: Some(order).filter(|o| o.is_finite()),
            resolved: false,
        });
    }
    // A change smaller than the highest order explains is luck: what that order predicts is used instead.
    let believed = order.min(HIGHEST_ORDER);
    let estimate = change_before / ratio.powf(believed) / (ratio.powf(believed) - 1.0);
    Some(Estimate {
        estimate,
        order: Some(order).filter(|o| o.is_finite()),
        resolved: true,
    })
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    fn levels(values: &[f64]) -> Vec<LevelValues> {
        (0..values.len())
            .map(|l| LevelValues {
                elements: 32 << l,
                penetration: values[l],
                contact_area: values[l],
                max_pressure: values[l],
            })
            .collect()
    }

    #[test]
    fn a_number_that_converges_with_order_one_has_its_error_estimated_exactly() {
        let error = GridError::new(levels(&[1.4, 1.2, 1.1]))
            .penetration
            .unwrap();
        assert_relative_eq!(error.estimate, 0.1, max_relative = 1e-12);
        assert_relative_eq!(error.order.unwrap(), 1.0, max_relative = 1e-12);
        assert!(error.resolved);
    }

    #[test]
    fn a_change_that_vanishes_by_luck_is_not_taken_for_an_error_that_vanishes() {
        let error = GridError::new(levels(&[1.0, 1.4, 1.4]))
            .penetration
            .unwrap();
        // Second order at best: 0.4/4/3.
        assert_relative_eq!(error.estimate, 0.4 / 12.0, max_relative = 1e-12);
    }

    #[test]
    fn a_peak_that_grows_with_the_grid_is_not_resolved() {
        assert!(
            !GridError::new(levels(&[1.0, 1.4, 2.0]))
                .max_pressure
                .unwrap()
                .resolved
        );
    }

    #[test]
    fn one_level_says_nothing_and_two_resolve_nothing() {
        assert!(GridError::new(levels(&[1.0])).penetration.is_none());
        assert!(
            !GridError::new(levels(&[1.0, 1.1]))
                .penetration
                .unwrap()
                .resolved
        );
    }
}
