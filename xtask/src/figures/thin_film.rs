//! Formulas for indenters on a thin layer over the exact force: the picture of docs/thin-film-formulas.md.

use pellicle_kernel::Interface;
use pellicle_plot::axes::panel::Axis;
use pellicle_plot::sheet::colours::{AMBER, BLUE, GREEN, INK, ORANGE, PURPLE, SKY, TEAL, WINE};
use pellicle_plot::sheet::svg::Dash::{Dashed, Solid};
use pellicle_validation::ValidationError;
use pellicle_validation::film_formulas::{FilmIndenter, PUBLISHED, ThinLayer, polynomial};
use rayon::prelude::*;

use super::chart::{Chart, ChartLine, CurvePanel, Pen};
use super::sheet::{Caption, Picture};
use crate::XtaskError;

/// Number of points of the curves, and contact radii (in thicknesses) of the program's contacts.
const POINTS: u32 = 61;
const RADII: [f64; 6] = [0.1, 0.25, 0.6, 1.4, 3.0, 5.5];
/// Range of `√(RD)/H`, `D tan α/H` and `a/H`.
const CHI: [f64; 2] = [0.05, 5.0];

/// Draws the picture; every exact force is computed for it.
pub(super) fn draw() -> Result<Picture, XtaskError> {
    let bonded = Interface::Bonded;
    let panels = [
        (
            "paraboloid on a bonded incompressible layer",
            bonded,
            FilmIndenter::Paraboloid,
            "√(RD)/H",
        ),
        (
            "paraboloid on a sliding layer (Dimitriadis for ν = ½)",
            Interface::Frictionless,
            FilmIndenter::Paraboloid,
            "√(RD)/H",
        ),
        (
            "cone on a bonded incompressible layer",
            bonded,
            FilmIndenter::Cone,
            "D tan α/H",
        ),
        (
            "flat punch on a bonded incompressible layer",
            bonded,
            FilmIndenter::FlatPunch,
            "a/H",
        ),
    ];
    let chart = Chart {
        name: "thin-film",
        caption: Caption {
            title: "Thin films: force by the formula over the exact force",
            subtitle: "frictionless indenters on an elastic layer of thickness H on a rigid base, penetration D"
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
        panels: panels.map(panel).into_iter().collect::<Result<_, _>>()?,
    };
    Ok(chart.draw())
}

/// The lines of every panel, in the order of the legend; each formula has its own pen.
const AS_IF_THICK: (&str, Pen) = ("as if thick: Hertz, Sneddon", (BLUE, Solid));
const SERIES: (&str, Pen) = ("four terms of the exact series", (GREEN, Solid));
const THIN: (&str, Pen) = ("limit of a very thin layer", (PURPLE, Solid));
const DIMITRIADIS: (&str, Pen) = ("Dimitriadis and others 2002", (ORANGE, Dashed));
const CONTACTS: (&str, Pen) = ("Pellicle's contacts", (INK, Solid));
const PENS: [(&str, Pen); 4] = [
    ("Garcia and Garcia 2018", (TEAL, Dashed)),
    ("Long and others 2011", (AMBER, Dashed)),
    ("Managuli and Roy 2018", (SKY, Dashed)),
    ("Gavara and Chadwick 2012", (WINE, Dashed)),
];

/// A panel for an incompressible film with this interface under an indenter.
fn panel(
    (name, interface, indenter, length): (&'static str, Interface, FilmIndenter, &str),
) -> Result<CurvePanel, ValidationError> {
    let film = ThinLayer {
        interface,
        poisson_ratio: 0.5,
    };
    Ok(CurvePanel {
        name,
        title: name.into(),
        axes: [
            Axis::logarithmic(CHI[0], CHI[1], length.into()),
            Axis::new(0.0, 2.0, "force by the formula / exact force".into(), 9),
        ],
        lines: lines(&film, indenter)?,
    })
}

/// The formulas' forces, and those of the program's contacts, over the exact force; lines without points for those that
/// do not hold here.
fn lines(film: &ThinLayer, indenter: FilmIndenter) -> Result<Vec<ChartLine>, ValidationError> {
    let [first, last] = CHI;
    let chi = |i| first * (last / first).powf(f64::from(i) / f64::from(POINTS - 1));
    let exact = (0..POINTS).into_par_iter();
    let exact = exact.map(|i| Ok((chi(i), film.exact(indenter, chi(i))?)));
    let exact = exact.collect::<Result<Vec<_>, ValidationError>>()?;
    let line = |(name, pen): (&str, Pen), formula: Option<&dyn Fn(f64) -> f64>| {
        let points = formula.map(|formula| {
            let points = exact.iter();
            points
                .map(|(chi, exact)| (*chi, formula(*chi) / exact))
                .collect()
        });
        ChartLine::new(name, pen, points.into_iter().collect())
    };
    let is_ball = indenter == FilmIndenter::Paraboloid;
    let series = film.series(indenter)?;
    let dimitriadis = film.dimitriadis().filter(|_| is_ball);
    let of_dimitriadis = |chi| polynomial(&dimitriadis.unwrap_or_default(), chi);
    let four_terms = |chi| polynomial(&series, chi);
    let thin = |chi| film.thin_limit(chi);
    let published = |named: (&str, Pen)| {
        let is_bonded = film.interface == Interface::Bonded;
        let mut all = PUBLISHED.iter().filter(|_| is_bonded);
        let found = all.find(|of| of.name == named.0 && of.indenter == indenter);
        line(named, found.map(|of| &of.factor as &dyn Fn(f64) -> f64))
    };
    let mut lines = vec![
        line(AS_IF_THICK, Some(&|_| 1.0)),
        line(
            DIMITRIADIS,
            dimitriadis.is_some().then_some(&of_dimitriadis),
        ),
    ];
    lines.extend(PENS.map(published));
    lines.push(line(SERIES, Some(&four_terms)));
    lines.push(line(THIN, is_ball.then_some(&thin)));
    let contacts = if is_ball { contacts(film)? } else { Vec::new() };
    lines.push(ChartLine::new(CONTACTS.0, CONTACTS.1, contacts).marked());
    Ok(lines)
}

/// The program's contacts under a paraboloid, each a point.
fn contacts(film: &ThinLayer) -> Result<Vec<Vec<(f64, f64)>>, ValidationError> {
    let contact = |radius| {
        let [chi, exact] = film.at_contact_radius(FilmIndenter::Paraboloid, radius)?;
        Ok(vec![(chi, film.solved(chi, 2.4 * radius)? / exact)])
    };
    RADII.into_iter().map(contact).collect()
}
