//! The rivals: their drivers, what must be installed for them, and the tolerances at which they run.

use std::fmt;

use clap::ValueEnum;

/// A program that solves the same problems, from the Python Package Index.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, ValueEnum)]
pub enum Rival {
    /// aspher, with nested grids and its full-grid preconditioner.
    Aspher,
    /// slippy, by its low-level solver.
    Slippy,
    /// Tamaas, on its non-periodic operator.
    Tamaas,
    /// `ContactMechanics`, on its free half-space.
    #[value(name = "contactmechanics")]
    ContactMechanics,
}

/// The tolerance that everyone is asked for.
pub(super) const TOLERANCE: f64 = 1e-8;
/// aspher's tolerance is relative to the gap's range, 11 times the Hertzian approach: at this one its certificate is
/// comparable with the others'.
const TIGHTER_TOLERANCE: f64 = 1e-9;

impl Rival {
    /// Every rival.
    pub const ALL: [Self; 4] = [
        Self::Aspher,
        Self::Slippy,
        Self::Tamaas,
        Self::ContactMechanics,
    ];

    /// File of its driver in `xtask/compare`.
    pub(super) fn driver(self) -> &'static str {
        match self {
            Self::Aspher => "aspher_driver.py",
            Self::Slippy => "slippy_driver.py",
            Self::Tamaas => "tamaas_driver.py",
            Self::ContactMechanics => "contactmechanics_driver.py",
        }
    }

    /// Arguments of `pip install`, one list an invocation.
    pub(super) fn requirements(self) -> &'static [&'static [&'static str]] {
        match self {
            // From source; Eigen's headers must be installed.
            Self::Aspher => &[&["aspher", "numpy"]],
            // Its own requirements cannot be met on current Pythons: versions that it works with, without asking it.
            Self::Slippy => &[
                &[
                    "numpy==1.23.5",
                    "numba==0.57.1",
                    "scipy==1.10.1",
                    "pyfftw==0.13.1",
                    "matplotlib==3.7.5",
                    "scikit-image==0.21.0",
                    "sympy",
                    "tinydb",
                ],
                &["--no-deps", "slippy"],
            ],
            Self::Tamaas => &[&["tamaas", "numpy", "scipy"]],
            Self::ContactMechanics => &[&["ContactMechanics"]],
        }
    }

    /// The tolerances at which it runs.
    pub(super) fn tolerances(self) -> &'static [f64] {
        match self {
            Self::Aspher => &[TOLERANCE, TIGHTER_TOLERANCE],
            Self::Slippy | Self::Tamaas | Self::ContactMechanics => &[TOLERANCE],
        }
    }

    /// Whether the package of the index can use more than one thread.
    pub(super) fn is_threaded(self) -> bool {
        match self {
            Self::Aspher | Self::Slippy => true,
            Self::Tamaas | Self::ContactMechanics => false,
        }
    }
}

impl fmt::Display for Rival {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Aspher => "aspher",
            Self::Slippy => "slippy",
            Self::Tamaas => "Tamaas",
            Self::ContactMechanics => "ContactMechanics",
        })
    }
}
