//! How well the elements resolve a measured map: elements to the shortest wave of the gap around a contact.
//!
//! Elements longer than the waves of a surface miss its summits. Coarser grids miss them as well, so the changes
//! between grids say nothing of the error. The shortest wave is that of the initial gap `f − f*` along lines across
//! the contact: a wall or a rim of the map far from it does not count, and neither does a roughness with far smaller
//! slopes than the indenter. `docs/grid-error.md` has the evidence for the number of elements to a wave.

use std::borrow::Cow;

use pellicle_texture::{Grid, HeightMap, Relief, SlopeSpectrum};
use rayon::prelude::*;

use crate::{Boundary, Indenter, Model, Profile as _, problem::model::initial_gap};

/// Elements to the shortest wave with which errors are estimated. With at least as many, none of the areas and peaks in
/// `docs/grid-error.md` lies outside its interval; with fewer, a third of the areas does.
pub const FEWEST_ELEMENTS_PER_WAVE: f64 = 5.0;

/// Least width, in elements, of the square on which waves are sought: short waves are told from a smooth shape on at
/// least this many.
const LEAST_WIDTH: f64 = 48.0;

/// Lines along either axis.
const LINES: u32 = 16;

/// Distance between the points of a line over the pixel: less than 1, so that no wave vanishes by the place of its
/// points.
const SPACING: f64 = 0.7;

/// Points of a line to an element where no pixel is known.
const POINTS_PER_ELEMENT: f64 = 16.0;

/// A user-defined shape with a shorter wave than this, in points of a line, has vertical walls: its shortest wave is
/// unknown.
const POINTS_PER_KNOWN_WAVE: f64 = 4.0;

/// A rectangle: its lower and upper corner, in m.
type Rectangle = [[f64; 2]; 2];

/// The resolution of the gap between a model's surfaces on a grid.
pub struct MapResolution<'a> {
    /// With the relief as it was before any wear.
    model: Cow<'a, Model>,
    grid: &'a Grid,
    boundary: Boundary,
    /// The last square and its result.
    known: Option<(Rectangle, Option<f64>)>,
}

impl<'a> MapResolution<'a> {
    pub fn new(model: &'a Model, grid: &'a Grid, boundary: Boundary) -> Self {
        let unworn = match &model.relief {
            Relief::Custom(relief) => relief.unworn(),
            _ => None,
        };
        let model = match unworn {
            Some(relief) => Cow::Owned(Model {
                relief: relief.clone(),
                ..model.clone()
            }),
            None => Cow::Borrowed(model),
        };
        Self {
            model,
            grid,
            boundary,
            known: None,
        }
    }

    /// Elements to the shortest wave around a contact of this radius (m); none without a map or a user-defined relief,
    /// without contact, or where there are no waves.
    pub fn elements_per_wave(&mut self, contact_radius: f64) -> Option<f64> {
        let spacing = SPACING * self.pixel()?;
        if contact_radius <= 0.0 {
            return None;
        }
        let square = self.square(contact_radius);
        if let Some((_, known)) = self.known.filter(|(of, _)| *of == square) {
            return known;
        }
        let found = self.shortest_wave(square, spacing);
        let found = found.map(|wave| wave / self.grid.element_side());
        self.known = Some((square, found));
        found
    }

    /// The shorter side of a pixel of the maps, m; none without one.
    fn pixel(&self) -> Option<f64> {
        let of_map = |map: &HeightMap| {
            let sides = [0, 1].map(|axis| map.extent()[axis] / map.shape()[axis] as f64);
            sides[0].min(sides[1])
        };
        let relief = match &self.model.relief {
            Relief::Map(relief) => Some(of_map(relief.map())),
            Relief::Custom(_) => Some(self.grid.element_side() / (SPACING * POINTS_PER_ELEMENT)),
            Relief::Bare | Relief::Cylinders(_) | Relief::Recesses(_) | Relief::Film(_) => None,
        };
        let indenter = match &self.model.indenter {
            Indenter::Map(indenter) => Some(of_map(indenter.map())),
            _ => None,
        };
        relief.into_iter().chain(indenter).reduce(f64::min)
    }

    /// The part of the domain around the contact that the maps cover.
    fn square(&self, contact_radius: f64) -> Rectangle {
        let half = self.grid.sides().map(|side| 0.5 * side);
        let least = 0.5 * LEAST_WIDTH * self.grid.element_side();
        let reach = half.map(|half| match self.boundary {
            Boundary::Periodic => half,
            Boundary::Free => contact_radius.max(least).min(half),
        });
        let mut square = [reach.map(|reach| -reach), reach];
        let relief = match &self.model.relief {
            Relief::Map(relief) => {
                let half = relief.map().extent().map(|side| 0.5 * side);
                Some([half.map(|half| -half), half])
            }
            _ => None,
        };
        let indenter = match &self.model.indenter {
            Indenter::Map(indenter) => Some(indenter.rectangle()),
            _ => None,
        };
        for [lower, upper] in relief.into_iter().chain(indenter) {
            for axis in [0, 1] {
                square[0][axis] = square[0][axis].max(lower[axis]);
                square[1][axis] = square[1][axis].min(upper[axis]);
            }
        }
        square
    }

    fn shortest_wave(&self, [lower, upper]: Rectangle, spacing: f64) -> Option<f64> {
        let mut spectrum = SlopeSpectrum::default();
        for axis in [0, 1] {
            let (length, width) = (upper[axis] - lower[axis], upper[1 - axis] - lower[1 - axis]);
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a length of some pixels, 0 if negative"
            )]
            let points = (length / spacing) as u32;
            let line = |line: u32| {
                let across = lower[1 - axis] + (f64::from(line) + 0.5) / f64::from(LINES) * width;
                let along = |k: u32| lower[axis] + (f64::from(k) + 0.5) * spacing;
                let point = |k: u32| match axis {
                    0 => [along(k), across],
                    _ => [across, along(k)],
                };
                self.gap(&(0..points).map(point).collect::<Vec<_>>())
            };
            // A user-defined shape is not asked by several threads at once.
            let lines: Vec<Vec<f64>> = if self.has_custom_shape() {
                (0..LINES).map(line).collect()
            } else {
                (0..LINES).into_par_iter().map(line).collect()
            };
            spectrum.add(spacing, lines.into_iter());
        }
        let is_known = |wave: &f64| match self.model.relief {
            Relief::Custom(_) => *wave >= POINTS_PER_KNOWN_WAVE * spacing,
            _ => true,
        };
        spectrum.shortest_wave().filter(is_known)
    }

    fn has_custom_shape(&self) -> bool {
        matches!(self.model.relief, Relief::Custom(_))
            || matches!(self.model.indenter, Indenter::Custom(_))
    }

    /// The initial gap at some points, m; above an indenter that ends among them, the surface alone.
    fn gap(&self, points: &[[f64; 2]]) -> Vec<f64> {
        let profile = self.model.relief.profile_at(points);
        let heights = self.model.indenter.heights(points);
        if heights.iter().all(|height| height.is_finite()) {
            initial_gap(&heights, &profile)
        } else {
            profile
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use pellicle_texture::{MapCompliance, ReliefMap, ReliefShape};

    use super::*;
    use crate::{IndenterMap, Paraboloid, Pyramid};

    /// Elements to the shortest wave with `size` elements on a side of 1 and a contact of this radius.
    fn per_wave(relief: Relief, indenter: Indenter, size: usize, radius: f64) -> Option<f64> {
        let model = Model::on_half_space([1.0, 0.0], relief, indenter);
        let grid = Grid::new(1.0, size).unwrap();
        MapResolution::new(&model, &grid, Boundary::Free).elements_per_wave(radius)
    }

    /// n × n samples of a surface on the square of side 1.
    fn map(n: usize, surface: impl Fn(f64, f64) -> f64) -> HeightMap {
        let at = |i: usize| (i as f64 + 0.5) / n as f64 - 0.5;
        let heights = (0..n * n).map(|k| surface(at(k / n), at(k % n)));
        HeightMap::new(heights.collect(), [n; 2], [1.0; 2]).unwrap()
    }

    #[expect(clippy::cast_possible_truncation, reason = "the rounding is wanted")]
    fn single_precision(height: f64) -> f64 {
        f64::from(height as f32)
    }

    fn relief(map: HeightMap) -> Relief {
        Relief::Map(ReliefMap::new(map, MapCompliance::Uniform(0.0)).unwrap())
    }

    fn plane() -> Indenter {
        Paraboloid::new(1e6).unwrap().into()
    }

    fn wave(x: f64, y: f64, length: f64) -> f64 {
        length * ((TAU * x / length).cos() + (TAU * y / length).sin())
    }

    #[test]
    fn the_shortest_wave_is_that_of_the_surface_and_not_of_its_samples() {
        // A wave of 1/16, 8 elements of 128; its two neighbours in the spectrum are 1/15 and 1/17.
        for n in [128, 200, 512] {
            let found = per_wave(
                relief(map(n, |x, y| wave(x, y, 1.0 / 16.0))),
                plane(),
                128,
                0.4,
            );
            assert!((found.unwrap() - 8.0).abs() < 0.6, "{n}: {found:?}");
        }
        let found = per_wave(
            Relief::Bare,
            IndenterMap::new(map(128, |x, y| wave(x, y, 1.0 / 32.0))).into(),
            64,
            0.4,
        );
        assert!((found.unwrap() - 2.0).abs() < 0.2, "{found:?}");
        assert_eq!(per_wave(Relief::Bare, plane(), 64, 0.4), None);
    }

    #[test]
    fn a_smooth_map_sampled_finely_is_resolved() {
        let indented = |map: HeightMap, radius: f64| {
            let found = per_wave(Relief::Bare, IndenterMap::new(map).into(), 128, radius);
            assert!(found.unwrap() > FEWEST_ELEMENTS_PER_WAVE, "{found:?}");
        };
        for radius in [1e-3, 0.1, 0.4] {
            indented(map(1024, |x, y| x * x + y * y), radius);
            indented(map(512, |x, y| -(4.0 - x * x - y * y).sqrt()), radius);
            indented(map(512, f64::hypot), radius);
            // As single precision stores it.
            indented(
                map(512, |x, y| single_precision(1e-6 * (x * x + y * y))),
                radius,
            );
        }
        let vickers = Pyramid::vickers(0.0).unwrap();
        indented(map(512, |x, y| vickers.height(x, y)), 0.3);
        // The rim of a lens on flat land, far from the contact, and its wall.
        indented(
            map(512, |x, y| -(0.16 - x * x - y * y).max(0.0).sqrt()),
            0.1,
        );
    }

    #[test]
    fn a_rough_ball_is_not_resolved_where_its_roughness_is_not() {
        // Slopes of 2 on a ball whose slope is 0.2 at the edge of the contact; waves of 1/40, 3.2 elements.
        let rough = map(512, |x, y| x * x + y * y + 0.05 * wave(x, y, 1.0 / 40.0));
        let found = per_wave(Relief::Bare, IndenterMap::new(rough).into(), 128, 0.1);
        assert!((found.unwrap() - 3.2).abs() < 0.3, "{found:?}");
        let found = per_wave(
            relief(map(512, |x, y| 0.05 * wave(x, y, 1.0 / 40.0))),
            Paraboloid::new(0.5).unwrap().into(),
            128,
            0.1,
        );
        assert!((found.unwrap() - 3.2).abs() < 0.3, "{found:?}");
    }

    /// A relief by a function of x and y.
    #[derive(Debug)]
    struct Function(fn(f64, f64) -> f64);

    impl ReliefShape for Function {
        fn profile(&self, points: &[[f64; 2]]) -> Vec<f64> {
            points.iter().map(|[x, y]| (self.0)(*x, *y)).collect()
        }

        fn compliance(&self, points: &[[f64; 2]]) -> Vec<f64> {
            vec![0.0; points.len()]
        }
    }

    #[test]
    fn the_shortest_wave_of_a_user_defined_relief_is_known_unless_it_has_walls() {
        let waves = Relief::custom(Function(|x, y| wave(x, y, 1.0 / 40.0) - 0.05));
        let found = per_wave(waves, plane(), 128, 0.4);
        assert!((found.unwrap() - 3.2).abs() < 0.2, "{found:?}");
        let pillars = Function(|x, y| {
            if (10.0 * x).cos() * (10.0 * y).cos() > 0.0 {
                0.0
            } else {
                -1.0
            }
        });
        assert_eq!(per_wave(Relief::custom(pillars), plane(), 128, 0.4), None);
    }
}
