//! Limits on the heights of a map: in the wrong unit, a map is at least a thousand times steeper than any surface.

use std::fmt;

use pellicle_texture::HeightMap;

/// The steepest map that is accepted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeightLimits {
    /// Largest root mean square slope.
    slope: f64,
    /// Largest range of the heights over the shorter side.
    range: f64,
}

/// The slope and range of a map that exceeds the limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TooSteep {
    slope: f64,
    range: f64,
    side: f64,
}

/// Usual units of heights, m.
const UNITS: [(&str, f64); 4] = [("mm", 1e-3), ("um", 1e-6), ("nm", 1e-9), ("pm", 1e-12)];

impl Default for HeightLimits {
    fn default() -> Self {
        Self::SURFACE
    }
}

impl HeightLimits {
    /// For a surface: an rms slope of 1 means 45 degrees everywhere, far beyond small strains.
    pub const SURFACE: Self = Self {
        slope: 1.0,
        range: 1.0,
    };

    /// For a tip: the faces of a cube corner have a slope of 1.4, a cone of half-angle 10 degrees has one of 5.7.
    pub const INDENTER: Self = Self {
        slope: 6.0,
        range: 6.0,
    };

    /// Checks the heights.
    ///
    /// # Errors
    ///
    /// [`TooSteep`] if the heights are too steep or their range is too large for the map's sides.
    pub fn check(self, map: &HeightMap) -> Result<(), TooSteep> {
        let too_steep = TooSteep {
            slope: rms_slope(map),
            range: range(map),
            side: map.extent().into_iter().fold(f64::INFINITY, f64::min),
        };
        if self.allows(too_steep, 1.0) {
            Ok(())
        } else {
            Err(too_steep)
        }
    }

    /// Whether heights `times` as large are within the limits.
    fn allows(self, found: TooSteep, times: f64) -> bool {
        found.slope * times <= self.slope && found.range * times <= self.range * found.side
    }

    /// Describes the limits for points x, y, z in one unit: another unit of the heights would not change the slope.
    #[must_use]
    pub fn wanted_of_points(self) -> String {
        format!(
            "{}: x, y and z are in this unit; lateral_unit = \"um\" or sides = [x, y] sets that of x and y",
            self.words()
        )
    }

    fn words(self) -> String {
        format!(
            "an rms slope of at most {} and a range of at most {} times the shorter side",
            self.slope, self.range
        )
    }

    /// Describes the limits, with the likely unit of the heights: the largest that brings them within the limits.
    #[must_use]
    pub fn wanted(self, map: &HeightMap, height_unit: f64, has_unit: bool) -> String {
        let most = self.words();
        let Err(found) = self.check(map) else {
            return most;
        };
        let fits = |(_, unit): &&(&str, f64)| self.allows(found, unit / height_unit.abs());
        let unit = UNITS.iter().find(fits).map(|(name, unit)| {
            if has_unit {
                format!("\"{name}\"")
            } else {
                format!("{unit:e}")
            }
        });
        let unit = unit.map(|unit| format!(", as with height_unit = {unit}"));
        format!("{most}{}", unit.unwrap_or_default())
    }
}

impl fmt::Display for TooSteep {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { slope, range, side } = self;
        write!(
            f,
            "which gives heights with an rms slope of {slope:.2e} and a range of {range:.2e} on a side of {side:.2e}"
        )
    }
}

fn range(map: &HeightMap) -> f64 {
    let heights = map.heights().iter().copied();
    let least = heights.clone().fold(f64::INFINITY, f64::min);
    heights.fold(f64::NEG_INFINITY, f64::max) - least
}

/// √⟨|∇z|²⟩ from the differences of neighbouring samples along both axes.
fn rms_slope(map: &HeightMap) -> f64 {
    let ([rows, columns], [along_x, along_y]) = (map.shape(), map.extent());
    let heights = map.heights();
    let mean_square = |pairs: &mut dyn Iterator<Item = f64>, step: f64| {
        let (sum, count) = pairs.fold((0.0, 0_usize), |(sum, count), difference| {
            (sum + (difference / step).powi(2), count + 1)
        });
        sum / count.max(1) as f64
    };
    let below = heights.iter().zip(heights.iter().skip(columns));
    let beside = heights.chunks_exact(columns).flat_map(|row| row.windows(2));
    let slope_x = mean_square(&mut below.map(|(a, b)| b - a), along_x / rows as f64);
    let slope_y = mean_square(
        &mut beside.map(|pair| pair[1] - pair[0]),
        along_y / columns as f64,
    );
    (slope_x + slope_y).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 20 × 20 samples over 20 µm of a wave of amplitude `height`.
    fn map(height: f64) -> HeightMap {
        let heights = (0..400_u32).map(|n| height * (f64::from(n % 20) / 3.0).sin());
        HeightMap::new(heights.collect(), [20, 20], [20e-6, 20e-6]).unwrap()
    }

    #[test]
    fn heights_in_nanometres_read_as_metres_are_recognised() {
        let wrong = map(50.0);
        let too_steep = HeightLimits::SURFACE.check(&wrong).unwrap_err().to_string();
        assert!(too_steep.contains("an rms slope of 1.1"), "{too_steep}");
        let wanted = |has_unit| HeightLimits::SURFACE.wanted(&wrong, 1.0, has_unit);
        assert!(
            wanted(true).ends_with("as with height_unit = \"nm\""),
            "{}",
            wanted(true)
        );
        assert!(wanted(false).ends_with("as with height_unit = 1e-9"));
        // Given in micrometres, meant in nanometres.
        assert!(
            HeightLimits::SURFACE
                .wanted(&map(50e-6), 1e-6, true)
                .ends_with("\"nm\"")
        );
    }

    #[test]
    fn surfaces_and_tips_at_the_slope_limit_are_accepted() {
        // A slope of 0.24.
        assert_eq!(HeightLimits::SURFACE.check(&map(1e-6)), Ok(()));
        let cube_corner = (0..400_u32).map(|n| 1.42e-6 * f64::from(n / 20));
        let map = HeightMap::new(cube_corner.collect(), [20, 20], [20e-6, 20e-6]).unwrap();
        assert!(HeightLimits::SURFACE.check(&map).is_err());
        assert_eq!(HeightLimits::INDENTER.check(&map), Ok(()));
        let one = HeightMap::new(vec![3.0], [1, 1], [1e-6, 1e-6]).unwrap();
        assert_eq!(HeightLimits::SURFACE.check(&one), Ok(()));
    }
}
