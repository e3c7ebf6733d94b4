//! The displacement around a point force on a layered foundation, as two functions of the dimensionless radius `t = r/H`.
//!
//! `T(t) = t ∫₀^∞ Φ(s) J0(st) ds` is the displacement over that of a homogeneous body of the surface's material; with `x = st`,
//! `T(t) = ∫₀^∞ Φ(x/t) J0(x) dx`. Its integral `P(t) = ∫₀^t T dt'` turns area integrals into edge integrals, because
//! `div(r P/r²) = T/r`. (`P = t W` with the `W(t) = ∫ Φ(s) J1(st)/s ds` of the transform.)

mod sampler;
mod stored;

use pellicle_kernel::Foundation;

use crate::chebyshev;
use crate::far_field::FarField;
use crate::panels::{Panel, Panels};
use crate::product_rule::Borders;
use crate::response::ResponseTable;
use sampler::{Sampler, scale};

/// Below this many thicknesses of the top layer `T = 1 + g t` to 1e-17: the next term is t³.
const NEAR: f64 = 1.0 / 262_144.0;

/// From this many reciprocals of the reach of Φ's Taylor series on, four even terms of it give T to rounding.
const FAR: f64 = 300.0;

/// Wanted size of the expansions' tails, relative to the scale of T.
const TOLERANCE: f64 = 1e-15;

/// On a rigid base, where nothing is left far away, errors of T are kept below this share of what they would be allowed in a
/// homogeneous body.
const RIGID_FLOOR: f64 = 1e-2;

/// `T` and `P` of one layered foundation.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RadialFunctions {
    limit: f64,
    /// g in `T = 1 + g t`, left of the panels.
    slope: f64,
    /// T over ln t.
    panels: Panels,
    /// P over ln t, in the same panels.
    integrals: Vec<Vec<f64>>,
    /// Ends of the panels as t.
    ends: [f64; 2],
    /// Coefficients of t⁻², t⁻⁴, t⁻⁶, t⁻⁸ in `T − Φ(0)`, right of the panels.
    series: [f64; 4],
    /// From this panel on, `integrals` hold P less `constant`.
    reduced_from: usize,
    /// `∫₀^∞ (T − Φ(0)) dt`, the part of P that no radius changes any more.
    constant: f64,
    worst: Worst,
    borders: Borders,
    far_field: Option<FarField>,
}

/// The largest estimated error of T over its scale, and where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Worst {
    pub error: f64,
    pub t: f64,
}

/// P for the far and near parts of one element alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Area {
    /// P itself.
    Whole,
    /// P less `∫₀^∞ (T − Φ(0)) dt`, which is a point force's share that only the loaded element itself feels.
    Reduced,
}

impl RadialFunctions {
    pub(crate) fn new(foundation: &Foundation) -> Self {
        let response = ResponseTable::new(foundation);
        let sampler = Sampler::new(foundation, &response);
        let ends = [NEAR * 24.0 / response.end(), FAR / response.reach()];
        let limit = response.limit();
        let at = |ln_t: f64| sampler.at(ln_t).value;
        let allowed = |largest: f64, ln_t: f64| {
            let scale = scale(limit, largest, ln_t);
            (TOLERANCE * scale).max(2.0 * sampler.at(ln_t).rounding())
        };
        let panels = Panels::fit(ends.map(f64::ln), at, allowed);
        let [start, end] = panels.range();
        let series = series(sampler.even_taylor());
        let mut functions = Self {
            limit,
            slope: (at(start) - 1.0) / start.exp(),
            integrals: Vec::new(),
            ends: [start.exp(), end.exp()],
            series,
            reduced_from: panels.panels().len(),
            constant: 0.0,
            worst: sampler.worst(&panels),
            borders: borders(limit),
            far_field: None,
            panels,
        };
        functions.integrate();
        functions.tabulate_far_field();
        functions
    }

    /// The largest estimated error of T relative to its scale, `max(|T|, min(1, Φ(0)))`.
    pub(crate) fn worst(&self) -> Worst {
        self.worst
    }

    /// From which offsets product rules hold.
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

    /// `T(√u)/√u`, the quick way.
    #[inline]
    pub(crate) fn over_root(&self, u: f64) -> f64 {
        let table = self.far_field.as_ref();
        table.and_then(|table| table.value(u)).unwrap_or_else(|| {
            let t = u.sqrt();
            self.value(t) / t
        })
    }

    /// The constant by which [`Area::Reduced`] is less than [`Area::Whole`].
    pub(crate) fn constant(&self) -> f64 {
        self.constant
    }

    /// Which form of P is the smaller for all radii from `t` on.
    pub(crate) fn area_from(&self, t: f64) -> Area {
        let panels = self.panels.panels();
        let beyond = |panel: &Panel| t.ln() >= panel.centre - panel.half_width;
        match panels.get(self.reduced_from) {
            Some(first) if beyond(first) => Area::Reduced,
            _ => Area::Whole,
        }
    }

    /// `P(t)` in the form wanted.
    pub(crate) fn area(&self, t: f64, form: Area) -> f64 {
        let (value, held) = self.area_as_held(t);
        match (form, held) {
            (Area::Whole, Area::Reduced) => value + self.constant,
            (Area::Reduced, Area::Whole) => value - self.constant,
            _ => value,
        }
    }

    fn area_as_held(&self, t: f64) -> (f64, Area) {
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
    fn far_area(&self, t: f64) -> f64 {
        let u = 1.0 / (t * t);
        let [b2, b4, b6, b8] = self.series;
        self.limit * t - (b2 + u * (b4 / 3.0 + u * (b6 / 5.0 + u * b8 / 7.0))) / t
    }

    fn tabulate_far_field(&mut self) {
        let value = |t: f64| self.value(t);
        let scale = |largest: f64, t: f64| scale(self.limit, largest, t.ln());
        let table = FarField::new(self.ends, value, scale);
        self.worst.error += table.error();
        self.far_field = Some(table);
    }

    /// Fills in P from left to right, and takes the constant out from where it is more than half of P.
    ///
    /// The constant's own error does not matter: what is left out is added again, and only what is left must be accurate.
    fn integrate(&mut self) {
        let growth: Vec<Vec<f64>> = self.panels.panels().iter().map(integral).collect();
        let [start, end] = self.ends;
        let mut at_edge = start * (1.0 + self.slope * start / 2.0);
        let at_edges = growth.iter().map(|p| {
            let before = at_edge;
            at_edge += chebyshev::sum(p, 1.0);
            before
        });
        let at_edges: Vec<f64> = at_edges.collect();
        self.constant = at_edge - self.far_area(end);
        let smaller = |p: &&f64| (**p - self.constant).abs() < p.abs();
        self.reduced_from = growth.len() - at_edges.iter().rev().take_while(smaller).count();
        let mut at_edge = at_edges[0];
        for (index, mut p) in growth.into_iter().enumerate() {
            if index == self.reduced_from {
                at_edge -= self.constant;
            }
            p[0] += at_edge;
            at_edge = chebyshev::sum(&p, 1.0);
            self.integrals.push(p);
        }
    }
}

/// From which offsets product rules hold over a base of this `Φ(0)`.
fn borders(limit: f64) -> Borders {
    Borders::new(if limit > 0.0 {
        limit.min(1.0)
    } else {
        RIGID_FLOOR
    })
}

/// Chebyshev coefficients of `∫ T dt` from the panel's left end, over ln t.
fn integral(panel: &Panel) -> Vec<f64> {
    let transform = chebyshev::Transform::new(crate::panels::TERMS, crate::panels::TERMS);
    // dt = t d ln t
    let integrand = panel.samples().map(|ln_t| panel.value(ln_t) * ln_t.exp());
    let coefficients = transform.coefficients(&integrand.collect::<Vec<_>>());
    let mut integral = chebyshev::integral(&coefficients);
    for c in &mut integral {
        *c *= panel.half_width;
    }
    integral
}

/// `t ∫ s^j J0(st) ds` of the Taylor terms: 0 for odd j; `(−1)^(j/2) ((j−1)!!)² t^(−j)` for even.
fn series([c2, c4, c6, c8]: [f64; 4]) -> [f64; 4] {
    [-c2, 9.0 * c4, -225.0 * c6, 11_025.0 * c8]
}

#[cfg(test)]
mod tests {
    use pellicle_kernel::{Foundation, Material};

    use super::{Area, RadialFunctions};

    fn coated(young_modulus: f64) -> RadialFunctions {
        let coating = Material::new(young_modulus, 0.4).unwrap();
        let base = Material::new(1.0, 0.3).unwrap();
        RadialFunctions::new(&Foundation::coated(1.0, coating, base).unwrap())
    }

    /// Radii below, between and beyond the panels.
    fn radii(functions: &RadialFunctions) -> impl Iterator<Item = f64> {
        let [start, end] = functions.ends.map(f64::ln);
        (-2..=22).map(move |i| (start + (end - start) * f64::from(i) / 20.0).exp())
    }

    #[test]
    fn the_area_grows_as_the_function_below_it() {
        for functions in [coated(0.1), coated(10.0)] {
            for t in radii(&functions) {
                let step = 1e-4 * t;
                let [less, more] = [t - step, t + step].map(|t| functions.area_as_held(t));
                // Held in one form on both sides of most radii; P' = T, to (step/t)² of its curvature.
                let growth = (more.0 - less.0) / (2.0 * step);
                if less.1 == more.1 {
                    approx::assert_relative_eq!(growth, functions.value(t), max_relative = 1e-7);
                }
            }
        }
    }

    #[test]
    fn both_forms_of_the_area_differ_by_the_constant_at_every_radius() {
        for functions in [coated(0.1), coated(10.0)] {
            let constant = functions.constant();
            for t in radii(&functions) {
                let [whole, reduced] = [Area::Whole, Area::Reduced].map(|a| functions.area(t, a));
                let largest = whole.abs().max(reduced.abs()).max(constant.abs());
                // one rounding of a sum
                assert!((whole - reduced - constant).abs() <= 1e-15 * largest, "{t}");
            }
        }
    }
}
