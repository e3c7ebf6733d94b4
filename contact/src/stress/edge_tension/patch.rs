//! The tension at one point of the edge, continued from the elements around it.
//!
//! At the edge the traction vanishes, so the tension is the larger principal value of the tensor `N + T` along the
//! surface, under the pressure and under the traction. With `p = K √s` at the depth s inside an edge with the normal n
//! and the tangent t,
//!
//! ```text
//! N = −p (n⊗n + 2ν t⊗t) + smooth       T analytic inside, with a cusp √|s| outside
//! ```
//!
//! where the smooth part has a term `s^{3/2}` inside, from the edge's curvature. N without its cusp is fitted across
//! the edge, T from inside alone and without the two outermost elements, whose pressures are 5 to 15 % off.

use super::edge_contact::{EdgeContact, Place};
use super::least_squares::LeastSquares;
use super::outline::EdgePoint;
use super::surface_parts::{Part, SurfaceParts, Tensor, larger_eigenvalue};

/// Distances from the point (elements) of the elements in contact to whose p² a quadratic is fitted.
const PRESSURES: [f64; 2] = [1.2, 6.0];
/// Depths inside the edge between which N and T are fitted, and half widths of the fits along the edge, in elements.
const NORMAL: [f64; 2] = [-2.5, 2.5];
const NORMAL_ALONG: f64 = 4.1;
const TANGENTIAL: [f64; 2] = [1.9, 5.9];
const TANGENTIAL_LINEAR: [f64; 2] = [1.9, 4.9];
const TANGENTIAL_ALONG: f64 = 2.1;
/// Weights fall from 1 to 0 over twice this distance around the ends of a fit, so that fits vary continuously with the
/// load.
const TAPER: f64 = 0.3;
/// Elements farther from the edge than this, plus the sagitta of an edge of the least radius, lie on the side of the
/// edge that their depth says.
const NEAR_EDGE: f64 = 0.8;
/// Least radius of a resolved contact, in elements: below it the patches of opposite edges overlap.
const LEAST_RADIUS: f64 = 7.0;
/// Farthest element of a patch from its point, in elements.
const REACH: isize = 7;

/// The tension continued to a point of the edge.
#[derive(Clone, Copy, Debug)]
pub struct Continued {
    /// Larger principal stress along the surface, in Pa.
    pub value: f64,
    /// The difference between continuations of T with and without a term in s², in Pa.
    pub uncertainty: f64,
    /// Whether the contact around the point is wide and its edge smooth on the scale of the elements.
    pub is_regular: bool,
}

/// The elements around a point of the edge, seen along the edge's normal.
pub struct Patch<'a> {
    contact: &'a EdgeContact<'a>,
    point: EdgePoint,
    normal: [f64; 2],
    /// Coefficients of 1, x, y, x², xy, y² of p² around the point.
    square: [f64; 6],
}

impl<'a> Patch<'a> {
    /// The patch around a point; none if too few elements around it are in contact.
    pub fn new(contact: &'a EdgeContact<'a>, point: EdgePoint) -> Option<Self> {
        let mut fit = LeastSquares::<6, 1>::new();
        let [from, to] = PRESSURES;
        for place in around(point.at) {
            let [x, y] = offset(place, point.at);
            let (distance, p) = (x.hypot(y), contact.pressure(place));
            if p > 0.0 {
                let weight = taper(distance - from) * taper(to - distance);
                if weight > 0.0 {
                    fit.add(weight, [1.0, x, y, x * x, x * y, y * y], [p * p]);
                }
            }
        }
        let [square] = fit.solve()?;
        let patch = Self {
            contact,
            point,
            normal: [0.0; 2],
            square,
        };
        let normal = patch.normal_at([0.0; 2])?;
        let [m, n] = point.outward;
        (normal[0] * m + normal[1] * n > 0.0).then_some(Self { normal, ..patch })
    }

    pub fn point(&self) -> EdgePoint {
        self.point
    }

    /// `−∇p²/|∇p²|` at an offset from the point.
    fn normal_at(&self, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
        let [_, bx, by, bxx, bxy, byy] = self.square;
        let gradient = [bx + 2.0 * bxx * x + bxy * y, by + bxy * x + 2.0 * byy * y];
        let length = gradient[0].hypot(gradient[1]);
        (length > 0.0).then(|| gradient.map(|along| -along / length))
    }

    /// Depth inside the edge, and the distance along it, in elements.
    fn depth_and_along(&self, place: Place) -> [f64; 2] {
        let ([x, y], [nx, ny]) = (offset(place, self.point.at), self.normal);
        [-(x * nx + y * ny), y * nx - x * ny]
    }

    /// The elements that the fits of a part need.
    pub fn places(&self, part: Part) -> impl Iterator<Item = Place> {
        around(self.point.at).filter(move |place| self.weight(part, *place) > 0.0)
    }

    fn weight(&self, part: Part, place: Place) -> f64 {
        let (depths, half_width) = match part {
            Part::Normal => (NORMAL, NORMAL_ALONG),
            Part::Tangential => (TANGENTIAL, TANGENTIAL_ALONG),
        };
        let [s, t] = self.depth_and_along(place);
        let weight = within(s, depths) * taper(half_width - t.abs());
        if part == Part::Tangential && !self.contact.is_in_contact(place) {
            return 0.0;
        }
        weight
    }

    /// The tension at the point; none if the elements do not determine it.
    pub fn continued(
        &self,
        parts: &SurfaceParts,
        poisson_ratio: f64,
        slides: bool,
    ) -> Option<Continued> {
        let normal = self.normal_part(parts, poisson_ratio)?;
        let [quadratic, linear] = if slides {
            self.tangential_part(parts)?
        } else {
            [[0.0; 3]; 2]
        };
        let value = |tangential: Tensor| {
            larger_eigenvalue(std::array::from_fn(|i| normal[i] + tangential[i]))
        };
        Some(Continued {
            value: value(quadratic),
            uncertainty: (value(quadratic) - value(linear)).abs(),
            is_regular: self.is_regular(),
        })
    }

    /// N at the point.
    fn normal_part(&self, parts: &SurfaceParts, poisson_ratio: f64) -> Option<Tensor> {
        let mut fit = LeastSquares::<6, 3>::new();
        for place in self.places(Part::Normal) {
            let [s, t] = self.depth_and_along(place);
            let mut stress = parts.at(Part::Normal, place);
            let p = self.contact.pressure(place);
            if p > 0.0 {
                // C = N + p (n⊗n + 2ν t⊗t) with the normal at the element itself
                let [nx, ny] = self.normal_at(offset(place, self.point.at))?;
                let across = 2.0 * poisson_ratio;
                stress[0] += p * (nx * nx + across * ny * ny);
                stress[1] += p * (ny * ny + across * nx * nx);
                stress[2] += p * nx * ny * (1.0 - across);
            }
            let terms = [1.0, s, t, t * t, s * t, s.max(0.0).powf(1.5)];
            fit.add(self.weight(Part::Normal, place), terms, stress);
        }
        Some(fit.solve()?.map(|[constant, ..]| constant))
    }

    /// T at the point, with and without a term in s².
    fn tangential_part(&self, parts: &SurfaceParts) -> Option<[Tensor; 2]> {
        let mut quadratic = LeastSquares::<6, 3>::new();
        let mut linear = LeastSquares::<5, 3>::new();
        for place in self.places(Part::Tangential) {
            let [s, t] = self.depth_and_along(place);
            let stress = parts.at(Part::Tangential, place);
            let weight = self.weight(Part::Tangential, place);
            quadratic.add(weight, [1.0, s, t, t * t, s * t, s * s], stress);
            let nearer = weight * within(s, TANGENTIAL_LINEAR);
            if nearer > 0.0 {
                linear.add(nearer, [1.0, s, t, t * t, s * t], stress);
            }
        }
        Some([
            quadratic.solve()?.map(|[constant, ..]| constant),
            linear.solve()?.map(|[constant, ..]| constant),
        ])
    }

    /// Whether the elements of the patch lie on the sides of the edge that their depths say, the contact goes on beyond
    /// the patch, and no pressure is cut.
    fn is_regular(&self) -> bool {
        let is_as_said = |place: Place| {
            let [s, t] = self.depth_and_along(place);
            let is_in_patch = s > NORMAL[0] && s < TANGENTIAL[1] && t.abs() < NORMAL_ALONG;
            let sagitta = 0.5 * t * t / LEAST_RADIUS;
            let is_clear = s.abs() > NEAR_EDGE + sagitta
                && s.abs() + t * t / LEAST_RADIUS < 2.0 * LEAST_RADIUS;
            let p = self.contact.pressure(place);
            !is_in_patch || p < self.contact.hardness && (!is_clear || (p > 0.0) == (s > 0.0))
        };
        let across = (2..)
            .map(f64::from)
            .take_while(|s| *s < 2.0 * LEAST_RADIUS - NEAR_EDGE);
        let mut inside = across.map(|s| {
            [0, 1].map(|axis: usize| {
                crate::stress::nearest(self.point.at[axis] - s * self.normal[axis])
            })
        });
        around(self.point.at).all(is_as_said)
            && inside.all(|place| self.contact.is_in_contact(place))
    }
}

/// The elements within the reach of a patch.
fn around(at: [f64; 2]) -> impl Iterator<Item = Place> {
    let [i, j] = at.map(crate::stress::nearest);
    (-REACH..=REACH).flat_map(move |m| (-REACH..=REACH).map(move |n| [i + m, j + n]))
}

fn offset(place: Place, from: [f64; 2]) -> [f64; 2] {
    [0, 1].map(|axis: usize| place[axis] as f64 - from[axis])
}

/// 0 below −[`TAPER`], 1 above it.
fn taper(distance: f64) -> f64 {
    (0.5 + 0.5 * distance / TAPER).clamp(0.0, 1.0)
}

fn within(s: f64, [from, to]: [f64; 2]) -> f64 {
    taper(s - from) * taper(to - s)
}
