//! Directions in the space of a foundation's parameters: changes of scale, and changes that preserve the compliance.

use crate::{Base, Foundation, FoundationParameter, Material};

/// Rates of change `dθ/dt` of some parameters, each in its own unit.
pub type FoundationDirection = Vec<(FoundationParameter, f64)>;

impl Foundation {
    /// The change of all parameters under `H → e^(lt) H` for every thickness, `E → e^(mt) E` for every modulus and
    /// `c → e^((l−m)t) c` for every compliance of an interface, with the exponents `l` of lengths and `m` of moduli.
    ///
    /// It takes the compliance `C(k)` to `e^((l−m)t) C(e^(lt) k)`.
    #[must_use]
    pub fn scaling(&self, length: f64, modulus: f64) -> FoundationDirection {
        let exponent = |parameter: &FoundationParameter| match parameter {
            FoundationParameter::YoungModulus { .. } => modulus,
            FoundationParameter::PoissonRatio { .. } => 0.0,
            FoundationParameter::Thickness { .. } => length,
            FoundationParameter::NormalCompliance { .. }
            | FoundationParameter::ShearCompliance { .. } => length - modulus,
        };
        let all = self.parameters().into_iter();
        let changes = all.filter_map(|parameter| {
            let change = exponent(&parameter) * self.parameter(parameter)?;
            (change != 0.0).then_some((parameter, change))
        });
        changes.collect()
    }

    /// Changes of the materials that preserve the compliance `C(k)` at every wavenumber, so that no normal load on the
    /// surface can detect them.
    ///
    /// Under a given pressure the stresses depend on `1/E*` of each body, `E* = E/(1 − ν²)`, and on the differences of
    /// `1/(2G)` between bodies that are bonded or joined by springs. A common change of `1/(2G)` adds the gradient of
    /// Airy's function to the displacements, and its normal part is zero on a surface without shear traction. So there
    /// is one direction for each block of bodies between frictionless interfaces, but none for a block bonded to a
    /// rigid base (Dundurs 1967 for two bodies; Cherkaev, Lurie and Milton 1992 for any number).
    ///
    /// ```
    /// use pellicle_kernel::{Foundation, Material};
    ///
    /// let (coating, base) = (Material::new(100e9, 0.25)?, Material::new(10e9, 0.3)?);
    /// let coated = Foundation::coated(0.5e-6, coating, base)?;
    /// // Four elastic constants, of which C(k) determines three numbers.
    /// assert_eq!(coated.null_directions().len(), 1);
    /// # Ok::<(), pellicle_kernel::KernelError>(())
    /// ```
    #[must_use]
    pub fn null_directions(&self) -> Vec<FoundationDirection> {
        let mut directions = Vec::new();
        let mut block = FoundationDirection::new();
        for (body, layer) in self.layers().iter().enumerate() {
            block.extend(shifted(body, layer.material()));
            if layer.interface().is_frictionless() {
                directions.push(std::mem::take(&mut block));
            }
        }
        if let Base::HalfSpace(material) = self.base() {
            block.extend(shifted(self.layers().len(), material));
            directions.push(block);
        }
        directions
    }
}

/// The change of a body's constants that adds t to its `1/(2G) = (1 + ν)/E` at constant `E/(1 − ν²)`, in units of
/// `1/E`.
fn shifted(body: usize, material: Material) -> [(FoundationParameter, f64); 2] {
    let (young, nu) = (material.young_modulus(), material.poisson_ratio());
    // dν = E (1 − ν)/(1 + ν) dt,  dE = −2ν E/(1 − ν²) dν
    let of_ratio = young * (1.0 - nu) / (1.0 + nu);
    let of_modulus = -2.0 * nu * young / ((1.0 - nu) * (1.0 + nu)) * of_ratio;
    [
        (FoundationParameter::YoungModulus { body }, of_modulus),
        (FoundationParameter::PoissonRatio { body }, of_ratio),
    ]
}
