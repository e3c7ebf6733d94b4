//! The cases of the paper, run by the program that users have, and what was solved of them kept.
//!
//! A [`PaperCase`] names a case file; a [`Request`] asks for it at a number of elements; the [`Runner`] gives the request to
//! the release build of `pellicle run`, unless the same run of the same program is kept already; [`PaperRun`] is the result.

mod case;
mod paper_run;
mod program;
mod request;
mod runner;

pub use case::PaperCase;
pub use paper_run::PaperRun;
pub use program::Program;
pub use request::{Keep, Request};
pub use runner::Runner;
