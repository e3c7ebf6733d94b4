//! What the checks are given to look at: results of cases on grids, wherever they come from.

use std::rc::Rc;

use super::{ClaimsError, ContactFields, Curve, Cylinders};
use crate::XtaskError;

/// One step of one case on one grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Subject<'a> {
    /// Name of the case.
    pub(super) case: &'a str,
    /// Values of the case that are replaced, as `--set` takes them.
    pub(super) set: &'a [String],
    /// The loading step, from 0.
    pub(super) step: usize,
    /// Elements per side.
    pub(super) elements: usize,
}

impl<'a> Subject<'a> {
    /// The step that `NAME` (the first) or `NAME:STEP` calls.
    ///
    /// # Errors
    /// [`ClaimsError::Case`] if the step is no number.
    pub(super) fn parse(
        called: &'a str,
        set: &'a [String],
        elements: usize,
    ) -> Result<Self, ClaimsError> {
        let (case, step) = called.split_once(':').unwrap_or((called, "0"));
        let step = step.parse().map_err(|_| ClaimsError::Case {
            found: called.to_owned(),
        })?;
        Ok(Self {
            case,
            set,
            step,
            elements,
        })
    }
}

/// The numbers of one step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Numbers {
    /// Side of an element of the grid.
    pub(super) element_side: f64,
    /// Penetration.
    pub(super) penetration: f64,
    /// Largest pressure.
    pub(super) max_pressure: f64,
    /// Where it is.
    pub(super) max_pressure_at: [f64; 2],
    /// Contact area, and the part of it between the elements of the relief.
    pub(super) contact_area: f64,
    /// See `contact_area`.
    pub(super) contact_area_between: f64,
    /// `η E* / 2`, the length below which the springs round a pressure that is singular without them.
    pub(super) spring_length: f64,
}

/// Results of cases, certified.
pub(super) trait Evidence {
    /// The fields of a step.
    fn fields(&mut self, subject: Subject<'_>) -> Result<Rc<ContactFields>, XtaskError>;

    /// Where the cylinders of a case stand.
    fn cylinders(&mut self, subject: Subject<'_>) -> Result<Cylinders, XtaskError>;

    /// The numbers of a step.
    fn numbers(&mut self, subject: Subject<'_>) -> Result<Numbers, XtaskError>;

    /// The curve over all steps of a case.
    fn curve(&mut self, subject: Subject<'_>) -> Result<Rc<Curve>, XtaskError>;
}
