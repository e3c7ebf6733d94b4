//! Warnings about the maps of a case.

use pellicle_contact::IndenterMap;
use pellicle_texture::{MeanPlane, RimStep};

use super::CaseWarning;
use crate::case::Case;
use crate::case::grid::BoundaryCase;
use crate::case::map::MapCase;
use crate::display::{Unit, quantity, significant};
use crate::input::units::Units;

/// A tenth of a nanometre on a side of a centimetre; the heights of every measured surface have a larger range.
const FLAT: f64 = 1e-8;

/// Maps of heights have smaller sides, m; most are below a tenth of it.
const LARGE: f64 = 1e-2;

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

/// The largest distance of printed coordinates from a grid, in spacings, that is not told.
const OFF_BY_ROUNDING: f64 = 0.01;

/// Ratio of the sides of a pixel from which they are compared with exchanged ones.
const OBLONG: f64 = 1.5;

/// Ratio up to which a pixel is square; sides have a few digits.
const SQUARE: f64 = 1.05;

/// The warnings about the maps of a case, on a domain of this side (m).
pub(super) fn of(case: &Case, side: f64) -> Vec<CaseWarning> {
    let element_side = side / case.grid.elements as f64;
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
        upside_down(case).into_iter().collect(),
        of_kind(&of_depths),
        of_kind(&filled),
        of_kind(&perhaps_holes),
        of_kind(&off_grid),
        of_kind(&|table, map| oblong_pixels(table, map, case.units)),
        of_kind(&|table, map| {
            in_metres(table, map, side, case.units).or_else(|| flat(table, map, case.units))
        }),
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

/// The warning about the map of a tip that points upwards. One of a whole cell has no corners.
fn upside_down(case: &Case) -> Option<CaseWarning> {
    let map = case.indenter.map()?;
    let is_free = case.grid.boundary == BoundaryCase::Free;
    (is_free && IndenterMap::new(map.own().clone()).is_dome()).then(|| CaseWarning {
        code: "upside-down",
        message: format!(
            "the map of the indenter, {}, falls towards its ends along x and along y, so its corners press: a tip scanned pointing upwards needs a negative indenter.height_unit, such as \"-1 nm\"",
            map.file
        ),
    })
}

/// The warning about depths that are taken as heights.
fn of_depths(table: &str, map: &MapCase) -> Option<CaseWarning> {
    map.has_upward_depths.then(|| CaseWarning {
        code: "map-of-depths",
        message: format!(
            "the heights of the {table}'s map, {}, are named depths in it and taken as heights, upwards: if they count downwards, give a negative height_unit, such as \"-1 um\"",
            map.file
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

/// The warning about a value that may stand for missing heights.
fn perhaps_holes(table: &str, map: &MapCase) -> Option<CaseWarning> {
    map.perhaps_holes.map(|code| CaseWarning {
        code: "map-perhaps-holes",
        message: format!(
            "of the heights of the {table}'s map, {}, {code}: write nan for them if they are holes, and give holes = \"none\" if they are heights",
            map.file
        ),
    })
}

/// The warning about points that were taken onto a grid.
fn off_grid(table: &str, map: &MapCase) -> Option<CaseWarning> {
    (map.off_grid > OFF_BY_ROUNDING).then(|| CaseWarning {
        code: "points-off-grid",
        message: format!(
            "the points of the {table}'s map, {}, are up to {} spacings off a rectangular grid, onto which they are taken",
            map.file,
            significant(map.off_grid, 2)
        ),
    })
}

/// The warning about sides that would make the pixels square if they were exchanged, or if lines were not missing.
fn oblong_pixels(table: &str, map: &MapCase, units: Units) -> Option<CaseWarning> {
    let ([x, y], shape) = (map.sides, map.shape());
    let [along_x, along_y] = shape.map(|samples| samples as f64);
    let ratio = |[x, y]: [f64; 2]| (x / y).max(y / x);
    let pixel = [x / along_x, y / along_y];
    let is_exchanged = ratio(pixel) > OBLONG && ratio([y / along_x, x / along_y]) <= SQUARE;
    let metres = |value| quantity(value, Unit::Metre, units);
    let [x, y] = [x, y].map(metres);
    let doubt = match () {
        () if is_exchanged => format!(
            "which would be square on {y} by {x}: are the sides exchanged, or the axes of the map?"
        ),
        () if map.may_be_cut && pixel[1] > SQUARE * pixel[0] => {
            "by the size that its head states: are lines missing?".into()
        }
        () => return None,
    };
    Some(CaseWarning {
        code: "oblong-pixels",
        message: format!(
            "the map of the {table}, {}, has {} samples on {x} along x and {} on {y} along y, pixels of {} by {}, {doubt}",
            map.file,
            shape[0],
            shape[1],
            metres(pixel[0]),
            metres(pixel[1]),
        ),
    })
}

/// The warning about a file without a unit, taken as metres, where that makes the map large or flat, or the whole
/// domain smaller than its pixels.
fn in_metres(table: &str, map: &MapCase, side: f64, units: Units) -> Option<CaseWarning> {
    let is_large = map.sides.into_iter().any(|side| side > LARGE);
    let is_absurd = is_large || map.pixel() > side || is_flat(map);
    let metres = |value| quantity(value, Unit::Metre, units);
    let [x, y] = map.sides.map(metres);
    (map.has_bare_sides && units == Units::Si && is_absurd).then(|| CaseWarning {
        code: "map-in-metres",
        message: format!(
            "the map of the {table}, {}, names no unit of x and y, which are taken as metres, {x} by {y}: `lateral_unit` gives the unit, or `side` the length along x",
            map.file
        ),
    })
}

/// The warning about a flat map, or an almost flat one; its unit is probably a thousand times too small.
fn flat(table: &str, map: &MapCase, units: Units) -> Option<CaseWarning> {
    let range = range(map);
    let doubt = match () {
        () if is_flat(map) => {
            let range = quantity(range, Unit::Metre, units);
            format!("range over {range} only: is height_unit right?")
        }
        () if range <= 0.0 => "are all equal: is it the right file?".into(),
        () => return None,
    };
    Some(CaseWarning {
        code: "flat-map",
        message: format!("the heights of the {table}'s map, {}, {doubt}", map.file),
    })
}

fn is_flat(map: &MapCase) -> bool {
    let ([x, y], range) = (map.sides, range(map));
    range > 0.0 && range < FLAT * x.min(y)
}

/// The highest less the lowest height, m.
fn range(map: &MapCase) -> f64 {
    let samples = map.samples().iter().copied();
    let least = samples.clone().fold(f64::INFINITY, f64::min);
    samples.fold(f64::NEG_INFINITY, f64::max) - least
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
