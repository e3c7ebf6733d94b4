//! The parameters of a model, one by one: read, or replaced.

use crate::{ContactError, Model, ModelParameter};

impl Model {
    /// All numbers of the model on which a solution depends smoothly. The outline of a relief and the radius of a flat
    /// punch are excluded, since elements follow them in steps.
    #[must_use]
    pub fn parameters(&self) -> Vec<ModelParameter> {
        let elastic = self.tables.bodies().parameters();
        let elastic = elastic.into_iter().map(ModelParameter::Elastic);
        let relief = self.relief.parameters();
        let relief = relief.into_iter().map(ModelParameter::Relief);
        let indenter = self.indenter.parameters();
        let indenter = indenter.into_iter().map(ModelParameter::Indenter);
        elastic.chain(relief).chain(indenter).collect()
    }

    /// The value of a number, in SI units; none if the model has no such number.
    #[must_use]
    pub fn parameter(&self, parameter: ModelParameter) -> Option<f64> {
        match parameter {
            ModelParameter::Elastic(of) => self.tables.bodies().parameter(of),
            ModelParameter::Relief(of) => self.relief.parameter(of),
            ModelParameter::Indenter(of) => self.indenter.parameter(of),
            ModelParameter::WorkOfAdhesion => None,
        }
    }

    /// The same model with another value of one number; radial tables come from the model's cache or are rebuilt.
    ///
    /// # Errors
    /// As [`Self::with_parameters`].
    pub fn with_parameter(
        &self,
        parameter: ModelParameter,
        value: f64,
    ) -> Result<Self, ContactError> {
        self.with_parameters(&[(parameter, value)])
    }

    /// The same model with other values of some numbers; radial tables come from the model's cache or are rebuilt.
    ///
    /// # Errors
    /// A value that the body, the relief or the indenter cannot have; a body that the model does not have; radial
    /// tables that miss their accuracy.
    pub fn with_parameters(&self, values: &[(ModelParameter, f64)]) -> Result<Self, ContactError> {
        let mut model = self.clone();
        let mut bodies = self.tables.bodies().clone();
        for (parameter, value) in values {
            match *parameter {
                ModelParameter::Elastic(of) => bodies = bodies.with_parameter(of, *value)?,
                ModelParameter::Relief(of) => {
                    model.relief = model.relief.with_parameter(of, *value)?;
                }
                ModelParameter::Indenter(of) => {
                    model.indenter = model.indenter.with_parameter(of, *value)?;
                }
                wanted @ ModelParameter::WorkOfAdhesion => {
                    return Err(ContactError::NoParameter { wanted });
                }
            }
        }
        if bodies != *self.tables.bodies() {
            model.tables = self.cache.radial_tables_like(&self.tables, &bodies)?;
        }
        Ok(model)
    }
}
