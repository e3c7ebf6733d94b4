//! The readers: of what a user writes, of maps and measured curves, and of the program's own files.

mod own_files;

use std::fs;
use std::path::Path;
use std::sync::Arc;

use pellicle::Case;
use pellicle::input::clean::clean;
use pellicle::input::source_file;
use pellicle_cli::Template;
use pellicle_identify::draft::{Draft, DraftKind};
use pellicle_identify::fit_file::Measurements;
use pellicle_identify::fit_file::evaluation_file::Task;
use pellicle_identify::measured::curve::MeasuredCurve;
use pellicle_identify::measured::data_table::DataTable;
use pellicle_study::study_file;

use self::own_files::{
    coefficients, coefficients_file, fields, fields_file, identity_file, line, line_file, parts,
    summary, summary_file, table_file,
};
use super::{Reader, SoundFile};

/// Every reader.
pub const ALL: [Reader; 15] = [
    Reader {
        name: "case",
        prepare: case_file,
        read: case,
    },
    Reader {
        name: "study",
        prepare: study_file,
        read: study,
    },
    Reader {
        name: "samples of a study",
        prepare: samples_file,
        read: study,
    },
    Reader {
        name: "fit",
        prepare: fit_file,
        read: fit,
    },
    Reader {
        name: "map in NumPy's format",
        prepare: npy_file,
        read: npy,
    },
    Reader {
        name: "map in Gwyddion's format",
        prepare: gsf_file,
        read: gsf,
    },
    Reader {
        name: "map as text",
        prepare: text_file,
        read: text,
    },
    Reader {
        name: "measured curve",
        prepare: curve_file,
        read: curve,
    },
    Reader {
        name: "measured curve of a draft",
        prepare: drafted_file,
        read: drafted,
    },
    Reader {
        name: "cached coefficients",
        prepare: coefficients_file,
        read: coefficients,
    },
    Reader {
        name: "identity of a study",
        prepare: identity_file,
        read: parts,
    },
    Reader {
        name: "table of a study",
        prepare: table_file,
        read: parts,
    },
    Reader {
        name: "summary of a run",
        prepare: summary_file,
        read: summary,
    },
    Reader {
        name: "fields of a run",
        prepare: fields_file,
        read: fields,
    },
    Reader {
        name: "line of a stream",
        prepare: line_file,
        read: line,
    },
];

/// The reader of this name.
#[must_use]
pub fn named(name: &str) -> Option<Reader> {
    ALL.into_iter().find(|reader| reader.name == name)
}

/// A small case of a homogeneous body, of which nothing is cached.
const CASE: &str = r#"title = "Ball"
[foundation]
substrate = { young_modulus = "70 GPa", poisson_ratio = 0.2 }
[indenter]
kind = "paraboloid"
radius = "1 um"
[load]
force = "1 uN"
[grid]
side = "100 nm"
elements = 16
"#;

/// The same on a map of heights.
const CASE_ON_MAP: &str = r#"
[foundation]
substrate = { young_modulus = "70 GPa", poisson_ratio = 0.2 }
[surface]
kind = "rough"
file = "MAP"
side = "4 um"
height_unit = "nm"
[indenter]
kind = "paraboloid"
radius = "1 um"
[load]
force = "1 uN"
"#;

const STUDY: &str = r#"[study]
case = "base.toml"
keep = ["pressure"]
[study.vary]
load.force = ["1 uN", "2 uN", "3 uN"]
indenter.radius = { from = "1 um", to = "2 um", count = 2, spacing = "log" }
"#;

const STUDY_OF_SAMPLES: &str = r#"[study]
case = "base.toml"
[study.vary]
from = "samples.csv"
"#;

const SAMPLES: &str = "load.force,indenter.radius\n1 uN,1 um\n2 uN,1.5 um\n\"3 uN\",2 um\n";

const CURVE: &str = "# Sample 3\nDepth (nm),Load (mN),Time (s)\n0.0,0.000,0.0\n2.0,0.019,0.5\n4.0,0.053,1.0\n\
                     6.0,0.098,1.5\n8.0,0.151,2.0\n6.0,0.097,2.5\n4.0,0.052,3.0\n";

const CURVE_WITH_TABS: &str = "Depth\tLoad\r\n[nm]\t[mN]\r\n0.0\t0.0\r\n2\t1.9e-2\r\n4\t5.3e-2\r\n6\t9.8e-2\r\n8\t15.1e-2\r\n";

const DATA: &str = "[[data]]\nfile = \"curve.txt\"\ncolumns = { depth = \"Depth\", force = \"Load\" }\nunits = { depth = \"nm\", force = \"mN\" }\n";

/// A text without its comment lines.
fn bare(text: &str) -> Vec<u8> {
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    lines
        .flat_map(|line| [line, "\n"])
        .collect::<String>()
        .into_bytes()
}

fn put(folder: &Path, name: &str, content: impl AsRef<[u8]>) {
    fs::write(folder.join(name), content).expect("a file in a folder of its own");
}

fn sound(folder: &Path, name: &str, contents: Vec<Vec<u8>>) -> SoundFile {
    let path = folder.join(name);
    SoundFile { path, contents }
}

/// The sentence as the program shows it.
fn told(error: &dyn std::error::Error) -> String {
    clean(&error.to_string())
}

fn case_file(folder: &Path) -> SoundFile {
    put(
        folder,
        "rough-surface.csv",
        "1 2 1 3\n2 1 2 1\n3 1 2 1\n1 2 1 2\n",
    );
    let templates = [
        Template::Cylinders,
        Template::Dimples,
        Template::Film,
        Template::Coating,
        Template::CubeCorner,
        Template::Power,
        Template::FlatPunch,
    ];
    let mut contents: Vec<_> = templates.iter().map(|one| bare(&one.text())).collect();
    contents.push(CASE.into());
    contents.push(CASE_ON_MAP.replace("MAP", "rough-surface.csv").into());
    contents.push(format!("{CASE}[stress]\ndepths = [\"10 nm\"]\n[solver]\nhardness = \"5 GPa\"\n[output]\nformats = [\"npz\", \"vti\"]\n").into());
    sound(folder, "case.toml", contents)
}

fn case(folder: &Path) -> Result<(), String> {
    let case = Case::read(&folder.join("case.toml"), &[]);
    case.map(drop).map_err(|error| told(&error))
}

fn study_file(folder: &Path) -> SoundFile {
    put(folder, "base.toml", CASE);
    put(folder, "samples.csv", SAMPLES);
    let whole = bare(&Template::Study.text());
    sound(
        folder,
        "study.toml",
        vec![STUDY.into(), STUDY_OF_SAMPLES.into(), whole],
    )
}

fn samples_file(folder: &Path) -> SoundFile {
    put(folder, "base.toml", CASE);
    put(folder, "study.toml", STUDY_OF_SAMPLES);
    sound(
        folder,
        "samples.csv",
        vec![SAMPLES.into(), SAMPLES.replace(',', ";").into()],
    )
}

fn study(folder: &Path) -> Result<(), String> {
    let study = study_file::read(&folder.join("study.toml"), &[]).map_err(|error| told(&error))?;
    // A case that is not valid is recorded in its turn.
    drop(study.case(0));
    Ok(())
}

fn fit_file(folder: &Path) -> SoundFile {
    put(folder, "curve.txt", CURVE);
    put(folder, "approach.txt", &*Template::Approach.text());
    put(folder, "oxide.csv", &*Template::Oxide.text());
    put(folder, "indentation.txt", &*Template::Indentation.text());
    let fits = [
        Template::Fit,
        Template::FitAfm,
        Template::FitFilm,
        Template::FitUnloading,
    ];
    let mut contents: Vec<_> = fits.iter().map(|one| bare(&one.text())).collect();
    let fit = String::from_utf8_lossy(&contents[0]).into_owned();
    let more = "[nuisance]\ndepth_zero = { per = \"curve\", mean = \"0 nm\", sd = \"5 nm\" }\n[report]\nseed = 3\n";
    contents.push((fit + more).into());
    sound(folder, "fit.toml", contents)
}

fn fit(folder: &Path) -> Result<(), String> {
    let task = Task::read(&folder.join("fit.toml"), Measurements::Required);
    task.map(drop).map_err(|error| told(&error))
}

fn npy_file(folder: &Path) -> SoundFile {
    let array = |kind: &str, order: &str, shape: &str, data: Vec<u8>| {
        let header = format!("{{'descr': '{kind}', 'fortran_order': {order}, 'shape': {shape}, }}");
        let header = format!("{header:<117}\n");
        let mut bytes = b"\x93NUMPY\x01\x00\x76\x00".to_vec();
        bytes.extend(header.bytes());
        bytes.extend(data);
        bytes
    };
    let numbers = [1.0, 2.0, 3.0, 2.0, 1.0, 2.0_f64];
    let eight = numbers
        .iter()
        .flat_map(|number| number.to_le_bytes())
        .collect();
    let two = [1_u16, 2, 3, 2, 1, 2]
        .iter()
        .flat_map(|number| number.to_be_bytes())
        .collect();
    let arrays = vec![
        array("<f8", "False", "(2, 3)", eight),
        array(">u2", "True", "(3, 2)", two),
    ];
    map_file(folder, "map.npy", arrays)
}

fn gsf_file(folder: &Path) -> SoundFile {
    let field = |head: &str| {
        let mut bytes = format!("Gwyddion Simple Field 1.0\n{head}").into_bytes();
        bytes.resize((bytes.len() / 4 + 1) * 4, 0);
        let heights = [1.0, 2.0, 3.0, 2.0, 1.0, 2.0_f32];
        bytes.extend(
            heights
                .iter()
                .flat_map(|height| (1e-9 * height).to_le_bytes()),
        );
        bytes
    };
    let bare = field("XRes = 3\nYRes = 2\n");
    let whole = field(
        "XRes = 2\nYRes = 3\nXReal = 2e-06\nYReal = 3e-06\nXYUnits = m\nZUnits = m\nTitle = Z\n",
    );
    map_file(folder, "map.gsf", vec![bare, whole])
}

fn text_file(folder: &Path) -> SoundFile {
    let texts = [
        "1,2,3\n4,5,6\n",
        "# Channel: Topography\n# Width: 4 µm\n1,5\t2,5\n-3,25\t4e1\n",
        "x y z\n0 0 0.5\n1 0 0.6\n0 2 0.7\n1 2 0.8\n",
        "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 9\nNODATA_value -9999\n1 2 3\n4 5 6\n",
    ];
    let mut contents = texts.map(|text| text.as_bytes().to_vec()).to_vec();
    contents.push(
        "\u{feff}1 2\n3 4\n"
            .encode_utf16()
            .flat_map(u16::to_le_bytes)
            .collect(),
    );
    map_file(folder, "map.txt", contents)
}

fn map_file(folder: &Path, name: &str, contents: Vec<Vec<u8>>) -> SoundFile {
    put(folder, "case.toml", CASE_ON_MAP.replace("MAP", name));
    let own = CASE_ON_MAP.replace("MAP", name);
    let own = own
        .replace("side = \"4 um\"\n", "")
        .replace("height_unit = \"nm\"\n", "");
    put(folder, "own.toml", own);
    sound(folder, name, contents)
}

/// A map without a size of its own is read with that of the case, one with a size without.
fn map(folder: &Path) -> Result<(), String> {
    case(folder).or_else(|_| {
        let case = Case::read(&folder.join("own.toml"), &[]);
        case.map(drop).map_err(|error| told(&error))
    })
}

use self::{map as npy, map as gsf, map as text};

fn curve_file(folder: &Path) -> SoundFile {
    put(folder, "fit.toml", DATA);
    let contents = vec![
        CURVE.into(),
        CURVE_WITH_TABS.into(),
        bare(&Template::Indentation.text()),
    ];
    sound(folder, "curve.txt", contents)
}

fn curve(folder: &Path) -> Result<(), String> {
    let source = source_file::read(&folder.join("fit.toml")).map_err(|error| told(&error))?;
    let tables = DataTable::parse_all(&Arc::new(source), folder).map_err(|error| told(&error))?;
    tables.iter().try_for_each(|table| {
        let curves = MeasuredCurve::read_all(table);
        curves.map(drop).map_err(|error| told(&error))
    })
}

fn drafted_file(folder: &Path) -> SoundFile {
    // The first lines of an approach: the time of a draft grows with the length of the curve.
    let approach = Template::Approach.text();
    let approach: Vec<_> = approach.lines().take(60).collect();
    sound(
        folder,
        "curve.txt",
        vec![CURVE.into(), approach.join("\n").into()],
    )
}

fn drafted(folder: &Path) -> Result<(), String> {
    let draft = Draft::new(&[folder.join("curve.txt")], folder, DraftKind::Guessed);
    draft.map(drop).map_err(|error| told(&error))
}
