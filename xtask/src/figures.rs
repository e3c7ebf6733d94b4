//! The figures of the paper, drawn from certified runs of its cases, and the picture for the page on thin films.
//!
//! A figure gets solutions from the [`Runner`] and returns [`Picture`]s: a drawing and the numbers in it. Captions are
//! literal, since the parameters of the paper's cases do not change.

mod chart;
mod figure_2;
mod figure_3;
mod figure_5;
mod gallery;
mod loading;
mod pressures;
mod runner;
mod sheet;
mod stresses;
mod thin_film;
mod worn;

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use self::runner::{FULL, QUICK};
use self::sheet::Picture;
use crate::XtaskError;

pub use self::runner::Runner;

/// A figure of the paper that shows results, or of a page of the documentation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Figure {
    /// Pressure under a paraboloid on textured coatings.
    #[value(name = "2")]
    Two,
    /// Deformed layer and tops of the elements.
    #[value(name = "3")]
    Three,
    /// Penetration against load.
    #[value(name = "4")]
    Four,
    /// Pressure under a pyramid, with and without film.
    #[value(name = "5")]
    Five,
    /// Largest pressure and penetration against load, with and without film.
    #[value(name = "6")]
    Six,
    /// Formulas for thin films over the exact force; not in the paper.
    ThinFilm,
    /// Stresses under figure 2, which the paper does not show.
    Stresses,
    /// Rounded edges and wear of the pillars of figure 2, which the paper does not show.
    Worn,
    /// Pictures that docs/gallery.md describes by their commands.
    Gallery,
}

/// Draws the paper's figures from its cases.
#[derive(Debug, Clone, Args)]
pub struct FiguresArguments {
    /// Only these figures: of the paper, 2 to 6, or thin-film, or stresses, those under figure 2, or worn, its pillars,
    /// or gallery.
    #[arg(long, value_name = "FIGURE,…", value_delimiter = ',')]
    pub only: Vec<Figure>,
    /// Coarse grids, for a look only; the pictures say so.
    #[arg(long)]
    pub quick: bool,
    /// Write small versions into docs/figures too.
    #[arg(long, conflicts_with = "quick")]
    pub docs: bool,
    /// Folder of the pictures, relative to the workspace [default: target/paper/figures, with --quick
    /// target/paper/quick].
    #[arg(long, value_name = "DIR", hide_default_value = true)]
    #[arg(default_value = "target/paper/figures")]
    #[arg(default_value_if("quick", "true", "target/paper/quick"))]
    pub out: PathBuf,
}

impl FiguresArguments {
    /// The requested figures, each once, in the paper's order.
    #[must_use]
    pub fn figures(&self) -> Vec<Figure> {
        let is_wanted = |figure: &Figure| self.only.is_empty() || self.only.contains(figure);
        let all = Figure::value_variants().iter().copied();
        all.filter(is_wanted).collect()
    }

    /// Elements along a side of every grid.
    #[must_use]
    pub fn elements(&self) -> usize {
        if self.quick { QUICK } else { FULL }
    }
}

/// Draws figures and writes their pictures into the folder `out`, and small versions into `small` if given; returns the
/// number of pictures.
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
            (runner.tell)(&format!("drawn:  {}", out.join(&picture.name).display()));
            count += 1;
        }
    }
    Ok(count)
}

fn draw(figure: Figure, runner: &Runner) -> Result<Vec<Picture>, XtaskError> {
    match figure {
        Figure::Two => figure_2::draw(runner),
        Figure::Three => Ok(vec![figure_3::draw(runner)?]),
        Figure::Four => Ok(vec![loading::FIGURE_4.draw(runner)?]),
        Figure::Five => figure_5::draw(runner),
        Figure::Six => Ok(vec![loading::FIGURE_6.draw(runner)?]),
        Figure::ThinFilm => Ok(vec![thin_film::draw()?]),
        Figure::Stresses => stresses::draw(runner),
        Figure::Worn => worn::draw(runner),
        Figure::Gallery => gallery::draw(runner),
    }
}
