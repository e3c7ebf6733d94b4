//! Forces and tractions in random stacks.

use pellicle_kernel::{Base, Foundation, Interface};
use pellicle_validation::stress::balance::{box_forces, random_stacks, traction_jumps};
use rayon::prelude::*;

#[test]
fn the_tractions_on_a_box_in_a_random_stack_balance_the_load() {
    let stacks = random_stacks(12).unwrap();
    stacks.par_iter().for_each(|body| {
        for ([wanted, found], error) in box_forces(body).unwrap() {
            // The quadrature error of the box in thick layers.
            assert!(error < 1e-8, "{body:?}: {wanted} {found:e}");
        }
    });
}

#[test]
fn tractions_are_continuous_across_every_interface_of_random_stacks() {
    let stacks = random_stacks(40).unwrap();
    let has = |interface: fn(Interface) -> bool| {
        let mut layers = stacks.iter().flat_map(Foundation::layers);
        layers.any(|layer| interface(layer.interface()))
    };
    assert!(has(|interface| interface.is_frictionless()));
    assert!(has(|interface| matches!(interface, Interface::Spring(_))));
    assert!(stacks.iter().any(|body| body.base() == Base::Rigid));
    let mut layers = stacks.iter().flat_map(Foundation::layers);
    assert!(layers.any(|layer| layer.material().poisson_ratio() >= 0.5));
    let jumps: Vec<_> = stacks
        .par_iter()
        .flat_map(|body| traction_jumps(body).unwrap())
        .collect();
    assert!(jumps.len() > 80, "{}", jumps.len());
    for ([above, below], error) in jumps {
        // The accuracy of the fields on both sides.
        assert!(error < 2e-11, "{above:e} {below:e}");
    }
}
