//! The fields on all planes of a step at once, held in memory.

use pellicle::case::Case;
use pellicle::case::foundation::FoundationCase;
use pellicle::case::foundation::depths::BodyPlane;
use pellicle::case::stress::StressCase;
use pellicle_contact::{LoadingPath, StressField};
use pellicle_kernel::Foundation;

use super::plane_values::{FIELDS, PlaneValues};
use super::planes::block_radius;
use crate::failure::Failure;

/// The fields on planes in the body.
#[derive(Debug)]
pub struct StressFields {
    /// The coordinates of the points along x, and along y, m.
    pub centres: Vec<f64>,
    /// The planes, from the surface down.
    pub planes: Vec<BodyPlane>,
    /// For every plane, the values of each of [`FIELDS`], with one row per coordinate along x.
    pub values: Vec<[Vec<f64>; FIELDS.len()]>,
}

impl StressFields {
    /// Computes the fields that `stress` requests for a step of the path of a case; none if there is no such step.
    ///
    /// # Errors
    ///
    /// [`Failure`] if a field cannot be computed.
    pub fn new(
        case: &Case,
        path: &LoadingPath,
        step: usize,
        stress: &StressCase,
    ) -> Result<Option<Self>, Failure> {
        let path = &path.seen_from(stress.body.into());
        let Some(field) = StressField::new(path, step, stress.sliding()) else {
            return Ok(None);
        };
        let contact_radius = path.steps[step].summary.contact_radius;
        let body = stress.body.of(&case.foundation, Some(&case.indenter));
        Self::of(
            (&body, path.tables.foundation()),
            field,
            contact_radius,
            stress,
        )
        .map(Some)
    }

    /// Computes the fields that `stress` requests, with the residual stress of the layers, under a contact of this
    /// radius (m), in a foundation given by the case and as split.
    ///
    /// # Errors
    ///
    /// [`Failure`] if a field cannot be computed.
    pub fn of(
        (case, foundation): (&FoundationCase, &Foundation),
        field: StressField,
        contact_radius: f64,
        stress: &StressCase,
    ) -> Result<Self, Failure> {
        let field = field.with_residual(case.residual_stress(foundation));
        let side = field.grid().side();
        let radius = block_radius(contact_radius, side);
        let planes = stress.planes(case, foundation, radius);
        let mut below = field.planes(stress.side(radius, side));
        let centres = below.centres().to_vec();
        let values = planes.iter().map(|plane| {
            let mut values = PlaneValues::new(centres.len());
            values.compute(&mut below, *plane)?;
            Ok(values.fields)
        });
        let values = values.collect::<Result<_, Failure>>()?;
        Ok(Self {
            centres,
            planes,
            values,
        })
    }
}
