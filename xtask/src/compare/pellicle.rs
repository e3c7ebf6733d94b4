//! Pellicle's own run, in a process of its own like a rival's.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use ndarray::Array2;
use pellicle_contact::{LoadingPath, SolverOptions, solve_path};

use super::{Case, Measurement, Problem};
use crate::XtaskError;

/// One problem for Pellicle alone.
#[derive(Debug, Clone, Args)]
pub struct PellicleArguments {
    /// Problem.
    pub case: Case,
    /// Elements per side.
    pub elements: usize,
    /// Number of threads.
    pub threads: usize,
    /// Bound on every line of the certificate.
    pub tolerance: f64,
    /// File to write the pressure to, `.npy`.
    pub pressure: PathBuf,
    /// Solve on the whole grid what a quadrant would do for.
    #[arg(long)]
    pub whole_grid: bool,
}

/// Elements per side of the problem solved before the clock starts, so that code is loaded and threads run.
const WARM_UP_ELEMENTS: usize = 64;

/// Solves the problem from its parameters, writes the pressure, and says what it took.
///
/// # Errors
/// A problem that cannot be posed or solved, threads that cannot be started, a file that cannot be written.
pub fn run_pellicle(arguments: &PellicleArguments) -> Result<Measurement, XtaskError> {
    let problem = Problem::new(arguments.case, arguments.elements)?;
    let warm_up = Problem::new(arguments.case, WARM_UP_ELEMENTS)?;
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(arguments.threads)
        .build()?;
    let options = SolverOptions {
        tolerance: arguments.tolerance,
        // The rivals do not compute it.
        contact_stiffness: false,
        mirror_symmetry: !arguments.whole_grid,
        ..SolverOptions::default()
    };
    pool.install(|| solve(warm_up, &options))?;
    let clock = Instant::now();
    let path = pool.install(|| solve(problem, &options))?;
    let total_seconds = clock.elapsed().as_secs_f64();
    let peak_bytes = peak_bytes();
    write_pressure(&path, &arguments.pressure)?;
    Ok(measurement(&path, total_seconds, peak_bytes))
}

fn solve(problem: Problem, options: &SolverOptions) -> Result<LoadingPath, XtaskError> {
    let model = problem.model()?;
    Ok(solve_path(
        &model,
        problem.domain(),
        problem.elements(),
        &[problem.load()],
        options,
        &mut (),
    )?)
}

fn measurement(path: &LoadingPath, total_seconds: f64, peak_bytes: Option<u64>) -> Measurement {
    let step = path.steps.first();
    let certificate = step.map(|step| step.solution.certificate);
    let solve_seconds = path.solve_seconds;
    Measurement {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        setup_seconds: total_seconds - solve_seconds,
        solve_seconds,
        products: step.map(|step| step.work.operator_applications),
        peak_bytes,
        converged: certificate.is_some_and(|certificate| certificate.is_satisfied()),
        own_error: certificate.map(|certificate| certificate.worst()),
    }
}

/// Writes the N × N pressure of the only step.
fn write_pressure(path: &LoadingPath, file: &Path) -> Result<(), XtaskError> {
    let size = path.grid.size();
    for step in &path.steps {
        let pressure = &step.solution.pressure;
        let field = Array2::from_shape_fn((size, size), |(i, j)| pressure[i * size + j]);
        ndarray_npy::write_npy(file, &field)?;
    }
    Ok(())
}

/// The largest resident memory of this process so far; none where the system keeps no such account.
fn peak_bytes() -> Option<u64> {
    high_water_mark(&fs::read_to_string("/proc/self/status").ok()?)
}

/// The line `VmHWM: … kB` of a process's status.
fn high_water_mark(status: &str) -> Option<u64> {
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(1024 * kilobytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_high_water_mark_is_in_kilobytes() {
        let status = "Name:\txtask\nVmPeak:\t  20 kB\nVmHWM:\t    12 kB\n";
        assert_eq!(high_water_mark(status), Some(12 * 1024));
        assert_eq!(high_water_mark("Name:\txtask\n"), None);
    }

    #[test]
    fn pellicle_certifies_both_cases_and_writes_what_it_found() {
        let folder = tempfile::tempdir().unwrap();
        for (case, whole_grid) in [
            (Case::Hertz, false),
            (Case::Pillars, false),
            (Case::Pillars, true),
        ] {
            let arguments = PellicleArguments {
                case,
                elements: 64,
                threads: 1,
                tolerance: 1e-8,
                pressure: folder.path().join("pressure.npy"),
                whole_grid,
            };
            let measurement = run_pellicle(&arguments).unwrap();
            assert!(measurement.converged, "{measurement:?}");
            assert!(measurement.products > Some(1));
            let pressure: Array2<f64> = ndarray_npy::read_npy(&arguments.pressure).unwrap();
            // F = 4 · 0.15³/3 = 0.0045 on elements of area 1/64²; to the tolerance of the load.
            approx::assert_relative_eq!(
                pressure.sum() / 4096.0,
                0.0045,
                max_relative = arguments.tolerance
            );
        }
    }
}
