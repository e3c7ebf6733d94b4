//! The search for the elements on the wrong side of a solution with held elements.

use super::{LimitExchange, WrongSide};
use crate::{DiscreteProblem, Load};

/// Relative excess over the limit that is cut off as rounding; without this an element was held and released in turn.
const ROUNDING_ABOVE_LIMIT: f64 = 1e-13;
/// Gap of a held element that is ignored, as a fraction of the residual of the solution.
const IGNORED_GAP: f64 = 0.5;
/// Elements released at most under a force, per element that carries pressure below the limit.
const MOST_RELEASED: usize = 4;

impl LimitExchange {
    /// Finds the elements on the wrong side of the solution with the held elements, from its `v = K p + w* + g0` (m).
    pub(super) fn wrong(&mut self, problem: &DiscreteProblem, v: &[f64]) -> WrongSide {
        let limit = problem.hardness();
        let highest = limit * (1.0 + ROUNDING_ABOVE_LIMIT);
        let mut wrong = WrongSide::default();
        for (element, p) in self.free.iter().enumerate().filter(|(_, p)| **p > highest) {
            wrong.above.push(element);
            wrong.excess = wrong.excess.max(p / limit - 1.0);
        }
        wrong.by = wrong.excess;
        if self.held.count() == 0 {
            return wrong;
        }
        let penetration = self.penetration(v);
        self.total.penetration = penetration;
        let total = self.free.iter().sum::<f64>() + self.held.total;
        let mean_pressure = total / problem.elements() as f64;
        let reference = problem
            .gap_scale()
            .length(penetration, mean_pressure, |mean| {
                let gaps = v
                    .iter()
                    .zip(problem.own_gap())
                    .filter(|(_, g0)| g0.is_finite());
                gaps.fold(0.0, |most, (v, g0)| (v - g0 - mean).abs().max(most))
            });
        let lowest = penetration + IGNORED_GAP * self.accuracy * reference;
        let held = self.held.mask.iter().enumerate();
        let open = held.filter(|(element, held)| **held && v[*element] > lowest);
        wrong.open = open.map(|(element, _)| element).collect();
        if let Load::Force(_) = self.load {
            self.keep_widest(&mut wrong.open, v);
        }
        for element in &wrong.open {
            wrong.by = wrong.by.max((v[*element] - penetration) / reference);
        }
        wrong
    }

    /// Keeps the elements with the largest gaps, a few for each element that carries pressure below the limit: a
    /// penetration that rests on few elements says little about the others. Releasing all, rough surfaces on a coating
    /// 3000 times as stiff were not solved in 2000 products.
    fn keep_widest(&self, open: &mut Vec<usize>, v: &[f64]) {
        let carrying = self.free.iter().filter(|p| **p > 0.0).count();
        let most = MOST_RELEASED * (carrying + 1);
        if open.len() > most {
            open.sort_by(|e, f| v[*f].total_cmp(&v[*e]));
            open.truncate(most);
        }
    }

    /// `D` for `v = K p + w* + g0` (m).
    pub(super) fn penetration(&self, v: &[f64]) -> f64 {
        if let Load::Penetration(penetration) = self.load {
            return penetration;
        }
        let (mut total, mut weighted) = (0.0, 0.0);
        let (mut highest, mut lowest) = (f64::NEG_INFINITY, f64::INFINITY);
        for ((p, v), held) in self.free.iter().zip(v).zip(&self.held.mask) {
            if *held {
                highest = highest.max(*v);
            } else if *p > 0.0 {
                (total, weighted) = (total + p, weighted + p * v);
            } else {
                lowest = lowest.min(*v);
            }
        }
        if total > 0.0 {
            weighted / total
        } else {
            highest.min(lowest)
        }
    }
}
