//! The points of a fit at which its model does not hold.

use std::collections::BTreeMap;

use pellicle_identify::Invalidity;

use super::curve_source::{CurveSource, OutsidePoint};
use super::findings::ExcludedResult;

/// Points at which the model does not hold.
#[derive(Debug, Clone, Default)]
pub struct Outside {
    /// For each point measured in contact, the reason why the model does not hold, if so; empty if there are no such
    /// points.
    pub invalid: Vec<Option<Invalidity>>,
    /// The points of each curve; empty if there are none.
    pub points: Vec<Vec<OutsidePoint>>,
    /// Their handling.
    pub handling: Handling,
    /// The points of each curve at which the grid's error is too large for the noise, if they are in the fit because
    /// too few would be left without them; its intervals include that error. Empty otherwise.
    pub inaccurate: Vec<Vec<OutsidePoint>>,
    /// The reason why the points could not be determined, if any.
    pub failure: Option<String>,
}

/// The handling of the points at which the model does not hold.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Handling {
    /// The points are not in the fit.
    #[default]
    LeftOut,
    /// The points are in the fit, as the fit file requests.
    Kept,
    /// The points are not in the fit, but the fit without them gives other points.
    Unsettled,
    /// The points are in the fit because too few would be left without them.
    TooFewLeft,
    /// The points are in the fit, which did not converge.
    NotConverged,
}

impl Outside {
    /// The points at which the model does not hold, of curves with these reasons, one for each point of all.
    #[must_use]
    pub fn of(invalid: Vec<Option<Invalidity>>, sources: &[CurveSource]) -> Self {
        if invalid.iter().all(Option::is_none) {
            return Self::default();
        }
        let mut first = 0;
        let points = sources.iter().map(|source| {
            let end = first + source.abscissa.len();
            let points = source.outside(&invalid[first..end]);
            first = end;
            points
        });
        Self {
            points: points.collect(),
            invalid,
            ..Self::default()
        }
    }

    /// These points and those found earlier.
    #[must_use]
    pub fn and(self, earlier: &Self, sources: &[CurveSource]) -> Self {
        if self.invalid.is_empty() || earlier.invalid.is_empty() {
            return if self.invalid.is_empty() {
                earlier.clone()
            } else {
                self
            };
        }
        let pairs = earlier.invalid.iter().zip(&self.invalid);
        let both = pairs.map(|(earlier, now)| earlier.or(*now)).collect();
        Self {
            inaccurate: self.inaccurate,
            failure: self.failure,
            ..Self::of(both, sources)
        }
    }

    /// The same points, except that those at which only the grid's error is too large may be in the fit.
    #[must_use]
    pub fn with_inaccurate(self) -> Self {
        let invalid = self.invalid.into_iter();
        let invalid: Vec<_> = invalid
            .map(|reason| reason.filter(|reason| *reason != Invalidity::Inaccurate))
            .collect();
        let apart = self.points.into_iter().map(|points| {
            let points = points.into_iter();
            points.partition(OutsidePoint::is_inaccurate)
        });
        let (inaccurate, points): (Vec<_>, Vec<_>) = apart.unzip();
        // As if they had never been found, so that no others is the same as none.
        let none = invalid.iter().all(Option::is_none);
        Self {
            points: if none { Vec::new() } else { points },
            invalid: if none { Vec::new() } else { invalid },
            inaccurate,
            ..self
        }
    }

    /// Whether there are points that only the grid's error leaves out.
    #[must_use]
    pub fn has_inaccurate(&self) -> bool {
        self.points
            .iter()
            .flatten()
            .any(OutsidePoint::is_inaccurate)
    }

    /// Whether points are in the fit at which the grid's error is too large for the noise.
    #[must_use]
    pub fn includes_inaccurate(&self) -> bool {
        self.inaccurate.iter().any(|points| !points.is_empty())
    }

    /// Whether the points are left out of the fit.
    #[must_use]
    pub fn are_left_out(&self) -> bool {
        matches!(self.handling, Handling::LeftOut | Handling::Unsettled)
    }

    /// Counts the points left out of the fit, by reason.
    #[must_use]
    pub fn excluded(&self) -> Vec<ExcludedResult> {
        if !self.are_left_out() {
            return Vec::new();
        }
        let mut counts: BTreeMap<String, usize> = BTreeMap::new();
        for point in self.points.iter().flatten() {
            *counts.entry(point.reason.to_string()).or_default() += 1;
        }
        let reasons = counts.into_iter();
        reasons
            .map(|(reason, count)| ExcludedResult { reason, count })
            .collect()
    }
}
