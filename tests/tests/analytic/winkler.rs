//! Springs alone: a film on an all but rigid body.

use pellicle_contact::{Load, reference};
use pellicle_kernel::Foundation;
use pellicle_tests::scene::{material, model, paraboloid, relative, solve};
use pellicle_texture::{Film, Relief};

#[test]
fn a_soft_film_on_an_all_but_rigid_body_is_a_winkler_foundation() {
    // Film compliance 0.01; the body gives way by less than 1e-9 of that.
    let foundation = Foundation::half_space(material(1e9, 0.3));
    let film = Relief::Film(Film::new(0.01, 1.0).expect("a film"));
    let winkler = reference::winkler::from_penetration(1.0, 0.01, 0.005);
    let load = Load::Penetration(winkler.penetration);
    let path = solve(&model(&foundation, film, paraboloid(1.0)), 0.25, 256, load);
    let step = &path.steps[0];
    for (found, [x, y]) in step.solution.pressure.iter().zip(path.grid.centres()) {
        let wanted = winkler.pressure(x.hypot(y));
        // The certificate's 1e-8, and the body.
        assert!(
            (found - wanted).abs() < 1e-7 * winkler.peak_pressure,
            "{found} {wanted}"
        );
    }
    // Sums over whole elements.
    assert!(relative(step.solution.force, winkler.force) < 1e-3);
    assert!(relative(step.summary.contact_area, winkler.contact_area) < 1e-2);
}
