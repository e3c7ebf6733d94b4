//! The radial functions of a foundation: panels of T, their integrals, the far field, and the errors of all of them.

use pellicle_kernel::Foundation;

use super::far_field::FarField;
use super::functions::{RadialFunctions, Worst, Yardstick, scale};
use super::sampler::Sampler;
use crate::element::product_rule::Borders;
use crate::numerics::chebyshev;
use crate::numerics::chebyshev_panels::{ChebyshevPanel, ChebyshevPanels, TERMS};
use crate::response::ResponseTable;

/// Below this many thicknesses of the top layer `T = 1 + g t` to 1e-17: the next term is t³.
pub(crate) const NEAR: f64 = 1.0 / 262_144.0;

/// From this many times the reciprocal reach of Φ's Taylor series on, four of its even terms give T to rounding.
const FAR: f64 = 300.0;

/// On a rigid base, where T vanishes far away, its errors are kept below this fraction of a homogeneous
/// body's coefficients.
const RIGID_FLOOR: f64 = 1e-2;

impl RadialFunctions {
    pub(crate) fn new(foundation: &Foundation) -> Self {
        let response = ResponseTable::new(foundation);
        let mut functions = Self::sampled(&Sampler::new(foundation, &response));
        functions.tabulate_far_field();
        functions
    }

    /// The functions of a response that belongs to no foundation, with the rules over an element of one that does.
    pub(crate) fn of_response(response: &ResponseTable, rules: Option<&Self>) -> Self {
        let mut functions = Self::sampled(&Sampler::plain_only(response));
        if let Some(rules) = rules {
            (functions.rule_floor, functions.borders) = (rules.rule_floor, rules.borders);
        }
        functions.tabulate_far_field();
        functions
    }

    /// Panels of T, their integrals and the far series.
    fn sampled(sampler: &Sampler<'_>) -> Self {
        let response = sampler.response();
        let ends = [NEAR * 24.0 / response.end(), FAR / response.reach()];
        let limit = response.limit();
        let at = |ln_t: f64| sampler.at(ln_t).value;
        let allowed = |largest: f64, ln_t: f64| {
            let scale = scale(limit, largest, ln_t);
            (sampler.tolerance() * scale).max(2.0 * sampler.at(ln_t).rounding())
        };
        let panels = ChebyshevPanels::fit(ends.map(f64::ln), at, allowed);
        let [start, end] = panels.range();
        let series = series(sampler.even_taylor());
        let rule_floor = rule_floor(limit);
        let mut functions = Self {
            limit,
            slope: (at(start) - 1.0) / start.exp(),
            integrals: Vec::new(),
            ends: [start.exp(), end.exp()],
            series,
            reduced_from: panels.panels().len(),
            constant: 0.0,
            worst: Worst::NONE,
            rule_floor,
            borders: Borders::new(rule_floor),
            far_field: None,
            panels,
        };
        functions.integrate();
        functions.worst = sampler.worst(&functions);
        functions
    }

    fn tabulate_far_field(&mut self) {
        let value = |t: f64| self.value(t);
        let mut yardstick = Yardstick::new(self);
        let scale = |largest: f64, t: f64| yardstick.at(t, largest);
        let table = FarField::new(self.ends, value, scale);
        self.worst.error += table.error();
        self.far_field = Some(table);
    }

    /// Computes P from left to right, and subtracts the constant from where it is more than half of P.
    ///
    /// The error of the constant itself does not matter: it is added again, and only the remainder must be accurate.
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

/// Error allowed to the product rules over a base with this `Φ(0)`.
fn rule_floor(limit: f64) -> f64 {
    if limit > 0.0 {
        limit.min(1.0)
    } else {
        RIGID_FLOOR
    }
}

/// Chebyshev coefficients of `∫ T dt` from the panel's left end, over ln t.
fn integral(panel: &ChebyshevPanel) -> Vec<f64> {
    let transform = chebyshev::ChebyshevTransform::new(TERMS, TERMS);
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
    use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};

    use super::super::functions::Area;
    use super::{RadialFunctions, Yardstick};

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
    fn the_derivative_of_the_area_is_the_function() {
        for functions in [coated(0.1), coated(10.0)] {
            for t in radii(&functions) {
                let step = 1e-4 * t;
                let [less, more] = [t - step, t + step].map(|t| functions.stored_area(t));
                // Stored in the same form on both sides of most radii; P' = T, to (step/t)² of its curvature.
                let growth = (more.0 - less.0) / (2.0 * step);
                if less.1 == more.1 {
                    approx::assert_relative_eq!(growth, functions.value(t), max_relative = 1e-7);
                }
            }
        }
    }

    /// A layer (thickness, modulus, Poisson's ratio) on an interface.
    fn layer(numbers: [f64; 3], interface: Interface) -> Layer {
        let [thickness, modulus, ratio] = numbers;
        Layer::new(thickness, Material::new(modulus, ratio).unwrap(), interface).unwrap()
    }

    /// T(t) by mpmath 1.3 with 34 digits: a dense linear system of Airy's stress functions for each wavenumber.
    #[test]
    fn between_stiff_bodies_the_function_agrees_with_mpmath_within_the_estimate() {
        let gold = vec![
            layer([1e-7, 78e9, 0.44], Interface::Bonded),
            layer([2e-5, 2e6, 0.49], Interface::Bonded),
        ];
        let sliding = vec![
            layer([0.1, 50.0, 0.04], Interface::Bonded),
            layer([5.0, 0.0015, 0.06], Interface::Frictionless),
            layer([26.0, 3.0, 0.49], Interface::Bonded),
        ];
        let base = Base::HalfSpace(Material::new(37.0, 0.4).unwrap());
        let on_gold = [
            (0.02, 8_136.340_437_921_923),
            (1.0, -6_882.568_492_681_384),
            (30.0, -0.332_849_835_155_958_1),
        ];
        let on_sliding = [(0.5, -645.746_847_609_596_1)];
        for (layers, base, expected) in [
            (gold, Base::Rigid, &on_gold[..]),
            (sliding, base, &on_sliding),
        ] {
            let functions = RadialFunctions::new(&Foundation::new(layers, base).unwrap());
            let mut yardstick = Yardstick::new(&functions);
            for &(t, expected) in expected {
                let error = (functions.value(t) - expected).abs();
                let scale = yardstick.at(t, f64::abs(expected));
                assert!(error < functions.worst().error * scale, "{t}: {error:e}");
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
