//! `[surface]`: the relief of springs that the foundation carries.

mod patterns;

use pellicle_texture::{
    CustomRelief, Cylinders, Film, MapCompliance, Relief, ReliefMap, TextureError,
};
use serde::Serialize;

pub use self::patterns::{
    CylindersCase, DimplesCase, GrooveProfileCase, GroovesCase, LatticeCase, SpacingCase,
};
use super::caller_shape::{self, CallerShape};
use super::map::MapCase;
use super::map_sources::MapSources;
use super::spring_law::LawCase;
use crate::declare::macros::{kinds, one_of, record};
use crate::declare::{
    Codec, Kinds, Presence, Scope, Shape, compliance, length, part, pressure, word,
};
use crate::input::diagnosis::{Diagnosis, Fault};
use crate::input::dimension::{Dimension, Sign};
use crate::input::table_reader::TableReader;
use crate::input::value_reader::ValueReader;

kinds! {
    /// The surface of a case; every value is in SI units or the case's own.
    pub enum SurfaceCase default "bare" {
        Bare                     = "bare",      "the body's plane surface";
        Cylinders(CylindersCase) = "cylinders", "periodic elastic cylinders";
        Dimples(DimplesCase)     = "dimples",   "spherical caps below the plane, in a pattern";
        Grooves(GroovesCase)     = "grooves",   "straight channels below the plane, in a pattern";
        Film(FilmCase)           = "film",      "a film that covers everything";
        Map(ReliefMapCase)       = "map",       "a measured relief of springs on the body";
        Rough(MapCase)           = "rough",     "the body's own measured surface";
    }
    outside {
        Function(ReliefFunctionCase), "a relief given by the caller's functions";
    }
}

record! {
    /// A film that covers everything.
    #[derive(Copy)]
    pub struct FilmCase {
        thickness: f64 = length().positive(), "thickness of the film";
        young_modulus: f64 = pressure().positive(), "pressure over strain of the film: E of a brush, E (1 − ν)/((1 + ν)(1 − 2ν)) of a solid film much thinner than the contact";
        law: LawCase = word(LawCase::WORDS).or(LawCase::Linear, "\"linear\""), "law of the springs";
    }
}

record! {
    /// A measured relief and its compliance.
    pub struct ReliefMapCase {
        #[serde(flatten)] compliance: ComplianceCase = part(), "how its springs give";
        law: LawCase = LawOfMap, "law of the springs; those with a compliance have no height and stay linear";
        #[serde(flatten)] map: MapCase = part(), "its heights";
    }
}

/// The law of springs that have a height only if their modulus is given.
#[derive(Debug, Clone, Copy)]
struct LawOfMap;

impl Codec for LawOfMap {
    type Out = LawCase;

    fn shape(&self) -> Shape {
        word(LawCase::WORDS).shape()
    }

    fn wanted(&self) -> String {
        word(LawCase::WORDS).wanted()
    }

    fn read(&self, value: &ValueReader<'_>, scope: &Scope<'_>) -> Result<LawCase, Diagnosis> {
        word(LawCase::WORDS).read(value, scope)
    }

    fn take(
        &self,
        key: &'static str,
        table: &TableReader<'_>,
        scope: &Scope<'_>,
    ) -> Result<LawCase, Diagnosis> {
        let Some(value) = table.optional(key) else {
            return Ok(LawCase::Linear);
        };
        match self.read(&value, scope)? {
            LawCase::Logarithmic if table.optional("compliance").is_some() => {
                Err(value.wanted(NO_HEIGHT))
            }
            law => Ok(law),
        }
    }

    fn presence(&self) -> Presence {
        Presence::Default("\"linear\"".into())
    }
}

one_of! {
    /// The compliance of a measured relief.
    pub enum ComplianceCase, "exactly one of compliance and young_modulus, for the springs of the map; if the body itself is rough, write kind = \"rough\"", None;
    young_modulus: YoungModulus(f64) = pressure().positive(),
        "Young's modulus of the springs, each as long as the height above the deepest sample";
    compliance: Compliance(f64) = compliance().not_negative(),
        "compliance of the springs, the same everywhere; 0 is rigid";
}

/// A relief given by the caller's functions.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ReliefFunctionCase {
    /// The functions.
    #[serde(skip)]
    pub relief: CallerShape<CustomRelief>,
    /// The uniform compliance, m/Pa; none if the compliance is one of the functions.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub compliance: Option<f64>,
}

/// The requirement on a map whose springs stiffen.
const NO_HEIGHT: &str =
    "\"linear\", or young_modulus in place of compliance, with which springs have a height";

/// Young's modulus of the body's top, Pa.
fn of_the_surface(scope: &Scope<'_>) -> Option<f64> {
    scope.foundation?.surface_young_modulus()
}

impl SurfaceCase {
    /// Reads the table and the map that it names; the foundation supplies the modulus of the cylinders if the table
    /// does not.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first key that is invalid for its kind.
    pub fn read(table: &TableReader<'_>, scope: &Scope<'_>) -> Result<Self, Diagnosis> {
        let kind = table.optional("kind");
        let relief = scope.maps.and_then(MapSources::relief);
        if let Some(relief) = kind.and_then(|kind| caller_shape::of_kind(&kind, relief)) {
            return ReliefFunctionCase::read(table, relief).map(Self::Function);
        }
        <Self as Kinds>::read(table, &[], scope)
            .map_err(|diagnosis| springs_need_a_map(table, diagnosis))
    }

    /// Whether it consists of springs, and is not the body's own surface.
    #[must_use]
    pub fn has_springs(&self) -> bool {
        match self {
            Self::Bare | Self::Rough(_) => false,
            Self::Dimples(of) => of.young_modulus.is_some(),
            Self::Grooves(of) => of.young_modulus.is_some(),
            Self::Cylinders(_) | Self::Film(_) | Self::Map(_) | Self::Function(_) => true,
        }
    }

    /// The relief itself.
    ///
    /// # Errors
    ///
    /// [`TextureError`] if the relief is invalid.
    pub fn build(&self) -> Result<Relief, TextureError> {
        match self {
            Self::Bare => Ok(Relief::Bare),
            Self::Cylinders(cylinders) => cylinders.build().map(Relief::Cylinders),
            Self::Dimples(dimples) => dimples.build().map(Relief::Recesses),
            Self::Grooves(grooves) => grooves.build().map(Relief::Recesses),
            Self::Film(film) => film.build().map(Relief::Film),
            Self::Map(map) => map.build().map(Relief::Map),
            Self::Function(function) => function.build().map(Relief::Custom),
            Self::Rough(map) => {
                ReliefMap::new(map.heights(), MapCompliance::Uniform(0.0)).map(Relief::Map)
            }
        }
    }

    /// The measured map, if any.
    #[must_use]
    pub fn map(&self) -> Option<&MapCase> {
        match self {
            Self::Map(map) => Some(&map.map),
            Self::Rough(map) => Some(map),
            _ => None,
        }
    }

    /// Mutable access to [`Self::map`].
    pub fn map_mut(&mut self) -> Option<&mut MapCase> {
        match self {
            Self::Map(map) => Some(&mut map.map),
            Self::Rough(map) => Some(map),
            _ => None,
        }
    }
}

impl ReliefFunctionCase {
    fn read(table: &TableReader<'_>, relief: CallerShape<CustomRelief>) -> Result<Self, Diagnosis> {
        table.only(&["kind", "compliance"])?;
        let read =
            |field: ValueReader<'_>| field.quantity(Dimension::Compliance, Sign::NotNegative);
        let compliance = table.optional("compliance").map(read).transpose()?;
        Ok(Self { relief, compliance })
    }

    fn build(&self) -> Result<CustomRelief, TextureError> {
        let relief = self.relief.shape.clone();
        match self.compliance {
            Some(compliance) => relief.with_uniform_compliance(compliance),
            None => Ok(relief),
        }
    }
}

impl FilmCase {
    fn build(&self) -> Result<Film, TextureError> {
        let film = Film::new(self.thickness, self.young_modulus)?;
        Ok(match self.law {
            LawCase::Linear => film,
            LawCase::Logarithmic => film.stiffening(),
        })
    }
}

impl ReliefMapCase {
    fn build(&self) -> Result<ReliefMap, TextureError> {
        let compliance = match self.compliance {
            ComplianceCase::Compliance(compliance) => MapCompliance::Uniform(compliance),
            ComplianceCase::YoungModulus(modulus) => MapCompliance::YoungModulus(modulus),
        };
        let map = ReliefMap::new(self.map.heights(), compliance)?;
        match self.law {
            LawCase::Linear => Ok(map),
            LawCase::Logarithmic => map.stiffening(),
        }
    }
}

/// Adds to the diagnosis of a rough surface with springs that it has none.
fn springs_need_a_map(table: &TableReader<'_>, diagnosis: Diagnosis) -> Diagnosis {
    const SPRINGS: [&str; 3] = ["compliance", "young_modulus", LawCase::KEY];
    let is_rough = table
        .optional("kind")
        .is_some_and(|kind| kind.text() == Ok("rough"));
    if !is_rough
        || table.given(&SPRINGS).is_empty()
        || !matches!(diagnosis.fault, Fault::Unknown { .. })
    {
        return diagnosis;
    }
    diagnosis.with_help(
        "a rough surface is the body's own and has no springs: springs belong to kind = \"map\"",
    )
}

impl From<Film> for SurfaceCase {
    fn from(film: Film) -> Self {
        Self::Film(FilmCase {
            thickness: film.thickness(),
            young_modulus: film.young_modulus(),
            law: film.spring_law().into(),
        })
    }
}

impl From<Cylinders> for SurfaceCase {
    fn from(of: Cylinders) -> Self {
        Self::Cylinders(of.into())
    }
}

#[cfg(test)]
mod tests;
