//! Amplitudes inside, compared with one dense system of all layers, in the four classical waves of each.
//!
//! In a layer `U = (A + B ζ) e^{−ζ}`, `V = (A + B (ζ + 3 − 4ν)) e^{−ζ}` from its top and the mirror image from its
//! bottom; the equations are the original conditions on the surface and at the interfaces.

#![allow(
    clippy::unwrap_used,
    reason = "helpers of tests are tests too; a failed unwrap is a failed test"
)]

use nalgebra::{DMatrix, DVector, Matrix4, Vector4};
use pellicle_kernel::{Base, Foundation, InPlane, Interface, Layer, Material, Side};

/// A body of the stack: its waves as displacements (m) and tractions (Pa).
struct Body {
    material: Material,
    thickness: f64,
    wavenumber: f64,
}

impl Body {
    /// The states `(u_x, u_z, σ_xz, σ_zz)` of the four waves at a depth below its top, as columns; the last two
    /// vanish in a half-space.
    fn states(&self, depth: f64) -> Matrix4<f64> {
        let nu = self.material.poisson_ratio();
        let unit = 2.0 * self.material.shear_modulus() * self.wavenumber;
        let wave = |zeta: f64, [a, b]: [f64; 2]| {
            let decay = (-zeta).exp();
            Vector4::new(
                (a + b * zeta) * decay,
                (a + b * (zeta + 3.0 - 4.0 * nu)) * decay,
                -unit * (a + b * (zeta + 1.0 - 2.0 * nu)) * decay,
                -unit * (a + b * (zeta + 2.0 - 2.0 * nu)) * decay,
            )
        };
        let mirrored = |state: Vector4<f64>| Vector4::new(state[0], -state[1], -state[2], state[3]);
        let down = self.wavenumber * depth;
        let up = [[1.0, 0.0], [0.0, 1.0]].map(|wave_of| {
            if self.thickness.is_finite() {
                mirrored(wave(self.wavenumber * (self.thickness - depth), wave_of))
            } else {
                Vector4::zeros()
            }
        });
        Matrix4::from_columns(&[wave(down, [1.0, 0.0]), wave(down, [0.0, 1.0]), up[0], up[1]])
    }
}

fn bodies(foundation: &Foundation, wavenumber: f64) -> Vec<Body> {
    let body = |material, thickness| Body {
        material,
        thickness,
        wavenumber,
    };
    let layers = foundation.layers().iter();
    let mut bodies: Vec<_> = layers.map(|l| body(l.material(), l.thickness())).collect();
    if let Base::HalfSpace(material) = foundation.base() {
        bodies.push(body(material, f64::INFINITY));
    }
    bodies
}

/// The wave amplitudes of all bodies under tractions `(σ_xz, σ_zz)` on the surface.
fn solve(foundation: &Foundation, bodies: &[Body], tractions: [f64; 2]) -> DVector<f64> {
    let layers = foundation.layers();
    let size = 4 * layers.len() + if bodies.len() > layers.len() { 2 } else { 0 };
    let mut matrix = DMatrix::zeros(size, size);
    let mut load = DVector::zeros(size);
    let columns = |i: usize| 4 * i..(4 * i + 4).min(size);
    for (row, traction) in tractions.iter().enumerate() {
        for column in columns(0) {
            matrix[(row, column)] = bodies[0].states(0.0)[(2 + row, column)];
        }
        load[row] = *traction;
    }
    let mut row = 2;
    for (i, layer) in layers.iter().enumerate() {
        let above = bodies[i].states(layer.thickness());
        let below = bodies.get(i + 1).map(|body| body.states(0.0));
        let rows = conditions(layer.interface(), below.is_none());
        for [on_above, on_below] in rows {
            let coefficients = [(i, Some(above), on_above), (i + 1, below, on_below)];
            for (body, states, condition) in coefficients {
                let Some(states) = states else { continue };
                for (local, column) in columns(body).enumerate() {
                    matrix[(row, column)] = condition.dot(&states.column(local));
                }
            }
            row += 1;
        }
    }
    assert_eq!(row, size);
    equilibrated(matrix, load)
}

/// Solves with full pivoting after rows and columns are scaled to 1.
fn equilibrated(mut matrix: DMatrix<f64>, mut load: DVector<f64>) -> DVector<f64> {
    let scales: Vec<f64> = matrix
        .column_iter()
        .map(|column| 1.0 / column.amax())
        .collect();
    for (mut column, scale) in matrix.column_iter_mut().zip(&scales) {
        column *= *scale;
    }
    for (mut row, value) in matrix.row_iter_mut().zip(load.iter_mut()) {
        let scale = 1.0 / row.amax();
        row *= scale;
        *value *= scale;
    }
    let factors = matrix.clone().full_piv_lu();
    let mut solution = factors.solve(&load).unwrap();
    solution += factors.solve(&(&load - &matrix * &solution)).unwrap();
    solution.component_mul(&DVector::from_vec(scales))
}

/// The conditions at an interface, as products with the states above and below; their sum is zero.
fn conditions(interface: Interface, is_rigid_below: bool) -> Vec<[Vector4<f64>; 2]> {
    let axis = |i: usize, x: f64| {
        let mut axis = Vector4::zeros();
        axis[i] = x;
        axis
    };
    let (normal, shear) = (interface.normal_compliance(), interface.shear_compliance());
    let mut rows = vec![[axis(1, 1.0) + axis(3, normal), axis(1, -1.0)]];
    if interface.is_frictionless() {
        rows.push([axis(2, 1.0), Vector4::zeros()]);
        rows.push([Vector4::zeros(), axis(2, 1.0)]);
    } else {
        rows.push([axis(0, 1.0) + axis(2, shear), axis(0, -1.0)]);
        rows.push([axis(2, 1.0), axis(2, -1.0)]);
    }
    rows.push([axis(3, 1.0), axis(3, -1.0)]);
    if is_rigid_below {
        rows.truncate(2);
    }
    rows
}

/// A reproducible sequence of numbers in [0, 1).
struct Sequence(u64);

impl Sequence {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    fn material(&mut self) -> Material {
        let young = 10_f64.powf(self.between(-1.5, 1.5));
        Material::new(young, self.between(0.0, 0.5)).unwrap()
    }

    fn interface(&mut self) -> Interface {
        let normal = if self.next() < 0.5 {
            0.0
        } else {
            10_f64.powf(self.between(-2.0, 2.0))
        };
        let shear = match self.between(0.0, 3.0) {
            ..1.0 => 0.0,
            1.0..2.0 => 10_f64.powf(self.between(-2.0, 2.0)),
            _ => f64::INFINITY,
        };
        Interface::spring(normal, shear).unwrap()
    }

    fn foundation(&mut self) -> Foundation {
        let mut layers = Vec::new();
        while layers.is_empty() || (layers.len() < 4 && self.next() < 0.6) {
            let (thickness, material) = (self.between(0.3, 1.5), self.material());
            layers.push(Layer::new(thickness, material, self.interface()).unwrap());
        }
        let base = if self.next() < 0.3 {
            Base::Rigid
        } else {
            Base::HalfSpace(self.material())
        };
        Foundation::new(layers, base).unwrap()
    }
}

fn state(place: &InPlane) -> Vector4<f64> {
    Vector4::new(
        place.horizontal_displacement,
        place.vertical_displacement,
        place.shear_stress,
        place.normal_stress,
    )
}

#[test]
fn random_stacks_solve_the_dense_system() {
    let mut sequence = Sequence(1);
    for _ in 0..200 {
        let foundation = sequence.foundation();
        let k = 10_f64.powf(sequence.between(-0.5, 0.8));
        let bodies = bodies(&foundation, k);
        let interior = foundation.interior(k).unwrap();
        let loads = [[0.0, -1.0], [-1.0, 0.0]].map(|load| solve(&foundation, &bodies, load));
        for (i, body) in bodies.iter().enumerate() {
            let unit = 2.0 * k * body.material.shear_modulus();
            let size = Vector4::new(unit, unit, 1.0, 1.0);
            for part in [0.0, 0.4, 1.0] {
                let within = part * body.thickness.min(2.0 / k);
                let side = if part > 0.0 { Side::Above } else { Side::Below };
                let place = interior.at(foundation.interface_depth(i) + within, side);
                for (found, amplitudes) in [place.normal, place.shear].iter().zip(&loads) {
                    let columns = body.states(within);
                    let waves = amplitudes.iter().skip(4 * i).take(4);
                    let wanted: Vector4<f64> =
                        waves.enumerate().map(|(j, x)| columns.column(j) * *x).sum();
                    let error = (state(found) - wanted).component_mul(&size).amax();
                    // The errors are those of the dense system, whose waves look alike where k H is 0.1: measured
                    // 1.9e-13.
                    let bound = 1e-12 * wanted.component_mul(&size).amax();
                    assert!(error <= bound, "{error:e} {bound:e} k = {k} {foundation:?}");
                }
            }
        }
    }
}
