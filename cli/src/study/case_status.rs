//! How a case of a study ended.

/// How a case ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CaseStatus {
    /// Every step is certified.
    Certified,
    /// There is a result, but a certificate is not satisfied.
    NotConverged,
    /// A contact would go on where the domain or a map ends, so another problem is solved.
    CutOff,
    /// There is no result.
    Failed,
}

impl CaseStatus {
    const ALL: [Self; 4] = [
        Self::Certified,
        Self::NotConverged,
        Self::CutOff,
        Self::Failed,
    ];

    /// The word in the table.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Certified => "certified",
            Self::NotConverged => "not-converged",
            Self::CutOff => "cut-off",
            Self::Failed => "failed",
        }
    }

    /// The status with this word.
    #[must_use]
    pub fn of(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|status| status.word() == word)
    }
}

/// How many cases ended in which way.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, serde::Serialize)]
pub struct Tally {
    /// Certified.
    pub certified: usize,
    /// With a result that is not certified.
    pub not_converged: usize,
    /// With a result whose contact is cut off.
    pub cut_off: usize,
    /// Without a result.
    pub failed: usize,
}

impl Tally {
    /// Counts these.
    pub fn of(statuses: impl IntoIterator<Item = CaseStatus>) -> Self {
        let mut tally = Self::default();
        statuses.into_iter().for_each(|status| tally.add(status));
        tally
    }

    fn add(&mut self, status: CaseStatus) {
        let count = match status {
            CaseStatus::Certified => &mut self.certified,
            CaseStatus::NotConverged => &mut self.not_converged,
            CaseStatus::CutOff => &mut self.cut_off,
            CaseStatus::Failed => &mut self.failed,
        };
        *count += 1;
    }

    /// All together.
    #[must_use]
    pub fn done(&self) -> usize {
        self.certified + self.not_converged + self.cut_off + self.failed
    }

    /// Whether every case has a certified result.
    #[must_use]
    pub fn is_certified(&self) -> bool {
        self.certified == self.done()
    }
}
