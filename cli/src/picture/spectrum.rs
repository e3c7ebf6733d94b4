//! The maps of a case, as numbers of the picture of their spectra.

use pellicle::summary::RunSummary;
use pellicle::summary::roughness::RoughnessSummary;
use pellicle_plot::run::spectrum::RoughMap;

/// The maps of a run; empty without maps.
#[must_use]
pub fn of_run(run: &RunSummary) -> Vec<RoughMap<'_>> {
    let maps = run.roughness.iter().flat_map(RoughnessSummary::maps);
    maps.map(|(name, map)| RoughMap {
        name,
        rms_height: map.rms_height,
        rms_slope: map.rms_slope,
        wavenumber: &map.spectrum.wavenumber,
        power: &map.spectrum.power,
    })
    .collect()
}
