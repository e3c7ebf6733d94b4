//! The set and the pressures of a start, on fields whose interpolation is known.

use super::*;

const COARSE: usize = 8;
const FINE: usize = 16;

/// Fields of a grid by row and column, in its own elements.
fn field<T>(size: usize, of: impl Fn([usize; 2]) -> T) -> Vec<T> {
    (0..size * size).map(|e| of([e / size, e % size])).collect()
}

/// A solution with this pressure and displacement under a penetration of 1, and this outline.
fn coarser(
    pressure: impl Fn([usize; 2]) -> f64,
    displacement: impl Fn([usize; 2]) -> f64,
    outline: impl Fn([usize; 2]) -> bool,
) -> CoarserSolution {
    CoarserSolution {
        region: Region::whole(COARSE),
        pressure: field(COARSE, pressure),
        displacement: field(COARSE, displacement),
        penetration: 1.0,
        outline: Arc::new(field(COARSE, outline)),
    }
}

fn start(from: &CoarserSolution, gap: f64, outline: impl Fn([usize; 2]) -> bool) -> Vec<f64> {
    let fine = FineGrid {
        initial_gap: &vec![gap; FINE * FINE],
        outline: &field(FINE, outline),
        rough: None,
    };
    from.start_on(&Region::whole(FINE), &fine)
}

/// The sum over the fine elements of a coarse one.
fn together(start: &[f64], [i, j]: [usize; 2]) -> f64 {
    let of = |a: usize, b: usize| start[(2 * i + a) * FINE + 2 * j + b];
    of(0, 0) + of(0, 1) + of(1, 0) + of(1, 1)
}

fn bump([i, j]: [usize; 2]) -> f64 {
    let [x, y] = [i, j].map(|i| i as f64 - 3.2);
    (9.0 - x * x - y * y).max(0.0)
}

#[test]
fn a_coarse_element_keeps_its_force() {
    let from = coarser(bump, |_| 0.0, |_| false);
    let found = start(&from, 0.5, |_| false);
    for e in 0..COARSE * COARSE {
        let place = [e / COARSE, e % COARSE];
        if from.pressure[e] > 0.0 {
            let error = together(&found, place) / 4.0 - from.pressure[e];
            assert!(error.abs() < 1e-14, "{place:?}: {error}");
        }
    }
    // Overlapping elements beside the contact press a little, those too far away do not.
    let highest = from.pressure.iter().copied().fold(0.0, f64::max);
    assert_eq!(found[FINE * FINE - 1], SMALLEST_PRESSURE * highest);
    assert_eq!(start(&from, 1.0, |_| false), vec![0.0; FINE * FINE]);
}

#[test]
fn elements_that_overlap_or_lie_within_the_contact_are_pressed() {
    // u = 0.1 times the coarse row, which a cubic reproduces: overlap where u < 0.4 with a gap of 0.6.
    let corner = |[i, j]: [usize; 2]| f64::from(u8::from(i >= 6 && j >= 6));
    let from = coarser(corner, |[i, _]| 0.1 * i as f64, |_| false);
    let found = start(&from, 0.6, |_| false);
    for (e, p) in found.iter().enumerate() {
        let [i, j] = [e / FINE, e % FINE];
        // Beyond the outermost centres, the outermost lines are repeated.
        let row = (i as f64 / 2.0 - 0.25).max(0.0);
        let is_within = [i, j].iter().all(|i| *i >= 13);
        assert_eq!(*p > 0.0, row < 4.0 || is_within, "{i} {j}: {p}");
    }
}

#[test]
fn no_pressure_crosses_an_outline() {
    // The relief's outline runs through the middle of the coarse column 3, which is on the relief.
    let pressure = |[_, j]: [usize; 2]| if j < 4 { 2.0 } else { 1.0 };
    let from = coarser(pressure, |_| 0.0, |[_, j]| j < 4);
    let found = start(&from, 0.5, |[_, j]| j < 7);
    for (e, p) in found.iter().enumerate() {
        let j = e % FINE;
        if j < 6 {
            assert!((p - 2.0).abs() < 1e-14, "{j}: {p}");
        } else if j > 7 {
            assert!((p - 1.0).abs() < 1e-14, "{j}: {p}");
        }
    }
    // Two of its elements are on its side.
    assert!((together(&found, [4, 3]) - 2.0 * 2.0).abs() < 1e-14);
}

#[test]
fn on_a_rough_surface_gaps_smaller_than_their_error_belong_to_the_contact() {
    // Coarse columns 0 to 3 press: fine columns up to 6 lie within, 7 and 8 have shares of 3/4 and 1/4 around them.
    // The last column's displacement only widens the search.
    let pressure = |[_, j]: [usize; 2]| if j < 4 { 2.0 } else { 0.0 };
    let from = coarser(
        pressure,
        |[_, j]| if j == 7 { -1.0 } else { 0.0 },
        |_| false,
    );
    let gap = |[i, j]: [usize; 2]| match (j, i % 4) {
        (..7, _) if (i / 8 + j) % 2 == 0 => 0.2,
        (..7, _) => -0.2,
        (7, step) => [0.07, 0.08, 0.14, 0.16][step],
        (8, step) => [0.02, 0.03, 0.04, 0.06][step],
        _ => 0.5,
    };
    let start = |rough: Option<RoughSurface<'_>>| {
        let fine = FineGrid {
            initial_gap: &field(FINE, |place| 1.0 + gap(place)),
            outline: &field(FINE, |_| false),
            rough,
        };
        from.start_on(&Region::whole(FINE), &fine)
    };
    let with_springs = |eta: f64| {
        let relief_compliance = [eta; FINE * FINE];
        start(Some(RoughSurface {
            relief_compliance: &relief_compliance,
            spring_law: SpringLaw::LINEAR,
            shortest_compliance: 0.05,
            hardness: f64::INFINITY,
        }))
    };
    // The springs' 0.1 makes errors of 0.3 and 0.1 of the gaps, of which they take half.
    for (found, error) in [
        (start(None), 0.0),
        (with_springs(0.0), 0.2),
        (with_springs(0.05), 0.1),
    ] {
        for (e, p) in found.iter().enumerate() {
            let place = [e / FINE, e % FINE];
            let share = match place[1] {
                ..7 => f64::INFINITY,
                7 => 0.75,
                8 => 0.25,
                9..12 => 0.0,
                _ => continue,
            };
            let belongs = share.is_infinite() || gap(place) < share * error;
            assert_eq!(*p > 0.0, belongs, "{error} {place:?}: {p}");
        }
    }
}
