//! The formats of a step's fields: each has its own module in this folder, its size in `disk_space.rs` and its file
//! names in `own_files.rs`.

use std::path::Path;

use rayon::prelude::*;

use super::fields::Fields;
use super::summary::RunSummary;
use super::write_progress::WriteProgress;
use super::{gsf, netcdf, npz, vti};
use crate::case::output::Format;
use crate::failure::Failure;

/// Writes the fields of a step in every requested format, in parallel: compression takes about as long as all the rest.
///
/// # Errors
///
/// [`Failure::Write`] if a file cannot be written.
pub fn write(
    folder: &Path,
    summary: &RunSummary,
    step: usize,
    fields: &Fields<'_>,
    formats: &[Format],
    writer: &WriteProgress<'_>,
) -> Result<(), Failure> {
    let units = summary.units;
    formats.par_iter().try_for_each(|format| {
        let write = || match format {
            Format::Npz => npz::write(&folder.join(npz::file(step)), fields),
            Format::Vti => vti::write(&folder.join(vti::file(step)), fields, units),
            Format::Nc => netcdf::write(&folder.join(netcdf::file(step)), fields, summary, step),
            Format::Gsf => gsf::write(folder, fields, units, step),
        };
        writer.file(write).map(drop)
    })
}
