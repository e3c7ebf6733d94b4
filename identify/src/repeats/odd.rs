//! Repeats far from the others, and what the others alone give.

use super::{CurveFit, Repeats, State, discordant::farthest};
use crate::IdentifyError;

/// Repeats whose parameters lie far from those of the others. They are in the fit: a soft place of a specimen is a
/// measurement of it.
#[derive(Debug, Clone, PartialEq)]
pub struct OddRepeats {
    /// The repeats, the farthest first; fewer than half of all.
    pub curves: Vec<OddRepeat>,
    /// What the others alone give, for each answer that they determine.
    pub without: Vec<WithoutOdd>,
}

/// A repeat far from the others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OddRepeat {
    /// Index of the curve, from 0.
    pub curve: usize,
    /// Index of the unknown in which it is farthest.
    pub unknown: usize,
    /// Its distance from the median, in units of the standard deviation of the others or of its own.
    pub deviation: f64,
}

/// An answer without the odd repeats.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WithoutOdd {
    /// Index of the unknown.
    pub unknown: usize,
    /// Its common value.
    pub value: f64,
    /// The interval of that, at the level of the fit.
    pub interval: [f64; 2],
    /// Standard deviation between the repeats.
    pub scatter: f64,
}

impl Repeats<'_> {
    /// The odd repeats of a fit at its common values; none if no curve lies far from the others.
    pub(super) fn odd(
        &self,
        state: &State,
        curves: &[CurveFit],
    ) -> Result<Option<OddRepeats>, IdentifyError> {
        let columns = self.scattered();
        let mut others: Vec<&CurveFit> = curves.iter().collect();
        let mut odd = Vec::new();
        while let Some(found) = farthest(&others, &columns) {
            if 2 * (odd.len() + 1) >= curves.len() {
                break;
            }
            odd.push(OddRepeat {
                curve: others.remove(found.place).index,
                unknown: self.determined[found.column],
                deviation: found.deviation,
            });
        }
        if odd.is_empty() {
            return Ok(None);
        }
        let others: Vec<CurveFit> = others.into_iter().cloned().collect();
        Ok(Some(OddRepeats {
            curves: odd,
            without: self.without(state, &others)?,
        }))
    }

    /// The answers of some of the curves.
    fn without(
        &self,
        state: &State,
        curves: &[CurveFit],
    ) -> Result<Vec<WithoutOdd>, IdentifyError> {
        let model = self.mixed_model(curves, state);
        let common = model.solve(&self.guess(curves))?;
        let unknowns = self.problem.unknowns();
        let of_column = |(&column, scatter): (&usize, &f64)| {
            let unknown = self.determined[column];
            let parameter = &unknowns[unknown];
            let x = state.at.position[unknown] + common.correction[column];
            let half = self.half_width(state, curves, &common, &model, unknown)?;
            let value = parameter.value_beyond(x);
            Ok(WithoutOdd {
                unknown,
                value,
                interval: [x - half, x + half].map(|x| parameter.value_beyond(x)),
                scatter: scatter * parameter.value_slope(value),
            })
        };
        let answers = model.scattered.iter().zip(&common.scatter);
        answers
            .filter(|(column, _)| !self.null_space.moves(self.determined[**column]))
            .map(of_column)
            .collect()
    }
}
