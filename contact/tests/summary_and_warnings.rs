//! Summary and warnings: the summary recomputed from the pressure, and the warnings with their numbers.

#![expect(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a scene that cannot be built fails its test; sums and zeros that must be the same bits"
)]

use std::sync::Arc;

use pellicle_contact::{
    Cone, Domain, FlatPunch, Indenter, Load, LoadingPath, Model, Paraboloid, PeakPlace,
    SolverOptions, Step, Warning, model_warnings, solve_path,
};
use pellicle_influence::{Cache, RadialTables};
use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};
use pellicle_texture::{CylinderSpec, Cylinders, Film, Grid, Lattice, Relief};

/// A paraboloid of radius 1 on layers of the given thicknesses over a body of plane-strain modulus 1.
fn model(thicknesses: &[f64], relief: Relief) -> Model {
    let body = Material::new(1.0, 0.0).unwrap();
    // No two neighbours are equal.
    let material = |layer: usize| Material::new([1.0, 10.0][layer % 2], 0.0).unwrap();
    let layers = thicknesses
        .iter()
        .enumerate()
        .map(|(i, thickness)| Layer::new(*thickness, material(i), Interface::Bonded).unwrap());
    let foundation = Foundation::new(layers.collect(), Base::HalfSpace(body)).unwrap();
    Model {
        tables: Arc::new(RadialTables::build(&foundation).unwrap()),
        relief,
        indenter: Indenter::Paraboloid(Paraboloid::new(1.0).unwrap()),
        cache: Cache::none(),
    }
}

/// Cylinders off the axes of the grid, with the given radius and a period of 0.05.
fn cylinders(radius: f64) -> Relief {
    let spec = CylinderSpec {
        lattice: Lattice::Square,
        radius,
        height: 2e-4,
        period: 0.05,
        offset: [0.013, 0.004],
        young_modulus: 1.0,
    };
    Relief::Cylinders(Cylinders::new(spec).unwrap())
}

#[test]
fn a_penetration_at_which_nothing_touches_is_warned_of_once() {
    // The tops of the pillars stand beside the axis: 0.02²/2 above the paraboloid's lowest point.
    let apart = model(&[], cylinders(0.01));
    let solved = |penetrations: &[f64]| {
        let loads: Vec<Load> = penetrations.iter().map(|d| Load::Penetration(*d)).collect();
        let options = SolverOptions::default();
        solve_path(&apart, Domain::Side(0.2), 64, &loads, &options, &mut ()).unwrap()
    };
    let found = solved(&[-1.0, 1e-6, 2e-6, 1e-2]);
    let codes: Vec<_> = found
        .warnings
        .iter()
        .filter(|of| of.code() == "nothing-touches")
        .collect();
    assert!(
        matches!(
            codes[..],
            [Warning::NothingTouches {
                step: 1,
                penetration: 1e-6
            }]
        ),
        "{codes:?}"
    );
    let found = solved(&[-1.0, 1e-2]);
    assert!(
        found
            .warnings
            .iter()
            .all(|of| of.code() != "nothing-touches")
    );
}

fn solve(model: &Model, side: f64, elements: usize, load: Load) -> LoadingPath {
    let options = SolverOptions::default();
    let loads = [Load::Penetration(-1.0), load];
    solve_path(
        model,
        Domain::Side(side),
        elements,
        &loads,
        &options,
        &mut (),
    )
    .unwrap()
}

fn last(path: &LoadingPath) -> &Step {
    path.steps.last().unwrap()
}

fn assert_close(found: f64, wanted: f64) {
    // the same few operations, with sums in another order
    approx::assert_relative_eq!(found, wanted, max_relative = 1e-12);
}

#[test]
fn the_summary_follows_from_the_pressure() {
    // the field is summed in two parts
    let path = solve(&model(&[], cylinders(0.02)), 0.4, 128, Load::Force(4e-4));
    let (grid, pressure) = (path.grid, &last(&path).solution.pressure);
    let found = last(&path).summary;
    let pressed: Vec<usize> = (0..grid.len()).filter(|e| pressure[*e] > 0.0).collect();
    let place = |e: usize| [grid.centre(e / 128), grid.centre(e % 128)];
    let peak = pressure.iter().copied().fold(0.0, f64::max);
    let peak_at = pressure.iter().position(|p| *p == peak).unwrap();
    assert_eq!(found.contact_elements, pressed.len());
    // The count is off by some tenths of an element along the contact's edge, here of about 300 elements.
    let counted = grid.element_area() * pressed.len() as f64;
    assert!(
        (found.contact_area / counted - 1.0).abs() < 0.06,
        "{found:?}"
    );
    let (on, between) = (found.contact_area_on_relief, found.contact_area_between);
    assert!(on > between && between > 0.0, "{found:?}");
    assert_close(on + between, found.contact_area);
    assert_close(found.mean_pressure, 4e-4 / found.contact_area);
    // The farthest centre in contact lies half an element or less from the edge.
    let radii = pressed.iter().map(|e| place(*e)[0].hypot(place(*e)[1]));
    let farthest = radii.fold(0.0, f64::max);
    assert!(
        (found.contact_radius - farthest).abs() < 0.8 * grid.element_side(),
        "{found:?}"
    );
    let to_edge = |e: &usize| [e / 128, 127 - e / 128, e % 128, 127 - e % 128];
    let nearest = pressed.iter().flat_map(to_edge).min();
    assert_eq!(found.elements_to_edge, nearest);
    assert_eq!(found.max_pressure.to_bits(), peak.to_bits());
    assert_eq!(found.max_pressure_at, place(peak_at));
    assert_eq!(found.peak_place, PeakPlace::Outline);
}

#[test]
fn the_largest_pressure_lies_inside_under_a_ball_and_at_the_tip_of_a_cone() {
    let bare = model(&[], Relief::Bare);
    let cone = Model {
        indenter: Cone::new(1.4, 0.0).unwrap().into(),
        ..bare.clone()
    };
    for (model, wanted) in [(bare, PeakPlace::Inside), (cone, PeakPlace::IndenterEdge)] {
        let path = solve(&model, 0.4, 32, Load::Force(1e-3));
        assert_eq!(last(&path).summary.peak_place, wanted);
    }
}

#[test]
fn without_contact_the_summary_is_empty() {
    let path = solve(&model(&[], Relief::Bare), 0.4, 32, Load::Force(1e-4));
    let found = path.steps[0].summary;
    assert_eq!(found.contact_elements, 0);
    let numbers = [
        found.max_pressure,
        found.mean_pressure,
        found.contact_area,
        found.contact_area_on_relief,
        found.contact_area_between,
        found.contact_radius,
    ];
    assert_eq!(numbers, [0.0; 6]);
    // and there is no warning
    assert!(
        path.warnings
            .iter()
            .all(|warning| warning.code() != "domain-edge")
    );
}

#[test]
fn too_few_elements_per_radius_or_thickness_are_warned_about() {
    let grid = Grid::new(1.0, 100).unwrap();
    for (radius, warned) in [(0.0395, true), (0.0405, false)] {
        let spec = CylinderSpec {
            lattice: Lattice::Square,
            radius,
            height: 1e-3,
            period: 0.1,
            offset: [0.0, 0.0],
            young_modulus: 1.0,
        };
        let relief = Relief::Cylinders(Cylinders::new(spec).unwrap());
        let warnings = model_warnings(&model(&[], relief), &grid);
        assert_eq!(warnings.len(), usize::from(warned), "{warnings:?}");
        if let [
            Warning::TextureUnderResolved {
                elements_per_radius,
            },
        ] = warnings[..]
        {
            assert_close(elements_per_radius, 3.95);
        }
    }
    let warnings = model_warnings(&model(&[0.01, 1.9e-4, 2.1e-4], Relief::Bare), &grid);
    let [
        Warning::LayerUnderResolved {
            layer: 1,
            elements_per_thickness,
            ..
        },
    ] = warnings[..]
    else {
        panic!("{warnings:?}");
    };
    assert_close(elements_per_thickness, 0.019);
}

#[test]
fn coefficients_below_their_accuracy_are_warned_about_with_the_accuracy_reached() {
    let grid = Grid::new(1.0, 100).unwrap();
    let right = model(&[0.1], Relief::Bare);
    // An accuracy is not warned of where its two digits are those wanted.
    for (wrong_by, warned) in [(1e-13, false), (1.03e-12, false), (3e-11, true)] {
        let tables = Arc::new(right.tables.perturbed(wrong_by));
        let warnings = model_warnings(
            &Model {
                tables,
                ..right.clone()
            },
            &grid,
        );
        let found = warnings.iter().map(Warning::code).collect::<Vec<_>>();
        assert_eq!(found, vec!["coefficient-accuracy"; usize::from(warned)]);
        if let [Warning::CoefficientAccuracy { found, wanted }] = warnings[..] {
            // The rest is the error of the tables.
            assert!((found / wrong_by - 1.0).abs() < 1e-2 && wanted == RadialTables::GOAL);
        }
    }
}

/// The steps and numbers of the warnings of one kind.
fn numbers(path: &LoadingPath, code: &str) -> Vec<(usize, f64)> {
    let of_kind = path.warnings.iter().filter(|w| w.code() == code);
    of_kind
        .map(|warning| match *warning {
            Warning::DomainEdge { step, elements } => (step, elements as f64),
            Warning::CutOff { step, .. } => (step, 0.0),
            Warning::FilmShortening { step, times } => (step, times),
            Warning::WornThrough { step, area } => (step, area),
            Warning::PeakNotResolved { step, change, .. } => (step, change),
            Warning::SteepIndenter { step, slope } => (step, slope.value()),
            Warning::LayerShortening { step, part, .. } | Warning::LayerWorn { step, part, .. } => {
                (step, part)
            }
            Warning::BeyondModel { step, beyond } => (step, beyond.ratio),
            Warning::NotConverged { step, worst, .. } => (step, worst),
            Warning::MapUnderResolved {
                step,
                elements_per_wave,
                ..
            } => (step, elements_per_wave),
            Warning::NothingTouches { step, penetration } => (step, penetration),
            Warning::NotResolved { step, numbers } => (step, numbers.each().count() as f64),
            Warning::TextureUnderResolved { .. }
            | Warning::NoGridError { .. }
            | Warning::DeepRecesses { .. }
            | Warning::ArcUnderResolved(_)
            | Warning::LayerUnderResolved { .. }
            | Warning::DomainMuchLarger { .. }
            | Warning::SteepTip { .. }
            | Warning::CoefficientAccuracy { .. } => {
                unreachable!("of no step")
            }
        })
        .collect()
}

fn assert_warning_of_the_last_step(path: &LoadingPath, code: &str, wanted: f64) {
    let found = numbers(path, code);
    assert!(found.len() == 1 && found[0].0 == 1, "{:?}", path.warnings);
    assert_close(found[0].1, wanted);
}

#[test]
fn a_film_that_shortens_by_more_than_its_thickness_is_warned_about() {
    for (force, warned) in [(2e-4, false), (2e-3, true)] {
        let film = Relief::Film(Film::new(2e-3, 0.05).unwrap());
        let path = solve(&model(&[], film), 0.5, 48, Load::Force(force));
        let shortening = path
            .surface(&path.geometry(), path.steps.len() - 1)
            .unwrap()
            .shortening;
        let times = shortening.iter().copied().fold(0.0, f64::max) / 2e-3;
        assert_eq!(times > 1.0, warned, "{times}");
        if warned {
            assert_warning_of_the_last_step(&path, "film-shortening", times);
        } else {
            assert!(numbers(&path, "film-shortening").is_empty());
        }
    }
}

#[test]
fn an_indenter_with_a_steep_slope_at_the_contact_edge_is_warned_about() {
    for (radius, warned) in [(0.27_f64, false), (0.35, true)] {
        let force = Load::Force(4.0 / 3.0 * radius.powi(3));
        let path = solve(&model(&[], Relief::Bare), 1.0, 48, force);
        // A paraboloid of radius 1 has the slope ρ; the central difference loses 1e-13.
        let slope = last(&path).summary.contact_radius;
        assert_eq!(slope > 0.3, warned, "{slope}");
        if warned {
            assert_warning_of_the_last_step(&path, "steep-indenter", slope);
        } else {
            assert!(numbers(&path, "steep-indenter").is_empty());
        }
    }
}

#[test]
fn a_peak_that_changes_with_the_grid_is_warned_about_with_its_change() {
    let path = solve(&model(&[], cylinders(0.02)), 0.4, 128, Load::Force(4e-4));
    let step = last(&path);
    let estimate = step.grid_error.max_pressure.unwrap();
    assert!(!estimate.resolved, "{estimate:?}");
    let levels = &step.grid_error.levels;
    let [.., before, last] = levels.as_slice() else {
        panic!("{levels:?}");
    };
    let change = (1.0 - before.max_pressure / last.max_pressure).abs();
    assert_warning_of_the_last_step(&path, "peak-not-resolved", change);
}

#[test]
fn a_contact_near_the_edge_is_warned_about_with_the_elements_between() {
    let mut seen = Vec::new();
    for radius in [0.1_f64, 0.16, 0.17, 0.18, 0.25] {
        let force = Load::Force(4.0 / 3.0 * radius.powi(3));
        let path = solve(&model(&[], Relief::Bare), 0.4, 40, force);
        let pressure = &last(&path).solution.pressure;
        let pressed = (0..40 * 40).filter(|e| pressure[*e] > 0.0);
        let nearest = pressed
            .flat_map(|e| [e / 40, e % 40, 39 - e / 40, 39 - e % 40])
            .min();
        let nearest = nearest.unwrap();
        seen.push(nearest);
        if nearest == 0 {
            assert_warning_of_the_last_step(&path, "cut-off", 0.0);
            assert!(numbers(&path, "domain-edge").is_empty());
        } else if nearest < 3 {
            assert_warning_of_the_last_step(&path, "domain-edge", nearest as f64);
        } else {
            assert!(numbers(&path, "domain-edge").is_empty());
        }
    }
    assert!(
        [0, 2, 3].iter().all(|nearest| seen.contains(nearest)),
        "{seen:?}"
    );
}

#[test]
fn a_mean_pressure_is_at_most_the_largest() {
    // A ball that touches one to sixteen elements, and a flat punch on a film of springs, whose pressure is uniform
    // while elements follow its outline as a staircase.
    let ball = model(&[], Relief::Bare);
    let film = Film::new(1.0, 1e-3).unwrap();
    let punch = Model {
        relief: Relief::Film(film),
        indenter: FlatPunch::new(0.07).unwrap().into(),
        ..ball.clone()
    };
    for (model, forces) in [(&ball, [1e-9, 1e-7, 1e-5]), (&punch, [1e-9, 1e-7, 1e-5])] {
        for (force, elements) in forces.into_iter().zip([15, 16, 33]) {
            let found = last(&solve(model, 0.4, elements, Load::Force(force))).summary;
            assert!(found.contact_elements > 0);
            assert!(found.mean_pressure <= found.max_pressure, "{found:?}");
            // No smaller area carries the force under the largest pressure.
            let least = force / found.max_pressure;
            assert!(
                found.meets_outline || found.contact_area >= least * (1.0 - 1e-15),
                "{found:?}"
            );
        }
    }
}
