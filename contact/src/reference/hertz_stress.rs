//! Stress below Hertz's contact with a half-space: under the pressure (M. T. Huber 1904) and under a traction that is
//! a multiple of it (G. M. Hamilton 1983), in closed form.
//!
//! Hertz's pressure is a sum of waves with the transform
//!
//! ```text
//! p̅(k) = p₀/2a ∫₀ᵃ (a² − t²) cos kt dt
//! ```
//!
//! and below the surface a wave causes fields that are polynomials in `kz` times `e^{−kz}`. Every field is therefore a
//! sum of the integrals `∫ p̅ k kⁿ e^{−kz} J_m(kr) dk`, which are real or imaginary parts of integrals over
//! `w = z + it` of
//!
//! ```text
//! j_m = ∫ e^{−kw} J_m(kr) dk = ((ρ − w)/r)ᵐ/ρ      ρ² = r² + w²
//! ```
//!
//! times powers of t: polynomials, roots and a logarithm. Hamilton's formulas are their real parts written out.

use num_complex::Complex64;
use pellicle_influence::SubsurfaceState;

use super::hertz::HertzContact;

/// The elastic constants of the half-space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace {
    /// G, Pa.
    pub shear_modulus: f64,
    /// ν.
    pub poisson_ratio: f64,
}

/// Displacements (m) and stresses (Pa) under Hertz's pressure at `point`, (x, y, z) from the centre of the contact
/// with z into the body, in m.
///
/// Exact to rounding on the axis, elsewhere to `1e-15 (a/r)³` of the largest pressure. On the rim of the contact, at
/// the surface, the stress is undefined.
///
/// ```
/// use pellicle_contact::reference::hertz;
/// use pellicle_contact::reference::hertz_stress::{HalfSpace, under_pressure};
///
/// let body = HalfSpace { shear_modulus: 1.0, poisson_ratio: 0.3 };
/// let contact = hertz::from_contact_radius(1.0, 2.0 / 0.7, 0.1);
/// let yielding = under_pressure(&contact, body, [0.0, 0.0, 0.0481]).von_mises();
/// // 0.620 of the largest pressure at 0.481 contact radii, to the digits given.
/// assert!((yielding / contact.peak_pressure - 0.620).abs() < 5e-4);
/// ```
#[must_use]
pub fn under_pressure(contact: &HertzContact, body: HalfSpace, point: [f64; 3]) -> SubsurfaceState {
    let place = CylindricalPoint::new(point);
    let waves = Waves::new(contact, &place);
    let (nu, z) = (body.poisson_ratio, place.z);
    let per_modulus = 0.5 / body.shear_modulus;
    // u_z: (2 (1 − ν) + kz)/2Gk, u_r: −(1 − 2ν − kz)/2Gk
    let sinking = 2.0 * (1.0 - nu) * waves.inverse(0) + z * waves.plain(0);
    let outward = z * waves.plain(1) - (1.0 - 2.0 * nu) * waves.inverse(1);
    // along the wave −(1 − kz), across it −2ν
    let along = |order| waves.times_depth(order) - waves.plain(order);
    let across = |order| -2.0 * nu * waves.plain(order);
    let mean = f64::midpoint(along(0), across(0));
    let half = f64::midpoint(along(2), -across(2));
    let shear = -waves.times_depth(1);
    let [cos, sin] = place.direction;
    let [cos_2, sin_2] = [cos * cos - sin * sin, 2.0 * sin * cos];
    SubsurfaceState {
        displacement: [
            per_modulus * outward * cos,
            per_modulus * outward * sin,
            per_modulus * sinking,
        ],
        stress: [
            mean - half * cos_2,
            mean + half * cos_2,
            -waves.plain(0) - waves.times_depth(0),
            -half * sin_2,
            shear * cos,
            shear * sin,
        ],
    }
}

/// Displacements (m) and stresses (Pa) under a traction equal to Hertz's pressure that drags the surface along +x, at
/// `point` (m); accuracy as for [`under_pressure`].
///
/// Under sliding with friction μ the stresses are those under the pressure and μ times these (Goodman's
/// approximation: the traction does not change the pressure, which is exact for ν = ½).
#[must_use]
pub fn under_traction(contact: &HertzContact, body: HalfSpace, point: [f64; 3]) -> SubsurfaceState {
    let place = CylindricalPoint::new(point);
    let waves = Waves::new(contact, &place);
    let (nu, z) = (body.poisson_ratio, place.z);
    let per_modulus = 0.5 / body.shear_modulus;
    // In the plane of the wave u: (2 (1 − ν) − kz)/2Gk, σ along it 2 − kz, across it 2ν, σ_zz kz, shear −(1 − kz);
    // out of that plane u: 2/2Gk, shear −1 and, of σ_xy, 1.
    let in_plane = |order| 2.0 * (1.0 - nu) * waves.inverse(order) - z * waves.plain(order);
    let sinking = (1.0 - 2.0 * nu) * waves.inverse(1) + z * waves.plain(1);
    let along = |order| 2.0 * waves.plain(order) - waves.times_depth(order);
    let across = |order| 2.0 * nu * waves.plain(order);
    let shear = |order| waves.times_depth(order) - waves.plain(order);
    let lateral = |order| waves.plain(order);
    let [mean, half] = [0, 2].map(|order| {
        let sign = if order == 0 { 1.0 } else { -1.0 };
        [
            per_modulus * 0.5 * (in_plane(order) + sign * 2.0 * waves.inverse(order)),
            0.5 * (shear(order) - sign * waves.plain(order)),
        ]
    });
    let [x, y, xy] = [
        0.75 * along(1) + 0.25 * across(1) + 0.5 * lateral(1),
        0.25 * along(1) + 0.75 * across(1) - 0.5 * lateral(1),
        0.25 * (along(1) - across(1)) + 0.5 * lateral(1),
    ];
    let third = 0.25 * (along(3) - across(3)) - 0.5 * lateral(3);
    let [cos, sin] = place.direction;
    let [cos_2, sin_2] = [cos * cos - sin * sin, 2.0 * sin * cos];
    let [cos_3, sin_3] = [cos * cos_2 - sin * sin_2, sin * cos_2 + cos * sin_2];
    SubsurfaceState {
        displacement: [
            mean[0] - half[0] * cos_2,
            -half[0] * sin_2,
            per_modulus * sinking * cos,
        ],
        stress: [
            -x * cos + third * cos_3,
            -y * cos - third * cos_3,
            -waves.times_depth(1) * cos,
            -xy * sin + third * sin_3,
            mean[1] - half[1] * cos_2,
            -half[1] * sin_2,
        ],
    }
}

/// A point in cylindrical coordinates.
struct CylindricalPoint {
    r: f64,
    z: f64,
    direction: [f64; 2],
}

impl CylindricalPoint {
    fn new([x, y, z]: [f64; 3]) -> Self {
        let r = x.hypot(y);
        let direction = if r > 0.0 { [x / r, y / r] } else { [1.0, 0.0] };
        Self { r, z, direction }
    }
}

/// `∫ p̅ k kⁿ e^{−kz} J_m(kr) dk` for n = −1, 0 and 1, the last times z, by the order m.
struct Waves([[f64; ORDERS]; 3]);

/// Orders of Bessel functions.
const ORDERS: usize = 4;

impl Waves {
    fn new(contact: &HertzContact, place: &CylindricalPoint) -> Self {
        let a = contact.contact_radius;
        let &CylindricalPoint { r, z, .. } = place;
        let (end, start) = (Complex64::new(z, a), Complex64::new(z, 0.0));
        let mut waves = Self([[0.0; ORDERS]; 3]);
        let orders = if r == 0.0 { 1 } else { ORDERS };
        for order in 0..orders {
            let transform = Transform { r, order };
            // ∫ wⁿ j_m dw
            let moment = |n| transform.moment(n, end) - transform.moment(n, start);
            let moments = [0, 1, 2].map(moment);
            let i = Complex64::I;
            // ∫ tⁿ j_m dt, t = (w − z)/i
            let t_0 = -i * moments[0];
            let t_1 = moments[0] * z - moments[1];
            let t_2 = i * (moments[2] - moments[1] * (2.0 * z) + moments[0] * (z * z));
            let factor = contact.peak_pressure;
            waves.0[0][order] = factor * (t_0 * (a * a) - t_2).re / (2.0 * a);
            waves.0[1][order] = -factor * t_1.im / a;
            if z > 0.0 {
                waves.0[2][order] = factor * z * (t_0 / a - transform.value(end)).re;
            }
        }
        waves
    }

    fn inverse(&self, order: usize) -> f64 {
        self.0[0][order]
    }

    fn plain(&self, order: usize) -> f64 {
        self.0[1][order]
    }

    fn times_depth(&self, order: usize) -> f64 {
        self.0[2][order]
    }
}

/// `j_m(w) = P(w) + Q(w)/ρ`.
struct Transform {
    r: f64,
    order: usize,
}

impl Transform {
    /// The coefficients of P and Q by power of w.
    fn polynomials(&self) -> [[f64; 4]; 2] {
        let r = self.r;
        match self.order {
            0 => [[0.0; 4], [1.0, 0.0, 0.0, 0.0]],
            1 => [[1.0 / r, 0.0, 0.0, 0.0], [0.0, -1.0 / r, 0.0, 0.0]],
            2 => {
                let over = 2.0 / (r * r);
                [[0.0, -over, 0.0, 0.0], [1.0, 0.0, over, 0.0]]
            }
            _ => {
                let over = 4.0 / r.powi(3);
                [[1.0 / r, 0.0, over, 0.0], [0.0, -3.0 / r, 0.0, -over]]
            }
        }
    }

    fn value(&self, w: Complex64) -> Complex64 {
        let [p, q] = self.polynomials();
        let at = |c: [f64; 4]| c.iter().rev().fold(Complex64::ZERO, |sum, c| sum * w + c);
        at(p) + at(q) / self.root(w)
    }

    /// ρ, the branch with a positive real part.
    fn root(&self, w: Complex64) -> Complex64 {
        (w * w + self.r * self.r).sqrt()
    }

    /// `∫ wⁿ j_m dw`.
    fn moment(&self, n: usize, w: Complex64) -> Complex64 {
        let [p, q] = self.polynomials();
        let over_root = self.over_root(w);
        let terms = p.iter().zip(q).enumerate().map(|(power, (p, q))| {
            let power = power + n;
            let whole = if *p == 0.0 {
                Complex64::ZERO
            } else {
                (1..=power).fold(w, |product, _| product * w) * (p / (power + 1) as f64)
            };
            if q == 0.0 {
                whole
            } else {
                whole + over_root[power] * q
            }
        });
        terms.sum()
    }

    /// `A_n = ∫ wⁿ/ρ dw`: `n A_n = wⁿ⁻¹ ρ − (n − 1) r² A_{n−2}`.
    fn over_root(&self, w: Complex64) -> [Complex64; 6] {
        let root = self.root(w);
        let mut integrals = [Complex64::ZERO; 6];
        // At the centre of the surface only the imaginary part counts, which is 0.
        let from_root = w + root;
        integrals[0] = if from_root == Complex64::ZERO {
            from_root
        } else {
            from_root.ln()
        };
        integrals[1] = root;
        let mut power = w;
        for n in 2..6 {
            let below = integrals[n - 2] * ((n - 1) as f64 * self.r * self.r);
            integrals[n] = (power * root - below) / n as f64;
            power *= w;
        }
        integrals
    }
}

#[cfg(test)]
mod tests;
