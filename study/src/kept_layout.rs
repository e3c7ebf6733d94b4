//! Layout of `fields-nN.nc`: the kept fields of all cases of a study that have N × N elements, as NetCDF-3.
//!
//! The case is the record dimension. The variables are `case` (its number in the table), `status`, the `side` of its
//! domain, and the fields over `(case, x, y)`, or `(case, step, x, y)` if all loading steps are kept. Each case has its
//! own domain, so `x` and `y` are relative to its side. Missing steps and failed cases are filled with NaN.

use std::io;

use pellicle::case::Case;
use pellicle::case::output::Steps;
use pellicle::input::units::Units;
use pellicle::result::fields::NUMBERS;
use pellicle_files::netcdf::{Attribute, Header, Kind, RECORDS, Variable};
use serde::{Deserialize, Serialize};

use crate::StudyError;
use crate::case_counts::CaseCounts;
use crate::case_status::CaseStatus;
use crate::numbering::CaseNumbering;
use crate::shard::Shard;
use crate::{KeptField, Study};

/// Most bytes of a variable in one case: the format has 32 bits for its size.
const MAX_BYTES: usize = u32::MAX as usize - 3;

/// Bytes of a case before its fields: number, status and side.
pub const HEAD: usize = 4 + 4 + 8;

/// The layout of the files: fields, steps and units.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct KeptLayout {
    /// The fields, each once, in the order of the files.
    pub fields: Vec<KeptField>,
    /// Largest number of loading steps if all are kept; `None` if only the last is kept.
    pub steps: Option<usize>,
    /// The units of the numbers.
    units: Units,
    /// Elements per side of every case.
    pub elements: CaseCounts,
}

impl KeptLayout {
    /// Builds the layout of a study, of which `case` is a valid case; `None` if nothing is to be kept. All loading
    /// steps are kept if `output.fields` of this case is `all`, otherwise only the last.
    ///
    /// # Errors
    ///
    /// [`StudyError::KeptTooLarge`] if a field of one case does not fit into the format, [`StudyError::KeptOblong`] for
    /// an oblong cell.
    pub fn new(study: &Study, case: &Case, rows: &CaseCounts) -> Result<Option<Self>, StudyError> {
        if study.keep.is_empty() {
            return Ok(None);
        }
        if case.grid.sides.is_some() {
            return Err(StudyError::KeptOblong);
        }
        let most_steps = rows.different().into_iter().max().unwrap_or(1);
        let layout = Self {
            fields: study.keep.clone(),
            steps: (case.output.fields == Steps::All).then_some(most_steps),
            units: case.units,
            elements: CaseCounts::elements(study),
        };
        let elements = layout.grids().into_iter().max().unwrap_or(0);
        if layout.field_bytes(elements) > MAX_BYTES {
            let steps = layout.steps.unwrap_or(1);
            return Err(StudyError::KeptTooLarge { elements, steps });
        }
        Ok(Some(layout))
    }

    /// Returns the elements per side that occur, in order; there is one file for each.
    #[must_use]
    pub fn grids(&self) -> Vec<usize> {
        let mut grids = self.elements.different();
        grids.retain(|elements| *elements > 0);
        grids
    }

    /// Whether this is the layout of a study with this numbering; a damaged file may have another.
    pub(crate) fn is_of(&self, numbering: &CaseNumbering) -> bool {
        let fits = |elements: usize| {
            let plane = elements
                .checked_mul(elements)?
                .checked_mul(size_of::<f64>())?;
            let bytes = plane.checked_mul(self.steps.unwrap_or(1))?;
            Some(bytes <= MAX_BYTES)
        };
        self.fields.is_sorted_by(|a, b| a < b)
            && self.elements.are_of(numbering)
            && self
                .grids()
                .into_iter()
                .all(|elements| fits(elements) == Some(true))
    }

    /// Returns the file name for a part of the study.
    #[must_use]
    pub fn file(elements: usize, shard: Shard) -> String {
        shard.file(&format!("fields-n{elements}"), "nc")
    }

    /// Returns the elements per side of a case; `None` if they are invalid.
    #[must_use]
    pub fn grid_of(&self, numbering: &CaseNumbering, case: usize) -> Option<usize> {
        let elements = self.elements.of(numbering, case);
        elements.filter(|elements| *elements > 0)
    }

    /// Bytes of one field of a case.
    #[must_use]
    pub fn field_bytes(&self, elements: usize) -> usize {
        self.steps.unwrap_or(1) * elements * elements * size_of::<f64>()
    }

    /// Bytes of a case.
    #[must_use]
    pub fn record_bytes(&self, elements: usize) -> usize {
        HEAD + self.fields.len() * self.field_bytes(elements)
    }

    /// Byte offset of a step of a field from the beginning of its case.
    #[must_use]
    pub fn offset(&self, elements: usize, field: usize, step: usize) -> u64 {
        let plane = elements * elements * size_of::<f64>();
        (HEAD + field * self.field_bytes(elements) + step * plane) as u64
    }

    /// Returns everything before the first case, in a file whose header gives `cases` cases.
    ///
    /// # Errors
    ///
    /// If a number does not fit into the format.
    pub fn beginning(&self, name: &str, elements: usize, cases: usize) -> io::Result<Vec<u8>> {
        let mut bytes = self.header(name, elements, cases).bytes()?;
        // x_i = (2i + 1 − N)/(2N)
        let centre = |i| ((2 * i + 1) as f64 - elements as f64) / (2 * elements) as f64;
        for _axis in ["x", "y"] {
            bytes.extend((0..elements).flat_map(|i| centre(i).to_be_bytes()));
        }
        Ok(bytes)
    }

    fn header(&self, name: &str, elements: usize, cases: usize) -> Header {
        let (x, y, case) = (0, 1, 2);
        let mut dimensions = vec![("x", elements), ("y", elements), ("case", RECORDS)];
        let mut over = vec![case];
        if let Some(steps) = self.steps {
            over.push(dimensions.len());
            dimensions.push(("step", steps));
        }
        over.extend([x, y]);
        let centre = "centre of the element, in sides of the case's domain";
        let statuses = CaseStatus::ALL.iter().enumerate();
        let statuses: Vec<_> = statuses
            .map(|(i, status)| format!("{i} {}", status.word()))
            .collect();
        let mut variables = vec![
            variable("x", vec![x], Kind::Double, "1", centre),
            variable("y", vec![y], Kind::Double, "1", centre),
            variable(
                "case",
                vec![case],
                Kind::Integer,
                "1",
                "number of the case, as in the table of results",
            ),
            variable(
                "status",
                vec![case],
                Kind::Integer,
                "1",
                &statuses.join(", "),
            ),
            variable(
                "side",
                vec![case],
                Kind::Double,
                self.units.name("m"),
                "side of the square domain",
            ),
        ];
        for field in &self.fields {
            let field = &NUMBERS[*field as usize];
            let unit = self.units.name(field.unit);
            let over = over.clone();
            variables.push(variable(
                field.name,
                over,
                Kind::Double,
                unit,
                field.meaning,
            ));
        }
        Header {
            records: cases,
            dimensions,
            attributes: vec![
                Attribute::Text("title", name.to_owned()),
                Attribute::Text("source", format!("pellicle {}", env!("CARGO_PKG_VERSION"))),
            ],
            variables,
        }
    }
}

fn variable(
    name: &'static str,
    dimensions: Vec<usize>,
    kind: Kind,
    unit: &str,
    meaning: &str,
) -> Variable {
    Variable {
        name,
        dimensions,
        attributes: vec![
            Attribute::Text("units", unit.to_owned()),
            Attribute::Text("long_name", meaning.to_owned()),
        ],
        kind,
    }
}
