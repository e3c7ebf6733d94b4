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
enum Outcome {
    /// Refused with this in the message.
    Refused(&'static str),
    /// Read with these samples along x and y, and this height, in the unit of the file, at the first and the last.
    Read([usize; 2], [f64; 2]),
}

use Outcome::{Read, Refused};

/// A fault, the bytes of the file, and what becomes of them.
type Row = (&'static str, Vec<u8>, Outcome);

/// Heights of the file are in nm on a side of 4 um, unless it says so itself.
fn hold(ending: &str, rows: Vec<Row>) {
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

#[test]
fn text_and_points() {
    let text = |text: &str| text.as_bytes().to_vec();
    // Thirty points, x first: z = 1, 2, … 30.
    let line = |k: u32| format!("{} {} {}\n", k % 6, k / 6, k + 1);
    let points: String = (0..30).map(line).collect();
    let reversed: String = (0..30).rev().map(line).collect();
    // Ten lines of four heights after the number of each.
    let numbered = |k: u32| format!("{k} 3 {} {} 2\n", k * k % 7, k * 3 % 5);
    let numbered: String = (0..10).map(numbered).collect();
    hold(
        "txt",
        vec![
            (
                "a short line",
                text("1 2 3 4\n5 6 7\n"),
                Refused("line 2 holds 3 numbers"),
            ),
            (
                "a word",
                text("1 2 3 4\n5 6 x 8\n"),
                Refused("line 2 holds \"x\""),
            ),
            ("nothing", text(""), Refused("no numbers")),
            (
                "a head alone",
                text("# Height\nnothing here\n"),
                Refused("no numbers"),
            ),
            ("one column", text("1\n2\n3\n4\n"), Refused("one column")),
            (
                "two columns",
                text(&"1 2\n3 4\n".repeat(5)),
                Refused("two columns"),
            ),
            (
                "decimal commas or two numbers",
                text("1,2\n3,4\n5,6\n"),
                Refused("may be one number or two"),
            ),
            (
                "thousands",
                text("1,234.5 2\n3 4\n"),
                Refused("\"1,234.5\""),
            ),
            (
                "hexadecimal",
                text("0x1 2 3 4\n5 6 7 8\n"),
                Refused("\"0x1\""),
            ),
            (
                "a hole",
                text("1 NaN 3 4\n5 6 7 8\n"),
                Refused("holes = \"interpolate\""),
            ),
            (
                "points on no grid",
                text(&points.replace("5 4 30", "9 7 30")),
                Refused("no rectangular grid"),
            ),
            (
                "a point twice",
                text(&points.replace("5 4 30", "4 4 30")),
                Refused("no rectangular grid"),
            ),
            (
                "columns named in another order",
                text(&format!("y[nm] x[nm] z[nm]\n{points}")),
                Refused("columns = y before x"),
            ),
            (
                "points with a fourth column",
                text(&points.replace('\n', " 0.5\n")),
                Refused("4 columns hold the points x, y, z"),
            ),
            (
                "numbers of lines",
                text(&numbered),
                Refused("first column rises or falls in equal steps"),
            ),
            (
                "the height of the surface for a side",
                text("Width: 4 um\nHeight: 9 nm\n1 2 3 4\n5 6 7 8\n"),
                Refused("Height = 9e-9 m"),
            ),
            ("points", text(&points), Read([6, 5], [1.0, 30.0])),
            (
                "points from the end",
                text(&reversed),
                Read([6, 5], [1.0, 30.0]),
            ),
            (
                "a semicolon at each end",
                text("1;2;3;4;\n5;6;7;8;\n"),
                Read([4, 2], [5.0, 4.0]),
            ),
            ("null bytes", b"1 2\x00 3\n".to_vec(), Refused("line 1")),
        ],
    );
}

#[test]
fn texts_of_doubtful_form() {
    let text = |text: &str| text.as_bytes().to_vec();
    hold(
        "txt",
        vec![
            (
                "another map",
                text("1 2 3 4\n5 6 7 8\n\n1 2 3 4\n5 6 7 9\n"),
                Refused("line 4 begins a second map"),
            ),
            (
                "decimal commas among commas",
                text("1,89,-2,03,0,50,1,07\n1,89,2,03,0,50,1,01\n"),
                Refused("may be one number or two"),
            ),
            (
                "counts exchanged",
                text("ncols 2\nnrows 4\n1 2 3 4\n5 6 7 8\n"),
                Refused("exchange the two"),
            ),
            (
                "numbers in quotation marks",
                text("\"1,0\",\"2\",\"3\",\"4\"\n\"5\",\"6\",\"7\",\"8\"\n"),
                Read([4, 2], [5.0, 4.0]),
            ),
        ],
    );
}

#[test]
fn esri_grids() {
    let text = |text: &str| text.as_bytes().to_vec();
    let grid = |head: &str, data: &str| text(&format!("{head}xllcorner 0\nyllcorner 0\n{data}"));
    let data = "1 2 3 4\n5 6 7 8\n";
    let sized = "ncols 4\nnrows 2\ncellsize 1e-6\n";
    hold(
        "asc",
        vec![
            (
                "a column missing",
                grid("ncols 5\nnrows 2\ncellsize 1e-6\n", data),
                Refused("ncols 5"),
            ),
            (
                "a row missing",
                grid("ncols 4\nnrows 3\ncellsize 1e-6\n", data),
                Refused("nrows 3"),
            ),
            (
                "a row too many",
                grid("ncols 4\nnrows 1\ncellsize 1e-6\n", data),
                Refused("nrows 1"),
            ),
            (
                "a number of columns in words",
                grid("ncols four\nnrows 2\n", data),
                Refused("ncols"),
            ),
            (
                "half a column",
                grid("ncols 4.5\nnrows 2\n", data),
                Refused("ncols"),
            ),
            (
                "a cell of no size",
                grid("ncols 4\nnrows 2\ncellsize 0\n", data),
                Refused("cellsize"),
            ),
            (
                "a negative cell",
                grid("ncols 4\nnrows 2\ncellsize -1\n", data),
                Refused("cellsize"),
            ),
            (
                "a cell in words",
                grid("ncols 4\nnrows 2\ncellsize one\n", data),
                Refused("cellsize"),
            ),
            (
                "a height that is missing",
                grid(
                    &format!("{sized}NODATA_value -9999\n"),
                    "1 2 -9999.0 4\n5 6 7 8\n",
                ),
                Refused("holes = \"interpolate\""),
            ),
            (
                "a short line",
                grid(sized, "1 2 3 4\n5 6 7\n"),
                Refused("holds 7 numbers"),
            ),
            (
                "all in one line",
                grid(sized, "1e-9 2e-9 3e-9 4e-9 5e-9 6e-9 7e-9 8e-9\n"),
                Read([4, 2], [5.0, 4.0]),
            ),
            (
                "wrapped lines",
                grid(sized, "1e-9 2e-9 3e-9\n4e-9 5e-9 6e-9\n7e-9 8e-9\n"),
                Read([4, 2], [5.0, 4.0]),
            ),
            (
                "capital letters",
                grid(
                    "NCOLS 4\nNROWS 2\nCELLSIZE 1e-6\n",
                    "1e-9 2e-9 3e-9 4e-9\n5e-9 6e-9 7e-9 8e-9\n",
                ),
                Read([4, 2], [5.0, 4.0]),
            ),
        ],
    );
}
