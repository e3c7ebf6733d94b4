//! The columns of stresses in tables: extremes of a step, and critical loads of a case.

use pellicle_contact::{BodyStress, Criterion, CriticalLoad, InterfaceStress};

use super::columns::number;
use crate::case::Case;
use crate::input::units::Units;
use crate::output::summary::{RunSummary, StepSummary};

/// The stresses in the columns of a table.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct StressColumns {
    /// Names of bodies, from the surface down.
    bodies: Vec<String>,
    /// Indices of interfaces.
    interfaces: Vec<usize>,
    /// Names of bodies and interfaces with the criterion of a given strength.
    critical: Vec<(String, Criterion)>,
}

/// The name of a column and its value for a body.
type BodyColumn = (&'static str, fn(&BodyStress) -> f64);

const OF_BODIES: [BodyColumn; 4] = [
    ("max von Mises", |body| body.max_von_mises.value),
    ("max principal", |body| body.max_principal.value),
    ("min principal", |body| body.min_principal.value),
    ("max shear", |body| body.max_shear.value),
];

/// The name of a column and its value for an interface.
type InterfaceColumn = (&'static str, fn(&InterfaceStress) -> f64);

const OF_INTERFACES: [InterfaceColumn; 3] = [
    ("max shear traction", |interface| {
        interface.max_shear_traction.value
    }),
    ("max tension", |interface| interface.max_tension.value),
    ("max compression", |interface| {
        interface.max_compression.value
    }),
];

impl StressColumns {
    /// The columns of the steps of a summary, without critical loads.
    #[must_use]
    pub fn of_steps(summary: &RunSummary) -> Self {
        let stress = summary.steps.iter().find_map(|step| step.stress.as_ref());
        let Some(stress) = stress else {
            return Self::default();
        };
        let interfaces = stress.extremes.interfaces.iter();
        Self {
            bodies: (stress.extremes.bodies.iter())
                .map(|body| body.name.clone())
                .collect(),
            interfaces: interfaces.map(|interface| interface.index).collect(),
            critical: Vec::new(),
        }
    }

    /// Adds the columns of a case, without duplicates.
    pub fn add(&mut self, case: &Case) {
        if case.stress.is_none() {
            return;
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

    /// Names of the columns, with units: those of a step, then the critical loads.
    #[must_use]
    pub fn header(&self, units: Units) -> Vec<String> {
        let (pascal, newton) = (units.name("Pa"), units.name("N"));
        let of_bodies = self
            .bodies
            .iter()
            .flat_map(|body| OF_BODIES.map(|(name, _)| format!("{name} {body} [{pascal}]")));
        let of_interfaces = self.interfaces.iter().flat_map(|index| {
            OF_INTERFACES.map(|(name, _)| format!("{name} interface[{index}] [{pascal}]"))
        });
        let critical = self.critical.iter().map(|(name, criterion)| {
            let word = word(*criterion);
            format!("critical force {word} {name} [{newton}]")
        });
        of_bodies.chain(of_interfaces).chain(critical).collect()
    }

    /// The values of a step and of the critical loads; cells without a value are empty.
    #[must_use]
    pub fn row(&self, step: &StepSummary, critical: &[CriticalLoad]) -> Vec<String> {
        let extremes = step.stress.as_ref().map(|stress| &stress.extremes);
        let cell = |value: Option<f64>| value.map_or_else(String::new, number);
        let of_bodies = self.bodies.iter().flat_map(|name| {
            let body =
                extremes.and_then(|found| found.bodies.iter().find(|body| body.name == *name));
            OF_BODIES.map(|(_, value)| cell(body.map(value)))
        });
        let of_interfaces = self.interfaces.iter().flat_map(|index| {
            let mut interfaces = extremes.into_iter().flat_map(|found| &found.interfaces);
            let interface = interfaces.find(|interface| interface.index == *index);
            OF_INTERFACES.map(|(_, value)| cell(interface.map(value)))
        });
        let critical = self.critical.iter().map(|(name, criterion)| {
            let is_it = |load: &&CriticalLoad| load.name == *name && load.criterion == *criterion;
            cell(critical.iter().find(is_it).and_then(|load| load.force))
        });
        of_bodies.chain(of_interfaces).chain(critical).collect()
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
