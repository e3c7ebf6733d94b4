//! The fields of one element under one load at one depth.
//!
//! There are three zones, by the distance from the element's centre to the point. Lengths are in sides of the element.
//!
//! - far: the functions of the radius are those of the element itself. The mean of a wave `e^{ik·x}` over the element
//!   is `sinc(k_x/2) sinc(k_y/2)`, which is replaced by its own mean over the directions, a factor of the amplitude.
//!   The error is of the order of `k⁴ cos 4θ / 11520`.
//! - middle: the mean of four points `(±t, ±t)`, where `t⁴ = 1/240` removes the term in `k⁴ cos 4θ`. Their own mean
//!   of a wave is `cos(t k_x) cos(t k_y)`; the factor of the amplitude is the mean of the ratio over the
//!   directions, up to `k⁶`.
//! - near: Gauss points and, near the surface, the closed form for a half-space of the top layer's material.

use std::f64::consts::PI;
use std::marker::PhantomData;
use std::sync::LazyLock;

use pellicle_kernel::{KernelError, Material};

use super::depth::Depth;
use super::homogeneous::loaded_square;
use super::log_lattice::STEP;
use super::point_kernels::{NORMAL, PointLoad, Pressure, TANGENTIAL, Traction};
use super::radial_panels::{Layout, RadialPanels};
use super::state::SubsurfaceState;
use super::waves::{Sampled, Waves};
use crate::numerics::quadrature::{Node, legendre_of};

/// Distance from which the error of the middle zone's means is 1e-12 of the largest value of a field.
const MIDDLE_FROM: f64 = 40.0;

/// Distance from which the error of the far zone's functions is 2e-12 of the largest value of a field.
const FAR_FROM: f64 = 300.0;

/// Coordinates of the points of the middle zone, `240^(−1/4)`.
const POINT: f64 = 0.254_067_078_995_166_5;

/// Rules for square cells, and the distance, in half sides of the cell, from which the error of each is below 1e-14 of
/// a point kernel: p points per direction leave `(2d)^(−2p)`.
static RULES: LazyLock<[(f64, Vec<Node>); 5]> = LazyLock::new(|| {
    [
        (200.0, legendre_of::<3>()),
        (40.0, legendre_of::<4>()),
        (16.0, legendre_of::<5>()),
        (8.0, legendre_of::<6>()),
        (4.0, legendre_of::<8>()),
    ]
});

/// Lattice points of the wavenumber below which factors are 1 to 1e-17, and up to which either zone needs them: the end
/// of [the rule](super::log_lattice) at the smallest radius from which the zone's functions are interpolated.
const FACTORS: [isize; 2] = [-1950, 230];

/// The factors of the far and of the middle zone.
static FACTORS_OF_ZONES: LazyLock<Vec<[f64; 2]>> = LazyLock::new(|| {
    let [first, last] = FACTORS;
    (first..=last)
        .map(|index| factors((index as f64 * STEP).exp()))
        .collect()
});

/// The factors of waves of one wavenumber.
fn factors(wavenumber: f64) -> [f64; 2] {
    // Midpoints of an eighth of a turn, exact up to cos 28θ.
    let directions = [1.0, 3.0, 5.0, 7.0].map(|odd| odd * PI / 32.0);
    let mean = directions.map(|angle| {
        let k = [wavenumber * angle.cos(), wavenumber * angle.sin()];
        let [x, y] = k.map(|k| (k / 2.0).sin() / (k / 2.0));
        x * y
    });
    // ln (sinc(k/2)/cos(t k)) = −(1/24 − t²/2) k² + (t⁶/45 − 1/181440) k⁶ + …, and the mean of cos⁶ θ + sin⁶ θ is
    // 5/8. The ratio itself has poles.
    let square = wavenumber * wavenumber;
    let second = 1.0 / 24.0 - POINT * POINT / 2.0;
    let sixth = 0.625 * (POINT.powi(6) / 45.0 - 1.0 / 181_440.0);
    let of_points = (-second * square).exp() * (1.0 + sixth * square.powi(3));
    [mean.iter().sum::<f64>() / 4.0, of_points]
}

/// The factor at the index of a wavenumber; 0 where none is needed.
fn factor(zone: usize, index: isize) -> f64 {
    match usize::try_from(index - FACTORS[0]) {
        Err(_) => 1.0,
        Ok(place) => FACTORS_OF_ZONES
            .get(place)
            .map_or(0.0, |factors| factors[zone]),
    }
}

/// The amplitudes at one depth from which the fields of any load are computed.
#[derive(Clone, Debug)]
pub struct DepthWaves {
    depth: Depth,
    /// Side of an element, m.
    side: f64,
    /// The material of the half-space whose fields are added in the near zone.
    material: Option<Material>,
    near: Option<Sampled>,
    middle: Option<Sampled>,
    far: Option<Sampled>,
}

impl DepthWaves {
    /// The amplitudes for points up to `largest_distance` (m) from the centre of an element.
    pub fn new(
        waves: &mut Waves,
        depth: Depth,
        largest_distance: f64,
    ) -> Result<Self, KernelError> {
        let (side, foundation) = (waves.unit(), waves.foundation().clone());
        let (z, largest) = (depth.z / side, largest_distance / side);
        let is_split = depth.is_split(&foundation);
        // Radii from one distance to another, or to the largest.
        let zone = |[from, to]: [f64; 2], room: f64| {
            let radius = |distance: f64| (distance * distance - z * z).max(0.0).sqrt();
            let ends = [radius(from), radius(to).min(largest)];
            let is_empty = to <= z || (from > 0.0 && ends[0] >= ends[1]);
            (!is_empty).then(|| [(ends[0] - room).max(0.0), ends[1] + room])
        };
        let all = |interior: &pellicle_kernel::Interior| Some(interior.at(depth.z, depth.side));
        let mut sampled = |ends: Option<[f64; 2]>, number: usize| {
            let layout = ends.map(|ends| Layout::new(z, ends));
            layout
                .map(|layout| waves.sampled(layout, all, |index| factor(number, index)))
                .transpose()
        };
        let far = sampled(zone([FAR_FROM, f64::INFINITY], 0.0), 0)?;
        let middle = sampled(zone([MIDDLE_FROM, FAR_FROM], 0.5), 1)?;
        let near = zone([0.0, MIDDLE_FROM], 1.0);
        let near = match (near, foundation.layers().first()) {
            (None, _) | (_, None) => None,
            (Some(ends), Some(top)) if is_split => {
                let reach = (2.0 * top.thickness() - depth.z) / side;
                let correction =
                    |interior: &pellicle_kernel::Interior| interior.correction(depth.z);
                Some(waves.sampled(Layout::new(reach, ends), correction, |_| 1.0)?)
            }
            (Some(ends), Some(_)) => Some(waves.sampled(Layout::new(z, ends), all, |_| 1.0)?),
        };
        Ok(Self {
            depth,
            side,
            material: is_split.then(|| foundation.surface_material()),
            near,
            middle,
            far,
        })
    }
}

/// The fields of an element under one load at one depth. Lengths are in sides of the element.
#[derive(Clone, Debug)]
pub struct UnderLoad<L, const F: usize> {
    load: PhantomData<L>,
    depth: f64,
    homogeneous: Option<Homogeneous>,
    near: Option<Near<F>>,
    middle: Option<RadialPanels<F>>,
    far: Option<RadialPanels<F>>,
}

/// Under a pressure, and under a traction.
pub type UnderPressure = UnderLoad<Pressure, NORMAL>;
pub type UnderTraction = UnderLoad<Traction, TANGENTIAL>;

/// The fields in a half-space of the top layer's material, in closed form.
#[derive(Clone, Debug)]
struct Homogeneous {
    material: Material,
    /// Side of the element, m.
    side: f64,
    /// Depth of the point, m.
    depth: f64,
}

/// The near zone: the layers' correction to the half-space, or the whole fields without one.
#[derive(Clone, Debug)]
struct Near<const F: usize> {
    panels: RadialPanels<F>,
    reach: f64,
}

impl<L: PointLoad<F>, const F: usize> UnderLoad<L, F> {
    pub fn new(waves: &DepthWaves) -> Self {
        let (side, depth) = (waves.side, waves.depth.z);
        let panels = |sampled: &Sampled| sampled.panels::<L, F>();
        Self {
            load: PhantomData,
            depth: depth / side,
            homogeneous: waves.material.map(|material| Homogeneous {
                material,
                side,
                depth,
            }),
            near: waves.near.as_ref().map(|near| Near {
                panels: panels(near),
                reach: near.reach(),
            }),
            middle: waves.middle.as_ref().map(panels),
            far: waves.far.as_ref().map(panels),
        }
    }

    /// The state at (x, y).
    #[inline]
    pub fn at(&self, place: [f64; 2]) -> SubsurfaceState {
        let mut state = self.homogeneous_at(place);
        self.visit(place, |weight, functions, from| {
            state += L::state(functions, from) * weight;
        });
        state
    }

    /// The states at (x, y) and at (y, x).
    #[inline]
    pub fn at_both(&self, place: [f64; 2]) -> [SubsurfaceState; 2] {
        let [x, y] = place;
        let mut states = [self.homogeneous_at(place), self.homogeneous_at([y, x])];
        self.visit(place, |weight, functions, [x, y]| {
            states[0] += L::state(functions, [x, y]) * weight;
            states[1] += L::state(functions, [y, x]) * weight;
        });
        states
    }

    /// The closed form's part of the state.
    #[inline]
    fn homogeneous_at(&self, [x, y]: [f64; 2]) -> SubsurfaceState {
        match &self.homogeneous {
            Some(of) if x * x + y * y + self.depth * self.depth < MIDDLE_FROM * MIDDLE_FROM => {
                let point = [x * of.side, y * of.side, of.depth];
                loaded_square(L::LOAD, &of.material, of.side, point)
            }
            _ => SubsurfaceState::default(),
        }
    }

    /// Calls `take` for the points of the element over which the rest of the state is summed, with their weights and
    /// functions and the place as seen from each. The points are symmetric about the diagonal.
    #[inline]
    fn visit(&self, [x, y]: [f64; 2], mut take: impl FnMut(f64, &[f64; F], [f64; 2])) {
        let radius_square = x * x + y * y;
        let square = radius_square + self.depth * self.depth;
        if square >= FAR_FROM * FAR_FROM {
            if let Some(far) = &self.far {
                take(1.0, &far.at(radius_square), [x, y]);
            }
        } else if square >= MIDDLE_FROM * MIDDLE_FROM {
            let Some(middle) = &self.middle else {
                return;
            };
            for [i, j] in [
                [POINT, POINT],
                [POINT, -POINT],
                [-POINT, POINT],
                [-POINT, -POINT],
            ] {
                let from = [x - i, y - j];
                take(
                    0.25,
                    &middle.at(from[0] * from[0] + from[1] * from[1]),
                    from,
                );
            }
        } else if let Some(near) = &self.near {
            let element = Cell {
                centre: [0.0; 2],
                half_side: 0.5,
            };
            let place = [x, y];
            element.visit(place, near.reach, &mut |weight, from| {
                take(
                    weight,
                    &near.panels.at(from[0] * from[0] + from[1] * from[1]),
                    from,
                );
            });
        }
    }
}

/// A square part of the element.
struct Cell {
    centre: [f64; 2],
    half_side: f64,
}

impl Cell {
    /// Calls `take` with the weights of a Gauss rule and the place as seen from its points, if kernels of this reach
    /// are smooth on the cell's scale; otherwise visits the cell's quarters.
    fn visit(&self, place: [f64; 2], reach: f64, take: &mut impl FnMut(f64, [f64; 2])) {
        let [x, y] = [0, 1].map(|axis: usize| place[axis] - self.centre[axis]);
        // The kernels are analytic for radii within i times their reach.
        let distance = x.hypot(y).hypot(reach) / self.half_side;
        let Some((_, line)) = RULES.iter().find(|(from, _)| distance >= *from) else {
            let half_side = self.half_side / 2.0;
            for [side_x, side_y] in [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]] {
                let centre = [
                    self.centre[0] + side_x * half_side,
                    self.centre[1] + side_y * half_side,
                ];
                Self { centre, half_side }.visit(place, reach, take);
            }
            return;
        };
        for one in line {
            for other in line {
                let from = [
                    x - self.half_side * one.position,
                    y - self.half_side * other.position,
                ];
                take(
                    self.half_side * self.half_side * one.weight * other.weight,
                    from,
                );
            }
        }
    }
}
