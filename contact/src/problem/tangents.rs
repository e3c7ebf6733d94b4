//! Nonlinear springs, linearised at a pressure.
//!
//! ```text
//! w*(p) ≈ w*(p₀) + η_t (p − p₀) = η_t p + s,    η_t = dw*/dp(p₀),    s = w*(p₀) − η_t p₀
//! ```
//!
//! So the problem on a grid becomes a linear one with compliance `η_t` and initial gap `g0 + s`.

use pellicle_texture::SpringLaw;

use crate::{
    problem::scale::Scale,
    vector::{by_parts, update, update_with},
};

/// Fraction of the decrease predicted by the slope that the energy must reach (Armijo).
const DECREASE: f64 = 1e-4;
/// Bisections for the minimum on the segment, to a thousandth of its length.
const BISECTIONS: usize = 10;

/// Tangents to the shortenings of all springs, in the units of a problem's scale except for the compliances.
#[derive(Debug, Clone)]
pub struct Tangents {
    law: SpringLaw,
    per_compliance: f64,
    /// `p₀`.
    at: Vec<f64>,
    /// `η_t`, in m/Pa.
    compliance: Vec<f64>,
    /// Its part by linear springs added to all elements, in m/Pa.
    added: f64,
}

impl Tangents {
    /// Tangents at rest, equal to the compliances η (m/Pa) and that of linear springs added to them; none if all
    /// springs are linear.
    pub fn at_rest(law: SpringLaw, scale: Scale, compliance: &[f64], added: f64) -> Option<Self> {
        (!law.is_linear()).then(|| Self {
            law: law.in_unit(scale.pressure()),
            per_compliance: 1.0 / scale.compliance,
            at: vec![0.0; compliance.len()],
            compliance: compliance.iter().map(|eta| eta + added).collect(),
            added,
        })
    }

    /// `η_t`, in m/Pa.
    pub fn compliance(&self) -> &[f64] {
        &self.compliance
    }

    /// `p₀`.
    pub fn at(&self) -> &[f64] {
        &self.at
    }

    /// Linearises springs with compliances at rest η (m/Pa) at a pressure ≥ 0.
    pub fn take(&mut self, rest: &[f64], pressure: &[f64]) {
        self.at.copy_from_slice(pressure);
        let (law, added) = (self.law, self.added);
        update_with(&mut self.compliance, rest, pressure, |tangent, eta, p| {
            *tangent = law.tangent(*eta, *p) + added;
        });
    }

    /// Adds `s` to a gap.
    pub fn add_offset(&self, rest: &[f64], gap: &mut [f64]) {
        // s is the distance of the law below the tangent at rest.
        update_with(gap, rest, &self.at, |gap, eta, at| {
            if *at > 0.0 {
                *gap -= self.law.beyond_tangent(self.per_compliance * eta, *at, 0.0);
            }
        });
    }

    /// Adds to `v`, computed with the tangents, the law's deviation from them at a pressure; `beyond` is a buffer.
    pub fn add_beyond(&self, rest: &[f64], pressure: &[f64], beyond: &mut [f64], v: &mut [f64]) {
        beyond.copy_from_slice(pressure);
        update_with(beyond, rest, &self.at, |value, eta, at| {
            let eta = self.per_compliance * eta;
            *value = if (*value - at).abs() > 0.0 {
                self.law.beyond_tangent(eta, *at, *value)
            } else {
                0.0
            };
        });
        update(v, beyond, |v, beyond| *v += beyond);
    }

    /// The fraction to take of the segment from `p₀` to a pressure: all of it, or up to the minimum of the energy if
    /// that would not be lower at the end. `slope` and `curvature` are those of the linear problem's energy along the
    /// segment.
    pub fn part_downhill(
        &self,
        rest: &[f64],
        pressure: &[f64],
        [slope, curvature]: [f64; 2],
    ) -> f64 {
        // E(p₀ + t s) − E(p₀) = t s·∂E + ½ t² s·y + the law's deviation
        let change = slope + curvature / 2.0 + self.beyond_along(rest, pressure, 1.0)[0];
        let is_uphill = change > DECREASE * slope;
        if !(is_uphill && slope < 0.0) {
            return 1.0;
        }
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..BISECTIONS {
            let middle = f64::midpoint(low, high);
            let [_, beyond] = self.beyond_along(rest, pressure, middle);
            if slope + middle * curvature + beyond < 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        f64::midpoint(low, high)
    }

    /// The law's addition to the energy and to its slope at the fraction `t` of the segment from `p₀` to a pressure.
    fn beyond_along(&self, rest: &[f64], pressure: &[f64], t: f64) -> [f64; 2] {
        let parts = by_parts(pressure.len(), |part| {
            let fields = (self.at[part.clone()].iter()).zip(&pressure[part.clone()]);
            let mut sums = [0.0; 2];
            for ((at, p), eta) in fields.zip(&rest[part]) {
                let (step, eta) = (p - at, self.per_compliance * eta);
                if step != 0.0 {
                    let to = at + t * step;
                    sums[0] += self.law.energy_beyond_tangent(eta, *at, to);
                    sums[1] += step * self.law.beyond_tangent(eta, *at, to);
                }
            }
            sums
        });
        let add = |sums: [f64; 2], part: [f64; 2]| [sums[0] + part[0], sums[1] + part[1]];
        parts.into_iter().fold([0.0; 2], add)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const REST: [f64; 4] = [0.5, 0.0, 1.0, 2.0];
    const AT: [f64; 4] = [1.0, 3.0, 2.5, 0.0];

    fn law() -> SpringLaw {
        SpringLaw::logarithmic(2.0).unwrap()
    }

    fn tangents() -> Tangents {
        let mut tangents = Tangents::at_rest(law(), Scale::SI, &REST, 0.0).unwrap();
        tangents.take(&REST, &AT);
        tangents
    }

    #[test]
    fn tangent_offset_and_remainder_add_up_to_the_law() {
        let (tangents, pressure) = (tangents(), [4.0, 1.0, 0.0, 0.3]);
        let (mut offset, mut beyond, mut found) = ([0.0; 4], [0.0; 4], [0.0; 4]);
        tangents.add_offset(&REST, &mut offset);
        for e in 0..4 {
            found[e] = tangents.compliance()[e] * pressure[e] + offset[e];
        }
        tangents.add_beyond(&REST, &pressure, &mut beyond, &mut found);
        for e in 0..4 {
            let wanted = law().shortening(REST[e], pressure[e]);
            assert!((found[e] - wanted).abs() < 1e-15, "{e}");
        }
    }

    #[test]
    fn the_slope_along_a_segment_is_that_of_the_energy() {
        let (tangents, pressure) = (tangents(), [4.0, 1.0, 0.0, 0.3]);
        let along = |t: f64| tangents.beyond_along(&REST, &pressure, t);
        assert_eq!(along(0.0), [0.0; 2]);
        for t in [0.1, 0.5, 1.0] {
            let step = 1e-4;
            let difference = (along(t + step)[0] - along(t - step)[0]) / (2.0 * step);
            assert!((difference / along(t)[1] - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn an_uphill_segment_ends_at_its_minimum_and_a_downhill_one_at_its_end() {
        let (tangents, pressure) = (tangents(), [0.0, 1.0, 0.0, 0.0]);
        let part = |derivatives| tangents.part_downhill(&REST, &pressure, derivatives);
        let [beyond, _] = tangents.beyond_along(&REST, &pressure, 1.0);
        assert!(beyond > 0.0);
        // The law's deviation exceeds the decrease of the linear problem by a little.
        let curvature = 2.0 * (1.0 - 0.999 * beyond);
        let t = part([-1.0, curvature]);
        let slope = -1.0 + t * curvature + tangents.beyond_along(&REST, &pressure, t)[1];
        assert!(t > 0.1 && t < 0.9 && slope.abs() < 5e-3, "{t} {slope}");
        assert_eq!(part([-1.0, 2.0 * (0.99 - beyond)]), 1.0);
        assert_eq!(part([1.0, 1.0]), 1.0);
    }
}
