//! Slopes of solved contacts, with those of closed forms.

use pellicle_texture::{HeightMap, MapCompliance, ReliefMap};

use super::*;
use crate::{
    Cone, Domain, FlatPunch, IndenterMap, Load, Model, Paraboloid, Pyramid, SolverOptions, Sphere,
    solve_path,
};

/// The slope under an indenter on a half-space with `E* = 1/0.91`.
fn slope(model: &Model, domain: Domain, load: Load) -> ContactSlope {
    let options = SolverOptions::default();
    let path = solve_path(model, domain, 64, &[load], &options, &mut ()).unwrap();
    path.steps[0].slope.unwrap()
}

fn under(indenter: impl Into<Indenter>, load: Load) -> f64 {
    let model = Model::on_half_space([1.0, 0.3], Relief::Bare, indenter);
    let found = slope(&model, Domain::Automatic, load);
    assert!(matches!(found, ContactSlope::AtEdge(_)));
    found.value()
}

/// A map of `n` × `n` samples on the square of side 2.
fn map(n: usize, height: impl Fn(f64, f64) -> f64) -> HeightMap {
    let at = |i: usize| (2 * i + 1) as f64 / n as f64 - 1.0;
    let heights = (0..n * n).map(|k| height(at(k / n), at(k % n)));
    HeightMap::new(heights.collect(), [n; 2], [2.0; 2]).unwrap()
}

#[test]
fn a_paraboloid_has_the_slope_of_hertz_at_its_edge_and_a_cone_its_own() {
    // a² = R D; the edge is placed to a hundredth of an element.
    let found = under(Paraboloid::new(1.0).unwrap(), Load::Penetration(0.01));
    assert!((found / 0.1 - 1.0).abs() < 2e-3, "{found}");
    let found = under(Cone::new(1.2, 0.0).unwrap(), Load::Penetration(0.01));
    // Differences over a tenth of an element across a cone.
    assert!((found * 1.2_f64.tan() - 1.0).abs() < 1e-6, "{found}");
    // The faces of a Berkovich pyramid, cot 65.03°.
    let found = under(Pyramid::berkovich(0.0).unwrap(), Load::Penetration(0.01));
    assert!((found / 0.465_65 - 1.0).abs() < 1e-3, "{found}");
    // A punch is flat up to its rim.
    let found = under(FlatPunch::new(1.0).unwrap(), Load::Penetration(0.01));
    assert!(found.abs() < 1e-12, "{found}");
}

#[test]
fn a_punch_that_yields_up_to_its_rim_is_flat() {
    let model = Model::on_half_space([1.0, 0.3], Relief::Bare, FlatPunch::new(1.0).unwrap());
    let options = SolverOptions {
        hardness: 8e-3,
        ..SolverOptions::default()
    };
    let load = Load::Penetration(0.01);
    let path = solve_path(&model, Domain::Automatic, 64, &[load], &options, &mut ()).unwrap();
    assert!(path.steps[0].summary.area_at_limit.unwrap() > 0.1);
    assert!(
        path.steps[0]
            .slope
            .is_none_or(|slope| slope.value() < 1e-12)
    );
}

#[test]
fn a_ball_pressed_in_to_its_equator_is_infinitely_steep() {
    assert!(under(Sphere::new(1.0).unwrap(), Load::Penetration(5.0)).is_infinite());
    // Sneddon: D = a/2 ln((R + a)/(R − a)) = 0.3 at a = 0.522; the slope is a/√(R² − a²).
    let (a, depth) = (0.522_f64, 0.3022);
    let found = under(Sphere::new(1.0).unwrap(), Load::Penetration(depth));
    assert!(
        (found / (a / (1.0 - a * a).sqrt()) - 1.0).abs() < 0.01,
        "{found}"
    );
}

#[test]
fn a_long_ellipse_has_the_slope_of_its_narrow_side() {
    // Radii of curvature 100 and 1: Hertz's ellipse has semi-axes in the ratio 1 : 0.0446 (e = 0.99900), which follow
    // from (K − E)/(E/(1 − e²) − K) = 1/100. Its slopes are a/100 and b/1, b/1 being 4.46 times as large.
    let ellipse = IndenterMap::new(map(256, |x, y| x * x / 200.0 + y * y / 2.0));
    let model = Model::on_half_space([1.0, 0.3], Relief::Bare, ellipse);
    let options = SolverOptions::default();
    let (domain, load) = (Domain::Side(2.0), Load::Force(2e-5));
    let path = solve_path(&model, domain, 256, &[load], &options, &mut ()).unwrap();
    let step = &path.steps[0];
    // The farthest point of the edge is (a, 0).
    let narrow = step.summary.contact_area / (std::f64::consts::PI * step.summary.contact_radius);
    let found = step.slope.unwrap().value();
    assert!((found / narrow - 1.0).abs() < 0.1, "{found} {narrow}");
    assert!(found < 0.1 * step.summary.contact_radius);
}

#[test]
fn a_roller_in_a_cell_has_the_slope_at_its_half_width() {
    let roller = IndenterMap::new(map(128, |x, _| 0.5 * x * x));
    let model = Model::on_half_space([1.0, 0.3], Relief::Bare, roller);
    let found = slope(&model, Domain::Periodic(2.0), Load::Force(0.1));
    // Line contact under 0.05 per length, b² = 4 F R/(π E* L) (Johnson 1985, 4.43); the neighbours, two away, add b²/4
    // of the curvature.
    let half_width = (4.0 * 0.05 * 0.91 / std::f64::consts::PI).sqrt();
    assert!(matches!(found, ContactSlope::AtEdge(_)));
    assert!(
        (found.value() / half_width - 1.0).abs() < 0.05,
        "{found:?} {half_width}"
    );
}

#[test]
fn a_rough_surface_has_its_root_mean_square_slope_in_contact() {
    use std::f64::consts::PI;
    // Two waves, |∇h|² = (π s)² (sin² πx... ) with the mean (π s)² over a whole wave; near full contact.
    let height = 0.02;
    let wave = map(128, |x, y| {
        height * ((2.0 * PI * x).cos() + (2.0 * PI * y).cos())
    });
    let wave = ReliefMap::new(wave, MapCompliance::Uniform(0.0)).unwrap();
    let model = Model::on_half_space([1.0, 0.3], Relief::Map(wave), FlatPunch::new(9.0).unwrap());
    // Contact is full from a mean pressure of π E* · 2 h/λ on: 0.14.
    let found = slope(&model, Domain::Periodic(2.0), Load::Force(4.0));
    assert!(matches!(found, ContactSlope::RootMeanSquare(_)));
    // ⟨(2π h sin 2πx)²⟩ = (2π h)²/2 along each axis; differences over two elements of 1/32 of a wave lose
    // 1 − sinc(2π/32) = 0.6 %.
    assert!(
        (found.value() / (2.0 * PI * height) - 1.0).abs() < 0.01,
        "{found:?}"
    );
}
