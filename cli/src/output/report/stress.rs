//! The stresses of a loading step in the report: the extremes in each body and on each interface.

use pellicle::display::{Unit, error_of, position, quantity, significant};
use pellicle::input::units::Units;
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
        let utilisation = body.utilisation;
        let yielding = used(utilisation.yielding, "yield");
        let tension = used(utilisation.tension, "tensile");
        let none = String::new;
        let rows = [
            ("largest von Mises stress", body.max_von_mises, yielding),
            ("largest principal stress", body.max_principal, tension),
            ("least principal stress", body.min_principal, none()),
            ("largest shear", body.max_shear, none()),
        ];
        self.of_place(&body.name, rows)
    }

    /// The rows of the tractions wanted on an interface, the first with its name.
    fn of_interface(&self, interface: &InterfaceStress) -> Vec<StressRow> {
        let depth = quantity(interface.depth, Unit::Metre, self.units);
        let place = format!("interface {}, {depth} deep", interface.index);
        let utilisation = interface.utilisation;
        let (shear, tension) = (
            used(utilisation.shear, "shear"),
            used(utilisation.tension, "tensile"),
        );
        let traction = interface.max_shear_traction;
        let rows = [
            ("largest shear traction", traction, shear),
            ("largest tension", interface.max_tension, tension),
            (
                "largest compression",
                interface.max_compression,
                String::new(),
            ),
        ];
        self.of_place(&place, rows)
    }

    fn of_place<const AXES: usize, const ROWS: usize>(
        &self,
        place: &str,
        rows: [(&'static str, Option<Extreme<AXES>>, String); ROWS],
    ) -> Vec<StressRow> {
        let wanted = rows.into_iter();
        let wanted = wanted.filter_map(|(name, extreme, used)| Some((name, extreme?, used)));
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

/// `0.34 of the yield strength`
fn used(ratio: Option<f64>, strength: &str) -> String {
    let words = |ratio| format!("{} of the {strength} strength", significant(ratio, 3));
    ratio.map_or_else(String::new, words)
}

#[cfg(test)]
mod tests {
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
        assert_eq!(used(Some(0.3371), "yield"), "0.337 of the yield strength");
        assert_eq!(used(None, "yield"), "");
    }
}
