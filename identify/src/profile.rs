//! The profile of the likelihood: how far an unknown can go while the others follow.
//!
//! `Δ(x_j) = min over the others of χ² − least χ²` reaches the squared quantile of Student's distribution at the ends
//! of the interval: D. M. Bates and D. G. Watts, Nonlinear Regression Analysis and Its Applications (Wiley, 1988),
//! section 6.1. The scan goes outward in `z = √Δ`, which is nearly linear. Derivatives make it cheap: the others start
//! where their tangent leads, what a linear problem could still gain is taken off without another prediction, and
//! `dΔ/dx_j = −2 J_jᵀ r` of the constrained fit leads to the next point and corrects the last.

use std::rc::Rc;

use crate::{
    IdentifyError, Problem,
    least_squares::{Minimum, Search, Stopping, farthest},
    metric::{Metric, System},
    normal_equations::NormalEquations,
    predictor::{Evaluation, Predictor},
    projection::dot,
};

/// A scan ends where `z` is this near its target, as a part of it; a tangent leads the rest of the way.
const NEAR: f64 = 0.05;
/// Longest stride of a scan, a factor of four for a logarithm.
const LONGEST_STRIDE: f64 = 1.4;
/// What the constrained fits may leave to be gained, in units of χ²; it is taken off as if the problem were linear.
const CONSTRAINED: f64 = 0.02;
/// A profile lower than the best fit by this has found a better one: a twentieth of χ² at level 0.95, so that the
/// jitter of a prediction from a grid is not taken for one.
const BETTER: f64 = 0.2;
/// A scan goes on where a linearisation promises less than this part of `Δ` at the end.
const PROMISE: f64 = 0.75;
/// Such a fit is no worse than the end by this factor of `Δ`.
const NEARLY_AS_GOOD: f64 = 2.0;
/// No linearisation is trusted farther than this, a factor of 1.4 for a logarithm.
const TRUSTED: f64 = 0.35;
/// Constrained fits on one side before it counts as open.
const MOST_POINTS: usize = 24;
/// Halvings of a stride to where the model has no prediction.
const MOST_RETREATS: usize = 4;

/// One point of a profile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProfilePoint {
    /// The unknown.
    pub value: f64,
    /// `Δ`, how much worse the best fit with this value is than the best of all, in units of χ².
    pub delta_chi_squared: f64,
}

/// Why a side of an interval is open.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Open {
    /// The bound of the range came first.
    Bound,
    /// The model ends before.
    Model,
}

/// One side of a profile.
#[derive(Debug, Clone)]
pub(crate) struct Side {
    /// Where `Δ` reaches the target, in the coordinate of the unknown, or why nowhere.
    pub end: Result<f64, Open>,
    /// Points in the coordinate, outward from the best fit, which is not among them: `x` and `Δ`.
    pub points: Vec<(f64, f64)>,
}

/// What a scan found.
pub(crate) enum Scan {
    Side(Side),
    /// A better fit than the best.
    Better(Rc<Evaluation>),
}

/// The profile of one unknown under one covariance of the noise.
pub(crate) struct Profile<'s, 'p> {
    pub problem: &'p Problem,
    pub metric: &'s Metric<'p>,
    pub best: &'s Minimum,
    pub unknown: usize,
    /// The unknowns that follow.
    pub others: &'s [usize],
    /// Standard error of the unknown in its coordinate.
    pub standard_error: f64,
    /// `z` at the end of the interval.
    pub target: f64,
}

/// A constrained fit of the scan.
struct Point {
    at: Rc<Evaluation>,
    x: f64,
    /// `√Δ`.
    z: f64,
    /// `dz/d|x|`.
    slope: f64,
    /// How the others follow, `dx_k/dx_j`, over all unknowns.
    tangent: Vec<f64>,
}

impl Profile<'_, '_> {
    /// Scans outward from the best fit, up for `sign` 1 and down for −1.
    pub fn side(&self, predictor: &mut Predictor, sign: f64) -> Result<Scan, IdentifyError> {
        self.outward(predictor, self.first()?, sign)
    }

    /// Scans on from the end of a side, where an evaluation from elsewhere promises a lower profile there: the others
    /// may have two valleys, and a scan follows one. Nothing where none does.
    pub fn beyond(
        &self,
        predictor: &mut Predictor,
        end: f64,
        sign: f64,
    ) -> Result<Option<Scan>, IdentifyError> {
        let Some(promised) = self.promised(predictor, end)? else {
            return Ok(None);
        };
        let Some(start) = predictor.evaluate(&promised)? else {
            return Ok(None);
        };
        match self.constrained(predictor, start, sign)? {
            Err(better) => Ok(Some(Scan::Better(better))),
            Ok(point) if point.z < (1.0 - NEAR) * self.target => {
                self.outward(predictor, point, sign).map(Some)
            }
            Ok(_) => Ok(None),
        }
    }

    /// Where the linearisation of a fit nearly as good as the end has a lower profile there.
    fn promised(&self, predictor: &Predictor, x: f64) -> Result<Option<Vec<f64>>, IdentifyError> {
        let search = self.search();
        let end = self.target * self.target;
        let above = |system: &System| system.chi_squared - self.best.system.chi_squared;
        let mut least = PROMISE * end;
        let mut found = None;
        for known in predictor
            .evaluations()
            .filter(|known| self.is_beside(known))
        {
            if above(&self.metric.system(known)) > NEARLY_AS_GOOD * end {
                continue;
            }
            let (position, system) = search.linear_minimum(known, self.unknown, x)?;
            if above(&system) < least && farthest(&position, &known.position) <= TRUSTED {
                (least, found) = (above(&system), Some(position));
            }
        }
        Ok(found)
    }

    /// Whether what is held is the same there.
    fn is_beside(&self, known: &Evaluation) -> bool {
        let best = &self.best.at.position;
        let is_held = |j: &usize| *j != self.unknown && !self.others.contains(j);
        let mut held = (0..best.len()).filter(is_held);
        held.all(|j| known.position[j].to_bits() == best[j].to_bits())
    }

    fn search(&self) -> Search<'_, '_> {
        Search {
            problem: self.problem,
            metric: self.metric,
            free: self.others,
            stopping: Stopping {
                tolerance: CONSTRAINED,
                degrees: None,
            },
        }
    }

    fn outward(
        &self,
        predictor: &mut Predictor,
        mut inner: Point,
        sign: f64,
    ) -> Result<Scan, IdentifyError> {
        let [low, high] = self.problem.unknowns()[self.unknown].bounds();
        let bound = if sign > 0.0 { high } else { low };
        let mut outer: Option<Point> = None;
        let mut points = Vec::new();
        let done = |end, points| Ok(Scan::Side(Side { end, points }));
        for _ in 0..MOST_POINTS {
            if sign * (bound - inner.x) <= 0.0 {
                return done(Err(Open::Bound), points);
            }
            let wanted = self.next(&inner, outer.as_ref(), sign, bound);
            let Some(point) = self.reach(predictor, &inner, wanted, sign)? else {
                return done(Err(Open::Model), points);
            };
            let point = match point {
                Ok(point) => point,
                Err(better) => return Ok(Scan::Better(better)),
            };
            points.push((point.x, point.z * point.z));
            if (point.z - self.target).abs() <= NEAR * self.target {
                let end = point.x + sign * (self.target - point.z) / point.slope;
                let outside = sign * (end - bound) > 0.0;
                return done(if outside { Err(Open::Bound) } else { Ok(end) }, points);
            }
            if point.z < self.target {
                inner = point;
            } else {
                outer = Some(point);
            }
        }
        done(Err(Open::Bound), points)
    }

    /// The best fit as the first point.
    fn first(&self) -> Result<Point, IdentifyError> {
        Ok(Point {
            x: self.best.at.position[self.unknown],
            at: Rc::clone(&self.best.at),
            z: 0.0,
            slope: 1.0 / self.standard_error,
            tangent: self.tangent(self.best)?,
        })
    }

    /// The coordinate to try next.
    fn next(&self, inner: &Point, outer: Option<&Point>, sign: f64, bound: f64) -> f64 {
        let Some(outer) = outer else {
            let stride = (self.target - inner.z) / inner.slope;
            // A profile that no longer rises tells nothing about the distance.
            let stride = if stride > 0.0 {
                stride.min(LONGEST_STRIDE)
            } else {
                LONGEST_STRIDE
            };
            let x = inner.x + sign * stride;
            return if sign * (x - bound) > 0.0 { bound } else { x };
        };
        let width = (outer.x - inner.x).abs();
        let part = bracketed(inner, outer, width, self.target);
        inner.x + sign * width * part
    }

    /// The constrained fit at a coordinate, or nearer where the model has no prediction there. `Err` is a better fit.
    fn reach(
        &self,
        predictor: &mut Predictor,
        inner: &Point,
        wanted: f64,
        sign: f64,
    ) -> Result<Option<Result<Point, Rc<Evaluation>>>, IdentifyError> {
        let mut x = wanted;
        for _ in 0..MOST_RETREATS {
            if let Some(start) = predictor.evaluate(&self.follow(inner, x))? {
                return self.constrained(predictor, start, sign).map(Some);
            }
            x = f64::midpoint(inner.x, x);
        }
        Ok(None)
    }

    /// Where the tangent of the others leads.
    fn follow(&self, inner: &Point, x: f64) -> Vec<f64> {
        let mut position = inner.at.position.clone();
        let step = x - inner.x;
        for &k in self.others {
            let [low, high] = self.problem.unknowns()[k].bounds();
            position[k] = (position[k] + step * inner.tangent[k]).clamp(low, high);
        }
        position[self.unknown] = x;
        position
    }

    fn constrained(
        &self,
        predictor: &mut Predictor,
        start: Rc<Evaluation>,
        sign: f64,
    ) -> Result<Result<Point, Rc<Evaluation>>, IdentifyError> {
        let search = self.search();
        let fit = search.descend(predictor, start, |_| false)?;
        let above = fit.system.chi_squared - self.best.system.chi_squared + self.best.remaining;
        if above < -BETTER {
            return Ok(Err(fit.at));
        }
        // What a search that found no end could gain is not known.
        let gain = if fit.converged { fit.remaining } else { 0.0 };
        let z = (above - gain).max(0.0).sqrt();
        let equations = NormalEquations::new(&fit.system, &search.moving(&fit));
        // The residual after the rest of the step, and from it dΔ/dx_j = −2 J_jᵀ r.
        let rest = fit.system.after(&equations.full_step()?);
        let column = &fit.system.jacobian[self.unknown];
        let rise = -2.0 * sign * dot(column, &rest);
        Ok(Ok(Point {
            x: fit.at.position[self.unknown],
            slope: rise / (2.0 * z.max(f64::MIN_POSITIVE)),
            z,
            tangent: self.tangent(&fit)?,
            at: fit.at,
        }))
    }

    /// `dx_k/dx_j = −(JᵀJ)⁻¹ Jᵀ J_j` of the others.
    fn tangent(&self, fit: &Minimum) -> Result<Vec<f64>, IdentifyError> {
        let mut pulled = fit.system.clone();
        pulled.residual = fit.system.jacobian[self.unknown]
            .iter()
            .map(|v| -v)
            .collect();
        NormalEquations::new(&pulled, self.others).full_step()
    }
}

/// Where between two points, as a part of their distance, the cubic through both with their slopes reaches the target.
fn bracketed(inner: &Point, outer: &Point, width: f64, target: f64) -> f64 {
    let hermite = |t: f64| {
        let (t2, t3) = (t * t, t * t * t);
        (2.0 * t3 - 3.0 * t2 + 1.0) * inner.z
            + (t3 - 2.0 * t2 + t) * width * inner.slope
            + (3.0 * t2 - 2.0 * t3) * outer.z
            + (t3 - t2) * width * outer.slope
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..50 {
        let middle = f64::midpoint(low, high);
        if hermite(middle) < target {
            low = middle;
        } else {
            high = middle;
        }
    }
    // Away from both ends, so that the bracket always shrinks.
    f64::midpoint(low, high).clamp(0.05, 0.95)
}
