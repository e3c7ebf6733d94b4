//! The picture of a search: the number over the key in the cases tried, with limit and answer.

use std::fs;
use std::path::Path;

use pellicle_files::FileError;
use pellicle_plot::study::curves::{CurvesPanel, CurvesPicture};
use pellicle_plot::study::sample::{Sample, SampleError, SampledAxis};
use pellicle_study::find::folder::FILE;
use pellicle_study::find::tried::{self, Tried};
use serde::Deserialize;

use super::study::Scaled;
use crate::failure::Failure;

/// What the picture shows of `find.json`.
#[derive(Debug, Deserialize)]
struct Asked {
    title: String,
    key: String,
    unit: Option<String>,
    result: String,
    result_unit: Option<String>,
    limit: f64,
    extreme: Option<String>,
    value: Option<f64>,
    interval: Option<[f64; 2]>,
}

/// Whether a folder is that of a search.
#[must_use]
pub fn is_in(folder: &Path) -> bool {
    folder.join(FILE).is_file()
}

/// Makes the picture of the search in a folder.
///
/// # Errors
///
/// [`FileError::Damaged`] if its files cannot be read.
pub fn of(folder: &Path) -> Result<CurvesPicture, Failure> {
    let damaged = |cause: &dyn std::fmt::Display| FileError::damaged(folder, cause);
    let read = |name: &str| fs::read_to_string(folder.join(name)).map_err(|cause| damaged(&cause));
    let asked: Asked = serde_json::from_str(&read(FILE)?).map_err(|cause| damaged(&cause))?;
    let mut tried = tried::read(&read(tried::FILE)?);
    tried.sort_by(|one, other| one.key.total_cmp(&other.key));
    let keys = Scaled::of(
        &asked.key,
        asked.unit.as_deref(),
        tried.iter().map(|tried| tried.key),
    );
    let numbers = tried.iter().filter_map(Tried::certified);
    let numbers = numbers.chain([asked.limit]);
    let numbers = Scaled::of(&asked.result, asked.result_unit.as_deref(), numbers);
    let points = tried.iter().map(|tried| {
        let sample = sample(tried, numbers.divisor);
        (tried.key / keys.divisor, sample)
    });
    let is_positive = tried.iter().all(|tried| tried.key > 0.0);
    let are_positive =
        asked.limit > 0.0 && (tried.iter().filter_map(Tried::certified)).all(|number| number > 0.0);
    let words = match &asked.extreme {
        Some(extreme) => format!("{extreme} {} for a limit of {}", asked.key, asked.result),
        None => format!("{} over {}", asked.result, asked.key),
    };
    let value = asked.value.map(|value| value / keys.divisor);
    let interval = asked
        .interval
        .map(|ends| ends.map(|end| end / keys.divisor));
    Ok(CurvesPicture {
        heading: [asked.title, words],
        key: SampledAxis {
            title: keys.title,
            is_logarithmic: is_positive,
        },
        panels: vec![CurvesPanel {
            axis: SampledAxis {
                title: numbers.title,
                is_logarithmic: is_positive && are_positive,
            },
            curves: vec![points.collect()],
            limit: Some(asked.limit / numbers.divisor),
        }],
        names: Vec::new(),
        answer: value.map(|value| (value, interval)),
    })
}

fn sample(tried: &Tried, divisor: f64) -> Sample {
    Sample {
        value: tried.certified().map(|number| number / divisor),
        error: match (tried.error, tried.resolved) {
            (Some(error), _) => SampleError::Known(error / divisor),
            (None, Some(_)) => SampleError::NotResolved,
            (None, None) => SampleError::None,
        },
    }
}
