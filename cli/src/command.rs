//! The commands, one a file.

pub mod cache;
pub mod check;
pub mod completions;
pub mod gather;
pub mod identify;
pub mod influence;
pub mod init;
pub mod kernel;
pub mod plot;
pub mod run;
pub mod solve;
pub mod stress;
pub mod study;
pub mod surface;
pub mod validate;
