//! Maps whose points scatter, whose heads name units or none, whose holes are numbers, whose sides are exchanged: read
//! as the surface that was written, or refused.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use pellicle::Case;
use pellicle::input::span::Source;

const CASE: &str = r#"
[foundation]
substrate = { young_modulus = "70 GPa", poisson_ratio = 0.2 }
[surface]
kind = "rough"
file = "FILE"
KEYS
[indenter]
kind = "paraboloid"
radius = "20 um"
[load]
force = "50 uN"
[grid]
elements = 64
side = "1 um"
"#;

/// Points along x and along y, and their spacing, um.
const SHAPE: [usize; 2] = [14, 10];
const SPACING: f64 = 0.094;

/// The height of the surface at point (i, j), nm.
fn height([i, j]: [usize; 2]) -> f64 {
    3.0 * (0.7 * i as f64).sin() + 2.0 * (0.9 * j as f64 + 1.0).cos()
}

/// Points in an order that is not sorted, each up to so many spacings off its place.
fn points(off: f64) -> Vec<[f64; 3]> {
    let all = SHAPE[0] * SHAPE[1];
    let point = |n: usize| {
        let n = n * 33 % all;
        let at = [n / SHAPE[1], n % SHAPE[1]];
        let to = [n * 37 % 101, n * 53 % 97].map(|k| k as f64 / 50.0 - 1.0);
        let [x, y] = [0, 1].map(|axis| SPACING * (at[axis] as f64 + 0.5 + off * to[axis]));
        [x, y, height(at)]
    };
    (0..all).map(point).collect()
}

/// Points as lines of text, heights multiplied.
fn lines(points: &[[f64; 3]], times: f64) -> String {
    let line = |[x, y, z]: &[f64; 3]| format!("{x:.5} {y:.5} {:.13}\n", z * times);
    points.iter().map(line).collect()
}

/// The surface as rows of text from the largest y down, some heights replaced.
fn rows(hole: impl Fn([usize; 2]) -> Option<f64>) -> String {
    let row = |j: usize| {
        let at = |i: usize| hole([i, j]).unwrap_or(height([i, j]));
        let row: Vec<_> = (0..SHAPE[0]).map(|i| format!("{:.9}", at(i))).collect();
        row.join(" ") + "\n"
    };
    (0..SHAPE[1]).rev().map(row).collect()
}

/// The case of such a file with these keys.
fn case(name: &str, bytes: &[u8], keys: &str) -> Result<Case, String> {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join(name), bytes).expect("a file");
    let text = CASE.replace("FILE", name).replace("KEYS", keys);
    read(text, folder.path())
}

fn read(text: String, folder: &Path) -> Result<Case, String> {
    let source = Arc::new(Source::new("case.toml", text));
    Case::parse(&source, "case", folder, &[]).map_err(|told| told.to_string())
}

/// The codes of the warnings on a domain of 1 um.
fn codes(case: &Case) -> Vec<&'static str> {
    let warnings = case.warnings(1e-6);
    warnings.iter().map(|warning| warning.code).collect()
}

/// Asserts that a map has the heights of the surface, on pixels of this side, m.
#[track_caller]
fn assert_surface(case: &Case, spacing: f64) {
    let map = case.surface.map().expect("a map");
    assert_eq!(map.shape(), SHAPE);
    for (side, samples) in map.sides.into_iter().zip(SHAPE) {
        let pixel = side / samples as f64;
        // Scatter of a tenth over ten lines of ten points.
        assert!((pixel / spacing - 1.0).abs() < 2e-3, "{pixel}");
    }
    for (n, sample) in map.samples().iter().enumerate() {
        let wanted = height([n / SHAPE[1], n % SHAPE[1]]) * 1e-9;
        assert!((sample - wanted).abs() < 1e-17, "{n}: {sample}, {wanted}");
    }
}

const UNITS: &str = "height_unit = \"nm\"\nlateral_unit = \"um\"";

#[test]
fn scattered_points_are_the_map_of_their_grid_or_refused_but_no_strip() {
    for (off, told) in [(0.0, false), (0.02, true), (0.08, true)] {
        let text = lines(&points(off), 1.0);
        let case = case("m.txt", text.as_bytes(), UNITS).unwrap();
        assert_surface(&case, 94e-9);
        assert_eq!(codes(&case).contains(&"points-off-grid"), told, "{off}");
    }
    for off in [0.2, 0.5] {
        for count in [140, 20, 9] {
            let text = lines(&points(off)[..count], 1.0);
            let keys = "height_unit = \"nm\"\nside = \"6 um\"";
            let refused = case("m.txt", text.as_bytes(), keys).unwrap_err();
            assert!(
                refused.contains(&format!("{count} points x, y, z")),
                "{refused}"
            );
            assert!(refused.contains("\"ncols 3\""), "{refused}");
        }
    }
    let named = format!("x y z\n{}", lines(&points(0.5)[..5], 1.0));
    let refused = case("m.txt", named.as_bytes(), UNITS).unwrap_err();
    assert!(refused.contains("5 points x, y, z"), "{refused}");
}

#[test]
fn depths_taken_as_heights_are_told_and_a_factor_of_the_heights_is_refused() {
    let points = lines(&points(0.0), 1.0);
    for (name, unit, told) in [
        ("Depth", "1 nm", true),
        ("Depth", "-1 nm", false),
        ("Height", "1 nm", false),
    ] {
        let text = format!("X (um)\tY (um)\t{name} (nm)\n{points}");
        let keys = format!("height_unit = \"{unit}\"");
        let case = case("m.txt", text.as_bytes(), &keys).unwrap();
        assert_eq!(
            codes(&case).contains(&"map-of-depths"),
            told,
            "{name} {unit}"
        );
    }
    let keys = "height_unit = \"nm\"\nside = \"6 um\"";
    let heights = rows(|_| None);
    let of = |head: &str| case("m.txt", format!("{head}\n{heights}").as_bytes(), keys);
    assert!(of("Scale factor: 1").is_ok() && of("Z scale: 100 nm").is_ok());
    let refused = of("# Scale factor: 0.5").unwrap_err();
    assert!(refused.contains("heights multiplied by it"), "{refused}");
}

#[test]
fn three_columns_of_heights_are_said_to_be_such() {
    let strip = lines(&points(0.5), 1.0);
    let case = case(
        "m.txt",
        format!("ncols 3\n{strip}").as_bytes(),
        "height_unit = \"nm\"\nside = \"6 um\"",
    );
    let shape = case.map(|case| case.surface.map().expect("a map").shape());
    assert_eq!(shape, Ok([3, 140]));
}

#[test]
fn an_array_of_scattered_points_is_refused_as_its_text_is() {
    let array = |off: f64| {
        let numbers = points(off)
            .as_flattened()
            .iter()
            .flat_map(|x| x.to_le_bytes())
            .collect::<Vec<_>>();
        npy("(140, 3)", &numbers)
    };
    assert_surface(&case("m.npy", &array(0.05), UNITS).unwrap(), 94e-9);
    let refused = case("m.npy", &array(0.4), UNITS).unwrap_err();
    assert!(refused.contains("140 points x, y, z"), "{refused}");
    assert!(refused.contains("transposed"), "{refused}");
}

fn npy(shape: &str, data: &[u8]) -> Vec<u8> {
    let header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}\n");
    let length = u16::try_from(header.len()).expect("a short header");
    let head = b"\x93NUMPY\x01\x00"
        .iter()
        .copied()
        .chain(length.to_le_bytes());
    head.chain(header.bytes())
        .chain(data.iter().copied())
        .collect()
}

#[test]
fn units_in_the_names_of_columns_are_those_of_the_points() {
    let file = |head: &str, times: f64| format!("{head}\n{}", lines(&points(0.0), times));
    for (head, times) in [
        ("x[um] y[um] z[um]", 1e-3),
        ("x[um] y[um] z[nm]", 1.0),
        ("X (\u{b5}m), Y (\u{b5}m), Height (nm)", 1.0),
        ("# x y z in um", 1e-3),
        ("x/um;y/um;z/pm", 1e3),
    ] {
        let found = case("m.txt", file(head, times).as_bytes(), "");
        assert_surface(&found.unwrap(), 94e-9);
    }
    let named = file("x[um] y[um] z[nm]", 1.0);
    let agree = case("m.txt", named.as_bytes(), UNITS);
    assert_surface(&agree.unwrap(), 94e-9);
    for (keys, words) in [
        ("lateral_unit = \"nm\"", "key `surface.lateral_unit`"),
        ("height_unit = \"um\"", "key `surface.height_unit`"),
        ("side = \"6 um\"", "key `surface.side`"),
    ] {
        let refused = case("m.txt", named.as_bytes(), keys).unwrap_err();
        assert!(
            refused.contains(words) && refused.contains("contradicts"),
            "{refused}"
        );
    }
    let volts = file("x[um] y[um] z[V]", 1.0);
    let refused = case("m.txt", volts.as_bytes(), "").unwrap_err();
    assert!(refused.contains("height unit \"V\""), "{refused}");
    assert_surface(
        &case("m.txt", volts.as_bytes(), "height_unit = \"nm\"").unwrap(),
        94e-9,
    );
}

#[test]
fn a_size_without_a_unit_has_that_of_its_key_or_the_scale_of_a_side() {
    let file = |cell: &str| format!("ncols 14\nnrows 10\ncellsize {cell}\n{}", rows(|_| None));
    let nm = "height_unit = \"nm\"\n";
    for (cell, key) in [
        ("0.094", "lateral_unit = \"um\""),
        ("94", "lateral_unit = \"nm\""),
        ("94", "side = \"1.316 um\""),
        ("1", "sides = [\"1.316 um\", \"0.94 um\"]"),
        ("94e-9", ""),
    ] {
        let found = case("m.asc", file(cell).as_bytes(), &format!("{nm}{key}")).unwrap();
        assert_surface(&found, 94e-9);
        assert!(!codes(&found).contains(&"map-in-metres"), "{cell}, {key}");
    }
    for cell in ["94", "0.094", "9.4e-5"] {
        let found = case("m.asc", file(cell).as_bytes(), nm).unwrap();
        let codes = codes(&found);
        assert!(
            codes.contains(&"map-in-metres") && !codes.contains(&"flat-map"),
            "{codes:?}"
        );
    }
    // On a domain as large as the map, with heights that are not flat beside it.
    let found = case("m.asc", file("0.094").as_bytes(), "height_unit = \"mm\"\n").unwrap();
    let mut warnings = found.warnings(1.316).into_iter();
    assert!(warnings.any(|warning| warning.code == "map-in-metres"));
    // A size that the case gives a unit is one that a side may contradict.
    let twice = format!("{nm}lateral_unit = \"um\"\nside = \"6 um\"");
    let refused = case("m.asc", file("0.094").as_bytes(), &twice).unwrap_err();
    assert!(refused.contains("contradicts the size 1.316"), "{refused}");
    // No size, and nothing that the unit could be of.
    let keys = format!("{nm}lateral_unit = \"um\"\nside = 6");
    let refused = case("m.txt", rows(|_| None).as_bytes(), &keys).unwrap_err();
    assert!(refused.contains("key `surface.lateral_unit`"), "{refused}");
}

#[test]
fn numbers_for_missing_heights_are_holes_in_every_format() {
    const SIDE: &str = "height_unit = \"nm\"\nside = \"1.316 um\"\n";
    let is_hole = |[i, j]: [usize; 2]| (i == 4 && (2..5).contains(&j)) || [i, j] == [9, 7];
    for code in [-9999.0, -32768.0, 1e30, -999.0, 7777.0] {
        let hole = |at| is_hole(at).then_some(code);
        let text = rows(hole).into_bytes();
        let numbers = (0..140).flat_map(|n: usize| {
            let at = [n / 10, n % 10];
            hole(at).unwrap_or(height(at)).to_le_bytes()
        });
        let array = npy("(14, 10)", &numbers.collect::<Vec<_>>());
        for (name, bytes) in [("m.txt", &text), ("m.npy", &array)] {
            for unit in ["nm", "pm"] {
                let side = SIDE.replace("\"nm\"", &format!("\"{unit}\""));
                let refused = case(name, bytes, &side).unwrap_err();
                assert!(refused.contains("of whose 140 heights 4 are"), "{refused}");
                assert!(refused.contains("holes = \"interpolate\""), "{refused}");
                assert!(!refused.contains("height_unit"), "{refused}");
            }
            let found = case(name, bytes, &format!("{SIDE}holes = \"interpolate\"")).unwrap();
            let map = found.surface.map().expect("a map");
            assert_eq!(
                (map.missing, codes(&found).contains(&"map-holes")),
                (4, true)
            );
            for (n, sample) in map.samples().iter().enumerate() {
                let at = [n / 10, n % 10];
                let wanted = height(at) * 1e-9;
                // Half of the surface's range, which is 9 nm, in a hole.
                let near = if is_hole(at) { 5e-9 } else { 1e-17 };
                assert!((sample - wanted).abs() < near, "{at:?}: {sample}, {wanted}");
            }
        }
    }
}

#[test]
fn what_may_be_holes_is_told_and_what_are_heights_is_kept() {
    const SIDE: &str = "height_unit = \"nm\"\nside = \"1.316 um\"\n";
    let zeros = |at: [usize; 2]| {
        Some(if at[0] == 3 && at[1] < 5 {
            0.0
        } else {
            40.0 + height(at)
        })
    };
    let found = case("m.txt", rows(zeros).as_bytes(), SIDE).unwrap();
    assert!(codes(&found).contains(&"map-perhaps-holes"));
    let said = case(
        "m.txt",
        rows(zeros).as_bytes(),
        &format!("{SIDE}holes = \"none\""),
    )
    .unwrap();
    assert!(!codes(&said).contains(&"map-perhaps-holes"));
    let pit = |[i, j]: [usize; 2]| (i == 4 && j < 4).then_some(-999.0);
    let keys = SIDE.replace("\"nm\"", "\"0.1 nm\"") + "holes = \"none\"";
    let kept = case("m.txt", rows(pit).as_bytes(), &keys).unwrap();
    let lowest = kept.surface.map().expect("a map").own().lowest();
    assert!((lowest + 99.9e-9).abs() < 1e-18, "{lowest}");
    // Ground between pillars.
    let pillars = |[i, j]: [usize; 2]| Some(if (i / 3 + j / 3) % 2 == 0 { 30.0 } else { 0.0 });
    let found = case("m.txt", rows(pillars).as_bytes(), SIDE).unwrap();
    assert!(!codes(&found).contains(&"map-perhaps-holes"));
}

#[test]
fn exchanged_sides_are_told_and_oblong_pixels_are_not() {
    let told = |sides: &str| {
        let keys = format!("height_unit = \"nm\"\nsides = {sides}");
        let found = case("m.txt", rows(|_| None).as_bytes(), &keys).unwrap();
        let warnings = found.warnings(1e-6).into_iter();
        warnings
            .filter(|warning| warning.code == "oblong-pixels")
            .map(|warning| warning.message)
            .next()
    };
    let exchanged = told("[\"0.94 um\", \"1.316 um\"]").expect("a warning");
    let words = "14 samples on 940.00 nm along x and 10 on 1.3160 µm along y";
    assert!(exchanged.contains(words), "{exchanged}");
    for right in [
        "[\"1.316 um\", \"0.94 um\"]",
        // Fewer lines than samples on a line.
        "[\"1.316 um\", \"2.82 um\"]",
        "[\"1 um\", \"1 um\"]",
    ] {
        assert_eq!(told(right), None);
    }
}

#[test]
fn lines_that_are_missing_by_the_size_in_the_head_are_told() {
    let with_head =
        |height: &str| format!("Width: 1.4 um\nHeight: {height} um\n{}", rows(|_| None));
    let told = |height: &str| {
        let text = with_head(height);
        let found = case("m.txt", text.as_bytes(), "height_unit = \"nm\"").unwrap();
        let warnings = found.warnings(1e-6).into_iter();
        let oblong: Vec<_> = warnings.filter(|of| of.code == "oblong-pixels").collect();
        oblong.first().map(|warning| warning.message.clone())
    };
    assert_eq!(told("1.0"), None);
    let message = told("1.7").expect("a warning");
    assert!(message.contains("are lines missing?"), "{message}");
}
