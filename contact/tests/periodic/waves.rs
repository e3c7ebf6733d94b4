//! Periodic cells: a wavy surface by the formulas of Westergaard and of Johnson, Greenwood and Higginson, a rigid base,
//! and a cell so large that its neighbours do not matter.

use std::f64::consts::{PI, TAU};

use approx::assert_relative_eq;
use pellicle_contact::{
    Domain, Indenter, Load, Method, Paraboloid, Profile, SolverOptions, solve_path,
};
use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};

use super::{model, solve};

/// Side of the cell and plane-strain modulus are 1.
const AMPLITUDE: f64 = 0.01;

fn half_space() -> Foundation {
    Foundation::half_space(Material::new(1.0, 0.0).expect("a material"))
}

/// `Δ (1 − cos 2πx)`, or `Δ (1 − cos 2πx cos 2πy)`.
#[derive(Debug)]
struct Waves {
    in_both_directions: bool,
}

impl Profile for Waves {
    fn height(&self, x: f64, y: f64) -> f64 {
        let along_y = if self.in_both_directions {
            (TAU * y).cos()
        } else {
            1.0
        };
        AMPLITUDE * (1.0 - (TAU * x).cos() * along_y)
    }
}

fn waves(in_both_directions: bool) -> Indenter {
    Indenter::custom(Waves { in_both_directions })
}

/// Westergaard 1939: `p̄ = p* sin² πa`, `p = 2 p̄ cos πx √(sin² πa − sin² πx)/sin² πa` with `p* = π E* Δ`.
#[test]
fn a_wavy_surface_in_partial_contact_agrees_with_westergaard() {
    let (cell, full) = (model(&half_space(), waves(false)), PI * AMPLITUDE);
    let edge = (0.3 * PI).sin();
    let mean = full * edge * edge;
    let exact = |x: f64| {
        let inside = edge * edge - (PI * x).sin().powi(2);
        2.0 * mean / edge.powi(2) * (PI * x).cos() * inside.max(0.0).sqrt()
    };
    let errors = [64, 128, 256].map(|elements| {
        let path = solve(&cell, Domain::Periodic(1.0), elements, mean);
        let step = &path.steps[0];
        let area = step.summary.contact_area;
        assert!(
            (area - 0.6).abs() <= 2.0 / elements as f64,
            "{elements}: {area}"
        );
        let sum: f64 = (0..elements)
            .map(|i| {
                let x = (i as f64 + 0.5) / elements as f64 - 0.5;
                (step.solution.pressure[i * elements + elements / 3] - exact(x)).abs()
            })
            .sum();
        sum / elements as f64 / mean * (elements as f64).powf(1.5)
    });
    // The pressure ends like a square root: its mean error falls with the power 3/2 and depends on where the edge lies
    // in its element.
    assert!(errors.iter().all(|error| *error < 1.0), "{errors:?}");
}

#[test]
fn a_surface_in_full_contact_takes_the_shape_of_the_waves() {
    for (in_both_directions, wavenumber) in [(false, TAU), (true, TAU * 2.0_f64.sqrt())] {
        let cell = model(&half_space(), waves(in_both_directions));
        // p = p̄ + ½ E* k Δ cos …, which Johnson, Greenwood and Higginson 1985 give as √2 π E* Δ.
        let wave = wavenumber * AMPLITUDE / 2.0;
        let elements = 128;
        let path = solve(&cell, Domain::Periodic(1.0), elements, 1.5 * wave);
        let step = &path.steps[0];
        // Exact for a smooth wave; the elements reduce the response by a part (k h)²/24.
        assert_relative_eq!(step.summary.max_pressure, 2.5 * wave, max_relative = 1e-3);
        assert_relative_eq!(step.solution.penetration, AMPLITUDE, max_relative = 1e-9);
        assert_relative_eq!(step.summary.contact_area, 1.0);
        // The surfaces cannot be pressed any closer.
        assert!(
            step.contact_stiffness
                .is_none_or(|stiffness| stiffness > 1e3)
        );
    }
}

/// Under a light load each crest is a paraboloid with `1/R = Δ (2π)²`; there are two crests per cell.
#[test]
fn crests_in_slight_contact_are_paraboloids() {
    let cell = model(&half_space(), waves(true));
    let radius = 1.0 / (AMPLITUDE * TAU * TAU);
    let contact_radius = 0.03_f64;
    let force = 2.0 * 4.0 / 3.0 * contact_radius.powi(3) / radius;
    let path = solve(&cell, Domain::Periodic(1.0), 512, force);
    let hertz = 2.0 / PI * contact_radius / radius;
    assert_relative_eq!(
        path.steps[0].summary.max_pressure,
        hertz,
        max_relative = 1e-2
    );
    let area = 2.0 * PI * contact_radius.powi(2);
    assert_relative_eq!(
        path.steps[0].summary.contact_area,
        area,
        max_relative = 0.03
    );
}

/// On a rigid base displacements decay within a few thicknesses; the penetration is measured from the undeformed
/// surface.
#[test]
fn in_a_large_cell_on_a_rigid_base_contacts_do_not_interact() {
    let layer = Layer::new(0.05, Material::new(1.0, 0.3).unwrap(), Interface::Bonded).unwrap();
    let body = Foundation::new(vec![layer], Base::Rigid).unwrap();
    let model = model(&body, Paraboloid::new(1.0).unwrap().into());
    let [alone, cell] = [Domain::Side(1.0), Domain::Periodic(1.0)]
        .map(|domain| solve(&model, domain, 128, 1e-3).steps.remove(0).solution);
    assert_relative_eq!(cell.penetration, alone.penetration, max_relative = 1e-7);
    let largest = alone.pressure.iter().copied().fold(0.0, f64::max);
    for (cell, alone) in cell.pressure.iter().zip(&alone.pressure) {
        assert!((cell - alone).abs() < 1e-6 * largest, "{cell} {alone}");
    }
}

/// The neighbours of a cell press the surface down nearly evenly; the deviation falls at least with the square of the
/// contact's size over the cell's.
#[test]
fn in_ever_larger_cells_a_contact_tends_to_a_single_one() {
    let model = model(&half_space(), Paraboloid::new(1.0).unwrap().into());
    let peak = |domain, elements| {
        let options = SolverOptions::default();
        let loads = [Load::Force(1e-3)];
        let path = solve_path(&model, domain, elements, &loads, &options, &mut ()).unwrap();
        path.steps[0].summary.max_pressure
    };
    let errors = [(0.4, 64), (0.8, 128), (1.6, 256)].map(|(side, elements)| {
        (peak(Domain::Periodic(side), elements) / peak(Domain::Side(side), elements) - 1.0).abs()
    });
    assert!(
        errors[2] < 1e-3 && errors[0] / errors[1] > 4.0 && errors[1] / errors[2] > 4.0,
        "{errors:?}"
    );
}

#[test]
fn both_methods_agree_in_a_cell_on_a_coating() {
    let material = |modulus| Material::new(modulus, 0.3).unwrap();
    let body = Foundation::coated(0.05, material(5.0), material(1.0)).unwrap();
    let cell = model(&body, waves(true));
    let loads = [Load::Force(0.01)];
    let [one, other] = [Method::Gradient, Method::ActiveSet].map(|method| {
        let options = SolverOptions {
            method,
            tolerance: 1e-10,
            ..SolverOptions::default()
        };
        let path = solve_path(&cell, Domain::Periodic(1.0), 24, &loads, &options, &mut ());
        path.unwrap().steps.remove(0).solution
    });
    assert_relative_eq!(one.penetration, other.penetration, max_relative = 1e-8);
    let largest = one.pressure.iter().copied().fold(0.0, f64::max);
    for (one, other) in one.pressure.iter().zip(&other.pressure) {
        assert!((one - other).abs() < 1e-7 * largest);
    }
}

#[test]
fn the_surface_of_a_step_is_periodic_and_its_mean_is_its_plane() {
    let cell = model(&half_space(), waves(false));
    let path = solve(&cell, Domain::Periodic(1.0), 64, 0.01);
    let surface = path.surface(&path.geometry(), 0).unwrap();
    let mean = surface.displacement.iter().sum::<f64>() / 4096.0;
    assert!(mean.abs() < 1e-15);
    let contact = |element: &usize| path.steps[0].solution.pressure[*element] > 0.0;
    for element in (0..4096).filter(contact) {
        assert!(surface.gap[element].abs() < 1e-8 * AMPLITUDE);
    }
}
