//! The distributions of a rough contact, as numbers of their picture.

use pellicle::summary::StepSummary;
use pellicle_contact::Histogram;
use pellicle_plot::step::histograms::{Distribution, RoughContact};

/// The distributions of a step; none if it has no rough contact.
#[must_use]
pub fn of_step(step: &StepSummary) -> Option<RoughContact<'_>> {
    let rough = step.rough_contact.as_ref()?;
    Some(RoughContact {
        pressures: distribution(&rough.pressures, step.summary.mean_pressure),
        gaps: distribution(&rough.gaps, rough.mean_gap),
    })
}

fn distribution(of: &Histogram, mean: f64) -> Distribution<'_> {
    Distribution {
        mean,
        largest: of.largest,
        counts: &of.counts,
    }
}
