//! What the page draws of a loading step: the pressure from above and along x, and the section.

use pellicle::Run;
use pellicle::display::{DisplayUnit, Unit};
use pellicle::result::fields::Fields;
use pellicle::result::square_fields::SquareFields;
use pellicle_plot::sheet::style::{Cut, Heading, Style};
use pellicle_plot::step::crop::Crop;
use pellicle_plot::step::section;
use pellicle_plot::step::subject::Subject;
use pellicle_plot::step::surface_figure::SurfaceFigure;
use serde_json::{Value, json};

/// Most cells along a side of the map: a pixel or two each.
const MAP_CELLS: usize = 192;

/// What is drawn of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Detail {
    /// What follows a slider.
    Sketch,
    /// The section, too.
    Whole,
}

/// The pictures of a step; none if its surface is not known.
#[must_use]
pub fn of_step(run: &Run, step: usize, detail: Detail) -> Option<Value> {
    let geometry = run.path.geometry();
    let surface = run.path.surface(&geometry, step)?;
    let square = SquareFields::of(Fields::of(&run.path, &geometry, step, &surface));
    let heading = Heading::Hidden;
    let subject = Subject {
        title: "",
        numbers: String::new(),
        accuracy: String::new(),
        units: run.summary.units,
        relief_height: run.summary.relief_height(),
        fields: square.fields(),
        style: Style {
            heading,
            cut: run.summary.presses_a_plane().then_some(Cut::Peak),
            ..Style::default()
        },
    };
    let map = SurfaceFigure::new(&subject, MAP_CELLS);
    Some(json!({
        "map": {
            "cells": map.cells, "values": map.values, "palette": map.palette, "labels": map.labels,
        },
        "pressure": along_x(&subject),
        "section": (detail == Detail::Whole).then(|| section::draw(&subject)),
    }))
}

/// The pressures of the elements along the section, in SI units or the case's own.
fn along_x(subject: &Subject<'_>) -> Value {
    let fields = &subject.fields;
    let size = fields.size;
    let shown = Crop::around_contact(fields.pressure, size).x;
    let x: Vec<_> = shown.clone().map(|i| fields.centre_along(0, i)).collect();
    let row = section::row(subject).unwrap_or(size / 2);
    let p: Vec<_> = shown.map(|i| fields.pressure[i * size + row]).collect();
    json!({ "x": x, "y": p })
}

/// The scale of numbers up to the largest of a list.
#[must_use]
pub fn scale(numbers: impl IntoIterator<Item = f64>, unit: Unit, run: &Run) -> Value {
    let largest = numbers.into_iter().map(f64::abs).fold(0.0, f64::max);
    let scale = DisplayUnit::of(largest, unit, run.summary.units);
    json!({ "divisor": scale.divisor, "label": scale.label })
}
