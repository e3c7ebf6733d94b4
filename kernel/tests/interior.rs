//! Interior fields: Hooke's law and equilibrium at every depth, the interfaces, the surface.

#![allow(
    clippy::unwrap_used,
    reason = "helpers of tests are tests too; a failed unwrap is a failed test"
)]

use pellicle_kernel::{Amplitudes, Base, Foundation, Interface, Interior, Layer, Material};

fn material(young: f64, poisson: f64) -> Material {
    Material::new(young, poisson).unwrap()
}

fn layer(thickness: f64, young: f64, poisson: f64, interface: Interface) -> Layer {
    Layer::new(thickness, material(young, poisson), interface).unwrap()
}

fn foundations() -> Vec<Foundation> {
    use Interface::{Bonded, Frictionless};
    let stack = vec![
        layer(0.3, 20.0, 0.25, Bonded),
        layer(0.2, 0.1, 0.5, Frictionless),
        layer(1.0, 5.0, 0.0, Bonded),
    ];
    let film = |interface| vec![layer(1.0, 1e-3, 0.5, interface)];
    let half_space = Base::HalfSpace(material(1.0, 0.4));
    [
        (vec![], half_space),
        (film(Bonded), half_space),
        (film(Bonded), Base::Rigid),
        (film(Frictionless), Base::Rigid),
        (stack.clone(), half_space),
        (stack, Base::Rigid),
    ]
    .into_iter()
    .map(|(layers, base)| Foundation::new(layers, base).unwrap())
    .collect()
}

const WAVENUMBERS: [f64; 7] = [1e-6, 1e-2, 0.3, 1.0, 5.0, 30.0, 200.0];

/// Largest displacement times `2 G k` and stress: what the errors of one place are measured by.
fn size(place: &Amplitudes, unit: f64) -> f64 {
    let stresses =
        place.normal_stress.abs() + place.shear_stress.abs() + place.longitudinal_stress.abs();
    unit * (place.vertical_displacement.abs() + place.horizontal_displacement.abs()) + stresses
}

#[test]
fn the_surface_carries_the_pressure_and_moves_by_the_compliance() {
    for foundation in foundations() {
        for k in WAVENUMBERS {
            let surface = foundation.interior(k).unwrap().at(0.0);
            let moved = surface.vertical_displacement / foundation.compliance(k) - 1.0;
            // The error of the elimination, a few tens of roundings.
            assert!(moved.abs() < 2e-14, "{moved:e} k = {k} {foundation:?}");
            assert!((surface.normal_stress + 1.0).abs() < 2e-14, "k = {k}");
            let unit = 2.0 * foundation.surface_material().shear_modulus() * k;
            assert!(
                surface.shear_stress.abs() < 2e-15 * size(&surface, unit),
                "k = {k}"
            );
        }
    }
}

/// Central difference of fourth order of one amplitude with respect to `ζ = k z`.
fn slope(interior: &Interior, depth: f64, field: fn(&Amplitudes) -> f64) -> f64 {
    let k = interior.wavenumber();
    let at = |steps: f64| field(&interior.at(depth + steps * STEP / k));
    (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * STEP)
}

/// Difference step in `ζ`: the truncation, `STEP⁴/30` times a fifth derivative, about 5 times the
/// field, and the rounding, `1e-15/STEP`, are then both near 1e-12.
const STEP: f64 = 1.5e-3;

#[test]
fn every_depth_is_in_equilibrium_and_obeys_hooke() {
    for foundation in foundations() {
        for k in [0.3, 1.0, 5.0, 30.0] {
            let interior = foundation.interior(k).unwrap();
            let mut top = 0.0;
            for layer in foundation.layers() {
                for part in [0.21, 0.5, 0.83] {
                    let depth = top + part * layer.thickness();
                    check_place(&interior, depth, layer.material());
                }
                top += layer.thickness();
            }
            if let Base::HalfSpace(base) = foundation.base() {
                check_place(&interior, top + 0.7 / k, base);
            }
        }
    }
}

fn check_place(interior: &Interior, depth: f64, material: Material) {
    let k = interior.wavenumber();
    let (young, nu) = (material.young_modulus(), material.poisson_ratio());
    let place = interior.at(depth);
    let (u, v) = (place.horizontal_displacement, place.vertical_displacement);
    let (xx, yy) = (place.longitudinal_stress, place.transverse_stress);
    let (zz, xz) = (place.normal_stress, place.shear_stress);
    let du = slope(interior, depth, |place| place.horizontal_displacement);
    let dv = slope(interior, depth, |place| place.vertical_displacement);
    let residuals = [
        // ∂σ_xx/∂x + ∂σ_xz/∂z = 0, ∂σ_xz/∂x + ∂σ_zz/∂z = 0
        slope(interior, depth, |place| place.shear_stress) - xx,
        slope(interior, depth, |place| place.normal_stress) + xz,
        // E ε_xx = σ_xx − ν (σ_yy + σ_zz), and so on; σ_xz = G (∂u_x/∂z + ∂u_z/∂x)
        young * k * u - (xx - nu * (yy + zz)),
        yy - nu * (xx + zz),
        young * k * dv - (zz - nu * (xx + yy)),
        xz - material.shear_modulus() * k * (du - v),
    ];
    let size = size(&place, 2.0 * material.shear_modulus() * k);
    for (i, residual) in residuals.iter().enumerate() {
        // Truncation and rounding of the differences, see `STEP`.
        assert!(
            residual.abs() < 1e-11 * size,
            "{i}: {residual:e} of {size:e} at {depth}, k = {k}"
        );
    }
}

#[test]
fn interfaces_transmit_what_they_should() {
    for foundation in foundations() {
        for k in WAVENUMBERS {
            let interior = foundation.interior(k).unwrap();
            let mut depth = 0.0;
            for (i, layer) in foundation.layers().iter().enumerate() {
                depth += layer.thickness();
                let below = body_below(&foundation, i);
                let softer = below.map_or(f64::INFINITY, |body| body.shear_modulus());
                Meeting {
                    above: interior.at(depth),
                    below: interior.below_interface(i + 1).unwrap(),
                    unit: 2.0 * k * softer.min(layer.material().shear_modulus()),
                    rigid: below.is_none(),
                }
                .check(layer.interface());
            }
        }
    }
}

fn body_below(foundation: &Foundation, i: usize) -> Option<Material> {
    match (foundation.layers().get(i + 1), foundation.base()) {
        (Some(layer), _) => Some(layer.material()),
        (None, Base::HalfSpace(material)) => Some(material),
        (None, Base::Rigid) => None,
    }
}

/// Both sides of an interface; a rigid body below has no tractions of its own to compare.
struct Meeting {
    above: Amplitudes,
    below: Amplitudes,
    /// `2 G k` of the softer side, where a small error of traction is the larger displacement
    unit: f64,
    rigid: bool,
}

impl Meeting {
    fn check(&self, interface: Interface) {
        let (above, below) = (&self.above, &self.below);
        self.same_displacement(above.vertical_displacement, below.vertical_displacement);
        self.same_traction(above.normal_stress, below.normal_stress);
        match interface {
            Interface::Bonded => {
                let (a, b) = (above.horizontal_displacement, below.horizontal_displacement);
                self.same_displacement(a, b);
                self.same_traction(above.shear_stress, below.shear_stress);
            }
            Interface::Frictionless => {
                self.close(above.shear_stress);
                self.close(below.shear_stress);
            }
        }
    }

    /// To 1e-13 of the state, the error of the eliminations above and below.
    fn close(&self, difference: f64) {
        let size = size(&self.above, self.unit);
        assert!(
            difference.abs() <= 1e-13 * size,
            "{difference:e} of {size:e}"
        );
    }

    fn same_displacement(&self, above: f64, below: f64) {
        self.close(self.unit * (above - below));
    }

    fn same_traction(&self, above: f64, below: f64) {
        if !self.rigid {
            self.close(above - below);
        }
    }
}

#[test]
fn on_an_interface_the_state_is_that_of_the_upper_body() {
    let foundation = Foundation::coated(0.5, material(10.0, 0.3), material(1.0, 0.4)).unwrap();
    let interior = foundation.interior(2.0).unwrap();
    let stress = |depth: f64| interior.at(depth).longitudinal_stress;
    let below = interior.below_interface(1).unwrap().longitudinal_stress;
    // 1e-9 of the thickness above, the stress is another by about as much; below it is a tenth as the modulus is.
    assert!((stress(0.5) - stress(0.5 * (1.0 - 1e-9))).abs() < 1e-7);
    assert!((stress(0.5 * (1.0 + 1e-9)) - below).abs() < 1e-7);
    assert!((stress(0.5) - below).abs() > 0.1);
}

#[test]
fn a_half_space_decays_as_in_the_textbook() {
    let half_space = Foundation::half_space(material(2.0, 0.3));
    let interior = half_space.interior(1.0).unwrap();
    for z in [0.0_f64, 0.5, 3.0, 40.0] {
        let place = interior.at(z);
        // σ_zz = −(1 + kz) e^{−kz}, σ_xz = −kz e^{−kz}, σ_xx = −(1 − kz) e^{−kz}
        let decay = (-z).exp();
        let bound = 1e-15 * (1.0 + z) * decay;
        assert!((place.normal_stress + (1.0 + z) * decay).abs() <= 4.0 * bound);
        assert!((place.shear_stress + z * decay).abs() <= 4.0 * bound);
        assert!((place.longitudinal_stress + (1.0 - z) * decay).abs() <= 4.0 * bound);
    }
}

#[test]
fn a_wave_without_a_length_is_refused() {
    let half_space = Foundation::half_space(material(2.0, 0.3));
    for k in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(half_space.interior(k).is_err());
    }
}
