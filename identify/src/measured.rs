//! Measured indentation curves: text of any instrument read into depths and forces in SI units.
//!
//! A [`DataTable`](data_table::DataTable) is one `[[data]]` table of a fit file. It names files and says how to read
//! them. Each file gives a [`MeasuredCurve`](curve::MeasuredCurve): the points of the segment in use, and the number of
//! points left out, with the reason. `docs/measured-curves.md` describes the keys.

pub mod baseline;
pub mod before_contact;
mod binary;
pub mod channel;
mod checks;
pub mod columns;
pub mod curve;
pub mod curve_segment;
pub(crate) mod cycles;
pub mod data_table;
pub mod decimal_mark;
pub mod depth_step;
mod end_slopes;
pub mod error;
pub mod exclusion;
pub mod header;
pub mod header_lines;
pub(crate) mod hysteresis;
mod jump;
pub mod noise;
pub mod omitted;
pub(crate) mod raw_curve;
pub(crate) mod reading;
pub(crate) mod segment_rows;
pub mod separator;
mod setting;
pub mod sources;
pub mod spring;
pub mod stated;
pub mod text_options;
pub mod text_table;
pub(crate) mod words;
