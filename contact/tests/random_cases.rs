//! Random cases in SI units, from nanometres to metres and from kilopascals to terapascals: each is certified or
//! refused with a reason, none is NaN, and none depends on its units.
//!
//! 24 by default;
//! `PELLICLE_RANDOM_CASES=3000 cargo test --release -p pellicle-contact random_cases:: -- --nocapture` for more,
//! larger ones and a table.

#![expect(
    clippy::unwrap_used,
    reason = "a scene that cannot be built fails its test"
)]

mod case;
mod made;
pub mod random;
mod relations;
mod stresses;
mod view;
mod wear;

use pellicle_contact::{ContactError, Domain, FlatPunch, Load, SolverOptions, Status};
use pellicle_influence::InfluenceError;
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::{CylinderSpec, Cylinders, Lattice, Relief};
use rayon::prelude::*;

use self::case::{Case, Units};
use self::view::View;

const SI: Units = Units {
    length: 1.0,
    modulus: 1.0,
};
/// Nanometres instead of metres.
const OTHER: Units = Units {
    length: 1e-9,
    modulus: 1e12,
};
/// Number of cases in the short form, and the most elements per side in the short and the long form.
const SHORT: u64 = 24;
const MOST_ELEMENTS: [usize; 2] = [34, 160];

/// Number of cases, and the most elements per side.
fn extent() -> (u64, usize) {
    let [short, long] = MOST_ELEMENTS;
    std::env::var("PELLICLE_RANDOM_CASES")
        .map_or((SHORT, short), |count| (count.parse().unwrap(), long))
}

/// Tolerance so fine that the residuals do not mask the effect of other units.
const FINE: f64 = 1e-12;
/// The most products on the finest grid in the short form.
const MOST_PRODUCTS: usize = 400;

/// A skin of 0.3 mm, a thousand times as stiff as the gel below, with pillars under a flat punch of 60 mN.
fn gel_under_a_punch(units: Units) -> Case {
    let Units { length, modulus } = units;
    let [skin, gel] = [20e6, 20e3].map(|e| Material::new(modulus * e, 0.49).unwrap());
    let pillars = CylinderSpec {
        lattice: Lattice::Hexagonal,
        radius: 1.4e-3 * length,
        height: 3e-6 * length,
        period: 2.8e-3 * length,
        offset: [1.91e-3 * length, 2.27e-3 * length],
        young_modulus: 3e9 * modulus,
    };
    Case {
        bodies: Foundation::coated(0.3e-3 * length, skin, gel)
            .unwrap()
            .into(),
        relief: Relief::Cylinders(Cylinders::new(pillars).unwrap()),
        indenter: FlatPunch::new(6.3e-3 * length).unwrap().into(),
        domain: Domain::Side(20e-3 * length),
        elements: 48,
        load: Load::Force(60e-3 * modulus * length * length),
    }
}

#[test]
fn a_stiff_skin_under_a_punch_is_solved_in_every_system_of_units() {
    let softer = Units {
        modulus: 1e-5,
        ..SI
    };
    let options = SolverOptions {
        tolerance: FINE,
        ..SolverOptions::default()
    };
    let numbers = [SI, softer, OTHER].map(|units| {
        let case = gel_under_a_punch(units);
        match outcome(&case, units, &options) {
            Outcome::Certified(numbers, _) => numbers,
            Outcome::CutOff => panic!("cut off"),
            Outcome::Refused(reason) => panic!("{reason}"),
            Outcome::Failed(how) => panic!("{how}"),
        }
    });
    for other in &numbers[1..] {
        assert_close(&numbers[0], other);
    }
}

/// A coating 3.6e4 times as stiff as its base with rigid pillars in a hexagonal lattice under a flat punch.
fn rigid_pillars_under_a_punch() -> Case {
    let [coating, base] = [(229.5e9, 0.49), (6.44e6, 0.0)].map(|(e, nu)| Material::new(e, nu));
    let pillars = CylinderSpec {
        lattice: Lattice::Hexagonal,
        radius: 33.59e-6,
        height: 15.24e-6,
        period: 80.59e-6,
        offset: [3.74e-6, 66.24e-6],
        young_modulus: 2.3e16,
    };
    Case {
        bodies: Foundation::coated(7.9e-6, coating.unwrap(), base.unwrap())
            .unwrap()
            .into(),
        relief: Relief::Cylinders(Cylinders::new(pillars).unwrap()),
        indenter: FlatPunch::new(721.4e-6).unwrap().into(),
        domain: Domain::Side(1.792e-3),
        elements: 160,
        load: Load::Force(94.91e-6),
    }
}

#[test]
fn rigid_pillars_on_a_very_stiff_coating_are_certified_in_hundreds_of_products() {
    let case = rigid_pillars_under_a_punch();
    let path = case.solve(&SolverOptions::default()).unwrap();
    let step = &path.steps[0];
    assert_eq!(step.status(), Status::Certified);
    // As measured, with a tenth to spare; without the descent from face to face the solver gave up after 4002.
    let products = step.work.operator_applications;
    assert!(products <= 330, "{products}");
}

/// Asserts that dimensionless numbers are the same in other units.
#[track_caller]
fn assert_close(one: &[f64; 4], other: &[f64; 4]) {
    for (one, other) in one.iter().zip(other) {
        assert!(
            (one - other).abs() <= 1e-10 * one.abs(),
            "{one:e} {other:e}"
        );
    }
}

/// The outcome of a case.
enum Outcome {
    /// Its dimensionless numbers, and products with `K` on the finest grid.
    Certified([f64; 4], usize),
    /// Cut off by the given side.
    CutOff,
    /// The reason.
    Refused(&'static str),
    Failed(String),
}

fn outcome(case: &Case, units: Units, options: &SolverOptions) -> Outcome {
    match case.solve(options) {
        Ok(path) => {
            let step = &path.steps[0];
            let force = units.modulus * units.length * units.length;
            let numbers = [
                step.solution.penetration / units.length,
                step.solution.force / force,
                step.summary.contact_area / units.length.powi(2),
                step.summary.max_pressure / units.modulus,
            ];
            let is_finite = numbers.iter().all(|number| number.is_finite());
            match step.status() {
                // The solver is tested also where no body would behave like this.
                Status::Certified | Status::BeyondModel if is_finite => {
                    Outcome::Certified(numbers, step.work.operator_applications)
                }
                Status::CutOff if is_finite => Outcome::CutOff,
                status => Outcome::Failed(format!(
                    "{status:?} {numbers:?} {:?}",
                    step.solution.certificate
                )),
            }
        }
        Err(error) => refused(&error),
    }
}

/// The outcome of a case that is not solved.
fn refused(error: &ContactError) -> Outcome {
    match error {
        ContactError::Influence(InfluenceError::TableAccuracy { .. }) => {
            Outcome::Refused("radial tables")
        }
        ContactError::DomainTooSmall { .. } => Outcome::Refused("automatic domain"),
        reason => Outcome::Failed(reason.to_string()),
    }
}

/// Prints how many cases have which outcome, and asserts that none fails and few are refused; returns the products of
/// those certified, from the fewest.
#[expect(clippy::print_stderr, reason = "a table for whoever runs more cases")]
fn tally(
    kind: &str,
    outcomes: Vec<(u64, Outcome)>,
    describe: impl Fn(u64) -> String,
) -> Vec<usize> {
    let count = outcomes.len();
    let (mut products, mut cut_off, mut failures) = (Vec::new(), 0, 0);
    let mut refusals = std::collections::BTreeMap::new();
    for (seed, outcome) in outcomes {
        match outcome {
            Outcome::Certified(_, count) => products.push(count),
            Outcome::CutOff => cut_off += 1,
            Outcome::Refused(reason) => *refusals.entry(reason).or_insert(0) += 1,
            Outcome::Failed(how) => {
                failures += 1;
                eprintln!("{seed}: {how}, {}", describe(seed));
            }
        }
    }
    products.sort_unstable();
    let [median, largest] = [products.len() / 2, products.len() - 1].map(|place| products[place]);
    eprintln!(
        "{kind}: {} certified, {cut_off} cut off, refused {refusals:?}, {failures} failed; products: {median} in the median, {largest} at most",
        products.len()
    );
    assert_eq!(failures, 0);
    assert!(
        100 * refusals.values().sum::<usize>() <= count,
        "{refusals:?}"
    );
    products
}

#[test]
fn every_random_case_is_certified_or_refused_with_a_reason() {
    let (count, most) = extent();
    let options = SolverOptions::default();
    let outcomes: Vec<(u64, Outcome)> = (0..count)
        .into_par_iter()
        .map(|seed| (seed, outcome(&Case::draw(seed, most, SI), SI, &options)))
        .collect();
    let describe = |seed| format!("{:?}", Case::draw(seed, most, SI));
    let products = tally("cases", outcomes, describe);
    assert!(products.len() as u64 > count / 2);
    let largest = products.last().copied();
    assert!(largest < Some(MOST_PRODUCTS), "{largest:?}");
}

#[test]
fn every_random_case_of_what_people_make_is_certified_or_refused_with_a_reason() {
    let (count, most) = extent();
    let (options, plain) = (SolverOptions::default(), View::plain(SI));
    let outcomes: Vec<(u64, Outcome)> = (0..count)
        .into_par_iter()
        .map(|seed| {
            (
                seed,
                outcome(&Case::draw_made(seed, most, plain), SI, &options),
            )
        })
        .collect();
    let describe = |seed| format!("{:?}", Case::draw_made(seed, most, plain));
    let products = tally("made", outcomes, describe);
    assert!(products.len() as u64 > count / 2);
}

#[test]
fn random_cases_give_the_same_numbers_in_other_units() {
    let (count, most) = extent();
    let options = SolverOptions {
        tolerance: FINE,
        ..SolverOptions::default()
    };
    let numbers =
        |seed: u64, units: Units| match outcome(&Case::draw(seed, most, units), units, &options) {
            Outcome::Certified(numbers, _) => Some(numbers),
            _ => None,
        };
    // Only cases certified to this fine tolerance in both units; rounding prevents that in some stiff cases.
    let pairs: Vec<_> = (0..count / 2)
        .into_par_iter()
        .filter_map(|seed| Some((numbers(seed, SI)?, numbers(seed, OTHER)?)))
        .collect();
    let difference = |(one, other): &([f64; 4], [f64; 4])| {
        let parts = one
            .iter()
            .zip(other)
            .map(|(one, other)| (one / other - 1.0).abs());
        parts.fold(0.0, f64::max)
    };
    let mut differences: Vec<f64> = pairs.iter().map(difference).collect();
    differences.sort_unstable_by(f64::total_cmp);
    let (median, largest) = (differences[pairs.len() / 2], differences[pairs.len() - 1]);
    let close = differences.iter().filter(|found| **found <= 1e-10).count();
    eprintln!(
        "{} of {} compared in two systems of units, {close} the same to 1e-10; {median:.1e} in the median, {largest:.1e} at most",
        pairs.len(),
        count / 2
    );
    // *Measured* on 1,200 cases of the long form, 1,147 of them certified to this tolerance in both: all agree to 1e-10
    // except one, whose largest pressure differs by up to 3e-9. Its coating is 1e8 times as stiff as the material
    // below, and rounding limits the accuracy of the pressure at the edges.
    assert!(median <= 1e-14 && largest <= 1e-8, "{differences:?}");
    assert!(100 * close >= 99 * pairs.len(), "{differences:?}");
    assert!(3 * pairs.len() as u64 > count / 2);
}
