//! Properties of every solution: symmetries, scales, one state for force and penetration, no memory of the path, a
//! bounded amount of work. And of the program's own judgements: certificate, grid error and warnings appear where they
//! should and nowhere else.

#![expect(
    clippy::unwrap_used,
    reason = "a scene that cannot be built fails its test"
)]

mod certificate;
mod grid_error;
mod load;
mod methods;
mod rough_on_stiff_coatings;
mod scaling;
mod symmetry;
mod textured;
mod warnings;
mod work;
