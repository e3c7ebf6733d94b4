//! Wear of random patterns: each distance is certified, the volume is that of Archard, and no depth is negative.

use pellicle_contact::wear::{Wear, solve_wear};
use pellicle_contact::{ContactError, Load, SolverOptions, Status};
use pellicle_influence::Cache;
use rayon::prelude::*;

use super::case::Case;
use super::view::View;
use super::{Outcome, SI, refused};

/// Number of cases in the short form, and the most elements per side.
const SHORT: u64 = 8;
const MOST_ELEMENTS: usize = 32;
/// Largest depths of wear over the penetration of the unworn contact.
const DEPTHS: [f64; 2] = [1e-2, 3.0];
/// Tolerance of the depths.
const TOLERANCE: f64 = 1e-2;

/// The outcome of the wear of a case, whose contacts without wear are certified.
fn outcome(seed: u64) -> Option<Outcome> {
    let mut case = Case::draw_made(seed, MOST_ELEMENTS, View::plain(SI));
    let options = SolverOptions::default();
    let unworn = case.solve(&options).ok()?;
    let step = &unworn.steps[0];
    // Recesses may leave nothing to touch.
    if step.status() != Status::Certified || step.summary.max_pressure == 0.0 {
        return None;
    }
    case.domain = pellicle_contact::Domain::Chosen(unworn.grid.side());
    let mut random = super::random::Random(seed);
    let depth = step.solution.penetration.abs() * random.decades(DEPTHS[0], DEPTHS[1]);
    let wear = Wear {
        coefficient: depth / step.summary.max_pressure,
        distances: vec![0.0, 0.1, 1.0],
        tolerance: TOLERANCE,
    };
    let mut model = case.model().ok()?;
    model.cache = Cache::in_memory();
    let (domain, elements) = (case.domain, case.elements);
    let path = solve_wear(
        &model,
        domain,
        elements,
        case.load,
        &wear,
        &options,
        &mut (),
    );
    let path = match path {
        Ok(path) => path,
        Err(ContactError::WearOfStiffening) => {
            return Some(Outcome::Refused("springs that stiffen"));
        }
        Err(error) => return Some(refused(&error)),
    };
    let mut products = 0;
    for step in &path.steps {
        let Some(worn) = &step.wear else {
            return Some(Outcome::Failed("no wear".to_owned()));
        };
        products += worn.products;
        // k Q s, unless a part does not wear or the force changes.
        let wanted = wear.coefficient * step.solution.force * worn.distance;
        let is_exact = worn.unwearing == 0.0 && matches!(case.load, Load::Force(_));
        let within = if is_exact {
            1e-10 * wanted
        } else {
            f64::INFINITY
        };
        let is_right = (worn.volume - wanted).abs() <= within
            && worn
                .depth
                .iter()
                .all(|depth| *depth >= 0.0 && depth.is_finite())
            && step.summary.max_pressure.is_finite();
        if !is_right {
            let how = format!("{:e} worn, wanted {wanted:e}", worn.volume);
            return Some(Outcome::Failed(how));
        }
        match step.status() {
            Status::Certified | Status::BeyondModel if worn.is_certified => {}
            Status::CutOff => return Some(Outcome::CutOff),
            status => {
                let how = format!("{status:?}, stages {}", worn.is_certified);
                return Some(Outcome::Failed(how));
            }
        }
    }
    let last = path.steps.last()?;
    let numbers = [last.solution.penetration, last.solution.force];
    let numbers = [
        numbers[0],
        numbers[1],
        last.summary.contact_area,
        last.summary.max_pressure,
    ];
    Some(Outcome::Certified(numbers, products))
}

#[test]
fn wear_of_every_random_case_is_certified_or_refused_with_a_reason() {
    let count = std::env::var("PELLICLE_RANDOM_CASES");
    let count: u64 = count.map_or(SHORT, |count| count.parse().unwrap());
    let outcomes: Vec<(u64, Outcome)> = (0..count)
        .into_par_iter()
        .filter_map(|seed| Some((seed, outcome(seed)?)))
        .collect();
    let describe = |seed| {
        format!(
            "{:?}",
            Case::draw_made(seed, MOST_ELEMENTS, View::plain(SI))
        )
    };
    let products = super::tally("wear", outcomes, describe);
    assert!(2 * products.len() as u64 > count, "{}", products.len());
}
