//! The typeface of every picture: `DejaVu Sans`, embedded, so that no system font is needed.

use std::sync::Once;

use plotters::style::{FontStyle, register_font};

/// Name under which the typeface is registered.
pub const FAMILY: &str = "sans-serif";

static REGISTERED: Once = Once::new();

/// Makes the typeface known, once.
pub fn register() {
    REGISTERED.call_once(|| {
        // An embedded typeface is a typeface; were it none, drawing the first text would say so.
        drop(register_font(
            FAMILY,
            FontStyle::Normal,
            dejavu::sans::regular(),
        ));
    });
}
