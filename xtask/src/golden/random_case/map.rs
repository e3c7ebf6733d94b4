//! Height maps in every format, and the keys that name them.

use std::io::Cursor;

use ndarray::Array2;
use ndarray_npy::WriteNpyExt;

use super::Scales;
use super::draw::Draw;

/// The side of a map: that of the cell, or far beyond the contact.
pub fn side(scales: Scales) -> f64 {
    match scales.side {
        Some(side) if scales.periodic => side,
        _ => 7.0 * scales.contact,
    }
}

/// Adds a map of the heights at points of the unit square, and the keys of the table `name` that describe it.
pub fn draw(draw: &mut Draw, name: &str, scales: Scales, height: impl Fn([f64; 2]) -> f64) {
    let samples = 16 + draw.below(17);
    let is_oblong = !scales.periodic && draw.one_in(4);
    let shape = [samples, if is_oblong { samples + 8 } else { samples }];
    // Heights in the file are of order one hundred, in a unit that the case names.
    let unit = scales.depth() / 100.0;
    let centre = |index: usize, count: usize| (index as f64 + 0.5) / count as f64;
    let heights = Array2::from_shape_fn(shape, |(i, j)| {
        height([centre(i, shape[0]), centre(j, shape[1])]) / unit
    });
    let side = side(scales);
    let format = draw.pick(&["npy", "csv", "txt", "gsf"]);
    let bytes = match format {
        "npy" => npy(&heights),
        "csv" => rows(&heights, ",").into_bytes(),
        "txt" => rows(&heights, " ").into_bytes(),
        _ => gsf(&heights, side),
    };
    let file = format!("{name}.{format}");
    draw.maps.push((file.clone(), bytes.into()));
    draw.line(format!("file = \"{file}\""));
    let unit = draw.length(unit);
    draw.line(format!("height_unit = {unit}"));
    let text = draw.length(side);
    match format {
        "gsf" if draw.one_in(2) => {}
        _ if is_oblong => draw.line(format!("sides = [{text}, {text}]")),
        _ => draw.line(format!("side = {text}")),
    }
    draw.sometimes(3, "interpolation = \"linear\"");
}

/// A NumPy file, first index along x.
fn npy(heights: &Array2<f64>) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    let written = heights.write_npy(&mut bytes);
    debug_assert!(written.is_ok(), "memory takes any array");
    bytes.into_inner()
}

/// A line is a row of pixels along x, the first at the largest y.
fn rows(heights: &Array2<f64>, between: &str) -> String {
    let row = |j: usize| {
        let cells = heights.column(j);
        let cells: Vec<String> = cells.iter().map(|height| format!("{height:.6}")).collect();
        cells.join(between) + "\n"
    };
    (0..heights.ncols()).rev().map(row).collect()
}

/// Gwyddion Simple Field: a header padded to a multiple of four bytes, then rows in single precision from the top.
#[expect(
    clippy::cast_possible_truncation,
    reason = "the format has single precision"
)]
fn gsf(heights: &Array2<f64>, side: f64) -> Vec<u8> {
    let [x, y] = [heights.nrows(), heights.ncols()];
    let mut bytes = format!(
        "Gwyddion Simple Field 1.0\nXRes = {x}\nYRes = {y}\nXReal = {side:e}\nYReal = {:e}\n",
        side * y as f64 / x as f64
    )
    .into_bytes();
    let padding = 4 - bytes.len() % 4;
    bytes.extend(std::iter::repeat_n(0, padding));
    let pixels = (0..y).rev().flat_map(|j| heights.column(j).to_vec());
    bytes.extend(pixels.flat_map(|height| (height as f32).to_le_bytes()));
    bytes
}
