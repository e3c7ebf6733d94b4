//! The columns of stresses in tables: extremes of a step, and critical loads of a case.

use pellicle::case::Case;
use pellicle::input::units::Units;
use pellicle::summary::{RunSummary, StepSummary};
use pellicle_contact::{
    BodyStress, Criterion, CriticalLoad, CriticalStatus, Extreme, InterfaceStress, StressQuantity,
};

use super::columns::optional;

/// The stresses in the columns of a table.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct StressColumns {
    /// Names of bodies, from the surface down.
    bodies: Vec<String>,
    /// Indices of interfaces.
    interfaces: Vec<usize>,
    /// The quantities that are wanted.
    quantities: Vec<StressQuantity>,
    /// Names of bodies and interfaces with the criterion of a given strength.
    critical: Vec<(String, Criterion)>,
}

/// A number with its grid error: three columns of a table.
struct Estimated {
    value: Option<f64>,
    /// Half-width of its interval; claimed only where the number is resolved.
    estimate: Option<f64>,
    resolved: bool,
}

impl Estimated {
    /// The names of the columns, as `max shear substrate [Pa]`, `max shear substrate error [Pa]` and `max shear
    /// substrate resolved`.
    fn header(name: &str, unit: &str) -> [String; 3] {
        [
            format!("{name} [{unit}]"),
            format!("{name} error [{unit}]"),
            format!("{name} resolved"),
        ]
    }

    /// The cells; all empty without the number.
    fn cells(found: Option<Self>) -> [String; 3] {
        let Some(found) = found else {
            return <[String; 3]>::default();
        };
        let error = found.estimate.filter(|_| found.resolved);
        [
            optional(found.value),
            optional(error),
            found.resolved.to_string(),
        ]
    }
}

impl<const AXES: usize> From<Extreme<AXES>> for Estimated {
    fn from(extreme: Extreme<AXES>) -> Self {
        Self {
            value: Some(extreme.value),
            estimate: extreme.estimate,
            resolved: extreme.resolved,
        }
    }
}

impl From<&CriticalLoad> for Estimated {
    fn from(load: &CriticalLoad) -> Self {
        Self {
            value: load.force,
            estimate: load.estimate,
            resolved: load.resolved,
        }
    }
}

/// The name of a number, its quantity and its value for a body.
type BodyColumn = (
    &'static str,
    StressQuantity,
    fn(&BodyStress) -> Option<Extreme<3>>,
);

const OF_BODIES: [BodyColumn; 4] = [
    ("max von Mises", StressQuantity::VonMises, |body| {
        body.max_von_mises
    }),
    ("max principal", StressQuantity::MaxPrincipal, |body| {
        body.max_principal
    }),
    ("min principal", StressQuantity::MinPrincipal, |body| {
        body.min_principal
    }),
    ("max shear", StressQuantity::MaxShear, |body| body.max_shear),
];

/// The name of a number, its quantity and its value for an interface.
type InterfaceColumn = (
    &'static str,
    StressQuantity,
    fn(&InterfaceStress) -> Option<Extreme<2>>,
);

const OF_INTERFACES: [InterfaceColumn; 3] = [
    (
        "max shear traction",
        StressQuantity::ShearTraction,
        |interface| interface.max_shear_traction,
    ),
    ("max tension", StressQuantity::Tension, |interface| {
        interface.max_tension
    }),
    (
        "max compression",
        StressQuantity::Compression,
        |interface| interface.max_compression,
    ),
];

impl StressColumns {
    /// The columns of a summary.
    #[must_use]
    pub fn of_steps(summary: &RunSummary) -> Self {
        let stress = summary.steps.iter().find_map(|step| step.stress.as_ref());
        let Some(stress) = stress else {
            return Self::default();
        };
        let interfaces = stress.extremes.interfaces.iter();
        let of_bodies = OF_BODIES.iter().filter_map(|(_, quantity, extreme)| {
            let mut bodies = stress.extremes.bodies.iter();
            bodies
                .any(|body| extreme(body).is_some())
                .then_some(*quantity)
        });
        let of_interfaces = OF_INTERFACES.iter().filter_map(|(_, quantity, extreme)| {
            let mut interfaces = stress.extremes.interfaces.iter();
            let has_it = interfaces.any(|interface| extreme(interface).is_some());
            has_it.then_some(*quantity)
        });
        Self {
            quantities: of_bodies.chain(of_interfaces).collect(),
            bodies: (stress.extremes.bodies.iter())
                .map(|body| body.name.clone())
                .collect(),
            interfaces: interfaces.map(|interface| interface.index).collect(),
            critical: (summary.critical.iter().flatten())
                .map(|load| (load.name.clone(), load.criterion))
                .collect(),
        }
    }

    /// Adds the columns of a case, without duplicates.
    pub fn add(&mut self, case: &Case) {
        let Some(stress) = &case.stress else {
            return;
        };
        for (_, quantity) in StressQuantity::NAMES {
            let is_new = stress.wants(quantity) && !self.quantities.contains(&quantity);
            self.quantities.extend(is_new.then_some(quantity));
        }
        // The substrate is the last, whatever the number of layers.
        for name in case.foundation.body_names() {
            let is_new = !self.bodies.contains(&name);
            let last = self.bodies.iter().position(|body| body == SUBSTRATE);
            let place = last.unwrap_or(self.bodies.len());
            if is_new {
                self.bodies.insert(place, name);
            }
        }
        for index in 0..case.foundation.layer.len() {
            if !self.interfaces.contains(&index) {
                self.interfaces.push(index);
            }
        }
        for criterion in case.foundation.criteria() {
            if !self.critical.contains(&criterion) {
                self.critical.push(criterion);
            }
        }
    }

    /// The columns of the wanted quantities of a body.
    fn of_bodies(&self) -> impl Iterator<Item = &'static BodyColumn> {
        OF_BODIES
            .iter()
            .filter(|(_, quantity, _)| self.quantities.contains(quantity))
    }

    /// The columns of the wanted quantities of an interface.
    fn of_interfaces(&self) -> impl Iterator<Item = &'static InterfaceColumn> {
        OF_INTERFACES
            .iter()
            .filter(|(_, quantity, _)| self.quantities.contains(quantity))
    }

    /// Names of the columns, with units: those of a step, then the critical loads.
    #[must_use]
    pub fn header(&self, units: Units) -> Vec<String> {
        let (pascal, newton) = (units.name("Pa"), units.name("N"));
        let of_bodies = self.bodies.iter().flat_map(|body| {
            let names = self.of_bodies();
            let names = names.map(move |(name, ..)| format!("{name} {body}"));
            names.map(|name| Estimated::header(&name, pascal))
        });
        let of_interfaces = self.interfaces.iter().flat_map(|index| {
            let names = self.of_interfaces();
            let names = names.map(move |(name, ..)| format!("{name} interface[{index}]"));
            names.map(|name| Estimated::header(&name, pascal))
        });
        let critical = self.critical.iter().flat_map(|(name, criterion)| {
            let name = format!("critical force {} {name}", word(*criterion));
            let status = format!("{name} status");
            (Estimated::header(&name, newton).into_iter()).chain(std::iter::once(status))
        });
        (of_bodies.chain(of_interfaces).flatten())
            .chain(critical)
            .collect()
    }

    /// The values of a step and of the critical loads. Cells without a value are empty; a critical force is also empty
    /// if its status is not `met`, and the status if there is no such body or its strength is not given.
    #[must_use]
    pub fn row(&self, step: &StepSummary, critical: &[CriticalLoad]) -> Vec<String> {
        let extremes = step.stress.as_ref().map(|stress| &stress.extremes);
        let of_bodies = self.bodies.iter().flat_map(|name| {
            let body =
                extremes.and_then(|found| found.bodies.iter().find(|body| body.name == *name));
            let found = self.of_bodies().map(move |(.., extreme)| extreme(body?));
            found.map(|extreme| Estimated::cells(extreme.map(Estimated::from)))
        });
        let of_interfaces = self.interfaces.iter().flat_map(|index| {
            let mut interfaces = extremes.into_iter().flat_map(|found| &found.interfaces);
            let interface = interfaces.find(|interface| interface.index == *index);
            let found = self.of_interfaces();
            let found = found.map(move |(.., extreme)| extreme(interface?));
            found.map(|extreme| Estimated::cells(extreme.map(Estimated::from)))
        });
        let critical = self.critical.iter().flat_map(|(name, criterion)| {
            let is_it = |load: &&CriticalLoad| load.name == *name && load.criterion == *criterion;
            let load = critical.iter().find(is_it);
            let status = load.map_or("", |load| status_word(load.status)).to_owned();
            (Estimated::cells(load.map(Estimated::from)).into_iter()).chain(std::iter::once(status))
        });
        (of_bodies.chain(of_interfaces).flatten())
            .chain(critical)
            .collect()
    }
}

const SUBSTRATE: &str = "substrate";

/// The name of the criterion in a table, that of its strength.
fn word(criterion: Criterion) -> &'static str {
    match criterion {
        Criterion::Yield => "yield",
        Criterion::Tension | Criterion::InterfaceTension => "tension",
        Criterion::InterfaceShear => "shear",
    }
}

/// The status as in `summary.json`.
fn status_word(status: CriticalStatus) -> &'static str {
    match status {
        CriticalStatus::Met => "met",
        CriticalStatus::NotReached => "not-reached",
        CriticalStatus::BelowSmallest => "below-smallest",
        CriticalStatus::BeyondModel => "beyond-model",
    }
}
