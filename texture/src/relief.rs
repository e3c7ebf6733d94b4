//! The relief on top of the layered foundation.

mod sampling;

use crate::custom_relief::{CustomRelief, ReliefShape};
use crate::cylinders::Cylinders;
use crate::film::Film;
use crate::recesses::Recesses;
use crate::relief_map::{MapCompliance, ReliefMap};
use crate::sampled::level;
use crate::spring_law::SpringLaw;

/// The relief on top of the foundation.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Relief {
    /// No relief: the foundation's own plane surface.
    #[default]
    Bare,
    /// Equal cylinders on a lattice.
    Cylinders(Cylinders),
    /// A plane with dimples or grooves.
    Recesses(Recesses),
    /// A film over the whole surface.
    Film(Film),
    /// A measured height map.
    Map(ReliefMap),
    /// A user-defined shape.
    Custom(CustomRelief),
}

impl Relief {
    /// Builds a relief of any shape.
    #[must_use]
    pub fn custom(shape: impl ReliefShape + 'static) -> Self {
        Self::Custom(CustomRelief::new(shape))
    }

    /// Returns the surface profile `f*` at the given points (m): 0 on the tops, negative between them.
    #[must_use]
    pub fn profile_at(&self, points: &[[f64; 2]]) -> Vec<f64> {
        match self {
            Self::Bare | Self::Film(_) => vec![0.0; points.len()],
            Self::Cylinders(cylinders) => {
                let depths = points.iter().map(|point| cylinders.depth_at(*point));
                depths.map(level).collect()
            }
            Self::Recesses(recesses) => {
                let depths = points.iter().map(|point| recesses.depth_at(*point));
                depths.map(level).collect()
            }
            Self::Map(map) => points.iter().map(|point| map.profile_at(*point)).collect(),
            Self::Custom(custom) => custom.profile(points),
        }
    }

    /// Returns the compliance η at the given points, m/Pa; 0 off the relief.
    #[must_use]
    pub fn compliance_at(&self, points: &[[f64; 2]]) -> Vec<f64> {
        let each = |of: &dyn Fn([f64; 2]) -> f64| points.iter().map(|point| of(*point)).collect();
        match self {
            Self::Bare => vec![0.0; points.len()],
            Self::Cylinders(cylinders) => each(&|point| {
                if cylinders.contains(point) {
                    cylinders.compliance_at_depth(cylinders.depth_at(point))
                } else {
                    0.0
                }
            }),
            Self::Recesses(recesses) => each(&|point| {
                if recesses.contains(point) {
                    recesses.compliance_at_depth(recesses.depth_at(point))
                } else {
                    0.0
                }
            }),
            Self::Film(film) => vec![film.compliance(); points.len()],
            Self::Map(map) => each(&|point| map.compliance_at(point)),
            Self::Custom(custom) => custom.compliance(points),
        }
    }

    /// Young's modulus of springs as long as the relief is high, Pa: their compliance is the height over it. None if
    /// the surface is the body's own, or if its springs have a compliance without a height.
    #[must_use]
    pub fn spring_modulus(&self) -> Option<f64> {
        match self {
            Self::Cylinders(cylinders) => Some(cylinders.spec().young_modulus),
            Self::Recesses(recesses) => recesses.young_modulus(),
            Self::Film(film) => Some(film.young_modulus()),
            Self::Map(map) => match map.compliance() {
                MapCompliance::YoungModulus(modulus) => Some(modulus),
                MapCompliance::Uniform(_) => None,
            },
            Self::Bare | Self::Custom(_) => None,
        }
    }

    /// The law of the springs.
    #[must_use]
    pub fn spring_law(&self) -> SpringLaw {
        match self {
            Self::Bare | Self::Custom(_) => SpringLaw::LINEAR,
            Self::Cylinders(cylinders) => cylinders.spring_law(),
            Self::Recesses(recesses) => recesses.spring_law(),
            Self::Film(film) => film.spring_law(),
            Self::Map(map) => map.spring_law(),
        }
    }

    /// Fraction of the plane that carries relief: closed form for cylinders and between vertical walls of grooves, 0
    /// for a bare surface, 1 otherwise.
    #[must_use]
    pub fn area_fraction(&self) -> f64 {
        match self {
            Self::Bare => 0.0,
            Self::Cylinders(cylinders) => cylinders.area_fraction(),
            Self::Recesses(recesses) => recesses.area_fraction(),
            Self::Film(_) | Self::Map(_) | Self::Custom(_) => 1.0,
        }
    }

    /// Length of the longest springs, m: height h of the cylinders, thickness of the film, depth of recesses between
    /// springs; `None` without springs and on a map or a user-defined shape.
    #[must_use]
    pub fn height(&self) -> Option<f64> {
        match self {
            Self::Bare | Self::Map(_) | Self::Custom(_) => None,
            Self::Recesses(recesses) => recesses.young_modulus().map(|_| recesses.depth()),
            Self::Cylinders(cylinders) => Some(cylinders.height()),
            Self::Film(film) => Some(film.thickness()),
        }
    }

    /// Distance from the point to the nearest outline of the relief, m: positive on the tops, negative between them;
    /// `None` if there is no outline.
    #[must_use]
    pub fn distance_to_outline(&self, point: [f64; 2]) -> Option<f64> {
        match self {
            Self::Cylinders(cylinders) => Some(cylinders.distance_to_rim(point)),
            Self::Recesses(recesses) => recesses.distance_to_wall(point),
            Self::Bare | Self::Film(_) | Self::Map(_) | Self::Custom(_) => None,
        }
    }

    /// Distance from the point to the nearest edge at an outline of the relief, m: at least half the width of the arc
    /// that rounds it, so that an edge is far on a grid that resolves its arc; `None` if there is no outline.
    #[must_use]
    pub fn distance_to_edge(&self, point: [f64; 2]) -> Option<f64> {
        match self {
            Self::Cylinders(cylinders) => Some(cylinders.distance_to_edge(point)),
            Self::Recesses(recesses) => recesses.distance_to_edge(point),
            Self::Bare | Self::Film(_) | Self::Map(_) | Self::Custom(_) => None,
        }
    }

    /// Half the width of the features of a pattern, m: the radius of cylinders and dimples, half the width of grooves;
    /// none of another relief.
    #[must_use]
    pub fn feature_radius(&self) -> Option<f64> {
        match self {
            Self::Cylinders(cylinders) => Some(cylinders.radius()),
            Self::Recesses(recesses) => Some(recesses.half_width()),
            Self::Bare | Self::Film(_) | Self::Map(_) | Self::Custom(_) => None,
        }
    }

    /// Width in the plane of the arcs that round the edges of a pattern, m; none without arcs.
    #[must_use]
    pub fn arc_width(&self) -> Option<f64> {
        let width = match self {
            Self::Cylinders(cylinders) => cylinders.edge_radius(),
            Self::Recesses(recesses) => recesses.arc_width(),
            Self::Bare | Self::Film(_) | Self::Map(_) | Self::Custom(_) => 0.0,
        };
        (width > 0.0).then_some(width)
    }

    /// Distance from the point to the nearest ridge of the relief, m; infinite if it has none. The edge of a dimple or
    /// of a V is one unless it is rounded; for a map see
    /// [`HeightMap::distance_to_ridge`](crate::HeightMap::distance_to_ridge).
    #[must_use]
    pub fn distance_to_ridge(&self, point: [f64; 2]) -> f64 {
        match self {
            Self::Map(map) => map.map().distance_to_ridge(point),
            Self::Recesses(recesses) => recesses.distance_to_ridge(point),
            Self::Bare | Self::Film(_) | Self::Cylinders(_) | Self::Custom(_) => f64::INFINITY,
        }
    }

    /// Distance from a vector (m) to the nearest one that moves a pattern onto itself, m; none of another relief.
    #[must_use]
    pub fn distance_to_translation(&self, vector: [f64; 2]) -> Option<f64> {
        match self {
            Self::Cylinders(cylinders) => Some(cylinders.pattern().distance_to_translation(vector)),
            Self::Recesses(recesses) => Some(recesses.distance_to_translation(vector)),
            Self::Bare | Self::Film(_) | Self::Map(_) | Self::Custom(_) => None,
        }
    }

    /// Whether the relief is symmetric in x and y; false for every map, and for a user-defined shape unless it says so.
    ///
    /// If it is, its samples are symmetric on every grid, to the last bit unless a user defines them.
    #[must_use]
    pub fn is_mirrored(&self) -> bool {
        match self {
            Self::Bare | Self::Film(_) => true,
            Self::Cylinders(cylinders) => cylinders.is_mirrored(),
            Self::Recesses(recesses) => recesses.is_mirrored(),
            Self::Custom(custom) => custom.is_mirrored(),
            Self::Map(_) => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Grid;
    use crate::{CylinderSpec, HeightMap, Lattice, MapCompliance};

    #[test]
    fn a_bare_surface_is_flat_and_rigid_and_a_film_is_flat_and_soft() {
        let grid = Grid::new(1.0, 3).unwrap();
        let bare = Relief::Bare.sample(&grid);
        assert_eq!(
            (bare.mask(), bare.profile(), bare.compliance()),
            (&[false; 9][..], &[0.0; 9][..], &[0.0; 9][..])
        );
        let film = Relief::Film(Film::new(2.0, 8.0).unwrap());
        let sampled = film.sample(&grid);
        assert_eq!(
            (sampled.mask(), sampled.profile(), sampled.compliance()),
            (&[true; 9][..], &[0.0; 9][..], &[0.25; 9][..])
        );
        assert_eq!(
            (film.height(), film.area_fraction(), sampled.mask_fraction()),
            (Some(2.0), 1.0, 1.0)
        );
    }

    #[test]
    fn the_first_index_runs_along_x() {
        // One cylinder at x = −1, y = 0 of a 3 × 3 grid: element (0, 1), index 1.
        let spec = CylinderSpec {
            lattice: Lattice::Square,
            radius: 0.4,
            height: 2.0,
            period: 50.0,
            offset: [-1.0, 0.0],
            young_modulus: 4.0,
        };
        let relief = Relief::Cylinders(Cylinders::new(spec).unwrap());
        let sampled = relief.sample(&Grid::new(3.0, 3).unwrap());
        let only = |hit: f64, miss: f64| {
            (0..9)
                .map(|n| if n == 1 { hit } else { miss })
                .collect::<Vec<_>>()
        };
        assert_eq!(sampled.profile(), only(0.0, -2.0));
        assert_eq!(sampled.compliance(), only(0.5, 0.0));
        assert!(sampled.mask()[1] && sampled.mask_fraction() == 1.0 / 9.0);
    }

    #[test]
    fn mirrored_reliefs_have_mirrored_samples_and_others_do_not() {
        let relief = |lattice: Lattice, offset: [f64; 2]| {
            // Many element centres are at this radius up to rounding.
            let spec = CylinderSpec {
                lattice,
                radius: 0.3,
                height: 2.0,
                period: 1.0,
                offset,
                young_modulus: 4.0,
            };
            Relief::Cylinders(Cylinders::new(spec).unwrap())
        };
        let height = 0.75_f64.sqrt();
        for (relief, is_mirrored) in [
            (relief(Lattice::Square, [0.0, 0.0]), true),
            (relief(Lattice::Square, [0.5, -1.0]), true),
            (relief(Lattice::Hexagonal, [0.0, 0.0]), true),
            (relief(Lattice::Hexagonal, [0.5, height]), true),
            (relief(Lattice::Hexagonal, [0.5, 0.0]), true),
            (relief(Lattice::Square, [0.25, 0.0]), false),
            (relief(Lattice::Square, [0.2, 0.0]), false),
            (relief(Lattice::Hexagonal, [0.0, 0.4]), false),
        ] {
            assert_eq!(relief.is_mirrored(), is_mirrored, "{relief:?}");
            let size = 60;
            let sampled = relief.sample(&Grid::new(6.0, size).unwrap());
            let mask = |i: usize, j: usize| sampled.mask()[i * size + j];
            let is_same = |i: usize, j: usize| {
                mask(i, j) == mask(size - 1 - i, j) && mask(i, j) == mask(i, size - 1 - j)
            };
            let all_same = (0..size * size).all(|e| is_same(e / size, e % size));
            assert_eq!(all_same, is_mirrored, "{relief:?}");
        }
    }

    #[test]
    fn a_map_on_its_own_grid_returns_its_samples() {
        let heights = vec![-1.0, -2.0, 0.0, -4.0, -5.0, -3.0, -6.0, -7.0, -8.0];
        let map = HeightMap::new(heights.clone(), [3, 3], [1.5, 1.5]).unwrap();
        let relief = Relief::Map(ReliefMap::new(map, MapCompliance::Uniform(0.1)).unwrap());
        let sampled = relief.sample(&Grid::new(1.5, 3).unwrap());
        assert_eq!(sampled.profile(), heights);
        assert_eq!(sampled.compliance(), [0.1; 9]);
    }
}
