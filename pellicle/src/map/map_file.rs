//! A height map as stored in its file.

/// The contents of a map's file, in the units of the file.
#[derive(Debug, Clone, PartialEq)]
pub struct MapFile {
    /// Samples along x and along y.
    pub shape: [usize; 2],
    /// Height of sample `(i, j)` at `i * shape[1] + j`, in units of `height_unit`.
    pub heights: Vec<f64>,
    /// Sides along x and along y, in units of `lateral_unit`; none if the file does not give them.
    pub sides: Option<[f64; 2]>,
    /// Unit of the sides; none if the file names none.
    pub lateral_unit: Option<String>,
    /// Unit of the heights; none if the file names none.
    pub height_unit: Option<String>,
    /// Whether the sides are in the unit of the heights unless a unit is named, as for points x, y, z.
    pub has_one_unit: bool,
    /// Whether it has a size of its own along both sides, and may lack lines that were not measured.
    pub may_be_cut: bool,
    /// Whether the file calls its heights depths.
    pub is_of_depths: bool,
    /// Points x, y, z that are missing on their grid; their heights are NaN, as are those that the file marks as bad.
    pub missing_points: usize,
    /// The largest distance of a point from its place on the grid along x or y, in spacings.
    pub off_grid: f64,
}

impl MapFile {
    /// Creates a map without size and units from the values of an array, first index along x.
    pub(super) fn bare(shape: [usize; 2], heights: Vec<f64>) -> Self {
        Self {
            shape,
            heights,
            sides: None,
            lateral_unit: None,
            height_unit: None,
            has_one_unit: false,
            may_be_cut: false,
            is_of_depths: false,
            missing_points: 0,
            off_grid: 0.0,
        }
    }

    /// Creates such a map from a picture, `columns` values per row, rows from the top down.
    pub(super) fn from_picture(columns: usize, picture: &[f64]) -> Self {
        let rows = picture.len() / columns;
        let column = |i: usize| (0..rows).rev().map(move |row| picture[row * columns + i]);
        Self::bare([columns, rows], (0..columns).flat_map(column).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_top_left_pixel_of_an_image_has_small_x_and_large_y() {
        let map = MapFile::from_picture(3, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        assert_eq!(map.shape, [3, 2]);
        assert_eq!(map.heights, [4.0, 1.0, 5.0, 2.0, 6.0, 3.0]);
    }
}
