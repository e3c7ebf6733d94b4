//! The nuisances of a fit to stiffnesses: a slope of the force over the depth, which neither zero changes.

use pellicle::input::diagnosis::{Diagnosis, Fault};
use pellicle::input::value_reader::ValueReader;

use super::FitFile;
use super::unknown::flattened;
use crate::{IdentifyError, LinearNuisance, Reading};

impl FitFile {
    /// The nuisances that enter the observable linearly: none for a stiffness.
    ///
    /// # Errors
    ///
    /// [`IdentifyError`] if a prior is invalid.
    pub fn linear_nuisances(&self) -> Result<Vec<LinearNuisance>, IdentifyError> {
        if self.observes_stiffness() {
            return Ok(Vec::new());
        }
        self.nuisances.linear()
    }

    fn observes_stiffness(&self) -> bool {
        let observed = self.data.first().map(|table| table.observe.observed());
        observed == Some(Reading::Stiffness)
    }

    /// Rejects the nuisances that a stiffness does not have, or that do not enter it linearly.
    pub(super) fn refuse_nuisances_of_stiffness(
        &self,
        nuisances: Option<&ValueReader<'_>>,
    ) -> Result<(), Diagnosis> {
        let Some(nuisances) = nuisances.filter(|_| self.observes_stiffness()) else {
            return Ok(());
        };
        for (key, field) in flattened(nuisances)? {
            let is_off = field.text().is_ok_and(|text| text == "off");
            let wanted = match key.as_str() {
                _ if is_off => continue,
                "shift" => "\"off\": the zero of the depth does not change a stiffness",
                "drift" => "\"off\": a drift of the depth does not change a stiffness",
                "frame_compliance" => {
                    "\"off\": a frame enters a stiffness by 1/S = 1/S_contact + C_f, which is not linear; \
                     wanted the stiffness of the contact alone"
                }
                _ => continue,
            };
            let (found, wanted) = ("a nuisance of depths".to_owned(), wanted.to_owned());
            return Err(field.diagnosis(Fault::Wrong { found, wanted }));
        }
        Ok(())
    }
}
