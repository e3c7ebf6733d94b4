//! Displacements and stresses at depth, for one wavenumber.

mod antiplane;
mod bottom;
mod crossing;
mod in_plane;
mod state;

pub use state::{Amplitudes, Antiplane, InPlane, Side};

use crate::wave::PlaceInLayer;
use crate::{Base, Foundation, KernelError, Layer, Material};

/// The interior of a foundation under waves of one wavenumber on its surface: a pressure, a traction along the wave
/// vector, a traction across it. Phases and signs: [`Amplitudes`].
///
/// ```
/// use pellicle_kernel::{Foundation, Material, Side};
///
/// let foundation = Foundation::coated(1e-6, Material::new(300e9, 0.2)?, Material::new(210e9, 0.3)?)?;
/// let interior = foundation.interior(2e6)?;
/// let surface = interior.at(0.0, Side::Below);
/// // The surface moves by the compliance; elimination against closed form.
/// let moved = surface.normal.vertical_displacement;
/// assert!((moved / foundation.compliance(2e6) - 1.0).abs() < 1e-14);
/// // Betti: the traction lifts the surface by what the pressure moves it along.
/// let lifted = surface.shear.vertical_displacement;
/// assert!((lifted / surface.normal.horizontal_displacement - 1.0).abs() < 1e-13);
/// # Ok::<(), pellicle_kernel::KernelError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Interior {
    wavenumber: f64,
    bodies: Vec<Body>,
    correction: in_plane::InPlaneWave,
}

/// One layer or the base.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Body {
    top: f64,
    bottom: f64,
    material: Material,
    in_plane: in_plane::InPlaneWave,
    antiplane: antiplane::AntiplaneWave,
}

impl Foundation {
    /// Displacements and stresses at every depth under waves of wavenumber `k` (1/m).
    ///
    /// The work grows with the number of layers; that of [`Interior::at`] hardly depends on it.
    ///
    /// Accuracy: 1e-13 of the larger components of the state (displacements times `2 G k`, stresses) at every depth,
    /// plus `2e-15 k z` from the rounding of `e^{−kz}` (`tests/interior_reference.rs`, `tests/dense.rs`). Below a
    /// frictionless interface, where a long wave of traction leaves stresses of the order of `k H`, their error is
    /// 1e-16 of the traction. Amplitudes that have decayed below the smallest number are 0.
    ///
    /// `k = 0` is refused; small `k` are as accurate as any other. For `k → 0` displacements grow like `1/k` on a
    /// half-space, where `k u` has the limit of the base alone; on a rigid base they have finite limits. Layers above a
    /// frictionless interface are not held along the surface: under the tractions, their `u_x` and `u_y` grow like
    /// `1/k²` and their `σ_xx` and `σ_xy` like `1/k`.
    ///
    /// # Errors
    ///
    /// [`KernelError::Wavenumber`] if `k` is not positive and finite; [`KernelError::Singular`] if the
    /// equations of a layer have no solution in floating point.
    pub fn interior(&self, wavenumber: f64) -> Result<Interior, KernelError> {
        if !(wavenumber.is_finite() && wavenumber > 0.0) {
            return Err(KernelError::Wavenumber { found: wavenumber });
        }
        let in_plane::Waves { bodies, correction } = in_plane::Waves::new(self, wavenumber)?;
        let antiplane = antiplane::AntiplaneWave::of(self.layers(), self.base(), wavenumber);
        let mut bottom = 0.0;
        let body = |(i, (in_plane, antiplane))| {
            let top = bottom;
            // The same sums as in `interface_depth`.
            bottom += self.layers().get(i).map_or(f64::INFINITY, Layer::thickness);
            Body {
                top,
                bottom,
                material: self.material_of(i),
                in_plane,
                antiplane,
            }
        };
        Ok(Interior {
            wavenumber,
            bodies: (bodies.into_iter().zip(antiplane).enumerate())
                .map(body)
                .collect(),
            correction,
        })
    }

    /// The material of layer `i`, or of the base; for a rigid base, where nothing moves, any material.
    fn material_of(&self, i: usize) -> Material {
        match (self.layers().get(i), self.base()) {
            (Some(layer), _) => layer.material(),
            (None, Base::HalfSpace(material)) => material,
            (None, Base::Rigid) => self.surface_material(),
        }
    }
}

impl Interior {
    /// The wavenumber `k`, 1/m.
    #[must_use]
    pub fn wavenumber(&self) -> f64 {
        self.wavenumber
    }

    /// Amplitudes at `depth` (m, from the surface).
    ///
    /// On an interface, which lies exactly at [`Foundation::interface_depth`], they are those on the requested `side`;
    /// elsewhere the side does not matter. Above the surface they equal those on it; inside a rigid base they are zero.
    #[must_use]
    pub fn at(&self, depth: f64, side: Side) -> Amplitudes {
        // The last body has no bottom.
        let index = match side {
            Side::Above => self.bodies.partition_point(|body| body.bottom < depth),
            Side::Below => self.bodies.partition_point(|body| body.bottom <= depth),
        };
        let last = self.bodies.len() - 1;
        self.bodies[index.min(last)].at(depth, self.wavenumber)
    }

    /// The amplitudes in the top layer minus those in a half-space of its material, computed without cancellation: of
    /// the order of `e^{−k (2H − z)}` where the amplitudes are of the order of `e^{−kz}`.
    ///
    /// Zero for a half-space; `None` below the top layer, where the amplitudes themselves have decayed by `e^{−kH}`.
    /// The homogeneous amplitudes are `Foundation::half_space(foundation.surface_material()).interior(k)`.
    ///
    /// Accuracy: 3e-13 of the larger components of the difference, times `1 + 2kH` with the top layer's thickness `H`,
    /// since `e^{−2kH}` magnifies roundings (`tests/interior_reference.rs`); where reflections from several interfaces
    /// cancel, a rounding of the largest.
    #[must_use]
    pub fn correction(&self, depth: f64) -> Option<Amplitudes> {
        let body = &self.bodies[0];
        let place = body.place(depth, self.wavenumber)?;
        let [normal, shear] = self.correction.at(&place, body.material, self.wavenumber);
        let antiplane = body.antiplane;
        Some(Amplitudes {
            normal,
            shear,
            antiplane: antiplane.correction(&place, body.stiffness(self.wavenumber)),
        })
    }
}

impl Body {
    fn at(&self, depth: f64, wavenumber: f64) -> Amplitudes {
        let place = self.clamped(depth, wavenumber);
        let [normal, shear] = self.in_plane.at(&place, self.material, wavenumber);
        Amplitudes {
            normal,
            shear,
            antiplane: self.antiplane.at(&place, self.stiffness(wavenumber)),
        }
    }

    /// `G k`
    fn stiffness(&self, wavenumber: f64) -> f64 {
        self.material.shear_modulus() * wavenumber
    }

    /// The place at `depth`; `None` below the body.
    fn place(&self, depth: f64, wavenumber: f64) -> Option<PlaceInLayer> {
        (depth <= self.bottom).then(|| self.clamped(depth, wavenumber))
    }

    fn clamped(&self, depth: f64, wavenumber: f64) -> PlaceInLayer {
        let depth = depth.clamp(self.top, self.bottom);
        PlaceInLayer {
            below_top: wavenumber * (depth - self.top),
            above_bottom: wavenumber * (self.bottom - depth),
        }
    }
}
