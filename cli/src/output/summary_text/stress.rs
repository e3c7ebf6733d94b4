//! Stresses and critical loads in words.

use pellicle_contact::{Criterion, CriticalLoad, Extreme};

use super::columns::TextColumns;
use crate::display::{Unit, error_of, quantity, significant};
use crate::input::units::Units;
use crate::output::summary::RunSummary;
use crate::output::summary::StressSummary;

impl TextColumns {
    /// Adds the largest stresses in each body and on each interface.
    pub(super) fn stresses(&mut self, stress: &StressSummary) {
        for body in &stress.extremes.bodies {
            self.push(&format!("stress in {}", body.name), "", "");
            self.extreme("  von Mises", &body.max_von_mises);
            self.used("yield", body.utilisation.yielding);
            self.extreme("  tension", &body.max_principal);
            self.used("tensile", body.utilisation.tension);
        }
        for interface in &stress.extremes.interfaces {
            self.push(&format!("stress on interface {}", interface.index), "", "");
            self.extreme("  shear", &interface.max_shear_traction);
            self.used("shear", interface.utilisation.shear);
            if interface.max_tension.value > 0.0 {
                self.extreme("  tension", &interface.max_tension);
            }
            self.used("tensile", interface.utilisation.tension);
        }
    }

    fn extreme<const AXES: usize>(&mut self, name: &str, extreme: &Extreme<AXES>) {
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
        let at = rounded(at).map(|along| quantity(along, Unit::Metre, self.units));
        self.push(
            &format!("    at {}", ["x", "y", "z"][..AXES].join(", ")),
            &at.join(", "),
            "",
        );
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
    let layers = summary.layers();
    let mut loads: Vec<_> = critical.iter().collect();
    let force = |load: &CriticalLoad| load.force.unwrap_or(f64::INFINITY);
    loads.sort_by(|one, other| force(one).total_cmp(&force(other)));
    let first = loads.first().filter(|load| load.force.is_some()).copied();
    let sentence = |load: &&CriticalLoad| {
        let is_first = Some(*load) == first && is_clearly_first(load, &loads);
        format!("{}\n", sentence(load, is_first, layers, summary.units))
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

/// `the coating yields first at 3.2 mN ± 0.1 mN (grid), 0.48 µm below the surface on the axis`
fn sentence(load: &CriticalLoad, is_first: bool, layers: usize, units: Units) -> String {
    let (what, verb) = (place(&load.name, layers), verb(load.criterion));
    let Some(force) = load.force else {
        let ratio = significant(load.utilisation, 3);
        return if load.utilisation < 1.0 {
            format!("{what} {verb} at none of these loads: {ratio} of its strength is reached")
        } else {
            format!(
                "{what} {verb} already at the smallest load tried: {ratio} times its strength is reached"
            )
        };
    };
    let first = if is_first { " first" } else { "" };
    let newtons = quantity(force, Unit::Newton, units);
    let note = match load.estimate {
        _ if !load.resolved => " (not resolved by the grid)".to_owned(),
        Some(error) => format!(" {} (grid)", error_of(force, error, Unit::Newton, units)),
        None => String::new(),
    };
    let at = load.at.map_or_else(String::new, |at| depth(at, units));
    format!("{what} {verb}{first} at {newtons}{note}{at}")
}

/// `, 0.48 µm below the surface at x, y = 0 m, 1.2 µm`
fn depth(at: [f64; 3], units: Units) -> String {
    let [x, y, z] = rounded(at);
    let metres = |value| quantity(value, Unit::Metre, units);
    let depth = if z == 0.0 {
        "at the surface".to_owned()
    } else {
        format!("{} below the surface", metres(z))
    };
    let (x, y) = (metres(x), metres(y));
    format!(", {depth} at x, y = {x}, {y}")
}

/// Sets coordinates below a millionth of the largest to zero: a peak on the axis is found slightly beside it.
fn rounded<const AXES: usize>(at: [f64; AXES]) -> [f64; AXES] {
    let largest = at
        .iter()
        .fold(0.0_f64, |largest, along| largest.max(along.abs()));
    at.map(|along| {
        if along.abs() < 1e-6 * largest {
            0.0
        } else {
            along
        }
    })
}

/// Names a body or interface of a summary; a single layer is the coating.
fn place(name: &str, layers: usize) -> String {
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
            force,
            penetration: force.map(|_| 1e-7),
            at: force.map(|_| [0.0, 0.0, 0.48e-6]),
            estimate: force.map(|_| 0.02e-3),
            resolved: true,
            utilisation: if force.is_some() { 1.0 } else { 0.34 },
        }
    }

    #[test]
    fn a_critical_load_is_printed_with_its_error_and_place() {
        let yields = load("layer[0]", Criterion::Yield, Some(3.2e-3));
        assert_eq!(
            sentence(&yields, true, 1, Units::Si),
            "the coating yields first at 3.2000 mN ± 0.020 mN (grid), 480.00 nm below the surface at x, y = 0 m, 0 m"
        );
        let unresolved = CriticalLoad {
            resolved: false,
            at: Some([1e-6, 0.0, 0.0]),
            ..load("layer[1]", Criterion::Tension, Some(1.0))
        };
        assert_eq!(
            sentence(&unresolved, false, 2, Units::Consistent),
            "layer 1 cracks at 1.0000 (not resolved by the grid), at the surface at x, y = 1.0000e-6, 0"
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
            sentence(&holds, false, 1, Units::Si),
            "the interface fails in shear at none of these loads: 0.340 of its strength is reached"
        );
    }
}
