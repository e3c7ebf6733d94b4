//! The fields of one loaded element at one depth.

use pellicle_kernel::Foundation;

use super::depth::Depth;
use super::state::{SubsurfaceState, SurfaceLoad};
use super::under_load::{DepthWaves, UnderLoad, UnderPressure, UnderTraction};
use super::waves::Waves;
use crate::element::check_element_side;
use crate::error::InfluenceError;

/// The states of one point under the two loads of an element.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ElementLoads {
    /// Under a unit pressure.
    pub normal: SubsurfaceState,
    /// Under a unit traction that drags the surface along +x.
    pub tangential: SubsurfaceState,
}

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
    element_side: f64,
    /// Whether `u_x` and `u_y` under a traction are bounded.
    is_held: bool,
    normal: UnderPressure,
    tangential: UnderTraction,
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
        let mut waves = Waves::new(foundation, element_side);
        let waves = DepthWaves::new(&mut waves, depth, largest_distance)?;
        Ok(Self {
            element_side,
            is_held: depth.is_held(foundation),
            normal: UnderLoad::new(&waves),
            tangential: UnderLoad::new(&waves),
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
        let place = point.map(|along| along / self.element_side);
        let mut state = match load {
            SurfaceLoad::Pressure => self.normal.at(place),
            SurfaceLoad::Traction => self.tangential.at(place),
        };
        if load == SurfaceLoad::Traction && !self.is_held {
            state.displacement[..2].fill(f64::NAN);
        }
        state
    }
}
