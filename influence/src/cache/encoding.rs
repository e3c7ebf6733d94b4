//! Numbers as bytes, little-endian, every bit of an f64 kept: what the files of the cache hold.

use std::io::Read;

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

/// Numbers read at once where there are many: few enough for the nearest cache of the processor.
const NUMBERS: usize = 1024;

/// Reads what an [`Encoder`] wrote, as it comes. Every answer is none where the bytes end too early or are no finite number.
pub(crate) struct Decoder<'a> {
    source: &'a mut dyn Read,
    /// Bytes that there are still to be.
    left: usize,
    /// Room for numbers that are read at once.
    block: Vec<u8>,
}

impl<'a> Decoder<'a> {
    /// Reads `length` bytes from the source.
    pub(crate) fn new(source: &'a mut dyn Read, length: usize) -> Self {
        Self {
            source,
            left: length,
            block: vec![0; WIDTH * NUMBERS],
        }
    }

    /// A finite real number.
    pub(crate) fn real(&mut self) -> Option<f64> {
        self.word().map(f64::from_le_bytes).filter(finite)
    }

    /// As many finite real numbers as the array is long.
    pub(crate) fn array<const N: usize>(&mut self) -> Option<[f64; N]> {
        let mut values = [0.0; N];
        for (value, word) in values.iter_mut().zip(self.words(N)?) {
            *value = f64::from_le_bytes(*word);
        }
        values.iter().all(finite).then_some(values)
    }

    /// This many finite real numbers.
    pub(crate) fn reals(&mut self, count: usize) -> Option<Vec<f64>> {
        if count > self.left / WIDTH {
            return None;
        }
        let mut values = Vec::with_capacity(count);
        while values.len() < count {
            let before = values.len();
            let words = self.words((count - before).min(NUMBERS))?;
            values.extend(words.iter().map(|word| f64::from_le_bytes(*word)));
            if !values[before..].iter().all(finite) {
                return None;
            }
        }
        Some(values)
    }

    /// A count of things of at least one number each.
    pub(crate) fn count(&mut self) -> Option<usize> {
        let count = usize::try_from(self.word().map(u64::from_le_bytes)?).ok()?;
        (count <= self.left / WIDTH).then_some(count)
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
    pub(crate) fn finish<T>(&self, value: T) -> Option<T> {
        (self.left == 0).then_some(value)
    }

    fn word(&mut self) -> Option<[u8; WIDTH]> {
        self.words(1)?.first().copied()
    }

    /// The next words, no more than [`NUMBERS`].
    fn words(&mut self, count: usize) -> Option<&[[u8; WIDTH]]> {
        let length = WIDTH * count;
        self.left = self.left.checked_sub(length)?;
        let block = self.block.get_mut(..length)?;
        self.source.read_exact(block).ok()?;
        Some(block.as_chunks().0)
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
    use super::{Decoder, Encoder, NUMBERS, WIDTH};

    /// What is read from these bytes, of which there are said to be as many.
    fn read<T>(bytes: &[u8], read: impl FnOnce(&mut Decoder<'_>) -> T) -> T {
        read(&mut Decoder::new(&mut &*bytes, bytes.len()))
    }

    #[test]
    fn every_bit_comes_back() {
        let values = [-0.0, f64::MIN_POSITIVE / 8.0, 0.1, -f64::MAX];
        let many: Vec<f64> = (0..2 * NUMBERS + 3).map(|i| 1.0 / (i + 3) as f64).collect();
        let mut encoder = Encoder::default();
        encoder.list(&values);
        encoder.real(1.0 / 3.0);
        encoder.reals(&many);
        let bytes = encoder.into_bytes();
        let bits = |values: &[f64]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
        read(&bytes, |decoder| {
            assert_eq!(bits(&decoder.list().unwrap()), bits(&values));
            assert_eq!(decoder.real(), Some(1.0 / 3.0));
            assert_eq!(decoder.finish(()), None);
            assert_eq!(decoder.reals(many.len()).unwrap(), many);
            assert_eq!(decoder.finish(()), Some(()));
        });
    }

    #[test]
    fn bytes_that_end_too_early_or_too_late_are_refused() {
        let mut encoder = Encoder::default();
        encoder.list(&[1.0, 2.0]);
        let bytes = encoder.into_bytes();
        for length in 0..bytes.len() {
            assert!(read(&bytes[..length], |decoder| decoder.list().is_none()));
            // Fewer than there were said to be.
            let mut fewer = &bytes[..length];
            assert_eq!(Decoder::new(&mut fewer, bytes.len()).list(), None);
        }
        read(&bytes, |decoder| {
            assert_eq!(decoder.count(), Some(2));
            assert_eq!(decoder.finish(()), None);
        });
    }

    #[test]
    fn a_count_beyond_the_bytes_and_a_number_that_is_none_are_refused() {
        let mut encoder = Encoder::default();
        encoder.count(usize::MAX);
        encoder.reals(&[f64::NAN]);
        read(&encoder.into_bytes(), |decoder| {
            assert_eq!(decoder.count(), None);
            assert_eq!(decoder.reals(1), None);
        });
        let mut many = vec![1.0; 2 * NUMBERS];
        many[NUMBERS + 7] = f64::INFINITY;
        let mut encoder = Encoder::default();
        encoder.reals(&many);
        let bytes = encoder.into_bytes();
        assert_eq!(read(&bytes, |decoder| decoder.reals(many.len())), None);
        let mut fewer = &bytes[..WIDTH * (NUMBERS + 3)];
        let mut decoder = Decoder::new(&mut fewer, bytes.len());
        assert_eq!(decoder.reals(many.len()), None);
    }
}
