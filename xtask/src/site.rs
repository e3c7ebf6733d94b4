//! The site: the pages of `docs/SUMMARY.md` as an mdBook, with the files to which they link, and a check of every link
//! of the pages built.

mod built;
mod source;

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use clap::Args;

pub use built::BrokenLink;
pub use source::{PageFault, SiteSource};

use crate::{Tree, XtaskError};

/// Where the site is built.
#[derive(Debug, Clone, Args)]
pub struct SiteArguments {
    /// Folder of the site, from the root of the workspace; what is in it is replaced.
    #[arg(long, default_value = "target/site")]
    pub out: PathBuf,
    /// The program mdBook.
    #[arg(long, default_value = "mdbook")]
    pub mdbook: OsString,
}

/// What became of the site.
#[derive(Debug)]
pub enum Site {
    /// It is built, with as many pages; these links lead nowhere.
    Built(usize, Vec<BrokenLink>),
    /// Its sources are gathered, but there is no mdBook to build it.
    Gathered(usize),
}

/// Gathers the pages of the workspace at `root` and builds the site.
///
/// # Errors
/// [`XtaskError`] if a page is missing from the contents, a file cannot be read or written, or mdBook fails.
pub fn site(root: &Path, arguments: &SiteArguments) -> Result<Site, XtaskError> {
    let source = SiteSource::gathered(&Tree::read(root)?)?;
    let out = root.join(&arguments.out);
    match fs::remove_dir_all(&out) {
        Err(cause) if out.exists() => return Err(XtaskError::write(&out, cause)),
        _ => {}
    }
    source.write(root, &out)?;
    let pages = source.pages().len();
    let built = Command::new(&arguments.mdbook)
        .arg("build")
        .arg(&out)
        .status();
    match built {
        Ok(status) if status.success() => {
            let broken = built::broken_links(&out.join("book"), source.pages())?;
            Ok(Site::Built(pages, broken))
        }
        Ok(_) => Err(XtaskError::NoSite),
        Err(cause) if cause.kind() == std::io::ErrorKind::NotFound => Ok(Site::Gathered(pages)),
        Err(cause) => Err(XtaskError::start(Path::new(&arguments.mdbook), cause)),
    }
}
