//! Residual stress: shifted principal stresses, and critical loads that vanish where it reaches a strength.

use pellicle_contact::{CriticalStatus, ResidualStress};

use super::*;

/// Poisson's ratio of the half-space, `E* = 1`, and the radius of the indenter, 1.
fn under_ball(force: f64) -> hertz::HertzContact {
    let modulus = STEEL.0 / (1.0 - STEEL.1 * STEEL.1);
    hertz::from_force(1.0, modulus, force)
}

/// A body of one material with residual stress.
fn with_residual(strengths: BodyStrengths, residual: f64) -> StressModel {
    StressModel {
        residual: ResidualStress::new([(f64::INFINITY, residual)]),
        ..whole(strengths)
    }
}

fn critical(force: f64, stress: &StressModel) -> CriticalLoad {
    let model = model(&half_space(), Paraboloid::new(1.0).unwrap());
    let path = solved(&model, 96, force);
    let extremes = [stress_extremes(&path, 0, stress).unwrap()];
    let options = SolverOptions::default();
    let domain = Domain::Automatic;
    let found = critical_loads(&model, &path, &extremes, domain, &options, stress, &mut ());
    found.unwrap().remove(0)
}

#[test]
fn states_on_the_axis_are_shifted_along_the_surface_and_nothing_else() {
    let model = model(&half_space(), Paraboloid::new(1.0).unwrap());
    let path = solved(&model, 64, 1e-3);
    let field = || StressField::new(&path, 0, Sliding::default()).unwrap();
    let own = -0.04;
    let residual = ResidualStress::new([(0.05, own)]);
    let (plain, shifted) = (field(), field().with_residual(residual));
    for depth in [Depth::below(0.03), Depth::above(0.05)] {
        let [alone, both] = [&plain, &shifted].map(|field| field.at([0.0; 2], depth).unwrap());
        let [xx, yy, zz, ..] = alone.stress;
        assert_eq!(both.stress[..3], [xx + own, yy + own, zz]);
        assert_eq!(both.stress[3..], alone.stress[3..]);
        let moved = |state: &SubsurfaceState| state.displacement.map(f64::to_bits);
        assert_eq!(moved(&both), moved(&alone));
        // |σ_zz − σ_xx| on the axis.
        assert_relative_eq!(both.von_mises(), (zz - xx - own).abs(), max_relative = 1e-9);
    }
    let below = Depth::below(0.05);
    assert_eq!(plain.at([0.0; 2], below), shifted.at([0.0; 2], below));
    // Planes as points.
    let mut planes = shifted.planes(0.1);
    let at: Vec<_> = planes
        .centres()
        .iter()
        .map(|x| [*x, planes.centres()[0]])
        .collect();
    let states = shifted.at_points(&at, Depth::below(0.03)).unwrap();
    let size = at.len();
    planes
        .fields_on(Depth::below(0.03), |field, values| {
            for (i, state) in states.iter().enumerate().filter(|_| field >= 3) {
                let error = values[i * size] - state.stress[field - 3];
                assert!(error.abs() < 1e-10, "{field}: {error:e}");
            }
        })
        .unwrap();
}

#[test]
fn the_tension_beside_the_contact_and_the_stress_far_from_it_are_shifted() {
    let force = 1e-3;
    let model = model(&half_space(), Paraboloid::new(1.0).unwrap());
    let path = solved(&model, 128, force);
    let peak = under_ball(force).peak_pressure;
    // (1 − 2ν) p₀/3 at the edge
    let edge = (1.0 - 2.0 * STEEL.1) / 3.0 * peak;
    for own in [0.5 * edge, -0.5 * edge] {
        let stress = with_residual(BodyStrengths::default(), own);
        let body = stress_extremes(&path, 0, &stress).unwrap().bodies.remove(0);
        let found = body.max_principal.unwrap();
        let error = found.value - (edge + own);
        assert!(
            error.abs() < found.estimate.unwrap(),
            "{own}: {found:?} {error:e}"
        );
    }
    // What no place near the contact exceeds is found far away.
    let own = -2.0 * peak;
    let stress = with_residual(BodyStrengths::default(), own);
    let body = stress_extremes(&path, 0, &stress).unwrap().bodies.remove(0);
    assert!(body.max_principal.unwrap().value.abs() == 0.0);
    assert!(body.max_von_mises.unwrap().value >= -own);
    // Under the contact: σ_r − (1 + 2ν)/2 p₀ on the surface of the axis.
    let least = body.min_principal.unwrap().value;
    assert_relative_eq!(least, own - (0.5 + STEEL.1) * peak, max_relative = 3e-3);
}

#[test]
fn the_critical_load_vanishes_as_the_residual_stress_reaches_the_strength() {
    let strength = 0.01;
    let strengths = BodyStrengths {
        tensile_strength: Some(strength),
        ..BodyStrengths::default()
    };
    let modulus = STEEL.0 / (1.0 - STEEL.1 * STEEL.1);
    for part in [-1.0, 0.0, 0.5, 0.9] {
        let found = critical(3e-2, &with_residual(strengths, part * strength));
        // (1 − 2ν) p₀/3 + σ_r = σ_t and p₀³ = 6 Q E*²/(π³ R²)
        let peak = 3.0 * (1.0 - part) * strength / (1.0 - 2.0 * STEEL.1);
        let wanted = (std::f64::consts::PI * peak).powi(3) / (6.0 * modulus * modulus);
        let (force, estimate) = (found.force.unwrap(), found.estimate.unwrap());
        assert_eq!(found.status, CriticalStatus::Met);
        assert!(
            (force - wanted).abs() < estimate + 1e-4 * wanted,
            "{part}: {found:?} {wanted}"
        );
        assert!(estimate < 0.06 * wanted, "{found:?}");
    }
    for part in [1.0, 1.7] {
        let found = critical(2e-3, &with_residual(strengths, part * strength));
        assert_eq!(
            (found.status, found.force),
            (CriticalStatus::AtRest, Some(0.0))
        );
        assert_relative_eq!(found.utilisation, part, max_relative = 1e-14);
    }
}

#[test]
fn a_body_under_residual_compression_yields_where_both_stresses_together_do() {
    let yield_strength = 0.05;
    let strengths = BodyStrengths {
        yield_strength: Some(yield_strength),
        ..BodyStrengths::default()
    };
    for part in [-0.9, -0.3, 0.3, 0.9] {
        let stress = with_residual(strengths, part * yield_strength);
        let found = critical(2e-2, &stress);
        let force = found.force.unwrap();
        let model = model(&half_space(), Paraboloid::new(1.0).unwrap());
        let at = |force| {
            let body = stress_extremes(&solved(&model, 96, force), 0, &stress);
            body.unwrap().bodies[0].max_von_mises.unwrap().value
        };
        assert_relative_eq!(at(force), yield_strength, max_relative = 2e-3);
        assert!(at(0.9 * force) < yield_strength);
    }
}
