//! The disk space that a run will take.
//!
//! Fields take a known number of bytes per element unless they are compressed; pictures are about as large as other
//! pictures of as many elements. *Measured* on the templates, a film and a rough surface, N = 64 to 512: within a tenth
//! where fields dominate, within a fifth where pictures do.

use pellicle::case::Case;
use pellicle::case::output::{Format, OutputCase};
use pellicle::case::surface::SurfaceCase;
use pellicle_plot::step::pressure_map::CELLS;

use super::results::STEPS_IN_REPORT;

/// Bytes of an element in an uncompressed file: five numbers and two truth values; in `.nc` the contact once more; in
/// `.gsf` the pressure alone.
const VTI: f64 = 22.0;
const NC: f64 = 43.0;
const GSF: f64 = 4.0;

/// Bytes of an element in a compressed file: displacement and gap of a symmetric contact. A film's pressure and
/// shortening add to them, and fields without symmetry compress poorly.
const NPZ: f64 = 12.0;
const NPZ_OF_A_FILM: f64 = 2.5;
const NPZ_OF_A_SURFACE: f64 = 14.5;
const NPZ_OF_AN_INDENTER: f64 = 6.0;

/// Bytes of the three pressure pictures of a step on 64 × 64 elements, and the exponent of their growth with the
/// elements per side.
const PICTURES: f64 = 480e3;
const GROWTH: f64 = 0.34;

/// Bytes of a map of another field, and bytes per element in it.
const FIELD_MAP: f64 = 80e3;
const FIELD_MAP_CELL: f64 = 1.5;

/// Bytes of the pictures of a run: of its convergence from grid to grid, and of its curve.
const CONVERGENCE: f64 = 110e3;
const CURVE: f64 = 66e3;

/// Smallest number of elements per side of a run on several grids.
const MIN_ELEMENTS_OF_SEVERAL_GRIDS: usize = 64;

/// Bytes of a step in the report, bytes per element per side in it, and bytes per element in its maps of other fields.
const REPORT: f64 = 20e3;
const REPORT_SIDE: f64 = 400.0;
const REPORT_CELL: f64 = 0.85;

/// Bytes of the stresses at a point: eleven numbers in double precision, or in single precision with the body.
const STRESS_NC: f64 = 88.0;
const STRESS_VTR: f64 = 45.0;

/// Bytes of a point that the pictures show, two compressed numbers; and of the stress pictures of a step, which the
/// report repeats: the section, and the maps of an interface.
const STRESS_NPZ: f64 = 11.0;
const STRESS_SECTION: f64 = 520e3;
const STRESS_INTERFACE: f64 = 200e3;

/// Bytes of summary and curve for a step.
const NUMBERS: f64 = 3.2e3;

/// Estimates the disk space, in bytes, of the stresses of a run on `planes` planes of `size` × `size` points per step,
/// and of their pictures.
#[must_use]
pub fn of_stresses(case: &Case, planes: usize, size: usize) -> f64 {
    if case.stress.is_none() {
        return 0.0;
    }
    let plane = (size * size) as f64;
    let interfaces = case.stressed().layer.len() as f64;
    let bytes = case.output.formats.iter().map(|format| match format {
        Format::Nc => STRESS_NC * planes as f64 * plane,
        Format::Vti => STRESS_VTR * planes as f64 * plane,
        Format::Npz => STRESS_NPZ * (interfaces * plane + (planes * size) as f64),
        Format::Gsf => 0.0,
    });
    let steps = case.steps();
    let of_fields =
        case.output.fields.count(steps) as f64 * bytes.fold(0.0, |sum, bytes| sum + bytes);
    let of_pictures = STRESS_SECTION + STRESS_INTERFACE * interfaces;
    of_fields + case.output.pictures.count(steps) as f64 * of_pictures
}

/// Estimates the disk space of a run of a case without its stresses, in bytes.
#[must_use]
pub fn bytes(case: &Case) -> f64 {
    let steps = case.steps();
    let OutputCase {
        fields, pictures, ..
    } = case.output;
    let area = case.grid.count() as f64;
    let of_fields = fields.count(steps) as f64 * area * per_element(case);
    let pictured = pictures.count(steps);
    let of_pictures = pictured as f64 * of_a_step(case) + of_the_run(case, pictured > 0);
    let of_report = pictured.clamp(1, STEPS_IN_REPORT) as f64 * of_a_step_in_report(case);
    of_fields + of_pictures + of_report + steps as f64 * NUMBERS
}

/// Bytes of the fields of an element in the requested formats.
fn per_element(case: &Case) -> f64 {
    let film = matches!(case.surface, SurfaceCase::Film { .. });
    let packed = [
        (film, NPZ_OF_A_FILM),
        (case.surface.map().is_some(), NPZ_OF_A_SURFACE),
        (case.indenter.map().is_some(), NPZ_OF_AN_INDENTER),
    ];
    let packed = packed.into_iter().filter(|(is, _)| *is);
    let npz = packed.fold(NPZ, |bytes, (_, more)| bytes + more);
    let bytes = case.output.formats.iter().map(|format| match format {
        Format::Npz => npz,
        Format::Vti => VTI,
        Format::Nc => NC,
        Format::Gsf => GSF,
    });
    bytes.fold(0.0, |sum, bytes| sum + bytes)
}

fn of_a_step(case: &Case) -> f64 {
    let side = (case.grid.elements as f64).min(1024.0);
    let pressure = PICTURES * (side / 64.0).powf(GROWTH);
    pressure + field_maps(case) * (FIELD_MAP + FIELD_MAP_CELL * cells(case))
}

fn of_a_step_in_report(case: &Case) -> f64 {
    let side = (case.grid.elements as f64).min(1024.0);
    REPORT + REPORT_SIDE * side + field_maps(case) * REPORT_CELL * cells(case)
}

fn of_the_run(case: &Case, pictures: bool) -> f64 {
    let has_curve = case.steps() > 1;
    let has_grids = case.grid.elements >= MIN_ELEMENTS_OF_SEVERAL_GRIDS;
    let curve = f64::from(u8::from(pictures && has_curve)) * CURVE;
    curve + f64::from(u8::from(pictures && has_grids)) * CONVERGENCE
}

/// Number of maps of fields other than the pressure.
fn field_maps(case: &Case) -> f64 {
    match (case.surface.map(), case.indenter.map()) {
        (Some(_), _) => 3.0,
        (None, Some(_)) => 2.0,
        (None, None) => 0.0,
    }
}

/// Largest number of cells of a map.
fn cells(case: &Case) -> f64 {
    (case.grid.elements.min(CELLS) as f64).powi(2)
}
