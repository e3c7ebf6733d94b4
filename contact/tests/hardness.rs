//! Contact whose pressure is cut at a hardness, compared with closed forms, an independent method, and itself.

#![expect(
    clippy::unwrap_used,
    reason = "a scene that cannot be built fails its test"
)]

mod discrete_problem;
mod loading_path;

use pellicle_kernel::{Foundation, Material};

const SIDE: f64 = 1.0;

/// A coating of this relative stiffness and thickness on a body of modulus 1, or the body alone.
fn body(coating: Option<[f64; 2]>) -> Foundation {
    let base = Material::new(1.0, 0.3).unwrap();
    match coating {
        None => Foundation::half_space(base),
        Some([stiffness, thickness]) => {
            Foundation::coated(thickness, Material::new(stiffness, 0.3).unwrap(), base).unwrap()
        }
    }
}
