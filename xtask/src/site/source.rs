//! What the site is built from: its pages, and the files and folders to which they link, at their places in the
//! workspace, so that every link holds.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use thiserror::Error;

use crate::links::{resolved, targets};
use crate::{Tree, XtaskError};

/// The contents, whose links are the pages.
const CONTENTS: &str = "docs/SUMMARY.md";

/// A page to which another leads but which the contents lack.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{from}: found a link to {to}, wanted a page that {CONTENTS} lists")]
pub struct PageFault {
    /// The page with the link.
    pub from: String,
    /// The page to which it leads.
    pub to: String,
}

/// The sources of the site, by their paths from the root of the workspace.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SiteSource {
    contents: String,
    pages: Vec<String>,
    files: BTreeSet<String>,
    /// Folders to which pages lead, with the files in them.
    folders: Vec<(String, Vec<String>)>,
}

impl SiteSource {
    /// Finds the pages, and all to which they link.
    ///
    /// # Errors
    /// [`XtaskError::Page`] if a page is missing from the contents.
    pub fn gathered(tree: &Tree) -> Result<Self, XtaskError> {
        let contents = tree.text(CONTENTS).unwrap_or_default();
        let pages = links(CONTENTS, contents);
        let paths = tree.paths();
        let (mut files, mut folders) = (BTreeSet::new(), BTreeSet::new());
        for page in &pages {
            for to in links(page, tree.text(page).unwrap_or_default()) {
                if pages.contains(&to) || !paths.contains(to.as_str()) {
                    continue;
                }
                if Path::new(&to).extension() == Some("md".as_ref()) {
                    let from = page.clone();
                    return Err(PageFault { from, to }.into());
                }
                let inside = format!("{to}/");
                if paths.iter().any(|path| path.starts_with(&inside)) {
                    folders.insert(to);
                } else {
                    files.insert(to);
                }
            }
        }
        let folders = folders.into_iter().map(|folder| {
            let inside = tree.files_in(&folder);
            (folder, inside)
        });
        let folders: Vec<_> = folders.collect();
        files.extend(folders.iter().flat_map(|(_, inside)| inside.clone()));
        Ok(Self {
            contents: from_root(contents),
            pages,
            files,
            folders,
        })
    }

    /// The pages, in the order of the contents.
    #[must_use]
    pub fn pages(&self) -> &[String] {
        &self.pages
    }

    /// Copies pages and files of the workspace at `root` into the folder `source` of `out`, with the book's settings
    /// beside it. A folder to which a page leads gets a list of its files as its page.
    ///
    /// # Errors
    /// [`XtaskError`] if a file cannot be read or written.
    pub fn write(&self, root: &Path, out: &Path) -> Result<(), XtaskError> {
        let source = out.join("source");
        for path in self.pages.iter().chain(&self.files) {
            copy(&root.join(path), &source.join(path))?;
        }
        for (folder, inside) in &self.folders {
            put(
                &source.join(folder).join("index.html"),
                list(folder, inside),
            )?;
        }
        put(&source.join("SUMMARY.md"), &self.contents)?;
        for settings in ["book.toml", "site.css"] {
            copy(&root.join("docs").join(settings), &out.join(settings))?;
        }
        Ok(())
    }
}

/// The paths from the root to which a page links, each once, in their order.
fn links(page: &str, text: &str) -> Vec<String> {
    let mut found = Vec::new();
    for (_, target) in targets(text) {
        let file = target.split('#').next().unwrap_or_default();
        if let Some(path) = resolved(page, file).filter(|_| !file.is_empty())
            && !found.contains(&path)
        {
            found.push(path);
        }
    }
    found
}

/// The contents with their links as seen from the root.
fn from_root(contents: &str) -> String {
    let mut parts = contents.split("](");
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (target, rest) = part.split_once(')').unwrap_or((part, ""));
        let path = resolved(CONTENTS, target).unwrap_or_default();
        let _ = write!(text, "]({path}){rest}");
    }
    text
}

fn list(folder: &str, files: &[String]) -> String {
    let rows = files.iter().fold(String::new(), |mut rows, file| {
        let name = file.rsplit('/').next().unwrap_or(file);
        let _ = writeln!(rows, "<li><a href=\"{name}\">{name}</a></li>");
        rows
    });
    format!(
        "<!doctype html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>{folder}</title>\n<h1>{folder}</h1>\n<ul>\n\
         {rows}</ul>\n</html>\n"
    )
}

fn copy(from: &Path, to: &Path) -> Result<(), XtaskError> {
    let bytes = fs::read(from).map_err(|cause| XtaskError::read(from, cause))?;
    put(to, bytes)
}

fn put(path: &Path, bytes: impl AsRef<[u8]>) -> Result<(), XtaskError> {
    let folder = path.parent().unwrap_or(path);
    let written = fs::create_dir_all(folder).and_then(|()| fs::write(path, bytes));
    written.map_err(|cause| XtaskError::write(path, cause))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_site_has_its_pages_and_what_they_link_to() {
        let tree = Tree::of(&[
            (CONTENTS, "[Start](../README.md)\n- [Guide](guide.md)\n"),
            ("README.md", "[guide](docs/guide.md#first) [cases](cases)"),
            (
                "docs/guide.md",
                "![a picture](figures/a.png) [site](https://a.b) [up](#first)",
            ),
            ("docs/figures/a.png", ""),
            ("cases/ball.toml", ""),
            ("other.md", ""),
        ]);
        let site = SiteSource::gathered(&tree).unwrap();
        assert_eq!(site.pages, ["README.md", "docs/guide.md"]);
        assert_eq!(
            site.contents,
            "[Start](README.md)\n- [Guide](docs/guide.md)\n"
        );
        let files: Vec<_> = site.files.iter().collect();
        assert_eq!(files, ["cases/ball.toml", "docs/figures/a.png"]);
        let folder = ("cases".to_owned(), vec!["cases/ball.toml".to_owned()]);
        assert_eq!(site.folders, [folder]);
    }

    #[test]
    fn a_page_that_the_contents_lack_is_refused() {
        let tree = Tree::of(&[
            (CONTENTS, "- [Guide](guide.md)\n"),
            ("docs/guide.md", "[more](more.md)"),
            ("docs/more.md", ""),
        ]);
        let error = SiteSource::gathered(&tree).unwrap_err().to_string();
        let wanted =
            "docs/guide.md: found a link to docs/more.md, wanted a page that docs/SUMMARY.md lists";
        assert_eq!(error, wanted);
    }
}
