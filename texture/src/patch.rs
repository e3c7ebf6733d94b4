//! One cell of a bicubic surface between four samples, and its highest point.
//!
//! With heights `f`, slopes `f_x`, `f_y` and twists `f_xy` at the corners (in units of the distance between samples),
//! the cell is the bicubic polynomial of the Bernstein coefficients
//!
//! ```text
//! f,   f ± f_x/3,   f ± f_y/3,   f ± f_x/3 ± f_y/3 ± f_xy/9      at each corner, signs towards the inside.
//! ```
//!
//! The largest coefficient bounds the surface from above (convex hull property), and is attained at a corner.

/// Points along each axis from which the highest point is sought; a cell has few summits.
const STARTS: u32 = 5;

/// Most steps from one start; quadratic convergence needs a handful, a curved crest some more.
const MOST_STEPS: usize = 60;

/// Halvings of a step that does not rise.
const HALVINGS: usize = 30;

/// Steps shorter than this, in samples, are no longer judged by the height, which rounding hides: the slope is.
const SHORT: f64 = 1e-4;

/// Steps shorter than this are rounding.
const ROUNDING: f64 = 1e-15;

/// Height, slopes and twist at a corner.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Corner {
    pub(crate) height: f64,
    pub(crate) along_x: f64,
    pub(crate) along_y: f64,
    pub(crate) twist: f64,
}

impl Corner {
    /// The largest coefficient that a cell has at this corner, on whichever side it lies.
    pub(crate) fn bound(&self) -> f64 {
        let slopes = (self.along_x.abs() + self.along_y.abs()) / 3.0;
        self.height + slopes + self.twist.abs() / 9.0
    }
}

/// The Bernstein coefficients of a cell, first index x.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patch([[f64; 4]; 4]);

/// Height, slopes, and second derivatives (xx, xy, yy) at a point of a cell.
struct Derivatives {
    height: f64,
    slopes: [f64; 2],
    bends: [f64; 3],
}

impl Patch {
    /// The cell between corners `[x][y]`.
    pub(crate) fn new(corners: [[Corner; 2]; 2]) -> Self {
        let coefficient = |a: usize, b: usize| {
            let corner = corners[a / 2][b / 2];
            let step = |index: usize| match index {
                1 => 1.0 / 3.0,
                2 => -1.0 / 3.0,
                _ => 0.0,
            };
            let (x, y) = (step(a), step(b));
            corner.height + x * corner.along_x + y * corner.along_y + x * y * corner.twist
        };
        Self([0, 1, 2, 3].map(|a| [0, 1, 2, 3].map(|b| coefficient(a, b))))
    }

    /// An upper bound of the surface.
    pub(crate) fn bound(&self) -> f64 {
        self.0
            .as_flattened()
            .iter()
            .copied()
            .fold(f64::NEG_INFINITY, f64::max)
    }

    /// The height at a point of the unit square.
    fn height(&self, at: [f64; 2]) -> f64 {
        self.derivatives(at).height
    }

    fn derivatives(&self, [u, v]: [f64; 2]) -> Derivatives {
        let along_y = self.0.map(|line| bernstein(line, v));
        let of = |order: usize| bernstein(along_y.map(|derivatives| derivatives[order]), u);
        let [height, along_x, xx] = of(0);
        let [along_y, xy, _] = of(1);
        let [yy, _, _] = of(2);
        Derivatives {
            height,
            slopes: [along_x, along_y],
            bends: [xx, xy, yy],
        }
    }

    /// The summits reached from several starts, as points of the unit square.
    pub(crate) fn summits(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        (0..STARTS * STARTS).map(|k| {
            let start = [k / STARTS, k % STARTS].map(|i| f64::from(i) / f64::from(STARTS - 1));
            self.climb(start)
        })
    }

    /// Climbs from a point to a summit within the unit square: Newton's method, or along the slope where the surface is
    /// not convex.
    fn climb(&self, start: [f64; 2]) -> [f64; 2] {
        let mut at = start;
        for _ in 0..MOST_STEPS {
            let here = self.derivatives(at);
            let step = step(&here, at);
            let moved = |part: f64| [0, 1].map(|i| (at[i] + part * step[i]).clamp(0.0, 1.0));
            let length = step[0].abs().max(step[1].abs());
            if length < SHORT {
                at = moved(1.0);
                if length < ROUNDING {
                    break;
                }
                continue;
            }
            let mut part = 1.0;
            let mut halvings = 0;
            while self.height(moved(part)) <= here.height && halvings < HALVINGS {
                part *= 0.5;
                halvings += 1;
            }
            if halvings == HALVINGS {
                break;
            }
            at = moved(part);
        }
        at
    }
}

/// The step from a point of the unit square towards the summit.
fn step(here: &Derivatives, at: [f64; 2]) -> [f64; 2] {
    let Derivatives {
        slopes: [x, y],
        bends: [xx, xy, yy],
        ..
    } = *here;
    let is_free = |slope: f64, at: f64| !((at <= 0.0 && slope < 0.0) || (at >= 1.0 && slope > 0.0));
    // Along one axis: to the zero of the slope, or up to the border.
    let alone = |slope: f64, bend: f64| {
        if slope == 0.0 {
            0.0
        } else if bend < 0.0 {
            (-slope / bend).clamp(-1.0, 1.0)
        } else {
            slope.signum()
        }
    };
    match (is_free(x, at[0]), is_free(y, at[1])) {
        (false, false) => [0.0; 2],
        (true, false) => [alone(x, xx), 0.0],
        (false, true) => [0.0, alone(y, yy)],
        (true, true) => {
            let determinant = xx * yy - xy * xy;
            // −H⁻¹ ∇f
            let newton = [
                (xy * y - yy * x) / determinant,
                (xy * x - xx * y) / determinant,
            ];
            let is_convex = xx < 0.0 && determinant > 0.0;
            let length = newton[0].abs().max(newton[1].abs()).max(1.0);
            if is_convex && length.is_finite() {
                return newton.map(|step| step / length);
            }
            // Upwards along each axis by itself.
            [alone(x, xx), alone(y, yy)]
        }
    }
}

/// Value, first and second derivative of a cubic in Bernstein form.
fn bernstein([a, b, c, d]: [f64; 4], t: f64) -> [f64; 3] {
    let rest = 1.0 - t;
    let mix = |a: f64, b: f64| rest * a + t * b;
    let [ab, bc, cd] = [mix(a, b), mix(b, c), mix(c, d)];
    let slope = 3.0 * (mix(b - a, c - b) * rest + mix(c - b, d - c) * t);
    let bend = 6.0 * mix((c - b) - (b - a), (d - c) - (c - b));
    [mix(mix(ab, bc), mix(bc, cd)), slope, bend]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The cell of `f = c − (u − u₀)² − k (u − u₀)(v − v₀) − (v − v₀)²`.
    fn of_bowl([u0, v0]: [f64; 2], k: f64) -> Patch {
        let corner = |u: f64, v: f64| Corner {
            height: 3.0 - (u - u0).powi(2) - k * (u - u0) * (v - v0) - (v - v0).powi(2),
            along_x: -2.0 * (u - u0) - k * (v - v0),
            along_y: -2.0 * (v - v0) - k * (u - u0),
            twist: -k,
        };
        Patch::new([0.0, 1.0].map(|u| [0.0, 1.0].map(|v| corner(u, v))))
    }

    #[test]
    fn the_summit_of_a_quadratic_is_found_from_everywhere_and_bounded() {
        // Round, and a crest 30 times as long as wide across the axes.
        for k in [0.0, 1.0, 1.998, -1.998] {
            let patch = of_bowl([0.3, 0.6], k);
            assert!(patch.bound() >= 3.0);
            for [u, v] in patch.summits() {
                // The long crest amplifies the rounding of its slopes 1000 times.
                assert!((u - 0.3).hypot(v - 0.6) < 1e-12, "{k}: {u}, {v}");
                assert!((patch.height([u, v]) - 3.0).abs() < 2e-15);
            }
        }
    }

    #[test]
    fn a_summit_beyond_the_cell_leaves_its_border() {
        let patch = of_bowl([1.4, 0.25], 0.0);
        for [u, v] in patch.summits() {
            assert!(u == 1.0 && (v - 0.25).abs() < 1e-15, "{u}, {v}");
            assert!((patch.height([u, v]) - 2.84).abs() < 1e-15);
        }
    }
}
