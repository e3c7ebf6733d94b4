//! What the pictures of a fit show of one unknown.

use crate::display::{Scale, significant};

/// An unknown as found.
#[derive(Debug, Clone, PartialEq)]
pub struct FittedUnknown {
    /// Its name in words.
    pub name: String,
    /// The unit in which it is shown.
    pub scale: Scale,
    /// Its value in the best fit.
    pub value: f64,
    /// Its interval; nothing on a side that is open.
    pub interval: [Option<f64>; 2],
    /// The least and the largest value that the fit allows.
    pub bounds: [f64; 2],
    /// Its verdict in a word.
    pub verdict: String,
    /// Half the interval from the covariance over the value, as a difference of logarithms; none without covariance.
    pub wald: Option<f64>,
    /// The level of `Δχ²` at which the interval ends.
    pub threshold: f64,
    /// Values with their `Δχ²`, in the order of the values; none without a profile.
    pub profile: Vec<[f64; 2]>,
}

impl FittedUnknown {
    /// Its value, interval and unit: `164.2 [163.1, open] nm`.
    #[must_use]
    pub fn numbers(&self) -> String {
        let number = |value: f64| significant(value / self.scale.divisor, 4);
        let [low, high] = self.interval.map(|end| end.map_or("open".into(), number));
        let text = format!(
            "{} [{low}, {high}] {}",
            number(self.value),
            self.scale.label
        );
        text.trim_end().to_owned()
    }

    /// `Δχ²` of the parabola of the covariance at a value.
    #[must_use]
    pub fn parabola(&self, value: f64) -> Option<f64> {
        let z = (value / self.value).ln() / self.wald?;
        Some(self.threshold * z * z)
    }

    /// The standard deviation of its logarithm.
    #[must_use]
    pub fn deviation(&self) -> Option<f64> {
        self.wald.map(|half| half / self.threshold.sqrt())
    }

    /// The profile as a smooth line: its root, with a sign, is nearly linear in the logarithm.
    #[must_use]
    pub fn smooth_profile(&self) -> Vec<[f64; 2]> {
        const PARTS: usize = 16;
        let root = |[value, delta]: [f64; 2]| {
            [
                value.ln(),
                delta.max(0.0).sqrt().copysign(value - self.value),
            ]
        };
        let mut line = Vec::new();
        for pair in self.profile.windows(2) {
            let [[x0, z0], [x1, z1]] = [root(pair[0]), root(pair[1])];
            line.extend((0..PARTS).map(|i| {
                let t = i as f64 / PARTS as f64;
                let (x, z) = (x0 + t * (x1 - x0), z0 + t * (z1 - z0));
                [x.exp(), z * z]
            }));
        }
        line.extend(self.profile.last());
        line
    }
}

#[cfg(test)]
pub(super) mod tests {
    use approx::assert_relative_eq;

    use super::*;

    /// An unknown of this name whose logarithm has this standard deviation, at level 0.95.
    pub fn unknown(name: &str, value: f64, deviation: f64) -> FittedUnknown {
        let half = 1.96 * deviation;
        let profile = |i: i32| {
            let z = f64::from(i);
            [value * (z * deviation).exp(), z * z]
        };
        FittedUnknown {
            name: name.into(),
            scale: Scale {
                divisor: 1e9,
                label: "GPa".into(),
            },
            value,
            interval: [Some(value * (-half).exp()), Some(value * half.exp())],
            bounds: [value / 10.0, value * 10.0],
            verdict: "identified".into(),
            wald: Some(half),
            threshold: 1.96 * 1.96,
            profile: (-2..=2).map(profile).collect(),
        }
    }

    #[test]
    fn the_parabola_reaches_the_threshold_at_the_ends_of_its_interval() {
        let found = unknown("E", 7e9, 0.1);
        let end = 7e9 * 0.196_f64.exp();
        // Rounding of a logarithm.
        let delta = found.parabola(end).unwrap();
        assert_relative_eq!(delta, found.threshold, max_relative = 1e-12);
        assert_relative_eq!(found.deviation().unwrap(), 0.1, max_relative = 1e-12);
    }

    #[test]
    fn between_its_points_a_quadratic_profile_is_the_parabola() {
        let found = unknown("E", 7e9, 0.1);
        for [value, delta] in found.smooth_profile() {
            let parabola = found.parabola(value).unwrap();
            // Rounding of an exponential.
            assert!((delta - parabola).abs() < 1e-10, "{value} {delta}");
        }
    }

    #[test]
    fn an_open_side_is_called_so() {
        let mut found = unknown("E", 7e9, 0.1);
        found.interval = [Some(6e9), None];
        assert_eq!(found.numbers(), "7.000 [6.000, open] GPa");
    }
}
