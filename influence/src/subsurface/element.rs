//! The fields of one loaded element at one depth.

use std::sync::LazyLock;

use pellicle_kernel::Foundation;

use super::depth::Depth;
use super::homogeneous::loaded_square;
use super::point_kernels::PointKernels;
use super::state::{SubsurfaceState, SurfaceLoad};
use crate::element::check_element_side;
use crate::error::InfluenceError;
use crate::numerics::quadrature::{Node, legendre_of};

/// The states of one point under the two loads of an element.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ElementLoads {
    /// Under a unit pressure.
    pub normal: SubsurfaceState,
    /// Under a unit traction that drags the surface along +x.
    pub tangential: SubsurfaceState,
}

/// Rules for square cells, and the distance, in half sides of the cell, from which each leaves less than 1e-14 of a
/// point kernel: p points a direction leave `(2d)^(−2p)`.
static RULES: LazyLock<[(f64, Vec<Node>); 5]> = LazyLock::new(|| {
    [
        (200.0, legendre_of::<3>()),
        (40.0, legendre_of::<4>()),
        (16.0, legendre_of::<5>()),
        (8.0, legendre_of::<6>()),
        (4.0, legendre_of::<8>()),
    ]
});

/// The nine fields of a square element under unit pressure and unit traction, at one depth of a foundation.
///
/// ```
/// use pellicle_influence::{ElementFields, Depth};
/// use pellicle_kernel::{Foundation, Material, Side};
///
/// let (coating, steel) = (Material::new(400e9, 0.25)?, Material::new(210e9, 0.3)?);
/// let foundation = Foundation::coated(2e-6, coating, steel)?;
/// let [above, below] = [Side::Above, Side::Below].map(|side| {
///     let depth = Depth { z: 2e-6, side };
///     ElementFields::new(&foundation, 1e-6, depth, 10e-6).map(|fields| fields.at([0.0, 0.0]))
/// });
/// // Tractions pass the interface, the stress along it jumps.
/// let [above, below] = [above?.normal.stress, below?.normal.stress];
/// assert!((above[2] / below[2] - 1.0).abs() < 1e-10 && above[0] > below[0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct ElementFields {
    pub(super) foundation: Foundation,
    pub(super) element_side: f64,
    pub(super) depth: f64,
    /// Whether the fields of a half-space of the top layer's material are to be added.
    pub(super) has_homogeneous: bool,
    /// Whether `u_x` and `u_y` under a traction are bounded.
    is_held: bool,
    pub(super) kernels: Option<PointKernels>,
}

impl ElementFields {
    /// The fields at a depth of elements of side `element_side` (m), for points up to `largest_distance` (m) from the
    /// centre of the element.
    ///
    /// Accuracy: 1e-11 of the largest value of each field at that depth.
    ///
    /// # Errors
    ///
    /// A side that is not finite and positive; [`InfluenceError::Depth`] for a depth above the surface or inside a
    /// rigid base; amplitudes that the kernel cannot give.
    pub fn new(
        foundation: &Foundation,
        element_side: f64,
        depth: Depth,
        largest_distance: f64,
    ) -> Result<Self, InfluenceError> {
        check_element_side(element_side)?;
        depth.check(foundation)?;
        let largest_radius = largest_distance + element_side;
        let kernels = PointKernels::new(foundation, depth, largest_radius)?;
        Ok(Self {
            foundation: foundation.clone(),
            element_side,
            depth: depth.z,
            has_homogeneous: depth.is_split(foundation),
            is_held: depth.is_held(foundation),
            kernels,
        })
    }

    /// The states at `point`, (x, y) from the centre of the element, in m.
    ///
    /// Where nothing holds the body along the surface, above a frictionless interface, `u_x` and `u_y` under the
    /// traction are unbounded and returned as NaN.
    #[must_use]
    pub fn at(&self, point: [f64; 2]) -> ElementLoads {
        ElementLoads {
            normal: self.state(SurfaceLoad::Pressure, point),
            tangential: self.state(SurfaceLoad::Traction, point),
        }
    }

    /// The state at a point under one of the loads.
    #[must_use]
    pub fn state(&self, load: SurfaceLoad, point: [f64; 2]) -> SubsurfaceState {
        let mut state = self.smooth_part(load, point);
        if self.has_homogeneous {
            let material = self.foundation.surface_material();
            let point = [point[0], point[1], self.depth];
            state += loaded_square(load, &material, self.element_side, point);
        }
        if load == SurfaceLoad::Traction && !self.is_held {
            state.displacement[..2].fill(f64::NAN);
        }
        state
    }

    /// Whether a field under the traction is bounded.
    pub(super) fn is_bounded(&self, field: usize) -> bool {
        self.is_held || field > 1
    }

    /// The part of the state that comes from point loads.
    pub(super) fn smooth_part(&self, load: SurfaceLoad, point: [f64; 2]) -> SubsurfaceState {
        let mut state = SubsurfaceState::default();
        if let Some(kernels) = &self.kernels {
            let element = Cell {
                centre: [0.0, 0.0],
                half_side: self.element_side / 2.0,
            };
            element.add_to(&mut state, load, kernels, point);
        }
        state
    }
}

/// A square part of the element.
struct Cell {
    centre: [f64; 2],
    half_side: f64,
}

impl Cell {
    /// Adds the field of the cell's load at a point: by a Gauss rule where the kernels are smooth on its scale, by
    /// its quarters else.
    fn add_to(
        &self,
        state: &mut SubsurfaceState,
        load: SurfaceLoad,
        kernels: &PointKernels,
        point: [f64; 2],
    ) {
        let [x, y] = [0, 1].map(|axis: usize| point[axis] - self.centre[axis]);
        // The kernels are analytic for radii within i times their reach.
        let distance = x.hypot(y).hypot(kernels.reach) / self.half_side;
        let Some((_, line)) = RULES.iter().find(|(from, _)| distance >= *from) else {
            let half_side = self.half_side / 2.0;
            for [side_x, side_y] in [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]] {
                let centre = [
                    self.centre[0] + side_x * half_side,
                    self.centre[1] + side_y * half_side,
                ];
                Self { centre, half_side }.add_to(state, load, kernels, point);
            }
            return;
        };
        for one in line {
            for other in line {
                let from = [
                    x - self.half_side * one.position,
                    y - self.half_side * other.position,
                ];
                let weight = self.half_side * self.half_side * one.weight * other.weight;
                *state += kernels.at(load, from) * weight;
            }
        }
    }
}
