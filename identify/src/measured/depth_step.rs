//! The largest depth step of a loading, a pop-in that ends its elastic part.

/// A step is a pop-in if it is larger than this many times the median of all steps.
const TIMES_MEDIAN: f64 = 10.0;
/// Steps directly before the largest one belong to it if larger than this fraction of it: a pop-in may span several
/// samples.
const FRACTION_OF_LARGEST: f64 = 0.02;

/// The largest depth step between neighbouring points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DepthStep {
    /// Index of the last point before the step.
    pub last_before: usize,
    /// Its height, m; if it spans several samples, that of its largest part.
    pub height: f64,
    /// The median of the absolute values of all steps, m.
    pub median: f64,
}

impl DepthStep {
    /// Finds the largest step between points of neighbouring rows; none without such points.
    #[must_use]
    pub fn find(depths: &[f64], rows: &[usize]) -> Option<Self> {
        let is_neighbour = |pair: &[usize]| pair[1] == pair[0] + 1;
        let steps: Vec<_> = (depths.windows(2).zip(rows.windows(2)))
            .map(|(depths, rows)| is_neighbour(rows).then(|| depths[1] - depths[0]))
            .collect();
        let largest = (steps.iter().enumerate())
            .filter_map(|(place, step)| Some((place, (*step)?)))
            .max_by(|a, b| a.1.total_cmp(&b.1));
        let (mut last_before, height) = largest?;
        let median = median(steps.iter().flatten().map(|step| step.abs()).collect())?;
        let belongs = |step: f64| step > (TIMES_MEDIAN * median).max(FRACTION_OF_LARGEST * height);
        while last_before > 0 && steps[last_before - 1].is_some_and(belongs) {
            last_before -= 1;
        }
        Some(Self {
            last_before,
            height,
            median,
        })
    }

    /// Whether the step stands out from the others.
    #[must_use]
    pub fn stands_out(&self) -> bool {
        self.height > TIMES_MEDIAN * self.median
    }
}

fn median(mut values: Vec<f64>) -> Option<f64> {
    let middle = values.len() / 2;
    (middle < values.len()).then(|| *values.select_nth_unstable_by(middle, f64::total_cmp).1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_over_several_samples_begins_at_the_first() {
        let depths = [
            0.0, 1.0, 2.0, 3.1, 14.0, 114.0, 150.0, 151.0, 152.0, 153.0, 154.0,
        ];
        let rows: Vec<_> = (0..depths.len()).collect();
        let step = DepthStep::find(&depths, &rows).unwrap();
        assert_eq!((step.last_before, step.height), (3, 100.0));
        assert!(step.stands_out());
    }

    #[test]
    fn a_gap_in_the_rows_is_not_a_step() {
        let step = DepthStep::find(&[0.0, 1.0, 50.0, 51.5], &[0, 1, 7, 8]).unwrap();
        assert_eq!((step.last_before, step.height), (2, 1.5));
        assert!(!step.stands_out());
        assert_eq!(DepthStep::find(&[1.0], &[0]), None);
    }
}
