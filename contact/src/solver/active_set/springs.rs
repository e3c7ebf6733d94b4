//! Springs of a law that is not linear on the dense system: Newton's method around the active set.

use super::dense_system::{DenseSystem, SetSolution};
use crate::{
    DiscreteProblem, Load,
    problem::{scale::Scale, tangents::Tangents},
};

/// What the law may say beyond its tangents at a solution, as a part of the penetration: rounding.
const ROUNDING: f64 = 1e-14;
/// Times that springs are straightened; more than any problem has been seen to take by far.
const MOST_TIMES: usize = 200;

/// Springs, the pressure where they are straightened, and what is known there.
pub struct DenseSprings {
    tangents: Tangents,
    /// Compliance at rest.
    rest: Vec<f64>,
    /// The problem's own `g0`.
    initial_gap: Vec<f64>,
    pressure: Vec<f64>,
    /// `K p + w* + g0` there; none at first, when no pressure of the load is known.
    v: Option<Vec<f64>>,
    times: usize,
}

impl DenseSprings {
    /// Springs at rest; none where they are linear.
    pub fn of(problem: &DiscreteProblem) -> Option<Self> {
        let rest = problem.relief_compliance();
        Some(Self {
            tangents: Tangents::at_rest(problem.spring_law(), Scale::SI, rest)?,
            rest: rest.to_vec(),
            initial_gap: problem.initial_gap().to_vec(),
            pressure: vec![0.0; rest.len()],
            v: None,
            times: 0,
        })
    }

    /// The pressure where they are straightened, in Pa.
    pub fn pressure(&self) -> &[f64] {
        &self.pressure
    }

    /// Straightens them at the solution of the system that was made with them, or where the energy is least on the way
    /// to it, and makes the next system; false where the law has nothing more to say.
    pub fn straighten(&mut self, system: &mut DenseSystem, solution: &SetSolution) -> bool {
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

    /// The part of the way to a pressure to go, by the energy.
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
