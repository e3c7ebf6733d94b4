//! Each part of the iteration against its documentation, on a grid of 32 by 32 elements.

use pellicle_influence::{Sector, SectorGrid};

use crate::solver::gradient::best_pressure::BestPressure;
use crate::solver::gradient::load_control::LoadControl;
use crate::solver::gradient::preconditioner::Preconditioner;
use crate::solver::gradient::state::State;
use crate::solver::gradient::steps::face::FaceDescent;
use crate::solver::gradient::steps::newton::Newton;
use crate::solver::gradient::steps::segment::Segment;
use crate::solver::gradient::steps::{Context, outcome::StepOutcome};
use crate::solver::gradient::working_set::WorkingSet;
use crate::{
    DiscreteProblem, Load, Shortcuts,
    grid::region::Region,
    solver::tests::{RIGID, SIZE, paraboloid, pillars, problem},
    vector::{add_scaled, dot, sum},
};

const ELEMENTS: usize = SIZE * SIZE;

/// Most products for a plate on pillars by the descent from face to face.
const MOST_ON_FACES: usize = 400;

fn plate() -> DiscreteProblem {
    problem([1000.0, 0.01], |x, y| pillars(x, y, 0.002), RIGID)
}

/// The state that starts from a pressure, and its working set.
pub fn begun(
    problem: &mut DiscreteProblem,
    control: LoadControl,
    pressure: &[f64],
) -> (State, WorkingSet) {
    let mut state = State::new(problem);
    state.start(problem, control, pressure);
    let mut set = WorkingSet::new(pressure.len());
    set.start(&mut state);
    (state, set)
}

fn start(problem: &mut DiscreteProblem, load: Load) -> (State, WorkingSet) {
    let control = LoadControl::of(problem, load);
    begun(problem, control, &[0.0; ELEMENTS])
}

#[test]
fn newtons_method_alone_solves_a_plate_on_pillars() {
    // Products as measured, with a margin of a tenth.
    for (load, most) in [(Load::Force(1e-2), 63), (Load::Penetration(0.02), 18)] {
        let mut problem = plate();
        let (mut state, mut set) = start(&mut problem, load);
        let mut preconditioner = Preconditioner::new(&problem, Shortcuts::ALL);
        let mut newton = Newton::new(ELEMENTS);
        newton.restart();
        let mut segment = Segment::new(ELEMENTS);
        let mut exchanges = 0;
        while state.residual().0 > 1e-9 || !state.residual().1 {
            let mut context = Context {
                problem: &mut problem,
                state: &mut state,
                set: &mut set,
                preconditioner: &mut preconditioner,
                segment: &mut segment,
            };
            let outcome = newton.step(&mut context, 1e-9);
            assert_ne!(outcome, StepOutcome::Failed);
            exchanges += usize::from(outcome == StepOutcome::Exchanged);
            assert!(state.applications() <= most, "{exchanges} exchanges");
        }
    }
}

#[test]
fn descent_from_face_to_face_alone_solves_a_plate_on_pillars() {
    for load in [Load::Force(1e-2), Load::Penetration(0.02)] {
        let mut problem = plate();
        let (mut state, mut set) = start(&mut problem, load);
        let mut preconditioner = Preconditioner::new(&problem, Shortcuts::ALL);
        let mut faces = FaceDescent::new(ELEMENTS);
        let mut segment = Segment::new(ELEMENTS);
        faces.begin(&state);
        let mut energy = state.energy();
        while state.residual().0 > 1e-9 || !state.residual().1 {
            let products = state.applications();
            faces.step(&mut Context {
                problem: &mut problem,
                state: &mut state,
                set: &mut set,
                preconditioner: &mut preconditioner,
                segment: &mut segment,
            });
            if set.take_moves() > 0 && state.residual().1 {
                // Rounding of the energy.
                assert!(state.energy() <= energy + 1e-12 * energy.abs());
                energy = state.energy();
            }
            assert!(state.applications() <= products + 1);
            assert!(products < MOST_ON_FACES, "{:?}", state.residual());
        }
    }
}

#[test]
fn a_solver_that_gives_up_returns_the_best_admissible_pressure() {
    let mut problem = problem([1.0, 0.1], paraboloid, RIGID);
    let control = LoadControl::of(&problem, Load::Penetration(0.01));
    let mut state = |pressure: f64| begun(&mut problem, control, &[pressure; ELEMENTS]).0;
    let mut offered = |residuals: &[f64], last: State, residual: f64| {
        let mut best = BestPressure::new();
        for (i, offer) in residuals.iter().enumerate() {
            best.offer(&state(1.0 + i as f64), *offer);
        }
        best.or(&last, residual)[0]
    };
    let mut other = plate();
    let mut last = |pressure: f64| {
        let mut state = begun(&mut other, control, &[0.0; ELEMENTS]).0;
        state.pressure.fill(pressure);
        state
    };
    // Exact: the values are copies.
    let found = [
        offered(&[0.5, 0.1, 0.3], last(9.0), 0.2),
        offered(&[0.5, 0.3], last(9.0), 0.7),
        offered(&[0.5, 0.1], last(9.0), 0.05),
        offered(&[0.5, 0.1], last(-9.0), 0.05),
        offered(&[], last(-9.0), 0.05),
    ];
    // The second is not copied unless it is twice as good.
    assert_eq!(found, [2.0, 1.0, 9.0, 2.0, -9.0]);
}

#[test]
fn the_energy_along_a_step_is_the_parabola_of_its_slope_and_curvature() {
    for load in [Load::Force(1e-2), Load::Penetration(0.02)] {
        let mut problem = plate();
        let (mut state, _) = start(&mut problem, load);
        state.press_anywhere();
        let direction: Vec<f64> = (0..ELEMENTS).map(|e| (e as f64).sin()).collect();
        let mut segment = Segment::new(ELEMENTS);
        segment.clip(&state, 1.0, &direction);
        let (before, slope) = (state.energy(), segment.slope(&state));
        // With an unreachable ceiling the whole step is taken.
        assert_eq!(
            segment.take(&mut problem, &mut state, f64::INFINITY),
            StepOutcome::Clipped
        );
        let wanted = before + slope + segment.curvature() / 2.0;
        assert!((state.energy() / wanted - 1.0).abs() < 1e-10);
        // v is the deformation of the pressure itself.
        let kept = state.v.clone();
        state.refresh(&mut problem);
        let largest = kept.iter().copied().fold(0.0, f64::max);
        let errors = kept.iter().zip(&state.v).map(|(a, b)| (a - b).abs());
        assert!(errors.fold(0.0, f64::max) < 1e-12 * largest);
    }
}

#[test]
fn a_step_that_would_raise_the_energy_is_cut_at_its_minimum() {
    let mut problem = plate();
    let (mut state, _) = start(&mut problem, Load::Penetration(0.02));
    let downhill: Vec<f64> = state
        .v
        .iter()
        .map(|v| 1e3 * (state.penetration - v))
        .collect();
    let mut segment = Segment::new(ELEMENTS);
    segment.clip(&state, 1.0, &downhill);
    let (before, slope) = (state.energy(), segment.slope(&state));
    assert!(slope < 0.0);
    let mut image = [0.0; ELEMENTS];
    problem.deform_to_scale(&segment.step, &mut image);
    // E − s·∂E²/(2 s·y)
    let wanted = before - slope * slope / (2.0 * dot(&segment.step, &image));
    assert_eq!(
        segment.take(&mut problem, &mut state, before),
        StepOutcome::Cut
    );
    assert!((state.energy() - wanted).abs() < 1e-10 * wanted.abs());
}

#[test]
fn under_a_penetration_a_pressure_is_scaled_to_the_least_energy() {
    let depth = 0.02;
    let mut problem = plate();
    let control = LoadControl::of(&problem, Load::Penetration(depth));
    let gaps = problem.initial_gap().iter().enumerate();
    let within = |g0: f64| if g0 < depth / 2.0 { 1e-4 } else { 0.0 };
    let one: Vec<f64> = gaps
        .map(|(e, g0)| within(*g0) * (1.5 + (e as f64).sin()))
        .collect();
    let (mut state, _) = begun(&mut problem, control, &one);
    assert!(state.keeps_total());
    // D = Σ p v / Σ p, and v is the deformation of the pressure itself.
    let mean = dot(&state.pressure, &state.v) / sum(&state.pressure);
    let length = problem.scale().length;
    assert!((mean * length / depth - 1.0).abs() < 1e-13);
    let (least, scaled) = (state.energy(), state.pressure.clone());
    for factor in [0.99, 1.01] {
        state.pressure = scaled.iter().map(|p| factor * p).collect();
        problem.deform_to_scale(&state.pressure, &mut state.v);
        add_scaled(&mut state.v, 1.0, &state.initial_gap);
        assert!(state.energy() > least);
    }
    // A direction made conjugate does not change the mean.
    let (mut state, _) = begun(&mut problem, control, &one);
    state.press_anywhere();
    let mut direction: Vec<f64> = (0..ELEMENTS).map(|e| (0.3 * e as f64).cos()).collect();
    state.deflate(&mut direction);
    let mut image = [0.0; ELEMENTS];
    state.image_into(&mut problem, &direction, &mut image);
    assert!(dot(&state.pressure, &image).abs() < 1e-12 * dot(&direction, &image));
    // A step includes the growth of the pressure after it.
    let mut segment = Segment::new(ELEMENTS);
    segment.clip(&state, 1e-5, &direction);
    let before = [state.pressure.clone(), state.v.clone()];
    segment.take(&mut problem, &mut state, f64::INFINITY);
    for ((after, before), step) in [&state.pressure, &state.v]
        .into_iter()
        .zip(&before)
        .zip([&*segment.step, &segment.image[..]])
    {
        let largest = step.iter().map(|s| s.abs()).fold(0.0, f64::max);
        for ((after, before), step) in after.iter().zip(before).zip(step) {
            assert!((after - before - step).abs() < 1e-9 * largest);
        }
    }
    // Above the surface no scale works.
    let control = LoadControl::of(&problem, Load::Penetration(-depth));
    let (state, _) = begun(&mut problem, control, &one);
    let unit = problem.scale().pressure();
    let as_given = state
        .pressure
        .iter()
        .zip(&one)
        .all(|(p, one)| p * unit == *one);
    assert!(!state.keeps_total() && as_given);
}

#[test]
fn a_set_touches_the_border_if_any_of_its_elements_does() {
    let mut problem = problem([1.0, 0.1], paraboloid, RIGID);
    let control = LoadControl::of(&problem, Load::Penetration(-1.0));
    let last = SIZE - 1;
    // On the whole grid, and on a quadrant.
    for (i, j, touches) in [
        (0, 9, [true, false]),
        (9, 0, [true, false]),
        (last, 9, [true; 2]),
        (9, last, [true; 2]),
        (0, 0, [true, false]),
        (0, last, [true; 2]),
        (last, last, [true; 2]),
        (1, 1, [false; 2]),
        (last - 1, last - 1, [false; 2]),
        (9, 1, [false; 2]),
    ] {
        let mut pressure = [0.0; ELEMENTS];
        pressure[i * SIZE + j] = 1.0;
        let (_, set) = begun(&mut problem, control, &pressure);
        assert_eq!(set.len(), 1);
        let found = [Sector::Whole, Sector::Quadrant]
            .map(|sector| set.holds_any(Region::all_of(SectorGrid::new(sector, SIZE)).rim()));
        assert_eq!(found, touches, "{i} {j}");
    }
}

#[test]
fn the_contact_may_continue_beyond_a_part_of_the_grid_and_not_beyond_all_of_it() {
    let problem = problem([1.0, 0.1], paraboloid, RIGID);
    assert!(!problem.support().may_grow());
    let whole = Region::whole(SIZE);
    let region = whole.around(|place| place == [16, 16]);
    assert!(problem.part(&region).unwrap().support().may_grow());
    assert!(!problem.part(&whole).unwrap().support().may_grow());
}

#[test]
fn a_pressure_of_the_wrong_scale_is_balanced_by_the_growth_returned() {
    let depth = 0.02;
    let mut problem = problem([1.0, 0.1], paraboloid, RIGID);
    let control = LoadControl::of(&problem, Load::Penetration(depth));
    let touches = |g0: &f64| f64::from(u8::from(*g0 < depth / 2.0));
    let one: Vec<f64> = problem.initial_gap().iter().map(touches).collect();
    let (mut state, _) = begun(&mut problem, control, &one);
    let balanced = state.pressure.clone();
    for factor in [1e-3, 0.5, 2.0] {
        // v belongs to the pressure, as after a step.
        state.pressure = balanced.iter().map(|p| factor * p).collect();
        problem.deform_to_scale(&state.pressure, &mut state.v);
        add_scaled(&mut state.v, 1.0, &state.initial_gap);
        let products = state.applications();
        let growth = state.balance(&mut problem);
        assert!(
            ((1.0 + growth) * factor - 1.0).abs() < 1e-10,
            "{factor}: {growth}"
        );
        // More than tenfold takes a product.
        assert_eq!(state.applications() - products, usize::from(factor < 0.1));
        for (found, wanted) in state.pressure.iter().zip(&balanced) {
            assert!((found - wanted).abs() <= 1e-10 * wanted);
        }
    }
}
