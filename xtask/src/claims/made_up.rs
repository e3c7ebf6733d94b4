//! Made-up fields and curves for tests, in which a claim is true or false by construction.

use super::{ContactFields, Curve, Cylinders};

/// Cylinders of radius 1/4 on a lattice of period 1.
pub(super) const CYLINDERS: Cylinders = Cylinders {
    radius: 0.25,
    period: 1.0,
};

/// Elements per side: 32 a period.
const ELEMENTS: usize = 160;
const SIDE: f64 = 5.0;

/// A pressure that is a function of the distance from the axis and from the nearest cylinder's, the latter in radii;
/// under the cone `f = r`.
pub(super) fn pressed(pressure: impl Fn(f64, f64) -> f64) -> ContactFields {
    let mut fields = blank();
    for index in 0..ELEMENTS * ELEMENTS {
        let [radius, relative] = [
            fields.radius(index),
            CYLINDERS.relative_distance(fields.point(index)),
        ];
        fields.pressure[index] = pressure(radius, relative);
        fields.indenter[index] = radius;
    }
    fields
}

/// A displacement that is a function of x.
pub(super) fn displaced(displacement: impl Fn(f64) -> f64) -> ContactFields {
    let mut fields = blank();
    for index in 0..ELEMENTS * ELEMENTS {
        fields.displacement[index] = displacement(fields.point(index)[0]);
    }
    fields
}

fn blank() -> ContactFields {
    let zeros = vec![0.0; ELEMENTS * ELEMENTS];
    let mut fields = ContactFields {
        elements: ELEMENTS,
        side: SIDE,
        pressure: zeros.clone(),
        displacement: zeros.clone(),
        indenter: zeros,
        relief: Vec::new(),
    };
    let stands = |index| CYLINDERS.relative_distance(fields.point(index)) < 1.0;
    fields.relief = (0..ELEMENTS * ELEMENTS).map(stands).collect();
    fields.checked().unwrap()
}

/// `D = scale Q^m` at twenty loads up to 1, with its own gradient; area and largest pressure as some powers.
pub(super) fn power_law(scale: f64, exponent: f64) -> Curve {
    let force: Vec<f64> = (1..=20).map(|i| f64::from(i) / 20.0).collect();
    let of = |law: &dyn Fn(f64) -> f64| force.iter().map(|&q| law(q)).collect();
    let curve = Curve {
        penetration: of(&|q| scale * q.powf(exponent)),
        max_pressure: of(&|q| q.powf(1.0 - exponent)),
        contact_area: of(&|q| q.powf(exponent)),
        gradient: of(&|q| scale * exponent * q.powf(exponent - 1.0)),
        force: force.clone(),
    };
    curve.checked().unwrap()
}

/// The curve of a half-space, `D ~ Q^(2/3)`, with a film whose effect on everything is `1/(2 + 10 Q)`.
pub(super) fn with_fading_film() -> Curve {
    let mut film = power_law(1.0, 2.0 / 3.0);
    for (i, force) in film.force.iter().enumerate() {
        let effect = 0.5 / (1.0 + 5.0 * force);
        film.penetration[i] *= 1.0 + effect;
        film.gradient[i] *= 1.0 + effect;
        film.contact_area[i] *= 1.0 + effect;
        film.max_pressure[i] *= 1.0 - effect;
    }
    film
}
