//! Compliance of layered elastic foundations in the wavenumber domain.

mod base;
mod error;
mod foundation;
mod interface;
mod layer;
mod material;
mod response;

pub use base::Base;
pub use error::KernelError;
pub use foundation::Foundation;
pub use interface::Interface;
pub use layer::Layer;
pub use material::Material;
