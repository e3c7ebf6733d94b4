//! Periodic cells: a nominal pressure or a penetration as load, oblong cells.

use std::path::Path;
use std::sync::Arc;

use pellicle::case::map_sources::MapSources;
use pellicle::case::unit_slip;
use pellicle::input::span::Source;
use pellicle::summary::StepSummary;
use pellicle::{Case, Error};

/// Samples per side of the map.
const SAMPLES: usize = 32;

/// 5 µm of a polymer on a rigid base with a rough surface in a cell of 10 µm, under a flat body, with lines `load` and
/// `more`.
fn text(load: &str, more: &str) -> String {
    format!(
        "[foundation]\nsubstrate = \"rigid\"\n\
         layer = [{{ thickness = \"5 um\", young_modulus = \"1 GPa\", poisson_ratio = 0.3 }}]\n\
         [surface]\nkind = \"rough\"\nfile = \"waves\"\nside = \"10 um\"\n\
         [indenter]\nkind = \"paraboloid\"\nradius = \"1 km\"\n[load]\n{load}\n\
         [grid]\nelements = {SAMPLES}\nside = \"10 um\"\n{more}"
    )
}

/// Waves of 30 nm, two along x and three along y, with a smaller one along the diagonal.
fn waves() -> MapSources {
    repeated_waves([1, 1])
}

/// The same so many times along x and y.
fn repeated_waves(times: [usize; 2]) -> MapSources {
    let [rows, columns] = times.map(|times| times * SAMPLES);
    let height = |element: usize| {
        let [x, y] = [element / columns, element % columns]
            .map(|i| std::f64::consts::TAU * (i % SAMPLES) as f64 / SAMPLES as f64);
        30e-9 * (2.0 * x).cos() * (3.0 * y).cos() + 10e-9 * (x + y).sin()
    };
    let heights = (0..rows * columns).map(height).collect();
    MapSources::in_folder(Path::new("")).with_array("waves", [rows, columns], heights)
}

/// A cell of this many square ones along x and y.
fn oblong(times: [usize; 2], load: &str, elements: &str) -> Result<Case, String> {
    let [x, y] = times.map(|times| 10 * times);
    let sides = format!("sides = [\"{x} um\", \"{y} um\"]");
    let text = text(load, "boundary = \"periodic\"")
        .replace("side = \"10 um\"", &sides)
        .replace(
            &format!("elements = {SAMPLES}"),
            &format!("elements = {elements}"),
        );
    read_with(&text, &repeated_waves(times))
}

fn read(text: &str) -> Result<Case, String> {
    read_with(text, &waves())
}

fn read_with(text: &str, maps: &MapSources) -> Result<Case, String> {
    let source = Arc::new(Source::new("case.toml", text.to_owned()));
    Case::parse_with(&source, "case", maps).map_err(|error| error.to_string())
}

/// The steps of the periodic cell under this load, all certified.
fn steps(load: &str) -> Vec<StepSummary> {
    solved(&read(&text(load, "boundary = \"periodic\"")).expect("a valid case"))
}

fn solved(case: &Case) -> Vec<StepSummary> {
    let run = case.solve(&mut ());
    let run = run.map_err(|error: Error| error.to_string());
    let summary = run.expect("a solution").summary;
    assert!(summary.is_certified(), "{:?}", case.load);
    summary.steps
}

#[test]
fn a_nominal_pressure_is_the_force_over_the_area_of_the_cell() {
    // 1 MPa on 1e-10 m².
    for (pressure, force) in [
        ("pressure = \"1 MPa\"", "force = \"100 uN\""),
        (
            "pressures = { from = \"1 MPa\", to = \"4 MPa\", count = 2 }",
            "forces = [\"100 uN\", \"400 uN\"]",
        ),
    ] {
        let (found, wanted) = (steps(pressure), steps(force));
        assert_eq!(found.len(), wanted.len());
        for (found, wanted) in found.iter().zip(&wanted) {
            let same = |found: f64, wanted: f64| {
                // The force is rounded in its last digits; the equations are solved to 1e-8 anyway.
                approx::assert_relative_eq!(found, wanted, max_relative = 1e-12);
            };
            same(found.force, wanted.force);
            same(found.penetration, wanted.penetration);
            same(found.summary.max_pressure, wanted.summary.max_pressure);
            let nominal = found.summary.nominal_pressure.expect("that of the cell");
            same(nominal, found.force / 1e-10);
        }
    }
}

#[test]
fn on_a_rigid_base_a_penetration_takes_the_force_that_gives_it() {
    let by_force = &steps("force = \"100 uN\"")[0];
    let found = &steps(&format!("penetration = {:e}", by_force.penetration))[0];
    // The tolerance of the solver.
    approx::assert_relative_eq!(found.force, 1e-4, max_relative = 3e-8);
    assert!((found.penetration - by_force.penetration).abs() <= 0.0);
    approx::assert_relative_eq!(
        found.summary.contact_area,
        by_force.summary.contact_area,
        max_relative = 1e-6
    );
}

#[test]
fn a_penetration_of_a_half_space_or_of_an_elastic_indenter_is_refused() {
    let load = "penetration = \"10 nm\"";
    let rigid = text(load, "boundary = \"periodic\"");
    let elastic = "{ young_modulus = \"70 GPa\", poisson_ratio = 0.2 }";
    let on_half_space = rigid.replace("\"rigid\"", elastic);
    let indenter = "[indenter]\nyoung_modulus = \"70 GPa\"\npoisson_ratio = 0.2";
    let under_elastic = rigid.replace("[indenter]", indenter);
    for (text, half_space) in [
        (on_half_space, "the substrate's, unless it is \"rigid\""),
        (under_elastic, "an elastic indenter's"),
    ] {
        let told = read(&text).expect_err("an infinite mean");
        let start = "found \"10 nm\", with grid.boundary = \"periodic\", wanted force or forces, or pressure or pressures";
        assert!(
            told.contains("key `load.penetration`") && told.contains(start),
            "{told}"
        );
        assert!(told.ends_with(half_space), "{told}");
    }
}

#[test]
fn layers_that_cannot_shorten_have_no_penetration_beyond_their_gaps() {
    let load = "penetration = \"1 um\"";
    let text = text(load, "boundary = \"periodic\"").replace("= 0.3", "= 0.5");
    let refused = read(&text).expect("a valid case").solve(&mut ());
    let told = refused.expect_err("beyond the gaps").to_string();
    assert!(
        told.contains("load.penetration") && told.contains("incompressible"),
        "{told}"
    );
}

/// 20 GPa on a cell of 0.5 mm press a ball of that radius on a polymer with 5 kN.
#[test]
fn another_unit_of_a_nominal_pressure_is_asked_for_like_that_of_a_force() {
    let text = "[foundation]\nsubstrate = { young_modulus = \"3 GPa\", poisson_ratio = 0.35 }\n\
        [indenter]\nkind = \"sphere\"\nradius = \"0.5 mm\"\n[load]\npressure = \"20 GPa\"\n\
        [grid]\nelements = 32\nside = \"0.5 mm\"\nboundary = \"periodic\"";
    let case = read(text).expect("a valid case");
    let question = unit_slip::question(&case).expect("a question");
    assert_eq!(question, "load.pressure is given as 20 GPa: was MPa meant?");
}

#[test]
fn a_nominal_pressure_on_a_free_surface_is_refused_with_what_to_give_instead() {
    for load in ["pressure = \"1 MPa\"", "pressures = [\"1 MPa\"]"] {
        let told = read(&text(load, "")).expect_err("no nominal area");
        for words in [
            "line 12, key `load.pressure",
            "with grid.boundary = \"free\"",
            "wanted force or forces, or grid.boundary = \"periodic\"",
        ] {
            assert!(told.contains(words), "{told}");
        }
    }
}

#[test]
fn a_rough_cell_twice_side_by_side_has_twice_of_everything_and_the_same_pressures() {
    let one = &steps("pressure = \"2 MPa\"")[0];
    let of = |step: &StepSummary| step.rough_contact.clone().expect("a rough contact");
    for (times, elements) in [([2, 1], "64"), ([1, 2], "[32, 64]"), ([3, 1], "96")] {
        let many = times.into_iter().product::<usize>();
        let case = oblong(times, "pressure = \"2 MPa\"", elements).expect("a valid case");
        let several = &solved(&case)[0];
        let same = |found: f64, wanted: f64| {
            // The tolerance of the solver; maps are interpolated at shifted places.
            approx::assert_relative_eq!(found, wanted, max_relative = 1e-6);
        };
        same(several.force, many as f64 * one.force);
        // Penetrations are measured from the highest point, which is located between samples.
        let [found, wanted] = [several, one].map(|step| step.penetration);
        approx::assert_relative_eq!(found, wanted, max_relative = 1e-5);
        same(several.summary.max_pressure, one.summary.max_pressure);
        let nominal = several.summary.nominal_pressure.expect("that of the cell");
        same(nominal, 2e6);
        let (found, wanted) = (of(several), of(one));
        assert_eq!(found.islands.count, many * wanted.islands.count);
        same(found.nominal_area, many as f64 * wanted.nominal_area);
        same(found.contact_fraction, wanted.contact_fraction);
        same(found.perimeter, many as f64 * wanted.perimeter);
        same(found.mean_gap, wanted.mean_gap);
    }
}

#[test]
fn a_map_of_other_sides_than_the_cell_is_refused() {
    let text = text("force = \"1 uN\"", "boundary = \"periodic\"");
    let text = text.replace(
        "elements = 32\nside = \"10 um\"",
        "elements = 64\nsides = [\"20 um\", \"10 um\"]",
    );
    let told = read_with(&text, &waves()).expect_err("another size");
    assert!(
        told.contains("key `surface.side`") && told.contains("2e-5 by 1e-5 m"),
        "{told}"
    );
}

/// Random waves of two samples and more, rolled by whole samples.
fn rolled(seed: u32, by: [usize; 2]) -> MapSources {
    let noise = |i: usize, j: usize| {
        let (i, j) = ((i + by[0]) % SAMPLES, (j + by[1]) % SAMPLES);
        let large = ((i * SAMPLES + j) as f64 * 7.13 + f64::from(seed)).sin() * 43_758.545;
        large - large.floor()
    };
    let height = |n: usize| {
        let (i, j) = (n / SAMPLES, n % SAMPLES);
        10e-9 * (noise(i, j) + noise(i + 1, j) + noise(i, j + 1) + noise(i + 1, j + 1))
    };
    let heights = (0..SAMPLES * SAMPLES).map(height).collect();
    MapSources::in_folder(Path::new("")).with_array("waves", [SAMPLES; 2], heights)
}

#[test]
fn a_rough_cell_gives_the_same_wherever_its_map_is_cut() {
    let text = text("pressure = \"20 MPa\"", "boundary = \"periodic\"");
    for seed in 0..6 {
        let at = |by| {
            let case = read_with(&text, &rolled(seed, by)).unwrap();
            solved(&case)[0].clone()
        };
        let wanted = at([0, 0]);
        for by in [[3, 0], [16, 5], [31, 30]] {
            let found = at(by);
            for (found, wanted) in [
                (found.penetration, wanted.penetration),
                (found.summary.contact_area, wanted.summary.contact_area),
                (found.summary.max_pressure, wanted.summary.max_pressure),
            ] {
                // The tolerance of the solver.
                assert!(
                    (found / wanted - 1.0).abs() < 1e-6,
                    "{seed} {by:?}: {found} {wanted}"
                );
            }
        }
    }
}
