//! `[stress]`: requests the stresses inside the body.

mod depths;

use std::sync::Arc;

use pellicle_contact::{
    BodyPart, BodyStrengths, Criterion, InterfacePart, InterfaceStrengths, Sliding, StressModel,
    StressQuantity,
};
use pellicle_kernel::Foundation;

use super::foundation::FoundationCase;
use super::foundation::depths::BodyPlane;
use super::foundation::strength::{BodyStrengthCase, InterfaceStrengthCase};
use super::foundation::substrate::SubstrateCase;
use super::indenter::IndenterCase;
use super::stressed_body::{BODIES, StressedBody};
use crate::declare::codec::Number;
use crate::declare::macros::record;
use crate::declare::{Codec, Record, Scope, angle, fraction, length, list, series, word};
use crate::input::diagnosis::Diagnosis;
use crate::input::spacing::rounded;
use crate::input::span::Source;
use crate::input::table_reader::TableReader;
use crate::input::toml_tree;
use crate::input::value_reader::ValueReader;

record! {
    /// The requested stresses; every value is in SI units or the case's own.
    #[derive(Default)]
    pub struct StressCase {
        #[serde(skip_serializing_if = "StressedBody::is_foundation")]
        body: StressedBody = word(BODIES).or(StressedBody::Foundation, "\"foundation\""),
            "the body inside which stresses are computed; depths of the indenter are measured into it, those of both into the foundation";
        #[serde(skip_serializing_if = "Option::is_none")]
        depths: Option<Vec<f64>> = series(length(), MAX_DEPTHS).each(within_the_body).map(increasing)
            .optional("chosen through layers and base, down to two contact radii"),
            "depths of the planes that are written";
        #[serde(skip_serializing_if = "Option::is_none")]
        extent: Option<f64> = length().positive().checked(within_the_domain)
            .optional("1.5 contact diameters, at most the side of the domain"), "side of the square that is written";
        friction: f64 = friction().or(0.0, "0"),
            "coefficient of friction of a sliding indenter, whose traction does not change the pressure";
        direction: f64 = angle().or(0.0, "0"), "direction of sliding, from +x towards +y";
        #[serde(skip_serializing_if = "Option::is_none")]
        only: Option<Vec<StressQuantity>> = list(word(&StressQuantity::NAMES), some_quantities())
            .checked(enough_for_the_strengths).optional("all"), "quantities whose extremes are wanted";
    }
}

/// More depths than this are a mistake.
const MAX_DEPTHS: usize = 1000;

/// No two materials have a larger coefficient of friction.
const MAX_FRICTION: f64 = 10.0;

impl StressCase {
    /// Reads the table `[stress]` of a text for a body, and the indenter pressed on it if there is one, on a domain of
    /// this side.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first invalid key.
    pub fn parse(
        source: &Arc<Source>,
        (foundation, indenter): (&FoundationCase, Option<&IndenterCase>),
        side: f64,
    ) -> Result<Self, Diagnosis> {
        let root = toml_tree::parse(source)?;
        let table = TableReader::root(&root)?;
        let stress = table.required("stress", "a table [stress]")?;
        let scope = Scope {
            foundation: Some(foundation),
            side: Some(side),
            ..Scope::default()
        };
        Self::read_of(&stress.table()?, indenter, &scope)
    }

    /// Reads the table of a case for the body that it names.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first invalid key, or of a body that does not deform.
    pub fn read_of(
        table: &TableReader<'_>,
        indenter: Option<&IndenterCase>,
        scope: &Scope<'_>,
    ) -> Result<Self, Diagnosis> {
        let Some(foundation) = scope.foundation else {
            return Self::read(table, scope);
        };
        let name = table.optional("body");
        let body = name.as_ref().map(|name| name.choice(BODIES)).transpose()?;
        let body = body.unwrap_or_default();
        for each in body.each() {
            let each = each.of(foundation, indenter);
            if each.is_rigid() {
                let Some(name) = name else {
                    let wanted = "\"indenter\": the foundation is rigid".to_owned();
                    return Err(table.missing("body", wanted));
                };
                let (because, wanted) = match body {
                    StressedBody::Both => ("with a rigid body", "the one that deforms"),
                    _ => ("which is rigid", "a body that deforms"),
                };
                return Err(name.unusable(&because, wanted));
            }
            // Depths and extent are those of the foundation alone.
            if let Some(only) = table.optional("only") {
                let scope = Scope {
                    foundation: Some(&each),
                    ..*scope
                };
                let quantities = list(word(&StressQuantity::NAMES), some_quantities());
                quantities
                    .checked(enough_for_the_strengths)
                    .read(&only, &scope)?;
            }
        }
        let of = body.of(foundation, indenter);
        let scope = Scope {
            foundation: Some(&of),
            ..*scope
        };
        Self::read(table, &scope)
    }

    /// These stresses in one body.
    #[must_use]
    pub fn inside(&self, body: StressedBody) -> Self {
        Self {
            body,
            ..self.clone()
        }
    }

    /// The requested sliding, which drags the indenter the other way than the foundation.
    #[must_use]
    pub fn sliding(&self) -> Sliding {
        let sliding = Sliding {
            friction: self.friction,
            direction: self.direction,
        };
        match self.body {
            StressedBody::Foundation | StressedBody::Both => sliding,
            StressedBody::Indenter => sliding.opposite(),
        }
    }

    /// Whether the extremes of a quantity are wanted.
    #[must_use]
    pub fn wants(&self, quantity: StressQuantity) -> bool {
        let only = self.only.as_ref();
        only.is_none_or(|only| only.contains(&quantity))
    }

    /// Direction of sliding, degrees from +x to +y, to 15 digits.
    #[must_use]
    pub fn direction_degrees(&self) -> f64 {
        rounded(self.direction.to_degrees())
    }

    /// The bodies and interfaces of a case with their strengths, at the depths of its `foundation`.
    #[must_use]
    pub fn model(&self, case: &FoundationCase, foundation: &Foundation) -> StressModel {
        let bottoms = case.bottoms(foundation);
        let tops = std::iter::once(0.0).chain(bottoms.iter().copied());
        let substrate = match case.substrate {
            SubstrateCase::Rigid => None,
            SubstrateCase::Elastic(material) => Some(material.strength),
        };
        let strengths = case.layer.iter().map(|layer| layer.strength);
        let ends = bottoms.iter().copied().chain(Some(f64::INFINITY));
        let bodies = case.body_names().into_iter().zip(tops.zip(ends));
        let bodies = bodies.zip(strengths.chain(substrate));
        let interfaces = case.layer.iter().zip(&bottoms).enumerate();
        StressModel {
            sliding: self.sliding(),
            bodies: bodies
                .map(|((name, (top, bottom)), strength)| BodyPart {
                    name: format!("{}{name}", self.body.prefix()),
                    top,
                    bottom,
                    strengths: strength.into(),
                })
                .collect(),
            interfaces: interfaces
                .map(|(index, (layer, depth))| InterfacePart {
                    index,
                    depth: *depth,
                    strengths: layer.interface_strength.into(),
                })
                .collect(),
            residual: case.residual_stress(foundation),
            only: self.only.clone(),
        }
    }

    /// The planes on which stresses are written under a contact of this radius (m): as given, or chosen down to two
    /// radii. An interface has two.
    #[must_use]
    pub fn planes(
        &self,
        case: &FoundationCase,
        foundation: &Foundation,
        contact_radius: f64,
    ) -> Vec<BodyPlane> {
        match &self.depths {
            Some(depths) => case.planes_at(foundation, depths),
            None => self.drawn_planes(case, foundation, contact_radius),
        }
    }

    /// The planes between which a section under a contact of this radius (m) is drawn: through all bodies down to the
    /// deepest given plane, or to two radii.
    #[must_use]
    pub fn drawn_planes(
        &self,
        case: &FoundationCase,
        foundation: &Foundation,
        contact_radius: f64,
    ) -> Vec<BodyPlane> {
        let given = self
            .depths
            .as_ref()
            .and_then(|depths| depths.last().copied());
        let deepest = given.filter(|depth| *depth > 0.0);
        let deepest = deepest.unwrap_or(2.0 * contact_radius);
        let deepest = deepest.min(foundation_bottom(case, foundation));
        case.planes_at(
            foundation,
            &depths::chosen(&case.bottoms(foundation), deepest),
        )
    }

    /// Side of the square on which stresses are written, m: as given, or 1.5 contact diameters, at most the side of the
    /// domain.
    #[must_use]
    pub fn side(&self, contact_radius: f64, domain: f64) -> f64 {
        self.extent.unwrap_or(3.0 * contact_radius).min(domain)
    }
}

/// Depth of the rigid base, m, bit-identical to that of the foundation; infinite if there is none.
fn foundation_bottom(case: &FoundationCase, foundation: &Foundation) -> f64 {
    match (case.substrate, case.bottoms(foundation).last()) {
        (SubstrateCase::Rigid, Some(bottom)) => *bottom,
        _ => f64::INFINITY,
    }
}

impl From<BodyStrengthCase> for BodyStrengths {
    fn from(case: BodyStrengthCase) -> Self {
        Self {
            yield_strength: case.yield_strength,
            tensile_strength: case.tensile_strength,
        }
    }
}

impl From<InterfaceStrengthCase> for InterfaceStrengths {
    fn from(case: InterfaceStrengthCase) -> Self {
        Self {
            shear_strength: case.interface_shear_strength,
            tensile_strength: case.interface_tensile_strength,
        }
    }
}

/// Refuses a depth above the surface or inside a rigid base.
fn within_the_body(
    item: &ValueReader<'_>,
    depth: f64,
    scope: &Scope<'_>,
) -> Result<f64, Diagnosis> {
    if depth < 0.0 {
        return Err(item.wanted("a depth of zero or more: the surface is at 0"));
    }
    let bottom = scope
        .foundation
        .map_or(f64::INFINITY, FoundationCase::bottom);
    if depth > bottom * (1.0 + FoundationCase::NEAR) {
        let wanted = format!("at most {bottom:e}, the depth of the rigid base");
        return Err(item.wanted(wanted));
    }
    Ok(depth)
}

/// The depths in order, each once.
fn increasing(mut depths: Vec<f64>) -> Vec<f64> {
    depths.sort_unstable_by(f64::total_cmp);
    depths.dedup();
    depths
}

/// Refuses a square larger than the domain, where that is known.
fn within_the_domain(
    value: &ValueReader<'_>,
    extent: f64,
    scope: &Scope<'_>,
) -> Result<f64, Diagnosis> {
    match scope.side {
        Some(side) if extent > side => Err(value.wanted(extent_wanted(side))),
        _ => Ok(extent),
    }
}

/// Describes an extent that lies within a domain of this side.
#[must_use]
pub fn extent_wanted(side: f64) -> String {
    format!("at most the side of the domain, {side:e}")
}

fn friction() -> Number {
    let wanted = format!("a coefficient of friction, a number from 0 to {MAX_FRICTION}");
    fraction(0.0..=MAX_FRICTION, wanted)
}

fn some_quantities() -> String {
    let words = StressQuantity::NAMES.map(|(name, _)| format!("\"{name}\""));
    format!("a list of some of {}", words.join(", "))
}

/// The quantities in the order of results, each once: at least those that the given strengths limit.
#[expect(clippy::needless_pass_by_value, reason = "the signature of a check")]
fn enough_for_the_strengths(
    value: &ValueReader<'_>,
    quantities: Vec<StressQuantity>,
    scope: &Scope<'_>,
) -> Result<Vec<StressQuantity>, Diagnosis> {
    let criteria = scope.foundation.map(FoundationCase::criteria);
    for (name, criterion) in criteria.unwrap_or_default() {
        let quantity = criterion.quantity();
        if !quantities.contains(&quantity) {
            let (quantity, strength) = (quantity.name(), strength(criterion));
            let wanted = format!(
                "\"{quantity}\" among them, which the {strength} of {name} limits, or no such strength"
            );
            return Err(value.wanted(wanted));
        }
    }
    let wanted = StressQuantity::NAMES.into_iter();
    let wanted = wanted.map(|(_, quantity)| quantity);
    Ok(wanted
        .filter(|quantity| quantities.contains(quantity))
        .collect())
}

/// The strength of a criterion, as in a case.
fn strength(criterion: Criterion) -> &'static str {
    match criterion {
        Criterion::Yield => "yield_strength",
        Criterion::Tension => "tensile_strength",
        Criterion::InterfaceShear => "interface_shear_strength",
        Criterion::InterfaceTension => "interface_tensile_strength",
    }
}

#[cfg(test)]
mod tests;
