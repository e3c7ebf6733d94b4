//! Indenters with a closed form: Hertz, Sneddon, Winkler.

use std::f64::consts::PI;

use pellicle_contact::reference::{
    cone, elliptic_hertz, flat_punch, hertz, power_law, sphere, winkler,
};
use pellicle_contact::{Cone, EllipticParaboloid, FlatPunch, Indenter, Load, PowerLaw, Sphere};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::{Film, Relief};

use crate::comparison::Comparison;
use crate::run::{ContactSetup, ValidationError, ValidationRun, paraboloid, unit_material};
use crate::section::ValidationSection;

/// The section.
pub const SECTION: ValidationSection = ValidationSection {
    name: "Closed forms",
    source: "Hertz; Sneddon 1965; Winkler (contact::reference)",
    because: "relative; the grid: of second order in the element's side, of first at the punch's rim, and areas are \
              those of whole elements",
    rows,
};

/// Elements per side. The domains are two and a half to three contact radii wide, so an element is about 1/90 of a
/// radius.
const ELEMENTS: usize = 256;
/// The same for an ellipse of semi-axes in the ratio 4.5, of which the shorter one has 26 elements.
const ELLIPSE: f64 = 1e-4;
/// Error of second order: (1/85)² = 1.4e-4 times a factor that depends on where the grid meets the contact's edge.
const SECOND_ORDER: f64 = 2e-5;
/// The same under a power law, whose pressure ends more steeply at the edge of the contact.
const POWER_LAW: f64 = 5e-5;
/// The centre nearest to the axis is about 1/120 of a radius off it.
const PEAK: f64 = 2e-4;
/// The edge of the contact is a staircase: 1/85, reduced by the averaging of its steps.
const STAIRCASE: f64 = 5e-3;
/// Without elasticity there is no discretisation error: only the certificate's 1e-8 and the body's 1e-9 remain.
const CERTIFIED: f64 = 1e-7;

fn rows(run: ValidationRun) -> Result<Vec<Comparison>, ValidationError> {
    let parts = [
        hertz_rows,
        ellipse_rows,
        sphere_rows,
        cone_rows,
        power_rows,
        punch_rows,
        winkler_rows,
    ];
    let rows: Result<Vec<_>, _> = parts.iter().map(|part| part(run)).collect();
    Ok(rows?.concat())
}

/// A contact on the half-space of plane-strain modulus 1.
fn on_half_space(
    indenter: Indenter,
    side: f64,
    load: Load,
) -> Result<ContactSetup, ValidationError> {
    let body = Foundation::half_space(unit_material()?);
    Ok(ContactSetup::bare(body, indenter, (side, ELEMENTS), load))
}

fn hertz_rows(run: ValidationRun) -> Result<Vec<Comparison>, ValidationError> {
    let wanted = hertz::from_contact_radius(1.0, 1.0, 0.1);
    let solve = |load| {
        let path = run.solve(&on_half_space(paraboloid(1.0)?, 0.3, load)?)?;
        Ok::<_, ValidationError>(path.steps.into_iter().next())
    };
    let by_force = solve(Load::Force(wanted.force))?.ok_or(ValidationError::NoSolution)?;
    let by_depth =
        solve(Load::Penetration(wanted.penetration))?.ok_or(ValidationError::NoSolution)?;
    let row = |what: &str, wanted, found, tolerance| {
        Comparison::relative(format!("Hertz: {what}"), wanted, found, tolerance)
    };
    let (depth, force) = (by_force.solution.penetration, by_depth.solution.force);
    let (peak, area) = (by_force.summary.max_pressure, by_force.summary.contact_area);
    let stiffness = by_force.contact_stiffness.unwrap_or(f64::NAN);
    let a = wanted.contact_radius;
    Ok(vec![
        row(
            "penetration under a force",
            wanted.penetration,
            depth,
            SECOND_ORDER,
        ),
        row("force at a penetration", wanted.force, force, SECOND_ORDER),
        row("largest pressure", wanted.peak_pressure, peak, PEAK),
        row("contact area", PI * a * a, area, STAIRCASE),
        // dQ/dD = 2 E* a
        row("contact stiffness", 2.0 * a, stiffness, STAIRCASE),
    ])
}

fn ellipse_rows(run: ValidationRun) -> Result<Vec<Comparison>, ValidationError> {
    let wanted = elliptic_hertz::from_force([10.0, 1.0], 1.0, 1e-3);
    let indenter = EllipticParaboloid::new([10.0, 1.0])?.into();
    let side = 2.2 * wanted.semi_axes[0];
    let path = run.solve(&on_half_space(indenter, side, Load::Force(wanted.force))?)?;
    let step = &path.steps[0];
    let row = |what: &str, wanted, found| {
        Comparison::relative(format!("Hertz, radii 10:1: {what}"), wanted, found, ELLIPSE)
    };
    Ok(vec![
        row("penetration", wanted.penetration, step.solution.penetration),
        row(
            "largest pressure",
            wanted.peak_pressure,
            step.summary.max_pressure,
        ),
    ])
}

fn sphere_rows(run: ValidationRun) -> Result<Vec<Comparison>, ValidationError> {
    // Deep enough that Hertz's penetration under the same force is off by 0.9 %.
    let wanted = sphere::from_contact_radius(1.0, 1.0, 0.35);
    let indenter = Indenter::Sphere(Sphere::new(1.0)?);
    let found = run.penetration(&on_half_space(indenter, 1.05, Load::Force(wanted.force))?)?;
    let check = "Sphere, a/R = 0.35: penetration".into();
    Ok(vec![Comparison::relative(
        check,
        wanted.penetration,
        found,
        SECOND_ORDER,
    )])
}

fn cone_rows(run: ValidationRun) -> Result<Vec<Comparison>, ValidationError> {
    let half_angle = 1.2;
    let wanted = cone::from_penetration(half_angle, 1.0, 0.1);
    let side = 3.0 * wanted.contact_radius;
    let contact = |load| {
        let indenter = Indenter::Cone(Cone::new(half_angle, 0.0)?);
        on_half_space(indenter, side, load)
    };
    let by_force = run.penetration(&contact(Load::Force(wanted.force))?)?;
    let by_penetration = run.solve(&contact(Load::Penetration(wanted.penetration))?)?;
    let force = by_penetration.steps[0].solution.force;
    Ok(vec![
        Comparison::relative(
            "Cone: penetration under a force".into(),
            wanted.penetration,
            by_force,
            SECOND_ORDER,
        ),
        Comparison::relative(
            "Cone: force at a penetration".into(),
            wanted.force,
            force,
            SECOND_ORDER,
        ),
    ])
}

fn power_rows(run: ValidationRun) -> Result<Vec<Comparison>, ValidationError> {
    let rows = [1.5, 3.3, 6.0].map(|exponent| {
        let wanted = power_law::from_contact_radius([exponent, 1.0], 1.0, 0.1);
        let indenter = Indenter::PowerLaw(PowerLaw::new(exponent, 1.0)?);
        let contact = on_half_space(indenter, 0.3, Load::Force(wanted.force))?;
        Ok(Comparison::relative(
            format!("Power law r^{exponent}: penetration under a force"),
            wanted.penetration,
            run.penetration(&contact)?,
            POWER_LAW,
        ))
    });
    rows.into_iter().collect()
}

fn punch_rows(run: ValidationRun) -> Result<Vec<Comparison>, ValidationError> {
    let wanted = flat_punch::from_force(0.1, 1.0, 0.02);
    let indenter = Indenter::FlatPunch(FlatPunch::new(0.1)?);
    let path = run.solve(&on_half_space(indenter, 0.25, Load::Force(wanted.force))?)?;
    let solution = &path.steps[0].solution;
    // The element with a corner on the axis.
    let middle = solution.pressure[ELEMENTS / 2 * (ELEMENTS + 1)];
    Ok(vec![
        Comparison::relative(
            "Flat punch: penetration".into(),
            wanted.penetration,
            solution.penetration,
            STAIRCASE,
        ),
        Comparison::relative(
            "Flat punch: pressure on the axis".into(),
            wanted.central_pressure,
            middle,
            STAIRCASE,
        ),
    ])
}

fn winkler_rows(run: ValidationRun) -> Result<Vec<Comparison>, ValidationError> {
    // The body deforms by less than 1e-9 of the film's shortening.
    let body = Foundation::half_space(Material::new(1e9, 0.3)?);
    let film = Film::new(0.01, 1.0)?;
    let wanted = winkler::from_penetration(1.0, film.compliance(), 0.005);
    let contact = ContactSetup {
        foundation: body,
        relief: Relief::Film(film),
        ..on_half_space(
            paraboloid(1.0)?,
            0.25,
            Load::Penetration(wanted.penetration),
        )?
    };
    let path = run.solve(&contact)?;
    let step = &path.steps[0];
    let elements = step.solution.pressure.iter().zip(path.grid.centres());
    let compared = elements.map(|(found, [x, y])| {
        let pressure = wanted.pressure(x.hypot(y));
        (
            [pressure, *found],
            (found - pressure).abs() / wanted.peak_pressure,
        )
    });
    Ok(vec![
        Comparison::relative(
            "Winkler: force at a penetration".into(),
            wanted.force,
            step.solution.force,
            SECOND_ORDER,
        ),
        Comparison::worst(
            "Winkler: pressure of every element".into(),
            compared,
            CERTIFIED,
        ),
    ])
}
