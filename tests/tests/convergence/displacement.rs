//! Coefficients and product: the displacement under a known pressure.

use pellicle_contact::reference;
use pellicle_influence::{
    CoefficientTable, ConvolutionOperator, ElasticOperator, RadialTables, love,
};
use pellicle_tests::convergence::{GRIDS, demand};
use pellicle_tests::scene::{material, unit_half_space};
use pellicle_texture::Grid;

/// Error of the displacement under Hertz's pressure, with contact radius 0.1 on a square of side 0.3.
fn displacement_error(elements: usize) -> f64 {
    let hertz = reference::hertz::from_contact_radius(1.0, 1.0, 0.1);
    let grid = Grid::new(0.3, elements).expect("a grid");
    let tables = RadialTables::build(&unit_half_space()).expect("Love's");
    let table = CoefficientTable::assemble(&tables, grid.element_side(), elements).expect("finite");
    let pressure: Vec<f64> = grid
        .centres()
        .map(|[x, y]| hertz.pressure(x.hypot(y)))
        .collect();
    let mut found = vec![0.0; pressure.len()];
    ConvolutionOperator::new(&table).apply_into(&pressure, &mut found);
    // In contact u = D − ρ²/2R.
    let inside = grid
        .centres()
        .zip(found)
        .filter(|([x, y], _)| x.hypot(*y) < 0.05);
    let errors =
        inside.map(|([x, y], u)| (u - (hertz.penetration - f64::midpoint(x * x, y * y))).abs());
    errors.fold(0.0, f64::max) / hertz.penetration
}

#[test]
fn hertzs_pressure_gives_hertzs_displacement_with_almost_order_two() {
    let errors = GRIDS.map(|elements| (elements, displacement_error(elements)));
    // Pressures at the centres replace the elements' means: second order except for the square root at the contact's
    // edge.
    demand(&errors, 1.7, 1e-5).expect("almost order two");
}

#[test]
fn a_far_element_acts_like_a_point_force_with_order_two() {
    // k → 4a²/(πE*r), the next term is of relative order (a/r)²; here the number of elements between takes the role of
    // the grid.
    let body = material(0.91, 0.3);
    let errors = [4, 8, 16, 32, 64, 128].map(|m: usize| {
        let point = 1.0 / (std::f64::consts::PI * m as f64);
        let found = love::coefficient(&body, 1.0, [m, 0]);
        (m, (found / point - 1.0).abs())
    });
    let order = demand(&errors, 1.95, 1e-4).expect("order two");
    assert!(order < 2.05, "{order}");
}
