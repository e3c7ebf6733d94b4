//! The command line of `cargo xtask claims`.

use clap::Args;

use super::Claim;

/// Which claims are computed, and on which grids.
#[derive(Debug, Clone, Default, Args)]
pub struct ClaimsArguments {
    /// Only these claims: an id of docs/claims.toml, or how ids begin, up to a hyphen (repeatable, or separated by commas).
    #[arg(long, value_name = "ID", value_delimiter = ',')]
    pub only: Vec<String>,
    /// Coarser grids, for a look within two minutes; claims that need the fine ones are left out.
    #[arg(long)]
    pub quick: bool,
}

impl ClaimsArguments {
    /// Whether all claims are computed on their full grids.
    pub(super) fn is_everything(&self) -> bool {
        self.only.is_empty() && !self.quick
    }

    /// The grids on which a claim is evaluated; none if it needs finer ones than are asked for.
    pub(super) fn grids<'a>(&self, claim: &'a Claim) -> &'a [usize] {
        if self.quick {
            &claim.quick
        } else {
            &claim.elements
        }
    }
}
