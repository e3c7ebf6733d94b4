//! The numbers of a loading step.
//!
//! One line declares a number for the terminal, `curve.csv`, the table of a study, the pages, `summary.json` and its
//! schema, the Python package and the documents. Its value comes from the [`StepSummary`]; a number that a
//! [`Summary`](pellicle_contact::Summary) of the contact has is there already.

use super::quantity::{Measure, Part, Quantity, Value};
use crate::display::Unit;
use crate::summary::{RunSummary, StepSummary};

/// Declares the numbers, each as `key "name" "symbol" unit, part "meaning" = value, within error`.
macro_rules! quantities {
    ($($key:literal $name:literal $symbol:literal $measure:expr, $part:ident $meaning:literal
        = $value:expr $(, within $error:expr)?;)+) => {
        /// The numbers of a loading step, in the order in which they are shown.
        pub const QUANTITIES: &[Quantity] = &[$(Quantity {
            key: $key,
            name: $name,
            symbol: $symbol,
            measure: $measure,
            part: Part::$part,
            meaning: $meaning,
            value: |step| {
                let value: fn(&StepSummary) -> Option<_> = $value;
                value(step).map(Value::from)
            },
            error: quantities!(@error $($error)?),
        },)+];
    };
    (@error) => { None };
    (@error $error:expr) => { Some($error) };
}

const METRE: Measure = Measure::Of(Unit::Metre);
const AREA: Measure = Measure::Of(Unit::SquareMetre);
const VOLUME: Measure = Measure::Of(Unit::CubicMetre);
const PASCAL: Measure = Measure::Of(Unit::Pascal);
const NEWTON: Measure = Measure::Of(Unit::Newton);
const STIFFNESS: Measure = Measure::Of(Unit::NewtonPerMetre);
const RATIO: Measure = Measure::Ratio;
const COUNT: Measure = Measure::Count;
const TRUTH: Measure = Measure::Truth;
const PLACE: Measure = Measure::Place;

#[rustfmt::skip]
quantities! {
    "force" "force" "Q" NEWTON, Contact
        "force on the indenter, or on one periodic cell"
        = |step| Some(step.force), within |error| error.force;
    "penetration" "penetration" "D" METRE, Contact
        "depth of the indenter's lowest point below the highest point of the undeformed surface"
        = |step| Some(step.penetration), within |error| error.penetration;
    "max_pressure" "max pressure" "" PASCAL, Contact
        "largest pressure, interpolated between elements where it is smooth, at an edge that of the element"
        = |step| Some(step.summary.max_pressure), within |error| error.max_pressure;
    "max_pressure_at" "max pressure at" "x, y" PLACE, Contact
        "where the pressure is largest, the first of several equal places"
        = |step| Some(step.summary.max_pressure_at);
    "max_averaged_pressure" "max averaged pressure" "" PASCAL, Averaged
        "largest pressure averaged over a disc as wide as mean_pressure_over"
        = |step| step.summary.max_averaged_pressure, within |error| error.max_averaged_pressure;
    "mean_pressure" "mean pressure" "" PASCAL, Contact
        "force over contact area, never above the largest pressure; 0 without contact"
        = |step| Some(step.summary.mean_pressure);
    "nominal_pressure" "nominal pressure" "" PASCAL, Nominal
        "force over a periodic cell, or over the nominal area of a measured surface"
        = |step| step.summary.nominal_pressure;
    "contact_area" "contact area" "" AREA, Contact
        "true contact area, its edge located within an element by pressure and gap"
        = |step| Some(step.summary.contact_area), within |error| error.contact_area;
    "contact_area_on_relief" "contact area on relief" "" AREA, Relief
        "contact area on the tops of the relief"
        = |step| Some(step.summary.contact_area_on_relief);
    "contact_area_between" "contact area between" "" AREA, Relief
        "contact area between the tops of the relief"
        = |step| Some(step.summary.contact_area_between);
    "contact_radius" "contact radius" "" METRE, Contact
        "distance from the axis to the farthest point of the contact's edge; 0 without contact"
        = |step| Some(step.summary.contact_radius);
    "contact_elements" "contact elements" "" COUNT, Contact
        "elements that carry pressure"
        = |step| Some(step.summary.contact_elements);
    "contact_stiffness" "contact stiffness" "dQ/dD" STIFFNESS, Touching
        "change of the force with the penetration, for the elements in contact"
        = |step| step.contact_stiffness;
    "area_at_limit" "area at hardness" "" AREA, Hardness
        "area of the elements whose pressure is cut at the hardness"
        = |step| step.summary.area_at_limit;
    "fraction_at_limit" "area fraction at hardness" "" RATIO, Hardness
        "this area over the contact area; 0 without contact"
        = |step| step.summary.fraction_at_limit;
    "plastic_depth" "plastic depth" "" METRE, Hardness
        "largest depth of the indenter below the elastic surface where the pressure is cut at the hardness"
        = |step| step.summary.plastic_depth;
    "wear.distance" "sliding distance" "s" METRE, Wear
        "sliding distance over which the surface has worn"
        = |step| Some(step.wear.as_ref()?.distance);
    "wear.volume" "worn volume" "" VOLUME, Wear
        "volume that the surface has lost, on one periodic cell"
        = |step| Some(step.wear.as_ref()?.volume);
    "wear.max_depth" "depth of wear" "" METRE, Wear
        "largest depth that the surface has lost"
        = |step| Some(step.wear.as_ref()?.max_depth);
    "rough_contact.nominal_area" "nominal area" "" AREA, Rough
        "area of the periodic cell, or of the convex hull of the contact"
        = |step| Some(step.rough_contact.as_ref()?.nominal_area);
    "rough_contact.contact_fraction" "contact fraction" "" RATIO, Rough
        "contact area over nominal area"
        = |step| Some(step.rough_contact.as_ref()?.contact_fraction);
    "rough_contact.counted_area" "counted contact area" "" AREA, Rough
        "area of the elements in contact"
        = |step| Some(step.rough_contact.as_ref()?.counted_area);
    "rough_contact.corrected_area" "corrected contact area" "" AREA, Rough
        "the same less the excess along the perimeter, by Yastrebov, Anciaux and Molinari"
        = |step| Some(step.rough_contact.as_ref()?.corrected_area);
    "rough_contact.perimeter" "perimeter" "" METRE, Rough
        "length of the sides between elements in contact and others"
        = |step| Some(step.rough_contact.as_ref()?.perimeter);
    "rough_contact.mean_gap" "mean gap" "" METRE, Rough
        "gap averaged over the nominal area, 0 in contact"
        = |step| Some(step.rough_contact.as_ref()?.mean_gap);
    "rough_contact.islands.count" "islands" "" COUNT, Rough
        "connected regions of contact"
        = |step| Some(step.rough_contact.as_ref()?.islands.count);
    "rough_contact.islands.largest_area" "largest island" "" AREA, Rough
        "area of the largest of them"
        = |step| Some(step.rough_contact.as_ref()?.islands.largest_area);
    "area_law.reduced_pressure" "reduced pressure" "p*" RATIO, Rough
        "nominal pressure over E* times the rms slope of the measured surface, the other surface being smooth"
        = |step| Some(step.area_law.as_ref()?.reduced_pressure);
    "area_law.kappa" "kappa" "κ" RATIO, Rough
        "contact fraction over reduced pressure; for light loads √(8/π) by Persson, √(2π) by Bush, Gibson and Thomas"
        = |step| Some(step.area_law.as_ref()?.kappa);
    "certificate.worst" "certificate worst" "" RATIO, Solution
        "largest dimensionless line of the certificate"
        = |step| Some(step.certificate.worst);
    "certificate.satisfied" "certificate satisfied" "" TRUTH, Solution
        "whether every line keeps to the tolerance and every pressure to its bounds"
        = |step| Some(step.certificate.satisfied);
    "work.operator_applications" "operator applications" "" COUNT, Solution
        "products with the matrix K on the finest grid"
        = |step| Some(step.work.operator_applications);
}

/// The numbers in the table of a curve for human readers, or of a body that wears.
#[must_use]
pub fn of_a_curve(run: &RunSummary) -> Vec<&'static Quantity> {
    let keys = if run.steps.iter().any(|step| step.wear.is_some()) {
        [
            "wear.distance",
            "wear.max_depth",
            "max_pressure",
            "contact_area",
        ]
    } else {
        ["force", "penetration", "max_pressure", "contact_area"]
    };
    keys.into_iter().filter_map(of_key).collect()
}

/// The number with this key.
#[must_use]
pub fn of_key(key: &str) -> Option<&'static Quantity> {
    QUANTITIES.iter().find(|quantity| quantity.key == key)
}
