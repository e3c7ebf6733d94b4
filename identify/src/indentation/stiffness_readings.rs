//! The numbers of readings of a continuous stiffness, each a contact of its own.
//!
//! The noise of a reading is told by the scatter about the line through its neighbours in depth, both in logarithms, in
//! which a contact is nearly a power law however far its readings are apart (T. Gasser, L. Sroka and C.
//! Jennen-Steinmetz, Biometrika 73, 625 (1986)). Readings that an instrument has filtered scatter less beside one
//! another than they err.

use std::f64::consts::PI;

use super::contact::Contact;
use super::inputs::Inputs;
use super::numbers::{IndentationNumbers, Source};
use super::settings::{DepthZero, EvaluationSettings};
use super::{IndentationError, Uncertain};

/// Neighbouring readings whose mean square deviation is the scatter of one: as each shares readings with four others,
/// so many tell it to an eighth, and from 32 to 128 nothing else changes.
const BESIDE: usize = 64;
/// With fewer of them readings do not tell their noise.
const FEWEST: usize = 8;

/// Evaluates readings of a continuous stiffness: depths (m), forces (N), stiffnesses (N/m), and where the instrument
/// gives them contact radii (m), `√(A/π)`, in place of the area function.
///
/// From ten readings on the scatter of forces, stiffnesses and radii is part of the uncertainties.
///
/// # Errors
///
/// [`IndentationError`] if a reading has no such numbers.
pub fn evaluate_stiffnesses(
    [depth, force, stiffness]: [&[f64]; 3],
    radius: Option<&[f64]>,
    settings: &EvaluationSettings,
) -> Result<Vec<IndentationNumbers>, IndentationError> {
    let zero = match settings.depth_zero {
        DepthZero::At(zero) => zero,
        DepthZero::FirstContact => return Err(IndentationError::NoContact),
        DepthZero::AsRecorded | DepthZero::FirstContactIfFound => Uncertain::exact(0.0),
    };
    let inputs = Inputs {
        zero: zero.value,
        ..Inputs::of(settings)
    };
    let columns: Vec<&[f64]> = [depth, force, stiffness]
        .into_iter()
        .chain(radius)
        .collect();
    let scatter: Vec<Vec<f64>> = (columns[1..].iter())
        .map(|readings| scatter(depth, readings))
        .collect();
    let numbers = |row: usize| {
        let values = |inputs: &Inputs, of: &[f64]| {
            // 1/S = 1/S_measured − C_f
            let contact = Contact {
                depth: of[0] - inputs.zero - inputs.frame_compliance * of[1],
                force: of[1],
                stiffness: 1.0 / (1.0 / of[2] - inputs.frame_compliance),
                exponent: None,
                area: of.get(3).map(|radius| PI * radius.powi(2)),
            };
            contact.numbers(settings, inputs)
        };
        let readings: Vec<f64> = columns.iter().map(|readings| readings[row]).collect();
        let mut numbers = IndentationNumbers::exact(values(&inputs, &readings)?);
        for (place, scatter) in (1..).zip(&scatter) {
            let (value, sd) = (readings[place], scatter[row] * readings[place].abs());
            numbers.add_source(Source::Own, Uncertain { value, sd }, &|side| {
                let mut moved = readings.clone();
                moved[place] += side * sd;
                // A very noisy reading may be no contact on one side.
                values(&inputs, &moved).or_else(|_| values(&inputs, &readings))
            })?;
        }
        for (source, uncertain, field) in Inputs::sources(settings, [Uncertain::exact(0.0), zero]) {
            numbers.add_source(source, uncertain, &|side| {
                values(&inputs.moved(field, side * uncertain.sd), &readings)
            })?;
        }
        Ok(numbers)
    };
    (0..depth.len()).map(numbers).collect()
}

/// The relative standard deviation of the noise on each of some readings at these depths; 0 if they are too few to
/// tell.
fn scatter(depths: &[f64], readings: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..readings.len())
        .filter(|row| depths[*row] > 0.0 && readings[*row] > 0.0)
        .collect();
    order.sort_by(|one, other| depths[*one].total_cmp(&depths[*other]));
    // (y − w y₋ − (1 − w) y₊)²/(1 + w² + (1 − w)²)
    let square = |of: &[usize]| {
        let [x, y] = [depths, readings].map(|column| [0, 1, 2].map(|k| column[of[k]].ln()));
        let before = (x[2] - x[1]) / (x[2] - x[0]);
        let after = 1.0 - before;
        let rest = y[1] - before * y[0] - after * y[2];
        rest * rest / (1.0 + before * before + after * after)
    };
    let squares: Vec<f64> = order.windows(3).map(square).collect();
    let count = squares.len();
    let mut found = vec![0.0; readings.len()];
    if count < FEWEST {
        return found;
    }
    for (place, row) in order.into_iter().enumerate() {
        let first = place.saturating_sub(BESIDE / 2);
        let first = first.min(count.saturating_sub(BESIDE));
        // Of equal depths there is no line.
        let near = squares[first..count.min(first + BESIDE)].iter();
        let (sum, number) = near
            .filter(|square| square.is_finite())
            .fold((0.0, 0.0), |(sum, number), square| {
                (sum + square, number + 1.0)
            });
        if number > 0.0 {
            found[row] = f64::sqrt(sum / number);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scatter_of_smooth_readings_is_their_noise() {
        let mut state = 1_u64;
        let mut uniform = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / 2_f64.powi(53)
        };
        // The sum of twelve is all but normal, with a standard deviation of 1.
        let mut normal = || (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
        // A contact stiffness of 2 E a with noise of 1 %, dense and with depths that double.
        for (count, ratio) in [(400, 1.01_f64), (14, 2.0)] {
            let depths: Vec<f64> = (0..count).map(|n| 1e-8 * ratio.powi(n)).collect();
            let noisy = |depth: &f64| depth * (1.0 + 0.01 * normal());
            let readings: Vec<f64> = depths.iter().map(noisy).collect();
            let found = scatter(&depths, &readings);
            let mean = found.iter().sum::<f64>() / f64::from(count);
            assert!((mean / 0.01 - 1.0).abs() < 0.3, "{count}: {mean}");
            assert!(found.iter().all(|sd| (0.5..1.6).contains(&(sd / 0.01))));
            // The order of the rows does not count, and a power law without noise has none.
            let mut turned = (depths.clone(), readings.clone());
            turned.0.reverse();
            turned.1.reverse();
            let backwards: Vec<f64> = scatter(&turned.0, &turned.1);
            assert!(
                backwards
                    .iter()
                    .rev()
                    .zip(&found)
                    .all(|(one, other)| (one - other).abs() < 1e-12)
            );
            let smooth: Vec<f64> = depths.iter().map(|depth| depth * depth).collect();
            assert!(scatter(&depths, &smooth).iter().all(|sd| *sd < 1e-12));
        }
        assert_eq!(scatter(&[1.0; 9], &[1.0; 9]), [0.0; 9]);
    }
}
