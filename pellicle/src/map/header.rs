//! What the head of a text says about its map: the size, the unit of the heights, the mark of a missing one.
//!
//! Lines `Width: 8 um`, `Height: 3 um`, `Value units: nm` are those of Gwyddion, `ncols 64`, `cellsize 0.5`,
//! `nrows 32`, `NODATA_value -9999` those of ESRI; `pixel size = 0.5 um` stands in several others. Above points the
//! names of their columns may have [units](PointUnits).

use super::error::MapError;
use super::map_file::MapFile;
use super::point_units::PointUnits;
use crate::input::dimension::Dimension;
use crate::input::quantity;

/// Ratio of the sides of a pixel from which one of them is not a side: a square scan of a thousand samples on a line
/// has ten lines at least.
const LONGEST_PIXEL: f64 = 100.0;

const SIDE_ALONG_Y: &str = "the side along y: delete the line if it is the height of the surface";

/// The head of a text.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MapHeader {
    /// Side along x, m.
    width: Option<f64>,
    /// Side along y, m.
    height: Option<f64>,
    /// Side of a pixel, m.
    pixel: Option<f64>,
    /// Side of a pixel in a unit that is not named.
    cell: Option<f64>,
    /// Numbers in a row, and rows.
    counts: [Option<usize>; 2],
    /// Unit of the heights.
    unit: Option<String>,
    /// The height that stands for a missing one.
    missing: Option<f64>,
    /// The units of the columns x, y, z.
    points: Option<PointUnits>,
}

impl MapHeader {
    /// Reads a line of the head.
    ///
    /// # Errors
    ///
    /// [`MapError::Header`] for a count or a cell that is none.
    pub fn read(&mut self, line: &str) -> Result<(), MapError> {
        let points = PointUnits::in_line(line);
        let is_told = |points: &PointUnits| self.points.is_none() || points.has_units();
        self.points = points.filter(is_told).or(self.points.take());
        let Some((key, value)) = entry(line) else {
            return Ok(());
        };
        let number = with_point(value);
        let length = || quantity::parse(&number, Dimension::Length).ok();
        match key.as_str() {
            "width" => self.width = self.width.or_else(length),
            "height" => self.height = self.height.or_else(length),
            "pixel size" => self.pixel = self.pixel.or_else(length),
            "cellsize" if length().is_some() => self.pixel = length(),
            "cellsize" => self.cell = Some(cell(&number)?),
            "ncols" => self.counts[0] = Some(count("ncols", value)?),
            "nrows" => self.counts[1] = Some(count("nrows", value)?),
            "nodata_value" => {
                self.missing = self.missing.or_else(|| number.parse().ok());
            }
            "value units" | "z units" if !value.is_empty() => self.unit = Some(value.to_owned()),
            _ => {}
        }
        Ok(())
    }

    /// Whether a line has a key of a head.
    pub fn has_key(line: &str) -> bool {
        const KEYS: [&str; 7] = [
            "channel",
            "width",
            "height",
            "pixel size",
            "cellsize",
            "ncols",
            "nrows",
        ];
        entry(line).is_some_and(|(key, _)| KEYS.contains(&key.as_str()))
    }

    /// Numbers in a row of the picture: those of each line, or as the head says, however the lines are wrapped.
    ///
    /// # Errors
    ///
    /// [`MapError::Count`] if there are not as many numbers as the head says.
    pub fn columns(&self, of_lines: usize, numbers: usize) -> Result<usize, MapError> {
        let said = match self.counts {
            _ if numbers == 0 => return Err(MapError::Empty),
            [Some(columns), Some(rows)] => columns.checked_mul(rows),
            [Some(columns), None] => Some(numbers).filter(|all| all.is_multiple_of(columns)),
            [None, Some(rows)] => of_lines.checked_mul(rows),
            [None, None] => return Ok(of_lines),
        };
        if said == Some(numbers) {
            return Ok(self.counts[0].unwrap_or(of_lines));
        }
        let words = |count: Option<usize>| count.map(|count| count.to_string());
        let [columns, rows] = self.counts.map(words);
        let (key, said) = match (columns, rows) {
            (Some(columns), None) => ("ncols", columns),
            (None, rows) => ("nrows", rows.unwrap_or_default()),
            (Some(columns), Some(rows)) => ("ncols", format!("{columns} times nrows {rows}")),
        };
        Err(MapError::Count {
            key,
            said,
            found: numbers,
        })
    }

    /// Whether the head says how many numbers a row has.
    pub fn has_columns(&self) -> bool {
        self.counts[0].is_some()
    }

    /// Whether the head names columns x, y and z.
    ///
    /// # Errors
    ///
    /// [`MapError::Header`] if it names y before x, as which the map would be mirrored.
    pub fn names_points(&self) -> Result<bool, MapError> {
        match &self.points {
            Some(points) if !points.is_in_order() => {
                let found = "y before x";
                Err(MapError::header("columns", found, "x, y, z in this order"))
            }
            points => Ok(points.is_some()),
        }
    }

    /// Gives a map the size and unit of the head, and marks the heights that are missing.
    ///
    /// # Errors
    ///
    /// [`MapError::Header`] for a `Height` that is that of the surface and no side.
    pub fn apply(self, map: &mut MapFile) -> Result<(), MapError> {
        if map.has_one_unit
            && let Some(units) = self.points
        {
            units.apply(map);
        }
        let [along_x, along_y] = map.shape.map(|samples| samples as f64);
        let of_pixels = |pixel: f64| [pixel * along_x, pixel * along_y];
        // One side alone means square pixels.
        let sides = match (self.width, self.height) {
            (Some(x), Some(y)) => Some([x, y]),
            (Some(x), None) => Some(of_pixels(x / along_x)),
            (None, Some(y)) => Some(of_pixels(y / along_y)),
            (None, None) => self.pixel.map(of_pixels),
        };
        if let (Some([x, y]), Some(height)) = (sides, self.height) {
            let [x, y] = [x / along_x, y / along_y];
            if x.max(y) > LONGEST_PIXEL * x.min(y) {
                let found = format!("{height:e} m");
                return Err(MapError::header("Height", &found, SIDE_ALONG_Y));
            }
        }
        if let Some(sides) = sides.filter(|_| map.sides.is_none()) {
            map.sides = Some(sides);
            map.lateral_unit = Some("m".into());
        }
        map.sides = map.sides.or_else(|| self.cell.map(of_pixels));
        map.height_unit = map.height_unit.take().or(self.unit);
        if let Some(missing) = self.missing {
            let is_missing = |height: &&mut f64| (**height - missing).abs() <= 0.0;
            let marked = map.heights.iter_mut().filter(is_missing);
            marked.for_each(|height| *height = f64::NAN);
        }
        Ok(())
    }
}

/// The key of a line in small letters, and its value.
fn entry(line: &str) -> Option<(String, &str)> {
    let line = line.trim_start_matches(['#', ' ', '\t']);
    let split = line.split_once([':', '=']);
    let (key, value) = split.or_else(|| line.split_once(char::is_whitespace))?;
    Some((key.trim().to_lowercase(), value.trim()))
}

/// A value with a point in place of a decimal comma, `10,00 µm`.
fn with_point(value: &str) -> String {
    let ends_in_digit = |text: &str| text.ends_with(|c: char| c.is_ascii_digit());
    let begins_with_digit = |text: &str| text.starts_with(|c: char| c.is_ascii_digit());
    match value.split_once(',') {
        Some((whole, fraction))
            if ends_in_digit(whole)
                && begins_with_digit(fraction)
                && !value.contains('.')
                && !fraction.contains(',') =>
        {
            format!("{whole}.{fraction}")
        }
        _ => value.to_owned(),
    }
}

fn count(key: &'static str, value: &str) -> Result<usize, MapError> {
    let count = value.parse().ok().filter(|count| *count > 0);
    count.ok_or_else(|| MapError::header(key, value, "a positive number"))
}

fn cell(value: &str) -> Result<f64, MapError> {
    let is_length = |cell: &f64| *cell > 0.0 && cell.is_finite();
    let cell = value.parse().ok().filter(is_length);
    cell.ok_or_else(|| MapError::header("cellsize", value, "a positive length"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn applied(lines: &[&str]) -> MapFile {
        let mut header = MapHeader::default();
        lines.iter().try_for_each(|line| header.read(line)).unwrap();
        let mut map = MapFile::bare([4, 2], vec![1.0; 8]);
        header.apply(&mut map).unwrap();
        map
    }

    #[track_caller]
    fn assert_sides(map: &MapFile, wanted: [f64; 2]) {
        let sides = map.sides.unwrap();
        let near = |axis: usize| (sides[axis] / wanted[axis] - 1.0).abs() < 1e-12;
        assert!(near(0) && near(1), "{sides:?}");
    }

    #[test]
    fn sizes_and_units_are_those_of_the_head() {
        let map = applied(&[
            "# Width: 8.0 \u{b5}m",
            "# Height: 3.0 \u{3bc}m",
            "# Value units: nm",
        ]);
        assert_sides(&map, [8e-6, 3e-6]);
        let units = [map.lateral_unit.as_deref(), map.height_unit.as_deref()];
        assert_eq!(units, [Some("m"), Some("nm")]);
        assert_sides(&applied(&["Width: 4 um"]), [4e-6, 2e-6]);
        assert_sides(&applied(&["Width: 4 um", "Height: 50 um"]), [4e-6, 50e-6]);
        assert_sides(&applied(&["h=2 w=4", "pixel size=5e-7 m"]), [2e-6, 1e-6]);
        let map = applied(&["cellsize 94 nm"]);
        assert_sides(&map, [4.0 * 94e-9, 2.0 * 94e-9]);
        assert_eq!(map.lateral_unit.as_deref(), Some("m"));
        let map = applied(&["ncols 4", "nrows 2", "cellsize 0.5", "NODATA_value 1"]);
        assert_eq!((map.sides, map.lateral_unit), (Some([2.0, 1.0]), None));
        assert!(map.heights.iter().all(|height| height.is_nan()));
    }

    #[test]
    fn numbers_of_the_head_may_have_a_decimal_comma() {
        let lines = ["# Width: 10,00 \u{b5}m", "# Height: 4,5 \u{b5}m"];
        assert_sides(&applied(&lines), [10e-6, 4.5e-6]);
        let map = applied(&["ncols 4", "nrows 2", "cellsize 0,5", "NODATA_value 1,0"]);
        assert_eq!(map.sides, Some([2.0, 1.0]));
        assert!(map.heights.iter().all(|height| height.is_nan()));
        assert_eq!(applied(&["Width: 1,024.5 um"]).sides, None);
        assert_eq!(applied(&["Width: 1,024,5 um"]).sides, None);
    }

    #[test]
    fn the_height_of_the_surface_is_no_side() {
        let mut header = MapHeader::default();
        let lines = ["Width: 6 um", "Height: 22.7 nm"];
        lines.iter().try_for_each(|line| header.read(line)).unwrap();
        let map = &mut MapFile::bare([8, 8], vec![1.0; 64]);
        let refused = header.apply(map).unwrap_err().to_string();
        assert!(
            refused.contains("Height = 2.27e-8 m, not the side along y"),
            "{refused}"
        );
    }
}
