//! Formulas for a paraboloid on a thin layer over the exact force: the picture of docs/thin-film-formulas.md.

use pellicle_cli::drawing::colours::{self, Colour};
use pellicle_cli::drawing::{Axis, Dash, Rect};
use pellicle_cli::evidence::film_formulas::{Film, polynomial};
use pellicle_cli::evidence::run::{ContactSetup, paraboloid};
use pellicle_cli::evidence::{ValidationError, ValidationRun};
use pellicle_contact::Load;
use pellicle_kernel::Interface;
use pellicle_texture::Relief;
use rayon::prelude::*;

use super::chart::{self, AXIS, ChartLine, LEFT};
use super::sheet::{Caption, Picture, Sheet};
use crate::XtaskError;

/// In pixels.
const SIDE: f64 = 500.0;
const COLUMN: f64 = LEFT + SIDE + 36.0;
const LEGEND: f64 = 92.0 + 44.0;

/// Places of the curves, and contact radii (in thicknesses) of the program's contacts.
const POINTS: u32 = 61;
const RADII: [f64; 6] = [0.1, 0.25, 0.6, 1.4, 3.0, 5.5];
/// `√(RD)/H` from here to there.
const CHI: [f64; 2] = [0.05, 5.0];
/// Elements along a side of the program's grids.
const ELEMENTS: usize = 256;

/// Draws the picture; every exact force is computed for it.
pub(super) fn draw() -> Result<Picture, XtaskError> {
    let films = [(Interface::Bonded, 0.5), (Interface::Frictionless, 0.5)];
    let films = films.map(|(interface, poisson_ratio)| Film {
        interface,
        poisson_ratio,
    });
    let titles = [
        "bonded to the base, incompressible (ν = ½)",
        "sliding on the base (Dimitriadis for ν = ½)",
    ];
    let caption = Caption {
        title: "Thin films: force by the formula over the exact force",
        subtitle: "frictionless paraboloid of radius R on an elastic layer of thickness H on a rigid base, penetration D"
            .into(),
        notes: vec![
            "exact: Fredholm's integral equation, 1e-11; the program's contacts: 256 × 256 elements, certified".into(),
            "a modulus fitted by a formula is wrong by the inverse of its curve".into(),
        ],
    };
    let mut sheet = Sheet::new((2.0 * COLUMN, LEGEND + SIDE + AXIS), &caption);
    let mut panels = Vec::new();
    for film in &films {
        panels.push(lines(film)?);
    }
    for (i, (title, lines)) in titles.iter().zip(&panels).enumerate() {
        let place = Rect {
            left: COLUMN * i as f64 + LEFT,
            top: Sheet::TOP + LEGEND,
            width: SIDE,
            height: SIDE,
        };
        let axes = [
            Axis::logarithmic(CHI[0], CHI[1], "√(RD)/H".into()),
            Axis::new(0.0, 2.0, "force by the formula / exact force".into(), 9),
        ];
        chart::draw(&mut sheet.svg, title, place, axes, lines);
    }
    chart::legend(&mut sheet.svg, (2, 560.0), &panels[0]);
    let tables = titles.iter().zip(&panels);
    let csv = chart::csv(tables.map(|(title, lines)| (*title, lines.as_slice())));
    Ok(sheet.finish("thin-film", csv))
}

fn lines(film: &Film) -> Result<Vec<ChartLine>, ValidationError> {
    let [first, last] = CHI;
    let place = |i| first * (last / first).powf(f64::from(i) / f64::from(POINTS - 1));
    let exact: Result<Vec<_>, ValidationError> = (0..POINTS)
        .into_par_iter()
        .map(|i| Ok((place(i), film.exact(place(i))?)))
        .collect();
    let exact = exact?;
    let series = film.series()?;
    let curve = |name: &str, colour: Colour, dash, formula: &dyn Fn(f64) -> f64| {
        let points = exact
            .iter()
            .map(|(chi, exact)| (*chi, formula(*chi) / exact));
        ChartLine {
            dash,
            ..ChartLine::new(name.into(), colour, vec![points.collect()])
        }
    };
    let mut lines = vec![
        curve("Hertz: as if thick", colours::BLUE, Dash::Solid, &|_| 1.0),
        curve(
            "four terms of the exact series",
            colours::GREEN,
            Dash::Solid,
            &|chi| polynomial(&series, chi),
        ),
        curve(
            "limit of a very thin layer",
            colours::PURPLE,
            Dash::Solid,
            &|chi| film.thin_limit(chi),
        ),
    ];
    if let Some(coefficients) = film.dimitriadis() {
        let formula = |chi| polynomial(&coefficients, chi);
        let name = "Dimitriadis and others 2002";
        lines.insert(1, curve(name, colours::ORANGE, Dash::Dashed, &formula));
    }
    lines.push(ChartLine {
        is_marked: true,
        ..ChartLine::new("Pellicle's contacts".into(), colours::INK, contacts(film)?)
    });
    Ok(lines)
}

/// The program's forces over the exact ones, a part of its own each.
fn contacts(film: &Film) -> Result<Vec<Vec<(f64, f64)>>, ValidationError> {
    let contact = |radius: f64| {
        let [chi, exact] = film.at_contact_radius(radius)?;
        let path = ValidationRun::default().solve(&ContactSetup {
            foundation: film.foundation()?,
            relief: Relief::Bare,
            indenter: paraboloid(1.0)?,
            side: 2.4 * radius,
            elements: ELEMENTS,
            load: Load::Penetration(chi * chi),
        })?;
        // Hertz: 4/3 E* √R D^{3/2}, E* = R = 1
        let force = path.steps[0].solution.force;
        Ok(vec![(chi, 0.75 * force / chi.powi(3) / exact)])
    };
    RADII.into_iter().map(contact).collect()
}
