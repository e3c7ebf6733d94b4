//! The command line of `cargo xtask figures`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::runner::{FULL, QUICK};

/// A figure of the paper that shows results, or of a page of the documentation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, ValueEnum)]
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
    #[value(name = "thin-film")]
    ThinFilm,
    /// Stresses under figure 2, which the paper does not show.
    #[value(name = "stresses")]
    Stresses,
}

/// Draws the paper's figures from its cases.
#[derive(Debug, Clone, Args)]
pub struct FiguresArguments {
    /// Only these figures: of the paper, 2 to 6, or thin-film, or stresses, those under figure 2.
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
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

impl FiguresArguments {
    /// The figures asked for, each once, in the paper's order.
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

    /// Folder of the pictures.
    #[must_use]
    pub fn folder(&self) -> PathBuf {
        let default = if self.quick { "quick" } else { "figures" };
        let default = || PathBuf::from("target/paper").join(default);
        self.out.clone().unwrap_or_else(default)
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;

    #[derive(Debug, Parser)]
    struct Line {
        #[command(flatten)]
        figures: FiguresArguments,
    }

    fn parsed(line: &str) -> Result<FiguresArguments, clap::Error> {
        let words = std::iter::once("figures").chain(line.split_whitespace());
        Line::try_parse_from(words).map(|line| line.figures)
    }

    #[test]
    fn without_options_all_figures_are_drawn_at_full_resolution() {
        let arguments = parsed("").unwrap();
        assert_eq!(arguments.figures(), Figure::value_variants());
        assert_eq!(arguments.elements(), FULL);
    }

    #[test]
    fn figures_can_be_chosen_and_come_in_order() {
        let arguments = parsed("--only 6,4 --only 4 --quick").unwrap();
        assert_eq!(arguments.figures(), [Figure::Four, Figure::Six]);
        assert_eq!(arguments.elements(), QUICK);
        assert_ne!(arguments.folder(), parsed("").unwrap().folder());
    }

    #[test]
    fn coarse_pictures_never_become_those_of_the_documents() {
        assert!(parsed("--quick --docs").is_err());
    }
}
