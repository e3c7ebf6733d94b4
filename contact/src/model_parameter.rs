//! The names of a model's numbers.

use pellicle_influence::ElasticParameter;
use pellicle_texture::ReliefParameter;

use crate::IndenterQuantity;

/// One number of a [`Model`](crate::Model).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ModelParameter {
    /// Of the foundation, or of an elastic indenter's material.
    Elastic(ElasticParameter),
    /// Of the relief's springs.
    Relief(ReliefParameter),
    /// Of the indenter's shape.
    Indenter(IndenterQuantity),
}
