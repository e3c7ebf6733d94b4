//! The factor among candidates on small sets whose systems are known entry by entry.

use pellicle_influence::{CoefficientTable, RadialTables};
use pellicle_kernel::{Foundation, Material};

use super::*;
use crate::{
    DiscreteProblem, Load,
    grid::candidates::elements_where,
    solver::gradient::{load_control::LoadControl, state::State},
};

const SIZE: usize = 40;
/// Rows all of whose elements are candidates, after those of a first few rows.
const ROWS: [usize; 2] = [20, 32];
const ELEMENTS: usize = SIZE * SIZE;

fn elasticity() -> Arc<SurfaceElasticity> {
    let [coating, base] = [10.0, 1.0].map(|modulus| Material::new(modulus, 0.3).unwrap());
    let body = Foundation::coated(0.05, coating, base).unwrap();
    let tables = RadialTables::build(&body).unwrap();
    let table = CoefficientTable::assemble(&tables, 1.0 / SIZE as f64, SIZE).unwrap();
    Arc::new(SurfaceElasticity::new(Arc::new(table), body))
}

/// The candidates, more than one parallel chunk.
fn candidates() -> Arc<Candidates> {
    let rows = ROWS[0] + 1..ROWS[1];
    let members = elements_where(SIZE, |[row, column]| {
        rows.contains(&row) || [row, column] == [3, 5]
    });
    let candidates = Candidates::around(SIZE, &members);
    assert!(candidates.len() > PART);
    Arc::new(candidates)
}

/// The set of candidates whose row and column satisfy `belongs`.
fn set(candidates: &Candidates, belongs: impl Fn([usize; 2]) -> bool) -> WorkingSet {
    // A state of as many elements that presses there; the problem does not matter.
    let field = |value| vec![value; ELEMENTS];
    let mut problem =
        DiscreteProblem::elastic(elasticity(), SIZE, field(0.0), field(0.0), 1.0).unwrap();
    let pressure = (0..ELEMENTS).map(|c| c < candidates.len() && belongs(candidates.place(c)));
    let pressure: Vec<f64> = pressure
        .map(|presses| f64::from(u8::from(presses)))
        .collect();
    let control = LoadControl::of(&problem, Load::Penetration(0.0));
    let mut state = State::new(&problem);
    state.start(&mut problem, control, &pressure);
    let mut set = WorkingSet::new(ELEMENTS);
    set.start(&mut state);
    set.keep_pressing(&mut state);
    set
}

/// About every other element of seven rows and columns, all within the places searched for neighbours.
fn patch([i, j]: [usize; 2]) -> bool {
    (23..30).contains(&i) && (26..33).contains(&j) && (3 * i + 5 * j) % 7 < 4
}

/// `(K + η) p` on a set of the candidates, summed term by term.
fn deformed(candidates: &Candidates, set: &WorkingSet, eta: &[f64], p: &[f64]) -> Vec<f64> {
    let elasticity = elasticity();
    let members: Vec<usize> = (0..candidates.len()).filter(|c| set.mask()[*c]).collect();
    let mut image = vec![0.0; p.len()];
    for a in &members {
        let [i, j] = candidates.place(*a);
        for b in &members {
            let [k, l] = candidates.place(*b);
            image[*a] += elasticity.coefficient([i.abs_diff(k), j.abs_diff(l)]) * p[*b];
        }
        image[*a] += eta[*a] * p[*a];
    }
    image
}

/// The largest difference between `GᵀG (K + η) p` and `p`, which lies between 1 and 3 on the set and is 0 outside.
fn error(factor: &mut ScatteredFactor, set: &WorkingSet, eta: &[f64]) -> f64 {
    let candidates = candidates();
    let pressure = (0..candidates.len()).map(|c| 2.0 + (c as f64).sin());
    let pressure = pressure
        .zip(set.mask())
        .map(|(p, member)| if *member { p } else { 0.0 });
    let pressure: Vec<f64> = pressure.collect();
    let mut field = deformed(&candidates, set, eta, &pressure);
    // Values outside the set must be ignored.
    for (value, member) in field.iter_mut().zip(set.mask()) {
        *value = if *member { *value } else { 7.0 };
    }
    factor.apply(&mut field);
    let errors = field.iter().zip(&pressure).map(|(z, p)| (z - p).abs());
    errors.fold(0.0, f64::max)
}

/// A compliance that its class represents exactly: 16 classes per factor of two, starting from `10⁻³ K₀₀`.
fn springs(candidates: &Candidates) -> Vec<f64> {
    let own = elasticity().coefficient([0, 0]);
    let of_class = |class: usize| 1e-3 * (class as f64 / 16.0).exp2() * own;
    (0..candidates.len())
        .map(|c| of_class(100 + c % 80))
        .collect()
}

#[test]
fn with_all_earlier_elements_as_neighbours_the_factor_is_the_inverse() {
    let candidates = candidates();
    let rigid = vec![0.0; candidates.len()];
    let springs = springs(&candidates);
    let elasticity = elasticity();
    let mut factor = ScatteredFactor::new(elasticity, candidates.clone(), &rigid, SEARCHED);
    let whole = set(&candidates, patch);
    // Rows in single precision, of a system with a condition number of some hundreds.
    factor.update(&whole);
    let fresh = error(&mut factor, &whole, &rigid);
    assert!(fresh < 1e-4, "{fresh:e}");
    // The set loses elements and gains others; rows whose neighbours stay are kept and are right.
    let other = set(&candidates, |[i, j]| {
        patch([i, j]) != ((23..26).contains(&i) && (27..32).contains(&j))
    });
    factor.update(&other);
    let moved = error(&mut factor, &other, &rigid);
    assert!(moved < 1e-4, "{moved:e}");
    factor.take_compliance(&springs);
    factor.update(&other);
    let soft = error(&mut factor, &other, &springs);
    assert!(soft < 1e-4, "{soft:e}");
    factor.update(&whole);
    assert!(error(&mut factor, &whole, &springs) < 1e-4);
}

#[test]
fn the_nearest_neighbours_are_used_and_more_are_more_accurate() {
    let candidates = candidates();
    let rigid = vec![0.0; candidates.len()];
    let whole = set(&candidates, patch);
    let errors = [0, 2, 6, 20].map(|neighbours| {
        let mut factor =
            ScatteredFactor::new(elasticity(), candidates.clone(), &rigid, neighbours.max(1));
        factor.update(&whole);
        let largest = factor.rows.iter().map(|row| row.neighbours.len()).max();
        assert_eq!(largest, Some(neighbours.max(1)));
        for (c, row) in factor.rows.iter().enumerate() {
            assert_eq!(row.diagonal > 0.0, whole.mask()[c]);
            let square = |other: usize| {
                let [[i, j], [k, l]] = [c, other].map(|c| candidates.place(c));
                i.abs_diff(k).pow(2) + j.abs_diff(l).pow(2)
            };
            assert!(
                row.neighbours
                    .is_sorted_by_key(|other| square(*other as usize))
            );
            assert!(
                row.neighbours
                    .iter()
                    .all(|other| whole.mask()[*other as usize])
            );
        }
        error(&mut factor, &whole, &rigid)
    });
    assert!(
        errors.is_sorted_by(|fewer, more| more <= fewer),
        "{errors:?}"
    );
}
