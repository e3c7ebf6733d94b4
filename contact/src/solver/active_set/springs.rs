//! Nonlinear springs on the dense system: Newton's method around the active set.

use super::dense_system::{DenseSystem, SetSolution};
use crate::{
    DiscreteProblem, Load,
    problem::{scale::Scale, tangents::Tangents},
};

/// Largest deviation of the law from its tangents at a solution, as a fraction of the penetration: rounding.
const ROUNDING: f64 = 1e-14;
/// Most linearisations; far more than any problem has been seen to take.
const MOST_TIMES: usize = 200;

/// The springs, the pressure at which they are linearised, and the fields known there.
pub struct DenseSprings {
    tangents: Tangents,
    /// Compliance at rest.
    rest: Vec<f64>,
    /// The problem's own `g0`.
    initial_gap: Vec<f64>,
    pressure: Vec<f64>,
    /// `K p + w* + g0` there; none before the first solution of the load.
    v: Option<Vec<f64>>,
    times: usize,
}

impl DenseSprings {
    /// Springs at rest; none if they are linear.
    pub fn of(problem: &DiscreteProblem) -> Option<Self> {
        let rest = problem.relief_compliance();
        Some(Self {
            tangents: Tangents::at_rest(
                problem.spring_law(),
                Scale::SI,
                rest,
                problem.springs().added(),
            )?,
            rest: rest.to_vec(),
            initial_gap: problem.initial_gap().to_vec(),
            pressure: vec![0.0; rest.len()],
            v: None,
            times: 0,
        })
    }

    /// The pressure at which the springs are linearised, in Pa.
    pub fn pressure(&self) -> &[f64] {
        &self.pressure
    }

    /// Linearises the springs at the solution of the current system, or at the minimum of the energy on the segment to
    /// it, and sets up the next system. Returns false if the law agrees with its tangents.
    pub fn linearise(&mut self, system: &mut DenseSystem, solution: &SetSolution) -> bool {
        let mut pressure: Vec<f64> = solution.pressure.iter().map(|p| p.max(0.0)).collect();
        let of_gap = |gap: &f64| gap + solution.penetration;
        let mut v: Vec<f64> = solution.gap.iter().map(of_gap).collect();
        let mut beyond = vec![0.0; v.len()];
        let mut by_law = v.clone();
        (self.tangents).add_beyond(&self.rest, &pressure, &mut beyond, &mut by_law);
        let largest = beyond
            .iter()
            .fold(0.0_f64, |largest, b| largest.max(b.abs()));
        self.times += 1;
        if largest <= ROUNDING * solution.penetration.abs() || self.times > MOST_TIMES {
            return false;
        }
        let part = self.part(system.load(), &pressure, &v);
        if let (true, Some(before)) = (part < 1.0, &self.v) {
            let go = |to: &mut f64, from: &f64| *to = from + part * (*to - from);
            (pressure.iter_mut().zip(&self.pressure)).for_each(|(to, from)| go(to, from));
            (v.iter_mut().zip(before)).for_each(|(to, from)| go(to, from));
            (self.tangents).add_beyond(&self.rest, &pressure, &mut beyond, &mut v);
            by_law = v;
        }
        self.tangents.take(&self.rest, &pressure);
        (self.pressure, self.v) = (pressure, Some(by_law));
        let mut gap = self.initial_gap.clone();
        self.tangents.add_offset(&self.rest, &mut gap);
        system.take_springs(self.tangents.compliance(), gap);
        true
    }

    /// The fraction of the step to a pressure at which the energy is least.
    fn part(&self, load: Load, pressure: &[f64], v: &[f64]) -> f64 {
        let Some(before) = &self.v else {
            return 1.0;
        };
        let penetration = match load {
            Load::Force(_) => 0.0,
            Load::Penetration(penetration) => penetration,
        };
        let (mut slope, mut curvature) = (0.0, 0.0);
        for (e, p) in pressure.iter().enumerate() {
            let step = p - self.pressure[e];
            if step != 0.0 {
                slope += step * (before[e] - penetration);
                curvature += step * (v[e] - before[e]);
            }
        }
        (self.tangents).part_downhill(&self.rest, pressure, [slope, curvature])
    }
}

#[cfg(test)]
mod tests {
    use pellicle_influence::ElasticOperator;
    use pellicle_texture::SpringLaw;

    use super::*;
    use crate::{
        ActiveSetSolver, GradientSolver, Solution, Solver, Watch,
        solver::tests::{SIZE, paraboloid, pillars, problem},
    };

    /// A rigid body.
    struct Rigid;

    impl ElasticOperator for Rigid {
        fn size(&self) -> usize {
            8
        }

        fn apply_into(&mut self, _: &[f64], displacement: &mut [f64]) {
            displacement.fill(0.0);
        }
    }

    #[test]
    fn on_springs_alone_every_element_has_the_pressure_of_its_own_shortening() {
        let (young, height, depth, area) = (2.0, 0.3, 0.2725, 0.01);
        let gap: Vec<f64> = (0..64).map(|e| 0.005 * f64::from(e)).collect();
        let wanted: Vec<f64> = gap
            .iter()
            .map(|g0| -young * (-(depth - g0).max(0.0) / height).ln_1p())
            .collect();
        let springs = vec![height / young; 64];
        let mut problem = DiscreteProblem::new(Box::new(Rigid), springs, gap, area)
            .unwrap()
            .with_spring_law(SpringLaw::logarithmic(young).unwrap());
        let force = area * wanted.iter().sum::<f64>();
        for load in [Load::Penetration(depth), Load::Force(force)] {
            for first in [0.0, 50.0] {
                let mut start = vec![0.0; 64];
                start[40] = first;
                let found = ActiveSetSolver::default()
                    .solve(&mut problem, load, &start, &mut Watch::alone(&mut ()))
                    .unwrap();
                for (p, wanted) in found.pressure.iter().zip(&wanted) {
                    assert!((p - wanted).abs() < 1e-10, "{p} {wanted}");
                }
                // dQ/dD = 4a² Σ 1/η_t = 4a² Σ (E + …)/(h − w)
                let tangents = wanted.iter().filter(|p| **p > 0.0);
                let stiffness = tangents.map(|p| area * young / height * (p / young).exp());
                let ratio = found.contact_stiffness.unwrap() / stiffness.sum::<f64>();
                // The last tangents are those at the previous pressure.
                assert!((ratio - 1.0).abs() < 1e-8, "{ratio}");
                // As few as Newton's method takes; bisection would need more.
                assert!(found.iterations < 40, "{}", found.iterations);
            }
        }
    }

    #[test]
    fn both_methods_find_the_same_contact_on_springs_that_stiffen() {
        let springs = |x: f64, y: f64| if pillars(x, y, 1.0) < 0.6 { 0.05 } else { 0.0 };
        let film = |_: f64, _: f64| 0.3;
        let law = SpringLaw::logarithmic(0.05).unwrap();
        let (force, depth) = (Load::Force(5e-4), Load::Penetration(0.003));
        let problems = [
            (problem([1.0, 0.1], paraboloid, film), &[force, depth][..]),
            (
                problem([10.0, 0.02], |x, y| pillars(x, y, 0.002), springs),
                &[depth],
            ),
        ];
        for (problem, loads) in problems {
            let mut problem = problem.with_spring_law(law);
            for load in loads.iter().copied() {
                let mut solve = |solver: &mut dyn Solver| {
                    let start = [0.0; SIZE * SIZE];
                    let watch = &mut ();
                    let mut watch = Watch::alone(watch);
                    let found = solver.solve(&mut problem, load, &start, &mut watch);
                    let found = found.unwrap();
                    let pressure = found.pressure.clone();
                    let judged = Solution::judge(&mut problem, load, pressure, 1e-8);
                    let certificate = judged.certificate;
                    assert!(certificate.is_satisfied(), "{certificate:?}");
                    found
                };
                let dense = solve(&mut ActiveSetSolver::default());
                let gradient = solve(&mut GradientSolver::default());
                let stiffness = [&dense, &gradient].map(|found| found.contact_stiffness.unwrap());
                assert!(
                    (stiffness[0] / stiffness[1] - 1.0).abs() < 1e-5,
                    "{stiffness:?}"
                );
                let peak = dense.pressure.iter().copied().fold(0.0, f64::max);
                for (one, other) in dense.pressure.iter().zip(&gradient.pressure) {
                    // The certificate's 1e-8 times the condition number of the systems.
                    assert!((one - other).abs() < 1e-5 * peak);
                }
                // As measured, with a margin of a tenth.
                let work = [dense.iterations, gradient.operator_applications];
                assert!(work[0] <= 40 && work[1] <= 40, "{work:?}");
            }
        }
    }

    #[test]
    fn an_uphill_step_ends_where_the_springs_balance() {
        // The solution is a pressure of 3. From 6, where the tangents are very stiff, they lead to 0.3.
        let law = SpringLaw::logarithmic(1.0).unwrap();
        let at = |p: f64| vec![p; 64];
        let mut problem = DiscreteProblem::new(Box::new(Rigid), at(1.0), at(0.0), 1.0)
            .unwrap()
            .with_spring_law(law);
        let depth = law.shortening(1.0, 3.0);
        let mut system = DenseSystem::new(&mut problem, Load::Penetration(depth));
        let mut springs = DenseSprings::of(&problem).unwrap();
        springs.tangents.take(&springs.rest, &at(6.0));
        springs.pressure = at(6.0);
        springs.v = Some(at(law.shortening(1.0, 6.0)));
        let v = law.shortening(1.0, 6.0) + law.tangent(1.0, 6.0) * (0.3 - 6.0);
        let solution = SetSolution {
            pressure: at(0.3),
            gap: at(v - depth),
            infeasible: Vec::new(),
            stiffness: 0.0,
            penetration: depth,
        };
        assert!(springs.linearise(&mut system, &solution));
        let found = springs.pressure()[0];
        // To a thousandth of the step.
        assert!((found - 3.0).abs() < 6e-3, "{found}");
        assert!(springs.pressure().iter().all(|p| (p - found).abs() < 1e-13));
        let v = springs.v.as_ref().unwrap();
        assert!(
            v.iter()
                .all(|v| (v - law.shortening(1.0, found)).abs() < 1e-13)
        );
        // The next system is that of the tangents there; its solution differs from that of the law to second order.
        let members: Vec<usize> = (0..64).collect();
        let next = system.solve_on(&members).unwrap();
        let error = (found - 3.0).powi(2);
        assert!(
            next.pressure
                .iter()
                .all(|p| (p - 3.0).abs() <= error + 1e-12)
        );
        // A step that is downhill throughout is taken whole.
        let mut springs = DenseSprings::of(&problem).unwrap();
        let end = SetSolution {
            pressure: at(2.0),
            gap: at(2.0 - depth),
            ..solution
        };
        assert!(springs.linearise(&mut system, &end));
        assert_eq!(springs.pressure(), at(2.0));
        // Where the pressure stays the same, the law agrees with its tangents.
        let settled = SetSolution {
            gap: at(law.shortening(1.0, 2.0) - depth),
            ..end
        };
        assert!(!springs.linearise(&mut system, &settled));
    }
}
