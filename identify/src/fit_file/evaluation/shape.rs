//! The keys of `[evaluation]`.

use pellicle::declare::shape::{Field, Shape, TableShape};
use pellicle::input::dimension::{Dimension, Sign};

use super::area::{self, TIPS};
use super::{DEPTH_ZEROS, DRIFTS};

/// A quantity of any sign.
const fn quantity(dimension: Dimension) -> Shape {
    Shape::Quantity(dimension, Sign::Any)
}

/// The keys of a value with its standard uncertainty.
pub(super) fn uncertain_shape(dimension: Option<Dimension>) -> TableShape {
    let value = || dimension.map_or(Shape::Number, quantity);
    TableShape::of([
        Field::required("mean", "the value", value()),
        Field::required("sd", "its standard uncertainty", value()),
    ])
}

/// A value that may have a standard uncertainty, or one of these words.
fn uncertain(dimension: Option<Dimension>, words: &[&'static str]) -> Shape {
    let value = dimension.map_or(Shape::Number, quantity);
    let table = Shape::Table(uncertain_shape(dimension));
    let words = (!words.is_empty()).then(|| Shape::Words(words.into()));
    Shape::Either(words.into_iter().chain([value, table]).collect())
}

/// The keys of the body with which an indenter is calibrated.
pub(super) fn known_body() -> TableShape {
    let modulus = Shape::Quantity(Dimension::Pressure, Sign::Positive);
    TableShape::of([
        Field::required("young_modulus", "its Young's modulus", modulus),
        Field::optional(
            "coefficients",
            "how many the area function has",
            Shape::Count(1..=area::MOST_COEFFICIENTS),
            "3",
        ),
    ])
}

/// The keys of the material of a tip.
pub(super) fn material() -> TableShape {
    let modulus = uncertain(Some(Dimension::Pressure), &[]);
    let ratio = uncertain(None, &[]);
    TableShape::of([
        Field::required("young_modulus", "its Young's modulus", modulus),
        Field::required("poisson_ratio", "its Poisson's ratio", ratio),
    ])
}

/// The keys of `[evaluation]`.
#[must_use]
pub fn shape() -> TableShape {
    let optional = Field::optional;
    let coefficients = Shape::list(Shape::Either(vec![Shape::Number, Shape::Text]));
    let indenter = Shape::Either(vec![Shape::Words(vec!["rigid"]), Shape::Table(material())]);
    TableShape::of([
        optional(
            "area_function",
            "coefficients such as `[24.5, \"120 nm\"]`, or the file of a calibration",
            Shape::Either(vec![coefficients, Shape::Text]),
            "that of the `tip`",
        ),
        optional("tip", "the ideal shape", Shape::words(&TIPS), "none"),
        optional(
            "tip_radius",
            "the radius of the end of the tip",
            Shape::Quantity(Dimension::Length, Sign::NotNegative),
            "0",
        ),
        optional(
            "angle",
            "the angle between axis and side of a cone",
            Shape::Quantity(Dimension::Angle, Sign::Positive),
            "only of a cone",
        ),
        optional(
            "beta",
            "the factor β of the stiffness",
            uncertain(None, &[]),
            "1",
        ),
        optional(
            "epsilon",
            "the factor ε of the contact depth, or from the exponent",
            uncertain(None, &["exponent"]),
            "0.75",
        ),
        optional(
            "unloading",
            "upper and lower end of the fitted part, over the largest force",
            Shape::List(Box::new(Shape::Number), Some(2)),
            "`[0.95, 0.40]`",
        ),
        optional(
            "frame_compliance",
            "the compliance of the instrument",
            uncertain(Some(Dimension::FrameCompliance), &[]),
            "that of the calibration, or 0",
        ),
        optional(
            "drift",
            "a rate, or where it is found",
            uncertain(Some(Dimension::Speed), &DRIFTS),
            "that of a hold near zero force, if there is one",
        ),
        optional(
            "depth_zero",
            "the depth of the first contact, or where it is found",
            uncertain(Some(Dimension::Length), &DEPTH_ZEROS),
            "the first contact, if the file shows it",
        ),
        Field::required(
            "poisson_ratio",
            "Poisson's ratio of the body",
            uncertain(None, &[]),
        ),
        optional("indenter", "the material of the tip", indenter, "diamond"),
        optional(
            "thinning",
            "part of the contact depth by which an imprint thins the top layer",
            Shape::Number,
            "0",
        ),
        optional(
            "calibrate",
            "seeks the area function, with a body of known modulus",
            Shape::Table(known_body()),
            "no calibration",
        ),
    ])
}
