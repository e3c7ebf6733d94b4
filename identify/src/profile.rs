//! The profile of the likelihood: how far an unknown can move while the others adjust.
//!
//! `Δ(x_j) = min over the others of χ² − least χ²` reaches the squared quantile of Student's distribution at the ends
//! of the interval: D. M. Bates and D. G. Watts, Nonlinear Regression Analysis and Its Applications (Wiley, 1988),
//! section 6.1. The scan goes outward in `z = √Δ`, which is nearly linear. Derivatives make it cheap: the others start
//! from their tangent, the remaining gain of the linear problem is subtracted without another prediction, and
//! `dΔ/dx_j = −2 J_jᵀ r` of the constrained fit leads to the next point and corrects the last. With `z` negative on one
//! side, `x_j(z)` and the others run smoothly through the best fit, so one side predicts the start of the other
//! (`bend.rs`).

mod bend;
mod point;
mod valley;

use std::rc::Rc;

use bend::Bend;
use point::{Point, bracketed, hermite};

use crate::{
    IdentifyError, Problem,
    least_squares::{LeastSquares, Minimum, Stopping, farthest},
    metric::Metric,
    normal_equations::NormalEquations,
    orthonormal_basis::dot,
    predictor::{Evaluation, Predictor},
};

/// A scan may end when `z` is within this fraction of its target, and a cubic bridges the rest, …
const NEAR: f64 = 0.25;
/// … or within this fraction where a bound of another unknown bends the profile, …
const NEAR_A_KINK: f64 = 0.05;
/// … provided that the tangent at the last point leads to the same end within this fraction of the standard error. The
/// error of the cubic itself is one power of `z` higher, a fraction of that.
const AGREEMENT: f64 = 0.03;
/// Longest stride of a scan: a factor of four for a logarithm.
const LONGEST_STRIDE: f64 = 1.4;
/// Tolerance of the constrained fits, in units of χ²; the remaining gain is subtracted as if the problem were linear.
const CONSTRAINED: f64 = 0.1;
/// A profile lower than the best fit by this has found a better fit. It is a twentieth of χ² at level 0.95, so that the
/// jitter of a prediction from a grid does not count as one.
const BETTER: f64 = 0.2;
/// Nor does a part of a huge χ² that is below the accuracy of predictions.
const BETTER_PART: f64 = 1e-9;
/// No linearisation is trusted farther than this: a factor of 1.4 for a logarithm.
const TRUSTED: f64 = 0.35;
/// Number of constrained fits on one side before it counts as open.
const MOST_POINTS: usize = 24;
/// Number of halvings of a stride that ends where the model has no prediction.
const MOST_RETREATS: usize = 4;

/// One point of a profile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProfilePoint {
    /// Value of the unknown.
    pub value: f64,
    /// `Δ`, the increase of χ² of the best fit with this value over the overall best fit.
    pub delta_chi_squared: f64,
}

/// Why a side of an interval is open.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Open {
    /// The bound of the range is reached first.
    Bound,
    /// The model has no prediction that far out.
    Model,
}

/// One side of a profile.
#[derive(Debug, Clone)]
pub(crate) struct ProfileSide {
    /// Coordinate of the unknown at which `Δ` reaches the target, or the reason why it does not.
    pub end: Result<f64, Open>,
    /// Points `x` and `Δ`, in the coordinate, outward from the best fit, which is not included.
    pub points: Vec<(f64, f64)>,
    /// The bend of the profile, if the scan reached its end.
    pub bend: Option<Bend>,
}

/// The result of a scan.
pub(crate) enum Scan {
    Side(ProfileSide),
    /// A fit better than the best one so far.
    Better(Rc<Evaluation>),
}

/// The profile of one unknown under one covariance of the noise.
pub(crate) struct LikelihoodProfile<'s, 'p> {
    pub problem: &'p Problem,
    pub metric: &'s Metric<'p>,
    pub best: &'s Minimum,
    pub unknown: usize,
    /// The other unknowns, which adjust.
    pub others: &'s [usize],
    /// Standard error of the unknown in its coordinate.
    pub standard_error: f64,
    /// `z` at the end of the interval.
    pub target: f64,
}

impl LikelihoodProfile<'_, '_> {
    /// Scans outward from the best fit, up for `sign` 1 and down for −1. The first stride follows the bend of the other
    /// side, if it is known.
    pub fn side(
        &self,
        predictor: &mut Predictor,
        sign: f64,
        bend: Option<&Bend>,
    ) -> Result<Scan, IdentifyError> {
        let first = self.first()?;
        let guess = bend.and_then(|bend| self.guess(bend, &first, sign));
        self.outward(predictor, first, guess, sign)
    }

    fn search(&self) -> LeastSquares<'_, '_> {
        LeastSquares {
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
        mut guess: Option<Vec<f64>>,
        sign: f64,
    ) -> Result<Scan, IdentifyError> {
        let bound = self.bound(sign);
        let mut outer: Option<Point> = None;
        let mut points = Vec::new();
        let done = |end, points| {
            let bend = None;
            Ok(Scan::Side(ProfileSide { end, points, bend }))
        };
        for _ in 0..MOST_POINTS {
            if sign * (bound - inner.x) <= 0.0 {
                return done(Err(Open::Bound), points);
            }
            let start = guess.take().unwrap_or_else(|| {
                let wanted = self.next(&inner, outer.as_ref(), sign, bound);
                self.follow(&inner, wanted)
            });
            let Some(point) = self.reach(predictor, &inner, start, sign)? else {
                return done(Err(Open::Model), points);
            };
            let point = match point {
                Ok(point) => point,
                Err(better) => return Ok(Scan::Better(better)),
            };
            points.push((point.x, point.z * point.z));
            if let Some(end) = self.end(&inner, &point, sign) {
                let outside = sign * (end - bound) > 0.0;
                return Ok(Scan::Side(ProfileSide {
                    end: if outside { Err(Open::Bound) } else { Ok(end) },
                    points,
                    bend: Bend::between(&self.first()?, &point, sign),
                }));
            }
            if point.z < self.target {
                inner = point;
            } else {
                outer = Some(point);
            }
        }
        done(Err(Open::Bound), points)
    }

    /// The bound in the direction of the scan.
    fn bound(&self, sign: f64) -> f64 {
        let [low, high] = self.problem.unknowns()[self.unknown].bounds();
        if sign > 0.0 { high } else { low }
    }

    /// The end of the interval, if it is known well enough: from the cubic `x(z)` through two points with their slopes,
    /// if it agrees with the tangent at the second.
    fn end(&self, inner: &Point, point: &Point, sign: f64) -> Option<f64> {
        let left = self.target - point.z;
        if left.abs() > NEAR * self.target || !(point.slope > 0.0 && inner.slope > 0.0) {
            return None;
        }
        let tangent = left / point.slope;
        let ends = [inner, point].map(|of| [of.z, -(of.x - point.x).abs(), 1.0 / of.slope]);
        let cubic = hermite(ends, self.target);
        let end = point.x + sign * cubic;
        let is_smooth = self.keeps_bounds(inner, point, end);
        // Where the profile bends strongly, the standard error exceeds the actual length of a unit step in z.
        let one = (end - self.best.at.position[self.unknown]).abs() / self.target;
        let agrees = (cubic - tangent).abs() <= AGREEMENT * one.min(self.standard_error);
        (agrees && (is_smooth || left.abs() <= NEAR_A_KINK * self.target)).then_some(end)
    }

    /// Whether no bound begins or ceases to hold another unknown between the first point and the end, which would put a
    /// kink in the profile, and the end itself is within the bounds.
    fn keeps_bounds(&self, inner: &Point, point: &Point, end: f64) -> bool {
        let step = end - point.x;
        let is_held = |of: &Point, k: usize| {
            let [low, high] = self.problem.unknowns()[k].bounds();
            let x = of.at.position[k];
            x <= low || x >= high
        };
        let keeps = |&k: &usize| {
            let [low, high] = self.problem.unknowns()[k].bounds();
            let there = point.at.position[k] + step * point.tangent[k];
            is_held(inner, k) == is_held(point, k)
                && (is_held(point, k) || (low..=high).contains(&there))
        };
        let [low, high] = self.problem.unknowns()[self.unknown].bounds();
        (low..=high).contains(&end) && self.others.iter().all(keeps)
    }

    /// The end predicted by the bend of the other side: the unknown and the others there; `None` if that is farther
    /// than a scan may stride.
    fn guess(&self, bend: &Bend, first: &Point, sign: f64) -> Option<Vec<f64>> {
        let bound = self.bound(sign);
        let stride = sign * bend.stride(self.standard_error, sign * self.target);
        let is_likely = stride > 0.0 && stride <= LONGEST_STRIDE;
        let to_bound = sign * (bound - first.x);
        is_likely.then(|| {
            let stride = sign * stride.min(to_bound);
            let x = if stride.abs() < to_bound {
                first.x + stride
            } else {
                bound
            };
            self.placed(x, |k| first.at.position[k] + bend.follow(first, k, stride))
        })
    }

    /// The best fit as the first point.
    fn first(&self) -> Result<Point, IdentifyError> {
        Ok(Point {
            x: self.best.at.position[self.unknown],
            at: Rc::clone(&self.best.at),
            least: self.best.at.position.clone(),
            z: 0.0,
            slope: 1.0 / self.standard_error,
            tangent: self.tangent(self.best)?,
        })
    }

    /// The coordinate to try next.
    fn next(&self, inner: &Point, outer: Option<&Point>, sign: f64, bound: f64) -> f64 {
        let Some(outer) = outer else {
            let stride = (self.target - inner.z) / inner.slope;
            // A profile that no longer rises says nothing about the distance.
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

    /// The constrained fit from a starting point, or from a nearer one if the model has no prediction there. `Err`
    /// holds a better fit.
    fn reach(
        &self,
        predictor: &mut Predictor,
        inner: &Point,
        mut start: Vec<f64>,
        sign: f64,
    ) -> Result<Option<Result<Point, Rc<Evaluation>>>, IdentifyError> {
        for _ in 0..MOST_RETREATS {
            if let Some(start) = predictor.evaluate(&start)? {
                return self.constrained(predictor, start, sign).map(Some);
            }
            start = self.follow(inner, f64::midpoint(inner.x, start[self.unknown]));
        }
        Ok(None)
    }

    /// The point predicted by the tangent of the others.
    fn follow(&self, inner: &Point, x: f64) -> Vec<f64> {
        let step = x - inner.x;
        self.placed(x, |k| inner.least[k] + step * inner.tangent[k])
    }

    /// The point with the unknown at `x` and the others at their own coordinates, within the bounds.
    fn placed(&self, x: f64, of_other: impl Fn(usize) -> f64) -> Vec<f64> {
        let mut position = self.best.at.position.clone();
        for &k in self.others {
            let [low, high] = self.problem.unknowns()[k].bounds();
            position[k] = of_other(k).clamp(low, high);
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
        if above < -BETTER.max(BETTER_PART * self.best.system.chi_squared) {
            return Ok(Err(fit.at));
        }
        // The remaining gain is unknown if the search did not converge.
        let gain = if fit.converged { fit.remaining } else { 0.0 };
        let z = (above - gain).max(0.0).sqrt();
        let equations = NormalEquations::new(&fit.system, &search.moving(&fit));
        // The residual after the rest of the step, and from it dΔ/dx_j = −2 J_jᵀ r.
        let step = equations.full_step()?;
        let rest = fit.system.after(&step);
        let column = &fit.system.jacobian[self.unknown];
        let rise = -2.0 * sign * dot(column, &rest);
        Ok(Ok(Point {
            x: fit.at.position[self.unknown],
            slope: rise / (2.0 * z.max(f64::MIN_POSITIVE)),
            z,
            tangent: self.tangent(&fit)?,
            least: least(&fit, &step),
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

/// The minimum of the linear problem, if it lies within the range where its derivatives are trusted; otherwise the fit
/// itself.
fn least(fit: &Minimum, step: &[f64]) -> Vec<f64> {
    let pairs = fit.at.position.iter().zip(step);
    let least: Vec<f64> = pairs.map(|(x, s)| x + s).collect();
    if fit.converged && farthest(&least, &fit.at.position) <= TRUSTED {
        least
    } else {
        fit.at.position.clone()
    }
}
