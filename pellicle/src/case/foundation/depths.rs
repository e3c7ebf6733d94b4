//! Depths in the body: the bottoms of the layers, and the planes at a depth, two on an interface.

use pellicle_influence::Depth;
use pellicle_kernel::{Foundation, Side};

use super::FoundationCase;
use super::substrate::SubstrateCase;

/// A plane in the body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyPlane {
    /// Its depth, on one side of an interface.
    pub depth: Depth,
    /// The body to which it belongs, from 0 at the surface: a layer of the case, or the substrate after the last layer.
    pub body: usize,
}

impl BodyPlane {
    /// The side of the interface on which it lies, if it lies on one.
    #[must_use]
    pub fn side(&self) -> &'static str {
        match self.depth.side {
            Side::Above => "above",
            Side::Below => "below",
        }
    }
}

impl FoundationCase {
    /// Relative distance from an interface within which a depth lies on it.
    pub const NEAR: f64 = 1e-12;

    /// Depth of the rigid base, m; infinite if there is none.
    #[must_use]
    pub fn bottom(&self) -> f64 {
        match self.substrate {
            SubstrateCase::Rigid => self.layer.iter().map(|layer| layer.thickness).sum(),
            SubstrateCase::Elastic(_) => f64::INFINITY,
        }
    }

    /// The depths of the layers' bottoms, m, bit-identical to those of the foundation's interfaces.
    #[must_use]
    pub fn bottoms(&self, foundation: &Foundation) -> Vec<f64> {
        let layers = 1..=foundation.layers().len();
        let interfaces: Vec<_> = layers.map(|i| foundation.interface_depth(i)).collect();
        let mut bottom = 0.0;
        let bottoms = self.layer.iter().map(|layer| {
            bottom += layer.thickness;
            let near = interfaces.iter().find(|depth| is_near(bottom, **depth));
            near.copied().unwrap_or(bottom)
        });
        bottoms.collect()
    }

    /// The plane at a depth: two on an interface, one for each side; on a rigid base only the one above.
    #[must_use]
    pub fn planes(&self, foundation: &Foundation, depth: f64) -> Vec<BodyPlane> {
        let bottoms = self.bottoms(foundation);
        let plane = |z, side, body| BodyPlane {
            depth: Depth { z, side },
            body,
        };
        let on = bottoms.iter().position(|bottom| is_near(depth, *bottom));
        match on {
            Some(body) if self.is_rigid_below(body) => {
                vec![plane(bottoms[body], Side::Above, body)]
            }
            Some(body) => vec![
                plane(bottoms[body], Side::Above, body),
                plane(bottoms[body], Side::Below, body + 1),
            ],
            None => {
                let body = bottoms.partition_point(|bottom| *bottom < depth);
                vec![plane(depth, Side::Above, body)]
            }
        }
    }

    /// The planes at several depths.
    #[must_use]
    pub fn planes_at(&self, foundation: &Foundation, depths: &[f64]) -> Vec<BodyPlane> {
        let planes = depths.iter().map(|depth| self.planes(foundation, *depth));
        planes.flatten().collect()
    }

    fn is_rigid_below(&self, layer: usize) -> bool {
        self.substrate == SubstrateCase::Rigid && layer + 1 == self.layer.len()
    }
}

fn is_near(depth: f64, interface: f64) -> bool {
    (depth - interface).abs() <= FoundationCase::NEAR * interface
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::declare::{Record, Scope};
    use crate::input::table_reader::tests::read_table;

    const LAYERS: &str = "[[layer]]\nthickness = 0.1\nyoung_modulus = 2\npoisson_ratio = 0.3\n\
        [[layer]]\nthickness = 0.2\nyoung_modulus = { from = 3, to = 1, profile = \"linear\" }\npoisson_ratio = 0.3\n";

    fn read(substrate: &str) -> FoundationCase {
        let text = format!("substrate = {substrate}\n{LAYERS}");
        read_table(&text, |table| {
            FoundationCase::read(&table, &Scope::default())
        })
        .unwrap()
    }

    /// Sides and bodies of the planes at a depth.
    fn planes(case: &FoundationCase, depth: f64) -> Vec<(&'static str, usize)> {
        let foundation = case.split().unwrap().foundation;
        let planes = case.planes(&foundation, depth).into_iter();
        planes.map(|plane| (plane.side(), plane.body)).collect()
    }

    #[test]
    fn case_interfaces_have_two_sides_and_sublayer_interfaces_one() {
        let case = read("{ young_modulus = 1, poisson_ratio = 0.3 }");
        assert_eq!(planes(&case, 0.0), [("above", 0)]);
        assert_eq!(planes(&case, 0.1), [("above", 0), ("below", 1)]);
        // 0.1 + 0.2 is not 0.3 in binary.
        assert_eq!(planes(&case, 0.3), [("above", 1), ("below", 2)]);
        assert_eq!(planes(&case, 0.31), [("above", 2)]);
        let foundation = case.split().unwrap().foundation;
        assert!(foundation.layers().len() > 3);
        let split = foundation.interface_depth(2);
        assert!(split < 0.3);
        assert_eq!(planes(&case, split), [("above", 1)]);
        assert_eq!(case.body_names(), ["layer[0]", "layer[1]", "substrate"]);
        let [above, below] = case.planes(&foundation, 0.3)[..] else {
            panic!("two planes")
        };
        let lowest = foundation.interface_depth(foundation.layers().len());
        assert_eq!([above.depth.z, below.depth.z], [lowest; 2]);
    }

    #[test]
    fn there_is_no_plane_below_the_top_of_a_rigid_base() {
        let case = read("\"rigid\"");
        assert_eq!(planes(&case, 0.3), [("above", 1)]);
        assert_eq!(case.body_names(), ["layer[0]", "layer[1]"]);
    }
}
