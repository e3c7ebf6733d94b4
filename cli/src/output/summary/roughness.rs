//! The roughness of the maps of a case, and the contact of rough surfaces, in a summary.

use pellicle_contact::{Histogram, Islands, Step, nan_from_null};
use pellicle_texture::{Band, MapRim, Roughness};
use serde::{Deserialize, Serialize};

use crate::case::Case;
use crate::case::grid::BoundaryCase;
use crate::case::map::MapCase;

/// The roughness of the maps of a case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RoughnessSummary {
    /// Roughness of the surface.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub surface: Option<MapRoughness>,
    /// Roughness of the indenter.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub indenter: Option<MapRoughness>,
}

/// The roughness of the samples of a map.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MapRoughness {
    /// Root mean square of the heights above their mean plane, m.
    #[serde(deserialize_with = "nan_from_null")]
    pub rms_height: f64,
    /// Root mean square of the slope.
    #[serde(deserialize_with = "nan_from_null")]
    pub rms_slope: f64,
    /// Root mean square of the mean curvature, 1/m.
    #[serde(deserialize_with = "nan_from_null")]
    pub rms_curvature: f64,
    /// The source of slopes and curvatures.
    pub derivatives: Derivatives,
    /// The power spectrum, averaged over directions.
    pub spectrum: SpectrumSummary,
}

/// The source of the slopes and curvatures of a map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Derivatives {
    /// From the waves of a periodic map.
    Spectrum,
    /// From differences between neighbouring samples of a map that ends.
    Differences,
}

/// A power spectrum, one number for each band.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SpectrumSummary {
    /// Mean wavenumber, 1/m.
    pub wavenumber: Vec<f64>,
    /// Mean power spectral density `C`, m⁴.
    pub power: Vec<f64>,
    /// Number of waves in the band.
    pub waves: Vec<usize>,
}

/// The contact of a rough surface.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RoughContactSummary {
    /// Area of the periodic cell, or of the convex hull of the contact, m².
    #[serde(deserialize_with = "nan_from_null")]
    pub nominal_area: f64,
    /// Contact area over nominal area.
    #[serde(deserialize_with = "nan_from_null")]
    pub contact_fraction: f64,
    /// Area of the elements in contact, m².
    #[serde(deserialize_with = "nan_from_null")]
    pub counted_area: f64,
    /// The counted area without a part of the perimeter, m².
    #[serde(deserialize_with = "nan_from_null")]
    pub corrected_area: f64,
    /// Length of the sides between elements in contact and others, m.
    #[serde(deserialize_with = "nan_from_null")]
    pub perimeter: f64,
    /// Gap averaged over the nominal area, 0 in contact, m.
    #[serde(deserialize_with = "nan_from_null")]
    pub mean_gap: f64,
    /// The islands of contact.
    pub islands: IslandsSummary,
    /// Pressures in contact, Pa.
    #[serde(with = "HistogramFields")]
    pub pressures: Histogram,
    /// Gaps out of contact on the nominal area, m.
    #[serde(with = "HistogramFields")]
    pub gaps: Histogram,
}

/// The islands of a contact.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct IslandsSummary {
    /// Their number.
    pub count: usize,
    /// Area of the largest island by its elements, m².
    #[serde(deserialize_with = "nan_from_null")]
    pub largest_area: f64,
    /// Mean area of the islands by their elements, m².
    #[serde(deserialize_with = "nan_from_null")]
    pub mean_area: f64,
    /// The numbers of islands with 1 element, 2 or 3, 4 to 7, and so on.
    pub counts_by_octave: Vec<usize>,
}

/// The fields of a [`Histogram`] in a file.
#[derive(Serialize, Deserialize)]
#[serde(remote = "Histogram")]
struct HistogramFields {
    #[serde(deserialize_with = "nan_from_null")]
    largest: f64,
    #[serde(deserialize_with = "nan_from_null")]
    mean: f64,
    counts: Vec<usize>,
}

impl RoughnessSummary {
    /// Computes the roughness of the maps of a case; none if it has no maps.
    #[must_use]
    pub fn of(case: &Case) -> Option<Self> {
        let roughness = |map: &MapCase| MapRoughness::of(map, case.grid.boundary);
        let [surface, indenter] =
            [case.surface.map(), case.indenter.map()].map(|map| map.map(roughness));
        (surface.is_some() || indenter.is_some()).then_some(Self { surface, indenter })
    }

    /// The existing maps, with the names of their tables in a case.
    pub fn maps(&self) -> impl Iterator<Item = (&'static str, &MapRoughness)> {
        let maps = [("surface", &self.surface), ("indenter", &self.indenter)];
        maps.into_iter()
            .filter_map(|(name, map)| Some((name, map.as_ref()?)))
    }
}

impl MapRoughness {
    fn of(map: &MapCase, boundary: BoundaryCase) -> Self {
        let (rim, derivatives) = match boundary {
            BoundaryCase::Free => (MapRim::Ends, Derivatives::Differences),
            BoundaryCase::Periodic => (MapRim::Repeats, Derivatives::Spectrum),
        };
        let rough = Roughness::of(map.own(), rim);
        let bands = &rough.spectrum.bands;
        let of_bands = |number: fn(&Band) -> f64| bands.iter().map(number).collect();
        Self {
            rms_height: rough.rms_height,
            rms_slope: rough.rms_slope,
            rms_curvature: rough.rms_curvature,
            derivatives,
            spectrum: SpectrumSummary {
                wavenumber: of_bands(|band| band.wavenumber),
                power: of_bands(|band| band.power),
                waves: bands.iter().map(|band| band.waves).collect(),
            },
        }
    }
}

impl RoughContactSummary {
    /// Summarises a step with elements of this area (m²); none if no map takes part, or without contact.
    #[must_use]
    pub fn of(step: &Step, element_area: f64) -> Option<Self> {
        let rough = step.rough.as_ref()?;
        Some(Self {
            nominal_area: rough.nominal_area,
            contact_fraction: step.summary.contact_area / rough.nominal_area,
            counted_area: rough.counted_area,
            corrected_area: rough.corrected_area,
            perimeter: rough.perimeter,
            mean_gap: rough.mean_gap,
            islands: IslandsSummary::of(&rough.islands, element_area),
            pressures: rough.pressures.clone(),
            gaps: rough.gaps.clone(),
        })
    }
}

impl IslandsSummary {
    fn of(islands: &Islands, element_area: f64) -> Self {
        let mean = islands.elements() as f64 / islands.count().max(1) as f64;
        Self {
            count: islands.count(),
            largest_area: islands.largest() as f64 * element_area,
            mean_area: mean * element_area,
            counts_by_octave: islands.counts_by_octave(),
        }
    }
}
