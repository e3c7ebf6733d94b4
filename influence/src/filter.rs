//! Multiplication of a field's Fourier series, for preconditioners.

mod aliases;
mod periodic;
mod symbol;

pub use periodic::PeriodicFilter;
pub use symbol::PeriodicSymbol;
