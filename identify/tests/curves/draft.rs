//! Fit files drafted from curves of instruments: each is read, and says which columns it has found.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use pellicle::input::span::Source;
use pellicle_identify::draft::{Draft, DraftKind};
use pellicle_identify::fit_file::evaluation_file::Task;
use pellicle_identify::fit_file::{FitSources, Measurements};
use pellicle_identify::measured::curve::MeasuredCurve;

/// Drafts a fit file from a file of this folder, reads it back with its curves, and returns its text.
fn drafted(file: &str, kind: DraftKind) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/curves");
    let draft = Draft::new(&[folder.join(file)], &folder, kind).expect("a draft");
    let source = Arc::new(Source::new("draft.toml", draft.text.clone()));
    let sources = FitSources::in_folder(&folder);
    let read = Task::parse(&source, "draft", &sources, Measurements::Required);
    let read = read.map_err(|error| format!("{error}\n{}", draft.text));
    let data = match read.expect("a fit file") {
        Task::Fit(file) => file.data,
        Task::Evaluation(file) => file.data,
    };
    for table in &data {
        let curves = MeasuredCurve::read_all(table);
        let curves = curves.map_err(|error| format!("{error}\n{}", draft.text));
        curves.expect("curves");
    }
    draft.text
}

#[test]
fn every_instrument_s_file_gives_a_fit_file_that_is_read() {
    use DraftKind::{Afm, Guessed, Unloading};
    for (file, kind, wanted) in [
        (
            "FS1.txt",
            Guessed,
            &[
                "columns = { depth = \"h\", force = \"F\", time = \"t\" }",
                "decimal = \",\", table = 1",
                "units = { depth = \"um\", force = \"mN\", time = \"s\" }",
                "observe = \"unloading\"",
            ][..],
        ),
        (
            "RobinSteel0000LC.txt",
            Guessed,
            &[
                "depth = \"Depth (nm)\", force = \"Load (µN)\"",
                "; hold of ",
                "gives back 38 % of the work",
                "observe = \"unloading\"",
                "windows-1252",
            ],
        ),
        (
            "micromechanics_popin_test012.csv",
            Guessed,
            &[
                "depth = \"Displacement Into Surface [nm]\"",
                "a pop-in of 22.6 nm in row 128, at 346 uN",
                "until = \"largest depth step\"",
            ],
        ),
        (
            "micromechanics_popin_test012.csv",
            Unloading,
            &[
                "stiffness = \"Harmonic Contact Stiffness [N/m]\"",
                "every row is a contact",
                "observe = \"unloading\"",
            ],
        ),
        (
            "tungsten_sphere_test01.csv",
            Guessed,
            &["a pop-in of 29.6 nm in row 774, at 812 uN"],
        ),
        (
            "optics11_chiaro_AEBP1.txt",
            Guessed,
            &[
                "height = \"Piezo (nm)\", force = \"Load (uN)\"",
                "spring_constant = \"19 mN/m\"  # line 10: k (N/m) 0.019",
                "radius = \"27.5 um\"  # line 11: Tip radius (um) 27.500",
            ],
        ),
        (
            "fmt-afm-workshop-fd_single_2020-02-14_13.41.25.csv",
            Afm,
            &[
                "height = \"Extend Z-Sense(nm)\", force = \"Extend Force(nN)\" }",
                "spring_constant = \"10 N/m\"  # not in the file",
            ],
        ),
        (
            "jpk_spot3-0192.csv",
            Guessed,
            &[
                "height = \"height measured [m]\", force = \"force [N]\"",
                "spring_constant = \"43.494 mN/m\"  # line 2",
                "It is pulled back by 515 pN",
            ],
        ),
        (
            "synthetic_fused_silica.txt",
            Guessed,
            &["hold of 58", "observe = \"unloading\""],
        ),
    ] {
        let text = drafted(file, kind);
        for part in wanted {
            assert!(text.contains(part), "{file}: {part}\n{text}");
        }
    }
}

#[test]
fn eight_repeats_on_tungsten_are_one_pattern() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/curves");
    let file = |k: usize| folder.join(format!("tungsten_sphere_test0{k}.csv"));
    let files: Vec<PathBuf> = (1..=8).map(file).collect();
    let draft = Draft::new(&files, &folder, DraftKind::Guessed).expect("a draft");
    for wanted in [
        "# 8 files: repeats",
        "file = \"tungsten_sphere_test0*.csv\"\n",
    ] {
        assert!(draft.text.contains(wanted), "{}", draft.text);
    }
}
