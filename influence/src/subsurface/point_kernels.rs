//! The fields around point loads at one depth, from fifteen functions of the radius.
//!
//! A unit pressure on a point is the integral of all waves of pressure, `δ = (1/4π²) ∬ cos(k·x) d²k`, and each field is
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

//!
//! The functions are stored divided by `rⁿ`, with the order n of their Bessel function, so that cosines of `n φ` become
//! polynomials in x and y: `rⁿ cos n φ = Re (x + i y)ⁿ`.

use pellicle_kernel::Amplitudes;

use super::state::{SubsurfaceState, SurfaceLoad};

/// Functions of the radius under a pressure, and under a traction.
pub const NORMAL: usize = 6;
pub const TANGENTIAL: usize = 9;
/// The same without displacements.
pub const NORMAL_STRESSES: usize = 4;
pub const TANGENTIAL_STRESSES: usize = 6;

/// A point load, whose fields consist of `F` functions of the radius.
pub trait PointLoad<const F: usize>: Sync {
    /// The load on the surface.
    const LOAD: SurfaceLoad;

    /// Order of the Bessel function of each function.
    const ORDERS: [usize; F];

    /// The amplitudes whose transforms are the functions, in the order of the module's formulas.
    fn combined(amplitudes: &Amplitudes) -> [f64; F];

    /// The fields at (x, y) from the functions divided by `rⁿ`.
    fn state(functions: &[f64; F], place: [f64; 2]) -> SubsurfaceState;
}

/// A pressure.
#[derive(Clone, Copy, Debug)]
pub struct Pressure;

/// The stresses under a pressure.
#[derive(Clone, Copy, Debug)]
pub struct PressureStresses;

impl PointLoad<NORMAL> for Pressure {
    const LOAD: SurfaceLoad = SurfaceLoad::Pressure;

    const ORDERS: [usize; NORMAL] = [0, 1, 0, 1, 0, 2];

    fn combined(amplitudes: &Amplitudes) -> [f64; NORMAL] {
        let p = &amplitudes.normal;
        let [zz, rz, mean, half] = PressureStresses::combined(amplitudes);
        [
            p.vertical_displacement,
            p.horizontal_displacement,
            zz,
            rz,
            mean,
            half,
        ]
    }

    #[inline]
    fn state(functions: &[f64; NORMAL], [x, y]: [f64; 2]) -> SubsurfaceState {
        let &[uz, ur, zz, rz, mean, half] = functions;
        SubsurfaceState {
            displacement: [ur * x, ur * y, uz],
            ..PressureStresses::state(&[zz, rz, mean, half], [x, y])
        }
    }
}

impl PointLoad<NORMAL_STRESSES> for PressureStresses {
    const LOAD: SurfaceLoad = SurfaceLoad::Pressure;

    const ORDERS: [usize; NORMAL_STRESSES] = [0, 1, 0, 2];

    fn combined(Amplitudes { normal: p, .. }: &Amplitudes) -> [f64; NORMAL_STRESSES] {
        let mean = f64::midpoint;
        [
            p.normal_stress,
            p.shear_stress,
            mean(p.longitudinal_stress, p.transverse_stress),
            mean(p.longitudinal_stress, -p.transverse_stress),
        ]
    }

    #[inline]
    fn state(functions: &[f64; NORMAL_STRESSES], [x, y]: [f64; 2]) -> SubsurfaceState {
        let &[zz, rz, mean, half] = functions;
        let [cos_2, sin_2] = [x * x - y * y, 2.0 * x * y];
        SubsurfaceState {
            displacement: [0.0; 3],
            stress: [
                mean - half * cos_2,
                mean + half * cos_2,
                zz,
                -half * sin_2,
                rz * x,
                rz * y,
            ],
        }
    }
}

/// A traction along x.
#[derive(Clone, Copy, Debug)]
pub struct Traction;

/// The stresses under a traction along x.
#[derive(Clone, Copy, Debug)]
pub struct TractionStresses;

impl PointLoad<TANGENTIAL> for Traction {
    const LOAD: SurfaceLoad = SurfaceLoad::Traction;

    const ORDERS: [usize; TANGENTIAL] = [0, 2, 1, 1, 0, 2, 1, 1, 3];

    fn combined(amplitudes: &Amplitudes) -> [f64; TANGENTIAL] {
        let (q, a) = (&amplitudes.shear, &amplitudes.antiplane);
        let mean = f64::midpoint;
        let [zz, t0, t2, big_x, big_y, big_z] = TractionStresses::combined(amplitudes);
        [
            mean(q.horizontal_displacement, a.displacement),
            mean(q.horizontal_displacement, -a.displacement),
            q.vertical_displacement,
            zz,
            t0,
            t2,
            big_x,
            big_y,
            big_z,
        ]
    }

    #[inline]
    fn state(functions: &[f64; TANGENTIAL], [x, y]: [f64; 2]) -> SubsurfaceState {
        let &[u0, u2, uz, zz, t0, t2, big_x, big_y, big_z] = functions;
        let [cos_2, sin_2] = [x * x - y * y, 2.0 * x * y];
        SubsurfaceState {
            displacement: [u0 - u2 * cos_2, -u2 * sin_2, -uz * x],
            ..TractionStresses::state(&[zz, t0, t2, big_x, big_y, big_z], [x, y])
        }
    }
}

impl PointLoad<TANGENTIAL_STRESSES> for TractionStresses {
    const LOAD: SurfaceLoad = SurfaceLoad::Traction;

    const ORDERS: [usize; TANGENTIAL_STRESSES] = [1, 0, 2, 1, 1, 3];

    fn combined(amplitudes: &Amplitudes) -> [f64; TANGENTIAL_STRESSES] {
        let (q, a) = (&amplitudes.shear, &amplitudes.antiplane);
        let mean = f64::midpoint;
        let difference = (q.longitudinal_stress - q.transverse_stress) / 4.0;
        let lateral = a.lateral_shear_stress / 2.0;
        [
            q.normal_stress,
            mean(q.shear_stress, a.vertical_shear_stress),
            mean(q.shear_stress, -a.vertical_shear_stress),
            mean(q.longitudinal_stress, q.transverse_stress),
            difference + lateral,
            difference - lateral,
        ]
    }

    #[inline]
    fn state(functions: &[f64; TANGENTIAL_STRESSES], [x, y]: [f64; 2]) -> SubsurfaceState {
        let &[zz, t0, t2, big_x, big_y, big_z] = functions;
        let [cos_2, sin_2] = [x * x - y * y, 2.0 * x * y];
        let [cos_3, sin_3] = [x * cos_2 - y * sin_2, y * cos_2 + x * sin_2];
        SubsurfaceState {
            displacement: [0.0; 3],
            stress: [
                -(big_x + big_y) * x + big_z * cos_3,
                -(big_x - big_y) * x - big_z * cos_3,
                -zz * x,
                -big_y * y + big_z * sin_3,
                t0 - t2 * cos_2,
                -t2 * sin_2,
            ],
        }
    }
}
