//! Formulas for a paraboloid on a thin layer over the exact force: the picture of docs/thin-film-formulas.md.

use pellicle_kernel::Interface;
use pellicle_plot::axes::panel::Axis;
use pellicle_plot::sheet::colours::{BLUE, GREEN, INK, ORANGE, PURPLE};
use pellicle_plot::sheet::svg::Dash::{Dashed, Solid};
use pellicle_validation::ValidationError;
use pellicle_validation::film_formulas::{FilmIndenter, ThinLayer, polynomial};
use rayon::prelude::*;

use super::chart::{Chart, ChartLine, CurvePanel, Pen};
use super::sheet::{Caption, Picture};
use crate::XtaskError;

/// Number of points of the curves, and contact radii (in thicknesses) of the program's contacts.
const POINTS: u32 = 61;
const RADII: [f64; 6] = [0.1, 0.25, 0.6, 1.4, 3.0, 5.5];
/// Range of `√(RD)/H`.
const CHI: [f64; 2] = [0.05, 5.0];

/// Draws the picture; every exact force is computed for it.
pub(super) fn draw() -> Result<Picture, XtaskError> {
    let bonded = "bonded to the base, incompressible (ν = ½)";
    let sliding = "sliding on the base (Dimitriadis for ν = ½)";
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
        panels: vec![
            panel(bonded, Interface::Bonded)?,
            panel(sliding, Interface::Frictionless)?,
        ],
    };
    Ok(chart.draw())
}

/// A panel for an incompressible film with this interface.
fn panel(name: &'static str, interface: Interface) -> Result<CurvePanel, ValidationError> {
    let poisson_ratio = 0.5;
    let film = ThinLayer {
        interface,
        poisson_ratio,
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

/// The formulas' forces, and those of the program's contacts, over the exact force.
fn lines(film: &ThinLayer) -> Result<Vec<ChartLine>, ValidationError> {
    let [first, last] = CHI;
    let chi = |i| first * (last / first).powf(f64::from(i) / f64::from(POINTS - 1));
    let exact = (0..POINTS).into_par_iter();
    let exact = exact.map(|i| Ok((chi(i), film.exact(FilmIndenter::Paraboloid, chi(i))?)));
    let exact = exact.collect::<Result<Vec<_>, ValidationError>>()?;
    let curve = |name: &str, pen: Pen, formula: &dyn Fn(f64) -> f64| {
        let points = exact.iter();
        let points = points.map(|(chi, exact)| (*chi, formula(*chi) / exact));
        ChartLine::new(name, pen, vec![points.collect()])
    };
    let contact = |radius| {
        let [chi, exact] = film.at_contact_radius(FilmIndenter::Paraboloid, radius)?;
        Ok(vec![(chi, film.solved(chi, 2.4 * radius)? / exact)])
    };
    let contacts = RADII.into_iter().map(contact);
    let contacts = contacts.collect::<Result<Vec<_>, ValidationError>>()?;
    let series = film.series(FilmIndenter::Paraboloid)?;
    let four_terms = |chi| polynomial(&series, chi);
    let thin = |chi| film.thin_limit(chi);
    let dimitriadis = film.dimitriadis().map(|coefficients| {
        let formula = |chi| polynomial(&coefficients, chi);
        curve("Dimitriadis and others 2002", (ORANGE, Dashed), &formula)
    });
    let lines = [
        Some(curve("Hertz: as if thick", (BLUE, Solid), &|_| 1.0)),
        dimitriadis,
        Some(curve(
            "four terms of the exact series",
            (GREEN, Solid),
            &four_terms,
        )),
        Some(curve("limit of a very thin layer", (PURPLE, Solid), &thin)),
        Some(ChartLine::new("Pellicle's contacts", (INK, Solid), contacts).marked()),
    ];
    Ok(lines.into_iter().flatten().collect())
}
