//! The interval of an unknown among the others, from its profile or from the covariance.

use std::rc::Rc;

use crate::{
    Problem, Stopped,
    null_direction::Hold,
    predictor::Evaluation,
    profile::{Open, ProfileSide},
    verdict::{Ends, wald_ends},
};

/// One unknown among the others.
pub(super) struct Sought {
    pub unknown: usize,
    /// Its coordinate in the best fit.
    pub position: f64,
    /// The unknowns held so that the data determine it; `None` if no data can.
    pub hold: Option<Hold>,
    /// The other free unknowns.
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

/// How far the search for an interval got.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Reach {
    /// Complete.
    Whole,
    /// As far as the best fit: the ends come from the covariance instead of a profile.
    BestFit,
    /// Not as far as the best fit.
    Nowhere,
}

/// The result of the scans of all unknowns.
pub(super) enum Scanned {
    All(Vec<Interval>),
    /// A better fit, found by the profile of this unknown.
    Better(usize, Rc<Evaluation>),
}

impl Interval {
    /// The best fit as the only point.
    pub fn of(one: &Sought) -> Self {
        Self {
            points: vec![(one.position, 0.0)],
            ..Sought::no_interval(Reach::Whole)
        }
    }

    pub fn take(&mut self, end: usize, side: ProfileSide) {
        self.ends[end] = side.end;
        self.points.extend(side.points);
    }
}

impl Sought {
    /// `x ± t s`, open on a side that exceeds its bound.
    pub fn wald_interval(&self, problem: &Problem) -> Interval {
        let half = self.quantile * self.standard_error;
        Interval {
            ends: wald_ends(&problem.unknowns()[self.unknown], self.position, half),
            points: Vec::new(),
            reach: Reach::Whole,
        }
    }

    /// `x ± t s` instead of a profile, for a fit that was stopped.
    pub fn without_profile(&self, problem: &Problem) -> Interval {
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

/// The unknowns whose profile is missing, if any.
pub(super) fn missing_profiles(intervals: &[Interval]) -> Option<Stopped> {
    let missing = intervals.iter().enumerate();
    let missing = missing.filter(|(_, interval)| interval.reach == Reach::BestFit);
    let missing: Vec<usize> = missing.map(|(unknown, _)| unknown).collect();
    (!missing.is_empty()).then_some(Stopped::Profiles(missing))
}
