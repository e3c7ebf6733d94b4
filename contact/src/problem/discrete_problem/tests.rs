//! Fields and areas that a discrete problem rejects.

use std::sync::Arc;

use pellicle_influence::{CoefficientTable, ElasticOperator, RadialTables, SurfaceElasticity};
use pellicle_kernel::{Foundation, Material};

use super::DiscreteProblem;
use super::fields::{VALUES_AT_ONCE, check_values, is_rough};
use crate::{
    ContactError,
    grid::candidates::{Candidates, elements_where},
    problem::gap_scale::GapScale,
};

/// `u = 2 p`.
struct Springs;

impl ElasticOperator for Springs {
    fn size(&self) -> usize {
        2
    }

    fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        for (u, p) in displacement.iter_mut().zip(pressure) {
            *u = 2.0 * p;
        }
    }
}

fn problem(eta: &[f64], gap: &[f64], area: f64) -> Result<DiscreteProblem, ContactError> {
    DiscreteProblem::new(Box::new(Springs), eta.to_vec(), gap.to_vec(), area)
}

#[test]
fn a_problem_returns_its_data() {
    let (eta, gap) = ([0.5, 0.0, 1.0, 3.0], [0.0, 1.0, f64::INFINITY, -2.0]);
    let mut problem = problem(&eta, &gap, 0.25).unwrap();
    assert_eq!((problem.size(), problem.elements()), (2, 4));
    assert_eq!(problem.relief_compliance(), eta);
    assert_eq!(problem.initial_gap(), gap);
    assert_eq!(problem.element_area().to_bits(), 0.25_f64.to_bits());
    assert!(problem.elasticity().is_none() && !problem.support().may_grow());
    // (K + η) p, with powers of two.
    let mut deformation = [0.0; 4];
    problem.deform_into(&[1.0, 2.0, 4.0, 0.5], &mut deformation);
    assert_eq!(deformation, [2.5, 4.0, 12.0, 2.5]);
}

#[test]
fn added_springs_are_linear_whatever_the_law_of_the_relief_and_can_be_removed() {
    let pressure = [1.0, 2.0, 4.0, 0.5];
    let law = pellicle_texture::SpringLaw::logarithmic(2.0).unwrap();
    for law in [pellicle_texture::SpringLaw::LINEAR, law] {
        let problem = problem(&[0.5, 0.0, 1.0, 3.0], &[0.0; 4], 0.25).unwrap();
        let mut problem = problem.with_spring_law(law);
        let mut state = |added: f64| {
            problem.soften(added);
            let mut deformation = [0.0; 4];
            problem.deform_into(&pressure, &mut deformation);
            problem.linearise_springs(&pressure);
            (deformation, problem.springs().compliance().to_vec())
        };
        let without = state(0.0);
        let (deformation, tangents) = state(0.25);
        for e in 0..4 {
            assert!((deformation[e] - without.0[e] - 0.25 * pressure[e]).abs() < 1e-14);
            assert!((tangents[e] - without.1[e] - 0.25).abs() < 1e-14);
        }
        assert_eq!(state(0.0), without);
    }
}

#[test]
fn invalid_field_values_are_refused_with_their_element() {
    let (zeros, nan) = ([0.0; 4], f64::NAN);
    for (found, bad) in [(3, &[0.0; 3][..]), (5, &[0.0; 5])] {
        for outcome in [problem(bad, &zeros, 1.0), problem(&zeros, bad, 1.0)] {
            assert!(matches!(
                outcome,
                Err(ContactError::FieldLength { found: f, wanted: 4, .. }) if f == found
            ));
        }
    }
    for bad in [-1e-300, nan, f64::INFINITY] {
        let refused = problem(&[0.0, 1.0, bad, 0.0], &zeros, 1.0);
        assert!(matches!(
            refused,
            Err(ContactError::FieldValue { element: 2, .. })
        ));
    }
    for bad in [nan, f64::NEG_INFINITY] {
        let refused = problem(&zeros, &[0.0, bad, 0.0, 0.0], 1.0);
        assert!(matches!(
            refused,
            Err(ContactError::FieldValue { element: 1, .. })
        ));
    }
}

#[test]
fn of_many_invalid_values_the_first_is_reported() {
    let mut values = vec![1.0; 3 * VALUES_AT_ONCE];
    let check = |values: &[f64]| check_values("field", values, "positive", |value| value > 0.0);
    assert!(check(&values).is_ok());
    for wrong in [2 * VALUES_AT_ONCE + 5, VALUES_AT_ONCE + 9, VALUES_AT_ONCE] {
        values[wrong] = -2.0;
        assert!(matches!(
            check(&values),
            Err(ContactError::FieldValue { element, found: -2.0, .. }) if element == wrong
        ));
    }
}

#[test]
fn areas_must_be_positive_and_some_element_must_be_able_to_touch() {
    for area in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = problem(&[0.0; 4], &[0.0; 4], area);
        assert!(matches!(refused, Err(ContactError::ElementArea { .. })));
    }
    let refused = problem(&[0.0; 4], &[f64::INFINITY; 4], 1.0);
    assert!(matches!(
        refused,
        Err(ContactError::NothingCanTouch { elements: 4 })
    ));
}

#[test]
fn a_surface_is_rough_if_three_elements_in_ten_are_crests() {
    let size = 20;
    let gap = |of: fn(usize, usize) -> f64| -> Vec<f64> {
        (0..size * size).map(|e| of(e / size, e % size)).collect()
    };
    let smooth = gap(|i, j| (i as f64 - 9.5).powi(2) + (j as f64 - 9.5).powi(2));
    let every_other = gap(|i, j| ((i + j) % 2) as f64);
    let every_fourth = gap(|i, j| ((i % 2) * (j % 2)) as f64);
    let third = gap(|i, j| f64::from(u8::from((i + j) % 3 == 0)));
    let saddle = gap(|i, j| (i * i) as f64 - 1.01 * (j * j) as f64);
    let found = [smooth, every_other, every_fourth, third, saddle].map(|gap| is_rough(size, &gap));
    assert_eq!(found, [false, true, false, true, true]);
}

/// The problem of a flat surface on a half-space of 4 × 4 elements of side 1/4, or of a cell of it.
fn on_half_space(is_cell: bool, gap: &[f64]) -> DiscreteProblem {
    let body = Foundation::half_space(Material::new(1.0, 0.0).unwrap());
    let tables = RadialTables::build(&body).unwrap();
    let table = CoefficientTable::assemble(&tables, 0.25, 4).unwrap();
    let elasticity = Arc::new(SurfaceElasticity::new(Arc::new(table), body));
    let (eta, gap, area) = (vec![0.0; 16], gap.to_vec(), 0.0625);
    let problem = if is_cell {
        DiscreteProblem::periodic(elasticity, eta, gap, area)
    } else {
        DiscreteProblem::elastic(elasticity, 4, eta, gap, area)
    };
    problem.unwrap()
}

#[test]
fn gaps_of_a_cell_are_scaled_by_its_longest_wave_and_those_of_a_free_surface_are_not() {
    let [free, cell] = [false, true].map(|is_cell| on_half_space(is_cell, &[0.0; 16]).gap_scale());
    assert_eq!(free, GapScale::Penetration);
    let GapScale::Cell { mean, longest } = cell else {
        panic!("{cell:?}");
    };
    // C = 2/(E* k) at k = 2π, for a cell of side 1; the mean of a half-space is left out.
    assert!((longest * std::f64::consts::PI - 1.0).abs() < 1e-9);
    assert_eq!(mean, 0.0);
}

#[test]
fn replacing_the_gap_also_updates_the_roughness() {
    let flat = vec![0.0; 16];
    let board: Vec<f64> = (0..16).map(|e| f64::from((e / 4 + e % 4) % 2)).collect();
    let mut problem = on_half_space(false, &flat);
    assert!(!problem.is_rough());
    problem.take_initial_gap(board.clone());
    assert_eq!(problem.initial_gap(), board);
    assert!(problem.is_rough());
}

#[test]
fn among_candidates_the_fields_are_those_of_their_elements_on_the_grid() {
    let size = 300;
    let body = Foundation::half_space(Material::new(1.0, 0.3).unwrap());
    let tables = RadialTables::build(&body).unwrap();
    let table = CoefficientTable::assemble(&tables, 1.0 / size as f64, size).unwrap();
    let elasticity = Arc::new(SurfaceElasticity::new(Arc::new(table), body));
    let eta: Vec<f64> = (0..size * size).map(|e| e as f64).collect();
    let gap: Vec<f64> = eta.iter().map(|e| 1.0 + 3.0 * e).collect();
    let problem = DiscreteProblem::elastic(elasticity, size, eta, gap, 1.0).unwrap();
    // One element and its neighbours in each of rows 20 and 70 of a region away from the corner.
    let region = problem
        .region()
        .around(|[i, j]| (20..240).contains(&i) && (30..250).contains(&j));
    let [above, left] = region.origin();
    assert!(above != left && above > 0);
    let members = elements_where(region.size(), |element| {
        [[20, 31], [70, 12]].contains(&element)
    });
    let candidates = Candidates::around(region.size(), &members);
    let candidates = Arc::new(candidates);
    let part = problem.among(&region, &candidates).unwrap();
    assert_eq!(
        (part.elements(), part.support().candidates().unwrap().len()),
        (18, 18)
    );
    for candidate in 0..18 {
        let [row, column] = candidates.place(candidate);
        let element = ((above + row) * size + left + column) as f64;
        assert_eq!(part.relief_compliance()[candidate], element);
        assert_eq!(part.initial_gap()[candidate], 1.0 + 3.0 * element);
    }
}

/// The problem of a flat surface on a coating on 64 × 64 elements of side 1/64.
fn on_coating(stiffness: f64, thickness: f64) -> DiscreteProblem {
    let [coating, base] = [stiffness, 1.0].map(|young| Material::new(young, 0.3).unwrap());
    let body = Foundation::coated(thickness, coating, base).unwrap();
    let tables = RadialTables::build(&body).unwrap();
    let table = CoefficientTable::assemble(&tables, 1.0 / 64.0, 64).unwrap();
    let elasticity = Arc::new(SurfaceElasticity::new(Arc::new(table), body));
    let field = vec![0.0; 4096];
    DiscreteProblem::elastic(elasticity, 64, field.clone(), field, 1.0 / 4096.0).unwrap()
}

#[test]
fn the_stiffness_contrast_exceeds_one_only_under_a_stiff_coating() {
    assert!((on_coating(1.0, 0.1).stiffness_contrast() - 1.0).abs() < 1e-9);
    // The shortest wave, of two elements, stays in the coating; one of 64 is hardly affected by a thin coating.
    let (stiff, soft) = (on_coating(20.0, 0.05), on_coating(0.05, 0.05));
    let contrast = stiff.stiffness_contrast();
    assert!(contrast > 2.0 && contrast < 20.0, "{contrast}");
    let contrast = soft.stiffness_contrast();
    assert!(contrast > 0.05 && contrast < 0.5, "{contrast}");
    // The longer the wave relative to the coating, the greater the effect of the base.
    assert!(on_coating(20.0, 0.03).stiffness_contrast() > stiff.stiffness_contrast());
}

#[test]
fn the_identity_of_a_problem_changes_with_its_data() {
    let problem = || on_half_space(false, &[0.0; 16]);
    let (one, other) = (problem(), problem());
    assert!(one.identity() == one.identity());
    assert!(one.identity() != other.identity());
    let kept = one.identity().clone();
    assert!(*one.identity() == kept);
    let stiffening = one.with_spring_law(pellicle_texture::SpringLaw::logarithmic(1.0).unwrap());
    assert!(*stiffening.identity() != kept);
    let kept = stiffening.identity().clone();
    let mut limited = stiffening.with_hardness(1.0).unwrap();
    assert!(*limited.identity() != kept);
    let kept = limited.identity().clone();
    limited.take_initial_gap(vec![1.0; 16]);
    assert!(*limited.identity() != kept);
}
