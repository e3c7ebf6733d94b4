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
    let mut parts = sentence.split('`').peekable();
    let (mut html, mut is_code) = (String::new(), false);
    while let Some(part) = parts.next() {
        // An accent without a second one stands for itself.
        match (is_code, parts.peek()) {
            (true, Some(_)) => html += &format!("<code>{}</code>", escaped(part)),
            (true, None) => html += &format!("`{}", escaped(part)),
            (false, _) => html += &escaped(part),
        }
        is_code = !is_code;
    }
    html
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
