//! Spring constants of cantilevers that are not known exactly.
//!
//! A force microscope measures the approach z of its piezo and the deflection d of its cantilever. The penetration `δ =
//! z − d` does not depend on the spring constant. The force is `F = k d`, or was computed in this way with a nominal
//! constant k₀. An error of k therefore multiplies all forces of a table, `F = (k/k₀) F₀`, and nothing else. It is a
//! parameter with a normal prior that no curve can separate from the moduli, as penetrations depend on `F/E`.

use pellicle_identify::fit_file::FitFile;
use pellicle_identify::measured::spring::SpringConstant;
use pellicle_identify::{ForceScale, IdentifyError, Prior, Unknown};

/// A spring constant is sought within this many standard deviations of its mean, and above this fraction of the mean.
const DEVIATIONS: f64 = 8.0;
const LEAST_PART: f64 = 0.1;

/// For each table whose spring constant is not known exactly, the dependence of its forces on it.
#[must_use]
pub fn scales(file: &FitFile) -> Vec<Option<ForceScale>> {
    let tables = file.data.iter().map(|table| table.spring_constant);
    let mut before = 0;
    let scale = |spring: Option<SpringConstant>| {
        let SpringConstant { mean, sd, .. } = spring?;
        sd?;
        let constant = before;
        before += 1;
        Some(ForceScale {
            constant,
            nominal: mean,
        })
    };
    tables.map(scale).collect()
}

/// The spring constants as nuisances, in the order of their tables.
pub fn unknowns(file: &FitFile) -> impl Iterator<Item = Result<Unknown, IdentifyError>> {
    let tables = file.data.iter().enumerate();
    tables.filter_map(|(index, table)| {
        let SpringConstant { mean, sd, .. } = table.spring_constant?;
        Some(unknown(index, mean, sd?))
    })
}

fn unknown(table: usize, mean: f64, sd: f64) -> Result<Unknown, IdentifyError> {
    let range = [
        (mean - DEVIATIONS * sd).max(LEAST_PART * mean),
        mean + DEVIATIONS * sd,
    ];
    let unknown = Unknown::positive(format!("data[{table}].spring_constant"), range)?;
    let unknown = unknown.starting_at(mean)?;
    Ok(unknown
        .with_prior(Prior::Normal { mean, sd })?
        .as_nuisance())
}
