//! The contacts on which the error bars are tested.

use std::f64::consts::{FRAC_PI_4, PI, TAU};
use std::path::Path;
use std::sync::Arc;

use pellicle::Case;
use pellicle::input::span::Source;
use pellicle_cli::Template;
use pellicle_contact::{Cone, FlatPunch, Indenter, Load, Pyramid, Sphere, default_side, reference};
use pellicle_influence::Cache;
use pellicle_kernel::Foundation;
use pellicle_texture::{Film, HeightMap, MapCompliance, Relief, ReliefMap};
use pellicle_validation::data::contact::{AxisymmetricContact, AxisymmetricIndenter, axisymmetric};

use super::{Benchmark, GridQuantity};
use crate::scene::{coated, cylinders, figure_2, material, model, paraboloid, unit_half_space};

/// All benchmarks.
///
/// # Panics
/// If one cannot be built.
#[must_use]
pub fn benchmarks() -> Vec<Benchmark> {
    let mut all = closed_forms();
    all.extend(pyramids());
    all.extend(layered());
    all.extend(reliefs());
    all.extend(figure_2().map(|panel| Benchmark {
        name: format!("Fig. {}", panel.name),
        model: panel.model,
        side: panel.side,
        load: panel.load,
        known: Vec::new(),
    }));
    all.extend(templates());
    all
}

fn benchmark(
    name: &str,
    body: &Foundation,
    relief: Relief,
    indenter: Indenter,
    side: f64,
    load: Load,
) -> Benchmark {
    Benchmark {
        name: name.into(),
        model: model(body, relief, indenter),
        side,
        load,
        known: Vec::new(),
    }
}

fn bare(
    name: &str,
    indenter: Indenter,
    side: f64,
    load: Load,
    known: Vec<(GridQuantity, f64)>,
) -> Benchmark {
    Benchmark {
        known,
        ..benchmark(name, &unit_half_space(), Relief::Bare, indenter, side, load)
    }
}

/// Paraboloid, sphere, sharp cone and flat punch on a half-space.
fn closed_forms() -> Vec<Benchmark> {
    use GridQuantity::{ContactArea, Force, MaxPressure, Penetration};
    let hertz = reference::hertz::from_contact_radius(1.0, 1.0, 0.1);
    let sphere = reference::sphere::from_contact_radius(1.0, 1.0, 0.35);
    let cone = reference::cone::from_penetration(1.2, 1.0, 0.1);
    let punch = reference::flat_punch::from_force(0.1, 1.0, 0.02);
    let area = |radius: f64| (ContactArea, PI * radius * radius);
    let of_hertz = |other| vec![area(0.1), (MaxPressure, hertz.pressure(0.0)), other];
    vec![
        bare(
            "Hertz, force",
            paraboloid(1.0),
            0.3,
            Load::Force(hertz.force),
            of_hertz((Penetration, hertz.penetration)),
        ),
        bare(
            "Hertz, penetration",
            paraboloid(1.0),
            0.3,
            Load::Penetration(hertz.penetration),
            of_hertz((Force, hertz.force)),
        ),
        bare(
            "sphere",
            Indenter::Sphere(Sphere::new(1.0).expect("a sphere")),
            1.05,
            Load::Force(sphere.force),
            vec![(Penetration, sphere.penetration), area(0.35)],
        ),
        bare(
            "sharp cone",
            Indenter::Cone(Cone::new(1.2, 0.0).expect("a cone")),
            3.0 * cone.contact_radius,
            Load::Force(cone.force),
            vec![(Penetration, cone.penetration), area(cone.contact_radius)],
        ),
        bare(
            "rounded cone",
            Indenter::Cone(Cone::new(1.2, 0.1).expect("a cone")),
            3.0 * cone.contact_radius,
            Load::Force(cone.force),
            Vec::new(),
        ),
        bare(
            "flat punch",
            Indenter::FlatPunch(FlatPunch::new(0.1).expect("a punch")),
            0.25,
            Load::Force(punch.force),
            vec![(Penetration, punch.penetration), area(0.1)],
        ),
    ]
}

fn pyramids() -> Vec<Benchmark> {
    let pyramid = |name, pyramid: Result<Pyramid, _>| {
        let indenter = Indenter::Pyramid(pyramid.expect("a pyramid"));
        bare(name, indenter, 1.0, Load::Force(0.02), Vec::new())
    };
    vec![
        pyramid("sharp Berkovich", Pyramid::berkovich(0.0)),
        pyramid("rounded Berkovich", Pyramid::berkovich(0.1)),
        pyramid("rounded Vickers", Pyramid::vickers(0.05)),
    ]
}

/// Coated bodies: the axisymmetric contacts known to 22 digits, a soft coating, and a plate on a soft base.
fn layered() -> Vec<Benchmark> {
    let of = |case: AxisymmetricContact| {
        let body = coated(
            case.thickness,
            material(case.e1, case.nu1),
            material(1.0, case.nu2),
        );
        let (shape, indenter) = match case.shape {
            AxisymmetricIndenter::Paraboloid => ("paraboloid", paraboloid(1.0)),
            AxisymmetricIndenter::Cone => (
                "cone",
                Indenter::Cone(Cone::new(FRAC_PI_4, 0.0).expect("a cone")),
            ),
        };
        let name = format!("{shape}, E₁ = {}, H = {} a", case.e1, case.thickness);
        Benchmark {
            known: vec![
                (GridQuantity::Penetration, case.penetration),
                (GridQuantity::ContactArea, PI),
            ],
            ..benchmark(
                &name,
                &body,
                Relief::Bare,
                indenter,
                2.4,
                Load::Force(case.force),
            )
        }
    };
    let cases = axisymmetric().expect("the data");
    let mut all: Vec<_> = cases.into_iter().map(of).collect();
    let soft = coated(0.2, material(0.05, 0.45), material(1.0, 0.3));
    all.push(benchmark(
        "soft coating",
        &soft,
        Relief::Bare,
        paraboloid(1.0),
        2.4,
        Load::Force(0.2),
    ));
    all
}

fn reliefs() -> Vec<Benchmark> {
    let film = |thickness, modulus| Relief::Film(Film::new(thickness, modulus).expect("a film"));
    let body = unit_half_space();
    let ball = || paraboloid(1.0);
    vec![
        benchmark(
            "soft film",
            &body,
            film(0.02, 0.2),
            ball(),
            1.0,
            Load::Force(0.02),
        ),
        benchmark(
            "film",
            &body,
            film(0.02, 2.0),
            ball(),
            0.8,
            Load::Force(0.02),
        ),
        benchmark(
            "rigid pillars",
            &body,
            cylinders(0.02, 0.02, 0.07, 1e9),
            ball(),
            0.6,
            Load::Force(0.003),
        ),
        benchmark(
            "rough body",
            &body,
            rough(),
            ball(),
            0.8,
            Load::Force(0.005),
        ),
        benchmark(
            "soft pillars",
            &body,
            cylinders(0.03, 0.01, 0.1, 0.5),
            ball(),
            0.8,
            Load::Force(0.005),
        ),
    ]
}

/// A rough half-space: waves in all directions, three to ten along the map of side 1.2, with an rms height of 0.001 and
/// at least 13 samples per wave.
fn rough() -> Relief {
    const SAMPLES: usize = 128;
    const SIDE: f64 = 1.2;
    let waves: Vec<[f64; 3]> = (-10_i32..=10)
        .flat_map(|m| (0..=10).map(move |n| [m, n]))
        .filter(|[m, n]| (9..=100).contains(&(m * m + n * n)))
        // Pseudo-random phases, advanced by the golden angle after each wave.
        .zip(0_u32..)
        .map(|([m, n], k)| {
            [
                f64::from(m),
                f64::from(n),
                2.399_963_229_728_653 * f64::from(k * k),
            ]
        })
        .collect();
    let amplitude = 1e-3 * (2.0 / waves.len() as f64).sqrt();
    let at = |i: usize| (i as f64 + 0.5) / SAMPLES as f64;
    let height = |k: usize| -> f64 {
        let (x, y) = (at(k / SAMPLES), at(k % SAMPLES));
        let wave = |[m, n, phase]: &[f64; 3]| (TAU * (m * x + n * y) + phase).cos();
        amplitude * waves.iter().map(wave).sum::<f64>()
    };
    let heights = (0..SAMPLES * SAMPLES).map(height).collect();
    let map = HeightMap::new(heights, [SAMPLES; 2], [SIDE; 2]).expect("a map");
    Relief::Map(ReliefMap::new(map, MapCompliance::Uniform(0.0)).expect("a relief"))
}

/// The last load of every case of `pellicle init`.
fn templates() -> Vec<Benchmark> {
    let all = [
        Template::Cylinders,
        Template::Film,
        Template::Coating,
        Template::Berkovich,
        Template::Vickers,
        Template::CubeCorner,
        Template::Cone,
        Template::FlatPunch,
        Template::Hertz,
    ];
    all.map(|template| {
        let source = Arc::new(Source::new(
            format!("{template:?}"),
            template.text().into_owned(),
        ));
        let case = Case::parse(&source, "", Path::new(""), &[]).expect("a case");
        let model = case.model(&Cache::none()).expect("tables").value;
        let load = *case.loads().last().expect("a load");
        Benchmark {
            name: format!("init {}", format!("{template:?}").to_lowercase()),
            side: case
                .grid
                .side
                .unwrap_or_else(|| default_side(&model, &[load])),
            model,
            load,
            known: Vec::new(),
        }
    })
    .into()
}
