//! The fields of a loading step, for writers and pictures.

use std::borrow::Cow;

use pellicle_contact::{DeformedSurface, LoadingPath, SampledModel};

/// The fields of a step, a value for each element, element `(i, j)` of `N_x × N_y` at index `i N_y + j`: the first
/// index runs along x.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fields<'a> {
    /// Side of the domain along y, and along x if it is square, m.
    pub side: f64,
    /// Elements along y, in a row.
    pub size: usize,
    /// Pressure `p`, Pa.
    pub pressure: &'a [f64],
    /// Displacement `u` of the body's surface, m, positive into the body.
    pub displacement: &'a [f64],
    /// Gap `g`, m; +∞ where there is no indenter surface.
    pub gap: &'a [f64],
    /// Shortening `w*` of the relief, m.
    pub shortening: &'a [f64],
    /// Plastic depth where the pressure is cut at a hardness, m; empty without a hardness.
    pub plastic_depth: &'a [f64],
    /// Profile `f*` of the relief, m: 0 on the unworn tops, negative between them and where it is worn.
    pub profile: &'a [f64],
    /// Whether an element belongs to the relief.
    pub mask: &'a [bool],
}

/// A field of numbers, as in every file.
#[derive(Debug, Clone, Copy)]
pub struct NumberField {
    /// Its name.
    pub name: &'static str,
    /// Its unit in SI.
    pub unit: &'static str,
    /// Its meaning, in words.
    pub meaning: &'static str,
    /// Whether only a step with a hardness has it.
    pub of_hardness: bool,
    values: for<'a> fn(&Fields<'a>) -> &'a [f64],
}

/// A field of truth values, as in every file.
#[derive(Debug, Clone, Copy)]
pub struct TruthField {
    /// Its name.
    pub name: &'static str,
    /// Its meaning, in words.
    pub meaning: &'static str,
    values: for<'a> fn(&Fields<'a>) -> Cow<'a, [bool]>,
}

/// The fields of numbers, in their order in the files.
pub const NUMBERS: [NumberField; 6] = [
    NumberField {
        name: "pressure",
        unit: "Pa",
        meaning: "pressure p, compression positive",
        of_hardness: false,
        values: |fields| fields.pressure,
    },
    NumberField {
        name: "displacement",
        unit: "m",
        meaning: "displacement u of the body's surface, positive into the body",
        of_hardness: false,
        values: |fields| fields.displacement,
    },
    NumberField {
        name: "gap",
        unit: "m",
        meaning: "gap g between the indenter and the surface",
        of_hardness: false,
        values: |fields| fields.gap,
    },
    NumberField {
        name: "shortening",
        unit: "m",
        meaning: "shortening w* of the relief",
        of_hardness: false,
        values: |fields| fields.shortening,
    },
    NumberField {
        name: "profile",
        unit: "m",
        meaning: "profile f* of the relief: 0 on the unworn tops, negative between them and where it is worn",
        of_hardness: false,
        values: |fields| fields.profile,
    },
    NumberField {
        name: "plastic_depth",
        unit: "m",
        meaning: "plastic depth where the pressure is cut at the hardness",
        of_hardness: true,
        values: |fields| fields.plastic_depth,
    },
];

/// The fields of truth values, in their order in the files.
pub const TRUTHS: [TruthField; 2] = [
    TruthField {
        name: "mask",
        meaning: "whether the element belongs to the relief",
        values: |fields| Cow::Borrowed(fields.mask),
    },
    TruthField {
        name: "contact",
        meaning: "whether the element carries pressure",
        values: |fields| fields.pressure.iter().map(|p| *p > 0.0).collect(),
    },
];

impl NumberField {
    /// Its values in a step; empty where the step does not have it.
    #[must_use]
    pub fn of<'a>(&self, fields: &Fields<'a>) -> &'a [f64] {
        (self.values)(fields)
    }
}

impl TruthField {
    /// Its values in a step.
    #[must_use]
    pub fn of<'a>(&self, fields: &Fields<'a>) -> Cow<'a, [bool]> {
        (self.values)(fields)
    }
}

impl<'a> Fields<'a> {
    /// The fields of a step of a path, including its deformed surface.
    #[must_use]
    pub fn of(
        path: &'a LoadingPath,
        geometry: &'a SampledModel,
        step: usize,
        surface: &'a DeformedSurface,
    ) -> Self {
        Self {
            side: path.grid.sides()[1],
            size: path.grid.row(),
            pressure: &path.steps[step].solution.pressure,
            displacement: &surface.displacement,
            gap: &surface.gap,
            shortening: &surface.shortening,
            plastic_depth: &surface.plastic_depth,
            profile: match &surface.worn_profile[..] {
                [] => geometry.relief.profile(),
                worn => worn,
            },
            mask: geometry.relief.mask(),
        }
    }

    /// The fields of numbers that the step has, with their values.
    pub fn numbers(&self) -> impl Iterator<Item = (&'static NumberField, &'a [f64])> {
        let fields = *self;
        let all = NUMBERS.iter().map(move |field| (field, field.of(&fields)));
        all.filter(|(_, values)| !values.is_empty())
    }

    /// Elements along x and y.
    #[must_use]
    pub fn lengths(&self) -> [usize; 2] {
        [self.pressure.len() / self.size.max(1), self.size]
    }

    /// Whether the domain is a square.
    #[must_use]
    pub fn is_square(&self) -> bool {
        self.pressure.len() == self.size * self.size
    }

    /// Coordinate of the centre of the `i`-th element along an axis, 0 for x and 1 for y, m.
    ///
    /// # Panics
    /// If there is no such axis.
    #[must_use]
    pub fn centre_along(&self, axis: usize, i: usize) -> f64 {
        // x_i = (2i + 1 − N_x) h/2; the bracket is exact.
        ((2 * i + 1) as f64 - self.lengths()[axis] as f64) * (0.5 * self.element_side())
    }

    /// Lowest coordinates along x and y, m.
    #[must_use]
    pub fn corner(&self) -> [f64; 2] {
        let side = |length: usize| self.side * (length as f64 / self.size as f64);
        self.lengths().map(|length| side(length) * -0.5)
    }

    /// Area of the domain, m².
    #[must_use]
    pub fn area(&self) -> f64 {
        let [x, y] = self.corner();
        4.0 * (x * y)
    }

    /// Coordinate of the lower side of element `i` of a square, m; `i` may lie outside the domain.
    #[must_use]
    pub fn edge(&self, i: usize) -> f64 {
        self.side * (i as f64 / self.size as f64 - 0.5)
    }

    /// Coordinate of the centre of element `i` of a square, m.
    #[must_use]
    pub fn centre(&self, i: usize) -> f64 {
        // x_i = (2i + 1 − N) h/2; the bracket is exact.
        ((2 * i + 1) as f64 - self.size as f64) * (0.5 * self.element_side())
    }

    /// The element along an axis of a square that contains a coordinate or is nearest to it.
    #[must_use]
    pub fn nearest(&self, coordinate: f64) -> usize {
        let elements = (coordinate / self.side + 0.5) * self.size as f64;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "the conversion saturates"
        )]
        let element = elements as usize;
        element.min(self.size.saturating_sub(1))
    }

    /// Side of an element, m.
    #[must_use]
    pub fn element_side(&self) -> f64 {
        self.side / self.size as f64
    }
}
