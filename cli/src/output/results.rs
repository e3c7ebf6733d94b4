//! A results folder: what is written into it, and what is read back to draw it again.

use std::fs;
use std::io::Write;
use std::path::Path;

use pellicle_contact::LoadingPath;
use serde::Deserialize;

use super::summary::Summary;
use super::{curve, fields, file, json, summary};
use crate::case::units::Units;
use crate::failure::Failure;
use crate::picture::pressure_map::{self, PressureMap};

/// Writes everything a run leaves behind into an empty folder.
///
/// # Errors
///
/// [`Failure`] if a file cannot be written.
pub fn write(folder: &Path, path: &LoadingPath, summary: &Summary) -> Result<(), Failure> {
    for (i, step) in path.steps.iter().enumerate() {
        fields::write(&folder.join(fields::file(i)), path, &step.solution)?;
        let map = PressureMap {
            title: &summary.title,
            units: summary.case.units,
            certified: step.solution.certificate.is_satisfied(),
            force: step.solution.force,
            penetration: step.solution.penetration,
            side: path.grid.side(),
            size: path.grid.size(),
            pressure: &step.solution.pressure,
            mask: path.relief.mask(),
        };
        map.write(&folder.join(pressure_map::file(i)))?;
    }
    write_text(&folder.join(curve::FILE), &curve::csv(summary))?;
    write_text(&folder.join(summary::FILE), &json(summary)?)
}

fn write_text(path: &Path, text: &str) -> Result<(), Failure> {
    file::write_whole(path, |file| file.write_all(text.as_bytes()))
}

/// What a picture needs of a summary.
#[derive(Debug, Deserialize)]
struct Stored {
    title: String,
    grid: StoredGrid,
    steps: Vec<StoredStep>,
}

#[derive(Debug, Deserialize)]
struct StoredGrid {
    side: f64,
}

#[derive(Debug, Deserialize)]
struct StoredStep {
    force: f64,
    penetration: f64,
    certificate: StoredCertificate,
}

#[derive(Debug, Deserialize)]
struct StoredCertificate {
    satisfied: bool,
}

/// Draws the pictures of a results folder again, from its files alone; how many there are.
///
/// # Errors
///
/// [`Failure`] if the folder holds no results or a picture cannot be written.
pub fn draw(folder: &Path) -> Result<usize, Failure> {
    let (stored, units) = read(folder)?;
    for (i, step) in stored.steps.iter().enumerate() {
        let fields = fields::read(&folder.join(fields::file(i)))?;
        let map = PressureMap {
            title: &stored.title,
            units,
            certified: step.certificate.satisfied,
            force: step.force,
            penetration: step.penetration,
            side: stored.grid.side,
            size: fields.size,
            pressure: &fields.pressure,
            mask: &fields.mask,
        };
        map.write(&folder.join(pressure_map::file(i)))?;
    }
    Ok(stored.steps.len())
}

fn read(folder: &Path) -> Result<(Stored, Units), Failure> {
    let path = folder.join(summary::FILE);
    let text = read_text(&path)?;
    let stored = serde_json::from_str(&text).map_err(|cause| Failure::damaged(&path, &cause))?;
    let curve = read_text(&folder.join(curve::FILE))?;
    Ok((stored, curve::units(&curve)))
}

fn read_text(path: &Path) -> Result<String, Failure> {
    fs::read_to_string(path).map_err(|cause| Failure::damaged(path, &cause))
}
