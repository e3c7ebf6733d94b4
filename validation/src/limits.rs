//! Limits in which one problem becomes another, and values computed in two ways.

use pellicle_contact::{Load, Method, SolverOptions};
use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};
use pellicle_texture::{CylinderSpec, Cylinders, Film, Lattice, Relief};

use crate::comparison::Comparison;
use crate::run::{ContactSetup, ValidationError, ValidationRun, paraboloid, unit_material};
use crate::section::ValidationSection;

/// The section.
pub const SECTION: ValidationSection = ValidationSection {
    name: "Limits, and the same number computed in two ways",
    source: "another problem, solved here, that has the same answer",
    because: "relative; what the limit leaves (some 1e-6 where a thickness or a stiffness is a million), and ten times the certificate's 1e-8",
    rows,
};

/// The error of a penetration is less than ten times the certificate's 1e-8.
const CERTIFIED: f64 = 1e-7;
/// Coatings are a millionth or a million contact radii thick, or a stiff substrate is a million times stiffer. The
/// effect is a millionth times some ratio of moduli.
const MILLIONTH: f64 = 1e-5;

/// Two contacts with the same solution.
type SetupPair = fn() -> Result<[ContactSetup; 2], ValidationError>;

/// The limit in words, the tolerance, and the two contacts.
const LIMITS: [(&str, f64, SetupPair); 8] = [
    ("χ → 1, equal ν: the half-space", CERTIFIED, equal_materials),
    ("thick coating: the coating alone", MILLIONTH, thick),
    ("thin coating: the substrate alone", MILLIONTH, thin),
    (
        "stiff substrate: the rigid base",
        MILLIONTH,
        stiff_substrate,
    ),
    ("a layer cut in two: the layer", CERTIFIED, cut_in_two),
    (
        "film of zero compliance: the bare surface",
        CERTIFIED,
        hard_film,
    ),
    (
        "relief of zero height: the bare surface",
        CERTIFIED,
        low_relief,
    ),
    ("SI units: the same in units of R and E", CERTIFIED, units),
];

fn rows(run: ValidationRun) -> Result<Vec<Comparison>, ValidationError> {
    let limits = LIMITS.iter().map(|(check, tolerance, pair)| {
        limit(run, check, *tolerance, *pair)
            .unwrap_or_else(|error| Comparison::failed((*check).into(), &error))
    });
    let mut rows: Vec<_> = limits.collect();
    rows.push(there_and_back(run)?);
    rows.push(two_methods(run)?);
    Ok(rows)
}

/// Compares the penetrations of two contacts, each relative to its own side.
fn limit(
    run: ValidationRun,
    check: &str,
    tolerance: f64,
    pair: SetupPair,
) -> Result<Comparison, ValidationError> {
    let [wanted, found] = pair()?;
    let reference = run.penetration(&wanted)? / wanted.side;
    let computed = run.penetration(&found)? / found.side;
    Ok(Comparison::relative(
        check.into(),
        reference,
        computed,
        tolerance,
    ))
}

/// A paraboloid of radius 1 with a contact radius of about 0.1.
fn contact(foundation: Foundation) -> Result<ContactSetup, ValidationError> {
    let (grid, load) = ((0.3, 64), Load::Force(1.3e-3));
    Ok(ContactSetup::bare(foundation, paraboloid(1.0)?, grid, load))
}

fn half_space(material: Material) -> Result<ContactSetup, ValidationError> {
    contact(Foundation::half_space(material))
}

fn coated(
    thickness: f64,
    coating: Material,
    substrate: Material,
) -> Result<ContactSetup, ValidationError> {
    contact(Foundation::coated(thickness, coating, substrate)?)
}

fn other_material() -> Result<Material, ValidationError> {
    Ok(Material::new(5.0, 0.2)?)
}

fn equal_materials() -> Result<[ContactSetup; 2], ValidationError> {
    let substrate = unit_material()?;
    // Exactly equal materials would be recognised as a half-space.
    let coating = Material::new(substrate.young_modulus() * (1.0 + 1e-12), 0.3)?;
    Ok([half_space(substrate)?, coated(0.05, coating, substrate)?])
}

fn thick() -> Result<[ContactSetup; 2], ValidationError> {
    let coating = unit_material()?;
    Ok([
        half_space(coating)?,
        coated(1e5, coating, other_material()?)?,
    ])
}

fn thin() -> Result<[ContactSetup; 2], ValidationError> {
    let substrate = unit_material()?;
    Ok([
        half_space(substrate)?,
        coated(1e-7, other_material()?, substrate)?,
    ])
}

fn stiff_substrate() -> Result<[ContactSetup; 2], ValidationError> {
    let material = unit_material()?;
    let layer = Layer::new(0.1, material, Interface::Bonded)?;
    let rigid = Foundation::new(vec![layer], Base::Rigid)?;
    let stiff = Material::new(1e6, 0.3)?;
    Ok([contact(rigid)?, coated(0.1, material, stiff)?])
}

fn cut_in_two() -> Result<[ContactSetup; 2], ValidationError> {
    let (coating, substrate) = (other_material()?, unit_material()?);
    let layer = |thickness| Layer::new(thickness, coating, Interface::Bonded);
    let base = Base::HalfSpace(substrate);
    let cut = Foundation::new(vec![layer(0.013)?, layer(0.037)?], base)?;
    Ok([coated(0.05, coating, substrate)?, contact(cut)?])
}

/// The paper's stiff coating, bare.
fn stiff_coating() -> Result<ContactSetup, ValidationError> {
    coated(0.05, Material::new(10.0, 0.3)?, Material::new(1.0, 0.4)?)
}

fn hard_film() -> Result<[ContactSetup; 2], ValidationError> {
    let film = Relief::Film(Film::new(1e-3, 1e12)?);
    let with_film = ContactSetup {
        relief: film,
        ..stiff_coating()?
    };
    Ok([stiff_coating()?, with_film])
}

fn low_relief() -> Result<[ContactSetup; 2], ValidationError> {
    let low = ContactSetup {
        relief: cylinders(1e-14)?,
        ..stiff_coating()?
    };
    Ok([stiff_coating()?, low])
}

/// Cylinders of the coating's own modulus, with eight elements per radius.
fn cylinders(height: f64) -> Result<Relief, ValidationError> {
    let spec = CylinderSpec {
        lattice: Lattice::Square,
        radius: 0.0375,
        height,
        period: 0.09,
        offset: [0.0, 0.0],
        young_modulus: 10.0,
    };
    Ok(Relief::Cylinders(Cylinders::new(spec)?))
}

fn units() -> Result<[ContactSetup; 2], ValidationError> {
    let (micrometres, gigapascals) = (3e-6, 70e9);
    let coating = Material::new(10.0 * gigapascals, 0.3)?;
    let substrate = Material::new(gigapascals, 0.4)?;
    let body = Foundation::coated(0.05 * micrometres, coating, substrate)?;
    let load = Load::Force(1.3e-3 * gigapascals * micrometres * micrometres);
    let grid = (0.3 * micrometres, 64);
    let in_si = ContactSetup::bare(body, paraboloid(micrometres)?, grid, load);
    Ok([stiff_coating()?, in_si])
}

/// Contact on cylinders and between them.
fn textured() -> Result<ContactSetup, ValidationError> {
    let load = Load::Force(5e-3);
    let relief = cylinders(2e-3)?;
    Ok(ContactSetup {
        relief,
        load,
        elements: 32,
        ..stiff_coating()?
    })
}

/// Solves for a force, then prescribes the penetration found and compares the force.
fn there_and_back(run: ValidationRun) -> Result<Comparison, ValidationError> {
    let by_force = textured()?;
    let there = run.solve(&by_force)?.steps.remove(0).solution;
    let load = Load::Penetration(there.penetration);
    let back = run
        .solve(&ContactSetup { load, ..by_force })?
        .steps
        .remove(0)
        .solution;
    let check = "textured: force, penetration, force again".into();
    Ok(Comparison::relative(
        check,
        there.force,
        back.force,
        CERTIFIED,
    ))
}

/// Compares gradients with the paper's active set on the dense system.
fn two_methods(run: ValidationRun) -> Result<Comparison, ValidationError> {
    let contact = textured()?;
    let options = SolverOptions {
        method: Method::ActiveSet,
        ..SolverOptions::default()
    };
    let gradient = run.solve(&contact)?.steps.remove(0).summary;
    let active_set = run.solve_with(&contact, options)?.steps.remove(0).summary;
    let check = "textured: largest pressure by the dense active set".into();
    Ok(Comparison::relative(
        check,
        active_set.max_pressure,
        gradient.max_pressure,
        1e-6,
    ))
}
