//! The numbers of a model, by name.

use pellicle_influence::ElasticParameter;
use pellicle_texture::ReliefParameter;

use crate::IndenterQuantity;

/// One parameter of a [`Model`](crate::Model).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ModelParameter {
    /// A parameter of the foundation, or of an elastic indenter's material.
    Elastic(ElasticParameter),
    /// A parameter of the relief's springs.
    Relief(ReliefParameter),
    /// A parameter of the indenter's shape.
    Indenter(IndenterQuantity),
    /// The work of adhesion, J/m²: of an [`Adhesion`](crate::adhesion::Adhesion) beside a model, which has none itself.
    WorkOfAdhesion,
}
