//! The tension at the edge against Hamilton's closed form, and against itself on finer grids.

use std::f64::consts::PI;

use pellicle_kernel::{Foundation, Material};
use pellicle_texture::{Film, Relief};

use super::*;
use crate::stress::model::Sliding;
use crate::{Cone, Domain, FlatPunch, Load, Model, Paraboloid, SolverOptions, solve_path};

/// The solved contact at a penetration on a grid of side 1, and the extreme at its edge.
fn solved(model: &Model, elements: usize, depth: f64, sliding: Sliding) -> Option<Extreme<3>> {
    let options = SolverOptions {
        coarse_pressures: true,
        ..SolverOptions::default()
    };
    let load = [Load::Penetration(depth)];
    let path = solve_path(model, Domain::Side(1.0), elements, &load, &options, &mut ()).unwrap();
    let step = &path.steps[0];
    let of = |grid, pressure: &[f64]| StressField::of(path.tables.clone(), grid, pressure, sliding);
    let field = of(path.grid, &step.solution.pressure);
    let coarse = step
        .coarser
        .last()
        .map(|coarse| of(coarse.grid, &coarse.pressure));
    edge_extreme(&path, step, &field, Wanted::Error(coarse.as_ref())).unwrap()
}

/// The extreme under a ball whose contact has a radius of so many elements, in parts of the closed form's tension.
fn under_ball(elements: usize, radius: f64, nu: f64, sliding: Sliding) -> Extreme<3> {
    let model = Model::on_half_space([1.0, nu], Relief::Bare, Paraboloid::new(1.0).unwrap());
    let a = radius / elements as f64;
    let found = solved(&model, elements, a * a, sliding).unwrap();
    // Hertz: p0 = 2 E* a/(π R); Hamilton 1983: the tension at the trailing edge, p0 ((1 − 2ν)/3 + π μ (4 + ν)/8)
    let p0 = 2.0 * a / (PI * (1.0 - nu * nu));
    let wanted = p0 * ((1.0 - 2.0 * nu) / 3.0 + PI * sliding.friction * (4.0 + nu) / 8.0);
    Extreme {
        value: found.value / wanted,
        at: found.at.map(|along| along / a),
        estimate: found.estimate.map(|estimate| estimate / wanted),
        ..found
    }
}

#[test]
fn the_tension_at_the_edge_is_hamiltons_within_a_percent_and_its_interval() {
    for (radius, nu, friction, direction) in [
        (18.3, 0.2, 0.0, 0.0),
        (19.2, 0.3, 0.25, 0.0),
        (21.7, 0.45, 0.1, PI / 4.0),
        (20.4, 0.3, 1.0, 2.0),
    ] {
        let found = under_ball(
            64,
            radius,
            nu,
            Sliding {
                friction,
                direction,
            },
        );
        let error = (found.value - 1.0).abs();
        assert!(
            error < 0.01 && error < found.estimate.unwrap(),
            "{radius}: {found:?}"
        );
        assert!(
            found.resolved && found.estimate.unwrap() < 0.03,
            "{radius}: {found:?}"
        );
        let [x, y, z] = found.at;
        assert!(
            (x.hypot(y) - 1.0).abs() < 0.01 && z == 0.0,
            "{radius}: {found:?}"
        );
        if friction > 0.0 {
            // Behind the contact, to the root of the accuracy of the value.
            let behind = [-direction.cos(), -direction.sin()];
            assert!(x * behind[0] + y * behind[1] > 0.98, "{radius}: {found:?}");
        }
    }
}

/// Without sliding the tension at the edge of any axisymmetric contact with a half-space is (1 − 2ν) F/(2π a²).
#[test]
fn under_a_cone_the_tension_is_that_of_the_mean_pressure() {
    let (slope, nu) = (0.05_f64, 0.25);
    let model = Model::on_half_space(
        [1.0, nu],
        Relief::Bare,
        Cone::new(PI / 2.0 - f64::atan(slope), 0.0).unwrap(),
    );
    let a: f64 = 0.3;
    // Sneddon 1965: D = π a tan β/2, mean pressure E* tan β/2
    let found = solved(&model, 64, 0.5 * PI * a * slope, Sliding::default()).unwrap();
    let wanted = (1.0 - 2.0 * nu) / 2.0 * slope / (2.0 * (1.0 - nu * nu));
    assert!(
        (found.value / wanted - 1.0).abs() < 0.015,
        "{found:?} {wanted}"
    );
}

#[test]
fn what_the_grid_does_not_resolve_at_the_edge_is_said() {
    let sliding = Sliding {
        friction: 0.25,
        direction: 0.0,
    };
    let ball = || Paraboloid::new(1.0).unwrap();
    // A contact of six elements' radius.
    assert!(!under_ball(32, 6.0, 0.3, sliding).resolved);
    let [hard, base] = [3.0, 1.0].map(|modulus| Material::new(modulus, 0.3).unwrap());
    // Layers of two and of four elements.
    for (thickness, is_resolved) in [(2.0 / 48.0, false), (4.0 / 48.0, true)] {
        let body = Foundation::coated(thickness, hard, base).unwrap();
        let model = Model::on(&body, Relief::Bare, ball());
        let found = solved(&model, 48, 0.09, sliding).unwrap();
        assert_eq!(found.resolved, is_resolved, "{thickness}: {found:?}");
    }
    // Springs under the edge; a rim.
    let film = Relief::Film(Film::new(0.01, 0.5).unwrap());
    let found = solved(
        &Model::on_half_space([1.0, 0.3], film, ball()),
        48,
        0.09,
        sliding,
    );
    assert!(!found.unwrap().resolved);
    let punch = Model::on_half_space([1.0, 0.3], Relief::Bare, FlatPunch::new(0.3).unwrap());
    assert!(solved(&punch, 48, 0.01, sliding).is_none_or(|found| !found.resolved));
}

/// Errors and intervals of one group of contacts.
#[derive(Default)]
struct Coverage {
    contacts: usize,
    resolved: usize,
    inside: usize,
    critical_inside: usize,
    worst: f64,
    critical_worst: f64,
    intervals: Vec<f64>,
}

impl Coverage {
    /// Adds a value and the half-width of its interval, in parts of the truth. The load F at which a strength of this
    /// value is found is truly F value³.
    fn add(&mut self, found: Extreme<3>) {
        self.contacts += 1;
        if !found.resolved {
            return;
        }
        self.resolved += 1;
        let (value, interval) = (found.value, found.estimate.unwrap());
        let error = (value - 1.0).abs();
        // F_found/F_true = value^(−3), ± = 3 F ±σ/σ
        let critical = (value.powi(3) - 1.0).abs();
        self.inside += usize::from(error <= interval);
        self.critical_inside += usize::from(critical <= 3.0 * interval / value);
        self.worst = self.worst.max(error);
        self.critical_worst = self.critical_worst.max((value.powi(-3) - 1.0).abs());
        self.intervals.push(interval);
    }

    fn print(mut self, name: &str) {
        self.intervals.sort_by(f64::total_cmp);
        let median = self
            .intervals
            .get(self.intervals.len() / 2)
            .copied()
            .unwrap_or(f64::NAN);
        println!(
            "| {name} | {} | {} | {:.2} % | {} | {:.2} % | {:.2} % | {} |",
            self.contacts,
            self.resolved,
            100.0 * self.worst,
            self.inside,
            100.0 * median,
            100.0 * self.critical_worst,
            self.critical_inside,
        );
    }
}

/// Prints the table of `docs/grid-error.md`:
/// `cargo test --release -p pellicle-contact --lib coverage_at_the_edge -- --ignored --nocapture`.
#[test]
#[ignore = "a study of some minutes"]
fn coverage_at_the_edge() {
    let frictions = [0.0, 0.1, 0.25, 1.0];
    for elements in [32, 48, 64, 96, 128] {
        for friction in frictions {
            let mut coverage = Coverage::default();
            for nu in [0.2, 0.3, 0.45] {
                for direction in [0.0, 0.4, PI / 4.0] {
                    for k in 0..6 {
                        // Sizes that fall anywhere within the elements: multiples of the golden section.
                        let part = (0.618_034 * f64::from(k + 1) + nu + direction).fract();
                        let radius = elements as f64 * (0.26 + 0.1 * part);
                        coverage.add(under_ball(
                            elements,
                            radius,
                            nu,
                            Sliding {
                                friction,
                                direction,
                            },
                        ));
                    }
                }
            }
            coverage.print(&format!("half-space, N = {elements}, μ = {friction}"));
        }
    }
    let base = Material::new(1.0, 0.3).unwrap();
    for (modulus, nu) in [
        (1.5, 0.25),
        (4.0, 0.2),
        (20.0, 0.2),
        (0.3, 0.4),
        (0.05, 0.45),
    ] {
        for friction in frictions {
            let mut coverage = Coverage::default();
            for thickness in [0.2, 0.4, 1.0] {
                let a = 0.3;
                let layer = Material::new(modulus, nu).unwrap();
                let body = Foundation::coated(thickness * a, layer, base).unwrap();
                let model = Model::on(&body, Relief::Bare, Paraboloid::new(1.0).unwrap());
                let sliding = Sliding {
                    friction,
                    direction: 0.4,
                };
                let Some(truth) = solved(&model, 512, a * a, sliding).map(|fine| fine.value) else {
                    continue;
                };
                for elements in [32, 48, 56, 64, 80, 96] {
                    let Some(found) = solved(&model, elements, a * a, sliding) else {
                        continue;
                    };
                    coverage.add(Extreme {
                        value: found.value / truth,
                        estimate: found.estimate.map(|estimate| estimate / truth.abs()),
                        ..found
                    });
                }
            }
            coverage.print(&format!("layer of {modulus} E, μ = {friction}"));
        }
    }
}
