//! The depths of planes if a case gives none.

use std::f64::consts::PI;

/// Number of steps from the surface to the deepest plane in a body without layers.
const PLANES: f64 = 32.0;

/// Smallest number of steps from one interface to the next.
const MIN_STEPS: f64 = 8.0;

/// The uniform part of the spacing: without it the first plane below an interface would be much closer than the side of
/// any element.
const EVEN: f64 = 0.2;

/// Returns increasing depths from the surface to `deepest` (m), including the interfaces at `bottoms` that lie above
/// it.
///
/// Between two interfaces they are spaced like the extremes of a Chebyshev polynomial, denser at both ends, and evened
/// out a little. Below the last interface they are spaced like the upper half of those, denser at the top.
#[must_use]
pub fn chosen(bottoms: &[f64], deepest: f64) -> Vec<f64> {
    let within = bottoms.iter().copied().filter(|bottom| *bottom < deepest);
    let mut tops = vec![0.0];
    tops.extend(within);
    let mut depths = Vec::new();
    let parts = tops.len();
    for (i, top) in tops.iter().copied().enumerate() {
        let bottom = tops.get(i + 1).copied().unwrap_or(deepest);
        let thickness = bottom - top;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "between 8 and 32"
        )]
        let steps = (PLANES * thickness / deepest).round().max(MIN_STEPS) as usize;
        // The lower end of the last part is not an interface, so depths need not be dense there.
        let turn = if i + 1 == parts && bottoms.last() != Some(&deepest) {
            0.5
        } else {
            1.0
        };
        let at = |step: usize| {
            let part = step as f64 / steps as f64;
            let dense = (1.0 - (PI * turn * part).cos()) / (1.0 - (PI * turn).cos());
            top + thickness * (EVEN * part + (1.0 - EVEN) * dense)
        };
        depths.extend((0..steps).map(at));
    }
    depths.push(deepest);
    depths
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn depths_increase_from_the_surface_to_the_deepest_and_include_every_interface_above_it() {
        for (bottoms, deepest) in [
            (&[][..], 2.0),
            (&[0.01], 2.0),
            (&[0.5, 0.6, 3.0], 2.0),
            (&[0.5, 2.0], 2.0),
        ] {
            let depths = chosen(bottoms, deepest);
            assert_eq!((depths[0], depths[depths.len() - 1]), (0.0, deepest));
            assert!(
                depths.is_sorted_by(|above, below| above < below),
                "{depths:?}"
            );
            assert!((32..55).contains(&depths.len()), "{}", depths.len());
            for bottom in bottoms.iter().filter(|bottom| **bottom <= deepest) {
                assert!(depths.contains(bottom), "{bottom} in {depths:?}");
            }
        }
    }

    #[test]
    fn depths_are_denser_near_the_surface_and_interfaces() {
        let depths = chosen(&[0.5], 2.0);
        let steps: Vec<_> = depths.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let interface = depths.iter().position(|depth| *depth == 0.5).unwrap();
        let middle = steps[interface / 2];
        for at in [0, interface - 1, interface] {
            assert!(steps[at] < 0.5 * middle, "{at}: {steps:?}");
        }
        // The steps only grow towards the deepest plane.
        assert!(steps[interface..].is_sorted(), "{steps:?}");
    }
}
