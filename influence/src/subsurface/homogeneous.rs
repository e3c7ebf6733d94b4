//! A uniformly loaded square on a homogeneous half-space, in closed form.
//!
//! Under a pressure: A. E. H. Love (1929), as [`crate::love`]. Under a traction: the potentials of Cerruti in the form
//! of K. L. Johnson, *Contact Mechanics* (1985), section 3.2, integrated over the square in the same way.
//!
//! With `V = ∬ dA/r`, `Λ = ∬ ln(r + z) dA` and `F = ∬ (z ln(r + z) − r) dA`, the displacements and
//! stresses under a pressure are
//!
//! ```text
//! 4πG u_x = −z V_x − (1−2ν) Λ_x             4πG u_z = 2 (1−ν) V − z V_z
//! 2π σ_xx = 2ν V_z − z V_xx − (1−2ν) Λ_xx   2π σ_xy = −(1−2ν) Λ_xy − z V_xy
//! 2π σ_zz = V_z − z V_zz                    2π σ_xz = −z V_xz
//! ```
//!
//! and those under a traction along x, with `ψ = Λ_x`, are
//!
//! ```text
//! 4πG u_x = 2 V + 2ν F_xx − z ψ_x     4πG u_y = 2ν F_xy − z ψ_y     4πG u_z = (1−2ν) ψ − z ψ_z
//! 2π σ_xx = 2 (1+ν) ψ_z + 2ν F_xxx − z ψ_xx       2π σ_yy = 2ν ψ_z + 2ν F_xyy − z ψ_yy
//! 2π σ_xy = V_y + 2ν F_xxy − z ψ_xy               2π σ_zz = −z ψ_zz
//! 2π σ_xz = V_z − z ψ_xz                          2π σ_yz = −z ψ_yz
//! ```
//!
//! Each integral over the square is a function of the place seen from a corner, summed over the corners with
//! signs. Terms that depend only on x or only on y cancel in that sum and are left out, which saves the
//! digits that they would cost.

use std::f64::consts::PI;

use pellicle_kernel::Material;

use super::state::{SubsurfaceState, SurfaceLoad};

/// The state at `point` (x, y from the centre of the square, depth; m) for a unit load on a square of side
/// `element_side` (m).
///
/// Some fields are unbounded at the square's outline on the surface itself; there they are returned as ±∞ or NaN.
pub fn loaded_square(
    load: SurfaceLoad,
    material: &Material,
    element_side: f64,
    point: [f64; 3],
) -> SubsurfaceState {
    let half_side = element_side / 2.0;
    let place = point.map(|along| along / half_side);
    let mut sum = SubsurfaceState::default();
    for (sign_x, sign_y) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        let corner = Corner::new([place[0] + sign_x, place[1] + sign_y, place[2]]);
        let state = match load {
            SurfaceLoad::Pressure => corner.under_pressure(material.poisson_ratio()),
            SurfaceLoad::Traction => corner.under_traction(material.poisson_ratio()),
        };
        sum += state * (sign_x * sign_y);
    }
    let per_displacement = half_side / (4.0 * PI * material.shear_modulus());
    SubsurfaceState {
        displacement: sum.displacement.map(|u| u * per_displacement),
        stress: sum.stress.map(|stress| stress / (2.0 * PI)),
    }
}

/// `σ_xx`, `σ_yy` and `σ_xy` on the surface, under a pressure and under a traction along x, at (x, y) and at (y, x)
/// seen from a corner of a loaded quadrant. Summed over the corners of a square with signs, these are its stresses;
/// lengths are in any unit.
pub fn surface_corners(poisson_ratio: f64, [x, y]: [f64; 2]) -> [[[f64; 3]; 2]; 2] {
    let corner = Corner::new([x, y, 0.0]);
    let exchanged = corner.exchanged();
    [corner, exchanged].map(|corner| {
        let loads = [
            corner.under_pressure(poisson_ratio),
            corner.under_traction(poisson_ratio),
        ];
        loads.map(|state| {
            let [xx, yy, _, xy, _, _] = state.stress;
            [xx, yy, xy].map(|stress| stress / (2.0 * PI))
        })
    })
}

/// The derivatives of the potentials at a place seen from a corner.
struct Corner {
    x: f64,
    y: f64,
    z: f64,
    r: f64,
    /// `V_x` and `ψ_z`.
    v_x: f64,
    v_y: f64,
    v_z: f64,
    /// `Λ_xx` and `ψ_x`, without a term that cancels.
    lambda_xx: f64,
    lambda_yy: f64,
    /// `Λ_xy`.
    ln: f64,
    /// 1/(x² + z²), 1/(y² + z²); 0 where z/(x² + z²) has the limit 0.
    over_xz: f64,
    over_yz: f64,
}

impl Corner {
    /// The place with x and y exchanged.
    fn exchanged(&self) -> Self {
        Self {
            x: self.y,
            y: self.x,
            v_x: self.v_y,
            v_y: self.v_x,
            lambda_xx: self.lambda_yy,
            lambda_yy: self.lambda_xx,
            over_xz: self.over_yz,
            over_yz: self.over_xz,
            ..*self
        }
    }

    fn new([x, y, z]: [f64; 3]) -> Self {
        let r = (x * x + y * y + z * z).sqrt();
        let (xz, yz) = ((x * x + z * z).sqrt(), (y * y + z * z).sqrt());
        let v_z = -(x * y).atan2(z * r);
        // atan(y/x) − atan(y z/(x r)) = atan(x y (r − z)/(x² r + y² z)), r − z = (x² + y²)/(r + z)
        let from_z = (x * x + y * y) / (r + z);
        let lambda_xx = (x * y * from_z).atan2(x * x * r + y * y * z);
        let inverse_square = |c: f64| if c == 0.0 { 0.0 } else { 1.0 / (c * c) };
        Self {
            x,
            y,
            z,
            r,
            v_x: logarithm(y, xz, r),
            v_y: logarithm(x, yz, r),
            v_z,
            lambda_xx,
            // Λ_xx + Λ_yy = −V_z
            lambda_yy: -v_z - lambda_xx,
            ln: (r + z).ln(),
            over_xz: inverse_square(xz),
            over_yz: inverse_square(yz),
        }
    }

    /// `V = x V_x + y V_y + z V_z`, homogeneous of degree 1.
    fn v(&self) -> f64 {
        times(self.x, self.v_x) + times(self.y, self.v_y) + self.z * self.v_z
    }

    /// `Λ_x = y ln(r + z) + z V_x + x Λ_xx`.
    fn lambda_x(&self) -> f64 {
        times(self.y, self.ln) + times(self.z, self.v_x) + self.x * self.lambda_xx
    }

    fn lambda_y(&self) -> f64 {
        times(self.x, self.ln) + times(self.z, self.v_y) + self.y * self.lambda_yy
    }

    fn under_pressure(&self, nu: f64) -> SubsurfaceState {
        let &Self {
            x,
            y,
            z,
            r,
            v_x,
            v_y,
            v_z,
            ..
        } = self;
        let (over_xz, over_yz) = (self.over_xz, self.over_yz);
        let compressible = 1.0 - 2.0 * nu;
        // V_xx = −x y/(r (x² + z²)), V_xy = 1/r, V_xz = −y z/(r (x² + z²)),
        // V_zz = x y (r² + z²)/(r (x² + z²) (y² + z²))
        let z_v_xx = -over(z * x * y * over_xz, r);
        let z_v_yy = -over(z * x * y * over_yz, r);
        let z_v_zz = -z_v_xx - z_v_yy;
        SubsurfaceState {
            displacement: [
                -times(z, v_x) - compressible * self.lambda_x(),
                -times(z, v_y) - compressible * self.lambda_y(),
                2.0 * (1.0 - nu) * self.v() - z * v_z,
            ],
            stress: [
                2.0 * nu * v_z - z_v_xx - compressible * self.lambda_xx,
                2.0 * nu * v_z - z_v_yy - compressible * self.lambda_yy,
                v_z - z_v_zz,
                -times(compressible, self.ln) - over(z, r),
                over(z * z * y * over_xz, r),
                over(z * z * x * over_yz, r),
            ],
        }
    }

    fn under_traction(&self, nu: f64) -> SubsurfaceState {
        let &Self {
            x,
            y,
            z,
            r,
            v_x,
            v_y,
            v_z,
            over_xz,
            ..
        } = self;
        let depth = r + z;
        // F_xx = −x V_x + z Λ_xx, F_xy = z ln(r + z) − r
        let f_xx = -times(x, v_x) + z * self.lambda_xx;
        let f_xy = times(z, self.ln) - r;
        // F_xxx = −V_x + y/(r + z), F_xxy = −x/(r + z), F_xyy = −y/(r + z)
        let [over_x, over_y] = [over(x, depth), over(y, depth)];
        // ψ_xx = y (z r − x²)/(r (r + z) (x² + z²)), ψ_xy = x/(r (r + z)), ψ_yy = y/(r (r + z))
        let z_psi_xx = over(z * over_y * (z * r - x * x) * over_xz, r);
        let [z_psi_xy, z_psi_yy] = [over(z * over_x, r), over(z * over_y, r)];
        SubsurfaceState {
            displacement: [
                2.0 * self.v() + 2.0 * nu * f_xx - z * self.lambda_xx,
                2.0 * nu * f_xy - times(z, self.ln),
                (1.0 - 2.0 * nu) * self.lambda_x() - times(z, v_x),
            ],
            stress: [
                2.0 * v_x + 2.0 * nu * over_y - z_psi_xx,
                2.0 * nu * v_x - 2.0 * nu * over_y - z_psi_yy,
                // ψ_zz = −y z/(r (x² + z²)), ψ_xz = −x y/(r (x² + z²)), ψ_yz = 1/r
                over(z * z * y * over_xz, r),
                v_y - 2.0 * nu * over_x - z_psi_xy,
                v_z + over(z * x * y * over_xz, r),
                -over(z, r),
            ],
        }
    }
}

/// `asinh(a/c)` with `r² = a² + c²`, which is `ln(r + a)` minus a part that does not depend on `a`.
fn logarithm(a: f64, c: f64, r: f64) -> f64 {
    if a == 0.0 {
        0.0
    } else {
        ((r + a.abs()) / c).ln().copysign(a)
    }
}

/// `factor · value` with 0 for a factor of 0, whatever the value: the limit of `x ln x`.
fn times(factor: f64, value: f64) -> f64 {
    if factor == 0.0 { 0.0 } else { factor * value }
}

/// `value/divisor` with 0 for a value of 0.
fn over(value: f64, divisor: f64) -> f64 {
    if value == 0.0 { 0.0 } else { value / divisor }
}
