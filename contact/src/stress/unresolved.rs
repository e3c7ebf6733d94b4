//! Stresses and critical loads that the grid does not resolve, as warnings.

use std::fmt;

use super::body_extremes::StressExtremes;
use super::critical_load::CriticalLoad;
use super::extreme::Extreme;
use super::model::Criterion;

/// The numbers of one step, or the critical loads, that the grid does not resolve.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnresolvedStresses {
    /// The loading step, counted from 0; none for critical loads.
    pub step: Option<usize>,
    /// The numbers by name: `max_von_mises of layer[0]`, `tension of substrate`.
    pub numbers: Vec<String>,
}

impl UnresolvedStresses {
    /// The extremes of a step that are not resolved.
    #[must_use]
    pub fn of_step(step: usize, extremes: &StressExtremes) -> Option<Self> {
        // A tension of 0 is the absence of one.
        let unresolved = named(extremes)
            .into_iter()
            .filter(|(_, _, extreme)| !extreme.resolved && extreme.value != 0.0);
        let numbers: Vec<String> = unresolved
            .map(|(quantity, name, _)| format!("{quantity} of {name}"))
            .collect();
        let step = Some(step);
        (!numbers.is_empty()).then_some(Self { step, numbers })
    }

    /// The critical loads that are not resolved, including the stresses of strengths that are not reached.
    #[must_use]
    pub fn of_critical(loads: &[CriticalLoad]) -> Option<Self> {
        let unresolved = loads
            .iter()
            .filter(|load| !load.resolved && load.utilisation != 0.0);
        let numbers: Vec<String> = unresolved
            .map(|load| format!("{} of {}", quantity(load.criterion), load.name))
            .collect();
        (!numbers.is_empty()).then_some(Self {
            step: None,
            numbers,
        })
    }

    /// Returns a short, stable name for programs.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self.step {
            Some(_) => "stress-not-resolved",
            None => "critical-load-not-resolved",
        }
    }
}

impl fmt::Display for UnresolvedStresses {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let numbers = self.numbers.join(", ");
        match self.step {
            Some(step) => write!(
                f,
                "step {step}: stresses are not resolved by the grid: {numbers}"
            ),
            None => write!(
                f,
                "critical loads are not resolved by the grid, a finer one may move them: {numbers}"
            ),
        }
    }
}

/// An extreme with its name in results and that of its body or interface.
type NamedExtreme = (&'static str, String, Extreme<3>);

/// The extremes of a step, without those that are not wanted.
fn named(extremes: &StressExtremes) -> Vec<NamedExtreme> {
    let mut all = Vec::new();
    for body in &extremes.bodies {
        let of_body = [
            ("max_von_mises", body.max_von_mises),
            ("max_principal", body.max_principal),
            ("min_principal", body.min_principal),
            ("max_shear", body.max_shear),
        ];
        all.extend(of_body.map(|(quantity, extreme)| (quantity, body.name.clone(), extreme)));
    }
    for interface in &extremes.interfaces {
        let of_interface = [
            ("max_shear_traction", interface.max_shear_traction),
            ("max_tension", interface.max_tension),
            ("max_compression", interface.max_compression),
        ];
        let name = interface.name.clone();
        let in_space = |extreme: Extreme<2>| extreme.at_depth(interface.depth);
        let of_interface =
            of_interface.map(|(quantity, extreme)| (quantity, name.clone(), extreme.map(in_space)));
        all.extend(of_interface);
    }
    let wanted = all.into_iter();
    wanted
        .filter_map(|(quantity, name, extreme)| Some((quantity, name, extreme?)))
        .collect()
}

fn quantity(criterion: Criterion) -> &'static str {
    match criterion {
        Criterion::Yield => "yield",
        Criterion::Tension | Criterion::InterfaceTension => "tension",
        Criterion::InterfaceShear => "shear",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stress::body_extremes::{BodyStress, BodyUtilisation};
    use crate::stress::critical_load::CriticalStatus;

    fn body(resolved: [bool; 4]) -> StressExtremes {
        let extreme = |resolved| Extreme {
            value: 1.0,
            at: [0.0; 3],
            resolved,
            estimate: Some(0.1),
        };
        StressExtremes {
            bodies: vec![BodyStress {
                name: "substrate".to_owned(),
                max_von_mises: Some(extreme(resolved[0])),
                max_principal: Some(extreme(resolved[1])),
                min_principal: Some(extreme(resolved[2])),
                max_shear: Some(extreme(resolved[3])),
                utilisation: BodyUtilisation::default(),
            }],
            interfaces: Vec::new(),
        }
    }

    #[test]
    fn unresolved_stresses_are_listed_by_name() {
        let found = UnresolvedStresses::of_step(2, &body([true, false, true, false])).unwrap();
        assert_eq!(found.code(), "stress-not-resolved");
        assert_eq!(
            found.to_string(),
            "step 2: stresses are not resolved by the grid: max_principal of substrate, max_shear of substrate"
        );
        assert_eq!(UnresolvedStresses::of_step(0, &body([true; 4])), None);
    }

    #[test]
    fn unresolved_critical_loads_are_listed_by_name() {
        let load = |criterion, resolved| CriticalLoad {
            criterion,
            name: "layer[0]".to_owned(),
            strength: 1.0,
            status: CriticalStatus::Met,
            force: Some(1.0),
            penetration: None,
            at: None,
            estimate: Some(0.1),
            resolved,
            utilisation: 1.0,
        };
        let loads = [
            load(Criterion::Yield, true),
            load(Criterion::Tension, false),
        ];
        let found = UnresolvedStresses::of_critical(&loads).unwrap();
        assert_eq!(found.code(), "critical-load-not-resolved");
        assert_eq!(
            found.to_string(),
            "critical loads are not resolved by the grid, a finer one may move them: tension of layer[0]"
        );
        assert_eq!(UnresolvedStresses::of_critical(&loads[..1]), None);
    }
}
