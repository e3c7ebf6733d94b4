//! Three blunt tips and a needle on a region of a grid, solved on few elements.

use pellicle_influence::{CoefficientTable, RadialTables, SurfaceElasticity};
use pellicle_kernel::{Foundation, Material};

use super::*;
use crate::result::certificate::Trial;

const SIZE: usize = 320;
/// Range of elements that the region must hold, along either axis.
const HELD: [usize; 2] = [40, 280];
const DEPTH: f64 = 4e-4;
/// The needle's element, which is not in the start.
const NEEDLE: [usize; 2] = [150, 90];

fn elasticity() -> Arc<SurfaceElasticity> {
    let material = Material::new(1.0, 0.0).unwrap();
    let body = Foundation::half_space(material);
    let tables = RadialTables::build(&body).unwrap();
    let table = CoefficientTable::assemble(&tables, 1.0 / SIZE as f64, SIZE).unwrap();
    Arc::new(SurfaceElasticity::new(Arc::new(table), body))
}

/// The gap of tips of radius 0.2 and of the needle, which is a twentieth of the depth higher than the tips.
fn gap([i, j]: [usize; 2]) -> f64 {
    let apart = |[k, l]: [usize; 2]| {
        let [x, y] = [i.abs_diff(k), j.abs_diff(l)].map(|along| along as f64 / SIZE as f64);
        x * x + y * y
    };
    let tips = [[60, 70], [200, 220], [80, 230]].map(|tip| apart(tip) / 0.4);
    let needle = DEPTH / 20.0 + apart(NEEDLE) / 1e-4;
    tips.into_iter().fold(needle, f64::min)
}

fn field(of: impl Fn([usize; 2]) -> f64) -> Vec<f64> {
    (0..SIZE * SIZE).map(|e| of([e / SIZE, e % SIZE])).collect()
}

fn whole(elasticity: &Arc<SurfaceElasticity>) -> DiscreteProblem {
    let area = 1.0 / (SIZE * SIZE) as f64;
    let (rigid, gap) = (field(|_| 0.0), field(gap));
    DiscreteProblem::elastic(elasticity.clone(), SIZE, rigid, gap, area).unwrap()
}

fn region(problem: &DiscreteProblem) -> Region {
    let belongs = |i: usize| (HELD[0]..HELD[1]).contains(&i);
    let region = problem.region().around(|[i, j]| belongs(i) && belongs(j));
    assert!(region.size() >= SMALLEST_REGION && !region.is_whole());
    region
}

/// A pressure on the region under each tip, but not under the needle.
fn start(region: &Region) -> Vec<f64> {
    let [above, left] = region.origin();
    let size = region.size();
    let presses = |e: usize| {
        let place = [above + e / size, left + e % size];
        let is_low = gap(place) < DEPTH / 2.0;
        is_low
            && place[0]
                .abs_diff(NEEDLE[0])
                .max(place[1].abs_diff(NEEDLE[1]))
                > 3
    };
    (0..size * size)
        .map(|e| f64::from(u8::from(presses(e))))
        .collect()
}

#[test]
fn few_elements_give_the_solution_of_the_whole_grid_from_an_incomplete_start() {
    let elasticity = elasticity();
    let options = SolverOptions::default();
    for load in [Load::Penetration(DEPTH), Load::Force(3e-6)] {
        let mut problem = whole(&elasticity);
        let region = region(&problem);
        let mut pressure = start(&region);
        let mut dilute = Dilute::around(&problem, &region, &pressure, &options).unwrap();
        let known = dilute.candidates.len();
        assert!(known < 1000);
        let mut judged = JudgedFields::on(problem.region());
        let mut judgements = 0;
        let (iterate, solution) = loop {
            let watch = &mut ();
            let mut watch = Watch::alone(watch);
            let iterate = dilute
                .solve(&problem, &pressure, load, options, &mut watch)
                .unwrap();
            let trial = Trial {
                region: &region,
                load,
                expected: iterate.penetration,
                tolerance: options.tolerance,
            };
            let found = iterate.pressure.clone();
            let solution = Solution::judge_within(&mut problem, trial, found, &mut judged);
            judgements += 1;
            if dilute.is_done(&solution, &options) {
                break (iterate, solution);
            }
            assert!(judgements < 3, "{:?}", solution.certificate);
            assert!(dilute.correct(&problem, &judged, &solution.pressure));
            pressure = solution.pressure;
        };
        assert!(solution.certificate.is_satisfied());
        // Elements that are not candidates have no pressure; the needle has become a candidate.
        let [above, left] = region.origin();
        let needle = [NEEDLE[0] - above, NEEDLE[1] - left];
        assert!(dilute.candidates.at(needle).is_some());
        assert!(solution.pressure[needle[0] * region.size() + needle[1]] > 0.0);
        assert_eq!(solution.pressure.len(), region.elements());
        assert!(dilute.candidates.len() >= known + 9);
        // The work of all passes of the last solution: one residual more than steps in each.
        assert!(iterate.contact_stiffness.is_some() && iterate.stiffness_applications > 0);
        let passes = iterate.residuals.len() - iterate.iterations;
        assert!((1..=dilute.passes).contains(&passes), "{passes}");
        assert!(iterate.operator_applications > iterate.iterations);
        // As measured with a margin of a tenth; one product on the whole grid.
        let work = [dilute.passes, judgements, iterate.operator_applications];
        assert!(work[..2] == [2, 1] && work[2] <= 14, "{work:?}");
    }
}

#[test]
fn products_among_candidates_are_corrected_from_a_judged_pressure() {
    let elasticity = elasticity();
    let mut problem = whole(&elasticity);
    let (region, options) = (region(&problem), SolverOptions::default());
    // A pressure that is not a solution, also on elements that were not candidates.
    let mut pressure = start(&region);
    let mut dilute = Dilute::around(&problem, &region, &pressure, &options).unwrap();
    let [above, left] = region.origin();
    let needle = [NEEDLE[0] - above, NEEDLE[1] - left];
    pressure[needle[0] * region.size() + needle[1]] = 0.5;
    pressure.iter_mut().for_each(|p| *p *= 1e-3);
    let mut judged = JudgedFields::on(problem.region());
    let trial = Trial {
        region: &region,
        load: Load::Penetration(DEPTH),
        expected: f64::INFINITY,
        tolerance: options.tolerance,
    };
    let solution = Solution::judge_within(&mut problem, trial, pressure, &mut judged);
    assert!(!dilute.is_done(&solution, &options));
    assert!(dilute.correct(&problem, &judged, &solution.pressure));
    // With their own products the candidates now have the gaps of the whole grid's product.
    let mut displacement = vec![0.0; SIZE * SIZE];
    problem.displace(
        &region.scatter(solution.pressure.clone()),
        &mut displacement,
    );
    let among = dilute.candidates.gather(&solution.pressure);
    let mut own = vec![0.0; among.len()];
    dilute.problem.displace(&among, &mut own);
    let gaps = dilute.problem.initial_gap();
    for (candidate, (u, g0)) in own.iter().zip(gaps).enumerate() {
        let [i, j] = region.on_grid(dilute.candidates.place(candidate));
        let wanted = displacement[i * SIZE + j] + gap([i, j]);
        assert!((u + g0 - wanted).abs() < 1e-12, "{u} {g0} {wanted}");
    }
    // Overlapping elements have become candidates: this pressure is far too small.
    let tip = dilute.candidates.at([60 - above, 70 - left]);
    assert!(tip.is_some() && dilute.candidates.at(needle).is_some());
    dilute.passes = MOST_PASSES;
    assert!(!dilute.correct(&problem, &judged, &solution.pressure));
}

#[test]
fn only_a_dilute_contact_on_a_large_free_grid_is_solved_among_candidates() {
    let elasticity = elasticity();
    let problem = whole(&elasticity);
    let region = region(&problem);
    let (pressure, options) = (start(&region), SolverOptions::default());
    let is_solved = |problem: &DiscreteProblem, region: &Region, options: &SolverOptions| {
        Dilute::around(problem, region, &pressure, options).is_some()
    };
    assert!(is_solved(&problem, &region, &options));
    let dense = SolverOptions {
        method: Method::ActiveSet,
        ..options
    };
    assert!(!is_solved(&problem, &region, &dense));
    let limited = whole(&elasticity).with_hardness(1.0).unwrap();
    assert!(!is_solved(&limited, &region, &options));
    let (rigid, gap) = (field(|_| 0.0), field(gap));
    let cell = DiscreteProblem::periodic(elasticity.clone(), rigid, gap, 1e-5).unwrap();
    assert!(!is_solved(&cell, &region, &options));
    let small = problem.region().around(|[i, j]| i.max(j) < 200);
    assert!(small.size() < SMALLEST_REGION && !is_solved(&problem, &small, &options));
    // No element presses, and all do.
    for value in [0.0, 1.0] {
        let even = vec![value; region.elements()];
        assert!(Dilute::around(&problem, &region, &even, &options).is_none());
    }
}

#[test]
fn earlier_work_is_added() {
    let iterate = |work: usize| Iterate {
        iterations: work,
        operator_applications: 10 * work,
        stiffness_applications: 100 * work,
        residuals: vec![work as f64; work],
        penetration: work as f64,
        ..Iterate::of(vec![work as f64])
    };
    let found = after(iterate(2), iterate(3));
    let wanted = Iterate {
        residuals: vec![2.0, 2.0, 3.0, 3.0, 3.0],
        pressure: vec![3.0],
        penetration: 3.0,
        ..iterate(5)
    };
    assert_eq!(found, wanted);
}
