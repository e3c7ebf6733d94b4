//! Numbers as bytes, little-endian, every bit of an f64 kept: what the files of the cache hold.

/// Bytes of one number.
pub(crate) const WIDTH: usize = 8;

/// Writes numbers one after another.
#[derive(Debug, Default)]
pub(crate) struct Encoder(Vec<u8>);

impl Encoder {
    /// Writes a real number.
    pub(crate) fn real(&mut self, value: f64) {
        self.0.extend_from_slice(&value.to_le_bytes());
    }

    /// Writes real numbers, without their count.
    pub(crate) fn reals(&mut self, values: &[f64]) {
        self.0.reserve(WIDTH * values.len());
        values.iter().for_each(|value| self.real(*value));
    }

    /// Writes a count.
    pub(crate) fn count(&mut self, count: usize) {
        self.0.extend_from_slice(&(count as u64).to_le_bytes());
    }

    /// Writes real numbers, their count first.
    pub(crate) fn list(&mut self, values: &[f64]) {
        self.count(values.len());
        self.reals(values);
    }

    /// Everything written.
    pub(crate) fn into_bytes(self) -> Vec<u8> {
        self.0
    }
}

/// Reads what an [`Encoder`] wrote. Every answer is none where the bytes end too early or are no finite number.
#[derive(Debug)]
pub(crate) struct Decoder<'a>(&'a [u8]);

impl<'a> Decoder<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self(bytes)
    }

    /// A finite real number.
    pub(crate) fn real(&mut self) -> Option<f64> {
        self.word().map(f64::from_le_bytes).filter(finite)
    }

    /// As many finite real numbers as the array is long.
    pub(crate) fn array<const N: usize>(&mut self) -> Option<[f64; N]> {
        let mut values = [0.0; N];
        for value in &mut values {
            *value = self.real()?;
        }
        Some(values)
    }

    /// This many finite real numbers.
    pub(crate) fn reals(&mut self, count: usize) -> Option<Vec<f64>> {
        let (numbers, rest) = self.0.split_at_checked(count.checked_mul(WIDTH)?)?;
        self.0 = rest;
        let (words, _) = numbers.as_chunks::<WIDTH>();
        let values: Vec<f64> = words.iter().map(|word| f64::from_le_bytes(*word)).collect();
        values.iter().all(finite).then_some(values)
    }

    /// A count of things of at least one number each.
    pub(crate) fn count(&mut self) -> Option<usize> {
        let count = usize::try_from(self.word().map(u64::from_le_bytes)?).ok()?;
        (count <= self.0.len() / WIDTH).then_some(count)
    }

    /// A whole number that is no count.
    pub(crate) fn index(&mut self) -> Option<usize> {
        usize::try_from(self.word().map(u64::from_le_bytes)?).ok()
    }

    /// Real numbers, their count first.
    pub(crate) fn list(&mut self) -> Option<Vec<f64>> {
        let count = self.count()?;
        self.reals(count)
    }

    /// The value, if nothing is left unread.
    pub(crate) fn finish<T>(self, value: T) -> Option<T> {
        self.0.is_empty().then_some(value)
    }

    fn word(&mut self) -> Option<[u8; WIDTH]> {
        let (word, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(*word)
    }
}

#[expect(
    clippy::trivially_copy_pass_by_ref,
    reason = "the form that `filter` and `all` take"
)]
fn finite(value: &f64) -> bool {
    value.is_finite()
}

#[cfg(test)]
mod tests {
    use super::{Decoder, Encoder};

    #[test]
    fn every_bit_comes_back() {
        let values = [-0.0, f64::MIN_POSITIVE / 8.0, 0.1, -f64::MAX];
        let mut encoder = Encoder::default();
        encoder.list(&values);
        encoder.real(1.0 / 3.0);
        let bytes = encoder.into_bytes();
        let mut decoder = Decoder::new(&bytes);
        let bits = |values: &[f64]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&decoder.list().unwrap()), bits(&values));
        assert_eq!(decoder.real(), Some(1.0 / 3.0));
        assert_eq!(decoder.finish(()), Some(()));
    }

    #[test]
    fn bytes_that_end_too_early_or_too_late_are_refused() {
        let mut encoder = Encoder::default();
        encoder.list(&[1.0, 2.0]);
        let bytes = encoder.into_bytes();
        for length in 0..bytes.len() {
            assert_eq!(Decoder::new(&bytes[..length]).list(), None);
        }
        let mut decoder = Decoder::new(&bytes);
        assert_eq!(decoder.count(), Some(2));
        assert_eq!(decoder.finish(()), None);
    }

    #[test]
    fn a_count_beyond_the_bytes_and_a_number_that_is_none_are_refused() {
        let mut encoder = Encoder::default();
        encoder.count(usize::MAX);
        encoder.reals(&[f64::NAN]);
        let bytes = encoder.into_bytes();
        let mut decoder = Decoder::new(&bytes);
        assert_eq!(decoder.list(), None);
        assert_eq!(decoder.reals(1), None);
    }
}
