//! The plan of a study: every case is resolved once, before any long work.

use super::Study;
use super::identity::StudyIdentity;
use super::shard::Shard;
use super::table_columns::TableColumns;
use crate::case::Case;
use crate::case::diagnosis::Diagnosis;
use crate::case::output::OutputCase;
use crate::case::units::Units;
use crate::failure::Failure;
use crate::output::curve::stress::StressColumns;

/// The columns and the identity of a study.
#[derive(Debug, Clone)]
pub struct StudyPlan {
    /// The table's columns.
    pub columns: TableColumns,
    /// The study's identity.
    pub identity: StudyIdentity,
}

impl StudyPlan {
    /// Resolves every case of the study.
    ///
    /// # Errors
    ///
    /// The [`Diagnosis`] of the first case if no case is valid; if others are, an invalid case is recorded in its turn.
    pub fn new(study: &Study, shard: Shard) -> Result<Self, Failure> {
        let mut hasher = blake3::Hasher::new();
        hasher.update(env!("CARGO_PKG_VERSION").as_bytes());
        let (mut rows, mut units, mut refused) = (Vec::new(), None, None);
        let mut stress = StressColumns::default();
        for i in 0..study.len() {
            match study.case(i) {
                Ok(case) => {
                    add(&mut hasher, &case)?;
                    stress.add(&case);
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
        let units = units.ok_or_else(|| none_is_valid(refused))?;
        let columns = TableColumns::new(study, units, stress);
        hasher.update(columns.header().as_bytes());
        let fingerprint = hasher.finalize().to_hex().to_string();
        let identity = StudyIdentity::new(study, fingerprint, rows, columns.header(), shard);
        Ok(Self { columns, identity })
    }
}

/// Adds the case and the heights of its maps to the hash.
fn add(hasher: &mut blake3::Hasher, case: &Case) -> Result<(), Failure> {
    // The choice of files does not change the solution.
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

fn none_is_valid(refused: Option<Diagnosis>) -> Failure {
    match refused {
        Some(diagnosis) => diagnosis.into(),
        None => Failure::NoCases,
    }
}
