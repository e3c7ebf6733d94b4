//! Islands of patterns drawn by hand.

use super::*;

/// A pattern of lines, in which # is contact.
fn pattern(lines: &[&str], repeats: bool) -> ContactPattern {
    let pressure = |letter: char| if letter == '#' { 1.0 } else { 0.0 };
    let row = |line: &&str| runs(&line.chars().map(pressure).collect::<Vec<_>>());
    ContactPattern {
        rows: lines.iter().map(row).collect(),
        size: lines[0].len(),
        repeats,
    }
}

fn sizes(lines: &[&str], repeats: bool) -> Vec<usize> {
    pattern(lines, repeats).island_sizes()
}

#[test]
fn an_island_is_connected_by_sides_and_continues_in_the_next_cell() {
    let lines = [
        "#..##", "..#..", //
        "..##.", "#....", "#.#.#",
    ];
    assert_eq!(sizes(&lines, false), [3, 2, 2, 1, 1, 1]);
    // Around the corner of the cell: the ends of the first and the last row, and the column above them.
    assert_eq!(sizes(&lines, true), [6, 3, 1]);
}

#[test]
fn elements_that_share_only_a_corner_are_not_joined() {
    assert_eq!(sizes(&["#.", ".#"], false), [1, 1]);
    assert_eq!(pattern(&["#.", ".#"], false).sides(), 8);
    // In a periodic cell the elements in contact have open ones on all sides.
    assert_eq!(sizes(&["#.", ".#"], true), [1, 1]);
}

#[test]
fn branches_that_meet_later_are_one_island() {
    let comb = ["#.#.#.#", "#.#.#.#", "#######"];
    assert_eq!(sizes(&comb, false), [15]);
    let ring = ["#####", "#...#", "#.#.#", "#...#", "#####"];
    assert_eq!(sizes(&ring, false), [16, 1]);
    let spiral = ["#####", "....#", "###.#", "#...#", "#####"];
    assert_eq!(sizes(&spiral, false), [17]);
}

#[test]
fn sides_are_counted_once() {
    for (lines, within, of_cell) in [
        (&["....", ".##.", "....", "...."][..], 6, 6),
        (&["#..#", "....", "....", "...."], 8, 6),
        (&["##", "##"], 8, 0),
        (&["##..", "##..", "##..", "##.."], 12, 8),
        (&["####", "....", "....", "...."], 10, 8),
        (&["..", ".."], 0, 0),
        (&["#"], 4, 4),
    ] {
        assert_eq!(pattern(lines, false).sides(), within, "{lines:?}");
        if lines.len() > 1 {
            assert_eq!(pattern(lines, true).sides(), of_cell, "{lines:?}");
        }
    }
}

/// Sizes and sides found by flooding, one element at a time.
fn by_flooding(lines: &[String], repeats: bool) -> (Vec<usize>, usize) {
    let n = lines.len().cast_signed();
    let is_contact = |[i, j]: [isize; 2]| {
        let at = if repeats {
            [i, j].map(|x| x.rem_euclid(n))
        } else {
            [i, j]
        };
        let inside = at.iter().all(|x| (0..n).contains(x));
        inside && lines[at[0].cast_unsigned()].as_bytes()[at[1].cast_unsigned()] == b'#'
    };
    let around = |[i, j]: [isize; 2]| [[i - 1, j], [i + 1, j], [i, j - 1], [i, j + 1]];
    let all = (0..n).flat_map(|i| (0..n).map(move |j| [i, j]));
    let all: Vec<_> = all.filter(|at| is_contact(*at)).collect();
    let sides = all.iter().flat_map(|at| around(*at));
    let sides = sides.filter(|at| !is_contact(*at)).count();
    let mut left: std::collections::BTreeSet<_> = all.into_iter().collect();
    let mut sizes = Vec::new();
    while let Some(seed) = left.pop_first() {
        let (mut size, mut open) = (0, vec![seed]);
        while let Some(at) = open.pop() {
            size += 1;
            let next = around(at).map(|at| {
                if repeats {
                    at.map(|x| x.rem_euclid(n))
                } else {
                    at
                }
            });
            open.extend(next.into_iter().filter(|at| left.remove(at)));
        }
        sizes.push(size);
    }
    sizes.sort_unstable_by(|one, other| other.cmp(one));
    (sizes, sides)
}

#[test]
fn islands_and_sides_of_random_patterns_agree_with_a_flood_fill() {
    let mut state = 7_u64;
    let mut random = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 40) % 100
    };
    for (size, share) in [(3, 50), (8, 30), (13, 59), (30, 40), (30, 59), (30, 75)] {
        for _ in 0..20 {
            let line = |_| {
                (0..size)
                    .map(|_| if random() < share { '#' } else { '.' })
                    .collect()
            };
            let lines: Vec<String> = (0..size).map(line).collect();
            let rows: Vec<&str> = lines.iter().map(|line| &line[..]).collect();
            for repeats in [false, true] {
                let pattern = pattern(&rows, repeats);
                let found = (pattern.island_sizes(), pattern.sides());
                assert_eq!(found, by_flooding(&lines, repeats), "{lines:#?} {repeats}");
            }
        }
    }
}

#[test]
fn islands_are_counted_by_their_size() {
    let wanted = Islands {
        count: 7,
        largest_area: 18.0,
        mean_area: 25.0 / 7.0 * 2.0,
        counts_by_octave: vec![3, 2, 0, 2],
    };
    assert_eq!(Islands::of(&[9, 8, 3, 2, 1, 1, 1], 2.0), wanted);
    assert_eq!(Islands::of(&[], 2.0), Islands::default());
}
