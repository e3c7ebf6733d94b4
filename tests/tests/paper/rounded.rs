//! What rounded edges of the cylinders do to the largest pressure of Fig. 2(a).

use super::cases::{PaperCase, only_step};
use super::numbers::{assert_reads, exponent};

#[test]
fn the_largest_pressure_of_2a_settles_once_the_edges_of_the_cylinders_are_round() {
    for (percent, found) in [
        (0, &["0.2451", "0.2638"][..]),
        (50, &["0.2371", "0.2359"]),
        (100, &["0.2280", "0.2287", "0.2280"]),
    ] {
        let mut peaks = Vec::new();
        for (elements, written) in [512, 1024, 2048].into_iter().zip(found) {
            let step = only_step(PaperCase::Rounded(percent), elements);
            assert_reads(step.summary.max_pressure, written);
            peaks.push((elements, step.summary.max_pressure));
            // Only the finest grid has elements much shorter than the arc.
            let error = step.grid_error.max_pressure.expect("an error");
            assert_eq!(error.resolved, elements == 2048);
        }
        let grows = exponent(peaks[0], peaks[1]);
        if percent == 0 {
            assert!(grows > 0.1, "{grows}");
        } else {
            assert!(grows.abs() < 0.01, "{grows}");
        }
    }
    let step = only_step(PaperCase::Rounded(100), 2048);
    let error = step.grid_error.max_pressure.expect("an error");
    for elements in [512, 1024] {
        let coarse = only_step(PaperCase::Rounded(100), elements);
        let off = coarse.summary.max_pressure - step.summary.max_pressure;
        assert!(
            off.abs() <= error.estimate,
            "{elements}: {off:e}, {error:?}"
        );
    }
    assert!(error.estimate < 0.01 * step.summary.max_pressure);
}
