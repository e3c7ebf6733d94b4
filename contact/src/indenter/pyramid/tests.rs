//! The rounded pyramid compared with its definition and its limits, and its smoothness.

use super::*;
use crate::indenter::Cone;
use std::f64::consts::TAU;

/// The three standard shapes and two others, all with the same tip radius.
fn pyramids(tip_radius: f64) -> Vec<Pyramid> {
    vec![
        Pyramid::berkovich(tip_radius).unwrap(),
        Pyramid::vickers(tip_radius).unwrap(),
        Pyramid::cube_corner(tip_radius).unwrap(),
        Pyramid::new(5, 0.9, tip_radius).unwrap(),
        Pyramid::new(6, 1.5, tip_radius).unwrap(),
    ]
}

/// The sharp pyramid from its definition, `m max_k n_k·x`, the faces midway between the ridges.
fn sharp(pyramid: &Pyramid, x: f64, y: f64) -> f64 {
    let faces = pyramid.faces();
    let rise = |k: usize| {
        let (sine, cosine) = ((k as f64 + 0.5) * TAU / faces as f64).sin_cos();
        x * cosine + y * sine
    };
    (0..faces).map(rise).fold(f64::MIN, f64::max) / pyramid.face_angle().tan()
}

/// Points spread evenly over a disc, none on a line of symmetry.
fn points(count: u32, radius: f64) -> impl Iterator<Item = [f64; 2]> {
    (0..count).map(move |k| {
        let (sine, cosine) = (2.399_963 * f64::from(k)).sin_cos();
        let distance = radius * ((f64::from(k) + 0.5) / f64::from(count)).sqrt();
        [distance * cosine, distance * sine]
    })
}

#[test]
fn the_standard_angles_have_their_area_ratios() {
    // Areas over depth² of a sharp pyramid of n faces: projected n tan(π/n) tan² α, true surface that divided by sin α.
    let projected = |n: f64, angle: f64| n * (PI / n).tan() * angle.tan().powi(2);
    let surface = |n: f64, angle: f64| projected(n, angle) / angle.sin();
    let vickers = Pyramid::VICKERS_FACE_ANGLE;
    // An angle rounded to 0.005° changes tan² α by 2 · 0.005° / (sin α cos α) = 4.6e-4.
    let modified = projected(3.0, Pyramid::MODIFIED_BERKOVICH_FACE_ANGLE) / projected(4.0, vickers);
    assert!((modified - 1.0).abs() < 4.6e-4, "{modified}");
    let original = surface(3.0, Pyramid::BERKOVICH_FACE_ANGLE) / surface(4.0, vickers);
    assert!((original - 1.0).abs() < 4.6e-4, "{original}");
    // Three faces of a cube meet at right angles: n₁·n₂ = 0 for normals (cos α · horizontal, sin α), cos² α cos 120° +
    // sin² α = 0.
    let (sine, cosine) = Pyramid::CUBE_CORNER_FACE_ANGLE.sin_cos();
    assert!((sine * sine - 0.5 * cosine * cosine).abs() < 2.0 * f64::EPSILON);
}

#[test]
fn without_a_tip_radius_a_pyramid_is_sharp() {
    for pyramid in pyramids(0.0) {
        for [x, y] in points(500, 3.0) {
            let error = (pyramid.height(x, y) - sharp(&pyramid, x, y)).abs();
            assert!(error < 1e-14, "rounding of heights up to 5: {error:e}");
        }
        assert_eq!(pyramid.height(0.0, 0.0), 0.0);
    }
}

#[test]
fn it_tends_to_the_sharp_pyramid_as_the_tip_radius_vanishes() {
    for radius in [1e-1, 1e-3, 1e-6] {
        for pyramid in pyramids(radius) {
            // The sharp pyramid through the same faces, R (1/sin α − 1) deeper, lies below the blunt one, nowhere
            // inside.
            let depth = radius * (pyramid.face_angle().sin().recip() - 1.0);
            for [x, y] in points(500, 1.0) {
                let above = pyramid.height(x, y) - (sharp(&pyramid, x, y) - depth);
                assert!(
                    (-1e-15..=depth + 1e-15).contains(&above),
                    "{above:e} of {depth:e}"
                );
            }
        }
    }
}

#[test]
fn the_faces_are_flat_and_exactly_the_shifted_faces_of_the_sharp_pyramid() {
    for pyramid in pyramids(0.4) {
        let depth = 0.4 * (pyramid.face_angle().sin().recip() - 1.0);
        let (sine, cosine) = (PI / pyramid.faces() as f64).sin_cos();
        for distance in [0.5, 2.0, 100.0] {
            let (x, y) = (distance * cosine, distance * sine);
            let error = pyramid.height(x, y) - (sharp(&pyramid, x, y) - depth);
            assert!(
                error.abs() < 1e-15 * (1.0 + 3.0 * distance),
                "rounding: {error:e}"
            );
        }
    }
}

#[test]
fn it_is_the_envelope_of_the_planes_that_touch_the_tip() {
    // The largest of s·x − R (√(1 + |s|²) − 1) over a fine sampling of the polygon, from the definition alone.
    let steps = 120_u32;
    for pyramid in pyramids(0.7) {
        let slope = pyramid.face_angle().tan().recip();
        let corner = |k: usize| {
            let (sine, cosine) = ((k as f64 + 0.5) * TAU / pyramid.faces() as f64).sin_cos();
            [slope * cosine, slope * sine]
        };
        for [x, y] in points(60, 1.5) {
            let mut largest = f64::MIN;
            for k in 0..pyramid.faces() {
                let (from, to) = (corner(k), corner(k + 1));
                for index in 0..(steps + 1) * (steps + 1) {
                    let weight = f64::from(index / (steps + 1)) / f64::from(steps);
                    let share = f64::from(index % (steps + 1)) / f64::from(steps);
                    let s = [0, 1].map(|i| weight * ((1.0 - share) * from[i] + share * to[i]));
                    let plane = s[0] * x + s[1] * y
                        - 0.7 * ((1.0 + s[0] * s[0] + s[1] * s[1]).sqrt() - 1.0);
                    largest = largest.max(plane);
                }
            }
            let missing = pyramid.height(x, y) - largest;
            // The nearest sampled s is off by at most the edge length over 120, and the curvature is at most R.
            let off = 1.8 * slope / f64::from(steps);
            assert!(
                (-1e-14..0.5 * 0.7 * off * off + 1e-14).contains(&missing),
                "{missing:e}"
            );
        }
    }
}

#[test]
fn it_is_convex_and_its_slope_is_continuous() {
    // Convexity: second differences ≥ 0. C¹: they are at most h² / (R sin³ α), whereas a kink would leave a multiple of
    // h.
    for pyramid in pyramids(0.3) {
        let bound = 1.0 / (0.3 * pyramid.face_angle().sin().powi(3));
        for step in [1e-1, 1e-2, 1e-3] {
            for (k, [x, y]) in points(3000, 0.6).chain(seams(&pyramid)).enumerate() {
                let (sine, cosine) = (0.754_878 * k as f64).sin_cos();
                let at = |t: f64| pyramid.height(x + t * step * cosine, y + t * step * sine);
                let second = at(1.0) - 2.0 * at(0.0) + at(-1.0);
                // Heights below 2 round to 4e-16 each.
                assert!(second >= -2e-15, "not convex at {x}, {y}: {second:e}");
                assert!(
                    second <= bound * step * step + 2e-15,
                    "a kink at {x}, {y}: {second:e}, step {step}"
                );
            }
        }
    }
}

/// Points exactly on the borders between sphere, ridge and face, and on the ridge's crest.
fn seams(pyramid: &Pyramid) -> Vec<[f64; 2]> {
    let (radius, alpha) = (pyramid.tip_radius(), pyramid.face_angle());
    let (sine, cosine) = (PI / pyramid.faces() as f64).sin_cos();
    let ridge_slope = cosine / alpha.tan();
    let edge = radius * alpha.cos() * sine;
    let on_seams = |k: u32| {
        let share = f64::from(k) / 100.0;
        let across = share * edge;
        let along =
            ridge_slope / 1.0_f64.hypot(ridge_slope) * (radius * radius - across * across).sqrt();
        [
            [along, across],
            [edge / sine * cosine + share, edge],
            [along + share, 0.0],
        ]
    };
    (0..=100).flat_map(on_seams).collect()
}

#[test]
fn height_and_slope_are_continuous_across_every_seam_to_first_order_in_the_step() {
    for pyramid in pyramids(0.3) {
        for [x, y] in seams(&pyramid) {
            let jump = |h: f64| {
                let at = |t: f64| pyramid.height(x + 0.8 * t, y + 0.6 * t);
                ((at(h) - at(0.0)) / h - (at(0.0) - at(-h)) / h).abs()
            };
            let bound = 1.0 / (0.3 * pyramid.face_angle().sin().powi(3));
            // A continuous slope: the jump vanishes with the step at a bounded rate; the rest is rounding over the
            // step.
            for h in [1e-2, 1e-3, 1e-4, 1e-5] {
                assert!(
                    jump(h) <= bound * h + 2e-15 / h,
                    "{:e} at step {h} of {x}, {y}",
                    jump(h)
                );
            }
        }
    }
}

#[test]
fn it_has_the_symmetry_of_its_faces() {
    for pyramid in pyramids(0.3) {
        let (sine, cosine) = (TAU / pyramid.faces() as f64).sin_cos();
        for [x, y] in points(300, 1.0) {
            let height = pyramid.height(x, y);
            let turned = pyramid.height(cosine * x - sine * y, sine * x + cosine * y);
            assert!(
                (turned - height).abs() < 1e-14,
                "rounding of heights up to 1.5"
            );
            assert!((pyramid.height(x, -y) - height).abs() < 1e-14);
        }
    }
}

#[test]
fn with_many_faces_it_tends_to_the_cone_with_second_order() {
    let cone = Cone::new(1.1, 0.3).unwrap();
    let error = |faces: usize| {
        let pyramid = Pyramid::new(faces, 1.1, 0.3).unwrap();
        let errors =
            points(400, 1.0).map(|[x, y]| (pyramid.height(x, y) - cone.height(x, y)).abs());
        errors.fold(0.0, f64::max)
    };
    // The polygon of slopes lies within m (1 − cos(π/n)) ≈ m π²/2n² of the cone's disc.
    let order = (error(20) / error(320)).log2() / 4.0;
    assert!((order - 2.0).abs() < 0.05, "order {order}");
}

#[test]
fn the_mean_over_a_circle_of_a_sharp_pyramid_is_its_closed_form() {
    let pyramid = Pyramid::berkovich(0.0).unwrap();
    // m ρ (n/π) sin(π/n)
    let exact = 2.0 / pyramid.face_angle().tan() * 3.0 / PI * (PI / 3.0).sin();
    assert!((pyramid.mean_profile(2.0) / exact - 1.0).abs() < 1e-15);
    assert!((pyramid.mean_slope(2.0) / (0.5 * exact) - 1.0).abs() < 1e-15);
}

#[test]
fn the_mean_over_a_circle_of_a_rounded_pyramid_is_the_mean_of_its_heights() {
    let pyramid = Pyramid::new(4, 1.2, 0.5).unwrap();
    assert_eq!(pyramid.mean_profile(0.0), 0.0);
    // Inside the cap, across it, and where faces take over.
    for radius in [0.01, 0.1, 0.14, 0.2, 0.3, 2.0, 50.0] {
        let points = 20_000;
        let height = |k: i32| {
            let (sine, cosine) = (2.0 * PI * (f64::from(k) + 0.5) / f64::from(points)).sin_cos();
            pyramid.height(radius * cosine, radius * sine)
        };
        let mean = (0..points).map(height).sum::<f64>() / f64::from(points);
        // The error of the three-point Gauss rule over the ridge.
        let error = pyramid.mean_profile(radius) / mean - 1.0;
        assert!(error.abs() < 2e-6, "{radius}: {error}");
        let step = 1e-4 * radius;
        let [more, less] = [step, -step].map(|step| pyramid.mean_profile(radius + step));
        let error = pyramid.mean_slope(radius) / ((more - less) / (2.0 * step)) - 1.0;
        // The error of the difference where the curvature jumps.
        assert!(error.abs() < 1e-4, "{radius}: {error}");
    }
}

#[test]
fn a_pyramid_needs_three_faces_and_an_acute_angle() {
    let (least, most) = (3, 360);
    assert_eq!(
        Pyramid::new(2, 1.0, 0.0),
        Err(IndenterError::FaceCount {
            found: 2,
            least,
            most
        })
    );
    let quantity = IndenterQuantity::FaceAngle;
    assert_eq!(
        Pyramid::new(3, 65.03, 0.0),
        Err(IndenterError::Angle {
            quantity,
            found: 65.03
        })
    );
    assert!(Pyramid::berkovich(f64::NAN).is_err());
}

#[test]
fn the_edge_of_a_sharp_pyramid_is_its_nearest_ridge() {
    for (sharp, blunt) in pyramids(0.0).into_iter().zip(pyramids(10.0)) {
        let sector = PI / sharp.faces() as f64;
        for part in [-0.9, -0.3, 0.0, 0.5, 1.0] {
            // A ridge lies along x.
            let angle = part * sector;
            let [x, y] = [0.7 * angle.cos(), 0.7 * angle.sin()];
            let found = sharp.distance_to_edge(x, y, 0.01);
            assert!((found - 0.7 * angle.sin().abs()).abs() < 1e-14, "{found}");
            assert_eq!(blunt.distance_to_edge(x, y, 0.01), f64::INFINITY);
        }
    }
}
