//! Warnings about the maps of a case.

use pellicle_texture::{MeanPlane, RimStep};

use super::CaseWarning;
use crate::case::Case;
use crate::case::grid::BoundaryCase;
use crate::case::map::MapCase;
use crate::display::{Unit, quantity, significant};
use crate::input::units::Units;

/// A tenth of a nanometre on a side of a centimetre; the heights of every measured surface have a larger range.
const FLAT: f64 = 1e-8;

/// Rise of the least-squares plane across a map over the rms height above it with which a map counts as tilted. Of 600
/// level scans cut out of larger self-affine surfaces, with Hurst exponents of 0.5 to 1, none had more than 19.
const TILTED: f64 = 20.0;

/// The same for a map whose end cuts off the contact: its tilt is named.
const TILTED_AT_THE_END: f64 = 2.0;

/// Step across the rim over the largest step inside with which opposite edges of a map do not fit. Of 600 self-affine
/// surfaces that repeat, with Hurst exponents of 0.5 to 1 and waves down to two samples, none had more than 1.1; of 600
/// cut out of larger ones, none less than 1.4.
const DOES_NOT_FIT: f64 = 1.3;

/// A step across the rim smaller than this part of the rms height is of no account: heights have a few digits.
const LEAST_STEP: f64 = 1e-3;

/// The warnings about the maps of a case, on elements of this side (m).
pub(super) fn of(case: &Case, element_side: f64) -> Vec<CaseWarning> {
    let maps = [
        ("surface", case.surface.map()),
        ("indenter", case.indenter.map()),
    ];
    let maps = maps
        .into_iter()
        .filter_map(|(table, map)| Some((table, map?)));
    let of_kind = |warn: &dyn Fn(&str, &MapCase) -> Option<CaseWarning>| -> Vec<_> {
        let found = maps.clone().filter_map(|(table, map)| warn(table, map));
        found.collect()
    };
    let fitting = |table: &str, map: &MapCase| match case.grid.boundary {
        BoundaryCase::Free => tilted(table, map),
        BoundaryCase::Periodic => not_periodic(table, map, case.units),
    };
    [
        of_kind(&|table, map| coarse(table, map, element_side, case.units)),
        of_kind(&|table, map| filled(table, map)),
        of_kind(&|table, map| flat(table, map, case.units)),
        of_kind(&fitting),
    ]
    .concat()
}

/// The warning about a map whose pixels are larger than the elements, so that more elements resolve no more of the
/// surface.
fn coarse(table: &str, map: &MapCase, element_side: f64, units: Units) -> Option<CaseWarning> {
    let pixel = map.pixel();
    let metres = |value| quantity(value, Unit::Metre, units);
    // A map sampled on the grid itself has pixels as large as the elements, up to rounding.
    (pixel > element_side * (1.0 + 1e-9)).then(|| CaseWarning {
        code: "coarse-map",
        message: format!(
            "the map of the {table}, {}, has a sample every {}, farther apart than elements of {}: heights in between are interpolated",
            map.file,
            metres(pixel),
            metres(element_side)
        ),
    })
}

/// The warning about heights that are missing.
fn filled(table: &str, map: &MapCase) -> Option<CaseWarning> {
    let (missing, all) = (map.missing, map.samples().len());
    (missing > 0).then(|| CaseWarning {
        code: "map-holes",
        message: format!(
            "{missing} of {all} heights are missing in the map of the {table}, {}: each is the mean of its neighbours",
            map.file
        ),
    })
}

/// The warning about an almost flat map; its unit is probably a thousand times too small.
fn flat(table: &str, map: &MapCase, units: Units) -> Option<CaseWarning> {
    let samples = map.samples().iter().copied();
    let least = samples.clone().fold(f64::INFINITY, f64::min);
    let range = samples.fold(f64::NEG_INFINITY, f64::max) - least;
    let [x, y] = map.sides;
    (range > 0.0 && range < FLAT * x.min(y)).then(|| CaseWarning {
        code: "flat-map",
        message: format!(
            "the heights of the {table}'s map, {}, range over {} only: is height_unit right?",
            map.file,
            quantity(range, Unit::Metre, units)
        ),
    })
}

/// The warning about a free map whose tilt decides where it touches.
fn tilted(table: &str, map: &MapCase) -> Option<CaseWarning> {
    let tilt = Tilt::of(map);
    (tilt.times >= TILTED).then(|| CaseWarning {
        code: "tilted-map",
        message: format!(
            "the map of the {table}, {}, is tilted by {}, which decides where it touches: `level = \"plane\"` subtracts the tilt",
            map.file,
            tilt.words()
        ),
    })
}

/// The warning about a map in a periodic cell that does not continue periodically.
fn not_periodic(table: &str, map: &MapCase, units: Units) -> Option<CaseWarning> {
    let steps = RimStep::of(map.own());
    let rms_height = MeanPlane::of(map.own()).rms_height_above(map.own());
    let does_not_fit = |step: &RimStep| {
        step.across > DOES_NOT_FIT * step.inside && step.across > LEAST_STEP * rms_height
    };
    if !steps.iter().any(does_not_fit) {
        return None;
    }
    let metres = |value| quantity(value, Unit::Metre, units);
    let [x, y] = steps.map(|step| [step.across, step.inside].map(metres));
    let tilt = Tilt::of(map);
    let tilted = if tilt.times >= TILTED {
        format!(
            "; the map is tilted by {}, which `level = \"plane\"` subtracts",
            tilt.words()
        )
    } else {
        String::new()
    };
    Some(CaseWarning {
        code: "not-periodic-map",
        message: format!(
            "the map of the {table}, {}, does not continue periodically: the step across its rim is {} rms along x and {} along y, that between neighbouring lines of samples inside at most {} and {}; the wall at the rim carries load{tilted}. `edges = \"taper\"` makes opposite edges fit, and `grid.boundary = \"free\"` under an indenter of finite size needs no fit",
            map.file, x[0], y[0], x[1], y[1]
        ),
    })
}

/// What a tilt has to do with a contact that the end of this map cuts off; empty if nothing.
pub(super) fn tilt_of_cut_off(map: Option<&MapCase>) -> String {
    let tilt = map.map(Tilt::of);
    // A larger tilt has a warning of its own.
    let tilt = tilt.filter(|tilt| (TILTED_AT_THE_END..TILTED).contains(&tilt.times));
    tilt.map_or_else(String::new, |tilt| {
        format!(
            "; the map is tilted by {}, which `level = \"plane\"` subtracts",
            tilt.words()
        )
    })
}

/// A map that rises by more rms heights is a plane up to rounding.
const MOST_TIMES: f64 = 1e4;

/// The tilt of a map.
struct Tilt {
    /// Rise over length.
    slope: f64,
    /// Rise across the map over the rms height above the plane.
    times: f64,
}

impl Tilt {
    fn of(map: &MapCase) -> Self {
        let plane = MeanPlane::of(map.own());
        let above = plane.rms_height_above(map.own());
        Self {
            slope: plane.steepest(),
            times: if plane.rise() > 0.0 {
                plane.rise() / above
            } else {
                0.0
            },
        }
    }

    /// `0.10 (5.7 degrees), 54 times its rms height across the map`
    fn words(&self) -> String {
        let degrees = significant(self.slope.atan().to_degrees(), 2);
        let slope = significant(self.slope, 2);
        let rise = if self.times < MOST_TIMES {
            format!("{:.0} times its rms height across the map", self.times)
        } else {
            "nearly all of its height".into()
        };
        format!("{slope} ({degrees} degrees), {rise}")
    }
}
