//! A relief sampled at the elements of a grid.

use rayon::prelude::*;

use super::Relief;
use crate::grid::Grid;
use crate::relief_map::MapCompliance;
use crate::sampled::SampledRelief;

/// Whether a point lies on the relief of a pattern, and its depth below the plane of the tops, m.
type Patterned<'a> = dyn Fn([f64; 2]) -> (bool, f64) + Sync + 'a;

/// The elements at which a relief is sampled.
struct Elements<'a> {
    count: usize,
    /// Samples a pattern at all of them.
    patterned: &'a dyn Fn(&Patterned<'_>) -> Vec<(bool, f64)>,
    /// Coordinates of their rows and columns, m.
    lines: [Vec<f64>; 2],
    /// Their centres, m.
    centres: &'a dyn Fn() -> Vec<[f64; 2]>,
}

impl Relief {
    /// Samples mask, surface profile and compliance at the centres of the grid's elements.
    #[must_use]
    pub fn sample(&self, grid: &Grid) -> SampledRelief {
        let is_mirrored = self.is_mirrored();
        self.sampled(&Elements {
            count: grid.len(),
            patterned: &|point: &Patterned| grid.sample(is_mirrored, point),
            lines: [0, 1].map(|axis| grid.centres_from(axis, 0)),
            centres: &|| grid.sample(false, |point| point),
        })
    }

    /// Samples the elements from a row and a column on, in the order of [`Grid::sample_from`].
    ///
    /// # Panics
    /// As [`Grid::sample_from`].
    #[must_use]
    pub fn sample_from(&self, grid: &Grid, first: [usize; 2]) -> SampledRelief {
        let lengths = [0, 1].map(|axis| grid.lengths()[axis] - first[axis]);
        self.sampled(&Elements {
            count: lengths.iter().product(),
            patterned: &|point: &Patterned| grid.sample_from(first, point),
            lines: [0, 1].map(|axis| grid.centres_from(axis, first[axis])),
            centres: &|| grid.sample_from(first, |point| point),
        })
    }

    fn sampled(&self, elements: &Elements<'_>) -> SampledRelief {
        let everywhere = |value: f64| vec![value; elements.count];
        let law = self.spring_law();
        match self {
            Self::Bare => SampledRelief {
                mask: vec![false; elements.count],
                profile: everywhere(0.0),
                compliance: everywhere(0.0),
                law,
            },
            Self::Cylinders(cylinders) => {
                let at = |point| (cylinders.contains(point), cylinders.depth_at(point));
                let springs = |depth| cylinders.compliance_at_depth(depth);
                SampledRelief::of_depths(&(elements.patterned)(&at), springs, law)
            }
            Self::Recesses(recesses) => {
                let at = |point| (recesses.contains(point), recesses.depth_at(point));
                let springs = |depth| recesses.compliance_at_depth(depth);
                SampledRelief::of_depths(&(elements.patterned)(&at), springs, law)
            }
            Self::Film(film) => SampledRelief {
                mask: vec![true; elements.count],
                profile: everywhere(0.0),
                compliance: everywhere(film.compliance()),
                law,
            },
            Self::Map(map) => {
                let [x, y] = &elements.lines;
                let heights = map.map().at_crossings([x, y]);
                SampledRelief {
                    mask: vec![true; elements.count],
                    compliance: match map.compliance() {
                        MapCompliance::Uniform(compliance) => everywhere(compliance),
                        MapCompliance::YoungModulus(_) => {
                            let heights = heights.par_iter();
                            heights.map(|height| map.compliance_of(*height)).collect()
                        }
                    },
                    profile: map.profile_of(heights),
                    law,
                }
            }
            Self::Custom(custom) => {
                let centres = (elements.centres)();
                SampledRelief {
                    mask: vec![true; elements.count],
                    profile: custom.profile(&centres),
                    compliance: custom.compliance(&centres),
                    law,
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{CylinderSpec, Cylinders, Film, HeightMap, Lattice, ReliefMap};

    #[test]
    fn a_part_is_sampled_like_the_whole() {
        let spec = CylinderSpec {
            lattice: Lattice::Square,
            radius: 0.2,
            height: 0.1,
            period: 0.7,
            offset: [0.1, 0.3],
            young_modulus: 2.0,
        };
        let heights: Vec<f64> = (0..9).map(|k| f64::from(k * k)).collect();
        let map = HeightMap::new(heights, [3, 3], [3.0, 3.0]).unwrap();
        let reliefs = [
            Relief::Map(ReliefMap::new(map, MapCompliance::YoungModulus(2.0)).unwrap()),
            Relief::Bare,
            Relief::Cylinders(Cylinders::new(spec).unwrap()),
            Relief::Film(Film::new(2.0, 8.0).unwrap()),
        ];
        for (relief, size) in reliefs.iter().flat_map(|relief| [(relief, 8), (relief, 9)]) {
            let grid = Grid::new(3.0, size).unwrap();
            let (whole, found) = (relief.sample(&grid), relief.sample_from(&grid, [2, 4]));
            let elements = (0..grid.len()).filter(|e| e / size >= 2 && e % size >= 4);
            for (part, e) in elements.enumerate() {
                let at = |sampled: &SampledRelief, e: usize| {
                    (sampled.mask[e], sampled.profile[e], sampled.compliance[e])
                };
                assert_eq!(at(&found, part), at(&whole, e));
            }
            assert_eq!(found.mask.len(), (size - 2) * (size - 4));
        }
    }
}
