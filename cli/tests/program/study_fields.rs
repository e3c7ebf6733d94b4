//! `study.keep`: fields of all cases in one file, equal to those of `run`, however the study was interrupted or
//! divided.

use std::collections::BTreeMap;
use std::fs;
use std::process::Child;
use std::thread::sleep;
use std::time::{Duration, Instant};

use ndarray::Array2;
use ndarray_npy::NpzReader;

use super::netcdf_reader::{self, Records};
use super::runner::{CASE, ProgramOutput, TestFolder, names};

/// Two grids; the cylinders with the last radius overlap.
const STUDY: &str = r#"[study]
case = "case.toml"
keep = ["gap", "pressure"]

[study.vary]
grid.elements = [32, 48]
load.force = ["1 uN", "2 uN", "4 uN"]
surface.radius = ["10 nm", "20 nm", "26 nm"]
"#;

/// Each case has its own domain.
fn folder(text: &str) -> TestFolder {
    TestFolder::with_study(CASE.replace("side = \"400 nm\"\n", ""), text)
}

fn study(folder: &TestFolder, more: &[&str]) -> ProgramOutput {
    folder.study(&[&["--threads", "2"], more].concat())
}

fn bytes(folder: &TestFolder, name: &str) -> Vec<u8> {
    fs::read(folder.path("results/many").join(name)).unwrap()
}

fn kept(folder: &TestFolder, name: &str) -> BTreeMap<String, Records> {
    netcdf_reader::variables(bytes(folder, name))
}

fn column(variable: &Records) -> Vec<f64> {
    variable.iter().map(|record| record[0]).collect()
}

/// Whether the bits are equal, those of NaN included.
fn are_bits(one: &[f64], other: &[f64]) -> bool {
    let same = |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits();
    one.len() == other.len() && one.iter().zip(other).all(same)
}

#[test]
fn kept_fields_equal_those_of_single_runs_to_the_bit() {
    let folder = folder(STUDY);
    let ran = study(&folder, &[]);
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    for (elements, first) in [(32, 1), (48, 10)] {
        let found = kept(&folder, &format!("fields-n{elements}.nc"));
        let cases = column(&found["case"]);
        assert!(cases.iter().copied().eq((first..first + 9).map(f64::from)));
        let status = column(&found["status"]);
        assert_eq!(status, [0.0, 0.0, 3.0].repeat(3));
        for (i, force) in ["1 uN", "2 uN", "4 uN"].into_iter().enumerate() {
            for (j, radius) in ["10 nm", "20 nm"].into_iter().enumerate() {
                let place = 3 * i + j;
                let sets = [
                    format!("load.force={force}"),
                    format!("surface.radius={radius}"),
                    format!("grid.elements={elements}"),
                ];
                let mut line = vec!["run", "case.toml", "--quiet", "--out", "a", "--force"];
                line.extend(["--pictures", "none"]);
                sets.iter().for_each(|set| line.extend(["--set", set]));
                assert_eq!(folder.run(&line).code, Some(0));
                let path = folder.path("a/fields-000.npz");
                let mut npz = NpzReader::new(fs::File::open(path).unwrap()).unwrap();
                for name in ["pressure", "gap"] {
                    let field: Array2<f64> = npz.by_name(name).unwrap();
                    let field = field.into_raw_vec_and_offset().0;
                    assert!(are_bits(&found[name][place], &field), "{name} {sets:?}");
                }
                let side = folder.summary("a")["grid"]["side"].as_f64();
                assert_eq!(Some(found["side"][place][0]), side);
            }
            for name in ["pressure", "gap", "side"] {
                let failed = &found[name][3 * i + 2];
                assert!(failed.iter().all(|value| value.is_nan()), "{name}");
            }
        }
        let sides = column(&found["side"]);
        assert!(
            (sides[0] / sides[3] - 1.0).abs() > 1e-3,
            "sides chosen from the load differ"
        );
        // Centres of the elements of a unit square.
        let x = &found["x"][0];
        assert_eq!((x.len(), x[0]), (elements, 0.5 / elements as f64 - 0.5));
    }
}

const FILES: [&str; 3] = ["fields-n32.nc", "fields-n48.nc", "results.csv"];

/// The files of an undisturbed study.
fn undisturbed(text: &str) -> Vec<Vec<u8>> {
    let folder = folder(text);
    assert_eq!(study(&folder, &[]).code, Some(1));
    FILES.map(|name| bytes(&folder, name)).to_vec()
}

/// A longer study, so that there is something to interrupt.
fn long() -> String {
    let loads = "load.force = { from = \"1 uN\", to = \"4 uN\", count = 40 }";
    let text = STUDY.replace("load.force = [\"1 uN\", \"2 uN\", \"4 uN\"]", loads);
    assert_ne!(text, STUDY);
    text
}

#[test]
fn kept_fields_survive_kills_and_read_as_empty_until_complete() {
    let text = long();
    let (folder, expected) = (folder(&text), undisturbed(&text));
    let start = || -> Child {
        let line = ["study", "many.toml", "--quiet", "--threads", "2"];
        folder.command(&line).spawn().unwrap()
    };
    let path = folder.path("results/many/fields-n32.nc");
    let mut interrupted = 0;
    for i in 0..6 {
        let mut child = start();
        let began = Instant::now();
        while !path.exists() {
            assert!(began.elapsed() < Duration::from_mins(1), "no field");
            sleep(Duration::from_millis(2));
        }
        // Rows wait for their fields, which are forced to disk once a second.
        sleep(Duration::from_millis(150 * i));
        child.kill().unwrap();
        child.wait().unwrap();
        let rows = fs::read_to_string(folder.path("results/many/results.csv"));
        let rows = rows.map_or(0, |text| text.lines().count());
        if rows < 241 {
            let read = fs::read(&path).unwrap();
            assert_eq!(read[4..8], [0; 4], "no record is promised");
            interrupted += 1;
        }
    }
    assert!(interrupted > 0);
    assert_eq!(study(&folder, &[]).code, Some(1));
    let found = FILES.map(|name| bytes(&folder, name));
    assert!(found[..] == expected[..]);
}

#[test]
fn parts_from_several_machines_are_merged_into_the_files_of_one() {
    let expected = undisturbed(STUDY);
    let folder = folder(STUDY);
    // Each machine has its own folder; all are copied into one.
    for part in ["1/3", "2/3", "3/3"] {
        let out = format!("machine-{}", &part[..1]);
        let ran = study(&folder, &["--shard", part, "--out", &out]);
        assert_eq!(ran.code, Some(1), "{}", ran.stderr);
        fs::create_dir_all(folder.path("results/many")).unwrap();
        for name in names(&folder.path(&out)) {
            let to = folder.path("results/many").join(&name);
            fs::copy(folder.path(&out).join(&name), to).unwrap();
        }
    }
    let part = folder.path("results/many/fields-n48-2-of-3.nc");
    let missing = folder.path("away.nc");
    fs::rename(&part, &missing).unwrap();
    let refused = folder.run(&["gather", "results/many"]);
    assert_eq!(refused.code, Some(2));
    assert!(
        refused.stderr.contains("fields-n48-2-of-3.nc"),
        "{}",
        refused.stderr
    );
    fs::rename(&missing, &part).unwrap();
    let gathered = folder.run(&["gather", "results/many"]);
    assert_eq!(gathered.code, Some(1), "{}", gathered.stderr);
    let found = FILES.map(|name| bytes(&folder, name));
    assert!(found[..] == expected[..]);
    // The whole study counts as done, and its fields are there.
    assert_eq!(study(&folder, &[]).code, Some(1));
    let found = FILES.map(|name| bytes(&folder, name));
    assert!(found[..] == expected[..]);
}

#[test]
fn all_loading_steps_are_kept_if_the_case_requests_them() {
    let text = "[study]\ncase = \"case.toml\"\nkeep = [\"pressure\", \"profile\"]\n[study.vary]\n\
                load.forces = [[\"1 uN\", \"2 uN\", \"3 uN\"], [\"2 uN\"]]\n";
    let case = CASE.replace("force = \"1 uN\"\n", "");
    let folder = TestFolder::with_case(format!("{case}\n[output]\nfields = \"all\"\n"));
    fs::write(folder.path("many.toml"), text).unwrap();
    let ran = study(&folder, &[]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let found = kept(&folder, "fields-n32.nc");
    let [first, second] = &found["pressure"][..] else {
        panic!("two cases")
    };
    assert_eq!(first.len(), 3 * 32 * 32);
    // The load of the second case is the second load of the first case.
    assert!(are_bits(&second[..1024], &first[1024..2048]));
    assert!(second[1024..].iter().all(|value| value.is_nan()));
    assert!(are_bits(
        &found["profile"][0][..1024],
        &found["profile"][1][..1024]
    ));
}

#[test]
fn foreign_field_files_are_not_touched_and_missing_ones_are_reported() {
    let folder = folder(STUDY);
    fs::write(
        folder.path("many.toml"),
        STUDY.replace("\"gap\"", "\"gaps\""),
    )
    .unwrap();
    let wrong = study(&folder, &[]);
    assert_eq!(wrong.code, Some(2));
    let wanted =
        "key `study.keep[0]`: found \"gaps\", wanted one of \"pressure\", \"displacement\"";
    let sentence = wrong
        .stderr
        .split_whitespace()
        .collect::<Vec<_>>()
        .join(" ");
    assert!(
        sentence.contains("gaps") && sentence.contains("displacement"),
        "{wanted}: {sentence}"
    );
    fs::write(folder.path("many.toml"), STUDY).unwrap();
    assert_eq!(study(&folder, &[]).code, Some(1));
    let first = FILES.map(|name| bytes(&folder, name));
    // A table without its fields is of no use.
    fs::remove_file(folder.path("results/many/fields-n48.nc")).unwrap();
    let lost = study(&folder, &[]);
    assert_eq!(lost.code, Some(2));
    assert!(
        lost.stderr.contains("fields-n48.nc") && lost.stderr.contains("--fresh"),
        "{}",
        lost.stderr
    );
    fs::write(folder.path("results/many/fields-n48.nc"), "mine").unwrap();
    let other = study(&folder, &[]);
    assert_eq!(other.code, Some(2));
    assert!(
        other.stderr.contains("other fields than this study keeps"),
        "{}",
        other.stderr
    );
    assert_eq!(bytes(&folder, "fields-n48.nc"), b"mine");
    fs::remove_file(folder.path("results/many/fields-n48.nc")).unwrap();
    assert_eq!(study(&folder, &["--fresh"]).code, Some(1));
    assert!(FILES.map(|name| bytes(&folder, name)) == first);
    // Other fields make another study: the cases have to be solved again.
    fs::write(folder.path("many.toml"), STUDY.replace("\"gap\", ", "")).unwrap();
    let refused = study(&folder, &[]);
    assert_eq!(refused.code, Some(2));
    assert!(refused.stderr.contains("--fresh"), "{}", refused.stderr);
    assert_eq!(study(&folder, &["--fresh"]).code, Some(1));
    assert!(!kept(&folder, "fields-n32.nc").contains_key("gap"));
    let left = names(&folder.path("results/many"));
    assert!(left.iter().all(|name| !name.starts_with('.')), "{left:?}");
}
