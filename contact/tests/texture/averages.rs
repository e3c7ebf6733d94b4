//! The largest pressure averaged over a disc.

use pellicle_contact::{ContactError, FlatPunch};

use super::*;

fn averaged(model: &Model, domain: Domain, elements: usize, load: Load, over: f64) -> Step {
    let options = SolverOptions {
        averaging_length: Some(over),
        ..SolverOptions::default()
    };
    let path = solve_path(model, domain, elements, &[load], &options, &mut ()).unwrap();
    path.steps[0].clone()
}

/// Under a ball, `p = p0 √(1 − r²/a²)` averages over a disc of radius c to `2/3 p0 (1 − (1 − c²/a²)^(3/2)) a²/c²`.
#[test]
fn the_average_under_a_ball_is_its_closed_form_to_second_order_within_its_error() {
    let force = 4.0 / 3.0 * 1e-3;
    // a = 0.1, p0 = 2a/π for R = 1 and E* = 1.
    let model = model(&body(), Relief::Bare, ball());
    // The disc of the whole contact includes its edge, where the pressure is no smooth function.
    for (part, bounds) in [
        (0.3_f64, [2e-4, 2e-5]),
        (0.8, [2e-4, 2e-5]),
        (1.0, [4e-3, 5e-4]),
    ] {
        let whole = (1.0 - part * part).powf(1.5);
        let wanted = 2.0 / 3.0 * 0.2 / PI * (1.0 - whole) / (part * part);
        let at = |elements| {
            let step = averaged(
                &model,
                Domain::Side(0.31),
                elements,
                Load::Force(force),
                0.2 * part,
            );
            let found = step.summary.max_averaged_pressure.unwrap();
            let error = step.grid_error.max_averaged_pressure.unwrap();
            let off = (found - wanted).abs();
            assert!(
                error.resolved && off <= error.estimate,
                "{part}, {elements}: {off:e} {error:?}"
            );
            off / wanted
        };
        let [coarse, fine] = [64, 256].map(at);
        assert!(
            coarse < bounds[0] && fine < bounds[1],
            "{part}: {coarse:e} {fine:e}"
        );
    }
}

#[test]
fn a_disc_wider_than_the_domain_has_the_force_over_its_area() {
    let force = 4.0 / 3.0 * 1e-3;
    let model = model(&body(), Relief::Bare, ball());
    for diameter in [0.5, 1.2, 1e4] {
        let (domain, load) = (Domain::Side(0.31), Load::Force(force));
        let step = averaged(&model, domain, 32, load, diameter);
        let wanted = force / (0.25 * PI * diameter * diameter);
        let found = step.summary.max_averaged_pressure.unwrap();
        // The force is met within the tolerance of the solution.
        assert!(
            (found / wanted - 1.0).abs() < 1e-6,
            "{diameter}: {found} {wanted}"
        );
    }
}

#[test]
fn the_average_over_a_sixteenth_of_an_edge_stays_bounded_under_a_flat_punch() {
    // Under a flat punch the peak grows with the grid, the average over a length does not.
    let model = model(&body(), Relief::Bare, FlatPunch::new(0.1).unwrap().into());
    let at = |elements| {
        let step = averaged(
            &model,
            Domain::Side(0.25),
            elements,
            Load::Force(1e-3),
            0.04,
        );
        [
            step.summary.max_pressure,
            step.summary.max_averaged_pressure.unwrap(),
        ]
    };
    let [coarse, fine] = [at(64), at(256)];
    assert!(fine[0] > 1.5 * coarse[0], "{coarse:?} {fine:?}");
    assert!(
        (fine[1] / coarse[1] - 1.0).abs() < 0.1,
        "{coarse:?} {fine:?}"
    );
}

#[test]
fn in_a_cell_the_disc_reaches_over_its_edges() {
    let sine = |offset| {
        Relief::Recesses(grooves(GrooveSpec {
            profile: GrooveProfile::Sine,
            width: 1.0,
            depth: 2e-3,
            period: 1.0,
            offset: [offset, 0.0],
            rotation: 0.0,
            edge_radius: 0.0,
        }))
    };
    // The crest in the middle, and on the edge of the cell.
    let load = Load::Force(5e-4);
    let [middle, edge] = [0.5, 0.0].map(|offset| {
        let model = model(&body(), sine(offset), Plane.into());
        let step = averaged(&model, Domain::Periodic(1.0), 32, load, 0.4);
        step.summary.max_averaged_pressure.unwrap()
    });
    assert!((middle / edge - 1.0).abs() < 1e-6, "{middle} {edge}");
    assert!(middle > 5e-4);
}

#[test]
fn a_disc_smaller_than_an_element_is_refused_and_none_is_asked_for_by_default() {
    let model = model(&body(), Relief::Bare, ball());
    let options = SolverOptions {
        averaging_length: Some(0.0099),
        ..SolverOptions::default()
    };
    let load = [Load::Force(1e-3)];
    let refused = solve_path(&model, Domain::Side(0.32), 32, &load, &options, &mut ());
    assert!(matches!(refused, Err(ContactError::AveragingLength { .. })));
    let step = solve(&model, Domain::Side(0.32), 32, load[0]);
    assert_eq!(step.summary.max_averaged_pressure, None);
    assert_eq!(step.grid_error.max_averaged_pressure, None);
}
