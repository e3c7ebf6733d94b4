//! The contact area with measured maps, by counting elements, by correcting with their perimeter, and by locating the
//! edge within its element; compared with circles and with refined rough contacts.

#![expect(
    clippy::unwrap_used,
    reason = "a scene that cannot be built fails its test"
)]

use std::f64::consts::PI;
use std::sync::Arc;

use pellicle_contact::{Domain, FlatPunch, Indenter, Load, Model, SolverOptions, Step, solve_path};
use pellicle_influence::{Cache, RadialTables};
use pellicle_tests::scene::unit_half_space;
use pellicle_texture::{HeightMap, MapCompliance, MapRim, Relief, ReliefMap, Roughness};

use super::rough::{SAMPLES, repeated, samples};

/// Solves one load on a surface of heights under a flat body.
fn solve(heights: HeightMap, domain: Domain, elements: usize, force: f64) -> Step {
    let model = Model {
        tables: Arc::new(RadialTables::build(&unit_half_space()).unwrap()),
        relief: Relief::Map(ReliefMap::new(heights, MapCompliance::Uniform(0.0)).unwrap()),
        indenter: Indenter::FlatPunch(FlatPunch::new(9.0).unwrap()),
        cache: Cache::none(),
    };
    let (options, loads) = (SolverOptions::default(), [Load::Force(force)]);
    let mut path = solve_path(&model, domain, elements, &loads, &options, &mut ()).unwrap();
    let step = path.steps.remove(0);
    assert!(step.solution.certificate.is_satisfied());
    step
}

/// A paraboloid of radius 1 with its top at a point of the square of side 1, which bicubic interpolation reproduces.
fn bump([u, v]: [f64; 2]) -> HeightMap {
    let n = 24;
    let at = |i: usize| (i as f64 + 0.5) / n as f64 - 0.5;
    let height = |k: usize| -0.5 * ((at(k / n) - u).powi(2) + (at(k % n) - v).powi(2));
    HeightMap::new((0..n * n).map(height).collect(), [n; 2], [1.0; 2]).unwrap()
}

/// Relative error.
fn error(found: f64, exact: f64) -> f64 {
    (found / exact - 1.0).abs()
}

/// Hertz: `Q = 4/3 E* a³/R`. With the circle's own `S_d`, the counted area is too large by 0.089 `S_d h` on these
/// elements, whereas Yastrebov, Anciaux and Molinari subtract 0.118. Both areas converge to the circle's with first
/// order.
#[test]
fn the_counted_area_of_circles_is_too_large_by_a_fraction_of_the_perimeter() {
    for elements in [64, 256] {
        let h = 1.0 / elements as f64;
        let (mut part, mut errors) = (0.0, [0.0; 3]);
        let circles = 12;
        for k in (0..circles).map(f64::from) {
            let radius = 0.2 + 0.005 * k;
            let place = [0.37 * k * h % h, 0.71 * k * h % h];
            let force = 4.0 / 3.0 * radius.powi(3);
            let step = solve(bump(place), Domain::Side(1.0), elements, force);
            let rough = step.rough.as_ref().unwrap();
            assert_eq!(rough.islands.count, 1);
            let exact = PI * radius * radius;
            part += (rough.counted_area - exact) / (rough.perimeter * h * f64::from(circles));
            let areas = [
                rough.counted_area,
                rough.corrected_area,
                step.summary.contact_area,
            ];
            for (sum, area) in errors.iter_mut().zip(areas) {
                *sum += error(area, exact).powi(2) / f64::from(circles);
            }
        }
        // The mean of twelve circles scatters by 0.003 on the finer grid, by 0.006 on the coarser.
        assert!((part - 0.089).abs() < 0.012, "{elements}: {part}");
        let [counted, corrected, by_edge] = errors.map(f64::sqrt);
        assert!(
            counted > 2.0 * corrected && corrected > 3.0 * by_edge,
            "{errors:?}"
        );
    }
}

/// The truth comes from counting alone: its error is of first order, so two grids are extrapolated.
#[test]
fn on_a_rough_contact_edge_corrected_and_counted_areas_are_accurate_in_this_order() {
    let surface = repeated(&samples(11));
    let areas = [256, 512].map(|elements| {
        let step = solve(surface.clone(), Domain::Periodic(1.0), elements, 0.03);
        let rough = step.rough.unwrap();
        [
            rough.counted_area,
            rough.corrected_area,
            step.summary.contact_area,
        ]
    });
    let truth = 2.0 * areas[1][0] - areas[0][0];
    let [counted, corrected, by_edge] = areas[0].map(|area| error(area, truth));
    assert!(counted > 0.015 && counted < 0.025, "{counted}");
    assert!(
        corrected < 0.5 * counted && corrected > 0.003,
        "{corrected}"
    );
    assert!(by_edge < 5e-4, "{by_edge}");
}

/// `A/A₀ = κ p̄/(E* h'rms)` under a light load: κ is √(8/π) = 1.6 in Persson's theory, √(2π) = 2.5 in that of Bush,
/// Gibson and Thomas, whose asperities do not interact.
#[test]
fn under_a_light_load_the_area_grows_with_the_load_over_the_rms_slope() {
    for seed in [11, 12, 13] {
        let own = samples(seed);
        let map = HeightMap::new(own.clone(), [SAMPLES; 2], [1.0; 2]).unwrap();
        let slope = Roughness::of(&map, MapRim::Repeats).rms_slope;
        let factors = [0.002, 0.004].map(|force| {
            let step = solve(repeated(&own), Domain::Periodic(1.0), 256, force);
            let fraction = step.rough.unwrap().contact_fraction;
            fraction * slope / force
        });
        let bounds = (8.0 / PI).sqrt()..(2.0 * PI).sqrt();
        assert!(
            factors.iter().all(|factor| bounds.contains(factor)),
            "{factors:?}"
        );
        // A few tens of islands, a small number.
        assert!(error(factors[1], factors[0]) < 0.1, "{factors:?}");
    }
}
