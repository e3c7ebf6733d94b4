//! Binary files of instruments, told by their first bytes, and the tools that make tables of them.

use std::path::Path;

use super::error::CurveError;

/// First bytes, the kind of file, the tool.
const KINDS: [(&[u8], &str, &str); 8] = [
    (
        b"PK\x03\x04",
        "a ZIP archive (.xlsx, .jpk-force)",
        "in2csv of csvkit makes one of a spreadsheet, afmformats of a JPK file",
    ),
    (
        b"\x89HDF\r\n\x1a\n",
        "an HDF5 file",
        "h5dump makes one, afmformats of AFM curves, micromechanics of indentations",
    ),
    (
        b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1",
        "a spreadsheet of the old kind (.xls)",
        "in2csv of csvkit makes one",
    ),
    (
        b"TDSm",
        "a LabVIEW file (.tdms)",
        "tdmsinfo and npTDMS make one",
    ),
    (
        b"\xaf\xbe\xad\xde",
        "a Zwick file (.zs2)",
        "zs2decode makes one",
    ),
    (
        b"\\*Force file list",
        "a NanoScope file",
        "the package nanoscope makes one",
    ),
    (b"%PDF", "a PDF document", "export the measurement again"),
    (b"\x1f\x8b", "a file compressed by gzip", "gunzip makes one"),
];

/// Endings of the names of binary files whose first bytes tell less.
const ENDINGS: [(&str, &str, &str); 4] = [
    (
        "ibw",
        "an Igor file (.ibw)",
        "igor2 and afmformats make one",
    ),
    ("tdx", "a LabVIEW file (.tdx)", "tdm-loader makes one"),
    (
        "hap",
        "a FischerScope file (.hap)",
        "its own program exports one",
    ),
    ("hld", "a Hysitron file (.hld)", "micromechanics makes one"),
];

/// Refuses a file that is not text, by its first bytes, its ending or its zero bytes.
pub(super) fn refuse_binary(path: &Path, bytes: &[u8]) -> Result<(), CurveError> {
    let known = KINDS.iter().find(|(start, ..)| bytes.starts_with(start));
    if let Some((_, kind, tool)) = known {
        return Err(CurveError::Binary { kind, tool });
    }
    // Not one zero byte stands in a text other than UTF-16, which is looked for first.
    if !bytes.contains(&0) {
        return Ok(());
    }
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    let ending = ending.to_lowercase();
    let named = ENDINGS.iter().find(|(known, ..)| *known == ending);
    let (kind, tool) = named.map_or(
        ("a binary file", "the instrument's program exports one"),
        |(_, kind, tool)| (kind, tool),
    );
    Err(CurveError::Binary { kind, tool })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_binary_file_is_told_with_the_tool_that_makes_a_table_of_it() {
        let refused = |name: &str, bytes: &[u8]| {
            let error = refuse_binary(Path::new(name), bytes).unwrap_err();
            error.to_string()
        };
        let found = refused("a.jpk-force", b"PK\x03\x04\x14\x00");
        assert!(
            found.contains("ZIP") && found.contains("afmformats"),
            "{found}"
        );
        assert!(refused("a.h5", b"\x89HDF\r\n\x1a\n\x00").contains("HDF5"));
        assert!(refused("a.ibw", b"\x05\x00\x00\x00").contains("igor2"));
        assert!(refused("a.dat", b"1 2\x003").contains("a binary file"));
        assert_eq!(refuse_binary(Path::new("a.ibw"), b"1 2\n"), Ok(()));
    }
}
