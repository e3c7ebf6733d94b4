//! What force a grid carries where the pressure is cut at a hardness.

use pellicle_texture::Grid;

use crate::{ContactError, Load, Model, Profile};

/// Refuses a force of `loads` that the hardness (Pa) of all elements under the indenter does not carry.
pub fn check(
    model: &Model,
    grid: &Grid,
    loads: &[Load],
    hardness: f64,
) -> Result<(), ContactError> {
    let forces = loads.iter().filter_map(|load| match load {
        Load::Force(force) => Some(*force),
        Load::Penetration(_) => None,
    });
    let force = forces.fold(0.0, f64::max);
    if hardness.is_infinite() || force == 0.0 {
        return Ok(());
    }
    let heights = model.indenter.heights(&grid.centres().collect::<Vec<_>>());
    let touchable = heights.iter().filter(|height| height.is_finite()).count();
    let area = grid.element_area() * touchable as f64;
    let most = hardness * area;
    if force <= most {
        return Ok(());
    }
    Err(ContactError::BeyondHardness {
        force,
        hardness,
        area,
        most,
    })
}

/// Whether the indenter goes on beyond a grid's corner, so that a larger one carries more.
pub fn goes_on(model: &Model, grid: &Grid) -> bool {
    let corner = [grid.centre(0), grid.centre(0)];
    model.indenter.heights(&[corner])[0].is_finite()
}
