//! The surface stresses under the pressure alone and under the traction alone, computed where they are needed.

use std::collections::HashMap;

use pellicle_influence::{Depth, InfluenceError, PlaneFields, Squares, SurfaceMeans};
use rayon::prelude::*;

use super::edge_contact::Place;
use crate::stress::field::{LoadedSquare, StressField};

/// `σ_xx`, `σ_yy`, `σ_xy`, in Pa.
pub type Tensor = [f64; 3];

/// Offsets beyond those from one end of the loaded square to the other, in elements: the reach of the fits beyond the
/// edge.
const MARGIN: usize = 6;

/// From about this number of places on, a convolution is less work than sums.
const MOST_SUMS: usize = 400;
/// Indices of `σ_xx`, `σ_yy`, `σ_xy` among the fields of a plane.
const ALONG_SURFACE: [usize; 3] = [3, 4, 6];

/// The load that causes a stress.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Part {
    Normal,
    Tangential,
}

/// The stresses known so far.
pub struct SurfaceParts<'a> {
    field: &'a StressField,
    means: SurfaceMeans,
    known: HashMap<(Part, Place), Tensor>,
}

impl<'a> SurfaceParts<'a> {
    pub fn new(field: &'a StressField) -> Result<Self, InfluenceError> {
        let (foundation, side) = (field.tables().foundation(), field.grid().element_side());
        Ok(Self {
            field,
            means: SurfaceMeans::new(foundation, side, field.loaded().size + MARGIN)?,
            known: HashMap::new(),
        })
    }

    /// Computes the stresses at the places where they are not yet known; no farther from the loaded square than the
    /// fits reach.
    pub fn compute(&mut self, part: Part, places: &[Place]) {
        let LoadedSquare { size, pressure, .. } = self.field.loaded();
        let tractions = self.field.tractions();
        if part == Part::Tangential && !self.field.slides() {
            return;
        }
        let missing = places
            .par_iter()
            .filter(|place| !self.known.contains_key(&(part, **place)));
        let found: Vec<(Place, Tensor)> = missing
            .map(|place| {
                let stress = match part {
                    Part::Normal => self.means.under_pressure(pressure, *size, *place),
                    Part::Tangential => self
                        .means
                        .under_traction(pressure, *size, *place, tractions),
                };
                (*place, stress)
            })
            .collect();
        self.known.extend(
            found
                .into_iter()
                .map(|(place, stress)| ((part, place), stress)),
        );
    }

    /// The larger principal stresses along the surface at places within an element of the loaded square: at a few by
    /// sums, at many under centres by a convolution.
    pub fn tensions(&mut self, places: &[Place]) -> Result<Vec<f64>, InfluenceError> {
        if places.len() > MOST_SUMS {
            return self.tensions_by_convolution(places);
        }
        self.compute(Part::Normal, places);
        self.compute(Part::Tangential, places);
        let tension = |place: &Place| {
            let [normal, tangential] =
                [Part::Normal, Part::Tangential].map(|part| self.at(part, *place));
            larger_eigenvalue(std::array::from_fn(|i| normal[i] + tangential[i]))
        };
        Ok(places.iter().map(tension).collect())
    }

    fn tensions_by_convolution(&self, places: &[Place]) -> Result<Vec<f64>, InfluenceError> {
        let LoadedSquare { size, pressure, .. } = self.field.loaded();
        let (foundation, side) = (
            self.field.tables().foundation(),
            self.field.grid().element_side(),
        );
        let squares = Squares {
            loaded: *size,
            shown: size + 2,
            before: [1; 2],
        };
        let mut fields =
            PlaneFields::new(foundation, side, squares, pressure, self.field.tractions());
        let mut stresses = vec![[0.0; 3]; places.len()];
        fields.chosen_fields_on(Depth::below(0.0), &ALONG_SURFACE, |field, values| {
            let Some(index) = ALONG_SURFACE.iter().position(|other| *other == field) else {
                return;
            };
            for (stress, [i, j]) in stresses.iter_mut().zip(places) {
                stress[index] =
                    values[(i + 1).unsigned_abs() * (size + 2) + (j + 1).unsigned_abs()];
            }
        })?;
        Ok(stresses.into_iter().map(larger_eigenvalue).collect())
    }

    /// The stress at a place; 0 where it was not computed.
    pub fn at(&self, part: Part, place: Place) -> Tensor {
        self.known.get(&(part, place)).copied().unwrap_or_default()
    }
}

/// The larger principal stress along the surface.
pub fn larger_eigenvalue([xx, yy, xy]: Tensor) -> f64 {
    f64::midpoint(xx, yy) + (0.5 * (xx - yy)).hypot(xy)
}
