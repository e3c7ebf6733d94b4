//! The chores of the workspace, as functions: [`tidy`] checks the house rules on a [`Tree`] of files, [`figures`] draws
//! the paper's figures, [`golden`] compares all values of two builds, [`site`] builds the documents as a site.
//!
//! The binary `xtask` only parses its command line and prints what these functions return, so the test
//! `tests/workspace.rs` checks the real workspace with the same code as `cargo xtask tidy`.

mod arguments;
mod error;
mod figures;
mod golden;
mod links;
mod site;
mod tidy;
mod tree;

pub use arguments::{Arguments, Chore};
pub use error::XtaskError;
pub use figures::{Figure, FiguresArguments, Runner, figures};
pub use golden::{Comparison, Difference, Golden, GoldenArguments, golden, release_program};
pub use site::{BrokenLink, PageFault, Site, SiteArguments, SiteSource, site};
pub use tidy::{Violation, tidy};
pub use tree::Tree;
