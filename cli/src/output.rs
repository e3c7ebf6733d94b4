//! The results of a run: its summary, fields, pictures and report.

pub mod disk_space;
pub mod gsf;
mod large_file;
pub mod netcdf;
pub mod npz;
mod npz_archive;
pub mod paper;
pub mod pictures;
pub mod redraw;
pub mod report;
pub mod results;
mod stoppable;
pub mod stress;
pub mod summary_text;
pub mod vti;
pub mod write_progress;
