//! Oblong cells: against square ones side by side, surfaces that depend on one coordinate, and closed forms.

use std::f64::consts::{PI, TAU};

use approx::assert_relative_eq;
use pellicle_contact::{
    ContactError, Domain, Indenter, Load, Method, Model, Profile, SolverOptions, Step, solve_path,
};
use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};
use pellicle_texture::{Film, Relief};

use super::model;

const AMPLITUDE: f64 = 0.01;

/// `Δ (1 − cos 2πx/λ_x cos 2πy/λ_y + s sin 2π(x/λ_x + y/λ_y))`; an infinite wavelength leaves a direction out.
#[derive(Debug, Clone, Copy)]
struct Waves {
    lengths: [f64; 2],
    diagonal: f64,
}

impl Profile for Waves {
    fn height(&self, x: f64, y: f64) -> f64 {
        let [u, v] = [x / self.lengths[0], y / self.lengths[1]].map(|turns| TAU * turns);
        AMPLITUDE * (1.0 - u.cos() * v.cos() + self.diagonal * (u + v).sin())
    }
}

/// Summits of different heights, with the period 1 in both directions.
const SUMMITS: Waves = Waves {
    lengths: [1.0, 0.5],
    diagonal: 0.5,
};

fn half_space() -> Foundation {
    Foundation::half_space(Material::new(1.0, 0.0).unwrap())
}

/// A coating three times as stiff as what carries it.
fn coated(base: Base) -> Foundation {
    let layer = |thickness, modulus| {
        let material = Material::new(modulus, 0.3).unwrap();
        Layer::new(thickness, material, Interface::Bonded).unwrap()
    };
    Foundation::new(vec![layer(0.05, 3.0), layer(0.5, 1.0)], base).unwrap()
}

fn solve(model: &Model, domain: Domain, elements: usize, load: Load) -> Step {
    solve_with(model, domain, elements, load, &SolverOptions::default())
}

fn solve_with(
    model: &Model,
    domain: Domain,
    elements: usize,
    load: Load,
    options: &SolverOptions,
) -> Step {
    let path = solve_path(model, domain, elements, &[load], options, &mut ()).unwrap();
    let step = path.steps[0].clone();
    assert!(step.solution.certificate.is_satisfied(), "{domain:?}");
    step
}

/// Holds two cells of size 1 side by side, along either axis, to one of them.
fn assert_two_are_twice_one(model: &Model, force: f64, options: &SolverOptions) {
    const SIZE: usize = 32;
    let one = solve_with(
        model,
        Domain::Periodic(1.0),
        SIZE,
        Load::Force(force),
        options,
    );
    for (sides, lengths) in [
        ([2.0, 1.0], [2 * SIZE, SIZE]),
        ([1.0, 2.0], [SIZE, 2 * SIZE]),
    ] {
        let load = Load::Force(2.0 * force);
        let two = solve_with(model, Domain::Oblong(sides), 2 * SIZE, load, options);
        assert_eq!(two.solution.pressure.len(), lengths[0] * lengths[1]);
        let largest = one.summary.max_pressure;
        for (element, found) in two.solution.pressure.iter().enumerate() {
            // The longer cell begins half a period earlier.
            let places = [element / lengths[1], element % lengths[1]];
            let [i, j] = [0, 1].map(|axis: usize| {
                let shift = (lengths[axis] - SIZE) / 2;
                (places[axis] + SIZE - shift) % SIZE
            });
            let wanted = one.solution.pressure[i * SIZE + j];
            assert!((found - wanted).abs() < 1e-6 * largest, "{found} {wanted}");
        }
        // The tolerance of the solver.
        let same = |found: f64, wanted: f64| {
            assert_relative_eq!(found, wanted, max_relative = 1e-6);
        };
        same(two.solution.penetration, one.solution.penetration);
        same(two.summary.max_pressure, one.summary.max_pressure);
        same(two.summary.contact_area, 2.0 * one.summary.contact_area);
        assert_eq!(
            two.summary.contact_elements,
            2 * one.summary.contact_elements
        );
        same(two.summary.nominal_pressure.unwrap(), force);
        same(
            two.contact_stiffness.unwrap(),
            2.0 * one.contact_stiffness.unwrap(),
        );
        // The same surface on coarser grids of the same elements, which are solved to 1e-6.
        let levels = [&two, &one].map(|step| step.grid_error.levels.iter().rev());
        let [found, wanted] = levels;
        assert!(wanted.len() > 1);
        for (found, wanted) in found.zip(wanted) {
            assert_eq!(found.elements, 2 * wanted.elements);
            assert_relative_eq!(found.max_pressure, wanted.max_pressure, max_relative = 1e-4);
        }
        // About as much work.
        let [work, wanted] = [&two, &one].map(|step| step.work.operator_applications);
        assert!(work <= wanted + 5, "{work} {wanted}");
    }
}

#[test]
fn a_square_cell_twice_side_by_side_has_the_same_pressures_and_twice_the_force() {
    let steel = Material::new(0.3, 0.3).unwrap();
    for foundation in [
        half_space(),
        coated(Base::Rigid),
        coated(Base::HalfSpace(steel)),
    ] {
        let cell = model(&foundation, Indenter::custom(SUMMITS));
        for force in [1e-3, 0.01] {
            assert_two_are_twice_one(&cell, force, &SolverOptions::default());
        }
    }
}

#[test]
fn so_it_has_with_springs_a_hardness_and_by_the_active_set() {
    let usual = SolverOptions::default();
    let bare = model(&half_space(), Indenter::custom(SUMMITS));
    let film = Film::new(0.1, 0.5).unwrap();
    for relief in [film, film.stiffening()] {
        let springy = Model {
            relief: Relief::Film(relief),
            ..bare.clone()
        };
        assert_two_are_twice_one(&springy, 0.01, &usual);
    }
    let hardness = SolverOptions {
        hardness: 0.03,
        ..usual
    };
    assert_two_are_twice_one(&bare, 0.01, &hardness);
    let dense = SolverOptions {
        method: Method::ActiveSet,
        ..usual
    };
    assert_two_are_twice_one(&bare, 1e-3, &dense);
}

#[test]
fn a_surface_that_depends_on_x_alone_does_not_feel_the_length_along_y() {
    let ridges = Waves {
        lengths: [1.0, f64::INFINITY],
        diagonal: 0.0,
    };
    let cell = model(&coated(Base::Rigid), Indenter::custom(ridges));
    let mean = 0.003;
    let wanted = solve(&cell, Domain::Periodic(1.0), 64, Load::Force(mean));
    for (width, columns) in [(0.25, 16), (0.75, 48), (1.25, 80)] {
        let size = columns.max(64);
        let load = Load::Force(mean * width);
        let found = solve(&cell, Domain::Oblong([1.0, width]), size, load);
        for (element, found) in found.solution.pressure.iter().enumerate() {
            let wanted = wanted.solution.pressure[element / columns * 64];
            assert!((found - wanted).abs() < 1e-6 * mean, "{found} {wanted}");
        }
        let depth = found.solution.penetration;
        assert_relative_eq!(depth, wanted.solution.penetration, max_relative = 1e-7);
    }
}

/// Johnson, Greenwood and Higginson 1985: closed gaps take `p̄ + ½ E* k Δ cos cos` with `k² = k_x² + k_y²`; of waves in
/// one direction `p* = π E* Δ/λ`.
#[test]
fn in_full_contact_the_waves_of_an_oblong_cell_have_the_pressure_of_johnson() {
    let sides = [0.75, 1.0];
    for (lengths, amplitude) in [
        (
            [0.75, 1.0],
            0.5 * TAU * AMPLITUDE * (1.0_f64 / 0.75).hypot(1.0),
        ),
        ([0.75, f64::INFINITY], PI * AMPLITUDE / 0.75),
        ([f64::INFINITY, 0.5], PI * AMPLITUDE / 0.5),
    ] {
        let waves = Waves {
            lengths,
            diagonal: 0.0,
        };
        let cell = model(&half_space(), Indenter::custom(waves));
        let load = Load::Force(1.5 * amplitude * 0.75);
        let step = solve(&cell, Domain::Oblong(sides), 128, load);
        let largest = step.summary.max_pressure;
        // Elements flatten waves by (k a)²/6 along each axis: 4e-4 of two waves along y.
        let wanted = 2.5 * amplitude;
        assert_relative_eq!(largest, wanted, max_relative = 5e-4);
        // The whole cell touches; on a half-space the deformed surface has its mean in its plane.
        assert_relative_eq!(step.summary.contact_area, 0.75, max_relative = 1e-12);
        assert_relative_eq!(step.solution.penetration, AMPLITUDE, max_relative = 1e-7);
    }
}

#[test]
fn the_penetration_of_an_oblong_cell_takes_its_force() {
    let cell = model(&coated(Base::Rigid), Indenter::custom(SUMMITS));
    let domain = Domain::Oblong([1.0, 1.5]);
    let by_force = solve(&cell, domain, 48, Load::Force(0.01));
    let depth = Load::Penetration(by_force.solution.penetration);
    let found = solve(&cell, domain, 48, depth);
    assert_relative_eq!(found.solution.force, 0.01, max_relative = 3e-8);
}

#[test]
fn elements_that_would_not_be_square_are_refused() {
    let cell = model(&half_space(), Indenter::custom(SUMMITS));
    let (loads, options) = ([Load::Force(0.01)], SolverOptions::default());
    let domain = Domain::Oblong([0.7, 1.0]);
    let refused = solve_path(&cell, domain, 64, &loads, &options, &mut ());
    assert!(matches!(
        refused,
        Err(ContactError::NotSquareElements { size: 64, .. })
    ));
}
