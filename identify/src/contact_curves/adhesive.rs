//! Contact with adhesion, without a grid: the stable branch from the jump-out on.
//!
//! The contacts are solved at a few radii `a` from the end of the branch to the largest abscissa. Through `F` and `D`
//! at these, and their derivatives by the unknowns at constant a, lie polynomials in `ln a`. At an abscissa `F`, with
//! subscripts for derivatives:
//!
//! ```text
//! dD/dF = D_a/F_a      ∂D/∂θ = D_θ − F_θ dD/dF
//! ```
//!
//! and at an approach `z = D + c F` of the end of a compliance c in series the same with `F` and `z` exchanged.
//! Before the end of the branch the curve goes on along its tangent, so that a search whose values let go too early
//! finds its way.

use std::f64::consts::PI;

use pellicle_contact::adhesion::{Adhesion, AdhesionLaw, AdhesiveContact, AdhesiveCurve};
use pellicle_contact::axisymmetric::{AxisymmetricElasticity, AxisymmetricProfile};
use pellicle_contact::{ContactError, Model, ModelParameter};
use pellicle_influence::ElasticBodies;

use super::curve::{ContactCurve, Reading};
use crate::Prediction;

/// Contacts per curve: force and penetration are smooth in `ln a`, and the polynomials exact to 1e-9
/// (`a_retraction_is_the_branch_of_the_curve`).
const CONTACTS: usize = 24;

/// The branch begins at this multiple of the radius at its end, where it has a slope; by JKR on a half-space the force
/// there is 0.6 % above that of the pull-off.
const FIRST: f64 = 1.05;

/// Relative step of a parameter; the error of a difference is its square.
const STEP: f64 = 1e-4;

/// The smallest radius over the largest: below, penetrations are a millionth of the largest.
const SMALLEST: f64 = 1e-3;

/// Halvings that find a point on a polynomial to rounding.
const HALVINGS: u32 = 60;

/// What an adhesive contact is made of.
#[derive(Debug, Clone)]
pub struct AdhesiveModel {
    /// The relief and the indenter; its radial tables, which nothing here needs, are those of the first bodies.
    model: Model,
    bodies: ElasticBodies,
    adhesion: Adhesion,
}

/// Force, N, and penetration, m, or approach of the end of a compliance.
type Pair = [f64; 2];

impl AdhesiveModel {
    /// The model of a curve with other values of some numbers; none if the curve has no adhesion.
    pub fn of(
        curve: &ContactCurve,
        values: &[(ModelParameter, f64)],
    ) -> Result<Option<Self>, ContactError> {
        let Some(adhesion) = curve.adhesion else {
            return Ok(None);
        };
        let given = Self {
            model: curve.model.clone(),
            bodies: curve.model.tables.bodies().clone(),
            adhesion,
        };
        let mut pairs = values.iter().copied();
        let found = pairs.try_fold(given, |model, (of, value)| model.with(of, value));
        found.map(Some)
    }

    fn value(&self, parameter: ModelParameter) -> Option<f64> {
        match parameter {
            ModelParameter::Elastic(of) => self.bodies.parameter(of),
            ModelParameter::WorkOfAdhesion => Some(self.adhesion.work),
            _ => self.model.parameter(parameter),
        }
    }

    fn with(mut self, parameter: ModelParameter, value: f64) -> Result<Self, ContactError> {
        match parameter {
            ModelParameter::Elastic(of) => self.bodies = self.bodies.with_parameter(of, value)?,
            ModelParameter::WorkOfAdhesion => self.adhesion.work = value,
            _ => self.model = self.model.with_parameter(parameter, value)?,
        }
        Ok(self)
    }

    fn profile(&self) -> Result<AxisymmetricProfile, ContactError> {
        AxisymmetricProfile::of(&self.model.indenter).ok_or(ContactError::NotAxisymmetric)
    }

    fn elasticity(&self) -> Result<AxisymmetricElasticity, ContactError> {
        AxisymmetricElasticity::new(&self.bodies)
            .on_relief(&self.model.relief)
            .ok_or(ContactError::NotAxisymmetric)
    }

    /// The curve of its contacts.
    pub fn curve(&self) -> Result<AdhesiveCurve, ContactError> {
        AdhesiveCurve::new(self.elasticity()?, self.profile()?, self.adhesion)
    }

    fn contacts(&self, radii: &[f64]) -> Result<Vec<AdhesiveContact>, ContactError> {
        let (elasticity, profile) = (self.elasticity()?, self.profile()?);
        let at = |radius: &f64| AdhesiveContact::of(&elasticity, profile, self.adhesion, *radius);
        radii.iter().map(at).collect()
    }

    /// The readings at these abscissae, and their derivatives by the numbers sought; `series` as in [`ContactCurve`].
    pub fn predicted(
        &self,
        abscissa: Reading,
        (abscissae, series): (&[f64], f64),
        sought: &[ModelParameter],
    ) -> Result<Prediction, ContactError> {
        // A depth at a force is that of the contact alone, however it was measured.
        let compliance = match abscissa {
            Reading::Force => 0.0,
            _ => series,
        };
        let (nodes, _) = self.nodes(abscissa, (abscissae, compliance))?;
        let pair = |of: &AdhesiveContact| [of.force, of.penetration + compliance * of.force];
        let contacts = self.contacts(&nodes.radii)?;
        let branch: Vec<Pair> = contacts.iter().map(pair).collect();
        let column = |parameter: &ModelParameter| match parameter {
            ModelParameter::WorkOfAdhesion => Ok(self.by_work(&contacts, compliance)),
            _ => self.by(*parameter, &nodes, pair),
        };
        let columns: Vec<Vec<Pair>> = sought.iter().map(column).collect::<Result<_, _>>()?;
        let mut found = nodes.read(abscissa, abscissae, (&branch, &columns));
        if abscissa == Reading::Force {
            found.slope.iter_mut().for_each(|slope| *slope += series);
        }
        Ok(found)
    }

    /// The forces (N) without adhesion of the contacts of the same radii at the points of a curve; none beyond the end
    /// of the branch.
    pub fn forces_without(
        &self,
        of: &ContactCurve,
        abscissae: &[f64],
    ) -> Result<Vec<Option<f64>>, ContactError> {
        let abscissa = of.observable.abscissa();
        let (given, compliance) = match abscissa {
            Reading::Force => (0, 0.0),
            _ => (1, of.series),
        };
        let (nodes, end) = self.nodes(abscissa, (abscissae, compliance))?;
        let pair = |of: &AdhesiveContact| [of.force, of.penetration + compliance * of.force];
        let contacts = self.contacts(&nodes.radii)?;
        let branch: Vec<Pair> = contacts.iter().map(pair).collect();
        let without: Vec<Pair> = contacts.iter().map(|of| [of.force_without; 2]).collect();
        let at = |abscissa: &f64| {
            let place = nodes.where_reached(|weights| sum(weights, &branch)[given] - abscissa);
            let force = sum(&nodes.weights(place), &without)[0];
            (*abscissa >= pair(&end)[given]).then_some(force)
        };
        Ok(abscissae.iter().map(at).collect())
    }

    /// Radii of the branch that the abscissae need, and the contact at its end.
    fn nodes(
        &self,
        abscissa: Reading,
        (abscissae, compliance): (&[f64], f64),
    ) -> Result<(Nodes, AdhesiveContact), ContactError> {
        let curve = self.curve()?;
        let largest = abscissae.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let (end, last) = if abscissa == Reading::Force {
            let end = curve.pull_off();
            (end, curve.at_force(largest.max(end.force))?)
        } else {
            let curve = curve.behind_spring(compliance)?;
            let end = curve.last_contact();
            (end, curve.at_penetration(largest)?.unwrap_or(end))
        };
        Ok((Nodes::between([FIRST * end.radius, last.radius]), end))
    }

    /// Force and approach by the work of adhesion: `F − F₀` and `D − D₀` are in proportion to `√w` by JKR and to w by
    /// DMT.
    fn by_work(&self, contacts: &[AdhesiveContact], compliance: f64) -> Vec<Pair> {
        let power = match self.adhesion.law {
            AdhesionLaw::Jkr => 0.5,
            AdhesionLaw::Dmt => 1.0,
        };
        let by_work = |of: &AdhesiveContact| {
            let force = of.force - of.force_without;
            let penetration = of.penetration - of.penetration_without;
            [force, penetration + compliance * force]
                .map(|change| power * change / self.adhesion.work)
        };
        contacts.iter().map(by_work).collect()
    }

    /// Force and approach at each node by another number, by central differences.
    fn by(
        &self,
        parameter: ModelParameter,
        nodes: &Nodes,
        pair: impl Fn(&AdhesiveContact) -> Pair,
    ) -> Result<Vec<Pair>, ContactError> {
        let value = self.value(parameter).unwrap_or(f64::NAN);
        let at = |factor: f64| {
            let moved = self.clone().with(parameter, factor * value)?;
            Ok((factor, moved.contacts(&nodes.radii)?))
        };
        let (below, less) = at(1.0 - STEP)?;
        // A ratio of one half has no neighbour above.
        let (above, more) = at(1.0 + STEP).or_else(|_: ContactError| at(1.0))?;
        let slopes = more.iter().zip(&less).map(|(more, less)| {
            let (more, less) = (pair(more), pair(less));
            [0, 1].map(|i| (more[i] - less[i]) / ((above - below) * value))
        });
        Ok(slopes.collect())
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

    /// Reads the points off the polynomials through the branch and the columns of its derivatives.
    fn read(
        &self,
        abscissa: Reading,
        abscissae: &[f64],
        (branch, columns): (&[Pair], &[Vec<Pair>]),
    ) -> Prediction {
        let (given, wanted) = match abscissa {
            Reading::Force => (0, 1),
            _ => (1, 0),
        };
        let mut found = Prediction {
            derivatives: vec![Vec::new(); columns.len()],
            ..Prediction::default()
        };
        for abscissa in abscissae {
            let place = self.where_reached(|weights| sum(weights, branch)[given] - abscissa);
            let weights = self.weights(place);
            let at = sum(&weights, branch);
            let slope = self.slope(place, branch);
            let slope = slope[wanted] / slope[given];
            // Before the first node, along the tangent.
            let before = if place > -1.0 {
                0.0
            } else {
                abscissa - at[given]
            };
            found.value.push(at[wanted] + slope * before);
            found.slope.push(slope);
            for (to, column) in found.derivatives.iter_mut().zip(columns) {
                let change = sum(&weights, column);
                to.push(change[wanted] - change[given] * slope);
            }
        }
        found
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
