//! Random cases of what people make and press: rounded pillars, dimples, grooves, ellipses, two coated bodies.

use std::f64::consts::PI;

use pellicle_contact::{Cone, EllipticParaboloid, FlatPunch, Indenter, Sphere};
use pellicle_influence::ElasticBodies;
use pellicle_kernel::{Base, Foundation, Interface, Layer};
use pellicle_texture::{
    CylinderSpec, Cylinders, Dimples, GrooveProfile, GrooveSpec, Grooves, Lattice, Pattern,
    RecessShape, Recesses, Relief,
};

use super::case::{Case, Draw, Units};
use super::random::Random;
use super::view::View;

/// Ratios of the radii of an ellipse.
const RATIOS: [f64; 2] = [1.0, 50.0];
/// Share of a period that a pattern covers across.
const PARTS: [f64; 2] = [0.2, 0.9];
/// Depths over half widths.
const DEPTHS: [f64; 2] = [1e-3, 0.3];

impl Case {
    /// The case of a seed on at most `most` elements per side, seen in some way.
    pub fn draw_made(seed: u64, most: usize, view: View) -> Self {
        let random = Random(seed.wrapping_mul(0x2545_f491_4f6c_dd1d) ^ 0x3a8e);
        let mut draw = Draw::new(random, view.units);
        draw.scales();
        let foundation = draw.foundation();
        let body = (draw.random.below(3) == 0).then(|| draw.foundation());
        let foundation = if view.is_split {
            split(&foundation, draw.side)
        } else {
            foundation
        };
        let bodies = match body {
            Some(body) => ElasticBodies::new(foundation, body),
            None => foundation.into(),
        };
        let relief = draw.pattern(view);
        let indenter = draw.round_tip(view);
        let case = draw.under_load(bodies, relief, indenter, most);
        Self {
            bodies: if view.is_swapped {
                case.bodies.swapped()
            } else {
                case.bodies
            },
            ..case
        }
    }
}

/// The same foundation with its top in two parts; that of a half-space is a part of this thickness.
fn split(foundation: &Foundation, thickness: f64) -> Foundation {
    let bonded = |thickness, material| Layer::new(thickness, material, Interface::Bonded).unwrap();
    let mut layers = foundation.layers().to_vec();
    match (layers.first().copied(), foundation.base()) {
        (Some(top), _) => {
            let part = 0.3 * top.thickness();
            layers[0] =
                Layer::new(top.thickness() - part, top.material(), top.interface()).unwrap();
            layers.insert(0, bonded(part, top.material()));
        }
        (None, Base::HalfSpace(material)) => layers.push(bonded(thickness, material)),
        (None, Base::Rigid) => {}
    }
    Foundation::new(layers, foundation.base()).unwrap()
}

impl Draw {
    /// A number between two, evenly.
    fn between(&mut self, [low, high]: [f64; 2]) -> f64 {
        low + (high - low) * self.random.unit()
    }

    fn pattern(&mut self, view: View) -> Relief {
        let period = self.length(0.05, 0.6);
        let place = [self.random.unit(), self.random.unit()];
        let turn = self.between([-1.5, 1.5]);
        // Half of the patterns are symmetric, which a quadrant is solved for.
        let (place, turn) = [(place, turn), ([0.0; 2], 0.0)][self.random.below(2)];
        let (offset, rotation) = view.placed(place.map(|part| part * period), turn);
        let half_width = 0.5 * period * self.between(PARTS);
        let depth = half_width * self.random.decades(DEPTHS[0], DEPTHS[1]);
        let edge_radius = depth * self.random.unit() * 0.5 * self.random.below(2) as f64;
        let young_modulus = self.any_modulus();
        let lattice = [Lattice::Square, Lattice::Hexagonal][self.random.below(2)];
        let has_springs = self.random.below(2) == 0;
        let recesses = match self.random.below(6) {
            0 => return Relief::Bare,
            1 => {
                let spec = CylinderSpec {
                    lattice,
                    radius: half_width,
                    height: depth,
                    period,
                    offset,
                    young_modulus,
                };
                let cylinders = Cylinders::new(spec).unwrap().rounded(edge_radius).unwrap();
                return Relief::Cylinders(cylinders.turned(rotation).unwrap());
            }
            2 => {
                let pattern = Pattern::new(lattice, period, offset).unwrap();
                let pattern = pattern.turned(rotation).unwrap();
                let dimples = Dimples::new(pattern, half_width, depth, edge_radius);
                Recesses::from(RecessShape::Dimples(dimples.unwrap()))
            }
            kind => {
                let profiles = [
                    (GrooveProfile::Rectangular, edge_radius),
                    (GrooveProfile::V, edge_radius),
                    (GrooveProfile::Sine, 0.0),
                ];
                let (profile, edge_radius) = profiles[kind - 3];
                let spec = GrooveSpec {
                    profile,
                    width: 2.0 * half_width,
                    depth,
                    period,
                    offset,
                    rotation,
                    edge_radius,
                };
                RecessShape::Grooves(Grooves::new(spec).unwrap()).into()
            }
        };
        Relief::Recesses(if has_springs {
            recesses.with_springs(young_modulus).unwrap()
        } else {
            recesses
        })
    }

    /// An ellipse in most cases, else another indenter that a quarter turn does not change.
    fn round_tip(&mut self, view: View) -> Indenter {
        let radius = self.length(0.3, 30.0);
        let ratio = self.random.decades(RATIOS[0], RATIOS[1]);
        let (angle, part) = (self.between([0.2, 1.55]), self.between([0.1, 0.48]));
        match self.random.below(6) {
            0 => Sphere::new(radius).unwrap().into(),
            1 => Cone::new(angle, 0.0).unwrap().into(),
            2 => FlatPunch::new(part * self.side).unwrap().into(),
            kind => {
                let radii = [[radius, ratio * radius], [ratio * radius, radius]][kind % 2];
                EllipticParaboloid::new(View::along(radii, view))
                    .unwrap()
                    .into()
            }
        }
    }
}

/// Area fraction and ratio of the radii of the cases of some seeds, for a look at what is drawn.
#[test]
fn what_is_drawn_covers_what_people_make() {
    let units = Units {
        length: 1.0,
        modulus: 1.0,
    };
    let cases = (0..200).map(|seed| Case::draw_made(seed, 34, View::plain(units)));
    let (mut fractions, mut ratios, mut pairs) = ([1.0_f64, 0.0_f64], 1.0_f64, 0);
    for case in cases {
        let fraction = case.relief.area_fraction();
        if fraction > 0.0 && fraction < 1.0 {
            fractions = [fractions[0].min(fraction), fractions[1].max(fraction)];
        }
        if let Indenter::EllipticParaboloid(ellipse) = &case.indenter {
            let [x, y] = ellipse.radii();
            ratios = ratios.max(x / y).max(y / x);
        }
        pairs += u64::from(!case.bodies.counterbody().is_rigid());
    }
    assert!(
        fractions[0] < 0.05 && fractions[1] > PI / 4.0 * 0.81,
        "{fractions:?}"
    );
    assert!(
        ratios > 30.0 && (40..100).contains(&pairs),
        "{ratios} {pairs}"
    );
}
