//! The search for the smallest force at which one stress reaches a strength.
//!
//! A stress grows roughly as a power of the load, so the secant between two solved loads in logarithms finds a strength
//! in a few steps. Each step solves a contact on its own grids. The whole body is searched under loads far from those
//! searched before: under a coating the peak jumps from one place to another. From a load nearby the peak is followed.
//! The body is searched again, and the error found, where the strength is met; if the peak is then another one, all
//! that was followed is searched, and the search begins anew. With residual stress, of which the largest may lie far
//! from the contact, every load is searched, and the power is that of what the load adds.

use pellicle_influence::RoughDepths;

use super::extreme::Extreme;
use super::extreme_finder::ExtremeFinder;
use super::model::Sliding;
use super::plane_scan::Target;
use super::residual::ResidualStress;
use super::solved_loads::SolvedLoads;
use crate::{ContactError, Domain, Load, LoadingPath, Step, choose_side};

/// Relative accuracy of a critical load.
const ACCURACY: f64 = 5e-5;
/// Largest number of loads solved for one criterion.
const MOST_SOLVED: usize = 24;
/// Factor between loads below the smallest of the path.
const SMALLER: f64 = 0.25;
/// Largest number of loads found by secants before the bracket is halved, of smaller loads, and of those around the
/// largest stress.
const MOST_TRIALS: usize = 8;
/// If the largest stress is at least this part of a strength, other loads may reach it.
const NEARLY: f64 = 0.7;
/// Loads whose logarithms differ by less than this are equivalent at a peak of the stress.
const FLAT: f64 = 0.1;
/// A load whose contact is solved already replaces one that differs by less than this factor.
const ALIKE: f64 = 1.05;
/// A peak is followed from a searched load that differs by less than this factor.
const NEARBY: f64 = 2.0;
/// The stress meets a strength within this part.
const MET: f64 = 1e-3;
/// A bracket this narrow is searched on one domain, so that changes of the grid do not blur the search.
const NARROW: f64 = 1.5;

/// The extreme under a load.
#[derive(Clone, Copy)]
pub struct Solved {
    /// Force, in N.
    pub force: f64,
    /// Penetration, in m.
    pub penetration: f64,
    /// Radius of the contact, in m.
    pub radius: f64,
    /// Whether the contact is beyond the model.
    pub is_beyond: bool,
    pub extreme: Extreme<3>,
    /// The domain on which the contact was solved, if its peak was only followed: the body is not searched yet.
    pub followed_on: Option<Domain>,
}

/// The result of a search.
pub enum LoadSearchResult {
    /// The strength is met, or the stress jumps beyond it, in which case it is not resolved; it grows as the force to
    /// the power `exponent`.
    Met { solved: Solved, exponent: f64 },
    /// The strength is met under no load, or under all loads; holds the load that comes nearest.
    Missed(Option<Solved>),
}

/// The loads solved so far for one criterion, and the means to solve another.
pub struct LoadSearch<'a, 'b> {
    /// Solves contacts, for all criteria.
    pub loads: &'a mut SolvedLoads<'b>,
    pub domain: Domain,
    pub sliding: Sliding,
    pub target: &'a Target,
    /// Strength, in Pa.
    pub strength: f64,
    /// What the bodies carry without a load.
    pub residual: &'a ResidualStress,
    /// The stress without a load, below the strength, in Pa.
    pub at_rest: f64,
    /// Solved loads, sorted by rising force.
    pub solved: Vec<Solved>,
    /// Whether peaks are followed from one load to the next.
    pub follows: bool,
    pub rough: &'a mut RoughDepths,
}

impl LoadSearch<'_, '_> {
    /// Searches for the smallest force at which the strength is reached.
    pub fn search(&mut self) -> Result<LoadSearchResult, ContactError> {
        let followed = self.follows;
        let found = self.search_once()?;
        if followed && !self.follows {
            // A peak that was followed is not the largest stress: the bracket may be wrong.
            let loads = self.solved.clone();
            for solved in loads {
                self.searched(solved)?;
            }
            return self.search_once();
        }
        Ok(found)
    }

    /// The search, from the loads solved so far.
    fn search_once(&mut self) -> Result<LoadSearchResult, ContactError> {
        let reached = match self.first_reached() {
            Some(reached) => Some(reached),
            None => self.reached_between()?,
        };
        let followed = self.follows;
        let Some(mut upper) = reached else {
            let largest = self.largest().copied();
            let largest = largest.map(|largest| self.searched(largest)).transpose()?;
            return Ok(LoadSearchResult::Missed(largest));
        };
        let mut tried = 0;
        let mut lower = loop {
            if let Some(lower) = self.last_before(upper.force) {
                break lower;
            }
            if tried == MOST_TRIALS {
                let upper = self.searched(upper)?;
                return Ok(LoadSearchResult::Missed(Some(upper)));
            }
            tried += 1;
            let smaller = self.solve(SMALLER * upper.force, self.domain)?;
            if self.utilisation(&smaller) >= 1.0 {
                upper = smaller;
            }
        };
        let mut exponent = self.exponent(&lower, &upper);
        let mut latest = self.nearer(lower, upper);
        let mut narrow = None;
        for trial in 0..MOST_SOLVED {
            let (low, high) = (lower.force, upper.force);
            if high / low <= NARROW && narrow.is_none() {
                narrow = Some(self.domain_for(high)?);
            }
            let force = exponent
                .filter(|_| trial < MOST_TRIALS)
                .map(|n| latest.force * self.utilisation(&latest).powf(-1.0 / n))
                .filter(|force| *force > low && *force < high)
                .unwrap_or((low * high).sqrt());
            let mut solved = match narrow {
                Some(domain) => self.solve(force, domain)?,
                None => self.solve_near(force, [low, high])?,
            };
            let is_met = |solved: &Solved, exponent: Option<f64>| {
                let apart = self.utilisation(solved).ln();
                exponent.is_some_and(|n| (apart / n).abs() <= 2.0 * ACCURACY)
            };
            let grows = self.exponent(&solved, &latest).or(exponent);
            if is_met(&solved, grows) || (high / low).ln() <= ACCURACY {
                solved = self.searched(solved)?;
            }
            let utilisation = self.utilisation(&solved);
            exponent = self.exponent(&solved, &latest).or(exponent);
            let closes = |n: f64| {
                (utilisation.ln() / n).abs() <= 2.0 * ACCURACY || (high / low).ln() <= ACCURACY
            };
            let met = exponent.filter(|n| closes(*n));
            let jumps = utilisation.ln().abs() > MET;
            if met.is_some() && jumps {
                // Below a jump the peak may be another one, too.
                self.searched(lower)?;
            }
            if followed && !self.follows {
                return Ok(LoadSearchResult::Missed(Some(solved)));
            }
            if let Some(exponent) = met {
                solved.extreme.resolved &= !jumps;
                return Ok(LoadSearchResult::Met { solved, exponent });
            }
            latest = solved;
            if utilisation >= 1.0 {
                upper = solved;
            } else {
                lower = solved;
            }
        }
        let upper = self.searched(upper)?;
        Ok(LoadSearchResult::Missed(Some(upper)))
    }

    /// The smallest solved load under which the strength is reached.
    fn first_reached(&self) -> Option<Solved> {
        let mut solved = self.solved.iter();
        solved
            .find(|solved| self.utilisation(solved) >= 1.0)
            .copied()
    }

    /// Searches for a load under which the strength is reached although no load solved so far reaches it: a stiff
    /// coating that has taken the indenter's shape bends no further, and under more load its stress falls.
    fn reached_between(&mut self) -> Result<Option<Solved>, ContactError> {
        let nearly = self
            .largest()
            .filter(|best| self.utilisation(best) >= NEARLY);
        let Some(mut best) = nearly.copied() else {
            return Ok(None);
        };
        let below = self.last_before(best.force);
        let mut ends = [
            below.map_or(SMALLER * best.force, |solved| solved.force),
            self.first_after(best.force),
        ];
        for trial in 0..MOST_TRIALS {
            // Alternately below and above the best; the stress is flat at a peak.
            let side = trial % 2;
            if (ends[side] / best.force).ln().abs() <= FLAT {
                continue;
            }
            let solved = self.solve((ends[side] * best.force).sqrt(), self.domain)?;
            if self.utilisation(&solved) >= 1.0 {
                return Ok(Some(solved));
            }
            if self.utilisation(&solved) > self.utilisation(&best) {
                ends[1 - side] = best.force;
                best = solved;
            } else if best.force >= ends[1] {
                // The stress grows up to the largest load.
                break;
            } else {
                ends[side] = solved.force;
            }
        }
        Ok(None)
    }

    /// The solved load with the largest stress.
    fn largest(&self) -> Option<&Solved> {
        let solved = self.solved.iter();
        solved.max_by(|one, other| self.utilisation(one).total_cmp(&self.utilisation(other)))
    }

    /// The smallest solved force above `force`, or `force` itself.
    fn first_after(&self, force: f64) -> f64 {
        let mut solved = self.solved.iter();
        let after = solved.find(|solved| solved.force > force);
        after.map_or(force, |solved| solved.force)
    }

    /// The largest solved load below `force`.
    fn last_before(&self, force: f64) -> Option<Solved> {
        let is_before = |solved: &&Solved| solved.force < force && solved.force > 0.0;
        self.solved.iter().rfind(is_before).copied()
    }

    /// The one of two loads that comes nearer to the strength.
    fn nearer(&self, one: Solved, other: Solved) -> Solved {
        let apart = |solved: &Solved| self.utilisation(solved).ln().abs();
        if apart(&one) < apart(&other) {
            one
        } else {
            other
        }
    }

    /// `n` of a utilisation that grows as `forceⁿ` between two loads; none if it does not grow.
    fn exponent(&self, one: &Solved, other: &Solved) -> Option<f64> {
        let [first, second] = [one, other].map(|solved| self.utilisation(solved).ln());
        let exponent = (second - first) / (other.force / one.force).ln();
        (exponent.is_finite() && exponent > 0.0).then_some(exponent)
    }

    /// The part of the strength that the load itself takes, above what the body carries without one.
    fn utilisation(&self, solved: &Solved) -> f64 {
        (solved.extreme.value - self.at_rest).max(0.0) / (self.strength - self.at_rest)
    }

    /// One domain for loads up to `force`: the given one, or one chosen for this force.
    fn domain_for(&self, force: f64) -> Result<Domain, ContactError> {
        if let Domain::Side(_) | Domain::Periodic(_) | Domain::Oblong(_) = self.domain {
            return Ok(self.domain);
        }
        Ok(Domain::Side(choose_side(
            self.loads.model,
            &[Load::Force(force)],
        )?))
    }

    /// Solves a load, or one that differs little, lies between these ends and is solved already, and finds its stress.
    fn solve_near(&mut self, force: f64, [low, high]: [f64; 2]) -> Result<Solved, ContactError> {
        let is_new = |other: f64| {
            self.solved
                .iter()
                .all(|solved| solved.force.total_cmp(&other).is_ne())
        };
        let known = self.loads.forces();
        let known = known.filter(|other| *other > low && *other < high && is_new(*other));
        let near = known.min_by(|one, other| {
            let apart = |known: &f64| (known / force).ln().abs();
            apart(one).total_cmp(&apart(other))
        });
        let near = near.filter(|known| (known / force).ln().abs() <= ALIKE.ln());
        self.solve(near.unwrap_or(force), self.domain)
    }

    /// Solves a load and finds its stress.
    fn solve(&mut self, force: f64, domain: Domain) -> Result<Solved, ContactError> {
        let domain = match domain {
            Domain::Chosen(_) => Domain::Automatic,
            domain => domain,
        };
        let path = self.loads.solve(force, domain)?;
        let step = only_step(&path)?;
        let is_nearby = |solved: &Solved| {
            let apart = (solved.force / force).ln().abs();
            solved.followed_on.is_none() && apart < NEARBY.ln()
        };
        let follows = self.follows && self.solved.iter().any(is_nearby);
        let followed = match self.expected(step.summary.contact_radius, force) {
            Some(place) if follows => {
                let finder = self.finder(&path, step);
                finder.follow(self.rough, self.target, place)?
            }
            _ => None,
        };
        let (extreme, followed_on) = match followed {
            Some(extreme) => (extreme, Some(domain)),
            None => (self.search_body(&path, step)?, None),
        };
        let solved = Solved {
            force,
            penetration: step.solution.penetration,
            radius: step.summary.contact_radius,
            is_beyond: step.beyond().is_some(),
            extreme,
            followed_on,
        };
        let place = self.solved.partition_point(|other| other.force < force);
        self.solved.insert(place, solved);
        Ok(solved)
    }

    /// Searches the whole body under a load whose peak was followed. If it is another peak, none is followed any
    /// longer.
    fn searched(&mut self, solved: Solved) -> Result<Solved, ContactError> {
        let Some(domain) = solved.followed_on else {
            return Ok(solved);
        };
        let path = self.loads.solve(solved.force, domain)?;
        let searched = Solved {
            extreme: self.search_body(&path, only_step(&path)?)?,
            followed_on: None,
            ..solved
        };
        let is_it = |other: &&mut Solved| other.force.total_cmp(&solved.force).is_eq();
        if let Some(other) = self.solved.iter_mut().find(is_it) {
            *other = searched;
        }
        let ratio = self.utilisation(&searched) / self.utilisation(&solved);
        self.follows &= ratio.ln().abs() <= ACCURACY;
        Ok(searched)
    }

    /// The extreme in the whole body, with its error.
    fn search_body(&mut self, path: &LoadingPath, step: &Step) -> Result<Extreme<3>, ContactError> {
        let targets = std::slice::from_ref(self.target);
        let finder = self.finder(path, step);
        Ok(finder.find(self.rough, targets)?[0][0])
    }

    fn finder<'p>(&self, path: &'p LoadingPath, step: &'p Step) -> ExtremeFinder<'p> {
        ExtremeFinder::new(path, step, self.sliding).with_residual(self.residual)
    }

    /// Where the peak is expected under a force with a contact of this radius: as far from the axis and the top of the
    /// body, in radii, as under the nearest load; at an end of the body it stays there.
    fn expected(&self, radius: f64, force: f64) -> Option<[f64; 3]> {
        let apart = |solved: &&Solved| (solved.force / force).ln().abs();
        let known = self.solved.iter().filter(|solved| solved.radius > 0.0);
        let nearest = known.min_by(|one, other| apart(one).total_cmp(&apart(other)))?;
        let ratio = radius / nearest.radius;
        let ([x, y, z], Target { top, bottom, .. }) = (nearest.extreme.at, self.target);
        let z = if z < *bottom {
            (top + (z - top) * ratio).min(*bottom)
        } else {
            z
        };
        (ratio > 0.0).then_some([x * ratio, y * ratio, z])
    }
}

/// The only step of a path, unless it was cancelled.
fn only_step(path: &LoadingPath) -> Result<&Step, ContactError> {
    match &path.steps[..] {
        [step] => Ok(step),
        _ => Err(ContactError::Cancelled { step: 0 }),
    }
}

#[cfg(test)]
mod tests;
