//! One row of the factor: the small dense system of an element and its earlier neighbours.

use pellicle_influence::SurfaceElasticity;

/// Compliances of relief, relative to an element's own elastic compliance, from which on the relief counts.
const SMALLEST_COMPLIANCE: f64 = 1e-3;
/// Classes of compliance to a factor of two: a preconditioner needs no more than two digits of it.
const CLASSES_PER_OCTAVE: f64 = 16.0;

/// The class of compliances `η/K₀₀` that are treated as one.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "rounded and clamped to the class's range"
)]
pub fn class(relative_compliance: f64) -> u16 {
    if relative_compliance < SMALLEST_COMPLIANCE {
        return 0;
    }
    let octaves = (relative_compliance / SMALLEST_COMPLIANCE).log2();
    1 + (CLASSES_PER_OCTAVE * octaves).round().clamp(0.0, 60_000.0) as u16
}

/// The `η/K₀₀` that stands for a class.
fn compliance_of(class: u16) -> f64 {
    if class == 0 {
        return 0.0;
    }
    SMALLEST_COMPLIANCE * (f64::from(class - 1) / CLASSES_PER_OCTAVE).exp2()
}

/// The system of one element, last, and its neighbours before it.
pub struct LocalSystem<'a> {
    pub elasticity: &'a SurfaceElasticity,
    /// Where the neighbours lie, in elements.
    pub places: &'a [[i32; 2]],
    /// Class of compliance of each neighbour.
    pub classes: &'a [u16],
    /// Class of the element itself.
    pub own_class: u16,
    /// Index of the element from each axis beyond which mirror images press too.
    pub to_axis: [Option<u32>; 2],
}

impl LocalSystem<'_> {
    /// `g` of `Lᵀ g = e_last`, where `L Lᵀ` is the system: the last row of the inverse of `L`.
    ///
    /// A system that is not positive definite up to rounding gives the element's own `1/√(K₀₀ + η)` and nothing else.
    pub fn row(&self) -> Vec<f64> {
        let n = self.places.len() + 1;
        let factor = self.cholesky();
        let mut g = vec![0.0; n];
        g[n - 1] = 1.0;
        for a in (0..n).rev() {
            g[a] /= factor[a * n + a];
            let (before, from_a) = g.split_at_mut(a);
            let column = &factor[a * n..a * n + a];
            before
                .iter_mut()
                .zip(column)
                .for_each(|(g, l)| *g -= l * from_a[0]);
        }
        if !g.iter().all(|g| g.is_finite()) {
            g.fill(0.0);
            g[n - 1] = 1.0 / self.entry(n - 1, n - 1).sqrt();
        }
        g
    }

    /// The lower factor, by rows.
    fn cholesky(&self) -> Vec<f64> {
        let n = self.places.len() + 1;
        let mut factor = vec![0.0; n * n];
        for a in 0..n {
            for b in 0..=a {
                let (row_a, row_b) = (&factor[a * n..a * n + b], &factor[b * n..b * n + b]);
                let known: f64 = row_a.iter().zip(row_b).map(|(x, y)| x * y).sum();
                let rest = self.entry(a, b) - known;
                factor[a * n + b] = if a == b {
                    rest.sqrt()
                } else {
                    rest / factor[b * n + b]
                };
            }
        }
        factor
    }

    /// `(K + η)_ab`.
    fn entry(&self, a: usize, b: usize) -> f64 {
        let [p, q] = [a, b].map(|a| self.places.get(a).copied().unwrap_or_default());
        let direct = [0, 1].map(|axis: usize| p[axis].abs_diff(q[axis]) as usize);
        // The image of index j lies at −1 − j: i + j + 1 from the index i.
        let mirrored = [0, 1].map(|axis: usize| {
            let twice = 2 * i64::from(self.to_axis[axis]?) + 1;
            usize::try_from(twice + i64::from(p[axis]) + i64::from(q[axis])).ok()
        });
        let along = |axis: usize| std::iter::once(direct[axis]).chain(mirrored[axis]);
        let elastic: f64 = along(0)
            .flat_map(|x| along(1).map(move |y| [x, y]))
            .map(|offset| self.elasticity.coefficient(offset))
            .sum();
        if a == b {
            let class = self.classes.get(a).copied().unwrap_or(self.own_class);
            elastic + self.elasticity.coefficient([0, 0]) * compliance_of(class)
        } else {
            elastic
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{class, compliance_of};

    #[test]
    fn a_class_keeps_a_compliance_to_three_percent() {
        // Half a class of 1/16 octave: 2^(1/32).
        for relative in [1e-3, 0.02, 0.7, 5.0, 1e6] {
            let found: f64 = compliance_of(class(relative)) / relative;
            assert!((found - 1.0).abs() < 0.023, "{relative}: {found}");
        }
        assert!(class(1e-4) == 0 && compliance_of(0) < f64::MIN_POSITIVE);
    }
}
