//! Which elements to hold in contact next.

use super::dense_system::{DenseSystem, Trial};
use crate::Load;

/// Full exchanges that may pass without a new lowest number of infeasible elements before the method descends.
const GRACE: usize = 6;

/// The working set and the memory that keeps it from cycling.
pub struct Exchange {
    members: Vec<usize>,
    fewest_infeasible: usize,
    grace: usize,
    /// The admissible pressure of the descending phase; empty before it.
    descent: Option<Vec<f64>>,
}

impl Exchange {
    /// Starts from the elements with pressure; from a cold start, as the paper does, from all that can touch.
    pub fn start(system: &DenseSystem, start: &[f64]) -> Self {
        let can_touch = |e: &usize| match system.load() {
            Load::Force(_) => system.initial_gap()[*e].is_finite(),
            Load::Penetration(penetration) => system.initial_gap()[*e] < penetration,
        };
        let warm: Vec<usize> = (0..system.elements())
            .filter(|e| start[*e] > 0.0 && can_touch(e))
            .collect();
        let members = if warm.is_empty() {
            (0..system.elements()).filter(can_touch).collect()
        } else {
            warm
        };
        Self {
            members,
            fewest_infeasible: usize::MAX,
            grace: GRACE,
            descent: None,
        }
    }

    /// The working set, ascending.
    pub fn members(&self) -> &[usize] {
        &self.members
    }

    /// Chooses the next working set from the solution on the present one.
    pub fn advance(&mut self, system: &DenseSystem, trial: &Trial) {
        if trial.infeasible.len() < self.fewest_infeasible {
            (self.fewest_infeasible, self.grace) = (trial.infeasible.len(), GRACE);
        } else {
            self.grace = self.grace.saturating_sub(1);
        }
        if self.grace > 0 && self.descent.is_none() {
            self.exchange_all(system, trial);
        } else {
            self.descend(system, trial);
        }
    }

    /// Drops all that pull and takes in all that overlap.
    fn exchange_all(&mut self, system: &DenseSystem, trial: &Trial) {
        let mut holds = vec![false; system.elements()];
        self.members.iter().for_each(|m| holds[*m] = true);
        trial.infeasible.iter().for_each(|e| holds[*e] = !holds[*e]);
        self.members = (0..system.elements()).filter(|e| holds[*e]).collect();
        self.keep_one(system);
    }

    /// A prescribed force needs at least one element to act on: the lowest.
    fn keep_one(&mut self, system: &DenseSystem) {
        if self.members.is_empty() && system.total().is_some() {
            let gap = system.initial_gap();
            self.members
                .extend((0..gap.len()).min_by(|e, f| gap[*e].total_cmp(&gap[*f])));
        }
    }

    /// One step of the descending phase, which starts from the trial's own pressure made admissible.
    fn descend(&mut self, system: &DenseSystem, trial: &Trial) {
        let Some(mut pressure) = self.descent.take() else {
            let pressure = admissible(system, &trial.pressure);
            self.members = (0..pressure.len()).filter(|e| pressure[*e] > 0.0).collect();
            self.keep_one(system);
            self.descent = Some(pressure);
            return;
        };
        // The longest step towards the trial on which nothing pulls, t = min p/(p − p_trial), and who stops it.
        let stops = |m: usize| (pressure[m] / (pressure[m] - trial.pressure[m]), m);
        let pulling = self
            .members
            .iter()
            .copied()
            .filter(|m| trial.pressure[*m] < 0.0);
        let blocking = pulling
            .map(stops)
            .min_by(|one, other| one.0.total_cmp(&other.0));
        let t = blocking.map_or(1.0, |(t, _)| t);
        self.members
            .iter()
            .for_each(|m| pressure[*m] += t * (trial.pressure[*m] - pressure[*m]));
        if let Some((_, blocking)) = blocking {
            pressure[blocking] = 0.0;
            self.members.retain(|m| *m != blocking);
        } else if let Some(lowest) =
            (0..system.elements()).min_by(|e, f| trial.gap[*e].total_cmp(&trial.gap[*f]))
        {
            self.members.push(lowest);
            self.members.sort_unstable();
            self.members.dedup();
        }
        self.descent = Some(pressure);
    }
}

/// `p ≥ 0` with the prescribed total.
fn admissible(system: &DenseSystem, pressure: &[f64]) -> Vec<f64> {
    let mut pressure: Vec<f64> = pressure.iter().map(|p| p.max(0.0)).collect();
    if let Some(total) = system.total() {
        let sum: f64 = pressure.iter().sum();
        pressure.iter_mut().for_each(|p| *p *= total / sum);
    }
    pressure
}
