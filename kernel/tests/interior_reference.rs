//! Amplitudes inside, compared with data of 17 digits (`tests/data/interior.txt`, which names their source).

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "helpers of tests are tests too; a failed unwrap is a failed test"
)]

use pellicle_kernel::{Antiplane, Base, Foundation, InPlane, Interface, Layer, Material, Side};

/// One place in one foundation under waves of one wavenumber.
struct Case {
    line: String,
    foundation: Foundation,
    wavenumber: f64,
    body: usize,
    offset: f64,
    values: Vec<f64>,
}

fn cases(text: &str) -> Vec<Case> {
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    lines.map(case).collect()
}

fn case(line: &str) -> Case {
    let fields: Vec<_> = line.split(' ').collect();
    let &[layers, base, k, body, offset, values] = fields.as_slice() else {
        panic!("{line}")
    };
    let layers: Vec<_> = if layers == "-" {
        vec![]
    } else {
        layers.split(';').map(layer).collect()
    };
    Case {
        line: fields[..5].join(" "),
        foundation: Foundation::new(layers, self::base(base)).unwrap(),
        wavenumber: number(k),
        body: body.parse().unwrap(),
        offset: number(offset),
        values: numbers(values),
    }
}

fn layer(text: &str) -> Layer {
    let &[thickness, young, poisson, normal, shear] = numbers(text).as_slice() else {
        panic!("{text}")
    };
    let material = Material::new(young, poisson).unwrap();
    Layer::new(
        thickness,
        material,
        Interface::spring(normal, shear).unwrap(),
    )
    .unwrap()
}

fn base(text: &str) -> Base {
    if text == "rigid" {
        return Base::Rigid;
    }
    let fields = numbers(text);
    Base::HalfSpace(Material::new(fields[0], fields[1]).unwrap())
}

fn numbers(text: &str) -> Vec<f64> {
    text.split(',').map(number).collect()
}

fn number(text: &str) -> f64 {
    text.parse().unwrap()
}

fn material(case: &Case) -> Material {
    match (
        case.foundation.layers().get(case.body),
        case.foundation.base(),
    ) {
        (Some(layer), _) => layer.material(),
        (None, Base::HalfSpace(material)) => material,
        (None, Base::Rigid) => panic!("nothing moves"),
    }
}

/// The error of a state and its scale.
struct Comparison {
    error: f64,
    size: f64,
}

impl Comparison {
    fn new(found: &[f64], wanted: &[f64]) -> Self {
        let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0_f64, f64::max);
        assert!(found.iter().all(|x| x.is_finite()), "{found:?}");
        let pairs = found.iter().zip(wanted);
        Self {
            error: largest(&mut pairs.map(|(x, y)| (x - y).abs())),
            size: largest(&mut wanted.iter().map(|x| x.abs())),
        }
    }

    fn in_plane(found: &InPlane, wanted: &[f64], unit: f64) -> Self {
        let state = [
            unit * found.horizontal_displacement,
            unit * found.vertical_displacement,
            found.shear_stress,
            found.normal_stress,
        ];
        let [u, v, shear, normal] = [0, 1, 2, 3].map(|i| wanted[i]);
        Self::new(&state, &[unit * u, unit * v, shear, normal])
    }

    fn antiplane(found: &Antiplane, wanted: &[f64], unit: f64) -> Self {
        let state = [unit * found.displacement, found.vertical_shear_stress];
        Self::new(&state, &[unit * wanted[0], wanted[1]])
    }
}

fn all() -> Vec<Case> {
    cases(include_str!("data/interior.txt"))
}

impl Case {
    fn unit(&self) -> f64 {
        2.0 * material(self).shear_modulus() * self.wavenumber
    }

    fn depth(&self) -> f64 {
        self.foundation.interface_depth(self.body) + self.offset
    }
}

#[test]
fn states_are_right_to_the_last_digits_of_their_larger_components() {
    for case in all() {
        let interior = case.foundation.interior(case.wavenumber).unwrap();
        let side = if case.offset > 0.0 {
            Side::Above
        } else {
            Side::Below
        };
        let found = interior.at(case.depth(), side);
        let (unit, wanted) = (case.unit(), &case.values);
        // Measured 1.2e-13 at the worst of 4000 places, plus 2e-15 k z where e^{−kz} has decayed far.
        let relative = 1e-13 + 2e-15 * case.wavenumber * case.depth();
        let comparisons = [
            Comparison::in_plane(&found.normal, &wanted[0..4], unit),
            Comparison::in_plane(&found.shear, &wanted[4..8], unit),
            Comparison::antiplane(&found.antiplane, &wanted[8..10], 0.5 * unit),
        ];
        for Comparison { error, size } in comparisons {
            // Below a frictionless interface a long shear wave leaves very small amplitudes, with an error of a
            // rounding of the load.
            let bound = relative * size + if size < 1e-3 { 1e-16 } else { 0.0 };
            assert!(error <= bound, "{error:e} of {size:e}, {}", case.line);
        }
    }
}

#[test]
fn the_correction_for_the_layers_is_right_to_the_last_digits() {
    for case in all() {
        let [_, _, _, _, _, _, _, _, _, _, ref wanted @ ..] = case.values[..] else {
            panic!("{}", case.line)
        };
        if wanted.is_empty() {
            continue;
        }
        let interior = case.foundation.interior(case.wavenumber).unwrap();
        let found = interior.correction(case.depth()).unwrap();
        let unit = case.unit();
        let comparisons = [
            Comparison::in_plane(&found.normal, &wanted[0..4], unit),
            Comparison::in_plane(&found.shear, &wanted[4..8], unit),
            Comparison::antiplane(&found.antiplane, &wanted[8..10], 0.5 * unit),
        ];
        let s = case.wavenumber * case.foundation.layers()[0].thickness();
        for Comparison { error, size } in comparisons {
            // Measured 1.4e-13; e^{−2s} magnifies the rounding of s by 2s.
            let bound = TOLERANCE * (1.0 + 2.0 * s) * size + f64::MIN_POSITIVE;
            assert!(error <= bound, "{error:e} of {size:e}, {}", case.line);
        }
    }
}

const TOLERANCE: f64 = 3e-13;
