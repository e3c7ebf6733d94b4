//! Rough contact, pillars and rough films on thin stiff coatings, where the contact breaks up into islands: the work,
//! in products with `K` on the finest grid.
//!
//! A paraboloid of radius 1 on a base of E = 1 under a coating of thickness 0.003 or 0.02, with equal Poisson's ratios;
//! the force gives a contact radius of 0.08 on the base alone.

use std::sync::{Arc, LazyLock};

use pellicle_cli::surfaces::SelfAffine;
use pellicle_contact::{
    Domain, Indenter, Load, Model, Paraboloid, Profile, SolverOptions, Step, solve_path,
};
use pellicle_influence::{Cache, RadialTables};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::{
    CylinderSpec, Cylinders, HeightMap, Lattice, MapCompliance, Relief, ReliefMap,
};

/// Elements per side.
const ELEMENTS: usize = 512;
/// Elements per side of the grid with elements half as wide.
const TWICE_THE_ELEMENTS: usize = 1024;
/// Every cell takes at most this many products, on both grids.
const MOST_PRODUCTS: usize = 40;
/// Side and samples per side of the rough map.
const SIDE: f64 = 0.3;
const SAMPLES: usize = 512;
/// Stiffness of the coating over the base's, and its thickness.
const COATINGS: [[f64; 2]; 8] = [
    [1.0, 0.003],
    [10.0, 0.003],
    [30.0, 0.003],
    [100.0, 0.003],
    [300.0, 0.003],
    [1000.0, 0.003],
    [3000.0, 0.003],
    [30.0, 0.02],
];

/// Heights of root mean square 1, Hurst exponent 0.8, waves from half of the side to two samples.
static HEIGHTS: LazyLock<Vec<f64>> = LazyLock::new(|| {
    let surface = SelfAffine {
        size: SAMPLES,
        waves: [2.0, 256.0],
        hurst: 0.8,
        rms: 1.0,
        seed: 1,
    };
    surface.heights().unwrap()
});

fn rough(rms: f64, compliance: f64) -> Relief {
    let heights = HEIGHTS.iter().map(|height| rms * height).collect();
    let map = HeightMap::new(heights, [SAMPLES; 2], [SIDE; 2]).unwrap();
    Relief::Map(ReliefMap::new(map, MapCompliance::Uniform(compliance)).unwrap())
}

fn pillars(young_modulus: f64) -> Relief {
    let spec = CylinderSpec {
        lattice: Lattice::Square,
        radius: 0.005,
        height: 0.001,
        period: 0.0125,
        offset: [0.0031, 0.0017],
        young_modulus,
    };
    Relief::Cylinders(Cylinders::new(spec).unwrap())
}

fn solve(elements: usize, coating: [f64; 2], relief: Relief) -> Step {
    solve_up_to(f64::INFINITY, elements, coating, relief)
}

/// The same with a hardness.
fn solve_up_to(hardness: f64, elements: usize, coating: [f64; 2], relief: Relief) -> Step {
    let paraboloid = Indenter::Paraboloid(Paraboloid::new(1.0).unwrap());
    solve_under(paraboloid, hardness, elements, coating, relief)
}

/// The same paraboloid without a declared symmetry, so that the whole grid is solved.
#[derive(Debug)]
struct Asymmetric(Paraboloid);

impl Profile for Asymmetric {
    fn height(&self, x: f64, y: f64) -> f64 {
        self.0.height(x, y)
    }
}

fn solve_under(
    indenter: Indenter,
    hardness: f64,
    elements: usize,
    [stiffness, thickness]: [f64; 2],
    relief: Relief,
) -> Step {
    let material = |young_modulus| Material::new(young_modulus, 0.3).unwrap();
    let body = Foundation::coated(thickness, material(stiffness), material(1.0)).unwrap();
    let model = Model {
        tables: Arc::new(RadialTables::build(&body).unwrap()),
        relief,
        indenter,
        cache: Cache::none(),
    };
    let options = SolverOptions {
        contact_stiffness: false,
        hardness,
        ..SolverOptions::default()
    };
    let load = [Load::Force(4.0 / 3.0 * 0.08_f64.powi(3) / 0.91)];
    let path = solve_path(
        &model,
        Domain::Automatic,
        elements,
        &load,
        &options,
        &mut (),
    );
    path.unwrap().steps.remove(0)
}

fn assert_few_products(elements: usize, name: &str, relief: impl Fn(f64) -> Relief) {
    for coating in COATINGS {
        let step = solve(elements, coating, relief(coating[0]));
        let certificate = step.solution.certificate;
        assert!(
            certificate.is_satisfied(),
            "{name} {coating:?}: {certificate:?}"
        );
        let taken = step.work.operator_applications;
        assert!(
            taken <= MOST_PRODUCTS,
            "{name} {coating:?}: {taken} products"
        );
    }
}

#[test]
fn bare_coatings_take_few_products() {
    assert_few_products(ELEMENTS, "bare", |_| Relief::Bare);
}

#[test]
fn a_very_stiff_coating_on_the_whole_grid_takes_few_products() {
    // 24; 643 when the images of remembered steps were correct only near the elements that left.
    let indenter = Indenter::custom(Asymmetric(Paraboloid::new(1.0).unwrap()));
    let (elements, coating) = (TWICE_THE_ELEMENTS, [5000.0, 0.003]);
    let step = solve_under(indenter, f64::INFINITY, elements, coating, Relief::Bare);
    let certificate = step.solution.certificate;
    assert!(certificate.is_satisfied(), "{certificate:?}");
    let taken = step.work.operator_applications;
    assert!(taken <= 30, "{taken} products");
}

#[test]
fn pillars_beside_the_axis_take_few_products() {
    assert_few_products(ELEMENTS, "pillars", pillars);
}

#[test]
fn a_rough_surface_takes_few_products() {
    assert_few_products(ELEMENTS, "rough", |_| rough(2e-4, 0.0));
}

#[test]
fn a_rough_film_of_springs_takes_few_products() {
    assert_few_products(ELEMENTS, "rough film", |_| rough(5e-5, 1e-5));
}

#[test]
fn a_rough_coating_with_a_hardness_takes_few_products() {
    // The hardness in units of E of the base, and the most products: 64 and 36, but 100 and 50 with problems between
    // exchanges solved no better than under a soft coating.
    for (hardness, most) in [(0.1, 80), (0.4, 45)] {
        let step = solve_up_to(hardness, 256, COATINGS[1], rough(2e-4, 0.0));
        let certificate = step.solution.certificate;
        assert!(certificate.is_satisfied(), "{hardness}: {certificate:?}");
        let taken = step.work.operator_applications;
        assert!(taken <= most, "{hardness}: {taken} products");
    }
}

#[test]
#[ignore = "a minute of processor time with optimisation, several without"]
fn no_cell_takes_more_products_with_elements_of_half_the_side() {
    let elements = TWICE_THE_ELEMENTS;
    assert_few_products(elements, "bare", |_| Relief::Bare);
    assert_few_products(elements, "pillars", pillars);
    assert_few_products(elements, "rough", |_| rough(2e-4, 0.0));
    assert_few_products(elements, "rough film", |_| rough(5e-5, 1e-5));
}
