//! `[stress]`: asks for the stresses inside the body.

mod depths;

use pellicle_contact::{
    BodyPart, BodyStrengths, InterfacePart, InterfaceStrengths, Sliding, StressModel,
};
use pellicle_kernel::Foundation;
use serde::Serialize;

use super::diagnosis::Diagnosis;
use super::dimension::Dimension;
use super::foundation::FoundationCase;
use super::foundation::depths::BodyPlane;
use super::foundation::strength::{BodyStrengthCase, InterfaceStrengthCase};
use super::foundation::substrate::SubstrateCase;
use super::quantity_list::QuantityList;
use super::spacing::rounded;
use super::table_reader::TableReader;
use super::value_reader::{Sign, ValueReader};

/// The stresses asked for, every value in SI units or the case's own.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct StressCase {
    /// The depths of the planes that are written, m, rising; none if they are to be chosen.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub depths: Option<Vec<f64>>,
    /// Side of the square that is written, m; none for 1.5 contact diameters.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub extent: Option<f64>,
    /// Coefficient of friction `μ` of the indenter that slides.
    pub friction: f64,
    /// Direction of sliding, rad, from +x to +y.
    pub direction: f64,
}

/// More depths are a mistake.
const DEPTHS: QuantityList = QuantityList {
    dimension: Dimension::Length,
    sign: Sign::Any,
    most: 1000,
};

/// No two materials slide with more.
const MOST_FRICTION: f64 = 10.0;

impl StressCase {
    /// Reads the table for a body on a domain of this side, if one is given.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first invalid key.
    pub fn read(
        table: &TableReader<'_>,
        foundation: &FoundationCase,
        side: Option<f64>,
    ) -> Result<Self, Diagnosis> {
        table.only(&["depths", "extent", "friction", "direction"])?;
        let depths = table.optional("depths");
        let extent = table.optional("extent").map(|field| extent(&field, side));
        let direction = table.optional("direction");
        let angle = |field: ValueReader<'_>| field.quantity(Dimension::Angle, Sign::Any);
        Ok(Self {
            depths: depths
                .map(|field| self::depths(&field, foundation))
                .transpose()?,
            extent: extent.transpose()?,
            friction: (table.optional("friction")).map_or(Ok(0.0), |field| friction(&field))?,
            direction: direction.map_or(Ok(0.0), angle)?,
        })
    }
}

impl StressCase {
    /// The sliding asked for.
    #[must_use]
    pub fn sliding(&self) -> Sliding {
        Sliding {
            friction: self.friction,
            direction: self.direction,
        }
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
                    name,
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
        }
    }

    /// The planes on which stresses are written under a contact of this radius (m): those given, or chosen down to two
    /// radii. On an interface there are two.
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
    /// deepest plane given, or to two radii.
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

    /// Side of the square on which they are written, m: as given, or 1.5 contact diameters, at most the domain's.
    #[must_use]
    pub fn side(&self, contact_radius: f64, domain: f64) -> f64 {
        self.extent.unwrap_or(3.0 * contact_radius).min(domain)
    }
}

/// Depth of the rigid base, m, to the bit that of the foundation; infinite where there is none.
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

/// The depths, rising and each once.
fn depths(field: &ValueReader<'_>, foundation: &FoundationCase) -> Result<Vec<f64>, Diagnosis> {
    let bottom = foundation.bottom();
    let mut depths = DEPTHS.read_checked(field, |item, depth| {
        if depth < 0.0 {
            return Err(item.wanted("a depth of zero or more: the surface is at 0"));
        }
        if depth > bottom * (1.0 + FoundationCase::NEAR) {
            let wanted = format!("at most {bottom:e}, the depth of the rigid base");
            return Err(item.wanted(wanted));
        }
        Ok(depth)
    })?;
    depths.sort_unstable_by(f64::total_cmp);
    depths.dedup();
    Ok(depths)
}

fn extent(field: &ValueReader<'_>, side: Option<f64>) -> Result<f64, Diagnosis> {
    let extent = field.quantity(Dimension::Length, Sign::Positive)?;
    match side {
        Some(side) if extent > side => Err(field.wanted(extent_wanted(side))),
        _ => Ok(extent),
    }
}

/// The description of an extent that lies within a domain of this side.
#[must_use]
pub fn extent_wanted(side: f64) -> String {
    format!("at most the side of the domain, {side:e}")
}

fn friction(field: &ValueReader<'_>) -> Result<f64, Diagnosis> {
    let wanted = format!("a coefficient of friction, a number from 0 to {MOST_FRICTION}");
    let friction = field.number(&wanted)?;
    if (0.0..=MOST_FRICTION).contains(&friction) {
        Ok(friction)
    } else {
        Err(field.wanted(wanted))
    }
}

#[cfg(test)]
mod tests {
    use super::super::table_reader::tests::read_table;
    use super::*;

    const LAYER: &str =
        "layer = [{ thickness = 2, young_modulus = 3, poisson_ratio = 0.3 }]\nsubstrate = ";

    fn read_on(substrate: &str, side: Option<f64>, text: &str) -> Result<StressCase, String> {
        let foundation = format!("{LAYER}{substrate}");
        let foundation = read_table(&foundation, |table| FoundationCase::read(&table))?;
        read_table(text, |table| StressCase::read(&table, &foundation, side))
    }

    const HALF_SPACE: &str = "{ young_modulus = 1, poisson_ratio = 0.3 }";

    fn read(text: &str) -> Result<StressCase, String> {
        read_on(HALF_SPACE, None, text)
    }

    #[test]
    fn everything_has_a_default() {
        assert_eq!(read(""), Ok(StressCase::default()));
    }

    const LAYERS: &str = "layer = [\
        { thickness = 0.1, young_modulus = { from = 1, to = 2, profile = \"linear\" }, poisson_ratio = 0.3, \
          tensile_strength = 5, interface_shear_strength = 6 },\
        { thickness = 0.2, young_modulus = 3, poisson_ratio = 0.3, yield_strength = 4, interface_tensile_strength = 7 }]\n";

    fn model(substrate: &str) -> StressModel {
        let foundation = format!("{LAYERS}substrate = {substrate}");
        let case = read_table(&foundation, |table| FoundationCase::read(&table)).unwrap();
        let stress = read("friction = 0.2\ndirection = 1").unwrap();
        stress.model(&case, &case.split().unwrap().foundation)
    }

    #[test]
    fn the_bodies_of_a_model_are_the_layers_of_the_case_and_the_substrate() {
        let of =
            "{ young_modulus = 1, poisson_ratio = 0.3, yield_strength = 8, tensile_strength = 9 }";
        let model = model(of);
        assert_eq!(
            (model.sliding.friction, model.sliding.direction),
            (0.2, 1.0)
        );
        let bodies = model.bodies.iter().map(|body| {
            let strengths = body.strengths;
            let [top, bottom] = [body.top, body.bottom].map(|depth| (depth * 1e9).round() / 1e9);
            (
                &body.name[..],
                top,
                bottom,
                strengths.yield_strength,
                strengths.tensile_strength,
            )
        });
        let wanted = [
            ("layer[0]", 0.0, 0.1, None, Some(5.0)),
            ("layer[1]", 0.1, 0.3, Some(4.0), None),
            ("substrate", 0.3, f64::INFINITY, Some(8.0), Some(9.0)),
        ];
        assert_eq!(bodies.collect::<Vec<_>>(), wanted);
        assert_eq!(model.bodies[0].bottom, model.bodies[1].top);
        let interfaces = model.interfaces.iter().map(|interface| {
            let strengths = interface.strengths;
            (
                interface.index,
                strengths.shear_strength,
                strengths.tensile_strength,
            )
        });
        assert_eq!(
            interfaces.collect::<Vec<_>>(),
            [(0, Some(6.0), None), (1, None, Some(7.0))]
        );
        assert_eq!(model.interfaces[1].depth, model.bodies[2].top);
    }

    #[test]
    fn a_rigid_base_is_no_body_and_its_interface_is_one() {
        let model = model("\"rigid\"");
        assert_eq!((model.bodies.len(), model.interfaces.len()), (2, 2));
        assert_eq!(model.bodies[1].bottom, model.interfaces[1].depth);
    }

    #[test]
    fn planes_are_those_given_or_go_down_to_two_radii_with_both_sides_of_interfaces() {
        let foundation = format!("{LAYERS}substrate = {HALF_SPACE}");
        let case = read_table(&foundation, |table| FoundationCase::read(&table)).unwrap();
        let built = case.split().unwrap().foundation;
        let depths = |text: &str, radius| {
            let planes = read(text).unwrap().planes(&case, &built, radius);
            planes.iter().map(|plane| plane.depth.z).collect::<Vec<_>>()
        };
        assert_eq!(depths("depths = [0, 0.1, 5]", 1.0), [0.0, 0.1, 0.1, 5.0]);
        let chosen = depths("", 1.0);
        assert_eq!((chosen[0], chosen[chosen.len() - 1]), (0.0, 2.0));
        let twice = chosen.windows(2).filter(|pair| pair[0] == pair[1]).count();
        assert_eq!(twice, 2);
    }

    #[test]
    fn the_square_is_as_given_or_as_wide_as_one_and_a_half_contacts_within_the_domain() {
        assert_eq!(read("extent = 2").unwrap().side(1.0, 9.0), 2.0);
        assert_eq!(read("").unwrap().side(1.0, 9.0), 3.0);
        assert_eq!(read("").unwrap().side(4.0, 9.0), 9.0);
    }

    #[test]
    fn depths_are_a_list_or_a_range_and_come_out_rising() {
        let depths = |text: &str| read(text).unwrap().depths.unwrap();
        assert_eq!(depths("depths = [3, 0, 2, 3]"), [0.0, 2.0, 3.0]);
        let range = "depths = { from = 0, to = \"10 um\", count = 3 }";
        assert_eq!(depths(range), [0.0, 5e-6, 1e-5]);
    }

    #[test]
    fn a_direction_is_an_angle_with_its_unit_or_in_radians() {
        let direction = |text: &str| read(text).unwrap().direction;
        assert!((direction("direction = \"90 deg\"") - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
        assert_eq!(direction("direction = -1.5"), -1.5);
    }

    #[test]
    fn what_is_no_stress_is_refused_with_what_is_wanted() {
        for (text, wanted) in [
            (
                "friction = -0.1",
                "key `friction`: found -0.1, wanted a coefficient of friction",
            ),
            ("friction = 10.5", "from 0 to 10"),
            ("friction = \"0.1\"", "from 0 to 10"),
            ("friction = nan", "from 0 to 10"),
            (
                "depths = [1, \"-1 nm\"]",
                "key `depths[1]`: found \"-1 nm\", wanted a depth of zero or more",
            ),
            (
                "depths = { from = -1, to = 2, count = 3 }",
                "key `depths.from`: found -1, wanted a depth",
            ),
            (
                "depths = { from = 0, to = 2, count = 3, spacing = \"log\" }",
                "key `depths.from`",
            ),
            (
                "depths = { from = 0, to = 2, count = 1001 }",
                "from 2 to 1000",
            ),
            ("depths = []", "wanted a list"),
            ("depths = 3", "wanted a list"),
            ("extent = 0", "wanted a positive length"),
            ("direction = \"5 nm\"", "wanted a finite angle"),
            ("frictoin = 1", "one of depths, extent, friction, direction"),
        ] {
            let message = read(text).unwrap_err();
            assert!(message.contains(wanted), "{text}: {message}");
        }
    }

    #[test]
    fn a_depth_inside_a_rigid_base_is_refused_and_its_top_is_not() {
        assert!(read_on("\"rigid\"", None, "depths = [0, 2]").is_ok());
        let message = read_on("\"rigid\"", None, "depths = [0, 2.1]").unwrap_err();
        let wanted = "found 2.1, wanted at most 2e0, the depth of the rigid base";
        assert!(message.contains(wanted), "{message}");
    }

    #[test]
    fn an_extent_beyond_the_domain_is_refused_where_its_side_is_given() {
        assert!(read_on(HALF_SPACE, Some(4.0), "extent = 4").is_ok());
        let message = read_on(HALF_SPACE, Some(4.0), "extent = 5").unwrap_err();
        let wanted = "found 5, wanted at most the side of the domain, 4e0";
        assert!(message.contains(wanted), "{message}");
    }
}
