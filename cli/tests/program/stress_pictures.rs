//! The pictures of stresses: drawn by a run, drawn again from its folder, and shown by the report.

use std::fs;

use pellicle_cli::results::read_stresses;

use super::runner::{TestFolder, names};

/// A hard coating on a base, R = 1, with sliding in an oblique direction.
const COATED: &str = "title = \"Coating\"\n\
    [foundation]\nsubstrate = { young_modulus = 1, poisson_ratio = 0.3, yield_strength = 0.02 }\n\
    [[foundation.layer]]\nthickness = 0.05\nyoung_modulus = 3\npoisson_ratio = 0.25\ntensile_strength = 0.1\n\
    [indenter]\nkind = \"paraboloid\"\nradius = 1\n[load]\nforce = 1e-3\n[grid]\nelements = 32\n\
    [stress]\nfriction = 0.3\ndirection = \"30 deg\"\n";

const PICTURES: [&str; 4] = [
    "stress-interfaces-000.png",
    "stress-interfaces-000.svg",
    "stress-section-000.png",
    "stress-section-000.svg",
];

fn run(folder: &TestFolder, line: &str) {
    let ran = folder.run(&line.split(' ').collect::<Vec<_>>());
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
}

#[test]
fn run_and_plot_draw_the_same_stress_pictures_and_the_report_shows_them() {
    let folder = TestFolder::with_case(COATED);
    run(&folder, "run case.toml --out a --formats npz");
    let files = names(&folder.path("a"));
    for name in PICTURES.iter().chain(&["stress-000.npz"]) {
        assert!(files.contains(&(*name).to_owned()), "{name} in {files:?}");
    }
    let read = |name: &str| fs::read_to_string(folder.path(name)).unwrap();
    let section = read("a/stress-section-000.svg");
    for words in [
        "section through x, y = ",
        " at 30°",
        "Largest von Mises stress ",
        "Largest principal stress ",
        ">interface 0</text>",
        "layer[0]",
        "substrate",
        "depth z (case units)",
        "dashed lines",
    ] {
        assert!(section.contains(words), "{words}");
    }
    let interfaces = read("a/stress-interfaces-000.svg");
    assert!(interfaces.contains("Interface 0, 0.050000 deep: shear traction"));
    run(&folder, "plot a --out b");
    for name in PICTURES.iter().filter(|name| name.ends_with("svg")) {
        assert_eq!(read(&format!("a/{name}")), read(&format!("b/{name}")));
    }
    let again = folder.run(&["plot", "a", "--out", "b"]);
    assert_eq!(again.code, Some(2));
    // The names of the stress files alone suffice for a refusal.
    for name in names(&folder.path("b")) {
        if !name.starts_with("stress") {
            fs::remove_file(folder.path("b").join(name)).unwrap();
        }
    }
    let again = folder.run(&["plot", "a", "--out", "b"]);
    assert!(
        again.stderr.contains("stress-section-000"),
        "{}",
        again.stderr
    );
    run(&folder, "plot a --out b --force");
    let report = read("a/report.html");
    for words in [
        "<h2>Critical loads</h2>",
        "<h3>Stresses inside</h3>",
        "largest von Mises stress",
        "sliding with a coefficient of friction 0.300 along 30.0°",
        " of the yield strength",
        "interface 0, 0.050000 deep",
        "the coating cracks",
    ] {
        assert!(report.contains(words), "{words}");
    }
    run(&folder, "plot a");
    assert_eq!(read("a/report.html"), report);
}

#[test]
fn the_section_shows_the_stresses_at_its_points() {
    let folder = TestFolder::with_case(COATED);
    let line = "run case.toml --out a --formats npz --pictures none --set foundation.layer[0].thickness=0.1";
    run(&folder, &(line.to_owned() + " --set stress={friction=0.3}"));
    let view = read_stresses(&folder.path("a/stress-000.npz")).unwrap();
    let section = &view.section;
    let count = section.along.len();
    let largest = section.von_mises.iter().copied().fold(0.0, f64::max);
    // Planes at the surface, within the coating, on both sides of the interface and in the base.
    let below = section.bodies.iter().position(|body| *body == 1).unwrap();
    for plane in [0, 3, below - 1, below, below + 5] {
        let i = plane * count + count / 3;
        let [x, y] = section.line.at(section.along[count / 3]);
        // The line lies between two rows of elements: the field is linear between them.
        let mut centres = view.centres.clone();
        centres.sort_by(|one, other| (one - y).abs().total_cmp(&(other - y).abs()));
        let [near, far] = [centres[0], centres[1]];
        let weight = (far - y) / (far - near);
        let at = [near, far].map(|y| {
            let point = format!("--at={x:e},{y:e},{:e}", section.depths[plane]);
            let line = ["stress", "case.toml", "--json", &point];
            let sets = [
                "--set",
                "foundation.layer[0].thickness=0.1",
                "--set",
                "stress={friction=0.3}",
            ];
            let states = folder.run(&[&line[..], &sets].concat()).json();
            let states = states.as_array().unwrap().clone();
            // On an interface, the first is that above it.
            let state = if plane == below {
                &states[1]
            } else {
                &states[0]
            };
            [&state["von_mises"], &state["principal"][0]].map(|value| value.as_f64().unwrap())
        });
        let found = [section.von_mises[i], section.max_principal[i]];
        for k in 0..2 {
            let wanted = weight * at[0][k] + (1.0 - weight) * at[1][k];
            // The planes are accurate to 1e-11 of the largest value, derived stresses to a little less.
            let error = (found[k] - wanted).abs();
            assert!(error < 1e-9 * largest, "plane {plane}: {found:?}, {wanted}");
        }
    }
}

#[test]
fn a_damaged_view_is_rejected_with_its_name() {
    let folder = TestFolder::with_case(COATED);
    run(
        &folder,
        "run case.toml --out a --formats npz --pictures none",
    );
    fs::write(folder.path("a/stress-000.npz"), "nothing").unwrap();
    let ran = folder.run(&["plot", "a"]);
    assert_eq!(ran.code, Some(2));
    assert!(ran.stderr.contains("stress-000.npz"), "{}", ran.stderr);
}
