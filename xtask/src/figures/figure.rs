//! The figures of the paper that show results.

use std::str::FromStr;

/// A figure of the paper.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Figure {
    /// Pressure under a paraboloid on textured coatings.
    Two,
    /// Deformed layer and tops of the elements.
    Three,
    /// Penetration against load.
    Four,
    /// Pressure under a pyramid, with and without film.
    Five,
    /// Largest pressure and penetration against load, with and without film.
    Six,
}

impl Figure {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Two, Self::Three, Self::Four, Self::Five, Self::Six];
}

impl FromStr for Figure {
    type Err = String;

    /// `4`.
    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "2" => Ok(Self::Two),
            "3" => Ok(Self::Three),
            "4" => Ok(Self::Four),
            "5" => Ok(Self::Five),
            "6" => Ok(Self::Six),
            _ => Err("wanted 2, 3, 4, 5 or 6, the paper's figures with results".into()),
        }
    }
}
