//! The module `pellicle._pellicle`: the program's interface for the Python package `pellicle`, in Python arrays and
//! exceptions.
//!
//! The package itself is Python: it writes cases as TOML, which the program's own reader resolves here, and it shows
//! results. This module solves. Work runs on separate threads while the interpreter continues, and Python waits for it
//! in short intervals, so that signals are noticed.

mod case;
mod discrete_problem;
mod error;
mod evaluation;
mod field;
mod fit;
mod foundation;
mod function;
mod planes;
mod process;
mod run;
mod search;
mod solution;
mod study;
mod work;

use pyo3::pymodule;

// Shared state is behind locks, and arrays are copied before they are read, so no interpreter-wide lock is needed.
#[pymodule(gil_used = false)]
mod _pellicle {
    #[pymodule_export]
    use crate::case::{Case, check_part, key_unit, key_units, number_text, read_text, si_value};
    #[pymodule_export]
    use crate::discrete_problem::DiscreteProblem;
    #[pymodule_export]
    use crate::error::{
        CaseError, ContactError, Error, IdentifyError, IndenterError, InfluenceError,
        InternalError, KernelError, RunError, TextureError,
    };
    #[pymodule_export]
    use crate::evaluation::evaluate;
    #[pymodule_export]
    use crate::field::Field;
    #[pymodule_export]
    use crate::fit::{Fit, FitRun, Likelihood, LikelihoodRun};
    #[pymodule_export]
    use crate::foundation::{Foundation, Operator};
    #[pymodule_export]
    use crate::planes::Planes;
    #[pymodule_export]
    use crate::run::Run;
    #[pymodule_export]
    use crate::search::{SearchRun, find};
    #[pymodule_export]
    use crate::solution::Solution;
    #[pymodule_export]
    use crate::study::{Study, StudyRun, Table};

    /// The version of the package, which is that of the program.
    #[pymodule_export]
    #[allow(non_upper_case_globals, reason = "Python's name")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
