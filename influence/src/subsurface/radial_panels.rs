//! Functions of the radius as polynomials in r² on panels.
//!
//! Waves that decay with depth as `e^{−kz}` give functions of r² that are analytic except at `r² = −z²` and beyond.
//! In `w = r² + z²`, on panels from w to at most 9/8 w, whose centre lies at least 17 half widths from that point,
//! polynomials of degree 9 leave some 1e-13 of the functions. Eight panels fill one power of two, so the leading
//! bits of w are the number of its panel. Two panels in one power of two, the centre at least 5 half widths away, leave
//! 1e-9.

use crate::numerics::chebyshev::{ChebyshevTransform, nodes, taylor_weight};

/// Number of coefficients of a polynomial.
const TERMS: usize = 10;

/// Bits of a number's fraction.
const FRACTION: u32 = 52;

/// Leading bits of the fraction that count the panels in one power of two.
#[derive(Clone, Copy, Debug)]
struct PanelBits(u32);

/// For functions to 1e-13, and to 1e-9.
const FINE: PanelBits = PanelBits(3);
const ROUGH: PanelBits = PanelBits(1);

impl PanelBits {
    /// Bits of the fraction below those that count panels.
    fn shift(self) -> u32 {
        FRACTION - self.0
    }

    /// The panel of `relative`, which is `w` over the smallest `w` and at least 1.
    #[inline]
    fn panel_of(self, relative: f64) -> u64 {
        (relative.to_bits() - 1_f64.to_bits()) >> self.shift()
    }

    /// The beginning of a panel, over the smallest `w`.
    fn beginning(self, panel: u64) -> f64 {
        f64::from_bits(1_f64.to_bits() + (panel << self.shift()))
    }
}

/// The radii that panels cover; all lengths are in sides of an element.
#[derive(Clone, Copy, Debug)]
pub struct Layout {
    /// Depth with which the waves decay.
    reach: f64,
    /// The smallest `w`, at which the first panel begins.
    lowest: f64,
    count: u64,
    bits: PanelBits,
}

impl Layout {
    /// The layout for radii from one to another; `reach` and the first radius are not both 0.
    pub fn new(reach: f64, ends: [f64; 2]) -> Self {
        Self::with(FINE, reach, ends)
    }

    /// The same with fewer panels, for rough functions.
    pub fn rough(reach: f64, ends: [f64; 2]) -> Self {
        Self::with(ROUGH, reach, ends)
    }

    fn with(bits: PanelBits, reach: f64, [from, to]: [f64; 2]) -> Self {
        let lowest = from * from + reach * reach;
        let last = ((to * to + reach * reach) / lowest).max(1.0);
        Self {
            reach,
            lowest,
            count: bits.panel_of(last) + 1,
            bits,
        }
    }

    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// The smallest and the largest radius at which the functions are evaluated.
    pub fn ends(&self) -> [f64; 2] {
        let (mut first, mut last) = (f64::INFINITY, 0.0);
        for radius in self.radii_of(0) {
            first = f64::min(first, radius);
        }
        for radius in self.radii_of(self.count - 1) {
            last = f64::max(last, radius);
        }
        [first, last]
    }

    /// The radii of one panel at which the functions are evaluated.
    fn radii_of(&self, panel: u64) -> impl Iterator<Item = f64> {
        let [begin, end] = [panel, panel + 1].map(|panel| self.bits.beginning(panel));
        let (lowest, reach) = (self.lowest, self.reach);
        nodes(TERMS).map(move |t| {
            let relative = begin + (end - begin) * f64::midpoint(1.0, t);
            // r² = w − z²
            (lowest * relative - reach * reach).max(0.0).sqrt()
        })
    }
}

/// `F` functions of the radius.
#[derive(Clone, Debug)]
pub struct RadialPanels<const F: usize> {
    reach_square: f64,
    per_lowest: f64,
    bits: PanelBits,
    shift: u32,
    /// Panels in one power of two.
    per_octave: f64,
    /// For each panel, from the highest power of the position in it down.
    powers: Vec<[[f64; F]; TERMS]>,
}

impl<const F: usize> RadialPanels<F> {
    /// The polynomials through the values of the functions at the layout's radii.
    pub fn new(layout: &Layout, function: impl Fn(f64) -> [f64; F]) -> Self {
        let transform = ChebyshevTransform::new(TERMS, TERMS);
        let powers = 0..i32::try_from(TERMS).unwrap_or(i32::MAX);
        let of_chebyshev: Vec<Vec<f64>> = powers
            .map(|power| (0..TERMS).map(|j| taylor_weight(j, power)).collect())
            .collect();
        let panel = |index: u64| {
            let values: Vec<[f64; F]> = layout.radii_of(index).map(&function).collect();
            let mut panel = [[0.0; F]; TERMS];
            for f in 0..F {
                let of_one: Vec<f64> = values.iter().map(|values| values[f]).collect();
                let coefficients = transform.coefficients(&of_one);
                for (power, weights) in panel.iter_mut().rev().zip(&of_chebyshev) {
                    let terms = coefficients.iter().zip(weights);
                    power[f] = terms.map(|(c, weight)| c * weight).sum();
                }
            }
            panel
        };
        Self {
            reach_square: layout.reach * layout.reach,
            per_lowest: 1.0 / layout.lowest,
            bits: layout.bits,
            shift: layout.bits.shift(),
            per_octave: 2_f64.powi(layout.bits.0.cast_signed()),
            powers: (0..layout.count).map(panel).collect(),
        }
    }

    /// The functions of a square element of this side, from those of points that belong to fields `f rⁿ cos nφ` of
    /// these orders n: to `k⁴ cos 4θ/11520`, far away from the element.
    ///
    /// Averaged over the element, a wave is `1 − k²h²/24 + 7/11520 k⁴h⁴` besides what depends on its direction, and −k²
    /// is the Laplacian, which on a field of order n is, with `w = r² + z²`,
    ///
    /// ```text
    /// Δ(f rⁿ cos nφ) = (4 r² f'' + 4 (n + 1) f') rⁿ cos nφ       ' = d/dw
    /// ```
    pub fn averaged(&self, orders: [usize; F], side: f64) -> Self {
        let square = side * side;
        let [second, fourth] = [square / 24.0, 7.0 / 11520.0 * square * square];
        let panel = |(index, powers): (u64, &[[f64; F]; TERMS])| {
            let place = self.place_of(index);
            let once = laplacian(powers, &orders, place);
            let twice = laplacian(&once, &orders, place);
            let mut sums = *powers;
            for (term, sums) in sums.iter_mut().enumerate() {
                for (f, sum) in sums.iter_mut().enumerate() {
                    *sum += second * once[term][f] + fourth * twice[term][f];
                }
            }
            sums
        };
        Self {
            powers: (0..).zip(&self.powers).map(panel).collect(),
            ..*self
        }
    }

    /// `r²` at the beginning of a panel, and its width in `w`.
    fn place_of(&self, panel: u64) -> [f64; 2] {
        let ends = [panel, panel + 1].map(|panel| self.bits.beginning(panel) / self.per_lowest);
        [ends[0] - self.reach_square, ends[1] - ends[0]]
    }

    /// The functions at the root of `radius_square`; NaN beyond the last panel.
    #[inline]
    pub fn at(&self, radius_square: f64) -> [f64; F] {
        let relative = ((radius_square + self.reach_square) * self.per_lowest).max(1.0);
        let panel = (relative.to_bits() - 1_f64.to_bits()) >> self.shift;
        let Some(powers) = usize::try_from(panel).ok().and_then(|i| self.powers.get(i)) else {
            return [f64::NAN; F];
        };
        // The bits below those that count panels are the position in one.
        let fraction = relative.to_bits() & ((1 << self.shift) - 1);
        let place = (f64::from_bits(1_f64.to_bits() | fraction) - 1.0) * self.per_octave;
        let mut sums = powers[0];
        for coefficients in &powers[1..] {
            for (sum, coefficient) in sums.iter_mut().zip(coefficients) {
                *sum = *sum * place + coefficient;
            }
        }
        sums
    }
}

/// The Laplacians of fields of these orders, as polynomials on a panel that begins at `r²` and has a width in w.
fn laplacian<const F: usize>(
    powers: &[[f64; F]; TERMS],
    orders: &[usize; F],
    [radius_square, width]: [f64; 2],
) -> [[f64; F]; TERMS] {
    // Powers fall from the first term on; those above the highest are 0.
    let coefficient = |power: usize, f: usize| {
        if power < TERMS {
            powers[TERMS - 1 - power][f]
        } else {
            0.0
        }
    };
    let mut sums = [[0.0; F]; TERMS];
    for (power, sums) in sums.iter_mut().rev().enumerate() {
        let k = power as f64;
        for (f, (sum, order)) in sums.iter_mut().zip(orders).enumerate() {
            // 4 r² f'' + 4 (n + 1) f' with r² = r₀² + s t and f = Σ cₖ tᵏ
            let second = radius_square / width * (k + 2.0) * coefficient(power + 2, f);
            let first = (k + 1.0 + *order as f64) * coefficient(power + 1, f);
            *sum = 4.0 * (k + 1.0) / width * (second + first);
        }
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::{Layout, RadialPanels};

    #[test]
    fn functions_of_point_loads_are_accurate_to_thirteen_digits() {
        for (reach, ends) in [
            (0.3, [0.0, 500.0]),
            (200.0, [0.0, 40.0]),
            (0.0, [40.0, 900.0]),
        ] {
            let layout = Layout::new(reach, ends);
            // 1/ρ, z²/ρ⁵ and z/ρ⁷, as in Boussinesq's solution
            let function = |r: f64| {
                let rho = r.hypot(reach.max(1e-9));
                [1.0 / rho, rho.powi(-5), rho.powi(-7)]
            };
            let panels = RadialPanels::new(&layout, function);
            for i in 0..=1000 {
                let r = ends[0] + (ends[1] - ends[0]) * f64::from(i).powi(3) / 1e9;
                let (found, expected) = (panels.at(r * r), function(r));
                for (found, expected) in found.iter().zip(expected) {
                    assert!(
                        (found / expected - 1.0).abs() < 1e-12,
                        "{reach} {r}: {found:e} {expected:e}"
                    );
                }
            }
            assert!(panels.at(4.0 * (ends[1] + reach).powi(2))[0].is_nan());
        }
    }
}
