//! Warnings at their thresholds.

mod domain;

use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};
use pellicle_texture::{
    CylinderSpec, Cylinders, Dimples, Film, Lattice, Pattern, RecessShape, Recesses, Relief,
};

use pellicle_influence::ElasticBody;

use super::*;
use crate::wear::StepWear;
use crate::{Domain, Paraboloid, SolverOptions, solve_path};

/// A ball on a film of height 0.01 on a half-space, and a single step on two grids.
fn on_film() -> (Model, Step) {
    let model = Model::on_half_space(
        [1.0, 0.0],
        Relief::Film(Film::new(0.01, 1.0).unwrap()),
        Paraboloid::new(2.0).unwrap(),
    );
    let (domain, loads) = (Domain::Side(1.0), [Load::Force(1e-2)]);
    let options = SolverOptions::default();
    let path = solve_path(&model, domain, 64, &loads, &options, &mut ()).unwrap();
    let step = path.steps[0].clone();
    (model, step)
}

fn grid() -> Grid {
    Grid::new(1.0, 64).unwrap()
}

/// The codes of the warnings about a step.
fn codes(model: &Model, step: &Step) -> Vec<&'static str> {
    let warnings = step_warnings(model, &grid(), 0, step);
    warnings.iter().map(Warning::code).collect()
}

#[test]
fn a_step_is_warned_about_for_its_certificate_springs_peak_or_slope() {
    let (model, mut step) = on_film();
    assert_eq!(codes(&model, &step), [""; 0]);
    step.summary.largest_shortening = 0.0075;
    assert_eq!(relative_shortening(&model, &step), Some(0.75));
    step.summary.largest_shortening = 0.015;
    let found = step_warnings(&model, &grid(), 5, &step);
    let [Warning::FilmShortening { step: 5, times }] = found[..] else {
        panic!("{found:?}")
    };
    assert_eq!(times, 1.5);
    step.summary.largest_shortening = 0.0;
    let worn = |unwearing: f64| StepWear {
        distance: 1.0,
        volume: 1e-9,
        max_depth: 1e-3,
        depth: Vec::new(),
        unwearing,
        is_certified: true,
        contacts: 2,
        products: 9,
    };
    for (area, found) in [(0.0, vec![]), (0.25, vec!["worn-through"])] {
        step.wear = Some(worn(area));
        assert_eq!(codes(&model, &step), found);
    }
    step.wear = None;
    // f = ρ²/4: a slope of ρ/2
    let slope = step.slope.unwrap().value();
    assert!((slope / (step.summary.contact_radius / 2.0) - 1.0).abs() < 1e-6);
    for (slope, found) in [(0.29, vec![]), (0.31, vec!["steep-indenter"])] {
        step.slope = Some(ContactSlope::AtEdge(slope));
        assert_eq!(codes(&model, &step), found);
        step.slope = Some(ContactSlope::RootMeanSquare(slope));
        assert_eq!(codes(&model, &step), found);
    }
    step.slope = None;
    for (ratio, found) in [
        (0.09, vec![]),
        (0.11, vec!["layer-shortening"]),
        (0.99, vec!["layer-shortening"]),
        (1.0, vec!["beyond-model"]),
    ] {
        let of = ElasticBody::Foundation;
        let limit = ModelLimit::LayerThickness { of, layer: 0 };
        step.limits = vec![crate::LimitRatio { limit, ratio }];
        assert_eq!(codes(&model, &step), found);
    }
    step.limits.clear();
    step.solution.certificate.overlap = 2.0 * step.solution.certificate.tolerance;
    assert_eq!(codes(&model, &step), ["not-converged"]);
}

#[test]
fn a_self_similar_indenter_is_steep_at_every_load_and_is_told_of_once() {
    let (model, mut step) = on_film();
    step.slope = Some(ContactSlope::AtEdge(0.46));
    let steps = vec![step; 3];
    let with = |indenter: Indenter| {
        let model = Model {
            indenter,
            ..model.clone()
        };
        let grid = Grid::new(1.0, 64).unwrap();
        let loads = [Load::Force(1e-2); 3];
        let found = warnings(&model, &grid, Domain::Side(1.0), &loads, &steps);
        let steep = found
            .into_iter()
            .filter(|warning| warning.code() == "steep-indenter");
        steep
            .map(|warning| (warning.step(), warning.to_string()))
            .collect::<Vec<_>>()
    };
    assert_eq!(with(Paraboloid::new(2.0).unwrap().into()).len(), 3);
    let pyramid = crate::Pyramid::berkovich(0.0).unwrap();
    // cot 65.03° = 0.4657
    let once = "the indenter's slope is 0.47 at every depth, beyond small strains";
    assert_eq!(with(pyramid.into()), [(None, once.to_owned())]);
}

#[test]
fn a_peak_that_changes_is_warned_about_unless_it_is_the_hardness() {
    let (model, mut step) = on_film();
    let last = step.grid_error.levels.len() - 1;
    let largest = step.grid_error.levels[last].max_pressure;
    step.grid_error.levels[last - 1].max_pressure = 0.8 * largest;
    assert_eq!(codes(&model, &step), [""; 0]);
    step.grid_error.max_pressure.as_mut().unwrap().resolved = false;
    let found = step_warnings(&model, &grid(), 0, &step);
    let [Warning::PeakNotResolved { change, .. }] = found[..] else {
        panic!("{found:?}")
    };
    assert!((change - 0.2).abs() < 1e-12);
    step.summary.area_at_limit = Some(1e-6);
    assert_eq!(codes(&model, &step), [""; 0]);
    // There is no warning on a single grid.
    step.summary.area_at_limit = Some(0.0);
    step.grid_error.levels.truncate(1);
    assert_eq!(codes(&model, &step), [""; 0]);
}

#[test]
fn numbers_that_are_not_resolved_are_named_and_a_single_grid_is_told_of() {
    let (model, mut step) = on_film();
    let domain = Domain::Side(1.0);
    let sentences = |step: &Step| {
        let (loads, steps) = ([Load::Force(1e-2)], std::slice::from_ref(step));
        let found = warnings(&model, &grid(), domain, &loads, steps);
        found.iter().map(ToString::to_string).collect::<Vec<_>>()
    };
    assert_eq!(sentences(&step), [""; 0]);
    for error in [
        &mut step.grid_error.penetration,
        &mut step.grid_error.contact_area,
    ] {
        error.as_mut().unwrap().resolved = false;
    }
    let of_two = "step 0: not resolved by the grid, the ± may be too small: the penetration, the contact area";
    assert_eq!(sentences(&step), [of_two]);
    // A prescribed number has no error.
    step.grid_error.penetration.as_mut().unwrap().estimate = 0.0;
    assert!(sentences(&step)[0].ends_with("too small: the contact area"));
    step.grid_error = crate::GridError::new(step.grid_error.levels.split_off(2), 0.0);
    let [single] = &sentences(&step)[..] else {
        panic!("one warning")
    };
    assert!(
        single.starts_with("no number has a ±: a grid of 64 elements"),
        "{single}"
    );
}

/// A ball on pillars of radius 0.05 on a layered body; relative stiffness and thickness of the layers from the top.
fn on_layers(layers: &[(f64, f64)]) -> Model {
    let spec = CylinderSpec {
        lattice: Lattice::Square,
        radius: 0.05,
        height: 0.1,
        period: 0.2,
        offset: [0.0, 0.0],
        young_modulus: 1.0,
    };
    let material = |young| Material::new(young, 0.3).unwrap();
    let layers = layers.iter().map(|(young, thickness)| {
        Layer::new(*thickness, material(*young), Interface::Bonded).unwrap()
    });
    let body = Foundation::new(layers.collect(), Base::HalfSpace(material(1.0))).unwrap();
    Model::on(
        &body,
        Relief::Cylinders(Cylinders::new(spec).unwrap()),
        Paraboloid::new(1.0).unwrap(),
    )
}

#[test]
fn pillars_and_layers_that_elements_do_not_resolve_are_warned_about() {
    // Elements of 0.05/3.9 and of 0.05/4.1; a layer thinner than 0.02 elements.
    let bare = on_layers(&[]);
    let found = |model: &Model, elements_per_radius: f64| {
        let size = 390;
        let side = 0.05 / elements_per_radius * size as f64;
        model_warnings(model, &Grid::new(side, size).unwrap())
    };
    let coarse = found(&bare, 3.9);
    let [
        Warning::TextureUnderResolved {
            elements_per_radius,
        },
    ] = coarse[..]
    else {
        panic!("{coarse:?}")
    };
    assert!((elements_per_radius - 3.9).abs() < 1e-12);
    assert!(found(&bare, 4.1).is_empty());
    // Elements of 0.01; the second of two layers is too thin: 1.9e-4.
    let of_layers = |layers: &[(f64, f64)]| {
        let found_warnings = found(&on_layers(layers), 5.0);
        let found_warnings = found_warnings.iter().map(|warning| match warning {
            Warning::LayerUnderResolved {
                layer,
                elements_per_thickness,
                ..
            } => (*layer, *elements_per_thickness),
            other => panic!("{other:?}"),
        });
        found_warnings.collect::<Vec<_>>()
    };
    let thin = of_layers(&[(4.0, 0.1), (10.0, 1.9e-4)]);
    assert_eq!(thin.len(), 1);
    assert!(thin[0].0 == 1 && (thin[0].1 - 0.019).abs() < 1e-12);
    assert!(of_layers(&[(4.0, 0.1), (10.0, 2.1e-4)]).is_empty());
    // A gel on a rigid base needs two elements to four thicknesses; a compressible layer, or one between equals, not.
    let gel = |poisson_ratio: f64, base: Base, thickness: f64| {
        let gel = Material::new(1.0, poisson_ratio).unwrap();
        let layer = Layer::new(thickness, gel, Interface::Bonded).unwrap();
        let body = Foundation::new(vec![layer], base).unwrap();
        let model = Model::on(&body, Relief::Bare, Paraboloid::new(1.0).unwrap());
        model_warnings(&model, &Grid::new(1.0, 100).unwrap()).len()
    };
    assert_eq!(
        [
            gel(0.46, Base::Rigid, 4.9e-3),
            gel(0.46, Base::Rigid, 5.1e-3),
            gel(0.44, Base::Rigid, 4.9e-3),
            gel(
                0.46,
                Base::HalfSpace(Material::new(9.0, 0.3).unwrap()),
                4.9e-3
            ),
            gel(
                0.46,
                Base::HalfSpace(Material::new(11.0, 0.3).unwrap()),
                4.9e-3
            ),
        ],
        [1, 0, 0, 0, 1]
    );
    // A layer nearly as stiff as the one above or below belongs to a graded layer.
    assert!(of_layers(&[(4.0, 0.1), (7.0, 1.9e-4)]).is_empty());
    assert!(of_layers(&[(4.0, 1.9e-4), (2.1, 0.1)]).is_empty());
    assert_eq!(of_layers(&[(9.0, 1.9e-4), (3.0, 0.1)]).len(), 1);
}

#[test]
fn elements_are_too_large_if_none_has_its_centre_under_the_indenter() {
    let (film, _) = on_film();
    let pin = Model {
        relief: Relief::Bare,
        indenter: crate::FlatPunch::new(0.06).unwrap().into(),
        ..film
    };
    let loads = [Load::Force(1e-3)];
    let grid = |elements| Grid::new(1.6, elements).unwrap();
    assert!(check_elements(&pin, &grid(32), &loads).is_ok());
    // With sixteen elements the centres nearest to the axis are at (0.05, 0.05).
    let refused = check_elements(&pin, &grid(16), &loads);
    let Err(ContactError::ElementsTooLarge {
        side,
        element_side,
        radius,
        wanted,
    }) = refused
    else {
        panic!("{refused:?}")
    };
    assert_eq!((side, wanted), (1.6, SIDE_PER_RADIUS * radius));
    assert!((element_side - 0.1).abs() < 1e-15 && (radius / 0.06 - 1.0).abs() < 0.02);
}

#[test]
fn deep_recesses_in_the_bodys_own_surface_are_told_of() {
    let pattern = Pattern::new(Lattice::Square, 1.0, [0.0; 2]).unwrap();
    let told = |depth: f64, springs: bool| {
        let dimples = Dimples::new(pattern, 0.3, depth, 0.0).unwrap();
        let recesses = Recesses::from(RecessShape::Dimples(dimples));
        let recesses = if springs {
            recesses.with_springs(1.0).unwrap()
        } else {
            recesses
        };
        let ball = Paraboloid::new(2.0).unwrap();
        let model = Model::on_half_space([1.0, 0.0], Relief::Recesses(recesses), ball);
        let found = model_warnings(&model, &Grid::new(2.0, 64).unwrap());
        found.iter().any(|of| of.code() == "deep-recesses")
    };
    assert!(told(0.1, false) && !told(0.08, false) && !told(0.1, true));
}
