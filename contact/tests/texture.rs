//! Patterns that people make: dimples, grooves and rounded pillars, against maps of the same heights, a closed form,
//! and themselves in other units, in mirrors and turned.

#![expect(
    clippy::unwrap_used,
    reason = "a scene that cannot be built fails its test"
)]

mod averages;

use std::f64::consts::PI;
use std::sync::Arc;

use pellicle_contact::{
    Domain, Indenter, Load, Model, Paraboloid, PeakPlace, Plane, SolverOptions, Step, solve_path,
};
use pellicle_influence::{Cache, RadialTables};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::{
    CylinderSpec, Cylinders, Dimples, GrooveProfile, GrooveSpec, Grooves, HeightMap, Lattice,
    MapCompliance, Pattern, RecessShape, Recesses, Relief, ReliefMap,
};

/// A body of plane-strain modulus 1.
fn body() -> Foundation {
    Foundation::half_space(Material::new(1.0, 0.0).unwrap())
}

fn model(body: &Foundation, relief: Relief, indenter: Indenter) -> Model {
    Model {
        tables: Arc::new(RadialTables::build(body).unwrap()),
        relief,
        indenter,
        cache: Cache::in_memory(),
    }
}

fn ball() -> Indenter {
    Paraboloid::new(1.0).unwrap().into()
}

fn solve(model: &Model, domain: Domain, elements: usize, load: Load) -> Step {
    let options = SolverOptions::default();
    let path = solve_path(model, domain, elements, &[load], &options, &mut ()).unwrap();
    let step = path.steps[0].clone();
    assert!(step.solution.certificate.is_satisfied());
    step
}

fn dimples(edge_radius: f64) -> Recesses {
    let pattern = Pattern::new(Lattice::Hexagonal, 0.1, [0.01, 0.02]).unwrap();
    let pattern = pattern.turned(0.3).unwrap();
    RecessShape::Dimples(Dimples::new(pattern, 0.03, 0.003, edge_radius).unwrap()).into()
}

const GROOVES: GrooveSpec = GrooveSpec {
    profile: GrooveProfile::V,
    width: 0.06,
    depth: 0.003,
    period: 0.1,
    offset: [0.01, 0.0],
    rotation: 0.4,
    edge_radius: 0.05,
};

fn grooves(spec: GrooveSpec) -> Recesses {
    RecessShape::Grooves(Grooves::new(spec).unwrap()).into()
}

/// A map of the relief with so many samples per side of a square, with springs of this modulus, if any.
fn map(relief: &Relief, side: f64, samples: u32, young_modulus: Option<f64>) -> Relief {
    let at = |k: u32| ((f64::from(k) + 0.5) / f64::from(samples) - 0.5) * side;
    let points = (0..samples * samples).map(|n| [at(n / samples), at(n % samples)]);
    let heights = relief.profile_at(&points.collect::<Vec<_>>());
    let map = HeightMap::new(heights, [samples as usize; 2], [side; 2]).unwrap();
    let compliance = young_modulus.map_or(MapCompliance::Uniform(0.0), MapCompliance::YoungModulus);
    Relief::Map(ReliefMap::new(map, compliance).unwrap())
}

#[test]
fn dimples_and_grooves_are_pressed_as_finely_sampled_maps_of_them() {
    const SIDE: f64 = 0.4;
    let sine = GrooveSpec {
        profile: GrooveProfile::Sine,
        edge_radius: 0.0,
        ..GROOVES
    };
    for recesses in [dimples(0.05), dimples(0.0), grooves(GROOVES), grooves(sine)] {
        for modulus in [None, Some(0.5)] {
            let recesses = match modulus {
                Some(modulus) => recesses.with_springs(modulus).unwrap(),
                None => recesses,
            };
            let relief = Relief::Recesses(recesses);
            let sampled = map(&relief, SIDE, 500, modulus);
            // Elements whose centres are no samples of the map.
            let pressed = |relief: Relief| {
                let model = model(&body(), relief, ball());
                solve(&model, Domain::Side(SIDE), 96, Load::Force(3e-3))
            };
            let [own, of_map] = [relief, sampled].map(pressed);
            let near = |value: fn(&Step) -> f64| {
                let [own, of_map] = [value(&own), value(&of_map)];
                assert!(
                    (own / of_map - 1.0).abs() < 1e-3,
                    "{recesses:?}: {own} {of_map}"
                );
            };
            near(|step| step.solution.penetration);
            near(|step| step.summary.contact_area);
            // At a sharp rim the peak is that of the map's rounding between its samples.
            if own.summary.peak_place == PeakPlace::Inside {
                near(|step| step.summary.max_pressure);
            }
        }
    }
}

/// Sine-shaped grooves of infinite length under a rigid plane, one wavelength 1 wide and 1/16 long, pressed so that the
/// contact is `2a` wide: `p̄ = p* sin²(πa)`, `p* = π E* Δ`, with the largest pressure `2 p̄/sin(πa)` on the crest
/// (Westergaard, J. Appl. Mech. 6, 1939, A49; Johnson, Contact Mechanics, 1985, §13.2).
///
/// Relative errors of the width and of the largest pressure, with the crest at a part of an element from its edge.
fn errors_of_a_wave(elements: usize, half_width: f64, part: f64) -> [f64; 2] {
    const AMPLITUDE: f64 = 1e-3;
    let relief = Relief::Recesses(grooves(GrooveSpec {
        profile: GrooveProfile::Sine,
        width: 1.0,
        depth: 2.0 * AMPLITUDE,
        period: 1.0,
        offset: [0.5 + part / elements as f64, 0.0],
        rotation: 0.0,
        edge_radius: 0.0,
    }));
    let sides = [1.0, 1.0 / 16.0];
    let sine = (PI * half_width).sin();
    let mean = PI * AMPLITUDE * sine * sine;
    let load = Load::Force(mean * sides[0] * sides[1]);
    let model = model(&body(), relief, Plane.into());
    let step = solve(&model, Domain::Oblong(sides), elements, load);
    let width = step.summary.contact_area / sides[1];
    [
        width / (2.0 * half_width) - 1.0,
        step.summary.max_pressure / (2.0 * mean / sine) - 1.0,
    ]
}

#[test]
fn sine_grooves_of_infinite_length_touch_as_westergaard_says() {
    for half_width in [0.1, 0.25, 0.4] {
        // Root mean square over places of the crest within an element, since the errors depend on them.
        let errors = |elements| {
            let each =
                [0.1, 0.3, 0.5, 0.7, 0.9].map(|part| errors_of_a_wave(elements, half_width, part));
            [0, 1].map(|of: usize| {
                let squares = each.iter().map(|error| error[of] * error[of]);
                (squares.sum::<f64>() / 5.0).sqrt()
            })
        };
        let [coarse, fine] = [32, 256].map(errors);
        let orders = [0, 1].map(|of: usize| (coarse[of] / fine[of]).ln() / 8.0_f64.ln());
        assert!(orders[0] > 1.0 && orders[1] > 1.8, "{orders:?}");
        assert!(fine[0] < 3e-4 && fine[1] < 1e-4, "{fine:?}");
    }
}

fn pillars(edge_radius: f64) -> Relief {
    let spec = CylinderSpec {
        lattice: Lattice::Square,
        radius: 0.04,
        height: 0.02,
        period: 0.1,
        offset: [0.0, 0.0],
        young_modulus: 1.0,
    };
    let cylinders = Cylinders::new(spec).unwrap();
    Relief::Cylinders(cylinders.rounded(edge_radius).unwrap())
}

fn pressed_on_pillars(edge_radius: f64, elements: usize) -> Step {
    let model = model(&body(), pillars(edge_radius), ball());
    solve(&model, Domain::Side(0.3), elements, Load::Force(2e-3))
}

#[test]
fn the_peak_on_a_rounded_pillar_converges_and_that_on_a_sharp_one_is_not_resolved() {
    let steps = [64, 128, 256].map(|n| pressed_on_pillars(0.015, n));
    let peaks = steps.each_ref().map(|step| step.summary.max_pressure);
    let errors = steps
        .each_ref()
        .map(|step| step.grid_error.max_pressure.unwrap());
    assert!(errors[2].resolved && errors[2].order.unwrap() > 1.0);
    for (peak, error) in peaks.iter().zip(&errors) {
        if error.resolved {
            // The finest grid's own error is within its ±.
            assert!((peak - peaks[2]).abs() <= error.estimate + errors[2].estimate);
        }
    }
    let sharp = pressed_on_pillars(0.0, 128);
    assert!(!sharp.grid_error.max_pressure.unwrap().resolved);
}

#[test]
fn a_vanishing_edge_radius_gives_the_sharp_edge_on_any_grid() {
    let sharp = pressed_on_pillars(0.0, 64);
    let round = pressed_on_pillars(1e-9, 64);
    let relative = |value: fn(&Step) -> f64| (value(&round) / value(&sharp) - 1.0).abs();
    assert!(relative(|step| step.solution.penetration) < 1e-6);
    assert!(relative(|step| step.summary.max_pressure) < 1e-6);
    assert!(relative(|step| step.summary.contact_area) < 1e-6);
}
