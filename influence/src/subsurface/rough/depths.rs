//! The functions of the radius at many depths, each computed once.

use std::collections::BTreeMap;
use std::ops::Add;
use std::sync::Arc;

use pellicle_kernel::{Amplitudes, Foundation, Interior, KernelError, Material, Side};

use super::{NEAR, NEAR_SURFACE, RoughPressure, RoughTraction};
use crate::element::check_element_side;
use crate::error::InfluenceError;
use crate::subsurface::depth::Depth;
use crate::subsurface::element_table::ElementStates;
use crate::subsurface::point_kernels::{
    NORMAL_STRESSES, PressureStresses, TANGENTIAL_STRESSES, TractionStresses,
};
use crate::subsurface::radial_panels::{Layout, RadialPanels};
use crate::subsurface::state::SubsurfaceState;
use crate::subsurface::waves::Waves;

/// Functions are tabulated up to this factor beyond the distance that is asked for, so that others seldom need more.
const ROOM: f64 = 1.5;

/// The stresses around point loads at all depths asked for so far, to 2e-6 of the largest at each depth; without
/// displacements.
#[derive(Debug)]
pub struct RoughDepths {
    waves: Waves,
    slides: bool,
    known: BTreeMap<Key, Arc<DepthKernels>>,
    computed: usize,
}

/// A depth and, near the surface, the side of the elements.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Key {
    depth: u64,
    is_above: bool,
    element_side: u64,
}

/// The functions at one depth. Lengths are in units of the waves.
#[derive(Debug)]
pub struct DepthKernels {
    /// Unit of lengths and depth, m.
    pub unit: f64,
    pub depth: f64,
    /// Farthest distance from a point load.
    farthest: f64,
    /// The whole fields; near the surface, only away from a load.
    pub whole: Kernels,
    pub near_surface: Option<NearSurface>,
}

/// The fields close to a load near the surface: those of a half-space of this material, and the layers' correction.
#[derive(Debug)]
pub struct NearSurface {
    pub material: Material,
    pub correction: Option<Kernels>,
}

/// The functions under a pressure and a traction.
#[derive(Debug)]
pub struct Kernels {
    /// Depth with which the waves decay.
    pub reach: f64,
    pub normal: RadialPanels<NORMAL_STRESSES>,
    pub tangential: Option<RadialPanels<TANGENTIAL_STRESSES>>,
}

impl RoughDepths {
    /// The stresses in a foundation, under a pressure and, if there is friction, under tractions.
    ///
    /// # Errors
    ///
    /// A length that is not finite and positive. It may be any that occurs, such as the side of an element.
    pub fn new(
        foundation: &Foundation,
        length: f64,
        friction: [f64; 2],
    ) -> Result<Self, InfluenceError> {
        check_element_side(length)?;
        Ok(Self {
            waves: Waves::rough(foundation, length),
            slides: friction.iter().any(|factor| *factor != 0.0),
            known: BTreeMap::new(),
            computed: 0,
        })
    }

    /// Number of depths computed so far, a measure of the work.
    #[must_use]
    pub fn computed(&self) -> usize {
        self.computed
    }

    /// Forgets the depths, but not the waves.
    pub fn forget(&mut self) {
        self.known.clear();
    }

    /// The stresses at `point` (x, y; m) and a depth under many elements of side `element_side` (m), each given by its
    /// centre (m) and its pressure (Pa), with a traction of `friction` times the pressure along x and y.
    ///
    /// # Errors
    ///
    /// As [`ElementFields::new`](crate::ElementFields::new).
    pub fn sum_over(
        &mut self,
        loaded: &[([f64; 2], f64)],
        element_side: f64,
        friction: [f64; 2],
        (point, depth): ([f64; 2], Depth),
    ) -> Result<SubsurfaceState, InfluenceError> {
        let seen = |centre: &[f64; 2]| [0, 1].map(|axis: usize| point[axis] - centre[axis]);
        let squares = loaded.iter().map(|(centre, _)| {
            let [x, y] = seen(centre);
            x * x + y * y
        });
        let farthest = squares.fold(0.0, f64::max).sqrt();
        let kernels = self.at(depth, element_side, farthest + element_side)?;
        let normal = RoughPressure::under_pressure(&kernels, element_side);
        let tangential = RoughTraction::under_traction(&kernels, element_side);
        let per_side = 1.0 / element_side;
        let of_element = |(centre, pressure): &([f64; 2], f64)| {
            let place = seen(centre).map(|along| along * per_side);
            let mut state = normal.at(place);
            if let Some(tangential) = &tangential {
                let [along_x, along_y] = tangential.at_both(place);
                state += along_x * friction[0] + along_y.transposed() * friction[1];
            }
            state * *pressure
        };
        Ok(loaded
            .iter()
            .map(of_element)
            .fold(SubsurfaceState::default(), Add::add))
    }

    /// The functions at a depth for elements of this side (m) at distances of up to `farthest` (m).
    pub(in crate::subsurface) fn at(
        &mut self,
        depth: Depth,
        element_side: f64,
        farthest: f64,
    ) -> Result<Arc<DepthKernels>, InfluenceError> {
        check_element_side(element_side)?;
        depth.check(self.waves.foundation())?;
        let is_near_surface =
            depth.is_split(self.waves.foundation()) && depth.z < NEAR_SURFACE * element_side;
        let key = Key {
            depth: depth.z.to_bits(),
            is_above: depth.side == Side::Above,
            element_side: if is_near_surface {
                element_side.to_bits()
            } else {
                0
            },
        };
        let farthest = farthest / self.waves.unit();
        let known = self.known.get(&key);
        if let Some(known) = known.filter(|known| known.farthest >= farthest) {
            return Ok(known.clone());
        }
        let side = is_near_surface.then(|| element_side / self.waves.unit());
        let kernels = Arc::new(self.computed_at(depth, side, ROOM * farthest)?);
        self.known.insert(key, kernels.clone());
        self.computed += 1;
        Ok(kernels)
    }

    fn computed_at(
        &mut self,
        depth: Depth,
        near_surface: Option<f64>,
        farthest: f64,
    ) -> Result<DepthKernels, KernelError> {
        let (unit, slides) = (self.waves.unit(), self.slides);
        let z = depth.z / unit;
        let foundation = self.waves.foundation();
        let material = foundation.surface_material();
        let top = foundation.layers().first().copied();
        let mut kernels = |layout: Layout, of: &dyn Fn(&Interior) -> Option<Amplitudes>| {
            let sampled = self.waves.sampled(layout, of, |_| 1.0)?;
            Ok::<_, KernelError>(Kernels {
                reach: sampled.reach(),
                normal: sampled.panels::<PressureStresses, NORMAL_STRESSES>(),
                tangential: slides
                    .then(|| sampled.panels::<TractionStresses, TANGENTIAL_STRESSES>()),
            })
        };
        let nearest = near_surface.map_or(0.0, |side| {
            let from = NEAR * side;
            (from * from - z * z).sqrt() - side
        });
        let all = |interior: &Interior| Some(interior.at(depth.z, depth.side));
        let whole = kernels(Layout::rough(z, [nearest, farthest.max(nearest)]), &all)?;
        let near_surface = match (near_surface, top) {
            (None, _) => None,
            (Some(_), None) => Some(None),
            (Some(side), Some(top)) => {
                let reach = 2.0 * top.thickness() / unit - z;
                let layout = Layout::rough(reach, [0.0, (NEAR + 1.0) * side]);
                let of = |interior: &Interior| interior.correction(depth.z);
                Some(Some(kernels(layout, &of)?))
            }
        };
        Ok(DepthKernels {
            unit,
            depth: depth.z,
            farthest,
            whole,
            near_surface: near_surface.map(|correction| NearSurface {
                material,
                correction,
            }),
        })
    }
}
