//! Contact curves compared with closed forms, finer grids and exact identities.

#![expect(clippy::unwrap_used, reason = "a test fails by its panic")]

mod axisymmetric;
mod stiffness;

use approx::assert_relative_eq;
use pellicle_contact::{
    Cone, Domain, FlatPunch, Indenter, IndenterQuantity, Load, Model, ModelParameter, Paraboloid,
    Pyramid, SolverOptions, default_side, solve_path,
};
use pellicle_identify::{
    ContactCurve, ContactCurves, CurveOptions, ForceScale, ForwardModel, Observable, Prediction,
};
use pellicle_influence::{Cache, ElasticBodies, ElasticParameter, Sector};
use pellicle_kernel::{Foundation, FoundationParameter, Material};
use pellicle_texture::{Film, Relief, ReliefParameter};

const RADIUS: f64 = 10e-6;

fn material(young: f64, poisson: f64) -> Material {
    Material::new(young, poisson).unwrap()
}

fn model(bodies: &ElasticBodies, relief: Relief, indenter: impl Into<Indenter>) -> Model {
    let cache = Cache::of_shapes();
    Model {
        tables: cache.radial_tables_of(bodies).unwrap().value,
        relief,
        indenter: indenter.into(),
        cache,
    }
}

fn coating(thickness: f64) -> ElasticBodies {
    let (coating, base) = (material(100e9, 0.25), material(10e9, 0.3));
    Foundation::coated(thickness, coating, base).unwrap().into()
}

fn young_modulus(body: usize) -> ModelParameter {
    ModelParameter::Elastic(ElasticParameter::Foundation(
        FoundationParameter::YoungModulus { body },
    ))
}

const THICKNESS: ModelParameter = ModelParameter::Elastic(ElasticParameter::Foundation(
    FoundationParameter::Thickness { layer: 0 },
));
const RADIUS_OF_INDENTER: ModelParameter = ModelParameter::Indenter(IndenterQuantity::Radius);
const FILM_MODULUS: ModelParameter = ModelParameter::Relief(ReliefParameter::YoungModulus);

/// Forces over two decades.
fn forces() -> Vec<f64> {
    (0..24)
        .map(|i| 1e-4 * 100_f64.powf(f64::from(i) / 23.0))
        .collect()
}

fn curves(
    model: &Model,
    observable: Observable,
    abscissae: Vec<f64>,
    parameters: &[ModelParameter],
) -> ContactCurves {
    let curve = ContactCurve {
        model: model.clone(),
        observable,
        abscissae,
        own: Vec::new(),
        origins: Vec::new(),
        series: 0.0,
        thinned: None,
        adhesion: None,
    };
    ContactCurves::new(vec![curve], parameters.to_vec(), CurveOptions::default()).unwrap()
}

/// Predicts the curve of a model at its own parameter values.
fn predicted(
    model: &Model,
    observable: Observable,
    abscissae: Vec<f64>,
    parameters: &[ModelParameter],
) -> Prediction {
    let values = parameters.iter().map(|of| model.parameter(*of).unwrap());
    let curves = curves(model, observable, abscissae, parameters);
    curves.predict(&values.collect::<Vec<_>>()).unwrap()
}

#[test]
fn forces_read_with_another_spring_constant_agree_with_the_true_one() {
    let bodies = ElasticBodies::from(Foundation::half_space(material(70e9, 0.2)));
    let model = model(&bodies, Relief::Bare, Paraboloid::new(RADIUS).unwrap());
    let parameters = [young_modulus(0)];
    let (constant, nominal) = (0.046, 0.04);
    let factor = constant / nominal;
    let scale = ForceScale {
        constant: 0,
        nominal,
    };
    let true_forces: Vec<f64> = forces().iter().map(|force| factor * force).collect();
    let plain = predicted(&model, Observable::DepthAtForce, true_forces, &parameters);
    let depths = plain.value.clone();
    let inverse = predicted(
        &model,
        Observable::ForceAtDepth,
        depths.clone(),
        &parameters,
    );
    for (observable, abscissae, value, slope) in [
        (
            Observable::DepthAtForce,
            forces(),
            plain.value,
            plain
                .slope
                .iter()
                .map(|slope| factor * slope)
                .collect::<Vec<f64>>(),
        ),
        (
            Observable::ForceAtDepth,
            depths,
            inverse.value.iter().map(|force| force / factor).collect(),
            inverse.slope.iter().map(|slope| slope / factor).collect(),
        ),
    ] {
        let scaled = curves(&model, observable, abscissae, &parameters);
        let scaled = scaled.with_force_scales(vec![Some(scale)]);
        let at = |constant: f64| scaled.predict(&[70e9, constant]).unwrap();
        let found = at(constant);
        let step = 1e-3 * constant;
        let (more, less) = (at(constant + step), at(constant - step));
        for i in 0..value.len() {
            // The same loads on the same grids, to rounding.
            assert_relative_eq!(found.value[i], value[i], max_relative = 1e-9);
            assert_relative_eq!(found.slope[i], slope[i], max_relative = 1e-9);
            let quotient = (more.value[i] - less.value[i]) / (2.0 * step);
            // Predictions jump by a relative 1e-6, and the quotient by that over the step; its slope is off by 1e-4.
            assert_relative_eq!(found.derivatives[1][i], quotient, max_relative = 3e-3);
        }
    }
}

#[test]
fn the_hertz_curve_its_slope_and_derivatives_are_reproduced() {
    let steel = material(210e9, 0.3);
    let diamond = material(1141e9, 0.07);
    let bodies = ElasticBodies::new(Foundation::half_space(steel), Some(diamond));
    let model = model(&bodies, Relief::Bare, Paraboloid::new(RADIUS).unwrap());
    let parameters = [young_modulus(0), RADIUS_OF_INDENTER];
    let found = predicted(&model, Observable::DepthAtForce, forces(), &parameters);
    // 1/E* = 1/E₁* + 1/E_i*,  D³ = 9 Q²/(16 R E*²)
    let [own, other] = [steel, diamond].map(|material| 1.0 / material.plane_strain_modulus());
    let modulus = 1.0 / (own + other);
    for (i, force) in forces().into_iter().enumerate() {
        let depth = (9.0 * force * force / (16.0 * RADIUS * modulus * modulus)).cbrt();
        let pairs = [
            (found.value[i], depth),
            (found.slope[i], 2.0 / 3.0 * depth / force),
            (
                found.derivatives[0][i] * 210e9,
                -2.0 / 3.0 * depth * own * modulus,
            ),
            (found.derivatives[1][i] * RADIUS, -depth / 3.0),
        ];
        for (quantity, (found, expected)) in pairs.into_iter().enumerate() {
            let error = found / expected - 1.0;
            // Extrapolated from 64 and 32 elements per side; 1.8e-4 for the radius.
            assert!(error.abs() < 2.5e-4, "{quantity} at {force}: {error:e}");
        }
    }
}

/// The cost of a load is its products times the elements of their sector.
#[test]
fn a_berkovich_curve_on_a_half_takes_few_more_products_than_a_paraboloid_on_a_quadrant() {
    let paraboloid = || Indenter::from(Paraboloid::new(RADIUS).unwrap());
    let berkovich = || Indenter::from(Pyramid::berkovich(0.2e-6).unwrap());
    let bare = ElasticBodies::from(Foundation::half_space(material(10e9, 0.3)));
    // Without a film a paraboloid needs no grid; so stiff a one changes nothing.
    let film = || Relief::Film(Film::new(1e-9, 1e15).unwrap());
    for bodies in [bare, coating(0.5e-6)] {
        let [quadrant, half] = [paraboloid(), berkovich()].map(|indenter| {
            let model = model(&bodies, film(), indenter);
            let curves = curves(&model, Observable::DepthAtForce, forces(), &[]);
            curves.predict(&[]).unwrap();
            (
                model.sector(),
                curves.loads_solved(),
                curves.operator_applications(),
            )
        });
        assert_eq!((quadrant.0, half.0), (Sector::Quadrant, Sector::Half));
        assert_eq!(quadrant.1, half.1);
        // 112 and 125, against 105 and 104.
        assert!(4 * half.2 <= 5 * quadrant.2, "{half:?} {quadrant:?}");
    }
}

#[test]
fn the_force_at_a_depth_is_the_inverse_of_the_depth_at_a_force() {
    let model = model(
        &coating(0.5e-6),
        Relief::Bare,
        Paraboloid::new(RADIUS).unwrap(),
    );
    let parameters = [young_modulus(0), THICKNESS];
    let forward = predicted(&model, Observable::DepthAtForce, forces(), &parameters);
    let depths = forward.value.clone();
    let back = predicted(&model, Observable::ForceAtDepth, depths, &parameters);
    for (i, force) in forces().into_iter().enumerate() {
        let pairs = [
            (back.value[i], force),
            (back.slope[i] * forward.slope[i], 1.0),
            (
                back.derivatives[0][i],
                -forward.derivatives[0][i] / forward.slope[i],
            ),
            (
                back.derivatives[1][i],
                -forward.derivatives[1][i] / forward.slope[i],
            ),
        ];
        for (quantity, (found, expected)) in pairs.into_iter().enumerate() {
            let error = found / expected - 1.0;
            // Two polynomials through different contacts.
            assert!(error.abs() < 1e-6, "{quantity} at {force}: {error:e}");
        }
    }
}

#[test]
fn curves_of_coatings_and_films_agree_with_fine_grids() {
    let film = Relief::Film(Film::new(20e-9, 1e9).unwrap());
    let paraboloid = Indenter::from(Paraboloid::new(RADIUS).unwrap());
    let berkovich = Indenter::from(Pyramid::berkovich(0.2e-6).unwrap());
    for (relief, indenter, bound) in [
        (Relief::Bare, paraboloid.clone(), 3e-5),
        (film.clone(), paraboloid, 3e-5),
        (film, berkovich, 6e-4),
    ] {
        let model = model(&coating(0.5e-6), relief, indenter);
        let points = vec![1.3e-4, 9e-4, 8.7e-3];
        let all = [forces(), points.clone()].concat();
        let found = predicted(&model, Observable::DepthAtForce, all, &[]);
        for (i, force) in points.into_iter().enumerate() {
            let side = default_side(&model, &[Load::Force(force)]);
            let at = |elements| {
                let load = [Load::Force(force)];
                let options = SolverOptions::default();
                let domain = Domain::Side(1.2 * side);
                let path = solve_path(&model, domain, elements, &load, &options, &mut ());
                path.unwrap().steps[0].solution.penetration
            };
            let expected = (4.0 * at(512) - at(256)) / 3.0;
            let error = found.value[24 + i] / expected - 1.0;
            assert!(error.abs() < bound, "{force}: {error:e}");
        }
    }
}

/// The gauge of the paraboloid and the scale of all moduli (logarithmic derivatives of D):
/// `2∂_R + ∂_H − ∂_E1 − ∂_E2 + 2∂_η = 0`, `∂_E1 + ∂_E2 − ∂_η = −Q D′/D`.
#[test]
fn derivatives_satisfy_the_identities_of_the_paraboloid() {
    for thickness in [0.05e-6, 0.5e-6, 4e-6] {
        let film = Relief::Film(Film::new(20e-9, 1e9).unwrap());
        let model = model(&coating(thickness), film, Paraboloid::new(RADIUS).unwrap());
        let parameters = [
            young_modulus(0),
            young_modulus(1),
            THICKNESS,
            RADIUS_OF_INDENTER,
            FILM_MODULUS,
        ];
        let found = predicted(&model, Observable::DepthAtForce, forces(), &parameters);
        let mut worst = [0.0_f64; 2];
        for (i, force) in forces().into_iter().enumerate() {
            let by = |index: usize| {
                let value = model.parameter(parameters[index]).unwrap();
                found.derivatives[index][i] * value / found.value[i]
            };
            // η ∝ 1/E_w
            let of_film = -by(4);
            let gauge = 2.0 * by(3) + by(2) - by(0) - by(1) + 2.0 * of_film;
            let power = force * found.slope[i] / found.value[i];
            let scale = by(0) + by(1) - of_film + power;
            worst = [worst[0].max(gauge.abs()), worst[1].max(scale.abs())];
        }
        assert!(worst[0] < 1e-3 && worst[1] < 1e-3, "{thickness}: {worst:?}");
    }
}

/// The gauge of the paraboloid, the compliance of a film, the materials of a coating, the slope of a sharp cone, and
/// two moduli that enter only as a sum.
#[test]
fn penetrations_do_not_change_along_null_directions() {
    let film = Film::new(20e-9, 1e9).unwrap();
    // The thickness and modulus of stiffening springs matter separately.
    let stiffening = Relief::Film(film.stiffening());
    let film = Relief::Film(film);
    let diamond = Some(material(1141e9, 0.07));
    let steel = Foundation::half_space(material(210e9, 0.3));
    let paraboloid = Indenter::from(Paraboloid::new(RADIUS).unwrap());
    let cone = Indenter::from(Cone::new(1.3, 0.0).unwrap());
    let cases = [
        (model(&coating(0.5e-6), film.clone(), paraboloid.clone()), 3),
        (model(&coating(0.5e-6), film, cone), 3),
        (model(&coating(0.5e-6), stiffening, paraboloid.clone()), 2),
        (
            model(
                &ElasticBodies::new(steel, diamond),
                Relief::Bare,
                paraboloid,
            ),
            4,
        ),
    ];
    for (model, count) in cases {
        let directions = model.null_directions();
        assert_eq!(directions.len(), count);
        for direction in directions {
            let parameters: Vec<ModelParameter> = direction.iter().map(|(of, _)| *of).collect();
            let found = predicted(&model, Observable::DepthAtForce, forces(), &parameters);
            for i in 0..forces().len() {
                let changes = direction.iter().zip(&found.derivatives);
                let changes = changes.map(|((_, change), derivative)| change * derivative[i]);
                let changes: Vec<f64> = changes.collect();
                let largest = changes
                    .iter()
                    .fold(0.0, |most: f64, change| most.max(change.abs()));
                let sum: f64 = changes.iter().sum();
                // The grid error of each.
                assert!(
                    sum.abs() < 2e-3 * largest,
                    "{direction:?}: {sum:e} of {largest:e}"
                );
            }
        }
    }
}

#[test]
fn more_points_need_no_more_loads() {
    let loads = |indenter: Indenter, abscissae| {
        let model = model(&coating(0.5e-6), Relief::Bare, indenter);
        let curves = curves(&model, Observable::DepthAtForce, abscissae, &[]);
        curves.predict(&[]).unwrap();
        curves.loads_solved()
    };
    let dense = || (0..10_000).map(|i| 1e-2 * f64::from(i + 1) / 1e4).collect();
    let berkovich = || Indenter::from(Pyramid::berkovich(0.2e-6).unwrap());
    let paraboloid = || Indenter::from(Paraboloid::new(RADIUS).unwrap());
    // On a grid two decades at six loads per decade; then three decades, the widest range that is solved.
    assert_eq!(
        (loads(berkovich(), forces()), loads(berkovich(), dense())),
        (15, 21)
    );
    // Without a grid by the range of contact radii.
    assert_eq!(
        (loads(paraboloid(), forces()), loads(paraboloid(), dense())),
        (29, 39)
    );
}

#[test]
fn the_force_of_a_flat_punch_at_a_depth_is_the_inverse_of_its_depth() {
    let punch = Indenter::from(FlatPunch::new(1e-3).unwrap());
    let gel = || Foundation::half_space(material(50e3, 0.45));
    let coated = Foundation::coated(0.5e-3, material(20e3, 0.45), material(2e6, 0.3)).unwrap();
    let soft = Some(material(50e3, 0.45));
    let film = Relief::Film(Film::new(0.1e-3, 10e3).unwrap());
    let cases = [
        (ElasticBodies::from(gel()), Relief::Bare, Some(1.0)),
        (ElasticBodies::from(coated), Relief::Bare, None),
        (ElasticBodies::new(gel(), soft), Relief::Bare, Some(0.5)),
        (ElasticBodies::from(gel()), film, None),
    ];
    let depths: Vec<f64> = (1..=10).map(|i| 4e-6 * f64::from(i)).collect();
    for (bodies, relief, part) in cases {
        let model = model(&bodies, relief, punch.clone());
        let parameters = [young_modulus(0)];
        let found = predicted(
            &model,
            Observable::ForceAtDepth,
            depths.clone(),
            &parameters,
        );
        let back = predicted(
            &model,
            Observable::DepthAtForce,
            found.value.clone(),
            &parameters,
        );
        for (i, depth) in depths.iter().enumerate() {
            // Both are linear; with a film solved on the same elements at other loads.
            assert_relative_eq!(back.value[i], *depth, max_relative = 1e-6);
            if let Some(part) = part {
                // F = 2 a E* D
                let exact = 2e-3 * part * material(50e3, 0.45).plane_strain_modulus() * depth;
                assert_relative_eq!(found.value[i], exact, max_relative = 1e-12);
            }
        }
    }
}
