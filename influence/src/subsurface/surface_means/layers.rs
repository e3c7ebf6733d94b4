//! What layers change of the means over four points of an element.
//!
//! The mean of a wave over the four points and the loaded element hardly depends on the wave's direction. Averaged over
//! the directions it is a factor of the layers' correction, which then is a function of the radius alone, for all
//! distances.

use std::f64::consts::PI;

use pellicle_kernel::{Foundation, Interior, KernelError, Layer};

use super::{ALONG_SURFACE, EXCHANGED};
use crate::subsurface::depth::Depth;
use crate::subsurface::log_lattice::ROUGH;
use crate::subsurface::point_kernels::{
    NORMAL, NORMAL_STRESSES, PointLoad, Pressure, PressureStresses, TANGENTIAL,
    TANGENTIAL_STRESSES, Traction, TractionStresses,
};
use crate::subsurface::radial_panels::{Layout, RadialPanels};
use crate::subsurface::state::SubsurfaceState;
use crate::subsurface::under_load::{DepthWaves, UnderLoad};
use crate::subsurface::waves::Waves;

/// Layers whose waves decay over at least this many sides have a correction that is taken as a function of the radius.
/// What depends on the direction is `k⁴ cos 4θ/2900`: 1e-5 of the correction at a reach of four sides; at one side it
/// still cancels in sums over pressures that vary slowly.
const SMOOTH_REACH: f64 = 1.0;

/// The four points, `ξ = ±h/3`: there the aliases `Σ (−1)^m cos(2πm ξ/h)/m = −ln(2 cos(π ξ/h))` of an odd symbol
/// vanish.
const FOUR_POINTS: [[f64; 2]; 4] = {
    let third = 1.0 / 3.0;
    [
        [third, third],
        [third, -third],
        [-third, third],
        [-third, -third],
    ]
};

/// `σ_xx`, `σ_yy`, `σ_xy` at (m, n) and at (n, m), under a pressure and under a traction along x.
pub type Means = [[[f64; 3]; 2]; 2];

/// The means of layers at every place. Lengths are in sides of an element.
pub enum LayerMeans {
    /// What the layers add to the half-space of the top layer's material.
    Added(
        RadialPanels<NORMAL_STRESSES>,
        RadialPanels<TANGENTIAL_STRESSES>,
    ),
    /// The whole stresses at points, on top layers thinner than half an element.
    Whole(
        Box<UnderLoad<Pressure, NORMAL>>,
        Box<UnderLoad<Traction, TANGENTIAL>>,
    ),
}

impl LayerMeans {
    /// On a foundation with layers, for elements of side `element_side` (m) at distances of up to `farthest` sides.
    pub fn new(
        foundation: &Foundation,
        element_side: f64,
        farthest: f64,
    ) -> Result<Self, KernelError> {
        let top = foundation.layers().first();
        let thickness = top.map_or(0.0, Layer::thickness);
        let reach = 2.0 * thickness / element_side;
        if reach < SMOOTH_REACH {
            let mut waves = Waves::new(foundation, element_side);
            let waves = DepthWaves::new(&mut waves, Depth::below(0.0), element_side * farthest)?;
            return Ok(Self::Whole(
                Box::new(UnderLoad::new(&waves)),
                Box::new(UnderLoad::new(&waves)),
            ));
        }
        let mut waves = Waves::rough(foundation, element_side);
        let correction = |interior: &Interior| interior.correction(0.0);
        let layout = Layout::rough(reach, [0.0, farthest]);
        let sampled = waves.sampled(layout, correction, factor)?;
        Ok(Self::Added(
            sampled.panels::<PressureStresses, NORMAL_STRESSES>(),
            sampled.panels::<TractionStresses, TANGENTIAL_STRESSES>(),
        ))
    }

    /// Whether the means are what is added to those of a half-space.
    pub fn are_added(&self) -> bool {
        matches!(self, Self::Added(..))
    }

    /// The means at a place and at that with x and y exchanged.
    pub fn at(&self, [x, y]: [f64; 2]) -> Means {
        match self {
            Self::Added(normal, tangential) => {
                let square = x * x + y * y;
                let (normal, tangential) = (normal.at(square), tangential.at(square));
                let pressed = along_surface(&PressureStresses::state(&normal, [x, y]));
                let dragged = |place| along_surface(&TractionStresses::state(&tangential, place));
                [
                    [pressed, EXCHANGED.map(|stress| pressed[stress])],
                    [dragged([x, y]), dragged([y, x])],
                ]
            }
            Self::Whole(normal, tangential) => {
                let mut sums = Means::default();
                for [i, j] in FOUR_POINTS {
                    let place = [x + i, y + j];
                    let states = [normal.at_both(place), tangential.at_both(place)];
                    for (sums, states) in sums.iter_mut().zip(states) {
                        for (sum, state) in sums.iter_mut().zip(states) {
                            let terms = sum.iter_mut().zip(along_surface(&state));
                            terms.for_each(|(sum, stress)| *sum += 0.25 * stress);
                        }
                    }
                }
                sums
            }
        }
    }
}

fn along_surface(state: &SubsurfaceState) -> [f64; 3] {
    ALONG_SURFACE.map(|field| state.field(field))
}

/// The mean of a wave over the four points and the loaded element, averaged over its directions.
fn factor(index: isize) -> f64 {
    let wavenumber = (index as f64 * ROUGH.step).exp();
    let directions = [1.0, 3.0, 5.0, 7.0].map(|odd| odd * PI / 32.0);
    let mean = directions.map(|angle| {
        let k = [wavenumber * angle.cos(), wavenumber * angle.sin()];
        let [x, y] = k.map(|k| (k / 2.0).sin() / (k / 2.0) * (k / 3.0).cos());
        x * y
    });
    mean.iter().sum::<f64>() / 4.0
}
