//! The plan of a study: what can be known about its cases before any is solved, without reading all of them.

use pellicle::case::Case;
use pellicle::input::diagnosis::Diagnosis;

use crate::Study;
use crate::StudyError;
use crate::fingerprint;
use crate::identity::StudyIdentity;
use crate::kept_layout::KeptLayout;
use crate::shard::Shard;
use crate::table_columns::{ResultColumns, TableColumns};
use crate::varied_key::VariedKey;

/// Most values of one axis tried before anything is solved; the others are read in their turn.
const MAX_TRIED: usize = 10_000;

/// The columns and the identity of a study, with the cases known to be invalid.
#[derive(Debug, Clone)]
pub struct StudyPlan {
    /// The table's columns.
    pub columns: TableColumns,
    /// The study's identity.
    pub identity: StudyIdentity,
    /// The invalid cases among those tried; they are recorded as failed in their turn.
    pub refused: RefusedCases,
}

/// The invalid cases among those tried before anything is solved.
#[derive(Debug, Clone, Default)]
pub struct RefusedCases {
    /// Number of cases tried.
    pub tried: usize,
    /// Number of invalid ones.
    pub count: usize,
    /// The first invalid case, counted from 0, and its fault.
    pub first: Option<(usize, Box<Diagnosis>)>,
}

impl StudyPlan {
    /// Reads the cases up to the first valid one, and those that differ from it in one key. So every value of a key is
    /// tried once, with valid values of the others. For a key with more than 10,000 values, and for zipped keys, the
    /// first 10,000 are tried.
    ///
    /// # Errors
    ///
    /// The [`Diagnosis`] of the first case if no case is valid; otherwise an invalid case is recorded in its turn.
    pub fn new(study: &Study, shard: Shard) -> Result<Self, StudyError> {
        let (reference, valid) = first_valid(study)?;
        let units = valid.units;
        let mut refused = RefusedCases::default();
        let mut results = ResultColumns::default();
        for case in cases_to_try(study, reference) {
            refused.tried += 1;
            match study.case(case) {
                Ok(case) => results.add(&case),
                Err(diagnosis) => refused.add(case, diagnosis),
            }
        }
        let columns = TableColumns::new(study, units, results);
        let fingerprint = fingerprint::of(study, (reference, &valid), &columns.header())?;
        let mut identity = StudyIdentity::new(study, fingerprint, columns.header(), shard);
        identity.kept = KeptLayout::new(study, &valid, &identity.rows)?;
        Ok(Self {
            columns,
            identity,
            refused,
        })
    }
}

impl RefusedCases {
    fn add(&mut self, case: usize, diagnosis: Diagnosis) {
        self.count += 1;
        self.first.get_or_insert((case, Box::new(diagnosis)));
    }

    /// Describes the first invalid case and the number of invalid cases; `None` if every case tried is valid.
    #[must_use]
    pub fn words(&self) -> Option<String> {
        let (case, diagnosis) = self.first.as_ref()?;
        let others = match self.count {
            1 => String::new(),
            count => format!("; {count} of the {} cases tried are invalid", self.tried),
        };
        let case = case + 1;
        Some(format!(
            "case {case} is invalid and will be recorded as failed: {diagnosis}{others}"
        ))
    }
}

/// The first valid case, with its number.
fn first_valid(study: &Study) -> Result<(usize, Case), StudyError> {
    let mut refused = None;
    for case in 0..study.case_count() {
        match study.case(case) {
            Ok(found) => return Ok((case, found)),
            Err(diagnosis) => {
                refused.get_or_insert(diagnosis);
            }
        }
    }
    Err(refused.map_or(StudyError::NoCases, StudyError::from))
}

/// The cases that differ from a valid one in one key, and those that differ in any number of keys that change the shape
/// of a case, since these decide the columns of the table. In order, each once.
fn cases_to_try(study: &Study, reference: usize) -> Vec<usize> {
    let numbering = study.numbering();
    let mut cases = Vec::new();
    for axis in 0..numbering.lengths.len() {
        cases.extend(numbering.around(reference, &[axis]).take(MAX_TRIED));
    }
    let shaping = study
        .varied_keys()
        .iter()
        .filter(|varied| varied.shapes_cases());
    let mut shaping: Vec<_> = shaping.map(|varied: &VariedKey| varied.axis).collect();
    shaping.dedup();
    cases.extend(numbering.around(reference, &shaping));
    cases.sort_unstable();
    cases.dedup();
    cases
}
