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

/// A sentence as HTML: what stands between two grave accents is code.
///
/// ```
/// let html = pellicle_files::with_code("`holes = \"none\"` reads a & b");
/// assert_eq!(html, "<code>holes = &quot;none&quot;</code> reads a &amp; b");
/// ```
#[must_use]
pub fn with_code(sentence: &str) -> String {
    let escaped = |text: &str| {
        let text = text.replace('&', "&amp;").replace('"', "&quot;");
        text.replace('<', "&lt;").replace('>', "&gt;")
    };
    let parts: Vec<&str> = sentence.split('`').collect();
    let part = |(place, part): (usize, &&str)| match (place % 2 == 1, place + 1 < parts.len()) {
        (true, true) => format!("<code>{}</code>", escaped(part)),
        // An accent without a second one stands for itself.
        (true, false) => format!("`{}", escaped(part)),
        (false, _) => escaped(part),
    };
    parts.iter().enumerate().map(part).collect()
}

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
