//! One measured curve.

use crate::{IdentifyError, PointErrors};

/// A measured curve: an observable at given abscissae, such as penetrations at given forces, in the order measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    abscissa: Vec<f64>,
    observed: Vec<f64>,
    time: Option<Vec<f64>>,
    origin: Option<f64>,
    errors: Vec<PointErrors>,
}

impl Curve {
    /// A curve of the observable over the abscissa. Correlated noise runs through the points in the order given.
    ///
    /// # Errors
    ///
    /// [`IdentifyError::Length`] where the lists differ in length or are empty, [`IdentifyError::Point`] at a value
    /// that is not finite.
    pub fn new(abscissa: Vec<f64>, observed: Vec<f64>) -> Result<Self, IdentifyError> {
        check_length("observable", &observed, abscissa.len().max(1))?;
        check_finite("abscissa", &abscissa)?;
        check_finite("observable", &observed)?;
        Ok(Self {
            abscissa,
            observed,
            time: None,
            origin: None,
            errors: Vec::new(),
        })
    }

    /// The same curve with the time of each point, for a drift.
    ///
    /// # Errors
    ///
    /// [`IdentifyError::Length`] where the numbers of times and points differ, [`IdentifyError::Point`] where a time is
    /// not finite or not after the previous one.
    pub fn with_time(mut self, time: Vec<f64>) -> Result<Self, IdentifyError> {
        check_length("time", &time, self.points())?;
        check_finite("time", &time)?;
        if let Some(back) = time.windows(2).position(|pair| pair[1] <= pair[0]) {
            return Err(IdentifyError::Point {
                list: "time",
                point: back + 1,
                found: time[back + 1],
                wanted: "a later time than that of the point before",
            });
        }
        self.time = Some(time);
        Ok(self)
    }

    /// The same curve with the zero of its abscissa that it shows, where the search for it starts.
    #[must_use]
    pub fn with_origin(mut self, origin: f64) -> Self {
        self.origin = Some(origin);
        self
    }

    /// The same curve with the known errors of each point, independent of those of others, beside the noise that all
    /// points have in common.
    ///
    /// # Errors
    ///
    /// [`IdentifyError::Length`] where the numbers of errors and points differ, [`IdentifyError::Point`] where a
    /// variance is negative or not finite.
    pub fn with_errors(mut self, errors: Vec<PointErrors>) -> Result<Self, IdentifyError> {
        check_count("known errors", errors.len(), self.points())?;
        let mut points = errors.iter().enumerate();
        points.try_for_each(|(point, errors)| errors.check(point))?;
        self.errors = errors;
        Ok(self)
    }

    /// The known errors of each point; empty where there are none.
    #[must_use]
    pub fn errors(&self) -> &[PointErrors] {
        &self.errors
    }

    /// The zero of its abscissa that it shows, if any: where the search for it starts.
    #[must_use]
    pub fn origin(&self) -> Option<f64> {
        self.origin
    }

    /// Number of points.
    #[must_use]
    pub fn points(&self) -> usize {
        self.abscissa.len()
    }

    /// The abscissae, such as forces.
    #[must_use]
    pub fn abscissa(&self) -> &[f64] {
        &self.abscissa
    }

    /// The observed values, such as penetrations.
    #[must_use]
    pub fn observed(&self) -> &[f64] {
        &self.observed
    }

    /// The times, where known.
    #[must_use]
    pub fn time(&self) -> Option<&[f64]> {
        self.time.as_deref()
    }
}

/// Checks that a list has one value for each point.
pub(crate) fn check_length(
    list: &'static str,
    values: &[f64],
    wanted: usize,
) -> Result<(), IdentifyError> {
    check_count(list, values.len(), wanted)
}

fn check_count(list: &'static str, found: usize, wanted: usize) -> Result<(), IdentifyError> {
    if found == wanted {
        return Ok(());
    }
    Err(IdentifyError::Length {
        list,
        found,
        wanted,
    })
}

/// Checks that every value of a list is a finite number.
pub(crate) fn check_finite(list: &'static str, values: &[f64]) -> Result<(), IdentifyError> {
    match values.iter().position(|value| !value.is_finite()) {
        None => Ok(()),
        Some(point) => Err(IdentifyError::Point {
            list,
            point,
            found: values[point],
            wanted: "a finite number",
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_needs_finite_lists_of_equal_length() {
        assert!(Curve::new(vec![1.0, 2.0], vec![1.0, 4.0]).is_ok());
        assert!(matches!(
            Curve::new(vec![1.0, 2.0], vec![1.0]),
            Err(IdentifyError::Length {
                found: 1,
                wanted: 2,
                ..
            })
        ));
        assert!(matches!(
            Curve::new(vec![1.0, f64::NAN], vec![1.0, 2.0]),
            Err(IdentifyError::Point { point: 1, .. })
        ));
        assert!(Curve::new(vec![], vec![]).is_err());
    }

    #[test]
    fn times_must_increase() {
        let curve = Curve::new(vec![1.0, 2.0, 3.0], vec![1.0, 4.0, 9.0]).unwrap();
        assert!(curve.clone().with_time(vec![0.0, 1.0, 2.0]).is_ok());
        assert!(matches!(
            curve.with_time(vec![0.0, 1.0, 1.0]),
            Err(IdentifyError::Point { point: 2, .. })
        ));
    }
}
