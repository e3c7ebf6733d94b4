//! A height map named by a case: `file`, and keys for properties that the file does not give.
//!
//! `side` is its length along x, with square pixels; `sides` are its lengths along x and y. A file may contain its
//! sides, which they must not contradict; without a unit there, `lateral_unit` or `side` gives it. `height_unit` is the
//! length that a value of 1 in the file stands for: `"nm"`, `"0.5 um"` or a bare number, negative to turn heights into
//! depths. Without it, heights are in the unit that the file names, or in metres, or in the case's own unit of length.
//! `interpolation` sets how heights between the samples are found.

pub mod hole_code;
mod holes;
pub mod preparation;
mod repetition;
mod scale;

use std::sync::Arc;

use pellicle_texture::{HeightMap, Interpolation};
use serde::Serialize;

use self::hole_code::HoleCode;
pub use self::holes::HolesCase;
use self::holes::{HOLES, without_holes};
use self::preparation::{EDGES, EdgesCase, LEVELS, LevelCase, is_default, prepared};
pub use self::repetition::Repetition;
use self::repetition::with_rim;
use self::scale::{MapSides, MapUnits, names_a_unit, sides, units};
use super::map_sources::MapSources;
use crate::declare::macros::record;
use crate::declare::{Codec, Record, Scope, Shape, TableShape, length, pair, text, word};
use crate::input::diagnosis::Diagnosis;
use crate::input::dimension::Dimension;
use crate::input::quantity;
use crate::input::table_reader::TableReader;
use crate::input::toml_tree::TomlValue;
use crate::input::units::Units;
use crate::input::value_reader::ValueReader;

const FILE: &str =
    "a height map (.npy, .csv, .txt, .asc or .gsf) by its path from the folder of the case file";

const LENGTHS: &str = "a list of two positive lengths, [x, y]";

const HEIGHT_UNIT: &str =
    "the length of a 1 in the file, such as \"nm\" or \"0.5 um\", or a bare number other than 0";

/// A height map of a case. It is written as the keys from which it was read; the heights stay in the file.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MapCase {
    /// Path of the file, from the folder of the case.
    pub file: String,
    /// Sides along x and along y, m.
    pub sides: [f64; 2],
    /// The length that a value of 1 in the file stands for, m.
    pub height_unit: f64,
    /// The interpolation between the samples.
    pub interpolation: InterpolationCase,
    /// What is done where heights are missing.
    #[serde(skip_serializing_if = "HolesCase::is_refuse")]
    pub holes: HolesCase,
    /// What is done with its tilt.
    #[serde(skip_serializing_if = "is_default")]
    pub level: LevelCase,
    /// What is done where its opposite edges do not fit.
    #[serde(skip_serializing_if = "is_default")]
    pub edges: EdgesCase,
    /// Number of heights that were missing.
    #[serde(skip)]
    pub missing: usize,
    /// A value that may stand for missing heights, taken as it is.
    #[serde(skip)]
    pub perhaps_holes: Option<HoleCode>,
    /// The largest distance of a point of the file from its place on the grid along x or y, in spacings.
    #[serde(skip)]
    pub off_grid: f64,
    /// Whether the sides are those of a file that names no unit.
    #[serde(skip)]
    pub has_bare_sides: bool,
    /// Whether the sides are those of a file that may lack lines.
    #[serde(skip)]
    pub may_be_cut: bool,
    /// Whether the file calls its heights depths, and they are taken as heights.
    #[serde(skip)]
    pub has_upward_depths: bool,
    /// The units; SI if the file names one.
    #[serde(skip)]
    pub units: Units,
    #[serde(skip)]
    heights: Arc<HeightMap>,
    /// The repetition, if the map is periodic.
    #[serde(skip)]
    repeats: Option<Repetition>,
}

/// The interpolation between samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum InterpolationCase {
    /// Bicubic, smooth.
    Bicubic,
    /// Linear, with kinks along every line of samples.
    Linear,
}

const INTERPOLATIONS: &[(&str, InterpolationCase)] = &[
    ("bicubic", InterpolationCase::Bicubic),
    ("linear", InterpolationCase::Linear),
];

record! {
    /// The keys of a map, as far as each can be read by itself.
    struct MapKeys {
        file: String = text(FILE), "the heights: path of a .npy, .csv, .txt, .asc or .gsf file from the folder of the case";
        side: Option<f64> = length().positive().optional("that of the file"),
            "length of the map along x, its pixels being square";
        sides: Option<[f64; 2]> = pair(length().positive(), LENGTHS).optional("those of the file"),
            "lengths of the map along x and y";
        height_unit: Option<f64> = HeightUnit.optional("that of the file, or 1"),
            "length that a 1 in the file stands for; negative for depths";
        interpolation: InterpolationCase = word(INTERPOLATIONS).or(InterpolationCase::Bicubic, "\"bicubic\""),
            "heights between the samples";
        holes: HolesCase = word(HOLES).or(HolesCase::Refuse, "\"refuse\""),
            "where heights are missing, also by a code such as -9999: the map is refused, or each is the mean of its neighbours; or no number is a code";
        level: LevelCase = word(LEVELS).or(LevelCase::None, "\"none\""),
            "tilt of the map: its least-squares plane is subtracted, or it is solved as measured";
        edges: EdgesCase = word(EDGES).or(EdgesCase::AsMeasured, "\"as measured\""),
            "where opposite edges do not fit in a periodic cell: as they are, or half of the step is taken from either edge and fades inwards, each of its waves over a sixth of its length";
        lateral_unit: Option<f64> = HeightUnit.optional("that of the file, of the heights for points, or 1"),
            "length that a 1 along the surface stands for, of points x, y, z or of a size without a unit in the file";
    }
}

/// A length, or a unit alone.
#[derive(Debug, Clone, Copy)]
struct HeightUnit;

impl Codec for HeightUnit {
    type Out = f64;

    fn shape(&self) -> Shape {
        Shape::Either(vec![length().shape(), Shape::Text])
    }

    fn wanted(&self) -> String {
        HEIGHT_UNIT.into()
    }

    fn read(&self, value: &ValueReader<'_>, scope: &Scope<'_>) -> Result<f64, Diagnosis> {
        let alone = match value.value() {
            TomlValue::Text(text) => quantity::one(text, Dimension::Length).ok(),
            _ => None,
        };
        let length = alone.map_or_else(|| length().read(value, scope), Ok)?;
        if length == 0.0 {
            return Err(value.wanted(HEIGHT_UNIT));
        }
        value.in_range(Dimension::Length, length)
    }
}

impl Record for MapCase {
    fn shape() -> TableShape {
        MapKeys::shape()
    }

    fn read_part(table: &TableReader<'_>, scope: &Scope<'_>) -> Result<Self, Diagnosis> {
        let none = MapSources::default();
        Self::open(table, scope.maps.unwrap_or(&none), scope)
    }
}

impl From<InterpolationCase> for Interpolation {
    fn from(case: InterpolationCase) -> Self {
        match case {
            InterpolationCase::Bicubic => Self::Bicubic,
            InterpolationCase::Linear => Self::Linear,
        }
    }
}

impl MapCase {
    /// Opens the map that the keys name, and checks the heights.
    fn open(
        table: &TableReader<'_>,
        maps: &MapSources,
        scope: &Scope<'_>,
    ) -> Result<Self, Diagnosis> {
        let field = table.required("file", FILE)?;
        let name = field.text()?;
        let read = maps.read(name);
        let file = read.map_err(|error| field.unusable(&error, FILE))?;
        let keys = MapKeys::read_part(table, scope)?;
        let map_units = MapUnits::of(table, &field, &keys, &file)?;
        let height_unit = map_units.height;
        let MapSides { sides, are_bare } = sides(table, &keys, &file, map_units)?;
        let filled = without_holes(&field, &file, keys.holes)?;
        let heights = filled.heights.iter().map(|height| height * height_unit);
        let heights = HeightMap::new(heights.collect(), file.shape, sides);
        let heights = heights.map_err(|error| field.refused(&error))?;
        let heights = prepared(heights, keys.level, keys.edges);
        scope.limits.check(&heights).map_err(|too_steep| {
            let at_fault = table.optional("height_unit").unwrap_or(field);
            let has_unit =
                matches!(at_fault.value(), TomlValue::Text(_)) || names_a_unit(table, &file);
            let has_one_unit = file.has_one_unit && !map_units.has_lateral;
            let wanted = if has_one_unit && keys.sides.is_none() {
                scope.limits.wanted_of_points()
            } else {
                scope.limits.wanted(&heights, height_unit, has_unit)
            };
            at_fault.unusable(&too_steep, wanted)
        })?;
        Ok(Self {
            file: name.to_owned(),
            sides,
            height_unit,
            interpolation: keys.interpolation,
            holes: keys.holes,
            level: keys.level,
            edges: keys.edges,
            missing: filled.missing,
            perhaps_holes: filled.perhaps,
            off_grid: file.off_grid,
            has_bare_sides: are_bare,
            may_be_cut: file.may_be_cut && keys.side.is_none() && keys.sides.is_none(),
            has_upward_depths: file.is_of_depths && height_unit > 0.0,
            units: units(&file),
            heights: Arc::new(heights.with_interpolation(keys.interpolation.into())),
            repeats: None,
        })
    }

    /// Makes the map periodic: after its last samples come the first samples of its neighbour.
    pub fn repeat(&mut self, how: Repetition) {
        self.repeats = Some(how);
    }

    /// The map, with a rim of its neighbours' samples if it is periodic.
    #[must_use]
    pub fn heights(&self) -> HeightMap {
        let own = self.heights.as_ref();
        let rimmed = self.repeats.and_then(|how| with_rim(own, how).ok());
        rimmed.unwrap_or_else(|| own.clone())
    }

    /// The map without a rim.
    #[must_use]
    pub fn own(&self) -> &HeightMap {
        &self.heights
    }

    /// The samples, m, as [`HeightMap::heights`].
    #[must_use]
    pub fn samples(&self) -> &[f64] {
        self.heights.heights()
    }

    /// Samples along x and along y.
    #[must_use]
    pub fn shape(&self) -> [usize; 2] {
        self.heights.shape()
    }

    /// The longer side of a pixel, m.
    #[must_use]
    pub fn pixel(&self) -> f64 {
        let [x, y] = self.shape().map(|samples| samples as f64);
        (self.sides[0] / x).max(self.sides[1] / y)
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use tempfile::TempDir;

    use super::*;
    use crate::input::table_reader::tests::read_table;

    fn folder() -> TempDir {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("a.csv"), "1,2,3\n4,5,6\n").unwrap();
        let mut gsf = b"Gwyddion Simple Field 1.0\nXRes = 1\nYRes = 1\nXReal = 2\nYReal = 4\nXYUnits = um\nZUnits = V\n".to_vec();
        gsf.resize((gsf.len() / 4 + 1) * 4, 0);
        gsf.extend(7.0_f32.to_le_bytes());
        fs::write(folder.path().join("volts.gsf"), gsf).unwrap();
        let holes = "1 3 1 3\n3 Bad 3 1\n1 1 1 3\n1 3 3 3\n";
        fs::write(folder.path().join("holes.txt"), holes).unwrap();
        fs::write(
            folder.path().join("points.txt"),
            "0 0 50\n1 0 60\n0 2 70\n1 2 80\n",
        )
        .unwrap();
        folder
    }

    fn read(text: &str) -> Result<MapCase, String> {
        let folder = folder();
        read_table(text, |table| {
            let maps = MapSources::in_folder(folder.path());
            let scope = Scope {
                maps: Some(&maps),
                ..Scope::default()
            };
            MapCase::read_part(&table, &scope)
        })
    }

    #[test]
    fn a_single_side_means_square_pixels() {
        let map = read("file = \"a.csv\"\nside = \"3 um\"\nheight_unit = \"nm\"").unwrap();
        assert_eq!((map.shape(), map.sides), ([3, 2], [3e-6, 2e-6]));
        assert_eq!((map.height_unit, map.units), (1e-9, Units::Consistent));
        let heights = map.heights();
        // Each value has one rounding error.
        let [lowest, highest] = [heights.lowest() - 1e-9, heights.highest() - 6e-9];
        assert!(lowest.abs() < 1e-24 && highest.abs() < 1e-24);
    }

    #[test]
    fn a_unit_that_is_no_length_is_overridden_but_no_size() {
        let map = read("file = \"volts.gsf\"\nheight_unit = \"-0.5 um\"").unwrap();
        assert_eq!((map.sides, map.units), ([2e-6, 4e-6], Units::Si));
        assert_eq!(
            (map.height_unit, map.heights().lowest()),
            (-0.5e-6, -3.5e-6)
        );
        // A size is not.
        let wrong = read("file = \"volts.gsf\"\nheight_unit = 1\nsides = [1, 2]").unwrap_err();
        assert!(
            wrong.contains("key `sides`: found [1, 2], which contradicts the size 2"),
            "{wrong}"
        );
        let map = read("file = \"volts.gsf\"\nheight_unit = 1\nside = \"2 um\"").unwrap();
        assert_eq!(map.sides, [2e-6, 4e-6]);
    }

    #[test]
    fn missing_heights_are_refused_or_the_mean_of_their_neighbours() {
        let wrong = read("file = \"holes.txt\"\nside = 1").unwrap_err();
        assert!(
            wrong.contains("of whose 16 heights 1 are missing"),
            "{wrong}"
        );
        assert!(wrong.contains("holes = \"interpolate\""), "{wrong}");
        let map = read("file = \"holes.txt\"\nside = 100\nholes = \"interpolate\"").unwrap();
        assert_eq!(map.missing, 1);
        // Of eight neighbours, five are 1 and three are 3.
        assert!(
            map.samples()
                .iter()
                .any(|height| (height - 1.75).abs() < 1e-15)
        );
    }

    #[test]
    fn the_unit_of_points_along_the_surface_may_be_another() {
        let map =
            read("file = \"points.txt\"\nheight_unit = \"nm\"\nlateral_unit = \"um\"").unwrap();
        assert!(
            (map.sides[0] / 2e-6 - 1.0).abs() < 1e-12 && (map.sides[1] / 4e-6 - 1.0).abs() < 1e-12
        );
        let wrong = read("file = \"points.txt\"\nheight_unit = \"nm\"").unwrap_err();
        assert!(wrong.contains("lateral_unit = \"um\""), "{wrong}");
    }

    #[test]
    fn an_invalid_map_is_reported_with_key_file_found_and_wanted() {
        let message = |text: &str| read(text).unwrap_err();
        let found = message("file = \"b.csv\"\nside = 1");
        let start =
            "case.toml, line 1, key `file`: found \"b.csv\", which cannot be read: No such file";
        assert!(found.starts_with(start), "{found}");
        assert!(found.ends_with(&format!("wanted {FILE}")), "{found}");
        let found = message("file = \"a.csv\"");
        assert!(found.contains("key `side`: found no such key, wanted side, the length"));
        let found = message("file = \"volts.gsf\"");
        assert!(found.contains("found \"volts.gsf\", whose header has the height unit \"V\""));
        for text in [
            "file = 3",
            "file = \"a.csv\"\nside = 0",
            "file = \"a.csv\"\nside = 1\nsides = [1, 2]",
            "file = \"a.csv\"\nsides = [1]",
            "file = \"a.csv\"\nside = 1\nheight_unit = 0",
            "file = \"a.csv\"\nside = 1\nheight_unit = \"GPa\"",
            "file = \"a.csv\"\nside = 1\nheight_unit = nan",
        ] {
            assert!(read(text).is_err(), "{text}");
        }
    }
}
