//! `pellicle explore`: a page in the browser on which the numbers of a case are changed and its answer follows.

use std::io;
use std::path::Path;
use std::process::{Command, Stdio};

use clap::ValueEnum;
use pellicle::input::source_file;
use pellicle_explore::{Ending, Server, Setup, Template as Start};
use pellicle_files::whole;

use crate::arguments::ExploreArguments;
use crate::command::Outcome;
use crate::failure::Failure;
use crate::output::summary_text;
use crate::templates::Template;
use crate::{cache, interrupt, terminal};

/// Serves the page until it is closed.
///
/// # Errors
///
/// [`Failure`] if the case cannot be read, or the port is taken.
pub fn explore(arguments: &ExploreArguments) -> Result<Outcome, Failure> {
    // The map of the rough templates.
    let maps = tempfile::tempdir().map_err(|cause| Failure::Page { cause })?;
    let (case, folder) = if let Some(path) = &arguments.case {
        (Some(opened(path)?), path.parent().unwrap_or(Path::new("")))
    } else {
        let map = maps.path().join("rough-surface.csv");
        whole::write_bytes(&map, Template::RoughMap.text().as_bytes())?;
        (None, maps.path())
    };
    let setup = Setup {
        case,
        templates: templates(),
        folder: folder.to_owned(),
        cache: cache::open_for_many(),
        critical: summary_text::stress::critical,
    };
    let failure = |cause| Failure::Page { cause };
    let server = Server::listen(arguments.port, setup).map_err(failure)?;
    let address = server.address();
    terminal::print(&format!("{address}\n"))?;
    terminal::report("the page ends with Ctrl-C, or when it is closed");
    if !arguments.no_browser && show(&address).is_err() {
        terminal::report("found no browser to open: open this address in one");
    }
    Ok(
        match server.serve(interrupt::is_requested).map_err(failure)? {
            Ending::PagesClosed => Outcome::Done,
            Ending::Stopped => Outcome::Stopped,
        },
    )
}

/// The case of a file.
fn opened(path: &Path) -> Result<Start, Failure> {
    let source = source_file::read(path)?;
    Ok(Start {
        name: path.display().to_string(),
        meaning: String::new(),
        text: source.inner().clone(),
    })
}

fn templates() -> Vec<Start> {
    let cases = Template::value_variants()
        .iter()
        .filter(|template| template.is_case());
    let start = |template: &Template| {
        let named = template.to_possible_value()?;
        let meaning = named
            .get_help()
            .map_or_else(String::new, ToString::to_string);
        let name = format!("{}.toml", named.get_name());
        Some(Start {
            name,
            meaning,
            text: template.text().into_owned(),
        })
    };
    cases.filter_map(start).collect()
}

/// Opens an address in the browser of the system.
fn show(address: &str) -> io::Result<()> {
    let (program, options): (_, &[&str]) = if cfg!(target_os = "macos") {
        ("open", &[])
    } else if cfg!(windows) {
        ("rundll32", &["url.dll,FileProtocolHandler"])
    } else {
        ("xdg-open", &[])
    };
    let mut browser = Command::new(program);
    browser.args(options).arg(address);
    browser
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    browser.spawn().map(drop)
}
