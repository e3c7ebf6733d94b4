//! The smooth part of the fields around point loads at one depth: fifteen functions of the radius.
//!
//! A unit pressure on a point is the integral of all waves of pressure, `δ = (1/4π²) ∬ cos(k·x) d²k`, and each field
//! that of its waves with the [amplitudes](pellicle_kernel::Amplitudes) of a layered body. Over the directions of the
//! waves the integrals are Bessel functions. With `⟨A⟩_n = (1/2π) ∫ A J_n(k r) k dk`, polar coordinates r, φ and the
//! amplitudes of a pressure,
//!
//! ```text
//! u_z = ⟨V⟩_0     u_x = ⟨U⟩_1 cos φ     σ_zz = ⟨N⟩_0     σ_xz = ⟨T⟩_1 cos φ
//! σ_xx, σ_yy = ⟨½(L + Q)⟩_0 ∓ ⟨½(L − Q)⟩_2 cos 2φ     σ_xy = −⟨½(L − Q)⟩_2 sin 2φ
//! ```
//!
//! with L the stress along the wave vector and Q that across it. A traction along x is, on a wave at the angle θ to x,
//! `cos θ` along and `−sin θ` across it, so that with U, V, N, T, L, Q in plane and W, S, M antiplane
//!
//! ```text
//! u_x = ⟨½(U + W)⟩_0 − ⟨½(U − W)⟩_2 cos 2φ     u_y = −⟨½(U − W)⟩_2 sin 2φ     u_z = −⟨V⟩_1 cos φ
//! σ_xz = ⟨½(T + S)⟩_0 − ⟨½(T − S)⟩_2 cos 2φ    σ_yz = −⟨½(T − S)⟩_2 sin 2φ    σ_zz = −⟨N⟩_1 cos φ
//! σ_xx = −(X + Y) cos φ + Z cos 3φ     σ_yy = −(X − Y) cos φ − Z cos 3φ     σ_xy = −Y sin φ + Z sin 3φ
//! X = ⟨½(L + Q)⟩_1     Y = ⟨¼(L − Q) + ½M⟩_1     Z = ⟨¼(L − Q) − ½M⟩_3
//! ```

use std::f64::consts::TAU;

use pellicle_kernel::{Amplitudes, Foundation, KernelError};
use rayon::prelude::*;

use super::depth::Depth;
use super::log_lattice::{ENDS, EVERY_FROM, NODES, RADIUS_STRIDE, STEP};
use super::state::{SubsurfaceState, SurfaceLoad};
use crate::numerics::rounding::{ceil, floor};

/// Functions of the radius under a pressure, and under a traction.
const NORMAL: usize = 6;
const TANGENTIAL: usize = 9;

/// Functions of the radius.
const FUNCTIONS: usize = NORMAL + TANGENTIAL;

/// Order of the Bessel function of each.
const ORDER: [u8; FUNCTIONS] = [0, 1, 0, 1, 0, 2, 0, 2, 1, 1, 0, 2, 1, 1, 3];

/// Values of all functions at one radius, or of the amplitudes that they are made of at one wavenumber.
type Values = [f64; FUNCTIONS];

/// Below this part of the reach of the amplitudes in depth the functions are `r^n (c + c' r²)` to 1e-14.
const NEAREST: f64 = 1.0 / 3000.0;

/// Amplitudes have fallen to e^{−60} at this wavenumber over the reach's.
const DECAYED: f64 = 60.0;

/// Step of `ln r`.
const STRIDE: f64 = RADIUS_STRIDE as f64 * STEP;

/// Steps in which the radius doubles.
const DOUBLED: usize = 17;

/// Points of the interpolation over `ln r`: with steps of 0.04 it is right to 1e-13 for functions that are analytic
/// in r within i times the reach.
const STENCIL: usize = 10;

/// The functions, tabulated over the logarithm of the radius.
#[derive(Clone, Debug)]
pub struct PointKernels {
    normal: Table<NORMAL>,
    tangential: Table<TANGENTIAL>,
    /// Depth with which the amplitudes decay, m: `e^{−k reach}`.
    pub reach: f64,
}

impl PointKernels {
    /// The kernels at a depth, for radii up to `largest_radius` (m).
    ///
    /// Near the surface they are what the body has more than a half-space of the top layer's material; none for a
    /// half-space, which has nothing more.
    pub fn new(
        foundation: &Foundation,
        depth: Depth,
        largest_radius: f64,
    ) -> Result<Option<Self>, KernelError> {
        let Some(top) = foundation.layers().first() else {
            return Ok(None);
        };
        let thickness = top.thickness();
        let (is_split, z) = (depth.is_split(foundation), depth.z);
        let reach = if is_split { 2.0 * thickness - z } else { z };
        let first = (NEAREST * reach).ln();
        let steps = ((largest_radius.ln() - first) / STRIDE).max(0.0);
        let radii = ceil(steps) + 2 * STENCIL;
        // ln k = ln x − ln r, in steps from that of the first radius
        let shift = (RADIUS_STRIDE * (radii - 1)).cast_signed();
        let lowest = ENDS[0] - shift;
        let every_from = EVERY_FROM - shift;
        let highest = ((DECAYED / reach).ln() + first) / STEP;
        let count = floor(highest - lowest as f64);
        let amplitudes_at = |place: usize| -> Result<Values, KernelError> {
            let index = lowest + place.cast_signed();
            if index < every_from && index.rem_euclid(RADIUS_STRIDE.cast_signed()) != 0 {
                return Ok([0.0; FUNCTIONS]);
            }
            let interior = foundation.interior((index as f64 * STEP - first).exp())?;
            let amplitudes = if is_split {
                interior.correction(z)
            } else {
                Some(interior.at(z, depth.side))
            };
            Ok(amplitudes.map_or([0.0; FUNCTIONS], |amplitudes| combined(&amplitudes)))
        };
        let amplitudes = (0..count).into_par_iter().map(amplitudes_at);
        let amplitudes = amplitudes.collect::<Result<Vec<Values>, _>>()?;
        let at_radius = |i: usize| {
            let r = (first + i as f64 * STRIDE).exp();
            let below = lowest + (RADIUS_STRIDE * i).cast_signed();
            let mut sums = [0.0; FUNCTIONS];
            for node in NODES.iter() {
                let place = usize::try_from(node.index - below).ok();
                let Some(values) = place.and_then(|place| amplitudes.get(place)) else {
                    continue;
                };
                for ((sum, value), order) in sums.iter_mut().zip(values).zip(ORDER) {
                    *sum += node.weights[usize::from(order)] * value;
                }
            }
            sums.map(|sum| sum / (TAU * r * r))
        };
        let table: Vec<Values> = (0..radii).into_par_iter().map(at_radius).collect();
        Ok(Some(Self {
            normal: Table::new(first, &table, 0),
            tangential: Table::new(first, &table, NORMAL),
            reach,
        }))
    }

    /// The fields at (x, y) (m) from a unit force of this kind.
    pub fn at(&self, load: SurfaceLoad, [x, y]: [f64; 2]) -> SubsurfaceState {
        let r = x.hypot(y);
        let [cos, sin] = if r > 0.0 { [x / r, y / r] } else { [1.0, 0.0] };
        let [cos_2, sin_2] = [cos * cos - sin * sin, 2.0 * sin * cos];
        match load {
            SurfaceLoad::Pressure => {
                let [uz, ur, zz, rz, mean, half] = self.normal.values(r);
                SubsurfaceState {
                    displacement: [ur * cos, ur * sin, uz],
                    stress: [
                        mean - half * cos_2,
                        mean + half * cos_2,
                        zz,
                        -half * sin_2,
                        rz * cos,
                        rz * sin,
                    ],
                }
            }
            SurfaceLoad::Traction => {
                let [cos_3, sin_3] = [cos * cos_2 - sin * sin_2, sin * cos_2 + cos * sin_2];
                let [u0, u2, uz, zz, t0, t2, x, y, z] = self.tangential.values(r);
                SubsurfaceState {
                    displacement: [u0 - u2 * cos_2, -u2 * sin_2, -uz * cos],
                    stress: [
                        -(x + y) * cos + z * cos_3,
                        -(x - y) * cos - z * cos_3,
                        -zz * cos,
                        -y * sin + z * sin_3,
                        t0 - t2 * cos_2,
                        -t2 * sin_2,
                    ],
                }
            }
        }
    }
}

/// Some of the functions over the logarithm of the radius.
#[derive(Clone, Debug)]
struct Table<const F: usize> {
    /// ln r of the first entry.
    first: f64,
    entries: Vec<[f64; F]>,
    orders: [i32; F],
    /// `f/rⁿ` at r = 0 and its slope over r².
    at_axis: [[f64; F]; 2],
}

impl<const F: usize> Table<F> {
    /// The functions from index `from` on.
    fn new(first: f64, table: &[Values], from: usize) -> Self {
        let entries = table
            .iter()
            .map(|values| std::array::from_fn(|f| values[from + f]));
        let entries: Vec<[f64; F]> = entries.collect();
        let orders = std::array::from_fn(|f| ORDER[from + f].into());
        // `f/rⁿ` and its slope from the first entry and one at twice its radius
        let radii = [0, DOUBLED].map(|i| (first + i as f64 * STRIDE).exp());
        let mut at_axis = [[0.0; F]; 2];
        for f in 0..F {
            let over_power = |i: usize| entries[i * DOUBLED][f] / radii[i].powi(orders[f]);
            let [near, far] = [over_power(0), over_power(1)];
            let slope = (far - near) / (radii[1].powi(2) - radii[0].powi(2));
            (at_axis[0][f], at_axis[1][f]) = (near - slope * radii[0].powi(2), slope);
        }
        Self {
            first,
            entries,
            orders,
            at_axis,
        }
    }

    /// The functions at a radius (m).
    fn values(&self, r: f64) -> [f64; F] {
        let place = (r.ln() - self.first) / STRIDE;
        // In the middle of the stencil.
        let middle = (STENCIL / 2) as f64;
        if r == 0.0 || place < middle {
            let [value, slope] = &self.at_axis;
            return std::array::from_fn(|f| (value[f] + slope[f] * r * r) * r.powi(self.orders[f]));
        }
        let first = floor(place - middle + 1.0).min(self.entries.len() - STENCIL);
        let weights = lagrange_weights(place - first as f64);
        let mut sums = [0.0; F];
        for (values, weight) in self.entries[first..].iter().zip(weights) {
            for (sum, value) in sums.iter_mut().zip(values) {
                *sum += weight * value;
            }
        }
        sums
    }
}

/// The weights of the values at 0, 1, … in the polynomial through them at t.
fn lagrange_weights(t: f64) -> [f64; STENCIL] {
    let mut weights = [1.0; STENCIL];
    let mut product = 1.0;
    // w_j = Π_{m ≠ j} (t − m)/(j − m)
    for (j, weight) in weights.iter_mut().enumerate() {
        *weight = product / DENOMINATORS[j];
        product *= t - j as f64;
    }
    product = 1.0;
    for (j, weight) in weights.iter_mut().enumerate().rev() {
        *weight *= product;
        product *= t - j as f64;
    }
    weights
}

/// `Π_{m ≠ j} (j − m) = (−1)^(9−j) j! (9−j)!`
const DENOMINATORS: [f64; STENCIL] = [
    -362_880.0, 40_320.0, -10_080.0, 4_320.0, -2_880.0, 2_880.0, -4_320.0, 10_080.0, -40_320.0,
    362_880.0,
];

/// The amplitudes that the functions are transforms of, in the order of the module's formulas.
fn combined(amplitudes: &Amplitudes) -> Values {
    let (p, q, a) = (&amplitudes.normal, &amplitudes.shear, &amplitudes.antiplane);
    let mean = f64::midpoint;
    let difference = (q.longitudinal_stress - q.transverse_stress) / 4.0;
    let lateral = a.lateral_shear_stress / 2.0;
    [
        p.vertical_displacement,
        p.horizontal_displacement,
        p.normal_stress,
        p.shear_stress,
        mean(p.longitudinal_stress, p.transverse_stress),
        mean(p.longitudinal_stress, -p.transverse_stress),
        mean(q.horizontal_displacement, a.displacement),
        mean(q.horizontal_displacement, -a.displacement),
        q.vertical_displacement,
        q.normal_stress,
        mean(q.shear_stress, a.vertical_shear_stress),
        mean(q.shear_stress, -a.vertical_shear_stress),
        mean(q.longitudinal_stress, q.transverse_stress),
        difference + lateral,
        difference - lateral,
    ]
}
