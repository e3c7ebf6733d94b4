//! The program `pellicle`: a case file in, a certified contact solution out.

pub mod case;
pub mod failure;
