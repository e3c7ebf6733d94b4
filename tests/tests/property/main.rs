//! What every solution must have in common: symmetries, scales, one state for force and penetration, no memory of the
//! path, a bounded amount of work; and that the program's own judgements, certificate, grid error and warnings, say
//! what they are meant to and no more.

#![expect(
    clippy::unwrap_used,
    reason = "a scene that cannot be built fails its test"
)]

mod certificate;
mod coverage;
mod grid_error;
mod load;
mod methods;
mod scaling;
mod symmetry;
mod textured;
mod warnings;
mod work;
