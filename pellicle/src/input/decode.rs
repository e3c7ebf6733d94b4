//! The decoding of a file's text from the encodings that instruments use.

use std::borrow::Cow;

use encoding_rs::{Encoding, UTF_8, UTF_16BE, UTF_16LE, WINDOWS_1252};

/// The encoding of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TextEncoding {
    /// UTF-16 or UTF-8 if the bytes are valid, Windows-1252 otherwise.
    Guessed,
    /// As named by the user; a byte-order mark takes precedence.
    Named(&'static Encoding),
}

/// The text of a file, and the encoding if it was only guessed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Decoded<'a> {
    /// The text.
    pub text: Cow<'a, str>,
    /// The encoding, if it was guessed and the bytes do not confirm it.
    pub guessed: Option<&'static str>,
}

/// A byte that the encoding does not have.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NotInEncoding {
    /// The name of the encoding.
    pub encoding: String,
    /// Line of the byte, from 1.
    pub line: usize,
}

impl TextEncoding {
    /// Returns the encoding of this name: one of the labels of the WHATWG standard, or `latin-1`.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let name = match name.to_lowercase().as_str() {
            "auto" => return Some(Self::Guessed),
            // The standard has "latin1" and "iso-8859-1"; all three mean Windows-1252, which contains them.
            "latin-1" => "latin1".to_owned(),
            other => other.to_owned(),
        };
        Encoding::for_label_no_replacement(name.as_bytes()).map(Self::Named)
    }

    /// Decodes these bytes.
    ///
    /// # Errors
    ///
    /// [`NotInEncoding`] of the first byte that the encoding does not have; none if it is guessed from ordinary text.
    pub fn decode(self, bytes: &[u8]) -> Result<Decoded<'_>, NotInEncoding> {
        if let Some((encoding, mark)) = Encoding::for_bom(bytes) {
            return strict(encoding, bytes.get(mark..).unwrap_or_default());
        }
        match self {
            Self::Named(encoding) => strict(encoding, bytes),
            Self::Guessed => guess(bytes),
        }
    }

    /// Whether zero bytes are valid in a text in this encoding.
    #[must_use]
    pub fn has_zero_bytes(self, bytes: &[u8]) -> bool {
        let encoding = match (Encoding::for_bom(bytes), self) {
            (Some((encoding, _)), _) | (None, Self::Named(encoding)) => Some(encoding),
            (None, Self::Guessed) => utf_16(bytes),
        };
        encoding.is_some_and(|encoding| encoding == UTF_16LE || encoding == UTF_16BE)
    }
}

fn guess(bytes: &[u8]) -> Result<Decoded<'_>, NotInEncoding> {
    if let Some(encoding) = utf_16(bytes) {
        return strict(encoding, bytes);
    }
    if let Ok(decoded) = strict(UTF_8, bytes) {
        return Ok(decoded);
    }
    let (text, _) = WINDOWS_1252.decode_without_bom_handling(bytes);
    Ok(Decoded {
        text,
        guessed: Some("windows-1252"),
    })
}

/// Recognises UTF-16 without a byte-order mark: in numbers every second byte is zero.
fn utf_16(bytes: &[u8]) -> Option<&'static Encoding> {
    let start = bytes.get(..bytes.len().min(512)).unwrap_or_default();
    let zeros = |odd: usize| {
        start
            .iter()
            .skip(odd)
            .step_by(2)
            .filter(|&&b| b == 0)
            .count()
    };
    let (even, odd) = (zeros(0), zeros(1));
    // Some characters such as µ or a dash may have no zero byte; other encodings have none at all.
    match start.len() / 2 {
        0 | 1 => None,
        half if odd * 10 >= half * 9 && even == 0 => Some(UTF_16LE),
        half if even * 10 >= half * 9 && odd == 0 => Some(UTF_16BE),
        _ => None,
    }
}

fn strict(encoding: &'static Encoding, bytes: &[u8]) -> Result<Decoded<'static>, NotInEncoding> {
    let decoded = encoding.decode_without_bom_handling_and_without_replacement(bytes);
    let text = decoded.ok_or_else(|| {
        let (text, _) = encoding.decode_without_bom_handling(bytes);
        let before = text.split('\u{fffd}').next().unwrap_or_default();
        NotInEncoding {
            encoding: encoding.name().to_lowercase(),
            line: 1 + before.matches('\n').count(),
        }
    })?;
    Ok(Decoded {
        text: Cow::Owned(text.into_owned()),
        guessed: None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decoded(name: &str, bytes: &[u8]) -> Result<(String, bool), NotInEncoding> {
        let decoded = TextEncoding::named(name).unwrap().decode(bytes)?;
        Ok((decoded.text.into_owned(), decoded.guessed.is_some()))
    }

    #[test]
    fn a_micro_sign_is_read_in_every_encoding() {
        let want = |guessed| Ok(("F (µN)\n1".to_owned(), guessed));
        assert_eq!(decoded("latin-1", b"F (\xb5N)\n1"), want(false));
        assert_eq!(decoded("windows-1252", b"F (\xb5N)\n1"), want(false));
        assert_eq!(decoded("auto", b"F (\xb5N)\n1"), want(true));
        assert_eq!(decoded("auto", "F (µN)\n1".as_bytes()), want(false));
        assert_eq!(decoded("auto", "\u{feff}F (µN)\n1".as_bytes()), want(false));
        let utf_16: Vec<u8> = "F (µN)\n1"
            .encode_utf16()
            .flat_map(u16::to_le_bytes)
            .collect();
        assert_eq!(decoded("utf-16", &utf_16), want(false));
        assert_eq!(decoded("auto", &utf_16), want(false));
        assert!(TextEncoding::Guessed.has_zero_bytes(&utf_16));
        let utf_16: Vec<u8> = "\u{feff}F (µN)\n1"
            .encode_utf16()
            .flat_map(u16::to_be_bytes)
            .collect();
        assert_eq!(decoded("auto", &utf_16), want(false));
    }

    #[test]
    fn a_byte_of_another_encoding_is_refused_with_its_line() {
        let found = decoded("utf-8", b"a\nb\nF (\xb5N)\n1").unwrap_err();
        let (encoding, line) = ("utf-8".into(), 3);
        assert_eq!(found, NotInEncoding { encoding, line });
        assert_eq!(TextEncoding::named("latin-99"), None);
    }
}
