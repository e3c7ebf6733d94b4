//! Status of a study's cases.

/// The status of a case.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CaseStatus {
    /// Every step is certified.
    Certified,
    /// There is a result, but at least one certificate is not satisfied.
    NotConverged,
    /// A contact is cut off by the edge of the domain or of a map, so a different problem was solved.
    CutOff,
    /// There is no result.
    Failed,
    /// A number is impossible for the model.
    BeyondModel,
}

impl CaseStatus {
    /// All statuses; a file of fields stores the index in this list.
    pub const ALL: [Self; 5] = [
        Self::Certified,
        Self::NotConverged,
        Self::CutOff,
        Self::Failed,
        Self::BeyondModel,
    ];

    /// Returns the word in the table.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Certified => "certified",
            Self::NotConverged => "not-converged",
            Self::CutOff => "cut-off",
            Self::Failed => "failed",
            Self::BeyondModel => "beyond-model",
        }
    }

    /// Returns the status with this word.
    #[must_use]
    pub fn of(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|status| status.word() == word)
    }
}

/// The number of cases with each status.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, serde::Serialize)]
pub struct Tally {
    /// Certified cases.
    pub certified: usize,
    /// Cases with a result that is not certified.
    pub not_converged: usize,
    /// Cases with a result whose contact is cut off.
    pub cut_off: usize,
    /// Cases with a result that is impossible for the model.
    pub beyond_model: usize,
    /// Cases without a result.
    pub failed: usize,
}

impl Tally {
    /// Counts the given statuses.
    pub fn of(statuses: impl IntoIterator<Item = CaseStatus>) -> Self {
        let mut tally = Self::default();
        statuses.into_iter().for_each(|status| tally.add(status));
        tally
    }

    /// Counts one more case.
    pub fn add(&mut self, status: CaseStatus) {
        let count = match status {
            CaseStatus::Certified => &mut self.certified,
            CaseStatus::NotConverged => &mut self.not_converged,
            CaseStatus::CutOff => &mut self.cut_off,
            CaseStatus::BeyondModel => &mut self.beyond_model,
            CaseStatus::Failed => &mut self.failed,
        };
        *count += 1;
    }

    /// Returns the number of all cases counted.
    #[must_use]
    pub fn done(&self) -> usize {
        self.certified + self.not_converged + self.cut_off + self.beyond_model + self.failed
    }

    /// Describes the counts, out of `cases` in all.
    #[must_use]
    pub fn words(&self, cases: usize) -> String {
        let others = [
            (self.not_converged, "not converged"),
            (self.cut_off, "cut off"),
            (self.beyond_model, "beyond the model"),
            (self.failed, "failed"),
            (cases - self.done(), "to do"),
        ];
        let others = others.into_iter().filter(|(count, _)| *count > 0);
        let others = others.map(|(count, word)| format!(", {count} {word}"));
        format!(
            "{cases} cases: {} certified{}",
            self.certified,
            others.collect::<String>()
        )
    }

    /// Whether every case has a certified result.
    #[must_use]
    pub fn is_certified(&self) -> bool {
        self.certified == self.done()
    }
}
