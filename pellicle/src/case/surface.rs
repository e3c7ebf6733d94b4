//! `[surface]`: the relief of springs that the foundation carries.

use pellicle_texture::{
    CustomRelief, CylinderSpec, Cylinders, Film, Lattice, MapCompliance, Relief, ReliefMap,
    TextureError,
};
use serde::Serialize;

use super::caller_shape::{self, CallerShape};
use super::foundation::FoundationCase;
use super::height_limits::HeightLimits;
use super::map::MapCase;
use super::map_sources::MapSources;
use super::spring_law::LawCase;
use crate::input::diagnosis::{Diagnosis, Fault};
use crate::input::dimension::{Dimension, Sign};
use crate::input::table_reader::TableReader;
use crate::input::value_reader::ValueReader;

/// The surface of a case; every value is in SI units or the case's own.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum SurfaceCase {
    /// The foundation's plane surface, without relief.
    Bare,
    /// Periodic elastic cylinders.
    Cylinders(CylindersCase),
    /// A film that covers everything.
    Film {
        /// Thickness, m.
        thickness: f64,
        /// Young's modulus, Pa.
        young_modulus: f64,
        /// The law of its springs.
        law: LawCase,
    },
    /// A measured relief.
    Map(ReliefMapCase),
    /// The elastic body's own measured surface.
    Rough(MapCase),
    /// A relief given by the caller's functions.
    Function(ReliefFunctionCase),
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

/// A measured relief and its compliance.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ReliefMapCase {
    /// Its heights.
    #[serde(flatten)]
    pub map: MapCase,
    /// Its compliance.
    #[serde(flatten)]
    pub compliance: ComplianceCase,
    /// The law of its springs.
    pub law: LawCase,
}

/// The compliance of a measured relief.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ComplianceCase {
    /// `η`, m/Pa, the same everywhere; 0 is rigid.
    Compliance(f64),
    /// Young's modulus, Pa: `η` is the height above the deepest sample divided by it.
    YoungModulus(f64),
}

/// Periodic elastic cylinders.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CylindersCase {
    /// Arrangement of the axes.
    pub lattice: LatticeCase,
    /// Radius `r` of a cylinder, m.
    pub radius: f64,
    /// Height `h` of a cylinder, m.
    pub height: f64,
    /// Distance `T` between neighbouring axes, m.
    pub period: f64,
    /// Position of one axis relative to the indenter's, m.
    pub offset: [f64; 2],
    /// Young's modulus `E_a`, Pa; by default that of the surface.
    pub young_modulus: f64,
    /// The law of their springs.
    pub law: LawCase,
}

/// The lattice of the cylinders.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum LatticeCase {
    /// Four neighbours each.
    Square,
    /// Six neighbours each.
    Hexagonal,
}

/// The requirement on a map whose springs stiffen.
const NO_HEIGHT: &str =
    "\"linear\", or young_modulus in place of compliance, with which springs have a height";

#[derive(Clone, Copy)]
enum SurfaceKind {
    Bare,
    Cylinders,
    Film,
    Map,
    Rough,
}

const KINDS: [(&str, SurfaceKind); 5] = [
    ("bare", SurfaceKind::Bare),
    ("cylinders", SurfaceKind::Cylinders),
    ("film", SurfaceKind::Film),
    ("map", SurfaceKind::Map),
    ("rough", SurfaceKind::Rough),
];

impl SurfaceCase {
    /// Reads the table and the map that it names; the foundation supplies the modulus of the cylinders if the table
    /// does not.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first key that is invalid for its kind.
    pub fn read(
        table: &TableReader<'_>,
        foundation: &FoundationCase,
        maps: &MapSources,
    ) -> Result<Self, Diagnosis> {
        let kind = match table.optional("kind") {
            Some(field) => {
                if let Some(relief) = caller_shape::of_kind(&field, maps.relief()) {
                    return ReliefFunctionCase::read(table, relief).map(Self::Function);
                }
                field.choice(&KINDS)?
            }
            None => SurfaceKind::Bare,
        };
        match kind {
            SurfaceKind::Bare => table.only(&["kind"]).map(|()| Self::Bare),
            SurfaceKind::Cylinders => CylindersCase::read(table, foundation).map(Self::Cylinders),
            SurfaceKind::Film => Self::read_film(table),
            SurfaceKind::Map => ReliefMapCase::read(table, maps).map(Self::Map),
            SurfaceKind::Rough => Self::read_rough(table, maps),
        }
    }

    fn read_film(table: &TableReader<'_>) -> Result<Self, Diagnosis> {
        table.only(&["kind", "thickness", "young_modulus", LawCase::KEY])?;
        Ok(Self::Film {
            thickness: table.positive("thickness", Dimension::Length)?,
            young_modulus: table.positive("young_modulus", Dimension::Pressure)?,
            law: LawCase::read(table)?,
        })
    }

    fn read_rough(table: &TableReader<'_>, maps: &MapSources) -> Result<Self, Diagnosis> {
        table.only(&MapCase::KEYS).map_err(|diagnosis| {
            let springs = table.given(&[&ComplianceCase::KEYS[..], &[LawCase::KEY]].concat());
            if springs.is_empty() {
                return diagnosis;
            }
            diagnosis.with_help("a rough surface is the body's own and has no springs: springs belong to kind = \"map\"")
        })?;
        MapCase::read(table, maps, HeightLimits::SURFACE).map(Self::Rough)
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
            Self::Film {
                thickness,
                young_modulus,
                law,
            } => {
                let film = Film::new(*thickness, *young_modulus)?;
                Ok(Relief::Film(match law {
                    LawCase::Linear => film,
                    LawCase::Logarithmic => film.stiffening(),
                }))
            }
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

impl ReliefMapCase {
    fn read(table: &TableReader<'_>, maps: &MapSources) -> Result<Self, Diagnosis> {
        let keys = [&MapCase::KEYS[..], &ComplianceCase::KEYS, &[LawCase::KEY]].concat();
        table.only(&keys)?;
        let (compliance, law) = (ComplianceCase::read(table)?, LawCase::read(table)?);
        if let (ComplianceCase::Compliance(_), LawCase::Logarithmic) = (compliance, law) {
            return Err(table.required(LawCase::KEY, NO_HEIGHT)?.wanted(NO_HEIGHT));
        }
        Ok(Self {
            compliance,
            law,
            map: MapCase::read(table, maps, HeightLimits::SURFACE)?,
        })
    }

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

impl ComplianceCase {
    const KEYS: [&str; 2] = ["compliance", "young_modulus"];

    fn read(table: &TableReader<'_>) -> Result<Self, Diagnosis> {
        const WANTED: &str = "exactly one of compliance and young_modulus, for the springs of the map; if the body itself is rough, write kind = \"rough\"";
        match table.given(&Self::KEYS)[..] {
            ["compliance"] => table
                .required("compliance", WANTED)?
                .quantity(Dimension::Compliance, Sign::NotNegative)
                .map(Self::Compliance),
            ["young_modulus"] => table
                .positive("young_modulus", Dimension::Pressure)
                .map(Self::YoungModulus),
            [] => Err(table.missing("young_modulus", WANTED.into())),
            _ => Err(table
                .required("compliance", WANTED)?
                .diagnosis(Fault::Wrong {
                    found: "compliance and young_modulus".into(),
                    wanted: WANTED.into(),
                })),
        }
    }
}

impl CylindersCase {
    fn read(table: &TableReader<'_>, foundation: &FoundationCase) -> Result<Self, Diagnosis> {
        const KEYS: [&str; 8] = [
            "kind",
            "radius",
            "height",
            "period",
            "lattice",
            "offset",
            "young_modulus",
            LawCase::KEY,
        ];
        table.only(&KEYS)?;
        let cylinders = Self {
            lattice: lattice(table)?,
            radius: table.positive("radius", Dimension::Length)?,
            height: table.positive("height", Dimension::Length)?,
            period: table.positive("period", Dimension::Length)?,
            offset: offset(table)?,
            young_modulus: young_modulus(table, foundation)?,
            law: LawCase::read(table)?,
        };
        // Every number is in range here, so only an overlap can be rejected.
        let radius = table.required("radius", "")?;
        cylinders.build().map_err(|error| radius.refused(&error))?;
        Ok(cylinders)
    }

    fn build(&self) -> Result<Cylinders, TextureError> {
        let lattice = match self.lattice {
            LatticeCase::Square => Lattice::Square,
            LatticeCase::Hexagonal => Lattice::Hexagonal,
        };
        let cylinders = Cylinders::new(CylinderSpec {
            lattice,
            radius: self.radius,
            height: self.height,
            period: self.period,
            offset: self.offset,
            young_modulus: self.young_modulus,
        })?;
        Ok(match self.law {
            LawCase::Linear => cylinders,
            LawCase::Logarithmic => cylinders.stiffening(),
        })
    }
}

fn lattice(table: &TableReader<'_>) -> Result<LatticeCase, Diagnosis> {
    let choices = [
        ("square", LatticeCase::Square),
        ("hexagonal", LatticeCase::Hexagonal),
    ];
    (table.optional("lattice")).map_or(Ok(LatticeCase::Square), |field| field.choice(&choices))
}

fn offset(table: &TableReader<'_>) -> Result<[f64; 2], Diagnosis> {
    const WANTED: &str = "a list of two lengths, [x, y]";
    let Some(field) = table.optional("offset") else {
        return Ok([0.0, 0.0]);
    };
    let [x, y] = &field.list(WANTED)?[..] else {
        return Err(field.wanted(WANTED));
    };
    let length = |field: &ValueReader<'_>| field.quantity(Dimension::Length, Sign::Any);
    Ok([length(x)?, length(y)?])
}

fn young_modulus(table: &TableReader<'_>, foundation: &FoundationCase) -> Result<f64, Diagnosis> {
    match (
        table.optional("young_modulus"),
        foundation.surface_young_modulus(),
    ) {
        (None, Some(modulus)) => Ok(modulus),
        _ => table.positive("young_modulus", Dimension::Pressure),
    }
}

#[cfg(test)]
mod tests;
