//! The quantities of a measured curve, one column of its file each.

use pellicle::input::dimension::Dimension;

use super::words::lower_words;
use crate::Reading;

/// A measured quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Channel {
    /// Penetration, positive into the body, m.
    Depth,
    /// Force, positive if it presses, N.
    Force,
    /// Time, s.
    Time,
    /// Contact stiffness, N/m.
    Stiffness,
    /// Radius of the contact, m.
    ContactRadius,
    /// Height of the piezo that moves a cantilever, m.
    Height,
    /// Deflection of the cantilever, positive if the body presses it, m.
    Deflection,
}

impl Channel {
    /// All channels.
    pub const ALL: [Self; 7] = [
        Self::Depth,
        Self::Force,
        Self::Time,
        Self::Stiffness,
        Self::ContactRadius,
        Self::Height,
        Self::Deflection,
    ];

    /// Its key in `columns` and `units`.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::Depth => "depth",
            Self::Force => "force",
            Self::Time => "time",
            Self::Stiffness => "stiffness",
            Self::ContactRadius => "contact_radius",
            Self::Height => "height",
            Self::Deflection => "deflection",
        }
    }

    /// Its meaning, in words.
    #[must_use]
    pub fn meaning(self) -> &'static str {
        match self {
            Self::Depth => "penetration, positive into the body",
            Self::Force => "force, positive if it presses",
            Self::Time => "time",
            Self::Stiffness => "contact stiffness",
            Self::ContactRadius => "√(A/π) of the contact area A",
            Self::Height => "height of the piezo that moves a cantilever",
            Self::Deflection => "deflection of the cantilever, positive if the body presses it",
        }
    }

    /// Its dimension.
    #[must_use]
    pub fn dimension(self) -> Dimension {
        match self {
            Self::Depth | Self::ContactRadius | Self::Height | Self::Deflection => {
                Dimension::Length
            }
            Self::Force => Dimension::Force,
            Self::Time => Dimension::Time,
            Self::Stiffness => Dimension::Stiffness,
        }
    }

    /// The words with which instruments name a column of this quantity.
    fn words(self) -> &'static [&'static str] {
        match self {
            Self::Depth => &[
                "depth",
                "displacement",
                "indentation",
                "penetration",
                "eindringtiefe",
                "extension",
                "weg",
                "standardweg",
            ],
            Self::Force => &[
                "force",
                "load",
                "kraft",
                "last",
                "standardkraft",
                "normalkraft",
            ],
            Self::Time => &["time", "zeit", "prüfzeit"],
            Self::Stiffness => &["stiffness"],
            Self::ContactRadius => &["radius"],
            Self::Height => &["height", "höhe", "hauteur", "piezo", "z"],
            Self::Deflection => &["deflection", "cantilever"],
        }
    }

    /// Whether the name of a column indicates this quantity.
    #[must_use]
    pub fn is_indicated_by(self, name: &str) -> bool {
        let words = lower_words(name);
        self.words()
            .iter()
            .any(|word| words.iter().any(|found| found == word))
    }

    /// Returns the other quantity that the name of a column indicates, if it does not also indicate this one.
    #[must_use]
    pub fn other_in(self, name: &str) -> Option<Self> {
        let is_indicated = |channel: &Self| channel.is_indicated_by(name);
        // A name that also indicates this quantity, such as "load at depth", proves nothing; heights and depths are
        // often confused.
        let is_like = |channel: &Self| {
            *channel == self || (channel.dimension() == self.dimension() && is_indicated(channel))
        };
        if Self::ALL
            .iter()
            .filter(|channel| is_indicated(channel))
            .any(is_like)
        {
            return None;
        }
        Self::ALL.into_iter().find(is_indicated)
    }
}

impl From<Reading> for Channel {
    fn from(reading: Reading) -> Self {
        match reading {
            Reading::Force => Self::Force,
            Reading::Depth => Self::Depth,
            Reading::ContactRadius => Self::ContactRadius,
            Reading::Stiffness => Self::Stiffness,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_indicates_another_quantity_only_if_it_indicates_no_third() {
        assert_eq!(
            Channel::Depth.other_in("Load On Sample"),
            Some(Channel::Force)
        );
        assert_eq!(
            Channel::Force.other_in("Extend Z-Sense"),
            Some(Channel::Height)
        );
        assert_eq!(Channel::Force.other_in("Load at maximum depth"), None);
        assert_eq!(Channel::Depth.other_in("h"), None);
        assert_eq!(Channel::Height.other_in("Displacement"), None);
        assert_eq!(Channel::Depth.other_in("overload"), None);
    }
}
