//! The text of a file that the user wrote: a case, a study or a fit.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;
use std::sync::Arc;

use crate::failure::Failure;
use crate::input::diagnosis::{Diagnosis, Fault};
use crate::input::span::{Source, Span};

/// The largest file that is read, bytes; a case file is far smaller.
const MAX_FILE_BYTES: u64 = 16 << 20;

/// The mark that some editors write at the beginning of UTF-8 text.
const BYTE_ORDER_MARK: char = '\u{feff}';

/// Reads the text of the file without a byte-order mark; the path becomes the name of the source.
///
/// # Errors
///
/// [`Failure::Unreadable`] if the file does not exist or cannot be read; [`Failure::Case`] if it is not UTF-8 text.
pub fn read(path: &Path) -> Result<Source, Failure> {
    let bytes = bytes(path).map_err(|cause| Failure::Unreadable {
        path: path.to_owned(),
        cause,
    })?;
    let name = path.display().to_string();
    match String::from_utf8(bytes) {
        Ok(text) => {
            let text = text.strip_prefix(BYTE_ORDER_MARK).unwrap_or(&text);
            Ok(Source::new(name, text.to_owned()))
        }
        Err(error) => Err(not_utf8(&name, &error).into()),
    }
}

/// The name of a file without its extension, for what is named after it: `case` of `case.toml`. A name of dots alone
/// would be that of a folder, so `..toml` keeps its extension.
#[must_use]
pub fn stem(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    if stem.chars().all(|character| character == '.') {
        path.file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into()
    } else {
        stem.into()
    }
}

fn bytes(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let file = File::open(path)?;
    let read = file.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes)?;
    if read as u64 > MAX_FILE_BYTES {
        let message = format!(
            "larger than {} MiB, too large for a case file",
            MAX_FILE_BYTES >> 20
        );
        return Err(io::Error::new(io::ErrorKind::FileTooLarge, message));
    }
    Ok(bytes)
}

fn not_utf8(name: &str, error: &std::string::FromUtf8Error) -> Diagnosis {
    let valid = error.utf8_error().valid_up_to();
    let byte = error.as_bytes().get(valid).copied().unwrap_or_default();
    // The diagnosis shows only the text before the byte.
    let before = String::from_utf8_lossy(&error.as_bytes()[..valid]).into_owned();
    let source = Arc::new(Source::new(name, before));
    let fault = Fault::Wrong {
        found: format!("the byte 0x{byte:02x}, which is not UTF-8"),
        wanted: "TOML in UTF-8".into(),
    };
    let diagnosis = Diagnosis::of_text(Span::new(&source, valid..valid), fault);
    match byte {
        0xff | 0xfe if valid == 0 => {
            diagnosis.with_help("the file looks like UTF-16: save it as UTF-8")
        }
        _ => diagnosis.with_help("save the file as UTF-8"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_stem_is_the_name_of_this_or_the_parent_folder() {
        let names = [
            "case.toml",
            "a/b.c.toml",
            "..toml",
            "...toml",
            "....toml",
            ".toml",
            "case",
            "..",
        ];
        let stems = names.map(|name| stem(Path::new(name)));
        assert_eq!(
            stems,
            [
                "case", "b.c", "..toml", "...toml", "....toml", ".toml", "case", ""
            ]
        );
    }
}
