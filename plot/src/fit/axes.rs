//! Axes for measured values, with SI prefixes.

use pellicle::display::DisplayUnit;

use crate::axes::labels;
use crate::axes::panel::Axis;

/// Margin beyond the extreme values, as a fraction of their distance.
const MARGIN: f64 = 0.05;

/// Ratio of the largest to the smallest value above which an axis is logarithmic.
const DECADES: f64 = 50.0;

/// The same for an unknown fitted by its logarithm: on a linear axis its likelihood is crowded at small values.
const FACTOR: f64 = 5.0;

/// Returns the least and the largest finite value; `None` if there is none.
#[must_use]
pub fn ends(values: impl IntoIterator<Item = f64>) -> Option<[f64; 2]> {
    let finite = values.into_iter().filter(|value| value.is_finite());
    let both = finite.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
        [low.min(value), high.max(value)]
    });
    (both[0] <= both[1]).then_some(both)
}

/// Whether values are positive and so far apart that small ones would vanish on a linear axis.
#[must_use]
pub fn suits_logarithms([low, high]: [f64; 2]) -> bool {
    low > 0.0 && high >= DECADES * low
}

/// Returns a linear axis for values in this range, in the unit of the scale, with a margin.
#[must_use]
pub fn linear([low, high]: [f64; 2], scale: &DisplayUnit, quantity: &str, count: usize) -> Axis {
    let [low, high] = [low, high].map(|value| value / scale.divisor);
    let length = if high > low {
        high - low
    } else {
        high.abs().max(1e-300)
    };
    let (from, to) = (low - MARGIN * length, high + MARGIN * length);
    Axis::new(from, to, title(quantity, scale), count)
}

/// Returns a logarithmic axis for values in this range, in the unit of the scale.
#[must_use]
pub fn logarithmic([low, high]: [f64; 2], scale: &DisplayUnit, quantity: &str) -> Axis {
    let [low, high] = [low, high].map(|value| value / scale.divisor);
    Axis::logarithmic(low, high, title(quantity, scale))
}

/// Returns an axis for an unknown fitted by its logarithm: logarithmic as soon as its values differ by a moderate
/// factor.
#[must_use]
pub fn of_unknown(
    [low, high]: [f64; 2],
    scale: &DisplayUnit,
    quantity: &str,
    count: usize,
) -> Axis {
    if low > 0.0 && high >= FACTOR * low {
        logarithmic([low, high], scale, quantity)
    } else {
        linear([low, high], scale, quantity, count)
    }
}

/// Returns the quantity with its unit, if it has one.
#[must_use]
pub fn title(quantity: &str, scale: &DisplayUnit) -> String {
    match scale.label.as_str() {
        "" => quantity.to_owned(),
        unit => labels::axis_title(quantity, unit),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_ignore_values_that_are_not_finite() {
        assert_eq!(
            ends([2.0, f64::NAN, -1.0, f64::INFINITY]),
            Some([-1.0, 2.0])
        );
        assert_eq!(ends([f64::NAN]), None);
    }

    #[test]
    fn an_axis_contains_its_values_and_names_its_unit_if_any() {
        let scale = DisplayUnit {
            divisor: 1e-9,
            label: "nm".into(),
        };
        let axis = linear([1e-9, 5e-9], &scale, "depth", 5);
        assert!(axis.from < 1.0 && axis.to > 5.0, "{axis:?}");
        assert_eq!(axis.title, "depth, nm");
        let none = DisplayUnit {
            divisor: 1.0,
            label: String::new(),
        };
        assert_eq!(title("ratio", &none), "ratio");
    }
}
