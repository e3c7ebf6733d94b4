//! Counts known for every case before it is solved: its rows, one per loading step, or the elements of its grid.

use pellicle::case::grid::GridCase;
use pellicle::case::load::LoadCase;
use pellicle::declare::{Record, Scope};
use pellicle::input::diagnosis::Diagnosis;
use pellicle::input::table_reader::TableReader;
use pellicle::input::value_reader::ValueReader;
use serde::{Deserialize, Serialize};

use crate::Study;
use crate::numbering::CaseNumbering;

/// One count per case. It takes no more memory for a million cases than for one, unless the keys that affect it vary.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct CaseCounts {
    /// The axes on which the count depends.
    axes: Vec<usize>,
    /// The counts, for every combination of values of these axes.
    counts: Vec<usize>,
}

impl CaseCounts {
    /// Counts the rows of every case of a study, for cases that do not fail.
    #[must_use]
    pub fn rows(study: &Study) -> Self {
        Self::new(study, changes_the_number_of_loads, Study::steps)
    }

    /// Counts the elements per side of every case; 0 if they are invalid.
    #[must_use]
    pub fn elements(study: &Study) -> Self {
        Self::new(study, changes_the_elements, Study::elements)
    }

    fn new(
        study: &Study,
        changes: impl Fn(&[String]) -> bool,
        count: impl Fn(&Study, usize) -> usize,
    ) -> Self {
        let axes = study.axes_of(changes);
        let cases = study.numbering().around(0, &axes);
        let mut counts: Vec<_> = cases.map(|case| count(study, case)).collect();
        let are_equal = counts.windows(2).all(|pair| pair[0] == pair[1]);
        if are_equal {
            counts.truncate(1);
        }
        let axes = if are_equal { Vec::new() } else { axes };
        Self { axes, counts }
    }

    /// Whether there is one count for every case of a study with this numbering; a damaged file may have others.
    pub(crate) fn are_of(&self, numbering: &CaseNumbering) -> bool {
        let is_axis = |axis: &usize| *axis < numbering.lengths.len();
        self.axes.iter().all(is_axis) && numbering.places(&self.axes) == self.counts.len()
    }

    /// Returns the count of a case; `None` if there is no such case.
    #[must_use]
    pub fn of(&self, numbering: &CaseNumbering, case: usize) -> Option<usize> {
        if case >= numbering.case_count() {
            return None;
        }
        let place = numbering.place(case, &self.axes);
        self.counts.get(place).copied()
    }

    /// Returns the distinct counts, in order.
    #[must_use]
    pub fn different(&self) -> Vec<usize> {
        let mut different = self.counts.clone();
        different.sort_unstable();
        different.dedup();
        different
    }
}

impl Study {
    /// The number of loading steps of a case; 1 if its load is invalid. Only the load is read.
    fn steps(&self, case: usize) -> usize {
        let read = || {
            let root = self.tree(case)?;
            let load = TableReader::root(&root)?.required("load", "a table [load]")?;
            LoadCase::read(&load.table()?, &Scope::default())
        };
        read().map_or(1, |load: LoadCase| load.steps())
    }

    /// The elements per side of a square of a case; 0 if they are invalid or it is oblong. Only the grid is read.
    fn elements(&self, case: usize) -> usize {
        let read = || -> Result<usize, Diagnosis> {
            let root = self.tree(case)?;
            let table = TableReader::root(&root)?.optional("grid");
            let table = table.map(ValueReader::table).transpose()?;
            table.map_or(Ok(GridCase::default().elements), |table| {
                let is_oblong = table.optional("sides").is_some();
                GridCase::read_elements(&table).map(|size| if is_oblong { 0 } else { size })
            })
        };
        read().unwrap_or(0)
    }
}

/// Whether another value of this key may change the number of loads.
fn changes_the_number_of_loads(path: &[String]) -> bool {
    let mut path = path.iter().map(String::as_str);
    path.next() == Some("load")
        && path
            .next()
            .is_none_or(|key| matches!(key, "forces" | "pressures" | "penetrations"))
}

/// Whether another value of this key may change the grid.
fn changes_the_elements(path: &[String]) -> bool {
    let mut path = path.iter().map(String::as_str);
    path.next() == Some("grid") && path.next().is_none_or(|key| key == "elements")
}
