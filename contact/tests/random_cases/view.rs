//! The same case seen in another way: each view has the same numbers.

use std::f64::consts::FRAC_PI_2;

use super::case::Units;

/// Units, and what else does not change a contact.
#[derive(Debug, Clone, Copy)]
pub struct View {
    pub units: Units,
    /// Whether y is −y, before the turn.
    pub is_mirrored: bool,
    pub quarter_turns: u8,
    /// Whether the top of the foundation is two layers of one material.
    pub is_split: bool,
    /// Whether the indenter's body is called the foundation.
    pub is_swapped: bool,
}

impl View {
    /// The case as drawn, in some units.
    pub fn plain(units: Units) -> Self {
        Self {
            units,
            is_mirrored: false,
            quarter_turns: 0,
            is_split: false,
            is_swapped: false,
        }
    }

    /// A point and an angle, seen so.
    pub fn placed(self, [x, y]: [f64; 2], rotation: f64) -> ([f64; 2], f64) {
        let (mut place, mut rotation) = if self.is_mirrored {
            ([x, -y], -rotation)
        } else {
            ([x, y], rotation)
        };
        for _ in 0..self.quarter_turns {
            place = [-place[1], place[0]];
        }
        rotation += f64::from(self.quarter_turns) * FRAC_PI_2;
        (place, rotation)
    }

    /// Lengths along x and y, seen so.
    pub fn along([x, y]: [f64; 2], view: Self) -> [f64; 2] {
        if view.quarter_turns.is_multiple_of(2) {
            [x, y]
        } else {
            [y, x]
        }
    }
}
