//! Compliance of layered elastic foundations in the wavenumber domain.

mod asymptotics;
mod base;
mod error;
mod foundation;
mod interface;
mod layer;
mod material;
mod paper;
mod response;
mod system;
mod wave;

pub use asymptotics::{LongWaves, ShortWaves};
pub use base::Base;
pub use error::KernelError;
pub use foundation::Foundation;
pub use interface::Interface;
pub use layer::Layer;
pub use material::Material;
pub use paper::{TwoLayer, load_transform};
pub use system::TransformedSystem;
