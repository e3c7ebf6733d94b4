//! The place of the largest pressure on the cylinders.

use std::collections::BTreeMap;

use super::cases::{PaperCase, RADIUS, only_step};
use super::fields::{SolvedFields, nearest_cylinder, relative_distance};
use super::numbers::assert_reads;

/// The edge region of a cylinder: from here to its boundary, in radii. A tenth of the radius is three elements at
/// N = 512 in Fig. 2(a), so a step in the sampled circle does not move a peak out of it.
const EDGE: f64 = 0.9;
/// The middle of a cylinder, in radii.
const MIDDLE: f64 = 0.25;

/// Pressure and distance from the cylinder's axis, in radii, for every grid element on each cylinder.
fn cylinders(case: PaperCase, elements: usize) -> BTreeMap<[i64; 2], Vec<(f64, f64)>> {
    let fields = SolvedFields::of(case, 0, elements);
    let mut loaded: BTreeMap<_, Vec<_>> = BTreeMap::new();
    for index in (0..fields.pressure.len()).filter(|&index| fields.is_on_relief(index)) {
        let point = fields.point(index);
        let cylinder = loaded.entry(nearest_cylinder(point)).or_default();
        cylinder.push((fields.pressure[index], relative_distance(point)));
    }
    loaded
}

/// Mean pressure over a part of a cylinder.
fn mean(cylinder: &[(f64, f64)], belongs: impl Fn(f64) -> bool) -> f64 {
    let inside = || cylinder.iter().filter(|(_, distance)| belongs(*distance));
    inside().map(|(pressure, _)| pressure).sum::<f64>() / inside().count().max(1) as f64
}

/// Distance of the largest pressure from the axis, in radii, and whether it is at the edge of the central cylinder.
fn largest(case: PaperCase, elements: usize) -> (f64, bool) {
    let point = only_step(case, elements).summary.max_pressure_at;
    let at_edge = (EDGE..=1.0).contains(&relative_distance(point));
    let [x, y] = point;
    (
        x.hypot(y) / RADIUS,
        at_edge && nearest_cylinder(point) == [0, 0],
    )
}

#[test]
fn the_pressure_peaks_at_the_edges_of_the_elements() {
    for (case, full, found) in [
        (PaperCase::Fig2a, 1, ["1.90", "2.02"]),
        (PaperCase::Fig2b, 9, ["13.7", "19.9"]),
        (PaperCase::Fig2c, 9, ["2.40", "2.56"]),
        (PaperCase::Fig2d, 45, ["9.17", "16.1"]),
    ] {
        for (elements, written) in [512, 1024].into_iter().zip(found) {
            let loaded = cylinders(case, elements);
            let in_contact =
                |one: &&Vec<(f64, f64)>| one.iter().all(|(pressure, _)| *pressure > 0.0);
            let wholly: Vec<_> = loaded.values().filter(in_contact).collect();
            assert_eq!(wholly.len(), full, "{case:?}");
            let mut most = 0.0_f64;
            for cylinder in wholly {
                let by_pressure = |a: &&(f64, f64), b: &&(f64, f64)| a.0.total_cmp(&b.0);
                let (peak, at) = cylinder.iter().max_by(by_pressure).expect("elements on it");
                // A peak at the edge is a property of every cylinder, so none may be missing.
                assert!(*at >= EDGE, "{case:?}: {at}");
                most = most.max(peak / mean(cylinder, |distance| distance < MIDDLE));
            }
            assert_reads(most, written);
        }
    }
}

#[test]
fn the_largest_pressure_of_all_is_at_the_edge_of_the_central_element_in_2a_2b_and_2c() {
    for (case, found) in [
        (PaperCase::Fig2a, ["0.998", "0.999", "1.00"]),
        (PaperCase::Fig2b, ["0.998", "0.999", "1.00"]),
        (PaperCase::Fig2c, ["0.999", "0.998", "1.00"]),
    ] {
        for (elements, written) in [512, 1024, 2048].into_iter().zip(found) {
            let (radii, central) = largest(case, elements);
            assert_reads(radii, written);
            assert!(central, "{case:?}, N = {elements}");
        }
    }
}

#[test]
fn whether_the_largest_pressure_of_2d_is_at_the_central_element_depends_on_the_grid() {
    for (elements, written, wanted) in [
        (512, "6.07", false),
        (1024, "6.54", false),
        (2048, "1.00", true),
    ] {
        let (radii, central) = largest(PaperCase::Fig2d, elements);
        assert_reads(radii, written);
        assert_eq!(central, wanted, "N = {elements}");
    }
}

#[test]
fn with_whole_periods_of_elements_the_largest_pressure_of_2d_is_at_the_central_element() {
    for (elements, written) in [(264, "0.969"), (528, "0.997"), (1056, "0.999")] {
        let (radii, central) = largest(PaperCase::WholePeriods, elements);
        assert_reads(radii, written);
        assert!(central, "N = {elements}");
    }
}

#[test]
fn the_mean_pressure_along_the_edge_is_largest_at_the_central_element_of_2d() {
    for (elements, pressure, excess) in [(512, "0.0127", "3.27 %"), (1024, "0.0131", "2.82 %")] {
        let mut loaded = cylinders(PaperCase::Fig2d, elements);
        let at_edge = |cylinder: &Vec<(f64, f64)>| mean(cylinder, |distance| distance >= EDGE);
        let central = at_edge(&loaded.remove(&[0, 0]).expect("a central cylinder"));
        let others = loaded.values().map(at_edge).fold(0.0, f64::max);
        assert_reads(central, pressure);
        assert_reads(1.0 - others / central, excess);
        assert!(others < central);
    }
}
