//! Tests of the compliance of layers and of the fields inside them, against references and laws.

mod agreement;
mod dense;
mod derivative;
mod interior;
mod interior_reference;
mod property;
mod reference;
