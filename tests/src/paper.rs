//! The paper's textured surfaces, Fig. 2(a)–(d), in its units: indenter radius 1, coating modulus 1.

use std::sync::Arc;

use pellicle_contact::{Indenter, Load, Model, Paraboloid};
use pellicle_influence::{Cache, RadialTables};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::{CylinderSpec, Cylinders, Lattice, Relief};

/// One panel of Fig. 2.
#[derive(Debug, Clone)]
pub struct Panel {
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
///
/// # Panics
/// Never: the numbers are the paper's.
#[must_use]
pub fn figure_2() -> [Panel; 4] {
    let soft = || model(Material::new(1.0, 0.4), Material::new(10.0, 0.3));
    let stiff = || model(Material::new(1.0, 0.3), Material::new(0.1, 0.4));
    let panel = |name, model, side, force| Panel {
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

/// Coating `H = 1e-4` with cylinders `r = 5e-3`, `h = 1e-4`, period 1/80 of its own modulus 1.
fn model<E: std::fmt::Debug>(
    coating: Result<Material, E>,
    substrate: Result<Material, E>,
) -> Model {
    let (coating, substrate) = (coating.expect("legal"), substrate.expect("legal"));
    let foundation = Foundation::coated(1e-4, coating, substrate).expect("legal");
    let spec = CylinderSpec {
        lattice: Lattice::Square,
        radius: 5e-3,
        height: 1e-4,
        period: 1.0 / 80.0,
        offset: [0.0, 0.0],
        young_modulus: 1.0,
    };
    Model {
        tables: Arc::new(RadialTables::build(&foundation).expect("within the tables' reach")),
        relief: Relief::Cylinders(Cylinders::new(spec).expect("apart")),
        indenter: Indenter::Paraboloid(Paraboloid::new(1.0).expect("positive")),
        cache: Cache::in_memory(),
    }
}
