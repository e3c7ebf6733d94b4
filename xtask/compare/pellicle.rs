//! Pellicle's driver in the comparison: solves one problem in a separate process and prints the cost.
//!
//! ```text
//! compare-pellicle CASE N THREADS TOLERANCE PRESSURE_FILE [--whole-grid]
//! ```
//!
//! The problems are those of `problem.py`; the gap of a rough surface is read from the file named by `GAP_FILE`, and
//! its mean pressure and hardness from `MEAN_PRESSURE` and `HARDNESS`. The certificate, computed from `problem.py`
//! alone, checks that the two definitions agree.

#![expect(clippy::print_stdout, reason = "its one line of JSON is its result")]

use std::error::Error;
use std::fs;
use std::sync::Arc;
use std::time::Instant;

use ndarray::Array2;
use pellicle_contact::{
    Domain, FlatPunch, Indenter, Load, LoadingPath, Model, Paraboloid, SolverOptions, solve_path,
};
use pellicle_influence::{Cache, RadialTables};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::{
    CylinderSpec, Cylinders, HeightMap, Lattice, MapCompliance, Relief, ReliefMap,
};

type DriverError = Box<dyn Error + Send + Sync>;

const SIDE: f64 = 1.0;
/// Hertzian contact radius under the paraboloid, whose radius is 1.
const CONTACT_RADIUS: f64 = 0.15;
const PILLAR_HEIGHT: f64 = 0.1 * CONTACT_RADIUS * CONTACT_RADIUS;
const ELEMENTS_PER_PERIOD: usize = 16;
const RADIUS_OVER_PERIOD: f64 = 0.4;
/// Modulus of the pillars: their shortening is below 1e-33 and changes no bit of a displacement of 1e-2.
const PILLAR_MODULUS: f64 = 1e30;
/// The problems whose square is a periodic cell.
const CELLS: [&str; 2] = ["periodic", "saturated"];
/// Elements per side of the problem solved before timing, to load code and start threads.
const WARM_UP_ELEMENTS: usize = 64;

fn main() -> Result<(), DriverError> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (arguments, whole_grid) = match arguments.split_last() {
        Some((last, rest)) if last == "--whole-grid" => (rest.to_vec(), true),
        _ => (arguments, false),
    };
    let [case, elements, threads, tolerance, pressure_file] = &arguments[..] else {
        return Err(
            "wanted the arguments CASE N THREADS TOLERANCE PRESSURE_FILE [--whole-grid]".into(),
        );
    };
    let elements: usize = elements.parse()?;
    let options = SolverOptions {
        tolerance: tolerance.parse()?,
        // The rivals do not compute the stiffness.
        contact_stiffness: false,
        mirror_symmetry: !whole_grid,
        ..SolverOptions::default()
    };
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads.parse()?)
        .build()?;
    pool.install(|| solve("hertz", WARM_UP_ELEMENTS, None, &options))?;

    let is_measured = case.starts_with("rough") || CELLS.contains(&case.as_str());
    let gap = is_measured.then(read_gap).transpose()?;
    let options = SolverOptions {
        hardness: std::env::var("HARDNESS")
            .map_or(Ok(f64::INFINITY), |hardness| hardness.parse())?,
        ..options
    };
    let (clock, cpu) = (Instant::now(), cpu_seconds());
    let path = pool.install(|| solve(case, elements, gap, &options))?;
    let (total_seconds, cpu) = (
        clock.elapsed().as_secs_f64(),
        difference(cpu, cpu_seconds()),
    );
    let peak_bytes = peak_bytes();

    let step = &path.steps[0];
    let pressure = Array2::from_shape_vec((elements, elements), step.solution.pressure.clone())?;
    ndarray_npy::write_npy(pressure_file, &pressure)?;
    let measurement = serde_json::json!({
        "version": env!("CARGO_PKG_VERSION"),
        "setup_seconds": total_seconds - path.solve_seconds,
        "solve_seconds": path.solve_seconds,
        "cpu_seconds": cpu,
        "products": step.work.operator_applications,
        "peak_bytes": peak_bytes,
        "converged": step.solution.certificate.is_satisfied(),
        "own_error": step.solution.certificate.worst(),
    });
    println!("{measurement}");
    Ok(())
}

/// Reads the gap and the mean pressure of `rough`, written by `problem.py`.
fn read_gap() -> Result<(Array2<f64>, f64), DriverError> {
    let gap = ndarray_npy::read_npy(std::env::var("GAP_FILE")?)?;
    Ok((gap, std::env::var("MEAN_PRESSURE")?.parse()?))
}

fn solve(
    case: &str,
    elements: usize,
    gap: Option<(Array2<f64>, f64)>,
    options: &SolverOptions,
) -> Result<LoadingPath, DriverError> {
    // F = 4 E* a³/(3R), E* = E/(1 − ν²) = 1
    let hertz = 4.0 * CONTACT_RADIUS.powi(3) / 3.0;
    let force = gap.as_ref().map_or(hertz, |(_, mean)| mean * SIDE * SIDE);
    let (relief, indenter) = match (case, gap) {
        ("hertz", _) => (Relief::Bare, Indenter::Paraboloid(Paraboloid::new(1.0)?)),
        ("pillars", _) => (
            pillars(elements)?,
            Indenter::Paraboloid(Paraboloid::new(1.0)?),
        ),
        (_, Some((gap, _))) => (
            rough(gap)?,
            Indenter::FlatPunch(FlatPunch::new(2.0 * SIDE)?),
        ),
        _ => return Err(format!("found no case named {case}").into()),
    };
    let model = Model {
        tables: Arc::new(RadialTables::build(&Foundation::half_space(
            Material::new(1.0, 0.0)?,
        ))?),
        relief,
        indenter,
        cache: Cache::none(),
    };
    let domain = if CELLS.contains(&case) {
        Domain::Periodic(SIDE)
    } else {
        Domain::Side(SIDE)
    };
    let loads = [Load::Force(force)];
    Ok(solve_path(
        &model,
        domain,
        elements,
        &loads,
        options,
        &mut (),
    )?)
}

/// The rough body itself, without springs, under a plane that covers the square.
fn rough(gap: Array2<f64>) -> Result<Relief, DriverError> {
    let shape = [gap.nrows(), gap.ncols()];
    let mut heights = gap.into_raw_vec_and_offset().0;
    heights.iter_mut().for_each(|height| *height = -*height);
    let map = HeightMap::new(heights, shape, [SIDE; 2])?;
    let compliance = MapCompliance::Uniform(0.0);
    Ok(Relief::Map(ReliefMap::new(map, compliance)?))
}

/// Pillars whose periods fill the grid exactly.
fn pillars(elements: usize) -> Result<Relief, DriverError> {
    if !elements.is_multiple_of(ELEMENTS_PER_PERIOD) {
        return Err(format!(
            "found {elements} elements per side, wanted a multiple of {ELEMENTS_PER_PERIOD}"
        )
        .into());
    }
    let period = SIDE * ELEMENTS_PER_PERIOD as f64 / elements as f64;
    Ok(Relief::Cylinders(Cylinders::new(CylinderSpec {
        lattice: Lattice::Square,
        radius: RADIUS_OVER_PERIOD * period,
        height: PILLAR_HEIGHT,
        period,
        offset: [0.5 * (period - SIDE); 2],
        young_modulus: PILLAR_MODULUS,
    })?))
}

/// CPU time of all threads of this process so far, in s; `None` where the system does not record it.
fn cpu_seconds() -> Option<f64> {
    let mut nanoseconds = 0.0;
    for task in fs::read_dir("/proc/self/task").ok()? {
        let account = fs::read_to_string(task.ok()?.path().join("schedstat")).ok()?;
        nanoseconds += account.split(' ').next()?.parse::<f64>().ok()?;
    }
    Some(nanoseconds * 1e-9)
}

fn difference(before: Option<f64>, after: Option<f64>) -> Option<f64> {
    Some(after? - before?)
}

/// The largest resident memory of this process so far, the line `VmHWM: … kB` of its status.
fn peak_bytes() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(1024 * kilobytes)
}
