//! Limits in which the stress below a loaded element becomes that in another body.

use pellicle_influence::{Depth, ElementFields, SubsurfaceState};
use pellicle_kernel::{Base, Foundation, Interface, Layer, Material, Side};

use super::super::comparison::Comparison;
use super::super::run::{ValidationError, ValidationRun};
use super::super::section::ValidationSection;
use super::differences;

/// The section.
pub const SECTION: ValidationSection = ValidationSection {
    name: "Stress inside: limits",
    source: "another body, computed here, that has the same fields below a loaded element",
    because: "relative to the largest stress, or displacement; what the limit leaves (1e-6 or less where a thickness or a \
              compliance is a millionth or a million)",
    rows,
};

/// Accuracy of the fields in two bodies.
const ACCURACY: f64 = 1e-10;
/// A millionth times ratios of moduli.
const MILLIONTH: f64 = 1e-5;

/// The loads whose fields are compared.
#[derive(Clone, Copy, PartialEq)]
enum Loads {
    Both,
    /// Only the pressure: above a frictionless interface a traction moves the surface without bound.
    Pressure,
}

/// The reference body and the body compared with it.
type FoundationPair = fn() -> Result<[Foundation; 2], ValidationError>;

const LIMITS: [(&str, f64, Loads, [f64; 2], FoundationPair); 6] = [
    (
        "coat = base: the half-space",
        ACCURACY,
        Loads::Both,
        [0.0, 0.7],
        equal,
    ),
    (
        "thick coat: the coat alone",
        MILLIONTH,
        Loads::Both,
        [0.0, 0.7],
        thick,
    ),
    (
        "thin coat: the base alone",
        MILLIONTH,
        Loads::Both,
        [0.2, 0.7],
        thin,
    ),
    (
        "a layer cut in two: the layer",
        ACCURACY,
        Loads::Both,
        [0.3, 1.5],
        cut,
    ),
    (
        "stiff springs: bonded",
        MILLIONTH,
        Loads::Both,
        [0.3, 1.5],
        stiff_springs,
    ),
    (
        "springs soft in shear: frictionless",
        MILLIONTH,
        Loads::Pressure,
        [0.3, 1.5],
        soft_springs,
    ),
];

fn rows(_: ValidationRun) -> Result<Vec<Comparison>, ValidationError> {
    LIMITS
        .iter()
        .map(|(check, tolerance, loads, depths, pair)| {
            let [wanted, found] = pair()?;
            let [wanted, found] = [
                states(&wanted, *depths, *loads)?,
                states(&found, *depths, *loads)?,
            ];
            let pairs = wanted.iter().zip(&found);
            let pairs = pairs.flat_map(|(wanted, found)| differences(wanted, found));
            Ok(Comparison::worst((*check).into(), pairs, *tolerance))
        })
        .collect()
}

/// States below an element of side 1, at all points, for each load and depth.
fn states(
    body: &Foundation,
    depths: [f64; 2],
    loads: Loads,
) -> Result<Vec<Vec<SubsurfaceState>>, ValidationError> {
    let points = [[0.1, 0.2], [0.45, 0.3], [0.8, -0.6], [-2.0, 1.5]];
    let mut states = Vec::new();
    for z in depths {
        let side = Side::Above;
        let element = ElementFields::new(body, 1.0, Depth { z, side }, 4.0)?;
        let both = points.map(|point| element.at(point));
        states.push(both.iter().map(|loads| loads.normal).collect());
        if loads == Loads::Both {
            states.push(both.iter().map(|loads| loads.tangential).collect());
        }
    }
    Ok(states)
}

fn coating() -> Result<Material, ValidationError> {
    Ok(Material::new(5.0, 0.2)?)
}

fn base() -> Result<Material, ValidationError> {
    Ok(Material::new(1.0, 0.4)?)
}

/// A coating of thickness 1 on an interface.
fn on(interface: Interface) -> Result<Foundation, ValidationError> {
    let layer = Layer::new(1.0, coating()?, interface)?;
    Ok(Foundation::new(vec![layer], Base::HalfSpace(base()?))?)
}

fn equal() -> Result<[Foundation; 2], ValidationError> {
    // Exactly equal materials would be recognised as a half-space.
    let almost = Material::new(1.0 + 1e-13, 0.4)?;
    let body = Foundation::half_space(base()?);
    Ok([body, Foundation::coated(0.5, almost, base()?)?])
}

fn thick() -> Result<[Foundation; 2], ValidationError> {
    let body = Foundation::half_space(coating()?);
    Ok([body, Foundation::coated(1e6, coating()?, base()?)?])
}

fn thin() -> Result<[Foundation; 2], ValidationError> {
    let body = Foundation::half_space(base()?);
    Ok([body, Foundation::coated(1e-7, coating()?, base()?)?])
}

fn cut() -> Result<[Foundation; 2], ValidationError> {
    let layer = |thickness| {
        Layer::new(thickness, coating()?, Interface::Bonded).map_err(ValidationError::from)
    };
    let layers = vec![layer(0.4)?, layer(0.6)?];
    let body = Foundation::new(layers, Base::HalfSpace(base()?))?;
    Ok([on(Interface::Bonded)?, body])
}

fn stiff_springs() -> Result<[Foundation; 2], ValidationError> {
    let springs = Interface::spring(1e-7, 1e-7)?;
    Ok([on(Interface::Bonded)?, on(springs)?])
}

fn soft_springs() -> Result<[Foundation; 2], ValidationError> {
    let springs = Interface::spring(0.0, 1e7)?;
    Ok([on(Interface::Frictionless)?, on(springs)?])
}
