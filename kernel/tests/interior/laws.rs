//! Hooke's law and equilibrium at every depth, and the conditions on the surface and at the interfaces.

use super::*;

#[test]
fn the_surface_carries_the_loads_and_moves_by_the_compliance() {
    for foundation in foundations() {
        for k in WAVENUMBERS {
            let surface = foundation.interior(k).unwrap().at(0.0, Side::Below);
            let moved = surface.normal.vertical_displacement / foundation.compliance(k) - 1.0;
            // The error is that of the elimination, a few tens of roundings.
            assert!(moved.abs() < 2e-14, "{moved:e} k = {k} {foundation:?}");
            let unit = 2.0 * foundation.surface_material().shear_modulus() * k;
            let loads = [[0.0, -1.0], [-1.0, 0.0]];
            for (state, [shear, normal]) in in_plane(&surface).iter().zip(loads) {
                let bound = 2e-15 * size(state, unit);
                assert!((state.shear_stress - shear).abs() < bound, "k = {k}");
                assert!((state.normal_stress - normal).abs() < bound, "k = {k}");
            }
            // one division
            assert!((surface.antiplane.vertical_shear_stress + 1.0).abs() < 1e-15);
        }
    }
}

#[test]
fn horizontal_and_vertical_cross_displacements_are_reciprocal() {
    for foundation in foundations() {
        for k in WAVENUMBERS {
            let surface = foundation.interior(k).unwrap().at(0.0, Side::Below);
            let (along, lifted) = (
                surface.normal.horizontal_displacement,
                surface.shear.vertical_displacement,
            );
            let larger =
                surface.normal.vertical_displacement + surface.shear.horizontal_displacement;
            // Betti; the errors are relative to the larger components.
            assert!(
                (along - lifted).abs() < 1e-13 * larger,
                "k = {k} {foundation:?}"
            );
        }
    }
}

/// Central difference of fourth order of one amplitude with respect to `ζ = k z`.
fn slope(interior: &Interior, depth: f64, field: impl Fn(&Amplitudes) -> f64) -> f64 {
    let k = interior.wavenumber();
    let at = |steps: f64| field(&interior.at(depth + steps * STEP / k, Side::Below));
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
    check_in_plane(interior, depth, material, |place| place.normal);
    check_in_plane(interior, depth, material, |place| place.shear);
    let stiffness = material.shear_modulus() * interior.wavenumber();
    let place = interior.at(depth, Side::Below).antiplane;
    let residuals = [
        // σ_yz = G ∂u_y/∂z, σ_xy = G ∂u_y/∂x, ∂σ_xy/∂x + ∂σ_yz/∂z = 0
        slope(interior, depth, |place| place.antiplane.displacement) * stiffness
            - place.vertical_shear_stress,
        place.displacement * stiffness - place.lateral_shear_stress,
        slope(interior, depth, |place| {
            place.antiplane.vertical_shear_stress
        }) - place.lateral_shear_stress,
    ];
    for residual in residuals {
        // Truncation and rounding of the differences, see `STEP`.
        assert!(residual.abs() <= 1e-11 * antiplane_size(&place));
    }
}

fn check_in_plane(
    interior: &Interior,
    depth: f64,
    material: Material,
    load: fn(&Amplitudes) -> InPlane,
) {
    let k = interior.wavenumber();
    let (young, nu) = (material.young_modulus(), material.poisson_ratio());
    let place = load(&interior.at(depth, Side::Below));
    let (u, v) = (place.horizontal_displacement, place.vertical_displacement);
    let (xx, yy) = (place.longitudinal_stress, place.transverse_stress);
    let (zz, xz) = (place.normal_stress, place.shear_stress);
    let du = slope(interior, depth, |place| load(place).horizontal_displacement);
    let dv = slope(interior, depth, |place| load(place).vertical_displacement);
    let residuals = [
        // ∂σ_xx/∂x + ∂σ_xz/∂z = 0, ∂σ_xz/∂x + ∂σ_zz/∂z = 0
        slope(interior, depth, |place| load(place).shear_stress) - xx,
        slope(interior, depth, |place| load(place).normal_stress) + xz,
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
fn interfaces_transmit_tractions_and_displacements_by_their_kind() {
    for foundation in foundations() {
        for k in WAVENUMBERS {
            let interior = foundation.interior(k).unwrap();
            for (i, layer) in foundation.layers().iter().enumerate() {
                let below = body_below(&foundation, i);
                let softer = below.map_or(f64::INFINITY, |body| body.shear_modulus());
                let depth = foundation.interface_depth(i + 1);
                let sides = [Side::Above, Side::Below].map(|side| interior.at(depth, side));
                let joint = Joint {
                    interface: layer.interface(),
                    unit: 2.0 * k * softer.min(layer.material().shear_modulus()),
                    rigid: below.is_none(),
                };
                joint.check(sides.map(|side| side.normal));
                joint.check(sides.map(|side| side.shear));
                joint.check_antiplane(sides.map(|side| side.antiplane));
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

/// An interface; a rigid body below has no tractions to compare.
struct Joint {
    interface: Interface,
    /// `2 G k` of the softer side, where a small error of traction causes the larger displacement
    unit: f64,
    rigid: bool,
}

impl Joint {
    fn check(&self, [above, below]: [InPlane; 2]) {
        // To 1e-13 of the state, the error of the eliminations above and below.
        let bound = 1e-13 * size(&above, self.unit);
        let (normal, shear) = self.jumps();
        let close =
            |difference: f64| assert!(difference.abs() <= bound, "{difference:e} {bound:e}");
        // 1 + c 2 G k: the error of the traction causes one of the displacement.
        let opening = below.vertical_displacement - above.vertical_displacement;
        close(self.unit * (opening - normal * above.normal_stress) / (1.0 + normal * self.unit));
        let sliding = below.horizontal_displacement - above.horizontal_displacement;
        if self.interface.is_frictionless() {
            close(above.shear_stress);
            close(below.shear_stress);
        } else {
            close(self.unit * (sliding - shear * above.shear_stress) / (1.0 + shear * self.unit));
        }
        if !self.rigid {
            close(below.normal_stress - above.normal_stress);
            close(below.shear_stress - above.shear_stress);
        }
    }

    fn check_antiplane(&self, [above, below]: [Antiplane; 2]) {
        let bound = 1e-14 * (antiplane_size(&above) + self.unit * above.displacement);
        let (_, shear) = self.jumps();
        let close =
            |difference: f64| assert!(difference.abs() <= bound, "{difference:e} {bound:e}");
        if self.interface.is_frictionless() {
            close(above.vertical_shear_stress);
            close(below.vertical_shear_stress);
        } else {
            let sliding = below.displacement - above.displacement;
            close(self.unit * (sliding - shear * above.vertical_shear_stress));
        }
        if !self.rigid {
            close(below.vertical_shear_stress - above.vertical_shear_stress);
        }
    }

    fn jumps(&self) -> (f64, f64) {
        (
            self.interface.normal_compliance(),
            self.interface.shear_compliance(),
        )
    }
}

#[test]
fn stress_may_jump_at_an_interface() {
    let foundation = Foundation::coated(0.5, material(10.0, 0.3), material(1.0, 0.4)).unwrap();
    let interior = foundation.interior(2.0).unwrap();
    let stress = |depth, side| interior.at(depth, side).normal.longitudinal_stress;
    let (above, below) = (stress(0.5, Side::Above), stress(0.5, Side::Below));
    // 1e-9 of the thickness away, the stress changes by about as much; below, it is a tenth, like the modulus.
    assert!((above - stress(0.5 * (1.0 - 1e-9), Side::Below)).abs() < 1e-7);
    assert!((below - stress(0.5 * (1.0 + 1e-9), Side::Above)).abs() < 1e-7);
    assert!((above - below).abs() > 0.1);
    assert_eq!(interior.at(0.0, Side::Above), interior.at(0.0, Side::Below));
}
