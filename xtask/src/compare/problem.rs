//! The two problems as models of Pellicle: the same definition as in `xtask/compare/problem.py`.
//!
//! Everything is dimensionless. A rigid paraboloid of radius `R = 1` is pressed on a homogeneous half-space of
//! plane-strain modulus `E* = 1` by the force `F = 4 E* a³/(3R)` of the Hertzian contact radius `a = 0.15`; the
//! pressure acts inside a square of side 1. The pillars are rigid (`η = 0`), `0.1 d_H` high with `d_H = a²/R`; their
//! axes form a square lattice of period `T` = 16 elements, the first at `(T/2, T/2)` from the corner of the square,
//! and an element stands on a pillar if its centre lies within `0.4 T` of the pillar's axis.

use std::sync::Arc;

use pellicle_contact::{Domain, Indenter, Load, Model, Paraboloid};
use pellicle_influence::{Cache, RadialTables};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::{CylinderSpec, Cylinders, Lattice, Relief};

use super::Case;
use crate::XtaskError;

const SIDE: f64 = 1.0;
const INDENTER_RADIUS: f64 = 1.0;
const CONTACT_RADIUS: f64 = 0.15;
const HERTZ_APPROACH: f64 = CONTACT_RADIUS * CONTACT_RADIUS / INDENTER_RADIUS;
const PILLAR_HEIGHT: f64 = 0.1 * HERTZ_APPROACH;
const ELEMENTS_PER_PERIOD: usize = 16;
const RADIUS_OVER_PERIOD: f64 = 0.4;
/// Modulus of the pillars. Their shortening `η p` is then below 1e-33, and adding it to a displacement of 1e-2 changes
/// no bit: they are rigid.
const PILLAR_MODULUS: f64 = 1e30;

/// One case on a grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Problem {
    case: Case,
    elements: usize,
}

impl Problem {
    /// A case on `elements` × `elements` elements.
    ///
    /// # Errors
    /// [`XtaskError::Size`] unless whole periods of pillars fill the grid; asked of both cases, so that one list of
    /// sizes serves both.
    pub fn new(case: Case, elements: usize) -> Result<Self, XtaskError> {
        let period = ELEMENTS_PER_PERIOD;
        if elements == 0 || !elements.is_multiple_of(period) {
            return Err(XtaskError::Size {
                found: elements,
                period,
            });
        }
        Ok(Self { case, elements })
    }

    /// The case.
    #[must_use]
    pub fn case(&self) -> Case {
        self.case
    }

    /// Elements per side.
    #[must_use]
    pub fn elements(&self) -> usize {
        self.elements
    }

    /// The square on which pressure may act.
    #[must_use]
    pub fn domain(&self) -> Domain {
        Domain::Side(SIDE)
    }

    /// The force of the Hertzian contact radius.
    #[must_use]
    pub fn load(&self) -> Load {
        // F = 4 E* a³/(3R)
        Load::Force(4.0 * CONTACT_RADIUS.powi(3) / (3.0 * INDENTER_RADIUS))
    }

    /// Foundation, relief and indenter; nothing is precomputed and nothing is kept.
    ///
    /// # Errors
    /// None for a problem that could be made; those of the crates' constructors in principle.
    pub fn model(&self) -> Result<Model, XtaskError> {
        // E* = E/(1 − ν²) = 1
        let foundation = Foundation::half_space(Material::new(1.0, 0.0)?);
        Ok(Model {
            tables: Arc::new(RadialTables::build(&foundation)?),
            relief: self.relief()?,
            indenter: Indenter::Paraboloid(Paraboloid::new(INDENTER_RADIUS)?),
            cache: Cache::none(),
        })
    }

    fn relief(&self) -> Result<Relief, XtaskError> {
        match self.case {
            Case::Hertz => Ok(Relief::Bare),
            Case::Pillars => Ok(Relief::Cylinders(Cylinders::new(self.pillars())?)),
        }
    }

    fn pillars(&self) -> CylinderSpec {
        let period = SIDE * ELEMENTS_PER_PERIOD as f64 / self.elements as f64;
        CylinderSpec {
            lattice: Lattice::Square,
            radius: RADIUS_OVER_PERIOD * period,
            height: PILLAR_HEIGHT,
            period,
            offset: [0.5 * (period - SIDE); 2],
            young_modulus: PILLAR_MODULUS,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gap(case: Case, elements: usize) -> Vec<f64> {
        let model = Problem::new(case, elements).unwrap().model().unwrap();
        let sampled = model.sample(SIDE, elements).unwrap();
        let profiles = sampled
            .indenter_profile
            .iter()
            .zip(sampled.relief.profile());
        profiles.map(|(f, relief)| f - relief).collect()
    }

    #[test]
    fn pillars_are_the_paraboloid_above_a_pattern_counted_in_elements() {
        let (bare, pillars) = (gap(Case::Hertz, 64), gap(Case::Pillars, 64));
        for (index, (f, gap)) in bare.iter().zip(&pillars).enumerate() {
            // Twice the distance from the axis of the pillar in elements, per direction: odd integers up to 15.
            let twice = [index / 64, index % 64].map(|i| (2 * (i % 16)).abs_diff(15));
            // 2 · 0.4 · 16 = 12.8, squared.
            let on_pillar = (twice[0].pow(2) + twice[1].pow(2)) as f64 <= 163.84;
            let height = if on_pillar { 0.0 } else { 0.1 * 0.0225 };
            // One rounding of a sum below 0.3.
            assert!((gap - f - height).abs() < 1e-16, "element {index}");
        }
    }

    #[test]
    fn the_paraboloid_is_at_the_elements_centres() {
        let gap = gap(Case::Hertz, 16);
        // x = −1/2 + 1/32, y = −1/2 + 3/32
        approx::assert_relative_eq!(gap[1], f64::midpoint(225.0, 169.0) / 1024.0);
    }

    #[test]
    fn a_grid_that_pillars_do_not_fill_is_refused() {
        for elements in [0, 8, 100] {
            assert!(Problem::new(Case::Pillars, elements).is_err());
        }
    }
}
