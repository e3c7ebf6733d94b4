//! The product `K p` by FFT against the sum over elements.

use pellicle_influence::{CoefficientTable, ConvolutionOperator, DenseOperator, ElasticOperator};
use pellicle_kernel::{Foundation, Material};

use crate::comparison::Comparison;
use crate::run::{ValidationError, ValidationRun};
use crate::section::ValidationSection;

/// The section.
pub const SECTION: ValidationSection = ValidationSection {
    name: "Product of coefficients and pressure",
    source: "the sum over all elements, one by one",
    because: "relative to the largest displacement; rounding of the transforms and of the sums",
    rows,
};

/// Rounding of transforms of up to 96² numbers.
const ROUNDING: f64 = 1e-13;

fn rows(run: ValidationRun) -> Result<Vec<Comparison>, ValidationError> {
    let half_space = Foundation::half_space(Material::new(1.0, 0.3)?);
    let soft = Foundation::coated(1.0, Material::new(1e-3, 0.49)?, Material::new(1.0, 0.3)?)?;
    [("half-space", half_space), ("soft coating", soft)]
        .iter()
        .map(|(name, foundation)| product(run, name, foundation))
        .collect()
}

/// Compares the worst element for a pressure without symmetry.
fn product(
    run: ValidationRun,
    name: &str,
    foundation: &Foundation,
) -> Result<Comparison, ValidationError> {
    let size = 37;
    let table = CoefficientTable::assemble(&run.tables(foundation)?, 0.3, size)?;
    // All values of the chaotic sequence are in (0, 1); its start is irrational.
    let mut state = std::f64::consts::FRAC_1_SQRT_2;
    let pressure: Vec<f64> = (0..size * size)
        .map(|_| {
            state = 3.99 * state * (1.0 - state);
            state
        })
        .collect();
    let mut fast = vec![0.0; pressure.len()];
    ConvolutionOperator::new(&table).apply_into(&pressure, &mut fast);
    let mut summed = vec![0.0; pressure.len()];
    DenseOperator::new(&table).apply_into(&pressure, &mut summed);
    let largest = summed
        .iter()
        .fold(0.0_f64, |largest, u| largest.max(u.abs()));
    let elements = summed.iter().zip(&fast);
    let compared =
        elements.map(|(wanted, found)| ([*wanted, *found], (found - wanted).abs() / largest));
    let check = format!("{name}, {size} × {size} elements");
    Ok(Comparison::worst(check, compared, ROUNDING))
}
