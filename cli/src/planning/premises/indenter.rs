//! The indenters of a plan: that of the model, known ones, and those whose radius is sought as its is.

/// The knowledge that a plan has of an indenter's radius.
#[derive(Debug, Clone, PartialEq)]
pub enum IndenterRadius {
    /// It is that of the model.
    OfModel,
    /// It is another one, and known exactly.
    Known(String),
    /// It is another one, and sought as that of the model is: its place among the unknowns, and its name.
    Sought(usize, String),
}

impl IndenterRadius {
    /// The name of its radius, if that is not the key of the model's.
    #[must_use]
    pub fn name(&self) -> Option<String> {
        match self {
            Self::OfModel => None,
            Self::Known(name) | Self::Sought(_, name) => Some(name.clone()),
        }
    }
}
