//! The program `pellicle`, for the tests of this package.

use std::process::ExitCode;

fn main() -> ExitCode {
    pellicle_cli::main(std::env::args_os())
}
