//! `pellicle stress`: displacements and stresses at points of the body under one load of a case.

use pellicle::Watching;
use pellicle::case::Case;
use pellicle::case::foundation::depths::BodyPlane;
use pellicle::case::stress::StressCase;
use pellicle::case::stressed_body::StressedBody;
use pellicle::forecast::need::Need;
use pellicle::input::units::Units;
use pellicle::memory::MemoryBudget;
use pellicle_contact::{Model, Status, StressField, solve_path};
use pellicle_files::json;
use pellicle_influence::{Depth, ElasticBody, SubsurfaceState};
use serde::Serialize;

use crate::arguments::StressArguments;
use crate::command::{Outcome, complaint};
use crate::failure::Failure;
use crate::output::stress::FIELDS;
use crate::progress::ProgressLine;
use crate::{cache, terminal, threads};

/// Distance, in elements, within which a point counts as on the border of an element.
const ON_BORDER: f64 = 1e-6;

/// The state at one point, in m and Pa; null where unbounded.
#[derive(Debug, Clone, Copy, Serialize)]
struct PointRow {
    /// x, y and z, m.
    at: [f64; 3],
    /// The body to which a point on an interface belongs.
    side: &'static str,
    /// Displacements along x, y and z, m.
    u: [f64; 3],
    /// Stresses, Pa.
    sigma: SigmaRow,
    /// Von Mises' stress, Pa.
    von_mises: f64,
    /// Principal stresses, the largest first, Pa.
    principal: [f64; 3],
}

#[derive(Debug, Clone, Copy, Serialize)]
struct SigmaRow {
    xx: f64,
    yy: f64,
    zz: f64,
    xy: f64,
    xz: f64,
    yz: f64,
}

/// Solves one load of the case and prints one row per point, two for a point on an interface.
///
/// # Errors
///
/// [`Failure`] if the case is wrong or has no such step, a point lies outside the body, or the contact cannot be
/// computed.
pub fn stress(arguments: &StressArguments) -> Result<Outcome, Failure> {
    let case = Case::read(&arguments.case.path, &arguments.case.sets)?;
    if case.wear.is_some() {
        let wanted = "none: stresses are computed under surfaces without wear";
        return Err(pellicle::Error::from(case.document.wanted("wear", wanted)).into());
    }
    let step = step(&case, arguments.step)?;
    check_depths(&case, &arguments.points)?;
    let cache = cache::open();
    let model = case.model(&cache)?.value;
    threads::begin();
    let (field, status, side) = solve(&case, &model, step, arguments.json)?;
    let bodies = model.tables.bodies();
    let (body, foundation) = (case.stressed(), bodies.of(stressed(&case)));
    let mut rows = Vec::new();
    for [x, y, z] in &arguments.points {
        for plane in body.planes(foundation, *z) {
            let state = state(&field, [*x, *y], plane.depth)?;
            rows.push(PointRow::new([*x, *y, *z], plane, &state));
        }
    }
    let text = if arguments.json {
        json(&rows)?
    } else {
        table(&rows, step, case.units)
    };
    terminal::print(&text)?;
    cache::report_warnings(&cache);
    for warning in case.warnings(side) {
        terminal::report(&format!("warning: {}", warning.message));
    }
    Ok(outcome(status))
}

/// The body inside which the points lie.
fn stressed(case: &Case) -> ElasticBody {
    let stress = case.stress.as_ref();
    stress
        .map_or_else(StressedBody::default, |stress| stress.body)
        .into()
}

/// The requested step, by default the last.
fn step(case: &Case, requested: Option<usize>) -> Result<usize, Failure> {
    let last = case.load.steps().saturating_sub(1);
    match requested {
        Some(found) if found > last => Err(Failure::NoStep { found, last }),
        requested => Ok(requested.unwrap_or(last)),
    }
}

/// Rejects a point inside a rigid base before anything is solved.
fn check_depths(case: &Case, points: &[[f64; 3]]) -> Result<(), Failure> {
    let bottom = case.stressed().bottom();
    let is_outside = |point: &&[f64; 3]| {
        let planes_end = bottom * (1.0 + pellicle::case::foundation::FoundationCase::NEAR);
        point[2] > planes_end
    };
    points
        .iter()
        .find(is_outside)
        .map_or(Ok(()), |[_, _, found]| {
            Err(Failure::InRigidBase {
                found: *found,
                bottom,
            })
        })
}

/// Solves one load of the case on the domain of all loads. Returns its stress field and status, and the side of the
/// domain.
fn solve(
    case: &Case,
    model: &Model,
    step: usize,
    is_quiet: bool,
) -> Result<(StressField, Status, f64), Failure> {
    let mut line = if is_quiet {
        ProgressLine::hidden()
    } else {
        ProgressLine::new(case.solver.tolerance)
    };
    let domain = case.domain(model)?;
    let memory = MemoryBudget::default();
    let _share = memory.take(Need::new(case, model, domain, 0), &mut line)?;
    let loads = &case.loads()[step..=step];
    let elements = case.grid.elements;
    let options = case.solver_options();
    let path = solve_path(
        model,
        domain,
        elements,
        loads,
        &options,
        &mut Watching(&mut line),
    )
    .map_err(|error| case.blame(error))?;
    let sliding = case.stress.as_ref().map(StressCase::sliding);
    let seen = path.seen_from(stressed(case));
    let field = StressField::new(&seen, 0, sliding.unwrap_or_default());
    match (field, path.steps.first()) {
        (Some(field), Some(step)) => {
            let residual = case.stressed().residual_stress(seen.tables.foundation());
            Ok((
                field.with_residual(residual),
                step.status(),
                path.grid.side(),
            ))
        }
        // There is no step if the user stopped.
        _ => Err(pellicle_contact::ContactError::Cancelled { step }.into()),
    }
}

/// The state at a point. On the surface, pressure and stresses jump between elements: a point on the border of two or
/// four elements gets the mean of the values half an element to either side.
fn state(field: &StressField, point: [f64; 2], depth: Depth) -> Result<SubsurfaceState, Failure> {
    let grid = field.grid();
    let beside = |x: f64| {
        let elements = x / grid.element_side() + 0.5 * grid.size() as f64;
        if depth.z == 0.0 && (elements - elements.round()).abs() < ON_BORDER {
            let half = 0.5 * grid.element_side();
            vec![x - half, x + half]
        } else {
            vec![x]
        }
    };
    let [along_x, along_y] = point.map(beside);
    let pairs = along_x
        .iter()
        .flat_map(|x| along_y.iter().map(|y| [*x, *y]));
    let points: Vec<_> = pairs.collect();
    let states = field.at_points(&points, depth).map_err(Failure::Inside)?;
    let sum = states
        .iter()
        .fold(SubsurfaceState::default(), |sum, state| sum + *state);
    Ok(sum * (1.0 / points.len() as f64))
}

fn outcome(status: Status) -> Outcome {
    match complaint(status) {
        None => Outcome::Done,
        Some(complaint) => {
            terminal::report(&complaint);
            Outcome::NotConverged
        }
    }
}

impl PointRow {
    fn new(at: [f64; 3], plane: BodyPlane, state: &SubsurfaceState) -> Self {
        let [xx, yy, zz, xy, xz, yz] = state.stress;
        Self {
            at,
            side: plane.side(),
            u: state.displacement,
            sigma: SigmaRow {
                xx,
                yy,
                zz,
                xy,
                xz,
                yz,
            },
            von_mises: state.von_mises(),
            principal: state.principal(),
        }
    }

    /// The values in the order of [`FIELDS`].
    fn values(&self) -> [f64; FIELDS.len()] {
        let ([ux, uy, uz], sigma) = (self.u, self.sigma);
        let SigmaRow {
            xx,
            yy,
            zz,
            xy,
            xz,
            yz,
        } = sigma;
        let [largest, ..] = self.principal;
        [ux, uy, uz, xx, yy, zz, xy, xz, yz, self.von_mises, largest]
    }
}

/// The rows as a table.
fn table(rows: &[PointRow], step: usize, units: Units) -> String {
    let (metre, pascal) = (units.name("m"), units.name("Pa"));
    let names = FIELDS.map(|field| format!("{:>15}", field.name)).concat();
    let line = |row: &PointRow| {
        let at = row.at.map(|along| format!("{along:>14.5e}")).concat();
        let values = row.values().map(|value| format!("{value:>15.6e}"));
        format!("{at}  {:<6}{}\n", row.side, values.concat())
    };
    let lines: String = rows.iter().map(line).collect();
    format!(
        "step {step}; x, y, z and displacements in {metre}, stresses in {pascal}\n\
         {:>14}{:>14}{:>14}  {:<6}{names}\n{lines}",
        "x", "y", "z", "side"
    )
}
