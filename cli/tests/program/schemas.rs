//! The schemas of cases, fits, studies and summaries: what they accept is what the program takes, and what they see
//! wrong it refuses.

use std::fs;
use std::path::{Path, PathBuf};

use super::read_back::read_back;
use super::runner::{CASE, TestFolder};

#[test]
fn every_summary_conforms_to_its_schema() {
    let folder = TestFolder::with_case(CASE);
    let runs = [
        vec!["case.toml"],
        vec![
            "case.toml",
            "--set",
            "load={penetrations=[\"1 nm\", \"2 nm\"]}",
            "--set",
            "grid.elements=128",
        ],
        vec!["case.toml", "--set", "load.force=5e-324 N"],
        vec![
            "case.toml",
            "--set",
            "surface={kind=\"film\", thickness=\"5 nm\", young_modulus=\"1 GPa\"}",
        ],
        vec![
            "case.toml",
            "--set",
            "surface={kind=\"bare\"}",
            "--set",
            "foundation.substrate=\"rigid\"",
        ],
        vec!["case.toml", "--set", "indenter={kind=\"vickers\"}"],
        vec!["case.toml", "--fields", "none", "--formats", "nc,npz"],
        vec![
            "case.toml",
            "--set",
            "indenter={kind=\"cone\", half_angle=\"80 deg\"}",
        ],
        vec![
            "case.toml",
            "--set",
            "stress={depths=[0, \"5 nm\"], extent=\"100 nm\", friction=0.2, direction=\"10 deg\"}",
            "--set",
            "foundation.layer[0].yield_strength=1 MPa",
            "--set",
            "foundation.layer[0].interface={normal_compliance=0, shear_compliance=\"1 nm/GPa\"}",
            "--set",
            "foundation.layer[0].interface_tensile_strength=1 TPa",
            "--set",
            "foundation.substrate.tensile_strength=1 GPa",
        ],
        vec![
            "case.toml",
            "--set",
            "indenter.young_modulus=1141 GPa",
            "--set",
            "indenter.poisson_ratio=0.07",
            "--set",
            "load.sensitivities=true",
        ],
    ];
    let mut arguments = vec![schema(&folder, "summary-schema")];
    for (i, run) in runs.iter().enumerate() {
        let ran = folder.run(&[&["run", "--json"], &run[..]].concat());
        assert_ne!(ran.stdout, "", "{run:?}: {}", ran.stderr);
        arguments.push(folder.path(&format!("{i}.json")));
        fs::write(arguments.last().unwrap(), ran.stdout).unwrap();
    }
    read_back("schema.py", &arguments);
}

/// Writes a schema into the folder.
fn schema(folder: &TestFolder, kind: &str) -> PathBuf {
    let ran = folder.run(&["init", kind, "--out", "schema.json"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    folder.path("schema.json")
}

/// Mistakes that an editor can see, each with a table that replaces one of [`CASE`].
const MISTAKES: [&str; 12] = [
    "foundation={layer=[{thickness=1, young_modulus=1, poisson_ratio=0.3}]}",
    "foundation={substrate=\"soft\"}",
    "foundation={substrate={young_modulus=1, poisson_ratio=\"0.3\"}}",
    "indenter={kind=\"parabolid\", radius=1}",
    "indenter={kind=\"sphere\", radius=\"1\"}",
    "indenter={kind=\"sphere\", radius=1, tip_radius=2}",
    "indenter={kind=\"sphere\", radius=1, young_modulus=1}",
    "surface={kind=\"cylinders\", radius=1, height=1}",
    "surface={kind=\"film\", thickness=1, young_modulus=1, law=\"soft\"}",
    "load={force=1, penetration=1}",
    "grid={elements=64.5}",
    "output={formats=[\"hdf5\"]}",
];

#[test]
fn editors_accept_every_case_and_template_and_see_mistakes() {
    let folder = TestFolder::with_case(CASE);
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let toml = |folder: &Path| {
        let files = fs::read_dir(folder).unwrap();
        let files = files.map(|file| file.unwrap().path());
        files.filter(|file| file.extension().is_some_and(|end| end == "toml"))
    };
    let mut right: Vec<PathBuf> = ["cases", "cases/paper", "cli/src/templates"]
        .iter()
        .flat_map(|name| toml(&root.join(name)).collect::<Vec<_>>())
        .filter(|path| kind_of(path) == "schema")
        .collect();
    right.push(folder.path("case.toml"));
    assert!(right.len() > 25, "{right:?}");
    let mut wrong = Vec::new();
    for (i, mistake) in MISTAKES.iter().enumerate() {
        // The program refuses it, too.
        let ran = folder.run(&["check", "case.toml", "--set", mistake]);
        assert_eq!(ran.code, Some(2), "{mistake}: {}", ran.stdout);
        let (key, value) = mistake.split_once('=').unwrap();
        let mut case: toml::Table = CASE.parse().unwrap();
        let value: toml::Table = format!("value = {value}").parse().unwrap();
        case.insert(key.into(), value["value"].clone());
        let path = folder.path(&format!("wrong-{i}.toml"));
        fs::write(&path, case.to_string()).unwrap();
        wrong.push(path);
    }
    let mut arguments = vec![schema(&folder, "schema"), right.len().to_string().into()];
    arguments.extend(right);
    arguments.extend(wrong);
    read_back("case_schema.py", &arguments);
}

/// The schema of a template, by its name.
fn kind_of(path: &Path) -> &'static str {
    let name = path.file_name().unwrap().to_string_lossy();
    match &*name {
        "study.toml" => "study-schema",
        name if name.starts_with("fit") => "fit-schema",
        _ => "schema",
    }
}

/// A fit of a template's kind, with every table that a fit may have.
const FIT: &str = r#"
title = "all tables"
[model]
foundation = { substrate = { young_modulus = "10 GPa", poisson_ratio = 0.3 } }
indenter = { kind = "paraboloid" }
load = { work_of_adhesion = "50 mJ/m^2", adhesion = "dmt" }
[[data]]
file = "ball-*.csv"
columns = { depth = 1, force = "F", marker = 3 }
units = { depth = "nm", force = 1e-3 }
text = { decimal = ",", separator = ";", table = 2, invalid_above = 1e30 }
segment = { from = "0.1 mN", to = { row = 300 }, part = "loading", until = "largest depth step" }
baseline = { from = "10 nm", to = "1 um" }
omit = [31, 44]
observe = "force at depth"
noise = { depth = "0.2 nm", relative = 0.01, correlation = "none" }
spring_constant = { mean = "0.1 N/m", sd = 0.01 }
height_direction = "toward"
set = { "indenter.radius" = "1 um" }
[unknown]
"load.work_of_adhesion" = { prior = "normal", mean = "50 mJ/m^2", sd = "5 mJ/m^2" }
[unknown.foundation.substrate]
young_modulus = { from = "2 GPa", to = "50 GPa" }
[nuisance]
depth_zero = "off"
force_zero = { per = "curve", prior = "normal", mean = 0, sd = "1 nN" }
drift = { per = "curve" }
frame_compliance = "free"
"indenter.radius" = { prior = "lognormal", median = "10 um", factor = 1.05 }
[report]
level = 0.9
design = { forces = ["1 mN"], radii = { from = "1 um", to = "9 um", count = 3, spacing = "log" }, points = 9 }
[evaluation]
poisson_ratio = { mean = 0.17, sd = 0.01 }
area_function = [24.5, "120 nm"]
unloading = [0.95, 0.4]
drift = "hold"
depth_zero = "3 nm"
indenter = { young_modulus = "1141 GPa", poisson_ratio = 0.07 }
calibrate = { young_modulus = "72 GPa", coefficients = 2 }
"#;

/// Mistakes in a fit or a study that an editor can see: what replaces what.
const MISTAKES_IN_FITS: [[&str; 2]; 10] = [
    ["part = \"loading\"", "part = \"load\""],
    ["columns", "colums"],
    ["{ row = 300 }", "{ row = 300, force = 1 }"],
    ["omit = [31, 44]", "omit = [0]"],
    ["height_direction = \"toward\"", "height_direction = \"up\""],
    ["per = \"curve\" }", "per = \"file\" }"],
    ["level = 0.9", "level = \"0.9\""],
    ["unloading = [0.95, 0.4]", "unloading = [0.95]"],
    ["drift = \"hold\"", "drift = \"found\""],
    ["kind = \"paraboloid\"", "kind = \"parabola\""],
];

#[test]
fn editors_accept_every_fit_and_study_and_see_mistakes() {
    let folder = TestFolder::new();
    let templates = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/templates");
    let written = |name: String, text: &str| {
        let path = folder.path(&name);
        fs::write(&path, text).unwrap();
        path
    };
    let study = fs::read_to_string(templates.join("study.toml")).unwrap();
    let mistakes = [
        (FIT, "fit", &MISTAKES_IN_FITS[..]),
        (
            &study,
            "study",
            &[["[study.vary]", "[study.varies]"], ["[study]", "[studies]"]][..],
        ),
    ];
    for (text, kind, mistakes) in mistakes {
        let mut right = vec![written(format!("right-{kind}.toml"), text)];
        let files = fs::read_dir(&templates).unwrap();
        let files = files.map(|file| file.unwrap().path());
        let schema_kind = format!("{kind}-schema");
        right.extend(files.filter(|path| kind_of(path) == schema_kind));
        let wrong = mistakes.iter().enumerate().map(|(i, [from, to])| {
            let wrong = text.replacen(from, to, 1);
            assert_ne!(wrong, text, "{from}");
            written(format!("wrong-{kind}-{i}.toml"), &wrong)
        });
        let mut arguments = vec![
            schema(&folder, &schema_kind),
            right.len().to_string().into(),
        ];
        let wrong: Vec<PathBuf> = wrong.collect();
        arguments.extend(right);
        arguments.extend(wrong);
        read_back("case_schema.py", &arguments);
        fs::remove_file(folder.path("schema.json")).unwrap();
    }
}
