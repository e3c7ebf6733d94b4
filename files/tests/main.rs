//! A failure to write names what the user will look for, and the cause of the system alone.

use std::io;
use std::path::Path;

use pellicle_files::FileError;

#[derive(Debug, thiserror::Error)]
#[error("packing failed")]
struct Packing(#[source] io::Error);

#[test]
fn a_failure_to_write_names_the_file_and_the_cause_of_the_system_alone() {
    let full = io::Error::from_raw_os_error(28);
    let words = full.to_string();
    let packed = Packing(io::Error::other(full));
    let path = Path::new("results/a/.pellicle-run-x1/fields-000.npz");
    let failure = FileError::write(path, io::Error::other(packed));
    let wanted = format!("results/a/fields-000.npz: cannot be written: {words}");
    assert_eq!(failure.to_string(), wanted);
}
