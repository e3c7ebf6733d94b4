//! `[surface]` of kind `cylinders`, `dimples` or `grooves`: equal features in a pattern.

use pellicle_texture::{
    CylinderSpec, Cylinders, Dimples, GrooveProfile, GrooveSpec, Grooves, Lattice, Pattern,
    RecessShape, Recesses, TextureError,
};
use serde::Serialize;

use super::of_the_surface;
use crate::case::spring_law::LawCase;
use crate::declare::macros::{one_of, record};
use crate::declare::{Codec, Scope, angle, length, number, pair, part, pressure, word};
use crate::input::diagnosis::Diagnosis;
use crate::input::table_reader::TableReader;

record! {
    /// Periodic elastic cylinders.
    #[derive(Copy)]
    pub struct CylindersCase {
        radius: f64 = length().positive(), "radius of a cylinder";
        height: f64 = length().positive(), "height of a cylinder";
        edge_radius: f64 = length().not_negative().or(0.0, "0"),
            "radius of the arc at the edge of a top; 0 for a sharp edge, whose pressure grows with the grid";
        #[serde(flatten)] spacing: SpacingCase = part(), "distance of the cylinders";
        lattice: LatticeCase = word(LATTICES).or(LatticeCase::Square, "\"square\""), "arrangement of the axes";
        offset: [f64; 2] = pair(length(), "a list of two lengths, [x, y]").or([0.0, 0.0], "[0, 0]"),
            "position of one axis relative to the indenter's";
        rotation: f64 = angle().or(0.0, "0"), "angle of the pattern about this axis, from +x towards +y";
        young_modulus: f64 = pressure().positive().or_else(of_the_surface, "that of the body's top"),
            "Young's modulus of the cylinders";
        law: LawCase = word(LawCase::WORDS).or(LawCase::Linear, "\"linear\""), "law of the springs";
    }
    check |cylinders: &CylindersCase, table: &TableReader<'_>, _: &Scope<'_>| {
        check_lattice(&cylinders.spacing, cylinders.lattice, table)?;
        cylinders.build().map_or_else(|error| refused(table, &error), |_| Ok(()))
    };
}

record! {
    /// Dimples: spherical caps below the plane.
    #[derive(Copy)]
    pub struct DimplesCase {
        radius: f64 = length().positive(), "radius of the rim in the plane";
        depth: f64 = length().positive(), "depth below the plane, at most the radius of the rim";
        edge_radius: f64 = length().not_negative().or(0.0, "0"),
            "radius of the arc that rounds the rim, outside it; 0 for a sharp rim, whose pressure grows with the grid";
        #[serde(flatten)] spacing: SpacingCase = part(), "distance of the dimples";
        lattice: LatticeCase = word(LATTICES).or(LatticeCase::Square, "\"square\""), "arrangement of the axes";
        offset: [f64; 2] = pair(length(), "a list of two lengths, [x, y]").or([0.0, 0.0], "[0, 0]"),
            "position of one dimple's axis relative to the indenter's";
        rotation: f64 = angle().or(0.0, "0"), "angle of the pattern about this axis, from +x towards +y";
        #[serde(skip_serializing_if = "Option::is_none")]
        young_modulus: Option<f64> = pressure().positive().optional("no springs: the body's own surface"),
            "Young's modulus of springs, each as long as the height above the deepest point";
        law: LawCase = word(LawCase::WORDS).or(LawCase::Linear, "\"linear\""), "law of the springs, if there are any";
    }
    check |dimples: &DimplesCase, table: &TableReader<'_>, _: &Scope<'_>| {
        check_law(dimples.law, table)?;
        check_lattice(&dimples.spacing, dimples.lattice, table)?;
        dimples.build().map_or_else(|error| refused(table, &error), |_| Ok(()))
    };
}

record! {
    /// Grooves: straight channels below the plane.
    #[derive(Copy)]
    pub struct GroovesCase {
        width: f64 = length().positive(), "width of a groove in the plane";
        depth: f64 = length().positive(), "depth below the plane";
        profile: GrooveProfileCase = word(PROFILES).or(GrooveProfileCase::Rectangular, "\"rectangular\""),
            "cross-section of a groove: vertical walls and a flat floor, two planes, or one wave";
        edge_radius: f64 = length().not_negative().or(0.0, "0"),
            "radius of the arcs that round the edges, outside vertical walls; 0 for sharp edges, whose pressure grows with the grid";
        #[serde(flatten)] spacing: SpacingCase = part(), "distance of the grooves";
        offset: [f64; 2] = pair(length(), "a list of two lengths, [x, y]").or([0.0, 0.0], "[0, 0]"),
            "a point on the middle of one groove, relative to the indenter's axis";
        rotation: f64 = angle().or(0.0, "0"),
            "angle of the pattern about this point, from +x towards +y; at 0 the grooves run along y, one after the other along x";
        #[serde(skip_serializing_if = "Option::is_none")]
        young_modulus: Option<f64> = pressure().positive().optional("no springs: the body's own surface"),
            "Young's modulus of springs, each as long as the height above the deepest point";
        law: LawCase = word(LawCase::WORDS).or(LawCase::Linear, "\"linear\""), "law of the springs, if there are any";
    }
    check |grooves: &GroovesCase, table: &TableReader<'_>, _: &Scope<'_>| {
        check_law(grooves.law, table)?;
        grooves.build().map_or_else(|error| refused(table, &error), |_| Ok(()))
    };
}

one_of! {
    /// The spacing of a pattern.
    #[derive(Copy)]
    pub enum SpacingCase, "exactly one of period and area_fraction", Some(HELP);
    period: Period(f64) = length().positive(), "distance between neighbours";
    area_fraction: AreaFraction(f64) = number(FRACTION).checked(|value, found, _| {
        if found > 0.0 && found < 1.0 { Ok(found) } else { Err(value.wanted(FRACTION)) }
    }), "part of the plane that the features cover, their edges taken as sharp; the period follows";
}

const FRACTION: &str = "a number between 0 and 1, both excluded";

/// The hint if one comes from the file and the other from the command line or a study.
const HELP: &str = "the period follows from the area fraction: to replace one by the other, replace the whole table";

/// The lattice of a pattern of round features.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum LatticeCase {
    /// Four neighbours each.
    Square,
    /// Six neighbours each.
    Hexagonal,
}

const LATTICES: &[(&str, LatticeCase)] = &[
    ("square", LatticeCase::Square),
    ("hexagonal", LatticeCase::Hexagonal),
];

/// The cross-section of grooves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum GrooveProfileCase {
    /// Vertical walls and a flat floor.
    Rectangular,
    /// Two planes.
    V,
    /// One wave.
    Sine,
}

const PROFILES: &[(&str, GrooveProfileCase)] = &[
    ("rectangular", GrooveProfileCase::Rectangular),
    ("v", GrooveProfileCase::V),
    ("sine", GrooveProfileCase::Sine),
];

impl LatticeCase {
    fn lattice(self) -> Lattice {
        match self {
            Self::Square => Lattice::Square,
            Self::Hexagonal => Lattice::Hexagonal,
        }
    }
}

impl SpacingCase {
    /// The period (m) of round features of this radius (m) on a lattice.
    fn on(self, lattice: Lattice, radius: f64) -> f64 {
        match self {
            Self::Period(period) => period,
            Self::AreaFraction(fraction) => lattice.period_of(radius, fraction),
        }
    }
}

impl CylindersCase {
    /// Distance between neighbouring axes, m.
    #[must_use]
    pub fn period(&self) -> f64 {
        self.spacing.on(self.lattice.lattice(), self.radius)
    }

    pub(super) fn build(&self) -> Result<Cylinders, TextureError> {
        let cylinders = Cylinders::new(CylinderSpec {
            lattice: self.lattice.lattice(),
            radius: self.radius,
            height: self.height,
            period: self.period(),
            offset: self.offset,
            young_modulus: self.young_modulus,
        })?;
        let cylinders = cylinders.rounded(self.edge_radius)?.turned(self.rotation)?;
        Ok(match self.law {
            LawCase::Linear => cylinders,
            LawCase::Logarithmic => cylinders.stiffening(),
        })
    }
}

impl DimplesCase {
    /// Distance between neighbouring axes, m.
    #[must_use]
    pub fn period(&self) -> f64 {
        self.spacing.on(self.lattice.lattice(), self.radius)
    }

    pub(super) fn build(&self) -> Result<Recesses, TextureError> {
        let pattern = Pattern::new(self.lattice.lattice(), self.period(), self.offset)?;
        let pattern = pattern.turned(self.rotation)?;
        let dimples = Dimples::new(pattern, self.radius, self.depth, self.edge_radius)?;
        recesses(RecessShape::Dimples(dimples), self.young_modulus, self.law)
    }
}

impl GroovesCase {
    /// Distance between the middles of neighbouring grooves, m.
    #[must_use]
    pub fn period(&self) -> f64 {
        match self.spacing {
            SpacingCase::Period(period) => period,
            SpacingCase::AreaFraction(fraction) => self.width / fraction,
        }
    }

    pub(super) fn build(&self) -> Result<Recesses, TextureError> {
        let grooves = Grooves::new(GrooveSpec {
            profile: match self.profile {
                GrooveProfileCase::Rectangular => GrooveProfile::Rectangular,
                GrooveProfileCase::V => GrooveProfile::V,
                GrooveProfileCase::Sine => GrooveProfile::Sine,
            },
            width: self.width,
            depth: self.depth,
            period: self.period(),
            offset: self.offset,
            rotation: self.rotation,
            edge_radius: self.edge_radius,
        })?;
        recesses(RecessShape::Grooves(grooves), self.young_modulus, self.law)
    }
}

/// Recesses in the body's own surface, or between springs of this modulus (Pa) and law.
fn recesses(
    shape: RecessShape,
    young_modulus: Option<f64>,
    law: LawCase,
) -> Result<Recesses, TextureError> {
    let recesses = Recesses::from(shape);
    let Some(modulus) = young_modulus else {
        return Ok(recesses);
    };
    let recesses = recesses.with_springs(modulus)?;
    Ok(match law {
        LawCase::Linear => recesses,
        LawCase::Logarithmic => recesses.stiffening(),
    })
}

/// Refuses a law of springs that are not there.
fn check_law(law: LawCase, table: &TableReader<'_>) -> Result<(), Diagnosis> {
    match table.optional(LawCase::KEY) {
        Some(value) if law == LawCase::Logarithmic && table.optional("young_modulus").is_none() => {
            Err(value.wanted("\"linear\", or a young_modulus, with which there are springs"))
        }
        _ => Ok(()),
    }
}

/// Refuses an area fraction at which the circles of a lattice would overlap.
fn check_lattice(
    spacing: &SpacingCase,
    lattice: LatticeCase,
    table: &TableReader<'_>,
) -> Result<(), Diagnosis> {
    let largest = lattice.lattice().largest_area_fraction();
    match spacing {
        SpacingCase::AreaFraction(fraction) if *fraction > largest => {
            let value = table.required("area_fraction", "")?;
            Err(value.wanted(format!(
                "at most {largest:.4}, at which circles on this lattice touch"
            )))
        }
        _ => Ok(()),
    }
}

/// The diagnosis that a pattern is impossible, at the key that makes it so.
fn refused(table: &TableReader<'_>, error: &TextureError) -> Result<(), Diagnosis> {
    let key = match error {
        TextureError::EdgeRadius { .. } | TextureError::RoundedOverlap { .. } => "edge_radius",
        TextureError::DeepDimple { .. } => "depth",
        TextureError::WideGroove { .. } => "width",
        // Every number is in range, so only circles that overlap are left.
        _ => "radius",
    };
    Err(table.required(key, "")?.refused(error))
}

impl From<Cylinders> for CylindersCase {
    fn from(of: Cylinders) -> Self {
        Self {
            radius: of.radius(),
            height: of.height(),
            edge_radius: of.edge_radius(),
            spacing: SpacingCase::Period(of.period()),
            lattice: match of.lattice() {
                Lattice::Square => LatticeCase::Square,
                Lattice::Hexagonal => LatticeCase::Hexagonal,
            },
            offset: of.offset(),
            rotation: of.pattern().rotation(),
            young_modulus: of.young_modulus(),
            law: of.spring_law().into(),
        }
    }
}
