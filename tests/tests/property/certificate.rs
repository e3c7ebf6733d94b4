//! The certificate, line by line: each line has a pressure that breaks it and no other; the correct pressure breaks
//! none.

use pellicle_contact::{Certificate, DiscreteProblem, Load, Solution};
use pellicle_influence::ElasticOperator;
use proptest::prelude::*;

const TOLERANCE: f64 = 1e-8;

/// Independent springs of compliance 1, so that `u = p` and all correct and wrong pressures can be written down.
struct Springs(usize);

impl ElasticOperator for Springs {
    fn size(&self) -> usize {
        self.0
    }

    fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        displacement.copy_from_slice(pressure);
    }
}

/// Initial gaps: at penetration 1 the first two elements are in contact, the third is pulled if it sticks, and the last
/// is far away.
const GAPS: [f64; 4] = [0.0, 0.5, 1.5, 5.0];
/// `p = D − g0` where that is positive.
const RIGHT: [f64; 4] = [1.0, 0.5, 0.0, 0.0];

fn judge(load: Load, pressure: [f64; 4]) -> Certificate {
    let springs = Box::new(Springs(2));
    let problem = DiscreteProblem::new(springs, vec![0.0; 4], GAPS.to_vec(), 1.0);
    Solution::judge(&mut problem.unwrap(), load, pressure.to_vec(), TOLERANCE).certificate
}

/// The names of the broken lines.
fn broken(certificate: &Certificate) -> Vec<&'static str> {
    let lines = [
        ("complementarity", certificate.complementarity),
        ("gap in contact", certificate.gap_in_contact),
        ("overlap", certificate.overlap),
        ("load", certificate.load),
        ("negative pressure", -certificate.min_pressure),
    ];
    let is_broken = |value: f64| value.is_nan() || value > TOLERANCE;
    let lines = lines.into_iter().filter(|line| is_broken(line.1));
    lines.map(|line| line.0).collect()
}

/// The broken lines of the certificate; none if it is satisfied.
fn found(load: Load, pressure: [f64; 4]) -> Vec<&'static str> {
    let certificate = judge(load, pressure);
    let broken = broken(&certificate);
    assert_eq!(
        certificate.is_satisfied(),
        broken.is_empty(),
        "{certificate:?}"
    );
    broken
}

#[test]
fn the_correct_pressure_satisfies_every_condition() {
    assert!(found(Load::Force(1.5), RIGHT).is_empty());
    assert!(found(Load::Penetration(1.0), RIGHT).is_empty());
}

#[test]
fn a_correct_pressure_for_another_force_violates_only_the_load() {
    assert_eq!(found(Load::Force(1.5 * (1.0 + 1e-6)), RIGHT), ["load"]);
}

#[test]
fn an_element_left_out_of_contact_violates_only_the_overlap() {
    assert_eq!(found(Load::Force(1.0), [1.0, 0.0, 0.0, 0.0]), ["overlap"]);
}

#[test]
fn a_trace_of_pressure_over_an_open_gap_violates_only_the_gap_in_contact() {
    let trace = [1.0, 0.5, 0.0, 1e-12];
    assert_eq!(found(Load::Force(1.5), trace), ["gap in contact"]);
}

#[test]
fn adhesion_violates_only_the_negative_pressure() {
    // The third element sticks to the indenter: no gap, no overlap, but it pulls.
    let sticking = [1.0, 0.5, -0.5, 0.0];
    assert_eq!(found(Load::Force(1.0), sticking), ["negative pressure"]);
}

#[test]
fn complementarity_is_violated_together_with_the_gaps_that_it_weighs() {
    // Complementarity is a pressure-weighted mean of the gaps in contact, so it cannot be broken alone.
    let larger = RIGHT.map(|p| p * (1.0 + 1e-6));
    let both = ["complementarity", "gap in contact"];
    assert_eq!(found(Load::Penetration(1.0), larger), both);
    let less = RIGHT.map(|p| p * (1.0 - 1e-6));
    let three = ["complementarity", "gap in contact", "overlap"];
    assert_eq!(found(Load::Penetration(1.0), less), three);
}

#[test]
fn nan_and_infinity_are_not_certified() {
    for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let certificate = judge(Load::Force(1.5), [1.0, wrong, 0.0, 0.0]);
        assert!(!certificate.is_satisfied(), "{certificate:?}");
    }
}

#[test]
fn each_condition_alone_decides() {
    let right = judge(Load::Force(1.5), RIGHT);
    let wrong = 2.0 * TOLERANCE;
    let spoilt = [
        Certificate {
            complementarity: wrong,
            ..right
        },
        Certificate {
            gap_in_contact: wrong,
            ..right
        },
        Certificate {
            overlap: wrong,
            ..right
        },
        Certificate {
            load: wrong,
            ..right
        },
        Certificate {
            min_pressure: -f64::MIN_POSITIVE,
            ..right
        },
        Certificate {
            min_pressure: f64::NAN,
            ..right
        },
    ];
    assert!(right.is_satisfied());
    for certificate in spoilt {
        assert!(!certificate.is_satisfied(), "{certificate:?}");
    }
}

proptest! {
    /// Only the correct pressure passes.
    #[test]
    fn complementarity_never_exceeds_the_largest_gap_in_contact(
        pressure in prop::array::uniform4(0.0..2.0_f64), depth in 0.1..3.0_f64,
    ) {
        for load in [Load::Penetration(depth), Load::Force(pressure.iter().sum())] {
            let certificate = judge(load, pressure);
            // Rounding of the mean.
            prop_assert!(certificate.complementarity <= certificate.gap_in_contact * (1.0 + 1e-15));
            prop_assert!(!certificate.is_satisfied());
        }
    }
}
