//! Curves alone, in pairs and all together, best first.

use pellicle_identify::{Expected, NullDirections, Role};

use super::candidate::CandidateCurve;
use super::design::{DesignResult, ExpectedResult, better};
use super::{Judged, Planning};
use crate::failure::Failure;
use crate::identification::findings::CombinationResult;

/// Number of pairs reported, the best ones.
const PAIRS: usize = 10;

/// Returns the designs, best first: each curve alone, the best pairs, and all together.
///
/// # Errors
///
/// [`Failure`] if a number is not finite.
pub fn designs(of: &Planning<'_>) -> Result<Vec<DesignResult>, Failure> {
    let count = of.judged.len();
    let design = |chosen: Vec<usize>| of.design(&chosen);
    let single = (0..count).map(|i| vec![i]);
    let mut designs = single.map(design).collect::<Result<Vec<_>, _>>()?;
    let pair = |i: usize| (i + 1..count).map(move |j| vec![i, j]);
    let pairs = (0..count).flat_map(pair).map(design);
    let mut pairs = pairs.collect::<Result<Vec<_>, _>>()?;
    pairs.sort_by(better);
    pairs.truncate(PAIRS);
    designs.extend(pairs);
    if count > 2 {
        designs.push(design((0..count).collect())?);
    }
    designs.sort_by(better);
    Ok(designs)
}

impl Planning<'_> {
    /// Evaluates the design of some of the curves.
    fn design(&self, chosen: &[usize]) -> Result<DesignResult, Failure> {
        let chosen: Vec<&Judged> = chosen.iter().map(|i| &self.judged[*i]).collect();
        let directions: Vec<NullDirections> =
            chosen.iter().map(|of| of.directions.clone()).collect();
        let directions = NullDirections::common(&directions)?;
        let information: Vec<_> = chosen.iter().map(|of| &of.information).collect();
        let premises = &self.premises;
        let level = premises.file.report.level;
        let all = premises.plan.expected(&information, &directions, level)?;
        let own = premises.place_of_radius();
        let of_case = |index: usize| {
            let expected = match own {
                Some(place) if place == index => radius(&all, &chosen, place),
                _ => &all[index],
            };
            (expected.role, self.result(index, expected))
        };
        let (sought, nuisances): (Vec<_>, Vec<_>) = (0..premises.cases().len())
            .map(of_case)
            .partition(|(role, _)| *role == Role::Sought);
        let without_role = |all: Vec<(Role, ExpectedResult)>| {
            let all = all.into_iter();
            all.map(|(_, expected)| expected).collect()
        };
        let curves = chosen.iter().map(|of| of.candidate.clone());
        Ok(DesignResult {
            curves: curves.collect::<Vec<CandidateCurve>>(),
            unknowns: without_role(sought),
            nuisances: without_role(nuisances),
        })
    }

    fn result(&self, index: usize, of: &Expected) -> ExpectedResult {
        let case = &self.premises.cases()[index];
        let finite = |value: f64| Some(value).filter(|value| value.is_finite());
        ExpectedResult {
            key: case.key.clone(),
            unit: case.unit().into(),
            value: of.value,
            standard_error: finite(of.standard_error),
            factor: finite(of.half_width.exp()),
            interval: of.interval,
            verdict: of.verdict.to_string(),
            known_combination: of.known_combination.as_ref().map(CombinationResult::from),
        }
    }
}

/// Of several unknown indenter radii, the one with the largest standard error.
fn radius<'a>(all: &'a [Expected], curves: &[&Judged], own: usize) -> &'a Expected {
    let places = curves.iter().flat_map(|of| &of.radii);
    let least = places
        .map(|place| &all[*place])
        .max_by(|one, other| one.standard_error.total_cmp(&other.standard_error));
    least.unwrap_or(&all[own])
}
