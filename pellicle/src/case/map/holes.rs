//! Heights that are missing in a map.

use std::borrow::Cow;

use serde::Serialize;

use super::hole_code::HoleCode;
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
    /// Nothing: every number in the file is a height.
    None,
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
    ("none", HolesCase::None),
];

/// The heights of a map without its holes.
pub(super) struct Filled<'a> {
    /// With the mean of the neighbours where they are missing.
    pub heights: Cow<'a, [f64]>,
    /// How many are missing.
    pub missing: usize,
    /// A value that may stand for missing ones, but was taken as it is.
    pub perhaps: Option<HoleCode>,
}

/// Fills the holes of a map, those in points on a grid, or all as the case asks.
pub(super) fn without_holes<'a>(
    field: &ValueReader<'_>,
    file: &'a MapFile,
    holes: HolesCase,
) -> Result<Filled<'a>, Diagnosis> {
    let codes = match holes {
        HolesCase::None => Vec::new(),
        _ => HoleCode::among(&file.heights),
    };
    let is_hole = |height: f64| !height.is_finite() || codes.iter().any(|code| code.is_at(height));
    let missing = file.heights.iter().filter(|height| is_hole(**height));
    let missing = missing.count();
    if missing == 0 {
        let perhaps = HoleCode::perhaps_among(&file.heights);
        return Ok(Filled {
            heights: Cow::Borrowed(&file.heights),
            missing,
            perhaps: perhaps.filter(|_| holes != HolesCase::None),
        });
    }
    let all = file.heights.len();
    let is_filled = holes == HolesCase::Interpolate || missing == file.missing_points;
    if is_filled && missing as f64 <= MISSING * all as f64 {
        let known = |height: &f64| if is_hole(*height) { f64::NAN } else { *height };
        let known: Vec<_> = file.heights.iter().map(known).collect();
        return Ok(Filled {
            heights: Cow::Owned(filled(&known, file.shape)),
            missing,
            perhaps: None,
        });
    }
    let wanted = match (is_filled, &codes[..]) {
        (true, _) => "at most a tenth of them missing",
        (false, []) => {
            "every height, or holes = \"interpolate\", which takes the mean of the neighbours"
        }
        (false, _) => {
            "holes = \"interpolate\", which takes the mean of the neighbours, or \"none\" if these are heights"
        }
    };
    Err(field.unusable(&told(&file.heights, &codes), wanted))
}

/// `of whose 4096 heights 12 are -9999, far from the others (-11.4 .. 10.2), as holes are written`
fn told(heights: &[f64], codes: &[HoleCode]) -> String {
    let missing = heights.iter().filter(|height| !height.is_finite()).count();
    let missing = (missing > 0).then(|| format!("{missing} are missing or infinite"));
    let coded = codes.iter().map(ToString::to_string);
    let found: Vec<_> = missing.into_iter().chain(coded).collect();
    let all = heights.len();
    format!("of whose {all} heights {}", found.join(" and "))
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
