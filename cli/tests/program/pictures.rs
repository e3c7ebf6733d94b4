//! `plot`: pictures drawn again unchanged, and with options.

use std::fs;
use std::path::Path;

use pellicle::display::{Unit, quantity};
use pellicle::input::units::Units;

use super::runner::{CASE, TestFolder, names};

/// A folder with results of one load, and of three.
fn results() -> TestFolder {
    let folder = TestFolder::with_case(CASE);
    let curve = "load={forces=[\"1 uN\", \"2 uN\", \"4 uN\"]}";
    for (out, more) in [("one", &[][..]), ("three", &["--set", curve])] {
        let ran = folder.run(
            &[
                &["run", "case.toml", "--out", out, "--formats", "npz"],
                more,
            ]
            .concat(),
        );
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    }
    folder
}

fn plot(folder: &TestFolder, line: &str) {
    let ran = folder.run(&line.split(' ').collect::<Vec<_>>());
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
}

fn svg(path: &Path) -> String {
    fs::read_to_string(path).unwrap()
}

#[test]
fn custom_pictures_are_added_beside_the_existing_ones() {
    let folder = results();
    let before = svg(&folder.path("one/pressure-000.svg"));
    assert!(before.contains("Q = 1.0000 µN"));
    plot(
        &folder,
        "plot one --out fig --no-title --size 600 --colour-map cividis --section peak",
    );
    assert_eq!(svg(&folder.path("one/pressure-000.svg")), before);
    let map = svg(&folder.path("fig/pressure-000.svg"));
    assert!(
        map.contains(" width=\"600\"") && !map.contains("Q = "),
        "{}",
        &map[..300]
    );
    let png = fs::read(folder.path("fig/pressure-000.png")).unwrap();
    // The header of a PNG contains the width.
    assert_eq!(png[16..20], 600_u32.to_be_bytes());
    let again = folder.run(&["plot", "one", "--out", "fig"]);
    assert_eq!(again.code, Some(2));
    assert!(again.stderr.contains("--force"), "{}", again.stderr);
    plot(&folder, "plot one --out fig --force");
    assert_eq!(svg(&folder.path("fig/pressure-000.svg")), before);
}

#[test]
fn a_section_is_at_the_requested_place_and_states_its_depth_scale() {
    let folder = results();
    let section = |order: &str| {
        plot(&folder, &format!("plot one --out s --force{order}"));
        svg(&folder.path("s/section-000.svg"))
    };
    let axis = section("");
    assert!(axis.contains("section at y = 6.2500 nm"), "{axis}");
    assert!(axis.contains(" × enlarged"));
    let peak = section(" --section peak");
    let summary = folder.summary("one");
    let y = summary["steps"][0]["max_pressure_at"][1].as_f64().unwrap();
    let y = quantity(y, Unit::Metre, Units::Si);
    assert!(peak.contains(&format!("section at y = {y}")), "{y}");
    assert!(section(" --section x=-100nm").contains("section at x = -93.750 nm"));
    assert!(section(" --section y=1").contains("section at y = 193.75 nm"));
}

#[test]
fn a_pressed_plane_has_no_axis_and_its_section_is_through_the_largest_pressure() {
    let folder = TestFolder::new();
    for order in [
        "init rough-map --out rough-surface.csv",
        "init rough-periodic --out case.toml",
    ] {
        plot(&folder, order);
    }
    plot(
        &folder,
        "run case.toml --out rough --set grid.elements=32 --set load={force=1e-3} --formats npz",
    );
    let section = svg(&folder.path("rough/section-000.svg"));
    let summary = folder.summary("rough");
    let y = summary["steps"][0]["max_pressure_at"][1].as_f64().unwrap();
    let y = quantity(y, Unit::Metre, Units::Si);
    assert!(section.contains(&format!("section at y = {y}")), "{y}");
}

#[test]
fn the_colour_bar_has_the_given_pressure_range() {
    let folder = results();
    plot(&folder, "plot one --out r --range 0.5GPa:3GPa");
    let map = svg(&folder.path("r/pressure-000.svg"));
    for label in [">0.5</text>", ">3</text>", ">pressure p, GPa</text>"] {
        assert!(map.contains(label), "{label}");
    }
}

#[test]
fn curves_of_several_results_are_drawn_in_one_picture() {
    let folder = results();
    plot(&folder, "plot three one --out c");
    assert_eq!(names(&folder.path("c")), ["curves.png", "curves.svg"]);
    let curves = svg(&folder.path("c/curves.svg"));
    assert!(curves.contains("three (Test)") && curves.contains("one (Test)"));
    let again = folder.run(&["plot", "three", "one", "--out", "c"]);
    assert_eq!(again.code, Some(2), "{}", again.stderr);
    let section = folder.run(&["plot", "three", "one", "--section", "peak"]);
    assert_eq!(section.code, Some(2), "{}", section.stderr);
}

#[test]
fn a_result_without_fields_keeps_its_pictures_and_its_report() {
    let folder = TestFolder::with_case(CASE);
    folder.run(&["run", "case.toml", "--out", "a", "--fields", "none"]);
    let before = fs::read(folder.path("a/report.html")).unwrap();
    let files = names(&folder.path("a"));
    assert!(files.contains(&"section-000.png".to_owned()), "{files:?}");
    plot(&folder, "plot a");
    assert_eq!(names(&folder.path("a")), files);
    assert_eq!(fs::read(folder.path("a/report.html")).unwrap(), before);
    let step = folder.run(&["plot", "a", "--step", "0"]);
    assert_eq!(step.code, Some(2), "{}", step.stderr);
}

#[test]
fn a_measured_surface_has_maps_of_its_heights_the_gap_and_the_displacement() {
    let map = "[surface]\nkind = \"map\"\nfile = \"s.csv\"\nside = \"400 nm\"\nheight_unit = \"nm\"\ncompliance = 0\n";
    let (start, rest) = CASE.split_once("[surface]").unwrap();
    let (_, end) = rest.split_once("[indenter]").unwrap();
    let folder = TestFolder::with_case(format!("{start}{map}\n[indenter]{end}"));
    let row = |j: usize| {
        (0..9)
            .map(|i| ((i * j) % 4).to_string())
            .collect::<Vec<_>>()
            .join(",")
    };
    let rows: Vec<_> = (0..9).map(row).collect();
    fs::write(folder.path("s.csv"), rows.join("\n") + "\n").unwrap();
    let ran = folder.run(&["run", "case.toml", "--out", "a"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    for (name, title) in [
        ("heights", "height f*, nm"),
        ("gap", "gap g, nm"),
        ("displacement", "displacement u, "),
    ] {
        let map = svg(&folder.path(&format!("a/{name}-000.svg")));
        assert!(map.contains(title), "{name}");
        assert!(folder.path(&format!("a/{name}-000.png")).is_file());
    }
    let page = fs::read_to_string(folder.path("a/report.html")).unwrap();
    assert!(page.contains("<h3>The gap g</h3>"));
    let spectrum = svg(&folder.path("a/spectrum.svg"));
    assert!(spectrum.contains("surface: rms height") && page.contains("<h2>Roughness</h2>"));
    let area = svg(&folder.path("a/area-law.svg"));
    assert!(area.contains("Persson") && page.contains("<h2>Contact area</h2>"));
    let histograms = svg(&folder.path("a/histograms-000.svg"));
    assert!(histograms.contains("mean gap ") && page.contains("Pressures and gaps"));
    let curve = fs::read_to_string(folder.path("a/curve.csv")).unwrap();
    let header = curve.lines().next().unwrap();
    assert!(
        header.contains("nominal area [m^2],contact fraction,counted contact area [m^2],"),
        "{header}"
    );
    // It is drawn from the files alone.
    fs::remove_file(folder.path("a/spectrum.svg")).unwrap();
    plot(&folder, "plot a");
    assert_eq!(svg(&folder.path("a/spectrum.svg")), spectrum);
}
