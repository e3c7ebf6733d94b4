//! Binary files of instruments, recognised by their first bytes, and the tools that convert them to tables.

use std::path::Path;

use super::error::CurveError;

/// Extension, kind of file, tool. Extensions are more specific than the first bytes: many kinds are archives.
const ENDINGS: [(&str, &str, &str); 9] = [
    ("jpk-force", "a JPK file", "afmformats makes one"),
    ("ibw", "an Igor file", "igor2 or afmformats makes one"),
    ("xlsx", "a spreadsheet", "in2csv of csvkit makes one"),
    ("xls", "a spreadsheet", "in2csv of csvkit makes one"),
    ("zs2", "a Zwick file", "zs2decode makes one"),
    ("tdms", "a LabVIEW file", "npTDMS makes one"),
    ("tdx", "a LabVIEW file", "tdm-loader makes one"),
    ("hld", "a Hysitron file", "nanodent makes one"),
    ("hap", "a FischerScope file", "its own program exports one"),
];

/// First bytes, the kind of file, the tool.
const STARTS: [(&[u8], &str, &str); 7] = [
    (
        b"PK\x03\x04",
        "a ZIP archive",
        "in2csv of csvkit makes one of a spreadsheet (.xlsx), afmformats of a JPK file",
    ),
    (
        b"\x89HDF\r\n\x1a\n",
        "an HDF5 file",
        "h5dump or h5py makes one, afmformats of its own files",
    ),
    (
        b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1",
        "a spreadsheet of the old kind (.xls)",
        "in2csv of csvkit makes one",
    ),
    (b"TDSm", "a LabVIEW file (.tdms)", "npTDMS makes one"),
    (
        b"\\*Force file list",
        "a NanoScope file",
        "the package nanoscope makes one",
    ),
    (b"%PDF", "a PDF document", "export the measurement again"),
    (
        b"\x1f\x8b",
        "a compressed file",
        "gunzip makes one of a text, zs2decode of a Zwick file",
    ),
];

/// Rejects a file that is not text, recognised by its first bytes or by zero bytes.
pub(super) fn refuse_binary(path: &Path, bytes: &[u8]) -> Result<(), CurveError> {
    let by_start = STARTS.iter().find(|(start, ..)| bytes.starts_with(start));
    // Text has no zero bytes unless it is UTF-16, which is checked first.
    if by_start.is_none() && !bytes.contains(&0) {
        return Ok(());
    }
    let name = path.to_string_lossy().to_lowercase();
    let has_ending = |ending: &str| name.ends_with(&format!(".{ending}"));
    let by_name = ENDINGS.iter().find(|(ending, ..)| has_ending(ending));
    let by_name = by_name.map(|(_, kind, tool)| (*kind, *tool));
    let by_start = by_start.map(|(_, kind, tool)| (*kind, *tool));
    let unknown = ("a binary file", "the instrument's program exports one");
    let (kind, tool) = by_name.or(by_start).unwrap_or(unknown);
    Err(CurveError::Binary { kind, tool })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_binary_file_is_refused_naming_a_tool_that_converts_it() {
        let refused = |name: &str, bytes: &[u8]| {
            let error = refuse_binary(Path::new(name), bytes).unwrap_err();
            error.to_string()
        };
        let found = refused("a.zip", b"PK\x03\x04\x14\x00");
        assert!(
            found.contains("ZIP") && found.contains("afmformats"),
            "{found}"
        );
        assert!(refused("a.h5", b"\x89HDF\r\n\x1a\n\x00").contains("HDF5"));
        assert!(refused("a.ZS2", b"\x1f\x8b\x08").contains("Zwick"));
        assert!(refused("a.jpk-force", b"PK\x03\x04").contains("a JPK file"));
        assert!(refused("a.ibw", b"\x05\x00\x00\x00").contains("igor2"));
        assert!(refused("a.dat", b"1 2\x003").contains("a binary file"));
        assert_eq!(refuse_binary(Path::new("a.ibw"), b"1 2\n"), Ok(()));
    }
}
