//! Penetration D against load Q (Fig. 4).

use super::cases::{Coating, PaperCase, path};
use super::numbers::assert_reads;

/// A bend of a twentieth of the full scale is clearly visible.
const BEND: f64 = 0.05;
/// The sampled edges of cylinders make ∂D/∂Q jump by less than a hundredth.
const JUMP: f64 = 0.01;
/// A constant does not change; a bare half-space, where ∂D/∂Q ~ Q^(−1/3) throughout, changes by 21 % over the upper
/// half of the loads. A twentieth lies well between.
const CONSTANT: f64 = 0.05;
/// Penetrations are certified to about 1e-8, so differences above a millionth are real.
const DIFFERENT: f64 = 1e-6;
/// A tenth of the full scale: similar curves, not identical ones.
const SIMILAR: f64 = 0.1;

/// The four curves of Fig. 4.
const CURVES: [PaperCase; 4] = [
    PaperCase::Curve(Coating::Soft, 60),
    PaperCase::Curve(Coating::Soft, 80),
    PaperCase::Curve(Coating::Stiff, 60),
    PaperCase::Curve(Coating::Stiff, 80),
];

/// One value per load each, in order of increasing force.
pub struct LoadingCurve {
    /// Force Q.
    pub force: Vec<f64>,
    /// Penetration D.
    pub penetration: Vec<f64>,
    /// `∂D/∂Q`, the reciprocal of the contact stiffness.
    pub gradient: Vec<f64>,
    /// Largest pressure.
    pub max_pressure: Vec<f64>,
    /// Contact area.
    pub contact_area: Vec<f64>,
}

impl LoadingCurve {
    /// The curve of a case.
    pub fn of(case: PaperCase, elements: usize) -> Self {
        let steps = &path(case, elements).steps;
        Self {
            force: steps.iter().map(|step| step.solution.force).collect(),
            penetration: steps.iter().map(|step| step.solution.penetration).collect(),
            gradient: steps
                .iter()
                .map(|step| step.contact_stiffness.expect("a stiffness").recip())
                .collect(),
            max_pressure: steps.iter().map(|step| step.summary.max_pressure).collect(),
            contact_area: steps.iter().map(|step| step.summary.contact_area).collect(),
        }
    }

    /// Penetrations over the last, with their forces over the last.
    fn scaled(&self) -> impl Iterator<Item = [f64; 2]> {
        let [q, d] = [&self.force, &self.penetration].map(|list| last(list));
        (self.force.iter().zip(&self.penetration)).map(move |(force, depth)| [force / q, depth / d])
    }

    /// Relative fall of ∂D/∂Q from half of the last force to the last, and the corresponding power of Q.
    fn change_over_upper_half(&self) -> [f64; 2] {
        let half = last(&self.force) / 2.0;
        let above = self.force.partition_point(|&force| force < half);
        let [q0, q1] = [self.force[above - 1], self.force[above]];
        let [y0, y1] = [self.gradient[above - 1], self.gradient[above]];
        let at_half = y0 + (y1 - y0) * (half - q0) / (q1 - q0);
        let ratio = last(&self.gradient) / at_half;
        [1.0 - ratio, ratio.ln() / 2.0_f64.ln()]
    }
}

fn last(list: &[f64]) -> f64 {
    list[list.len() - 1]
}

/// Smallest and largest of some values.
pub fn range(values: &[f64]) -> [f64; 2] {
    let smallest = values.iter().copied().fold(f64::INFINITY, f64::min);
    [
        smallest,
        values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
    ]
}

#[test]
fn penetration_grows_nonlinearly_with_the_load() {
    let found = [
        ["19.3 %", "19.4 %"],
        ["15.8 %", "15.8 %"],
        ["15.9 %", "15.8 %"],
        ["15.1 %", "15.1 %"],
    ];
    for (case, found) in CURVES.into_iter().zip(found) {
        for (elements, written) in [256, 512].into_iter().zip(found) {
            let off: Vec<f64> = LoadingCurve::of(case, elements)
                .scaled()
                .map(|[q, d]| (d - q).abs())
                .collect();
            let [_, largest] = range(&off);
            assert_reads(largest, written);
            assert!(largest > BEND, "{case:?}");
        }
    }
}

#[test]
fn the_gradient_of_penetration_decreases_with_the_load() {
    let found = [
        ["17.7 %", "17.6 %"],
        ["16.8 %", "16.7 %"],
        ["18.1 %", "18.4 %"],
        ["21.1 %", "20.7 %"],
    ];
    for (case, found) in CURVES.into_iter().zip(found) {
        for (elements, written) in [256, 512].into_iter().zip(found) {
            let LoadingCurve { gradient, .. } = LoadingCurve::of(case, elements);
            let fall = last(&gradient) / gradient[0];
            assert_reads(fall, written);
            assert!(fall < 1.0 - JUMP, "{case:?}");
            let mut lowest = f64::INFINITY;
            for value in gradient {
                assert!(value / lowest - 1.0 <= JUMP, "{case:?} rises");
                lowest = lowest.min(value);
            }
        }
    }
}

fn assert_still_falls(case: PaperCase, found: [[&str; 2]; 2]) {
    for (elements, [change, power]) in [256, 512].into_iter().zip(found) {
        let [fall, exponent] = LoadingCurve::of(case, elements).change_over_upper_half();
        assert_reads(fall, change);
        assert_reads(exponent, power);
        assert!(fall > CONSTANT, "{case:?}");
    }
}

#[test]
fn the_gradient_of_penetration_does_not_become_constant() {
    let [soft_60, soft_80, stiff_60, stiff_80] = CURVES;
    assert_still_falls(soft_60, [["16.8 %", "-0.26"], ["16.8 %", "-0.27"]]);
    assert_still_falls(soft_80, [["24.9 %", "-0.41"], ["25.0 %", "-0.41"]]);
    assert_still_falls(stiff_60, [["23.0 %", "-0.38"]; 2]);
    assert_still_falls(stiff_80, [["20.9 %", "-0.34"]; 2]);
}

#[test]
fn within_ten_times_the_loads_the_gradient_does_not_become_constant() {
    assert_still_falls(PaperCase::Beyond(Coating::Soft), [["21.1 %", "-0.34"]; 2]);
    assert_still_falls(PaperCase::Beyond(Coating::Stiff), [["21.0 %", "-0.34"]; 2]);
}

#[test]
fn a_smaller_period_gives_a_smaller_penetration() {
    for (coating, found) in [
        (
            Coating::Soft,
            [["0 %", "17.2 %", "4.18 %"], ["0 %", "17.2 %", "4.11 %"]],
        ),
        (
            Coating::Stiff,
            [
                ["1.04 %", "14.0 %", "1.04 %"],
                ["1.05 %", "13.9 %", "1.05 %"],
            ],
        ),
    ] {
        for (elements, written) in [256, 512].into_iter().zip(found) {
            let [less, more] = [80, 60]
                .map(|periods| LoadingCurve::of(PaperCase::Curve(coating, periods), elements));
            let pairs = less.penetration.iter().zip(&more.penetration);
            let shortfall: Vec<f64> = pairs.map(|(less, more)| 1.0 - less / more).collect();
            let [smallest, largest] = range(&shortfall);
            for (found, written) in [smallest, largest, last(&shortfall)]
                .into_iter()
                .zip(written)
            {
                assert_reads(found, written);
            }
            // While only the central cylinder is in contact, the period cannot matter.
            assert!(
                smallest >= -DIFFERENT && last(&shortfall) > DIFFERENT,
                "{coating:?}"
            );
        }
    }
}

#[test]
fn the_curves_of_the_soft_and_the_stiff_coating_are_similar() {
    for (periods, found) in [
        (60, [["4.01 %", "4.04"], ["4.08 %", "4.04"]]),
        (80, [["1.42 %", "4.17"], ["1.46 %", "4.17"]]),
    ] {
        for (elements, [apart, deeper]) in [256, 512].into_iter().zip(found) {
            let [soft, stiff] = [Coating::Soft, Coating::Stiff]
                .map(|coating| LoadingCurve::of(PaperCase::Curve(coating, periods), elements));
            let pairs = soft.scaled().zip(stiff.scaled());
            let distances: Vec<f64> = pairs
                .map(|([_, one], [_, other])| (one - other).abs())
                .collect();
            let [_, largest] = range(&distances);
            assert_reads(largest, apart);
            assert_reads(last(&stiff.penetration) / last(&soft.penetration), deeper);
            assert!(largest < SIMILAR, "R/{periods}");
        }
    }
}
