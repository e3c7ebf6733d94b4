//! The counted work of a search for extremes and for critical loads, known before any contact is solved.

use pellicle_texture::Relief;

use super::field::StressField;
use super::model::{Criterion, Sliding, StressModel};
use super::plane_scan::{BLOCKS, Target, margin};
use super::pressure_blocks::doublings;
use super::quantity::{OF_BODIES, OF_INTERFACES, StressQuantity};
use crate::{Indenter, LoadingPath};

/// The loaded elements of a contact, as far as the work of a search depends on them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadedElements {
    /// Elements along a side of the smallest square that holds all pressures.
    pub size: usize,
    /// Side of an element, m.
    pub side: f64,
    /// Whether the pressure is smooth, as under a ball on a bare surface, so that large squares are searched in blocks.
    pub is_smooth: bool,
    /// Number of layers and base below them; more than the bodies of a stress model if layers are graded.
    pub materials: usize,
}

impl LoadedElements {
    /// Those of a step if its contact were solved with this number of elements per side.
    ///
    /// # Panics
    /// If the path has no such step.
    #[must_use]
    pub fn of_step(path: &LoadingPath, step: usize, elements: usize) -> Self {
        let pressure = &path.steps[step].solution.pressure;
        let field = StressField::of(path.tables.clone(), path.grid, pressure, Sliding::default());
        let finer = elements as f64 / path.grid.size() as f64;
        let is_smooth = matches!(path.relief, Relief::Bare | Relief::Film(_))
            && !matches!(
                path.indenter,
                Indenter::FlatPunch(_)
                    | Indenter::Plane(_)
                    | Indenter::Map(_)
                    | Indenter::Custom(_)
            );
        Self {
            size: super::nearest(field.loaded().size as f64 * finer).unsigned_abs(),
            side: path.grid.side() / elements as f64,
            is_smooth,
            materials: path.tables.foundation().layers().len() + 1,
        }
    }
}

/// Counts from which time and memory of a search follow.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SearchWork {
    /// Planes, each with its functions of the distance from a load.
    pub planes: f64,
    /// Planes times layers: these functions consist of waves in all of them.
    pub planes_in_layers: f64,
    /// Places on all planes, with those of the loaded square: the size of their transforms.
    pub places: f64,
    /// Places on the largest plane, with those of the loaded square.
    pub largest_plane: f64,
    /// Places on all planes.
    pub kept: f64,
    /// Peaks that are followed, one a quantity and body.
    pub peaks: f64,
    /// Peaks times layers.
    pub peaks_in_layers: f64,
    /// Peaks times loaded elements: the size of their sums.
    pub summed: f64,
    /// Loaded elements if the tension at the edge of the contact is sought.
    pub at_edge: f64,
}

impl SearchWork {
    /// Number of [terms](Self::terms).
    pub const TERMS: usize = 7;

    /// The counts of which the time of a search is a sum: planes, the same in layers, places, peaks, the same in
    /// layers, sums and those of the edge.
    #[must_use]
    pub fn terms(&self) -> [f64; Self::TERMS] {
        [
            self.planes,
            self.planes_in_layers,
            self.places,
            self.peaks,
            self.peaks_in_layers,
            self.summed,
            self.at_edge,
        ]
    }
}

/// Counts the work of the extremes under a loaded square of elements.
#[must_use]
pub fn search_work(stress: &StressModel, loaded: LoadedElements) -> SearchWork {
    let wanted = |all: &[StressQuantity]| -> Vec<StressQuantity> {
        let wanted = all.iter().filter(|quantity| stress.wants(**quantity));
        wanted.copied().collect()
    };
    let (of_bodies, of_interfaces) = (wanted(&OF_BODIES), wanted(&OF_INTERFACES));
    let bodies = stress.bodies.iter();
    let bodies = bodies.map(|body| (body.top, body.bottom, &of_bodies));
    let interfaces = stress.interfaces.iter();
    let interfaces = interfaces.map(|of| (of.depth, of.depth, &of_interfaces));
    let targets = bodies.chain(interfaces);
    let targets = targets.map(|(top, bottom, quantities)| Target {
        top,
        bottom,
        quantities: quantities.clone(),
    });
    counted(&targets.collect::<Vec<_>>(), loaded)
}

/// Counts the work of one search of the whole body for each strength that is given.
#[must_use]
pub fn critical_work(stress: &StressModel, loaded: LoadedElements) -> Vec<SearchWork> {
    let of_bodies = stress.bodies.iter().flat_map(|body| {
        let (range, strengths) = ([body.top, body.bottom], body.strengths);
        [
            (strengths.yield_strength, Criterion::Yield, range),
            (strengths.tensile_strength, Criterion::Tension, range),
        ]
    });
    let of_interfaces = stress.interfaces.iter().flat_map(|interface| {
        let (range, strengths) = ([interface.depth; 2], interface.strengths);
        let (shear, tension) = (strengths.shear_strength, strengths.tensile_strength);
        [
            (shear, Criterion::InterfaceShear, range),
            (tension, Criterion::InterfaceTension, range),
        ]
    });
    let given = of_bodies.chain(of_interfaces);
    let given = given.filter(|(strength, ..)| strength.is_some());
    given
        .map(|(_, criterion, [top, bottom])| {
            let quantities = vec![criterion.quantity()];
            let target = Target {
                top,
                bottom,
                quantities,
            };
            counted(&[target], loaded)
        })
        .collect()
}

fn counted(targets: &[Target], loaded: LoadedElements) -> SearchWork {
    let LoadedElements {
        size,
        side,
        is_smooth,
        materials,
    } = loaded;
    let layers = materials as f64 - 1.0;
    let mut work = SearchWork::default();
    if size == 0 {
        return work;
    }
    let elements = size as f64 * size as f64;
    let least = match (1..u32::BITS).take_while(|m| size >> m >= BLOCKS).last() {
        Some(m) if is_smooth => m,
        _ => 0,
    };
    let mut known = Vec::new();
    for target in targets.iter().filter(|of| !of.quantities.is_empty()) {
        let peaks = target.quantities.len() as f64;
        work.peaks += peaks;
        work.peaks_in_layers += peaks * layers;
        work.summed += peaks * elements;
        if target.top == 0.0 && target.quantities.contains(&StressQuantity::MaxPrincipal) {
            work.at_edge = elements;
        }
        for depth in target.depths(size as f64 * side, side) {
            if known.contains(&depth) {
                continue;
            }
            known.push(depth);
            let doublings = doublings(depth.z, side).max(least);
            let blocks = size.div_ceil(1 << doublings.min(usize::BITS - 1));
            let block = side * 2_f64.powi(doublings.cast_signed());
            let shown = blocks + 2 * margin(blocks, depth.z / block);
            let (shown, together) = ((shown as f64).powi(2), ((shown + blocks) as f64).powi(2));
            work.planes += 1.0;
            work.planes_in_layers += layers;
            work.kept += shown;
            work.places += together;
            work.largest_plane = work.largest_plane.max(together);
        }
    }
    work
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stress::model::{BodyPart, BodyStrengths, InterfacePart, InterfaceStrengths};

    /// A coating of this thickness with a yield strength on a half-space.
    fn coating(thickness: f64) -> StressModel {
        let body = |name: &str, top, bottom, yield_strength| BodyPart {
            name: name.to_owned(),
            top,
            bottom,
            strengths: BodyStrengths {
                yield_strength,
                tensile_strength: None,
            },
        };
        StressModel {
            bodies: vec![
                body("layer[0]", 0.0, thickness, Some(1.0)),
                body("substrate", thickness, f64::INFINITY, None),
            ],
            interfaces: vec![InterfacePart {
                index: 0,
                depth: thickness,
                strengths: InterfaceStrengths {
                    shear_strength: Some(1.0),
                    tensile_strength: None,
                },
            }],
            ..StressModel::default()
        }
    }

    fn loaded(size: usize) -> LoadedElements {
        LoadedElements {
            size,
            side: 1.0,
            is_smooth: true,
            materials: 2,
        }
    }

    #[test]
    fn what_is_not_wanted_is_no_work() {
        let mut stress = coating(10.0);
        let all = search_work(&stress, loaded(20));
        assert_eq!(all.peaks, 2.0 * 4.0 + 3.0);
        assert_eq!(all.at_edge, 400.0);
        stress.only = Some(vec![StressQuantity::VonMises]);
        let one = search_work(&stress, loaded(20));
        assert_eq!((one.peaks, one.at_edge), (2.0, 0.0));
        stress.only = Some(vec![StressQuantity::Tension]);
        let interface = search_work(&stress, loaded(20));
        // A single plane.
        assert_eq!((interface.planes, interface.peaks), (1.0, 1.0));
        assert!(interface.places < 0.2 * one.places);
        assert_eq!(search_work(&stress, loaded(0)), SearchWork::default());
    }

    #[test]
    fn every_strength_is_one_search() {
        let works = critical_work(&coating(10.0), loaded(20));
        let peaks: Vec<f64> = works.iter().map(|work| work.peaks).collect();
        assert_eq!(peaks, [1.0, 1.0]);
        assert!(works[0].places > works[1].places);
    }

    #[test]
    fn a_smooth_pressure_is_searched_in_blocks() {
        let [rough, smooth] = [false, true].map(|is_smooth| {
            let loaded = LoadedElements {
                is_smooth,
                ..loaded(512)
            };
            search_work(&coating(100.0), loaded).places
        });
        assert!(smooth < 0.1 * rough, "{smooth} {rough}");
    }
}
