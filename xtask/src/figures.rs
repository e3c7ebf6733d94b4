//! The figures of the paper, drawn from certified runs of its cases.
//!
//! A figure asks the [`Runner`] for its cases through a [`Studio`], which knows how fine the grids are to be, and gives
//! [`Picture`]s: a drawing and the numbers in it.

mod arguments;
mod chart;
mod figure_2;
mod figure_3;
mod figure_4;
mod figure_5;
mod figure_6;
mod line;
mod loading;
mod note;
mod parameters;
mod picture;
mod pressure_sheet;
mod pressures;
mod run;
mod section;
mod sheet;
mod studio;

use std::path::Path;

pub use arguments::{Figure, FiguresArguments};
pub use run::Runner;
pub use studio::Quality;

use crate::XtaskError;
use picture::Picture;
use studio::Studio;

/// Draws the figures of `arguments` from the cases of the workspace at `root`, and returns how many pictures there are;
/// `tell` hears what is going on.
///
/// # Errors
/// A program that cannot be built, a run that is not certified, a file that cannot be written.
pub fn figures(
    arguments: &FiguresArguments,
    root: &Path,
    tell: &mut dyn FnMut(&str),
) -> Result<usize, XtaskError> {
    let runner = Runner::release(root);
    let quality = arguments.quality();
    let out = root.join(arguments.folder());
    let mut drawn = 0;
    for figure in arguments.figures() {
        for picture in draw(figure, &runner, quality, tell)? {
            picture.write(&out)?;
            if arguments.docs {
                picture.write_small(&root.join("docs").join("figures"))?;
            }
            tell(&format!("drawn:  {}", out.join(picture.name).display()));
            drawn += 1;
        }
    }
    Ok(drawn)
}

/// Draws one figure and writes its pictures into a folder; the names of the files.
///
/// # Errors
/// A run that is not certified, a file that cannot be written.
pub fn draw_figure(
    figure: Figure,
    runner: &Runner,
    quality: Quality,
    out: &Path,
) -> Result<Vec<String>, XtaskError> {
    let pictures = draw(figure, runner, quality, &mut |_| ())?;
    let mut names = Vec::new();
    for picture in pictures {
        names.extend(picture.write(out)?);
    }
    Ok(names)
}

fn draw(
    figure: Figure,
    runner: &Runner,
    quality: Quality,
    tell: &mut dyn FnMut(&str),
) -> Result<Vec<Picture>, XtaskError> {
    let mut studio = Studio {
        runner,
        quality,
        tell,
    };
    match figure {
        Figure::Two => figure_2::draw(&mut studio),
        Figure::Three => figure_3::draw(&mut studio),
        Figure::Four => figure_4::draw(&mut studio),
        Figure::Five => figure_5::draw(&mut studio),
        Figure::Six => figure_6::draw(&mut studio),
    }
}
