//! Each shortcut to a solution switched off alone, and all together: the same certified numbers.

#![expect(
    clippy::unwrap_used,
    reason = "a scene that cannot be built fails its test"
)]

use std::f64::consts::TAU;
use std::sync::Arc;

use pellicle_contact::{
    Domain, FlatPunch, Indenter, Load, Model, Paraboloid, Pyramid, Shortcuts, SolverOptions, Step,
    solve_path,
};
use pellicle_influence::{Cache, RadialTables};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::{
    CylinderSpec, Cylinders, HeightMap, Lattice, MapCompliance, Relief, ReliefMap,
};
use rayon::prelude::*;

/// Gaps closed to this part of the penetration agree so well that the numbers do to about 1e3 times it.
const TOLERANCE: f64 = 1e-10;
const SAME: f64 = 1e-6;

/// Most products with `K`: without shortcuts a stiff coating takes some hundred.
const MOST_PRODUCTS: usize = 20_000;

/// Samples along a side of the rough map, and its waves.
const SAMPLES: usize = 128;
const WAVES: u32 = 40;

/// A problem, its domain and elements, and the loads of a path.
struct Scene {
    name: &'static str,
    model: Model,
    domain: Domain,
    elements: usize,
    loads: Vec<Load>,
    hardness: f64,
}

/// A scene on a square of side 0.4, under the force that makes a contact of radius 0.1 on a body of modulus 1.
fn scene(name: &'static str, model: Model) -> Scene {
    Scene {
        name,
        model,
        domain: Domain::Side(0.4),
        elements: 48,
        loads: vec![Load::Force(4e-3 / 3.0)],
        hardness: f64::INFINITY,
    }
}

fn body() -> Foundation {
    Foundation::half_space(Material::new(1.0, 0.0).unwrap())
}

/// A coating of this modulus, 0.01 thick, on a body of modulus 1.
fn coated(modulus: f64) -> Foundation {
    let [coating, base] = [modulus, 1.0].map(|modulus| Material::new(modulus, 0.0).unwrap());
    Foundation::coated(0.01, coating, base).unwrap()
}

fn ball() -> Indenter {
    Paraboloid::new(1.0).unwrap().into()
}

fn plane() -> Indenter {
    Indenter::FlatPunch(FlatPunch::new(2.0).unwrap())
}

fn pillars() -> Relief {
    let spec = CylinderSpec {
        lattice: Lattice::Square,
        radius: 0.02,
        height: 1e-3,
        period: 0.05,
        offset: [0.0; 2],
        young_modulus: 1.0,
    };
    Relief::Cylinders(Cylinders::new(spec).unwrap())
}

/// Waves of equal slope in all directions on a side of 0.4, of this root mean square slope or so.
fn rough(slope: f64) -> Relief {
    let height = |x: f64, y: f64| -> f64 {
        let waves = (0..WAVES).map(|wave| {
            let wave = f64::from(wave);
            // The golden angle scatters directions, and multiples of it phases.
            let (direction, phase) = (2.399_963 * wave, 8.885_766 * wave * wave);
            let number = (2.0 + 14.0 * wave / f64::from(WAVES)).round();
            let [along_x, along_y] =
                [direction.cos(), direction.sin()].map(|c| (number * c).round());
            (TAU * (along_x * x + along_y * y) + phase).sin() / number
        });
        0.4 * slope / TAU * waves.sum::<f64>() / f64::from(WAVES).sqrt()
    };
    let places = (0..SAMPLES).map(|i| i as f64 / SAMPLES as f64);
    let heights = places
        .clone()
        .flat_map(|x| places.clone().map(move |y| height(x, y)));
    let map = HeightMap::new(heights.collect(), [SAMPLES; 2], [0.4; 2]).unwrap();
    Relief::Map(ReliefMap::new(map, MapCompliance::Uniform(0.0)).unwrap())
}

fn model(foundation: &Foundation, relief: Relief, indenter: Indenter) -> Model {
    Model {
        tables: Arc::new(RadialTables::build(foundation).unwrap()),
        relief,
        indenter,
        cache: Cache::none(),
    }
}

/// A dozen problems, among which each shortcut is taken.
fn scenes() -> Vec<Scene> {
    let three_faces: Indenter = Pyramid::new(3, 1.2, 0.0).unwrap().into();
    let forces = [1.0, 2.0, 0.5]
        .map(|part| Load::Force(part * 4e-3 / 3.0))
        .to_vec();
    vec![
        scene("ball", model(&body(), Relief::Bare, ball())),
        scene("soft coating", model(&coated(0.2), Relief::Bare, ball())),
        scene("coating", model(&coated(10.0), Relief::Bare, ball())),
        scene("stiff coating", model(&coated(300.0), Relief::Bare, ball())),
        scene("pillars", model(&body(), pillars(), ball())),
        scene(
            "pillars on a coating",
            model(&coated(30.0), pillars(), ball()),
        ),
        scene(
            "three faces",
            model(&coated(10.0), Relief::Bare, three_faces),
        ),
        scene("rough", model(&body(), rough(0.05), ball())),
        Scene {
            elements: 192,
            loads: vec![Load::Force(4e-3)],
            ..scene(
                "rough on a coating",
                model(&coated(30.0), rough(0.2), ball()),
            )
        },
        Scene {
            loads: vec![Load::Penetration(0.01)],
            ..scene("penetration", model(&coated(0.2), pillars(), ball()))
        },
        Scene {
            loads: forces,
            ..scene("three loads", model(&coated(3.0), pillars(), ball()))
        },
        Scene {
            // Half the peak of the contact: 3 Q/(2 π a²).
            hardness: 0.03,
            ..scene("hardness", model(&body(), Relief::Bare, ball()))
        },
        Scene {
            domain: Domain::Periodic(0.4),
            ..scene("cell", model(&body(), rough(0.05), plane()))
        },
        Scene {
            elements: 512,
            loads: vec![Load::Force(1e-4)],
            ..scene("dilute", model(&body(), rough(0.2), plane()))
        },
    ]
}

/// Solves a scene; every step is certified.
fn solved(scene: &Scene, shortcuts: Shortcuts, mirror_symmetry: bool) -> Vec<Step> {
    let options = SolverOptions {
        tolerance: TOLERANCE,
        max_applications: MOST_PRODUCTS,
        hardness: scene.hardness,
        mirror_symmetry,
        shortcuts,
        ..SolverOptions::default()
    };
    let Scene {
        model,
        domain,
        elements,
        loads,
        ..
    } = scene;
    let path = solve_path(model, *domain, *elements, loads, &options, &mut ()).unwrap();
    for step in &path.steps {
        let certificate = step.solution.certificate;
        assert!(
            certificate.is_satisfied(),
            "{}, {shortcuts:?}: {certificate:?}",
            scene.name
        );
    }
    path.steps
}

fn assert_same(of: &str, found: &[Step], wanted: &[Step]) {
    assert_eq!(found.len(), wanted.len(), "{of}");
    for (found, wanted) in found.iter().zip(wanted) {
        let numbers = |step: &Step| {
            let (solution, summary) = (&step.solution, &step.summary);
            [
                solution.penetration,
                solution.force,
                summary.max_pressure,
                summary.mean_pressure,
                summary.contact_area,
            ]
        };
        for (one, other) in numbers(found).into_iter().zip(numbers(wanted)) {
            assert!((one - other).abs() <= SAME * other, "{of}: {one} {other}");
        }
        let peak = wanted.summary.max_pressure;
        let pressures = found
            .solution
            .pressure
            .iter()
            .zip(&wanted.solution.pressure);
        for (one, other) in pressures {
            assert!((one - other).abs() <= SAME * peak, "{of}: {one} {other}");
        }
        let [one, other] = [found, wanted].map(|step| step.contact_stiffness.unwrap_or(0.0));
        // The stiffness is accurate to about 1e-6.
        assert!((one - other).abs() <= 1e-5 * other, "{of}: {one} {other}");
    }
}

/// The shortcuts by name, each alone switched off.
fn switched_off() -> [(&'static str, Shortcuts); 8] {
    let without = |off: fn(&mut Shortcuts)| {
        let mut shortcuts = Shortcuts::ALL;
        off(&mut shortcuts);
        shortcuts
    };
    [
        ("coarser grids", without(|on| on.coarser_grids = false)),
        ("guess", without(|on| on.guess = false)),
        ("windows", without(|on| on.windows = false)),
        ("candidates", without(|on| on.candidates = false)),
        ("memory", without(|on| on.memory = false)),
        ("edge band", without(|on| on.edge_band = false)),
        ("sparse factor", without(|on| on.sparse_factor = false)),
        ("all", Shortcuts::NONE),
    ]
}

#[test]
fn without_any_shortcut_and_without_each_the_certified_numbers_are_the_same() {
    scenes().par_iter().for_each(|scene| {
        let wanted = solved(scene, Shortcuts::ALL, true);
        for (name, shortcuts) in switched_off() {
            let of = format!("{} without {name}", scene.name);
            let found = solved(scene, shortcuts, shortcuts != Shortcuts::NONE);
            assert_same(&of, &found, &wanted);
        }
        let of = format!("{} on all of the grid", scene.name);
        assert_same(&of, &solved(scene, Shortcuts::ALL, false), &wanted);
    });
}

/// Iterations, products with `K` and those among candidates on each grid of the first load.
fn work(steps: &[Step]) -> Vec<[usize; 3]> {
    let levels = steps[0].work.levels.iter();
    let work = levels.map(|level| {
        [
            level.iterations,
            level.operator_applications,
            level.candidate_applications,
        ]
    });
    work.collect()
}

#[test]
fn each_shortcut_that_saves_steps_on_small_grids_is_left_out_when_it_is_off() {
    let scenes = scenes();
    let works: Vec<_> = scenes
        .par_iter()
        .map(|scene| {
            let with = work(&solved(scene, Shortcuts::ALL, true));
            switched_off().map(|(_, shortcuts)| with != work(&solved(scene, shortcuts, true)))
        })
        .collect();
    for (index, (name, _)) in switched_off().iter().enumerate() {
        // Windows and the memory of fields save time, not products.
        let saves_products = !["windows", "memory"].contains(name);
        let differs = works.iter().any(|differs| differs[index]);
        assert!(differs || !saves_products, "{name}");
    }
}

#[test]
fn threads_and_a_cache_on_disk_change_no_bit() {
    let folder = tempfile::tempdir().unwrap();
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .unwrap();
    scenes().into_iter().for_each(|mut scene| {
        let bits = |scene: &Scene| -> Vec<u64> {
            let steps = solved(scene, Shortcuts::ALL, true);
            let pressures = steps.iter().flat_map(|step| &step.solution.pressure);
            pressures.map(|pressure| pressure.to_bits()).collect()
        };
        let wanted = bits(&scene);
        assert!(
            pool.install(|| bits(&scene)) == wanted,
            "{}, one thread",
            scene.name
        );
        // Computed and kept, then read.
        for pass in 0..2 {
            scene.model.cache = Cache::storing_from(1, folder.path());
            assert!(bits(&scene) == wanted, "{}, cache, {pass}", scene.name);
        }
    });
}
