//! The system `F_EE s = −(F r)_E` of the band, by conjugate gradients in single precision.
//!
//! A group of adjacent places is computed at once, in few sweeps over the band: they take most of the time of the
//! filter where the contact is large.

use pulp::Arch;
use rayon::prelude::*;

use super::{
    ACCURACY, MOST_STEPS,
    layout::{Elements, Layout},
    stencil::{Group, Lanes, SingleStencil, Stencils, TOGETHER},
};

/// Groups per thread.
const GROUPS: usize = 1 << 10;

/// The system, its fields by group, and the field to which the stencil is applied.
pub struct BandSystem {
    layout: Layout,
    coefficients: SingleStencil,
    /// Mirror images across axes of symmetry: their place, and that of the element.
    images: Vec<[usize; 2]>,
    /// The direction: 0 except on the band and its mirror images.
    spread: Vec<f32>,
    residual: Vec<Lanes>,
    solution: Vec<Lanes>,
    image: Vec<Lanes>,
}

impl BandSystem {
    pub fn new(layout: Layout) -> Self {
        Self {
            layout,
            coefficients: SingleStencil::default(),
            images: Vec::new(),
            spread: vec![0.0; layout.places()],
            residual: Vec::new(),
            solution: Vec::new(),
            image: Vec::new(),
        }
    }

    /// Sets the coefficients of `F`, by offset along the axes, in units of the first.
    pub fn take_coefficients(&mut self, coefficients: SingleStencil) {
        self.coefficients = coefficients;
    }

    /// Leaves a band.
    pub fn leave(&mut self, band: &Elements) {
        for group in &band.groups {
            self.spread[group.range()].fill(0.0);
        }
        self.images
            .iter()
            .for_each(|[image, _]| self.spread[*image] = 0.0);
    }

    /// Turns to a band.
    pub fn enter(&mut self, band: &Elements) {
        self.images.clear();
        if self.layout.beyond != [0; 2] {
            for [element, place] in band.groups.iter().flat_map(Group::elements) {
                let images = self.layout.images(element);
                self.images.extend(images.map(|image| [image, place]));
            }
        }
        for field in [&mut self.residual, &mut self.solution, &mut self.image] {
            field.resize(band.groups.len(), [0.0; TOGETHER]);
        }
    }

    /// Solves for `s` from `filtered`, `F r`, in units that it returns times the first coefficient; none if that is
    /// zero or not finite.
    pub fn solve(&mut self, band: &Elements, filtered: &[f64]) -> Option<f64> {
        let groups = &band.groups;
        let elements = groups.iter().flat_map(Group::elements);
        let values = elements.map(|[element, _]| filtered[element].abs());
        let unit = power_of_two(values.fold(0.0, f64::max))?;
        for (group, residual) in groups.iter().zip(&mut self.residual) {
            *residual = group.read(filtered, -1.0 / unit);
        }
        self.solution.fill([0.0; TOGETHER]);
        self.image.fill([0.0; TOGETHER]);
        let start = self.step(groups, 0.0);
        let mut product = start;
        self.turn(groups, None);
        for _ in 0..MOST_STEPS {
            let curvature = self.image(groups);
            let alpha = product / curvature;
            // Truncated at the reach, `F_EE` may be indefinite under a stiff coating.
            if !(alpha > 0.0 && alpha.is_finite()) {
                break;
            }
            let before = product;
            product = self.step(groups, alpha);
            if product <= ACCURACY * ACCURACY * start {
                break;
            }
            self.turn(groups, Some(product / before));
        }
        (start > 0.0 && start.is_finite()).then_some(unit)
    }

    /// `s` by group, in the unit of the last solution.
    pub fn solution(&self) -> &[Lanes] {
        &self.solution
    }

    /// `F s` on other elements, by group, in the unit of the last solution times the first coefficient.
    pub fn answers(&mut self, band: &Elements, others: &Elements) -> Vec<Lanes> {
        for (group, s) in band.groups.iter().zip(&self.solution) {
            self.spread[group.range()].copy_from_slice(s);
        }
        self.reflect();
        let mut answers = vec![[0.0; TOGETHER]; others.groups.len()];
        let parts = answers
            .par_chunks_mut(GROUPS)
            .zip(others.groups.par_chunks(GROUPS));
        parts.for_each(|(answers, groups)| {
            self.stencil(groups, answers);
        });
        answers
    }

    /// `d ← r + β d`, at first `d ← r`.
    fn turn(&mut self, groups: &[Group], beta: Option<f32>) {
        for (group, r) in groups.iter().zip(&self.residual) {
            let direction = self.spread[group.range()].iter_mut().zip(r);
            direction.for_each(|(d, r)| *d = r + beta.map_or(0.0, |beta| beta * *d));
        }
        self.reflect();
    }

    /// Copies the direction to the mirror images.
    fn reflect(&mut self) {
        for [image, place] in &self.images {
            self.spread[*image] = self.spread[*place];
        }
    }

    /// Computes `F_EE d`; returns `d·F_EE d`.
    fn image(&mut self, groups: &[Group]) -> f32 {
        let mut image = std::mem::take(&mut self.image);
        let parts = image.par_chunks_mut(GROUPS).zip(groups.par_chunks(GROUPS));
        let parts = parts.map(|(image, groups)| self.stencil(groups, image));
        let curvature = parts.collect::<Vec<f32>>().iter().sum();
        self.image = image;
        curvature
    }

    /// Writes the sums of the field times the coefficients around the elements of some groups; returns their product
    /// with the field.
    fn stencil(&self, groups: &[Group], sums: &mut [Lanes]) -> f32 {
        Arch::new().dispatch(Stencils {
            groups,
            field: &self.spread,
            width: self.layout.width(),
            coefficients: &self.coefficients,
            sums,
        })
    }

    /// `s ← s + α d`, `r ← r − α F_EE d`; returns `r·r`.
    fn step(&mut self, groups: &[Group], alpha: f32) -> f32 {
        let (spread, size) = (&self.spread, GROUPS);
        let parts = self
            .solution
            .par_chunks_mut(size)
            .zip(self.residual.par_chunks_mut(size));
        let parts = parts.zip(groups.par_chunks(size).zip(self.image.par_chunks(size)));
        let parts = parts.map(|((solution, residual), (groups, image))| {
            let mut product = [0.0; TOGETHER];
            let fields = solution
                .iter_mut()
                .zip(residual)
                .zip(groups.iter().zip(image));
            for ((s, r), (group, image)) in fields {
                let direction = &spread[group.range()];
                for k in 0..TOGETHER {
                    s[k] += alpha * direction[k];
                    r[k] -= alpha * image[k];
                    product[k] += r[k] * r[k];
                }
            }
            product.iter().sum()
        });
        parts.collect::<Vec<f32>>().iter().sum()
    }
}

/// The largest power of two up to a number, so that single precision holds the quotient and no digit changes; none if
/// it is 0 or not finite.
fn power_of_two(number: f64) -> Option<f64> {
    (number > 0.0 && number.is_finite()).then(|| number.log2().floor().exp2())
}
