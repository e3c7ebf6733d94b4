//! A number of the result of a case, as it is drawn.

/// A number with its ±.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// The number; none if the case has no certified result.
    pub value: Option<f64>,
    /// Its ±.
    pub error: SampleError,
}

/// The ± of a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SampleError {
    /// The number has none.
    None,
    /// Half the width of its interval.
    Known(f64),
    /// The grids do not resolve it.
    NotResolved,
}

impl Sample {
    /// The number with its ± subtracted and added.
    #[must_use]
    pub fn ends(&self) -> Option<[f64; 2]> {
        let value = self.value?;
        let error = match self.error {
            SampleError::Known(error) => error,
            _ => 0.0,
        };
        Some([value - error, value + error])
    }
}

/// An axis of a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct SampledAxis {
    /// Its quantity, with the unit.
    pub title: String,
    /// Whether equal lengths are equal ratios; then all values are positive.
    pub is_logarithmic: bool,
}

/// The smallest and the largest of some numbers; none without any.
pub fn ends(numbers: impl IntoIterator<Item = f64>) -> Option<[f64; 2]> {
    let mut numbers = numbers.into_iter().filter(|number| number.is_finite());
    let first = numbers.next()?;
    let wider = |[low, high]: [f64; 2], number: f64| [low.min(number), high.max(number)];
    Some(numbers.fold([first; 2], wider))
}
