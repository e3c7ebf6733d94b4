//! The documents of the crate, and cases with measured maps.

mod documents;
mod maps;
mod periodic;
mod two_bodies;
