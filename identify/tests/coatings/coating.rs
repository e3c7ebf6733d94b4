//! A coating under a ball, and its curve.

use pellicle_contact::{Model, ModelParameter, Paraboloid};
use pellicle_identify::{ContactCurve, ContactCurves, CurveOptions, Observable};
use pellicle_influence::{Cache, ElasticBodies, ElasticParameter};
use pellicle_kernel::{Foundation, FoundationParameter, Material};
use pellicle_texture::Relief;

/// The thickness of the coating, as a parameter.
pub const THICKNESS: ModelParameter = ModelParameter::Elastic(ElasticParameter::Foundation(
    FoundationParameter::Thickness { layer: 0 },
));

/// A coating on a base under a ball: forces over two decades.
#[derive(Debug, Clone, Copy)]
pub struct Coating {
    /// Young's modulus and Poisson's ratio of the coating.
    pub layer: (f64, f64),
    /// Young's modulus and Poisson's ratio of the base.
    pub base: (f64, f64),
    pub thickness: f64,
    pub radius: f64,
    pub least_force: f64,
    /// Number of forces.
    pub points: u32,
}

/// A coating of 100 GPa and 0.25, half a micrometre thick, on 10 GPa and 0.3, under a ball of ten micrometres.
pub fn coating(least_force: f64) -> Coating {
    Coating {
        layer: (100e9, 0.25),
        base: (10e9, 0.3),
        thickness: 0.5e-6,
        radius: 10e-6,
        least_force,
        points: 24,
    }
}

impl Coating {
    pub fn forces(&self) -> Vec<f64> {
        let last = f64::from(self.points - 1);
        (0..self.points)
            .map(|i| self.least_force * 100_f64.powf(f64::from(i) / last))
            .collect()
    }

    /// Moduli of coating and base, and thickness.
    pub fn truth(&self) -> [f64; 3] {
        [self.layer.0, self.base.0, self.thickness]
    }

    /// The curve with the first `unknowns` of these as parameters.
    pub fn curves(&self, unknowns: usize) -> ContactCurves {
        let all = [young_modulus(0), young_modulus(1), THICKNESS];
        self.curves_of(&all[..unknowns])
    }

    /// The curve with these parameters.
    pub fn curves_of(&self, sought: &[ModelParameter]) -> ContactCurves {
        let [upper, lower] = [self.layer, self.base].map(|(e, nu)| Material::new(e, nu).unwrap());
        let bodies: ElasticBodies = Foundation::coated(self.thickness, upper, lower)
            .unwrap()
            .into();
        let cache = Cache::of_shapes();
        let model = Model {
            tables: cache.radial_tables_of(&bodies).unwrap().value,
            relief: Relief::Bare,
            indenter: Paraboloid::new(self.radius).unwrap().into(),
            cache,
        };
        let curve = ContactCurve {
            model,
            observable: Observable::DepthAtForce,
            abscissae: self.forces(),
            own: Vec::new(),
            origins: Vec::new(),
            thinned: None,
            adhesion: None,
            series: 0.0,
        };
        ContactCurves::new(vec![curve], sought.to_vec(), CurveOptions::default()).unwrap()
    }
}

pub fn young_modulus(body: usize) -> ModelParameter {
    ModelParameter::Elastic(ElasticParameter::Foundation(
        FoundationParameter::YoungModulus { body },
    ))
}
