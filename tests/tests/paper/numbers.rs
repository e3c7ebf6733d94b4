//! Numbers as written on the page, with as many digits as it gives.

/// Fractions below this are written as `0 %`: solutions are certified to 1e-8.
const ZERO_BELOW: f64 = 1e-7;
/// Half a unit of the last digit, and a little more for two solutions that differ by their certificates.
const ROUNDING: f64 = 0.51;

/// Asserts that a number rounds to the written one: `0.2397`, `2.0181e-4`, or `98.8 %` for a fraction.
pub fn assert_reads(found: f64, written: &str) {
    if written == "0 %" {
        assert!(found.abs() < ZERO_BELOW, "{found:e} for 0 %");
        return;
    }
    let (digits, scale) = written
        .strip_suffix(" %")
        .map_or((written, 1.0), |digits| (digits, 100.0));
    let (mantissa, exponent) = digits.split_once('e').unwrap_or((digits, "0"));
    let decimals = mantissa.split_once('.').map_or(0, |(_, after)| after.len());
    let exponent: i32 = exponent.parse().expect("an exponent");
    let unit = 10.0_f64.powi(exponent - i32::try_from(decimals).expect("a few digits"));
    let wanted: f64 = digits.parse().expect("a number");
    let found = found * scale;
    let off = (found - wanted).abs() / unit;
    assert!(off <= ROUNDING, "{found} for {written}");
}

/// The exponent m of `p ~ N^m` between two grids.
pub fn exponent(coarse: (usize, f64), fine: (usize, f64)) -> f64 {
    (fine.1 / coarse.1).ln() / (fine.0 as f64 / coarse.0 as f64).ln()
}

/// The exponent that fits several grids best, by least squares of the logarithms.
pub fn fitted_exponent(peaks: &[(usize, f64)]) -> f64 {
    let points: Vec<[f64; 2]> = peaks
        .iter()
        .map(|&(n, p)| [(n as f64).ln(), p.ln()])
        .collect();
    let count = points.len() as f64;
    let mean = [0, 1].map(|k| points.iter().map(|point| point[k]).sum::<f64>() / count);
    let sum = |of: &dyn Fn(f64, f64) -> f64| -> f64 {
        points
            .iter()
            .map(|[x, y]| of(x - mean[0], y - mean[1]))
            .sum()
    };
    sum(&|x, y| x * y) / sum(&|x, _| x * x)
}

#[test]
fn a_number_is_compared_by_its_printed_digits() {
    for (found, written) in [
        (0.011_084_9, "1.11 %"),
        (1.0, "100 %"),
        (2.018_1e-4, "2.0181e-4"),
        (-3e-16, "0 %"),
    ] {
        assert_reads(found, written);
    }
    for (found, written) in [(0.0111, "1.12 %"), (2.018_2e-4, "2.0181e-4"), (1e-6, "0 %")] {
        assert!(std::panic::catch_unwind(|| assert_reads(found, written)).is_err());
    }
}

#[test]
fn the_fit_finds_the_exponent_of_a_power_law() {
    let peaks = [64, 128, 512].map(|n| (n, 3.0 * (n as f64).powf(0.7)));
    // Exact except for rounding of the logarithms.
    assert!((fitted_exponent(&peaks) - 0.7).abs() < 1e-12);
    assert!((exponent(peaks[0], peaks[2]) - 0.7).abs() < 1e-12);
}
