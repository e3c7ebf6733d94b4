//! Derivatives of solved contacts compared with differences between solutions, closed forms and finer grids.

#![expect(clippy::unwrap_used, reason = "a test fails by its panic")]

use pellicle_contact::{
    Cone, Domain, ForceCurve, Indenter, Load, LoadingPath, Model, ModelParameter, Paraboloid,
    PowerLaw, Pyramid, SolverOptions, Sphere, solve_path,
};
use pellicle_influence::{Cache, ElasticBodies, ElasticParameter};
use pellicle_kernel::{Base, Foundation, FoundationParameter, Interface, Layer, Material};
use pellicle_texture::{CylinderSpec, Cylinders, Film, Lattice, Relief};

fn material(young: f64, poisson: f64) -> Material {
    Material::new(young, poisson).unwrap()
}

fn model(bodies: &ElasticBodies, relief: Relief, indenter: impl Into<Indenter>) -> Model {
    let cache = Cache::in_memory();
    Model {
        tables: cache.radial_tables_of(bodies).unwrap().value,
        relief,
        indenter: indenter.into(),
        cache,
    }
}

fn coated(thickness: f64, coating: Material, base: Material) -> Foundation {
    Foundation::coated(thickness, coating, base).unwrap()
}

fn pillars(young_modulus: f64) -> Cylinders {
    let spec = CylinderSpec {
        lattice: Lattice::Hexagonal,
        radius: 0.03,
        height: 0.004,
        period: 0.1,
        offset: [0.0, 0.0],
        young_modulus,
    };
    Cylinders::new(spec).unwrap()
}

/// Models that cover every kind of parameter, each with a force and the side of a domain.
#[expect(clippy::too_many_lines, reason = "a list of cases")]
fn cases() -> Vec<(Model, f64, f64)> {
    let film = |thickness, young| Relief::Film(Film::new(thickness, young).unwrap());
    let springs = Interface::spring(0.02, 0.05).unwrap();
    let layer = |thickness, young, poisson, interface| {
        Layer::new(thickness, material(young, poisson), interface).unwrap()
    };
    let half_space = |young, poisson| Base::HalfSpace(material(young, poisson));
    let sprung = vec![layer(0.05, 3.0, 0.2, springs)];
    let three = vec![
        layer(0.02, 5.0, 0.2, Interface::Bonded),
        layer(0.1, 0.3, 0.45, Interface::Frictionless),
    ];
    let stack = |layers: &[Layer], base| Foundation::new(layers.to_vec(), base).unwrap();
    let diamond = Some(material(11.0, 0.07));
    let paraboloid = Paraboloid::new(1.0).unwrap();
    vec![
        (
            model(
                &Foundation::half_space(material(1.0, 0.3)).into(),
                Relief::Bare,
                paraboloid,
            ),
            1e-2,
            0.6,
        ),
        (
            model(
                &coated(0.1, material(10.0, 0.25), material(1.0, 0.3)).into(),
                Relief::Bare,
                paraboloid,
            ),
            1e-2,
            0.6,
        ),
        (
            model(
                &ElasticBodies::new(coated(0.1, material(0.2, 0.4), material(1.0, 0.3)), diamond),
                Relief::Bare,
                paraboloid,
            ),
            3e-3,
            0.6,
        ),
        (
            model(
                &ElasticBodies::new(
                    coated(0.1, material(5.0, 0.2), material(1.0, 0.3)),
                    stack(&three, half_space(2.0, 0.3)),
                ),
                Relief::Bare,
                paraboloid,
            ),
            3e-3,
            0.7,
        ),
        (
            model(
                &stack(&sprung, half_space(1.0, 0.35)).into(),
                Relief::Bare,
                Sphere::new(1.0).unwrap(),
            ),
            1e-2,
            0.6,
        ),
        (
            model(&stack(&three, Base::Rigid).into(), Relief::Bare, paraboloid),
            3e-3,
            0.7,
        ),
        (
            model(
                &stack(&three, half_space(0.5, 0.1)).into(),
                film(0.002, 0.3),
                Cone::new(1.3, 0.2).unwrap(),
            ),
            1e-2,
            0.6,
        ),
        (
            model(
                &coated(0.1, material(4.0, 0.2), material(1.0, 0.3)).into(),
                Relief::Bare,
                PowerLaw::new(3.3, 0.5).unwrap(),
            ),
            1e-2,
            0.8,
        ),
        (
            model(
                &coated(0.05, material(0.1, 0.5), material(1.0, 0.0)).into(),
                Relief::Cylinders(pillars(0.7)),
                paraboloid,
            ),
            4e-3,
            0.6,
        ),
        (
            model(
                &coated(0.05, material(20.0, 0.2), material(1.0, 0.3)).into(),
                Relief::Cylinders(pillars(0.7)),
                paraboloid,
            ),
            1e-2,
            0.6,
        ),
        (
            model(
                &coated(0.05, material(10.0, 0.3), material(1.0, 0.4)).into(),
                film(0.005, 0.2),
                Pyramid::berkovich(0.1).unwrap(),
            ),
            2e-2,
            0.6,
        ),
        (
            model(
                &ElasticBodies::new(Foundation::half_space(material(1.0, 0.2)), diamond),
                film(0.01, 5.0),
                Pyramid::vickers(0.3).unwrap(),
            ),
            1e-2,
            0.6,
        ),
    ]
}

/// Two models with stiffening springs.
fn stiffening_cases() -> Vec<(Model, f64, f64)> {
    let paraboloid = Paraboloid::new(1.0).unwrap();
    vec![
        (
            model(
                &coated(0.05, material(10.0, 0.3), material(1.0, 0.4)).into(),
                Relief::Film(Film::new(0.005, 0.2).unwrap().stiffening()),
                Pyramid::berkovich(0.1).unwrap(),
            ),
            2e-2,
            0.6,
        ),
        (
            model(
                &coated(0.1, material(4.0, 0.2), material(1.0, 0.3)).into(),
                Relief::Bare,
                PowerLaw::new(3.3, 0.5).unwrap(),
            ),
            1e-2,
            0.8,
        ),
        (
            model(
                &coated(0.05, material(0.1, 0.5), material(1.0, 0.0)).into(),
                Relief::Cylinders(pillars(0.007).stiffening()),
                paraboloid,
            ),
            4e-3,
            0.6,
        ),
    ]
}

fn solved(model: &Model, side: f64, elements: usize, forces: &[f64]) -> LoadingPath {
    let loads: Vec<Load> = forces.iter().copied().map(Load::Force).collect();
    let options = SolverOptions {
        tolerance: 1e-13,
        ..SolverOptions::default()
    };
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

/// Whether each element has pressure.
fn contact(path: &LoadingPath) -> Vec<bool> {
    let pressure = &path.steps[0].solution.pressure;
    pressure.iter().map(|p| *p > 0.0).collect()
}

/// Penetration and energy of a path's only step.
fn numbers(model: &Model, path: &LoadingPath) -> [f64; 2] {
    let energy = model
        .derivatives(&[])
        .unwrap()
        .of_path(path)
        .unwrap()
        .energy(0);
    [path.steps[0].solution.penetration, energy]
}

#[test]
fn derivatives_agree_with_differences_between_solutions_of_the_same_contact_set() {
    for (index, (model, force, side)) in cases().into_iter().chain(stiffening_cases()).enumerate() {
        let path = solved(&model, side, 48, &[force]);
        let set = contact(&path);
        let parameters = model.parameters();
        let found = model
            .derivatives(&parameters)
            .unwrap()
            .of_path(&path)
            .unwrap()
            .at(0);
        let [penetration, energy] = numbers(&model, &path);
        for (parameter, found) in parameters.iter().zip(found) {
            let is_ratio = matches!(
                parameter,
                ModelParameter::Elastic(
                    ElasticParameter::Counterbody(FoundationParameter::PoissonRatio { .. })
                        | ElasticParameter::Foundation(FoundationParameter::PoissonRatio { .. })
                )
            );
            let unit = if is_ratio { 1.0 } else { found.value };
            // At the ends of the range of Poisson's ratio there is no central difference.
            if is_ratio && !(0.01..0.49).contains(&found.value) {
                continue;
            }
            let unchanged = [3e-5, 3e-6].iter().find_map(|part| {
                let step = part * unit;
                let [more, less] = [step, -step].map(|step| {
                    let moved = model
                        .with_parameter(*parameter, found.value + step)
                        .unwrap();
                    let path = solved(&moved, side, 48, &[force]);
                    (contact(&path) == set).then(|| numbers(&moved, &path))
                });
                let (more, less) = (more?, less?);
                Some([0, 1].map(|i: usize| (more[i] - less[i]) / (2.0 * step)))
            });
            let [by_penetration, by_energy] = unchanged.expect("a contact set that stands still");
            // 1e-13 of each solution over a step of 3e-6 to 3e-5.
            let error = (found.penetration.unwrap() - by_penetration) * unit / penetration;
            assert!(error.abs() < 1e-7, "case {index}, {parameter:?}: {error:e}");
            let error = (found.energy - by_energy) * unit / energy;
            assert!(
                error.abs() < 1e-7,
                "energy, case {index}, {parameter:?}: {error:e}"
            );
        }
    }
}

#[test]
fn along_null_directions_the_penetration_does_not_change() {
    let bodies: ElasticBodies = coated(0.1, material(10.0, 0.25), material(1.0, 0.3)).into();
    let film = Relief::Film(Film::new(0.002, 0.5).unwrap());
    let paraboloid: Indenter = Paraboloid::new(1.0).unwrap().into();
    let sharp: [Indenter; 2] = [
        Cone::new(1.4, 0.0).unwrap().into(),
        Pyramid::berkovich(0.0).unwrap().into(),
    ];
    let cases = [
        // The materials of the coating and the gauge, and the compliance of the film.
        (model(&bodies, Relief::Bare, paraboloid.clone()), 2),
        (
            model(&bodies, Relief::Bare, PowerLaw::new(3.3, 0.5).unwrap()),
            2,
        ),
        (model(&bodies, film.clone(), paraboloid), 3),
        (model(&bodies, film.clone(), sharp[0].clone()), 3),
        (model(&bodies, film.clone(), sharp[1].clone()), 3),
        // A rounded tip has a length scale of its own.
        (model(&bodies, film, Cone::new(1.4, 0.01).unwrap()), 2),
    ];
    for (index, (model, count)) in cases.iter().enumerate() {
        let directions = model.null_directions();
        assert_eq!(directions.len(), *count, "case {index}");
        let path = solved(model, 0.6, 48, &[1e-2]);
        for direction in directions {
            let parameters: Vec<ModelParameter> = direction.iter().map(|(of, _)| *of).collect();
            let derivatives = model.derivatives(&parameters).unwrap();
            let sensitivities = derivatives.of_path(&path).unwrap();
            let found = sensitivities.at(0);
            // The energies computed alone are the same numbers.
            let energies = sensitivities.energies(0);
            assert!(
                energies
                    .iter()
                    .zip(&found)
                    .all(|(energy, found)| energy.to_bits() == found.energy.to_bits())
            );
            let changes = direction.iter().zip(&found);
            let changes: Vec<f64> = changes
                .map(|((_, change), found)| change * found.penetration.unwrap())
                .collect();
            let largest = changes.iter().fold(0.0_f64, |most, c| most.max(c.abs()));
            // Tables of derivatives are accurate to 2e-8; the gauge scales the elements too, which are not scaled here.
            let gauge = parameters
                .iter()
                .any(|of| matches!(of, ModelParameter::Indenter(_)));
            let within = if gauge { 3e-2 } else { 1e-6 };
            let sum: f64 = changes.iter().sum();
            assert!(sum.abs() < within * largest, "case {index}: {changes:?}");
        }
    }
}

/// Loads over one decade at which the curves are sampled.
fn decade(largest: f64) -> Vec<f64> {
    (-12..=0)
        .map(|i| largest * 10_f64.powf(f64::from(i) / 12.0))
        .collect()
}

/// Penetrations at these forces, extrapolated from grids of 256 and 512 elements per side.
fn extrapolated(model: &Model, side: f64, forces: &[f64]) -> Vec<f64> {
    let [coarse, fine] = [256, 512].map(|size| solved_loosely(model, side, size, forces));
    let at = |path: &LoadingPath, step: usize| path.steps[step].solution.penetration;
    let steps = 0..forces.len();
    // Assumes an error that falls with the square of the element's side.
    steps
        .map(|step| (4.0 * at(&fine, step) - at(&coarse, step)) / 3.0)
        .collect()
}

fn solved_loosely(model: &Model, side: f64, size: usize, forces: &[f64]) -> LoadingPath {
    let loads: Vec<Load> = forces.iter().copied().map(Load::Force).collect();
    let options = SolverOptions {
        contact_stiffness: false,
        ..SolverOptions::default()
    };
    solve_path(model, Domain::Side(side), size, &loads, &options, &mut ()).unwrap()
}

#[test]
fn the_derivative_along_the_curve_is_right_where_the_one_from_the_elements_is_not() {
    let bodies = coated(0.1, material(10.0, 0.25), material(1.0, 0.3)).into();
    let film = Relief::Film(Film::new(0.002, 0.5).unwrap());
    let coating = model(&bodies, film, Paraboloid::new(1.0).unwrap());
    let (forces, side) = (decade(6e-2), 0.9);
    let path = solved(&coating, side, 64, &forces);
    let parameters = coating.parameters();
    let sensitivities = coating
        .derivatives(&parameters)
        .unwrap()
        .of_path(&path)
        .unwrap();
    let steps: Vec<_> = (0..forces.len())
        .map(|step| sensitivities.at(step))
        .collect();
    let enough = |step: &usize| path.steps[*step].summary.contact_elements >= 400;
    // A spline is less accurate at its ends.
    let measured: Vec<usize> = (0..forces.len() - 2).filter(enough).collect();
    assert!(measured.len() >= 5);
    let (mut of_elements, mut along) = (0.0_f64, 0.0_f64);
    for (index, parameter) in parameters.iter().enumerate() {
        let value = coating.parameter(*parameter).unwrap();
        let step = 0.02 * value;
        let [more, less] = [step, -step].map(|step| {
            let moved = coating.with_parameter(*parameter, value + step).unwrap();
            extrapolated(&moved, side, &forces)
        });
        let energies: Vec<f64> = steps.iter().map(|step| step[index].energy).collect();
        let curve = ForceCurve::through(&forces, &energies).unwrap();
        for i in &measured {
            let expected = (more[*i] - less[*i]) / (2.0 * step);
            let relative = |found: f64| (found / expected - 1.0).abs();
            along = along.max(relative(curve.derivative(forces[*i])));
            of_elements = of_elements.max(relative(steps[*i][index].penetration.unwrap()));
        }
    }
    // Measured: 4.4e-3 for the film's compliance, which is a hundredth of D; 5e-2 for the derivatives with the contact
    // set fixed.
    assert!(along < 5e-3, "{along:e}");
    assert!(of_elements > 1e-2, "{of_elements:e}");
    let energies: Vec<f64> = (0..forces.len())
        .map(|step| sensitivities.energy(step))
        .collect();
    let curve = ForceCurve::through(&forces, &energies).unwrap();
    for i in measured {
        let penetration = path.steps[i].solution.penetration;
        // The remaining error is that of the steps of D itself, as elements enter.
        assert!((curve.derivative(forces[i]) / penetration - 1.0).abs() < 2e-3);
    }
}
