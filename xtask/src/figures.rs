//! The figures of the paper, drawn from certified runs of its cases, and the picture of the page on thin films.
//!
//! A figure asks the [`Runner`] for solutions and returns [`Picture`]s: a drawing and the numbers in it. Captions are
//! literal: the cases are the paper's, whose parameters do not change.

mod arguments;
mod chart;
mod figure_2;
mod figure_3;
mod figure_5;
mod loading;
mod pressures;
mod runner;
mod sheet;
mod stresses;
mod thin_film;

use std::path::Path;

pub use arguments::{Figure, FiguresArguments};
pub use runner::Runner;

use crate::XtaskError;
use sheet::Picture;

/// Draws figures and writes their pictures into the folder `out`, and small versions into `small` if there is one;
/// returns how many pictures there are.
///
/// # Errors
/// A program that cannot be run, a solution that is not certified, a file that cannot be written.
pub fn figures(
    figures: &[Figure],
    runner: &Runner,
    out: &Path,
    small: Option<&Path>,
) -> Result<usize, XtaskError> {
    let mut count = 0;
    for figure in figures {
        for picture in draw(*figure, runner)? {
            picture.write(out)?;
            if let Some(folder) = small {
                picture.write_small(folder)?;
            }
            (runner.tell)(&format!("drawn:  {}", out.join(picture.name).display()));
            count += 1;
        }
    }
    Ok(count)
}

fn draw(figure: Figure, runner: &Runner) -> Result<Vec<Picture>, XtaskError> {
    match figure {
        Figure::Two => figure_2::draw(runner),
        Figure::Three => Ok(vec![figure_3::draw(runner)?]),
        Figure::Four => Ok(vec![loading::figure_4(runner)?]),
        Figure::Five => figure_5::draw(runner),
        Figure::Six => Ok(vec![loading::figure_6(runner)?]),
        Figure::ThinFilm => Ok(vec![thin_film::draw()?]),
        Figure::Stresses => stresses::draw(runner),
    }
}
