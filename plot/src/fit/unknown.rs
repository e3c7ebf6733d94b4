//! An unknown as shown in the pictures of a fit.

use pellicle::display::{DisplayUnit, significant};

/// An unknown with its fitted value.
#[derive(Debug, Clone, PartialEq)]
pub struct FittedUnknown {
    /// Its name in words.
    pub name: String,
    /// Its symbol and location.
    pub symbol: String,
    /// The unit in which it is shown.
    pub scale: DisplayUnit,
    /// Its best-fit value.
    pub value: f64,
    /// Its interval; `None` on an open side.
    pub interval: [Option<f64>; 2],
    /// The least and the largest value allowed in the fit.
    pub bounds: [f64; 2],
    /// Its verdict in one word.
    pub verdict: String,
    /// Half the width of the interval from the covariance, as a difference of logarithms; `None` without a covariance.
    pub wald: Option<f64>,
    /// The level of `Δχ²` at which the interval ends.
    pub threshold: f64,
    /// Values with their `Δχ²`, in the order of the values; empty without a profile.
    pub profile: Vec<[f64; 2]>,
    /// The product determined in its place; the profile is then that with the other unknowns held.
    pub combination: Option<Combination>,
}

/// A product of powers that the data determine.
#[derive(Debug, Clone, PartialEq)]
pub struct Combination {
    /// The product in symbols.
    pub words: String,
    /// Its interval relative to its value.
    pub interval: [Option<f64>; 2],
}

impl FittedUnknown {
    /// Writes value, interval and unit: `164.2 [163.1, open] nm`.
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

    /// Returns `Δχ²` of the covariance's parabola at a value.
    #[must_use]
    pub fn parabola(&self, value: f64) -> Option<f64> {
        let z = (value / self.value).ln() / self.wald?;
        Some(self.threshold * z * z)
    }

    /// Returns the profile as a smooth line up to the ends of the interval. Its signed square root is nearly linear in
    /// the logarithm.
    #[must_use]
    pub fn smooth_profile(&self) -> Vec<[f64; 2]> {
        let root = |[value, delta]: [f64; 2]| {
            let z = delta.max(0.0).sqrt().copysign(value - self.value);
            [value.ln(), z]
        };
        let nodes: Vec<_> = self.nodes().into_iter().map(root).collect();
        let line = smooth_line(&nodes).into_iter();
        line.map(|[x, z]| [x.exp(), z * z]).collect()
    }

    /// The points of the profile, and the ends of the interval outside them.
    fn nodes(&self) -> Vec<[f64; 2]> {
        let mut nodes = self.profile.clone();
        let (Some(first), Some(last)) = (nodes.first().copied(), nodes.last().copied()) else {
            return nodes;
        };
        let [low, high] = self.interval.map(|end| end.unwrap_or(f64::NAN));
        if low < first[0] {
            nodes.insert(0, [low, self.threshold]);
        }
        if high > last[0] {
            nodes.push([high, self.threshold]);
        }
        nodes
    }
}

/// Points of a smooth line through ordered nodes, without bends other than theirs: cubics between the nodes, where the
/// slope at a node is the harmonic mean of those to its neighbours.
fn smooth_line(nodes: &[[f64; 2]]) -> Vec<[f64; 2]> {
    const PARTS: usize = 16;
    let slopes: Vec<f64> = nodes
        .windows(2)
        .map(|pair| (pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0]))
        .collect();
    let slope = |node: usize| match (node.checked_sub(1).map(|i| slopes[i]), slopes.get(node)) {
        (Some(left), Some(&right)) if left * right > 0.0 => 2.0 * left * right / (left + right),
        (Some(_), Some(_)) => 0.0,
        (Some(only), None) => only,
        (None, only) => only.copied().unwrap_or(0.0),
    };
    let mut line = Vec::new();
    for (i, pair) in nodes.windows(2).enumerate() {
        let [[x0, z0], [x1, z1]] = [pair[0], pair[1]];
        let step = x1 - x0;
        let [m0, m1] = [slope(i) * step, slope(i + 1) * step];
        line.extend((0..PARTS).map(|part| {
            let t = part as f64 / PARTS as f64;
            // Hermite's cubic.
            let (a, b) = ((1.0 + 2.0 * t) * (1.0 - t).powi(2), t * t * (3.0 - 2.0 * t));
            let (c, d) = (t * (1.0 - t).powi(2), t * t * (t - 1.0));
            [x0 + t * step, a * z0 + b * z1 + c * m0 + d * m1]
        }));
    }
    line.extend(nodes.last());
    line
}

#[cfg(test)]
pub(super) mod tests {
    use approx::assert_relative_eq;

    use super::*;

    /// Returns an unknown with this name, whose logarithm has this standard deviation, at level 0.95.
    pub fn unknown(name: &str, value: f64, deviation: f64) -> FittedUnknown {
        let half = 1.96 * deviation;
        let profile = |i: i32| {
            let z = f64::from(i);
            [value * (z * deviation).exp(), z * z]
        };
        FittedUnknown {
            name: name.into(),
            symbol: "E".into(),
            scale: DisplayUnit {
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
            combination: None,
        }
    }

    #[test]
    fn the_parabola_reaches_the_threshold_at_the_ends_of_its_interval() {
        let found = unknown("E", 7e9, 0.1);
        let end = 7e9 * 0.196_f64.exp();
        // Rounding of a logarithm.
        let delta = found.parabola(end).unwrap();
        assert_relative_eq!(delta, found.threshold, max_relative = 1e-12);
    }

    #[test]
    fn a_quadratic_profile_is_the_parabola_between_its_points() {
        let found = unknown("E", 7e9, 0.1);
        for [value, delta] in found.smooth_profile() {
            let parabola = found.parabola(value).unwrap();
            // Rounding of an exponential.
            assert!((delta - parabola).abs() < 1e-10, "{value} {delta}");
        }
    }

    #[test]
    fn a_smooth_line_passes_through_its_nodes_without_overshoot() {
        let nodes = [[0.0, -2.0], [1.0, -1.9], [1.5, 0.0], [4.0, 3.0]];
        let line = smooth_line(&nodes);
        assert!(nodes.iter().all(|node| line.contains(node)), "{line:?}");
        assert!(
            line.windows(2).all(|pair| pair[1][1] >= pair[0][1]),
            "{line:?}"
        );
    }

    #[test]
    fn a_profile_extends_to_the_end_of_its_interval() {
        let mut found = unknown("E", 7e9, 0.1);
        found.profile.truncate(4);
        let end = found.interval[1].unwrap();
        let [value, delta] = *found.smooth_profile().last().unwrap();
        // Rounding of an exponential and a root.
        assert_relative_eq!(value, end, max_relative = 1e-12);
        assert_relative_eq!(delta, found.threshold, max_relative = 1e-12);
    }

    #[test]
    fn an_open_side_is_written_as_open() {
        let mut found = unknown("E", 7e9, 0.1);
        found.interval = [Some(6e9), None];
        assert_eq!(found.numbers(), "7.000 [6.000, open] GPa");
    }
}
