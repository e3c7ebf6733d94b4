//! The plane-strain problem: displacements along the wave vector and into the body.
//!
//! On the way up, the [minors](crate::response::Minors) give the support of every layer's bottom. On the way down, each
//! layer is then four equations: two components of the state on its top, and two for the support of its bottom. The
//! solution gives the state on the top of the next layer. No step amplifies an error, so amplitudes that have decayed
//! to `e^{−kz}` of the surface value keep their relative accuracy.

use super::InPlane;
use super::bottom::{rows, rows_of_half_space};
use super::crossing::{best_pair, cross};
use crate::material::Poisson;
use crate::response::{BottomSupport, Minors, Stack};
use crate::wave::{
    DepthFactors, LayerEquations, LayerWave, PlaceInLayer, SIGMA, TAU, TopPair, U, V, decayed,
    slope,
};
use crate::{Base, Foundation, KernelError, Layer, Material};
use nalgebra::Vector4;

/// Normal and shear load, in this order.
pub(super) type Pair<T> = [T; 2];

/// The waves of one body under both loads; the tractions of its states are in units of its `2 G k`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum InPlaneWave {
    /// `s = k H` and the waves.
    Layer { s: f64, waves: Pair<LayerWave> },
    /// The states on the top.
    HalfSpace(Pair<Vector4<f64>>),
    /// Nothing moves.
    Rigid,
}

impl InPlaneWave {
    /// Amplitudes under both loads in a body of this material.
    pub(super) fn at(
        &self,
        place: &PlaceInLayer,
        material: Material,
        wavenumber: f64,
    ) -> Pair<InPlane> {
        let poisson = Poisson::new(material);
        let unit = unit_traction(material, wavenumber);
        self.states(place)
            .map(|state| in_plane(&state, &poisson, unit))
    }

    fn states(&self, place: &PlaceInLayer) -> Pair<Vector4<f64>> {
        match self {
            Self::Layer { s, waves } => {
                let profile = DepthFactors::new(*s, place);
                waves.map(|wave| wave.at(&profile))
            }
            Self::HalfSpace(tops) => tops.map(|top| in_half_space(&top, place.below_top)),
            Self::Rigid => [Vector4::zeros(); 2],
        }
    }
}

/// All waves of a foundation.
pub(super) struct Waves {
    /// The waves of every body, surface first, the base last.
    pub(super) bodies: Vec<InPlaneWave>,
    /// The waves of the top layer minus those of a half-space of its material.
    pub(super) correction: InPlaneWave,
}

impl Waves {
    pub(super) fn new(foundation: &Foundation, wavenumber: f64) -> Result<Self, KernelError> {
        let surface = foundation.surface_material();
        let unit = unit_traction(surface, wavenumber);
        let tops = half_space_tops(&Poisson::new(surface)).map(|top| top / unit);
        if foundation.layers().is_empty() {
            return Ok(Self {
                bodies: vec![InPlaneWave::HalfSpace(tops)],
                correction: InPlaneWave::Rigid,
            });
        }
        let stack = Stack::new(foundation.layers(), foundation.base());
        let supports = stack.bottom_supports(wavenumber);
        let correction = correction(
            &foundation.layers()[0],
            wavenumber,
            &supports[0].0,
            tops,
            supports.len(),
        )?;
        let bodies = descend(foundation, wavenumber, &supports)?;
        Ok(Self { bodies, correction })
    }
}

/// Computes the waves of all bodies, from the surface down.
fn descend(
    foundation: &Foundation,
    wavenumber: f64,
    supports: &[(BottomSupport, Minors)],
) -> Result<Vec<InPlaneWave>, KernelError> {
    let layers = foundation.layers();
    let unit = unit_traction(foundation.surface_material(), wavenumber);
    let mut pair = TopPair::TRACTIONS;
    let mut tops = [
        Vector4::new(0.0, 0.0, 0.0, -1.0 / unit),
        Vector4::new(0.0, 0.0, -1.0 / unit, 0.0),
    ];
    let mut bodies = Vec::with_capacity(layers.len() + 1);
    for (i, (layer, (support, below))) in layers.iter().zip(supports).enumerate() {
        let s = wavenumber * layer.thickness();
        let poisson = Poisson::new(layer.material());
        let equations = LayerEquations::new(&poisson, s, pair, rows(&support.minors));
        let [first, second] = pair.0;
        let loads = tops.map(|top| Vector4::new(top[first], top[second], 0.0, 0.0));
        let waves = equations.solve(loads).ok_or(KernelError::Singular { s })?;
        bodies.push(InPlaneWave::Layer { s, waves });
        let bottom = DepthFactors::new(s, &PlaceInLayer::bottom(s));
        let mu = body_below(foundation, i).map_or(1.0, |below| {
            layer.material().shear_modulus() / below.shear_modulus()
        });
        tops = waves.map(|wave| in_units_below(cross(support, &wave.at(&bottom)), mu));
        pair = best_pair(below);
    }
    bodies.push(match foundation.base() {
        Base::HalfSpace(_) => InPlaneWave::HalfSpace(tops),
        Base::Rigid => InPlaneWave::Rigid,
    });
    Ok(bodies)
}

fn body_below(foundation: &Foundation, i: usize) -> Option<Material> {
    match (foundation.layers().get(i + 1), foundation.base()) {
        (Some(layer), _) => Some(layer.material()),
        (None, Base::HalfSpace(material)) => Some(material),
        (None, Base::Rigid) => None,
    }
}

fn in_units_below(state: Vector4<f64>, mu: f64) -> Vector4<f64> {
    Vector4::new(state[U], state[V], mu * state[TAU], mu * state[SIGMA])
}

/// The waves that the layers add to those of the homogeneous body inside the top layer: they have no tractions on the
/// surface, and on the bottom they supply the part missing from the homogeneous waves.
fn correction(
    layer: &Layer,
    wavenumber: f64,
    support: &BottomSupport,
    tops: Pair<Vector4<f64>>,
    layers: usize,
) -> Result<InPlaneWave, KernelError> {
    let s = wavenumber * layer.thickness();
    let poisson = Poisson::new(layer.material());
    let equations = LayerEquations::new(&poisson, s, TopPair::TRACTIONS, rows(&support.minors));
    let lacking = rows_of_half_space(support, &poisson, layers);
    let loads = tops.map(|top| {
        let bottom = in_half_space(&top, s);
        let [third, fourth] = lacking.map(|row| -(row * bottom)[0]);
        Vector4::new(0.0, 0.0, third, fourth)
    });
    let waves = equations.solve(loads).ok_or(KernelError::Singular { s })?;
    Ok(InPlaneWave::Layer { s, waves })
}

/// The states on a half-space under unit pressure and unit traction, tractions in `2 G k`.
fn half_space_tops(&Poisson { b, w, .. }: &Poisson) -> Pair<Vector4<f64>> {
    [
        Vector4::new(-b, w, 0.0, -1.0),
        Vector4::new(w, -b, -1.0, 0.0),
    ]
}

/// `e^{−ζ} [1 + ζ (A + 1)] v` for the state `v` on the top of a half-space.
fn in_half_space(top: &Vector4<f64>, zeta: f64) -> Vector4<f64> {
    let [decay, sloped] = decayed(zeta);
    top * decay + slope(top[TAU] - top[SIGMA]) * sloped
}

/// `2 G k`, Pa/m
fn unit_traction(material: Material, wavenumber: f64) -> f64 {
    2.0 * material.shear_modulus() * wavenumber
}

fn in_plane(state: &Vector4<f64>, poisson: &Poisson, unit: f64) -> InPlane {
    let &Poisson { nu, x, .. } = poisson;
    // σ_xx = [U + ν σ_zz] / (1 − ν) in 2 G k; 1/(1 − ν) = 2x
    let longitudinal = 2.0 * x * (state[U] + nu * state[SIGMA]);
    InPlane {
        horizontal_displacement: state[U],
        vertical_displacement: state[V],
        longitudinal_stress: unit * longitudinal,
        // plane strain across the wave: σ_yy = ν (σ_xx + σ_zz)
        transverse_stress: unit * nu * (longitudinal + state[SIGMA]),
        normal_stress: unit * state[SIGMA],
        shear_stress: unit * state[TAU],
    }
}
