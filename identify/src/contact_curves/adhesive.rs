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

/// What is prescribed of a contact.
#[derive(Debug, Clone, Copy)]
enum Prescribed {
    /// The force, N.
    Force,
    /// The approach, m, of the end of this compliance (m/N) in series.
    Approach(f64),
}

/// What is prescribed, and what is read: force (N) and penetration (m), or approach (m) and force.
type Pair = [f64; 2];

impl Prescribed {
    /// What a reading prescribes behind a compliance in series. A depth at a force is that of the contact alone,
    /// however it was measured.
    fn new(reading: Reading, series: f64) -> Self {
        match reading {
            Reading::Force => Self::Force,
            _ => Self::Approach(series),
        }
    }

    fn pair(self, of: &AdhesiveContact) -> Pair {
        match self {
            Self::Force => [of.force, of.penetration],
            Self::Approach(compliance) => [of.penetration + compliance * of.force, of.force],
        }
    }
}

/// Contacts along the branch.
struct AdhesiveBranch {
    nodes: Nodes,
    contacts: Vec<AdhesiveContact>,
    /// Prescribed and read, at the nodes.
    pairs: Vec<Pair>,
    /// What is prescribed at the jump-out.
    end: f64,
}

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
        reading: Reading,
        (abscissae, series): (&[f64], f64),
        sought: &[ModelParameter],
    ) -> Result<Prediction, ContactError> {
        let prescribed = Prescribed::new(reading, series);
        let branch = self.branch(prescribed, abscissae)?;
        let column = |parameter: &ModelParameter| match parameter {
            ModelParameter::WorkOfAdhesion => Ok(self.by_work(&branch.contacts, prescribed)),
            _ => self.by(*parameter, &branch.nodes, prescribed),
        };
        let columns: Vec<Vec<Pair>> = sought.iter().map(column).collect::<Result<_, _>>()?;
        let mut found = branch.read(abscissae, &columns);
        if reading == Reading::Force {
            found.slope.iter_mut().for_each(|slope| *slope += series);
        }
        Ok(found)
    }

    /// The forces (N) of the contacts without adhesion of the same radii; none beyond the end of the branch.
    pub fn forces_without(
        &self,
        reading: Reading,
        (abscissae, series): (&[f64], f64),
    ) -> Result<Vec<Option<f64>>, ContactError> {
        let branch = self.branch(Prescribed::new(reading, series), abscissae)?;
        let without = branch.contacts.iter().map(|of| [of.force_without; 2]);
        let without: Vec<Pair> = without.collect();
        let at = |abscissa: &f64| {
            let weights = branch.nodes.weights(branch.place(*abscissa));
            (*abscissa >= branch.end).then(|| sum(&weights, &without)[0])
        };
        Ok(abscissae.iter().map(at).collect())
    }

    /// The branch as far as these abscissae need it.
    fn branch(
        &self,
        prescribed: Prescribed,
        abscissae: &[f64],
    ) -> Result<AdhesiveBranch, ContactError> {
        let curve = self.curve()?;
        let largest = abscissae.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let (end, last) = match prescribed {
            Prescribed::Force => {
                let end = curve.pull_off();
                (end, curve.at_force(largest.max(end.force))?)
            }
            Prescribed::Approach(compliance) => {
                let curve = curve.behind_spring(compliance)?;
                let end = curve.last_contact();
                (end, curve.at_penetration(largest)?.unwrap_or(end))
            }
        };
        let nodes = Nodes::between([FIRST * end.radius, last.radius]);
        let contacts = self.contacts(&nodes.radii)?;
        Ok(AdhesiveBranch {
            pairs: contacts.iter().map(|of| prescribed.pair(of)).collect(),
            end: prescribed.pair(&end)[0],
            nodes,
            contacts,
        })
    }

    /// What is prescribed and what is read, by the work of adhesion: `F − F₀` and `D − D₀` are in proportion to `√w` by
    /// JKR and to w by DMT.
    fn by_work(&self, contacts: &[AdhesiveContact], prescribed: Prescribed) -> Vec<Pair> {
        let power = match self.adhesion.law {
            AdhesionLaw::Jkr => 0.5,
            AdhesionLaw::Dmt => 1.0,
        };
        let by_work = |of: &AdhesiveContact| {
            let change = AdhesiveContact {
                force: of.force - of.force_without,
                penetration: of.penetration - of.penetration_without,
                ..*of
            };
            prescribed
                .pair(&change)
                .map(|change| power * change / self.adhesion.work)
        };
        contacts.iter().map(by_work).collect()
    }

    /// The same at each node by another number, by central differences.
    fn by(
        &self,
        parameter: ModelParameter,
        nodes: &Nodes,
        prescribed: Prescribed,
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
            let [more, less] = [more, less].map(|of| prescribed.pair(of));
            [0, 1].map(|i| (more[i] - less[i]) / ((above - below) * value))
        });
        Ok(slopes.collect())
    }
}

impl AdhesiveBranch {
    /// Where an abscissa lies; at the first node if it is before that.
    fn place(&self, abscissa: f64) -> f64 {
        (self.nodes).where_reached(|weights| sum(weights, &self.pairs)[0] - abscissa)
    }

    /// Reads the points off the polynomials through the pairs and the columns of their derivatives.
    fn read(&self, abscissae: &[f64], columns: &[Vec<Pair>]) -> Prediction {
        let mut found = Prediction {
            derivatives: vec![Vec::new(); columns.len()],
            ..Prediction::default()
        };
        for abscissa in abscissae {
            let place = self.place(*abscissa);
            let weights = self.nodes.weights(place);
            let [given, read] = sum(&weights, &self.pairs);
            let [by_given, by_read] = self.nodes.slope(place, &self.pairs);
            let slope = by_read / by_given;
            // Before the first node, along the tangent.
            let before = if place > -1.0 { 0.0 } else { abscissa - given };
            found.value.push(read + slope * before);
            found.slope.push(slope);
            for (to, column) in found.derivatives.iter_mut().zip(columns) {
                let [given, read] = sum(&weights, column);
                to.push(read - given * slope);
            }
        }
        found
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
    terms.fold([0.0; 2], |[one, other], (weight, value)| {
        [one + weight * value[0], other + weight * value[1]]
    })
}
