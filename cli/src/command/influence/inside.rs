//! Displacements and stresses inside the body under one loaded element.

use pellicle::case::foundation::FoundationCase;
use pellicle::input::units::Units;
use pellicle_influence::{ElementFields, SubsurfaceState};
use pellicle_kernel::Foundation;
use serde::{Serialize, Serializer};

use crate::arguments::InfluenceArguments;
use crate::failure::Failure;
use crate::output::stress::FIELDS;

/// The states at one offset and depth.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct ElementRow {
    /// Elements along x and y from the loaded one.
    offset: [isize; 2],
    /// Depth below the surface, m.
    depth: f64,
    /// The body to which a point on an interface belongs.
    side: &'static str,
    /// Side of an element, m.
    element_side: f64,
    /// Under a unit pressure.
    normal: StateRow,
    /// Under a unit traction along +x.
    tangential: StateRow,
}

/// Displacements, m/Pa, and stresses, per unit load; null where unbounded.
#[derive(Debug, Clone, Copy)]
struct StateRow([f64; 9]);

impl Serialize for StateRow {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(FIELDS.iter().map(|field| field.name).zip(self.0))
    }
}

/// Returns the rows of all offsets at all depths; on an interface, the rows above it precede those below.
pub fn rows(
    foundation: &Foundation,
    case: &FoundationCase,
    element_side: f64,
    arguments: &InfluenceArguments,
) -> Result<Vec<ElementRow>, Failure> {
    let offsets = &arguments.offsets;
    let distance = |[m, n]: [isize; 2]| (m as f64).hypot(n as f64) * element_side;
    let farthest = offsets.iter().map(|offset| distance(*offset));
    let farthest = farthest.fold(0.0, f64::max);
    let mut rows = Vec::new();
    for depth in &arguments.depths {
        for plane in case.planes(foundation, *depth) {
            let fields = ElementFields::new(foundation, element_side, plane.depth, farthest)
                .map_err(Failure::Inside)?;
            rows.extend(offsets.iter().map(|offset| {
                let loads = fields.at(offset.map(|along| along as f64 * element_side));
                ElementRow {
                    offset: *offset,
                    depth: *depth,
                    side: plane.side(),
                    element_side,
                    normal: loads.normal.into(),
                    tangential: loads.tangential.into(),
                }
            }));
        }
    }
    Ok(rows)
}

impl From<SubsurfaceState> for StateRow {
    fn from(state: SubsurfaceState) -> Self {
        Self(std::array::from_fn(|index| state.field(index)))
    }
}

/// Formats the rows as a table, two lines each.
pub fn table(rows: &[ElementRow], units: Units) -> String {
    let (metre, metre_per_pascal) = (units.name("m"), units.name("m/Pa"));
    let element_side = rows.first().map_or(f64::NAN, |row| row.element_side);
    let names = FIELDS[..9]
        .iter()
        .map(|field| format!("{:>13}", field.name));
    let names: String = names.collect();
    let line = |row: &ElementRow, load: &str, state: &StateRow| {
        let values = state.0.map(|value| format!("{value:>13.4e}")).concat();
        let ([m, n], depth, side) = (row.offset, row.depth, row.side);
        format!("{m:>6}{n:>6}{depth:>14e} {side:<6}{load:>11}{values}\n")
    };
    let lines = rows
        .iter()
        .map(|row| line(row, "normal", &row.normal) + &line(row, "tangential", &row.tangential));
    let lines: String = lines.collect();
    format!(
        "element side {element_side:e} {metre}; displacements in {metre_per_pascal}, stresses per unit load\n\
         {:>6}{:>6}{:>14} {:<6}{:>11}{names}\n{lines}",
        "m",
        "n",
        format!("depth [{metre}]"),
        "side",
        "load"
    )
}
