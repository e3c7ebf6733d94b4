//! Contacts of an axisymmetric indenter, without a grid: the stable branch, with adhesion from the jump-out on.
//!
//! The contacts are solved at a few radii `a` that cover the abscissae. Through what is prescribed, such as the force
//! `F`, and what is read, such as the penetration `D`, and their derivatives by the unknowns at constant a, lie
//! polynomials in the radius. At an abscissa `F`, with subscripts for derivatives:
//!
//! ```text
//! dD/dF = D_a/F_a      ∂D/∂θ = D_θ − F_θ dD/dF
//! ```
//!
//! and at an approach `z = D + c F` of the end of a compliance c in series the same with `F` and `z` exchanged.
//! Without adhesion the polynomials are of logarithms, and the curve goes on beyond them as a power law. With adhesion
//! it goes on along its tangent before the end of the branch, so that a search whose values let go too early finds its
//! way.

use pellicle_contact::adhesion::{Adhesion, AdhesionLaw, AdhesiveContact, AdhesiveCurve};
use pellicle_contact::axisymmetric::{AxisymmetricElasticity, AxisymmetricProfile};
use pellicle_contact::{ContactError, Indenter, Model, ModelParameter};
use pellicle_influence::ElasticBodies;
use rayon::prelude::*;

use super::branch::{Branch, Piece, Scale};
use super::chebyshev::{ChebyshevNodes, Pair};
use super::curve::{ContactCurve, Observable, Reading};

/// With adhesion the branch begins at this multiple of the radius at its end, where it has a slope; by JKR on a
/// half-space the force there is 0.6 % above that of the pull-off.
const FIRST: f64 = 1.05;

/// Relative step of a parameter; the error of a difference is its square.
const STEP: f64 = 1e-4;

/// The smallest radius over the largest: below, penetrations are less than 1e-4 of the largest.
const SMALLEST: f64 = 1e-2;

/// What is prescribed at the ends of a branch is met to this accuracy, in logarithms, and twice that lies beyond.
const MARGIN: f64 = 0.05;

/// Limit on the trials for an end, of which five or so suffice.
const MOST_TRIALS: usize = 60;

/// The largest contact radius over the thickness of the thinnest top layer. Below, a contact takes at most some 2 ms;
/// the effort grows with the square of the ratio, so wider ones are solved on a grid.
const WIDEST: f64 = 100.0;

/// What axisymmetric contacts are made of.
#[derive(Debug, Clone)]
pub struct AxisymmetricModel {
    /// The relief and the indenter; its radial tables, which nothing here needs, are those of the first bodies.
    model: Model,
    bodies: ElasticBodies,
    adhesion: Option<Adhesion>,
}

/// A contact.
#[derive(Debug, Clone, Copy)]
pub struct Circle {
    radius: f64,
    force: f64,
    penetration: f64,
    stiffness: f64,
    /// Force and penetration of the contact without adhesion that has the same radius.
    pub without: Pair,
}

/// What is prescribed of a contact, and what is read.
#[derive(Debug, Clone, Copy)]
struct Request {
    observable: Observable,
    /// Compliance in series, m/N.
    series: f64,
}

impl Request {
    fn pair(self, of: &Circle) -> Pair {
        let value = |reading| match reading {
            Reading::Force => of.force,
            Reading::Depth => of.penetration,
            Reading::ContactRadius => of.radius,
            Reading::Stiffness => of.stiffness,
        };
        let mut given = value(self.observable.abscissa());
        if self.observable == Observable::ForceAtDepth {
            given += self.series * of.force;
        }
        [given, value(self.observable.observed())]
    }
}

impl AxisymmetricModel {
    /// The model of a curve with other values of some numbers.
    pub fn of(
        curve: &ContactCurve,
        values: &[(ModelParameter, f64)],
    ) -> Result<Self, ContactError> {
        let given = Self {
            model: curve.model.clone(),
            bodies: curve.model.tables.bodies().clone(),
            adhesion: curve.adhesion,
        };
        let mut pairs = values.iter().copied();
        pairs.try_fold(given, |model, (of, value)| model.with(of, value))
    }

    /// Whether a curve is solved without a grid: with adhesion always, otherwise where there are no springs and the
    /// layers are not so thin that a grid takes less time.
    pub fn applies_to(curve: &ContactCurve) -> bool {
        if curve.adhesion.is_some() {
            return true;
        }
        let radius = Self::of(curve, &[]).and_then(|model| {
            if model.elasticity()?.has_springs() {
                return Err(ContactError::NotAxisymmetric);
            }
            model.largest_radius(curve)
        });
        let thinnest = curve.model.tables.bodies().thinnest_top();
        radius.is_ok_and(|radius| thinnest.is_none_or(|thinnest| radius <= WIDEST * thinnest))
    }

    /// The contact radius (m) at the largest abscissa of a curve.
    fn largest_radius(&self, curve: &ContactCurve) -> Result<f64, ContactError> {
        let abscissae = curve.abscissae_from(&curve.origins).into_iter();
        let largest = abscissae.fold(0.0, f64::max);
        match self.punch_radius() {
            Some(radius) if curve.observable.abscissa() == Reading::ContactRadius => {
                Err(ContactError::ContactRadius { radius })
            }
            Some(radius) => Ok(radius),
            None => {
                let request = Request {
                    observable: curve.observable,
                    series: curve.series,
                };
                Ok(self.reaching(request, largest, None)?.0)
            }
        }
    }

    /// The radius of a flat punch, m; none for another shape.
    pub fn punch_radius(&self) -> Option<f64> {
        match &self.model.indenter {
            Indenter::FlatPunch(punch) => Some(punch.radius()),
            _ => None,
        }
    }

    pub fn bodies(&self) -> &ElasticBodies {
        &self.bodies
    }

    pub fn value(&self, parameter: ModelParameter) -> Option<f64> {
        match parameter {
            ModelParameter::Elastic(of) => self.bodies.parameter(of),
            ModelParameter::WorkOfAdhesion => self.adhesion.map(|adhesion| adhesion.work),
            _ => self.model.parameter(parameter),
        }
    }

    pub fn with(mut self, parameter: ModelParameter, value: f64) -> Result<Self, ContactError> {
        match parameter {
            ModelParameter::Elastic(of) => self.bodies = self.bodies.with_parameter(of, value)?,
            ModelParameter::WorkOfAdhesion => {
                self.adhesion = self.adhesion.map(|adhesion| Adhesion {
                    work: value,
                    ..adhesion
                });
            }
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

    /// The curve of its contacts with adhesion; none without.
    pub fn adhesive(&self) -> Result<Option<AdhesiveCurve>, ContactError> {
        let curve = |adhesion| AdhesiveCurve::new(self.elasticity()?, self.profile()?, adhesion);
        self.adhesion.map(curve).transpose()
    }

    fn contacts(&self, radii: &[f64]) -> Result<Vec<Circle>, ContactError> {
        let (elasticity, profile) = (self.elasticity()?, self.profile()?);
        let at = |radius: &f64| self.contact(&elasticity, profile, *radius);
        let solved: Vec<_> = radii.par_iter().map(at).collect();
        solved.into_iter().collect()
    }

    fn contact(
        &self,
        elasticity: &AxisymmetricElasticity,
        profile: AxisymmetricProfile,
        radius: f64,
    ) -> Result<Circle, ContactError> {
        let Some(adhesion) = self.adhesion else {
            let of = elasticity.contact(profile, radius)?;
            return Ok(Circle {
                radius,
                force: of.force,
                penetration: of.penetration,
                stiffness: of.punch.stiffness,
                without: [of.force, of.penetration],
            });
        };
        let of = AdhesiveContact::of(elasticity, profile, adhesion, radius)?;
        Ok(Circle {
            radius,
            force: of.force,
            penetration: of.penetration,
            stiffness: of.stiffness,
            without: [of.force_without, of.penetration_without],
        })
    }

    /// The branch as far as these abscissae need it, with its derivatives by the numbers sought; `series` as in
    /// [`ContactCurve`], and the points per factor e in the radius.
    pub fn branch(
        &self,
        observable: Observable,
        (abscissae, series): (&[f64], f64),
        sought: &[ModelParameter],
        per_factor: f64,
    ) -> Result<Branch, ContactError> {
        let request = Request { observable, series };
        let (radii, end) = match self.adhesive()? {
            None => (self.covering(request, abscissae)?, None),
            Some(curve) => {
                let (radii, end) = adhesive_ends(curve, request, abscissae)?;
                (radii, Some(end))
            }
        };
        let scale = if end.is_some() {
            Scale::Linear
        } else {
            Scale::Logarithmic
        };
        let pieces = ChebyshevNodes::between(self.profile()?, radii, per_factor).into_iter();
        let solved = pieces.map(|nodes| {
            let circles = self.contacts(&nodes.radii)?;
            let column = |parameter: &ModelParameter| match (parameter, self.adhesion) {
                (ModelParameter::WorkOfAdhesion, Some(adhesion)) => {
                    Ok(by_work(adhesion, &circles, request))
                }
                _ => self.by(*parameter, &nodes, (request, scale)),
            };
            let columns = sought.iter().map(column).collect::<Result<_, _>>()?;
            let pairs = circles.iter().map(|of| scale.to(request.pair(of)));
            Ok(Piece {
                pairs: pairs.collect(),
                columns,
                nodes,
                circles,
            })
        });
        Ok(Branch {
            observable,
            series,
            pieces: solved.collect::<Result<_, ContactError>>()?,
            scale,
            end,
            is_cut: radii[0] <= 2.0 * SMALLEST * radii[1],
        })
    }

    /// Radii between which contacts without adhesion have the positive ones of these abscissae.
    fn covering(&self, request: Request, abscissae: &[f64]) -> Result<[f64; 2], ContactError> {
        let positive = abscissae.iter().copied().filter(|x| *x > 0.0);
        let [least, most] = positive.fold([f64::INFINITY, 0.0], |[least, most], x| {
            [f64::min(least, x), f64::max(most, x)]
        });
        if most == 0.0 {
            // Nothing is in contact: the branch at any scale.
            let radius = self.profile()?.half_space_radius(f64::MIN_POSITIVE.sqrt());
            return Ok([radius, (1.0 + MARGIN) * radius]);
        }
        let profile = self.profile()?;
        let beyond = |radius: f64, part: f64| {
            profile.half_space_radius(profile.half_space_penetration(radius) * part.exp())
        };
        let (last, log) = self.reaching(request, most, None)?;
        let last = beyond(last, 2.0 * MARGIN);
        // What is prescribed grows at least with the root of d.
        let low = log - 2.0 * (most / least).ln();
        let smallest = SMALLEST * last;
        let is_beyond = profile.half_space_penetration(smallest).ln() > log - 0.2 * (log - low);
        let first = if is_beyond {
            smallest
        } else {
            match self.reaching(request, least, Some(log - (most / least).ln())) {
                Ok((first, _)) => beyond(first, -2.0 * MARGIN).max(smallest),
                Err(_) => smallest,
            }
        };
        Ok([first, last])
    }

    /// The contact radius (m) at which a value is prescribed, to the margin, and `ln d` there; by secants of logarithms
    /// from a given one.
    fn reaching(
        &self,
        request: Request,
        wanted: f64,
        from: Option<f64>,
    ) -> Result<(f64, f64), ContactError> {
        let (elasticity, profile) = (self.elasticity()?, self.profile()?);
        let start = match request.observable.abscissa() {
            Reading::Force | Reading::Stiffness => (wanted / elasticity.modulus()).sqrt(),
            Reading::Depth => wanted,
            Reading::ContactRadius => profile.half_space_penetration(wanted),
        };
        let mut log = from.unwrap_or(start.ln());
        let (mut slope, mut last): (f64, Option<Pair>) = (1.5, None);
        let mut failure = ContactError::Penetration {
            penetration: wanted,
        };
        for _ in 0..MOST_TRIALS {
            let radius = profile.half_space_radius(log.exp());
            match self.contact(&elasticity, profile, radius) {
                Ok(found) => {
                    let miss = (request.pair(&found)[0] / wanted).ln();
                    if miss.abs() <= MARGIN {
                        return Ok((radius, log));
                    }
                    if let Some([at, before]) = last
                        && at.total_cmp(&log).is_ne()
                    {
                        slope = ((miss - before) / (log - at)).clamp(0.3, 4.0);
                    }
                    last = Some([log, miss]);
                    log -= miss / slope;
                }
                // Beyond the rim or the reach of layers: the search turns back.
                Err(error) => {
                    failure = error;
                    log = last.map_or(log - 2.0, |[at, _]| f64::midpoint(at, log));
                }
            }
        }
        Err(failure)
    }

    /// The derivatives at each node by a number, by central differences.
    fn by(
        &self,
        parameter: ModelParameter,
        nodes: &ChebyshevNodes,
        (request, scale): (Request, Scale),
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
            let [more, less] = [more, less].map(|of| scale.to(request.pair(of)));
            [0, 1].map(|i| (more[i] - less[i]) / ((above - below) * value))
        });
        Ok(slopes.collect())
    }
}

/// What is prescribed and what is read, by the work of adhesion: `F − F₀` and `D − D₀` are in proportion to `√w` by JKR
/// and to w by DMT.
fn by_work(adhesion: Adhesion, contacts: &[Circle], request: Request) -> Vec<Pair> {
    let power = match adhesion.law {
        AdhesionLaw::Jkr => 0.5,
        AdhesionLaw::Dmt => 1.0,
    };
    let by_work = |of: &Circle| {
        let change = Circle {
            force: of.force - of.without[0],
            penetration: of.penetration - of.without[1],
            ..*of
        };
        let change = request.pair(&change);
        change.map(|change| power * change / adhesion.work)
    };
    contacts.iter().map(by_work).collect()
}

/// The radii (m) at the ends of a branch with adhesion, and what is prescribed where it ends.
fn adhesive_ends(
    curve: AdhesiveCurve,
    request: Request,
    abscissae: &[f64],
) -> Result<([f64; 2], f64), ContactError> {
    let largest = abscissae.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let (end, last, prescribed) = if request.observable.abscissa() == Reading::Force {
        let end = curve.end_under_force();
        (end, curve.at_force(largest.max(end.force))?, end.force)
    } else {
        let curve = curve.behind_spring(request.series)?;
        let end = curve.end_under_penetration();
        let last = curve.at_penetration(largest)?.unwrap_or(end);
        (end, last, end.penetration + request.series * end.force)
    };
    // Not down to 0, where DMT ends, nor less than a hundredth apart.
    let first = FIRST * end.radius;
    let last = last.radius.max(1.01 * first);
    Ok(([first.max(SMALLEST * last), last], prescribed))
}
