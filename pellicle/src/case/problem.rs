//! The problem that a case poses: its model, its loads, its domain, and the options of the solver.

use pellicle_contact::{ContactError, Domain, Load, Model, SolverOptions, choose_side_at};
use pellicle_influence::{Cache, Cached, ElasticBodies, InfluenceError};

use super::{Case, stress};
use crate::error::Error;
use crate::input::diagnosis::Diagnosis;

impl Case {
    /// The loads that are solved, in order: a nominal pressure is the force on the cell; with adhesion, each is that of
    /// the contact without it that has the same radius.
    #[must_use]
    pub fn loads(&self) -> Vec<Load> {
        let given = self.load.loads(self.grid.nominal_area());
        match &self.adhesion {
            None => given,
            Some(adhesion) => adhesion.loads_without(&given),
        }
    }

    /// The number of steps: of loads, or of the distances of a wear.
    #[must_use]
    pub fn steps(&self) -> usize {
        let distances = self.wear.as_ref().map(|wear| wear.distances.list().len());
        distances.unwrap_or_else(|| self.load.steps())
    }

    /// Returns the domain of the solution, as given or chosen for the loads.
    ///
    /// # Errors
    ///
    /// [`Error`] if none can be chosen, or the square of the stresses does not fit in it.
    pub fn domain(&self, model: &Model) -> Result<Domain, Error> {
        let side = self.side(model).map_err(|error| self.blame(error))?;
        self.check_extent(side)?;
        Ok(match (self.grid.cell(), self.grid.side) {
            (Some(cell), _) => cell,
            (None, Some(_)) => Domain::Side(side),
            (None, None) => Domain::Chosen(side),
        })
    }

    /// Checks that the square of the requested stresses fits in a domain of this side.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of its key if not.
    pub fn check_extent(&self, side: f64) -> Result<(), Diagnosis> {
        let extent = self.stress.as_ref().and_then(|stress| stress.extent);
        if extent.is_none_or(|extent| extent <= side) {
            return Ok(());
        }
        let wanted = format!("{}, chosen from the load", stress::extent_wanted(side));
        Err(self.document.wanted("stress.extent", &wanted))
    }

    /// The longer side of the domain, m.
    ///
    /// # Errors
    ///
    /// [`ContactError`] if none can be chosen.
    pub fn side(&self, model: &Model) -> Result<f64, ContactError> {
        match self.grid.longer_side() {
            Some(side) => Ok(side),
            None => choose_side_at(model, &self.loads(), self.solver_options().hardness),
        }
    }

    /// The hardness at which the pressure is cut, Pa.
    #[must_use]
    pub fn hardness(&self) -> Option<f64> {
        let given = self.solver.hardness;
        given.or_else(|| self.foundation.hardness_against(&self.indenter))
    }

    /// The options of the solver. If stresses are requested, coarse pressures are kept: they give the errors of the
    /// stresses.
    #[must_use]
    pub fn solver_options(&self) -> SolverOptions {
        SolverOptions {
            coarse_pressures: self.stress.is_some(),
            hardness: self.hardness().unwrap_or(f64::INFINITY),
            averaging_length: self.output.mean_pressure_over,
            ..self.solver.options()
        }
    }

    /// The model of the case, and whether its radial tables came from the cache.
    ///
    /// # Errors
    ///
    /// [`Error`] if the tables of this foundation cannot be built.
    pub fn model(&self, cache: &Cache) -> Result<Cached<Model>, Error> {
        let foundation = self.foundation.split()?.foundation;
        let (relief, indenter) = (self.surface.build()?, self.indenter.build()?);
        let bodies = ElasticBodies::new(foundation, self.indenter.build_body()?);
        let tables = cache.radial_tables_of(&bodies)?;
        Ok(tables.map(|tables| Model {
            tables,
            relief,
            indenter,
            cache: cache.clone(),
        }))
    }

    /// Returns the failure of a solution, with the key to change if the case is at fault.
    #[must_use]
    pub fn blame(&self, error: ContactError) -> Error {
        let keys: &[&str] = match &error {
            ContactError::ElementsTooLarge { .. } => &["grid.side"],
            ContactError::BeyondHardness { .. } => &[
                "load.force",
                "load.forces",
                "load.pressure",
                "load.pressures",
            ],
            ContactError::WithHardness { .. } => &[
                "solver.hardness",
                "foundation.layer[0].hardness",
                "foundation.substrate.hardness",
                "indenter.body.layer[0].hardness",
                "indenter.body.substrate.hardness",
            ],
            ContactError::BeyondGaps { .. } => &["load.penetration", "load.penetrations"],
            ContactError::NothingCanTouch { .. } => {
                &["indenter.radius", "indenter.file", "indenter.kind"]
            }
            ContactError::FieldValue { .. } => &[
                "indenter.file",
                "indenter.radius",
                "indenter.tip_radius",
                "indenter.kind",
            ],
            ContactError::Influence(InfluenceError::CoefficientNotFinite { .. }) => &[
                "grid.side",
                "foundation.layer[0].thickness",
                "foundation.substrate",
            ],
            ContactError::AveragingLength { .. } => &["output.mean_pressure_over"],
            _ => return error.into(),
        };
        self.document.refused(keys, &error).into()
    }
}
