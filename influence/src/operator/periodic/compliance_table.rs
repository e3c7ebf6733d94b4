//! `C(k)` over the waves of a cell, tabulated once so that the aliases of a stack cost as little as those of one layer.
//!
//! `Φ` is smooth in `ln k` and tends to 1 beyond the reciprocal thickness of the top layer. Each octave is approximated
//! to a fraction of its own values, so `C` is right to as many digits for the longest waves on a rigid base, where `Φ`
//! vanishes, as for the shortest.

use pellicle_kernel::Foundation;

use crate::bodies::ElasticBodies;
use crate::numerics::chebyshev_panels::ChebyshevPanels;
use crate::response::NEGLIGIBLE_BEYOND;

/// Target size of the expansions' tails, relative to the largest `Φ` of a panel; the rounding of `Φ` in 200 layers.
const TOLERANCE: f64 = 1e-14;

/// `C(k)` of two bodies between two wavenumbers.
///
/// Accuracy: 1e-13 (test `the_table_equals_the_compliance`).
pub(crate) struct ComplianceTable([BodyTable; 2]);

/// `C(k)` of one body.
struct BodyTable {
    /// `E*` of the surface, Pa.
    modulus: f64,
    /// `Φ` over ln k; none for a half-space.
    panels: Option<ChebyshevPanels>,
    /// Wavenumber beyond which `Φ = 1`, in 1/m.
    end: f64,
}

impl ComplianceTable {
    /// Tabulates the waves of a cell of `size` × `size` elements and their aliases.
    pub(crate) fn of_cell(bodies: &ElasticBodies, element_side: f64, size: usize) -> Self {
        let longest = std::f64::consts::TAU / (element_side * size as f64);
        let ends = [longest, longest * size as f64 * super::alias_sum::SHORTEST];
        Self(bodies.each().map(|body| BodyTable::between(body, ends)))
    }

    /// Whether `C` is that of the surface materials alone beyond this wavenumber, in 1/m.
    pub(crate) fn is_homogeneous_beyond(&self, wavenumber: f64) -> bool {
        let is_homogeneous = |of: &BodyTable| of.panels.is_none() || of.end <= wavenumber;
        self.0.iter().all(is_homogeneous)
    }

    /// `C(k)`, in m/Pa, at a wavenumber (1/m) in the table's range.
    pub(crate) fn at(&self, wavenumber: f64) -> f64 {
        let [foundation, counterbody] = &self.0;
        foundation.at(wavenumber) + counterbody.at(wavenumber)
    }
}

impl BodyTable {
    /// Tabulates the waves between two wavenumbers, in 1/m.
    fn between(body: &Foundation, [smallest, largest]: [f64; 2]) -> Self {
        let top = body.layers().first();
        let end = top.map_or(0.0, |layer| NEGLIGIBLE_BEYOND / layer.thickness());
        // Roundings of the ends are far inside the margin.
        let ends = [0.99 * smallest, 1.01 * largest.min(end).max(smallest)].map(f64::ln);
        let panels = (end > smallest).then(|| {
            let response = |ln_k: f64| body.response(ln_k.exp());
            ChebyshevPanels::fit(ends, response, |largest, _| TOLERANCE * largest)
        });
        Self {
            modulus: body.surface_material().plane_strain_modulus(),
            panels,
            end,
        }
    }

    fn at(&self, wavenumber: f64) -> f64 {
        let response = match &self.panels {
            Some(panels) if wavenumber < self.end => panels.value(wavenumber.ln()),
            _ => 1.0,
        };
        // C = 2 (1 − ν₁²) / (E₁ k) · Φ
        2.0 / (self.modulus * wavenumber) * response
    }
}

#[cfg(test)]
mod tests {
    use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};

    use super::ComplianceTable;
    use crate::bodies::ElasticBodies;

    fn layer([thickness, modulus, ratio]: [f64; 3], interface: Interface) -> Layer {
        Layer::new(thickness, Material::new(modulus, ratio).unwrap(), interface).unwrap()
    }

    /// Foundations whose response changes most within an octave, and a graded layer of 100 sublayers.
    fn foundations() -> Vec<Foundation> {
        use Interface::{Bonded, Frictionless};
        let graded = (0..100).map(|i| layer([0.02, 4.0 - 0.02 * f64::from(i), 0.3], Bonded));
        let spring = Interface::spring(0.05, 3.0).unwrap();
        let stacks = [
            vec![layer([1.0, 1e4, 0.3], Bonded)],
            vec![layer([1.0, 1e-6, 0.5], Bonded)],
            vec![
                layer([0.01, 1e4, 0.2], Bonded),
                layer([2.0, 1e-3, 0.5], Bonded),
            ],
            vec![
                layer([0.1, 50.0, 0.04], Bonded),
                layer([5.0, 0.0015, 0.06], Frictionless),
                layer([26.0, 3.0, 0.49], Bonded),
            ],
            vec![
                layer([0.2, 5.0, 0.3], spring),
                layer([1.0, 0.1, 0.4999], Frictionless),
            ],
            graded.collect(),
        ];
        let base = Base::HalfSpace(Material::new(1.0, 0.3).unwrap());
        let on = |base: Base| {
            stacks
                .clone()
                .map(|layers| Foundation::new(layers, base).unwrap())
        };
        [on(base), on(Base::Rigid)].concat()
    }

    /// Cells from much smaller than the layers are thick to much larger.
    #[test]
    fn the_table_equals_the_compliance() {
        let indenter = Foundation::from(Material::new(2.0, 0.2).unwrap());
        for foundation in foundations() {
            let coated = foundations().swap_remove(2);
            for counterbody in [Foundation::rigid(), indenter.clone(), coated] {
                let bodies = ElasticBodies::new(foundation.clone(), counterbody);
                for element_side in [1e-3, 0.1, 30.0] {
                    let (size, longest) = (64, std::f64::consts::TAU / (64.0 * element_side));
                    let table = ComplianceTable::of_cell(&bodies, element_side, size);
                    for i in 0..=500 {
                        let wavenumber = longest * 3600_f64.powf(f64::from(i) / 500.0);
                        let (found, wanted) = (table.at(wavenumber), bodies.compliance(wavenumber));
                        let error = (found / wanted - 1.0).abs();
                        assert!(error < 1e-13, "{element_side} {i} {error:e} {foundation:?}");
                    }
                }
            }
        }
    }
}
