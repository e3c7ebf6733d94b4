//! Height maps in `.npy`, `.csv` and `.gsf` as indenter and as surface.

use std::fs;

use ndarray::Array2;
use ndarray_npy::WriteNpyExt;
use serde_json::Value;

use super::runner::{CASE, ProgramOutput, TestFolder};

/// Samples of the map along x and y, and its sides.
const SHAPE: [usize; 2] = [40, 30];
const SIDES: [f64; 2] = [600e-9, 450e-9];

/// A paraboloid of radius 4 µm with a bump at positive x and y, in m.
fn height(i: usize, j: usize) -> f64 {
    let at = |axis: usize, i: usize| ((i as f64 + 0.5) / SHAPE[axis] as f64 - 0.5) * SIDES[axis];
    let (x, y) = (at(0, i), at(1, j));
    let bump = if x > 50e-9 && y > 20e-9 { 0.6e-9 } else { 0.0 };
    (x * x + y * y) / 8e-6 - bump
}

/// A folder with the case and the same map in three formats: metres, nanometres, micrometres.
fn folder() -> TestFolder {
    let folder = TestFolder::with_case(CASE);
    let map = Array2::from_shape_fn(SHAPE, |(i, j)| height(i, j));
    map.write_npy(fs::File::create(folder.path("tip.npy")).unwrap())
        .unwrap();
    let rows = (0..SHAPE[1]).rev();
    let row = |j: usize| {
        let words = (0..SHAPE[0]).map(|i| format!("{:e}", height(i, j) * 1e9));
        words.collect::<Vec<_>>().join(", ") + "\n"
    };
    let csv: String = rows.clone().map(row).collect();
    fs::write(folder.path("tip.csv"), csv).unwrap();
    let mut gsf = format!(
        "Gwyddion Simple Field 1.0\nXRes = {}\nYRes = {}\nXReal = {}\nYReal = {}\nXYUnits = m\nZUnits = um\n",
        SHAPE[0], SHAPE[1], SIDES[0], SIDES[1]
    )
    .into_bytes();
    gsf.resize((gsf.len() / 4 + 1) * 4, 0);
    for j in rows {
        #[expect(clippy::cast_possible_truncation, reason = "the format holds f32")]
        gsf.extend((0..SHAPE[0]).flat_map(|i| ((height(i, j) * 1e6) as f32).to_le_bytes()));
    }
    fs::write(folder.path("tip.gsf"), gsf).unwrap();
    folder
}

const INDENTERS: [&str; 3] = [
    "indenter={kind=\"map\", file=\"tip.npy\", sides=[\"600 nm\", \"450 nm\"]}",
    "indenter={kind=\"map\", file=\"tip.csv\", side=\"600 nm\", height_unit=\"nm\"}",
    "indenter={kind=\"map\", file=\"tip.gsf\"}",
];

fn run(folder: &TestFolder, set: &str) -> Value {
    folder
        .run(&["run", "case.toml", "--json", "--set", set])
        .json()
}

fn penetration(summary: &Value) -> f64 {
    summary["steps"][0]["penetration"].as_f64().unwrap()
}

#[test]
fn the_three_map_formats_give_the_same_indenter() {
    let folder = folder();
    let [npy, csv, gsf] = INDENTERS.map(|set| run(&folder, set));
    assert!(npy["steps"][0]["max_pressure_at"][0].as_f64().unwrap() > 0.0);
    // Rounding of the heights.
    assert!((penetration(&csv) / penetration(&npy) - 1.0).abs() < 1e-9);
    // Heights in four bytes: 6e-8 of the highest, 15 nm, relative to 1 nm of penetration.
    let ratio = penetration(&gsf) / penetration(&npy);
    assert!((ratio - 1.0).abs() < 1e-6, "{ratio} {}", penetration(&npy));
    let at = |summary: &Value| summary["steps"][0]["max_pressure_at"].clone();
    assert_eq!((at(&npy), at(&npy)), (at(&csv), at(&gsf)));
}

#[test]
fn a_map_path_is_relative_to_the_case_and_the_resolved_case_runs_again() {
    let folder = folder();
    fs::create_dir(folder.path("elsewhere")).unwrap();
    let mut command = folder.command(&[
        "check",
        "../case.toml",
        "--set",
        "surface={kind=\"map\", file=\"tip.gsf\", compliance=\"20 nm/GPa\"}",
        // sharper than the hollow, so the contact ends within the map
        "--set",
        "indenter.radius=1 um",
    ]);
    let checked = TestFolder::ran(command.current_dir(folder.path("elsewhere")));
    assert_eq!(checked.code, Some(0), "{}", checked.stderr);
    for line in [
        "file = \"tip.gsf\"",
        "height_unit = \"1 um\"",
        "compliance = \"20 nm/GPa\"",
    ] {
        assert!(
            checked.stdout.contains(line),
            "{line} in {}",
            checked.stdout
        );
    }
    fs::write(folder.path("again.toml"), checked.stdout).unwrap();
    folder.run(&["run", "again.toml", "--json"]).json();
}

#[test]
fn moving_the_shape_from_indenter_to_rigid_relief_changes_nothing() {
    let folder = folder();
    // f − f*: it does not matter which body has the height, except for the position of the lowest point.
    let flat = "surface={kind=\"bare\"}";
    let bump = folder.run(&[
        "run",
        "case.toml",
        "--json",
        "--set",
        flat,
        "--set",
        INDENTERS[0],
    ]);
    let on_relief = folder.run(&[
        "run",
        "case.toml",
        "--json",
        "--set",
        "surface={kind=\"map\", file=\"tip.npy\", sides=[\"600 nm\", \"450 nm\"], height_unit=-1, compliance=0}",
        "--set",
        "indenter={kind=\"flat-punch\", radius=\"1 um\"}",
    ]);
    let [bump, on_relief] = [bump, on_relief].map(|ran| ran.json());
    let ratio = penetration(&bump) / penetration(&on_relief);
    // The indenter is moved by less than an element to put its lowest sample on the axis.
    assert!((ratio - 1.0).abs() < 0.02, "{ratio}");
}

/// A map of 24 × 24 samples, 35 nm apart, of a surface in m, as text in nm.
fn text(mut surface: impl FnMut(f64, f64) -> f64) -> String {
    let at = |i: u32| (f64::from(i) - 11.5) * 35e-9;
    let mut row = |j: u32| {
        let words = (0..24).map(|i| format!("{:.6}", 1e9 * surface(at(i), at(j))));
        words.collect::<Vec<_>>().join(";") + "\n"
    };
    (0..24).rev().map(&mut row).collect()
}

const PARABOLOID: fn(f64, f64) -> f64 = |x, y| (x * x + y * y) / 8e-6;

/// Runs the case with this surface or indenter and the map in `map.csv`.
fn with_map(text: &str, set: &str) -> (TestFolder, ProgramOutput) {
    let folder = TestFolder::with_case(CASE);
    fs::write(folder.path("map.csv"), text).unwrap();
    let ran = folder.run(&[
        "run",
        "case.toml",
        "--json",
        "--set",
        "surface={kind=\"bare\"}",
        "--set",
        set,
    ]);
    (folder, ran)
}

#[test]
fn a_smoothly_interpolated_map_has_the_pressure_of_its_surface_and_a_linear_one_has_ridges() {
    let peak = |indenter: &str| {
        let (_folder, ran) = with_map(&text(PARABOLOID), &format!("indenter={indenter}"));
        ran.json()["steps"][0]["max_pressure"].as_f64().unwrap()
    };
    let exact = peak("{kind=\"paraboloid\", radius=\"4 um\"}");
    let map = "kind=\"map\", file=\"map.csv\", side=\"840 nm\", height_unit=\"nm\"";
    let smooth = peak(&format!("{{{map}}}"));
    let linear = peak(&format!("{{{map}, interpolation=\"linear\"}}"));
    // The heights have six decimals of a nanometre.
    assert!((smooth / exact - 1.0).abs() < 1e-4, "{smooth:e} {exact:e}");
    assert!((linear / exact - 1.0).abs() > 0.03, "{linear:e} {exact:e}");
}

#[test]
fn a_map_in_the_wrong_unit_is_rejected_with_the_likely_one() {
    let rough = |x: f64, y: f64| 5e-9 * ((x / 60e-9).sin() + (y / 40e-9).cos());
    let surface =
        |rest: &str| format!("surface={{kind=\"rough\", file=\"map.csv\", side=\"840 nm\"{rest}}}");
    let (_folder, ran) = with_map(&text(rough), &surface(""));
    assert_eq!(ran.code, Some(2), "{}", ran.stderr);
    for part in [
        "`surface.file`",
        "rms slope of",
        "wanted",
        "height_unit = \"nm\"",
    ] {
        assert!(ran.stderr.contains(part), "{part} in {}", ran.stderr);
    }
    let (_folder, ran) = with_map(&text(rough), &surface(", height_unit=\"um\""));
    assert_eq!(ran.code, Some(2), "{}", ran.stderr);
    assert!(
        ran.stderr.contains("`surface.height_unit`"),
        "{}",
        ran.stderr
    );
    let (_folder, ran) = with_map(&text(rough), &surface(", height_unit=\"nm\""));
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
}

#[test]
fn a_rough_body_is_a_map_without_springs() {
    let rough = |x: f64, y: f64| 1e-9 * ((x / 60e-9).sin() + (y / 40e-9).cos());
    let map = "file=\"map.csv\", side=\"840 nm\", height_unit=\"nm\"";
    let [body, rigid] = ["kind=\"rough\"", "kind=\"map\", compliance=0"].map(|kind| {
        let (_folder, ran) = with_map(&text(rough), &format!("surface={{{kind}, {map}}}"));
        penetration(&ran.json()).to_bits()
    });
    assert_eq!(body, rigid);
    let (_folder, ran) = with_map(
        &text(rough),
        &format!("surface={{kind=\"rough\", young_modulus=\"1 GPa\", {map}}}"),
    );
    assert!(
        ran.stderr.contains("springs belong to kind = \"map\""),
        "{}",
        ran.stderr
    );
}

#[test]
fn maps_of_points_and_with_decimal_commas_are_read_correctly() {
    let indenter = "indenter={kind=\"map\", file=\"map.csv\", height_unit=\"nm\"";
    let of = |text: &str, rest: &str| {
        let (_folder, ran) = with_map(text, &format!("{indenter}{rest}}}"));
        penetration(&ran.json())
    };
    let semicolons = text(PARABOLOID);
    let expected = of(&semicolons, ", side=\"840 nm\"");
    let commas = of(&semicolons.replace('.', ","), ", side=\"840 nm\"");
    assert_eq!(commas.to_bits(), expected.to_bits());
    let mut points = Vec::new();
    text(|x, y| {
        let z = PARABOLOID(x, y);
        points.push(format!("{:.3} {:.3} {:.6}\n", x * 1e9, y * 1e9, z * 1e9));
        z
    });
    assert!((of(&points.concat(), "") / expected - 1.0).abs() < 1e-9);
    // One of the points is missing: it is the mean of its neighbours, within the curvature of the ball.
    let missing = [&points[..300], &points[301..]].concat().concat();
    assert!((of(&missing, "") / expected - 1.0).abs() < 0.05);
    // Some of the points only: neither a grid nor a strip of three samples.
    let some = points[15..].concat();
    let (_folder, ran) = with_map(&some, &format!("{indenter}, side=\"840 nm\"}}"));
    assert_eq!(ran.code, Some(2), "{}", ran.stderr);
    assert!(
        ran.stderr
            .contains("points x, y, z that form no rectangular grid"),
        "{}",
        ran.stderr
    );
}

#[test]
fn the_head_of_a_map_gives_its_size_and_unit_and_is_not_contradicted() {
    let head = "# Channel: Height\n# Width: 0.84 µm\n# Height: 0.84 µm\n# Value units: nm\n";
    let map = head.to_owned() + &text(PARABOLOID);
    let run = |keys: &str| {
        with_map(
            &map,
            &format!("indenter={{kind=\"map\", file=\"map.csv\"{keys}}}"),
        )
    };
    let (_folder, ran) = with_map(
        &text(PARABOLOID),
        "indenter={kind=\"map\", file=\"map.csv\", side=\"840 nm\", height_unit=\"nm\"}",
    );
    let expected = penetration(&ran.json());
    for keys in ["", ", side=\"840 nm\"", ", height_unit=\"nm\""] {
        let (_folder, ran) = run(keys);
        assert!(
            (penetration(&ran.json()) / expected - 1.0).abs() < 1e-12,
            "{keys}"
        );
    }
    for (keys, told) in [
        (
            ", side=\"840 um\"",
            "which contradicts the size 840.00 nm by 840.00 nm",
        ),
        (", height_unit=\"0.1 nm\"", "which contradicts the unit nm"),
    ] {
        let (_folder, ran) = run(keys);
        assert_eq!(ran.code, Some(2), "{keys}");
        assert!(ran.stderr.contains(told), "{}", ran.stderr);
    }
}

#[test]
fn check_reports_samples_per_element_and_warns_of_a_map_coarser_than_the_grid() {
    let wave = |x: f64, _: f64| 1e-9 * (x * std::f64::consts::TAU / 210e-9).sin();
    let surface = "surface={kind=\"rough\", file=\"map.csv\", side=\"840 nm\", height_unit=\"nm\"}";
    let (folder, ran) = with_map(&text(wave), surface);
    assert_eq!(ran.json()["warnings"][0]["code"], "coarse-map");
    let checked = folder.run(&["check", "case.toml", "--set", surface]);
    assert!(
        checked.stderr.contains("has a sample every 35.000 nm"),
        "{}",
        checked.stderr
    );
    let line = |name: &str| {
        let line = checked.stdout.lines().find(|line| line.contains(name));
        line.and_then(|line| line.split_whitespace().last())
            .unwrap()
            .to_owned()
    };
    assert_eq!(line("samples per element (surface)"), "0.357");
    let flat = surface
        .replace("nm\"}", "pm\"}")
        .replace("840 nm", "840 um");
    let checked = folder.run(&["check", "case.toml", "--set", &flat]);
    assert!(
        checked.stderr.contains("pm only: is height_unit right?"),
        "{}",
        checked.stderr
    );
    assert_eq!(line("samples per shortest wave (surface)"), "6.0");
}

#[test]
fn tops_of_a_step_map_are_flat_and_carry_what_they_carry_with_linear_interpolation() {
    // Square pillars of 200 nm and eight samples, at a period of 16; either interpolation has the same flat tops.
    let is_on = |i: usize| i % 16 < 8;
    let row = |i: usize| {
        let words = (0..32).map(|j| if is_on(i) && is_on(j) { "200" } else { "0" });
        words.collect::<Vec<_>>().join(",") + "\n"
    };
    let text: String = (0..32).map(row).collect();
    let numbers = |interpolation: &str| {
        let folder = TestFolder::with_case(CASE);
        fs::write(folder.path("map.csv"), &text).unwrap();
        let surface = format!(
            "surface={{kind=\"rough\", file=\"map.csv\", side=\"10 um\", height_unit=\"nm\", interpolation=\"{interpolation}\"}}"
        );
        let sets = [
            surface.as_str(),
            "foundation={substrate={young_modulus=\"70 GPa\", poisson_ratio=0.2}}",
            "indenter={kind=\"sphere\", radius=\"1 mm\"}",
            "load={force=\"1 mN\"}",
            "grid={elements=128, side=\"10 um\"}",
        ];
        let mut words = vec!["run", "case.toml", "--json"];
        words.extend(sets.iter().flat_map(|set| ["--set", set]));
        let ran = folder.run(&words);
        let step = ran.json()["steps"][0].clone();
        let resolved = step["grid_error"]["max_pressure"]["resolved"]
            .as_bool()
            .unwrap();
        let values = ["penetration", "contact_area", "max_pressure"]
            .map(|number| step[number].as_f64().unwrap());
        (values, resolved)
    };
    let (bicubic, is_resolved) = numbers("bicubic");
    let (linear, _) = numbers("linear");
    // The walls differ, the tops do not; at their edges, where the walls begin, the pressure grows with the grid.
    // Overshoot made them 18.6 nm, 0.13 µm² and 10.7 GPa.
    for ((found, wanted), part) in bicubic.into_iter().zip(linear).zip([0.01, 0.01, 0.15]) {
        assert!(
            (found / wanted - 1.0).abs() < part,
            "{bicubic:?} {linear:?}"
        );
    }
    assert!(!is_resolved);
}
