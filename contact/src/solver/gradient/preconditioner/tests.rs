//! The choice of a preconditioner, and its distance from the inverse.

use std::{f64::consts::TAU, sync::Arc};

use pellicle_influence::{CoefficientTable, RadialTables, SurfaceElasticity};
use pellicle_kernel::{Foundation, Material};

use super::*;
use crate::{
    Load,
    solver::{
        gradient::{load_control::LoadControl, tests::begun},
        tests::{RIGID, SIZE, paraboloid, problem as of_coating},
    },
};

const ELEMENTS: usize = SIZE * SIZE;

#[test]
fn neighbours_grow_with_the_grid_from_a_few_hundred_elements_up_to_a_bound() {
    let contrasts = [1.0, 2.0 * STIFF_FOR_GROWTH, 2.0 * VERY_STIFF];
    let of = |size| contrasts.map(|contrast| neighbours(size, contrast));
    assert_eq!(of(1), [42, 42, 60]);
    assert_eq!(of(COARSE), [42, 42, 60]);
    assert_eq!(of(3 * COARSE / 2), [66, 72, 103]);
    assert_eq!(of(2 * COARSE), [93, 105, 108]);
    assert_eq!(of(16 * COARSE), [108; 3]);
}

#[test]
fn the_stiffness_contrast_is_the_response_to_long_waves_over_that_to_short_ones() {
    let contrast = |body: Foundation, size: usize| {
        let tables = RadialTables::build(&body).unwrap();
        let table = CoefficientTable::assemble(&tables, 1.0 / size as f64, size).unwrap();
        stiffness_contrast(&SurfaceElasticity::new(Arc::new(table), body).symbol(size))
    };
    let material = |young| Material::new(young, 0.3).unwrap();
    let half_space = || Foundation::half_space(material(1.0));
    let coated = |young| Foundation::coated(0.02, material(young), material(1.0)).unwrap();
    // The stiffness is the same for all waves. The element's own shape has a small effect.
    assert!((contrast(half_space(), 128) - 1.0).abs() < 0.1);
    // The longest wave of 1 reaches the base below a coating of 0.02; the shortest of 1/64 stays in the coating.
    let [stiff, soft] = [8.0, 0.125].map(|young| contrast(coated(young), 128));
    assert!(stiff > 5.0 && stiff < 8.0, "{stiff}");
    assert!(soft > 0.125 && soft < 0.25, "{soft}");
    assert_eq!(contrast(coated(8.0), 4), 1.0);
}

/// A bare coating takes a fifth more products with Newton's method first.
#[test]
fn newton_comes_first_with_the_filter_where_springs_lie_on_a_stiff_coating() {
    let is_for_newton = |stiffness: f64, springs: f64| {
        let problem = of_coating([stiffness, 0.1], paraboloid, |_, _| springs);
        let symbol = problem.elasticity().unwrap().symbol(SIZE);
        let preconditioner = Preconditioner::new(&problem, Shortcuts::ALL);
        assert!(matches!(preconditioner.inverse, Inverse::Filter(_)));
        (stiffness_contrast(&symbol), preconditioner.is_for_newton())
    };
    for (stiffness, springs, wanted) in [(20.0, 0.0, false), (20.0, 1e-3, true), (2.0, 1e-3, false)]
    {
        let (contrast, found) = is_for_newton(stiffness, springs);
        assert_eq!(contrast > STIFF_FOR_NEWTON, stiffness > 2.0, "{contrast}");
        assert_eq!(found, wanted, "{stiffness} {springs}");
    }
}

#[test]
fn the_residual_is_zero_outside_the_set() {
    let mut problem = of_coating([1.0, 0.1], paraboloid, RIGID);
    let control = LoadControl::of(&problem, Load::Penetration(0.02));
    let pressure: Vec<f64> = (0..ELEMENTS).map(|e| (e as f64).sin().max(0.0)).collect();
    let (mut state, mut set) = begun(&mut problem, control, &pressure);
    set.keep_pressing(&mut state);
    let mut residual = SparseField::new(ELEMENTS);
    residual_into(&state, &set, &mut residual);
    for (e, found) in residual.iter().enumerate() {
        let wanted = if pressure[e] > 0.0 {
            state.penetration - state.v[e]
        } else {
            0.0
        };
        assert_eq!(*found, wanted);
    }
}

/// A set of six hundred elements in islands, too many for the direct solution.
fn islands(problem: &mut DiscreteProblem) -> (State, WorkingSet) {
    let control = LoadControl::of(problem, Load::Penetration(0.0));
    let in_set = |e: usize| {
        let (i, j) = (e / SIZE, e % SIZE);
        (i / 5 + j / 7) % 5 < 3
    };
    let pressure: Vec<f64> = (0..ELEMENTS)
        .map(|e| f64::from(u8::from(in_set(e))) * (1.0 + (e as f64).sin() / 2.0))
        .collect();
    let (mut state, mut set) = begun(problem, control, &pressure);
    set.keep_pressing(&mut state);
    assert_eq!(set.len(), pressure.iter().filter(|p| **p > 0.0).count());
    (state, set)
}

/// The relative distance of `M⁻¹_I (K + η)_I p` from `p` in the norm `√(pᵀ (K + η)_I p)` in which conjugate gradients
/// converge.
fn distance_from_inverse(problem: &mut DiscreteProblem, times: usize) -> f64 {
    let (state, set) = islands(problem);
    let mut preconditioner = Preconditioner::new(problem, Shortcuts::ALL);
    assert!(preconditioner.turn_to_factor(problem, times));
    preconditioner.follow(problem, &set);
    let mut z = vec![0.0; ELEMENTS];
    problem.deform_to_scale(&state.pressure, &mut z);
    preconditioner.apply(&set, &mut z);
    let error: Vec<f64> = z.iter().zip(&state.pressure).map(|(z, p)| z - p).collect();
    let mut norm = |p: &[f64]| {
        let mut v = vec![0.0; ELEMENTS];
        problem.deform_to_scale(p, &mut v);
        p.iter().zip(&v).map(|(p, v)| p * v).sum::<f64>().sqrt()
    };
    norm(&error) / norm(&state.pressure)
}

/// Multiples of the usual neighbours; the last is more than there are elements.
const TIMES_NEIGHBOURS: [usize; 4] = [1, 2, 5, 15];
/// The condition number of the rigid set's system, from its eigenvalues.
const CONDITION: f64 = 318.0;
/// Half of the last digit in single precision, in which the factor is computed and applied.
const HALF_DIGIT: f64 = f32::EPSILON as f64 / 2.0;

#[test]
fn the_sparse_factor_tends_to_the_inverse_with_more_neighbours() {
    let error =
        |times| distance_from_inverse(&mut of_coating([10.0, 0.05], paraboloid, RIGID), times);
    let errors = TIMES_NEIGHBOURS.map(error);
    assert!(
        errors.is_sorted_by(|fewer, more| more < fewer),
        "{errors:?}"
    );
    assert!(errors[3] < CONDITION * HALF_DIGIT, "{errors:?}");
}

/// With springs, near elements screen far ones less, so the same neighbours leave a larger error. With all neighbours
/// only the error of the classes remains: the factor is `(K + η̃)⁻¹`, and `|η − η̃| ≤ (2^(1/32) − 1) η̃`.
#[test]
fn the_sparse_factor_tends_to_the_inverse_with_springs_of_many_compliances() {
    let springs = |x: f64, y: f64| 0.01 * (2.0 + (9.0 * x).sin() + (7.0 * y).cos());
    let error =
        |times| distance_from_inverse(&mut of_coating([10.0, 0.05], paraboloid, springs), times);
    let errors = TIMES_NEIGHBOURS.map(error);
    assert!(
        errors.is_sorted_by(|fewer, more| more < fewer),
        "{errors:?}"
    );
    assert!(errors[3] < (1.0_f64 / 32.0).exp2() - 1.0, "{errors:?}");
}

#[test]
fn a_small_set_with_springs_is_solved_exactly() {
    let springs = |x: f64, y: f64| 0.01 * (2.0 + (9.0 * x).sin() + (7.0 * y).cos());
    let mut problem = of_coating([10.0, 0.05], paraboloid, springs);
    let control = LoadControl::of(&problem, Load::Penetration(0.0));
    let pressure: Vec<f64> = (0..ELEMENTS)
        .map(|e| f64::from(u8::from(e % 7 == 0)) * (1.0 + (e as f64).sin() / 2.0))
        .collect();
    let (mut state, mut set) = begun(&mut problem, control, &pressure);
    set.keep_pressing(&mut state);
    let mut preconditioner = Preconditioner::new(&problem, Shortcuts::ALL);
    assert!(preconditioner.turn_to_factor(&problem, 1));
    preconditioner.follow(&problem, &set);
    let mut z = vec![0.0; ELEMENTS];
    problem.deform_to_scale(&state.pressure, &mut z);
    preconditioner.apply(&set, &mut z);
    for (found, wanted) in z.iter().zip(&state.pressure) {
        assert!((found - wanted).abs() < 1e-11, "{found} {wanted}");
    }
}

#[test]
fn on_all_elements_the_filter_divides_a_wave_by_its_symbol() {
    let bare = of_coating([0.5, 0.1], paraboloid, |_, _| 0.0);
    let symbol = bare.elasticity().unwrap().symbol(SIZE);
    // A compliance that the filter does not round.
    let compliance = 1.1_f64.powi(-3) * symbol.value([SIZE / 2; 2]);
    let problem = of_coating([0.5, 0.1], paraboloid, |_, _| compliance);
    let control = LoadControl::of(&problem, Load::Penetration(1.0));
    let mut problem = problem;
    let (_, set) = begun(&mut problem, control, &[1.0; ELEMENTS]);
    assert_eq!(set.len(), ELEMENTS);
    let mut filter = RestrictedFilter::new(symbol.clone(), &problem.region());
    filter.update(&set, problem.springs().compliance());
    for [a, b] in [[0, 1], [3, 0], [2, 5], [16, 16], [7, 16]] {
        let wave = |e: usize| {
            let phase = a * (e / SIZE) + b * (e % SIZE);
            (TAU * phase as f64 / SIZE as f64).cos()
        };
        let mut field: Vec<f64> = (0..ELEMENTS).map(wave).collect();
        filter.apply(&set, &mut field);
        let wanted = 1.0 / (symbol.value([a, b]) + compliance);
        for (e, found) in field.iter().enumerate() {
            // Single precision, and sums of 1024 elements in single precision.
            assert!(
                (found - wanted * wave(e)).abs() < 1e-5 * wanted,
                "{a} {b} {e}"
            );
        }
    }
}
