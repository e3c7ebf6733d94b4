//! The readers of the program's own files: the cache, the parts of a study, the results of a run; and of a stream.

use std::fs;
use std::path::Path;
use std::sync::{Arc, LazyLock};

use pellicle::case::BaseCase;
use pellicle_influence::{Cache, CacheWarning, CoefficientTable, RadialTables};
use pellicle_kernel::{Foundation, Material};
use pellicle_study::gather::{self, OtherTable};

use super::{CASE, STUDY, put, sound, told};
use crate::bytes::SoundFile;

/// The coefficients of a small grid, through a cache in this folder that keeps them on disk.
fn cached(folder: &Path) -> (Arc<CoefficientTable>, Vec<CacheWarning>) {
    const SIZE: usize = 4;
    let steel = Material::new(210e9, 0.3).expect("steel");
    let body = Foundation::half_space(steel);
    let tables = RadialTables::build(&body).expect("a homogeneous body has tables");
    let cache = Cache::storing_from(SIZE, folder.join("kept"));
    let found = cache
        .coefficients(&tables, 1e-9, SIZE)
        .expect("coefficients of a small grid");
    (found.value, cache.take_warnings())
}

pub(super) fn coefficients_file(folder: &Path) -> SoundFile {
    cached(folder);
    let mut files = fs::read_dir(folder.join("kept")).expect("the cache has a folder");
    let file = files
        .next()
        .expect("the cache has a file")
        .expect("its name");
    let content = fs::read(file.path()).expect("its content");
    sound(
        folder,
        &format!("kept/{}", file.file_name().to_string_lossy()),
        vec![content],
    )
}

/// The coefficients without a cache.
static COMPUTED: LazyLock<Arc<CoefficientTable>> = LazyLock::new(|| {
    let folder = tempfile::tempdir().expect("a folder for temporary files");
    cached(folder.path()).0
});

/// Whatever the file contains, the coefficients are those of the body.
pub(super) fn coefficients(folder: &Path) -> Result<(), String> {
    let (found, warnings) = cached(folder);
    assert_eq!(found, *COMPUTED);
    warnings
        .first()
        .map_or(Ok(()), |warning| Err(told(warning)))
}

/// A study of two parts, of which the second has no table yet, so that gathering writes nothing.
fn study_in_parts(folder: &Path) {
    put(folder, "base.toml", CASE);
    put(folder, "study.toml", STUDY);
    for part in ["1/2", "2/2"] {
        carried_out(
            folder,
            &["study", "study.toml", "--out", "many", "--shard", part],
        );
    }
    fs::remove_file(folder.join("many/results-2-of-2.csv")).expect("the table of a part");
}

/// Runs the program on files in a folder.
fn carried_out(folder: &Path, words: &[&str]) {
    let word = |word: &&str| {
        let is_place = ["case.toml", "study.toml", "many", "results"].contains(word);
        if is_place {
            folder.join(word).into_os_string()
        } else {
            word.into()
        }
    };
    let words = words.iter().chain(&["--quiet"]).map(word);
    pellicle_cli::main(std::iter::once("pellicle".into()).chain(words));
}

pub(super) fn identity_file(folder: &Path) -> SoundFile {
    study_in_parts(folder);
    file_of(folder, "many/study-1-of-2.json")
}

pub(super) fn table_file(folder: &Path) -> SoundFile {
    study_in_parts(folder);
    file_of(folder, "many/results-1-of-2.csv")
}

fn file_of(folder: &Path, name: &str) -> SoundFile {
    let content = fs::read(folder.join(name)).expect("a file of the program");
    sound(folder, name, vec![content])
}

pub(super) fn parts(folder: &Path) -> Result<(), String> {
    let gathered = gather::gather(&folder.join("many"), OtherTable::Keep);
    gathered.map(drop).map_err(|error| told(&error))
}

fn run_of_case(folder: &Path) {
    put(folder, "case.toml", CASE);
    carried_out(
        folder,
        &["run", "case.toml", "--out", "results", "--pictures", "none"],
    );
}

pub(super) fn summary_file(folder: &Path) -> SoundFile {
    run_of_case(folder);
    file_of(folder, "results/summary.json")
}

pub(super) fn summary(folder: &Path) -> Result<(), String> {
    let read = pellicle_cli::results::read_summary(&folder.join("results"));
    read.map(drop).map_err(|error| told(&error))
}

pub(super) fn fields_file(folder: &Path) -> SoundFile {
    run_of_case(folder);
    file_of(folder, "results/fields-000.npz")
}

pub(super) fn fields(folder: &Path) -> Result<(), String> {
    let read = pellicle_cli::results::StoredFields::read(&folder.join("results/fields-000.npz"));
    read.map(drop).map_err(|error| told(&error))
}

pub(super) fn line_file(folder: &Path) -> SoundFile {
    put(folder, "case.toml", CASE);
    let lines = [
        "{\"load.force\": \"3 uN\", \"grid.elements\": 64}",
        "{\"indenter\": {\"kind\": \"cone\", \"half_angle\": 1.2}, \"load\": {\"forces\": [1e-6, 2e-6]}}",
        "{\"foundation.layer\": [{\"thickness\": 1e-7, \"young_modulus\": 1e9, \"poisson_ratio\": 0.3}]}",
        "{\"title\": \"\\u00b5\", \"surface\": {}, \"stress\": null}",
    ];
    sound(
        folder,
        "standard input",
        lines.map(|line| line.as_bytes().to_vec())[..3].to_vec(),
    )
}

pub(super) fn line(folder: &Path) -> Result<(), String> {
    let base = BaseCase::read(&folder.join("case.toml"), &[]).map_err(|error| told(&error))?;
    let bytes = fs::read(folder.join("standard input")).map_err(|error| told(&error))?;
    let case = pellicle_cli::streamed::case(&base, 1, &bytes);
    case.map(drop).map_err(|error| told(&error))
}
