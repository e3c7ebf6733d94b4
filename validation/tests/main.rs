//! The rows of the validation fail if a coefficient is slightly wrong.

use pellicle_validation::{SECTIONS, ValidationRun};

#[test]
fn errors_down_to_the_thirteenth_digit_are_detected_with_either_sign() {
    for (perturbation, grids) in [(-1e-6, 12), (1e-9, 12), (1e-12, 0), (-1e-12, 0)] {
        let run = ValidationRun { perturbation };
        let failed = |name: &str| {
            let section = SECTIONS
                .iter()
                .find(|section| section.name == name)
                .unwrap();
            let rows = section.compute(run).rows;
            rows.iter().filter(|row| !row.passes()).count()
        };
        // The two quadrature rows detect nothing below their own 1e-11.
        assert!(failed("Influence coefficients") >= 8, "{perturbation}");
        assert_eq!(failed("The same grid problem"), grids, "{perturbation}");
    }
}
