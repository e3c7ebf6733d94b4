//! The stress with which each strength is compared, and the loads at which it is reached.

use pellicle_texture::Relief;

use super::*;
use crate::{
    Load, Paraboloid, solve_path,
    stress::{
        body_extremes::{BodyUtilisation, InterfaceUtilisation, stress_extremes},
        model::{BodyPart, BodyStrengths, InterfacePart, InterfaceStrengths},
        quantity::StressQuantity::{MaxPrincipal, ShearTraction, Tension, VonMises},
    },
};

fn extreme<const AXES: usize>(value: f64) -> Extreme<AXES> {
    Extreme {
        value,
        at: [0.5; AXES],
        resolved: true,
        estimate: Some(0.1),
    }
}

/// A coating with all strengths on a substrate with one, and the interface between them.
fn stress() -> StressModel {
    let body = |name: &str, [top, bottom]: [f64; 2], strengths| BodyPart {
        name: name.to_owned(),
        top,
        bottom,
        strengths,
    };
    let all = BodyStrengths {
        yield_strength: Some(3.0),
        tensile_strength: Some(4.0),
    };
    let one = BodyStrengths {
        tensile_strength: Some(5.0),
        ..BodyStrengths::default()
    };
    StressModel {
        bodies: vec![
            body("layer[0]", [0.0, 0.2], all),
            body("substrate", [0.2, f64::INFINITY], one),
        ],
        interfaces: vec![InterfacePart {
            index: 0,
            depth: 0.2,
            strengths: InterfaceStrengths {
                shear_strength: Some(6.0),
                tensile_strength: Some(7.0),
            },
        }],
        ..StressModel::default()
    }
}

#[test]
fn every_strength_has_its_own_stress_in_its_own_depth_range() {
    let body = |value: f64| BodyStress {
        name: String::new(),
        max_von_mises: Some(extreme(value)),
        max_principal: Some(extreme(value + 1.0)),
        min_principal: Some(extreme(-9.0)),
        max_shear: Some(extreme(9.0)),
        utilisation: BodyUtilisation::default(),
    };
    let step = StressExtremes {
        bodies: vec![body(10.0), body(20.0)],
        interfaces: vec![InterfaceStress {
            name: "interface[0]".into(),
            index: 0,
            depth: 0.2,
            max_shear_traction: Some(extreme(30.0)),
            max_tension: Some(extreme(31.0)),
            max_compression: Some(extreme(9.0)),
            utilisation: InterfaceUtilisation::default(),
        }],
    };
    let searches = criteria(&stress(), std::slice::from_ref(&step)).unwrap();
    let found = searches.iter().map(|search| {
        let Target {
            top,
            bottom,
            quantities,
        } = &search.target;
        assert_eq!(search.known[0].at.len(), 3);
        let known = search.known[0].value;
        (
            search.name.as_str(),
            search.strength,
            [*top, *bottom],
            quantities[0],
            known,
        )
    });
    let endless = [0.2, f64::INFINITY];
    let wanted = [
        ("layer[0]", 3.0, [0.0, 0.2], VonMises, 10.0),
        ("layer[0]", 4.0, [0.0, 0.2], MaxPrincipal, 11.0),
        ("substrate", 5.0, endless, MaxPrincipal, 21.0),
        ("interface[0]", 6.0, [0.2; 2], ShearTraction, 30.0),
        ("interface[0]", 7.0, [0.2; 2], Tension, 31.0),
    ];
    assert_eq!(found.collect::<Vec<_>>(), wanted);
    // On an interface the depth is that of the interface.
    assert_eq!(searches[3].known[0].at, [0.5, 0.5, 0.2]);
    let mut without = step;
    without.interfaces[0].max_tension = None;
    let refused = criteria(&stress(), &[without]).err();
    assert!(matches!(
        refused,
        Some(ContactError::StressLeftOut {
            quantity: "max_tension"
        })
    ));
}

#[test]
fn the_relative_error_of_a_critical_load_is_that_of_the_stress_over_its_exponent() {
    let search = || CriterionSearch {
        criterion: Criterion::Yield,
        name: "substrate".to_owned(),
        strength: 4.0,
        target: Target {
            top: 0.0,
            bottom: 1.0,
            quantities: vec![VonMises],
        },
        known: Vec::new(),
    };
    let solved = |value: f64| Solved {
        force: 6.0,
        penetration: 0.3,
        radius: 1.0,
        is_beyond: false,
        extreme: extreme(value),
        followed_on: None,
    };
    let met = search().into_critical_load(
        &LoadSearchResult::Met {
            solved: solved(4.0),
            exponent: 0.5,
        },
        0.0,
    );
    // 6 · (0.1/4)/0.5
    assert!((met.estimate.unwrap() - 0.3).abs() < 1e-15);
    let numbers = (met.force, met.penetration, met.at, met.utilisation);
    assert_eq!(numbers, (Some(6.0), Some(0.3), Some([0.5; 3]), 1.0));
    assert_eq!(met.status, CriticalStatus::Met);
    let missed = search().into_critical_load(&LoadSearchResult::Missed(Some(solved(1.0))), 0.0);
    let numbers = (missed.force, missed.penetration, missed.at, missed.estimate);
    assert_eq!(numbers, (None, None, None, None));
    assert_eq!((missed.utilisation, missed.resolved), (0.25, true));
    assert_eq!(missed.status, CriticalStatus::NotReached);
    let exceeded = search().into_critical_load(&LoadSearchResult::Missed(Some(solved(8.0))), 0.0);
    assert_eq!(exceeded.status, CriticalStatus::BelowSmallest);
    let pulled = search().into_critical_load(&LoadSearchResult::Missed(Some(solved(-1.0))), 0.0);
    assert_eq!(pulled.utilisation, 0.0);
    let unloaded = search().into_critical_load(&LoadSearchResult::Missed(None), 0.0);
    assert_eq!((unloaded.utilisation, unloaded.resolved), (0.0, false));
}

#[test]
fn a_body_yields_under_a_ball_at_the_force_of_hertz() {
    let model = Model::on_half_space([1.0, 0.3], Relief::Bare, Paraboloid::new(1.0).unwrap());
    // 0.62 p0 with p0³ = 6 Q E*²/(π³ R²); no load reaches a tension of 0.2.
    let strength = 0.05;
    let modulus = 1.0 / 0.91;
    let exact = (std::f64::consts::PI * strength / 0.62).powi(3) / (6.0 * modulus * modulus);
    let stress = StressModel {
        bodies: vec![BodyPart {
            name: "substrate".to_owned(),
            top: 0.0,
            bottom: f64::INFINITY,
            strengths: BodyStrengths {
                yield_strength: Some(strength),
                tensile_strength: Some(4.0 * strength),
            },
        }],
        ..StressModel::default()
    };
    let loads = [2.0, 0.5].map(|part| Load::Force(part * exact));
    // Three radii under the larger load, a³ = 3 Q R/(4 E*).
    let side = 3.0 * (1.5 * exact / modulus).cbrt();
    let (domain, options) = (Domain::Side(side), SolverOptions::default());
    let path = solve_path(&model, domain, 24, &loads, &options, &mut ()).unwrap();
    let extremes = [0, 1].map(|step| stress_extremes(&path, step, &stress).unwrap());
    let solve = |options: &SolverOptions| {
        critical_loads(&model, &path, &extremes, domain, options, &stress, &mut ())
    };
    let found = solve(&options).unwrap();
    let [yielding, tension] = &found[..] else {
        panic!("{found:?}")
    };
    // Seven elements per radius.
    assert!(
        (yielding.force.unwrap() / exact - 1.0).abs() < 0.1,
        "{yielding:?}"
    );
    assert!((yielding.utilisation - 1.0).abs() < 1e-3);
    // Three times the error of the stress, which is estimated from coarser grids.
    assert!(yielding.estimate.unwrap() > 0.0 && yielding.estimate.unwrap() < 0.5 * exact);
    assert!(tension.force.is_none() && tension.utilisation < 0.7);
    let cut = SolverOptions {
        hardness: 1.0,
        ..options
    };
    assert!(matches!(
        solve(&cut),
        Err(ContactError::WithHardness { .. })
    ));
}
