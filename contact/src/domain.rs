//! How large a square to solve on.
//!
//! The contact radius `a` is estimated from axisymmetric closed forms with the indenter's profile averaged around
//! its axis: on the elastic foundation (Galin; Sneddon 1965)
//!
//! ```text
//! Q_e(a) = 2 E*(a) a² ∫₀^{π/2} f′(a sin θ) sin²θ dθ,    E*(a) = 2 / (k C(k)) at k = 1/a,
//! ```
//!
//! on the relief's springs alone `Q_w(a) = (φ/η) ∫₀^a (f(a) − f(ρ)) 2πρ dρ`, and on both in series
//! `1/Q = 1/Q_e + 1/Q_w`. Nothing depends on the estimate but the first domain tried: the solution itself tells
//! whether it was large enough.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use pellicle_texture::Relief;

use crate::{Indenter, Load, Model};

/// The square on which the problem is solved.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Domain {
    /// A square of this side (m), whatever the contact does; a contact near its edge is a warning.
    Side(f64),
    /// Chosen from the load, enlarged while the contact comes close to its edge.
    #[default]
    Automatic,
}

/// Half the side over the estimated contact radius: the estimate is good to some 20 %.
const MARGIN: f64 = 1.5;
/// Midpoints of the quadratures over the profile; the estimate needs no more.
const POINTS: usize = 64;
/// Halvings or doublings that the search for a radius may take: all of a double's range.
const LONGEST_SEARCH: usize = 2000;

/// The side (m) of the square on which to solve for all `loads`: three times the largest estimated contact radius.
///
/// Where no load makes contact, the radius at which the indenter stands one foundation thickness (or 1 m) high.
#[must_use]
pub fn default_side(model: &Model, loads: &[Load]) -> f64 {
    let radii = loads.iter().map(|load| contact_radius(model, *load));
    let radius = radii.filter(|radius| *radius > 0.0).fold(0.0, f64::max);
    if radius > 0.0 {
        2.0 * MARGIN * radius
    } else {
        2.0 * unloaded_radius(model)
    }
}

/// A paraboloid's pressure `p0 √(1 − ρ²/a²)` with the estimated contact radius of a load and its force: what the coarsest grid starts from.
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
            Load::Penetration(_) => force_at(model, radius),
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
        Load::Force(force) => radius_where(|a| force_at(model, a) >= force),
        Load::Penetration(penetration) if penetration > 0.0 => {
            radius_where(|a| model.indenter.mean_profile(a) >= penetration)
        }
        Load::Penetration(_) => 0.0,
    }
}

/// A length to look at where nothing touches.
fn unloaded_radius(model: &Model) -> f64 {
    let thickness = model.tables.foundation().thickness();
    let height = if thickness > 0.0 { thickness } else { 1.0 };
    radius_where(|a| model.indenter.mean_profile(a) >= height)
}

/// The smallest radius with a property that all larger ones have, to a hundredth.
fn radius_where(reached: impl Fn(f64) -> bool) -> f64 {
    let mut radius = 1.0;
    for _ in 0..LONGEST_SEARCH {
        if reached(radius) {
            break;
        }
        radius *= 2.0;
    }
    for _ in 0..LONGEST_SEARCH {
        if !reached(radius / 2.0) || radius < f64::MIN_POSITIVE {
            break;
        }
        radius /= 2.0;
    }
    // radius/2 falls short, radius does not.
    let (mut low, mut high) = (radius / 2.0, radius);
    while high - low > 0.01 * high {
        let middle = f64::midpoint(low, high);
        if reached(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    high
}

/// The force (N) at the contact radius `a`; infinite beyond the indenter's rim.
fn force_at(model: &Model, a: f64) -> f64 {
    if model.indenter.mean_profile(a).is_infinite() {
        return f64::INFINITY;
    }
    let elastic = elastic_force(model, a);
    match relief_force(model, a) {
        // 0 where either is, since 1/0 = ∞
        Some(relief) => 1.0 / (1.0 / elastic + 1.0 / relief),
        None => elastic,
    }
}

/// `Q_e(a)`.
fn elastic_force(model: &Model, a: f64) -> f64 {
    // E*(a) = 2/(k C(k)) at k = 1/a
    let modulus = 2.0 * a / model.tables.foundation().compliance(1.0 / a);
    let step = FRAC_PI_2 / POINTS as f64;
    let integral: f64 = (0..POINTS)
        .map(|i| {
            let sine = ((i as f64 + 0.5) * step).sin();
            slope(&model.indenter, a * sine) * sine * sine * step
        })
        .sum();
    2.0 * modulus * a * a * integral
}

/// `Q_w(a)`; none on a bare surface and under a map, whose springs are all different.
fn relief_force(model: &Model, a: f64) -> Option<f64> {
    let compliance = match &model.relief {
        Relief::Bare | Relief::Map(_) => return None,
        Relief::Film(film) => film.compliance(),
        // A cylinder also presses itself into the foundation, by some C(1/r) more than an even pressure would.
        Relief::Cylinders(cylinders) => {
            let local = model
                .tables
                .foundation()
                .compliance(1.0 / cylinders.radius());
            cylinders.compliance() + (1.0 - cylinders.area_fraction()) * local
        }
    };
    let step = a / POINTS as f64;
    let deepest = model.indenter.mean_profile(a);
    let volume: f64 = (0..POINTS)
        .map(|i| {
            let rho = (i as f64 + 0.5) * step;
            (deepest - model.indenter.mean_profile(rho)) * TAU * rho * step
        })
        .sum();
    Some(model.relief.area_fraction() * volume / compliance)
}

/// `f′(ρ)` of the averaged profile, by a central difference.
pub(crate) fn slope(indenter: &Indenter, rho: f64) -> f64 {
    let step = 1e-3 * rho;
    (indenter.mean_profile(rho + step) - indenter.mean_profile(rho - step)) / (2.0 * step)
}

#[cfg(test)]
mod tests;
