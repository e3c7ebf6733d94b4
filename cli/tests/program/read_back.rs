//! Every file of a results folder read back with the tool for which it is written. The tools are Python packages,
//! installed once into a folder of the build; without Python or a network, the tests report this on standard error and
//! pass.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

use super::runner::{CASE, TestFolder};

/// Packages imported by the scripts; VTK is installed without its plotting libraries.
const PACKAGES: [&str; 7] = [
    "numpy",
    "scipy",
    "xarray",
    "gsffile",
    "jsonschema",
    "pillow",
    "pypdfium2",
];
const ALONE: &str = "vtk";

/// A different number makes a new installation, for a changed list of packages.
const INSTALLATION: &str = "read-back-2";

/// The interpreter with the packages; `None` if they are not available.
fn python() -> Option<&'static Path> {
    static PYTHON: OnceLock<Option<PathBuf>> = OnceLock::new();
    let python = PYTHON.get_or_init(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(INSTALLATION);
        let installed = if folder.is_dir() {
            Ok(())
        } else {
            install(&folder)
        };
        match installed {
            Ok(()) => Some(interpreter(&folder)),
            Err(reason) => {
                say_skipped(&format!("files are not read back by their tools: {reason}"));
                None
            }
        }
    });
    python.as_deref()
}

/// Writes past the test harness, which hides the output of a test that passes.
pub fn say_skipped(line: &str) {
    let mut stderr = std::io::stderr();
    writeln!(stderr, "SKIPPED: {line}").unwrap();
}

fn interpreter(folder: &Path) -> PathBuf {
    folder.join(if cfg!(windows) {
        "Scripts/python.exe"
    } else {
        "bin/python"
    })
}

/// Makes the installation beside its final place and moves it there when it is complete.
fn install(folder: &Path) -> Result<(), String> {
    let parent = folder.parent().unwrap();
    fs::create_dir_all(parent).unwrap();
    let scratch = tempfile::tempdir_in(parent).unwrap();
    let place = scratch.path().join("python");
    let python = if cfg!(windows) { "python" } else { "python3" };
    succeed(Command::new(python).args(["-m", "venv"]).arg(&place))?;
    let pip = |more: &[&str]| {
        let mut command = Command::new(interpreter(&place));
        command.args([
            "-m",
            "pip",
            "install",
            "--quiet",
            "--disable-pip-version-check",
        ]);
        command.args([
            "--only-binary",
            ":all:",
            "--retries",
            "1",
            "--timeout",
            "20",
        ]);
        succeed(command.args(more))
    };
    pip(&PACKAGES)?;
    pip(&["--no-deps", ALONE])?;
    // Another process may have been faster; its installation serves as well.
    match fs::rename(&place, folder) {
        Err(error) if !folder.is_dir() => Err(error.to_string()),
        _ => Ok(()),
    }
}

fn succeed(command: &mut Command) -> Result<(), String> {
    let Output { status, stderr, .. } = command.output().map_err(|error| error.to_string())?;
    if status.success() {
        return Ok(());
    }
    let stderr = String::from_utf8_lossy(&stderr);
    Err(stderr
        .lines()
        .last()
        .unwrap_or("no reason given")
        .to_owned())
}

/// Runs a script of `tests/read_back`; it fails if the files are wrong.
pub fn read_back(script: &str, arguments: &[PathBuf]) {
    let Some(python) = python() else { return };
    let scripts = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/read_back");
    let mut command = Command::new(python);
    let output = command
        .arg(scripts.join(script))
        .args(arguments)
        .output()
        .unwrap();
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{script}: {stderr}");
}

/// A curve of two steps on two grids, and one of a punch, outside which the gap is infinite.
fn check_both_cases(script: &str) {
    let folder = TestFolder::with_case(CASE);
    let curve = [
        "--fields",
        "all",
        "--set",
        "load={forces=[\"1 uN\", \"2 uN\"]}",
        "--set",
        "grid.elements=64",
    ];
    let punch = ["--set", "indenter={kind=\"flat-punch\", radius=\"90 nm\"}"];
    for (name, more) in [("curve", &curve[..]), ("punch", &punch[..])] {
        let all = ["--formats", "npz,vti,nc,gsf"];
        let line = [
            &["run", "case.toml", "--quiet", "--out", name],
            &all[..],
            more,
        ]
        .concat();
        let ran = folder.run(&line);
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        read_back(script, &[folder.path(name)]);
    }
}

#[test]
fn numpy_reads_the_npz() {
    check_both_cases("numpy_npz.py");
}

#[test]
fn gwyddion_reads_the_gsf_as_written() {
    check_both_cases("gwyddion_gsf.py");
}

#[test]
fn vtk_reads_the_vti_with_its_units() {
    check_both_cases("vtk_image.py");
}

#[test]
fn xarray_reads_the_netcdf_in_the_layout_of_contact_engineering() {
    check_both_cases("xarray_netcdf.py");
}

/// Stresses of a curve: one layer with friction, and two layers without, one of them graded. xarray reads the tractions
/// on the surface and across interfaces, VTK those on unevenly spaced planes.
#[test]
fn stresses_are_read_as_written_by_xarray_and_vtk() {
    let folder = TestFolder::with_case(CASE);
    let layers = "foundation.layer=[\
        { thickness = \"10 nm\", young_modulus = { from = \"90 GPa\", to = \"50 GPa\", profile = \"linear\" }, poisson_ratio = 0.3 },\
        { thickness = \"20 nm\", young_modulus = \"200 GPa\", poisson_ratio = 0.2 }]";
    let curve = "load={forces=[\"1 uN\", \"2 uN\"]}";
    for (name, more) in [
        (
            "sliding",
            ["stress={friction=0.2, direction=\"30 deg\"}", curve],
        ),
        ("layers", ["stress={}", layers]),
    ] {
        let sets = more.into_iter().flat_map(|set| ["--set", set]);
        let line = [
            "run",
            "case.toml",
            "--quiet",
            "--pictures",
            "none",
            "--out",
            name,
        ];
        let fields = ["--fields", "all", "--formats", "npz,vti,nc"];
        let line = line.into_iter().chain(fields).chain(sets);
        let ran = folder.run(&line.collect::<Vec<_>>());
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        for script in ["xarray_stress.py", "vtk_rectilinear.py"] {
            read_back(script, &[folder.path(name)]);
        }
    }
}

#[test]
fn xarray_reads_the_fields_of_a_study_with_the_case_as_a_dimension() {
    let folder = TestFolder::with_case(CASE.replace("side = \"400 nm\"\n", ""));
    let text = "[study]\ncase = \"case.toml\"\nkeep = [\"pressure\"]\n[study.vary]\n\
                grid.elements = [32, 48]\nsurface.radius = [\"10 nm\", \"20 nm\", \"26 nm\"]\n";
    fs::write(folder.path("many.toml"), text).unwrap();
    let ran = folder.run(&["study", "many.toml", "--quiet"]);
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    read_back("xarray_study.py", &[folder.path("results/many")]);
}
