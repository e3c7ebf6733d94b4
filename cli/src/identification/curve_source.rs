//! A measured curve as used in a fit: abscissae, observed values and noise.

use pellicle::input::diagnosis::Diagnosis;
use pellicle_contact::adhesion::Adhesion;
use pellicle_identify::fit_file::FitFile;
use pellicle_identify::fit_file::evaluation_file::EvaluatedFile;
use pellicle_identify::fit_file::nuisance::{ForceZero, NuisanceTable, Zero};
use pellicle_identify::measured::baseline::is_pull_off;
use pellicle_identify::measured::channel::Channel;
use pellicle_identify::measured::curve::MeasuredCurve;
use pellicle_identify::measured::curve_segment::Branch;
use pellicle_identify::measured::data_table::DataTable;
use pellicle_identify::measured::error::CurveError;
use pellicle_identify::measured::noise::NoiseCorrelation;
use pellicle_identify::{
    Amount, Correlation, Curve, IdentifyError, Invalidity, Noise, Observable, PointErrors, Reading,
};

use super::contact_noise;
use crate::failure::Failure;

/// The smallest number of points of a curve.
pub const FEWEST_POINTS: usize = 3;
/// A force is clearly that of a contact above this many standard deviations of single forces. There the depth, which
/// grows as a power of the force of ⅔ or so, is nearly linear in its noise: the mean of `(1 + ε)^⅔` is 0.4 % below 1.
const CLEAR: f64 = 5.0;
/// Number of neighbouring forces whose mean decides; its noise is a third of that of one.
const NEIGHBOURS: usize = 9;
/// Forces without noise are known to this part of the largest, as files have so many digits.
const DIGITS: f64 = 1e-6;

/// A curve and its origin.
#[derive(Debug, Clone)]
pub struct CurveSource {
    /// The measurement.
    pub measured: MeasuredCurve,
    /// Abscissae of the points that are fitted: forces, N, or depths, m, or approaches of a cantilever, m.
    pub abscissa: Vec<f64>,
    /// The values observed there.
    pub observed: Vec<f64>,
    /// The times, s, if known.
    pub time: Option<Vec<f64>>,
    /// Number of points left out because their abscissa is not positive, where there is no contact.
    pub without_contact: usize,
    /// Whether it begins or ends at the pull-off of a contact with adhesion.
    pub has_pull_off: bool,
    /// What the imprint under each point takes off the thickness of the top layer, m; empty for nothing.
    pub thinned: Vec<f64>,
    /// The known errors of each point; empty for none.
    pub errors: Vec<PointErrors>,
    /// The index of each fitted point among those of the measurement.
    points: Vec<usize>,
}

/// A point of a measurement at which the model does not hold.
#[derive(Debug, Clone, PartialEq)]
pub struct OutsidePoint {
    /// Its row in the table of the file, from 1.
    pub row: usize,
    /// Its abscissa.
    pub abscissa: f64,
    /// The value observed there.
    pub observed: f64,
    /// The reason why the model does not hold.
    pub reason: Invalidity,
}

impl OutsidePoint {
    /// Whether only the grid's error is too large there.
    #[must_use]
    pub fn is_inaccurate(&self) -> bool {
        self.reason == Invalidity::Inaccurate
    }
}

impl CurveSource {
    /// Reads the curves of the files of a table, for a fit with these nuisances.
    ///
    /// # Errors
    ///
    /// [`Failure`] if a file gives no curve.
    pub fn of_table(
        table: &DataTable,
        nuisances: &NuisanceTable,
        adhesion: Option<Adhesion>,
    ) -> Result<Vec<Self>, Failure> {
        let sources = MeasuredCurve::read_all(table)?.into_iter();
        sources
            .map(|measured| Ok(Self::of(measured, table, nuisances, adhesion)?))
            .collect()
    }

    fn of(
        measured: MeasuredCurve,
        table: &DataTable,
        nuisances: &NuisanceTable,
        adhesion: Option<Adhesion>,
    ) -> Result<Self, Diagnosis> {
        let adhering = adhesion.and_then(|_| with_adhesion(&measured, table.segment.part));
        let is_approach =
            table.observe == Observable::ForceAtDepth && measured.approach().is_some();
        let x = if is_approach {
            Channel::Height
        } else {
            table.observe.abscissa().into()
        };
        let y = table.observe.observed().into();
        let values = |channel| measured.values(channel).unwrap_or_default();
        let (abscissa, observed) = (values(x), values(y));
        let has_pull_off = adhering.is_some();
        let in_contact = match table.observe.abscissa() {
            _ if has_pull_off => adhering.unwrap_or_default(),
            // A fit with the zero of the depth finds the contact itself.
            Reading::Depth if nuisances.seeks_depth_zero(table.observe) => {
                (0..abscissa.len()).collect()
            }
            Reading::Force => after_contact(&measured, abscissa, nuisances),
            _ => positive(abscissa, 0.0),
        };
        let kept = |values: &[f64]| in_contact.iter().map(|point| values[*point]).collect();
        let source = Self {
            abscissa: kept(abscissa),
            observed: kept(observed),
            time: measured.time().map(kept),
            without_contact: abscissa.len() - in_contact.len(),
            has_pull_off,
            thinned: Vec::new(),
            errors: Vec::new(),
            points: in_contact,
            measured,
        };
        let (found, rows) = (source.abscissa.len(), source.measured.table_rows);
        let wanted = FEWEST_POINTS;
        if found < wanted {
            let error = CurveError::TooFewPoints {
                found,
                rows,
                wanted,
            };
            return Err(table.diagnosis(&source.measured.file, &error));
        }
        Ok(source)
    }

    /// A curve of these readings, one for each row of a measurement.
    #[must_use]
    pub fn of_readings(measured: MeasuredCurve, [abscissa, observed]: [Vec<f64>; 2]) -> Self {
        Self {
            points: (0..abscissa.len()).collect(),
            measured,
            abscissa,
            observed,
            time: None,
            without_contact: 0,
            has_pull_off: false,
            thinned: Vec::new(),
            errors: Vec::new(),
        }
    }

    /// What the file tells of the zero of its force.
    #[must_use]
    pub fn force_zero(&self) -> ForceZero {
        let Some(before) = self.measured.before_contact else {
            return ForceZero::Unknown;
        };
        let is_before = |point: &usize| before.has(self.measured.rows[*point]);
        let in_fit = self.points.iter().filter(|point| is_before(point)).count();
        let forces = self.measured.force().unwrap_or_default().iter();
        let largest = forces.fold(0.0, |most: f64, force| most.max(force.abs()));
        let [mean, error] = before.zero();
        let zero = [mean, error.max(DIGITS * largest)];
        if in_fit >= FEWEST_POINTS {
            return ForceZero::InFit(before.is_subtracted.then_some(zero));
        }
        ForceZero::Measured(zero)
    }

    /// Where its abscissa begins, if the file shows it.
    #[must_use]
    pub fn origin(&self, observe: Observable) -> Option<f64> {
        let before = self.measured.before_contact?;
        Some(match observe.abscissa() {
            Reading::Force => before.zero()[0],
            _ => before.contact,
        })
    }

    /// Returns the curve without the points at which the model does not hold; `invalid` gives the reason for each of
    /// them.
    #[must_use]
    pub fn without(&self, invalid: &[Option<Invalidity>]) -> Self {
        let kept: Vec<usize> = (0..self.points.len())
            .filter(|point| invalid.get(*point).is_none_or(Option::is_none))
            .collect();
        let chosen = |values: &[f64]| kept.iter().map(|point| values[*point]).collect();
        let errors = kept.iter().filter_map(|point| self.errors.get(*point));
        let thinned = kept.iter().filter_map(|point| self.thinned.get(*point));
        Self {
            abscissa: chosen(&self.abscissa),
            observed: chosen(&self.observed),
            time: self.time.as_deref().map(chosen),
            thinned: thinned.copied().collect(),
            errors: errors.copied().collect(),
            points: kept.iter().map(|point| self.points[*point]).collect(),
            ..self.clone()
        }
    }

    /// Returns the points at which the model does not hold.
    #[must_use]
    pub fn outside(&self, invalid: &[Option<Invalidity>]) -> Vec<OutsidePoint> {
        let points = self.points.iter().zip(invalid).enumerate();
        let outside = points.filter_map(|(point, (place, reason))| {
            Some(OutsidePoint {
                row: self.measured.rows[*place],
                abscissa: self.abscissa[point],
                observed: self.observed[point],
                reason: (*reason)?,
            })
        });
        outside.collect()
    }

    /// The row in the table of the file, from 1, of a point of the fit.
    #[must_use]
    pub fn row(&self, point: usize) -> usize {
        self.measured.rows[self.points[point]]
    }

    /// Returns the curve for a fit; it has times only if they increase.
    ///
    /// # Errors
    ///
    /// [`IdentifyError`] if a value is not finite.
    pub fn curve(&self) -> Result<Curve, IdentifyError> {
        let mut curve = Curve::new(self.abscissa.clone(), self.observed.clone())?;
        if !self.errors.is_empty() {
            curve = curve.with_errors(self.errors.clone())?;
        }
        match &self.time {
            Some(time) if time.windows(2).all(|pair| pair[1] > pair[0]) => {
                curve.with_time(time.clone())
            }
            _ => Ok(curve),
        }
    }
}

/// The points whose abscissa is above a zero.
fn positive(abscissa: &[f64], zero: f64) -> Vec<usize> {
    (0..abscissa.len())
        .filter(|point| abscissa[*point] > zero)
        .collect()
}

/// The points whose force is clearly that of a contact: of a file that shows a stretch before it, those after the mean
/// of neighbouring forces was last one that might be noise. Single forces would choose points by their noise.
fn after_contact(
    measured: &MeasuredCurve,
    forces: &[f64],
    nuisances: &NuisanceTable,
) -> Vec<usize> {
    let Some(before) = measured.before_contact else {
        return positive(forces, 0.0);
    };
    let zero = before.zero()[0];
    let least = match nuisances.force_zero {
        Some(Zero::Off) => f64::max(zero + CLEAR * before.line.noise, 0.0),
        _ => zero + CLEAR * before.line.noise,
    };
    let mean = |window: &[f64]| window.iter().sum::<f64>() / window.len() as f64;
    let half = NEIGHBOURS / 2;
    let around = |point: usize| point.saturating_sub(half)..(point + half + 1).min(forces.len());
    let is_unclear = |point: &usize| mean(&forces[around(*point)]) <= least;
    if before.is_after {
        let first = (0..forces.len()).find(is_unclear);
        return (0..first.unwrap_or(forces.len())).collect();
    }
    let first = (0..forces.len()).rev().find(is_unclear);
    (first.map_or(0, |point| point + 1)..forces.len()).collect()
}

/// The points of a contact with adhesion between its largest force and its lowest one, where it has jumped in or is
/// about to jump out; not the lowest itself, which its noise has chosen. None without a force clearly below its zero.
fn with_adhesion(measured: &MeasuredCurve, part: Branch) -> Option<Vec<usize>> {
    let forces = measured.force()?;
    let lowest = (0..forces.len()).min_by(|a, b| forces[*a].total_cmp(&forces[*b]))?;
    let largest = forces.iter().copied().fold(0.0, f64::max);
    let [zero, noise] = measured
        .before_contact
        .map_or([0.0; 2], |before| [before.zero()[0], before.line.noise]);
    if !is_pull_off(zero - forces[lowest], noise, largest) {
        return None;
    }
    Some(match part {
        Branch::Unloading => (0..lowest).collect(),
        Branch::Loading | Branch::Whole => (lowest + 1..forces.len()).collect(),
    })
}

/// The compliance in series with the contact, m/N: that of a cantilever.
#[must_use]
pub fn series(table: &DataTable) -> f64 {
    table
        .spring_constant
        .map_or(0.0, |spring| 1.0 / spring.mean)
}

/// Returns the noise of all tables, which must agree.
///
/// If not given, the noise of the observed quantity is estimated, and that of the abscissa is zero, or that of the
/// forces before the contact.
///
/// # Errors
///
/// [`Failure`] if two tables have different noise.
pub fn noise(
    file: &FitFile,
    sources: &[CurveSource],
    evaluated: &[EvaluatedFile],
) -> Result<Noise, Failure> {
    let of = |table: &DataTable| (table.observe, table.noise);
    let first = file.data.first().map(of);
    let (observe, noise) = first.unwrap_or_default();
    if let Some(other) = file.data.iter().find(|table| of(table) != (observe, noise)) {
        return Err(other.other_noise().into());
    }
    if observe == Observable::UnloadingStiffness {
        return Ok(contact_noise::noise(noise, evaluated, file));
    }
    let (observed, abscissa) = (noise.of(observe.observed()), noise.of(observe.abscissa()));
    // What the forces scatter by before the contact, they scatter by in it.
    let scatter = sources
        .iter()
        .filter_map(|source| source.measured.before_contact);
    let scatter = scatter.map(|before| before.line.noise.powi(2));
    let (count, sum) = scatter.fold((0.0, 0.0), |(count, sum), square| {
        (count + 1.0, sum + square)
    });
    let seen = (observe.abscissa() == Reading::Force && count > 0.0).then(|| (sum / count).sqrt());
    let abscissa = abscissa.or(seen);
    Ok(Noise {
        observed: observed.map_or(Amount::Estimated, Amount::Given),
        abscissa: Amount::Given(abscissa.unwrap_or(0.0)),
        relative: Amount::Given(noise.relative.unwrap_or(0.0)),
        correlation: match noise.correlation {
            NoiseCorrelation::None => Correlation::None,
            NoiseCorrelation::Estimate => Correlation::Estimated,
        },
    })
}
