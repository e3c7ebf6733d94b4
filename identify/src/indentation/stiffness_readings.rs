//! The numbers of readings of a continuous stiffness, each a contact of its own.
//!
//! The noise of a reading is told by the scatter of those beside it: on smooth readings the third differences are those
//! of the noise, and 20 times its variance. Readings that an instrument has filtered scatter less beside one another
//! than they err.

use std::f64::consts::PI;

use super::contact::Contact;
use super::inputs::Inputs;
use super::numbers::{IndentationNumbers, Source};
use super::settings::{DepthZero, EvaluationSettings};
use super::{IndentationError, Uncertain};

/// Third differences whose mean square is the scatter at a reading. As each shares readings with six others, so many
/// tell it to a seventh; from 32 to 128 nothing else changes.
const BESIDE: usize = 64;
/// Third differences without which readings do not tell their noise.
const FEWEST: usize = 8;

/// Evaluates readings of a continuous stiffness: depths (m), forces (N), stiffnesses (N/m), and where the instrument
/// gives them contact radii (m), `√(A/π)`, in place of the area function.
///
/// From eleven readings on their scatter is part of the uncertainties.
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
    let scatter: Vec<Vec<f64>> = columns.iter().map(|readings| scatter(readings)).collect();
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
        for (place, scatter) in scatter.iter().enumerate() {
            let (value, sd) = (readings[place], scatter[row]);
            numbers.add_source(Source::Own, Uncertain { value, sd }, &|side| {
                let mut moved = readings.clone();
                moved[place] += side * sd;
                values(&inputs, &moved)
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

/// The standard deviation of the noise on each of some readings; 0 if they are too few to tell.
fn scatter(readings: &[f64]) -> Vec<f64> {
    let differences = readings.windows(4);
    let differences = differences.map(|v| v[3] - 3.0 * v[2] + 3.0 * v[1] - v[0]);
    let differences: Vec<f64> = differences.collect();
    let count = differences.len();
    if count < FEWEST {
        return vec![0.0; readings.len()];
    }
    let at = |row: usize| {
        let first = row
            .saturating_sub(BESIDE / 2 + 1)
            .min(count.saturating_sub(BESIDE));
        let near = &differences[first..count.min(first + BESIDE)];
        let square = near.iter().map(|of| of * of).sum::<f64>() / near.len() as f64;
        (square / 20.0).sqrt()
    };
    (0..readings.len()).map(at).collect()
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
        // A contact stiffness of 2 E a, with noise of 1 % of itself.
        let readings: Vec<f64> = (1..400)
            .map(|n| f64::from(n).sqrt() * (1.0 + 0.01 * normal()))
            .collect();
        let found = scatter(&readings);
        for row in [30, 150, 300, 398] {
            let ratio = found[row] / (0.01 * readings[row]);
            assert!((0.6..1.4).contains(&ratio), "{row}: {ratio}");
        }
        let mean = found
            .iter()
            .zip(&readings)
            .map(|(sd, of)| sd / of)
            .sum::<f64>()
            / 399.0;
        assert!((mean - 0.01).abs() < 1e-3, "{mean}");
        assert_eq!(scatter(&readings[..10]), [0.0; 10]);
    }
}
