//! Stresses and critical loads in words.

use pellicle::case::stressed_body::StressedBody;
use pellicle::display::{Unit, error_of, position, quantity, settled, significant};
use pellicle::input::units::Units;
use pellicle::result::extremes::{OF_BODIES, OF_INTERFACES};
use pellicle::summary::{RunSummary, StressSummary};
use pellicle_contact::{Criterion, CriticalLoad, CriticalStatus, Extreme};

use super::columns::TextColumns;

impl TextColumns {
    /// Adds the largest stresses in each body and on each interface: of those wanted, the ones that strengths limit.
    pub(super) fn stresses(&mut self, stress: &StressSummary) {
        for body in &stress.extremes.bodies {
            let limited = OF_BODIES.iter().filter_map(|of| {
                let limit = of.limit?;
                let used = (limit.used)(&body.utilisation);
                Some((of.name, (of.value)(body)?, limit.strength, used))
            });
            self.limited(&format!("stress in {}", body.name), limited);
        }
        for interface in &stress.extremes.interfaces {
            let limited = OF_INTERFACES.iter().filter_map(|of| {
                let limit = of.limit?;
                let used = (limit.used)(&interface.utilisation);
                Some((of.name, (of.value)(interface)?, limit.strength, used))
            });
            let is_of_indenter = (interface.name).starts_with(StressedBody::Indenter.prefix());
            let of = if is_of_indenter {
                " of the indenter"
            } else {
                ""
            };
            self.limited(
                &format!("stress on interface {}{of}", interface.index),
                limited,
            );
        }
    }

    /// Adds the extremes of a body or an interface, each with a strength and the part of it that is used.
    fn limited<'a, const AXES: usize>(
        &mut self,
        place: &str,
        extremes: impl Iterator<Item = (&'a str, Extreme<AXES>, &'a str, Option<f64>)>,
    ) {
        for (i, (name, extreme, strength, used)) in extremes.enumerate() {
            if i == 0 {
                self.push(place, "", "");
            }
            self.extreme(&format!("  {name}"), extreme);
            self.used(strength, used);
        }
    }

    fn extreme<const AXES: usize>(&mut self, name: &str, extreme: Extreme<AXES>) {
        let (value, at) = (extreme.value, extreme.at);
        let note = match extreme.estimate {
            _ if !extreme.resolved => "not resolved by the grid".into(),
            Some(error) => format!(
                "{} (grid)",
                error_of(value, error, Unit::Pascal, self.units)
            ),
            None => String::new(),
        };
        self.push(name, &quantity(value, Unit::Pascal, self.units), &note);
        let axes = ["x", "y", "z"][..AXES].join(", ");
        self.position(&format!("    at {axes}"), at);
    }

    fn used(&mut self, strength: &str, ratio: Option<f64>) {
        if let Some(ratio) = ratio {
            let words = format!("{} of the {strength} strength", significant(ratio, 4));
            self.push("", &words, "");
        }
    }
}

/// Describes the critical loads, one sentence each, the smallest first; empty if none are requested.
#[must_use]
pub fn critical(summary: &RunSummary) -> String {
    let Some(critical) = &summary.critical else {
        return String::new();
    };
    let mut loads: Vec<_> = critical.iter().collect();
    let force = |load: &CriticalLoad| load.force.unwrap_or(f64::INFINITY);
    loads.sort_by(|one, other| force(one).total_cmp(&force(other)));
    let first = loads.first().filter(|load| load.force.is_some()).copied();
    let forces = summary.steps.iter().map(|step| step.force);
    let words = CriticalWords {
        layers: summary.layers(),
        largest_force: forces.fold(0.0, f64::max),
        element_side: summary.grid.element_side,
        units: summary.units,
    };
    let sentence = |load: &&CriticalLoad| {
        let is_first = Some(*load) == first && is_clearly_first(load, &loads);
        let sentence = match load.force {
            Some(force) => words.met(load, force, is_first),
            None => words.not_met(load),
        };
        format!("{sentence}\n")
    };
    loads.iter().map(sentence).collect()
}

/// Whether the interval of a load, the smallest of several, ends below those of all others.
fn is_clearly_first(load: &CriticalLoad, loads: &[&CriticalLoad]) -> bool {
    let interval = |load: &CriticalLoad| {
        let (force, error) = (load.force?, load.estimate.filter(|_| load.resolved)?);
        Some([force - error, force + error])
    };
    let Some([_, end]) = interval(load) else {
        return false;
    };
    let mut others = loads
        .iter()
        .filter(|other| **other != load && other.force.is_some());
    loads.len() > 1 && others.all(|other| interval(other).is_some_and(|[start, _]| end < start))
}

/// The sentences on the critical loads of a run.
struct CriticalWords {
    /// The number of layers; a single one is the coating.
    layers: usize,
    /// The largest force of the run, N.
    largest_force: f64,
    /// Side of an element, m.
    element_side: f64,
    units: Units,
}

impl CriticalWords {
    /// `the coating yields first at 3.2 mN ± 0.1 mN (grid), 0.48 µm below the surface on the axis`
    fn met(&self, load: &CriticalLoad, force: f64, is_first: bool) -> String {
        let (what, verb) = (place(&load.name, self.layers), verb(load.criterion));
        if load.status == CriticalStatus::AtRest {
            let ratio = significant(load.utilisation, 3);
            return format!(
                "{what} {verb} without any load: its residual stress alone is {ratio} of its strength"
            );
        }
        let first = if is_first { " first" } else { "" };
        let newtons = quantity(force, Unit::Newton, self.units);
        let note = match load.estimate {
            _ if !load.resolved => NOT_RESOLVED.to_owned(),
            Some(error) => {
                let error = error_of(force, error, Unit::Newton, self.units);
                format!(" {error} (grid)")
            }
            None => String::new(),
        };
        let depth = |at| depth(at, self.element_side, self.units);
        let at = load.at.map_or_else(String::new, depth);
        let beyond = match load.status {
            CriticalStatus::BeyondModel => BEYOND_MODEL,
            _ => "",
        };
        format!("{what} {verb}{first} at {newtons}{note}{at}{beyond}")
    }

    /// `the coating yields under no load up to 5 mN: 0.34 of its strength is reached`
    fn not_met(&self, load: &CriticalLoad) -> String {
        let (what, verb) = (place(&load.name, self.layers), verb(load.criterion));
        let when = match load.status {
            CriticalStatus::BelowSmallest => "already at the smallest load tried".to_owned(),
            CriticalStatus::AtRest
            | CriticalStatus::Met
            | CriticalStatus::BeyondModel
            | CriticalStatus::NotReached => {
                let largest = quantity(self.largest_force, Unit::Newton, self.units);
                format!("under no load up to {largest}")
            }
        };
        let ratio = significant(load.utilisation, 3);
        let note = if load.resolved { "" } else { NOT_RESOLVED };
        format!("{what} {verb} {when}: {ratio} of its strength is reached{note}")
    }
}

/// The note on a number that still changes from grid to grid.
const NOT_RESOLVED: &str = " (not resolved by the grid)";

/// The note on a load under which the contact is beyond the model.
const BEYOND_MODEL: &str = ": BEYOND THE MODEL, do not use this load: under it the contact has numbers that no body can have";

/// `, 0.48 µm below the surface at x, y = 0 m, 1.2 µm`
fn depth(at: [f64; 3], element_side: f64, units: Units) -> String {
    let [x, y, z] = settled(at, element_side);
    let depth = if z == 0.0 {
        "at the surface".to_owned()
    } else {
        format!("{} below the surface", quantity(z, Unit::Metre, units))
    };
    let at = position([x, y], element_side, units);
    format!(", {depth} at x, y = {at}")
}

/// Names a body or interface of a summary; a single layer is the coating.
fn place(name: &str, layers: usize) -> String {
    if let Some(name) = name.strip_prefix("indenter.") {
        return format!("{} of the indenter", place(name, layers));
    }
    let index = |prefix: &str| name.strip_prefix(prefix)?.strip_suffix(']');
    match (index("layer["), index("interface[")) {
        (Some(_), _) if layers == 1 => "the coating".into(),
        (Some(index), _) => format!("layer {index}"),
        (_, Some(_)) if layers == 1 => "the interface".into(),
        (_, Some(index)) => format!("interface {index}"),
        _ => format!("the {name}"),
    }
}

fn verb(criterion: Criterion) -> &'static str {
    match criterion {
        Criterion::Yield => "yields",
        Criterion::Tension => "cracks",
        Criterion::InterfaceShear => "fails in shear",
        Criterion::InterfaceTension => "fails in tension",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn load(name: &str, criterion: Criterion, force: Option<f64>) -> CriticalLoad {
        CriticalLoad {
            criterion,
            name: name.into(),
            strength: 1e9,
            status: match force {
                Some(_) => CriticalStatus::Met,
                None => CriticalStatus::NotReached,
            },
            force,
            penetration: force.map(|_| 1e-7),
            at: force.map(|_| [0.0, 0.0, 0.48e-6]),
            estimate: force.map(|_| 0.02e-3),
            resolved: true,
            utilisation: if force.is_some() { 1.0 } else { 0.34 },
        }
    }

    fn words(layers: usize, units: Units) -> CriticalWords {
        CriticalWords {
            layers,
            largest_force: 5e-3,
            element_side: 1e-7,
            units,
        }
    }

    #[test]
    fn a_critical_load_is_printed_with_its_error_and_place() {
        let yields = load("layer[0]", Criterion::Yield, Some(3.2e-3));
        assert_eq!(
            words(1, Units::Si).met(&yields, 3.2e-3, true),
            "the coating yields first at 3.2000 mN ± 0.020 mN (grid), 480.00 nm below the surface at x, y = 0 m, 0 m"
        );
        let unresolved = CriticalLoad {
            resolved: false,
            at: Some([1e-6, -1e-12, 1e-15]),
            ..load("layer[1]", Criterion::Tension, Some(1.0))
        };
        assert_eq!(
            words(2, Units::Consistent).met(&unresolved, 1.0, false),
            "layer 1 cracks at 1.0000 (not resolved by the grid), at the surface at x, y = 1.0000e-6, 0"
        );
        let beyond = CriticalLoad {
            status: CriticalStatus::BeyondModel,
            ..yields
        };
        let sentence = words(1, Units::Si).met(&beyond, 3.2e-3, false);
        assert!(
            sentence.contains("x, y = 0 m, 0 m: BEYOND THE MODEL"),
            "{sentence}"
        );
    }

    #[test]
    fn first_is_said_only_where_intervals_do_not_overlap() {
        // ± 0.02 mN each.
        let yields = load("layer[0]", Criterion::Yield, Some(3.2e-3));
        let holds = load("interface[0]", Criterion::InterfaceShear, None);
        for (force, resolved, is_first) in [
            (3.25e-3, true, true),
            (3.23e-3, true, false),
            (3.25e-3, false, false),
        ] {
            let cracks = CriticalLoad {
                resolved,
                ..load("layer[0]", Criterion::Tension, Some(force))
            };
            let loads = [&yields, &cracks, &holds];
            assert_eq!(is_clearly_first(&yields, &loads), is_first, "{force}");
        }
        assert!(is_clearly_first(&yields, &[&yields, &holds]));
        assert!(!is_clearly_first(&yields, &[&yields]));
    }

    #[test]
    fn an_unreached_strength_is_printed_with_its_utilisation() {
        let holds = load("interface[0]", Criterion::InterfaceShear, None);
        assert_eq!(
            words(1, Units::Si).not_met(&holds),
            "the interface fails in shear under no load up to 5.0000 mN: 0.340 of its strength is reached"
        );
        let fails = CriticalLoad {
            status: CriticalStatus::BelowSmallest,
            utilisation: 2.0,
            resolved: false,
            ..holds
        };
        assert_eq!(
            words(1, Units::Si).not_met(&fails),
            "the interface fails in shear already at the smallest load tried: 2.00 of its strength is reached (not resolved by the grid)"
        );
    }
}
