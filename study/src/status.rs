//! Progress of a study, read from its folder while other processes work on it, on this machine or others.

use std::fs;
use std::path::Path;
use std::time::Duration;

use crate::StudyError;
use crate::case_blocks::CaseBlocks;
use crate::case_status::Tally;
use crate::folder;
use crate::identity::StudyIdentity;

/// The progress of a study.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StudyStatus {
    /// Total number of cases.
    pub cases: usize,
    /// The statuses of the cases done in any part.
    pub tally: Tally,
    /// Number of parts on which a process is working.
    pub parts_at_work: usize,
    /// Cases per second of these parts together, since each was last started; `None` if it is not known yet.
    pub rate: Option<f64>,
}

impl StudyStatus {
    /// Reads the tables of all parts of this study in a folder; nothing is written and no process has to wait.
    ///
    /// # Errors
    ///
    /// [`StudyError::File`] if a table or the file beside it cannot be read.
    pub fn read(folder: &Path, study: &StudyIdentity) -> Result<Self, StudyError> {
        let mut statuses = vec![None; study.numbering.case_count()];
        let (mut parts_at_work, mut rate) = (0, None);
        let parts = folder::identities(folder)?;
        for part in parts
            .iter()
            .filter(|part| part.fingerprint == study.fingerprint)
        {
            let path = part.table(folder);
            if !path.exists() {
                continue;
            }
            let blocks = CaseBlocks::read(&path, part)?.blocks;
            for block in &blocks {
                statuses[block.case] = Some(block.status);
            }
            if folder::is_at_work(folder, part.shard) {
                parts_at_work += 1;
                let since = blocks.len().saturating_sub(part.done_before);
                let own = time(folder, part).map(|time| since as f64 / time.as_secs_f64());
                rate = own
                    .filter(|own| *own > 0.0)
                    .map(|own| rate.unwrap_or(0.0) + own)
                    .or(rate);
            }
        }
        Ok(Self {
            cases: statuses.len(),
            tally: Tally::of(statuses.into_iter().flatten()),
            parts_at_work,
            rate,
        })
    }

    /// Returns the number of cases that are not done.
    #[must_use]
    pub fn to_do(self) -> usize {
        self.cases - self.tally.done()
    }

    /// Returns the time until every case is done at this rate; `None` if it is unknown or all are done.
    #[must_use]
    pub fn time_left(self) -> Option<Duration> {
        let seconds = self.to_do() as f64 / self.rate?;
        Duration::try_from_secs_f64(seconds)
            .ok()
            .filter(|left| !left.is_zero())
    }
}

/// Time from the start of a part to its last row. Both are times of files written by one machine, so the clocks of
/// other machines do not matter.
fn time(folder: &Path, part: &StudyIdentity) -> Option<Duration> {
    let written = |path: &Path| fs::metadata(path).and_then(|data| data.modified()).ok();
    let start = written(&StudyIdentity::path(folder, part.shard))?;
    let last = written(&part.table(folder))?;
    last.duration_since(start)
        .ok()
        .filter(|time| !time.is_zero())
}
