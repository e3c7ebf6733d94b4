//! The lines of the certificate on surfaces computed by hand.

use std::sync::Arc;

use pellicle_influence::{
    CoefficientTable, ElasticOperator, RadialTables, Sector, SectorGrid, SurfaceElasticity,
};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::SpringLaw;

use super::{Certificate, JudgedFields, Solution, Surface, Trial};
use crate::{
    DeformedSurface, DiscreteProblem, Load, grid::region::Region, problem::support::choice::under,
};

/// Independent springs of 0.5 m/Pa.
struct Springs(usize);

impl ElasticOperator for Springs {
    fn size(&self) -> usize {
        self.0
    }

    fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        for (u, p) in displacement.iter_mut().zip(pressure) {
            *u = 0.5 * p;
        }
    }
}

/// Two elements with pressure, one that overlaps and one out of reach; elements of 0.25 m².
fn judged(load: Load) -> (Solution, DeformedSurface) {
    let (eta, gap) = (vec![0.5, 0.0, 0.0, 0.0], vec![0.0, 0.5, 1.0, f64::INFINITY]);
    let problem = DiscreteProblem::new(Box::new(Springs(2)), eta, gap, 0.25);
    Solution::judge_with_surface(&mut problem.unwrap(), load, vec![2.0, 4.0, 0.0, 0.0], 1e-8)
}

fn assert_lines(found: Certificate, wanted: [f64; 4]) {
    let lines = [
        found.complementarity,
        found.gap_in_contact,
        found.overlap,
        found.load,
    ];
    for (found, wanted) in lines.into_iter().zip(wanted) {
        // a few roundings
        assert!((found - wanted).abs() < 1e-15, "{lines:?}");
    }
}

#[test]
fn under_a_force_every_line_equals_its_formula() {
    let (solution, surface) = judged(Load::Force(2.0));
    // v = (1 + 1 + 0, 2 + 0 + 0.5, 1, ∞), D = (2·2 + 4·2.5)/6 = 7/3, g = (−1/3, 1/6, −4/3, ∞)
    assert_eq!(surface.displacement, [1.0, 2.0, 0.0, 0.0]);
    assert_eq!(surface.shortening, [1.0, 0.0, 0.0, 0.0]);
    assert!((solution.penetration - 7.0 / 3.0).abs() < 1e-15);
    // as prescribed; the certificate reports that the pressures carry 1.5
    assert!((solution.force - 2.0).abs() <= 0.0);
    assert!((surface.gap[0] + 1.0 / 3.0).abs() < 1e-15 && surface.gap[3].is_infinite());
    // (2/3 + 4/6)/(7/3 · 6), (1/3)/(7/3), (4/3)/(7/3), |1.5 − 2|/2
    assert_lines(
        solution.certificate,
        [2.0 / 21.0, 1.0 / 7.0, 4.0 / 7.0, 0.25],
    );
    assert!(solution.certificate.min_pressure.abs() <= 0.0);
    assert!((solution.certificate.tolerance - 1e-8).abs() <= 0.0);
}

#[test]
fn under_a_penetration_the_gap_is_measured_from_it() {
    // D = ∓2: g = (2, 2.5, 1) + 2 above the surface, (0, 0.5, −1) below it
    let above = judged(Load::Penetration(-2.0)).0.certificate;
    assert_lines(above, [(2.0 * 4.0 + 4.0 * 4.5) / 12.0, 2.25, 0.0, 0.0]);
    let (below, surface) = judged(Load::Penetration(2.0));
    assert_lines(below.certificate, [1.0 / 6.0, 0.25, 0.5, 0.0]);
    assert_eq!(surface.gap, [0.0, 0.5, -1.0, f64::INFINITY]);
}

#[test]
fn on_a_large_grid_the_lines_include_all_elements() {
    let size = 200;
    let wave = |e: usize, rate: f64| (rate * e as f64).sin();
    let gap: Vec<f64> = (0..size * size).map(|e| 1.0 + wave(e, 0.01)).collect();
    let pressure: Vec<f64> = (0..size * size)
        .map(|e| wave(e, 1e-4).max(0.0) + 0.1 * f64::from(u8::from(e == 30_000)))
        .collect();
    let problem = DiscreteProblem::new(Box::new(Springs(size)), vec![0.0; size * size], gap, 1.0);
    let (found, surface) = Solution::judge_with_surface(
        &mut problem.unwrap(),
        Load::Penetration(1.2),
        pressure.clone(),
        1e-8,
    );
    let pressed = || pressure.iter().zip(&surface.gap).filter(|(p, _)| **p > 0.0);
    let total: f64 = pressure.iter().sum();
    let weighted: f64 = pressed().map(|(p, g)| p * g.abs()).sum();
    let largest = pressed().map(|(_, g)| g.abs()).fold(0.0, f64::max);
    let overlap = surface.gap.iter().map(|g| -g).fold(0.0, f64::max);
    let wanted = [weighted / total / 1.2, largest / 1.2, overlap / 1.2, 0.0];
    let lines = found.certificate;
    // sums of 40 000 terms in another order
    assert!((lines.complementarity / wanted[0] - 1.0).abs() < 1e-12);
    assert_lines(
        Certificate {
            complementarity: wanted[0],
            ..lines
        },
        wanted,
    );
    assert!(lines.min_pressure.abs() <= 0.0);
}

#[test]
fn one_bad_line_is_enough_to_fail() {
    let perfect = Certificate {
        complementarity: 0.0,
        gap_in_contact: 0.0,
        overlap: 0.0,
        load: 0.0,
        min_pressure: 0.0,
        gap_at_limit: Some(0.0),
        over_limit: Some(0.0),
        tolerance: 1e-8,
    };
    assert!(perfect.is_satisfied());
    for bad in [2e-8, f64::INFINITY, f64::NAN] {
        let altered = [
            Certificate {
                complementarity: bad,
                ..perfect
            },
            Certificate {
                gap_in_contact: bad,
                ..perfect
            },
            Certificate {
                overlap: bad,
                ..perfect
            },
            Certificate {
                load: bad,
                ..perfect
            },
            Certificate {
                gap_at_limit: Some(bad),
                ..perfect
            },
        ];
        for certificate in altered {
            assert!(!certificate.is_satisfied(), "{certificate:?}");
            assert_eq!(certificate.worst().to_bits(), bad.to_bits());
        }
    }
    for min_pressure in [-1e-300, f64::INFINITY, f64::NAN] {
        assert!(
            !Certificate {
                min_pressure,
                ..perfect
            }
            .is_satisfied()
        );
    }
    for over_limit in [1e-300, f64::INFINITY, f64::NAN] {
        assert!(
            !Certificate {
                over_limit: Some(over_limit),
                ..perfect
            }
            .is_satisfied()
        );
    }
    // A line at the tolerance is within it.
    assert!(
        Certificate {
            load: 1e-8,
            ..perfect
        }
        .is_satisfied()
    );
}

#[test]
fn nan_fails_at_every_element() {
    for place in [0, 1, 3] {
        let problem = DiscreteProblem::new(Box::new(Springs(2)), vec![0.0; 4], vec![0.0; 4], 1.0);
        let mut pressure = vec![1.0; 4];
        pressure[place] = f64::NAN;
        let found = Solution::judge(&mut problem.unwrap(), Load::Penetration(0.5), pressure, 1.0);
        let certificate = found.certificate;
        assert!(certificate.worst().is_nan() && certificate.min_pressure.is_nan());
        assert!(!certificate.is_satisfied());
    }
}

const SIZE: usize = 48;

/// A paraboloid above a sector of `SIZE` elements a row on a layer of this Poisson's ratio, ten times softer than its
/// base.
fn pressed_layer(grid: SectorGrid, poisson_ratio: f64) -> DiscreteProblem {
    let layer = Material::new(0.1, poisson_ratio).unwrap();
    let foundation = Foundation::coated(0.05, layer, Material::new(1.0, 0.3).unwrap()).unwrap();
    let (whole, side) = (grid.whole_size(), 1.0 / SIZE as f64);
    let tables = RadialTables::build(&foundation).unwrap();
    let table = CoefficientTable::assemble(&tables, side, whole).unwrap();
    let elasticity = Arc::new(SurfaceElasticity::new(Arc::new(table), foundation));
    let first = grid.first_index();
    let along = |i: usize| (i as f64 + 0.5 - 0.5 * whole as f64) * side;
    let gap = (0..grid.elements()).map(|e| {
        let [x, y] = [along(first[0] + e / SIZE), along(first[1] + e % SIZE)];
        f64::midpoint(x * x, y * y)
    });
    let (eta, support) = (
        vec![0.0; grid.elements()],
        under(elasticity, Region::all_of(grid)),
    );
    DiscreteProblem::on(support, eta, gap.collect(), side * side).unwrap()
}

/// The part of the grid around the contact has the certificate of the whole grid, and the rest does not overlap.
#[test]
fn no_overlap_is_missed_outside_the_judged_region() {
    for sector in [Sector::Whole, Sector::Half, Sector::Quadrant] {
        for poisson_ratio in [0.3, 0.5] {
            let mut problem = pressed_layer(SectorGrid::new(sector, SIZE), poisson_ratio);
            let everywhere = problem.region();
            let depth = 0.01;
            let overlapping: Vec<f64> = (problem.initial_gap().iter())
                .map(|g0| (depth - g0).max(0.0))
                .collect();
            let presses = |[i, j]: [usize; 2]| overlapping[i * SIZE + j] > 0.0;
            let region = everywhere.around(presses);
            assert!(!region.is_whole());
            let mut judged = |expected: f64, factor: f64| {
                let (load, tolerance) = (Load::Force(1e-3), 1e-8);
                let mut fields = JudgedFields::on(everywhere);
                let trial = Trial {
                    region: &region,
                    load,
                    expected,
                    tolerance,
                };
                let pressure = region.cut(&overlapping).into_iter().map(|p| factor * p);
                let solution =
                    Solution::judge_within(&mut problem, trial, pressure.collect(), &mut fields);
                (solution, fields)
            };
            // NaN and infinite pressures fail on the whole grid.
            for nonsense in [f64::NAN, f64::INFINITY] {
                let (nowhere, fields) = judged(depth, nonsense);
                assert!(fields.reach.is_whole() && !nowhere.certificate.is_satisfied());
            }
            let (whole, of_whole) = judged(f64::INFINITY, 1.0);
            assert!(of_whole.reach.is_whole());
            let (solution, mut fields) = judged(whole.penetration, 1.0);
            assert_eq!(fields.take_products(), 1);
            // The expected penetration is too small: the whole grid is examined.
            let (_, mut of_all) = judged(0.9 * whole.penetration, 1.0);
            assert!(of_all.reach.is_whole() && of_all.take_products() == 2);
            let lines = |judged: &Solution| {
                let found = judged.certificate;
                let lines = [found.complementarity, found.gap_in_contact, found.overlap];
                [
                    judged.penetration,
                    judged.force,
                    lines[0],
                    lines[1],
                    lines[2],
                ]
            };
            for (found, wanted) in lines(&solution).into_iter().zip(lines(&whole)) {
                // Rounding of a product.
                assert!((found - wanted).abs() <= 1e-12 * wanted.abs().max(1.0));
            }
            // The layer bulges, but not far from the load.
            let least = problem.elasticity().unwrap().least_coefficient_from(1);
            assert_eq!(least < 0.0, poisson_ratio == 0.5);
            // Under a load on one element of a sector and its images.
            let images = match sector {
                Sector::Whole => 1.0,
                Sector::Half => 2.0,
                Sector::Quadrant => 4.0,
            };
            let sunk_least = problem.least_displacement(2.0, 1);
            assert_eq!(sunk_least, 2.0 * images * least.min(0.0));
            assert!(!fields.reach.is_whole());
            for (e, initial_gap) in problem.initial_gap().iter().enumerate() {
                let element = [e / SIZE, e % SIZE];
                let is_in_reach = fields.reach.place(element).is_some();
                assert!(is_in_reach || of_whole.gap_of(element, *initial_gap) >= 0.0);
            }
        }
    }
}

#[test]
fn the_penetration_under_a_force_is_the_mean_of_v_weighted_by_the_pressure_below_the_limit() {
    let region = Region::whole(2);
    let of = |pressure: [f64; 4], limit: f64| {
        let surface = Surface {
            initial_gap: &[0.5, 0.25, 0.5, f64::INFINITY],
            compliance: &[0.5, 0.25, 0.0, 0.0],
            spring_law: SpringLaw::LINEAR,
            limit,
            region,
            reach: region,
            pressure: &pressure,
            displacement: &[1.0, 2.0, 3.0, 4.0],
        };
        surface.multiplier(pressure.iter().sum())
    };
    // v = 1.5 + p/2, 2.25 + p/4, 3.5 and infinity; elements without pressure have no weight.
    assert_eq!(of([1.0, 3.0, 0.0, 0.0], f64::INFINITY), (2.0 + 9.0) / 4.0);
    assert_eq!(
        of([1.0, 1.0, 2.0, 0.0], f64::INFINITY),
        (2.0 + 2.5 + 7.0) / 4.0
    );
    // Elements at the limit count only if none lies below it, and then by their largest v.
    assert_eq!(of([1.0, 3.0, 2.0, 0.0], 3.0), (2.0 + 7.0) / 3.0);
    assert_eq!(of([3.0, 3.0, 0.0, 0.0], 3.0), 3.0);
    assert_eq!(of([3.0, 0.0, 3.0, 0.0], 3.0), 3.5);
}
