//! The limits of linear elasticity, and a number of a contact over one of them.

use pellicle_influence::ElasticBody;

/// What a contact cannot exceed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ModelLimit {
    /// A layer cannot be shortened by its whole thickness.
    LayerThickness {
        /// The body that has the layer.
        of: ElasticBody,
        /// Layer, counted from the surface, from 0.
        layer: usize,
    },
    /// A layer cannot be worn deeper than it is thick: it is solved as whole.
    WornLayer {
        /// The body that has the layer, on top.
        of: ElasticBody,
    },
    /// The surface of a body cannot be below the top of its rigid base.
    RigidBase {
        /// The body.
        of: ElasticBody,
    },
    /// An indenter cannot be sunk by more than its own radius where linear elasticity holds.
    IndenterRadius,
    /// A body cannot carry a mean pressure above its Young's modulus.
    Modulus {
        /// The body that has the layer or the base.
        of: ElasticBody,
        /// Layer, counted from the surface, from 0; the number of layers for the base.
        body: usize,
    },
}

/// A number of a contact over its limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LimitRatio {
    /// The limit.
    pub limit: ModelLimit,
    /// The number over the limit; the model cannot hold from 1 on.
    pub ratio: f64,
}

impl LimitRatio {
    /// Whether the model cannot hold.
    #[must_use]
    pub fn is_beyond(&self) -> bool {
        self.ratio >= 1.0
    }
}
