//! What figures 2 and 5 share: runs with the fields of their only step, and the ends of axes and colours.

use pellicle_cli::results::StoredFields;

use super::note;
use super::run::PaperRun;
use super::studio::Studio;
use crate::XtaskError;

/// What is shown around the contact, as a part of it.
const MARGIN: f64 = 1.06;

/// The part of the elements in contact whose pressures the colours of a map tell apart: an edge peak would leave the
/// same dark colour to all the rest.
pub(super) const TOLD_APART: f64 = 0.95;

/// A run and the fields of its only step.
pub(super) struct Loaded {
    pub run: PaperRun,
    pub stored: StoredFields,
}

impl Loaded {
    /// The runs of these cases.
    pub(super) fn all<const N: usize>(
        studio: &mut Studio<'_>,
        cases: [&'static str; N],
    ) -> Result<Vec<Self>, XtaskError> {
        let load = |case| {
            let run = studio.fields(case)?;
            let stored = run.fields(0)?;
            Ok(Self { run, stored })
        };
        cases.into_iter().map(load).collect()
    }

    /// The largest pressure.
    pub(super) fn peak(&self) -> f64 {
        self.run.last().max_pressure
    }

    /// The pressure that all but a few of the elements in contact stay below.
    pub(super) fn common_peak(&self) -> f64 {
        let fields = self.stored.fields(self.run.side());
        let in_contact = fields.pressure.iter().copied().filter(|p| *p > 0.0);
        let mut pressures: Vec<f64> = in_contact.collect();
        pressures.sort_by(f64::total_cmp);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a part of a length"
        )]
        let at = (TOLD_APART * pressures.len() as f64) as usize;
        pressures.get(at).copied().unwrap_or(0.0)
    }

    /// The note on its data.
    pub(super) fn note(&self, name: &str) -> String {
        format!("{name}: {}", note::of_step(&self.run, self.run.last()))
    }
}

/// The largest contact and a margin.
pub(super) fn reach(loaded: &[Loaded]) -> f64 {
    let radii = loaded.iter().map(|loaded| loaded.run.last().contact_radius);
    MARGIN * radii.fold(0.0, f64::max)
}

/// The largest value, rounded up to two digits of which the second is even, so that the end of an axis is a round
/// number.
pub(super) fn rounded_up(values: impl Iterator<Item = f64>) -> f64 {
    let largest = values.fold(0.0, f64::max);
    let unit = 2.0 * 10_f64.powf(largest.log10().floor() - 1.0);
    // A value that is round already stays, whatever its last bits are.
    unit * (largest / unit - 1e-9).ceil()
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    #[test]
    fn the_end_of_an_axis_is_round_and_no_smaller_than_the_data() {
        for (value, end) in [(0.499, 0.50), (0.0434, 0.044), (4.19, 4.2), (0.5, 0.5)] {
            // A few roundings of products.
            assert_relative_eq!(rounded_up([value].into_iter()), end, max_relative = 1e-14);
        }
    }
}
