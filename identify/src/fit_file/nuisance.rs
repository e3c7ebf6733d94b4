//! `[nuisance]` of a fit file: zeros, frame compliance and drift of the curves, and parameters of the model that are
//! not known exactly.
//!
//! A curve has two zeros, that of its depth and that of its force. The zero of what is observed is a constant; that of
//! the abscissa shifts the curve along it.

use pellicle::declare::shape::{Field, Shape, TableShape};
use pellicle::input::diagnosis::Diagnosis;
use pellicle::input::dimension::Dimension;
use pellicle::input::table_reader::TableReader;
use pellicle::input::value_reader::ValueReader;

use super::model::ModelParameters;
use super::prior;
use super::unknown::{UnknownCase, flattened, read_unknown};
use crate::{IdentifyError, LinearNuisance, Observable, Prior, Reading};

/// The names of the zeros, and their keys.
pub const DEPTH_ZERO: &str = "depth_zero";
/// See [`DEPTH_ZERO`].
pub const FORCE_ZERO: &str = "force_zero";

/// A line through points that are in the fit holds its zero and its slope within so many of their standard errors: so
/// loosely that these points count for a twenty-fifth more, and so tightly that no other line takes its place, as one
/// so steep that the contact begins before the first point and the body is 60 times too stiff. 12 serves as well.
pub const LOOSELY: f64 = 5.0;

/// The nuisances of a fit.
#[derive(Debug, Clone, PartialEq)]
pub struct NuisanceTable {
    /// The zero of each curve's depth.
    pub depth_zero: Zero,
    /// The zero of each curve's force; by default what the files show.
    pub force_zero: Option<Zero>,
    /// Compliance of the frame.
    pub frame_compliance: Freedom,
    /// Whether each curve drifts.
    pub drift: Switch,
    /// Parameters of the model that are not known exactly.
    pub parameters: Vec<UnknownCase>,
}

/// The zero of a reading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Zero {
    /// The reading is exact.
    Off,
    /// Each curve has its own zero, with a normal prior of this mean and standard deviation, if any.
    PerCurve(Option<[f64; 2]>),
}

/// What a measurement tells of the zero of its force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ForceZero {
    /// Nothing: it shows no stretch before the contact.
    Unknown,
    /// The stretch before the contact is among the points of the fit, and its line, if it was subtracted, gives this
    /// mean and standard deviation, N.
    InFit(Option<[f64; 2]>),
    /// The stretch before the contact, which is not in the fit, gives this mean and standard deviation, N.
    Measured([f64; 2]),
}

/// Whether a nuisance is present, separate for each curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Switch {
    /// The nuisance is absent.
    Off,
    /// Each curve has its own nuisance.
    PerCurve,
}

/// The prior knowledge of a nuisance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Freedom {
    /// The nuisance is absent.
    Off,
    /// The nuisance has no prior.
    Free,
    /// A normal prior.
    Normal {
        /// Mean.
        mean: f64,
        /// Standard deviation.
        sd: f64,
    },
}

impl Default for NuisanceTable {
    fn default() -> Self {
        Self {
            depth_zero: Zero::PerCurve(None),
            force_zero: None,
            frame_compliance: Freedom::Off,
            drift: Switch::Off,
            parameters: Vec::new(),
        }
    }
}

impl NuisanceTable {
    /// Its keys.
    #[must_use]
    pub fn shape() -> TableShape {
        let off_or = |table| Shape::Either(vec![Shape::Words(vec!["off"]), Shape::Table(table)]);
        let compliance = prior::shape(Some(Dimension::FrameCompliance));
        let frame = vec![Shape::Words(vec!["off", "free"]), Shape::Table(compliance)];
        let [depth, force] = [Dimension::Length, Dimension::Force].map(zero_shape);
        let optional = Field::optional;
        TableShape::of([
            optional(
                DEPTH_ZERO,
                "the zero of the depth",
                off_or(depth.clone()),
                "one of each curve",
            ),
            optional(
                "shift",
                "the old name of `depth_zero`",
                off_or(depth),
                "as `depth_zero`",
            ),
            optional(
                FORCE_ZERO,
                "the zero of the force",
                off_or(force),
                "one of each curve, where the files show a stretch before the contact",
            ),
            optional(
                "drift",
                "a depth that grows with time",
                off_or(per_curve()),
                "`\"off\"`",
            ),
            optional(
                "frame_compliance",
                "the compliance of the instrument",
                Shape::Either(frame),
                "`\"off\"`",
            ),
        ])
        .open_to("a key of the model that is not known exactly, as in `[unknown]`")
    }

    /// Reads the table.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first fault.
    pub fn read(field: &ValueReader<'_>, parameters: &ModelParameters) -> Result<Self, Diagnosis> {
        let mut table = Self::default();
        let mut given = None;
        for (key, field) in flattened(field)? {
            match key.as_str() {
                "depth_zero" | "shift" if given.replace(key.clone()).is_some() => {
                    let wanted = "either depth_zero or shift, its old name";
                    return Err(field.wanted(wanted));
                }
                "depth_zero" | "shift" => table.depth_zero = zero(&field, Dimension::Length)?,
                "force_zero" => table.force_zero = Some(zero(&field, Dimension::Force)?),
                "drift" => table.drift = switch(&field)?,
                "frame_compliance" => table.frame_compliance = freedom(&field)?,
                _ => table
                    .parameters
                    .push(read_unknown(&key, &field, parameters)?),
            }
        }
        Ok(table)
    }

    /// Whether the zero of the depth is sought where this is observed.
    #[must_use]
    pub fn seeks_depth_zero(&self, observe: Observable) -> bool {
        self.depth_zero != Zero::Off && zero_of(Reading::Depth, observe).is_some()
    }

    /// Whether the zero of the force is sought where this is observed, with curves that tell this of it.
    #[must_use]
    pub fn seeks_force_zero(&self, observe: Observable, told: &[ForceZero]) -> bool {
        let shows = |of: &ForceZero| *of != ForceZero::Unknown;
        let is_sought = match self.force_zero {
            None => told.iter().any(shows),
            Some(zero) => zero != Zero::Off,
        };
        is_sought && zero_of(Reading::Force, observe).is_some()
    }

    /// The nuisances that enter linearly, or shift the abscissa; `told` is what each curve tells of its force's zero.
    ///
    /// # Errors
    ///
    /// [`IdentifyError`] if a prior is invalid.
    pub fn linear(
        &self,
        observe: Observable,
        told: &[ForceZero],
    ) -> Result<Vec<LinearNuisance>, IdentifyError> {
        let mut nuisances = Vec::new();
        let zero = zero_of(Reading::Depth, observe);
        if let Some(zero) = zero.filter(|_| self.seeks_depth_zero(observe)) {
            let prior = self.depth_zero.prior();
            nuisances.push(zero.named(DEPTH_ZERO).with_normal_priors(vec![prior])?);
        }
        let zero = zero_of(Reading::Force, observe);
        if let Some(zero) = zero.filter(|_| self.seeks_force_zero(observe, told)) {
            let prior = |of: &ForceZero| match of {
                ForceZero::Measured(measured) => Some(*measured),
                ForceZero::InFit(line) => line.map(|[mean, sd]| [mean, LOOSELY * sd]),
                ForceZero::Unknown => None,
            };
            let priors = match self.force_zero.and_then(Zero::prior) {
                Some(given) => vec![Some(given)],
                None => told.iter().map(prior).collect(),
            };
            nuisances.push(zero.named(FORCE_ZERO).with_normal_priors(priors)?);
        }
        match self.frame_compliance {
            Freedom::Off => {}
            Freedom::Free => nuisances.push(LinearNuisance::frame_compliance()),
            Freedom::Normal { mean, sd } => {
                let nuisance = LinearNuisance::frame_compliance();
                nuisances.push(nuisance.with_normal_prior(mean, sd)?);
            }
        }
        if self.drift == Switch::PerCurve {
            nuisances.push(LinearNuisance::drift());
        }
        Ok(nuisances)
    }
}

/// The zero of a reading as a nuisance of what is observed: a constant of the observable, a shift along the abscissa,
/// or none where the reading does not enter.
pub(super) fn zero_of(reading: Reading, observe: Observable) -> Option<LinearNuisance> {
    match reading {
        _ if reading == observe.observed() => Some(LinearNuisance::shift()),
        _ if reading == observe.abscissa() => Some(LinearNuisance::abscissa_zero()),
        _ => None,
    }
}

impl Zero {
    /// Mean and standard deviation of its prior, if it has one.
    fn prior(self) -> Option<[f64; 2]> {
        match self {
            Self::PerCurve(prior) => prior,
            Self::Off => None,
        }
    }
}

/// The keys of what every curve has of its own.
fn per_curve() -> TableShape {
    let word = Shape::Words(vec!["curve"]);
    TableShape::of([Field::required("per", "one of each curve", word)])
}

/// The keys of a zero of this dimension.
fn zero_shape(dimension: Dimension) -> TableShape {
    let is_normal = |field: &Field| ["prior", "mean", "sd"].contains(&field.key);
    let normal = prior::shape(Some(dimension)).fields.into_iter();
    let mut table = per_curve();
    table.fields.extend(normal.filter(is_normal));
    table
}

/// Reads `"off"` or `{ per = "curve" }`, which may have a normal prior.
fn zero(field: &ValueReader<'_>, dimension: Dimension) -> Result<Zero, Diagnosis> {
    const WANTED: &str =
        "\"off\", { per = \"curve\" } or that with a normal prior, prior = \"normal\", mean and sd";
    if !field.is_table() {
        return match field.text() {
            Ok("off") => Ok(Zero::Off),
            _ => Err(field.wanted(WANTED)),
        };
    }
    let table = field.clone().table()?;
    table.only(&zero_shape(dimension).keys())?;
    let per = table.required("per", "\"curve\"")?;
    per.choice(&[("curve", ())])?;
    match prior::read(&table, Some(dimension))? {
        None => Ok(Zero::PerCurve(None)),
        Some(Prior::Normal { mean, sd }) => Ok(Zero::PerCurve(Some([mean, sd]))),
        Some(_) => Err(field.wanted(WANTED)),
    }
}

/// Reads `"off"` or `{ per = "curve" }`.
fn switch(field: &ValueReader<'_>) -> Result<Switch, Diagnosis> {
    const WANTED: &str = "\"off\" or { per = \"curve\" }";
    if !field.is_table() {
        return match field.text() {
            Ok("off") => Ok(Switch::Off),
            _ => Err(field.wanted(WANTED)),
        };
    }
    let table = field.clone().table()?;
    table.only(&per_curve().keys())?;
    let per = table.required("per", "\"curve\"")?;
    per.choice(&[("curve", Switch::PerCurve)])
}

/// Reads `"off"`, `"free"` or a normal prior.
fn freedom(field: &ValueReader<'_>) -> Result<Freedom, Diagnosis> {
    const WANTED: &str =
        "\"off\", \"free\" or { prior = \"normal\", mean = \"0 nm/mN\", sd = \"0.2 nm/mN\" }";
    if !field.is_table() {
        return match field.text() {
            Ok("off") => Ok(Freedom::Off),
            Ok("free") => Ok(Freedom::Free),
            _ => Err(field.wanted(WANTED)),
        };
    }
    let table: TableReader<'_> = field.clone().table()?;
    table.only(&prior::shape(None).keys())?;
    match prior::read(&table, Some(Dimension::FrameCompliance))? {
        Some(Prior::Normal { mean, sd }) => Ok(Freedom::Normal { mean, sd }),
        _ => Err(field.wanted(WANTED)),
    }
}
