//! The work in products with `K`, the first sign of a step that no longer helps.

use super::*;

/// Solves from a cold start and asserts the products of the solution and of its stiffness, as measured with a margin of
/// a tenth.
#[track_caller]
fn assert_work(mut problem: DiscreteProblem, load: Load, most: [usize; 2]) {
    let found = solve(&mut problem, load, &[0.0; SIZE * SIZE]);
    assert!(found.contact_stiffness.is_some());
    let found = [found.operator_applications, found.stiffness_applications];
    assert!(found[0] <= most[0] && found[1] <= most[1], "{found:?}");
}

#[test]
fn a_homogeneous_body_takes_few_products() {
    let body = || problem([1.0, 0.1], paraboloid, RIGID);
    assert_work(body(), Load::Force(2e-3), [20, 2]);
    assert_work(body(), Load::Penetration(0.01), [8, 2]);
}

#[test]
fn pillars_on_a_soft_coating_take_few_products() {
    let springs = |x: f64, y: f64| {
        if pillars(x, y, 1.0) < 0.6 { 0.02 } else { 0.0 }
    };
    let soft = problem([0.1, 0.02], |x, y| pillars(x, y, 0.004), springs);
    assert_work(soft, Load::Force(2e-3), [16, 3]);
}

#[test]
fn a_stiff_coating_under_a_film_takes_few_products() {
    let film = problem([10.0, 0.02], paraboloid, |_, _| 0.3);
    assert_work(film, Load::Force(2e-3), [14, 2]);
}

#[test]
fn a_stiff_coating_takes_few_products_bare_and_with_pillars() {
    let bare = problem([10.0, 0.05], paraboloid, RIGID);
    assert_work(bare, Load::Force(2e-3), [31, 2]);
    let islands = problem([10.0, 0.05], |x, y| pillars(x, y, 0.002), RIGID);
    assert_work(islands, Load::Force(2e-3), [23, 2]);
}

#[test]
fn a_thin_coating_a_thousand_times_as_stiff_takes_few_products() {
    let bare = problem([1000.0, 0.01], paraboloid, RIGID);
    assert_work(bare, Load::Force(1e-2), [41, 4]);
    let islands = || problem([1000.0, 0.01], |x, y| pillars(x, y, 0.002), RIGID);
    assert_work(islands(), Load::Force(1e-2), [25, 3]);
    assert_work(islands(), Load::Penetration(0.02), [15, 2]);
}

#[test]
fn the_contact_set_of_a_punch_is_known_from_the_start() {
    let flat = |x: f64, y: f64| if x.hypot(y) < 0.3 { 0.0 } else { f64::INFINITY };
    assert_work(
        problem([10.0, 0.05], flat, RIGID),
        Load::Force(1e-2),
        [7, 2],
    );
}
