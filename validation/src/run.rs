//! A run of the validation: it solves the contacts to be compared, with coefficients that it computes itself.

use std::sync::Arc;

use pellicle_contact::{
    ContactError, Domain, Indenter, IndenterError, Load, LoadingPath, Model, Paraboloid,
    SolverOptions, solve_path,
};
use pellicle_influence::{Cache, InfluenceError, RadialTables};
use pellicle_kernel::{Foundation, KernelError, Material};
use pellicle_texture::{Relief, TextureError};

/// A run of the validation, which builds and solves contacts.
#[derive(Debug, Clone, Copy, Default)]
pub struct ValidationRun {
    /// Relative error of every influence coefficient: 0 except for the test hook.
    pub perturbation: f64,
}

/// A contact on a grid.
#[derive(Debug, Clone)]
pub struct ContactSetup {
    /// The elastic body.
    pub foundation: Foundation,
    /// The relief on it.
    pub relief: Relief,
    /// The indenter.
    pub indenter: Indenter,
    /// Side of the domain.
    pub side: f64,
    /// Elements per side.
    pub elements: usize,
    /// Force or penetration.
    pub load: Load,
}

impl ContactSetup {
    /// Returns the contact of an indenter with a bare surface, on a domain of this side, with this number of
    /// elements along it.
    #[must_use]
    pub fn bare(
        foundation: Foundation,
        indenter: Indenter,
        (side, elements): (f64, usize),
        load: Load,
    ) -> Self {
        Self {
            foundation,
            relief: Relief::Bare,
            indenter,
            side,
            elements,
            load,
        }
    }
}

/// The reason for a failed comparison.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "each is the error it holds")]
pub enum ValidationError {
    #[error(transparent)]
    Kernel(#[from] KernelError),
    #[error(transparent)]
    Influence(#[from] InfluenceError),
    #[error(transparent)]
    Texture(#[from] TextureError),
    #[error(transparent)]
    Indenter(#[from] IndenterError),
    #[error(transparent)]
    ContactSetup(#[from] ContactError),
    #[error("reference data: {0}")]
    Data(#[from] serde_json::Error),
    #[error("found a certificate of {worst:.1e}, wanted a certified solution")]
    NotCertified { worst: f64 },
    #[error("found no solution, wanted one")]
    NoSolution,
}

impl ValidationRun {
    /// Builds the tables of a foundation.
    ///
    /// # Errors
    /// Errors of [`RadialTables::build`].
    pub fn tables(self, foundation: &Foundation) -> Result<RadialTables, ValidationError> {
        Ok(RadialTables::build(foundation)?.perturbed(self.perturbation))
    }

    /// Builds the model of a contact.
    ///
    /// # Errors
    /// Errors of [`Self::tables`].
    pub fn model(self, contact: &ContactSetup) -> Result<Model, ValidationError> {
        Ok(Model {
            tables: Arc::new(self.tables(&contact.foundation)?),
            relief: contact.relief.clone(),
            indenter: contact.indenter.clone(),
            cache: Cache::none(),
        })
    }

    /// Returns the certified solution of a contact: a path of one step.
    ///
    /// # Errors
    /// Errors of the crates, and [`ValidationError::NotCertified`].
    pub fn solve(self, contact: &ContactSetup) -> Result<LoadingPath, ValidationError> {
        self.solve_with(contact, SolverOptions::default())
    }

    /// Returns the same with other options.
    ///
    /// # Errors
    /// Errors of [`Self::solve`].
    pub fn solve_with(
        self,
        contact: &ContactSetup,
        options: SolverOptions,
    ) -> Result<LoadingPath, ValidationError> {
        let (domain, loads) = (Domain::Side(contact.side), [contact.load]);
        let model = self.model(contact)?;
        let path = solve_path(&model, domain, contact.elements, &loads, &options, &mut ())?;
        let step = path.steps.first().ok_or(ValidationError::NoSolution)?;
        let certificate = &step.solution.certificate;
        if certificate.is_satisfied() {
            return Ok(path);
        }
        let worst = certificate.worst();
        Err(ValidationError::NotCertified { worst })
    }

    /// Returns the penetration of the certified solution.
    ///
    /// # Errors
    /// Errors of [`Self::solve`].
    pub fn penetration(self, contact: &ContactSetup) -> Result<f64, ValidationError> {
        Ok(self.solve(contact)?.steps[0].solution.penetration)
    }
}

/// Returns a material with plane-strain modulus 1.
///
/// # Errors
/// Never.
pub fn unit_material() -> Result<Material, KernelError> {
    Material::new(0.91, 0.3)
}

/// Returns a paraboloid.
///
/// # Errors
/// An error if the radius is not positive.
pub fn paraboloid(radius: f64) -> Result<Indenter, IndenterError> {
    Paraboloid::new(radius).map(Indenter::Paraboloid)
}
