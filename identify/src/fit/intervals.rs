//! The intervals of all unknowns, from profiles or from the covariance.

use std::rc::Rc;

use super::Fitting;
use crate::{
    IdentifyError, Intervals, Problem,
    distribution::student_quantile,
    null_direction::Hold,
    predictor::{Evaluation, Predictor},
    profile::{Open, Profile, Scan},
    projection::Projection,
    refinement::Refined,
    verdict::Ends,
};

/// One unknown among the others.
pub(super) struct Sought {
    pub unknown: usize,
    /// Its place in the best fit, in its coordinate.
    pub position: f64,
    /// What is held so that the data tell it; nothing where no data do.
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

/// What the scans of all unknowns found.
pub(super) enum Scanned {
    All(Vec<Interval>),
    /// A better fit, by the profile of this unknown.
    Better(usize, Rc<Evaluation>),
}

impl Sought {
    /// `x ± t s`, as far as the bounds.
    pub fn wald_interval(&self, problem: &Problem) -> Interval {
        let [low, high] = problem.unknowns()[self.unknown].bounds();
        let half = self.quantile * self.standard_error;
        let (down, up) = (self.position - half, self.position + half);
        let closed = |inside: bool, end: f64| if inside { Ok(end) } else { Err(Open::Bound) };
        Interval {
            ends: [closed(down >= low, down), closed(up <= high, up)],
            points: Vec::new(),
            reach: Reach::Whole,
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
        let variance = Projection::of(columns).inverse_gram()[others.len()][others.len()];
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
            match self.profile(predictor, refined, one) {
                Ok(Ok(interval)) => intervals.push(interval),
                Ok(Err(better)) => return Ok(Scanned::Better(one.unknown, better)),
                Err(IdentifyError::Stopped { .. }) => intervals.push(Interval {
                    reach: Reach::BestFit,
                    ..one.wald_interval(self.problem)
                }),
                Err(error) => return Err(error),
            }
        }
        Ok(Scanned::All(intervals))
    }

    /// Both sides of a profile; `Err` is a better fit.
    fn profile(
        &self,
        predictor: &mut Predictor,
        refined: &Refined,
        one: &Sought,
    ) -> Result<Result<Interval, Rc<Evaluation>>, IdentifyError> {
        let profile = Profile {
            problem: self.problem,
            metric: &refined.metric,
            best: &refined.minimum,
            unknown: one.unknown,
            others: &one.others,
            standard_error: one.standard_error,
            target: one.quantile,
        };
        let mut ends = [Err(Open::Bound); 2];
        let mut points = vec![(one.position, 0.0)];
        let mut bend = None;
        for (end, sign) in ends.iter_mut().zip([-1.0, 1.0]) {
            match profile.side(predictor, sign, bend.as_ref())? {
                Scan::Better(at) => return Ok(Err(at)),
                Scan::Side(side) => {
                    *end = side.end;
                    points.extend(side.points);
                    bend = side.bend;
                }
            }
        }
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        Ok(Ok(Interval {
            ends,
            points,
            reach: Reach::Whole,
        }))
    }
}
