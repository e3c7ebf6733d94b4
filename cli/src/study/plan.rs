//! What a study has to do: every case resolved once, before any long work.

use super::Study;
use super::identity::StudyIdentity;
use super::shard::Shard;
use super::table_columns::TableColumns;
use crate::case::Case;
use crate::case::diagnosis::Diagnosis;
use crate::case::output::OutputCase;
use crate::case::units::Units;
use crate::failure::Failure;

/// A study looked through.
#[derive(Debug, Clone)]
pub struct StudyPlan {
    /// The table's columns.
    pub columns: TableColumns,
    /// What makes it this study and no other.
    pub identity: StudyIdentity,
}

impl StudyPlan {
    /// Resolves every case of the study.
    ///
    /// # Errors
    ///
    /// The first case's [`Diagnosis`] if no case can be; one that cannot among others that can is recorded when its
    /// turn comes.
    pub fn new(study: &Study, shard: Shard) -> Result<Self, Failure> {
        let mut hasher = blake3::Hasher::new();
        hasher.update(env!("CARGO_PKG_VERSION").as_bytes());
        let (mut rows, mut units, mut refused) = (Vec::new(), None, None);
        for i in 0..study.len() {
            match study.case(i) {
                Ok(case) => {
                    add(&mut hasher, &case)?;
                    units = units.or(Some(case.units));
                    rows.push(case.load.loads().len());
                }
                Err(diagnosis) => {
                    hasher.update(diagnosis.to_string().as_bytes());
                    refused.get_or_insert(diagnosis);
                    rows.push(1);
                }
            }
        }
        let units = units.ok_or_else(|| none_can_be(refused))?;
        let columns = TableColumns::new(study, units);
        hasher.update(columns.header().as_bytes());
        let fingerprint = hasher.finalize().to_hex().to_string();
        let identity = StudyIdentity::new(study, fingerprint, rows, columns.header(), shard);
        Ok(Self { columns, identity })
    }
}

/// What the case says and, where it names a map, its heights.
fn add(hasher: &mut blake3::Hasher, case: &Case) -> Result<(), Failure> {
    // What is written of a solution is no part of it.
    let case = Case {
        output: OutputCase::default(),
        ..case.clone()
    };
    hasher.update(&serde_json::to_vec(&case)?);
    hasher.update(&[u8::from(case.units == Units::Si)]);
    for map in [case.surface.map(), case.indenter.map()]
        .into_iter()
        .flatten()
    {
        for height in map.heights().heights() {
            hasher.update(&height.to_le_bytes());
        }
    }
    Ok(())
}

fn none_can_be(refused: Option<Diagnosis>) -> Failure {
    match refused {
        Some(diagnosis) => diagnosis.into(),
        None => Failure::NoCases,
    }
}
