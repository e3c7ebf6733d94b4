//! The choice of the domain: first guesses judged by a solution on a coarse grid, which does not depend on the later
//! grids.
//!
//! The sides tried are the first guess times powers of 1.5. A square fits if the contact of the largest load stays
//! clear of its edge and nothing outside would touch. If the contact is a small part of the square, a smaller one is
//! tried.

use std::ops::ControlFlow;

use super::{default_side_at, largest, radius_at};
use crate::{
    Boundary, ContactError, Indenter, Load, Model, SolverOptions, Step,
    path::capacity,
    path::hierarchy::Hierarchy,
    path::levels::COARSE_TOLERANCE,
    path::warnings::EDGE_MARGIN,
    result::cut_off::{self, Surroundings},
    solver::Watch,
};
use pellicle_texture::{Grid, Relief};

/// Elements per side of the grid of a trial.
const TRIAL: usize = 64;
/// The same for the coarser grids tried first, which usually suffice: on them a contact is known to half an element.
const FIRST_TRIALS: [usize; 2] = [16, 32];
/// Tolerance on these grids: a tenth of the effect of one element, relative to the penetration.
const FIRST_TOLERANCE: f64 = 1e-3;
/// Sides tried are the first guess times powers of this.
const FACTOR: f64 = 1.5;
/// Most products of a trial, whose iterate is then used as it is: the edge of the contact is known long before.
const MOST_PRODUCTS: usize = 300;
/// Half width of the contact under the first guess, in elements of a trial; sides are shrunk to this.
const USUAL_EXTENT: f64 = 64.0 / 3.0;
/// A contact that extends over fewer elements than this from the middle needs a smaller square.
const SMALLEST_EXTENT: usize = 8;
/// Far more trials than any case has been seen to take.
const MOST_TRIALS: usize = 100;

/// The side (m) of the square that [`Domain::Automatic`](crate::Domain::Automatic) solves all `loads` on. It does not
/// depend on the grid.
///
/// # Errors
/// An invalid load; coefficients that miss their accuracy; a contact that reaches the edge of every square tried.
pub fn choose_side(model: &Model, loads: &[Load]) -> Result<f64, ContactError> {
    choose_side_at(model, loads, f64::INFINITY)
}

/// The same with a hardness (Pa) that limits the pressure; infinite for no limit.
///
/// # Errors
/// As [`choose_side`]; [`ContactError::BeyondHardness`] if the whole area under the indenter cannot carry a force at
/// the hardness.
pub fn choose_side_at(model: &Model, loads: &[Load], hardness: f64) -> Result<f64, ContactError> {
    for load in loads {
        load.checked()?;
    }
    let mut search = SideSearch {
        first: default_side_at(model, loads, hardness),
        power: 0,
        small: None,
        large: None,
    };
    // A plane covers the whole map.
    let is_plane = matches!(model.indenter, Indenter::Plane(_));
    if is_plane || (hardness.is_infinite() && is_known_beforehand(model)) {
        return Ok(search.side());
    }
    let presses = |load: &Load| !matches!(load, Load::Penetration(depth) if *depth <= 0.0);
    let loads: Vec<Load> = largest(loads).filter(presses).collect();
    for _ in 0..MOST_TRIALS {
        let side = search.side();
        // If one load needs a larger square, no other can need a smaller one.
        let mut verdict = None;
        for load in &loads {
            let found = judge(model, side, *load, hardness)?;
            verdict = Some(verdict.map_or(found, |other: SquareVerdict| other.max(found)));
        }
        let verdict = verdict.unwrap_or(SquareVerdict::Fits);
        if let ControlFlow::Break(side) = search.advance(verdict) {
            return Ok(side);
        }
    }
    Err(ContactError::DomainTooSmall {
        side: search.side(),
        trials: MOST_TRIALS,
    })
}

/// Whether the first guess is exact: an axisymmetric indenter on a homogeneous body.
fn is_known_beforehand(model: &Model) -> bool {
    let is_axisymmetric = matches!(
        model.indenter,
        Indenter::Paraboloid(_)
            | Indenter::Sphere(_)
            | Indenter::Cone(_)
            | Indenter::PowerLaw(_)
            | Indenter::FlatPunch(_)
    );
    let is_bare = matches!(model.relief, Relief::Bare);
    is_axisymmetric && is_bare && !model.tables.bodies().have_layers()
}

/// The verdict of a trial on its square, ordered by the size of square required.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum SquareVerdict {
    /// Too large by this many powers, negative.
    TooLarge(i32),
    Fits,
    /// Too small by this many powers.
    TooSmall(i32),
}

/// The powers tried so far.
struct SideSearch {
    first: f64,
    power: i32,
    /// The largest power known to be too small.
    small: Option<i32>,
    /// The smallest power known to hold the contact, perhaps with excess room.
    large: Option<i32>,
}

impl SideSearch {
    fn side(&self) -> f64 {
        self.first * FACTOR.powi(self.power)
    }

    /// Records the verdict on the current square; breaks with the final side if it is known.
    fn advance(&mut self, verdict: SquareVerdict) -> ControlFlow<f64> {
        let next = match verdict {
            SquareVerdict::Fits => return ControlFlow::Break(self.side()),
            SquareVerdict::TooSmall(powers) => {
                self.small = Some(self.power);
                self.power + powers
            }
            SquareVerdict::TooLarge(powers) => {
                self.large = Some(self.power);
                self.power + powers
            }
        };
        self.power = match (self.small, self.large) {
            (Some(small), Some(large)) if large - small <= 1 => {
                self.power = large;
                return ControlFlow::Break(self.side());
            }
            (Some(small), Some(large)) if next <= small || next >= large => {
                i32::midpoint(small, large)
            }
            _ => next,
        };
        ControlFlow::Continue(())
    }
}

/// Solves for one load on a square and judges the square by it.
fn judge(
    model: &Model,
    side: f64,
    load: Load,
    hardness: f64,
) -> Result<SquareVerdict, ContactError> {
    for size in FIRST_TRIALS {
        let grid = Grid::new(side, size)?;
        let is_carried = capacity::check(model, (&grid, Boundary::Free), &[load], hardness).is_ok();
        if is_carried && is_resolved_by(model, &grid) && fits_clearly(model, grid, load, hardness)?
        {
            return Ok(SquareVerdict::Fits);
        }
    }
    let grid = Grid::new(side, TRIAL)?;
    if let Err(refused) = capacity::check(model, (&grid, Boundary::Free), &[load], hardness) {
        return if capacity::extends_beyond(model, &grid) {
            Ok(SquareVerdict::TooSmall(1))
        } else {
            Err(refused)
        };
    }
    if !cut_off::can_touch(model, &grid) {
        return Ok(shrunk_to_fit(1));
    }
    let step = solve(model, grid, load, [COARSE_TOLERANCE, hardness])?;
    let Some(to_edge) = step.summary.elements_to_edge else {
        return Ok(
            if resolves_the_tip(model, &grid, step.solution.penetration) {
                SquareVerdict::Fits
            } else {
                shrunk_to_fit(1)
            },
        );
    };
    let is_cut_off = Surroundings::of(model, grid).cut_off(&step.solution);
    let extent = TRIAL / 2 - to_edge;
    Ok(if to_edge < EDGE_MARGIN || is_cut_off {
        SquareVerdict::TooSmall(enlarged(model, side, step.solution.penetration))
    } else if extent < SMALLEST_EXTENT {
        shrunk_to_fit(extent)
    } else {
        SquareVerdict::Fits
    })
}

/// Whether a grid coarser than that of a trial resolves everything that could touch: it must not miss a pillar or any
/// part of a map.
fn is_resolved_by(model: &Model, grid: &Grid) -> bool {
    let is_relief_resolved = match &model.relief {
        Relief::Bare | Relief::Film(_) => true,
        Relief::Cylinders(_) | Relief::Recesses(_) => {
            let radius = model.relief.feature_radius();
            radius.is_some_and(|radius| radius >= grid.element_side())
        }
        Relief::Map(_) | Relief::Custom(_) => false,
    };
    is_relief_resolved
        && !matches!(model.indenter, Indenter::Map(_) | Indenter::Custom(_))
        && cut_off::can_touch(model, grid)
}

/// Whether a square fits even if the grid is wrong by half an element.
fn fits_clearly(
    model: &Model,
    grid: Grid,
    load: Load,
    hardness: f64,
) -> Result<bool, ContactError> {
    let step = solve(model, grid, load, [FIRST_TOLERANCE, hardness])?;
    let Some(to_edge) = step.summary.elements_to_edge else {
        return Ok(false);
    };
    // Half an element more or less, in elements of a trial.
    let per_element = TRIAL / grid.size();
    let clear_of = |elements: usize| (elements * per_element).saturating_sub(per_element / 2);
    let is_clear =
        clear_of(to_edge) >= EDGE_MARGIN && clear_of(grid.size() / 2 - to_edge) >= SMALLEST_EXTENT;
    Ok(is_clear && !Surroundings::of(model, grid).cut_off(&step.solution))
}

fn solve(
    model: &Model,
    grid: Grid,
    load: Load,
    [tolerance, hardness]: [f64; 2],
) -> Result<Step, ContactError> {
    let options = SolverOptions {
        tolerance,
        hardness,
        max_applications: MOST_PRODUCTS,
        contact_stiffness: false,
        ..SolverOptions::default()
    };
    let mut grids = Hierarchy::new(model, (grid, Boundary::Free), &[load], &options);
    grids.solve(load, options, &mut Watch::alone(&mut ()))
}

/// Whether the height of the indenter is less than the penetration at an element around its axis, so that a grid
/// without contact has not missed any; true also if the penetration is unknown.
fn resolves_the_tip(model: &Model, grid: &Grid, penetration: f64) -> bool {
    penetration.is_nan() || cut_off::lowest_height(model, grid) < penetration
}

/// Number of powers by which to shrink a square whose contact extends over `extent` elements from the middle.
fn shrunk_to_fit(extent: usize) -> SquareVerdict {
    let powers = (USUAL_EXTENT / extent as f64).ln() / FACTOR.ln();
    SquareVerdict::TooLarge(-whole(powers))
}

/// Number of powers by which to enlarge a square that cuts off a contact: to the geometric mean of its half side, which
/// the contact reaches, and the radius at which the height of the indenter equals the penetration, beyond which there
/// is hardly any contact.
fn enlarged(model: &Model, side: f64, penetration: f64) -> i32 {
    let farthest = if penetration > 0.0 {
        radius_at(model, penetration)
    } else {
        0.0
    };
    let ratio = (farthest / (0.5 * side)).max(1.0);
    whole(ratio.sqrt().ln() / FACTOR.ln())
}

/// Rounds down, to at least 1.
fn whole(powers: f64) -> i32 {
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the logarithm of a double is below 2000"
    )]
    let powers = powers.floor() as i32;
    powers.max(1)
}

#[cfg(test)]
mod tests;
