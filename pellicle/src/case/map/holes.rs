//! Heights that are missing in a map.

use std::borrow::Cow;

use serde::Serialize;

use crate::input::diagnosis::Diagnosis;
use crate::input::value_reader::ValueReader;
use crate::map::MapFile;

/// The largest part of the heights that may be missing.
const MISSING: f64 = 0.1;

/// What is done where heights are missing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum HolesCase {
    /// The map is refused.
    Refuse,
    /// Each is the mean of its neighbours.
    Interpolate,
}

impl HolesCase {
    #[expect(clippy::trivially_copy_pass_by_ref, reason = "serde's signature")]
    /// Whether such a map is refused.
    pub(super) fn is_refuse(&self) -> bool {
        *self == Self::Refuse
    }
}

/// The words of the key `holes`.
pub(super) const HOLES: &[(&str, HolesCase)] = &[
    ("refuse", HolesCase::Refuse),
    ("interpolate", HolesCase::Interpolate),
];

/// The heights with the mean of the neighbours where they are missing, and how many are: of points on a grid, or as the
/// case asks.
pub(super) fn without_holes<'a>(
    field: &ValueReader<'_>,
    file: &'a MapFile,
    holes: HolesCase,
) -> Result<(Cow<'a, [f64]>, usize), Diagnosis> {
    let all = file.heights.len();
    let missing = file.heights.iter().filter(|height| !height.is_finite());
    let missing = missing.count();
    if missing == 0 {
        return Ok((Cow::Borrowed(&file.heights), 0));
    }
    let is_filled = holes == HolesCase::Interpolate || missing == file.missing_points;
    if is_filled && missing as f64 <= MISSING * all as f64 {
        return Ok((Cow::Owned(filled(&file.heights, file.shape)), missing));
    }
    let reason = format!("of whose {all} heights {missing} are missing or infinite");
    let wanted = if is_filled {
        "at most a tenth of them missing"
    } else {
        "every height, or holes = \"interpolate\", which takes the mean of the neighbours"
    };
    Err(field.unusable(&reason, wanted))
}

/// Puts the mean of the neighbours, diagonal ones included, where heights are not finite, from the rims of the holes
/// inwards.
fn filled(heights: &[f64], [rows, columns]: [usize; 2]) -> Vec<f64> {
    let mut filled = heights.to_vec();
    loop {
        let known = filled.clone();
        let is_known = |k: usize| known[k].is_finite();
        let mut is_whole = true;
        for k in (0..known.len()).filter(|k| !is_known(*k)) {
            let (i, j) = (k / columns, k % columns);
            let around = (i.saturating_sub(1)..rows.min(i + 2))
                .flat_map(|i| {
                    (j.saturating_sub(1)..columns.min(j + 2)).map(move |j| i * columns + j)
                })
                .filter(|near| is_known(*near));
            let (sum, count) = around.fold((0.0, 0_usize), |(sum, count), near| {
                (sum + known[near], count + 1)
            });
            if count > 0 {
                filled[k] = sum / count as f64;
            } else {
                is_whole = false;
            }
        }
        // Without a known height nothing can be filled.
        if is_whole || !known.iter().any(|height| height.is_finite()) {
            return filled;
        }
    }
}
