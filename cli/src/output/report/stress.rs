//! The stresses of a loading step in the report: the extremes in each body and on each interface.

use pellicle::display::{Unit, error_of, position, quantity, significant};
use pellicle::input::units::Units;
use pellicle::result::extremes::{Limit, OF_BODIES, OF_INTERFACES};
use pellicle::summary::{RunSummary, StressSummary};
use pellicle_contact::{BodyStress, Extreme, InterfaceStress};

use super::grid_error::GridErrorNote;

/// The table of the extremes.
pub struct StressTable {
    /// Sliding in words; none without friction.
    pub sliding: Option<String>,
    pub rows: Vec<StressRow>,
}

/// An extreme.
pub struct StressRow {
    /// The body or interface; empty if it is that of the row above.
    pub place: String,
    pub name: &'static str,
    pub value: String,
    /// Its coordinates.
    pub at: String,
    pub error: GridErrorNote,
    /// The utilisation of the strength; empty if there is no strength.
    pub used: String,
}

impl StressTable {
    pub fn new(stress: &StressSummary, run: &RunSummary) -> Self {
        let rows = StressRows {
            element_side: run.grid.element_side,
            units: run.units,
        };
        let bodies = stress.extremes.bodies.iter();
        let bodies = bodies.flat_map(|body| rows.of_body(body));
        let interfaces = stress.extremes.interfaces.iter();
        let interfaces = interfaces.flat_map(|interface| rows.of_interface(interface));
        let friction = (stress.friction, stress.direction_degrees);
        Self {
            sliding: (stress.friction > 0.0).then(|| {
                let [friction, degrees] =
                    [friction.0, friction.1].map(|value| significant(value, 3));
                format!(
                    "sliding with a coefficient of friction {friction} along {degrees}° from x to y"
                )
            }),
            rows: bodies.chain(interfaces).collect(),
        }
    }
}

/// The rows of a run.
struct StressRows {
    /// Side of an element, m.
    element_side: f64,
    units: Units,
}

impl StressRows {
    /// The rows of the stresses wanted in a body, the first with its name.
    fn of_body(&self, body: &BodyStress) -> Vec<StressRow> {
        let rows = OF_BODIES.iter().filter_map(|of| {
            let used = used(of.limit, &body.utilisation);
            Some((of.name, (of.value)(body)?, used))
        });
        self.of_place(&body.name, rows)
    }

    /// The rows of the tractions wanted on an interface, the first with its name.
    fn of_interface(&self, interface: &InterfaceStress) -> Vec<StressRow> {
        let depth = quantity(interface.depth, Unit::Metre, self.units);
        let body =
            (interface.name.rsplit_once('.')).map_or(String::new(), |(body, _)| format!("{body} "));
        let place = format!("{body}interface {}, {depth} deep", interface.index);
        let rows = OF_INTERFACES.iter().filter_map(|of| {
            let used = used(of.limit, &interface.utilisation);
            Some((of.name, (of.value)(interface)?, used))
        });
        self.of_place(&place, rows)
    }

    fn of_place<const AXES: usize>(
        &self,
        place: &str,
        wanted: impl Iterator<Item = (&'static str, Extreme<AXES>, String)>,
    ) -> Vec<StressRow> {
        let rows = wanted
            .enumerate()
            .map(|(i, (name, extreme, used))| StressRow {
                place: if i == 0 {
                    place.to_owned()
                } else {
                    String::new()
                },
                used,
                ..self.row(name, &extreme)
            });
        rows.collect()
    }

    fn row<const AXES: usize>(&self, name: &'static str, extreme: &Extreme<AXES>) -> StressRow {
        let value = extreme.value;
        StressRow {
            place: String::new(),
            name,
            value: quantity(value, Unit::Pascal, self.units),
            at: if value == 0.0 {
                String::new()
            } else {
                position(extreme.at, self.element_side, self.units)
            },
            error: match extreme.estimate {
                _ if value == 0.0 => GridErrorNote::NotEstimated,
                _ if !extreme.resolved => GridErrorNote::NotResolved,
                Some(error) => {
                    GridErrorNote::Estimated(error_of(value, error, Unit::Pascal, self.units))
                }
                None => GridErrorNote::OneGrid,
            },
            used: String::new(),
        }
    }
}

/// `0.34 of the yield strength`; nothing if no strength limits it, or none is given.
fn used<U>(limit: Option<Limit<U>>, utilisation: &U) -> String {
    let used = |limit: Limit<U>| Some((limit.strength, (limit.used)(utilisation)?));
    let words = |(strength, ratio)| format!("{} of the {strength} strength", significant(ratio, 3));
    limit.and_then(used).map_or_else(String::new, words)
}

#[cfg(test)]
mod tests {
    use pellicle_contact::BodyUtilisation;

    use super::*;

    #[test]
    fn an_extreme_states_its_grid_error() {
        let note = |resolved, estimate, value| {
            let extreme = Extreme {
                value,
                at: [-1e-11, 1e-6],
                resolved,
                estimate,
            };
            let rows = StressRows {
                element_side: 1e-7,
                units: Units::Si,
            };
            rows.row("largest tension", &extreme)
        };
        let good = note(true, Some(2e6), 1e9);
        assert_eq!(good.at, "0 m, 1.0000 µm");
        let GridErrorNote::Estimated(error) = good.error else {
            unreachable!("it is resolved")
        };
        assert_eq!(error, "± 0.0020 GPa");
        assert_eq!(
            note(false, Some(2e6), 1e9).error,
            GridErrorNote::NotResolved
        );
        assert_eq!(note(true, None, 1e9).error, GridErrorNote::OneGrid);
        let nothing = note(true, None, 0.0);
        assert_eq!(
            (&nothing.at[..], nothing.error),
            ("", GridErrorNote::NotEstimated)
        );
    }

    #[test]
    fn a_strength_is_reported_by_its_utilisation() {
        let limit = OF_BODIES[0].limit;
        let given = BodyUtilisation {
            yielding: Some(0.3371),
            ..BodyUtilisation::default()
        };
        assert_eq!(used(limit, &given), "0.337 of the yield strength");
        assert_eq!(used(limit, &BodyUtilisation::default()), "");
        assert_eq!(used(None, &given), "");
    }
}
