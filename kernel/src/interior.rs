//! Displacements and stresses at depth, for one wavenumber.
//!
//! Upward, the [minors](crate::response::minors) say how every layer's bottom is held. Downward, each
//! layer is then four equations: the tractions on its top, and two that say how its bottom is held;
//! its solution gives the tractions on the top of the next. No step amplifies an error, so what has
//! decayed to `e^{−kz}` of the surface's value keeps its relative accuracy.

use crate::response::{Minors, Poisson, Stack};
use crate::wave::{LayerEquations, LayerWave, SIGMA, TAU, U, V, decaying};
use crate::{Base, Foundation, Interface, KernelError, Layer, Material};
use nalgebra::{RowVector4, Vector2, Vector4};

/// Amplitudes of one wave at one depth, per unit amplitude of the pressure on the surface.
///
/// For the pressure `p = p̅ cos kx` (Pa) the fields are
///
/// ```text
/// u_x = U sin kx    u_z = V cos kx     (m)    z, and so u_z, into the body
/// σ_xx, σ_yy, σ_zz ∝ cos kx   σ_xz ∝ sin kx   (Pa)   tension positive
/// ```
///
/// with the amplitudes below times `p̅`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Amplitudes {
    /// `U`, m/Pa, along the wave vector.
    pub horizontal_displacement: f64,
    /// `V`, m/Pa, into the body; on the surface the compliance `C(k)`.
    pub vertical_displacement: f64,
    /// `σ_xx`, along the wave vector, per unit pressure.
    pub longitudinal_stress: f64,
    /// `σ_yy`, across the wave vector, per unit pressure.
    pub transverse_stress: f64,
    /// `σ_zz`, per unit pressure; −1 on the surface.
    pub normal_stress: f64,
    /// `σ_xz`, per unit pressure; 0 on the surface.
    pub shear_stress: f64,
}

/// The interior of a foundation under a pressure wave of one wavenumber.
///
/// ```
/// use pellicle_kernel::{Foundation, Material};
///
/// let foundation = Foundation::coated(1e-6, Material::new(300e9, 0.2)?, Material::new(210e9, 0.3)?)?;
/// let interior = foundation.interior(2e6)?;
/// let surface = interior.at(0.0);
/// // The surface moves by the compliance; elimination against closed form.
/// assert!((surface.vertical_displacement / foundation.compliance(2e6) - 1.0).abs() < 1e-14);
/// assert!((surface.normal_stress + 1.0).abs() < 1e-14);
/// # Ok::<(), pellicle_kernel::KernelError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Interior {
    wavenumber: f64,
    bodies: Vec<Body>,
}

/// One layer or the half-space at the bottom.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Body {
    top: f64,
    bottom: f64,
    material: Material,
    wave: Wave,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Wave {
    Layer(LayerWave),
    /// Displacements `(U, V)` on the top of a half-space.
    HalfSpace([f64; 2]),
    Rigid,
}

impl Foundation {
    /// Displacements and stresses at every depth under a pressure wave of wavenumber `k` (1/m).
    ///
    /// Accuracy: a few 1e-14, relative to the state's larger components, at every depth
    /// (`tests/interior.rs`: equilibrium, Hooke's law, interfaces, surface).
    ///
    /// # Errors
    ///
    /// [`KernelError::Wavenumber`] if `k` is not positive and finite; [`KernelError::Singular`] if the
    /// equations of a layer have no solution in floating point.
    pub fn interior(&self, wavenumber: f64) -> Result<Interior, KernelError> {
        if !(wavenumber.is_finite() && wavenumber > 0.0) {
            return Err(KernelError::Wavenumber { found: wavenumber });
        }
        let mut descent = Descent::new(wavenumber);
        let mut bodies = Vec::with_capacity(self.layers().len() + 1);
        for (layer, minors) in self.layers().iter().zip(held_bottoms(self, wavenumber)) {
            bodies.push(descent.layer(layer, &minors)?);
        }
        bodies.push(descent.base(self.base(), self.surface_material()));
        Ok(Interior { wavenumber, bodies })
    }
}

/// How the bottom of every layer is held, surface first.
fn held_bottoms(foundation: &Foundation, wavenumber: f64) -> Vec<Minors> {
    if foundation.layers().is_empty() {
        return Vec::new();
    }
    Stack::new(foundation.layers(), foundation.base()).held_bottoms(wavenumber)
}

impl Interior {
    /// The wavenumber `k`, 1/m.
    #[must_use]
    pub fn wavenumber(&self) -> f64 {
        self.wavenumber
    }

    /// Amplitudes at `depth` (m, from the surface). On an interface they are those of the upper body;
    /// above the surface those on it; inside a rigid base all are zero.
    #[must_use]
    pub fn at(&self, depth: f64) -> Amplitudes {
        // The last body has no bottom.
        let index = self.bodies.partition_point(|body| body.bottom < depth);
        self.bodies[index].at(depth, self.wavenumber)
    }

    /// Amplitudes directly below interface `index` (0 is the surface), `None` beyond the last: what
    /// jumps there can be compared with [`at`](Self::at).
    #[must_use]
    pub fn below_interface(&self, index: usize) -> Option<Amplitudes> {
        let body = self.bodies.get(index)?;
        Some(body.at(body.top, self.wavenumber))
    }
}

impl Body {
    fn at(&self, depth: f64, wavenumber: f64) -> Amplitudes {
        let poisson = Poisson::new(self.material);
        let within = depth.clamp(self.top, self.bottom) - self.top;
        let zeta = wavenumber * within;
        let state = match self.wave {
            Wave::Layer(wave) => wave.at(zeta),
            Wave::HalfSpace([u, v]) => {
                // The two waves have displacement a on the top.
                decaying(&poisson, zeta) * Vector2::new(u, v) / poisson.a
            }
            Wave::Rigid => Vector4::zeros(),
        };
        amplitudes(&state, &poisson, unit_traction(self.material, wavenumber))
    }
}

/// `2 G k`, Pa/m
fn unit_traction(material: Material, wavenumber: f64) -> f64 {
    2.0 * material.shear_modulus() * wavenumber
}

fn amplitudes(state: &Vector4<f64>, poisson: &Poisson, unit: f64) -> Amplitudes {
    let &Poisson { nu, x, .. } = poisson;
    // σ_xx = [U + ν σ_zz] / (1 − ν) in 2 G k; 1/(1 − ν) = 2x
    let longitudinal = 2.0 * x * (state[U] + nu * state[SIGMA]);
    Amplitudes {
        horizontal_displacement: state[U],
        vertical_displacement: state[V],
        longitudinal_stress: unit * longitudinal,
        // plane strain across the wave: σ_yy = ν (σ_xx + σ_zz)
        transverse_stress: unit * nu * (longitudinal + state[SIGMA]),
        normal_stress: unit * state[SIGMA],
        shear_stress: unit * state[TAU],
    }
}

/// Tractions `(σ_xz, σ_zz)` per unit pressure on the way down.
struct Descent {
    wavenumber: f64,
    depth: f64,
    tractions: [f64; 2],
}

impl Descent {
    fn new(wavenumber: f64) -> Self {
        Self {
            wavenumber,
            depth: 0.0,
            tractions: [0.0, -1.0],
        }
    }

    fn layer(&mut self, layer: &Layer, held: &Minors) -> Result<Body, KernelError> {
        let (material, top) = (layer.material(), self.depth);
        let s = self.wavenumber * layer.thickness();
        let unit = unit_traction(material, self.wavenumber);
        let tractions = self.tractions.map(|traction| traction / unit);
        let equations = LayerEquations::new(&Poisson::new(material), s, tractions, rows(held));
        let wave = equations.solve().ok_or(KernelError::Singular { s })?;
        let state = wave.at(s);
        self.tractions = match layer.interface() {
            Interface::Bonded => [unit * state[TAU], unit * state[SIGMA]],
            Interface::Frictionless => [0.0, unit * state[SIGMA]],
        };
        self.depth += layer.thickness();
        Ok(Body {
            top,
            bottom: self.depth,
            material,
            wave: Wave::Layer(wave),
        })
    }

    fn base(&self, base: Base, placeholder: Material) -> Body {
        let (material, wave) = match base {
            Base::HalfSpace(material) => (material, Wave::HalfSpace(self.pushed(material))),
            Base::Rigid => (placeholder, Wave::Rigid),
        };
        Body {
            top: self.depth,
            bottom: f64::INFINITY,
            material,
            wave,
        }
    }

    /// Displacements of a half-space's surface: `d U = q σ − f τ`, `d V = q τ − g σ`, `d = 1`.
    fn pushed(&self, material: Material) -> [f64; 2] {
        let unit = unit_traction(material, self.wavenumber);
        let [tau, sigma] = self.tractions.map(|traction| traction / unit);
        let Poisson { b, w, .. } = Poisson::new(material);
        [b * sigma - w * tau, b * tau - w * sigma]
    }
}

/// Two equations `row · v = 0` for the states that `minors` allow.
///
/// In general `f V + p σ + q U = 0` and `f τ + d U − q σ = 0`; `f = 0` only on a rigid body that holds
/// both displacements.
fn rows(minors: &Minors) -> [RowVector4<f64>; 2] {
    let &Minors { p, q, f, d, .. } = minors;
    if f == 0.0 {
        return [
            RowVector4::new(1.0, 0.0, 0.0, 0.0),
            RowVector4::new(0.0, 1.0, 0.0, 0.0),
        ];
    }
    let sizes = [f.max(p).max(q.abs()), f.max(d).max(q.abs())];
    [
        RowVector4::new(q, f, 0.0, p) / sizes[0],
        RowVector4::new(d, 0.0, f, -q) / sizes[1],
    ]
}
