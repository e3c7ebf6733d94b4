//! The value of a key at which a number of the result meets its limit.

mod folder;
mod questions;

use std::f64::consts::PI;
use std::sync::Arc;

use pellicle::case::BaseCase;
use pellicle::case::map_sources::MapSources;
use pellicle::input::span::Source;
use pellicle::memory::MemoryBudget;
use pellicle::run::Resources;
use pellicle_influence::Cache;
use pellicle_study::find::answer::{Answer, Extreme, Verdict};
use pellicle_study::find::tried::Tried;
use pellicle_study::find::{Means, Question, Search, WITHIN};

/// A rigid ball on steel, E* = 226.4 GPa, under 1 N: p₀ = 0.73 GPa.
const BALL: &str = r#"
[foundation]
substrate = { young_modulus = "206 GPa", poisson_ratio = 0.3 }
[indenter]
kind = "paraboloid"
radius = "5 mm"
[load]
force = "1 N"
[grid]
elements = 64
"#;

/// Pillars under a ball.
const TEXTURE: &str = r#"
[foundation]
substrate = { young_modulus = "206 GPa", poisson_ratio = 0.3 }
[surface]
kind = "cylinders"
radius = "10 um"
height = "2 um"
area_fraction = 0.3
[indenter]
kind = "paraboloid"
radius = "50 mm"
[load]
force = "5 N"
[grid]
elements = 64
"#;

fn base(text: &str) -> BaseCase {
    let source = Arc::new(Source::new("case.toml", text.to_owned()));
    BaseCase::parse(&source, "case", MapSources::default()).unwrap()
}

fn question(condition: &str, key: &str, between: Option<[&str; 2]>) -> Question {
    let source = |name: &str, text: &str| Arc::new(Source::new(name, text.to_owned()));
    Question {
        condition: source("--find", condition),
        key: source("--by", key),
        between: between.map(|ends| ends.map(|end| source("--between", end))),
        within: WITHIN,
    }
}

fn search(text: &str, condition: &str, key: &str, between: Option<[&str; 2]>) -> Search {
    Search::new(base(text), &question(condition, key, between)).unwrap()
}

fn run(search: &Search, before: Vec<Tried>) -> (Answer, Vec<Tried>) {
    let (cache, memory) = (Cache::in_memory(), MemoryBudget::default());
    let means = Means {
        resources: Resources {
            cache: &cache,
            memory: &memory,
            writers: 0,
        },
        monitor: &(),
        keep: &|_| Ok(()),
    };
    let (answer, tried) = search.run(before, means).unwrap();
    (answer.unwrap(), tried)
}

/// `E* = E/(1 − ν²)` of the ball's case, Pa.
const MODULUS: f64 = 206e9 / (1.0 - 0.3 * 0.3);

/// The answer contains this value, which is its own to the width of the search, after at most so many cases.
fn assert_found(found: &(Answer, Vec<Tried>), exact: f64, extreme: Extreme, cases: usize) {
    let (answer, tried) = found;
    assert_eq!(
        (answer.verdict, answer.extreme),
        (Verdict::Found, Some(extreme))
    );
    let ([low, high], value) = (answer.interval.unwrap(), answer.value.unwrap());
    assert!(
        low <= exact && exact <= high,
        "{exact:e} in {low:e} to {high:e}"
    );
    assert!(
        low <= value && value <= high,
        "{value:e} in {low:e} to {high:e}"
    );
    // The ± of the pressure at N = 64 is some 0.1 %, a third of that of the force.
    assert!((high - low) / exact < 0.05, "{low:e} to {high:e}");
    assert!(tried.len() <= cases, "{} cases: {tried:#?}", tried.len());
}

#[test]
fn the_largest_force_below_a_pressure_is_that_of_hertz() {
    // p₀ = (6 Q E*²/(π³ R²))^(1/3), Johnson, Contact Mechanics, (4.24)
    let (limit, radius) = (1e9_f64, 5e-3_f64);
    let exact = PI.powi(3) * radius.powi(2) * limit.powi(3) / (6.0 * MODULUS.powi(2));
    let found = run(
        &search(BALL, "max_pressure < 1 GPa", "load.force", None),
        vec![],
    );
    assert_found(&found, exact, Extreme::Largest, 8);
}

#[test]
fn the_smallest_radius_below_a_pressure_is_that_of_hertz() {
    let exact = (6.0 * MODULUS.powi(2) / (PI.powi(3) * 1e9_f64.powi(3))).sqrt();
    let between = Some(["1 mm", "10 mm"]);
    let search = search(BALL, "max pressure <= 1 GPa", "indenter.radius", between);
    assert_found(&run(&search, vec![]), exact, Extreme::Smallest, 8);
}

#[test]
fn a_condition_above_a_limit_holds_from_its_answer() {
    // a² = R D: a contact area of 100 µm² is a penetration of A/(π R), of a rigid ball.
    let text = BALL.replace("force = \"1 N\"", "penetration = \"5 nm\"");
    let search = search(&text, "contact_area > 100 um^2", "load.penetration", None);
    assert_found(
        &run(&search, vec![]),
        1e-10 / (PI * 5e-3),
        Extreme::Smallest,
        8,
    );
}

#[test]
fn a_fraction_of_a_texture_is_searched_up_to_what_the_lattice_allows() {
    let search = search(
        TEXTURE,
        "mean_pressure < 300 MPa",
        "surface.area_fraction",
        None,
    );
    // Discs of a square lattice touch at π/4; the ends of the range are allowed values.
    assert!(
        search.range[0] > 0.0299 && search.range[1] < PI / 4.0,
        "{:?}",
        search.range
    );
    let (answer, tried) = run(&search, vec![]);
    assert_eq!(
        answer.extreme,
        Some(Extreme::Smallest),
        "{answer:?} {tried:#?}"
    );
    let value = answer.value.unwrap();
    assert!((0.1..0.7).contains(&value), "{value}");
    assert_eq!(answer.interval, None);
    assert!(
        answer.notes.iter().any(|note| note.contains("has no ±")),
        "{answer:?}"
    );
}

/// The search by the critical force of a body of 0.3 GPa, under a load of 1 N, among radii from 2 mm.
fn search_by_yield(condition: &str, largest: &str) -> (Answer, Vec<Tried>) {
    let text = BALL.replace(
        "poisson_ratio = 0.3",
        "poisson_ratio = 0.3, yield_strength = \"0.3 GPa\"",
    ) + "[stress]\nonly = [\"max_von_mises\"]\n";
    let text = text.replace("elements = 64", "elements = 32");
    let between = Some(["2 mm", largest]);
    run(
        &search(&text, condition, "indenter.radius", between),
        vec![],
    )
}

/// The error of the smallest radius whose ball lets the body yield above 0.3 N; the load of 1 N reaches the strength up
/// to a radius of 7.4 mm.
fn error_of_radius(largest: &str) -> f64 {
    let (answer, tried) = search_by_yield("critical_force yield substrate > 0.3 N", largest);
    assert_eq!(
        answer.extreme,
        Some(Extreme::Smallest),
        "{answer:?} {tried:#?}"
    );
    // Q_y ∝ R², and p₀ = 1.613 Y at first yield for ν = 0.3 (Johnson, (4.27): 1.60 to three digits).
    let p0: f64 = 1.613 * 0.3e9;
    let exact = (6.0 * 0.3 * MODULUS.powi(2) / (PI.powi(3) * p0.powi(3))).sqrt();
    answer.value.unwrap() / exact - 1.0
}

#[test]
fn a_critical_force_is_a_number_like_any_other() {
    let error = error_of_radius("7 mm");
    assert!(error.abs() < 0.02, "{error:e}");
}

#[test]
fn a_critical_force_above_all_loads_is_larger_than_any_limit_below_them() {
    let error = error_of_radius("80 mm");
    assert!(error.abs() < 0.02, "{error:e}");
}

#[test]
fn a_critical_force_above_all_loads_says_nothing_of_a_limit_above_them() {
    let (answer, _) = search_by_yield("critical_force yield substrate > 3 N", "80 mm");
    assert_eq!(answer.verdict, Verdict::Blocked);
    let notes = answer.notes.concat();
    assert!(
        notes.contains("up to its load, 1.0000 N, which is below the limit"),
        "{notes}"
    );
    assert!(
        notes.contains("holds at neither of the outermost values that count"),
        "{notes}"
    );
}

#[test]
fn no_crossing_is_told_with_the_numbers_at_both_ends() {
    let (answer, tried) = run(
        &search(BALL, "max_pressure < 30 GPa", "load.force", None),
        vec![],
    );
    assert_eq!(
        (answer.verdict, answer.value),
        (Verdict::HoldsAtBothEnds, None)
    );
    assert_eq!(tried.len(), 2);
    let note = &answer.notes[0];
    assert!(
        note.contains("load.force = 100.00 mN") && note.contains("10.000 N"),
        "{note}"
    );
    let (answer, _) = run(
        &search(BALL, "max_pressure > 30 GPa", "load.force", None),
        vec![],
    );
    assert_eq!(answer.verdict, Verdict::HoldsAtNeitherEnd);
}

#[test]
fn a_case_that_is_not_certified_is_never_a_number() {
    // A domain of 60 µm cuts the contact off above some force.
    let text = BALL.replace("elements = 64", "elements = 64\nside = \"60 um\"");
    let search = search(
        &text,
        "max_pressure < 20 GPa",
        "load.force",
        Some(["0.1 N", "1 kN"]),
    );
    let (answer, tried) = run(&search, vec![]);
    assert_ne!(answer.verdict, Verdict::Found, "{tried:#?}");
    assert!(
        answer.notes.iter().any(|note| note.contains("is cut-off")),
        "{:?}",
        answer.notes
    );
}

/// Valleys between pillars that are reached at some force.
const VALLEYS: &str = r#"
[foundation]
substrate = { young_modulus = "206 GPa", poisson_ratio = 0.3 }
[surface]
kind = "cylinders"
radius = "10 um"
height = "20 nm"
period = "30 um"
[indenter]
kind = "paraboloid"
radius = "5 mm"
[load]
force = "0.5 N"
[grid]
side = "100 um"
elements = 64
"#;

/// Asserts that an answer is the one step of an area of zero, of which nothing says how exact it is.
#[track_caller]
fn assert_step((answer, tried): &(Answer, Vec<Tried>), extreme: Extreme) -> f64 {
    assert_eq!(
        (answer.verdict, answer.extreme, answer.interval),
        (Verdict::Found, Some(extreme), None),
        "{answer:?} {tried:#?}"
    );
    let note = answer.notes.last().unwrap();
    assert!(
        note.starts_with("no interval: contact area between leaves zero between load.force = "),
        "{note}"
    );
    let value = answer.value.unwrap();
    let area = |tried: &&Tried| tried.number.unwrap() > 0.0;
    let first = tried.iter().filter(area).map(|tried| tried.key);
    let last = tried.iter().filter(|tried| !area(tried));
    let last = last.map(|tried| tried.key).fold(0.0, f64::max);
    let first = first.fold(f64::INFINITY, f64::min);
    assert!(
        last < value && value < first,
        "{value:e} in {last:e} to {first:e}"
    );
    assert!(first / last < 1.0 + 1.01 * WITHIN, "{last:e} to {first:e}");
    // Both ends, and log₂(ln(40)/10⁻³) = 11.8 halvings.
    assert!(tried.len() <= 14, "{} cases", tried.len());
    value
}

#[test]
fn an_area_above_zero_begins_where_the_valleys_touch() {
    let between = Some(["50 mN", "2 N"]);
    let of = |condition| search(VALLEYS, condition, "load.force", between);
    let above = run(&of("contact_area_between > 0"), vec![]);
    let value = assert_step(&above, Extreme::Smallest);
    let at_most = run(&of("contact_area_between <= 0"), above.1);
    let largest = assert_step(&at_most, Extreme::Largest);
    assert_eq!(value.to_bits(), largest.to_bits());
    // Nothing is below zero, and everything at least zero.
    let (answer, tried) = run(&of("contact_area_between < 0"), at_most.1);
    assert_eq!(
        (answer.verdict, tried.len()),
        (Verdict::HoldsAtNeitherEnd, 2)
    );
    let (answer, _) = run(&of("contact_area_between >= 0"), tried);
    assert_eq!(answer.verdict, Verdict::HoldsAtBothEnds);
}
