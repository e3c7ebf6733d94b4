//! Derivatives of a model's springs by one of its numbers.

use pellicle_texture::SpringLaw;

use crate::{grid::region::Region, vector::dot};

/// Derivatives of springs by one number θ, per unit of θ.
pub enum SpringChange {
    /// `η_θ`.
    Linear(Vec<f64>),
    /// Law and compliance at rest one step above and one step below θ.
    Stiffening([(SpringLaw, Vec<f64>); 2], f64),
}

impl SpringChange {
    /// Forms the derivatives from springs one step above and one step below.
    pub fn of(more: (SpringLaw, Vec<f64>), less: (SpringLaw, Vec<f64>), step: f64) -> Self {
        if more.0.is_linear() {
            Self::Linear(difference(&more.1, &less.1, step))
        } else {
            Self::Stiffening([more, less], step)
        }
    }

    /// `w*_θ(p)` and `Σ ∂/∂θ ∫ w* dp` under a pressure on a region.
    pub fn under(&self, region: &Region, pressure: &[f64]) -> (Vec<f64>, f64) {
        match self {
            Self::Linear(compliance) => {
                let springs = region.cut(compliance);
                let image = springs.iter().zip(pressure).map(|(eta, p)| eta * p);
                let image: Vec<f64> = image.collect();
                let energy = 0.5 * dot(pressure, &image);
                (image, energy)
            }
            Self::Stiffening(both, step) => {
                let [more, less] = both.each_ref().map(|(law, compliance)| {
                    let springs = region.cut(compliance);
                    let pairs = springs.iter().zip(pressure);
                    let shortening = pairs.clone().map(|(eta, p)| law.shortening(*eta, *p));
                    let energy: f64 = pairs.map(|(eta, p)| law.energy(*eta, *p)).sum();
                    (shortening.collect::<Vec<f64>>(), energy)
                });
                let image = difference(&more.0, &less.0, *step);
                (image, (more.1 - less.1) / (2.0 * step))
            }
        }
    }
}

/// `(more − less)/(2 step)`; 0 where both are infinite, beyond the indenter's end.
pub(super) fn difference(more: &[f64], less: &[f64], step: f64) -> Vec<f64> {
    let pairs = more.iter().zip(less);
    let slope = |(more, less): (&f64, &f64)| {
        if more.is_finite() && less.is_finite() {
            (more - less) / (2.0 * step)
        } else {
            0.0
        }
    };
    pairs.map(slope).collect()
}

#[cfg(test)]
mod tests {
    use super::difference;

    #[test]
    fn differences_are_central_and_zero_beyond_the_rim_of_an_indenter() {
        let end = f64::INFINITY;
        let found = difference(&[3.0, end, end, -1.0], &[1.0, end, 2.0, end], 0.25);
        assert_eq!(found, [4.0, 0.0, 0.0, 0.0]);
    }
}
