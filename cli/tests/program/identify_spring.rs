//! A cantilever whose spring constant is not known exactly: the modulus is known no better.

use std::fs;

use serde_json::Value;

use super::runner::TestFolder;

const MODULUS: f64 = 50e3;
const RADIUS: f64 = 5e-6;
const SPRING: f64 = 0.05;

/// Approach, deflection and force of a ball on an elastic half-space according to Hertz, with 0.2 nm of noise.
fn measurement() -> String {
    let mut state = 12345_u64;
    let mut noise = || {
        // The sum of twelve numbers in [0, 1), minus six.
        let mut next = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        (0..12).map(|_| next()).sum::<f64>() - 6.0
    };
    let row = |i: u32| {
        let force = 0.1e-9 * 100_f64.powf(f64::from(i) / 59.0);
        let modulus = MODULUS / (1.0 - 0.45 * 0.45);
        let depth = (9.0 * force * force / (16.0 * RADIUS * modulus * modulus)).cbrt();
        let deflection = force / SPRING;
        let height = depth + deflection + 0.2e-9 * noise();
        let [z, d, f] = [height, deflection, force].map(|value| 1e9 * value);
        format!("{z:.6},{d:.6},{f:.6}\n")
    };
    let rows = (0..60).map(row);
    String::from("height [nm],deflection [nm],force [nN]\n") + &rows.collect::<String>()
}

/// Runs the fit with this spring constant and this column for the force.
fn fitted(spring: &str, column: &str, intervals: &str) -> Value {
    let data = format!("spring_constant = {spring}\nobserve = \"depth at force\"");
    fitted_with((&measurement(), column), &data, intervals)
}

/// Runs the fit of a curve with this column for the force and these keys of its data.
fn fitted_with((curve, column): (&str, &str), data: &str, intervals: &str) -> Value {
    let fit = format!(
        r#"
[model]
foundation = {{ substrate = {{ young_modulus = "40 kPa", poisson_ratio = 0.45 }} }}
indenter = {{ kind = "paraboloid", radius = "5 um" }}

[[data]]
file = "curve.csv"
columns = {{ height = "height", {column} = "{column}" }}
height_direction = "toward"
noise = {{ depth = "0.2 nm", correlation = "none" }}
{data}

[unknown]
"foundation.substrate.young_modulus" = {{ from = "1 kPa", to = "1 MPa" }}

[report]
intervals = "{intervals}"
"#
    );
    let folder = TestFolder::new();
    fs::write(folder.path("curve.csv"), curve).unwrap();
    fs::write(folder.path("fit.toml"), fit).unwrap();
    folder.run(&["identify", "fit.toml", "--json"]).json()
}

/// Value and interval ends of an estimate.
fn numbers(estimate: &Value, interval: &str) -> [f64; 3] {
    let number = |value: &Value| value.as_f64().unwrap();
    let ends = &estimate[interval];
    [
        number(&estimate["value"]),
        number(&ends[0]),
        number(&ends[1]),
    ]
}

/// Half the width of the interval from the covariance, in the logarithm.
fn half_width(found: &Value) -> f64 {
    let [_, low, high] = numbers(&found["unknowns"][0], "wald");
    0.5 * (high / low).ln()
}

#[test]
fn the_modulus_is_no_more_certain_than_the_spring_constant() {
    let exact = fitted("\"0.05 N/m\"", "deflection", "wald");
    assert_eq!(exact["nuisances"], serde_json::json!([]));
    let uncertain = "{ mean = \"0.05 N/m\", sd = \"0.005 N/m\" }";
    let found = fitted(uncertain, "deflection", "profile");
    // D ∝ (k/E*)^⅔ Q₀^⅔: the variances of ln E* and ln k add; the second is 0.1².
    let own = half_width(&exact);
    let quantile = 1.959_963_985;
    let expected = own.hypot(quantile * 0.1);
    assert!(own < 0.02, "{own}");
    // The slope of the prior in ln k at the best fit, which is within a thousandth of its centre.
    assert!((half_width(&found) / expected - 1.0).abs() < 5e-3, "{own}");
    // The profile is that of k, normal: k (1 ± z/10) with z from χ².
    let [value, low, high] = numbers(&found["unknowns"][0], "interval");
    for (end, sign) in [(low, -1.0), (high, 1.0)] {
        let expected = 1.0 + sign * quantile * 0.1;
        // The modulus' own half percent and a hundredth of a standard error.
        assert!((end / value / expected - 1.0).abs() < 3e-3, "{end} {value}");
    }
    let spring = &found["nuisances"][0];
    assert_eq!(spring["key"], "data[0].spring_constant");
    assert_eq!(spring["unit"], "N/m");
    assert_eq!(spring["verdict"], "prior-driven", "{spring}");
    let [constant, low, high] = numbers(spring, "interval");
    assert!((constant / SPRING - 1.0).abs() < 1e-3, "{spring}");
    assert!((low / 0.0402 - 1.0).abs() < 3e-3 && (high / 0.0598 - 1.0).abs() < 3e-3);
    let why = found["unknowns"][0]["why"].as_str().unwrap();
    assert!(
        why.contains("mostly that of data[0].spring_constant"),
        "{why}"
    );
}

#[test]
fn a_force_computed_from_the_deflection_gives_the_same() {
    let uncertain = "{ mean = \"0.05 N/m\", sd = \"0.005 N/m\" }";
    let by = |column| fitted(uncertain, column, "wald");
    let (deflection, force) = (by("deflection"), by("force"));
    let pair = [&deflection, &force].map(|found| numbers(&found["unknowns"][0], "wald"));
    for (one, other) in pair[0].iter().zip(pair[1]) {
        // Both are written with six decimals of a nanometre and a nanonewton.
        assert!((one / other - 1.0).abs() < 1e-4, "{one} {other}");
    }
}

/// The curve with its deflection in volts, of 80 nm each.
fn in_volts() -> String {
    let curve = measurement();
    let rows = curve.lines().skip(1).map(|row| {
        let mut fields = row.split(',');
        let mut next = || fields.next().unwrap();
        let (height, deflection) = (next(), next().parse::<f64>().unwrap());
        format!("{height},{:.9}\n", deflection / 80.0)
    });
    String::from("height [nm],deflection [V]\n") + &rows.collect::<String>()
}

#[test]
fn spring_constant_and_sensitivity_are_taken_as_exact_and_their_effect_is_that_of_other_ones() {
    let curve = in_volts();
    for observe in ["depth at force", "force at depth"] {
        let fitted = |spring: f64, sensitivity: f64| {
            let data = format!(
                "observe = \"{observe}\"\nspring_constant = \"{spring} N/m\"\n\
                 units = {{ deflection = \"{sensitivity} nm/V\" }}"
            );
            fitted_with((&curve, "deflection"), &data, "wald")
        };
        let at = fitted(SPRING, 80.0);
        let modulus = |found: &Value| numbers(&found["unknowns"][0], "wald")[0];
        assert!((modulus(&at) / MODULUS - 1.0).abs() < 0.02, "{observe}");
        for (key, value, [less, more]) in [
            (
                "data[0].spring_constant",
                SPRING,
                [0.999, 1.001].map(|part| fitted(part * SPRING, 80.0)),
            ),
            (
                "data[0].units.deflection",
                80e-9,
                [0.999, 1.001].map(|part| fitted(SPRING, part * 80.0)),
            ),
        ] {
            let all = at["taken_as_exact"].as_array().unwrap();
            let number = all.iter().find(|number| number["key"] == key).unwrap();
            assert!((number["value"].as_f64().unwrap() / value - 1.0).abs() < 1e-12);
            let wanted = (modulus(&more) / modulus(&less)).ln() / (1.001_f64 / 0.999).ln();
            let found = number["exponents"][0].as_f64().unwrap();
            // The quotient of differences is true to its step squared.
            assert!(
                (found / wanted - 1.0).abs() < 0.02,
                "{observe}, {key}: {found} for {wanted}"
            );
        }
    }
}
