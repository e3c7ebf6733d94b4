//! The cases of the paper's figures.

/// A case of the paper: one file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum PaperCase {
    /// Compliant textured coating, small load.
    Fig2a,
    /// Stiff textured coating, small load.
    Fig2b,
    /// Compliant textured coating, six times the load of 2a.
    Fig2c,
    /// Stiff textured coating, six times the load of 2b.
    Fig2d,
    /// Compliant coating under the two loads of 2b and 2d: Fig. 3 read by its labels.
    Fig3Soft,
    /// Stiff coating under the two loads of 2a and 2c: Fig. 3 read by its labels.
    Fig3Stiff,
    /// Loading of the compliant coating, period R/60.
    Fig4Soft60,
    /// Loading of the compliant coating, period R/80.
    Fig4Soft80,
    /// Loading of the stiff coating, period R/60.
    Fig4Stiff60,
    /// Loading of the stiff coating, period R/80.
    Fig4Stiff80,
    /// Berkovich pyramid without film.
    Fig5Bare,
    /// Berkovich pyramid with film.
    Fig5Film,
    /// Loading of the pyramid without film, up to the load of Fig. 5.
    Fig6Bare,
    /// Loading of the pyramid with film, up to the load of Fig. 5.
    Fig6Film,
}

impl PaperCase {
    /// All of them.
    pub const ALL: [Self; 14] = [
        Self::Fig2a,
        Self::Fig2b,
        Self::Fig2c,
        Self::Fig2d,
        Self::Fig3Soft,
        Self::Fig3Stiff,
        Self::Fig4Soft60,
        Self::Fig4Soft80,
        Self::Fig4Stiff60,
        Self::Fig4Stiff80,
        Self::Fig5Bare,
        Self::Fig5Film,
        Self::Fig6Bare,
        Self::Fig6Film,
    ];

    /// The case file, from the root of the workspace.
    #[must_use]
    pub fn file(self) -> &'static str {
        match self {
            Self::Fig2a => "cases/fig2a.toml",
            Self::Fig2b => "cases/fig2b.toml",
            Self::Fig2c => "cases/fig2c.toml",
            Self::Fig2d => "cases/fig2d.toml",
            Self::Fig3Soft => "cases/paper/fig3-soft.toml",
            Self::Fig3Stiff => "cases/paper/fig3-stiff.toml",
            Self::Fig4Soft60 => "cases/paper/fig4-soft-60.toml",
            Self::Fig4Soft80 => "cases/paper/fig4-soft-80.toml",
            Self::Fig4Stiff60 => "cases/paper/fig4-stiff-60.toml",
            Self::Fig4Stiff80 => "cases/paper/fig4-stiff-80.toml",
            Self::Fig5Bare => "cases/fig5-bare.toml",
            Self::Fig5Film => "cases/fig5-film.toml",
            Self::Fig6Bare => "cases/paper/fig6-bare.toml",
            Self::Fig6Film => "cases/paper/fig6-film.toml",
        }
    }

    /// The name of the file without folder and ending: `fig4-soft-60`.
    #[must_use]
    pub fn name(self) -> &'static str {
        let file = self.file();
        let file = file.rsplit_once('/').map_or(file, |(_, name)| name);
        file.strip_suffix(".toml").unwrap_or(file)
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use pellicle_cli::case::Case;

    use super::*;

    #[test]
    fn every_case_of_the_paper_is_a_file_that_reads() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        for case in PaperCase::ALL {
            let read = Case::read(&root.join(case.file()), &[]);
            assert!(read.is_ok(), "{}: {read:?}", case.file());
        }
    }

    #[test]
    fn names_are_those_of_the_files() {
        assert_eq!(PaperCase::Fig4Soft60.name(), "fig4-soft-60");
        assert_eq!(PaperCase::Fig2c.name(), "fig2c");
    }
}
