//! The grid's error bars: how often they contain the true value, and how much wider than the error they are.

mod benchmarks;

use std::fmt;

use pellicle_contact::{Domain, ErrorEstimate, Load, Model, SolverOptions, Step, solve_path};

pub use benchmarks::benchmarks;

/// A number that depends on the grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum GridQuantity {
    /// Penetration.
    Penetration,
    /// Force, under a prescribed penetration.
    Force,
    /// Contact area.
    ContactArea,
    /// Largest pressure.
    MaxPressure,
}

/// All quantities.
pub const QUANTITIES: [GridQuantity; 4] = [
    GridQuantity::Penetration,
    GridQuantity::Force,
    GridQuantity::ContactArea,
    GridQuantity::MaxPressure,
];

/// A contact whose numbers are known in closed form or from its finest grid.
pub struct Benchmark {
    /// Its name in the table.
    pub name: String,
    /// Foundation, relief and indenter.
    pub model: Model,
    /// Side of the domain, in m.
    pub side: f64,
    /// Its load.
    pub load: Load,
    /// The numbers that are known in closed form.
    pub known: Vec<(GridQuantity, f64)>,
}

/// The error bar of one number on one grid.
#[derive(Debug, Clone, Copy)]
pub struct ErrorBar {
    /// Elements per side.
    pub elements: usize,
    /// Error over half the interval.
    pub ratio: f64,
    /// Whether the number is reported as resolved.
    pub resolved: bool,
}

/// The error bars of one number over many grids.
#[derive(Debug, Clone)]
pub struct ErrorBars {
    /// The benchmark.
    pub benchmark: String,
    /// The number.
    pub quantity: GridQuantity,
    /// One per grid.
    pub bars: Vec<ErrorBar>,
}

impl Benchmark {
    /// Computes the error bars on `grids`. Numbers without a closed form are taken from a grid of `finest` elements per
    /// side, and judged on grids of at most half as many.
    ///
    /// # Panics
    /// If a grid cannot be solved.
    #[must_use]
    pub fn rows(&self, grids: &[usize], finest: usize) -> Vec<ErrorBars> {
        let reference = self.step(finest);
        let steps: Vec<(usize, Step)> = grids.iter().map(|n| (*n, self.step(*n))).collect();
        let prescribed = match self.load {
            Load::Force(_) => GridQuantity::Force,
            Load::Penetration(_) => GridQuantity::Penetration,
        };
        let quantities = QUANTITIES
            .into_iter()
            .filter(|quantity| *quantity != prescribed);
        quantities
            .map(|quantity| {
                let known = self.known.iter().find(|(known, _)| *known == quantity);
                let truth = known.map_or_else(|| quantity.value(&reference), |(_, value)| *value);
                let judged =
                    |(elements, _): &&(usize, Step)| known.is_some() || 2 * elements <= finest;
                let bar = |(elements, step): &(usize, Step)| {
                    ErrorBar::of(*elements, quantity, step, truth)
                };
                ErrorBars {
                    benchmark: self.name.clone(),
                    quantity,
                    bars: steps.iter().filter(judged).map(bar).collect(),
                }
            })
            .collect()
    }

    fn step(&self, elements: usize) -> Step {
        let (domain, options) = (Domain::Side(self.side), SolverOptions::default());
        let path = solve_path(
            &self.model,
            domain,
            elements,
            &[self.load],
            &options,
            &mut (),
        );
        path.expect("a solution").steps.remove(0)
    }
}

impl GridQuantity {
    /// The number in a step.
    #[must_use]
    pub fn value(self, step: &Step) -> f64 {
        match self {
            Self::Penetration => step.solution.penetration,
            Self::Force => step.solution.force,
            Self::ContactArea => step.summary.contact_area,
            Self::MaxPressure => step.summary.max_pressure,
        }
    }

    /// Its error bar in a step.
    #[must_use]
    pub fn estimate(self, step: &Step) -> Option<ErrorEstimate> {
        let error = &step.grid_error;
        match self {
            Self::Penetration => error.penetration,
            Self::Force => error.force,
            Self::ContactArea => error.contact_area,
            Self::MaxPressure => error.max_pressure,
        }
    }
}

impl ErrorBar {
    /// A number without an error bar is not resolved.
    fn of(elements: usize, quantity: GridQuantity, step: &Step, truth: f64) -> Self {
        let error = (quantity.value(step) - truth).abs();
        let estimate = quantity.estimate(step);
        Self {
            elements,
            ratio: estimate.map_or(f64::NAN, |estimate| error / estimate.estimate),
            resolved: estimate.is_some_and(|estimate| estimate.resolved),
        }
    }
}

impl ErrorBars {
    /// Numbers reported as resolved.
    pub fn resolved(&self) -> impl Iterator<Item = &ErrorBar> {
        self.bars.iter().filter(|bar| bar.resolved)
    }

    /// Number of resolved values whose error exceeds `times` half the interval.
    #[must_use]
    pub fn above(&self, times: f64) -> usize {
        self.resolved().filter(|bar| bar.ratio > times).count()
    }

    /// Median of half the interval over the error; NaN if nothing is resolved.
    #[must_use]
    pub fn width(&self) -> f64 {
        1.0 / median(self.resolved().map(|bar| bar.ratio).collect())
    }

    /// The largest error over half the interval.
    #[must_use]
    pub fn worst(&self) -> f64 {
        self.resolved().map(|bar| bar.ratio).fold(0.0, f64::max)
    }
}

/// The fraction of resolved numbers that lie within their interval, and the median of half the interval over the error.
#[must_use]
pub fn coverage(rows: &[ErrorBars]) -> (f64, f64) {
    let ratios: Vec<f64> = rows
        .iter()
        .flat_map(ErrorBars::resolved)
        .map(|bar| bar.ratio)
        .collect();
    let within = ratios.iter().filter(|ratio| **ratio <= 1.0).count();
    (within as f64 / ratios.len() as f64, 1.0 / median(ratios))
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// `count` grids from `first` to `last` elements per side, as evenly spaced in the logarithm as integers allow,
/// including odd ones.
#[must_use]
pub fn grids(count: usize, first: usize, last: usize) -> Vec<usize> {
    let (low, high) = ((first as f64).ln(), (last as f64).ln());
    let at = |i: usize| {
        (low + (high - low) * i as f64 / (count - 1) as f64)
            .exp()
            .round()
    };
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between two sizes"
    )]
    let mut grids: Vec<usize> = (0..count).map(|i| at(i) as usize).collect();
    grids.dedup();
    grids
}

impl fmt::Display for GridQuantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Penetration => "penetration",
            Self::Force => "force",
            Self::ContactArea => "contact area",
            Self::MaxPressure => "largest pressure",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(ratios: &[f64]) -> ErrorBars {
        let bar = |ratio: &f64| ErrorBar {
            elements: 64,
            ratio: *ratio,
            resolved: ratio.is_finite(),
        };
        ErrorBars {
            benchmark: String::new(),
            quantity: GridQuantity::Force,
            bars: ratios.iter().map(bar).collect(),
        }
    }

    #[test]
    fn unresolved_numbers_are_not_counted() {
        let row = row(&[0.5, f64::NAN, 1.5, 4.0]);
        assert_eq!(
            (row.resolved().count(), row.above(1.0), row.above(3.0)),
            (3, 2, 1)
        );
        assert_eq!((row.worst(), row.width()), (4.0, 1.0 / 1.5));
        assert!((coverage(&[row]).0 - 1.0 / 3.0).abs() < 1e-15);
    }

    #[test]
    fn grids_reach_from_the_first_to_the_last() {
        let grids = grids(60, 48, 1536);
        assert_eq!((grids.len(), grids[0], grids[59]), (60, 48, 1536));
        assert!(grids.iter().any(|n| n % 2 == 1));
    }
}
