//! The sentences of the warnings.

use std::fmt;

use pellicle_influence::ElasticBody;

use super::Warning;
use crate::path::levels::FEWEST_FOR_THREE_GRIDS;
use crate::result::{map_resolution::FEWEST_ELEMENTS_PER_WAVE, peak::FEWEST_ELEMENTS_PER_ARC};
use crate::{ContactSlope, CutOff, GridNumber, LimitRatio, ModelLimit, PeakPlace, UnresolvedArc};

/// A smaller relative change would be printed as 0.0 %.
const SMALLEST_CHANGE: f64 = 5e-4;

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
            ModelLimit::WornLayer { of } => {
                format!(
                    "{} is worn to {times} times its thickness, and solved as whole",
                    name(of, 0)
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
            Self::LayerWorn { step, of, part } => format!(
                "step {step}: wear takes {:.0} % of the thickness of {}, which is solved as whole",
                100.0 * part,
                name(of, 0)
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
            Self::CutOff { step, by } => {
                write!(f, "step {step}: the contact is cut off by {}", cut_off(by))
            }
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
                "step {step}: {area:.3e} m² in contact do not wear, where the relief is worn through or ends: less is worn than coefficient times force times distance"
            ),
            Self::DeepRecesses { slope } => write!(
                f,
                "the recesses are {slope:.2} times as deep as half their width: the body between them gives more than the half-space that is solved, which holds for shallow ones (`surface.young_modulus` makes them springs)"
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
                arc,
            } => unresolved_peak(f, step, change, (place, arc)),
            Self::NothingTouches { step, penetration } => write!(
                f,
                "step {step}: nothing touches at a penetration of {penetration:.3e} m: it is counted from where the lowest point of the indenter is as high as the highest of the surface; under a force the penetration is found"
            ),
            Self::NoGridError { elements } => no_grid_error(f, elements),
            Self::NotResolved { step, numbers } => {
                let names = numbers.each().map(GridNumber::name);
                not_resolved(f, step, &names.collect::<Vec<_>>())
            }
            Self::ArcUnderResolved(arc) => under_resolved_arc(f, arc),
            Self::SteepIndenter { step, slope } => {
                write!(f, "step {step}: {}, beyond small strains", in_words(slope))
            }
            Self::SteepTip { slope } => write!(
                f,
                "the indenter's slope is {slope:.2} at every depth, beyond small strains"
            ),
            Self::LayerShortening { .. } | Self::LayerWorn { .. } | Self::BeyondModel { .. } => {
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

/// What cuts a contact off, and what helps.
fn cut_off(by: CutOff) -> &'static str {
    match by {
        CutOff::Domain => "the edge of the domain: choose a larger side, or none",
        CutOff::ReliefMap => {
            "the end of the surface's map: the surface beyond it is unknown (a periodic cell, `grid.boundary = \"periodic\"` with `surface.edges = \"taper\"`, has no end)"
        }
        CutOff::IndenterMap => "the end of the indenter's map: the indenter beyond it is unknown",
    }
}

/// The sentence on arcs at the edges of a relief.
fn under_resolved_arc(f: &mut fmt::Formatter<'_>, arc: UnresolvedArc) -> fmt::Result {
    let UnresolvedArc { elements, wanted } = arc;
    let elements = decimals(elements, 1);
    write!(
        f,
        "the arc at an edge of the relief is {elements} elements wide: a largest pressure there grows with the grid; at least {FEWEST_ELEMENTS_PER_ARC} resolve it, which are {wanted} elements per side"
    )
}

/// The sentence on numbers that a grid does not resolve.
fn not_resolved(f: &mut fmt::Formatter<'_>, step: usize, names: &[&str]) -> fmt::Result {
    let names = names.join(", ");
    write!(
        f,
        "step {step}: not resolved by the grid, the ± may be too small: {names}"
    )
}

/// The sentence on a path of a single grid.
fn no_grid_error(f: &mut fmt::Formatter<'_>, elements: usize) -> fmt::Result {
    write!(
        f,
        "no number has a ±: a grid of {elements} elements per side has no coarser ones to compare with; "
    )?;
    if elements < FEWEST_FOR_THREE_GRIDS {
        write!(f, "{FEWEST_FOR_THREE_GRIDS} or more have two")
    } else {
        f.write_str("choose numbers of elements that can be halved twice")
    }
}

/// The sentence on a largest pressure that changed by this part from the previous grid.
fn unresolved_peak(
    f: &mut fmt::Formatter<'_>,
    step: usize,
    change: f64,
    (place, arc): (PeakPlace, Option<UnresolvedArc>),
) -> fmt::Result {
    write!(f, "step {step}: the largest pressure ")?;
    f.write_str(match place {
        PeakPlace::Inside => "is not resolved by the grid",
        PeakPlace::Outline => "sits at the outline of the relief and grows with the grid",
        PeakPlace::Ridge => {
            "sits at a ridge of the map or at the edge of a recess and grows with the grid"
        }
        PeakPlace::IndenterEdge => "sits at an edge of the indenter and grows with the grid",
    })?;
    if change >= SMALLEST_CHANGE {
        let percent = 100.0 * change;
        write!(f, "; it changed by {percent:.1} % from the previous grid")?;
    }
    f.write_str(match (place, arc) {
        (PeakPlace::Inside, _) => "",
        (PeakPlace::Outline | PeakPlace::Ridge, Some(UnresolvedArc { elements, wanted })) => {
            let elements = decimals(elements, 1);
            return write!(
                f,
                " (its arc is {elements} elements wide, at least {FEWEST_ELEMENTS_PER_ARC} resolve it, which are {wanted} elements per side; `output.mean_pressure_over` averages it)"
            );
        }
        (PeakPlace::Outline | PeakPlace::Ridge, None) => {
            " (an `edge_radius` of the texture bounds it, `output.mean_pressure_over` averages it)"
        }
        (PeakPlace::IndenterEdge, _) => " (`output.mean_pressure_over` averages it)",
    })
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
