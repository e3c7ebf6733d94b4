//! Critical loads compared with closed forms and with new solutions.

use super::*;

fn critical(model: &Model, elements: usize, force: f64, stress: &StressModel) -> Vec<CriticalLoad> {
    let path = solved(model, elements, force);
    let options = SolverOptions::default();
    let extremes = [stress_extremes(&path, 0, stress).unwrap()];
    critical_loads(
        model,
        &path,
        &extremes,
        Domain::Automatic,
        &options,
        stress,
        &mut (),
    )
    .unwrap()
}

#[test]
fn a_homogeneous_body_yields_at_the_force_of_hertz() {
    let yield_strength = 0.03;
    let stress = whole(BodyStrengths {
        yield_strength: Some(yield_strength),
        tensile_strength: None,
    });
    let model = model(&half_space(), Paraboloid::new(1.0).unwrap());
    // p0³ = 6 Q E*²/(π³ R²)
    let plane_modulus = STEEL.0 / (1.0 - STEEL.1 * STEEL.1);
    let peak = yield_strength / on_the_axis()[0];
    let exact = (std::f64::consts::PI * peak).powi(3) / (6.0 * plane_modulus.powi(2));
    // The search starts from above, and from far above.
    for force in [1.7 * exact, 90.0 * exact] {
        let found = critical(&model, 128, force, &stress);
        let [
            CriticalLoad {
                criterion: Criterion::Yield,
                force: Some(found),
                estimate: Some(estimate),
                resolved: true,
                ..
            },
        ] = found[..]
        else {
            panic!("{found:?}")
        };
        assert!(
            (found - exact).abs() < estimate + 1e-4 * exact,
            "{found} ± {estimate}, {exact}"
        );
        assert!(estimate < 2e-3 * exact, "{estimate}");
    }
    let below = critical(&model, 64, 0.9 * exact, &stress);
    assert_eq!(below[0].force, None);
    // Q^⅓
    assert_relative_eq!(below[0].utilisation, 0.9_f64.cbrt(), max_relative = 1e-3);
}

#[test]
fn each_strength_of_a_coated_body_is_reached_under_its_own_critical_load() {
    let thickness = 0.02;
    let mut stress = sliding_coating(thickness);
    stress.bodies[1].strengths.yield_strength = Some(0.03);
    stress.interfaces[0].strengths.shear_strength = Some(0.02);
    let model = model(&coated(thickness), Paraboloid::new(1.0).unwrap());
    let found = critical(&model, 64, 1e-3, &stress);
    assert_eq!(found.len(), 2);
    for (index, load) in found.iter().enumerate() {
        let extremes =
            stress_extremes(&solved(&model, 64, load.force.unwrap()), 0, &stress).unwrap();
        let utilisation = if index == 0 {
            extremes.bodies[1].utilisation.yielding
        } else {
            extremes.interfaces[0].utilisation.shear
        };
        // Another domain and another grid: the bound is the discretisation error, not the accuracy of the search.
        assert_relative_eq!(utilisation.unwrap(), 1.0, max_relative = 2e-3);
    }
}

#[test]
fn a_stress_that_falls_again_under_more_load_is_critical_where_it_first_reaches_its_strength() {
    // A thin stiff coating takes the shape of the indenter and bends no further.
    let thickness = 0.02;
    let coating = Material::new(10.0, 0.3).unwrap();
    let base = Material::new(STEEL.0, STEEL.1).unwrap();
    let model = model(
        &Foundation::coated(thickness, coating, base).unwrap(),
        Paraboloid::new(1.0).unwrap(),
    );
    let stress = |yield_strength| StressModel {
        bodies: vec![body(
            "layer[0]",
            0.0,
            thickness,
            BodyStrengths {
                yield_strength,
                tensile_strength: None,
            },
        )],
        ..StressModel::default()
    };
    let mises = |force: f64| {
        let extremes = stress_extremes(&solved(&model, 128, force), 0, &stress(None)).unwrap();
        extremes.bodies[0].max_von_mises.unwrap().value
    };
    let [early, peak, late] = [3.5e-4, 5e-4, 1.5e-3].map(mises);
    assert!(early < peak && late < 0.98 * early, "{early} {peak} {late}");
    for strength in [early, 0.5 * (early + peak)] {
        let found = critical(&model, 128, 1.5e-3, &stress(Some(strength)));
        let force = found[0].force.unwrap();
        assert!((3.4e-4..5e-4).contains(&force), "{found:?}");
        assert_relative_eq!(mises(force), strength, max_relative = 1e-3);
    }
}

#[test]
fn a_critical_load_does_not_depend_on_the_load_from_which_its_search_starts() {
    // A stiff coating cracks where it bends over its soft base, and further out as it is pressed down: the peak of the
    // tension jumps between surface and interface.
    let thickness = 5e-3;
    let coating = Material::new(200.0, 0.3).unwrap();
    let base = Material::new(STEEL.0, 0.3).unwrap();
    let model = model(
        &Foundation::coated(thickness, coating, base).unwrap(),
        Paraboloid::new(1.0).unwrap(),
    );
    let stress = StressModel {
        sliding: Sliding {
            friction: 0.3,
            direction: 0.0,
        },
        bodies: vec![body(
            "layer[0]",
            0.0,
            thickness,
            BodyStrengths {
                yield_strength: None,
                tensile_strength: Some(0.1),
            },
        )],
        ..StressModel::default()
    };
    // In units of the base's modulus and the radius: 3 GPa and 1 mm.
    let newton = 1.0 / 3e3;
    let mut first = None;
    for force in [6e-3, 10e-3, 12e-3, 50e-3, 1.0, 5.0] {
        let found = critical(&model, 64, force * newton, &stress).remove(0);
        let (force, estimate) = (found.force.unwrap(), found.estimate.unwrap());
        assert!(
            found.resolved && (found.utilisation - 1.0).abs() < 1e-3,
            "{found:?}"
        );
        let wanted = *first.get_or_insert(force);
        assert!((force / wanted - 1.0).abs() < 1e-3, "{force} for {wanted}");
        assert!(estimate < 2e-3 * force, "{found:?}");
    }
    // Below it the tension stays below the strength.
    let tension = |part: f64| {
        let path = solved(&model, 64, part * first.unwrap());
        let extremes = stress_extremes(&path, 0, &stress).unwrap();
        extremes.bodies[0].max_principal.unwrap().value
    };
    assert_relative_eq!(tension(1.0), 0.1, max_relative = 2e-3);
    assert!([0.2, 0.5, 0.9].map(tension).iter().all(|of| *of < 0.1));
}
