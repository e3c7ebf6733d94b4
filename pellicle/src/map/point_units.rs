//! The units of points x, y, z in the line that names their columns: `x[um] y[um] z[nm]`, `x/um;y/um;z/nm`,
//! `X (um), Y (um), Height (nm)`, `x and y in um, z in nm`.

use super::map_file::MapFile;
use crate::input::dimension::Dimension;
use crate::input::quantity;

/// The units of three columns, as far as they are named.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PointUnits {
    /// Those of x and of y.
    lateral: Option<[String; 2]>,
    height: Option<String>,
    /// Whether the line names y before x.
    is_exchanged: bool,
    /// Whether it names the third column a depth.
    is_of_depths: bool,
}

/// Names of a column that counts downwards, in small letters.
const DEPTHS: [&str; 3] = ["depth", "tiefe", "profondeur"];

impl PointUnits {
    /// The units in a line that names columns x, y and a third one, or three units.
    pub fn in_line(line: &str) -> Option<Self> {
        let words: Vec<_> = line
            .split(|c: char| !c.is_alphanumeric())
            .filter(|word| !word.is_empty())
            .collect();
        let place = |name: &str| {
            words
                .iter()
                .position(|word| word.eq_ignore_ascii_case(name))
        };
        let places = place("x").zip(place("y"));
        let found = Self::of_brackets(line)
            .or_else(|| Self::of_units(&words))
            .or_else(|| Self::of_names(&words, places?))?;
        let is_depth = |word: &&str| DEPTHS.contains(&word.to_lowercase().as_str());
        Some(Self {
            is_exchanged: places.is_some_and(|(x, y)| y < x),
            is_of_depths: words.iter().any(is_depth),
            ..found
        })
    }

    /// Whether the columns are x, y, z in this order, as far as they are named.
    pub fn is_in_order(&self) -> bool {
        !self.is_exchanged
    }

    /// Whether it names a unit.
    pub fn has_units(&self) -> bool {
        self.lateral.is_some() || self.height.is_some()
    }

    /// `x[um] y[um] z[nm]`: three units in brackets. That of the heights may be no length, such as volts.
    fn of_brackets(line: &str) -> Option<Self> {
        let groups = line.split(['[', '(']).skip(1);
        let units = groups.filter_map(|group| group.split([']', ')']).next());
        Self::of_units(&units.map(str::trim).collect::<Vec<_>>())
    }

    /// `um um nm`
    fn of_units(units: &[&str]) -> Option<Self> {
        match units {
            [x, y, z] if is_length(x) && is_length(y) => Some(Self {
                lateral: Some([x, y].map(|unit| (*unit).to_owned())),
                height: Some((*z).to_owned()),
                ..Self::default()
            }),
            _ => None,
        }
    }

    /// `x and y in um, z in nm`, or names without units.
    fn of_names(words: &[&str], (x, y): (usize, usize)) -> Option<Self> {
        let (x, y) = (x.min(y), x.max(y));
        let of_x = words[x + 1..y].iter().find(|word| is_length(word));
        // `y um`, or `y in um`, where `in` is no inch.
        let after = words[y + 1..].iter().take_while(|word| is_length(word));
        let after = after.count();
        let of_y = words[y + 1..][..after].last();
        let (_name, third) = words[y + 1 + after..].split_first()?;
        let height = third.iter().rfind(|word| is_length(word));
        let owned = |word: &&str| (*word).to_owned();
        let lateral = of_x.or(of_y).zip(of_y.or(of_x));
        Some(Self {
            lateral: lateral.map(|(x, y)| [owned(x), owned(y)]),
            height: height.map(owned),
            ..Self::default()
        })
    }

    /// Gives a map of points these units; its sides are in that of x.
    pub fn apply(self, map: &mut MapFile) {
        if let Some([x, y]) = self.lateral {
            let metres = |unit: &str| quantity::one(unit, Dimension::Length).unwrap_or(1.0);
            let times = metres(&y) / metres(&x);
            map.sides = map.sides.map(|[x, y]| [x, y * times]);
            map.lateral_unit = Some(x);
        }
        map.height_unit = self.height;
        map.is_of_depths = self.is_of_depths;
    }
}

fn is_length(word: &str) -> bool {
    quantity::one(word, Dimension::Length).is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_units_of_columns_are_found_in_every_usual_line() {
        for (line, units) in [
            ("x[um] y[um] z[nm]", Some(("um um", "nm"))),
            (
                "# X (\u{b5}m), Y (\u{b5}m), Height (nm)",
                Some(("\u{b5}m \u{b5}m", "nm")),
            ),
            ("x/um;y/mm;z/nm", Some(("um mm", "nm"))),
            ("\"x_um\",\"y_um\",\"z_nm\"", Some(("um um", "nm"))),
            ("# x and y in um, z in nm", Some(("um um", "nm"))),
            ("X [m]\tY [m]\tPotential [V]", Some(("m m", "V"))),
            ("# x y z in m", Some(("", "m"))),
            ("x[um] y[um] z", Some(("um um", ""))),
            (
                "Position 1 (mm)\tPosition 2 (mm)\tDepth (um)",
                Some(("mm mm", "um")),
            ),
            ("um um nm", Some(("um um", "nm"))),
            ("(um);(um);(nm)", Some(("um um", "nm"))),
            ("x,y,z", Some(("", ""))),
            ("x y", None),
            ("# Height 3 um", None),
            ("ncols 3", None),
        ] {
            let found = PointUnits::in_line(line);
            let words = found.as_ref().map(|found| {
                let lateral = found.lateral.as_ref().map(|units| units.join(" "));
                let height = found.height.clone();
                (lateral.unwrap_or_default(), height.unwrap_or_default())
            });
            let words = words.as_ref().map(|(x, z)| (x.as_str(), z.as_str()));
            assert_eq!(words, units, "{line}");
            assert!(found.is_none_or(|found| found.is_in_order()), "{line}");
        }
        for line in ["y[um] x[um] z[nm]", "y x z"] {
            assert!(PointUnits::in_line(line).is_some_and(|found| !found.is_in_order()));
        }
    }
}
