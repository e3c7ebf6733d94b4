//! Warnings about a result that is otherwise sound.

use std::fmt;

use pellicle_influence::ElasticBody;

use crate::{
    ContactSlope, CutOff, LimitRatio, ModelLimit, PeakPlace,
    result::map_resolution::FEWEST_ELEMENTS_PER_WAVE,
};

/// A smaller relative change would be printed as 0.0 %.
const SMALLEST_CHANGE: f64 = 5e-4;

/// A warning about the model or the grid, with its numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Warning {
    /// The contact comes close to the edge of the domain, so pressure may be cut off.
    DomainEdge {
        /// Loading step, counted from 0.
        step: usize,
        /// Whole elements between the contact and the edge.
        elements: usize,
    },
    /// The contact is cut off: it would continue beyond the domain or a map.
    CutOff {
        /// Loading step, counted from 0.
        step: usize,
        /// The limit.
        by: CutOff,
    },
    /// Every contact of the path is only a small part of the domain.
    DomainMuchLarger {
        /// Elements across the widest contact.
        elements: usize,
        /// Its radius, in m: as found, or as estimated where it is too small for the grid.
        radius: f64,
        /// Side of the domain, in m.
        side: f64,
        /// A side to choose instead, in m.
        wanted: f64,
    },
    /// The linear springs of the relief shorten by more than their height.
    FilmShortening {
        /// Loading step, counted from 0.
        step: usize,
        /// Largest shortening over height.
        times: f64,
    },
    /// The relief is worn through in places.
    WornThrough {
        /// Loading step, counted from 0.
        step: usize,
        /// Area that is worn through, m².
        area: f64,
    },
    /// Few elements per radius of a cylinder or a dimple, or per half width of a groove.
    TextureUnderResolved {
        /// Elements per radius.
        elements_per_radius: f64,
    },
    /// Few elements to the shortest wave of the gap under a measured map: the grid misses summits, and none of its
    /// numbers is resolved.
    MapUnderResolved {
        /// Loading step, counted from 0.
        step: usize,
        /// Elements to the shortest wave.
        elements_per_wave: f64,
        /// Elements per side that would be enough.
        wanted: usize,
    },
    /// A layer much thinner than an element, whose own stiffness the grid cannot resolve.
    LayerUnderResolved {
        /// The body that has the layer.
        of: ElasticBody,
        /// Layer, counted from the surface, from 0.
        layer: usize,
        /// Thickness over the side of an element.
        elements_per_thickness: f64,
    },
    /// The influence coefficients are less accurate than wanted; all numbers are uncertain by about as much.
    CoefficientAccuracy {
        /// Estimated error, relative to the largest coefficient.
        found: f64,
        /// Error wanted.
        wanted: f64,
    },
    /// The largest pressure is not that of the continuum: it is at an edge, where it grows with the grid, or it still
    /// changes.
    PeakNotResolved {
        /// Loading step, counted from 0.
        step: usize,
        /// Relative change of the largest pressure from the previous grid.
        change: f64,
        /// The place of the largest pressure.
        place: PeakPlace,
    },
    /// The surfaces in contact are steep, beyond small strains.
    SteepIndenter {
        /// Loading step, counted from 0.
        step: usize,
        /// Their slope.
        slope: ContactSlope,
    },
    /// A self-similar indenter, steep at every depth, is in contact beyond its rounded tip.
    SteepTip {
        /// Slope of its faces or its side.
        slope: f64,
    },
    /// A layer is shortened by a sizeable part of its thickness.
    LayerShortening {
        /// Loading step, counted from 0.
        step: usize,
        /// The body that has the layer.
        of: ElasticBody,
        /// Layer, counted from the surface, from 0.
        layer: usize,
        /// Its largest shortening over its thickness.
        part: f64,
    },
    /// A number is impossible: linear elasticity does not describe such a contact.
    BeyondModel {
        /// Loading step, counted from 0.
        step: usize,
        /// The number farthest beyond its limit.
        beyond: LimitRatio,
    },
    /// A step did not reach its tolerance.
    NotConverged {
        /// Loading step, counted from 0.
        step: usize,
        /// Largest line of the certificate.
        worst: f64,
        /// Bound wanted.
        tolerance: f64,
    },
}

impl Warning {
    /// Returns a short, stable name for programs.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::DomainEdge { .. } => "domain-edge",
            Self::CutOff { .. } => "cut-off",
            Self::DomainMuchLarger { .. } => "domain-much-larger",
            Self::FilmShortening { .. } => "film-shortening",
            Self::WornThrough { .. } => "worn-through",
            Self::TextureUnderResolved { .. } => "texture-under-resolved",
            Self::MapUnderResolved { .. } => "map-under-resolved",
            Self::LayerUnderResolved { .. } => "layer-under-resolved",
            Self::CoefficientAccuracy { .. } => "coefficient-accuracy",
            Self::PeakNotResolved { .. } => "peak-not-resolved",
            Self::SteepIndenter { .. } | Self::SteepTip { .. } => "steep-indenter",
            Self::LayerShortening { .. } => "layer-shortening",
            Self::BeyondModel { .. } => "beyond-model",
            Self::NotConverged { .. } => "not-converged",
        }
    }

    /// The loading step concerned, counted from 0; none if the warning concerns the whole path.
    #[must_use]
    pub fn step(&self) -> Option<usize> {
        match self {
            Self::DomainEdge { step, .. }
            | Self::CutOff { step, .. }
            | Self::FilmShortening { step, .. }
            | Self::WornThrough { step, .. }
            | Self::MapUnderResolved { step, .. }
            | Self::PeakNotResolved { step, .. }
            | Self::SteepIndenter { step, .. }
            | Self::LayerShortening { step, .. }
            | Self::BeyondModel { step, .. }
            | Self::NotConverged { step, .. } => Some(*step),
            Self::DomainMuchLarger { .. }
            | Self::SteepTip { .. }
            | Self::TextureUnderResolved { .. }
            | Self::LayerUnderResolved { .. }
            | Self::CoefficientAccuracy { .. } => None,
        }
    }
}

/// ` of the indenter`; nothing of the foundation.
fn of_body(body: ElasticBody) -> &'static str {
    match body {
        ElasticBody::Foundation => "",
        ElasticBody::Counterbody => " of the indenter",
    }
}

/// `1 element`, `2 elements`.
fn counted(elements: usize) -> String {
    let ending = if elements == 1 { "" } else { "s" };
    format!("{elements} element{ending}")
}

/// Formats a number with `places` decimals, or with two digits if it would be printed as zero: `0.4`, `3.2e-5`.
fn decimals(value: f64, places: i32) -> String {
    if value.abs() < 10_f64.powi(-places) {
        format!("{value:.1e}")
    } else {
        format!("{value:.*}", places.unsigned_abs() as usize)
    }
}

fn in_words(slope: ContactSlope) -> String {
    match slope {
        ContactSlope::AtEdge(slope) if slope.is_infinite() => {
            "the contact reaches the indenter's equator, where its slope is infinite".into()
        }
        ContactSlope::AtEdge(slope) => {
            format!("the indenter's slope is {slope:.2} at the edge of the contact")
        }
        ContactSlope::RootMeanSquare(slope) => {
            format!("the root-mean-square slope of the surfaces in contact is {slope:.2}")
        }
    }
}

/// A ratio with three digits: `1.03`, `456`, `2.9e6`.
fn times(ratio: f64) -> String {
    match ratio {
        ..10.0 => format!("{ratio:.2}"),
        ..100.0 => format!("{ratio:.1}"),
        ..1e4 => format!("{ratio:.0}"),
        _ => format!("{ratio:.1e}"),
    }
}

impl LimitRatio {
    /// The number in words, with the name of each body's layers and base, counted from the surface from 0.
    #[must_use]
    pub fn words(&self, name: &dyn Fn(ElasticBody, usize) -> String) -> String {
        let times = times(self.ratio);
        match self.limit {
            ModelLimit::LayerThickness { of, layer } => {
                format!(
                    "{} is shortened by {times} times its thickness",
                    name(of, layer)
                )
            }
            ModelLimit::RigidBase { of } => {
                let surface = match of {
                    ElasticBody::Foundation => "the surface",
                    ElasticBody::Counterbody => "the indenter's surface",
                };
                format!("{surface} is pressed to {times} times the depth of the rigid base")
            }
            ModelLimit::IndenterRadius => {
                format!("the indenter is sunk by {times} times its radius")
            }
            ModelLimit::Modulus { of, body } => format!(
                "{} carries a mean pressure of {times} times its Young's modulus",
                name(of, body)
            ),
        }
    }
}

impl Warning {
    /// The sentence, with the name of each body's layers and base, counted from the surface from 0.
    #[must_use]
    pub fn words(&self, name: &dyn Fn(ElasticBody, usize) -> String) -> String {
        match *self {
            Self::LayerShortening {
                step,
                of,
                layer,
                part,
            } => format!(
                "step {step}: {} is shortened by {:.0} % of its thickness, beyond small strains",
                name(of, layer),
                100.0 * part
            ),
            Self::BeyondModel { step, beyond } => {
                format!("step {step}: beyond the model: {}", beyond.words(name))
            }
            _ => self.to_string(),
        }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::DomainEdge { step, elements } => write!(
                f,
                "step {step}: the contact comes within {} of the edge of the domain; choose a larger side",
                counted(elements)
            ),
            Self::CutOff { step, by } => write!(
                f,
                "step {step}: the contact is cut off by {}",
                match by {
                    CutOff::Domain => "the edge of the domain: choose a larger side, or none",
                    CutOff::ReliefMap =>
                        "the end of the surface's map: the surface beyond it is unknown",
                    CutOff::IndenterMap =>
                        "the end of the indenter's map: the indenter beyond it is unknown",
                }
            ),
            Self::DomainMuchLarger {
                elements,
                radius,
                side,
                wanted,
            } => write!(
                f,
                "the contact, of radius about {radius:.2e}, is {} wide: a domain of side {side:.3e} is far too large; choose a side near {wanted:.2e}, or none",
                counted(elements)
            ),
            Self::FilmShortening { step, times } => write!(
                f,
                "step {step}: the relief shortens by {times:.2} times its height, beyond what linear springs describe: choose a logarithmic law"
            ),
            Self::WornThrough { step, area } => write!(
                f,
                "step {step}: {area:.3e} m² of the relief are worn through: the body below does not wear here, so less is worn than coefficient times force times distance"
            ),
            Self::TextureUnderResolved {
                elements_per_radius,
            } => write!(
                f,
                "{} elements per radius of a cylinder or dimple, or per half width of a groove, are few; use more elements or a smaller side",
                decimals(elements_per_radius, 1)
            ),
            Self::MapUnderResolved {
                step,
                elements_per_wave,
                wanted,
            } => write!(
                f,
                "step {step}: {} elements to the shortest wave of the map miss its summits: areas and pressures may be wrong many times over, and no error is known; choose at least {FEWEST_ELEMENTS_PER_WAVE} to a wave, which are {wanted} elements per side",
                decimals(elements_per_wave, 1)
            ),
            Self::LayerUnderResolved {
                of,
                layer,
                elements_per_thickness,
            } => write!(
                f,
                "layer {layer}{} is {} elements thick: the grid barely resolves it",
                of_body(of),
                decimals(elements_per_thickness, 3)
            ),
            Self::CoefficientAccuracy { found, wanted } => write!(
                f,
                "the influence coefficients of these layers are accurate to {found:.1e}, wanted {wanted:.0e}: all numbers are uncertain by about as much"
            ),
            Self::PeakNotResolved {
                step,
                change,
                place,
            } => unresolved_peak(f, step, change, place),
            Self::SteepIndenter { step, slope } => {
                write!(f, "step {step}: {}, beyond small strains", in_words(slope))
            }
            Self::SteepTip { slope } => write!(
                f,
                "the indenter's slope is {slope:.2} at every depth, beyond small strains"
            ),
            Self::LayerShortening { .. } | Self::BeyondModel { .. } => {
                let name =
                    |of, body| format!("body {body}{}, counted from the surface,", of_body(of));
                f.write_str(&self.words(&name))
            }
            Self::NotConverged {
                step,
                worst,
                tolerance,
            } => {
                write!(
                    f,
                    "step {step} did not converge: certificate {worst:.1e}, wanted {tolerance:.1e}"
                )
            }
        }
    }
}

/// The sentence on a largest pressure that changed by this part from the previous grid.
fn unresolved_peak(
    f: &mut fmt::Formatter<'_>,
    step: usize,
    change: f64,
    place: PeakPlace,
) -> fmt::Result {
    write!(f, "step {step}: the largest pressure ")?;
    f.write_str(match place {
        PeakPlace::Inside => "is not resolved by the grid",
        PeakPlace::Outline => "sits at the outline of the relief and grows with the grid",
        PeakPlace::Ridge => {
            "sits at a ridge of the map or at the sharp edge of a recess and grows with the grid"
        }
        PeakPlace::IndenterEdge => "sits at an edge of the indenter and grows with the grid",
    })?;
    if change < SMALLEST_CHANGE {
        return Ok(());
    }
    write!(
        f,
        "; it changed by {:.1} % from the previous grid",
        100.0 * change
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_values_are_not_printed_as_zero() {
        let layer = Warning::LayerUnderResolved {
            of: ElasticBody::Foundation,
            layer: 0,
            elements_per_thickness: 3.2e-5,
        };
        assert!(
            layer.to_string().contains("is 3.2e-5 elements thick"),
            "{layer}"
        );
        let texture = |elements_per_radius| Warning::TextureUnderResolved {
            elements_per_radius,
        };
        assert!(texture(0.004).to_string().starts_with("4.0e-3 elements"));
        assert!(texture(2.5).to_string().starts_with("2.5 elements"));
        assert_eq!(
            [0, 1, 2].map(counted),
            ["0 elements", "1 element", "2 elements"]
        );
    }

    #[test]
    fn a_warning_about_a_load_reports_its_step() {
        let warning = Warning::DomainEdge {
            step: 3,
            elements: 1,
        };
        assert_eq!(warning.step(), Some(3));
    }
}
