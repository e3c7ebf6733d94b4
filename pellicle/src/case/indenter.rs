//! `[indenter]`: the body pressed into the surface.

use std::f64::consts::FRAC_PI_2;

use pellicle_contact::{
    Cone, FlatPunch, Indenter, IndenterError, IndenterMap, Paraboloid, Pyramid, Sphere,
};
use pellicle_kernel::{KernelError, Material};
use serde::Serialize;

use super::caller_shape::{self, CallerShape};
use super::foundation::substrate::POISSON_RATIO;
use super::height_limits::HeightLimits;
use super::map::MapCase;
use super::map_sources::MapSources;
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
    /// Its material; none if it is rigid.
    #[serde(flatten)]
    pub material: Option<ElasticConstants>,
}

/// The elastic constants of an indenter.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ElasticConstants {
    /// Young's modulus `E_i`, Pa.
    pub young_modulus: f64,
    /// Poisson's ratio `ν_i`.
    pub poisson_ratio: f64,
}

/// The keys of [`ElasticConstants`].
const ELASTIC: [&str; 2] = ["young_modulus", "poisson_ratio"];

impl IndenterCase {
    /// Reads the table and the map that it names.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first key that is invalid for its kind.
    pub fn read(table: &TableReader<'_>, maps: &MapSources) -> Result<Self, Diagnosis> {
        Ok(Self {
            shape: IndenterShape::read(table, maps)?,
            material: ElasticConstants::read(table)?,
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

    /// The material, if it is elastic.
    ///
    /// # Errors
    ///
    /// [`KernelError`] if a value is invalid.
    pub fn build_material(&self) -> Result<Option<Material>, KernelError> {
        let build = |of: ElasticConstants| Material::new(of.young_modulus, of.poisson_ratio);
        self.material.map(build).transpose()
    }

    /// The measured map, if the indenter is given by one.
    #[must_use]
    pub fn map(&self) -> Option<&MapCase> {
        self.shape.map()
    }

    /// Mutable access to [`Self::map`].
    pub fn map_mut(&mut self) -> Option<&mut MapCase> {
        match &mut self.shape {
            IndenterShape::Map(map) => Some(map),
            _ => None,
        }
    }
}

impl ElasticConstants {
    /// Reads both constants or neither.
    fn read(table: &TableReader<'_>) -> Result<Option<Self>, Diagnosis> {
        if table.given(&ELASTIC).is_empty() {
            return Ok(None);
        }
        let ratio = table.required("poisson_ratio", POISSON_RATIO)?;
        let constants = Self {
            young_modulus: table.positive("young_modulus", Dimension::Pressure)?,
            poisson_ratio: ratio.number(POISSON_RATIO)?,
        };
        // The modulus is known to be positive here, so only the ratio can be rejected.
        Material::new(constants.young_modulus, constants.poisson_ratio)
            .map_err(|error| ratio.refused(&error))?;
        Ok(Some(constants))
    }
}

/// The shape of an indenter.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum IndenterShape {
    /// `f = ρ²/(2R)`.
    Paraboloid {
        /// Radius of curvature `R`, m.
        radius: f64,
    },
    /// A ball.
    Sphere {
        /// Its radius, m.
        radius: f64,
    },
    /// A cone, sharp or with a rounded tip.
    Cone {
        /// Angle between the axis and the side, rad.
        half_angle: f64,
        /// Radius of the tip, m; 0 is sharp.
        tip_radius: f64,
    },
    /// A three-sided pyramid.
    Berkovich(PyramidCase),
    /// A four-sided pyramid.
    Vickers(PyramidCase),
    /// Half a cube on its corner.
    CubeCorner(PyramidCase),
    /// A flat cylinder.
    FlatPunch {
        /// Its radius, m.
        radius: f64,
    },
    /// A measured surface.
    Map(MapCase),
    /// A function defined by the caller.
    Function(CallerShape<Indenter>),
}

/// The dimensions of a pyramid.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PyramidCase {
    /// Radius of the tip, m; 0 is sharp.
    pub tip_radius: f64,
    /// Angle between the axis and a face, rad.
    pub face_angle: f64,
}

#[derive(Clone, Copy)]
enum IndenterKind {
    Paraboloid,
    Sphere,
    Cone,
    Berkovich,
    Vickers,
    CubeCorner,
    FlatPunch,
    Map,
}

const KINDS: [(&str, IndenterKind); 8] = [
    ("paraboloid", IndenterKind::Paraboloid),
    ("sphere", IndenterKind::Sphere),
    ("cone", IndenterKind::Cone),
    ("berkovich", IndenterKind::Berkovich),
    ("vickers", IndenterKind::Vickers),
    ("cube-corner", IndenterKind::CubeCorner),
    ("flat-punch", IndenterKind::FlatPunch),
    ("map", IndenterKind::Map),
];

const WANTED: &str = "\"paraboloid\", \"sphere\", \"cone\", \"berkovich\", \"vickers\", \"cube-corner\", \"flat-punch\" or \"map\"";

impl IndenterShape {
    /// Reads the table and the map that it names.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first key that is invalid for its kind.
    pub fn read(table: &TableReader<'_>, maps: &MapSources) -> Result<Self, Diagnosis> {
        let field = table.required("kind", WANTED)?;
        if let Some(indenter) = caller_shape::of_kind(&field, maps.indenter()) {
            only(table, &["kind"])?;
            return Ok(Self::Function(indenter));
        }
        let indenter = match field.choice(&KINDS)? {
            IndenterKind::Paraboloid => Self::Paraboloid {
                radius: radius(table)?,
            },
            IndenterKind::Sphere => Self::Sphere {
                radius: radius(table)?,
            },
            IndenterKind::FlatPunch => Self::FlatPunch {
                radius: radius(table)?,
            },
            IndenterKind::Cone => read_cone(table)?,
            IndenterKind::Berkovich => {
                Self::Berkovich(PyramidCase::read(table, Pyramid::BERKOVICH_FACE_ANGLE)?)
            }
            IndenterKind::Vickers => {
                Self::Vickers(PyramidCase::read(table, Pyramid::VICKERS_FACE_ANGLE)?)
            }
            IndenterKind::CubeCorner => {
                Self::CubeCorner(PyramidCase::read(table, Pyramid::CUBE_CORNER_FACE_ANGLE)?)
            }
            // A map is checked as it is read.
            IndenterKind::Map => {
                only(table, &MapCase::KEYS)?;
                return MapCase::read(table, maps, HeightLimits::INDENTER).map(Self::Map);
            }
        };
        indenter.build().map_err(|error| field.refused(&error))?;
        Ok(indenter)
    }

    /// The indenter itself.
    ///
    /// # Errors
    ///
    /// [`IndenterError`] if a value is invalid.
    pub fn build(&self) -> Result<Indenter, IndenterError> {
        match self {
            Self::Paraboloid { radius } => Paraboloid::new(*radius).map(Indenter::from),
            Self::Sphere { radius } => Sphere::new(*radius).map(Indenter::from),
            Self::FlatPunch { radius } => FlatPunch::new(*radius).map(Indenter::from),
            Self::Cone {
                half_angle,
                tip_radius,
            } => Cone::new(*half_angle, *tip_radius).map(Indenter::from),
            Self::Berkovich(pyramid) | Self::CubeCorner(pyramid) => pyramid.build(3),
            Self::Vickers(pyramid) => pyramid.build(4),
            Self::Map(map) => Ok(IndenterMap::new(map.heights()).into()),
            Self::Function(indenter) => Ok(indenter.shape.clone()),
        }
    }

    /// The measured map, if the indenter is given by one.
    #[must_use]
    pub fn map(&self) -> Option<&MapCase> {
        match self {
            Self::Map(map) => Some(map),
            _ => None,
        }
    }
}

/// Rejects keys that belong neither to the shape nor to a material.
fn only(table: &TableReader<'_>, keys: &[&str]) -> Result<(), Diagnosis> {
    table.only(&[keys, &ELASTIC].concat())
}

fn radius(table: &TableReader<'_>) -> Result<f64, Diagnosis> {
    only(table, &["kind", "radius"])?;
    table.positive("radius", Dimension::Length)
}

fn read_cone(table: &TableReader<'_>) -> Result<IndenterShape, Diagnosis> {
    only(table, &["kind", "half_angle", "tip_radius"])?;
    Ok(IndenterShape::Cone {
        half_angle: angle(table, "half_angle", None)?,
        tip_radius: tip_radius(table)?,
    })
}

impl PyramidCase {
    fn build(&self, faces: usize) -> Result<Indenter, IndenterError> {
        Pyramid::new(faces, self.face_angle, self.tip_radius).map(Indenter::from)
    }

    fn read(table: &TableReader<'_>, standard: f64) -> Result<Self, Diagnosis> {
        only(table, &["kind", "tip_radius", "face_angle"])?;
        Ok(Self {
            tip_radius: tip_radius(table)?,
            face_angle: angle(table, "face_angle", Some(standard))?,
        })
    }
}

fn tip_radius(table: &TableReader<'_>) -> Result<f64, Diagnosis> {
    let read = |field: ValueReader<'_>| field.quantity(Dimension::Length, Sign::NotNegative);
    table.optional("tip_radius").map_or(Ok(0.0), read)
}

/// Angles from the axis. A needle sharper than the lower limit (0.1 degrees) is far beyond small slopes and cannot be
/// drawn; a cone blunter than the upper limit (10⁻⁴ degrees from flat) is flat.
const ANGLES: std::ops::RangeInclusive<f64> = 1.745e-3..=FRAC_PI_2 - 1.745e-6;

/// Reads an angle from the axis, between 0 and 90 degrees.
fn angle(table: &TableReader<'_>, key: &str, default: Option<f64>) -> Result<f64, Diagnosis> {
    const WANTED: &str = "an angle from the axis between 0 and 90 degrees (0.1 to 89.9999), such as \"65.03 deg\", or a bare number in radians";
    let field = match (table.optional(key), default) {
        (Some(field), _) => field,
        (None, Some(default)) => return Ok(default),
        (None, None) => return Err(table.missing(key, WANTED.into())),
    };
    let angle = field.quantity(Dimension::Angle, Sign::Any)?;
    if ANGLES.contains(&angle) {
        return Ok(angle);
    }
    Err(field.wanted(WANTED))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::table_reader::tests::read_table;

    fn read(text: &str) -> Result<IndenterShape, String> {
        let read = |table: TableReader<'_>| IndenterCase::read(&table, &MapSources::default());
        read_table(text, read).map(|case| case.shape)
    }

    #[test]
    fn an_elastic_indenter_requires_both_constants() {
        let read = |constants: &str| {
            let text = format!("kind = \"paraboloid\"\nradius = 1\n{constants}");
            read_table(&text, |table| {
                IndenterCase::read(&table, &MapSources::default())
            })
        };
        let diamond = read("young_modulus = \"1141 GPa\"\npoisson_ratio = 0.07").unwrap();
        let expected = Material::new(1141e9, 0.07).unwrap();
        assert_eq!(diamond.build_material(), Ok(Some(expected)));
        assert_eq!(read("").unwrap().build_material(), Ok(None));
        for faulty in [
            "young_modulus = 1",
            "poisson_ratio = 0.3",
            "young_modulus = 0\npoisson_ratio = 0.3",
            "young_modulus = 1\npoisson_ratio = 0.6",
        ] {
            assert!(read(faulty).is_err(), "{faulty}");
        }
    }

    #[test]
    fn pyramids_default_to_the_standard_face_angle_and_a_sharp_tip() {
        let standard = PyramidCase {
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
            Ok(IndenterShape::Cone { half_angle, .. }) => half_angle,
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
            "kind = \"paraboloid\"\nradius = 1\ntip_radius = 1",
            "kind = \"vickers\"\ntip_radius = -1",
            "kind = \"cone\"\nhalf_angle = \"90 deg\"",
            "kind = \"cone\"",
            "kind = \"cone\"\nhalf_angle = 1e-8",
            "kind = \"vickers\"\nface_angle = \"89.99999999 deg\"",
            "kind = \"map\"",
            "kind = \"map\"\nfile = \"a.npy\"\nyoung_modulus = 1",
        ] {
            assert!(read(text).is_err(), "{text}");
        }
    }
}
