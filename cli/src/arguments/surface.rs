//! Arguments of `surface`.

use std::path::PathBuf;

use clap::Args;

use super::values::{hurst, length};

/// Arguments of `surface`.
#[derive(Debug, Args)]
pub struct SurfaceArguments {
    /// The map's file: .npy (heights in m) or .gsf (heights and sides, single precision)
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,
    /// Side of the square, such as "0.3 mm"; a bare number is in m
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    pub side: f64,
    /// Root mean square of the heights, such as "50 nm"
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    pub rms: f64,
    /// Samples along each side
    #[arg(long, value_name = "N", default_value_t = 512, value_parser = clap::value_parser!(u16).range(4..=16384))]
    pub size: u16,
    /// Hurst exponent, from 0 to 1
    #[arg(long, value_name = "H", default_value_t = 0.8, value_parser = hurst)]
    pub hurst: f64,
    /// Longest and shortest wave, in any order [default: half of the side, and two samples]
    #[arg(long, value_name = "LENGTH", num_args = 2, value_delimiter = ',', value_parser = length)]
    pub wavelengths: Vec<f64>,
    /// Seed of the random phases: the same seed gives the same surface
    #[arg(long, value_name = "SEED", default_value_t = 1)]
    pub seed: u64,
    /// Replace the file if it exists
    #[arg(long)]
    pub force: bool,
}
