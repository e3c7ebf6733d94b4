//! `[stress]`: asks for the stresses inside the body.

use serde::Serialize;

use super::diagnosis::Diagnosis;
use super::dimension::Dimension;
use super::foundation::FoundationCase;
use super::quantity_list::QuantityList;
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
