//! The cache of radial tables and coefficients, in the folder named by `PELLICLE_CACHE` or else in the platform's cache
//! folder.

use std::env;
use std::ffi::OsString;
use std::path::PathBuf;

#[cfg(not(test))]
use directories::ProjectDirs;
use pellicle_influence::{Cache, CacheWarning};

use crate::terminal;

/// The environment variable that names the folder; if empty, nothing is cached on disk.
pub const VARIABLE: &str = "PELLICLE_CACHE";

/// The cache of this run.
#[must_use]
pub fn open() -> Cache {
    folder(env::var_os(VARIABLE), platform_folder).map_or_else(Cache::in_memory, Cache::at)
}

/// The cache of a study: like [`open`], but tables of coefficients are kept on disk only for N ≥ 128. Cases that differ
/// in load or radius differ in element size: 20,000 cases of N = 32 would leave 39,000 files that take as long to write
/// and read as to compute. Radial tables of foundations, which cases share, are always kept, up to 10,000 of some 100
/// kB: a million cases with bodies of their own would leave 100 GB.
#[must_use]
pub fn open_for_many() -> Cache {
    const MIN_ELEMENTS: usize = 128;
    const MOST_BYTES: u64 = 1 << 30;
    let at = |folder: PathBuf| Cache::storing_at_most(MOST_BYTES, MIN_ELEMENTS, folder);
    folder(env::var_os(VARIABLE), platform_folder).map_or_else(Cache::in_memory, at)
}

/// Prints the warnings of the cache to standard error.
pub fn report_warnings(cache: &Cache) {
    let report = |warning: CacheWarning| terminal::report(&format!("warning: {warning}"));
    cache.take_warnings().into_iter().for_each(report);
}

/// The named folder; none if the name is empty, the platform's folder if there is no name.
fn folder(
    named: Option<OsString>,
    platform_folder: impl FnOnce() -> Option<PathBuf>,
) -> Option<PathBuf> {
    match named {
        Some(name) if name.is_empty() => None,
        Some(name) => Some(name.into()),
        None => platform_folder(),
    }
}

/// The tests of this crate leave nothing in the user's folder.
#[cfg(test)]
fn platform_folder() -> Option<PathBuf> {
    None
}

/// `~/.cache/pellicle`, `~/Library/Caches/pellicle` or `%LOCALAPPDATA%\pellicle\cache`; none without a home folder.
#[cfg(not(test))]
fn platform_folder() -> Option<PathBuf> {
    let folders = ProjectDirs::from("", "", "pellicle")?;
    Some(folders.cache_dir().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_variable_overrides_the_platform_folder_and_an_empty_one_disables_the_cache() {
        let platform = || Some("platform".into());
        assert_eq!(folder(None, platform), Some("platform".into()));
        assert_eq!(folder(Some("".into()), platform), None);
        assert_eq!(folder(Some("own".into()), platform), Some("own".into()));
        assert_eq!(folder(None, || None), None);
    }
}
