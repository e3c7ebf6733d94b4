//! Height maps: heights between samples, derivatives, invalid samples.

use super::*;

#[test]
fn a_linear_map_has_ridges_along_its_samples_and_a_bicubic_one_has_none() {
    let map = HeightMap::new(vec![0.0; 20], [4, 5], [2.0, 5.0]).unwrap();
    assert_eq!(map.distance_to_ridge([0.1, 0.2]), f64::INFINITY);
    // Samples at x = ±0.25, ±0.75 and y = 0, ±1, ±2.
    let linear = map.with_interpolation(Interpolation::Linear);
    for (point, wanted) in [([0.25, 0.4], 0.0), ([0.05, 0.4], 0.2), ([0.0, 0.1], 0.1)] {
        let found = linear.distance_to_ridge(point);
        // a few roundings of numbers up to 5
        assert!((found - wanted).abs() < 1e-15, "{point:?}: {found}");
    }
}

#[test]
fn a_bilinear_surface_is_reproduced_between_the_samples() {
    let surface = |x: f64, y: f64| 1.0 + 2.0 * x - 3.0 * y + 4.0 * x * y;
    let (shape, extent) = ([4, 5], [2.0, 5.0]);
    let samples = (0..20)
        .map(|n| surface(f64::from(n / 5) * 0.5 - 0.75, f64::from(n % 5) - 2.0))
        .collect();
    let map = HeightMap::new(samples, shape, extent).unwrap();
    for interpolation in [Interpolation::Linear, Interpolation::Bicubic] {
        let map = map.clone().with_interpolation(interpolation);
        for (x, y) in [(-0.75, -2.0), (0.1, 0.3), (0.74, 1.99), (0.0, 0.0)] {
            // Heights up to 12, a dozen roundings.
            assert!((map.height([x, y]) - surface(x, y)).abs() < 2e-14);
        }
    }
}

#[test]
fn beyond_the_samples_the_edge_value_continues() {
    let map = HeightMap::new(vec![1.0, 2.0, 3.0, 4.0], [2, 2], [2.0, 2.0]).unwrap();
    assert_eq!(map.height([-9.0, -0.5]), 1.0);
    assert_eq!(map.height([9.0, 9.0]), 4.0);
    assert!(map.covers([1.0, -1.0]) && !map.covers([1.01, 0.0]));
}

/// n × n samples of a surface on the square of side 2.
fn sampled(n: u32, surface: impl Fn(f64, f64) -> f64) -> HeightMap {
    let at = |i: u32| (2.0 * f64::from(i) + 1.0) / f64::from(n) - 1.0;
    let heights = (0..n * n).map(|k| surface(at(k / n), at(k % n)));
    HeightMap::new(heights.collect(), [n as usize; 2], [2.0, 2.0]).unwrap()
}

#[test]
fn a_bicubic_surface_is_reproduced_away_from_the_rim_and_the_samples_to_the_bit() {
    let cubic = |x: f64| 1.0 + x * (2.0 - x * (3.0 - 4.0 * x));
    let surface = |x: f64, y: f64| cubic(x) * cubic(y) - 2.0 * y * x;
    let map = sampled(12, surface);
    for k in 0..1000_u32 {
        let [x, y] = [k % 37, k % 41].map(|k| f64::from(k) / 37.0 - 0.5);
        // Heights up to 30, 64 products.
        assert!((map.height([x, y]) - surface(x, y)).abs() < 1e-13);
    }
    for (n, height) in map.heights().iter().enumerate() {
        assert_eq!(map.height(map.point([n / 12, n % 12])), *height);
    }
}

#[test]
fn heights_and_slopes_are_continuous_across_the_samples() {
    let map = sampled(9, |x, y| (7.0 * x + y).sin() + (5.0 * x * y).cos());
    let [x, _] = map.point([4, 4]);
    let h = 1e-4;
    for k in 0..80_u32 {
        let y = f64::from(k) / 40.0 - 1.0;
        let [before, here, after] = [-h, 0.0, h].map(|dx| map.height([x + dx, y]));
        // The second difference is of order h across a ridge, such as a bilinear map has, and h² f″ on a smooth
        // surface, with f″ < 100.
        let bend = (after - 2.0 * here + before).abs();
        assert!(bend < 100.0 * h * h, "{y}: {bend:e}");
    }
    let linear = map.with_interpolation(Interpolation::Linear);
    let bend =
        linear.height([x + h, 0.7]) - 2.0 * linear.height([x, 0.7]) + linear.height([x - h, 0.7]);
    assert!(bend.abs() > 1000.0 * h * h, "{bend:e}");
}

#[test]
fn the_error_between_samples_falls_with_the_fourth_power_of_their_distance() {
    let surface = |x: f64, y: f64| (3.0 * x).sin() * (2.0 * y).cos();
    let error = |n: u32| {
        let map = sampled(n, surface);
        let errors = (0..41 * 41_u32).map(|k| {
            let [x, y] = [k / 41, k % 41].map(|k| f64::from(k) / 41.0 - 0.5);
            (map.height([x, y]) - surface(x, y)).abs()
        });
        errors.fold(0.0, f64::max)
    };
    let errors = [16, 32, 64].map(error);
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((3.8..4.3).contains(&order), "order {order}");
    }
}

#[test]
fn a_linear_map_has_its_extremes_in_samples_and_the_bits_of_the_bilinear_formula() {
    let map = sampled(6, |x, y| (9.0 * x).sin() - (4.0 * y).cos());
    let map = map.with_interpolation(Interpolation::Linear);
    let [least, greatest] = [map.least(), map.greatest()];
    assert_eq!([map.lowest(), map.highest()], [least, greatest]);
    // Sample 2 of x and 3 of y are at −1/6 and 1/6: u = ⅜ and v = ¼ of the way to the next.
    let f = |i: usize, j: usize| map.heights()[6 * i + j];
    let along_y = |i: usize| 0.75 * f(i, 3) + 0.25 * f(i, 4);
    let expected = 0.625 * along_y(2) + 0.375 * along_y(3);
    let found = map.height([-1.0 / 24.0, 0.25]);
    assert!((found - expected).abs() < 1e-15, "{found} {expected}");
}

#[test]
fn the_most_central_of_equal_lowest_points_is_taken() {
    let mut heights = vec![0.0; 25];
    heights[0] = 1.0;
    assert_eq!(
        HeightMap::new(heights, [5, 5], [1.0, 1.0])
            .unwrap()
            .with_interpolation(Interpolation::Linear)
            .lowest_point(),
        [0.0, 0.0]
    );
    let ramp = HeightMap::new(vec![3.0, 2.0, 1.0], [3, 1], [3.0, 1.0]).unwrap();
    assert_eq!(ramp.lowest_point(), [1.0, 0.0]);
}

#[test]
fn maps_of_the_wrong_size_or_with_values_not_finite_are_refused() {
    let wrong = HeightMap::new(vec![0.0; 5], [2, 3], [1.0, 1.0]);
    assert_eq!(
        wrong,
        Err(TextureError::MapShape {
            shape: [2, 3],
            found: 5
        })
    );
    assert!(HeightMap::new(vec![], [0, 3], [1.0, 1.0]).is_err());
    assert!(HeightMap::new(vec![0.0; 4], [2, 2], [1.0, 0.0]).is_err());
    let infinite = HeightMap::new(vec![0.0, 0.0, 0.0, f64::INFINITY], [2, 2], [1.0, 1.0]);
    assert_eq!(
        infinite,
        Err(TextureError::MapSample {
            index: [1, 1],
            found: f64::INFINITY
        })
    );
}

#[test]
fn heights_at_crossings_equal_those_at_the_points_to_the_bit() {
    let map = sampled(9, |x, y| (7.0 * x + y).sin() + (5.0 * x * y).cos());
    // Samples, points between them, and points beyond the rim.
    let (x, y) = ([-0.7, -0.25, 0.0, 0.1, 0.31], [-0.6, 0.0, 1.0 / 9.0, 0.2]);
    for map in [map.clone(), map.with_interpolation(Interpolation::Linear)] {
        let heights = map.at_crossings([&x, &y]);
        assert_eq!(heights.len(), x.len() * y.len());
        for (k, height) in heights.into_iter().enumerate() {
            let point = [x[k / y.len()], y[k % y.len()]];
            assert_eq!(height.to_bits(), map.height(point).to_bits(), "{point:?}");
        }
    }
}
