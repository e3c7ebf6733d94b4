//! A warning in a summary: of the case, of the path, of the cache.

use pellicle_contact::{UnresolvedStresses, Warning};
use pellicle_influence::CacheWarning;
use serde::{Deserialize, Serialize};

use crate::case::Case;
use crate::case::warnings::CaseWarning;

/// A warning about the numbers.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct WarningSummary {
    /// A word for programs.
    #[serde(default)]
    pub code: String,
    /// A sentence for human readers.
    pub message: String,
}

impl From<CaseWarning> for WarningSummary {
    fn from(CaseWarning { code, message }: CaseWarning) -> Self {
        let code = code.into();
        Self { code, message }
    }
}

impl WarningSummary {
    /// A warning about the solution of a case.
    #[must_use]
    pub fn of(case: &Case, warning: &Warning) -> Self {
        Self {
            code: warning.code().into(),
            message: case.sentence(warning),
        }
    }
}

impl From<UnresolvedStresses> for WarningSummary {
    fn from(unresolved: UnresolvedStresses) -> Self {
        Self {
            code: unresolved.code().into(),
            message: unresolved.to_string(),
        }
    }
}

impl From<&CacheWarning> for WarningSummary {
    fn from(warning: &CacheWarning) -> Self {
        Self {
            code: warning.code().into(),
            message: warning.to_string(),
        }
    }
}
