//! How a case of a study ended.

/// How a case ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// Every step is certified.
    Certified,
    /// There is a result, but a certificate is not satisfied.
    NotConverged,
    /// There is no result.
    Failed,
}

impl Status {
    const ALL: [Self; 3] = [Self::Certified, Self::NotConverged, Self::Failed];

    /// The word in the table.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Certified => "certified",
            Self::NotConverged => "not-converged",
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
    /// Without a result.
    pub failed: usize,
}

impl Tally {
    /// Counts these.
    pub fn of(statuses: impl IntoIterator<Item = Status>) -> Self {
        let mut tally = Self::default();
        statuses.into_iter().for_each(|status| tally.add(status));
        tally
    }

    fn add(&mut self, status: Status) {
        let count = match status {
            Status::Certified => &mut self.certified,
            Status::NotConverged => &mut self.not_converged,
            Status::Failed => &mut self.failed,
        };
        *count += 1;
    }

    /// All together.
    #[must_use]
    pub fn done(&self) -> usize {
        self.certified + self.not_converged + self.failed
    }

    /// Whether every case has a certified result.
    #[must_use]
    pub fn is_certified(&self) -> bool {
        self.not_converged == 0 && self.failed == 0
    }
}
