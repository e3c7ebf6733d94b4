//! Stress inside the body: convergence to closed forms, balance of forces, first yield, formulas from the literature.

#![expect(
    clippy::unwrap_used,
    reason = "a body or contact that cannot be computed fails its test"
)]

mod balance;
mod circle;
mod first_yield;
mod hertz;
mod punches;
mod thin_film;
