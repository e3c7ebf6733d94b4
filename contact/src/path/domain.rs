//! The first guess for the side of the domain.
//!
//! The contact radius `a` is estimated from axisymmetric closed forms with the indenter's profile averaged around
//! its axis: on the elastic foundation (Galin; Sneddon 1965)
//!
//! ```text
//! Q_e(a) = 2 E*(a) a² ∫₀^{π/2} f′(a sin θ) sin²θ dθ,    E*(a) = 2 / (k C(k)) at k = 1/a,
//! ```
//!
//! on the relief's springs alone `Q_w(a) = (φ/η) ∫₀^a (f(a) − f(ρ)) 2πρ dρ`, and on both in series
//! `1/Q = 1/Q_e + 1/Q_w`. For nonlinear springs η is `w*/p` at the mean pressure. The estimate only sets the first
//! domain tried: [`choose_side`](crate::choose_side) checks by a solution on a coarse grid whether it is large enough.

pub mod choice;
pub(crate) mod root_finding;

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::LazyLock;

use pellicle_texture::{Grid, Relief};

use crate::{Boundary, ContactError, Indenter, Load, Model, Profile as _};
use root_finding::where_zero;

/// The square on which the problem is solved.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Domain {
    /// A fixed square of this side (m); a contact near its edge gives a warning.
    Side(f64),
    /// A square of this side (m), chosen by [`choose_side`](crate::choose_side); enlarged if a contact reaches its edge
    /// after all.
    Chosen(f64),
    /// [Chosen](crate::choose_side) for the loads, large enough for the contact and the same for every grid.
    #[default]
    Automatic,
    /// A cell of this side (m) that repeats infinitely in both directions, with everything in it. Forces are those on
    /// one cell. On a half-space the mean displacement of the surface is infinite, so penetrations are measured from
    /// the mean plane of the deformed surface, and none can be prescribed.
    Periodic(f64),
    /// The same for a cell of these sides along x and y (m), a whole number of square elements each.
    Oblong([f64; 2]),
}

impl Domain {
    /// The boundary condition of the square.
    #[must_use]
    pub fn boundary(self) -> Boundary {
        match self {
            Self::Side(_) | Self::Chosen(_) | Self::Automatic => Boundary::Free,
            Self::Periodic(_) | Self::Oblong(_) => Boundary::Periodic,
        }
    }

    /// The grid of `size` elements along the longer side (m).
    pub(crate) fn grid(self, side: f64, size: usize) -> Result<Grid, ContactError> {
        let Self::Oblong(sides) = self else {
            return Ok(Grid::new(side, size)?);
        };
        let lengths = Grid::lengths_of(sides, size);
        let lengths = lengths.ok_or(ContactError::NotSquareElements { sides, size })?;
        Ok(Grid::oblong(side, lengths)?)
    }
}

/// Half the side over the estimated contact radius; the estimate is accurate to about 20 %.
const MARGIN: f64 = 1.5;
/// Iterations for the stiffness of the springs at the mean pressure, which give that pressure to a few percent.
const STIFFENINGS: usize = 10;
/// Midpoints of the quadratures over the profile; the estimate needs no more.
const POINTS: usize = 64;
/// `sin θ` at the midpoints of `0 … π/2`.
static SINES: LazyLock<[f64; POINTS]> = LazyLock::new(|| {
    let step = FRAC_PI_2 / POINTS as f64;
    std::array::from_fn(|i| ((i as f64 + 0.5) * step).sin())
});

/// A contact that would come closer to the rim of the indenter than this part of its radius ends there: slopes are
/// differences over a thousandth of the radius, which must not reach beyond the rim.
const RIM: f64 = 1e-2;

/// The side (m) of the square to try first for all `loads`: three times the largest estimated contact radius.
///
/// If no load makes contact, twice the radius at which the height of the indenter is the foundation's thickness, or its
/// distance from the surface (or 1 m). Under a plane it is the shorter side of the relief's map. See
/// [`choose_side`](crate::choose_side) for the square to solve on.
#[must_use]
pub fn default_side(model: &Model, loads: &[Load]) -> f64 {
    if let Some(side) = side_under_a_plane(model) {
        return side;
    }
    let radii = largest(loads).map(|load| contact_radius(model, load));
    let radius = radii.filter(|radius| *radius > 0.0).fold(0.0, f64::max);
    if radius > 0.0 {
        2.0 * MARGIN * radius
    } else {
        2.0 * unloaded_radius(model, loads)
    }
}

/// The shorter side of the map under a plane, m; none under another indenter or without a map.
fn side_under_a_plane(model: &Model) -> Option<f64> {
    match (&model.indenter, &model.relief) {
        (Indenter::Plane(_), Relief::Map(relief)) => Some(
            relief
                .map()
                .extent()
                .into_iter()
                .fold(f64::INFINITY, f64::min),
        ),
        _ => None,
    }
}

/// The same with a hardness (Pa), for which a force needs an area of at least `Q/p_max`.
pub(crate) fn default_side_at(model: &Model, loads: &[Load], hardness: f64) -> f64 {
    let plastic = loads.iter().map(|load| match load {
        Load::Force(force) => (force / hardness / PI).sqrt(),
        Load::Penetration(_) => 0.0,
    });
    let radius = plastic.fold(0.0, f64::max);
    default_side(model, loads).max(2.0 * MARGIN * radius)
}

/// The force (N) that presses the indenter to a penetration (m), by the closed forms of the first guess. Exact on
/// springs alone, and 2√2 times that of Hertz, since the contact radius is taken where the height of the indenter
/// equals the penetration. Where the indenter ends below that height, its end presses as a flat punch for the rest of
/// the penetration. 0 without contact.
#[must_use]
pub fn estimated_force(model: &Model, penetration: f64) -> f64 {
    if penetration.is_nan() || penetration <= 0.0 {
        return 0.0;
    }
    let radius = radius_at(model, penetration);
    if model
        .indenter
        .mean_profile(radius * (1.0 + RIM))
        .is_finite()
    {
        return estimated_force_at_radius(model, radius);
    }
    let inside = radius * (1.0 - RIM);
    let rest = penetration - model.indenter.mean_profile(inside);
    force_on_disc(model, inside, rest)
}

/// The largest force and the largest penetration of some loads, which give the widest contacts.
fn largest(loads: &[Load]) -> impl Iterator<Item = Load> {
    let force = loads.iter().filter_map(|load| match load {
        Load::Force(force) => Some(*force),
        Load::Penetration(_) => None,
    });
    let penetration = loads.iter().filter_map(|load| match load {
        Load::Force(_) => None,
        Load::Penetration(penetration) => Some(*penetration),
    });
    let force = force.reduce(f64::max).map(Load::Force);
    let penetration = penetration.reduce(f64::max).map(Load::Penetration);
    force.into_iter().chain(penetration)
}

/// A paraboloid's pressure `p0 √(1 − ρ²/a²)` with the estimated contact radius and force of a load: the start of the
/// coarsest grid.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Guess {
    /// `a`, in m.
    radius: f64,
    /// `p0 = 3 Q/(2π a²)`, in Pa.
    peak: f64,
}

impl Guess {
    /// None without contact.
    pub(crate) fn new(model: &Model, load: Load) -> Option<Self> {
        let radius = contact_radius(model, load);
        let force = match load {
            Load::Force(force) => force,
            Load::Penetration(_) => estimated_force_at_radius(model, radius),
        };
        let peak = 1.5 * force / (PI * radius * radius);
        (radius > 0.0 && peak.is_finite()).then_some(Self { radius, peak })
    }

    /// The pressure at a point, in Pa.
    pub(crate) fn pressure(&self, [x, y]: [f64; 2]) -> f64 {
        let ratio = x.hypot(y) / self.radius;
        self.peak * (1.0 - ratio * ratio).max(0.0).sqrt()
    }
}

/// The estimated contact radius of one load, in m; 0 without contact.
fn contact_radius(model: &Model, load: Load) -> f64 {
    match load {
        Load::Force(force) => where_zero(|a| (estimated_force_at_radius(model, a) / force).ln()),
        Load::Penetration(penetration) if penetration > 0.0 => radius_at(model, penetration),
        Load::Penetration(_) => 0.0,
    }
}

/// The radius at which the indenter has this height, in m.
fn radius_at(model: &Model, height: f64) -> f64 {
    where_zero(|a| (model.indenter.mean_profile(a) / height).ln())
}

/// A radius for the domain without contact.
fn unloaded_radius(model: &Model, loads: &[Load]) -> f64 {
    let hangs = loads.iter().map(|load| match load {
        Load::Penetration(penetration) => penetration.abs(),
        Load::Force(_) => 0.0,
    });
    let lengths = [model.tables.bodies().thickness(), hangs.fold(0.0, f64::max)];
    let height = lengths.into_iter().find(|length| *length > 0.0);
    radius_at(model, height.unwrap_or(1.0))
}

/// The force (N) that presses the indenter to a contact radius (m), by the closed forms of the first guess; infinite
/// beyond the indenter's rim.
#[must_use]
pub fn estimated_force_at_radius(model: &Model, radius: f64) -> f64 {
    if model.indenter.mean_profile(radius).is_infinite() {
        return f64::INFINITY;
    }
    force_on_disc(model, radius, 0.0)
}

/// The force (N) that presses the indenter to a contact radius `a` (m), and then a flat punch of this radius by
/// `deeper` (m): `2 a E* d` on the elastic body, `φ π a² d/η` on the relief's springs.
fn force_on_disc(model: &Model, a: f64, deeper: f64) -> f64 {
    let elastic = elastic_force(model, a) + 2.0 * a * modulus(model, a) * deeper;
    let Some(mut relief) = ReliefForce::new(model, a) else {
        return elastic;
    };
    relief.volume += model.relief.area_fraction() * PI * a * a * deeper;
    // 0 where either is 0, since 1/0 = ∞.
    let on_both = |springs: f64| 1.0 / (1.0 / elastic + 1.0 / relief.force(springs));
    let (law, mut force) = (model.relief.spring_law(), on_both(1.0));
    if law.is_linear() {
        return force;
    }
    let area = model.relief.area_fraction() * PI * a * a;
    for _ in 0..STIFFENINGS {
        force = on_both(law.secant(1.0, force / area));
    }
    force
}

/// `E*(a) = 2/(k C(k))` at `k = 1/a`, Pa.
fn modulus(model: &Model, a: f64) -> f64 {
    2.0 * a / model.tables.bodies().compliance(1.0 / a)
}

/// `Q_e(a)`.
fn elastic_force(model: &Model, a: f64) -> f64 {
    let step = FRAC_PI_2 / POINTS as f64;
    let integral: f64 = SINES
        .iter()
        .map(|sine| model.indenter.mean_slope(a * sine) * sine * sine * step)
        .sum();
    2.0 * modulus(model, a) * a * a * integral
}

/// The factors of `Q_w(a)`, the force on the relief's springs.
struct ReliefForce {
    /// `φ ∫₀^a (f(a) − f(ρ)) 2πρ dρ`.
    volume: f64,
    /// `η` of the springs, and the additional compliance that is independent of pressure.
    compliance: [f64; 2],
}

impl ReliefForce {
    /// None without springs.
    fn new(model: &Model, a: f64) -> Option<Self> {
        Some(Self {
            compliance: relief_compliance(model, a)?,
            volume: relief_volume(model, a),
        })
    }

    /// `Q_w` with this fraction of the springs' compliance at rest.
    fn force(&self, part: f64) -> f64 {
        let [springs, other] = self.compliance;
        self.volume / (part * springs + other)
    }
}

/// `η` of the springs, and the additional compliance that is independent of pressure, in m/Pa; none without springs.
/// For a custom relief it is the mean within the radius `a`.
fn relief_compliance(model: &Model, a: f64) -> Option<[f64; 2]> {
    let if_any = |mean: f64| Some([mean, 0.0]).filter(|_| mean > 0.0);
    Some(match &model.relief {
        Relief::Bare => return None,
        Relief::Map(map) => if_any(map.mean_compliance())?,
        Relief::Custom(custom) => if_any(custom.mean_compliance(a))?,
        Relief::Recesses(recesses) => if_any(recesses.mean_compliance())?,
        Relief::Film(film) => [film.compliance(), 0.0],
        // A cylinder also indents the foundation, by about C(1/r) more than a uniform pressure would.
        Relief::Cylinders(cylinders) => {
            let local = (model.tables.bodies()).compliance(1.0 / cylinders.radius());
            let share = 1.0 - cylinders.area_fraction();
            [cylinders.compliance(), share * local]
        }
    })
}

fn relief_volume(model: &Model, a: f64) -> f64 {
    let step = a / POINTS as f64;
    let deepest = model.indenter.mean_profile(a);
    let volume: f64 = (0..POINTS)
        .map(|i| {
            let rho = (i as f64 + 0.5) * step;
            (deepest - model.indenter.mean_profile(rho)) * TAU * rho * step
        })
        .sum();
    model.relief.area_fraction() * volume
}

#[cfg(test)]
mod tests;
