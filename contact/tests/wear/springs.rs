//! Surfaces on springs: a closed form, and an independent integration.

use super::*;

/// A wavy surface on springs of this compliance.
#[derive(Debug)]
struct Waves {
    compliance: f64,
}

fn wave([x, y]: [f64; 2]) -> f64 {
    let turn = std::f64::consts::TAU;
    0.01 * ((turn * x).cos() * (turn * y).cos() - 1.0)
}

impl ReliefShape for Waves {
    fn profile(&self, points: &[[f64; 2]]) -> Vec<f64> {
        points.iter().map(|point| wave(*point)).collect()
    }

    fn compliance(&self, points: &[[f64; 2]]) -> Vec<f64> {
        vec![self.compliance; points.len()]
    }
}

#[test]
fn the_pressure_of_a_plane_on_springs_tends_to_uniform_exponentially() {
    let (compliance, force, size) = (0.5, 0.1, 16);
    let relief = Relief::custom(Waves { compliance });
    let flat = model(RIGID, relief, Plane);
    let distances = [0.0, 0.2, 0.5, 1.0, 2.0];
    for tolerance in [1e-2, 1e-3] {
        let found = solve(
            &flat,
            Domain::Periodic(1.0),
            size,
            force,
            &wear(&distances, tolerance),
        );
        let grid = Grid::new(1.0, size).unwrap();
        let heights: Vec<f64> = grid.centres().map(wave).collect();
        let mean = heights.iter().sum::<f64>() / heights.len() as f64;
        let mut worst = 0.0_f64;
        for (step, contact) in &found {
            // All touch: p − p̄ = (z − z̄)/η e^{−ks/η}, and what is lost of z − z̄ is worn.
            let left = (-contact.distance / compliance).exp();
            let pressure = &step.solution.pressure;
            for ((height, p), depth) in heights.iter().zip(pressure).zip(&contact.depth) {
                let wanted = force + (height - mean) / compliance * left;
                assert!((p - wanted).abs() < 0.2 * tolerance * force, "{p} {wanted}");
                let wanted = force * contact.distance + (height - mean) * (1.0 - left);
                worst = worst.max((depth - wanted).abs() / contact.max_depth.max(1e-300));
            }
        }
        assert!(worst < tolerance, "{worst:e}");
    }
}

/// A map with springs of modulus 1 as long as it is high above its lowest point, a pit beside a centre, and the height
/// at each centre of a grid.
fn springs(size: usize) -> (Relief, Vec<f64>) {
    let count = 4 * size;
    let point = |i: usize| (i as f64 + 0.5) / count as f64 - 0.5;
    let height = |k: usize| 1.0 + 10.0 * wave([point(k / count), point(k % count)]);
    let heights = (0..count * count).map(|k| if k == 0 { 0.0 } else { height(k) });
    let map = HeightMap::new(heights.collect(), [count; 2], [1.0; 2]).unwrap();
    let relief = ReliefMap::new(map, MapCompliance::YoungModulus(1.0)).unwrap();
    let relief = Relief::Map(relief);
    let sampled = relief.sample(&Grid::new(1.0, size).unwrap());
    let heights = sampled.compliance().to_vec();
    (relief, heights)
}

/// Heights of springs of modulus 1 under a plane with this mean pressure after a distance, by Runge's and Kutta's
/// method: `dH/ds = −p`, `p = 1 − c/H` with c from the force, as long as all touch. Also the pressures.
fn integrated(mut heights: Vec<f64>, mean: f64, distance: f64) -> (Vec<f64>, Vec<f64>) {
    let pressures = |heights: &[f64]| -> Vec<f64> {
        let inverse = heights.iter().map(|h| 1.0 / h).sum::<f64>() / heights.len() as f64;
        let level = (1.0 - mean) / inverse;
        heights.iter().map(|h| 1.0 - level / h).collect()
    };
    let moved = |heights: &[f64], rate: &[f64], by: f64| -> Vec<f64> {
        heights.iter().zip(rate).map(|(h, p)| h - by * p).collect()
    };
    let steps = 200;
    let step = distance / f64::from(steps);
    for _ in 0..steps {
        let one = pressures(&heights);
        let two = pressures(&moved(&heights, &one, 0.5 * step));
        let three = pressures(&moved(&heights, &two, 0.5 * step));
        let four = pressures(&moved(&heights, &three, step));
        for (i, height) in heights.iter_mut().enumerate() {
            *height -= step / 6.0 * (one[i] + 2.0 * two[i] + 2.0 * three[i] + four[i]);
        }
    }
    let pressures = pressures(&heights);
    (heights, pressures)
}

#[test]
fn springs_shorten_as_they_wear_as_an_independent_integration_says() {
    let (size, force) = (16, 0.3);
    let (relief, heights) = springs(size);
    let flat = model(RIGID, relief, Plane);
    let distances = [0.3, 1.0, 2.0];
    let mut errors = Vec::new();
    for tolerance in [1e-2, 1e-3] {
        let found = solve(
            &flat,
            Domain::Periodic(1.0),
            size,
            force,
            &wear(&distances, tolerance),
        );
        let mut worst = 0.0_f64;
        for (step, contact) in &found {
            let (left, pressures) = integrated(heights.clone(), force, contact.distance);
            let depths = heights
                .iter()
                .zip(&left)
                .map(|(before, after)| before - after);
            for (found, wanted) in contact.depth.iter().zip(depths) {
                worst = worst.max((found - wanted).abs() / contact.max_depth);
            }
            let found = &step.solution.pressure;
            for (found, wanted) in found.iter().zip(pressures) {
                assert!(
                    (found - wanted).abs() < tolerance * force,
                    "{found} {wanted}"
                );
            }
        }
        assert!(worst < tolerance, "{worst:e}");
        errors.push(worst);
    }
    // As measured: 3.9e-4 and 2.1e-4. Steps that end at the distances are shorter than the tolerance asks for.
    assert!(errors[1] < 0.6 * errors[0], "{errors:?}");
}
