//! Pictures of docs/gallery.md as the page's own commands draw them. A comment before a picture names the drawing.

use std::fs;
use std::path::Path;
use std::process::Command;

use tempfile::TempDir;

use super::runner::Runner;
use super::sheet::Picture;
use crate::XtaskError;

/// Where the drawings are described.
const PAGE: &str = "docs/gallery.md";

/// Runs the commands of the page in an empty folder and takes the drawings that it names.
pub(super) fn draw(runner: &Runner) -> Result<Vec<Picture>, XtaskError> {
    let page = runner.root.join(PAGE);
    let text = fs::read_to_string(&page).map_err(|cause| XtaskError::read(&page, cause))?;
    let folder = TempDir::new().map_err(|cause| XtaskError::write(&std::env::temp_dir(), cause))?;
    for block in text.split("```").skip(1).step_by(2) {
        let (language, text) = block.split_once('\n').unwrap_or((block, ""));
        let name = text.lines().next().and_then(|line| line.strip_prefix("# "));
        match (language, name) {
            ("toml", Some(name)) => {
                let path = folder.path().join(name);
                fs::write(&path, text).map_err(|cause| XtaskError::write(&path, cause))?;
            }
            ("sh", _) => text
                .lines()
                .try_for_each(|line| run(line, runner, folder.path()))?,
            _ => {}
        }
    }
    let pictures = drawings(&text).map(|(drawing, name)| {
        let path = folder.path().join(drawing);
        let svg = fs::read_to_string(&path).map_err(|cause| XtaskError::read(&path, cause))?;
        Ok(Picture {
            name: name.to_owned(),
            svg,
            csv: String::new(),
        })
    });
    pictures.collect()
}

/// The drawings that the page names, with the names of their pictures.
fn drawings(page: &str) -> impl Iterator<Item = (&str, &str)> {
    page.split("<!-- ").skip(1).filter_map(|part| {
        let (drawing, rest) = part.split_once(" -->")?;
        let picture = rest.split_once("](figures/")?.1.split_once(".png)")?.0;
        Some((drawing, picture))
    })
}

fn run(line: &str, runner: &Runner, folder: &Path) -> Result<(), XtaskError> {
    let words = line.split_whitespace().skip(1);
    let mut command = Command::new(&runner.program[0]);
    command
        .args(&runner.program[1..])
        .args(words)
        .current_dir(folder);
    let ran = command
        .output()
        .map_err(|cause| XtaskError::start(Path::new(&runner.program[0]), cause))?;
    if ran.status.success() {
        return Ok(());
    }
    Err(XtaskError::Refused {
        run: line.to_owned(),
        message: String::from_utf8_lossy(&ran.stderr).trim().to_owned(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_comment_names_the_drawing_of_the_picture_after_it() {
        let page =
            "![a](figures/other.png)\n<!-- results/a/b.svg -->\n![long\ntext](figures/mine.png)\n";
        let found: Vec<_> = drawings(page).collect();
        assert_eq!(found, [("results/a/b.svg", "mine")]);
    }
}
