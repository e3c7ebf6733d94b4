//! The largest step of depth in a loading, where a pop-in ends its elastic part.

/// A step is a pop-in if it is so many times the median of all.
const TIMES_MEDIAN: f64 = 10.0;
/// Steps directly before the largest one belong to it from this fraction of it on: a pop-in may take several samples.
const FRACTION_OF_LARGEST: f64 = 0.02;

/// The largest step of depth between neighbouring points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DepthStep {
    /// Index of the last point before it.
    pub last_before: usize,
    /// Its height, m: that of its largest part, if it takes several samples.
    pub height: f64,
    /// The median of all steps without their signs, m.
    pub median: f64,
}

impl DepthStep {
    /// The largest step between points of neighbouring rows; none without such points.
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

    /// Whether it stands out from the others.
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
    fn a_step_of_several_samples_begins_at_the_first() {
        let depths = [
            0.0, 1.0, 2.0, 3.1, 14.0, 114.0, 150.0, 151.0, 152.0, 153.0, 154.0,
        ];
        let rows: Vec<_> = (0..depths.len()).collect();
        let step = DepthStep::find(&depths, &rows).unwrap();
        assert_eq!((step.last_before, step.height), (3, 100.0));
        assert!(step.stands_out());
    }

    #[test]
    fn a_gap_in_the_rows_is_no_step() {
        let step = DepthStep::find(&[0.0, 1.0, 50.0, 51.5], &[0, 1, 7, 8]).unwrap();
        assert_eq!((step.last_before, step.height), (2, 1.5));
        assert!(!step.stands_out());
        assert_eq!(DepthStep::find(&[1.0], &[0]), None);
    }
}
