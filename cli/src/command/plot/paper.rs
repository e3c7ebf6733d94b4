//! The picture of a study or of a search, for paper.

use std::path::Path;

use pellicle::result::quantities;
use pellicle_plot::sheet::style::{Heading, Style};
use pellicle_plot::study::{curves, map};
use pellicle_study::series::StudySeries;

use crate::arguments::PlotArguments;
use crate::failure::Failure;
use crate::output::paper::{Paper, PictureFormat};
use crate::picture::found;
use crate::picture::study::{self, StudyPicture, StudyPictureOptions};

/// Width on paper, in millimetres, and pixels per inch, unless they are given: one and a half columns of a journal, at
/// the resolution that journals ask for pictures in colour.
const WIDTH_MM: f64 = 120.0;
const DPI: f64 = 300.0;

/// The formats unless they are given.
const FORMATS: [PictureFormat; 2] = [PictureFormat::Svg, PictureFormat::Png];

/// Name of the picture of a search, without extension.
const FOUND: &str = "find";

/// Draws the picture of the study or the search in a folder; returns its name.
///
/// # Errors
///
/// [`Failure`] if the folder has no such picture, or it cannot be written.
pub fn draw(arguments: &PlotArguments, folder: &Path) -> Result<String, Failure> {
    let style = style(arguments);
    let (name, svg) = if found::is_in(folder) {
        (FOUND.to_owned(), curves::draw(&found::of(folder)?, &style))
    } else {
        let series = StudySeries::read(folder, arguments.step)?;
        let options = StudyPictureOptions {
            results: &arguments.results,
            over: &arguments.over,
            form: arguments.form,
        };
        let svg = match study::of(&series, options)? {
            StudyPicture::Curves(picture) => curves::draw(&picture, &style),
            StudyPicture::Map(picture) => map::draw(&picture, &style),
        };
        (name(&arguments.results), svg)
    };
    let svg = svg.ok_or_else(|| Failure::StudyPicture {
        message: format!("{}: found no certified number to draw", folder.display()),
    })?;
    let formats = match &arguments.formats[..] {
        [] => &FORMATS[..],
        formats => formats,
    };
    let paper = Paper {
        formats,
        width_mm: arguments.width.unwrap_or(WIDTH_MM),
        dpi: arguments.dpi.unwrap_or(DPI),
        replaces: arguments.out.is_none() || arguments.force,
    };
    let out = arguments.out.as_deref().unwrap_or(folder);
    paper.write(out, &name, &svg)?;
    Ok(name)
}

/// Draws the picture of the search in a folder beside its files.
///
/// # Errors
///
/// [`Failure`] if it cannot be written.
pub fn draw_found(folder: &Path) -> Result<(), Failure> {
    let style = Style {
        paper_mm: Some(WIDTH_MM),
        ..Style::default()
    };
    let paper = Paper {
        formats: &FORMATS,
        width_mm: WIDTH_MM,
        dpi: DPI,
        replaces: true,
    };
    let svg = curves::draw(&found::of(folder)?, &style);
    svg.map_or(Ok(()), |svg| paper.write(folder, FOUND, &svg))
}

/// `study-max_pressure`, after the numbers shown.
fn name(results: &[String]) -> String {
    if results.is_empty() {
        return "study-max_pressure".into();
    }
    let words = results.iter().map(|name| {
        let key = quantities::of_key(name.trim()).map_or(name.as_str(), |of| of.key);
        let plain = |c: char| if c.is_alphanumeric() { c } else { '_' };
        key.trim().chars().map(plain).collect::<String>()
    });
    let words: Vec<_> = words.collect();
    format!("study-{}", words.join("-"))
}

fn style(arguments: &PlotArguments) -> Style {
    Style {
        paper_mm: Some(arguments.width.unwrap_or(WIDTH_MM)),
        heading: if arguments.no_title {
            Heading::Hidden
        } else {
            Heading::Shown
        },
        colours: arguments.colour_map.unwrap_or_default(),
        ..Style::default()
    }
}
