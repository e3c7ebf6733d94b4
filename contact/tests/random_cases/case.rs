//! Random cases as a user might write them: every kind of body, relief, indenter and load, from nanometres to metres
//! and from kilopascals to terapascals.

use std::sync::Arc;

use pellicle_contact::{
    Cone, ContactError, Domain, FlatPunch, Indenter, IndenterMap, Load, LoadingPath, Model,
    Paraboloid, Pyramid, Sliding, SolverOptions, Sphere, solve_path,
};
use pellicle_influence::{Cache, ElasticBodies, RadialTables};
use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};
use pellicle_texture::{
    CylinderSpec, Cylinders, Film, HeightMap, Lattice, MapCompliance, Relief, ReliefMap,
};

use super::random::Random;

/// Moduli, in Pa.
const MODULI: [f64; 2] = [1e3, 1e12];
/// Sides of the square, in m.
const SIDES: [f64; 2] = [1e-8, 1.0];
/// Half of the elements per side of the smallest grid.
const SMALLEST_HALF: usize = 6;
/// Samples of a map along one side.
const SAMPLES: usize = 24;

/// Factors on lengths and moduli: the same case in other units.
#[derive(Debug, Clone, Copy)]
pub struct Units {
    pub length: f64,
    pub modulus: f64,
}

/// A case without its tables.
#[derive(Debug, Clone)]
pub struct Case {
    pub bodies: ElasticBodies,
    pub relief: Relief,
    pub indenter: Indenter,
    pub domain: Domain,
    pub elements: usize,
    pub load: Load,
}

impl Case {
    /// The case of a seed on at most `most` elements per side.
    pub fn draw(seed: u64, most: usize, units: Units) -> Self {
        let random = Random(seed.wrapping_mul(0x2545_f491_4f6c_dd1d) ^ 0x9e37);
        Draw::new(random, units).case(most)
    }

    /// The case of a seed with up to eight layers and the sliding of its indenter.
    pub fn draw_sliding(seed: u64, most: usize) -> (Self, Sliding) {
        let units = Units {
            length: 1.0,
            modulus: 1.0,
        };
        let random = Random(seed.wrapping_mul(0x2545_f491_4f6c_dd1d) ^ 0x51a5);
        let mut draw = Draw::new(random, units);
        let sliding = Sliding {
            friction: 2.0 * draw.random.unit() * f64::from(u8::from(draw.random.below(3) > 0)),
            direction: std::f64::consts::TAU * draw.random.unit(),
        };
        let mut case = draw.case(most);
        case.bodies = draw.layered(9).into();
        (case, sliding)
    }

    /// The model, with its tables.
    pub fn model(&self) -> Result<Model, ContactError> {
        Ok(Model {
            tables: Arc::new(RadialTables::of_bodies(&self.bodies)?),
            relief: self.relief.clone(),
            indenter: self.indenter.clone(),
            cache: Cache::none(),
        })
    }

    /// Solves the case.
    pub fn solve(&self, options: &SolverOptions) -> Result<LoadingPath, ContactError> {
        let (model, loads) = (self.model()?, [self.load]);
        solve_path(&model, self.domain, self.elements, &loads, options, &mut ())
    }
}

/// A case that is being drawn: its side and the modulus of its deepest body in the wanted units.
pub struct Draw {
    pub random: Random,
    pub side: f64,
    modulus: f64,
    units: Units,
}

impl Draw {
    pub fn new(random: Random, units: Units) -> Self {
        Self {
            random,
            side: 0.0,
            modulus: 0.0,
            units,
        }
    }

    fn case(&mut self, most: usize) -> Case {
        self.scales();
        let foundation = self.foundation();
        let relief = self.relief();
        let indenter = self.indenter();
        self.under_load(foundation.into(), relief, indenter, most)
    }

    pub fn scales(&mut self) {
        self.side = self.units.length * self.random.decades(SIDES[0], SIDES[1]);
        self.modulus = self.units.modulus * self.random.decades(MODULI[0], MODULI[1]);
    }

    /// The case with a load, a domain and a grid.
    pub fn under_load(
        &mut self,
        bodies: ElasticBodies,
        relief: Relief,
        indenter: Indenter,
        most: usize,
    ) -> Case {
        let depth = self.length(1e-6, 3e-2);
        let load = if self.random.below(3) == 0 {
            Load::Penetration(depth)
        } else {
            // This force presses the whole square to this depth or less.
            let compliance = bodies.compliance(1.0 / self.side);
            Load::Force(self.side * self.side * depth / compliance)
        };
        let domain = if self.random.below(4) == 0 {
            Domain::Automatic
        } else {
            Domain::Side(self.side)
        };
        let half = SMALLEST_HALF + self.random.below(most / 2 - SMALLEST_HALF);
        Case {
            bodies,
            relief,
            indenter,
            domain,
            elements: 2 * half + self.random.below(2),
            load,
        }
    }

    /// A length in units of the side.
    pub fn length(&mut self, low: f64, high: f64) -> f64 {
        self.side * self.random.decades(low, high)
    }

    /// A modulus within three decades of the base's, or any in the range.
    pub fn any_modulus(&mut self) -> f64 {
        let [low, high] = MODULI.map(|modulus| modulus * self.units.modulus);
        if self.random.below(4) == 0 {
            self.random.decades(low, high)
        } else {
            (self.modulus * self.random.decades(1e-3, 1e3)).clamp(low, high)
        }
    }

    fn material(&mut self, modulus: f64) -> Material {
        let any = 0.5 * self.random.unit();
        let poisson_ratio = [0.0, 0.3, 0.49, 0.5, any, any][self.random.below(6)];
        Material::new(modulus, poisson_ratio).unwrap()
    }

    /// Up to three layers, some sliding, on a half-space or a rigid base.
    pub fn foundation(&mut self) -> Foundation {
        self.layered(4)
    }

    /// Fewer layers than this, some sliding, on a half-space or a rigid base.
    fn layered(&mut self, fewer: usize) -> Foundation {
        let count = self.random.below(fewer);
        let mut layers = Vec::new();
        for _ in 0..count {
            let modulus = self.any_modulus();
            let material = self.material(modulus);
            let interface = [
                Interface::Bonded,
                Interface::Bonded,
                Interface::Frictionless,
            ][self.random.below(3)];
            layers.push(Layer::new(self.length(1e-3, 3.0), material, interface).unwrap());
        }
        let base = if count > 0 && self.random.below(6) == 0 {
            Base::Rigid
        } else {
            Base::HalfSpace(self.material(self.modulus))
        };
        Foundation::new(layers, base).unwrap()
    }

    fn relief(&mut self) -> Relief {
        let (height, modulus) = (self.length(1e-5, 1e-1), self.any_modulus());
        match self.random.below(6) {
            0 | 1 => Relief::Bare,
            2 => Relief::Film(Film::new(height, modulus).unwrap()),
            3 => {
                let compliance = match self.random.below(3) {
                    0 => MapCompliance::Uniform(0.0),
                    1 => MapCompliance::Uniform(height / modulus),
                    _ => MapCompliance::YoungModulus(modulus),
                };
                let heights = self.roughness(0.1 * height);
                let map = HeightMap::new(heights, [SAMPLES; 2], [self.side; 2]).unwrap();
                Relief::Map(ReliefMap::new(map, compliance).unwrap())
            }
            kind => Relief::Cylinders(self.cylinders(height, modulus, kind - 4)),
        }
    }

    fn cylinders(&mut self, height: f64, young_modulus: f64, lattice: usize) -> Cylinders {
        let period = self.length(0.05, 0.6);
        let somewhere = [self.random.unit(), self.random.unit()].map(|part| part * period);
        let spec = CylinderSpec {
            lattice: [Lattice::Square, Lattice::Hexagonal][lattice],
            radius: period * (0.15 + 0.35 * self.random.unit()),
            height,
            period,
            offset: [[0.0; 2], somewhere][self.random.below(2)],
            young_modulus,
        };
        Cylinders::new(spec).unwrap()
    }

    /// Heights of a map: a few waves with random phases.
    fn roughness(&mut self, height: f64) -> Vec<f64> {
        let waves: Vec<[f64; 3]> = (0..6)
            .map(|_| [7.0, 7.0, 6.0].map(|most| most * self.random.unit()))
            .collect();
        let at = |k: usize| k as f64 / SAMPLES as f64;
        let wave = |x: f64, y: f64, [a, b, phase]: [f64; 3]| (6.0 * (a * x + b * y) + phase).cos();
        (0..SAMPLES * SAMPLES)
            .map(|k| [at(k / SAMPLES), at(k % SAMPLES)])
            .map(|[x, y]| height * waves.iter().map(|w| wave(x, y, *w)).sum::<f64>())
            .collect()
    }

    fn indenter(&mut self) -> Indenter {
        let (radius, angle) = (self.length(0.3, 30.0), 0.2 + 1.35 * self.random.unit());
        let tip = self.length(1e-3, 1.0) * f64::from(u8::from(self.random.below(2) == 0));
        match self.random.below(7) {
            0 | 1 => Paraboloid::new(radius).unwrap().into(),
            2 => Sphere::new(radius).unwrap().into(),
            3 => Cone::new(angle, tip).unwrap().into(),
            4 => {
                let faces = 3 + self.random.below(6);
                Pyramid::new(faces, angle, tip).unwrap().into()
            }
            5 => {
                let part = 0.1 + 0.38 * self.random.unit();
                FlatPunch::new(part * self.side).unwrap().into()
            }
            _ => {
                let rough = self.length(1e-6, 1e-3);
                let extent = self.side * (0.3 + 0.9 * self.random.unit());
                let mut heights = self.roughness(rough);
                let at = |k: usize| ((k as f64 + 0.5) / SAMPLES as f64 - 0.5) * extent;
                for (k, height) in heights.iter_mut().enumerate() {
                    let [x, y] = [at(k / SAMPLES), at(k % SAMPLES)];
                    *height += (x * x + y * y) / (2.0 * radius);
                }
                IndenterMap::new(HeightMap::new(heights, [SAMPLES; 2], [extent; 2]).unwrap()).into()
            }
        }
    }
}
