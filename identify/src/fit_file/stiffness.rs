//! The nuisances that a fit to stiffnesses does not have. A stiffness is a slope of the force over the depth, which
//! neither zero changes; only the zero of the quantity at which it is observed enters.

use pellicle::input::diagnosis::{Diagnosis, Fault};
use pellicle::input::value_reader::ValueReader;

use super::FitFile;
use super::nuisance::{DEPTH_ZERO, FORCE_ZERO, zero_of};
use super::unknown::flattened;
use crate::Reading;

impl FitFile {
    /// Rejects the nuisances that a stiffness does not have, or that do not enter it linearly.
    pub(super) fn refuse_nuisances_of_stiffness(
        &self,
        nuisances: Option<&ValueReader<'_>>,
    ) -> Result<(), Diagnosis> {
        let observe = self.data.first().map(|table| table.observe);
        let observe = observe.filter(|observe| observe.observed() == Reading::Stiffness);
        let (Some(observe), Some(nuisances)) = (observe, nuisances) else {
            return Ok(());
        };
        let enters = |reading| zero_of(reading, observe).is_some();
        for (key, field) in flattened(nuisances)? {
            let is_off = field.text().is_ok_and(|text| text == "off");
            let why = match key.as_str() {
                _ if is_off => continue,
                DEPTH_ZERO | "shift" if !enters(Reading::Depth) => {
                    "the zero of the depth does not change a stiffness"
                }
                FORCE_ZERO if !enters(Reading::Force) => {
                    "the zero of the force does not change a stiffness"
                }
                "drift" => "a drift of the depth does not change a stiffness",
                "frame_compliance" => {
                    "a frame enters a stiffness by 1/S = 1/S_contact + C_f, which is not linear: \
                     give the stiffness of the contact alone"
                }
                _ => continue,
            };
            let found = format!(
                "a nuisance of stiffnesses at a {}",
                observe.abscissa().name()
            );
            let wanted = format!("\"off\": {why}");
            return Err(field.diagnosis(Fault::Wrong { found, wanted }));
        }
        Ok(())
    }
}
