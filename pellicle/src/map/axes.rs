//! Coordinates beside heights: a first column or line that counts the lines or columns, or points with more columns.

use super::error::MapError;
use super::grid_points;

/// From this many numbers on, equal steps are no accident.
const MANY: usize = 8;

/// Part of a step by which equal steps differ; printed coordinates have few digits.
const ROUNDING: f64 = 0.05;

/// Checks that all numbers of a picture are heights.
///
/// # Errors
///
/// [`MapError::Axis`] if the first or last column or the first line has equal steps and the next has not, or
/// [`MapError::MoreThanPoints`] if the first three columns are points of a grid.
pub fn check(columns: usize, picture: &[f64]) -> Result<(), MapError> {
    let lines = picture.len() / columns.max(1);
    let column = |i: usize| picture.iter().skip(i).step_by(columns).copied().collect();
    let line = |j: usize| picture[j * columns..][..columns].to_vec();
    // What is in the corner belongs to neither.
    let is_axis = |one: Vec<f64>, next: Vec<f64>| {
        one.len() > MANY && has_equal_steps(&one[1..]) && !has_equal_steps(&next[1..])
    };
    if columns < 2 || lines < 2 {
        return Ok(());
    }
    if is_axis(column(0), column(1)) {
        let which = "first column";
        return Err(MapError::Axis { which });
    }
    if is_axis(column(columns - 1), column(columns - 2)) {
        let which = "last column";
        return Err(MapError::Axis { which });
    }
    if is_axis(line(0), line(1)) {
        let which = "first line";
        return Err(MapError::Axis { which });
    }
    if columns > 3 && lines >= grid_points::MANY_LINES {
        let first = picture.chunks_exact(columns).flat_map(|line| &line[..3]);
        let points: Vec<_> = first.copied().collect();
        if grid_points::map(&points).is_ok() {
            return Err(MapError::MoreThanPoints { columns });
        }
    }
    Ok(())
}

fn has_equal_steps(numbers: &[f64]) -> bool {
    let [Some(first), Some(last)] = [numbers.first(), numbers.last()] else {
        return false;
    };
    let step = (last - first) / (numbers.len() - 1) as f64;
    let mut steps = numbers.windows(2).map(|pair| pair[1] - pair[0]);
    step.abs() > 0.0 && steps.all(|one| (one / step - 1.0).abs() <= ROUNDING)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 12 columns in 10 lines, numbers by line and column.
    fn picture(number: impl Fn(usize, usize) -> f64) -> Vec<f64> {
        let number = &number;
        (0..10)
            .flat_map(|j| (0..12).map(move |i| number(j, i)))
            .collect()
    }

    fn wave(j: usize, i: usize) -> f64 {
        (0.8 * j as f64).sin() + (0.9 * i as f64).cos()
    }

    #[test]
    fn coordinates_beside_heights_are_no_heights() {
        let with_column = picture(|j, i| if i == 0 { j as f64 } else { wave(j, i) });
        let with_last = picture(|j, i| if i == 11 { j as f64 } else { wave(j, i) });
        let with_line = picture(|j, i| {
            if j == 0 {
                0.0938 * i as f64
            } else {
                wave(j, i)
            }
        });
        let with_both = picture(|j, i| match (j, i) {
            (0, 0) => 99.0,
            (0, _) => 5.0 - i as f64,
            (_, 0) => j as f64,
            _ => wave(j, i),
        });
        for (numbers, axis) in [
            (with_column, "first column"),
            (with_last, "last column"),
            (with_line, "first line"),
            (with_both, "first column"),
        ] {
            let told = check(12, &numbers);
            assert!(
                matches!(told, Err(MapError::Axis { which }) if which == axis),
                "{told:?}"
            );
        }
        let points = (0..120).flat_map(|n: u32| {
            let (i, j) = (f64::from(n / 10), f64::from(n % 10));
            [i, j, (i * j).sin(), 7.0]
        });
        let told = check(4, &points.collect::<Vec<_>>());
        assert!(
            matches!(told, Err(MapError::MoreThanPoints { columns: 4 })),
            "{told:?}"
        );
    }

    #[test]
    fn waves_wedges_and_small_maps_are_heights() {
        let small = [0.0, 5.0, 9.0, 1.0, 7.0, 2.0, 2.0, 3.0, 8.0];
        assert!(check(3, &small).is_ok() && check(1, &small).is_ok() && check(0, &[]).is_ok());
        let wedge = |j: usize, i: usize| 3.0 * j as f64 - 2.0 * i as f64;
        let ball = |j: usize, i: usize| (j as f64 - 4.5).powi(2) + (i as f64 - 5.5).powi(2);
        assert!(check(12, &picture(wave)).is_ok());
        assert!(check(12, &picture(wedge)).is_ok());
        assert!(check(12, &picture(ball)).is_ok());
        assert!(check(12, &picture(|j, i| wedge(j, i) + wave(j, i))).is_ok());
        assert!(check(12, &picture(|_, _| 0.0)).is_ok());
    }
}
