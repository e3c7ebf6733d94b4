//! Equidistant lines through the coordinates of points along one axis.

/// The part of the widest gap up to which neighbouring coordinates are of one line. Points that are off their lines by
/// a tenth of the spacing leave gaps of 0.2 within a line; two lines in a row may have no points at all.
const WITHIN_A_LINE: f64 = 0.25;

/// Equidistant coordinates, in the unit of the file.
#[derive(Debug)]
pub struct GridLines {
    first: f64,
    distance: f64,
    /// The number of lines.
    pub count: usize,
}

impl GridLines {
    /// The least-squares lines through the coordinates, of which neighbouring ones are one line; none unless the
    /// coordinates are finite and differ.
    pub fn through(coordinates: impl Iterator<Item = f64>) -> Option<Self> {
        let mut sorted: Vec<_> = coordinates.collect();
        sorted.sort_by(f64::total_cmp);
        let widest = widest_step(&sorted);
        if !(widest > 0.0 && sorted.iter().all(|coordinate| coordinate.is_finite())) {
            return None;
        }
        let is_one_line = |one: &f64, next: &f64| next - one <= WITHIN_A_LINE * widest;
        let lines = sorted.chunk_by(is_one_line);
        let middles: Vec<_> = lines
            .map(|line| line.iter().sum::<f64>() / line.len() as f64)
            .collect();
        Self::fitted(&middles)
    }

    /// The lines through rising coordinates, where some lines may be missing.
    fn fitted(middles: &[f64]) -> Option<Self> {
        let mut steps: Vec<_> = middles.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let (_, spacing, _) = steps.select_nth_unstable_by(middles.len() / 2 - 1, f64::total_cmp);
        let mut numbers = vec![0.0];
        for pair in middles.windows(2) {
            let last = numbers.last().copied().unwrap_or_default();
            numbers.push(last + ((pair[1] - pair[0]) / *spacing).round());
        }
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        let [mean_number, mean_middle] = [mean(&numbers), mean(middles)];
        let offsets = || numbers.iter().map(|number| number - mean_number);
        let along: f64 = offsets()
            .zip(middles)
            .map(|(offset, middle)| offset * (middle - mean_middle))
            .sum();
        let distance = along / offsets().map(|offset| offset * offset).sum::<f64>();
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "no step is more than four spacings, and none below 0"
        )]
        let count = 1 + *numbers.last()? as usize;
        (distance > 0.0 && distance.is_finite()).then_some(Self {
            first: mean_middle - mean_number * distance,
            distance,
            count,
        })
    }

    /// The number of the nearest line, from 0, and how far the coordinate is off it, in spacings.
    pub fn nearest(&self, coordinate: f64) -> (usize, f64) {
        let number = (coordinate - self.first) / self.distance;
        let nearest = number.round().clamp(0.0, (self.count - 1) as f64);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a number of a line"
        )]
        let line = nearest as usize;
        (line, (number - nearest).abs())
    }

    /// The side of the pixels around the points.
    pub fn side(&self) -> f64 {
        self.distance * self.count as f64
    }
}

fn widest_step(sorted: &[f64]) -> f64 {
    let steps = sorted.windows(2).map(|pair| pair[1] - pair[0]);
    steps.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_found_through_scatter_and_where_one_is_missing() {
        let coordinate = |n: u32| {
            let off = 0.02 * f64::from(n * 7 % 11) / 10.0 - 0.01;
            3.0 + 0.25 * f64::from(n % 12) + off
        };
        for missing in [99, 0, 5] {
            let points = (0..120).filter(|n| n % 12 != missing).map(coordinate);
            let lines = GridLines::through(points).unwrap();
            let first = if missing == 0 { 3.25 } else { 3.0 };
            // Means of ten offsets of up to 0.01.
            assert!((lines.distance - 0.25).abs() < 1e-3, "{lines:?}");
            assert!((lines.first - first).abs() < 5e-3, "{lines:?}");
            assert_eq!(lines.count, if missing == 0 { 11 } else { 12 });
        }
    }

    #[test]
    fn coordinates_that_are_all_the_same_or_not_finite_have_no_lines() {
        for wrong in [vec![], vec![1.0], vec![2.0; 9], vec![1.0, 2.0, f64::NAN]] {
            assert!(GridLines::through(wrong.into_iter()).is_none());
        }
    }
}
