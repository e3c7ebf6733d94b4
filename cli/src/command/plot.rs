//! `pellicle plot`: the pictures of a results folder drawn again.

use crate::arguments::PlotArguments;
use crate::failure::Failure;
use crate::output::results;
use crate::program::Outcome;
use crate::terminal;

/// Draws the pictures from the files of the folder alone.
///
/// # Errors
///
/// [`Failure`] if the folder holds no results or a picture cannot be written.
pub fn plot(arguments: &PlotArguments) -> Result<Outcome, Failure> {
    let folder = &arguments.folder;
    let count = results::draw(folder)?;
    let pictures = if count == 1 { "picture" } else { "pictures" };
    terminal::tell(&format!("{count} {pictures} drawn in {}", folder.display()));
    Ok(Outcome::Done)
}
