//! The largest pressure: its value and place within smooth contact, and whether geometry puts it at an edge.
//!
//! Inside smooth contact the paraboloid through the largest element and its eight neighbours has its vertex at the
//! peak, `p = p₀ − ½ gᵀ H⁻¹ g` with the central differences `g` and `H`, to third order in the element's side. At an
//! edge the peak is the element's own value; where a hardness cuts the pressure, the peak is the hardness.

use pellicle_texture::{Grid, Relief};

use crate::{Indenter, Profile};
use crate::{grid::region::Place, result::contact_field::ContactField};

/// A peak within this many elements of an edge belongs to the edge.
const ELEMENTS_FROM_EDGE: f64 = 2.0;

/// With this many elements across an arc, none of its elements belongs to its edge: the peak there is one of the arc.
pub const FEWEST_ELEMENTS_PER_ARC: f64 = 2.0 * ELEMENTS_FROM_EDGE;

/// A peak nearer to the axis than this part of an element lies on it.
const AT_AXIS: f64 = 1e-6;

/// The place of the largest pressure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PeakPlace {
    /// Inside the contact, away from sharp features.
    #[default]
    Inside,
    /// The edge at an outline of the relief, sharp or with an arc that the grid does not resolve.
    Outline,
    /// A ridge of a relief: between the samples of a map, or the sharp edge of a dimple or a V-shaped groove.
    Ridge,
    /// A rim, a tip or a ridge of the indenter.
    IndenterEdge,
}

/// An arc at an edge of the relief that elements do not resolve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnresolvedArc {
    /// Elements across the arc.
    pub elements: f64,
    /// Elements per side that would resolve it.
    pub wanted: usize,
}

impl UnresolvedArc {
    /// The arcs of a relief on a grid; none without arcs, or if the elements resolve them.
    #[must_use]
    pub fn of(relief: &Relief, grid: &Grid) -> Option<Self> {
        let elements = relief.arc_width()? / grid.element_side();
        let wanted = FEWEST_ELEMENTS_PER_ARC / elements * grid.size() as f64;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a number of elements, the largest if there are too many"
        )]
        let wanted = wanted.ceil() as usize;
        (elements < FEWEST_ELEMENTS_PER_ARC).then_some(Self { elements, wanted })
    }
}

/// The largest pressure.
#[derive(Debug, Clone, Copy)]
pub struct Peak {
    /// Pressure, in Pa.
    pub pressure: f64,
    /// Position, in m.
    pub at: [f64; 2],
    pub place: PeakPlace,
}

impl Peak {
    /// The peak of a field whose largest pressure is that of an element of the region.
    pub fn of(field: &ContactField<'_>, largest: Place) -> Self {
        let (model, side) = (field.model, field.grid.element_side());
        if let Some(element) = field.element(largest).filter(|e| field.is_at_limit(*e)) {
            return Self {
                pressure: field.pressure[element],
                at: field.centre(largest),
                place: PeakPlace::Inside,
            };
        }
        let place = place_near(&model.relief, &model.indenter, side, field.centre(largest));
        let around = |[i, j]: Place| field.pressure_at([largest[0] + i, largest[1] + j]);
        let own = around([0, 0]);
        let vertex = (place == PeakPlace::Inside)
            .then(|| vertex(&around))
            .flatten();
        let (rise, [u, v]) = vertex.unwrap_or((0.0, [0.0; 2]));
        Self {
            pressure: (own + rise).min(field.hardness),
            at: field
                .point([largest[0] as f64 + u, largest[1] as f64 + v])
                .map(|x| if x.abs() < AT_AXIS * side { 0.0 } else { x }),
            place,
        }
    }
}

/// Returns the sharp feature near a point, by geometry alone, on a grid of elements of side `side` (m).
pub fn place_near(relief: &Relief, indenter: &Indenter, side: f64, point: [f64; 2]) -> PeakPlace {
    let is_near = |distance: f64| distance.abs() < ELEMENTS_FROM_EDGE * side;
    if relief.distance_to_edge(point).is_some_and(is_near) {
        PeakPlace::Outline
    } else if is_near(relief.distance_to_ridge(point)) {
        PeakPlace::Ridge
    } else if is_near(indenter.distance_to_edge(point[0], point[1], side)) {
        PeakPlace::IndenterEdge
    } else {
        PeakPlace::Inside
    }
}

/// Returns how much higher the vertex is than the middle, and where it lies; none if a neighbour is not in contact or
/// no vertex lies within an element.
pub fn vertex(around: &impl Fn(Place) -> f64) -> Option<(f64, [f64; 2])> {
    let mut least = f64::INFINITY;
    for i in -1..=1 {
        for j in -1..=1 {
            least = least.min(around([i, j]));
        }
    }
    let own = around([0, 0]);
    let along = |at: fn(isize) -> Place| {
        let [before, after] = [around(at(-1)), around(at(1))];
        (0.5 * (after - before), after - 2.0 * own + before)
    };
    let ((gx, hxx), (gy, hyy)) = (along(|i| [i, 0]), along(|j| [0, j]));
    let hxy = 0.25 * (around([1, 1]) - around([1, -1]) - around([-1, 1]) + around([-1, -1]));
    let determinant = hxx * hyy - hxy * hxy;
    if !(least > 0.0 && hxx < 0.0 && determinant > 0.0) {
        return None;
    }
    // −H⁻¹ g
    let step = [
        (hxy * gy - hyy * gx) / determinant,
        (hxy * gx - hxx * gy) / determinant,
    ];
    // The largest of nine lies within half an element of the vertex, except where the peak is not a paraboloid.
    let is_near = step.iter().all(|part| part.abs() <= 1.0);
    is_near.then(|| (0.5 * (gx * step[0] + gy * step[1]), step))
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use pellicle_influence::{Cache, RadialTables};
    use pellicle_kernel::{Foundation, Material};
    use pellicle_texture::{CylinderSpec, Cylinders, Grid, Lattice};

    use super::*;
    use crate::{
        FlatPunch, Model, Paraboloid, grid::region::Region, result::certificate::JudgedFields,
    };

    const SIZE: usize = 20;

    /// The peak of `p = 9 − 4 (x − x₀)² − 2 (x − x₀)(y − y₀) − 3 (y − y₀)²` on a square of side 4, under this indenter.
    fn peak_of(indenter: Indenter, vertex: [f64; 2], hardness: f64) -> Peak {
        let body = Foundation::half_space(Material::new(1.0, 0.3).unwrap());
        let model = Model {
            tables: Arc::new(RadialTables::build(&body).unwrap()),
            relief: Relief::Bare,
            indenter,
            cache: Cache::none(),
        };
        let (grid, region) = (Grid::new(4.0, SIZE).unwrap(), Region::whole(SIZE));
        let pressure = grid.centres().map(|place| {
            let [x, y] = [place[0] - vertex[0], place[1] - vertex[1]];
            (9.0 - 4.0 * x * x - 2.0 * x * y - 3.0 * y * y).clamp(0.0, hardness)
        });
        let pressure: Vec<f64> = pressure.collect();
        let largest = (0..SIZE * SIZE).max_by(|e, f| pressure[*e].total_cmp(&pressure[*f]));
        let element = largest.unwrap();
        let nothing = vec![0.0; SIZE * SIZE];
        let field = ContactField {
            model: &model,
            grid: &grid,
            region: &region,
            pressure: &pressure,
            hardness,
            initial_gap: &nothing,
            judged: &JudgedFields::on(region),
            mask: &[false; SIZE * SIZE],
            compliance: &nothing,
            coefficient: 1.0,
        };
        Peak::of(
            &field,
            [element / SIZE, element % SIZE].map(usize::cast_signed),
        )
    }

    #[test]
    fn a_smooth_peak_lies_between_centres_and_a_peak_at_an_edge_at_a_centre() {
        let ball: Indenter = Paraboloid::new(1.0).unwrap().into();
        for vertex in [[0.23, -0.41], [-0.47, 0.33], [0.0, 0.52]] {
            let found = peak_of(ball.clone(), vertex, f64::INFINITY);
            // A few roundings of numbers below 9.
            assert!((found.pressure - 9.0).abs() < 1e-13, "{}", found.pressure);
            let apart = (found.at[0] - vertex[0]).hypot(found.at[1] - vertex[1]);
            assert!(apart < 1e-13, "{:?}", found.at);
            assert_eq!(found.place, PeakPlace::Inside);
            // Exactly on the axis, if the vertex lies there to rounding.
            assert_eq!(found.at[0] == 0.0, vertex[0] == 0.0);
        }
        let [x, y] = [0.5, -0.1];
        let punch: Indenter = FlatPunch::new(0.55).unwrap().into();
        let found = peak_of(punch, [0.43, -0.17], f64::INFINITY);
        assert_eq!(found.place, PeakPlace::IndenterEdge);
        assert!(
            (found.at[0] - x).hypot(found.at[1] - y) < 1e-13,
            "{:?}",
            found.at
        );
        let [x, y] = [x - 0.43, y + 0.17];
        assert!((found.pressure - (9.0 - 4.0 * x * x - 2.0 * x * y - 3.0 * y * y)).abs() < 1e-13);
        // If an element is cut, the peak is the hardness there; if none is, the vertex is no higher than the hardness.
        let cut = peak_of(ball.clone(), [0.23, -0.41], 8.0);
        assert_eq!(cut.pressure, 8.0);
        let below = peak_of(ball, [0.2, -0.4], 8.97);
        assert_eq!((below.pressure, below.place), (8.97, PeakPlace::Inside));
    }

    #[test]
    fn the_vertex_of_a_paraboloid_is_recovered() {
        let [u, v] = [0.31, -0.44];
        let pressure = |[i, j]: Place| {
            let [x, y] = [i as f64 - u, j as f64 - v];
            9.0 - 2.0 * x * x - 0.7 * x * y - y * y
        };
        let (rise, at) = vertex(&pressure).unwrap();
        // a few roundings of numbers below 9
        assert!((rise + pressure([0, 0]) - 9.0).abs() < 1e-14, "{rise}");
        assert!((at[0] - u).hypot(at[1] - v) < 1e-14, "{at:?}");
    }

    #[test]
    fn neither_a_saddle_nor_a_contact_of_single_elements_has_a_vertex() {
        assert!(vertex(&|[i, j]: Place| 9.0 - (i * i) as f64 + 0.5 * (j * j) as f64).is_none());
        let peak = |[i, j]: Place| 9.0 - (i * i + j * j) as f64;
        assert!(vertex(&peak).is_some());
        for neighbour in (-1..=1).flat_map(|i| [-1, 0, 1].map(|j| [i, j])) {
            let without_neighbour =
                |place: Place| if place == neighbour { 0.0 } else { peak(place) };
            assert!(vertex(&without_neighbour).is_none(), "{neighbour:?}");
        }
    }

    #[test]
    fn a_peak_within_two_elements_of_a_sharp_feature_is_attributed_to_it() {
        let spec = CylinderSpec {
            lattice: Lattice::Square,
            radius: 0.2,
            height: 0.1,
            period: 1.0,
            offset: [0.0, 0.0],
            young_modulus: 1.0,
        };
        let cylinders = Relief::Cylinders(Cylinders::new(spec).unwrap());
        let punch: Indenter = FlatPunch::new(0.3).unwrap().into();
        let ball: Indenter = Paraboloid::new(1.0).unwrap().into();
        let near = |relief: &Relief, indenter: &Indenter, x: f64| {
            place_near(relief, indenter, 0.02, [0.0, x])
        };
        for (x, wanted) in [
            (0.25, PeakPlace::Inside),
            (0.27, PeakPlace::IndenterEdge),
            (0.33, PeakPlace::IndenterEdge),
            (0.35, PeakPlace::Inside),
        ] {
            assert_eq!(near(&Relief::Bare, &punch, x), wanted, "{x}");
            assert_eq!(near(&Relief::Bare, &ball, x), PeakPlace::Inside);
        }
        for (x, wanted) in [
            (0.15, PeakPlace::Inside),
            (0.17, PeakPlace::Outline),
            (0.23, PeakPlace::Outline),
            (0.27, PeakPlace::IndenterEdge),
        ] {
            assert_eq!(near(&cylinders, &punch, x), wanted, "{x}");
        }
    }
}
