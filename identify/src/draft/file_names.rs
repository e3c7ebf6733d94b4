//! The names of files as a fit file in a folder has them: a pattern if one matches just them.

use std::path::{Path, PathBuf};

use crate::measured::sources;

/// The names of files as a fit file in a folder has them: a pattern if one matches just them.
pub(super) fn named(files: &[PathBuf], folder: &Path) -> Vec<String> {
    let names: Vec<String> = files.iter().map(|file| relative(file, folder)).collect();
    pattern(&names, files, folder).map_or(names, |pattern| vec![pattern])
}

fn pattern(names: &[String], files: &[PathBuf], folder: &Path) -> Option<String> {
    let (first, others) = names.split_first()?;
    if others.is_empty() {
        return None;
    }
    let common = |same: &dyn Fn(&str, &str) -> usize| {
        others
            .iter()
            .map(|other| same(first, other))
            .min()
            .unwrap_or(0)
    };
    let alike = |one: &mut dyn Iterator<Item = char>, other: &mut dyn Iterator<Item = char>| {
        let pairs = one.zip(other).take_while(|(a, b)| a == b);
        pairs.map(|(a, _)| a.len_utf8()).sum()
    };
    let start = common(&|one, other| alike(&mut one.chars(), &mut other.chars()));
    let end = common(&|one, other| alike(&mut one.chars().rev(), &mut other.chars().rev()));
    let shortest = names.iter().map(String::len).min()?;
    let end = end.min(shortest - start);
    let folder_end = first.rfind('/').map_or(0, |place| place + 1);
    let ending = first
        .rfind('.')
        .filter(|dot| *dot >= folder_end)
        .unwrap_or(first.len());
    let candidates = [
        format!("{}*{}", &first[..folder_end], &first[ending..]),
        format!(
            "{}*{}",
            first.get(..start)?,
            first.get(first.len() - end..)?
        ),
    ];
    let canonical = |path: &PathBuf| path.canonicalize().ok();
    let mut wanted: Vec<_> = files.iter().map(canonical).collect();
    wanted.sort();
    candidates.into_iter().find(|pattern| {
        let mut found: Vec<_> = sources::files(folder, pattern)
            .iter()
            .map(canonical)
            .collect();
        found.sort();
        found == wanted
    })
}

/// The path of a file from a folder, with slashes; absolute where there is none.
pub(super) fn relative(file: &Path, folder: &Path) -> String {
    let here = if folder.as_os_str().is_empty() {
        Path::new(".")
    } else {
        folder
    };
    let (Ok(file), Ok(folder)) = (file.canonicalize(), here.canonicalize()) else {
        return file.to_string_lossy().into_owned();
    };
    let (of_file, of_folder): (Vec<_>, Vec<_>) =
        (file.components().collect(), folder.components().collect());
    let same = of_file
        .iter()
        .zip(&of_folder)
        .take_while(|(one, other)| one == other)
        .count();
    let up = (same..of_folder.len()).map(|_| "..".to_owned());
    let down = of_file[same..]
        .iter()
        .map(|part| part.as_os_str().to_string_lossy().into_owned());
    up.chain(down).collect::<Vec<_>>().join("/")
}
