//! Interior fields: Hooke's law and equilibrium at every depth, the interfaces, the surface, closed forms and limits.

#![allow(
    clippy::unwrap_used,
    reason = "helpers of tests are tests too; a failed unwrap is a failed test"
)]

use pellicle_kernel::{
    Amplitudes, Antiplane, Base, Foundation, InPlane, Interface, Interior, Layer, Material, Side,
};

fn material(young: f64, poisson: f64) -> Material {
    Material::new(young, poisson).unwrap()
}

fn layer(thickness: f64, young: f64, poisson: f64, interface: Interface) -> Layer {
    Layer::new(thickness, material(young, poisson), interface).unwrap()
}

fn spring(normal: f64, shear: f64) -> Interface {
    Interface::spring(normal, shear).unwrap()
}

fn foundations() -> Vec<Foundation> {
    use Interface::{Bonded, Frictionless};
    let stack = vec![
        layer(0.3, 20.0, 0.25, Bonded),
        layer(0.2, 0.1, 0.5, Frictionless),
        layer(1.0, 5.0, 0.0, Bonded),
    ];
    let imperfect = vec![
        layer(0.3, 20.0, 0.25, spring(0.03, 0.5)),
        layer(0.2, 0.1, 0.5, spring(2.0, f64::INFINITY)),
        layer(1.0, 5.0, 0.0, spring(0.0, 1e-3)),
    ];
    let film = |interface| vec![layer(1.0, 1e-3, 0.5, interface)];
    let half_space = Base::HalfSpace(material(1.0, 0.4));
    [
        (vec![], half_space),
        (film(Bonded), half_space),
        (film(spring(10.0, 0.0)), half_space),
        (film(Bonded), Base::Rigid),
        (film(Frictionless), Base::Rigid),
        (film(spring(0.0, 30.0)), Base::Rigid),
        (film(spring(30.0, 0.0)), Base::Rigid),
        (stack.clone(), half_space),
        (stack, Base::Rigid),
        (imperfect.clone(), half_space),
        (imperfect, Base::Rigid),
    ]
    .into_iter()
    .map(|(layers, base)| Foundation::new(layers, base).unwrap())
    .collect()
}

const WAVENUMBERS: [f64; 7] = [1e-6, 1e-2, 0.3, 1.0, 5.0, 30.0, 200.0];

/// Largest displacement times `2 G k` and stress: what the errors of one place are measured by.
fn size(place: &InPlane, unit: f64) -> f64 {
    let stresses =
        place.normal_stress.abs() + place.shear_stress.abs() + place.longitudinal_stress.abs();
    unit * (place.vertical_displacement.abs() + place.horizontal_displacement.abs()) + stresses
}

fn antiplane_size(place: &Antiplane) -> f64 {
    place.vertical_shear_stress.abs() + place.lateral_shear_stress.abs()
}

fn in_plane(place: &Amplitudes) -> [InPlane; 2] {
    [place.normal, place.shear]
}

#[test]
fn the_surface_carries_the_loads_and_moves_by_the_compliance() {
    for foundation in foundations() {
        for k in WAVENUMBERS {
            let surface = foundation.interior(k).unwrap().at(0.0, Side::Below);
            let moved = surface.normal.vertical_displacement / foundation.compliance(k) - 1.0;
            // The error of the elimination, a few tens of roundings.
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
fn what_pressure_moves_along_traction_lifts() {
    for foundation in foundations() {
        for k in WAVENUMBERS {
            let surface = foundation.interior(k).unwrap().at(0.0, Side::Below);
            let (along, lifted) = (
                surface.normal.horizontal_displacement,
                surface.shear.vertical_displacement,
            );
            let larger =
                surface.normal.vertical_displacement + surface.shear.horizontal_displacement;
            // Betti; the errors are those of the larger components.
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
fn interfaces_transmit_what_they_should() {
    for foundation in foundations() {
        for k in WAVENUMBERS {
            let interior = foundation.interior(k).unwrap();
            for (i, layer) in foundation.layers().iter().enumerate() {
                let below = body_below(&foundation, i);
                let softer = below.map_or(f64::INFINITY, |body| body.shear_modulus());
                let depth = foundation.interface_depth(i + 1);
                let sides = [Side::Above, Side::Below].map(|side| interior.at(depth, side));
                let meeting = Meeting {
                    interface: layer.interface(),
                    unit: 2.0 * k * softer.min(layer.material().shear_modulus()),
                    rigid: below.is_none(),
                };
                meeting.check(sides.map(|side| side.normal));
                meeting.check(sides.map(|side| side.shear));
                meeting.check_antiplane(sides.map(|side| side.antiplane));
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

/// An interface; a rigid body below has no tractions of its own to compare.
struct Meeting {
    interface: Interface,
    /// `2 G k` of the softer side, where a small error of traction is the larger displacement
    unit: f64,
    rigid: bool,
}

impl Meeting {
    fn check(&self, [above, below]: [InPlane; 2]) {
        // To 1e-13 of the state, the error of the eliminations above and below.
        let bound = 1e-13 * size(&above, self.unit);
        let (normal, shear) = self.jumps();
        let close =
            |difference: f64| assert!(difference.abs() <= bound, "{difference:e} {bound:e}");
        // 1 + c 2 G k: the error of the traction makes one of the displacement.
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
fn an_interface_has_two_sides() {
    let foundation = Foundation::coated(0.5, material(10.0, 0.3), material(1.0, 0.4)).unwrap();
    let interior = foundation.interior(2.0).unwrap();
    let stress = |depth, side| interior.at(depth, side).normal.longitudinal_stress;
    let (above, below) = (stress(0.5, Side::Above), stress(0.5, Side::Below));
    // 1e-9 of the thickness away, the stress is another by about as much; below it is a tenth as the modulus is.
    assert!((above - stress(0.5 * (1.0 - 1e-9), Side::Below)).abs() < 1e-7);
    assert!((below - stress(0.5 * (1.0 + 1e-9), Side::Above)).abs() < 1e-7);
    assert!((above - below).abs() > 0.1);
    assert_eq!(interior.at(0.0, Side::Above), interior.at(0.0, Side::Below));
}

#[test]
fn a_half_space_decays_as_in_the_textbook() {
    for nu in [0.0, 0.3, 0.5] {
        let body = material(2.0, nu);
        let unit = 2.0 * body.shear_modulus() * 3.0;
        let interior = Foundation::half_space(body).interior(3.0).unwrap();
        for t in [0.0_f64, 0.5, 3.0, 40.0, 600.0] {
            let decay = (-t).exp();
            let place = interior.at(t / 3.0, Side::Above);
            let check = |found: f64, wanted: f64| {
                // the roundings of t in e^{−t}, and a few
                let bound = 1e-15 * (2.0 + t) * (1.0 + t) * decay;
                assert!(
                    (found - wanted * decay).abs() <= bound,
                    "{found:e} {wanted:e}"
                );
            };
            let (b, w) = (1.0 - 2.0 * nu, 2.0 * (1.0 - nu));
            let normal = place.normal;
            check(unit * normal.horizontal_displacement, t - b);
            check(unit * normal.vertical_displacement, w + t);
            check(normal.longitudinal_stress, t - 1.0);
            check(normal.transverse_stress, -2.0 * nu);
            check(normal.normal_stress, -(1.0 + t));
            check(normal.shear_stress, -t);
            let shear = place.shear;
            check(unit * shear.horizontal_displacement, w - t);
            check(unit * shear.vertical_displacement, -(b + t));
            check(shear.longitudinal_stress, 2.0 - t);
            check(shear.transverse_stress, 2.0 * nu);
            check(shear.normal_stress, t);
            check(shear.shear_stress, t - 1.0);
            let antiplane = place.antiplane;
            check(unit * antiplane.displacement, 2.0);
            check(antiplane.vertical_shear_stress, -1.0);
            check(antiplane.lateral_shear_stress, 1.0);
        }
    }
}

fn numbers(place: &Amplitudes) -> [f64; 15] {
    let list = |state: &InPlane| {
        [
            state.horizontal_displacement,
            state.vertical_displacement,
            state.longitudinal_stress,
            state.transverse_stress,
            state.normal_stress,
            state.shear_stress,
        ]
    };
    let [normal, shear] = [list(&place.normal), list(&place.shear)];
    let Antiplane {
        displacement,
        vertical_shear_stress,
        lateral_shear_stress,
    } = place.antiplane;
    let antiplane = [displacement, vertical_shear_stress, lateral_shear_stress];
    std::array::from_fn(|i| match i {
        0..6 => normal[i],
        6..12 => shear[i - 6],
        _ => antiplane[i - 12],
    })
}

#[test]
fn the_homogeneous_body_and_the_correction_are_the_layered_body() {
    for foundation in foundations() {
        let homogeneous = Foundation::half_space(foundation.surface_material());
        for k in WAVENUMBERS {
            let (layered, plain) = (
                foundation.interior(k).unwrap(),
                homogeneous.interior(k).unwrap(),
            );
            let thickness = foundation.interface_depth(1).min(1.0);
            for part in [0.0, 0.3, 1.0] {
                let depth = part * thickness;
                let [whole, plain] =
                    [&layered, &plain].map(|of| numbers(&of.at(depth, Side::Above)));
                let correction = numbers(&layered.correction(depth).unwrap());
                for i in 0..15 {
                    // Displacements and stresses times 2 G k H are compared by the same loose size: the state's.
                    let unit = 2.0 * foundation.surface_material().shear_modulus() * k;
                    let scale = |list: &[f64]| {
                        let of = |i: usize, x: &f64| {
                            x.abs() * if IS_DISPLACEMENT[i] { unit } else { 1.0 }
                        };
                        list.iter()
                            .enumerate()
                            .fold(0.0, |size: f64, (i, x)| size.max(of(i, x)))
                    };
                    let size = scale(&whole) + scale(&plain);
                    let error = (plain[i] + correction[i] - whole[i]).abs()
                        * if IS_DISPLACEMENT[i] { unit } else { 1.0 };
                    // Both eliminations, and e^{−kz} of a rounded k z.
                    assert!(
                        error <= 1e-13 * size,
                        "{i} {error:e} {size:e} k = {k} {foundation:?}"
                    );
                }
            }
            assert_eq!(
                layered.correction(2.0 * thickness).is_none(),
                !foundation.layers().is_empty()
            );
        }
    }
}

/// Which of [`numbers`] are displacements.
const IS_DISPLACEMENT: [bool; 15] = [
    true, true, false, false, false, false, true, true, false, false, false, false, true, false,
    false,
];

#[test]
fn equal_layers_need_no_correction() {
    let body = material(3.0, 0.3);
    let layers = vec![layer(0.2, 3.0, 0.3, Interface::Bonded); 3];
    let foundation = Foundation::new(layers, Base::HalfSpace(body)).unwrap();
    for k in WAVENUMBERS {
        let interior = foundation.interior(k).unwrap();
        let correction = numbers(&interior.correction(0.1).unwrap());
        assert!(correction.iter().all(|x| x.abs() <= 0.0), "{correction:?}");
    }
}

/// The largest difference of the two bodies' states at `k = 1`, over the size of the second.
fn difference(found: &Foundation, wanted: &Foundation, depth: f64) -> f64 {
    let [found, wanted] =
        [found, wanted].map(|body| numbers(&body.interior(1.0).unwrap().at(depth, Side::Above)));
    let size = wanted.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    let largest = found
        .iter()
        .zip(&wanted)
        .fold(0.0_f64, |largest, (x, y)| largest.max((x - y).abs()));
    largest / size
}

#[test]
fn a_spring_leads_from_the_bond_to_the_frictionless_interface() {
    for base in [Base::HalfSpace(material(1.0, 0.4)), Base::Rigid] {
        let coated =
            |interface| Foundation::new(vec![layer(1.0, 3.0, 0.3, interface)], base).unwrap();
        let bonded = coated(Interface::Bonded);
        let sliding = coated(Interface::Frictionless);
        for depth in [0.0, 0.6, 1.0, 1.5] {
            if depth > 1.0 && base == Base::Rigid {
                continue;
            }
            for small in [1e-6, 1e-9] {
                // of first order in the compliance, whose units are 1/E here
                assert!(difference(&coated(spring(small, small)), &bonded, depth) < 10.0 * small);
                assert!(
                    difference(&coated(spring(0.0, 1.0 / small)), &sliding, depth) < 10.0 * small
                );
            }
        }
    }
}

#[test]
fn deep_waves_end_in_nothing_and_long_ones_in_the_base_alone() {
    for foundation in foundations() {
        for k in [700.0, 5e3, 1e9, 1e300] {
            let interior = foundation.interior(k).unwrap();
            for depth in [0.0, 0.1, 0.3, 1.0, 1.5, 1e3, f64::INFINITY] {
                let place = interior.at(depth, Side::Below);
                assert!(
                    numbers(&place).iter().all(|x| x.is_finite()),
                    "{k} {depth} {foundation:?}"
                );
                if let Some(correction) = interior.correction(depth) {
                    assert!(
                        numbers(&correction).iter().all(|x| x.is_finite()),
                        "{k} {depth}"
                    );
                }
            }
        }
        if let Base::HalfSpace(base) = foundation.base() {
            let (k, alone) = (1e-9, Foundation::half_space(base));
            let [found, wanted] = [&foundation, &alone].map(|body| {
                body.interior(k)
                    .unwrap()
                    .at(0.0, Side::Below)
                    .normal
                    .vertical_displacement
            });
            // The layers change k u by their thickness times k, with their compliance of up to 1e3.
            assert!((k * (found - wanted)).abs() < 1e-4, "{foundation:?}");
        }
    }
}

#[test]
fn a_wave_without_a_length_is_refused() {
    let half_space = Foundation::half_space(material(2.0, 0.3));
    for k in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(half_space.interior(k).is_err());
    }
}
