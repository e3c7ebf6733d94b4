//! The model of foundation, relief and indenter, independent of a grid, and its samples on a grid.

use std::sync::Arc;

use pellicle_influence::{Cache, Cached, ElasticBody, RadialTables, Sector, SurfaceElasticity};
use pellicle_texture::{Grid, Relief, SampledRelief};
use rayon::prelude::*;

use crate::{
    Boundary, ContactError, DiscreteProblem, Indenter, Profile, grid::region::Region,
    problem::support::choice::under, vector::update,
};

/// An indenter above a relief on an elastic foundation, without a grid or load.
#[derive(Debug, Clone)]
pub struct Model {
    /// Radial tables of the foundation, and of the indenter's body as its counterbody. Shared, because they do not
    /// depend on the grid.
    pub tables: Arc<RadialTables>,
    /// The relief on the surface.
    pub relief: Relief,
    /// The body pressed into it.
    pub indenter: Indenter,
    /// Cache of coefficients across the grids of a path and the paths of a model; [`Cache::none`] for no cache.
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

/// The geometry of a [`Model`] at the elements of a region.
pub(crate) struct SampledRegion {
    /// Whether an element lies on the relief.
    pub mask: Vec<bool>,
    /// `η` of the relief, in m/Pa.
    pub compliance: Vec<f64>,
    /// `g0 = f − f*`, in m.
    pub initial_gap: Vec<f64>,
}

impl Model {
    /// The model with this body as the foundation: the same pressures, and the stresses inside that body. The relief
    /// and the indenter's shape are the same, since only the gap between the bodies matters.
    #[must_use]
    pub fn seen_from(&self, body: ElasticBody) -> Self {
        let mut model = self.clone();
        if body == ElasticBody::Counterbody {
            model.tables = Arc::new(self.tables.swapped());
        }
        model
    }

    /// Samples the geometry on a grid of `size` × `size` elements over a square of side `side` (m).
    ///
    /// # Errors
    /// A side or size that is not valid for a grid.
    pub fn sample(&self, side: f64, size: usize) -> Result<SampledModel, ContactError> {
        let grid = Grid::new(side, size)?;
        Ok(SampledModel::on(grid, &self.relief, &self.indenter))
    }

    /// Samples the geometry at the elements of a grid in a region that is all of it or of its half or quadrant.
    pub(crate) fn sample_on(&self, grid: Grid, region: &Region) -> SampledRegion {
        let has_images = region.weight() > 1;
        let relief = if has_images {
            self.relief.sample_from(&grid, region.first_index())
        } else {
            self.relief.sample(&grid)
        };
        let (mask, mut gap, compliance) = relief.into_parts();
        // g0 = f − f*, stored in the profile's memory.
        let rule = |gap: &mut f64, f: &f64| *gap = f - *gap;
        if self.indenter.is_mirrored() && !has_images {
            let [rows, columns] = grid.lengths();
            let first = grid.lengths().map(|length| length / 2);
            let quadrant = grid.sample_from(first, |[x, y]| self.indenter.height(x, y));
            let image = |i: usize| (2 * i).abs_diff(rows - 1) / 2;
            let rows = gap.par_chunks_exact_mut(columns).enumerate();
            rows.for_each(|(i, row)| {
                let width = columns - first[1];
                let heights = &quadrant[image(i) * width..][..width];
                let (left, right) = row.split_at_mut(first[1]);
                let mirrored = heights.iter().skip(columns % 2);
                left.iter_mut()
                    .rev()
                    .zip(mirrored)
                    .for_each(|(gap, f)| rule(gap, f));
                right
                    .iter_mut()
                    .zip(heights)
                    .for_each(|(gap, f)| rule(gap, f));
            });
        } else {
            let points = grid.sample_from(region.first_index(), |point| point);
            update(&mut gap, &self.indenter.heights(&points), rule);
        }
        SampledRegion {
            mask,
            compliance,
            initial_gap: gap,
        }
    }

    /// Builds the discrete problem of a sampled model (coefficients, operator, symbol, `η` and `g0 = f − f*`); also
    /// returns the origin of the coefficients.
    ///
    /// # Errors
    /// Coefficients that do not reach their accuracy on this grid; an indenter that covers no element of the grid.
    pub fn discretize(
        &self,
        sampled: &SampledModel,
    ) -> Result<Cached<DiscreteProblem>, ContactError> {
        self.discretize_within(sampled, Boundary::Free)
    }

    /// The same for a periodic cell, which the grid fills.
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
        let region = Region::of_grid(&sampled.grid, boundary);
        let support = under(value, region);
        let value = DiscreteProblem::on(support, compliance.to_vec(), initial_gap, area)?;
        let value = value.with_spring_law(sampled.relief.spring_law());
        Ok(Cached { value, origin })
    }

    /// The smallest sector that represents an even grid: indenter and relief are symmetric about its axes, and so is
    /// the solution.
    #[must_use]
    pub fn sector(&self) -> Sector {
        match (self.indenter.is_mirrored(), self.relief.is_mirrored()) {
            (true, true) => Sector::Quadrant,
            (_, true) if self.indenter.is_mirrored_in_y() => Sector::Half,
            _ => Sector::Whole,
        }
    }

    /// The elasticity of a grid's elements, with the origin of its coefficients.
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
    /// Samples relief and indenter on a grid.
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

#[cfg(test)]
impl Model {
    /// A half-space of this Young's modulus (Pa) and Poisson's ratio under a relief and an indenter, for tests.
    pub(crate) fn on_half_space(
        [young_modulus, poisson_ratio]: [f64; 2],
        relief: Relief,
        indenter: impl Into<Indenter>,
    ) -> Self {
        let material = pellicle_kernel::Material::new(young_modulus, poisson_ratio).unwrap();
        Self::on(
            &pellicle_kernel::Foundation::half_space(material),
            relief,
            indenter,
        )
    }

    /// A body under a relief and an indenter, for tests.
    pub(crate) fn on(
        body: &pellicle_kernel::Foundation,
        relief: Relief,
        indenter: impl Into<Indenter>,
    ) -> Self {
        Self {
            tables: Arc::new(RadialTables::build(body).unwrap()),
            relief,
            indenter: indenter.into(),
            cache: Cache::none(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Paraboloid;
    use pellicle_texture::{HeightMap, MapCompliance, ReliefMap};

    #[test]
    fn the_initial_gap_is_the_difference_of_the_sampled_profiles() {
        let heights: Vec<f64> = (0..12).map(|k| f64::from(k * k % 7)).collect();
        let map = HeightMap::new(heights, [3, 4], [1.0; 2]).unwrap();
        let model = Model::on_half_space(
            [1.0, 0.3],
            Relief::Map(ReliefMap::new(map, MapCompliance::YoungModulus(2.0)).unwrap()),
            Paraboloid::new(0.7).unwrap(),
        );
        for size in [1, 2, 7, 8] {
            let grid = Grid::new(1.2, size).unwrap();
            let sampled = SampledModel::on(grid, &model.relief, &model.indenter);
            let expected = initial_gap(&sampled.indenter_profile, sampled.relief.profile());
            let found = model.sample_on(grid, &Region::whole(size));
            assert_eq!(found.initial_gap, expected);
            assert_eq!(found.compliance, sampled.relief.compliance());
        }
    }
}
