//! Regions: their content and growth, and fields moved between them.

use std::collections::BTreeSet;

use super::{ELEMENTS_PER_THREAD, Region};
use pellicle_influence::{Sector, SectorGrid};

/// A region of a grid of 20 × 20 elements.
fn region(origin: [usize; 2], size: usize) -> Region {
    Region {
        origin,
        size,
        ..Region::whole(20)
    }
}

#[test]
fn a_region_contains_the_members_with_a_margin() {
    let belongs = |[i, j]: [usize; 2]| i / 10 == 7 && j / 20 == 9;
    let region = Region::whole(200).around(belongs);
    let mask: Vec<f64> = (0..200 * 200)
        .map(|e| f64::from(u8::from(belongs([e / 200, e % 200]))))
        .collect();
    let part = region.cut(&mask);
    assert!(region.size() < 40 && !region.is_whole());
    assert_eq!(region.scatter(part.clone()), mask);
    // The elements touch the region's border only at the grid's end along y.
    let last = region.size() - 1;
    let border =
        |e: &usize| [0, last].contains(&(e / region.size())) || e.is_multiple_of(region.size());
    assert!((0..part.len()).filter(border).all(|e| part[e] == 0.0));
}

#[test]
fn a_quadrant_region_begins_at_the_axes_and_unfolds_to_four_images() {
    let quadrant = SectorGrid::new(Sector::Quadrant, 100);
    let everywhere = Region::all_of(quadrant);
    let region = everywhere.around(|[i, j]| i == 20 && j == 7);
    assert!(region.origin() == [0, 0] && (24..=27).contains(&region.size()));
    assert_eq!(region.grown().origin(), [0, 0]);
    assert!(
        region
            .on_finer(|[i, j]| i == 3 && j == 2, 200)
            .unwrap()
            .size()
            == 10
    );
    let size = region.size();
    let part: Vec<f64> = (0..size * size).map(|e| 1.0 + e as f64).collect();
    let whole = region.scatter(part.clone());
    for (e, found) in whole.iter().enumerate() {
        let [i, j] = [e / 200, e % 200].map(|i| if i < 100 { 99 - i } else { i - 100 });
        let expected = region.place([i, j]).map_or(0.0, |place| part[place]);
        assert_eq!(*found, expected);
    }
    assert_eq!(region.cut(&quadrant.cut(&whole)), part);
}

#[test]
fn a_half_region_begins_at_its_axis_and_unfolds_to_two_images() {
    let half = SectorGrid::new(Sector::Half, 100);
    let everywhere = Region::all_of(half);
    let region = everywhere.around(|[i, j]| (150..161).contains(&i) && j == 7);
    let [above, left] = region.origin();
    let [rows, columns] = region.lengths();
    // Eight columns and three more; the rows of the same square, around the elements that belong.
    assert!(left == 0 && (11..=12).contains(&columns) && rows == 2 * columns);
    assert!(above.abs_diff(150 - (rows - 11) / 2) <= 1);
    assert_eq!(region.grown().origin()[1], 0);
    let part: Vec<f64> = (0..region.elements()).map(|e| 1.0 + e as f64).collect();
    let whole = region.scatter(part.clone());
    for (e, found) in whole.iter().enumerate() {
        let (i, j) = (e / 200, e % 200);
        let j = if j < 100 { 99 - j } else { j - 100 };
        let expected = region.place([i, j]).map_or(0.0, |place| part[place]);
        assert_eq!(*found, expected);
    }
    assert_eq!(region.cut(&half.cut(&whole)), part);
    let last = columns - 1;
    let is_border = |e: &usize| [0, rows - 1].contains(&(e / columns)) || e % columns == last;
    let border: BTreeSet<usize> = region.border().collect();
    assert!(
        border
            .into_iter()
            .eq((0..region.elements()).filter(is_border))
    );
    let finer = region.on_finer(|_| true, 200).unwrap();
    assert_eq!(
        (finer.origin(), finer.lengths()),
        ([2 * above - 2, 0], [2 * rows + 4, 2 * columns + 2])
    );
}

#[test]
fn a_region_grows_until_it_is_the_whole_grid() {
    let mut region = Region::whole(500).around(|place| place == [250, 3]);
    for _ in 0..8 {
        region = region.grown();
    }
    assert_eq!(region, Region::whole(500));
    assert!(Region::whole(500).around(|_| false).is_whole());
}

#[test]
fn a_field_moves_between_regions_and_is_zero_outside_the_old_one() {
    let field: Vec<f64> = (0..400).map(|e| 1.0 + f64::from(e)).collect();
    let (one, other) = (region([2, 5], 9), region([7, 1], 8));
    let moved = other.take_over(&one, &one.cut(&field));
    for i in 0..20 {
        for j in 0..20 {
            let inside = (2..11).contains(&i) && (5..14).contains(&j);
            let wanted = if inside { field[i * 20 + j] } else { 0.0 };
            if let Some(place) = other.place([i, j]) {
                assert_eq!(moved[place], wanted, "{i} {j}");
            }
            let inside = (7..15).contains(&i) && (1..9).contains(&j);
            assert_eq!(other.place([i, j]).is_some(), inside);
        }
    }
    assert_eq!(other.line(&field, 3), &field[10 * 20 + 1..][..8]);
    // Regions without common elements.
    let apart = region([15, 15], 4).take_over(&one, &one.cut(&field));
    assert!(apart.iter().all(|value| *value == 0.0));
}

#[test]
fn a_rim_extends_as_far_as_the_grid() {
    assert_eq!(region([5, 6], 4).with_rim(2), region([3, 4], 8));
    assert_eq!(region([0, 15], 4).with_rim(2), region([0, 12], 8));
    assert_eq!(region([1, 2], 17).with_rim(2), Region::whole(20));
}

#[test]
fn on_a_finer_grid_a_region_extends_as_far_as_interpolation() {
    let belongs = |[i, j]: [usize; 2]| (4..7).contains(&i) && j == 9;
    for finer in [20, 33, 40] {
        let reach = Region::whole(20).on_finer(belongs, finer).unwrap();
        for i in 0..finer {
            for j in 0..finer {
                // A centre between those of two coarse elements is near both.
                let near = |i: usize, first: f64, last: f64| {
                    let place = (i as f64 + 0.5) * 20.0 / finer as f64 - 0.5;
                    place > first - 1.0 && place < last + 1.0
                };
                if near(i, 4.0, 6.0) && near(j, 9.0, 9.0) {
                    assert!(reach.place([i, j]).is_some(), "{finer}: {i} {j}");
                }
            }
        }
        assert!(reach.size() <= (7 * finer).div_ceil(20));
    }
    assert!(Region::whole(20).on_finer(|_| false, 40).is_none());
}

#[test]
fn many_loads_share_regions_of_few_sizes() {
    let mut sizes = BTreeSet::new();
    for half in 20..150 {
        let inside = |i: usize| i.abs_diff(250) < half;
        let belongs = |place: [usize; 2]| place.into_iter().all(inside);
        let size = Region::whole(500).around(belongs).size();
        // Apart from the margins, a region exceeds the contact by less than a quarter.
        assert!(size > 2 * half && 4 * size <= 5 * (2 * half + 2 * half / 12 + 8));
        sizes.insert(size);
    }
    assert!(sizes.len() <= 25, "{sizes:?}");
}

#[test]
fn the_region_around_pressed_elements_has_a_margin_and_is_none_without_pressure() {
    let whole = Region::whole(200);
    let mut pressure = vec![0.0; whole.elements()];
    assert!(whole.around_pressing(&pressure).is_none());
    pressure[70 * 200 + 90] = 1.0;
    let region = whole.around_pressing(&pressure).unwrap();
    assert!((7..=12).contains(&region.size()), "{}", region.size());
    assert!(
        [67, 73]
            .into_iter()
            .all(|i| region.place([i, i + 20]).is_some())
    );
    let part = region.cut(&pressure);
    assert!(region.presses(&part, [70, 90]));
    // An element that does not press, and one outside the region.
    assert!(!region.presses(&part, [71, 90]) && !region.presses(&part, [0, 0]));
}

#[test]
fn the_rows_per_thread_just_exceed_the_fewest_elements_worth_a_thread() {
    for size in [1, 100, 5000, 4 * ELEMENTS_PER_THREAD] {
        let rows = Region::whole(size).rows_per_thread();
        assert!(rows * size > ELEMENTS_PER_THREAD && (rows - 1) * size <= ELEMENTS_PER_THREAD);
    }
}

#[test]
fn an_index_on_the_whole_grid_counts_from_the_axes_of_a_sector() {
    // A sector of a grid of 20 × 20 elements begins at element 10 along each mirrored direction.
    for (sector, grid, axes) in [
        (Sector::Whole, 20, [0, 0]),
        (Sector::Half, 10, [0, 10]),
        (Sector::Quadrant, 10, [10, 10]),
    ] {
        let region = Region {
            origin: [2, 3],
            size: 5,
            ..Region::all_of(SectorGrid::new(sector, grid))
        };
        for place in [[0, 0], [4, 1], [-1, 2], [1, -6]] {
            let wanted = [axes[0] + 2 + place[0], axes[1] + 3 + place[1]];
            assert_eq!(region.index_on_whole(place), wanted, "{sector:?}");
        }
    }
}

#[test]
fn a_cell_across_an_axis_is_shared_equally_between_the_sectors_it_joins() {
    for sector in [Sector::Whole, Sector::Half, Sector::Quadrant] {
        let grid = SectorGrid::new(sector, 10);
        let region = Region::all_of(grid);
        let [x, y] = grid.mirrored();
        let half = |is_mirrored: bool| if is_mirrored { 0.5 } else { 1.0 };
        let shares =
            [[3, 4], [-1, 4], [3, -1], [-1, -1], [0, 0]].map(|at| region.share_of_cell(at));
        let wanted = [1.0, half(x), half(y), half(x) * half(y), 1.0];
        assert_eq!(shares, wanted, "{sector:?}");
        // So there are as many cells between all places as on the whole grid.
        let [rows, columns] = region.lengths().map(usize::cast_signed);
        let first = |is_mirrored: bool| if is_mirrored { -1 } else { 0 };
        let places =
            (first(x)..rows - 1).flat_map(|i| (first(y)..columns - 1).map(move |j| [i, j]));
        let cells: f64 = places.map(|place| region.share_of_cell(place)).sum();
        let lines = (grid.whole_size() - 1) as f64;
        assert_eq!(cells * grid.images() as f64, lines * lines, "{sector:?}");
    }
}

#[test]
fn beyond_an_axis_lies_the_mirror_image_and_beyond_the_grid_nothing() {
    for sector in [Sector::Whole, Sector::Half, Sector::Quadrant] {
        let grid = SectorGrid::new(sector, 10);
        let region = Region::all_of(grid);
        let size = region.size();
        let [x, y] = grid.mirrored();
        assert_eq!(region.element([-3, 4]), x.then_some(2 * size + 4));
        assert_eq!(region.element([4, -1]), y.then_some(4 * size));
        let last = region.lengths()[0] - 1;
        assert_eq!(region.element([last.cast_signed() + 1, 0]), None);
        // Every element is recovered from its first image, which comes first.
        for row in [0, 1, last] {
            for column in [0, 3, size - 1] {
                let image = region.first_image([row, column]);
                let place = region.place_of_image(image);
                assert_eq!(place, [row, column].map(usize::cast_signed), "{sector:?}");
            }
        }
    }
}

#[test]
fn the_wider_of_two_regions_is_taken_and_grows_if_it_is_the_present_one() {
    let (small, large) = (region([4, 4], 6), region([2, 3], 12));
    assert_eq!(small.wider(large), large);
    let kept = large.wider(small);
    assert!(kept.size() > large.size() || kept.is_whole());
    let same = large.wider(region([5, 5], 12));
    assert!(same.size() > large.size() || same.is_whole());
}
