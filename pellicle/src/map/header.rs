//! What the head of a text says about its map: the size, the unit of the heights, the mark of a missing one.
//!
//! Lines `Width: 8 um`, `Height: 3 um`, `Value units: nm` are those of Gwyddion, `ncols 64`, `cellsize 0.5`,
//! `nrows 32`, `NODATA_value -9999` those of ESRI; `pixel size = 0.5 um` stands in several others. Above points the
//! names of their columns may have [units](PointUnits).

use super::comma::ThreeDigits;
use super::counts::Counts;
use super::error::MapError;
use super::map_file::MapFile;
use super::point_units::PointUnits;
use crate::input::dimension::Dimension;
use crate::input::quantity;

/// Ratio of the sides of a pixel from which one of them is not a side: a square scan of a thousand samples on a line
/// has ten lines at least.
const LONGEST_PIXEL: f64 = 100.0;

/// Part by which a width may differ from its pixels, of which one more or less may be counted.
const SAME_SIZE: f64 = 0.05;

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
    /// Sides of a pixel in a unit that is not named.
    cell: [Option<f64>; 2],
    /// Sides of a pixel that the head gives one by one, m.
    pixels: [Option<f64>; 2],
    /// Numbers in a row, and rows.
    counts: Counts,
    /// What a comma before three digits is in its numbers, as far as the heights show it.
    comma: ThreeDigits,
    /// Unit of the heights.
    unit: Option<String>,
    /// The height that stands for a missing one.
    missing: Option<f64>,
    /// The units of the columns x, y, z.
    points: Option<PointUnits>,
}

impl MapHeader {
    /// The head above the heights of a text, empty.
    pub fn above(text: &str, head: usize) -> Self {
        Self {
            comma: ThreeDigits::beside(text, head),
            ..Self::default()
        }
    }

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
        let number = self.comma.with_point(value);
        let length = || match &number {
            Some(number) => Ok(quantity::parse(number, Dimension::Length).ok()),
            None => Err(MapError::header(
                "size",
                value,
                "one without a mark of thousands",
            )),
        };
        let bare = || number.as_ref().and_then(|number| number.parse().ok());
        match key.as_str() {
            "width" => self.width = self.width.or(length()?),
            "height" => self.height = self.height.or(length()?),
            "pixel size" => self.pixel = self.pixel.or(length()?),
            "cellsize" => match length()? {
                Some(pixel) => self.pixel = Some(pixel),
                None => self.cell = [Some(cell(value, bare())?); 2],
            },
            "dx" | "dy" => {
                let axis = usize::from(key == "dy");
                self.pixels[axis] = self.pixels[axis].or(length()?);
                self.cell[axis] = self.cell[axis].or(bare().filter(|cell| *cell > 0.0));
            }
            "nodata value" => self.missing = self.missing.or_else(bare),
            "value unit" | "z unit" | "height unit" | "data unit" if !value.is_empty() => {
                self.take_unit(value)?;
            }
            "scale" | "scale factor" | "height scale" | "zscale" | "multiplier" => {
                refuse_scale(value, bare())?;
            }
            _ => self.counts.read(&key, value)?,
        }
        Ok(())
    }

    /// Takes the unit of the heights.
    fn take_unit(&mut self, unit: &str) -> Result<(), MapError> {
        let length = |unit: &str| quantity::one(unit, Dimension::Length).ok();
        match &self.unit {
            Some(known) if known != unit && length(known) != length(unit) => {
                let found = format!("{known} and {unit}");
                Err(MapError::header("unit", &found, "one unit of the heights"))
            }
            _ => {
                self.unit = Some(unit.to_owned());
                Ok(())
            }
        }
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

    /// What it says of the numbers in a row and of the rows.
    pub fn counts(&self) -> &Counts {
        &self.counts
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
        self.counts.check(map)?;
        self.check_size(map)?;
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
            (None, None) => match self.pixels {
                [Some(x), Some(y)] => Some([x * along_x, y * along_y]),
                _ => self.pixel.map(of_pixels),
            },
        };
        map.may_be_cut = self.width.is_some() && self.height.is_some() && !self.counts.has_rows();
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
        if let [Some(x), Some(y)] = self.cell {
            map.sides = map.sides.or(Some([x * along_x, y * along_y]));
        }
        map.height_unit = map.height_unit.take().or(self.unit);
        if let Some(missing) = self.missing {
            let is_missing = |height: &&mut f64| (**height - missing).abs() <= 0.0;
            let marked = map.heights.iter_mut().filter(is_missing);
            marked.for_each(|height| *height = f64::NAN);
        }
        Ok(())
    }

    /// Checks that the width agrees with the pixels of a map.
    fn check_size(&self, map: &MapFile) -> Result<(), MapError> {
        let [columns, lines] = map.shape;
        let pixel = self.pixels[0].or(self.pixel);
        if let (Some(width), Some(pixel)) = (self.width, pixel)
            && (width / pixel / columns as f64 - 1.0).abs() > SAME_SIZE
        {
            return Err(MapError::OtherShape {
                key: "width",
                said: format!("{width:e} m and pixel size {pixel:e} m"),
                columns,
                lines,
            });
        }
        Ok(())
    }
}

/// The key of a line in small letters and without plurals and hyphens, and its value.
fn entry(line: &str) -> Option<(String, &str)> {
    let line = line.trim_start_matches(['#', ' ', '\t']);
    let split = line.split_once([':', '=']);
    let (key, value) = split.or_else(|| line.split_once(char::is_whitespace))?;
    let key = key.trim().to_lowercase().replace(['_', '-'], " ");
    let key = match key.as_str() {
        "ncols" | "nrows" => key,
        _ => key.trim_end_matches('s').to_owned(),
    };
    Some((key, value.trim()))
}

/// Refuses a factor of the heights: whether it is in them already is not said.
fn refuse_scale(value: &str, scale: Option<f64>) -> Result<(), MapError> {
    match scale {
        Some(scale) if (scale - 1.0).abs() > 0.0 => Err(MapError::header(
            "scale factor of the heights",
            value,
            "heights multiplied by it, without the line",
        )),
        _ => Ok(()),
    }
}

fn cell(value: &str, cell: Option<f64>) -> Result<f64, MapError> {
    let cell = cell.filter(|cell: &f64| *cell > 0.0 && cell.is_finite());
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
        for (heights, side) in [("1.5 2.5", Some(1024e-6)), ("1,5;2,5", Some(1.024e-6))] {
            let mut header = MapHeader::above(heights, 0);
            header.read("Width: 1,024 um").unwrap();
            assert_eq!(header.width, side);
        }
        for integers in ["1 2", "1,2"] {
            let mut header = MapHeader::above(integers, 0);
            let message = header.read("Width: 1,024 um").unwrap_err().to_string();
            assert!(message.contains("mark of thousands"), "{message}");
        }
        assert_eq!(applied(&["Width: 1,024.5 um"]).sides, None);
        assert_eq!(applied(&["Width: 1,024,5 um"]).sides, None);
    }

    fn refused(lines: &[&str]) -> String {
        let mut header = MapHeader::default();
        let read = lines.iter().try_for_each(|line| header.read(line));
        let map = &mut MapFile::bare([4, 2], vec![1.0; 8]);
        read.and_then(|()| header.apply(map))
            .unwrap_err()
            .to_string()
    }

    #[test]
    fn what_contradicts_the_heights_or_itself_is_refused() {
        for (lines, said) in [
            (
                ["nx = 2", "ny = 4"],
                "2 lines of 4 numbers, though its head says columns 2",
            ),
            (
                ["x-pixels: 4", "y-pixels: 3"],
                "though its head says rows 3",
            ),
            (
                ["Width: 8 um", "Pixel size: 0.5 um"],
                "width 8e-6 m and pixel size 5e-7 m",
            ),
            (["Value units: nm", "z-unit: um"], "unit = nm and um"),
            (["Z unit: nm", "z-unit = V"], "unit = nm and V"),
        ] {
            let message = refused(&lines);
            assert!(message.contains(said), "{message}");
        }
        let map = applied(&["dx 0.125", "dy 0.25", "Height unit: um", "samples/line: 4"]);
        assert_eq!(
            (map.sides, map.height_unit.as_deref()),
            (Some([0.5, 0.5]), Some("um"))
        );
        assert_sides(&applied(&["dx=1 um", "dy=2 um"]), [4e-6, 4e-6]);
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
