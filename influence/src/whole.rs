//! Whole numbers from real ones: the one place where the conversion is made, saturating at 0 and at the largest.

/// The largest whole number not above x; 0 for what is negative or not a number.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the conversion saturates, as documented"
)]
#[inline]
pub(crate) fn floor(x: f64) -> usize {
    x as usize
}

/// The smallest whole number not below x; 0 for what is negative or not a number.
pub(crate) fn ceil(x: f64) -> usize {
    floor(x.ceil())
}

#[cfg(test)]
mod tests {
    use super::{ceil, floor};

    #[test]
    fn what_is_no_count_is_none() {
        assert_eq!([floor(3.9), floor(-1.0), floor(f64::NAN)], [3, 0, 0]);
        assert_eq!([ceil(3.1), ceil(4.0), ceil(-0.5)], [4, 4, 0]);
    }
}
