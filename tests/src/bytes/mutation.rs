//! Damage to a file, drawn from a seed: bits, lengths, pieces of other files, numbers beyond any range, and words of
//! the text in each other's place.

use rand::seq::{IndexedMutRandom as _, IndexedRandom as _};
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

/// The most bytes of a damaged file.
const LONGEST: usize = 1 << 16;

/// The most bytes of a short block: a few words.
const SHORT: usize = 16;

/// The most times a block is repeated.
const MOST_REPEATS: usize = 40;

/// Numbers at and beyond the ends of the ranges in which they are kept, and other words in their place.
const NUMBERS: [&str; 22] = [
    "0",
    "-1",
    "-0.0",
    "1e999",
    "-1e400",
    "1e308",
    "1e-320",
    "nan",
    "inf",
    "255",
    "65536",
    "4294967296",
    "9223372036854775807",
    "18446744073709551615",
    "18446744073709551616",
    "99999999999999999999999999",
    "1,5",
    "0x7f",
    "1_000_000_000",
    "true",
    "\"\"",
    "[]",
];

/// Bytes that mean something to a reader, or end it: zero, line ends, quotes, brackets, halves of a character.
const BYTES: [u8; 18] = *b"\0\n\r\t\"'{}[],;=#.\x80\xc3\xff";

/// Damages files; the same seed gives the same damage.
#[derive(Debug)]
pub struct Mutator(ChaCha8Rng);

impl Mutator {
    /// Begins with a seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    /// One of these files with one to four faults; empty if there is none.
    #[must_use]
    pub fn damaged(&mut self, files: &[Vec<u8>]) -> Vec<u8> {
        let Some(mut bytes) = files.choose(&mut self.0).cloned() else {
            return Vec::new();
        };
        for _ in 0..self.0.random_range(1..=4) {
            self.damage(&mut bytes, files);
            bytes.truncate(LONGEST);
        }
        bytes
    }

    fn damage(&mut self, bytes: &mut Vec<u8>, files: &[Vec<u8>]) {
        match self.0.random_range(0..12) {
            0 => self.flip(bytes),
            1 => self.insert(bytes),
            2 => {
                let end = self.place(bytes);
                bytes.truncate(end);
            }
            3 => {
                let block = self.block(bytes);
                bytes.drain(block);
            }
            4 => {
                let block = self.block(bytes);
                let repeated = bytes[block.clone()].repeat(self.0.random_range(1..=MOST_REPEATS));
                bytes.splice(block, repeated);
            }
            5 => self.splice(bytes, files),
            6 => self.overwrite(bytes),
            7 | 8 => self.number(bytes),
            9 => self.swap(bytes, is_of_word),
            10 => self.swap(bytes, |byte| byte != b'\n'),
            _ => self.replace(bytes, files),
        }
    }

    /// A place in the file, or its end.
    fn place(&mut self, bytes: &[u8]) -> usize {
        self.0.random_range(0..=bytes.len())
    }

    /// A piece of the file: short, or of any length.
    fn block(&mut self, bytes: &[u8]) -> std::ops::Range<usize> {
        let [one, other] = [self.place(bytes), self.place(bytes)];
        let (start, end) = (one.min(other), one.max(other));
        if self.0.random_bool(0.5) {
            start..end.min(start + SHORT)
        } else {
            start..end
        }
    }

    fn flip(&mut self, bytes: &mut [u8]) {
        if let Some(byte) = bytes.choose_mut(&mut self.0) {
            *byte ^= 1 << self.0.random_range(0..8);
        }
    }

    fn insert(&mut self, bytes: &mut Vec<u8>) {
        let at = self.place(bytes);
        let byte = BYTES.choose(&mut self.0).copied();
        bytes.splice(at..at, byte);
    }

    /// Puts a piece of another file somewhere.
    fn splice(&mut self, bytes: &mut Vec<u8>, files: &[Vec<u8>]) {
        if let Some(other) = files.choose(&mut self.0) {
            let (to, from) = (self.block(bytes), self.block(other));
            bytes.splice(to, other[from].iter().copied());
        }
    }

    /// Writes the smallest or largest number of 1, 2, 4 or 8 bytes over others.
    fn overwrite(&mut self, bytes: &mut [u8]) {
        let at = self.place(bytes);
        let width = 1 << self.0.random_range(0..4);
        let end = bytes.len().min(at + width);
        bytes[at..end].fill(if self.0.random_bool(0.5) { 0 } else { 0xff });
    }

    /// Writes another number in the place of one.
    fn number(&mut self, bytes: &mut Vec<u8>) {
        let is_number = |word: &std::ops::Range<usize>| bytes[word.start].is_ascii_digit();
        let numbers: Vec<_> = words(bytes, is_of_word).filter(is_number).collect();
        let number = NUMBERS.choose(&mut self.0).copied().unwrap_or_default();
        if let Some(old) = numbers.choose(&mut self.0) {
            bytes.splice(old.clone(), number.bytes());
        }
    }

    /// Exchanges two words, or lines.
    fn swap(&mut self, bytes: &mut Vec<u8>, is_of_one: fn(u8) -> bool) {
        let all: Vec<_> = words(bytes, is_of_one).collect();
        let (Some(one), Some(other)) = (all.choose(&mut self.0), all.choose(&mut self.0)) else {
            return;
        };
        let (first, second) = if one.start < other.start {
            (one.clone(), other.clone())
        } else {
            (other.clone(), one.clone())
        };
        if first.end <= second.start {
            let [former, latter] = [&first, &second].map(|word| bytes[word.clone()].to_vec());
            bytes.splice(second, former);
            bytes.splice(first, latter);
        }
    }

    /// Writes a word of any of the files in the place of one.
    fn replace(&mut self, bytes: &mut Vec<u8>, files: &[Vec<u8>]) {
        let Some(other) = files.choose(&mut self.0) else {
            return;
        };
        let [own, others] =
            [&*bytes, other].map(|file| words(file, is_of_word).collect::<Vec<_>>());
        if let (Some(old), Some(new)) = (own.choose(&mut self.0), others.choose(&mut self.0)) {
            bytes.splice(old.clone(), other[new.clone()].iter().copied());
        }
    }
}

fn is_of_word(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || b"_.+-".contains(&byte)
}

/// The longest stretches of bytes that belong to a word.
fn words(
    bytes: &[u8],
    is_of_word: fn(u8) -> bool,
) -> impl Iterator<Item = std::ops::Range<usize>> + '_ {
    let mut end = 0;
    std::iter::from_fn(move || {
        let start = end + bytes[end..].iter().position(|byte| is_of_word(*byte))?;
        let length = bytes[start..].iter().position(|byte| !is_of_word(*byte));
        end = length.map_or(bytes.len(), |length| start + length);
        Some(start..end)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_seed_gives_the_same_damage_and_nearly_every_file_is_damaged() {
        let files = [b"a = 1\nb = 2.5\n".to_vec(), b"c = \"x y\"\n".to_vec()];
        let [mut one, mut other] = [Mutator::new(3), Mutator::new(3)];
        let mut damaged = 0;
        for _ in 0..1000 {
            let bytes = one.damaged(&files);
            assert_eq!(bytes, other.damaged(&files));
            damaged += usize::from(!files.contains(&bytes));
        }
        assert!(damaged > 800, "{damaged}");
    }

    #[test]
    fn words_are_found_to_the_end_of_the_file() {
        let found: Vec<_> = words(b"k=1.5e-3, two", is_of_word).collect();
        assert_eq!(found, [0..1, 2..8, 10..13]);
        assert_eq!(words(b"", is_of_word).count(), 0);
    }
}
