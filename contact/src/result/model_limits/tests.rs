//! Limits of solved contacts, from closed forms, exact fields, and the definition.

use std::sync::Arc;

use pellicle_influence::{Depth, ElasticBodies, RadialTables};
use pellicle_kernel::{Base, Foundation, Interface, Layer, Material, Side};
use pellicle_texture::Film;

use super::*;
use crate::{
    Cone, Domain, FlatPunch, Load, LoadingPath, Paraboloid, Sliding, SolverOptions, Sphere, Status,
    StressField, solve_path,
};

fn material(young: f64, nu: f64) -> Material {
    Material::new(young, nu).unwrap()
}

/// Layers of thickness, Young's modulus and Poisson's ratio, surface first.
fn body(layers: &[[f64; 3]], base: Base) -> Foundation {
    let layer = |[thickness, young, nu]: &[f64; 3]| {
        Layer::new(*thickness, material(*young, *nu), Interface::Bonded).unwrap()
    };
    Foundation::new(layers.iter().map(layer).collect(), base).unwrap()
}

fn solved(body: &Foundation, indenter: impl Into<Indenter>, loads: &[Load]) -> LoadingPath {
    let model = Model::on(body, Relief::Bare, indenter);
    let options = SolverOptions::default();
    solve_path(&model, Domain::Automatic, 64, loads, &options, &mut ()).unwrap()
}

fn ratio(step: &Step, is: impl Fn(ModelLimit) -> bool) -> Option<f64> {
    let found = step.limits.iter().find(|found| is(found.limit));
    found.map(|found| found.ratio)
}

fn of_layer(step: &Step) -> f64 {
    ratio(step, |limit| {
        matches!(limit, ModelLimit::LayerThickness { .. })
    })
    .unwrap()
}

/// The shortenings of the layers over their thicknesses below the axis, by the exact fields.
fn shortenings(path: &LoadingPath, step: usize) -> Vec<f64> {
    let field = StressField::new(path, step, Sliding::default()).unwrap();
    let foundation = path.tables.foundation();
    let sinking = |z: f64, side: Side| {
        let at = field.at([0.0; 2], Depth { z, side });
        at.unwrap().displacement[2]
    };
    let layers = foundation.layers().iter().enumerate();
    layers
        .map(|(layer, of)| {
            let [top, bottom] = [layer, layer + 1].map(|i| foundation.interface_depth(i));
            let is_rigid_below =
                layer + 1 == foundation.layers().len() && foundation.base_material().is_none();
            let below = if is_rigid_below {
                0.0
            } else {
                sinking(bottom, Side::Above)
            };
            (sinking(top, Side::Below) - below) / of.thickness()
        })
        .collect()
}

#[test]
fn shortenings_are_those_of_the_exact_field_to_some_percent() {
    let glass = Base::HalfSpace(material(70.0, 0.2));
    let hard = Base::HalfSpace(material(200.0, 0.3));
    for (name, body, radius, depth) in [
        ("thin film", body(&[[0.1, 1.0, 0.4]], glass), 50.0, 0.1),
        ("thick film", body(&[[5.0, 1.0, 0.4]], glass), 5.0, 0.7),
        (
            "interlayer",
            body(&[[1.0, 100.0, 0.3], [0.2, 1.0, 0.45]], hard),
            100.0,
            0.05,
        ),
        ("incompressible", body(&[[0.5, 1.0, 0.5]], glass), 10.0, 0.2),
        (
            "graded",
            body(&[[0.1, 2.0, 0.3], [0.1, 4.0, 0.3], [0.1, 8.0, 0.3]], hard),
            1.0,
            0.05,
        ),
    ] {
        let ball = Paraboloid::new(radius).unwrap();
        let path = solved(&body, ball, &[Load::Penetration(depth)]);
        let exact = shortenings(&path, 0).into_iter().fold(0.0, f64::max);
        let found = of_layer(&path.steps[0]);
        assert!(
            (found / exact - 1.0).abs() < 0.05,
            "{name}: {found} {exact}"
        );
    }
}

#[test]
fn a_layer_on_a_rigid_base_is_shortened_by_the_penetration() {
    let gel = body(&[[1e-6, 1e6, 0.45]], Base::Rigid);
    let depths = [0.1, 0.5, 0.999, 1.0, 2.0];
    let loads = depths.map(|depth| Load::Penetration(depth * 1e-6));
    for indenter in [
        Indenter::from(Sphere::new(1e-3).unwrap()),
        FlatPunch::new(5e-6).unwrap().into(),
    ] {
        let path = solved(&gel, indenter, &loads);
        for (step, depth) in path.steps.iter().zip(depths) {
            let found = of_layer(step);
            // Between the axis and the nearest centre a ball rises by less than 1e-3 of its depth.
            assert!((found / depth - 1.0).abs() < 2e-3, "{depth} {found}");
            let base = ratio(step, |limit| matches!(limit, ModelLimit::RigidBase { .. })).unwrap();
            assert!((base / depth - 1.0).abs() < 1e-12, "{depth} {base}");
            let wanted = if depth < 1.0 {
                Status::Certified
            } else {
                Status::BeyondModel
            };
            assert_eq!(step.status(), wanted, "{depth}");
        }
    }
}

#[test]
fn the_layer_of_an_indenter_is_pressed_through_as_that_of_a_foundation() {
    let gel = body(&[[1e-6, 1e6, 0.45]], Base::Rigid);
    let on_rigid = Model::on(&gel, Relief::Bare, Sphere::new(1e-3).unwrap());
    let under_rigid = on_rigid.seen_from(ElasticBody::Counterbody);
    let loads = [0.5, 2.0].map(|depth| Load::Penetration(depth * 1e-6));
    let options = SolverOptions::default();
    let solved = |model: &Model| {
        solve_path(model, Domain::Automatic, 64, &loads, &options, &mut ()).unwrap()
    };
    let (own, others) = (solved(&on_rigid), solved(&under_rigid));
    let of = ElasticBody::Counterbody;
    for (own, other) in own.steps.iter().zip(&others.steps) {
        let base = ratio(other, |limit| limit == ModelLimit::RigidBase { of }).unwrap();
        let layer = ModelLimit::LayerThickness { of, layer: 0 };
        let layer = ratio(other, |limit| limit == layer).unwrap();
        assert!((layer - of_layer(own)).abs() <= 0.0 && base > 0.4);
        assert_eq!(own.status(), other.status());
    }
    assert_eq!(others.steps[1].status(), Status::BeyondModel);
}

#[test]
fn a_soft_indenter_carries_no_more_than_its_modulus() {
    let hard = Foundation::half_space(material(1000.0, 0.3));
    let bodies = ElasticBodies::new(hard.clone(), material(1.0, 0.3));
    let model = Model {
        tables: Arc::new(RadialTables::of_bodies(&bodies).unwrap()),
        ..Model::on(&hard, Relief::Bare, Cone::new(0.42, 0.0).unwrap())
    };
    let (loads, options) = ([Load::Penetration(1.0)], SolverOptions::default());
    let path = solve_path(&model, Domain::Automatic, 64, &loads, &options, &mut ()).unwrap();
    let soft = ModelLimit::Modulus {
        of: ElasticBody::Counterbody,
        body: 0,
    };
    assert!(ratio(&path.steps[0], |limit| limit == soft).unwrap() > 1.0);
}

#[test]
fn an_indenter_sunk_by_its_radius_is_beyond_the_model() {
    let body = Foundation::half_space(material(1.0, 0.3));
    for indenter in [
        Indenter::from(Sphere::new(1.0).unwrap()),
        Paraboloid::new(1.0).unwrap().into(),
        FlatPunch::new(1.0).unwrap().into(),
    ] {
        let loads = [0.98, 1.0, 456.0].map(Load::Penetration);
        let path = solved(&body, indenter.clone(), &loads);
        let statuses: Vec<_> = path.steps.iter().map(Step::status).collect();
        assert_eq!(
            statuses,
            [Status::Certified, Status::BeyondModel, Status::BeyondModel],
            "{indenter:?}"
        );
        let found = path.steps[2].beyond().unwrap();
        let size = ratio(&path.steps[2], |limit| limit == ModelLimit::IndenterRadius).unwrap();
        assert!((size / 456.0 - 1.0).abs() < 1e-12 && found.ratio >= size);
    }
    // A self-similar tip has no size.
    let cone = Cone::new(1.2, 0.0).unwrap();
    let path = solved(&body, cone, &[Load::Penetration(456.0)]);
    assert_eq!(path.steps[0].status(), Status::Certified);
}

#[test]
fn a_small_indenter_may_sink_with_a_stiff_skin_by_more_than_its_radius() {
    // A skin much stiffer than what it lies on, ten times as thick as the indenter is large.
    let base = Base::HalfSpace(material(0.01, 0.3));
    let skin = body(&[[10.0, 1000.0, 0.3]], base);
    for (radius, indenter) in [
        (1.0, Indenter::from(Sphere::new(1.0).unwrap())),
        (0.2, FlatPunch::new(0.2).unwrap().into()),
    ] {
        let path = solved(&skin, indenter.clone(), &[Load::Force(20.0)]);
        let step = &path.steps[0];
        assert!(step.solution.penetration > radius, "{indenter:?}");
        let limits = &step.limits;
        assert_eq!(step.status(), Status::Certified, "{limits:?}");
    }
}

#[test]
fn a_mean_pressure_above_the_modulus_of_what_carries_it_is_beyond_the_model() {
    // A cone's mean pressure is E* cot α/2 at every load: 1.1 E at α = 0.46.
    let steep = Cone::new(0.42, 0.0).unwrap();
    let half_space = Foundation::half_space(material(1.0, 0.3));
    let path = solved(&half_space, steep, &[Load::Penetration(1.0)]);
    let wanted = 1.0 / (0.91 * 2.0 * 0.42_f64.tan());
    let found = ratio(&path.steps[0], |of| {
        matches!(of, ModelLimit::Modulus { body: 0, .. })
    })
    .unwrap();
    assert!(
        wanted > 1.0 && (found / wanted - 1.0).abs() < 0.02,
        "{found} {wanted}"
    );
    assert_eq!(path.steps[0].status(), Status::BeyondModel);
    // Under a thin stiff coat the body below it carries the same pressure.
    let coated = body(&[[0.01, 50.0, 0.3]], Base::HalfSpace(material(1.0, 0.3)));
    let path = solved(&coated, FlatPunch::new(1.0).unwrap(), &[Load::Force(10.0)]);
    let found = ratio(&path.steps[0], |of| {
        matches!(of, ModelLimit::Modulus { body: 1, .. })
    })
    .unwrap();
    // On the axis of a punch the pressure is half of its mean, 3.2, and up to its mean farther down.
    assert!((1.5..3.2).contains(&found), "{found}");
    assert_eq!(path.steps[0].status(), Status::BeyondModel);
}

#[test]
fn springs_on_the_surface_are_not_layers() {
    // The film's springs are shortened by many times their height, the body hardly at all.
    let stiff = body(&[[1.0, 1e4, 0.3]], Base::Rigid);
    let film = Relief::Film(Film::new(1e-3, 1e-2).unwrap());
    let model = Model::on(&stiff, film, Paraboloid::new(1.0).unwrap());
    let options = SolverOptions::default();
    let load = [Load::Penetration(0.01)];
    let path = solve_path(&model, Domain::Automatic, 32, &load, &options, &mut ()).unwrap();
    assert_eq!(path.steps[0].status(), Status::Certified);
    assert!(
        path.warnings
            .iter()
            .any(|of| of.code() == "film-shortening")
    );
}

#[test]
fn in_a_periodic_cell_the_mean_pressure_shortens_a_layer_as_if_confined() {
    let soft = body(&[[0.1, 1.0, 0.3]], Base::HalfSpace(material(100.0, 0.3)));
    let model = Model::on(&soft, Relief::Bare, FlatPunch::new(9.0).unwrap());
    let options = SolverOptions::default();
    let loads = [Load::Force(0.5), Load::Force(2.0)];
    let domain = Domain::Periodic(1.0);
    let path = solve_path(&model, domain, 32, &loads, &options, &mut ()).unwrap();
    // p (1 + ν)(1 − 2ν)/(E (1 − ν)), of the whole cell in contact.
    for (step, pressure) in path.steps.iter().zip([0.5, 2.0]) {
        let wanted = pressure * 1.3 * 0.4 / 0.7;
        let found = of_layer(step);
        assert!((found / wanted - 1.0).abs() < 1e-6, "{found} {wanted}");
    }
    let statuses: Vec<_> = path.steps.iter().map(Step::status).collect();
    assert_eq!(statuses, [Status::Certified, Status::BeyondModel]);
}

#[test]
fn a_layer_that_keeps_its_volume_is_not_pressed_through_unseen() {
    // Rubbers on steel: the base gives less than pressed without them, the rubber the rest.
    let steel = Base::HalfSpace(material(210e9, 0.3));
    let ball = Sphere::new(1e-3).unwrap();
    let rubber = body(&[[1e-5, 1e6, 0.5]], steel);
    let path = solved(&rubber, ball, &[Load::Penetration(5e-6)]);
    let (found, exact) = (of_layer(&path.steps[0]), shortenings(&path, 0)[0]);
    assert!((found / exact - 1.0).abs() < 0.05, "{found} {exact}");
    // The axis of this one, thinner than an element, was taken to be shortened by a tenth.
    let path = solved(
        &body(&[[1e-6, 1e6, 0.5]], steel),
        ball,
        &[Load::Force(10.0)],
    );
    assert!(of_layer(&path.steps[0]) > 1.0);
    assert_eq!(path.steps[0].status(), Status::BeyondModel);
    // Under a punch of 90 % of the thickness on a rigid base.
    let gel = body(&[[1e-5, 1e6, 0.5]], Base::Rigid);
    let punch = FlatPunch::new(1e-3).unwrap();
    let path = solved(&gel, punch, &[Load::Penetration(9e-6)]);
    assert!((of_layer(&path.steps[0]) - 0.9).abs() < 1e-9);
    // The layers of a body of one material, and a coating stiffer than its base, give no more than they do.
    for (young, nu) in [(1.0, 0.3), (100.0, 0.3)] {
        let coated = body(&[[0.1, young, nu]], Base::HalfSpace(material(1.0, 0.3)));
        let path = solved(
            &coated,
            Paraboloid::new(1.0).unwrap(),
            &[Load::Penetration(0.05)],
        );
        let found = ratio(&path.steps[0], |limit| {
            matches!(limit, ModelLimit::LayerThickness { .. })
        });
        let exact = shortenings(&path, 0)[0];
        assert!(
            found.is_none_or(|found| found < exact + 0.02),
            "{found:?} {exact}"
        );
    }
}

#[test]
fn an_interface_that_closes_does_not_shorten_its_layer() {
    // A sheet of glass of 1 µm on glue of 20 MPa, 20 µm thick, whose closing is its compliance times the pressure.
    let glass = material(70e9, 0.2);
    for base in [Base::HalfSpace(glass), Base::Rigid] {
        let glue = Interface::spring(1e-12, 1e-12).unwrap();
        let sheet = Layer::new(1e-6, glass, glue).unwrap();
        let body = Foundation::new(vec![sheet], base).unwrap();
        let ball = Sphere::new(100e-6).unwrap();
        let path = solved(&body, ball, &[Load::Force(1e-3)]);
        let step = &path.steps[0];
        assert!(step.solution.penetration > 1e-6);
        assert_eq!(step.status(), Status::Certified);
    }
}
