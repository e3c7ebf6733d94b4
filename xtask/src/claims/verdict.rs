//! What becomes of a sentence once its quantity has been computed on several grids.

use std::fmt;

use serde::Deserialize;

use super::Finding;

/// Whether a sentence of the paper is true of the computed solution.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
pub enum Verdict {
    /// True on every grid it was evaluated on.
    #[serde(rename = "borne out")]
    BorneOut,
    /// False on every grid.
    #[serde(rename = "not borne out")]
    NotBorneOut,
    /// True on some grids and false on others.
    #[serde(rename = "depends on the grid")]
    DependsOnTheGrid,
}

impl Verdict {
    /// The verdict over the findings of all grids; without any finding there is none.
    pub(super) fn of(findings: &[Finding]) -> Option<Self> {
        let holding = findings.iter().filter(|finding| finding.holds).count();
        match holding {
            _ if findings.is_empty() => None,
            0 => Some(Self::NotBorneOut),
            all if all == findings.len() => Some(Self::BorneOut),
            _ => Some(Self::DependsOnTheGrid),
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::BorneOut => "borne out",
            Self::NotBorneOut => "not borne out",
            Self::DependsOnTheGrid => "depends on the grid",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(holds: &[bool]) -> Option<Verdict> {
        let finding = |&holds| Finding {
            holds,
            measured: String::new(),
        };
        Verdict::of(&holds.iter().map(finding).collect::<Vec<_>>())
    }

    #[test]
    fn a_verdict_needs_every_grid_to_agree() {
        assert_eq!(of(&[true, true]), Some(Verdict::BorneOut));
        assert_eq!(of(&[false, false]), Some(Verdict::NotBorneOut));
        assert_eq!(of(&[true, false]), Some(Verdict::DependsOnTheGrid));
        assert_eq!(of(&[false, true, true]), Some(Verdict::DependsOnTheGrid));
    }

    #[test]
    fn no_finding_is_no_verdict() {
        assert_eq!(of(&[]), None);
    }
}
