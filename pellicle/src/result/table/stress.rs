//! The columns of stresses in tables: extremes of a step, and critical loads of a case.

use pellicle_contact::{Criterion, CriticalLoad, CriticalStatus, Extreme, StressQuantity};

use crate::case::Case;
use crate::case::foundation::FoundationCase;
use crate::input::units::Units;
use crate::result::extremes::{OF_BODIES, OF_INTERFACES};
use crate::result::quantity::cell;
use crate::summary::{RunSummary, StepSummary};

/// The stresses in the columns of a table.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct StressColumns {
    /// Names of bodies, from the surface down.
    bodies: Vec<String>,
    /// Names of interfaces.
    interfaces: Vec<String>,
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
        [cell(found.value), cell(error), found.resolved.to_string()]
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

impl StressColumns {
    /// The columns of a summary.
    #[must_use]
    pub fn of_steps(summary: &RunSummary) -> Self {
        let stress = summary.steps.iter().find_map(|step| step.stress.as_ref());
        let Some(stress) = stress else {
            return Self::default();
        };
        let interfaces = stress.extremes.interfaces.iter();
        let extremes = &stress.extremes;
        let of_bodies = OF_BODIES.iter().filter_map(|of| {
            let mut bodies = extremes.bodies.iter();
            let has_it = bodies.any(|body| (of.value)(body).is_some());
            has_it.then_some(of.quantity)
        });
        let of_interfaces = OF_INTERFACES.iter().filter_map(|of| {
            let mut interfaces = extremes.interfaces.iter();
            let has_it = interfaces.any(|interface| (of.value)(interface).is_some());
            has_it.then_some(of.quantity)
        });
        Self {
            quantities: of_bodies.chain(of_interfaces).collect(),
            bodies: (stress.extremes.bodies.iter())
                .map(|body| body.name.clone())
                .collect(),
            interfaces: interfaces.map(|interface| interface.name.clone()).collect(),
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
        for body in stress.body.each() {
            let of = body.of(&case.foundation, Some(&case.indenter));
            self.add_body(&of, body.prefix());
        }
    }

    /// Adds the columns of a body, the names of whose parts begin with `prefix`.
    fn add_body(&mut self, body: &FoundationCase, prefix: &str) {
        // The substrate is the last, whatever the number of layers.
        let substrate = format!("{prefix}{SUBSTRATE}");
        for name in body.body_names() {
            let name = format!("{prefix}{name}");
            let is_new = !self.bodies.contains(&name);
            let last = self.bodies.iter().position(|body| *body == substrate);
            let place = last.unwrap_or(self.bodies.len());
            if is_new {
                self.bodies.insert(place, name);
            }
        }
        for index in 0..body.layer.len() {
            let name = format!("{prefix}interface[{index}]");
            if !self.interfaces.contains(&name) {
                self.interfaces.push(name);
            }
        }
        for (name, criterion) in body.criteria() {
            let criterion = (format!("{prefix}{name}"), criterion);
            if !self.critical.contains(&criterion) {
                self.critical.push(criterion);
            }
        }
    }

    fn wants(&self, quantity: StressQuantity) -> bool {
        self.quantities.contains(&quantity)
    }

    /// Names of the columns, with units: those of a step, then the critical loads.
    #[must_use]
    pub fn header(&self, units: Units) -> Vec<String> {
        let (pascal, newton) = (units.name("Pa"), units.name("N"));
        let of_bodies = self.bodies.iter().flat_map(|body| {
            let wanted = OF_BODIES.iter().filter(|of| self.wants(of.quantity));
            wanted.map(move |of| Estimated::header(&format!("{} {body}", of.name), pascal))
        });
        let of_interfaces = self.interfaces.iter().flat_map(|interface| {
            let wanted = OF_INTERFACES.iter().filter(|of| self.wants(of.quantity));
            wanted.map(move |of| Estimated::header(&format!("{} {interface}", of.name), pascal))
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
            let wanted = OF_BODIES.iter().filter(|of| self.wants(of.quantity));
            let found = wanted.map(move |of| (of.value)(body?));
            found.map(|extreme| Estimated::cells(extreme.map(Estimated::from)))
        });
        let of_interfaces = self.interfaces.iter().flat_map(|name| {
            let mut interfaces = extremes.into_iter().flat_map(|found| &found.interfaces);
            let interface = interfaces.find(|interface| interface.name == *name);
            let wanted = OF_INTERFACES.iter().filter(|of| self.wants(of.quantity));
            let found = wanted.map(move |of| (of.value)(interface?));
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
#[must_use]
pub fn status_word(status: CriticalStatus) -> &'static str {
    match status {
        CriticalStatus::Met => "met",
        CriticalStatus::AtRest => "at-rest",
        CriticalStatus::NotReached => "not-reached",
        CriticalStatus::BelowSmallest => "below-smallest",
        CriticalStatus::BeyondModel => "beyond-model",
    }
}
