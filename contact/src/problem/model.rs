//! The model: foundation, relief and indenter, before any grid; and its samples on a grid.

use std::sync::Arc;

use pellicle_influence::{Cache, Cached, RadialTables, Sector, SurfaceElasticity};
use pellicle_texture::{Grid, Relief, SampledRelief};
use rayon::prelude::*;

use crate::{Boundary, ContactError, DiscreteProblem, Indenter, Profile};

/// An indenter above a relief on an elastic foundation, with no grid and no load yet.
#[derive(Debug, Clone)]
pub struct Model {
    /// Radial tables of the foundation, and of the indenter where that is elastic: their counterbody. Shared, because
    /// they do not depend on the grid.
    pub tables: Arc<RadialTables>,
    /// The relief on the surface.
    pub relief: Relief,
    /// The body pressed into it.
    pub indenter: Indenter,
    /// Where coefficients are looked for and kept, across the grids of a path and the paths of a model;
    /// [`Cache::none`] if nothing is to be kept.
    pub cache: Cache,
}

/// The geometry of a [`Model`] sampled at the element centres of a grid; fields hold N² values.
#[derive(Debug, Clone)]
pub struct SampledModel {
    /// The grid.
    pub grid: Grid,
    /// Mask, profile `f*` and compliance `η` of the relief.
    pub relief: SampledRelief,
    /// Indenter profile `f`, in m.
    pub indenter_profile: Vec<f64>,
}

/// The geometry of a [`Model`] at the elements of a sector of a grid.
pub(crate) struct SampledSector {
    /// Whether an element lies on the relief.
    pub mask: Vec<bool>,
    /// `η` of the relief, in m/Pa.
    pub compliance: Vec<f64>,
    /// `g0 = f − f*`, in m.
    pub initial_gap: Vec<f64>,
}

impl Model {
    /// Samples the geometry on a grid of `size` × `size` elements over a square of side `side` (m).
    ///
    /// # Errors
    /// A side or size that is no grid.
    pub fn sample(&self, side: f64, size: usize) -> Result<SampledModel, ContactError> {
        let grid = Grid::new(side, size)?;
        Ok(SampledModel::on(grid, &self.relief, &self.indenter))
    }

    /// The geometry on a sector of a grid, of the whole of any, of another of an even one.
    pub(crate) fn sample_sector(&self, grid: Grid, sector: Sector) -> SampledSector {
        let (indenter_profile, relief) = match sector {
            Sector::Whole => {
                let sampled = SampledModel::on(grid, &self.relief, &self.indenter);
                (sampled.indenter_profile, sampled.relief)
            }
            Sector::Half | Sector::Quadrant => {
                let first = sector.first_index(grid.size());
                (
                    self.indenter
                        .heights(&grid.sample_from(first, |point| point)),
                    self.relief.sample_from(&grid, first),
                )
            }
        };
        let (mask, profile, compliance) = relief.into_parts();
        SampledSector {
            mask,
            compliance,
            initial_gap: initial_gap(&indenter_profile, &profile),
        }
    }

    /// The discrete problem of a sampled model: coefficients, operator, symbol, `η` and `g0 = f − f*`; and where the
    /// coefficients came from.
    ///
    /// # Errors
    /// Coefficients that cannot be had to their accuracy on this grid; an indenter that misses the grid.
    pub fn discretize(
        &self,
        sampled: &SampledModel,
    ) -> Result<Cached<DiscreteProblem>, ContactError> {
        self.discretize_within(sampled, Boundary::Free)
    }

    /// The same of a periodic cell, which the grid fills.
    ///
    /// # Errors
    /// As [`Self::discretize`].
    pub fn discretize_cell(
        &self,
        sampled: &SampledModel,
    ) -> Result<Cached<DiscreteProblem>, ContactError> {
        self.discretize_within(sampled, Boundary::Periodic)
    }

    fn discretize_within(
        &self,
        sampled: &SampledModel,
        boundary: Boundary,
    ) -> Result<Cached<DiscreteProblem>, ContactError> {
        let Cached { value, origin } = self.elasticity(&sampled.grid)?;
        let initial_gap = initial_gap(&sampled.indenter_profile, sampled.relief.profile());
        let (compliance, area) = (sampled.relief.compliance(), sampled.grid.element_area());
        let around = (Sector::Whole, boundary);
        let value =
            DiscreteProblem::of_sector(value, around, compliance.to_vec(), initial_gap, area)?;
        let value = value.with_spring_law(sampled.relief.spring_law());
        Ok(Cached { value, origin })
    }

    /// The smallest sector that stands for all of an even grid: in its axes indenter and relief are their own mirror
    /// images, and the solution with them.
    #[must_use]
    pub fn sector(&self) -> Sector {
        match (self.indenter.is_mirrored(), self.relief.is_mirrored()) {
            (true, true) => Sector::Quadrant,
            (_, true) if self.indenter.is_mirrored_in_y() => Sector::Half,
            _ => Sector::Whole,
        }
    }

    /// The elasticity of a grid's elements, and where its coefficients came from.
    pub(crate) fn elasticity(
        &self,
        grid: &Grid,
    ) -> Result<Cached<Arc<SurfaceElasticity>>, ContactError> {
        let table = (self.cache).coefficients(&self.tables, grid.element_side(), grid.size())?;
        let bodies = self.tables.bodies().clone();
        Ok(Cached {
            value: Arc::new(SurfaceElasticity::new(table.value, bodies)),
            origin: table.origin,
        })
    }
}

impl SampledModel {
    /// Relief and indenter on a grid.
    pub(crate) fn on(grid: Grid, relief: &Relief, indenter: &Indenter) -> Self {
        Self {
            grid,
            relief: relief.sample(&grid),
            indenter_profile: if indenter.is_mirrored() {
                grid.sample(true, |[x, y]| indenter.height(x, y))
            } else {
                indenter.heights(&grid.sample(false, |point| point))
            },
        }
    }
}

/// `g0 = f − f*`, in m.
pub(crate) fn initial_gap(indenter_profile: &[f64], relief_profile: &[f64]) -> Vec<f64> {
    let profiles = indenter_profile.par_iter().zip(relief_profile);
    profiles.map(|(f, relief)| f - relief).collect()
}
