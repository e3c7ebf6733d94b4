//! Stress inside the body: published values, Hertz's contact, limits, balance of forces.

pub mod balance;
pub mod hertz;
pub mod limits;
pub mod published;
pub mod squares;

use pellicle_influence::SubsurfaceState;

/// Pairs of values from two lists of states with their differences: stresses relative to the largest stress,
/// displacements relative to the largest displacement.
fn differences(wanted: &[SubsurfaceState], found: &[SubsurfaceState]) -> Vec<([f64; 2], f64)> {
    let kinds = [0..3, 3..9];
    let of_kind = |kind: std::ops::Range<usize>| {
        let values =
            |state: &SubsurfaceState| kind.clone().map(|f| state.field(f)).collect::<Vec<_>>();
        let wanted: Vec<f64> = wanted.iter().flat_map(values).collect();
        let found: Vec<f64> = found.iter().flat_map(values).collect();
        let largest = wanted
            .iter()
            .fold(0.0_f64, |most, value| most.max(value.abs()));
        let pairs = wanted.into_iter().zip(found);
        pairs
            .map(|(wanted, found)| ([wanted, found], (found - wanted).abs() / largest))
            .collect::<Vec<_>>()
    };
    kinds.into_iter().flat_map(of_kind).collect()
}
