//! Means over four points against sums of single points, and against a traction whose stresses are known.

use std::f64::consts::PI;

use pellicle_kernel::{Base, Interface, Layer, Material};

use super::*;
use crate::{Depth, ElementFields, SubsurfaceState, SurfaceLoad};

fn material(young_modulus: f64, poisson_ratio: f64) -> Material {
    Material::new(young_modulus, poisson_ratio).unwrap()
}

/// Bodies with their layers' correction as a function of the radius, and with a layer too thin for that.
fn bodies() -> [Foundation; 4] {
    let [hard, base] = [material(5.0, 0.25), material(1.0, 0.4)];
    let layer = Layer::new(4.0, hard, Interface::Bonded).unwrap();
    [
        Foundation::half_space(base),
        Foundation::coated(2.3, hard, base).unwrap(),
        Foundation::coated(0.4, hard, base).unwrap(),
        Foundation::new(vec![layer], Base::Rigid).unwrap(),
    ]
}

#[test]
fn means_are_those_of_the_states_at_four_points() {
    for body in bodies() {
        let offsets = 46;
        let means = SurfaceMeans::new(&body, 1.0, offsets).unwrap();
        let fields = ElementFields::new(&body, 1.0, Depth::below(0.0), 80.0).unwrap();
        let mean = |load, [x, y]: [f64; 2]| {
            let third = 1.0 / 3.0;
            let points = [
                [third, third],
                [third, -third],
                [-third, third],
                [-third, -third],
            ];
            let states = points.map(|[i, j]| fields.state(load, [x + i, y + j]));
            let sum = states
                .into_iter()
                .fold(SubsurfaceState::default(), |sum, state| sum + state);
            ALONG_SURFACE.map(|field| sum.field(field) / 4.0)
        };
        for place in [
            [0, 0],
            [1, 0],
            [0, 2],
            [-3, 1],
            [5, -7],
            [20, 3],
            [-28, 28],
            [40, 1],
            [0, -45],
            [45, 45],
        ] {
            let [x, y] = place.map(|along| along as f64);
            let found = means.under_pressure(&[2.0], 1, place);
            let wanted = mean(SurfaceLoad::Pressure, [x, y]).map(|stress| 2.0 * stress);
            let along = [0.6, -0.8];
            let dragged = means.under_traction(&[2.0], 1, place, along);
            let along_x = mean(SurfaceLoad::Traction, [x, y]);
            let along_y = mean(SurfaceLoad::Traction, [y, x]);
            // Largest stresses are of the order of 1.
            for stress in 0..3 {
                let sum =
                    2.0 * (along[0] * along_x[stress] + along[1] * along_y[EXCHANGED[stress]]);
                assert!(
                    (found[stress] - wanted[stress]).abs() < 1e-4,
                    "{place:?} {found:?} {wanted:?}"
                );
                assert!(
                    (dragged[stress] - sum).abs() < 1e-4,
                    "{place:?} {dragged:?} {sum}"
                );
            }
        }
    }
}

/// Under a pressure that varies slowly the means of layers of less than an element are those of four points, too.
#[test]
fn under_a_smooth_pressure_what_depends_on_the_direction_cancels() {
    let body = Foundation::coated(0.6, material(5.0, 0.25), material(1.0, 0.4)).unwrap();
    let size = 17;
    let pressure: Vec<f64> = (0..size * size)
        .map(|e| {
            let [x, y] = [e / size, e % size].map(|i| (i as f64 - 8.0) / 8.5);
            (1.0 - x * x - y * y).max(0.0).powi(2)
        })
        .collect();
    let means = SurfaceMeans::new(&body, 1.0, size).unwrap();
    let fields = ElementFields::new(&body, 1.0, Depth::below(0.0), 40.0).unwrap();
    let loaded: Vec<_> = (0..size * size)
        .map(|e| ([(e / size) as f64, (e % size) as f64], pressure[e]))
        .collect();
    for place in [[8, 8], [3, 9], [5, 5]] {
        let third = 1.0 / 3.0;
        let points = [
            [third, third],
            [third, -third],
            [-third, third],
            [-third, -third],
        ];
        let states = points.map(|[i, j]| {
            let point = [place[0] as f64 + i, place[1] as f64 + j];
            fields.sum_over(&loaded, [0.0; 2], point)
        });
        let sum = states
            .into_iter()
            .fold(SubsurfaceState::default(), |sum, state| sum + state);
        let found = means.under_pressure(&pressure, size, place);
        for (found, field) in found.iter().zip(ALONG_SURFACE) {
            assert!(
                (found - sum.field(field) / 4.0).abs() < 1e-3,
                "{place:?} {found}"
            );
        }
    }
}

/// The error of the surface stress under a traction of cosines, whose exact amplitude on a half-space is 2: `σ_xx = −2
/// sin kx` for q = cos kx along x.
#[test]
fn under_a_traction_the_means_are_second_order_where_centres_are_first_order() {
    let body = Foundation::half_space(material(1.0, 0.3));
    let errors = [16, 32].map(|waves: usize| {
        let size = 4 * waves;
        let k = 2.0 * PI / waves as f64;
        // A bump of width much above a wave, so that the ends do not matter.
        let bump = |x: f64| (PI * x / size as f64).sin().powi(4);
        let pressure: Vec<f64> = (0..size * size)
            .map(|e| {
                let x = (e / size) as f64 + 0.5;
                (1.0 + (k * x).cos()) * bump(x)
            })
            .collect();
        let means = SurfaceMeans::new(&body, 1.0, size).unwrap();
        let fields = ElementFields::new(&body, 1.0, Depth::below(0.0), 2.0 * size as f64).unwrap();
        let place = [
            (size / 2 + waves / 4).cast_signed(),
            (size / 2).cast_signed(),
        ];
        let loaded: Vec<_> = (0..size * size)
            .map(|e| ([(e / size) as f64, (e % size) as f64], pressure[e]))
            .collect();
        let centre = place.map(|along| along as f64);
        let under_centre = fields.sum_over(&loaded, [1.0, 0.0], centre)
            + fields.sum_over(&loaded, [0.0; 2], centre) * -1.0;
        let mean = means.under_traction(&pressure, size, place, [1.0, 0.0]);
        // ∂q/∂x by differences of the samples.
        let slope = (pressure[(place[0].unsigned_abs() + 1) * size]
            - pressure[(place[0].unsigned_abs() - 1) * size])
            / 2.0;
        (under_centre.stress[0] - mean[0]) / slope
    });
    // σ_xx at the centres misses (2 ln 2/π) h ∂q/∂x, but for the next order.
    for (error, waves) in errors.iter().zip([16.0, 32.0]) {
        assert!(
            (error + 2.0 * 2.0_f64.ln() / PI).abs() < 0.7 / waves,
            "{errors:?}"
        );
    }
}
