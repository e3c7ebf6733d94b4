//! Stresses of random cases with up to eight layers, under forces and penetrations, at rest and sliding: each is found,
//! with finite numbers at places in its body, or refused with a reason.
//!
//! 16 by default; for more
//!
//! ```sh
//! PELLICLE_RANDOM_STRESSES=2000 cargo test --release -p pellicle-contact random_cases::stresses
//! ```

use pellicle_contact::{
    BodyPart, BodyStrengths, ContactError, CriticalStatus, Extreme, InterfacePart,
    InterfaceStrengths, LoadingPath, ResidualStress, Sliding, SolverOptions, StressExtremes,
    StressModel, critical_loads, stress_extremes,
};
use pellicle_influence::{ElasticBody, InfluenceError};
use pellicle_kernel::{Base, Foundation};
use rayon::prelude::*;

use super::SI;
use super::case::Case;
use super::random::Random;
use super::view::View;

/// Number of cases in the short form, and the most elements per side.
const SHORT: u64 = 16;
const MOST_ELEMENTS: usize = 32;
/// Critical loads are searched for in one of this many cases.
const CRITICAL: usize = 8;

/// The bodies and interfaces of a foundation, with strengths that are reached at part of the load.
fn stresses(foundation: &Foundation, sliding: Sliding) -> StressModel {
    let count = foundation.layers().len();
    let depth = |i: usize| match i {
        0 => 0.0,
        i if i > count => f64::INFINITY,
        i => foundation.interface_depth(i),
    };
    let last = match foundation.base() {
        Base::HalfSpace(_) => count + 1,
        Base::Rigid => count,
    };
    let bodies = (0..last).map(|i| BodyPart {
        name: format!("body {i}"),
        top: depth(i),
        bottom: depth(i + 1),
        strengths: BodyStrengths::default(),
    });
    let interfaces = (0..count).map(|i| InterfacePart {
        index: i,
        depth: depth(i + 1),
        strengths: InterfaceStrengths::default(),
    });
    StressModel {
        sliding,
        bodies: bodies.collect(),
        interfaces: interfaces.collect(),
        ..StressModel::default()
    }
}

/// Why an extreme is not one of its body.
fn fault<const AXES: usize>(extreme: &Extreme<AXES>, [top, bottom]: [f64; 2]) -> Option<String> {
    let is_finite = extreme.value.is_finite()
        && extreme.at.iter().all(|along| along.is_finite())
        && extreme.estimate.is_none_or(f64::is_finite);
    let is_inside = extreme.at.get(2).is_none_or(|z| (top..=bottom).contains(z));
    (!is_finite || !is_inside).then(|| format!("{extreme:?} between {top} and {bottom}"))
}

fn faults(stress: &StressModel, found: &StressExtremes) -> Option<String> {
    let bodies = stress.bodies.iter().zip(&found.bodies);
    let mut of_bodies = bodies.flat_map(|(part, body)| {
        let all = [
            body.max_von_mises.unwrap(),
            body.max_principal.unwrap(),
            body.min_principal.unwrap(),
            body.max_shear.unwrap(),
        ];
        all.into_iter()
            .filter_map(|extreme| fault(&extreme, [part.top, part.bottom]))
    });
    let mut of_interfaces = found.interfaces.iter().flat_map(|of| {
        let all = [
            of.max_shear_traction.unwrap(),
            of.max_tension.unwrap(),
            of.max_compression.unwrap(),
        ];
        all.into_iter()
            .filter_map(|extreme| fault(&extreme, [0.0; 2]))
    });
    of_bodies.next().or_else(|| of_interfaces.next())
}

/// Whether the case was refused; why it failed.
fn outcome(case: &Case, sliding: Sliding, random: &mut Random) -> Result<bool, String> {
    let options = SolverOptions {
        coarse_pressures: true,
        ..SolverOptions::default()
    };
    let refused = |error: ContactError| match error {
        ContactError::Influence(InfluenceError::TableAccuracy { .. })
        | ContactError::DomainTooSmall { .. } => Ok(true),
        error => Err(error.to_string()),
    };
    let path = match case.solve(&options) {
        Ok(path) => path,
        Err(error) => return refused(error),
    };
    for body in ElasticBody::ALL {
        let foundation = case.bodies.of(body);
        if foundation.is_rigid() {
            continue;
        }
        let (path, mut stress) = (path.seen_from(body), stresses(foundation, sliding));
        if body == ElasticBody::Counterbody || !case.bodies.counterbody().is_rigid() {
            stress.residual = residual(&stress, &path, random);
        }
        let found = match stress_extremes(&path, 0, &stress) {
            Ok(found) => found,
            Err(error) => return Err(error.to_string()),
        };
        if let Some(fault) = faults(&stress, &found) {
            return Err(fault);
        }
        if random.below(CRITICAL) == 0 {
            critical(case, body, &path, &mut stress, found)?;
        }
    }
    Ok(false)
}

/// Residual stresses of both signs, from a hundredth to ten times the largest pressure, in most bodies.
fn residual(stress: &StressModel, path: &LoadingPath, random: &mut Random) -> ResidualStress {
    let peak = path.steps[0].summary.max_pressure;
    let bodies = stress.bodies.iter().map(|body| {
        let size = peak * random.decades(1e-2, 10.0);
        (body.bottom, [0.0, size, -size, -size][random.below(4)])
    });
    ResidualStress::new(bodies.collect::<Vec<_>>())
}

/// Critical loads of four criteria at two thirds of the stress.
fn critical(
    case: &Case,
    body: ElasticBody,
    path: &LoadingPath,
    stress: &mut StressModel,
    found: StressExtremes,
) -> Result<(), String> {
    let part = |extreme: f64| (extreme > 0.0).then_some(extreme / 1.5);
    stress.bodies[0].strengths = BodyStrengths {
        yield_strength: part(found.bodies[0].max_von_mises.unwrap().value),
        tensile_strength: part(found.bodies[0].max_principal.unwrap().value),
    };
    if let Some(interface) = stress.interfaces.first_mut() {
        interface.strengths = InterfaceStrengths {
            shear_strength: part(found.interfaces[0].max_shear_traction.unwrap().value),
            tensile_strength: part(found.interfaces[0].max_tension.unwrap().value),
        };
    }
    let (model, options) = (case.model(), SolverOptions::default());
    let model = model.map_err(|error| error.to_string())?.seen_from(body);
    let loads = critical_loads(
        &model,
        path,
        &[found],
        case.domain,
        &options,
        stress,
        &mut (),
    );
    // A load between may need a larger domain or more products than the case itself.
    for load in loads.unwrap_or_default() {
        let least = match load.status {
            CriticalStatus::AtRest => 0.0,
            _ => f64::MIN_POSITIVE,
        };
        if load
            .force
            .is_some_and(|force| !(force >= least && force.is_finite()))
        {
            return Err(format!("{load:?}"));
        }
    }
    Ok(())
}

#[test]
fn stresses_of_every_random_case_are_finite_and_in_their_bodies() {
    assert_finite(|seed| Case::draw_sliding(seed, MOST_ELEMENTS));
}

#[test]
fn stresses_in_both_bodies_with_residual_stress_are_finite_and_in_their_bodies() {
    assert_finite(|seed| {
        let sliding = Sliding {
            friction: f64::from(u8::from(seed % 2 == 0)),
            direction: 0.4,
        };
        (
            Case::draw_made(seed, MOST_ELEMENTS, View::plain(SI)),
            sliding,
        )
    });
}

#[expect(clippy::print_stderr, reason = "a table for whoever runs more cases")]
fn assert_finite(draw: impl Fn(u64) -> (Case, Sliding) + Sync) {
    let count = std::env::var("PELLICLE_RANDOM_STRESSES");
    let count = count.map_or(SHORT, |count| count.parse().unwrap());
    let outcomes: Vec<_> = (0..count)
        .into_par_iter()
        .map(|seed| {
            let (case, sliding) = draw(seed);
            (seed, outcome(&case, sliding, &mut Random(seed)))
        })
        .collect();
    let (mut refused, mut failures) = (0, 0);
    for (seed, outcome) in outcomes {
        match outcome {
            Ok(is_refused) => refused += u64::from(is_refused),
            Err(how) => {
                failures += 1;
                eprintln!("{seed}: {how}, {:?}", draw(seed));
            }
        }
    }
    eprintln!("{count} cases: {refused} refused, {failures} failed");
    assert_eq!(failures, 0);
    assert!(20 * refused <= count, "{refused}");
}
