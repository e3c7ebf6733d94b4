//! Properties of every solution: symmetries, scaling, one state for force and penetration, independence of the path,
//! bounded work. Properties of the program's judgements: certificate, grid error and warnings appear where they should
//! and nowhere else.

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
