//! The homogeneous half-space in closed form: A. E. H. Love, *The stress produced in a semi-infinite solid by
//! pressure on part of the boundary*, Phil. Trans. R. Soc. A 228 (1929) 377–420.

use pellicle_kernel::Material;

use crate::element::edges::{Edge, edges};
use crate::element::product_rule::{Borders, ProductRule};

/// From this offset on the series of [`far`] is accurate to rounding: its next term is below 2e-17.
const FAR: usize = 48;

/// From this offset on the closed form would lose more than one digit to the cancellation between opposite edges.
const CANCELLATION: usize = 8;

/// Influence coefficient `k` of a homogeneous half-space, m/Pa: the displacement of the centre of one square
/// element, of side `element_side` (m), for unit pressure on another, `offset` elements away.
///
/// `k = a S / (π E*)` with the plane-strain modulus `E* = E/(1−ν²)`, `a` half the side, and [`shape_factor`] `S`.
/// The relative error is below 2e-15 at every offset.
///
/// ```
/// use pellicle_influence::love;
/// use pellicle_kernel::Material;
///
/// let steel = Material::new(210e9, 0.3)?;
/// // Under its own pressure the centre of a square sinks by 8 ln(1+√2) a/(π E*).
/// let own = love::coefficient(&steel, 2e-6, [0, 0]);
/// let expected = 8.0 * (1.0 + 2f64.sqrt()).ln() * 1e-6 / (std::f64::consts::PI * steel.plane_strain_modulus());
/// assert!((own / expected - 1.0).abs() < 4e-15); // rounding
/// # Ok::<(), pellicle_kernel::KernelError>(())
/// ```
#[must_use]
pub fn coefficient(material: &Material, element_side: f64, offset: [usize; 2]) -> f64 {
    let half_side = element_side / 2.0;
    // k = (1−ν²)/(πE) ∫ dA/ρ
    half_side * shape_factor(offset) / (std::f64::consts::PI * material.plane_strain_modulus())
}

/// `S(m, n) = ∫∫ dξ dη / ρ` over the square of side 2 centred at (2m, 2n), ρ the distance from the origin;
/// dimensionless.
///
/// Near elements use Love's closed form, more distant ones a Gauss product rule, which is more accurate there, and far
/// ones a series. Relative error below 2e-15 (checked against 50 digits in the tests).
#[must_use]
pub fn shape_factor(offset: [usize; 2]) -> f64 {
    let distance = offset[0].max(offset[1]);
    if distance >= FAR {
        return far(offset);
    }
    let rule = Borders::HOMOGENEOUS.rule(offset);
    match rule.filter(|_| distance >= CANCELLATION) {
        None => edges(offset).iter().map(edge_integral).sum(),
        Some(rule) => by_rule(rule, offset),
    }
}

/// `S` by a Gauss product rule.
fn by_rule(rule: &ProductRule, offset: [usize; 2]) -> f64 {
    let points = rule.points(offset);
    points.map(|(square, weight)| weight / square.sqrt()).sum()
}

/// `S` by the Taylor series of `1/r` about the centre of the square, with `r` = 2 (m² + n²)^½ and θ the angle from
/// an axis.
///
/// The odd moments of the square vanish; the derivatives of orders 2, 4 and 6 give
///
/// ```text
/// S = (4/r) (1 + t/6 + t² (7/80 − 7/48 cos 4θ) + t³ (15/224 − 3/32 cos 4θ) + O(t⁴)),    t = 1/r²,
/// ```
///
/// since `Δ r⁻ᵏ = k² r⁻ᵏ⁻²`, and `∂x² ∂y² = (Δ² − Re (∂x + i ∂y)⁴)/8` with `(∂x + i ∂y)⁴ (1/r) = 105 e^(4iθ)/r⁵`.
fn far([m, n]: [usize; 2]) -> f64 {
    let [m_squared, n_squared] = [m, n].map(|count| (count * count) as f64);
    let inverse = 1.0 / (m_squared + n_squared);
    let t = 0.25 * inverse;
    // cos 4θ = 1 − 8 cos²θ sin²θ
    let cos = 1.0 - 8.0 * (m_squared * inverse) * (n_squared * inverse);
    let third = 15.0 / 224.0 - 3.0 / 32.0 * cos;
    let second = 7.0 / 80.0 - 7.0 / 48.0 * cos;
    2.0 * inverse.sqrt() * (1.0 + t * (1.0 / 6.0 + t * (second + t * third)))
}

/// `d ∫ dl/ρ` along one edge.
fn edge_integral(edge: &Edge) -> f64 {
    let distance = edge.distance.abs();
    // ∫ dl/√(d²+l²) = asinh(l/d)
    edge.distance * asinh_difference(edge.to / distance, edge.from / distance)
}

/// `asinh p − asinh q` for p > q without cancellation.
fn asinh_difference(p: f64, q: f64) -> f64 {
    if q < 0.0 {
        return p.asinh() - q.asinh();
    }
    // asinh p − asinh q = asinh((p²−q²) / (p√(1+q²) + q√(1+p²)))
    let (over_p, over_q) = (1f64.hypot(p), 1f64.hypot(q));
    ((p - q) * (p + q) / (p * over_q + q * over_p)).asinh()
}

#[cfg(test)]
mod tests {
    use super::{FAR, by_rule, far, shape_factor};
    use crate::element::product_rule::Borders;

    /// mpmath 1.3, 50 digits, the edge sum of asinh evaluated directly.
    const FIFTY_DIGITS: [([usize; 2], f64); 22] = [
        ([0, 0], 7.050_988_696_156_344),
        ([1, 0], 2.076_099_471_809_512),
        ([1, 1], 1.449_394_876_268_66),
        ([2, 1], 0.902_177_976_698_439_7),
        ([7, 3], 0.262_801_987_495_275_45),
        ([7, 7], 0.202_116_713_553_400_36),
        ([8, 0], 0.250_162_537_499_831_86),
        ([8, 8], 0.176_834_397_354_479_26),
        ([15, 0], 0.133_358_015_084_286_16),
        ([16, 16], 0.088_395_545_629_251_84),
        ([48, 0], 0.041_667_420_158_496),
        ([48, 20], 0.038_462_131_154_948_296),
        ([48, 48], 0.029_463_048_979_384_454),
        ([63, 5], 0.031_646_850_539_389_48),
        ([64, 0], 0.031_250_317_884_647_716),
        ([100, 37], 0.018_757_305_598_304_16),
        ([200, 63], 0.009_537_995_495_543_495),
        ([777, 777], 0.001_820_094_737_676_250_3),
        ([1023, 1023], 0.001_382_417_977_053_722_4),
        ([1024, 0], 0.001_953_125_077_610_208),
        ([4096, 0], 0.000_488_281_251_212_659_6),
        ([4096, 4096], 0.000_345_266_983_429_983_8),
    ];

    #[test]
    fn coefficients_keep_all_digits_near_and_far() {
        for (offset, expected) in FIFTY_DIGITS {
            let error = shape_factor(offset) / expected - 1.0;
            // Rounding of some tens of terms, and 4e-15 of the product rule at its borders.
            assert!(error.abs() < 4e-15, "{offset:?}: {error:e}");
        }
    }

    #[test]
    fn far_away_the_series_and_the_product_rule_agree() {
        for m in (FAR..2100).step_by(37) {
            for n in (0..=m).step_by(29) {
                let rule = Borders::HOMOGENEOUS.rule([m, n]).unwrap();
                let error = far([m, n]) / by_rule(rule, [m, n]) - 1.0;
                // 4e-15 of the product rule at its borders.
                assert!(error.abs() < 4e-15, "{m} {n}: {error:e}");
            }
        }
        // At half the distance the next term is visible.
        let error = far([FAR / 2, 0]) / shape_factor([FAR / 2, 0]) - 1.0;
        assert!((1e-15..1e-14).contains(&error.abs()), "{error:e}");
    }

    #[test]
    fn the_order_of_an_offsets_components_does_not_matter() {
        for m in 0..20 {
            for n in 0..m {
                let ratio = shape_factor([m, n]) / shape_factor([n, m]);
                // Rounding: the terms are added in another order.
                assert!((ratio - 1.0).abs() < 1e-14);
            }
        }
    }
}
