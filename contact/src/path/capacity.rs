//! The largest load that a grid can carry: a force at a hardness, or a penetration of incompressible layers.

use pellicle_texture::Grid;

use crate::{
    Boundary, ContactError, Load, Model, Profile, grid::region::Region,
    problem::model::SampledRegion, vector::sum,
};

/// Returns an error if a force of `loads` exceeds what all elements under the indenter can carry at the hardness (Pa),
/// or a penetration what incompressible layers under a periodic cell give way.
pub fn check(
    model: &Model,
    (grid, boundary): (&Grid, Boundary),
    loads: &[Load],
    hardness: f64,
) -> Result<(), ContactError> {
    check_force(model, grid, loads, hardness)?;
    match boundary {
        Boundary::Periodic if hardness.is_infinite() => check_penetration(model, grid, loads),
        _ => Ok(()),
    }
}

/// A uniform pressure moves the surface of incompressible layers on a rigid base nowhere: its energy `Σ p (g0 − D)` has
/// a minimum only while `D` is below the mean of `g0`. Springs and elements that cannot touch set a bound of their own.
fn check_penetration(model: &Model, grid: &Grid, loads: &[Load]) -> Result<(), ContactError> {
    let depths = loads.iter().filter_map(|load| match load {
        Load::Penetration(depth) => Some(*depth),
        Load::Force(_) => None,
    });
    let Some(penetration) = depths.reduce(f64::max) else {
        return Ok(());
    };
    if model.tables.bodies().mean_compliance() > 0.0 {
        return Ok(());
    }
    let SampledRegion {
        compliance,
        initial_gap,
        ..
    } = model.sample_on(*grid, &Region::of_grid(grid, Boundary::Periodic));
    let mean_gap = sum(&initial_gap) / initial_gap.len() as f64;
    if penetration < mean_gap || compliance.iter().any(|eta| *eta > 0.0) {
        return Ok(());
    }
    Err(ContactError::BeyondGaps {
        penetration,
        mean_gap,
    })
}

fn check_force(
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

/// Whether the indenter extends beyond a grid's corner, so that a larger grid can carry more.
pub fn extends_beyond(model: &Model, grid: &Grid) -> bool {
    let corner = [grid.centre(0), grid.centre(0)];
    model.indenter.heights(&[corner])[0].is_finite()
}

#[cfg(test)]
mod tests {
    use pellicle_texture::Relief;

    use super::*;
    use crate::{FlatPunch, Indenter, Paraboloid};

    fn model(indenter: Indenter) -> Model {
        Model::on_half_space([1.0, 0.3], Relief::Bare, indenter)
    }

    #[test]
    fn the_elements_under_an_indenter_carry_their_area_times_the_hardness() {
        // Four elements of side 1 have their centres under the punch.
        let (punch, grid) = (
            model(FlatPunch::new(1.0).unwrap().into()),
            Grid::new(4.0, 4).unwrap(),
        );
        let check =
            |loads: &[Load], hardness| check(&punch, (&grid, Boundary::Free), loads, hardness);
        assert!(check(&[Load::Force(12.0)], 3.0).is_ok());
        let loads = [1.0, 12.1, 3.0].map(Load::Force);
        let refused = check(&loads, 3.0).unwrap_err();
        let ContactError::BeyondHardness {
            force,
            hardness,
            area,
            most,
        } = refused
        else {
            panic!("{refused}")
        };
        assert_eq!([force, hardness, area, most], [12.1, 3.0, 4.0, 12.0]);
        // A penetration is not checked, and without a hardness there is no bound.
        assert!(check(&[Load::Penetration(9.0)], 3.0).is_ok());
        assert!(check(&[Load::Force(0.0)], 3.0).is_ok());
        assert!(check(&[Load::Force(1e9)], f64::INFINITY).is_ok());
    }

    #[test]
    fn only_an_indenter_that_extends_beyond_the_grid_calls_for_a_larger_one() {
        let paraboloid = model(Paraboloid::new(1.0).unwrap().into());
        let grid = Grid::new(4.0, 4).unwrap();
        assert!(extends_beyond(&paraboloid, &grid));
        // The centre of the corner element lies 1.5 √2 = 2.12 from the axis.
        let ends =
            |radius: f64| !extends_beyond(&model(FlatPunch::new(radius).unwrap().into()), &grid);
        assert!(ends(2.1) && !ends(2.13));
    }
}
