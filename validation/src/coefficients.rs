//! Influence coefficients against values of 20 and 30 digits.

use pellicle_influence::direct;
use pellicle_kernel::{Foundation, Material};

use crate::comparison::Comparison;
use crate::data::influence::{Coefficients, ReferenceCoefficient, extreme, two_layer};
use crate::run::{ValidationError, ValidationRun};
use crate::section::ValidationSection;

/// The section.
pub const SECTION: ValidationSection = ValidationSection {
    name: "Influence coefficients",
    source: "tests/data/influence_*.json, 20 and 30 digits; quadrature of the paper's (3.4)",
    because: "relative to max(|k|, min(1, Φ(0)) k of the half-space); rounding of the product rules, \
              and of the quadrature its own tolerance",
    rows,
};

/// Error of the product rules around the softest layers.
const PRODUCT_RULES: f64 = 1e-13;
/// Rounding of a few tens of terms in Love's formula.
const ROUNDING: f64 = 1e-14;
/// The quadrature's own tolerance.
const QUADRATURE: f64 = 1e-11;

fn rows(run: ValidationRun) -> Result<Vec<Comparison>, ValidationError> {
    let data = [two_layer()?, extreme()?];
    let mut rows = vec![homogeneous(run, &data[0])?];
    for data in &data {
        for name in data.cases.keys() {
            rows.push(coated(run, data, name)?);
        }
    }
    for offset in [[0, 0], [2, 1]] {
        rows.push(by_quadrature(run, offset)?);
    }
    Ok(rows)
}

/// Compares `k E1/a` of a coating; the row is the worst of all its offsets and thicknesses.
fn coated(
    run: ValidationRun,
    data: &Coefficients,
    name: &str,
) -> Result<Comparison, ValidationError> {
    let coating = data.cases.get(name).ok_or(ValidationError::NoSolution)?;
    let tables = run.tables(&coating.foundation()?)?;
    let at_zero = tables.foundation().response_at_zero();
    let compared = |value: &ReferenceCoefficient| {
        let side = value.element_side();
        let found = 2.0 * tables.coefficient(side, [value.m, value.n]) / side;
        let error = (found - value.value).abs() / value.scale(at_zero);
        ([value.value, found], error)
    };
    let values = data.values.iter().filter(|value| value.case == name);
    let (chi, nu1, nu2) = (coating.chi, coating.nu1, coating.nu2);
    let check = format!(
        "χ = {chi}, ν = {nu1}, {nu2}: {} coefficients",
        values.clone().count()
    );
    Ok(Comparison::worst(
        check,
        values.map(compared),
        PRODUCT_RULES,
    ))
}

/// Compares `k E1/a` of half-spaces; the row is the worst of all offsets.
fn homogeneous(run: ValidationRun, data: &Coefficients) -> Result<Comparison, ValidationError> {
    let mut found = Vec::new();
    for value in &data.values {
        let coating = data
            .cases
            .get(&value.case)
            .ok_or(ValidationError::NoSolution)?;
        let body = Foundation::half_space(Material::new(1.0, coating.nu1)?);
        let computed = run.tables(&body)?.coefficient(2.0, [value.m, value.n]);
        let error = (computed / value.homogeneous - 1.0).abs();
        found.push(([value.homogeneous, computed], error));
    }
    let check = format!("half-space: {} coefficients", found.len());
    Ok(Comparison::worst(check, found.into_iter(), ROUNDING))
}

/// Compares one coefficient of the paper's stiff coating with quadrature.
fn by_quadrature(run: ValidationRun, offset: [usize; 2]) -> Result<Comparison, ValidationError> {
    let (coating, substrate) = (Material::new(1.0, 0.3)?, Material::new(0.1, 0.4)?);
    let foundation = Foundation::coated(1.0, coating, substrate)?;
    let reference = direct::coefficient(&foundation, 1.0, offset)?;
    let computed = run.tables(&foundation)?.coefficient(1.0, offset);
    let [m, n] = offset;
    let check = format!("χ = 10, ν = 0.3, 0.4: offset ({m}, {n}) by quadrature");
    Ok(Comparison::relative(check, reference, computed, QUADRATURE))
}
