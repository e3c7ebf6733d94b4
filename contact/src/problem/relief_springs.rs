//! The springs under a problem's elements: those of the relief, linear ones added to all, and the tangents of a law.

use pellicle_texture::SpringLaw;

use crate::{
    problem::{scale::Scale, tangents::Tangents},
    vector::update_with,
};

/// The springs, with one value of a field for each element.
#[derive(Debug, Clone)]
pub struct ReliefSprings {
    law: SpringLaw,
    /// `η` of the relief at rest, in m/Pa.
    relief: Vec<f64>,
    /// Whether the relief is rigid everywhere.
    is_rigid: bool,
    /// The compliance (m/Pa) of linear springs added to all elements, and that sum; none without.
    softened: Option<(f64, Vec<f64>)>,
    /// The tangents of nonlinear springs, once they have been linearised.
    tangents: Option<Tangents>,
}

impl ReliefSprings {
    /// Springs of a law with these compliances at rest (m/Pa), not yet linearised.
    pub fn new(law: SpringLaw, relief: Vec<f64>) -> Self {
        Self {
            law,
            is_rigid: relief.iter().all(|eta| *eta == 0.0),
            relief,
            softened: None,
            tangents: None,
        }
    }

    /// The relief's springs alone on some of the elements, of which a function returns the values.
    pub fn on_part(&self, values: impl Fn(&[f64]) -> Vec<f64>) -> Self {
        Self::new(self.law, values(&self.relief))
    }

    /// Takes another law for the relief's springs.
    pub fn take_law(&mut self, law: SpringLaw) {
        (self.law, self.tangents) = (law, None);
    }

    /// Adds linear springs of this compliance (m/Pa) to all elements, or removes them if it is 0; returns whether that
    /// changes anything.
    pub fn soften(&mut self, compliance: f64) -> bool {
        if compliance == 0.0 && self.softened.is_none() {
            return false;
        }
        let relief = self.relief.iter();
        let sum = || relief.map(|eta| eta + compliance).collect();
        self.softened = (compliance > 0.0).then(|| (compliance, sum()));
        self.tangents = None;
        true
    }

    /// Linearises nonlinear springs at a pressure ≥ 0, in the units of `scale`.
    pub fn linearise(&mut self, scale: Scale, pressure: &[f64]) {
        let (law, added) = (self.law, self.added());
        if self.tangents.is_none() {
            self.tangents = Tangents::at_rest(law, scale, &self.relief, added);
        }
        if let Some(tangents) = &mut self.tangents {
            tangents.take(&self.relief, pressure);
        }
    }

    /// The law of the relief's springs.
    pub fn law(&self) -> SpringLaw {
        self.law
    }

    /// `η` of the relief at rest, in m/Pa.
    pub fn relief(&self) -> &[f64] {
        &self.relief
    }

    /// The compliance (m/Pa) of the springs added to all elements; 0 without.
    pub fn added(&self) -> f64 {
        self.softened.as_ref().map_or(0.0, |(added, _)| *added)
    }

    /// The compliance (m/Pa) at rest of the relief and of the springs added to it.
    pub fn at_rest(&self) -> &[f64] {
        (self.softened.as_ref()).map_or(&self.relief, |(_, sum)| sum)
    }

    /// The tangents; none if the springs are linear or not yet linearised.
    pub fn tangents(&self) -> Option<&Tangents> {
        self.tangents.as_ref()
    }

    /// The compliance (m/Pa) of the linear problem: `η`, or that of the linearised springs.
    pub fn compliance(&self) -> &[f64] {
        (self.tangents.as_ref()).map_or(self.at_rest(), Tangents::compliance)
    }

    /// Whether the linear problem has no compliance anywhere.
    pub fn are_rigid(&self) -> bool {
        self.is_rigid && self.softened.is_none() && self.tangents.is_none()
    }

    /// Adds `w*(p)` (m) of the pressure `p` (Pa) to a deformation, with that of added springs.
    pub fn shorten_into(&self, pressure: &[f64], deformation: &mut [f64]) {
        let (law, added) = (self.law, self.added());
        update_with(deformation, &self.relief, pressure, |v, eta, p| {
            *v += law.shortening(*eta, *p) + added * p;
        });
    }
}
