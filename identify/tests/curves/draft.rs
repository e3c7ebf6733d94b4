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
                "segment = { from = \"903 uN\" }",
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

/// Drafts a fit file from a curve of a cantilever of 0.06 N/m on a soft body, whose deflection is in volts of 55 nm,
/// with this text above its numbers and these fields in each row.
fn drafted_volts(head: &str, row: impl Fn(f64, f64) -> String) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    // A force of k d at a penetration of z − d, d = 55 nm V: the depth is 0.8 of the approach.
    let volts = |z: f64| if z > 0.0 { 0.2 * z / 55.0 } else { 0.0 };
    let ripple = |i: i32| 1e-3 * (2.4 * f64::from(i)).sin();
    let height = |i: i32| 5.0 * f64::from(i - 100);
    let rows: String = (0..300)
        .map(|i| row(height(i), volts(height(i)) + ripple(i)) + "\n")
        .collect();
    std::fs::write(folder.path().join("a.txt"), format!("{head}\n{rows}")).expect("a file");
    let files = [folder.path().join("a.txt")];
    let draft = Draft::new(&files, folder.path(), DraftKind::Afm);
    draft.map_or_else(|error| error.to_string(), |draft| draft.text)
}

#[test]
fn a_sensitivity_that_the_head_states_is_never_invented() {
    let jpk = |z: f64, v: f64| format!("{:e} {v} 0.1", -1e-9 * z);
    let jpk = drafted_volts(
        "# springConstant: 0.06\n# sensitivity: 5.5e-08\n#\n# columns: height vDeflection seriesTime\n\
         # units: m V s",
        jpk,
    );
    let plain = |z: f64, v: f64| format!("{z}\t{v}");
    let of = |stated: &str| {
        let head = format!("Spring constant (N/m): 0.06\n{stated}\n\nZsensor (nm)\tDeflection (V)");
        drafted_volts(&head, plain)
    };
    let asylum = of("InvOLS: 5.5e-08");
    let [in_key, behind] = [of("InvOLS (nm/V): 55"), of("InvOLS: 55 nm/V")];
    let nanoscope = of("\\@Sens. DeflSens: V 55.0 nm/V");
    for (text, line) in [
        (jpk, "line 2: # sensitivity: 5.5e-08"),
        (asylum, "line 2: InvOLS: 5.5e-08"),
        (in_key, "line 2: InvOLS (nm/V): 55"),
        (behind, "line 2: InvOLS: 55 nm/V"),
        (nanoscope, "line 2: \\@Sens. DeflSens: V 55.0 nm/V"),
    ] {
        assert!(
            text.contains(&format!("deflection = \"55 nm/V\" }}  # {line}")),
            "{text}"
        );
        assert!(
            text.contains("spring_constant = \"60 mN/m\"  # line 1"),
            "{text}"
        );
    }
    let without_unit = of("InvOLS: 55");
    assert!(
        without_unit
            .contains("line 2: InvOLS: 55; its unit, taken for nm/V, not in the file: put yours"),
        "{without_unit}"
    );
    let without = of("");
    assert!(
        without.contains("# an invented sensitivity, not in the file: put yours"),
        "{without}"
    );
}

#[test]
fn columns_of_an_extension_and_a_retraction_in_volts_are_those_of_the_extension() {
    let row = |z: f64, v: f64| format!("{z}\t{z}\t{v}\t{v}");
    let text = drafted_volts(
        "Calc_Ramp_Ex_nm\tCalc_Ramp_Rt_nm\tDefl_V_Ex\tDefl_V_Rt",
        row,
    );
    for wanted in [
        "columns = { height = \"Calc_Ramp_Ex_nm\", deflection = \"Defl_V_Ex\" }",
        "an invented sensitivity",
    ] {
        assert!(text.contains(wanted), "{text}");
    }
}

#[test]
fn a_column_without_numbers_is_not_chosen() {
    let row = |z: f64, v: f64| format!("{z}\t{v}\t");
    let text = drafted_volts("Zsensor (nm)\tDeflection (V)\tForce (nN)", row);
    let wanted = "columns = { height = \"Zsensor (nm)\", deflection = \"Deflection (V)\" }";
    assert!(text.contains(wanted), "{text}");
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
