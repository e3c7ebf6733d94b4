//! Arguments of `pellicle plot`.

use std::path::PathBuf;

use clap::Args;
use pellicle_plot::sheet::colour_map::ColourMap;
use pellicle_plot::sheet::style::Cut;

use super::values::{colour_map, paper_width, range, resolution, section};
use crate::output::paper::PictureFormat;
use crate::picture::study::Form;

/// Arguments of `plot`.
#[derive(Debug, Args)]
pub struct PlotArguments {
    /// The results folder; for several, their curves are drawn in one picture, curves.svg and curves.png
    #[arg(value_name = "DIR", required = true)]
    pub folders: Vec<PathBuf>,
    /// Folder for the pictures [default: the results folder, whose pictures and report are replaced; for several, the
    /// current folder]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Replace existing pictures in a folder other than that of the results
    #[arg(long)]
    pub force: bool,
    /// Of a study: the number that is drawn, by its key or its name in tables [default: max pressure]; repeat it for
    /// several, one below the other
    #[arg(long = "result", value_name = "NAME")]
    pub results: Vec<String>,
    /// Of a study: the keys over which it is drawn, that of the axis below first [default: those that vary]
    #[arg(long, value_name = "KEY")]
    pub over: Vec<String>,
    /// Of a study: curves over one key, one for each value of another, or a map over two [default: curves, a map if the
    /// second key has more than 6 values]
    #[arg(long = "as", value_name = "FORM", value_enum)]
    pub form: Option<Form>,
    /// Of a study or a search: the format, repeatable [default: svg and png]
    #[arg(long = "format", value_name = "FORMAT", value_enum)]
    pub formats: Vec<PictureFormat>,
    /// Of a study or a search: width on paper in millimetres; letters are 8 points high [default: 120]
    #[arg(long, value_name = "MM", value_parser = paper_width)]
    pub width: Option<f64>,
    /// Of a study or a search: pixels per inch of the PNG [default: 300]
    #[arg(long, value_name = "DPI", value_parser = resolution)]
    pub dpi: Option<f64>,
    /// Draw only the pictures of this loading step, counted from 0
    #[arg(long, value_name = "N")]
    pub step: Option<usize>,
    /// Width of every picture in pixels [default: about 1000]
    #[arg(long, value_name = "PIXELS", value_parser = clap::value_parser!(u16).range(100..=10000))]
    pub size: Option<u16>,
    /// Omit the title lines above the pictures
    #[arg(long)]
    pub no_title: bool,
    /// Colour map [default: viridis]
    #[arg(long, value_name = "COLOURS", value_parser = colour_map())]
    pub colour_map: Option<ColourMap>,
    /// Range of the pressure scale: "2 GPa" or "0.5 GPa:2 GPa"; a bare number is in Pa or the case's own unit [default:
    /// up to the largest pressure]
    #[arg(long, value_name = "[FROM:]TO", value_parser = range)]
    pub range: Option<[f64; 2]>,
    /// Position of the section: axis, peak (through the largest pressure), y="5 um" (along x), x="5 um" (along y)
    /// [default: axis; peak where a plane is pressed]
    #[arg(long, value_name = "PLACE", value_parser = section)]
    pub section: Option<Cut>,
}
