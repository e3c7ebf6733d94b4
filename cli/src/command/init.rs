//! `pellicle init`: a commented case that runs as it is, or a fit drafted from measured curves.

use std::path::{Path, PathBuf};

use pellicle_files::whole;
use pellicle_identify::draft::{Draft, DraftError, DraftKind};
use pellicle_identify::measured::sources;

use crate::arguments::InitArguments;
use crate::command::Outcome;
use crate::failure::Failure;
use crate::terminal;

/// Prints the template, or writes it to a new file; drafts a fit if there are curves to draft it from.
///
/// # Errors
///
/// [`Failure`] if the file exists or cannot be written, or the curves are none.
pub fn init(arguments: &InitArguments) -> Result<Outcome, Failure> {
    let kind = arguments.kind;
    match (&arguments.from[..], kind.draft(), &arguments.out) {
        ([], _, Some(path)) => {
            write(path, &kind.text(), arguments.force)?;
            let path = path.display().to_string();
            terminal::report(&format!("wrote {path}; now: {}", kind.next(&path)));
        }
        ([], _, None) => terminal::print(&kind.text())?,
        (_, None, _) => return Err(Failure::NotDrafted),
        (from, Some(draft), _) => self::draft(from, draft, arguments)?,
    }
    Ok(Outcome::Done)
}

fn write(path: &Path, text: &str, force: bool) -> Result<(), Failure> {
    if force {
        whole::write_bytes(path, text.as_bytes())?;
    } else {
        whole::write_new(path, text.as_bytes())?;
    }
    Ok(())
}

/// Drafts a fit and writes it beside its curves.
fn draft(from: &[PathBuf], kind: DraftKind, arguments: &InitArguments) -> Result<(), Failure> {
    let files = files(from);
    let first = files.first().ok_or(DraftError::NoFiles)?;
    let beside = || match from {
        [folder] if folder.is_dir() => folder.join(folder.file_name().unwrap_or("curves".as_ref())),
        _ => first.clone(),
    };
    let out = arguments
        .out
        .clone()
        .unwrap_or_else(|| beside().with_extension("toml"));
    let folder = out.parent().unwrap_or(Path::new(""));
    let draft = Draft::new(&files, folder, kind)?;
    write(&out, &draft.text, arguments.force)?;
    for remark in &draft.remarks {
        terminal::report(remark);
    }
    let (put, path) = (pellicle_identify::draft::NOT_IN_THE_FILE, out.display());
    terminal::report(&format!(
        "wrote {path}; now look for \"{put}\" in it, then: pellicle identify {path}"
    ));
    Ok(())
}

/// The files of names, patterns and folders; of a folder those that are no fit files or pages.
fn files(from: &[PathBuf]) -> Vec<PathBuf> {
    const NOT_CURVES: [&str; 6] = ["toml", "md", "json", "html", "svg", "png"];
    let of = |path: &PathBuf| -> Vec<PathBuf> {
        if path.is_file() {
            return vec![path.clone()];
        }
        if !path.is_dir() {
            return sources::files(Path::new(""), &path.to_string_lossy());
        }
        let is_curve = |file: &PathBuf| {
            let ending = file.extension().unwrap_or_default().to_string_lossy();
            !NOT_CURVES.contains(&&*ending.to_lowercase())
        };
        let all = sources::files(path, "*");
        all.into_iter().filter(is_curve).collect()
    };
    from.iter().flat_map(of).collect()
}
