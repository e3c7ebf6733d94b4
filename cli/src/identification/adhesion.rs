//! Adhesion in a fit: what it can be fitted to.

use pellicle::case::parameter::WORK_OF_ADHESION;
use pellicle::input::diagnosis::Diagnosis;
use pellicle_contact::ModelParameter;
use pellicle_identify::Reading;
use pellicle_identify::fit_file::FitFile;
use pellicle_identify::fit_file::unknown::UnknownCase;
use pellicle_identify::measured::curve_segment::Branch;

use super::curve_source::CurveSource;

/// Refuses readings that contacts with adhesion do not predict.
///
/// # Errors
///
/// A diagnosis at the key that asks for them, or of a model that cannot be.
pub fn refuse_readings(file: &FitFile) -> Result<(), pellicle::Error> {
    for table in &file.data {
        if file.model.with(&table.set)?.adhesion.is_none() {
            continue;
        }
        if table.observe.observed() == Reading::Stiffness {
            let wanted = "\"depth at force\" or \"force at depth\" with load.work_of_adhesion";
            return Err(table.wanted("observe", wanted).into());
        }
        if table.segment.part == Branch::Whole {
            let wanted = "\"loading\" or \"unloading\" with load.work_of_adhesion: such a contact is made at one \
                          place and broken at another";
            return Err(table.wanted("segment.part", wanted).into());
        }
    }
    Ok(())
}

/// Refuses a work of adhesion that is sought in curves without pull-off.
///
/// # Errors
///
/// A [`Diagnosis`] at the unknown.
pub fn require_pull_off(file: &FitFile, sources: &[(usize, CurveSource)]) -> Result<(), Diagnosis> {
    let unknowns = file.all_unknowns();
    let is_work = |of: &UnknownCase| of.parameter == ModelParameter::WorkOfAdhesion;
    let has_pull_off = |(_, source): &(usize, CurveSource)| source.has_pull_off;
    if unknowns.iter().any(is_work) && !sources.iter().any(has_pull_off) {
        return Err(no_pull_off(file));
    }
    Ok(())
}

/// The diagnosis that nothing tells a work of adhesion.
fn no_pull_off(file: &FitFile) -> Diagnosis {
    let dotted = format!("unknown.{WORK_OF_ADHESION}");
    let quoted = format!("unknown.\"{WORK_OF_ADHESION}\"");
    let key = [dotted, quoted]
        .into_iter()
        .find(|key| file.document.has(key));
    let key = key.unwrap_or_else(|| "unknown".to_owned());
    let are_retractions = (file.data.iter()).all(|table| table.segment.part == Branch::Unloading);
    let wanted = if are_retractions {
        "none: no pull-off in the data, of which no force lies clearly below the baseline, by eight standard deviations \
         of its noise and half a percent of the largest force, so it is not identified"
    } else {
        "none: no pull-off in the data, so it is not identified. A retraction tells it \
         (segment = { part = \"unloading\" }), whose force falls below zero before the contact breaks"
    };
    file.document.wanted(&key, wanted)
}
