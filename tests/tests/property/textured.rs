//! The paper's textured cases at N = 256: their products, penetrations and places of contact.

use pellicle_contact::{Domain, SolverOptions, Step, solve_path};
use pellicle_tests::scene::{Fig2Panel, figure_2};

fn solve(panel: &Fig2Panel) -> Step {
    let domain = Domain::Side(panel.side);
    let options = SolverOptions::default();
    let path = solve_path(&panel.model, domain, 256, &[panel.load], &options, &mut ()).unwrap();
    path.steps[0].clone()
}

/// Penetrations of an independent prototype on the same grid, in units of R, and the maximum number of products for
/// each: a tenth more than at the time of writing.
const EXPECTED: [(f64, usize); 4] = [
    (2.0219e-4, 9),
    (8.137e-4, 17),
    (6.380e-4, 16),
    (2.6594e-3, 32),
];

#[test]
fn the_textured_cases_are_certified_within_the_expected_products() {
    for (panel, (penetration, products)) in figure_2().iter().zip(EXPECTED) {
        let step = solve(panel);
        let solution = &step.solution;
        assert!(
            solution.certificate.is_satisfied(),
            "{}: {:?}",
            panel.name,
            solution.certificate
        );
        // The prototype's numbers are rounded to the fourth or fifth digit.
        approx::assert_relative_eq!(solution.penetration, penetration, max_relative = 1e-4);
        let taken = step.work.operator_applications;
        assert!(taken <= products, "{}: {taken} products", panel.name);
    }
}

#[test]
fn large_loads_close_the_gap_between_the_cylinders_and_the_small_load_on_the_soft_coating_does_not()
{
    let [small_soft, _, large_soft, large_stiff] = figure_2();
    let between = |panel: &Fig2Panel| solve(panel).summary.contact_area_between;
    assert_eq!(between(&small_soft).to_bits(), 0.0_f64.to_bits());
    assert!(between(&large_soft) > 0.0);
    assert!(between(&large_stiff) > 0.0);
}
