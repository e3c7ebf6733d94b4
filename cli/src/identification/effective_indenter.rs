//! The effective indenter of each unloading on the fitted body: `kind = "power"` of a case that tells the stresses at
//! the largest force.

use pellicle_identify::Fit;
use pellicle_identify::fit_file::evaluation_file::Evaluated;
use pellicle_identify::indentation::EffectiveIndenterNumbers;

use super::Identification;
use crate::evaluation::result::Indentation;

impl Identification {
    /// Adds to the contacts, in the order of the evaluations, the effective indenters of those that are unloadings.
    /// There is none where no shape has the exponent of the unloading.
    pub(super) fn add_effective_indenters(&self, fit: &Fit, contacts: &mut [Indentation]) {
        let Some(settings) = &self.file.evaluation else {
            return;
        };
        let values: Vec<f64> = fit.estimates.iter().map(|of| of.value).collect();
        let evaluated = self.evaluated.iter().flat_map(|file| {
            let numbers = file.evaluated.iter().flat_map(Evaluated::contacts);
            numbers.map(|numbers| (file.table, numbers))
        });
        for (found, (table, numbers)) in contacts.iter_mut().zip(evaluated) {
            let model = self.model.model(table, &values).ok();
            found.effective_indenter = model.and_then(|model| {
                let bodies = model.tables.bodies();
                let found = EffectiveIndenterNumbers::of(numbers, settings.beta.value, bodies);
                found.ok().flatten()
            });
        }
    }
}
