//! The paper's textured surfaces, Fig. 2(a)–(d), in its units: indenter radius 1, coating modulus 1.

use pellicle_contact::{Load, Model};
use pellicle_influence::Cache;
use pellicle_kernel::Material;

use crate::scene::{coated, cylinders, material, model, paraboloid};

/// One panel of Fig. 2.
#[derive(Debug, Clone)]
pub struct Fig2Panel {
    /// Its letter.
    pub name: &'static str,
    /// Foundation, relief and indenter.
    pub model: Model,
    /// Side of the domain.
    pub side: f64,
    /// Force `Q' = Q/(E1 R²)`.
    pub load: Load,
}

/// The four panels.
#[must_use]
pub fn figure_2() -> [Fig2Panel; 4] {
    let soft = || textured(material(1.0, 0.4), material(10.0, 0.3));
    let stiff = || textured(material(1.0, 0.3), material(0.1, 0.4));
    let panel = |name, model, side, force| Fig2Panel {
        name,
        model,
        side,
        load: Load::Force(force),
    };
    [
        panel("2a", soft(), 0.08, 0.3571e-4),
        panel("2b", stiff(), 0.08, 0.3571e-5),
        panel("2c", soft(), 0.12, 2.1426e-4),
        panel("2d", stiff(), 0.14, 2.1426e-5),
    ]
}

/// Coating `H = 1e-4` with cylinders `r = 5e-3`, `h = 1e-4`, period 1/80, of the coating's modulus 1.
fn textured(coating: Material, substrate: Material) -> Model {
    let relief = cylinders(5e-3, 1e-4, 1.0 / 80.0, 1.0);
    Model {
        cache: Cache::in_memory(),
        ..model(&coated(1e-4, coating, substrate), relief, paraboloid(1.0))
    }
}
