//! What a result may be used for.

/// What a result may be used for, from good to bad.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Status {
    /// Its certificate is satisfied, and it solves the problem posed.
    Certified,
    /// Its certificate is satisfied, but the contact would go on where the domain or a map ends: it solves another problem.
    CutOff,
    /// Its certificate is not satisfied.
    NotConverged,
}

impl Status {
    /// A word that does not change, for programs.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Certified => "certified",
            Self::CutOff => "cut-off",
            Self::NotConverged => "not-converged",
        }
    }
}
