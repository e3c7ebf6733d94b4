//! Interior fields: Hooke's law and equilibrium at every depth, the interfaces, the surface, closed forms and limits.

#![allow(
    clippy::unwrap_used,
    reason = "helpers of tests are tests too; a failed unwrap is a failed test"
)]

mod laws;
mod limits;

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

/// Largest displacement times `2 G k` and stress: the scale of the errors at one place.
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
