//! The displacement around a point force on a layered foundation, as two functions of the dimensionless radius
//! `t = r/H`.
//!
//! `T(t) = t ∫₀^∞ Φ(s) J0(st) ds` is the displacement over that of a homogeneous body of the surface material; with
//! `x = st`, `T(t) = ∫₀^∞ Φ(x/t) J0(x) dx`. Its integral `P(t) = ∫₀^t T dt'` turns area integrals into edge integrals,
//! because `div(r P/r²) = T/r`. (`P = t W` with the `W(t) = ∫ Φ(s) J1(st)/s ds` of the transform.)

use serde::{Deserialize, Serialize};

use super::far_field::FarField;
use crate::element::product_rule::Borders;
use crate::numerics::chebyshev;
use crate::numerics::chebyshev_panels::{ChebyshevPanel, ChebyshevPanels};

/// `T` and `P` of one layered foundation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct RadialFunctions {
    pub(super) limit: f64,
    /// g in `T = 1 + g t`, left of the panels.
    pub(super) slope: f64,
    /// T over ln t.
    pub(super) panels: ChebyshevPanels,
    /// P over ln t, in the same panels.
    pub(super) integrals: Vec<Vec<f64>>,
    /// Ends of the panels as t.
    pub(super) ends: [f64; 2],
    /// Coefficients of t⁻², t⁻⁴, t⁻⁶, t⁻⁸ in `T − Φ(0)`, right of the panels.
    pub(super) series: [f64; 4],
    /// From this panel on, `integrals` hold P minus `constant`.
    pub(super) reduced_from: usize,
    /// `∫₀^∞ (T − Φ(0)) dt`, the part of P that does not depend on the radius.
    pub(super) constant: f64,
    pub(super) worst: Worst,
    /// Error allowed to the product rules, as a fraction of a homogeneous body's coefficients; see [`Borders::new`].
    pub(super) rule_floor: f64,
    pub(super) borders: Borders,
    pub(super) far_field: Option<FarField>,
}

/// The largest estimated error of T over its scale, and where.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Worst {
    pub error: f64,
    pub t: f64,
}

impl Worst {
    pub(crate) const NONE: Self = Self { error: 0.0, t: 1.0 };

    /// The larger of two; NaN is larger than any number.
    pub(crate) fn larger(self, other: Self) -> Self {
        if other.error.is_nan() || other.error > self.error {
            other
        } else {
            self
        }
    }

    /// The sum of both errors, at the place of the larger.
    fn and(self, other: Self) -> Self {
        Self {
            error: self.error + other.error,
            t: self.larger(other).t,
        }
    }
}

/// The two forms of P.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Area {
    /// P itself.
    Whole,
    /// P minus `∫₀^∞ (T − Φ(0)) dt`, the contribution of a point force that only affects the loaded element itself.
    Reduced,
}

impl RadialFunctions {
    /// The largest estimated error of T and of everything derived from it, relative to a [`Yardstick`].
    pub(crate) fn worst(&self) -> Worst {
        self.worst
    }

    /// Adds the error of another step.
    pub(crate) fn add_error(&mut self, other: Worst) {
        self.worst = self.worst.and(other);
    }

    /// Moves the borders of the product rules outwards to reduce their error by this factor.
    pub(crate) fn tighten_borders(&mut self, share: f64) {
        self.rule_floor *= share;
        self.borders = Borders::new(self.rule_floor);
    }

    /// Radii between which T is neither that of the top layer alone nor its limit.
    pub(crate) fn ends(&self) -> [f64; 2] {
        self.ends
    }

    /// The offsets from which product rules are valid.
    pub(crate) fn borders(&self) -> &Borders {
        &self.borders
    }

    /// `T(t)`.
    #[inline]
    pub(crate) fn value(&self, t: f64) -> f64 {
        if t < self.ends[0] {
            1.0 + self.slope * t
        } else if t < self.ends[1] {
            self.panels.value(t.ln())
        } else {
            self.far_value(t)
        }
    }

    /// `T(√u)/√u`, from the far-field table where it reaches.
    #[inline]
    pub(crate) fn over_root(&self, u: f64) -> f64 {
        let table = self.far_field.as_ref();
        table.and_then(|table| table.value(u)).unwrap_or_else(|| {
            let t = u.sqrt();
            self.value(t) / t
        })
    }

    /// The difference between [`Area::Whole`] and [`Area::Reduced`].
    pub(crate) fn constant(&self) -> f64 {
        self.constant
    }

    /// The form of P that is smaller for all radii from `t` on.
    pub(crate) fn area_from(&self, t: f64) -> Area {
        let panels = self.panels.panels();
        let beyond = |panel: &ChebyshevPanel| t.ln() >= panel.centre - panel.half_width;
        match panels.get(self.reduced_from) {
            Some(first) if beyond(first) => Area::Reduced,
            _ => Area::Whole,
        }
    }

    /// `P(t)` in the requested form.
    pub(crate) fn area(&self, t: f64, form: Area) -> f64 {
        let (value, stored) = self.stored_area(t);
        match (form, stored) {
            (Area::Whole, Area::Reduced) => value + self.constant,
            (Area::Reduced, Area::Whole) => value - self.constant,
            _ => value,
        }
    }

    /// `P(t)` and the form in which it is stored.
    pub(super) fn stored_area(&self, t: f64) -> (f64, Area) {
        if t < self.ends[0] {
            return (t * (1.0 + self.slope * t / 2.0), Area::Whole);
        }
        if t >= self.ends[1] {
            return (self.far_area(t), Area::Reduced);
        }
        let ln_t = t.ln();
        let index = self.panels.index(ln_t);
        let position = self.panels.panels()[index].position(ln_t);
        let form = if index < self.reduced_from {
            Area::Whole
        } else {
            Area::Reduced
        };
        (chebyshev::sum(&self.integrals[index], position), form)
    }

    /// `T = Φ(0) + Σ b_j t^(−j)`.
    fn far_value(&self, t: f64) -> f64 {
        let u = 1.0 / (t * t);
        let [b2, b4, b6, b8] = self.series;
        self.limit + u * (b2 + u * (b4 + u * (b6 + u * b8)))
    }

    /// `Φ(0) t − ∫_t^∞ (T − Φ(0)) dt' = Φ(0) t − Σ b_j t^(1−j)/(j−1)`.
    pub(super) fn far_area(&self, t: f64) -> f64 {
        let u = 1.0 / (t * t);
        let [b2, b4, b6, b8] = self.series;
        self.limit * t - (b2 + u * (b4 / 3.0 + u * (b6 / 5.0 + u * b8 / 7.0))) / t
    }
}

/// The scale of the errors of the expansions of T.
pub(super) fn scale(limit: f64, largest: f64, ln_t: f64) -> f64 {
    // On a rigid base T vanishes far away; the scale there is an element's own coefficient, about H/a = 1/t of Love's.
    let floor = if limit > 0.0 {
        limit.min(1.0)
    } else {
        (-ln_t).exp().min(1.0)
    };
    largest.max(floor)
}

/// The scale of T, evaluated at ascending radii: the largest of `|T|`, of its limit far away, and of `P/t`, the mean of
/// T up to the radius (with the largest P so far, where P falls again).
///
/// An error δT changes the coefficient at the distance r by `4a² c δT/r`, where `c = (1−ν1²)/(πE1)` and a is half an
/// element's side. The coefficient of the loaded element itself is about `2πcH P(a/H)`. The displacement around a
/// point force, T/t, falls with the distance, so `P(t)` is at most `(tH/a)² P(a/H)`. With `δT ≤ ε P(t)/t`,
/// therefore, the error of any coefficient is at most ε of the largest, whatever the element; the error of all of
/// them together is ε of their sum, up to the logarithm of the radius. On a rigid base, where T falls exponentially,
/// no finer error matters.
#[derive(Debug)]
pub(crate) struct Yardstick<'a> {
    functions: &'a RadialFunctions,
    largest_area: f64,
}

impl<'a> Yardstick<'a> {
    pub(crate) fn new(functions: &'a RadialFunctions) -> Self {
        Self {
            functions,
            largest_area: 0.0,
        }
    }

    /// The scale near t, where `|T|` is at most `largest`.
    pub(crate) fn at(&mut self, t: f64, largest: f64) -> f64 {
        let area = self.functions.area(t, Area::Whole).abs();
        self.largest_area = self.largest_area.max(area);
        scale(self.functions.limit, largest, t.ln()).max(self.largest_area / t)
    }
}
