//! Contact whose pressure is cut at a hardness: against closed forms, an independent method, and itself.

#![expect(
    clippy::unwrap_used,
    reason = "a scene that cannot be built fails its test"
)]

use std::f64::consts::PI;
use std::sync::Arc;

use pellicle_contact::{
    ActiveSetSolver, ContactError, DiscreteProblem, Domain, FlatPunch, GradientSolver, Indenter,
    Load, LoadingPath, Model, Paraboloid, Solution, Solver, SolverOptions, Step, Watch, reference,
    solve_path,
};
use pellicle_influence::{
    Cache, CoefficientTable, ElasticOperator, RadialTables, SurfaceElasticity,
};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::Relief;

const SIDE: f64 = 1.0;

/// A coat of relative stiffness and thickness on a body of modulus 1, or the body alone.
fn body(coat: Option<[f64; 2]>) -> Foundation {
    let base = Material::new(1.0, 0.3).unwrap();
    match coat {
        None => Foundation::half_space(base),
        Some([stiffness, thickness]) => {
            Foundation::coated(thickness, Material::new(stiffness, 0.3).unwrap(), base).unwrap()
        }
    }
}

fn elasticity(foundation: Foundation, size: usize) -> Arc<SurfaceElasticity> {
    let tables = RadialTables::build(&foundation).unwrap();
    let table = CoefficientTable::assemble(&tables, SIDE / size as f64, size).unwrap();
    Arc::new(SurfaceElasticity::new(Arc::new(table), foundation))
}

/// A field by the places of the elements.
fn sample(size: usize, of: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    let centre = |i: usize| (i as f64 + 0.5) * SIDE / size as f64 - SIDE / 2.0;
    let elements = 0..size * size;
    elements
        .map(|e| of(centre(e / size), centre(e % size)))
        .collect()
}

/// A paraboloid with grooves across.
fn grooved(x: f64, y: f64) -> f64 {
    f64::midpoint(x * x, y * y) + 0.004 * (23.0 * x + 5.0 * y).sin()
}

fn solve(solver: &mut impl Solver, problem: &mut DiscreteProblem, load: Load) -> Solution {
    let start = vec![0.0; problem.elements()];
    let iterate = solver
        .solve(problem, load, &start, &mut Watch::alone(&mut ()))
        .unwrap();
    let solution = Solution::judge(problem, load, iterate.pressure, 1e-8);
    let certificate = solution.certificate;
    assert!(certificate.is_satisfied(), "{certificate:?}");
    solution
}

/// The pressure under a penetration by Gauss–Seidel, each value cut to `0 ≤ p ≤ p_max`: slow, and nothing but the
/// conditions themselves.
fn cut_gauss_seidel(
    elasticity: &SurfaceElasticity,
    eta: &[f64],
    gap: &[f64],
    [penetration, limit]: [f64; 2],
) -> Vec<f64> {
    let size = elasticity.size();
    let coefficient = |e: usize, f: usize| {
        elasticity.coefficient([(e / size).abs_diff(f / size), (e % size).abs_diff(f % size)])
    };
    let elements = size * size;
    let matrix: Vec<Vec<f64>> = (0..elements)
        .map(|e| (0..elements).map(|f| coefficient(e, f)).collect())
        .collect();
    let mut pressure = vec![0.0; elements];
    for _ in 0..100_000 {
        let mut change = 0.0_f64;
        for e in 0..elements {
            let u: f64 = matrix[e].iter().zip(&pressure).map(|(k, p)| k * p).sum();
            let g = u + eta[e] * pressure[e] + gap[e] - penetration;
            let next = (pressure[e] - g / (matrix[e][e] + eta[e])).clamp(0.0, limit);
            change = change.max((next - pressure[e]).abs());
            pressure[e] = next;
        }
        if change < 1e-13 * limit {
            return pressure;
        }
    }
    panic!("Gauss–Seidel does not converge")
}

#[test]
fn an_independent_method_finds_the_same_pressures_under_either_load() {
    let size = 14;
    for (coat, limit) in [
        (None, 0.05),
        (Some([10.0, 0.05]), 0.1),
        (Some([0.1, 0.1]), 0.01),
    ] {
        let elasticity = elasticity(body(coat), size);
        let own = elasticity.coefficient([0, 0]);
        for softness in [0.0, 0.5] {
            let eta = sample(size, |x, _| if x < 0.1 { softness * own } else { 0.0 });
            let gap = sample(size, grooved);
            let wanted = cut_gauss_seidel(&elasticity, &eta, &gap, [0.03, limit]);
            let at_limit = wanted.iter().filter(|p| **p == limit).count();
            let free = wanted.iter().filter(|p| **p > 0.0 && **p < limit).count();
            assert!(
                at_limit >= 3 && free >= 3,
                "{at_limit} at the limit, {free} free"
            );
            let area = (SIDE / size as f64).powi(2);
            let mut problem = DiscreteProblem::elastic(elasticity.clone(), size, eta, gap, area)
                .unwrap()
                .with_hardness(limit)
                .unwrap();
            let force = area * wanted.iter().sum::<f64>();
            for load in [Load::Penetration(0.03), Load::Force(force)] {
                for found in [
                    solve(&mut GradientSolver::default(), &mut problem, load),
                    solve(&mut ActiveSetSolver::default(), &mut problem, load),
                ] {
                    for (found, wanted) in found.pressure.iter().zip(&wanted) {
                        // The certificate's 1e-8 of a penetration of several limits' displacements.
                        assert!((found - wanted).abs() < 1e-6 * limit, "{found} {wanted}");
                    }
                    assert!((found.penetration - 0.03).abs() < 1e-8);
                    assert!((found.force / force - 1.0).abs() < 1e-7);
                }
            }
        }
    }
}

/// A body that does not move.
struct Rigid(usize);

impl ElasticOperator for Rigid {
    fn size(&self) -> usize {
        self.0
    }

    fn apply_into(&mut self, _: &[f64], displacement: &mut [f64]) {
        displacement.fill(0.0);
    }
}

#[test]
fn on_springs_alone_the_penetration_is_a_straight_line_of_the_force() {
    // p = min((D − ρ²/2R)/η, p_max), so Q = π R (2 D p_max − η p_max²) from D = η p_max on.
    let (radius, eta, limit) = (1.0, 0.1, 0.2);
    let mut errors = Vec::new();
    for size in [32, 128] {
        let gap = sample(size, |x, y| f64::midpoint(x * x, y * y) / radius);
        let area = (SIDE / size as f64).powi(2);
        let springs = vec![eta; size * size];
        let mut problem = DiscreteProblem::new(Box::new(Rigid(size)), springs, gap.clone(), area)
            .unwrap()
            .with_hardness(limit)
            .unwrap();
        for penetration in [0.03, 0.1] {
            let solution = solve(
                &mut GradientSolver::default(),
                &mut problem,
                Load::Penetration(penetration),
            );
            for (p, g0) in solution.pressure.iter().zip(&gap) {
                let wanted = ((penetration - g0) / eta).clamp(0.0, limit);
                assert!((p - wanted).abs() < 1e-7 * limit, "{p} {wanted}");
            }
            let force = PI * radius * limit * (2.0 * penetration - eta * limit);
            let by_force = solve(
                &mut GradientSolver::default(),
                &mut problem,
                Load::Force(force),
            );
            errors.push((by_force.penetration / penetration - 1.0).abs());
        }
    }
    // Sums over the centres of elements: second order but for the kinks at the edges.
    assert!(
        errors[0] < 3e-3 && errors[2] < 3e-4 && errors[3] < 3e-4,
        "{errors:?}"
    );
}

#[test]
fn a_punch_sinks_by_no_more_than_it_must_where_every_element_is_at_the_limit() {
    let (size, limit) = (24, 0.03);
    let elasticity = elasticity(body(None), size);
    let gap = sample(
        size,
        |x, y| if x.hypot(y) < 0.3 { 0.0 } else { f64::INFINITY },
    );
    let count = gap.iter().filter(|gap| **gap == 0.0).count();
    let area = (SIDE / size as f64).powi(2);
    let mut problem = DiscreteProblem::elastic(elasticity, size, vec![0.0; size * size], gap, area)
        .unwrap()
        .with_hardness(limit)
        .unwrap();
    let most = limit * area * count as f64;
    let mut before = 0.0;
    for part in [0.5, 0.9, 0.99, 1.0] {
        let mut solver = GradientSolver::default();
        let solution = solve(&mut solver, &mut problem, Load::Force(part * most));
        assert!(solution.penetration > before, "{part}");
        before = solution.penetration;
        if part == 1.0 {
            let pressed: Vec<f64> = solution
                .pressure
                .iter()
                .copied()
                .filter(|p| *p > 0.0)
                .collect();
            assert_eq!((pressed.len(), pressed), (count, vec![limit; count]));
            let mut v = vec![0.0; size * size];
            problem.deform_into(&solution.pressure, &mut v);
            let deepest = v.iter().copied().fold(0.0, f64::max);
            // two products of the same pressure on grids of different size
            assert!((solution.penetration / deepest - 1.0).abs() < 1e-12);
        }
    }
    let start = vec![0.0; size * size];
    let refused = GradientSolver::default().solve(
        &mut problem,
        Load::Force(1.001 * most),
        &start,
        &mut Watch::alone(&mut ()),
    );
    assert!(
        matches!(refused, Err(ContactError::BeyondHardness { .. })),
        "{refused:?}"
    );
}

#[test]
fn a_hardness_that_is_none_is_refused() {
    let elasticity = elasticity(body(None), 8);
    let problem = || {
        DiscreteProblem::elastic(elasticity.clone(), 8, vec![0.0; 64], vec![0.0; 64], 1.0).unwrap()
    };
    for hardness in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = problem().with_hardness(hardness).err();
        assert!(
            matches!(refused, Some(ContactError::Hardness { .. })),
            "{hardness}"
        );
    }
    for hardness in [0.0, -1.0, f64::NAN] {
        let options = SolverOptions {
            hardness,
            ..SolverOptions::default()
        };
        assert!(options.checked_for(8).is_err(), "{hardness}");
    }
}

fn model(indenter: impl Into<Indenter>) -> Model {
    Model {
        tables: Arc::new(RadialTables::build(&body(None)).unwrap()),
        relief: Relief::Bare,
        indenter: indenter.into(),
        cache: Cache::none(),
    }
}

/// A contact of Hertz's of radius 0.2, cut at a part of its peak: force and peak.
fn hertz() -> (f64, f64) {
    let hertz = reference::hertz::from_contact_radius(1.0, 1.0 / (1.0 - 0.3 * 0.3), 0.2);
    (hertz.force, hertz.peak_pressure)
}

fn path(part: f64, domain: Domain, elements: usize, options: SolverOptions) -> LoadingPath {
    let (force, peak) = hertz();
    let options = SolverOptions {
        hardness: part * peak,
        ..options
    };
    let paraboloid = model(Paraboloid::new(1.0).unwrap());
    let path = solve_path(
        &paraboloid,
        domain,
        elements,
        &[Load::Force(force)],
        &options,
        &mut (),
    );
    path.unwrap()
}

fn step(part: f64, elements: usize) -> Step {
    let mut path = path(part, Domain::Side(SIDE), elements, SolverOptions::default());
    let step = path.steps.remove(0);
    assert!(
        step.solution.certificate.is_satisfied(),
        "{:?}",
        step.solution.certificate
    );
    step
}

#[test]
fn a_lower_hardness_lets_the_indenter_sink_deeper_over_more_of_the_contact() {
    let (force, peak) = hertz();
    let mut before: Option<Step> = None;
    for part in [1.1, 0.9, 0.6, 0.4, 0.3] {
        let step = step(part, 64);
        let summary = step.summary;
        assert!(summary.max_pressure <= part * peak);
        assert_eq!(summary.area_at_limit > 0.0, part < 1.0);
        assert_eq!(summary.plastic_depth > 0.0, part < 1.0);
        if let Some(before) = before {
            assert!(step.solution.penetration >= before.solution.penetration);
            assert!(summary.contact_area >= before.summary.contact_area * (1.0 - 1e-9));
            assert!(summary.area_at_limit >= before.summary.area_at_limit);
            assert!(summary.plastic_depth >= before.summary.plastic_depth);
            assert!(step.contact_stiffness.unwrap() > 0.0);
        }
        assert!(summary.area_at_limit * part * peak <= force);
        before = Some(step);
    }
}

#[test]
fn a_hardness_above_the_peak_changes_nothing() {
    let (elastic, cut) = (step(f64::INFINITY, 64), step(1.1, 64));
    let difference = cut.solution.penetration / elastic.solution.penetration - 1.0;
    // both certified to 1e-8
    assert!(difference.abs() < 2e-8, "{difference}");
    assert_eq!(
        cut.summary.contact_elements,
        elastic.summary.contact_elements
    );
}

#[test]
fn far_beyond_the_limit_the_contact_area_is_force_over_hardness() {
    let (force, peak) = hertz();
    for (part, bound) in [(0.25, 1e-3), (0.15, 5e-4)] {
        let step = step(part, 256);
        let (summary, wanted) = (step.summary, force / (part * peak));
        // The edge of the contact within half an element at the limit, scattered along a circle of 100 to 130 of them;
        // beside it a rim of one element.
        assert!((summary.contact_area / wanted - 1.0).abs() < bound);
        assert!((0.995..1.0).contains(&(summary.area_at_limit / wanted)));
        // Found 35 and 53.
        let products = step.work.operator_applications;
        assert!(products <= 60, "{products}");
    }
}

#[test]
fn numbers_converge_with_the_grid() {
    let steps = [32, 64, 128, 256].map(|elements| step(0.6, elements));
    let changes = |number: fn(&Step) -> f64| {
        let values = steps.each_ref().map(number);
        [1, 2, 3].map(|i| ((values[i] - values[i - 1]) / values[3]).abs())
    };
    let penetration = changes(|step| step.solution.penetration);
    let depth = changes(|step| step.summary.plastic_depth);
    assert!(
        penetration[2] < 0.5 * penetration[0] && penetration[2] < 1e-4,
        "{penetration:?}"
    );
    assert!(depth[2] < 0.5 * depth[0] && depth[2] < 1e-3, "{depth:?}");
    let area = changes(|step| step.summary.contact_area);
    assert!(area[2] < 2e-3, "{area:?}");
}

#[test]
fn quadrant_window_and_dense_method_agree_on_a_path() {
    let quadrant = step(0.5, 48);
    let options = SolverOptions {
        mirror_symmetry: false,
        ..SolverOptions::default()
    };
    let dense = SolverOptions {
        method: pellicle_contact::Method::ActiveSet,
        ..options
    };
    for options in [options, dense] {
        let other = path(0.5, Domain::Side(SIDE), 48, options).steps.remove(0);
        assert!(other.solution.certificate.is_satisfied());
        let peak = other.summary.max_pressure;
        for (one, other) in quadrant
            .solution
            .pressure
            .iter()
            .zip(&other.solution.pressure)
        {
            assert!((one - other).abs() < 1e-5 * peak, "{one} {other}");
        }
        let stiffness = quadrant.contact_stiffness.unwrap() / other.contact_stiffness.unwrap();
        // The sum's own accuracy, and a few elements within rounding of the limit.
        assert!((stiffness - 1.0).abs() < 1e-3, "{stiffness}");
    }
}

#[test]
fn a_chosen_domain_holds_the_plastic_contact() {
    let (force, peak) = hertz();
    // A contact of √(Q/π p_max), 2.3 times Hertz's radius.
    let path = path(0.125, Domain::Automatic, 64, SolverOptions::default());
    let step = &path.steps[0];
    assert_eq!(step.status(), pellicle_contact::Status::Certified);
    assert!(step.summary.contact_area > force / (0.125 * peak));
}

#[test]
fn a_punch_that_its_hardness_does_not_carry_is_refused_before_anything_is_solved() {
    let punch = model(FlatPunch::new(0.3).unwrap());
    let options = SolverOptions {
        hardness: 0.1,
        ..SolverOptions::default()
    };
    let load = [Load::Force(0.2 * PI * 0.3 * 0.3)];
    for domain in [Domain::Side(SIDE), Domain::Automatic] {
        let refused = solve_path(&punch, domain, 64, &load, &options, &mut ()).unwrap_err();
        assert!(
            matches!(refused, ContactError::BeyondHardness { .. }),
            "{refused}"
        );
    }
}

#[test]
fn a_cell_under_nine_tenths_of_its_hardness_is_all_but_closed() {
    let paraboloid = model(Paraboloid::new(1.0).unwrap());
    let options = SolverOptions {
        hardness: 0.1,
        ..SolverOptions::default()
    };
    let load = [Load::Force(0.09 * SIDE * SIDE)];
    let path = solve_path(
        &paraboloid,
        Domain::Periodic(SIDE),
        32,
        &load,
        &options,
        &mut (),
    )
    .unwrap();
    let step = &path.steps[0];
    assert!(
        step.solution.certificate.is_satisfied(),
        "{:?}",
        step.solution.certificate
    );
    assert!(step.summary.contact_area > 0.9 && step.summary.area_at_limit > 0.3);
    let more = [Load::Force(0.11 * SIDE * SIDE)];
    let refused = solve_path(
        &paraboloid,
        Domain::Periodic(SIDE),
        32,
        &more,
        &options,
        &mut (),
    );
    assert!(matches!(refused, Err(ContactError::BeyondHardness { .. })));
}

#[test]
fn tamaas_finds_the_same_contact() {
    // Tamaas 2.9.0, KatoSaturated on the non-periodic operator "dcfft" to 1e-13, E* = 1/0.91, 64² elements of a square
    // of side 1: elements in contact and at the limit, penetration and plastic depth from its pressure and operator,
    // whose gaps in contact are below 1e-11 of the penetration.
    for (part, in_contact, at_limit, penetration, plastic_depth) in [
        (
            0.6,
            616,
            532,
            0.042_722_155_480_277,
            0.010_487_780_110_249_5,
        ),
        (
            0.3,
            1160,
            1124,
            0.058_916_055_470_818_8,
            0.036_089_176_988_518_5,
        ),
    ] {
        let step = step(part, 64);
        let summary = step.summary;
        let elements = summary.area_at_limit * 64.0 * 64.0;
        assert_eq!(
            (summary.contact_elements, elements),
            (in_contact, f64::from(at_limit))
        );
        // our certificate's 1e-8
        assert!((step.solution.penetration / penetration - 1.0).abs() < 1e-8);
        assert!((summary.plastic_depth / plastic_depth - 1.0).abs() < 1e-7);
    }
}
