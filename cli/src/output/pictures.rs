//! The pictures of a results folder, each as SVG and as PNG, and the drawings in the report.

use std::path::Path;

use pellicle::case::output::Steps;
use pellicle::result::fields::Fields;
use pellicle::result::square_fields::SquareFields;
use pellicle::summary::{RunSummary, StepSummary};
use pellicle_plot as plot;
use pellicle_plot::sheet::style::Style;
use pellicle_plot::step::field_map::FieldMap;
use pellicle_plot::step::subject::Subject;
use pellicle_plot::step::surface_figure::SurfaceFigure;
use pellicle_plot::step::{pressure_map, pressure_view, section};
use pellicle_plot::stress::extremes::Extremes;
use pellicle_plot::stress::view::StressView;
use rayon::prelude::*;

use super::write_progress::WriteProgress;
use crate::failure::Failure;
use crate::picture::{area_law, convergence, curve, extremes, histograms, spectrum, subject, wear};

/// Most columns along a side that a browser turns without delay.
const TURNED_CELLS: usize = 96;

/// The pictures of a run as a whole.
const CURVE: &str = "curve";
const CONVERGENCE: &str = "convergence";
const SPECTRUM: &str = "spectrum";
const AREA_LAW: &str = "area-law";
const WEAR: &str = "wear";

/// A picture of a loading step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StepPicture {
    /// The pressure from above.
    PressureMap,
    /// The section.
    Section,
    /// The pressure in three dimensions.
    PressureView,
    /// The distribution of pressures and gaps.
    Histograms,
    /// Another field from above.
    Field(FieldMap),
}

/// The pictures of a loading step; a measured surface or indenter has more than others.
#[must_use]
pub fn of_a_step(summary: &RunSummary) -> Vec<StepPicture> {
    let mut pictures = vec![
        StepPicture::PressureMap,
        StepPicture::Section,
        StepPicture::PressureView,
    ];
    let fields: &[_] = match summary.maps() {
        [true, _] => &[FieldMap::Heights, FieldMap::Gap, FieldMap::Displacement],
        [false, true] => &[FieldMap::Gap, FieldMap::Displacement],
        [false, false] => &[],
    };
    pictures.extend(fields.iter().map(|field| StepPicture::Field(*field)));
    if summary.has_rough_contact() {
        pictures.push(StepPicture::Histograms);
    }
    pictures
}

impl StepPicture {
    /// Its file name, without extension.
    fn name(self, step: usize) -> String {
        let name = match self {
            Self::PressureMap => "pressure",
            Self::Section => "section",
            Self::PressureView => "pressure-3d",
            Self::Histograms => "histograms",
            Self::Field(FieldMap::Heights) => "heights",
            Self::Field(FieldMap::Gap) => "gap",
            Self::Field(FieldMap::Displacement) => "displacement",
        };
        format!("{name}-{step:03}")
    }

    fn draw(self, subject: &Subject<'_>, step: &StepSummary) -> String {
        match self {
            Self::PressureMap => pressure_map::draw(subject),
            Self::Section => section::draw(subject),
            Self::PressureView => pressure_view::draw(subject),
            Self::Histograms => {
                plot::step::histograms::draw(subject, histograms::of_step(step).as_ref())
            }
            Self::Field(field) => field.draw(subject),
        }
    }
}

/// A picture of the stresses of a loading step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StressPicture {
    /// The section through the largest von Mises stress.
    Section,
    /// The tractions on the interfaces.
    Interfaces,
}

/// The pictures of the stresses of a loading step, as SVG.
#[derive(Debug, Clone, Default)]
pub struct StressDrawings {
    /// Loading step, counted from 0.
    pub step: usize,
    /// The pictures that were drawn.
    pub drawings: Vec<(StressPicture, String)>,
}

/// The pictures of one loading step.
#[derive(Debug, Clone, Default)]
pub struct StepDrawings {
    /// Loading step, counted from 0.
    pub step: usize,
    /// The pictures that were drawn, as SVG.
    pub drawings: Vec<(StepPicture, String)>,
    /// The pictures of the stresses that were drawn, as SVG.
    pub stresses: Vec<(StressPicture, String)>,
    /// The rotatable pressure view; none if it cannot be drawn.
    pub surface: Option<SurfaceFigure>,
}

/// The pictures of the run as a whole, as SVG.
#[derive(Debug, Clone, Default)]
pub struct RunDrawings {
    /// Force over penetration, pressure over force.
    pub curve: Option<String>,
    /// Values from grid to grid.
    pub convergence: Option<String>,
    /// Power over the wavenumber of the maps.
    pub spectrum: Option<String>,
    /// Contact fraction over reduced pressure of a rough contact.
    pub area_law: Option<String>,
    /// The section of a surface as it wears.
    pub wear: Option<String>,
}

/// The pictures of the stresses of a step.
#[must_use]
pub fn of_stresses(summary: &RunSummary) -> &'static [StressPicture] {
    if summary.layers() > 0 {
        &[StressPicture::Section, StressPicture::Interfaces]
    } else {
        &[StressPicture::Section]
    }
}

impl StressPicture {
    /// Its file name, without extension.
    fn name(self, step: usize) -> String {
        match self {
            Self::Section => format!("stress-section-{step:03}"),
            Self::Interfaces => format!("stress-interfaces-{step:03}"),
        }
    }

    fn draw(self, subject: &Subject<'_>, view: &StressView, extremes: &Extremes) -> String {
        match self {
            Self::Section => plot::stress::section::draw(subject, view, extremes),
            Self::Interfaces => plot::stress::interfaces::draw(subject, view, extremes),
        }
    }
}

/// Names of the pictures of the stresses of a step, without extensions.
#[must_use]
pub fn names_of_stresses(summary: &RunSummary, step: usize) -> Vec<String> {
    let pictures = of_stresses(summary).iter();
    pictures.map(|picture| picture.name(step)).collect()
}

/// Writes the pictures of the stresses of a step, and returns the drawings for the report.
///
/// # Errors
///
/// [`Failure::File`] if a picture cannot be written.
pub fn stresses(
    folder: &Path,
    summary: &RunSummary,
    step: usize,
    fields: Fields<'_>,
    view: &StressView,
    style: &Style,
    writer: &WriteProgress<'_>,
) -> Result<StressDrawings, Failure> {
    let square = SquareFields::of(fields);
    let subject = subject::of_step(summary, &summary.steps[step], &square.fields(), *style);
    let extremes = extremes::of_step(&summary.steps[step]);
    let pictures = of_stresses(summary).par_iter();
    let drawn = pictures.map(|picture| {
        let draw = || picture.draw(&subject, view, &extremes);
        let svg = writer.picture(folder, &picture.name(step), draw)?;
        Ok(svg.map(|svg| (*picture, svg)))
    });
    let drawn = drawn.collect::<Result<Vec<_>, Failure>>()?;
    Ok(StressDrawings {
        step,
        drawings: drawn.into_iter().flatten().collect(),
    })
}

/// Draws the pictures of one loading step for the report, without writing them.
#[must_use]
pub fn drawn_step(summary: &RunSummary, step: usize, fields: Fields<'_>) -> StepDrawings {
    let numbers = &summary.steps[step];
    let square = SquareFields::of(fields);
    let subject = subject::of_step(summary, numbers, &square.fields(), Style::default());
    let pictures = of_a_step(summary).into_par_iter();
    StepDrawings {
        step,
        drawings: pictures
            .map(|picture| (picture, picture.draw(&subject, numbers)))
            .collect(),
        stresses: Vec::new(),
        surface: Some(SurfaceFigure::new(&subject, TURNED_CELLS)),
    }
}

/// Draws the pictures of the run as a whole for the report, without writing them.
#[must_use]
pub fn drawn_run(summary: &RunSummary) -> RunDrawings {
    RunDrawings {
        curve: draw_curve(summary, &Style::default()),
        convergence: draw_convergence(summary, &Style::default()),
        spectrum: draw_spectrum(summary, &Style::default()),
        area_law: draw_area_law(summary, &Style::default()),
        wear: draw_wear(summary, &Style::default()),
    }
}

/// Force over penetration and pressure over force; none of a single step.
fn draw_curve(summary: &RunSummary, style: &Style) -> Option<String> {
    let of_run = curve::of_run(summary, summary.title.clone());
    let worst = curve::worst(summary.steps.iter());
    has_curve(summary).then(|| plot::run::curve::draw(of_run, worst, summary.units, style))
}

fn draw_convergence(summary: &RunSummary, style: &Style) -> Option<String> {
    let (title, grids) = (&summary.title, convergence::of_run(summary));
    plot::run::convergence::draw(title, &grids, summary.units, style)
}

fn draw_spectrum(summary: &RunSummary, style: &Style) -> Option<String> {
    let (title, maps) = (&summary.title, spectrum::of_run(summary));
    plot::run::spectrum::draw(title, &maps, summary.units, style)
}

/// Whether there are several loads; the steps of a wear have one.
fn has_curve(summary: &RunSummary) -> bool {
    summary.steps.len() > 1 && summary.steps.iter().all(|step| step.wear.is_none())
}

fn draw_wear(summary: &RunSummary, style: &Style) -> Option<String> {
    let (title, sections) = (&summary.title, wear::of_run(summary));
    let domain = (summary.grid.side_along_x(), summary.units);
    plot::run::wear::draw(title, &sections, domain, style)
}

fn draw_area_law(summary: &RunSummary, style: &Style) -> Option<String> {
    plot::run::area_law::draw(&summary.title, &area_law::of_run(summary), style)
}

/// Writes the pictures of one loading step, and returns the drawings for the report.
///
/// # Errors
///
/// [`Failure::File`] if a picture cannot be written.
pub fn step(
    folder: &Path,
    summary: &RunSummary,
    step: usize,
    fields: Fields<'_>,
    style: &Style,
    writer: &WriteProgress<'_>,
) -> Result<StepDrawings, Failure> {
    let numbers = &summary.steps[step];
    let subject = subject::of_step(summary, numbers, &fields, *style);
    let pictures = of_a_step(summary).into_par_iter();
    let drawn = pictures.map(|picture| {
        let svg = writer.picture(folder, &picture.name(step), || {
            picture.draw(&subject, numbers)
        })?;
        Ok(svg.map(|svg| (picture, svg)))
    });
    let drawn = drawn.collect::<Result<Vec<_>, Failure>>()?;
    let surface = writer.drawn(
        &format!("of the pressure in three dimensions at step {step}"),
        || Ok(SurfaceFigure::new(&subject, TURNED_CELLS)),
    );
    Ok(StepDrawings {
        step,
        drawings: drawn.into_iter().flatten().collect(),
        stresses: Vec::new(),
        surface,
    })
}

/// Draws the pictures of the run as a whole for the report, and writes them unless no pictures are requested.
///
/// # Errors
///
/// [`Failure::File`] if a picture cannot be written.
pub fn run(
    folder: &Path,
    summary: &RunSummary,
    pictures: Steps,
    style: &Style,
    writer: &WriteProgress<'_>,
) -> Result<RunDrawings, Failure> {
    let one = |name: &str, svg: Option<String>| match svg {
        Some(svg) if pictures != Steps::None => writer
            .picture(folder, name, || svg.clone())
            .map(|_| Some(svg)),
        svg => Ok(svg),
    };
    let drawn = |name, draw: fn(&RunSummary, &Style) -> Option<String>| {
        writer.drawn(name, || Ok(draw(summary, style))).flatten()
    };
    Ok(RunDrawings {
        curve: one(CURVE, drawn(CURVE, draw_curve))?,
        convergence: one(CONVERGENCE, drawn(CONVERGENCE, draw_convergence))?,
        spectrum: one(SPECTRUM, drawn(SPECTRUM, draw_spectrum))?,
        area_law: one(AREA_LAW, drawn(AREA_LAW, draw_area_law))?,
        wear: one(WEAR, drawn(WEAR, draw_wear))?,
    })
}

/// The pictures of a run as a whole, and whether there is something to draw.
fn of_a_run(summary: &RunSummary) -> [(&'static str, bool); 5] {
    let has_grids = plot::run::convergence::is_drawn(&convergence::of_run(summary));
    let has_maps = plot::run::spectrum::is_drawn(&spectrum::of_run(summary));
    let has_area_law = plot::run::area_law::is_drawn(&area_law::of_run(summary));
    [
        (CURVE, has_curve(summary)),
        (CONVERGENCE, has_grids),
        (SPECTRUM, has_maps),
        (AREA_LAW, has_area_law),
        (WEAR, plot::run::wear::is_drawn(&wear::of_run(summary))),
    ]
}

/// Names, without extensions, of the pictures of some steps, and of the run unless no pictures are requested.
#[must_use]
pub fn names(summary: &RunSummary, steps: &[usize], of_run: Steps) -> Vec<String> {
    let pictures = of_a_step(summary);
    let name =
        |step: &usize| -> Vec<_> { pictures.iter().map(|picture| picture.name(*step)).collect() };
    let run = of_a_run(summary)
        .into_iter()
        .filter(|(_, is)| *is && of_run != Steps::None);
    let run = run.map(|(name, _)| name.to_owned());
    steps.iter().flat_map(name).chain(run).collect()
}

/// The number of pictures of the run as a whole.
#[must_use]
pub fn count_of_run(summary: &RunSummary, pictures: Steps) -> usize {
    let count = of_a_run(summary).into_iter().filter(|(_, is)| *is).count();
    if pictures == Steps::None { 0 } else { count }
}
