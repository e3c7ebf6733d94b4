//! Approach and retraction of an indenter that sticks: a forward model whose last unknown is the work of adhesion.
//!
//! The contacts with adhesion are solved at a few radii `a` from the end of the stable branch to the largest abscissa.
//! Through `F` and `D` at these, and their derivatives by the unknowns at constant a, lie polynomials in `ln a`. At an
//! abscissa `F`, with subscripts for derivatives:
//!
//! ```text
//! dD/dF = D_a/F_a      ∂D/∂θ = D_θ − F_θ dD/dF
//! ```
//!
//! and the same with `F` and `D` exchanged at an abscissa `D`.

use std::f64::consts::PI;

use pellicle_contact::ContactError;
use pellicle_contact::adhesion::{Adhesion, AdhesionLaw, AdhesiveContact, AdhesiveCurve};
use pellicle_contact::axisymmetric::{AxisymmetricElasticity, AxisymmetricProfile};
use pellicle_influence::{ElasticBodies, ElasticParameter};

use crate::{ForwardError, ForwardModel, Prediction};

/// Contacts per curve: force and penetration are smooth in `ln a`, and the polynomials exact to 1e-9
/// (`a_retraction_is_the_branch_of_the_curve`).
const CONTACTS: usize = 24;

/// Relative step of an elastic parameter; the error of a difference is its square.
const STEP: f64 = 1e-4;

/// The smallest radius over the largest: below, penetrations are a millionth of the largest.
const SMALLEST: f64 = 1e-3;

/// Halvings that find a point on a polynomial to rounding.
const HALVINGS: u32 = 60;

/// What a retraction prescribes, and what it measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Control {
    /// Penetrations (m) at forces (N), down to the pull-off force.
    Force,
    /// Forces (N) at penetrations (m), down to the least penetration.
    Penetration,
}

/// The stable branch of an adhesive contact, as a [`ForwardModel`] of the elastic parameters `sought`, in their order,
/// then of the work of adhesion (J/m²).
///
/// On approach the surfaces meet at no penetration and no force; points before that do not belong here.
#[derive(Debug, Clone)]
pub struct Retraction {
    /// The bodies, with the values of parameters that are not sought.
    pub bodies: ElasticBodies,
    /// The indenter.
    pub profile: AxisymmetricProfile,
    /// Where adhesion acts.
    pub law: AdhesionLaw,
    /// The elastic parameters sought.
    pub sought: Vec<ElasticParameter>,
    /// What is prescribed.
    pub control: Control,
    /// The forces (N) or penetrations (m) of the points.
    pub abscissae: Vec<f64>,
}

/// Force and penetration.
type Pair = [f64; 2];

impl Retraction {
    fn bodies_at(&self, values: &[f64]) -> Result<ElasticBodies, ContactError> {
        let pairs = self.sought.iter().zip(values);
        let mut bodies = self.bodies.clone();
        for (parameter, value) in pairs {
            bodies = bodies.with_parameter(*parameter, *value)?;
        }
        Ok(bodies)
    }

    fn contact(
        &self,
        bodies: &ElasticBodies,
        adhesion: Adhesion,
        radii: &[f64],
    ) -> Result<Vec<AdhesiveContact>, ContactError> {
        let elasticity = AxisymmetricElasticity::new(bodies);
        let at = |radius: &f64| AdhesiveContact::of(&elasticity, self.profile, adhesion, *radius);
        radii.iter().map(at).collect()
    }

    /// The radii of the branch that the abscissae need, smallest and largest, m.
    fn range(&self, curve: &AdhesiveCurve) -> Result<[f64; 2], ContactError> {
        let largest = self
            .abscissae
            .iter()
            .copied()
            .fold(f64::NEG_INFINITY, f64::max);
        let smallest = self.abscissae.iter().copied().fold(f64::INFINITY, f64::min);
        match self.control {
            Control::Force => Ok([
                curve.at_force(smallest)?.radius,
                curve.at_force(largest)?.radius,
            ]),
            Control::Penetration => {
                let last = curve.last_contact().penetration;
                let at = |penetration| match curve.at_penetration(penetration)? {
                    Some(contact) => Ok(contact.radius),
                    None => Err(ContactError::BeyondLastContact { penetration, last }),
                };
                Ok([at(smallest)?, at(largest)?])
            }
        }
    }

    fn predicted(&self, parameters: &[f64]) -> Result<Prediction, ContactError> {
        let (work, values) = match parameters.split_last() {
            Some((work, values)) => (*work, values),
            None => (f64::NAN, parameters),
        };
        let (bodies, adhesion) = (
            self.bodies_at(values)?,
            Adhesion {
                work,
                law: self.law,
            },
        );
        let curve =
            AdhesiveCurve::new(AxisymmetricElasticity::new(&bodies), self.profile, adhesion)?;
        let nodes = Nodes::between(self.range(&curve)?);
        let contacts = self.contact(&bodies, adhesion, &nodes.radii)?;
        let pair = |of: &AdhesiveContact| [of.force, of.penetration];
        let mut columns: Vec<Vec<Pair>> = Vec::new();
        for (index, value) in values.iter().enumerate() {
            let at = |factor: f64| {
                let mut changed = values.to_vec();
                changed[index] *= factor;
                self.contact(&self.bodies_at(&changed)?, adhesion, &nodes.radii)
            };
            let (more, less) = (at(1.0 + STEP)?, at(1.0 - STEP)?);
            let slopes = more.iter().zip(&less).map(|(more, less)| {
                let (more, less) = (pair(more), pair(less));
                [0, 1].map(|i| (more[i] - less[i]) / (2.0 * STEP * value))
            });
            columns.push(slopes.collect());
        }
        // F − F₀ and D − D₀ are in proportion to √w by JKR and to w by DMT.
        let power = match self.law {
            AdhesionLaw::Jkr => 0.5,
            AdhesionLaw::Dmt => 1.0,
        };
        let by_work = |of: &AdhesiveContact| {
            [
                of.force - of.force_without,
                of.penetration - of.penetration_without,
            ]
            .map(|change| power * change / work)
        };
        columns.push(contacts.iter().map(by_work).collect());
        let branch: Vec<Pair> = contacts.iter().map(pair).collect();
        Ok(self.read(&nodes, &branch, &columns))
    }

    /// Reads the points off the polynomials.
    fn read(&self, nodes: &Nodes, branch: &[Pair], columns: &[Vec<Pair>]) -> Prediction {
        let (given, wanted) = match self.control {
            Control::Force => (0, 1),
            Control::Penetration => (1, 0),
        };
        let mut found = Prediction {
            derivatives: vec![Vec::new(); columns.len()],
            ..Prediction::default()
        };
        for abscissa in &self.abscissae {
            let place = nodes.where_reached(|weights| sum(weights, branch)[given] - abscissa);
            let weights = nodes.weights(place);
            let slope = nodes.slope(place, branch);
            let slope = slope[wanted] / slope[given];
            found.value.push(sum(&weights, branch)[wanted]);
            found.slope.push(slope);
            for (to, column) in found.derivatives.iter_mut().zip(columns) {
                let change = sum(&weights, column);
                to.push(change[wanted] - change[given] * slope);
            }
        }
        found
    }
}

impl ForwardModel for Retraction {
    fn predict(&self, parameters: &[f64]) -> Result<Prediction, ForwardError> {
        Ok(self.predicted(parameters)?)
    }
}

/// Chebyshev's points in the logarithm of the radius.
struct Nodes {
    /// Radii, m.
    radii: Vec<f64>,
    /// Points in [−1, 1], ascending.
    places: Vec<f64>,
}

impl Nodes {
    /// Over these radii (m), but not down to 0, where DMT ends, nor less than a hundredth apart.
    fn between([first, last]: [f64; 2]) -> Self {
        let last = last.max(1.01 * first);
        let first = first.max(SMALLEST * last);
        let step = PI / (CONTACTS - 1) as f64;
        let places: Vec<f64> = (0..CONTACTS).map(|i| -(i as f64 * step).cos()).collect();
        let radii = places
            .iter()
            .map(|place| first * (last / first).powf(0.5 * (1.0 + place)));
        Self {
            radii: radii.collect(),
            places,
        }
    }

    /// Barycentric weights of the values at the nodes, for the polynomial at a place.
    fn weights(&self, place: f64) -> Vec<f64> {
        if let Some(at) = self
            .places
            .iter()
            .position(|node| node.total_cmp(&place).is_eq())
        {
            let mut weights = vec![0.0; CONTACTS];
            weights[at] = 1.0;
            return weights;
        }
        // (−1)ʲ/(x − xⱼ), half at the ends
        let weight = |(j, node): (usize, &f64)| {
            let sign = if j % 2 == 0 { 1.0 } else { -1.0 };
            let share = if j == 0 || j == CONTACTS - 1 {
                0.5
            } else {
                1.0
            };
            sign * share / (place - node)
        };
        let weights: Vec<f64> = self.places.iter().enumerate().map(weight).collect();
        let sum: f64 = weights.iter().sum();
        weights.into_iter().map(|weight| weight / sum).collect()
    }

    /// The derivative of a polynomial by the place, by a difference, at the ends also from just beyond.
    fn slope(&self, place: f64, values: &[Pair]) -> Pair {
        let step = 1e-5;
        let [less, more] =
            [place - step, place + step].map(|place| sum(&self.weights(place), values));
        [0, 1].map(|i| (more[i] - less[i]) / (2.0 * step))
    }

    /// The place at which an increasing quantity is 0.
    fn where_reached(&self, excess: impl Fn(&[f64]) -> f64) -> f64 {
        let (mut low, mut high) = (-1.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(low, high);
            if excess(&self.weights(middle)) < 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        f64::midpoint(low, high)
    }
}

/// The polynomial through some values.
fn sum(weights: &[f64], values: &[Pair]) -> Pair {
    let terms = weights.iter().zip(values);
    terms.fold([0.0; 2], |[force, penetration], (weight, value)| {
        [force + weight * value[0], penetration + weight * value[1]]
    })
}
