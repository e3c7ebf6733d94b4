//! The command line of `explore`.

use std::path::PathBuf;

use clap::Args;

/// Arguments of `explore`.
#[derive(Debug, Args)]
pub struct ExploreArguments {
    /// The case file [default: choose one of the templates of `init` on the page]
    #[arg(value_name = "CASE")]
    pub case: Option<PathBuf>,
    /// The port of this machine at which the page is [default: a free one]
    #[arg(long, value_name = "PORT", value_parser = clap::value_parser!(u16).range(1..))]
    pub port: Option<u16>,
    /// Print the address of the page and open no browser
    #[arg(long)]
    pub no_browser: bool,
}
