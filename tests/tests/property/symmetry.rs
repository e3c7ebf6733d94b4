//! A solution has the symmetries of its indenter and relief.

use pellicle_contact::{Domain, Load, SolverOptions, solve_path};
use pellicle_tests::scene::{
    coated, figure_2, largest_difference, material, model, paraboloid, solve as solve_model,
};
use pellicle_texture::{CylinderSpec, Cylinders, Lattice, Relief};

/// The element to which a symmetry maps `(i, j)`, given the last index.
type Image = fn(usize, usize, usize) -> (usize, usize);

/// The eight symmetries of the square.
const IMAGES: [Image; 8] = [
    |i, j, _| (i, j),
    |i, j, l| (l - i, j),
    |i, j, l| (i, l - j),
    |i, j, l| (l - i, l - j),
    |i, j, _| (j, i),
    |i, j, l| (l - j, i),
    |i, j, l| (j, l - i),
    |i, j, l| (l - j, l - i),
];

/// The differences between a pressure and its images, over its peak.
fn differences(pressure: &[f64]) -> [f64; 8] {
    let n = pressure.len().isqrt();
    IMAGES.map(|image| {
        largest_difference(pressure, |e| {
            let (i, j) = image(e / n, e % n, n - 1);
            pressure[i * n + j]
        })
    })
}

#[test]
fn textured_solutions_have_the_eight_symmetries_of_the_square() {
    for panel in figure_2() {
        // On the whole grid, since a quadrant would be mirrored whatever its solution.
        let options = SolverOptions {
            tolerance: 1e-10,
            mirror_symmetry: false,
            ..SolverOptions::default()
        };
        let (domain, loads) = (Domain::Side(panel.side), [panel.load]);
        let path = solve_path(&panel.model, domain, 64, &loads, &options, &mut ()).unwrap();
        let found = differences(&path.steps[0].solution.pressure);
        // Gaps are closed to 1e-10 of the penetration; single pressures have about 1e2 times that error.
        let name = panel.name;
        assert!(found.iter().all(|d| *d < 1e-7), "{name}: {found:?}");
    }
}

#[test]
fn an_off_axis_relief_has_one_symmetry_besides_the_identity() {
    let spec = CylinderSpec {
        lattice: Lattice::Square,
        radius: 0.02,
        height: 2e-3,
        period: 0.05,
        offset: [0.01, 0.0],
        young_modulus: 10.0,
    };
    let relief = Relief::Cylinders(Cylinders::new(spec).unwrap());
    let body = coated(0.05, material(10.0, 0.3), material(1.0, 0.4));
    let beside = model(&body, relief, paraboloid(1.0));
    let path = solve_model(&beside, 0.5, 64, Load::Force(2e-3));
    let found = differences(&path.steps[0].solution.pressure);
    // Single pressures have about 1e2 times the certificate's 1e-8.
    let kept: Vec<usize> = (0..8).filter(|image| found[*image] < 1e-5).collect();
    assert_eq!(kept, [0, 2], "{found:?}");
    assert!(found.iter().filter(|d| **d > 0.1).count() == 6, "{found:?}");
}
