//! A rough surface in a periodic cell on successively finer grids, with the map interpolated between its samples.

#![expect(
    clippy::unwrap_used,
    reason = "a scene that cannot be built fails its test"
)]

use std::sync::Arc;

use pellicle_cli::surfaces::SelfAffine;
use pellicle_contact::{Domain, FlatPunch, Indenter, Load, Model, SolverOptions, solve_path};
use pellicle_influence::{Cache, RadialTables};
use pellicle_tests::convergence::demand;
use pellicle_tests::scene::unit_half_space;
use pellicle_texture::{HeightMap, MapCompliance, Relief, ReliefMap};

/// Samples per side of the map, and samples of the periodic images around it.
pub const SAMPLES: usize = 128;
const RIM: usize = 8;

/// Heights of a self-affine surface of side 1, with shortest waves of 8 samples.
pub fn samples(seed: u64) -> Vec<f64> {
    let surface = SelfAffine {
        size: SAMPLES,
        waves: [2.0, 16.0],
        hurst: 0.8,
        rms: 0.01,
        seed,
    };
    surface.heights().unwrap()
}

/// A map of such heights with a periodic rim.
pub fn repeated(own: &[f64]) -> HeightMap {
    let width = SAMPLES + 2 * RIM;
    let around = |i: usize| (i + SAMPLES - RIM) % SAMPLES;
    let places = (0..width).flat_map(|i| (0..width).map(move |j| [i, j]));
    let heights = places.map(|[i, j]| own[around(i) * SAMPLES + around(j)]);
    let side = width as f64 / SAMPLES as f64;
    HeightMap::new(heights.collect(), [width; 2], [side; 2]).unwrap()
}

fn rough() -> Relief {
    let map = ReliefMap::new(repeated(&samples(11)), MapCompliance::Uniform(0.0));
    Relief::Map(map.unwrap())
}

/// Contact area, stiffness and mean gap.
fn numbers(elements: usize) -> [f64; 3] {
    let model = Model {
        tables: Arc::new(RadialTables::build(&unit_half_space()).unwrap()),
        relief: rough(),
        indenter: Indenter::FlatPunch(FlatPunch::new(9.0).unwrap()),
        cache: Cache::none(),
    };
    let (options, loads) = (SolverOptions::default(), [Load::Force(0.03)]);
    let path = solve_path(
        &model,
        Domain::Periodic(1.0),
        elements,
        &loads,
        &options,
        &mut (),
    );
    let path = path.unwrap();
    let step = &path.steps[0];
    assert!(step.solution.certificate.is_satisfied());
    let surface = path.surface(&path.geometry(), 0).unwrap();
    let mean_gap = surface.gap.iter().sum::<f64>() / (elements * elements) as f64;
    [
        step.summary.contact_area,
        step.contact_stiffness.unwrap(),
        mean_gap,
    ]
}

/// The edge of the area is located within an element; the shortest wave of the map spans 4 to 16 elements.
#[test]
fn area_stiffness_and_mean_gap_of_a_rough_contact_converge_with_order_two() {
    let finest = numbers(1024);
    let grids = [64, 128, 256].map(|elements| (elements, numbers(elements)));
    for (k, largest) in [3e-4, 6e-4, 7e-4].into_iter().enumerate() {
        let errors = grids.map(|(elements, found)| (elements, (found[k] / finest[k] - 1.0).abs()));
        let order = demand(&errors, 1.7, largest);
        assert!(order.is_ok(), "{k}: {order:?}, {errors:?}");
    }
}
