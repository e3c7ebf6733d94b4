//! The fields of one loading step, for writers and pictures.

use std::borrow::Cow;

use pellicle_contact::{DeformedSurface, LoadingPath, SampledModel};
use pellicle_plot::step::fields as plot;

/// The fields of a step, N × N values each, element `(i, j)` at index `i N + j`: the first index runs along x.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fields<'a> {
    /// Side of the square domain, m.
    pub side: f64,
    /// Elements per side, N.
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
    /// Profile `f*` of the relief, m: 0 on the tops, negative between them.
    pub profile: &'a [f64],
    /// Whether an element belongs to the relief.
    pub mask: &'a [bool],
}

/// A field of truth values with its name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TruthField<'a> {
    /// Its name in every file.
    pub name: &'static str,
    /// Its meaning, in words.
    pub meaning: &'static str,
    /// Its values.
    pub values: Cow<'a, [bool]>,
}

/// A field of lengths or pressures with its name and unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NumberField<'a> {
    /// Its name in every file.
    pub name: &'static str,
    /// Its unit in SI.
    pub unit: &'static str,
    /// Its meaning, in words.
    pub meaning: &'static str,
    /// Its values.
    pub values: &'a [f64],
}

impl Fields<'_> {
    /// Fields without elements, for their names, units and meanings.
    pub const EMPTY: Fields<'static> = Fields {
        side: 0.0,
        size: 0,
        pressure: &[],
        displacement: &[],
        gap: &[],
        shortening: &[],
        plastic_depth: &[],
        profile: &[],
        mask: &[],
    };
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
            side: path.grid.side(),
            size: path.grid.size(),
            pressure: &path.steps[step].solution.pressure,
            displacement: &surface.displacement,
            gap: &surface.gap,
            shortening: &surface.shortening,
            plastic_depth: &surface.plastic_depth,
            profile: geometry.relief.profile(),
            mask: geometry.relief.mask(),
        }
    }

    /// The numbers of its pictures.
    #[must_use]
    pub fn plotted(&self) -> plot::Fields<'a> {
        let Fields {
            side,
            size,
            pressure,
            displacement,
            gap,
            shortening,
            plastic_depth,
            profile,
            mask,
        } = *self;
        plot::Fields {
            side,
            size,
            pressure,
            displacement,
            gap,
            shortening,
            plastic_depth,
            profile,
            mask,
        }
    }

    /// The numeric fields, in their order in the files: five, and the plastic depth if there is a hardness.
    #[must_use]
    pub fn numbers(&self) -> Vec<NumberField<'a>> {
        let named = |name, unit, meaning, values| NumberField {
            name,
            unit,
            meaning,
            values,
        };
        let mut fields = vec![
            named(
                "pressure",
                "Pa",
                "pressure p, compression positive",
                self.pressure,
            ),
            named(
                "displacement",
                "m",
                "displacement u of the body's surface, positive into the body",
                self.displacement,
            ),
            named(
                "gap",
                "m",
                "gap g between the indenter and the surface",
                self.gap,
            ),
            named(
                "shortening",
                "m",
                "shortening w* of the relief",
                self.shortening,
            ),
            named(
                "profile",
                "m",
                "profile f* of the relief: 0 on the tops, negative between them",
                self.profile,
            ),
        ];
        if !self.plastic_depth.is_empty() {
            fields.push(named(
                "plastic_depth",
                "m",
                "plastic depth where the pressure is cut at the hardness",
                self.plastic_depth,
            ));
        }
        fields
    }

    /// The fields of truth values, in their order in the files: every format has both, with these names and meanings.
    #[must_use]
    pub fn truths(&self) -> [TruthField<'a>; 2] {
        let contact = self.pressure.iter().map(|pressure| *pressure > 0.0);
        [
            TruthField {
                name: "mask",
                meaning: "whether the element belongs to the relief",
                values: Cow::Borrowed(self.mask),
            },
            TruthField {
                name: "contact",
                meaning: "whether the element carries pressure",
                values: contact.collect(),
            },
        ]
    }

    /// Coordinate of the lower side of element `i`, m; `i` may lie outside the domain.
    #[must_use]
    pub fn edge(&self, i: usize) -> f64 {
        self.side * (i as f64 / self.size as f64 - 0.5)
    }

    /// Coordinate of the centre of element `i`, m.
    #[must_use]
    pub fn centre(&self, i: usize) -> f64 {
        // x_i = (2i + 1 − N) h/2; the bracket is exact.
        ((2 * i + 1) as f64 - self.size as f64) * (0.5 * self.element_side())
    }

    /// Side of an element, m.
    #[must_use]
    pub fn element_side(&self) -> f64 {
        self.side / self.size as f64
    }
}
