//! `pellicle surface`: a self-affine rough surface as a height map.

use std::path::Path;

use ndarray::ArrayView2;
use ndarray_npy::WriteNpyExt;
use pellicle_files::whole;

use crate::arguments::SurfaceArguments;
use crate::command::Outcome;
use crate::failure::Failure;
use crate::output::gsf;
use crate::self_affine::SelfAffine;
use crate::terminal;

/// Relative amount by which the shortest wave may be shorter than two samples, for rounding in the user's numbers.
const LEEWAY: f64 = 1e-9;

/// Writes the map.
///
/// # Errors
///
/// [`Failure`] if the extension belongs to neither format, the waves do not fit the square or its samples, or the file
/// exists or cannot be written.
pub fn surface(arguments: &SurfaceArguments) -> Result<Outcome, Failure> {
    let path = &arguments.out;
    let format = MapFormat::of(path)?;
    let surface = described(arguments)?;
    let no_wave = || {
        Failure::RoughSurface {
        message: "found no wave between the two lengths, wanted a band that holds the side over a whole number"
            .to_owned(),
    }
    };
    let heights = surface.heights().ok_or_else(no_wave)?;
    let bytes = match format {
        MapFormat::Npy => npy(&heights, surface.size),
        MapFormat::Gsf => gsf::height_map(&heights, surface.size, arguments.side),
    };
    if arguments.force {
        whole::write_bytes(path, &bytes)?;
    } else {
        whole::write_new(path, &bytes)?;
    }
    let shown = path.display();
    let side = arguments.side;
    let keys = match format {
        MapFormat::Npy => format!("file = \"{shown}\", side = \"{side:?} m\", height_unit = \"m\""),
        MapFormat::Gsf => format!("file = \"{shown}\""),
    };
    terminal::report(&format!(
        "wrote {shown}; in a case: surface = {{ kind = \"rough\", {keys} }}"
    ));
    Ok(Outcome::Done)
}

/// The format of a map.
#[derive(Debug, Clone, Copy)]
enum MapFormat {
    Npy,
    Gsf,
}

impl MapFormat {
    fn of(path: &Path) -> Result<Self, Failure> {
        let ending = path.extension().unwrap_or_default().to_string_lossy();
        match ending.to_lowercase().as_str() {
            "npy" => Ok(Self::Npy),
            "gsf" => Ok(Self::Gsf),
            found => Err(Failure::RoughSurface {
                message: format!("found a file name that ends in \"{found}\", wanted .npy or .gsf"),
            }),
        }
    }
}

/// The surface that the arguments describe.
fn described(arguments: &SurfaceArguments) -> Result<SelfAffine, Failure> {
    let (side, size) = (arguments.side, usize::from(arguments.size));
    let finest = 2.0 * side / size as f64;
    let [longest, shortest] = match arguments.wavelengths[..] {
        [one, other] => [one.max(other), one.min(other)],
        _ => [side / 2.0, finest],
    };
    let refuse = |message: String| Err(Failure::RoughSurface { message });
    if longest > side {
        return refuse(format!(
            "--wavelengths: found {longest:?} m, wanted no wave longer than the side, {side:?} m"
        ));
    }
    if shortest < finest * (1.0 - LEEWAY) {
        return refuse(format!(
            "--wavelengths: found {shortest:e} m, wanted no wave shorter than two samples, {finest:e} m"
        ));
    }
    Ok(SelfAffine {
        size,
        waves: [
            side / longest * (1.0 - LEEWAY),
            side / shortest * (1.0 + LEEWAY),
        ],
        hurst: arguments.hurst,
        rms: arguments.rms,
        seed: arguments.seed,
    })
}

fn npy(heights: &[f64], size: usize) -> Vec<u8> {
    let mut bytes = Vec::new();
    let written = ArrayView2::from_shape((size, size), heights)
        .map(|view| view.write_npy(&mut bytes).is_ok());
    debug_assert!(written.unwrap_or_default(), "memory takes every array");
    bytes
}
