//! Formulas for a paraboloid on a thin layer over the exact force: the picture of docs/thin-film-formulas.md.

use pellicle_cli::drawing::{Axis, Dash, colours};
use pellicle_cli::evidence::film_formulas::{ThinLayer, polynomial};
use pellicle_cli::evidence::run::{ContactSetup, paraboloid};
use pellicle_cli::evidence::{ValidationError, ValidationRun};
use pellicle_contact::Load;
use pellicle_kernel::Interface;
use pellicle_texture::Relief;
use rayon::prelude::*;

use super::chart::{Chart, ChartLine, CurvePanel, Pen};
use super::sheet::{Caption, Picture};
use crate::XtaskError;

/// Number of points of the curves, and contact radii (in thicknesses) of the program's contacts.
const POINTS: u32 = 61;
const RADII: [f64; 6] = [0.1, 0.25, 0.6, 1.4, 3.0, 5.5];
/// Range of `√(RD)/H`.
const CHI: [f64; 2] = [0.05, 5.0];
/// Elements along a side of the program's grids.
const ELEMENTS: usize = 256;

/// Incompressible films.
const FILMS: [(&str, Interface); 2] = [
    (
        "bonded to the base, incompressible (ν = ½)",
        Interface::Bonded,
    ),
    (
        "sliding on the base (Dimitriadis for ν = ½)",
        Interface::Frictionless,
    ),
];

/// Draws the picture; every exact force is computed for it.
pub(super) fn draw() -> Result<Picture, XtaskError> {
    let chart = Chart {
        name: "thin-film",
        caption: Caption {
            title: "Thin films: force by the formula over the exact force",
            subtitle: "frictionless paraboloid of radius R on an elastic layer of thickness H on a rigid base, penetration D"
                .into(),
            notes: vec![
                "exact: Fredholm's integral equation, 1e-11; the program's contacts: 256 × 256 elements, certified".into(),
                "a modulus fitted by a formula is wrong by the inverse of its curve".into(),
            ],
        },
        panel: (500.0, 500.0),
        margins: [44.0, 36.0, 76.0],
        legend: (2, 560.0),
        legend_from: 0,
        panels: FILMS.into_iter().map(panel).collect::<Result<_, _>>()?,
    };
    Ok(chart.draw())
}

fn panel((name, interface): (&'static str, Interface)) -> Result<CurvePanel, ValidationError> {
    let film = ThinLayer {
        interface,
        poisson_ratio: 0.5,
    };
    Ok(CurvePanel {
        name,
        title: name.into(),
        axes: [
            Axis::logarithmic(CHI[0], CHI[1], "√(RD)/H".into()),
            Axis::new(0.0, 2.0, "force by the formula / exact force".into(), 9),
        ],
        lines: lines(&film)?,
    })
}

fn lines(film: &ThinLayer) -> Result<Vec<ChartLine>, ValidationError> {
    let [first, last] = CHI;
    let place = |i| first * (last / first).powf(f64::from(i) / f64::from(POINTS - 1));
    let exact = (0..POINTS).into_par_iter();
    let exact = exact.map(|i| Ok((place(i), film.exact(place(i))?)));
    let exact = exact.collect::<Result<Vec<_>, ValidationError>>()?;
    let series = film.series()?;
    let curve = |name: &str, pen: Pen, formula: &dyn Fn(f64) -> f64| {
        let points = exact.iter();
        let points = points.map(|(chi, exact)| (*chi, formula(*chi) / exact));
        ChartLine::new(name, pen, vec![points.collect()])
    };
    let solid = |colour| (colour, Dash::Solid);
    let mut lines = vec![curve("Hertz: as if thick", solid(colours::BLUE), &|_| 1.0)];
    if let Some(coefficients) = film.dimitriadis() {
        let formula = |chi| polynomial(&coefficients, chi);
        let pen = (colours::ORANGE, Dash::Dashed);
        lines.push(curve("Dimitriadis and others 2002", pen, &formula));
    }
    let four_terms = |chi| polynomial(&series, chi);
    let thin = |chi| film.thin_limit(chi);
    lines.extend([
        curve(
            "four terms of the exact series",
            solid(colours::GREEN),
            &four_terms,
        ),
        curve("limit of a very thin layer", solid(colours::PURPLE), &thin),
        ChartLine {
            is_marked: true,
            ..ChartLine::new("Pellicle's contacts", solid(colours::INK), contacts(film)?)
        },
    ]);
    Ok(lines)
}

/// The program's forces over the exact ones, each as a separate part of a line.
fn contacts(film: &ThinLayer) -> Result<Vec<Vec<(f64, f64)>>, ValidationError> {
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
