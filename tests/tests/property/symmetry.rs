//! A solution has the symmetries of its indenter and relief.

use pellicle_tests::paper::figure_2;
use pellicle_tests::scene::largest_difference;

use crate::load::solve;

/// Where a symmetry takes the element `(i, j)`, given the last index.
type Image = fn(usize, usize, usize) -> (usize, usize);

#[test]
fn textured_solutions_have_the_eight_symmetries_of_the_square() {
    let n = 64;
    for panel in figure_2() {
        let pressure = &solve(&panel, n, &[panel.load], 1e-10)[0].solution.pressure;
        let images: [Image; 8] = [
            |i, j, _| (i, j),
            |i, j, l| (l - i, j),
            |i, j, l| (i, l - j),
            |i, j, l| (l - i, l - j),
            |i, j, _| (j, i),
            |i, j, l| (l - j, i),
            |i, j, l| (j, l - i),
            |i, j, l| (l - j, l - i),
        ];
        for image in images {
            let at = |e: usize| {
                let (i, j) = image(e / n, e % n, n - 1);
                pressure[i * n + j]
            };
            // Gaps are closed to 1e-10 of the penetration; single pressures follow to some 1e2 of that.
            assert!(
                largest_difference(pressure, at) < 1e-7,
                "{}: {:e}",
                panel.name,
                largest_difference(pressure, at)
            );
        }
    }
}
