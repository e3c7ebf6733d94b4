//! A measured curve as used in a fit: abscissae, observed values and noise.

use pellicle::input::diagnosis::Diagnosis;
use pellicle_identify::fit_file::FitFile;
use pellicle_identify::measured::curve::MeasuredCurve;
use pellicle_identify::measured::data_table::DataTable;
use pellicle_identify::measured::error::CurveError;
use pellicle_identify::measured::noise::NoiseCorrelation;
use pellicle_identify::{Amount, Correlation, Curve, IdentifyError, Invalidity, Noise};

use crate::failure::Failure;

/// The smallest number of points of a curve.
pub const FEWEST_POINTS: usize = 3;

/// A curve and its origin.
#[derive(Debug, Clone)]
pub struct CurveSource {
    /// The measurement.
    pub measured: MeasuredCurve,
    /// Abscissae of the points that are fitted: forces, N, or depths, m.
    pub abscissa: Vec<f64>,
    /// The values observed there.
    pub observed: Vec<f64>,
    /// The times, s, if known.
    pub time: Option<Vec<f64>>,
    /// Number of points left out because their abscissa is not positive, where there is no contact.
    pub without_contact: usize,
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
    /// Reads the curves of the files of a table.
    ///
    /// # Errors
    ///
    /// [`Failure`] if a file gives no curve.
    pub fn of_table(table: &DataTable) -> Result<Vec<Self>, Failure> {
        let sources = MeasuredCurve::read_all(table)?.into_iter();
        sources
            .map(|measured| Ok(Self::of(measured, table)?))
            .collect()
    }

    fn of(measured: MeasuredCurve, table: &DataTable) -> Result<Self, Diagnosis> {
        let (x, y) = (
            table.observe.abscissa().into(),
            table.observe.observed().into(),
        );
        let values = |channel| measured.values(channel).unwrap_or_default();
        let (abscissa, observed) = (values(x), values(y));
        let in_contact: Vec<usize> = (0..abscissa.len())
            .filter(|point| abscissa[*point] > 0.0)
            .collect();
        let kept = |values: &[f64]| in_contact.iter().map(|point| values[*point]).collect();
        let source = Self {
            abscissa: kept(abscissa),
            observed: kept(observed),
            time: measured.time().map(kept),
            without_contact: abscissa.len() - in_contact.len(),
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

    /// Returns the curve without the points at which the model does not hold; `invalid` gives the reason for each of
    /// them.
    #[must_use]
    pub fn without(&self, invalid: &[Option<Invalidity>]) -> Self {
        let kept: Vec<usize> = (0..self.points.len())
            .filter(|point| invalid[*point].is_none())
            .collect();
        let chosen = |values: &[f64]| kept.iter().map(|point| values[*point]).collect();
        Self {
            abscissa: chosen(&self.abscissa),
            observed: chosen(&self.observed),
            time: self.time.as_deref().map(chosen),
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
        let curve = Curve::new(self.abscissa.clone(), self.observed.clone())?;
        match &self.time {
            Some(time) if time.windows(2).all(|pair| pair[1] > pair[0]) => {
                curve.with_time(time.clone())
            }
            _ => Ok(curve),
        }
    }
}

/// Returns the noise of all tables, which must agree.
///
/// If not given, the noise of the observed quantity is estimated, and that of the abscissa is zero.
///
/// # Errors
///
/// [`Failure`] if two tables have different noise.
pub fn noise(file: &FitFile) -> Result<Noise, Failure> {
    let of = |table: &DataTable| (table.observe, table.noise);
    let first = file.data.first().map(of);
    let (observe, noise) = first.unwrap_or_default();
    if let Some(other) = file.data.iter().find(|table| of(table) != (observe, noise)) {
        return Err(other.other_noise().into());
    }
    let (observed, abscissa) = (noise.of(observe.observed()), noise.of(observe.abscissa()));
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
