//! The fields of one loaded element at one depth.

use std::ops::Add;
use std::sync::OnceLock;

use pellicle_kernel::Foundation;
use rayon::prelude::*;

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
    is_held_laterally: bool,
    normal: UnderPressure,
    /// Computed when a traction first needs it.
    tangential: OnceLock<UnderTraction>,
    waves: DepthWaves,
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
    /// rigid base; amplitudes that the kernel cannot compute.
    pub fn new(
        foundation: &Foundation,
        element_side: f64,
        depth: Depth,
        largest_distance: f64,
    ) -> Result<Self, InfluenceError> {
        ElementDepths::new(foundation, element_side)?.fields(depth, largest_distance)
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

    fn tangential(&self) -> &UnderTraction {
        self.tangential.get_or_init(|| UnderLoad::new(&self.waves))
    }

    /// The state at a point under one of the loads.
    #[must_use]
    pub fn state(&self, load: SurfaceLoad, point: [f64; 2]) -> SubsurfaceState {
        let place = point.map(|along| along / self.element_side);
        let mut state = match load {
            SurfaceLoad::Pressure => self.normal.at(place),
            SurfaceLoad::Traction => self.tangential().at(place),
        };
        if load == SurfaceLoad::Traction && !self.is_held_laterally {
            state.displacement[..2].fill(f64::NAN);
        }
        state
    }

    /// The state at `point` (x, y; m) under many elements, each given by its centre (m) and its pressure (Pa), which
    /// also causes a traction of `friction` times itself along x and y: displacements in m, stresses in Pa.
    ///
    /// The order of the sum is fixed, so every number of threads gives the same bits. Unbounded `u_x` and `u_y` are
    /// NaN, as in [`Self::at`].
    #[must_use]
    pub fn sum_over(
        &self,
        loaded: &[([f64; 2], f64)],
        friction: [f64; 2],
        point: [f64; 2],
    ) -> SubsurfaceState {
        let slides = friction.iter().any(|factor| *factor != 0.0);
        let of_element = |([x, y], pressure): &([f64; 2], f64)| {
            let place = [point[0] - x, point[1] - y].map(|along| along / self.element_side);
            let mut state = self.normal.at(place);
            if slides {
                let [along_x, along_y] = self.tangential().at_both(place);
                state += along_x * friction[0] + along_y.transposed() * friction[1];
            }
            state * *pressure
        };
        let sum = |states: &mut dyn Iterator<Item = SubsurfaceState>| {
            states.fold(SubsurfaceState::default(), Add::add)
        };
        let parts = loaded.par_chunks(ELEMENTS_PER_TASK);
        let parts: Vec<_> = parts
            .map(|part| sum(&mut part.iter().map(of_element)))
            .collect();
        let mut state = sum(&mut parts.into_iter());
        if slides && !self.is_held_laterally {
            state.displacement[..2].fill(f64::NAN);
        }
        state
    }
}

/// Number of elements that one task sums over.
const ELEMENTS_PER_TASK: usize = 512;

/// Fields of one element at many depths.
///
/// The waves in the body are solved for at the first depth; each further depth takes a fraction of that time.
///
/// ```
/// use pellicle_influence::{Depth, ElementDepths};
/// use pellicle_kernel::{Foundation, Material, Side};
///
/// let (coating, steel) = (Material::new(400e9, 0.25)?, Material::new(210e9, 0.3)?);
/// let mut depths = ElementDepths::new(&Foundation::coated(2e-6, coating, steel)?, 1e-6)?;
/// let mut shear_below = |z| {
///     let fields = depths.fields(Depth { z, side: Side::Above }, 10e-6)?;
///     // Two elements side by side, each under 1 GPa, seen from below their common edge.
///     let loaded = [([-0.5e-6, 0.0], 1e9), ([0.5e-6, 0.0], 1e9)];
///     Ok::<_, pellicle_influence::InfluenceError>(fields.sum_over(&loaded, [0.0; 2], [0.0; 2]).stress[4])
/// };
/// // By symmetry σ_xz is 0 there, to rounding.
/// assert!(shear_below(0.5e-6)?.abs() < 1e-3 && shear_below(1.5e-6)?.abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct ElementDepths(Waves);

impl ElementDepths {
    /// The fields of elements of side `element_side` (m).
    ///
    /// # Errors
    ///
    /// A side that is not finite and positive.
    pub fn new(foundation: &Foundation, element_side: f64) -> Result<Self, InfluenceError> {
        check_element_side(element_side)?;
        Ok(Self(Waves::new(foundation, element_side)))
    }

    /// The fields at a depth, as [`ElementFields::new`].
    ///
    /// # Errors
    ///
    /// As [`ElementFields::new`].
    pub fn fields(
        &mut self,
        depth: Depth,
        largest_distance: f64,
    ) -> Result<ElementFields, InfluenceError> {
        depth.check(self.0.foundation())?;
        let waves = DepthWaves::new(&mut self.0, depth, largest_distance)?;
        Ok(ElementFields {
            element_side: self.0.unit(),
            is_held_laterally: depth.is_held_laterally(self.0.foundation()),
            normal: UnderLoad::new(&waves),
            tangential: OnceLock::new(),
            waves,
        })
    }
}
