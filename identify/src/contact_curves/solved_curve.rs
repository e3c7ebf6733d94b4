//! The contact solved at a few loads, and the smooth curves through them.

use std::f64::consts::PI;

use pellicle_contact::{
    ContactError, Domain, ForceCurve, Load, LoadingPath, Model, ModelDerivatives, ModelParameter,
    SolverOptions, Status, default_side, estimated_force, estimated_force_at_radius, solve_path,
};
use rayon::prelude::*;

use super::curve::{ContactCurve, CurveOptions, Reading};

/// Forces below this fraction of the largest follow the power law at the smallest load solved.
const SMALLEST_PART: f64 = 1e-3;
/// Maximum number of loads between the ends.
const MOST_INTERVALS: u16 = 1000;
/// The estimated force at a measured depth is within this factor of the true one.
const ESTIMATE: f64 = 3.0;
/// A contact closer than this many elements to the edge of the first domain needs a larger one.
const EDGE: usize = 1;
/// Enlargement factor, and how often it is applied.
const ENLARGEMENT: f64 = 1.4;
const ENLARGEMENTS: usize = 8;
/// Side of the domain over the contact radius found on the first one: the contact covers half of its area.
const SIDE_PER_RADIUS: f64 = 2.5;
/// Bound on the certificate. The error of E is of the order of its square.
const TOLERANCE: f64 = 1e-7;

/// The loads at which a curve is solved.
#[derive(Debug, Clone)]
pub struct Nodes {
    ends: NodeEnds,
    count: usize,
    /// Side of each load's domain over the first guess.
    stretches: Vec<f64>,
}

/// Smallest and largest.
#[derive(Debug, Clone, Copy)]
enum NodeEnds {
    /// Forces, N.
    Forces([f64; 2]),
    /// Depths (m), whose forces depend on the parameters, with a compliance in series, m/N.
    Depths([f64; 2], f64),
    /// Contact radii (m), whose forces depend on the parameters.
    Radii([f64; 2]),
}

impl Nodes {
    /// Loads that cover the points of a curve.
    pub fn of(curve: &ContactCurve, options: &CurveOptions) -> Result<Self, ContactError> {
        let abscissae = curve.abscissae_from(&curve.origins);
        let positive = abscissae.into_iter().filter(|x| *x > 0.0);
        let [least, most] = positive.fold([f64::INFINITY, 0.0], |[least, most], x| {
            [f64::min(least, x), f64::max(most, x)]
        });
        if most == 0.0 {
            return Err(ContactError::Force { force: most });
        }
        // The force grows roughly with this power of the abscissa.
        let abscissa = curve.observable.abscissa();
        let (power, estimate): (f64, f64) = match abscissa {
            Reading::Force => (1.0, 1.0),
            Reading::Depth => (1.5, ESTIMATE),
            Reading::ContactRadius | Reading::Stiffness => (3.0, ESTIMATE),
        };
        let ends = [least.max(SMALLEST_PART.powf(1.0 / power) * most), most];
        let decades = power * (ends[1] / ends[0]).log10() + 2.0 * estimate.log10();
        let ends = match abscissa {
            Reading::Force => NodeEnds::Forces(ends),
            Reading::Depth => NodeEnds::Depths(ends, curve.series),
            Reading::ContactRadius | Reading::Stiffness => NodeEnds::Radii(ends),
        };
        let wanted = (decades * options.loads_per_decade).ceil();
        let count = (1..MOST_INTERVALS).find(|count| f64::from(*count) >= wanted);
        let mut nodes = Self {
            ends,
            stretches: Vec::new(),
            count: ForceCurve::FEWEST.max(3 + usize::from(count.unwrap_or(MOST_INTERVALS))),
        };
        nodes.refuse_unknown_radii(&curve.model)?;
        nodes.stretches = nodes.stretches_for(&curve.model, options)?;
        Ok(nodes)
    }

    /// Rejects radii that the contact has under no force, or under more than one, as that of a flat punch.
    fn refuse_unknown_radii(&self, model: &Model) -> Result<(), ContactError> {
        let NodeEnds::Radii(ends) = self.ends else {
            return Ok(());
        };
        let has_force = |radius: &f64| {
            let force = estimated_force_at_radius(model, *radius);
            force > 0.0 && force.is_finite()
        };
        match ends.iter().find(|radius| !has_force(radius)) {
            Some(radius) => Err(ContactError::ContactRadius { radius: *radius }),
            None => Ok(()),
        }
    }

    /// The stretches that put half of each domain in contact. They stay fixed while the parameters change, so a domain
    /// follows its contact without a jump.
    fn stretches_for(
        &self,
        model: &Model,
        options: &CurveOptions,
    ) -> Result<Vec<f64>, ContactError> {
        let forces = self.forces(model);
        let stretch = |force: &f64| {
            let radius = contact_radius(model, *force, options.elements / 2)?;
            let guess = default_side(model, &[Load::Force(*force)]);
            Ok(SIDE_PER_RADIUS * radius / guess)
        };
        let stretches: Vec<Result<f64, ContactError>> = forces.par_iter().map(stretch).collect();
        stretches.into_iter().collect()
    }

    /// The same nodes with their forces multiplied by `factor`, where forces are given.
    pub fn with_forces_times(&self, factor: f64) -> Self {
        let mut scaled = self.clone();
        if let NodeEnds::Forces(ends) = &mut scaled.ends {
            *ends = ends.map(|end| factor * end);
        }
        scaled
    }

    pub fn len(&self) -> usize {
        self.count
    }

    /// The forces (N) of the nodes for a model, each with the side of its domain (m).
    pub fn domains(&self, model: &Model) -> Vec<(f64, f64)> {
        let forces = self.forces(model).into_iter().zip(&self.stretches);
        forces
            .map(|(force, stretch)| {
                let side = stretch * default_side(model, &[Load::Force(force)]);
                (force, side)
            })
            .collect()
    }

    /// The forces of the nodes for a model, evenly spaced in logarithms.
    fn forces(&self, model: &Model) -> Vec<f64> {
        let [least, most] = match self.ends {
            NodeEnds::Forces(ends) => ends,
            NodeEnds::Depths([least, most], series) => {
                // Both the contact and what is in series give way by no more than the whole.
                let force = |depth| f64::min(estimated_force(model, depth), depth / series);
                [force(least) / ESTIMATE, force(most) * ESTIMATE]
            }
            NodeEnds::Radii([least, most]) => [
                estimated_force_at_radius(model, least) / ESTIMATE,
                estimated_force_at_radius(model, most) * ESTIMATE,
            ],
        };
        // One node beyond each end, where a spline is less accurate.
        let inside = (self.count - 3) as f64;
        let part = |i: usize| (i as f64 - 1.0) / inside;
        (0..self.count)
            .map(|i| least * (most / least).powf(part(i)))
            .collect()
    }
}

/// A curve of a model: the energy as a function of force, and its derivative with respect to each parameter.
#[derive(Debug)]
pub struct SolvedCurve {
    /// Smallest and largest force solved, N.
    pub(super) ends: [f64; 2],
    pub(super) energy: ForceCurve,
    /// `√(A/π)` of the contact area A.
    radius: ForceCurve,
    pub(super) changes: Vec<ForceCurve>,
    /// Products with `K` on the finer grids of all loads.
    pub products: usize,
}

/// `D`, `dD/dQ` and each `∂D/∂θ` at a force.
pub struct CurvePoint {
    pub penetration: f64,
    pub slope: f64,
    pub changes: Vec<f64>,
}

impl SolvedCurve {
    /// Solves `model` at the nodes, each on two grids.
    pub fn of(
        model: &Model,
        nodes: &Nodes,
        parameters: &[ModelParameter],
        options: &CurveOptions,
    ) -> Result<Self, ContactError> {
        let derivatives = model.derivatives(parameters)?;
        let domains = nodes.domains(model);
        let forces: Vec<f64> = domains.iter().map(|(force, _)| *force).collect();
        let solved = domains.par_iter().enumerate().map(|(step, domain)| {
            if options.stop.is_raised() {
                return Err(ContactError::Cancelled { step });
            }
            energies(model, &derivatives, *domain, options.elements)
        });
        let solved: Vec<Result<(Vec<f64>, usize), ContactError>> = solved.collect();
        let solved = solved.into_iter().collect::<Result<Vec<_>, _>>()?;
        let products = solved.iter().map(|(_, products)| products).sum();
        let curve = |index: usize| {
            let values: Vec<f64> = solved.iter().map(|(of_load, _)| of_load[index]).collect();
            ForceCurve::through(&forces, &values).ok_or(ContactError::Force { force: forces[0] })
        };
        Ok(Self {
            ends: [forces[0], forces[forces.len() - 1]],
            products,
            energy: curve(0)?,
            radius: curve(1)?,
            changes: (2..parameters.len() + 2)
                .map(curve)
                .collect::<Result<_, _>>()?,
        })
    }

    /// The curve at a force. Beyond the forces solved it follows the power law at the nearest; at zero force it is 0.
    pub fn at(&self, force: f64) -> CurvePoint {
        let inside = force.clamp(self.ends[0], self.ends[1]);
        let penetration = self.energy.derivative(inside);
        let slope = self.energy.second_derivative(inside);
        let changes = self.changes.iter().map(|curve| curve.derivative(inside));
        // D ∝ Q^n with n = Q D′/D
        let power = inside * slope / penetration;
        let part = (force.max(0.0) / inside).powf(power);
        CurvePoint {
            penetration: part * penetration,
            slope: if force > 0.0 {
                part * slope * inside / force
            } else {
                slope
            },
            changes: changes.map(|change| part * change).collect(),
        }
    }

    /// The contact radius (m) at a force, and its derivative with respect to the force.
    pub fn radius(&self, force: f64) -> [f64; 2] {
        [self.radius.value(force), self.radius.derivative(force)]
    }

    /// Smallest and largest force solved, N.
    pub fn ends(&self) -> [f64; 2] {
        self.ends
    }
}

/// `E`, the contact radius and each `∂E/∂θ` under a force, extrapolated from a grid of `elements` per side and one of
/// half as many.
///
/// The errors fall with the square of the element's side, so the extrapolation is `(4 E_h − E_2h)/3`. Also returns the
/// products on the finer grid.
fn energies(
    model: &Model,
    derivatives: &ModelDerivatives,
    domain: (f64, f64),
    elements: usize,
) -> Result<(Vec<f64>, usize), ContactError> {
    let fine = held(model, domain, elements)?;
    let coarse = solved(model, domain.0, fine.grid.side(), elements / 2)?;
    let energies = |path: &LoadingPath| {
        let sensitivities = derivatives.of_path(path)?;
        let radius = (path.steps[0].summary.contact_area / PI).sqrt();
        let mut energies = vec![sensitivities.energy(0), radius];
        energies.extend(sensitivities.energies(0));
        Ok::<_, ContactError>(energies)
    };
    let (of_fine, of_coarse) = (energies(&fine)?, energies(&coarse)?);
    let pairs = of_fine.iter().zip(&of_coarse);
    let extrapolated = pairs.map(|(fine, coarse)| (4.0 * fine - coarse) / 3.0);
    let products = fine.steps[0].work.operator_applications;
    Ok((extrapolated.collect(), products))
}

/// The solution under a force on a domain of this side, or on a larger one if the contact reaches its edge.
pub fn held(
    model: &Model,
    (force, mut side): (f64, f64),
    elements: usize,
) -> Result<LoadingPath, ContactError> {
    let mut path = solved(model, force, side, elements)?;
    for _ in 0..ENLARGEMENTS {
        if !is_at_edge(&path) {
            break;
        }
        side *= ENLARGEMENT;
        path = solved(model, force, side, elements)?;
    }
    Ok(path)
}

/// The contact radius (m) on a grid that contains the contact.
fn contact_radius(model: &Model, force: f64, elements: usize) -> Result<f64, ContactError> {
    let mut side = default_side(model, &[Load::Force(force)]);
    for _ in 0..ENLARGEMENTS {
        let path = solved(model, force, side, elements)?;
        if !is_at_edge(&path) {
            return Ok(path.steps[0].summary.contact_radius);
        }
        side *= ENLARGEMENT;
    }
    let trials = ENLARGEMENTS;
    Err(ContactError::DomainTooSmall { side, trials })
}

/// Whether a contact reaches the edge of its domain.
fn is_at_edge(path: &LoadingPath) -> bool {
    let to_edge = path.steps[0].summary.elements_to_edge;
    to_edge.is_some_and(|elements| elements < EDGE)
}

/// A certified solution.
fn solved(
    model: &Model,
    force: f64,
    side: f64,
    elements: usize,
) -> Result<LoadingPath, ContactError> {
    let options = SolverOptions {
        tolerance: TOLERANCE,
        contact_stiffness: false,
        ..SolverOptions::default()
    };
    let (loads, domain) = ([Load::Force(force)], Domain::Side(side));
    let path = solve_path(model, domain, elements, &loads, &options, &mut ())?;
    let solution = &path.steps[0].solution;
    if path.steps[0].status() == Status::NotConverged {
        let worst = solution.certificate.worst();
        return Err(ContactError::NotCertified { force, worst });
    }
    Ok(path)
}
