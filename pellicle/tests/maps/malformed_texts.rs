//! Ten malformed variants and more of the text formats of maps: refused with the remedy or read rightly.

use super::malformed::Outcome::{Read, Refused};
use super::malformed::hold;

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
