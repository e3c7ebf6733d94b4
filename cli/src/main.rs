//! The program `pellicle`.

use std::process::ExitCode;

fn main() -> ExitCode {
    pellicle_cli::main(std::env::args_os())
}
