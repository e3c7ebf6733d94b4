//! `[indenter]`: the body pressed into the surface.

pub mod body;
mod of_shape;

use std::borrow::Cow;
use std::f64::consts::FRAC_PI_2;

use pellicle_contact::{
    Cone, EllipticParaboloid, FlatPunch, Indenter, IndenterError, IndenterMap, Paraboloid, Plane,
    PowerLaw, Pyramid, Sphere,
};
use pellicle_kernel::{Foundation, KernelError};
use serde::Serialize;

use self::body::IndenterBody;
use super::caller_shape::{self, CallerShape};
use super::foundation::FoundationCase;
use super::height_limits::HeightLimits;
use super::map::preparation::is_default;
use super::map::{MapCase, Repetition};
use super::map_sources::MapSources;
use crate::declare::macros::{kinds, one_of, record};
use crate::declare::{
    Codec, Kinds, KindsShape, Scope, Shape, angle, fraction, length, pair, part, word,
};
use crate::input::diagnosis::Diagnosis;
use crate::input::dimension::{Dimension, Sign};
use crate::input::table_reader::TableReader;
use crate::input::value_reader::ValueReader;

/// The indenter of a case; every value is in SI units or the case's own.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct IndenterCase {
    /// Its shape.
    #[serde(flatten)]
    pub shape: IndenterShape,
    /// Its elastic body; none if it is rigid.
    #[serde(flatten)]
    pub body: Option<IndenterBody>,
}

kinds! {
    /// The shape of an indenter.
    pub enum IndenterShape {
        Paraboloid(ParaboloidCase) = "paraboloid",  "a paraboloid, of revolution or with two radii of curvature";
        Sphere(RoundCase)          = "sphere",      "a ball";
        Cone(ConeCase)             = "cone",        "a cone, sharp or with a rounded tip";
        Berkovich(BerkovichCase)   = "berkovich",   "a three-sided pyramid";
        Vickers(VickersCase)       = "vickers",     "a four-sided pyramid";
        CubeCorner(CubeCornerCase) = "cube-corner", "half a cube on its corner";
        Power(PowerCase)           = "power",       "a body of revolution of height r^n/c^(n-1), r from its axis";
        FlatPunch(RoundCase)       = "flat-punch",  "a flat cylinder";
        Flat                       = "flat",        "a plane without end, for rough and textured bodies";
        Map(IndenterMapCase)       = "map",         "a measured surface, whose end is its outline unless it rises to both ends as a ball's scan does";
    }
    outside {
        Function(CallerShape<Indenter>), "a function of the caller";
    }
}

record! {
    /// A shape with one radius.
    #[derive(Copy)]
    pub struct RoundCase {
        radius: f64 = length().positive(), "radius";
    }
}

one_of! {
    /// The curvature of a paraboloid.
    #[derive(Copy)]
    pub enum ParaboloidCase, "exactly one of radius and radii", None;
    radius: Radius(f64) = length().positive(), "radius of curvature of a paraboloid of revolution";
    radii: Radii([f64; 2]) = pair(length().positive(), RADII), "radii of curvature along x and y; the contact is an ellipse";
}

/// What is wanted for two radii.
const RADII: &str = "a list of two positive lengths, [along x, along y]";

record! {
    /// A cone.
    #[derive(Copy)]
    pub struct ConeCase {
        half_angle: f64 = FromAxis, "angle between the axis and the side";
        tip_radius: f64 = length().not_negative().or(0.0, "0, sharp"), "radius of the rounded tip";
    }
}

record! {
    /// A power of the distance from the axis.
    #[derive(Copy)]
    pub struct PowerCase {
        exponent: f64 = fraction(PowerLaw::LEAST_EXPONENT..=PowerLaw::MOST_EXPONENT, "an exponent from 1, a cone, to 50".into()), "n, from 1 to 50; 2 for a paraboloid of radius c/2";
        coefficient: f64 = length().positive(), "c: the height at this distance from the axis is as large; of no effect if n is 1";
    }
}

/// Declares a pyramid by the angle of its faces.
macro_rules! pyramids {
    ($($(#[$meta:meta])* $name:ident, $standard:expr, $words:literal;)+) => {$(
        record! {
            $(#[$meta])*
            #[derive(Copy)]
            pub struct $name {
                tip_radius: f64 = length().not_negative().or(0.0, "0, sharp"), "radius of the rounded tip";
                face_angle: f64 = FromAxis.or($standard, $words), "angle between the axis and a face";
            }
        }
    )+};
}

pyramids! {
    /// A Berkovich pyramid.
    BerkovichCase, Pyramid::BERKOVICH_FACE_ANGLE, "65.27 deg";
    /// A Vickers pyramid.
    VickersCase, Pyramid::VICKERS_FACE_ANGLE, "68 deg";
    /// A cube corner.
    CubeCornerCase, Pyramid::CUBE_CORNER_FACE_ANGLE, "35.26 deg";
}

record! {
    /// A measured surface and its place.
    pub struct IndenterMapCase {
        #[serde(skip_serializing_if = "is_default")] origin: OriginCase = word(ORIGINS).or(OriginCase::Summit, "\"summit\""),
            "what lies on the axis: the lowest point of the map, which touches first, or the middle of the map, as given, as the middle of a surface's map does";
        #[serde(flatten)] map: MapCase = part(), "its heights";
    }
}

/// The point of a measured indenter on the axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub enum OriginCase {
    /// The lowest point.
    #[default]
    #[serde(rename = "summit")]
    Summit,
    /// The middle of the map.
    #[serde(rename = "as given")]
    AsGiven,
}

const ORIGINS: &[(&str, OriginCase)] = &[
    ("summit", OriginCase::Summit),
    ("as given", OriginCase::AsGiven),
];

impl IndenterMapCase {
    fn build(&self) -> IndenterMap {
        match self.origin {
            OriginCase::Summit => IndenterMap::new(self.map.heights()),
            OriginCase::AsGiven => IndenterMap::in_place(self.map.heights()),
        }
    }
}

/// Angles from the axis. A needle sharper than the lower limit (0.1 degrees) is far beyond small slopes and cannot be
/// drawn; a cone blunter than the upper limit (10⁻⁴ degrees from flat) is flat.
const ANGLES: std::ops::RangeInclusive<f64> = 1.745e-3..=FRAC_PI_2 - 1.745e-6;

/// An angle from the axis, between 0 and 90 degrees.
#[derive(Debug, Clone, Copy)]
struct FromAxis;

impl Codec for FromAxis {
    type Out = f64;

    fn shape(&self) -> Shape {
        angle().shape()
    }

    fn wanted(&self) -> String {
        "an angle from the axis between 0 and 90 degrees (0.1 to 89.9999), such as \"65.03 deg\", or a bare number in radians".into()
    }

    fn read(&self, value: &ValueReader<'_>, _: &Scope<'_>) -> Result<f64, Diagnosis> {
        let angle = value.quantity(Dimension::Angle, Sign::Any)?;
        if ANGLES.contains(&angle) {
            return Ok(angle);
        }
        Err(value.wanted(self.wanted()))
    }
}

impl IndenterCase {
    /// Its kinds, each also with the fields of a material.
    #[must_use]
    pub fn shape_of_table() -> KindsShape {
        let mut kinds = <IndenterShape as Kinds>::shape();
        IndenterBody::declare(&mut kinds.shared);
        kinds
    }

    /// Reads the table and the map that it names.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first key that is invalid for its kind.
    pub fn read(table: &TableReader<'_>, scope: &Scope<'_>) -> Result<Self, Diagnosis> {
        Ok(Self {
            shape: IndenterShape::read_shape(table, scope)?,
            body: IndenterBody::read(table, scope)?,
        })
    }

    /// The indenter itself.
    ///
    /// # Errors
    ///
    /// [`IndenterError`] if a value is invalid.
    pub fn build(&self) -> Result<Indenter, IndenterError> {
        self.shape.build()
    }

    /// The elastic body; [rigid](Foundation::rigid) without one.
    ///
    /// # Errors
    ///
    /// [`KernelError`] if a value is invalid.
    pub fn build_body(&self) -> Result<Foundation, KernelError> {
        let body = self.body.as_ref().map(IndenterBody::build);
        Ok(body.transpose()?.unwrap_or_else(Foundation::rigid))
    }

    /// The elastic body as a foundation of the case; none if it is rigid.
    #[must_use]
    pub fn foundation(&self) -> Option<Cow<'_, FoundationCase>> {
        self.body.as_ref().map(IndenterBody::as_foundation)
    }

    /// The measured map, if the indenter is given by one.
    #[must_use]
    pub fn map(&self) -> Option<&MapCase> {
        self.shape.map()
    }

    /// Whether it is a plane without end.
    #[must_use]
    pub fn is_flat(&self) -> bool {
        self.shape == IndenterShape::Flat
    }

    /// How far the map must be continued in a periodic cell.
    #[must_use]
    pub(super) fn repetition(&self) -> Repetition {
        match &self.shape {
            IndenterShape::Map(of) if of.origin == OriginCase::AsGiven => Repetition::InPlace,
            _ => Repetition::Centred,
        }
    }

    /// Mutable access to [`Self::map`].
    pub fn map_mut(&mut self) -> Option<&mut MapCase> {
        match &mut self.shape {
            IndenterShape::Map(of) => Some(&mut of.map),
            _ => None,
        }
    }
}

impl IndenterShape {
    fn read_shape(table: &TableReader<'_>, scope: &Scope<'_>) -> Result<Self, Diagnosis> {
        let elastic = IndenterBody::keys();
        let kind = table.optional("kind");
        let shape = scope.maps.and_then(MapSources::indenter);
        if let Some(shape) = kind
            .as_ref()
            .and_then(|kind| caller_shape::of_kind(kind, shape))
        {
            table.only(&[&["kind"], &elastic[..]].concat())?;
            return Ok(Self::Function(shape));
        }
        let scope = Scope {
            limits: HeightLimits::INDENTER,
            ..*scope
        };
        let shape = <Self as Kinds>::read(table, &elastic, &scope)?;
        // A map is checked as it is read.
        if let (Some(kind), None) = (kind, shape.map()) {
            shape.build().map_err(|error| kind.refused(&error))?;
        }
        Ok(shape)
    }

    /// The indenter itself.
    ///
    /// # Errors
    ///
    /// [`IndenterError`] if a value is invalid.
    pub fn build(&self) -> Result<Indenter, IndenterError> {
        match self {
            Self::Paraboloid(ParaboloidCase::Radius(radius)) => {
                Paraboloid::new(*radius).map(Indenter::from)
            }
            Self::Paraboloid(ParaboloidCase::Radii(radii)) => {
                EllipticParaboloid::new(*radii).map(Indenter::from)
            }
            Self::Sphere(of) => Sphere::new(of.radius).map(Indenter::from),
            Self::FlatPunch(of) => FlatPunch::new(of.radius).map(Indenter::from),
            Self::Cone(cone) => Cone::new(cone.half_angle, cone.tip_radius).map(Indenter::from),
            Self::Power(of) => PowerLaw::new(of.exponent, of.coefficient).map(Indenter::from),
            Self::Berkovich(of) => pyramid(3, of.face_angle, of.tip_radius),
            Self::CubeCorner(of) => pyramid(3, of.face_angle, of.tip_radius),
            Self::Vickers(of) => pyramid(4, of.face_angle, of.tip_radius),
            Self::Flat => Ok(Plane.into()),
            Self::Map(of) => Ok(of.build().into()),
            Self::Function(indenter) => Ok(indenter.shape.clone()),
        }
    }

    /// The measured map, if the indenter is given by one.
    #[must_use]
    pub fn map(&self) -> Option<&MapCase> {
        match self {
            Self::Map(of) => Some(&of.map),
            _ => None,
        }
    }
}

fn pyramid(faces: usize, face_angle: f64, tip_radius: f64) -> Result<Indenter, IndenterError> {
    Pyramid::new(faces, face_angle, tip_radius).map(Indenter::from)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::table_reader::tests::read_table;

    fn read(text: &str) -> Result<IndenterShape, String> {
        let read = |table: TableReader<'_>| IndenterCase::read(&table, &Scope::default());
        read_table(text, read).map(|case| case.shape)
    }

    #[test]
    fn pyramids_default_to_the_standard_face_angle_and_a_sharp_tip() {
        let standard = BerkovichCase {
            tip_radius: 0.0,
            face_angle: Pyramid::BERKOVICH_FACE_ANGLE,
        };
        assert_eq!(
            read("kind = \"berkovich\""),
            Ok(IndenterShape::Berkovich(standard))
        );
    }

    #[test]
    fn angles_may_be_in_degrees_or_radians() {
        let cone = |text: &str| match read(&format!("kind = \"cone\"\nhalf_angle = {text}")) {
            Ok(IndenterShape::Cone(cone)) => cone.half_angle,
            other => panic!("{other:?}"),
        };
        // The factor of a degree has one rounding error.
        assert!((cone("\"60 deg\"") - cone("1.0471975511965976")).abs() < 1e-15);
    }

    #[test]
    fn an_angle_in_degrees_without_unit_is_rejected_with_the_reason() {
        let message = read("kind = \"cone\"\nhalf_angle = 60").unwrap_err();
        assert!(message.contains("a bare number in radians"), "{message}");
    }

    #[test]
    fn invalid_indenters_are_rejected() {
        for text in [
            "",
            "kind = \"paraboloid\"",
            "kind = \"parabola\"\nradius = 1",
            "kind = \"paraboloid\"\nradius = 0",
            "kind = \"paraboloid\"\nradius = 1\nradii = [1, 2]",
            "kind = \"paraboloid\"\nradii = [1, 0]",
            "kind = \"paraboloid\"\nradii = [1, 2, 3]",
            "kind = \"sphere\"\nradii = [1, 2]",
            "kind = \"paraboloid\"\nradius = 1\ntip_radius = 1",
            "kind = \"vickers\"\ntip_radius = -1",
            "kind = \"cone\"\nhalf_angle = \"90 deg\"",
            "kind = \"cone\"",
            "kind = \"power\"\nexponent = 3",
            "kind = \"power\"\nexponent = 0.9\ncoefficient = 1",
            "kind = \"power\"\nexponent = 3\ncoefficient = 0",
            "kind = \"cone\"\nhalf_angle = 1e-8",
            "kind = \"vickers\"\nface_angle = \"89.99999999 deg\"",
            "kind = \"map\"",
            "kind = \"map\"\nfile = \"a.npy\"\nyoung_modulus = 1",
        ] {
            assert!(read(text).is_err(), "{text}");
        }
    }
}
