//! Tests that every indenter must pass.

use super::*;
use pellicle_texture::{Grid, HeightMap};

fn all() -> [Indenter; 9] {
    let bowl = vec![2.0, 1.0, 2.0, 1.0, 0.5, 1.0, 2.0, 1.0, 2.0];
    [
        Paraboloid::new(2.0).unwrap().into(),
        EllipticParaboloid::new([2.0, 0.7]).unwrap().into(),
        Sphere::new(2.0).unwrap().into(),
        Cone::new(1.2, 0.3).unwrap().into(),
        PowerLaw::new(2.5, 1.5).unwrap().into(),
        FlatPunch::new(0.5).unwrap().into(),
        Plane.into(),
        Pyramid::vickers(0.3).unwrap().into(),
        IndenterMap::new(HeightMap::new(bowl, [3, 3], [3.0, 3.0]).unwrap()).into(),
    ]
}

#[test]
fn every_indenter_has_its_lowest_point_at_the_origin() {
    for indenter in all() {
        assert_eq!(indenter.height(0.0, 0.0), 0.0, "{indenter:?}");
        for k in 0..200 {
            let (x, y) = (f64::from(k % 20) / 7.0 - 1.4, f64::from(k / 20) / 3.5 - 1.4);
            assert!(indenter.height(x, y) >= 0.0, "{indenter:?} at {x}, {y}");
        }
    }
}

#[test]
fn heights_at_many_points_equal_the_height_at_each() {
    let point = |k: u32| [k % 61, k / 61].map(|i| f64::from(i) / 20.0 - 1.5);
    let points: Vec<_> = (0..61 * 61).map(point).collect();
    for indenter in all() {
        let each = points.iter().map(|[x, y]| indenter.height(*x, *y));
        assert!(each.eq(indenter.heights(&points)), "{indenter:?}");
    }
}

#[test]
fn the_mean_over_a_circle_is_the_mean_of_many_heights() {
    for indenter in all() {
        let turn = |k: i32| (f64::from(k) * std::f64::consts::TAU / 9001.0).sin_cos();
        let heights = (0..9001)
            .map(turn)
            .map(|(sine, cosine)| indenter.height(0.9 * cosine, 0.9 * sine));
        let mean = heights.sum::<f64>() / 9001.0;
        let error = (indenter.mean_profile(0.9) - mean).abs();
        // A profile of height about 1 with a few kinks on 360 angles: about 1/360² of it each. The mean of a map is
        // interpolated between radii a tenth apart.
        let within = if matches!(indenter, Indenter::Map(_)) {
            2e-3
        } else {
            3e-5
        };
        assert!(
            mean.is_infinite() || error < within,
            "{indenter:?}: {error:e}"
        );
        assert_eq!(mean.is_infinite(), indenter.mean_profile(0.9).is_infinite());
        // The enum and the trait give the same numbers.
        let through_trait = Profile::mean_profile(&indenter, 0.9);
        assert_eq!(
            through_trait.to_bits(),
            indenter.mean_profile(0.9).to_bits()
        );
    }
}

#[test]
fn mirrored_shapes_have_equal_heights_on_both_sides() {
    let mut shapes = all().to_vec();
    shapes.push(Pyramid::berkovich(0.3).unwrap().into());
    for indenter in shapes {
        let heights =
            |[x, y]: [f64; 2]| [[x, y], [-x, y], [x, -y]].map(|[x, y]| indenter.height(x, y));
        let is_same = |at| {
            let [here, left, below] = heights(at);
            // Rounding of the ridges' directions.
            let differs = |there: f64| (there - here).abs() > 1e-14;
            !(differs(left) || differs(below))
        };
        let places = [[0.7, 0.1], [0.2, 0.9], [1.1, 1.3], [0.05, 0.02]];
        let is_symmetric_map = matches!(indenter, Indenter::Map(_));
        assert_eq!(
            indenter.is_mirrored() || is_symmetric_map,
            places.into_iter().all(is_same),
            "{indenter:?}"
        );
    }
}

#[test]
fn samples_on_a_grid_vary_fastest_along_y() {
    let indenter = Indenter::from(IndenterMap::new(
        HeightMap::new(vec![0.0, 1.0], [2, 1], [2.0, 2.0]).unwrap(),
    ));
    // The lowest sample, at x = −½ of the map, is at the origin, so the map spans x from −½ to 3/2.
    let grid = Grid::new(2.0, 2).unwrap();
    assert_eq!(indenter.sample(&grid), [0.0, 0.0, 0.5, 0.5]);
}

#[test]
fn each_parameter_of_a_shape_can_be_replaced() {
    use IndenterQuantity::{
        Coefficient, Exponent, FaceAngle, HalfAngle, Radius, RadiusAlongX, RadiusAlongY, TipRadius,
    };
    let wanted: [&[IndenterQuantity]; 9] = [
        &[Radius],
        &[RadiusAlongX, RadiusAlongY],
        &[Radius],
        &[HalfAngle, TipRadius],
        &[Exponent, Coefficient],
        &[Radius],
        &[],
        &[FaceAngle, TipRadius],
        &[],
    ];
    for (indenter, wanted) in all().iter().zip(wanted) {
        for quantity in [
            Radius,
            RadiusAlongX,
            RadiusAlongY,
            HalfAngle,
            FaceAngle,
            TipRadius,
            Exponent,
            Coefficient,
        ] {
            let Some(own) = indenter.parameter(quantity) else {
                assert!(!wanted.contains(&quantity), "{indenter:?} {quantity:?}");
                assert_eq!(indenter.with_parameter(quantity, 1.1).unwrap(), *indenter);
                continue;
            };
            assert!(wanted.contains(&quantity), "{indenter:?} {quantity:?}");
            let other = indenter.with_parameter(quantity, 1.1).unwrap();
            assert_eq!(other.parameter(quantity), Some(1.1));
            assert_eq!(other.with_parameter(quantity, own).unwrap(), *indenter);
        }
    }
    // A punch's height does not depend on its radius smoothly.
    let smooth = all().map(|indenter| indenter.parameters().len());
    assert_eq!(smooth, [1, 2, 1, 2, 2, 0, 0, 2, 0]);
}

#[test]
fn a_tip_counts_as_sharp_if_rounded_over_less_than_two_elements() {
    // The round part of a cone ends at R cos α.
    let blunt: Indenter = Cone::new(1.2, 0.3).unwrap().into();
    let end = 0.3 * 1.2_f64.cos();
    assert_eq!(blunt.distance_to_edge(0.3, 0.4, 0.501 * end), 0.5);
    assert_eq!(blunt.distance_to_edge(0.3, 0.4, 0.499 * end), f64::INFINITY);
    // The curvature of a power law below 2 is infinite on the axis, but the pressure hardly shows it near 2.
    for (exponent, distance) in [(1.0, 0.5), (1.5, 0.5), (1.7, f64::INFINITY)] {
        let shape: Indenter = PowerLaw::new(exponent, 1.0).unwrap().into();
        assert_eq!(shape.distance_to_edge(0.3, 0.4, 0.01), distance);
    }
}

/// A user-defined shape that implements only its height.
#[derive(Debug)]
struct Ramp;

impl Profile for Ramp {
    fn height(&self, x: f64, _: f64) -> f64 {
        x.abs()
    }
}

#[test]
fn a_custom_shape_has_no_symmetry_and_no_rim_and_equals_its_copies() {
    let (one, other) = (Indenter::custom(Ramp), Indenter::custom(Ramp));
    assert!(one == one.clone() && one != other);
    assert!(!one.is_mirrored() && !one.is_mirrored_in_y());
    assert_eq!(Ramp.distance_to_rim(3.0, -4.0), f64::INFINITY);
    // The mean of |ρ cos φ| is 2ρ/π.
    let mean = one.mean_profile(0.5) / (1.0 / std::f64::consts::PI);
    assert!((mean - 1.0).abs() < 0.01, "{mean}");
}

#[test]
fn heights_have_the_symmetry_that_an_indenter_declares() {
    for indenter in all() {
        let [x, y] = [0.31, 0.17];
        let heights = [[x, y], [-x, y], [x, -y]].map(|[x, y]| indenter.height(x, y));
        let alike = |other: f64| (heights[0] - other).abs() < 1e-12 || heights[0] == other;
        let is_map = matches!(indenter, Indenter::Map(_));
        assert_eq!(Profile::is_mirrored(&indenter), indenter.is_mirrored());
        assert_eq!(indenter.is_mirrored_in_y(), !is_map, "{indenter:?}");
        assert!(!indenter.is_mirrored_in_y() || alike(heights[2]));
        assert!(!indenter.is_mirrored() || (alike(heights[1]) && alike(heights[2])));
    }
    let berkovich: Indenter = Pyramid::berkovich(0.3).unwrap().into();
    assert!(!berkovich.is_mirrored() && berkovich.is_mirrored_in_y());
}
