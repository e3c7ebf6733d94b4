//! Faulty and unusual files of each format: refused with what is wrong and what is wanted, or read rightly.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use pellicle::Case;
use pellicle::input::span::Source;

const CASE: &str = r#"
[foundation]
substrate = { young_modulus = "70 GPa", poisson_ratio = 0.2 }
[surface]
kind = "rough"
file = "FILE"
KEYS
[indenter]
kind = "paraboloid"
radius = "1 um"
[load]
force = "1 uN"
"#;

/// What becomes of a file.
pub enum Outcome {
    /// Refused with this in the message.
    Refused(&'static str),
    /// Read with these samples along x and y, and this height, in the unit of the file, at the first and the last.
    Read([usize; 2], [f64; 2]),
}

use Outcome::{Read, Refused};

/// A fault, the bytes of the file, and what becomes of them.
type Row = (&'static str, Vec<u8>, Outcome);

/// Heights of the file are in nm on a side of 4 um, unless it says so itself.
pub fn hold(ending: &str, rows: Vec<Row>) {
    let folder = tempfile::tempdir().expect("a folder");
    let mut wrong = Vec::new();
    for (fault, bytes, outcome) in rows {
        let file = format!("map.{ending}");
        fs::write(folder.path().join(&file), bytes).expect("a file");
        let is_read = |keys: &str| read(folder.path(), &file, keys);
        // A file with a size of its own is read without the keys.
        let found = is_read("").or_else(|_| is_read("side = \"4 um\"\nheight_unit = \"nm\""));
        match (found, outcome) {
            (Ok(found), Read(shape, ends)) if is_same(&found, shape, ends) => {}
            (Err(told), Refused(words))
                if told.contains(words) && told.contains(&file) && told.contains("wanted") => {}
            (found, _) => wrong.push(format!("{ending}, {fault}: {found:?}")),
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Samples, and the first and the last height in nm.
type Found = ([usize; 2], [f64; 2]);

fn is_same(found: &Found, shape: [usize; 2], ends: [f64; 2]) -> bool {
    let pairs = found.1.iter().zip(ends);
    found.0 == shape
        && pairs
            .into_iter()
            .all(|(one, other)| (one - other).abs() < 1e-6)
}

fn read(folder: &Path, file: &str, keys: &str) -> Result<Found, String> {
    let text = CASE.replace("FILE", file).replace("KEYS", keys);
    let source = Arc::new(Source::new("case.toml", text));
    let case = Case::parse(&source, "case", folder, &[]).map_err(|told| told.to_string())?;
    let map = case.surface.map().expect("a map");
    let samples = map.samples();
    let ends = [samples[0], samples[samples.len() - 1]];
    Ok((map.shape(), ends.map(|height| height * 1e9)))
}

/// An array in a NumPy file, with this text of its type, shape and order.
fn npy(kind: &str, shape: &str, order: &str, data: &[u8]) -> Vec<u8> {
    let mut header = format!("{{'descr': '{kind}', 'fortran_order': {order}, 'shape': {shape}, }}");
    while !(header.len() + 11).is_multiple_of(64) {
        header.push(' ');
    }
    header.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend(
        u16::try_from(header.len())
            .expect("a short header")
            .to_le_bytes(),
    );
    bytes.extend(header.bytes());
    bytes.extend(data);
    bytes
}

fn doubles(numbers: &[f64]) -> Vec<u8> {
    numbers
        .iter()
        .flat_map(|number| number.to_le_bytes())
        .collect()
}

#[test]
fn numpy_arrays() {
    let six = doubles(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    let short = [1_i16, -2, 3, 4, 5, 6].map(i16::to_be_bytes).concat();
    let hole = doubles(&[1.0, f64::NAN, 3.0, 4.0, 5.0, 6.0]);
    let endless = doubles(&[1.0, f64::INFINITY, 3.0, 4.0, 5.0, 6.0]);
    let text = b"1 2 3\n4 5 6\n".to_vec();
    hold(
        "npy",
        vec![
            (
                "data cut off",
                npy("<f8", "(2, 3)", "False", &six[..40]),
                Refused("40 bytes follow"),
            ),
            (
                "more data than the shape",
                npy("<f8", "(2, 2)", "False", &six),
                Refused("48 bytes follow"),
            ),
            (
                "one dimension",
                npy("<f8", "(6,)", "False", &six),
                Refused("1 dimensions"),
            ),
            (
                "three dimensions",
                npy("<f8", "(1, 2, 3)", "False", &six),
                Refused("3 dimensions"),
            ),
            (
                "complex numbers",
                npy("<c16", "(1, 3)", "False", &six),
                Refused("\"<c16\""),
            ),
            (
                "objects",
                npy("|O", "(2, 3)", "False", &six),
                Refused("\"|O\""),
            ),
            (
                "no numbers",
                npy("<f8", "(0, 3)", "False", &[]),
                Refused("no numbers"),
            ),
            (
                "a hole",
                npy("<f8", "(2, 3)", "False", &hole),
                Refused("holes = \"interpolate\""),
            ),
            (
                "an infinity",
                npy("<f8", "(2, 3)", "False", &endless),
                Refused("missing or infinite"),
            ),
            ("text named .npy", text, Refused("NumPy array")),
            (
                "a shape of words",
                npy("<f8", "('a', 3)", "False", &six),
                Refused("NumPy array"),
            ),
            (
                "the other order",
                npy("<f8", "(2, 3)", "True", &six),
                Read([2, 3], [1.0, 6.0]),
            ),
            (
                "big-endian integers",
                npy(">i2", "(2, 3)", "False", &short),
                Read([2, 3], [1.0, 6.0]),
            ),
        ],
    );
}

/// A field with these lines and numbers.
fn gsf(lines: &str, numbers: &[f32]) -> Vec<u8> {
    let mut bytes = format!("Gwyddion Simple Field 1.0\n{lines}").into_bytes();
    bytes.resize((bytes.len() / 4 + 1) * 4, 0);
    bytes.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
    bytes
}

#[test]
fn gwyddion_simple_fields() {
    const SIZE: &str = "XReal = 4e-6\nYReal = 6e-6\nXYUnits = m\nZUnits = nm\n";
    let six = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0_f32];
    let sized = |lines: &str| gsf(&format!("{lines}{SIZE}"), &six);
    let hole = [1.0, f32::NAN, 3.0, 4.0, 5.0, 6.0];
    let mut binary = sized("XRes = 2\nYRes = 3\n");
    binary[30] = 0xff;
    hold(
        "gsf",
        vec![
            (
                "another format",
                b"GWYP 1.0\n".to_vec(),
                Refused("Gwyddion Simple Field 1.0"),
            ),
            (
                "a header without end",
                b"Gwyddion Simple Field 1.0\nXRes = 2\n".to_vec(),
                Refused("Gwyddion Simple Field"),
            ),
            ("no width", sized("YRes = 3\n"), Refused("XRes = nothing")),
            (
                "a width of 0",
                sized("XRes = 0\nYRes = 3\n"),
                Refused("XRes = 0"),
            ),
            (
                "a width in words",
                sized("XRes = two\nYRes = 3\n"),
                Refused("XRes = two"),
            ),
            (
                "data cut off",
                sized("XRes = 2\nYRes = 4\n"),
                Refused("24 bytes of data, but its header says 32"),
            ),
            (
                "more data than the size",
                sized("XRes = 2\nYRes = 2\n"),
                Refused("24 bytes of data, but its header says 16"),
            ),
            (
                "a negative side",
                gsf("XRes = 2\nYRes = 3\nXReal = -1\nYReal = 1\n", &six),
                Refused("XReal = -1"),
            ),
            (
                "volts",
                gsf(
                    "XRes = 2\nYRes = 3\nXReal = 4e-6\nYReal = 6e-6\nZUnits = V\n",
                    &six,
                ),
                Read([2, 3], [5.0, 2.0]),
            ),
            (
                "sides in seconds",
                gsf(
                    "XRes = 2\nYRes = 3\nXReal = 4\nYReal = 6\nXYUnits = s\nZUnits = nm\n",
                    &six,
                ),
                Refused("\"s\""),
            ),
            (
                "a hole",
                gsf(&format!("XRes = 2\nYRes = 3\n{SIZE}"), &hole),
                Refused("holes = \"interpolate\""),
            ),
            ("bytes in the header", binary, Refused("not text")),
            (
                "right",
                sized("XRes = 2\nYRes = 3\n"),
                Read([2, 3], [5.0, 2.0]),
            ),
        ],
    );
}
