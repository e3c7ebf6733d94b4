//! Fields inside the body under loaded elements.

#![expect(
    clippy::unwrap_used,
    reason = "data and foundations that cannot be built fail their test"
)]

mod data;
mod interfaces;
mod planes;
mod points;

use pellicle_influence::SubsurfaceState;
use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};

const KEYS: [&str; 9] = ["ux", "uy", "uz", "sxx", "syy", "szz", "sxy", "sxz", "syz"];

fn nine(state: &SubsurfaceState) -> [f64; 9] {
    let mut values = [0.0; 9];
    values[..3].copy_from_slice(&state.displacement);
    values[3..].copy_from_slice(&state.stress);
    values
}

/// Stacks of thin and thick, stiff and soft, compressible and incompressible layers on elements of side 1.
fn stacks() -> Vec<Foundation> {
    let layer = |[thickness, modulus, ratio]: [f64; 3]| {
        Layer::new(
            thickness,
            Material::new(modulus, ratio).unwrap(),
            Interface::Bonded,
        )
        .unwrap()
    };
    let half_space = |modulus| Base::HalfSpace(Material::new(modulus, 0.3).unwrap());
    let stacks = [
        (vec![[0.01, 100.0, 0.2]], half_space(1.0)),
        (vec![[0.01, 0.01, 0.5]], half_space(1.0)),
        (vec![[30.0, 20.0, 0.1]], half_space(1.0)),
        (vec![[1.0, 1000.0, 0.25]], half_space(1.0)),
        (vec![[0.7, 1.0, 0.5]], Base::Rigid),
        (
            vec![[0.3, 5.0, 0.2], [0.05, 0.1, 0.4], [2.0, 30.0, 0.0]],
            half_space(1.0),
        ),
        (vec![[4.0, 0.02, 0.49], [0.2, 7.0, 0.3]], Base::Rigid),
    ];
    let foundation = |(layers, base): (Vec<[f64; 3]>, Base)| {
        Foundation::new(layers.into_iter().map(layer).collect(), base).unwrap()
    };
    stacks.into_iter().map(foundation).collect()
}
