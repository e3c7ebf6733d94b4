//! Negative control of the solver's side: a method of first order does not pass for one of second.

use pellicle_contact::{Load, reference};
use pellicle_tests::convergence::{GRIDS, Refusal, demand};
use pellicle_tests::scene::{model, paraboloid, penetration, relative, unit_half_space};
use pellicle_texture::Relief;

#[test]
fn a_penetration_off_by_a_part_of_an_element_is_seen_to_be_of_first_order() {
    let hertz = reference::hertz::from_contact_radius(1.0, 1.0, 0.1);
    let model = model(&unit_half_space(), Relief::Bare, paraboloid(1.0));
    let error = |elements| {
        let found = penetration(&model, 0.3, elements, Load::Force(hertz.force));
        // As if the tip were sampled a hundredth of an element too low.
        let spoilt = found * (1.0 + 0.01 * 3.0 / elements as f64);
        (elements, relative(spoilt, hertz.penetration))
    };
    let found = demand(&GRIDS.map(error), 1.7, 1e-5);
    assert!(matches!(found, Err(Refusal::Order { .. })), "{found:?}");
}
