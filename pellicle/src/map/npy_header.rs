//! The header of an array that NumPy saved: type of its numbers, order, shape.
//!
//! Six magic bytes, two of version, the header's length in two or four bytes, then a Python dictionary of exactly three
//! keys. Only headers that NumPy writes are read, without recursion or large allocations, since files may be damaged or
//! forged. Source: NumPy's `lib/_format_impl`,
//! numpy.org/doc/stable/reference/generated/numpy.lib.format.html.

use super::error::MapError;

const MAGIC: &[u8] = b"\x93NUMPY";

/// The longest header that is read, bytes.
const MAX_LENGTH: usize = 1 << 16;

/// The header of an array.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NpyHeader {
    /// NumPy's name for the type of its numbers, such as `<f8`.
    pub kind: String,
    /// Whether the first index varies fastest.
    pub is_fortran: bool,
    /// Numbers along each axis.
    pub shape: Vec<usize>,
    /// Bytes before the first number.
    pub length: usize,
}

impl NpyHeader {
    /// Reads the header at the beginning of a file.
    ///
    /// # Errors
    ///
    /// [`MapError::Npy`] if it is not a header that NumPy writes.
    pub fn read(bytes: &[u8]) -> Result<Self, MapError> {
        let fault = |reason: &str| MapError::Npy(reason.into());
        let after = bytes.strip_prefix(MAGIC);
        let after = after.ok_or_else(|| fault("it has no NumPy header"))?;
        let (length, start) = match after {
            [1, 0, a, b, ..] => (usize::from(u16::from_le_bytes([*a, *b])), 10),
            [2 | 3, 0, a, b, c, d, ..] => (u32::from_le_bytes([*a, *b, *c, *d]) as usize, 12),
            _ => return Err(fault("its header is of an unknown version")),
        };
        let text = bytes.get(start..start + length.min(MAX_LENGTH + 1));
        let text = text.filter(|text| text.len() == length);
        let text = text.ok_or_else(|| fault("its header is longer than the file or too long"))?;
        let text = std::str::from_utf8(text).map_err(|_| fault("its header is not text"))?;
        let dictionary = text
            .trim()
            .strip_prefix('{')
            .and_then(|text| text.strip_suffix('}'));
        let dictionary = dictionary.ok_or_else(|| fault("its header is not a dictionary"))?;
        let mut keys = Keys::default();
        keys.read(dictionary).map_err(|reason| fault(&reason))?;
        match keys {
            Keys {
                kind: Some(kind),
                is_fortran: Some(is_fortran),
                shape: Some(shape),
            } => Ok(Self {
                kind,
                is_fortran,
                shape,
                length: start + length,
            }),
            _ => Err(fault("its header lacks descr, fortran_order or shape")),
        }
    }

    /// Size of the whole file, header and numbers, in bytes; none if it overflows or the type has no size.
    #[must_use]
    pub fn size(&self) -> Option<u64> {
        let digits = self.kind.trim_start_matches(|c: char| !c.is_ascii_digit());
        let number: usize = digits.parse().ok()?;
        let numbers = |bytes: usize, count: &usize| bytes.checked_mul(*count);
        let data = self.shape.iter().try_fold(number, numbers)?;
        u64::try_from(data.checked_add(self.length)?).ok()
    }
}

/// The values of the three keys, as far as read.
#[derive(Default)]
struct Keys {
    kind: Option<String>,
    is_fortran: Option<bool>,
    shape: Option<Vec<usize>>,
}

impl Keys {
    fn read(&mut self, dictionary: &str) -> Result<(), String> {
        let mut rest = dictionary.trim();
        while !rest.is_empty() {
            let (key, after) = quoted(rest).ok_or("its header has a key that is not a string")?;
            let after = after.trim_start().strip_prefix(':');
            let after = after
                .ok_or("its header has a key without a value")?
                .trim_start();
            let after = self.value(key, after)?.trim_start();
            rest = after.strip_prefix(',').unwrap_or(after).trim_start();
        }
        Ok(())
    }

    /// Reads the value of a key and returns the rest.
    fn value<'a>(&mut self, key: &str, text: &'a str) -> Result<&'a str, String> {
        let (is_new, after) = match key {
            "descr" => {
                let (kind, after) =
                    quoted(text).ok_or("its elements are structures of several numbers")?;
                (self.kind.replace(kind.into()).is_none(), after)
            }
            "fortran_order" => {
                let no = text.strip_prefix("False").map(|after| (false, after));
                let (yes, after) = no
                    .or_else(|| text.strip_prefix("True").map(|after| (true, after)))
                    .ok_or("its header has a fortran_order that is neither True nor False")?;
                (self.is_fortran.replace(yes).is_none(), after)
            }
            "shape" => {
                let (shape, after) =
                    tuple(text).ok_or("its header has a shape that is not a tuple of numbers")?;
                (self.shape.replace(shape).is_none(), after)
            }
            _ => return Err("its header has a key that NumPy does not write".into()),
        };
        if is_new {
            Ok(after)
        } else {
            Err(format!("its header has the key {key} twice"))
        }
    }
}

/// Reads a string without escapes; returns it and the rest.
fn quoted(text: &str) -> Option<(&str, &str)> {
    let quote = text.chars().next().filter(|c| matches!(c, '\'' | '"'))?;
    let (string, after) = text[1..].split_once(quote)?;
    (!string.contains('\\')).then_some((string, after))
}

/// Reads a tuple of numbers, `(3, 2)` or `(3,)`; returns it and the rest.
fn tuple(text: &str) -> Option<(Vec<usize>, &str)> {
    let (numbers, after) = text.strip_prefix('(')?.split_once(')')?;
    let numbers = numbers.trim();
    let numbers = numbers.strip_suffix(',').unwrap_or(numbers);
    let parse = |number: &str| number.trim().parse().ok();
    let numbers: Option<_> = match numbers {
        "" => Some(Vec::new()),
        numbers => numbers.split(',').map(parse).collect(),
    };
    Some((numbers?, after))
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A file of version 1 with this header, followed by these bytes.
    pub fn file(header: &str, data: &[u8]) -> Vec<u8> {
        let length = u16::try_from(header.len()).unwrap().to_le_bytes();
        [MAGIC, &[1, 0], &length, header.as_bytes(), data].concat()
    }

    #[test]
    fn the_three_keys_are_read_in_any_order() {
        let header = "{'shape': (3, 20,), \"descr\":'<f8','fortran_order': True}  \n";
        let read = NpyHeader::read(&file(header, &[])).unwrap();
        assert_eq!((read.kind.as_str(), read.is_fortran), ("<f8", true));
        assert_eq!(
            (&read.shape[..], read.length),
            (&[3, 20][..], 10 + header.len())
        );
    }

    #[test]
    fn headers_that_numpy_would_not_write_are_rejected() {
        let right = "'descr': '<f8', 'fortran_order': False";
        for header in [
            format!("{{{right}, 'shape': (1, 1), 'shape': (9999999, 9999999)}}"),
            format!("{{{right}, 'shape': (1, 1), 'descr': '<f4'}}"),
            format!("{{{right}}}"),
            format!("{{{right}, 'shape': (1, -1)}}"),
            format!("{{{right}, 'shape': [1, 1]}}"),
            format!("{{{right}, 'shape': (99999999999999999999999, 1)}}"),
            format!("{{{right}, 'shape': (1, 1), 'more': 1}}"),
            format!("{{{right}, 'shape': {}", "(".repeat(60_000)),
            "{'descr': [('a', '<f4'), ('b', '<f4')], 'fortran_order': False, 'shape': (1, 1)}"
                .into(),
            "[]".into(),
        ] {
            let found = NpyHeader::read(&file(&header, &[0; 16]));
            assert!(found.is_err(), "{}", &header[..header.len().min(100)]);
        }
        // A header of four thousand million bytes in a file of sixteen.
        let long = b"\x93NUMPY\x02\x00\xff\xff\xff\xff{}..".to_vec();
        assert!(NpyHeader::read(&long).is_err());
    }
}
