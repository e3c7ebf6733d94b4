//! The scans of the profiles of all unknowns.

use super::{
    Fitting,
    intervals::{Interval, Reach, Scanned, Sought},
};
use crate::{
    IdentifyError, Intervals,
    distribution::student_quantile,
    orthonormal_basis::OrthonormalBasis,
    predictor::Predictor,
    profile::{LikelihoodProfile, Scan},
    refinement::Refined,
};

/// The lower and upper end of an interval, each with its outward direction.
const SIDES: [(usize, f64); 2] = [(0, -1.0), (1, 1.0)];

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
        // The unknown comes last, so that it is the column to be dropped if it depends on the others.
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

    /// Computes the intervals of all unknowns; from the covariance where the model ends the scans.
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

    /// Continues a scan where the evaluations of all scans suggest that the interval reaches farther.
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
