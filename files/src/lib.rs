//! Files written whole or not at all, locks on folders, and what the formats of results share.
//!
#![doc = include_str!("../README.md")]

pub mod cell;
pub mod disk;
mod error;
pub mod lock;
pub mod netcdf;
pub mod partial;
pub mod refusal;
pub mod staging;
pub mod unfinished;
pub mod whole;

use serde::Serialize;

pub use error::{FileError, causes};

/// The style of every page, `report.html`; no page loads anything.
pub const PAGE_STYLE: &str = include_str!("page.css").trim_ascii_end();

/// Returns the value as JSON with a final newline; numbers have their shortest exact form, and non-finite ones are
/// `null`.
///
/// # Errors
///
/// An error of serde if the value has no JSON form.
pub fn json(value: &impl Serialize) -> Result<String, serde_json::Error> {
    let mut text = serde_json::to_string_pretty(value)?;
    text.push('\n');
    Ok(text)
}
