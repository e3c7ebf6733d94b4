//! The intervals of all unknowns, from profiles or from the covariance.

use std::rc::Rc;

use super::Fitting;
use crate::{
    IdentifyError, Intervals, Problem,
    distribution::student_quantile,
    null_direction::Hold,
    orthonormal_basis::OrthonormalBasis,
    predictor::{Evaluation, Predictor},
    profile::{LikelihoodProfile, Open, ProfileSide, Scan},
    refinement::Refined,
    verdict::{Ends, wald_ends},
};

/// One unknown among the others.
pub(super) struct Sought {
    pub unknown: usize,
    /// Its place in the best fit, in its coordinate.
    pub position: f64,
    /// The unknowns held so that the data determine it; none where no data do.
    pub hold: Option<Hold>,
    /// The unknowns that are free beside it.
    pub others: Vec<usize>,
    /// Standard error in its coordinate.
    pub standard_error: f64,
    /// Degrees of freedom behind it.
    pub degrees: f64,
    /// Two-sided quantile of Student's distribution.
    pub quantile: f64,
}

/// An interval in the coordinate of the unknown, and the points of its profile, `x` and `Δ`, in order.
pub(super) struct Interval {
    pub ends: Ends,
    pub points: Vec<(f64, f64)>,
    pub reach: Reach,
}

/// How far the search for an interval came.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Reach {
    /// To its end.
    Whole,
    /// To the best fit: the ends are those of the covariance, in place of a profile.
    BestFit,
    /// Not to the best fit.
    Nowhere,
}

/// The lower end of an interval and the upper one, with the direction outward.
const SIDES: [(usize, f64); 2] = [(0, -1.0), (1, 1.0)];

/// The result of the scans of all unknowns.
pub(super) enum Scanned {
    All(Vec<Interval>),
    /// A better fit, by the profile of this unknown.
    Better(usize, Rc<Evaluation>),
}

impl Interval {
    /// The best fit alone.
    fn of(one: &Sought) -> Self {
        Self {
            points: vec![(one.position, 0.0)],
            ..Sought::no_interval(Reach::Whole)
        }
    }

    fn take(&mut self, end: usize, side: ProfileSide) {
        self.ends[end] = side.end;
        self.points.extend(side.points);
    }
}

impl Sought {
    /// `x ± t s`, as far as the bounds.
    pub fn wald_interval(&self, problem: &Problem) -> Interval {
        let half = self.quantile * self.standard_error;
        Interval {
            ends: wald_ends(&problem.unknowns()[self.unknown], self.position, half),
            points: Vec::new(),
            reach: Reach::Whole,
        }
    }

    /// `x ± t s` in place of a profile that the model ended.
    fn without_profile(&self, problem: &Problem) -> Interval {
        Interval {
            reach: Reach::BestFit,
            ..self.wald_interval(problem)
        }
    }

    /// Open on both sides.
    pub fn no_interval(reach: Reach) -> Interval {
        Interval {
            ends: [Err(Open::Bound), Err(Open::Bound)],
            points: Vec::new(),
            reach,
        }
    }
}

impl Fitting<'_> {
    /// Each unknown with its standard error.
    pub(super) fn sought(&self, refined: &Refined) -> Result<Vec<Sought>, IdentifyError> {
        let degrees = self.degrees(refined)?;
        (0..self.problem.unknowns().len())
            .map(|unknown| self.one_sought(refined, unknown, degrees[unknown]))
            .collect()
    }

    fn one_sought(
        &self,
        refined: &Refined,
        unknown: usize,
        degrees: f64,
    ) -> Result<Sought, IdentifyError> {
        let hold = self.null_space.hold_for(unknown)?;
        let held = hold.as_ref().map_or(&[][..], |hold| &hold.held);
        let others: Vec<usize> = (0..self.problem.unknowns().len())
            .filter(|j| *j != unknown && !held.contains(j))
            .collect();
        let jacobian = &refined.minimum.system.jacobian;
        // The unknown comes last, so that one that depends on the others is the one to be dropped.
        let columns = others
            .iter()
            .chain([&unknown])
            .map(|&j| jacobian[j].clone());
        let variance = OrthonormalBasis::of(columns).inverse_gram()[others.len()][others.len()];
        Ok(Sought {
            unknown,
            position: refined.minimum.at.position[unknown],
            hold,
            others,
            standard_error: variance.sqrt(),
            degrees,
            quantile: student_quantile(self.options.level, degrees),
        })
    }

    /// The intervals of all unknowns; those of the covariance where the model ends the scans.
    pub(super) fn scan(
        &self,
        predictor: &mut Predictor,
        refined: &Refined,
        sought: &[Sought],
    ) -> Result<Scanned, IdentifyError> {
        let mut intervals = Vec::with_capacity(sought.len());
        for one in sought {
            if one.hold.is_none() {
                intervals.push(Sought::no_interval(Reach::Whole));
                continue;
            }
            if self.options.intervals == Intervals::Wald {
                intervals.push(one.wald_interval(self.problem));
                continue;
            }
            let profile = self.profile(refined, one);
            let mut interval = Interval::of(one);
            let mut bend = None;
            for (k, sign) in SIDES {
                match profile.side(predictor, sign, bend.as_ref()) {
                    Ok(Scan::Better(at)) => return Ok(Scanned::Better(one.unknown, at)),
                    Ok(Scan::Side(mut side)) => {
                        bend = side.bend.take();
                        interval.take(k, side);
                    }
                    Err(IdentifyError::Stopped { .. }) => {
                        interval = one.without_profile(self.problem);
                        break;
                    }
                    Err(error) => return Err(error),
                }
            }
            intervals.push(interval);
        }
        self.extend(predictor, refined, sought, intervals)
    }

    /// Scans on where the evaluations of all scans promise that an interval reaches farther.
    fn extend(
        &self,
        predictor: &mut Predictor,
        refined: &Refined,
        sought: &[Sought],
        mut intervals: Vec<Interval>,
    ) -> Result<Scanned, IdentifyError> {
        for (one, interval) in sought.iter().zip(&mut intervals) {
            if interval.points.is_empty() {
                continue;
            }
            let profile = self.profile(refined, one);
            for (k, sign) in SIDES {
                let Ok(end) = interval.ends[k] else { continue };
                match profile.beyond(predictor, end, sign) {
                    Ok(Some(Scan::Better(at))) => return Ok(Scanned::Better(one.unknown, at)),
                    Ok(Some(Scan::Side(side))) => interval.take(k, side),
                    Ok(None) => {}
                    Err(IdentifyError::Stopped { .. }) => {
                        *interval = one.without_profile(self.problem);
                        break;
                    }
                    Err(error) => return Err(error),
                }
            }
        }
        for interval in &mut intervals {
            interval.points.sort_by(|a, b| a.0.total_cmp(&b.0));
        }
        Ok(Scanned::All(intervals))
    }

    fn profile<'s>(&'s self, refined: &'s Refined, one: &'s Sought) -> LikelihoodProfile<'s, 's> {
        LikelihoodProfile {
            problem: self.problem,
            metric: &refined.metric,
            best: &refined.minimum,
            unknown: one.unknown,
            others: &one.others,
            standard_error: one.standard_error,
            target: one.quantile,
        }
    }
}
