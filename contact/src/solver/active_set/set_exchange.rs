//! The choice of the next working set.

use super::dense_system::{DenseSystem, SetSolution};
use crate::{
    Load,
    solver::exchange::{Bound, Milestone, crossings},
};

/// Full exchanges allowed without a new smallest number of infeasible elements before the method descends.
const GRACE: usize = 6;
/// The next smallest number, as a fraction of the last: any lower number.
const FEWER: f64 = 1.0;

/// The working set and the state that prevents cycling.
pub struct SetExchange {
    members: Vec<usize>,
    /// The fewest infeasible elements.
    fewest: Milestone,
    /// The admissible pressure of the descending phase; empty before it.
    descent: Option<Vec<f64>>,
}

impl SetExchange {
    /// Starts from the elements with pressure, or from all that can touch if there are none, as the paper does.
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
            fewest: Milestone::new(FEWER),
            descent: None,
        }
    }

    /// The working set, ascending.
    pub fn members(&self) -> &[usize] {
        &self.members
    }

    /// Chooses the next working set from the solution on the current one.
    pub fn advance(&mut self, system: &DenseSystem, trial: &SetSolution) {
        let since = self.fewest.count(trial.infeasible.len() as f64);
        if since < GRACE && self.descent.is_none() {
            self.exchange_all(system, trial);
        } else {
            self.descend(system, trial);
        }
    }

    /// Drops all elements that pull and adds all that overlap.
    fn exchange_all(&mut self, system: &DenseSystem, trial: &SetSolution) {
        let mut holds = vec![false; system.elements()];
        self.members.iter().for_each(|m| holds[*m] = true);
        trial.infeasible.iter().for_each(|e| holds[*e] = !holds[*e]);
        self.members = (0..system.elements()).filter(|e| holds[*e]).collect();
        self.keep_at_least_one(system);
    }

    /// Adds the element with the smallest gap to an empty set under a prescribed force, which needs at least one.
    fn keep_at_least_one(&mut self, system: &DenseSystem) {
        if self.members.is_empty() && system.total().is_some() {
            let gap = system.initial_gap();
            self.members
                .extend((0..gap.len()).min_by(|e, f| gap[*e].total_cmp(&gap[*f])));
        }
    }

    /// Takes one step of the descending phase, which starts from the trial's pressure made admissible.
    fn descend(&mut self, system: &DenseSystem, trial: &SetSolution) {
        let Some(mut pressure) = self.descent.take() else {
            let pressure = admissible(system, &trial.pressure);
            self.members = (0..pressure.len()).filter(|e| pressure[*e] > 0.0).collect();
            self.keep_at_least_one(system);
            self.descent = Some(pressure);
            return;
        };
        // The longest step towards the trial without tension, t = min p/(p − p_trial), and the element that limits it.
        let stops = crossings([&pressure, &trial.pressure], Bound::Zero);
        let blocking = stops.min_by(|one, other| one.1.total_cmp(&other.1));
        let t = blocking.map_or(1.0, |(_, t)| t);
        self.members
            .iter()
            .for_each(|m| pressure[*m] += t * (trial.pressure[*m] - pressure[*m]));
        if let Some((blocking, _)) = blocking {
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

/// Clips a pressure to `p ≥ 0` and scales it to the prescribed total.
fn admissible(system: &DenseSystem, pressure: &[f64]) -> Vec<f64> {
    let mut pressure: Vec<f64> = pressure.iter().map(|p| p.max(0.0)).collect();
    if let Some(total) = system.total() {
        let sum: f64 = pressure.iter().sum();
        pressure.iter_mut().for_each(|p| *p *= total / sum);
    }
    pressure
}

#[cfg(test)]
mod tests {
    use super::{DenseSystem, SetExchange};
    use crate::{
        Load,
        solver::tests::{RIGID, paraboloid, pillars, problem},
    };

    /// The final pressure, and the number of exchanges.
    fn run(system: &DenseSystem, start: &[f64], next: Next) -> (Vec<f64>, usize) {
        let mut exchange = SetExchange::start(system, start);
        for exchanges in 0.. {
            let trial = system.solve_on(exchange.members()).unwrap();
            if trial.infeasible.is_empty() {
                return (trial.pressure, exchanges);
            }
            assert!(exchanges < 2000, "{} infeasible", trial.infeasible.len());
            next(&mut exchange, system, &trial);
        }
        unreachable!("the loop ends by itself")
    }

    type Next = fn(&mut SetExchange, &DenseSystem, &super::SetSolution);

    #[test]
    fn the_gap_of_a_set_on_springs_agrees_with_a_product_and_is_closed_on_the_set() {
        let springs = |x: f64, y: f64| 0.01 * (2.0 + (9.0 * x).sin() + (7.0 * y).cos());
        let mut problem = problem([10.0, 0.05], paraboloid, springs);
        let system = DenseSystem::new(&mut problem, Load::Penetration(0.01));
        let members: Vec<usize> = (480..544).collect();
        let trial = system.solve_on(&members).unwrap();
        let mut deformation = vec![0.0; system.elements()];
        problem.deform_into(&trial.pressure, &mut deformation);
        for (e, gap) in trial.gap.iter().enumerate() {
            let wanted = deformation[e] + problem.initial_gap()[e] - 0.01;
            assert!((gap - wanted).abs() < 1e-14, "{e}: {gap} {wanted}");
        }
        assert!(members.iter().all(|e| trial.gap[*e].abs() < 1e-14));
        assert!(trial.pressure.iter().any(|p| *p > 0.0));
    }

    #[test]
    fn the_residual_of_a_set_is_the_larger_of_overlap_and_tension() {
        let residual = |gap: f64, pressure: f64| {
            let set = super::SetSolution {
                pressure: vec![4.0, pressure],
                gap: vec![0.5, gap],
                infeasible: Vec::new(),
                stiffness: 0.0,
                penetration: 0.1,
            };
            set.residual()
        };
        // Powers of two over 4, and a fraction of the penetration.
        assert_eq!(residual(-0.0, -1.0), 0.25);
        assert!((residual(-0.03, -1.0) - 0.3).abs() < 1e-15);
        assert_eq!(residual(0.0, 0.0), 0.0);
    }

    #[test]
    fn the_descending_phase_alone_finds_the_same_solution_as_exchanges() {
        for load in [Load::Force(1e-3), Load::Penetration(0.01)] {
            let mut problem = problem([10.0, 0.05], |x, y| pillars(x, y, 0.002), RIGID);
            let system = DenseSystem::new(&mut problem, load);
            let mut start = vec![0.0; system.elements()];
            start[500..520].fill(1.0);
            let (wanted, exchanges) = run(&system, &start, SetExchange::advance);
            let (found, steps) = run(&system, &start, SetExchange::descend);
            assert!(exchanges < steps, "{exchanges} {steps}");
            let peak = wanted.iter().copied().fold(0.0, f64::max);
            for (found, wanted) in found.iter().zip(&wanted) {
                // Two dense solutions of the same system.
                assert!((found - wanted).abs() < 1e-9 * peak);
            }
        }
    }

    #[test]
    fn a_trial_reports_the_residual_and_the_stiffness_of_its_set() {
        let mut problem = problem([1.0, 0.1], paraboloid, RIGID);
        let area = problem.loaded_area();
        let by_force = DenseSystem::new(&mut problem, Load::Force(1e-3));
        assert_eq!(by_force.total(), Some(1e-3 / area));
        let (pressure, _) = run(&by_force, &[0.0; 1024], SetExchange::advance);
        let members: Vec<usize> = (0..1024).filter(|e| pressure[*e] > 0.0).collect();
        let all: Vec<usize> = (0..1024).collect();
        let residual = |members: &[usize]| by_force.solve_on(members).unwrap().residual();
        // Rounding of a dense solution, then elements that pull.
        assert!(residual(&members) < 1e-10 && residual(&all) > 1e-3);
        assert!(residual(&members[10..]) > 1e-4, "an overlap");
        let mut at = |penetration: f64| {
            let system = DenseSystem::new(&mut problem, Load::Penetration(penetration));
            assert_eq!(system.total(), None);
            let iterate = system.solve_on(&members).unwrap().into_iterate(Vec::new());
            let force = area * iterate.pressure.iter().sum::<f64>();
            (force, iterate.contact_stiffness.unwrap())
        };
        let [(less, stiffness), (more, same)] = [0.02, 0.03].map(&mut at);
        // Linear on one set: ΔQ = dQ/dD ΔD.
        approx::assert_relative_eq!(more - less, stiffness * 0.01, max_relative = 1e-9);
        approx::assert_relative_eq!(stiffness, same, max_relative = 1e-12);
    }

    #[test]
    fn a_warm_start_contains_its_pressed_elements_and_a_cold_one_all_that_can_touch() {
        let mut problem = problem([1.0, 0.1], paraboloid, RIGID);
        let mut warm = vec![0.0; 1024];
        warm[40] = 1.0;
        let by_force = DenseSystem::new(&mut problem, Load::Force(1e-3));
        assert_eq!(SetExchange::start(&by_force, &warm).members(), [40]);
        let all: Vec<usize> = (0..1024).collect();
        assert_eq!(SetExchange::start(&by_force, &[0.0; 1024]).members(), all);
        // g0 < D = 0.01 within ρ² < 0.02; the element 40 lies outside.
        let by_penetration = DenseSystem::new(&mut problem, Load::Penetration(0.01));
        let gap = by_penetration.initial_gap();
        let near: Vec<usize> = (0..1024).filter(|e| gap[*e] < 0.01).collect();
        assert_eq!(SetExchange::start(&by_penetration, &warm).members(), near);
    }
}
