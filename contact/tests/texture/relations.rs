//! Relations that hold exactly: other units, mirrors, a quarter turn. Each random case is certified in all of them.
//!
//! `PELLICLE_RANDOM_CASES=500 cargo test --release -p pellicle-contact texture::relations` for more cases.

use rayon::prelude::*;

use super::*;
use crate::random_cases::random::Random;

const ELEMENTS: usize = 36;
const SIDE: f64 = 0.4;
/// Number of cases in the short form.
const SHORT: u64 = 16;
/// Fine enough that what the solver leaves is below 1e-8 of the numbers.
const TOLERANCE: f64 = 1e-11;

/// A random relief in units of length and modulus, mirrored in y and then turned by so many quarter turns.
#[derive(Clone, Copy)]
struct View {
    length: f64,
    modulus: f64,
    mirrored: bool,
    quarter_turns: u32,
}

const PLAIN: View = View {
    length: 1.0,
    modulus: 1.0,
    mirrored: false,
    quarter_turns: 0,
};

impl View {
    fn place(self, [x, y]: [f64; 2], rotation: f64) -> ([f64; 2], f64) {
        let (mut place, mut rotation) = ([x, y], rotation);
        if self.mirrored {
            (place, rotation) = ([x, -y], -rotation);
        }
        for _ in 0..self.quarter_turns {
            place = [-place[1], place[0]];
        }
        rotation += f64::from(self.quarter_turns) * 0.5 * PI;
        (place.map(|x| x * self.length), rotation)
    }

    /// Penetration, largest pressure and contact area of a random case, in the plain units.
    fn solve(self, seed: u64) -> [f64; 3] {
        let mut random = Random(seed);
        let model = model(
            &Foundation::half_space(Material::new(self.modulus, 0.0).unwrap()),
            self.relief(&mut random),
            Paraboloid::new(self.length).unwrap().into(),
        );
        let options = SolverOptions {
            tolerance: TOLERANCE,
            ..SolverOptions::default()
        };
        let force = 3e-3 * self.modulus * self.length * self.length;
        let domain = Domain::Side(SIDE * self.length);
        let path = solve_path(
            &model,
            domain,
            ELEMENTS,
            &[Load::Force(force)],
            &options,
            &mut (),
        );
        let step = path.unwrap().steps.remove(0);
        assert!(step.solution.certificate.is_satisfied(), "{seed}");
        [
            step.solution.penetration / self.length,
            step.summary.max_pressure / self.modulus,
            step.summary.contact_area / (self.length * self.length),
        ]
    }

    fn relief(self, random: &mut Random) -> Relief {
        let mut part = |from: f64, to: f64| from + (to - from) * random.unit();
        let (period, turn) = (part(0.05, 0.15), part(-1.5, 1.5));
        let (offset, rotation) = self.place([part(-0.1, 0.1), part(-0.1, 0.1)], turn);
        let half_width = period * part(0.15, 0.4);
        let depth = half_width * part(0.02, 0.3);
        let edge_radius = depth * part(0.0, 0.5);
        let (kind, springs) = (part(0.0, 5.0), part(-1.0, 1.0));
        let [period, half_width, depth, edge_radius] =
            [period, half_width, depth, edge_radius].map(|length| length * self.length);
        let modulus = self.modulus * (1.0 + springs.abs());
        let lattice = if springs.abs() > 0.5 {
            Lattice::Hexagonal
        } else {
            Lattice::Square
        };
        let pattern = || {
            Pattern::new(lattice, period, offset)
                .unwrap()
                .turned(rotation)
                .unwrap()
        };
        let groove = |profile| {
            let edge_radius = if profile == GrooveProfile::Sine {
                0.0
            } else {
                edge_radius
            };
            let width = 2.0 * half_width;
            grooves(GrooveSpec {
                profile,
                width,
                depth,
                period,
                offset,
                rotation,
                edge_radius,
            })
        };
        let recesses = if kind < 1.0 {
            let spec = CylinderSpec {
                lattice,
                radius: half_width,
                height: depth,
                period,
                offset,
                young_modulus: modulus,
            };
            let cylinders = Cylinders::new(spec).unwrap().rounded(edge_radius).unwrap();
            return Relief::Cylinders(cylinders.turned(rotation).unwrap());
        } else if kind < 2.0 {
            let dimples = Dimples::new(pattern(), half_width, depth, edge_radius).unwrap();
            RecessShape::Dimples(dimples).into()
        } else if kind < 3.0 {
            groove(GrooveProfile::Rectangular)
        } else if kind < 4.0 {
            groove(GrooveProfile::V)
        } else {
            groove(GrooveProfile::Sine)
        };
        Relief::Recesses(if springs > 0.0 {
            recesses.with_springs(modulus).unwrap()
        } else {
            recesses
        })
    }
}

#[test]
fn units_mirrors_and_quarter_turns_change_nothing() {
    let cases = std::env::var("PELLICLE_RANDOM_CASES");
    let cases = cases.map_or(SHORT, |count| count.parse().unwrap());
    (0..cases).into_par_iter().for_each(|seed| {
        let wanted = PLAIN.solve(seed);
        for view in [
            View {
                length: 2e-6,
                modulus: 7e10,
                ..PLAIN
            },
            View {
                mirrored: true,
                ..PLAIN
            },
            View {
                quarter_turns: 1,
                ..PLAIN
            },
            View {
                mirrored: true,
                quarter_turns: 2,
                ..PLAIN
            },
        ] {
            let found = view.solve(seed);
            for (found, wanted) in found.iter().zip(wanted) {
                assert!(
                    (found / wanted - 1.0).abs() < 1e-8,
                    "{seed}: {found} {wanted}"
                );
            }
        }
    });
}
