//! The grids of a path, from the coarsest to the finest, each set up when first needed, or the finest while the coarser
//! ones are solved.

use std::sync::Arc;
use std::time::Instant;

use pellicle_influence::{Origin, SurfaceElasticity};
use pellicle_texture::Grid;

use crate::{
    Boundary, CoarsePressure, ContactError, ContactSlope, Load, Model, RoughContact, SolverOptions,
    Step,
    grid::region::Region,
    path::ascent::Ascent,
    path::capacity,
    path::domain::Guess,
    path::level::{Level, LevelResult, LevelStart},
    path::levels::{COARSE_TOLERANCE, coarser_lengths, solved_grid},
    path::start::CoarserSolution,
    result::cut_off,
    solver::Watch,
};

/// Elements per side above which the finest grid is set up while the coarser ones are solved.
const BUILT_AHEAD: usize = 512;

/// Number of coarser grids whose pressures are kept on request: as many as an error estimate needs.
const COARSE_PRESSURES: usize = 3;

/// All grids over one domain.
pub struct Hierarchy<'a> {
    model: &'a Model,
    side: f64,
    /// In Pa.
    hardness: f64,
    /// The elements solved for on each grid, coarsest first.
    grids: Vec<Region>,
    /// The grids in memory. For a single load only the current one and the finest are kept; the finest takes most of
    /// the memory.
    levels: Vec<Option<Level>>,
    keep: bool,
    coefficients_seconds: f64,
    coefficients_origin: Option<Origin>,
}

impl<'a> Hierarchy<'a> {
    /// The grids for some loads on a domain, the finest of which is given.
    pub fn new(
        model: &'a Model,
        (grid, boundary): (Grid, Boundary),
        loads: &[Load],
        options: &SolverOptions,
    ) -> Self {
        let side = grid.side();
        let mut coarser = coarser_lengths(grid.lengths());
        // On a domain far larger than the indenter, a coarse grid may have no element under it.
        coarser.retain(|lengths| {
            Grid::oblong(side, *lengths).is_ok_and(|grid| {
                cut_off::can_touch(model, &grid)
                    && capacity::check(model, (&grid, boundary), loads, options.hardness).is_ok()
            })
        });
        if !options.shortcuts.coarser_grids {
            coarser.clear();
        }
        let finest = Region::bounded(solved_grid(model, &grid, boundary, options), boundary);
        let coarser = coarser
            .into_iter()
            .map(|lengths| finest.with_lengths(lengths));
        let grids: Vec<_> = coarser.chain([finest]).collect();
        Self {
            model,
            side,
            levels: grids.iter().map(|_| None).collect(),
            grids,
            hardness: options.hardness,
            keep: loads.len() > 1,
            coefficients_seconds: 0.0,
            coefficients_origin: None,
        }
    }

    /// Returns `lanes` hierarchies of the same grids, this one first, each to be used by one thread at a time.
    pub fn lanes(mut self, lanes: usize) -> Result<Vec<Self>, ContactError> {
        let copies = if lanes > 1 {
            for index in 0..self.grids.len() {
                if self.levels[index].is_none() {
                    self.levels[index] = Some(self.make(index)?);
                }
            }
            (1..lanes).map_while(|_| self.fresh_copy()).collect()
        } else {
            Vec::new()
        };
        Ok(std::iter::once(self).chain(copies).collect())
    }

    /// The same grids without the memory of any load; none if they are not all in memory.
    fn fresh_copy(&self) -> Option<Self> {
        let levels = self.levels.iter();
        let copies: Option<Vec<_>> = levels.map(|level| level.as_ref()?.fresh_copy()).collect();
        Some(Self {
            model: self.model,
            side: self.side,
            hardness: self.hardness,
            grids: self.grids.clone(),
            levels: copies?.into_iter().map(Some).collect(),
            keep: self.keep,
            coefficients_seconds: 0.0,
            coefficients_origin: self.coefficients_origin,
        })
    }

    /// Time spent on coefficients and sampling while no load was being solved, in s.
    pub fn coefficients_seconds(&self) -> f64 {
        self.coefficients_seconds
    }

    /// Origin of the coefficients of all grids together.
    pub fn coefficients_origin(&self) -> Origin {
        self.coefficients_origin.unwrap_or(Origin::Computed)
    }

    /// Returns the finest grid, and the elasticity of its elements if a load has reached it.
    pub fn into_finest(mut self) -> Result<(Grid, Option<Arc<SurfaceElasticity>>), ContactError> {
        let grid = self.grids[self.grids.len() - 1].whole_grid(self.side)?;
        let level = self.levels.pop().flatten();
        Ok((grid, level.map(Level::into_elasticity)))
    }

    /// Solves one load from the coarsest grid to the finest.
    pub fn solve(
        &mut self,
        load: Load,
        options: SolverOptions,
        watch: &mut Watch<'_>,
    ) -> Result<Step, ContactError> {
        let (clock, spent_before) = (Instant::now(), self.coefficients_seconds);
        let mut ascent = Ascent::of(load, options);
        let finest = self.grids.len() - 1;
        if self.is_worth_building_ahead() {
            self.ascend_while_building(&mut ascent, watch)?;
        } else {
            self.ascend(&mut ascent, finest, watch)?;
        }
        let result = self.solve_next(&mut ascent, watch)?;
        let on_coefficients = self.coefficients_seconds - spent_before;
        let seconds = clock.elapsed().as_secs_f64() - on_coefficients;
        Ok(ascent.into_step(result, seconds, self.model.tables.error_estimate()))
    }

    /// Solves a load on the grids below `end`.
    fn ascend(
        &mut self,
        ascent: &mut Ascent,
        end: usize,
        watch: &mut Watch<'_>,
    ) -> Result<(), ContactError> {
        while ascent.levels.len() < end {
            self.solve_next(ascent, watch)?;
        }
        Ok(())
    }

    /// Solves a load on the next finer grid.
    fn solve_next(
        &mut self,
        ascent: &mut Ascent,
        watch: &mut Watch<'_>,
    ) -> Result<LevelResult, ContactError> {
        let Ascent { load, options, .. } = *ascent;
        let start = match &ascent.coarser_solution {
            Some(coarser) => LevelStart::Coarser(coarser),
            // A guess is for a single contact.
            None if self.grids[0].repeats() || !options.shortcuts.guess => LevelStart::Nothing,
            None => Guess::new(self.model, load).map_or(LevelStart::Nothing, LevelStart::Guess),
        };
        let index = ascent.levels.len();
        let (result, coarser) = self.solve_level(index, load, start, options, watch)?;
        let finest = self.grids.len() - 1;
        if options.coarse_pressures && index < finest && index + COARSE_PRESSURES >= finest {
            ascent.coarser.push(CoarsePressure {
                grid: self.grids[index].whole_grid(self.side)?,
                pressure: result.region.scatter(result.solution.pressure.clone()),
            });
        }
        ascent.levels.push(result.work);
        ascent.values.push(result.values(load));
        ascent.coarser_solution = coarser;
        Ok(result)
    }

    /// Whether the finest grid is not yet set up and doing so can use threads left idle by the coarser grids.
    fn is_worth_building_ahead(&self) -> bool {
        let finest = self.grids.len() - 1;
        rayon::current_num_threads() > 1
            && self.levels[finest].is_none()
            && self.grids[finest].grid_size() >= BUILT_AHEAD
    }

    /// Solves on all grids except the finest, which is set up at the same time.
    fn ascend_while_building(
        &mut self,
        ascent: &mut Ascent,
        watch: &mut Watch<'_>,
    ) -> Result<(), ContactError> {
        let finest = self.grids.len() - 1;
        let (model, square) = (self.model, (self.side, self.grids[finest]));
        let (hardness, keeps) = (self.hardness, self.keep);
        let clock = Instant::now();
        let ((coarser, ascended), level) = rayon::join(
            || (self.ascend(ascent, finest, watch), clock.elapsed()),
            || Level::new(model, square, hardness, keeps),
        );
        // Time spent while the solution ran is not counted.
        let waited = clock.elapsed().saturating_sub(ascended);
        self.coefficients_seconds += waited.as_secs_f64();
        coarser?;
        let level = level?;
        self.note_origin(&level);
        self.levels[finest] = Some(level);
        Ok(())
    }

    /// Solves on one grid; also returns the start for the next finer one.
    fn solve_level(
        &mut self,
        index: usize,
        load: Load,
        start: LevelStart<'_>,
        options: SolverOptions,
        watch: &mut Watch<'_>,
    ) -> Result<(LevelResult, Option<CoarserSolution>), ContactError> {
        let is_finest = index + 1 == self.grids.len();
        let options = if is_finest {
            options
        } else {
            coarse_options(options)
        };
        let mut level = match self.levels[index].take() {
            Some(level) => level,
            None => self.make(index)?,
        };
        let mut result = level.solve(self.model, load, start, options, watch);
        let coarser = match &mut result {
            Ok(result) if is_finest => {
                let pressure = std::mem::take(&mut result.solution.pressure);
                let field = level.field(self.model, &result.region, &pressure);
                let (force, summary) = (result.solution.force, &mut result.summary);
                *summary = summary.with_least_area(force);
                result.rough = RoughContact::of(&field, summary.contact_area);
                let of_nominal = |rough: &RoughContact| force / rough.nominal_area;
                let nominal = result.rough.as_ref().map(of_nominal);
                summary.nominal_pressure = summary.nominal_pressure.or(nominal);
                result.slope = ContactSlope::of(&field, result.rough.as_ref());
                result.solution.pressure = result.region.scatter(pressure);
                None
            }
            Ok(result) => Some(level.as_coarser(result)),
            Err(_) => None,
        };
        level.release();
        if self.keep || is_finest {
            self.levels[index] = Some(level);
        }
        Ok((result?, coarser))
    }

    fn make(&mut self, index: usize) -> Result<Level, ContactError> {
        let clock = Instant::now();
        let square = (self.side, self.grids[index]);
        let level = Level::new(self.model, square, self.hardness, self.keep)?;
        self.coefficients_seconds += clock.elapsed().as_secs_f64();
        self.note_origin(&level);
        Ok(level)
    }

    fn note_origin(&mut self, level: &Level) {
        let origin = level.coefficients_origin;
        self.coefficients_origin = Some(match self.coefficients_origin {
            Some(others) => others.max(origin),
            None => origin,
        });
    }
}

/// The options of coarse grids, with a looser tolerance.
fn coarse_options(options: SolverOptions) -> SolverOptions {
    SolverOptions {
        tolerance: options.tolerance.max(COARSE_TOLERANCE),
        contact_stiffness: false,
        ..options
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use pellicle_influence::{Sector, SectorGrid};
    use pellicle_texture::Relief;

    use super::{Grid, Hierarchy, Region};
    use crate::{
        Boundary, Indenter, Load, Method, Model, Paraboloid, Pyramid, SolverOptions,
        path::levels::coarser_sizes,
    };

    fn model(indenter: Indenter) -> Model {
        Model::on_half_space([1.0, 0.0], Relief::Bare, indenter)
    }

    #[test]
    fn a_sector_is_solved_if_everything_is_symmetric_on_every_grid() {
        let paraboloid = model(Paraboloid::new(1.0).unwrap().into());
        let berkovich = model(Pyramid::berkovich(0.1).unwrap().into());
        let usual = SolverOptions::default();
        let active_set = SolverOptions {
            method: Method::ActiveSet,
            ..usual
        };
        let whole = SolverOptions {
            mirror_symmetry: false,
            ..usual
        };
        for (model, elements, options, sector) in [
            (&paraboloid, 64, usual, Sector::Quadrant),
            (&paraboloid, 66, usual, Sector::Quadrant),
            (&paraboloid, 65, usual, Sector::Whole),
            (&paraboloid, 64, active_set, Sector::Whole),
            (&paraboloid, 64, whole, Sector::Whole),
            (&berkovich, 64, usual, Sector::Half),
            (&berkovich, 65, usual, Sector::Whole),
            (&berkovich, 64, whole, Sector::Whole),
        ] {
            let grid = Grid::new(1.0, elements).unwrap();
            let (square, load) = ((grid, Boundary::Free), [Load::Force(1.0)]);
            let hierarchy = Hierarchy::new(model, square, &load, &options);
            let grids = hierarchy.grids.iter().map(Region::grid);
            let sizes = coarser_sizes(elements).into_iter().chain([elements]);
            let expected = sizes.map(|size| SectorGrid::of_square(sector, size));
            assert!(grids.eq(expected), "{elements} {options:?}");
        }
    }

    #[test]
    fn the_requested_number_of_lanes_share_their_grids() {
        let model = model(Paraboloid::new(1.0).unwrap().into());
        for lanes in [1, 3] {
            let grid = Grid::new(1.0, 32).unwrap();
            let (square, load) = ((grid, Boundary::Free), [Load::Force(1e-3); 3]);
            let hierarchy = Hierarchy::new(&model, square, &load, &SolverOptions::default());
            let lanes_made = hierarchy.lanes(lanes).unwrap();
            assert_eq!(lanes_made.len(), lanes);
            let surface = |lane: Hierarchy<'_>| lane.into_finest().unwrap().1;
            let mut surfaces = lanes_made.into_iter().filter_map(surface);
            let first = surfaces.next();
            // A single one sets up its grids when a load comes.
            assert_eq!(first.is_some(), lanes > 1);
            assert!(surfaces.all(|surface| Arc::ptr_eq(&surface, first.as_ref().unwrap())));
        }
    }
}
