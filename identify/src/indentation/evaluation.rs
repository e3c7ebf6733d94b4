//! The numbers of an indentation, with their uncertainties.
//!
//! Every number is a function of independent sources: the noise of the unloading (three combinations), of the depths at
//! both ends of the hold and of the works; the rate of the drift, the frame's compliance, the zero of the depth, the
//! area function, β, ε, and both materials. Each source is moved by its standard uncertainty to both sides, and half the
//! difference is its part; the parts of independent sources add in squares.

use std::f64::consts::PI;

use super::area_function::AreaFunction;
use super::correction::{DriftHold, Line};
use super::phases::{Phases, drift_hold, median, phases};
use super::unloading::UnloadingFit;
use super::{IndentationError, IndentationNumber, Uncertain};

/// The fewest points of an unloading.
const FEWEST_POINTS: usize = 8;
/// The depth at the end of a hold is that of the line through this last part of it.
const END_OF_HOLD: f64 = 0.3;
/// The depth at its beginning is the mean of so many points.
const BEGINNING: usize = 3;
/// Number of all numbers.
const COUNT: usize = IndentationNumber::ALL.len();

/// How curves are evaluated.
#[derive(Debug, Clone, PartialEq)]
pub struct EvaluationSettings {
    /// The area function of the indenter.
    pub area: AreaFunction,
    /// Covariance of the coefficients of a polynomial; empty for exact ones.
    pub area_covariance: Vec<Vec<f64>>,
    /// The contact depths for which it was calibrated, m, if it was.
    pub area_range: Option<[f64; 2]>,
    /// β of `E_r = √π S/(2 β √A)`.
    pub beta: Uncertain,
    /// ε of the contact depth.
    pub epsilon: Epsilon,
    /// The part of the unloading that is fitted, from above, as parts of the largest force.
    pub unloading: [f64; 2],
    /// Compliance of the frame, m/N.
    pub frame_compliance: Uncertain,
    /// The drift of the depth.
    pub drift: Drift,
    /// The zero of the depth.
    pub depth_zero: DepthZero,
    /// Poisson's ratio of the body.
    pub poisson_ratio: Uncertain,
    /// The material of the indenter; none for a rigid one.
    pub indenter: Option<IndenterMaterial>,
}

/// ε of the contact depth `h_max − ε P_max/S`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Epsilon {
    /// A number.
    Fixed(Uncertain),
    /// `ε(m) = m (1 − 2(m−1)/√π · Γ(m/(2(m−1)))/Γ(1/(2(m−1))))` of the exponent.
    Exponent,
}

/// The drift of the depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Drift {
    /// None is taken out.
    Off,
    /// That of a hold at a small force.
    Hold,
    /// That of such a hold if the curve has one, otherwise none.
    OfHoldIfFound,
    /// A rate, m/s.
    Rate(Uncertain),
}

/// The zero of the depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum DepthZero {
    /// That of the file.
    AsRecorded,
    /// Where the contact begins after the stretch before it.
    FirstContact,
    /// That place if the curve shows it, otherwise the zero of the file.
    FirstContactIfFound,
    /// A depth of the file, m.
    At(Uncertain),
}

/// An elastic indenter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IndenterMaterial {
    /// Young's modulus, Pa.
    pub young_modulus: Uncertain,
    /// Poisson's ratio.
    pub poisson_ratio: Uncertain,
}

/// A measured load and its unloading, in the order of time.
#[derive(Debug, Clone, Copy)]
pub struct IndentationCurve<'a> {
    /// Times, s, if known.
    pub time: Option<&'a [f64]>,
    /// Depths, m.
    pub depth: &'a [f64],
    /// Forces, N.
    pub force: &'a [f64],
    /// The depth at which the contact begins, m, with the place of its first point, if the file shows it.
    pub contact: Option<(f64, usize)>,
}

/// A curve with its numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct EvaluatedCurve {
    values: [Option<f64>; COUNT],
    /// What each independent source adds to each number.
    parts: Vec<[f64; COUNT]>,
    /// Its phases.
    pub phases: Phases,
    /// The power law of its unloading.
    pub unloading: UnloadingFit,
    /// The hold that gives the drift, if it is sought.
    pub drift: Option<DriftHold>,
    /// Depths after all corrections, m.
    pub depth: Vec<f64>,
}

impl EvaluatedCurve {
    /// A number with its standard uncertainty; none if the curve does not have it.
    #[must_use]
    pub fn number(&self, of: IndentationNumber) -> Option<Uncertain> {
        let value = self.values[of.place()]?;
        Some(Uncertain {
            value,
            sd: self.covariance(of, of).sqrt(),
        })
    }

    /// The covariance of two numbers.
    #[must_use]
    pub fn covariance(&self, one: IndentationNumber, other: IndentationNumber) -> f64 {
        let parts = self.parts.iter();
        parts.map(|part| part[one.place()] * part[other.place()]).sum()
    }
}

/// Evaluates a curve.
///
/// Accuracy: exact for curves that follow the relations; of 200 synthetic curves with noise, drift and a compliant frame
/// the 95 % intervals hold in 180 to 196 (`tests/indentation.rs`).
///
/// # Errors
///
/// [`IndentationError`] if the curve has no such numbers.
pub fn evaluate(
    curve: IndentationCurve<'_>,
    settings: &EvaluationSettings,
) -> Result<EvaluatedCurve, IndentationError> {
    let phases = phases(curve.force, settings.unloading, FEWEST_POINTS)?;
    let (rate, drift) = rate(curve, settings.drift, &phases)?;
    let zero = match (settings.depth_zero, curve.contact) {
        (DepthZero::At(zero), _) => zero,
        (DepthZero::FirstContact | DepthZero::FirstContactIfFound, Some((depth, _))) => {
            Uncertain::exact(depth)
        }
        (DepthZero::AsRecorded, _) | (DepthZero::FirstContactIfFound, None) => {
            Uncertain::exact(0.0)
        }
        (DepthZero::FirstContact, None) => return Err(IndentationError::NoContact),
    };
    let inputs = Inputs {
        rate: rate.value,
        zero: zero.value,
        ..Inputs::of(settings)
    };
    let reading = Reading::of(curve, &phases, &inputs)?;
    let values = reading.numbers(settings, &inputs)?;
    let mut parts = Vec::new();
    // Half the difference between both sides of a source.
    let mut both_sides = |numbers: &dyn Fn(f64) -> Result<Numbers, IndentationError>| {
        let [above, below] = [numbers(1.0)?, numbers(-1.0)?];
        let part = |k: usize| match (above[k], below[k]) {
            (Some(above), Some(below)) => 0.5 * (above - below),
            _ => 0.0,
        };
        parts.push(std::array::from_fn(part));
        Ok::<(), IndentationError>(())
    };
    for direction in reading.noise() {
        both_sides(&|side| reading.moved(&direction, side).numbers(settings, &inputs))?;
    }
    for (uncertain, field) in inputs.sources(settings, [rate, zero]) {
        if uncertain.sd > 0.0 {
            both_sides(&|side| {
                let mut moved = inputs;
                *field(&mut moved) += side * uncertain.sd;
                let changes_data = moved.changes_data(&inputs);
                let again = changes_data.then(|| Reading::of(curve, &phases, &moved));
                let again = again.transpose()?;
                again.as_ref().unwrap_or(&reading).numbers(settings, &moved)
            })?;
        }
    }
    Ok(EvaluatedCurve {
        values,
        parts,
        unloading: reading.unloading,
        depth: inputs.corrected(curve),
        phases,
        drift,
    })
}

type Numbers = [Option<f64>; COUNT];

/// The rate of the drift, m/s, and the hold that it comes from.
fn rate(
    curve: IndentationCurve<'_>,
    drift: Drift,
    phases: &Phases,
) -> Result<(Uncertain, Option<DriftHold>), IndentationError> {
    match (drift, curve.time) {
        (Drift::Off, _) | (Drift::OfHoldIfFound, None) => Ok((Uncertain::exact(0.0), None)),
        (Drift::OfHoldIfFound, Some(time)) if drift_hold(time, curve.force, phases).is_none() => {
            Ok((Uncertain::exact(0.0), None))
        }
        (Drift::Rate(rate), Some(_)) => Ok((rate, None)),
        (Drift::Hold | Drift::OfHoldIfFound, Some(time)) => {
            let hold = drift_hold(time, curve.force, phases).ok_or(IndentationError::NoHold)?;
            let hold = DriftHold::of(time, curve.depth, hold)?;
            Ok((hold.rate, Some(hold)))
        }
        (Drift::Rate(_) | Drift::Hold, None) => Err(IndentationError::NoTime),
    }
}

/// The numbers that an evaluation takes from elsewhere than the curve.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Inputs {
    rate: f64,
    zero: f64,
    frame_compliance: f64,
    /// In standard uncertainties of the area at the contact depth.
    area: f64,
    beta: f64,
    epsilon: f64,
    poisson_ratio: f64,
    /// `E_i` and `ν_i`; an infinite modulus for a rigid indenter.
    indenter: [f64; 2],
}

type Field = fn(&mut Inputs) -> &mut f64;

impl Inputs {
    fn of(settings: &EvaluationSettings) -> Self {
        Self {
            rate: 0.0,
            zero: 0.0,
            frame_compliance: settings.frame_compliance.value,
            area: 0.0,
            beta: settings.beta.value,
            epsilon: match settings.epsilon {
                Epsilon::Fixed(epsilon) => epsilon.value,
                Epsilon::Exponent => f64::NAN,
            },
            poisson_ratio: settings.poisson_ratio.value,
            indenter: settings.indenter.map_or([f64::INFINITY, 0.0], |of| {
                [of.young_modulus.value, of.poisson_ratio.value]
            }),
        }
    }

    /// The independent sources with their standard uncertainties.
    fn sources(
        self,
        settings: &EvaluationSettings,
        [rate, zero]: [Uncertain; 2],
    ) -> Vec<(Uncertain, Field)> {
        let one = Uncertain {
            value: 0.0,
            sd: f64::from(u8::from(!settings.area_covariance.is_empty())),
        };
        let mut sources: Vec<(Uncertain, Field)> = vec![
            (rate, |of| &mut of.rate),
            (zero, |of| &mut of.zero),
            (settings.frame_compliance, |of| &mut of.frame_compliance),
            (one, |of| &mut of.area),
            (settings.beta, |of| &mut of.beta),
            (settings.poisson_ratio, |of| &mut of.poisson_ratio),
        ];
        if let Epsilon::Fixed(epsilon) = settings.epsilon {
            sources.push((epsilon, |of| &mut of.epsilon));
        }
        if let Some(indenter) = settings.indenter {
            sources.push((indenter.young_modulus, |of| &mut of.indenter[0]));
            sources.push((indenter.poisson_ratio, |of| &mut of.indenter[1]));
        }
        sources
    }

    /// Whether these inputs give other depths.
    fn changes_data(&self, other: &Self) -> bool {
        let of = |inputs: &Self| [inputs.rate, inputs.zero, inputs.frame_compliance];
        of(self) != of(other)
    }

    /// `h − h₀ − ḣ (t − t₀) − C_f P`, with the time of the first contact.
    fn corrected(&self, curve: IndentationCurve<'_>) -> Vec<f64> {
        let (_, first) = curve.contact.unwrap_or_default();
        let times = curve.time.unwrap_or_default();
        let start = times.get(first).copied().unwrap_or(0.0);
        let pairs = curve.depth.iter().zip(curve.force).enumerate();
        let corrected = pairs.map(|(at, (depth, force))| {
            let drift = times.get(at).map_or(0.0, |time| self.rate * (time - start));
            depth - self.zero - drift - self.frame_compliance * force
        });
        corrected.collect()
    }
}

/// What is read from a curve at given corrections.
#[derive(Debug, Clone)]
struct Reading {
    unloading: UnloadingFit,
    /// Depths at the end and at the beginning of the hold, m.
    top: [Uncertain; 2],
    is_held: bool,
    /// Work of loading and hold, and of the unloading as far as it was measured, J.
    work: [Uncertain; 2],
    /// The force at which the unloading ends, N.
    last_force: f64,
}

impl Reading {
    fn of(
        curve: IndentationCurve<'_>,
        phases: &Phases,
        inputs: &Inputs,
    ) -> Result<Self, IndentationError> {
        let depth = inputs.corrected(curve);
        let force = curve.force;
        let top = phases.top.clone();
        let largest = median(&force[top.clone()]);
        let fitted = phases.fitted.clone();
        let unloading = UnloadingFit::of(&depth[fitted.clone()], &force[fitted], largest)?;
        let noise = unloading.noise;
        let single = |value: f64, points: f64| Uncertain {
            value,
            sd: noise / points.sqrt(),
        };
        let (end, beginning) = if phases.is_held {
            let first = top.end - ((END_OF_HOLD * top.len() as f64) as usize).max(1);
            let places: Vec<f64> = (first..top.end).map(|at| at as f64).collect();
            let line = Line::through(&places, &depth[first..top.end]);
            let count = BEGINNING.min(top.len());
            let mean = depth[top.start..top.start + count].iter().sum::<f64>() / count as f64;
            (
                line.map_or(single(depth[top.end - 1], 1.0), |line| line.last),
                single(mean, count as f64),
            )
        } else {
            let at = single(depth[top.start], 1.0);
            (at, at)
        };
        let work = |range: std::ops::Range<usize>| {
            let (depth, force) = (&depth[range.clone()], &force[range]);
            let strips = depth.windows(2).zip(force.windows(2));
            let value = strips.map(|(h, p)| 0.5 * (p[0] + p[1]) * (h[1] - h[0])).sum::<f64>();
            // Each depth enters with half the difference of its neighbours' forces.
            let weights = force.windows(3).map(|p| (0.5 * (p[2] - p[0])).powi(2)).sum::<f64>();
            Uncertain {
                value,
                sd: noise * weights.sqrt(),
            }
        };
        let first = curve.contact.map_or(0, |(_, first)| first);
        let loading = work(first..top.end);
        let back = work(top.end - 1..phases.end + 1);
        Ok(Self {
            unloading,
            top: [end, beginning],
            is_held: phases.is_held,
            work: [
                loading,
                Uncertain {
                    value: -back.value,
                    ..back
                },
            ],
            last_force: force[phases.end].max(0.0),
        })
    }

    /// The independent directions of the noise, each one standard deviation long: of `S`, `m`, `h₁`, both depths of the
    /// hold, both works.
    fn noise(&self) -> Vec<[f64; 7]> {
        let triangle = cholesky(self.unloading.covariance);
        let mut directions: Vec<[f64; 7]> = (0..3)
            .map(|k| {
                let of = |row: usize| triangle[row][k];
                [of(0), of(1), of(2), 0.0, 0.0, 0.0, 0.0]
            })
            .collect();
        let others = [self.top[0], self.top[1], self.work[0], self.work[1]];
        for (k, uncertain) in others.into_iter().enumerate() {
            let mut direction = [0.0; 7];
            direction[3 + k] = uncertain.sd;
            directions.push(direction);
        }
        directions
    }

    fn moved(&self, direction: &[f64; 7], side: f64) -> Self {
        let mut moved = self.clone();
        let [s, m, h, end, beginning, loading, back] = direction.map(|part| side * part);
        moved.unloading.stiffness += s;
        moved.unloading.exponent += m;
        moved.unloading.depth += h;
        moved.top[0].value += end;
        moved.top[1].value += beginning;
        moved.work[0].value += loading;
        moved.work[1].value += back;
        moved
    }

    /// The numbers, in the order of [`IndentationNumber::ALL`].
    fn numbers(
        &self,
        settings: &EvaluationSettings,
        inputs: &Inputs,
    ) -> Result<Numbers, IndentationError> {
        let fit = &self.unloading;
        let [end, beginning] = self.top.map(|of| of.value);
        let epsilon = match settings.epsilon {
            Epsilon::Fixed(_) => inputs.epsilon,
            Epsilon::Exponent => epsilon_of(fit.exponent),
        };
        // h_c = h_max − ε P_max/S
        let contact = end - epsilon * fit.force / fit.stiffness;
        let exact = settings.area.positive_area(contact)?;
        let area = exact + inputs.area * settings.area_sd(contact);
        // E_r = √π S/(2 β √A)
        let reduced = PI.sqrt() * fit.stiffness / (2.0 * inputs.beta * area.sqrt());
        let [indenter, ratio] = inputs.indenter;
        let alone = indenter / (1.0 - ratio * ratio);
        if reduced >= alone {
            return Err(IndentationError::StifferThanIndenter {
                reduced,
                indenter: alone,
            });
        }
        let square = inputs.poisson_ratio.powi(2);
        let modulus = (1.0 - square) / (1.0 / reduced - 1.0 / alone);
        let [loading, back] = self.work.map(|of| of.value);
        // What the law gives back below the last force, ∫ P dh = P (h − h_f)/(m + 1).
        let span = fit.exponent * fit.force / fit.stiffness;
        let left = span * (self.last_force / fit.force).powf(1.0 / fit.exponent);
        let tail = self.last_force * left / (fit.exponent + 1.0);
        let creep = (end - beginning) / beginning;
        let of = |number| match number {
            IndentationNumber::MaxDepth => Some(end),
            IndentationNumber::MaxForce => Some(fit.force),
            IndentationNumber::ContactStiffness => Some(fit.stiffness),
            IndentationNumber::Exponent => Some(fit.exponent),
            IndentationNumber::FinalDepth => Some(fit.final_depth()),
            IndentationNumber::ContactDepth => Some(contact),
            IndentationNumber::Area => Some(area),
            IndentationNumber::ReducedModulus => Some(reduced),
            IndentationNumber::IndentationModulus => Some(modulus),
            IndentationNumber::IndentationHardness => Some(fit.force / area),
            IndentationNumber::MartensHardness => Some(fit.force / settings.area.surface(end)),
            IndentationNumber::Creep => self.is_held.then_some(creep),
            IndentationNumber::ElasticWorkRatio => {
                (loading > 0.0).then_some((back + tail) / loading)
            }
            IndentationNumber::DriftRate => Some(inputs.rate),
        };
        Ok(IndentationNumber::ALL.map(of))
    }
}

impl EvaluationSettings {
    /// The standard uncertainty of the area (m²) at a depth (m).
    fn area_sd(&self, depth: f64) -> f64 {
        let powers: Vec<f64> = (0..self.area_covariance.len())
            .map(|k| depth.powf(AreaFunction::power(k)))
            .collect();
        let rows = self.area_covariance.iter().zip(&powers);
        let variance: f64 = rows
            .flat_map(|(row, p)| row.iter().zip(&powers).map(move |(c, q)| p * c * q))
            .sum();
        variance.max(0.0).sqrt()
    }
}

/// `ε(m)`: 0.75 of a paraboloid (m = 3/2), 0.727 of a cone (m = 2). G. M. Pharr and A. Bolshakov, J. Mater. Res. 17,
/// 2660 (2002).
#[must_use]
pub(super) fn epsilon_of(exponent: f64) -> f64 {
    let rise = exponent - 1.0;
    let [above, below] = [exponent / (2.0 * rise), 1.0 / (2.0 * rise)];
    let ratio = (statrs::function::gamma::ln_gamma(above)
        - statrs::function::gamma::ln_gamma(below))
    .exp();
    exponent * (1.0 - 2.0 * rise / PI.sqrt() * ratio)
}

/// The lower triangle `L` of `L Lᵀ`; zero columns where the matrix is not positive.
fn cholesky(matrix: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let mut triangle = [[0.0; 3]; 3];
    for k in 0..3 {
        let dot = |a: usize, b: usize, l: &[[f64; 3]; 3]| -> f64 {
            (0..k).map(|j| l[a][j] * l[b][j]).sum()
        };
        let pivot = matrix[k][k] - dot(k, k, &triangle);
        if pivot <= 0.0 {
            continue;
        }
        triangle[k][k] = pivot.sqrt();
        for row in k + 1..3 {
            triangle[row][k] = (matrix[row][k] - dot(row, k, &triangle)) / triangle[k][k];
        }
    }
    triangle
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn epsilon_of_a_paraboloid_and_of_a_cone_are_the_known_ones() {
        assert!((epsilon_of(1.5) - 0.75).abs() < 1e-12);
        assert!((epsilon_of(2.0) - 2.0 * (1.0 - 2.0 / PI)).abs() < 1e-12);
        // That of a flat punch is 1.
        assert!((epsilon_of(1.0001) - 1.0).abs() < 2e-2);
    }

    #[test]
    fn the_triangle_gives_the_matrix_back() {
        let matrix = [[4.0, 2.0, 1.0], [2.0, 5.0, 3.0], [1.0, 3.0, 6.0]];
        let l = cholesky(matrix);
        for (i, row) in matrix.iter().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                let product: f64 = (0..3).map(|k| l[i][k] * l[j][k]).sum();
                assert!((product - entry).abs() < 1e-14);
            }
        }
    }
}
