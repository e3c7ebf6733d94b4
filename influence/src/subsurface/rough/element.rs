//! The stresses of one element at one depth, from the functions of point loads.

use std::marker::PhantomData;
use std::sync::LazyLock;

use super::NEAR;
use super::depths::{DepthKernels, Kernels, NearSurface};
use crate::numerics::quadrature::{Node, legendre_of};
use crate::subsurface::element_table::ElementStates;
use crate::subsurface::homogeneous::loaded_square;
use crate::subsurface::point_kernels::{
    NORMAL_STRESSES, PointLoad, PressureStresses, TANGENTIAL_STRESSES, TractionStresses,
};
use crate::subsurface::radial_panels::RadialPanels;
use crate::subsurface::state::{SubsurfaceState, SurfaceLoad};

/// Rules for square cells, and the distance, in half sides of the cell, from which the error of each is some 1e-6 of a
/// point load: p points per direction leave some ten times `(2d)^(−2p)` under a traction.
static RULES: LazyLock<[(f64, Vec<Node>); 3]> = LazyLock::new(|| {
    [
        (9.0, legendre_of::<3>()),
        (5.0, legendre_of::<4>()),
        (2.5, legendre_of::<6>()),
    ]
});

/// Distance, in sides, from which the averages of functions over an element are accurate to 2e-6 of a point load.
const FAR: f64 = 15.0;

/// The stresses of an element under one load. Places are in sides of the element from its centre.
pub struct RoughElement<'a, L, const F: usize> {
    load: PhantomData<L>,
    /// Side and depth, m.
    side: f64,
    depth: f64,
    /// Side in units of the functions.
    ratio: f64,
    whole: Radial<'a, F>,
    near_surface: Option<(&'a NearSurface, Option<Radial<'a, F>>)>,
}

/// Under a pressure, and under a traction.
pub type RoughPressure<'a> = RoughElement<'a, PressureStresses, NORMAL_STRESSES>;
pub type RoughTraction<'a> = RoughElement<'a, TractionStresses, TANGENTIAL_STRESSES>;

/// Functions of the radius and the depth with which they vary, in sides.
struct Radial<'a, const F: usize> {
    reach: f64,
    functions: &'a RadialPanels<F>,
    /// Averaged over the element.
    far: RadialPanels<F>,
}

impl<'a> RoughPressure<'a> {
    /// An element of this side (m) under a pressure.
    pub fn under_pressure(kernels: &'a DepthKernels, side: f64) -> Self {
        let correction = |near: &'a NearSurface| near.correction.as_ref();
        let correction = kernels.near_surface.as_ref().and_then(correction);
        let correction = correction.map(|of| (of, &of.normal));
        Self::new(kernels, side, &kernels.whole.normal, correction)
    }
}

impl<'a> RoughTraction<'a> {
    /// An element of this side (m) under a traction; none without friction.
    pub fn under_traction(kernels: &'a DepthKernels, side: f64) -> Option<Self> {
        let correction = |near: &'a NearSurface| near.correction.as_ref();
        let correction = kernels.near_surface.as_ref().and_then(correction);
        let correction = correction.and_then(|of| Some((of, of.tangential.as_ref()?)));
        let whole = kernels.whole.tangential.as_ref()?;
        Some(Self::new(kernels, side, whole, correction))
    }
}

impl<'a, L: PointLoad<F>, const F: usize> RoughElement<'a, L, F> {
    fn new(
        kernels: &'a DepthKernels,
        side: f64,
        whole: &'a RadialPanels<F>,
        correction: Option<(&'a Kernels, &'a RadialPanels<F>)>,
    ) -> Self {
        let ratio = side / kernels.unit;
        let radial = |reach: f64, functions: &'a RadialPanels<F>| Radial {
            reach: reach / ratio,
            functions,
            far: functions.averaged(L::ORDERS, ratio),
        };
        let correction = correction.map(|(of, functions)| radial(of.reach, functions));
        let near_surface = kernels.near_surface.as_ref();
        Self {
            load: PhantomData,
            side,
            depth: kernels.depth,
            ratio,
            whole: radial(kernels.whole.reach, whole),
            near_surface: near_surface.map(|near| (near, correction)),
        }
    }

    /// Whether the closed form gives the state at a place.
    fn is_near(&self, [x, y]: [f64; 2]) -> bool {
        let depth = self.depth / self.side;
        self.near_surface.is_some() && x * x + y * y + depth * depth < NEAR * NEAR
    }

    /// The closed form's part of the state; zero away from the element.
    fn closed_form(&self, [x, y]: [f64; 2]) -> SubsurfaceState {
        match &self.near_surface {
            Some((near, _)) if self.is_near([x, y]) => {
                let point = [x * self.side, y * self.side, self.depth];
                loaded_square(L::LOAD, &near.material, self.side, point)
            }
            _ => SubsurfaceState::default(),
        }
    }

    /// Calls `take` for the points of the element over which the rest of the state is summed, with their weights and
    /// functions and the place as seen from each.
    fn visit(&self, place: [f64; 2], mut take: impl FnMut(f64, &[f64; F], [f64; 2])) {
        let radial = match &self.near_surface {
            Some((_, correction)) if self.is_near(place) => correction.as_ref(),
            _ => Some(&self.whole),
        };
        let Some(Radial {
            reach,
            functions,
            far,
        }) = radial
        else {
            return;
        };
        let (ratio, [x, y]) = (self.ratio, place);
        if x * x + y * y + reach * reach >= FAR * FAR {
            let [x, y] = place.map(|along| along * ratio);
            take(ratio * ratio, &far.at(x * x + y * y), [x, y]);
            return;
        }
        visit_cell([0.0; 2], 0.5, place, *reach, &mut |weight, from| {
            let [x, y] = from.map(|along| along * ratio);
            take(weight * ratio * ratio, &functions.at(x * x + y * y), [x, y]);
        });
    }
}

impl<L: PointLoad<F>, const F: usize> ElementStates for RoughElement<'_, L, F> {
    const LOAD: SurfaceLoad = L::LOAD;

    fn at(&self, place: [f64; 2]) -> SubsurfaceState {
        let mut state = self.closed_form(place);
        self.visit(place, |weight, functions, from| {
            state += L::state(functions, from) * weight;
        });
        state
    }

    fn at_both(&self, [x, y]: [f64; 2]) -> [SubsurfaceState; 2] {
        let mut states = [self.closed_form([x, y]), self.closed_form([y, x])];
        self.visit([x, y], |weight, functions, [x, y]| {
            states[0] += L::state(functions, [x, y]) * weight;
            states[1] += L::state(functions, [y, x]) * weight;
        });
        states
    }
}

/// Calls `take` with the weights of a Gauss rule on a square cell and the place as seen from its points, if kernels of
/// this reach are smooth on the cell's scale; otherwise visits the cell's quarters.
fn visit_cell(
    centre: [f64; 2],
    half_side: f64,
    place: [f64; 2],
    reach: f64,
    take: &mut impl FnMut(f64, [f64; 2]),
) {
    let [x, y] = [0, 1].map(|axis: usize| place[axis] - centre[axis]);
    let square = (x * x + y * y + reach * reach) / (half_side * half_side);
    let Some((_, line)) = RULES.iter().find(|(from, _)| square >= from * from) else {
        let quarter = half_side / 2.0;
        for [side_x, side_y] in [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]] {
            let centre = [centre[0] + side_x * quarter, centre[1] + side_y * quarter];
            visit_cell(centre, quarter, place, reach, take);
        }
        return;
    };
    for one in line {
        for other in line {
            let from = [x - half_side * one.position, y - half_side * other.position];
            take(half_side * half_side * one.weight * other.weight, from);
        }
    }
}
