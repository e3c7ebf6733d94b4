//! The paper's own procedure, for comparison: drop what pulls, never take anything back.

use super::{check_size, dense_system::DenseSystem, exchange::Exchange};
use crate::{ContactError, DiscreteProblem, Iterate, Load, Solver, SolverOptions, Watch};

/// The procedure of Stepanov and Torskaya (2022): solve the linear system of all elements that may touch, drop those
/// with negative pressure, repeat until there are none.
///
/// An element once dropped stays out, and nothing looks at the gaps. Where the first systems pull on elements that belong to the
/// contact, as under a stiff coat or on a relief of islands, the end is a state in which the indenter overlaps the surface:
/// the certificate says so, and only that. On a smooth indenter over a homogeneous body it usually ends right.
///
/// ```
/// use std::sync::Arc;
/// use pellicle_contact::{
///     ActiveSetSolver, DiscreteProblem, DropOnlySolver, Load, Solution, Solver, Watch,
/// };
/// use pellicle_influence::{CoefficientTable, RadialTables, SurfaceElasticity};
/// use pellicle_kernel::{Foundation, Material};
///
/// // A waved indenter on a thin coat thirty times as stiff as what it lies on; 24 × 24 elements on a square of side 1.
/// let (n, side) = (24, 1.0 / 24.0);
/// let body = Foundation::coated(0.05, Material::new(30.0, 0.3)?, Material::new(1.0, 0.4)?)?;
/// let table = CoefficientTable::assemble(&RadialTables::build(&body)?, side, n)?;
/// let elasticity = Arc::new(SurfaceElasticity::new(Arc::new(table), body));
/// let centre = |i: usize| (i as f64 + 0.5) * side - 0.5;
/// let height = |x: f64, y: f64| {
///     (x * x + y * y) / 2.0 + 0.002 * (1.0 - (23.0 * x + 0.3).cos() * (19.0 * y - 0.2).cos())
/// };
/// let gap = (0..n * n).map(|e| height(centre(e / n), centre(e % n))).collect();
/// let mut problem = DiscreteProblem::elastic(elasticity, n, vec![0.0; n * n], gap, side * side)?;
/// let mut overlap = |solver: &dyn Solver| -> Result<f64, Box<dyn std::error::Error>> {
///     let mut watch = Watch { observer: &mut (), step: 0, finished: 0, steps: 1 };
///     let load = Load::Force(2e-2);
///     let iterate = solver.solve(&mut problem, load, &vec![0.0; n * n], &mut watch)?;
///     Ok(Solution::judge(&mut problem, load, iterate.pressure, 1e-8).certificate.overlap)
/// };
/// assert!(overlap(&ActiveSetSolver::default())? < 1e-10);
/// assert!(overlap(&DropOnlySolver::default())? > 1e-3); // of the penetration: not a solution
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DropOnlySolver {
    /// Its tolerance decides nothing: the procedure ends when nothing pulls.
    pub options: SolverOptions,
}

impl Solver for DropOnlySolver {
    fn solve(
        &self,
        problem: &mut DiscreteProblem,
        load: Load,
        _: &[f64],
        watch: &mut Watch<'_>,
    ) -> Result<Iterate, ContactError> {
        let size = problem.size();
        check_size(size)?;
        let system = DenseSystem::new(problem, load);
        let all = vec![0.0; problem.elements()];
        let mut members = Exchange::start(&system, &all).members().to_vec();
        let (mut residuals, mut moves) = (Vec::new(), members.len());
        loop {
            let trial = system.solve_on(&members)?;
            let working_set = [members.len(), moves];
            watch.tell(size, residuals.len(), trial.residual(), working_set)?;
            residuals.push(trial.residual());
            let before = members.len();
            members.retain(|m| trial.pressure[*m] >= 0.0);
            moves = before - members.len();
            if moves == 0 || members.is_empty() {
                return Ok(trial.into_iterate(residuals));
            }
        }
    }
}
