//! The information of measurements in few rows: the triangle `R` of `J = Q R`, so that `RᵀR = JᵀJ` and no digits are
//! lost by squaring.

use std::ops::Range;

use super::Plan;
use crate::{
    Curve, IdentifyError, Prediction, noise::whitener::Whitener, nuisance::NuisanceColumn,
    orthonormal_basis::OrthonormalBasis, predictor::Evaluation,
};

/// The information of curves about the unknowns and about the nuisances that all measurements share.
#[derive(Debug, Clone)]
pub struct Information {
    /// Columns of the shared nuisances, then of the unknowns, in their coordinates.
    columns: Vec<Vec<f64>>,
}

/// Nuisances of all measurements and of single curves.
struct Nuisances {
    shared: Vec<NuisanceColumn>,
    own: Vec<NuisanceColumn>,
}

impl Information {
    pub(super) fn of(
        plan: &Plan,
        prediction: &Prediction,
        curves: &[Curve],
    ) -> Result<Self, IdentifyError> {
        let Nuisances { shared, own } = Nuisances::of(plan, curves)?;
        let spans = spans(curves);
        let (value, slope) = (&prediction.value, &prediction.slope);
        let whitener = Whitener::new(&plan.noise, [value, slope], &[], &spans);
        let whitened = |mut column: Vec<f64>| {
            whitener.whiten(&mut column);
            column
        };
        let at = Evaluation::of(&plan.unknowns, &plan.truth, prediction.clone());
        let jacobian: Vec<_> = at.jacobian.into_iter().map(&whitened).collect();
        let shared = shared
            .into_iter()
            .map(|column| whitened(column.with_slopes(slope)));
        let columns: Vec<_> = shared.chain(jacobian.iter().cloned()).collect();
        let mut all = vec![Vec::new(); columns.len()];
        for (curve, span) in spans.iter().enumerate() {
            let mut eliminated = OwnColumns::new(span);
            for column in own.iter().filter(|column| column.curve == Some(curve)) {
                let sd = column.prior.map(|[_, sd]| sd);
                eliminated.push(&whitened(column.with_slopes(slope)), sd);
            }
            let left = compressed(eliminated.remove_from(&columns));
            all.iter_mut()
                .zip(left)
                .for_each(|(all, of)| all.extend(of));
        }
        let columns = compressed(all);
        Ok(Self { columns })
    }

    /// The columns of the unknowns from several measurements together, priors included and shared nuisances eliminated.
    pub(super) fn jacobian(plan: &Plan, measurements: &[&Self]) -> Vec<Vec<f64>> {
        let nuisances = plan.nuisances.iter();
        let priors: Vec<_> = nuisances
            .filter(|nuisance| nuisance.is_common())
            .map(|nuisance| nuisance.prior(None).map(|[_, sd]| sd.recip()))
            .chain(
                plan.unknowns
                    .iter()
                    .zip(&plan.truth)
                    .map(|(unknown, value)| {
                        let slope = unknown.prior()?.deviation_slope(*value);
                        Some(slope * unknown.value_slope(*value))
                    }),
            )
            .collect();
        let mut columns = vec![Vec::new(); priors.len()];
        for of in measurements {
            for (all, column) in columns.iter_mut().zip(&of.columns) {
                all.extend_from_slice(column);
            }
        }
        for (index, prior) in priors.iter().enumerate() {
            let Some(prior) = prior else {
                continue;
            };
            for (other, column) in columns.iter_mut().enumerate() {
                column.push(if other == index { *prior } else { 0.0 });
            }
        }
        let mut unknowns = columns.split_off(priors.len() - plan.unknowns.len());
        let shared = OrthonormalBasis::of(columns);
        for column in &mut unknowns {
            shared.remove_from(column);
        }
        unknowns
    }
}

impl Nuisances {
    fn of(plan: &Plan, curves: &[Curve]) -> Result<Self, IdentifyError> {
        let mut all = Vec::new();
        for nuisance in &plan.nuisances {
            all.extend(nuisance.columns(curves)?);
        }
        let (shared, own) = all.into_iter().partition(|column| column.curve.is_none());
        Ok(Self { shared, own })
    }
}

/// One curve's own nuisances, with one more row for each prior.
struct OwnColumns<'a> {
    span: &'a Range<usize>,
    columns: Vec<(Vec<f64>, Option<f64>)>,
}

impl<'a> OwnColumns<'a> {
    fn new(span: &'a Range<usize>) -> Self {
        Self {
            span,
            columns: Vec::new(),
        }
    }

    fn push(&mut self, column: &[f64], sd: Option<f64>) {
        self.columns.push((column[self.span.clone()].to_vec(), sd));
    }

    /// Restricts other columns to the points of the curve and projects them off its own.
    fn remove_from(self, others: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let points = self.span.len();
        let rows = points + self.columns.iter().filter(|(_, sd)| sd.is_some()).count();
        let mut row = points;
        let own = self.columns.into_iter().map(|(mut column, sd)| {
            column.resize(rows, 0.0);
            if let Some(sd) = sd {
                column[row] = sd.recip();
                row += 1;
            }
            column
        });
        let own = OrthonormalBasis::of(own);
        let left = others.iter().map(|column| {
            let mut column = column[self.span.clone()].to_vec();
            column.resize(rows, 0.0);
            own.remove_from(&mut column);
            column
        });
        left.collect()
    }
}

/// The columns expressed in the orthonormal basis that they span.
fn compressed(mut columns: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let basis = OrthonormalBasis::of(columns.iter().cloned());
    let all = columns.iter_mut().map(|column| basis.remove_from(column));
    all.collect()
}

fn spans(curves: &[Curve]) -> Vec<Range<usize>> {
    let mut first = 0;
    let span = |curve: &Curve| {
        let span = first..first + curve.points();
        first = span.end;
        span
    };
    curves.iter().map(span).collect()
}
