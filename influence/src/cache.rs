//! Radial tables and coefficients kept: in memory for the run, on disk for the next.
//!
//! What determines the data, bit by bit, is hashed (BLAKE3) to the name of a file: the foundation, the side of an element, the size of
//! the grid, the version of the format and that of the algorithm. A file is written under a temporary name and renamed, and has a
//! checksum, so any number of threads and processes may use one folder at once, and what is damaged, cut off or not the cache's own is
//! computed again. Nothing about the cache is ever an error: at worst there is none.

pub(crate) mod encoding;
mod file;
mod folder;
mod key;
mod memory;
mod origin;
mod recipe;
mod warning;

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use pellicle_kernel::Foundation;

use self::encoding::Decoder;
use self::folder::Folder;
use self::key::Key;
use self::memory::Memory;
use self::recipe::{CoefficientsOf, Recipe, TablesOf};
use crate::{CoefficientTable, InfluenceError, RadialTables};

pub use folder::Usage;
pub use origin::{Cached, Origin};
pub use warning::{CacheWarning, FileFault};

/// Keeps [`RadialTables`] and [`CoefficientTable`]s; clones share what they keep.
///
/// ```
/// use pellicle_influence::{Cache, Origin};
/// use pellicle_kernel::{Foundation, Material};
///
/// let (coating, steel) = (Material::new(400e9, 0.25)?, Material::new(210e9, 0.3)?);
/// let cache = Cache::in_memory();
/// let tables = cache.radial_tables(&Foundation::coated(2e-6, coating, steel)?)?.value;
/// let first = cache.coefficients(&tables, 1e-6, 128)?;
/// let again = cache.coefficients(&tables, 1e-6, 128)?;
/// assert_eq!([first.origin, again.origin], [Origin::Computed, Origin::Memory]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Cache(Arc<Parts>);

#[derive(Debug)]
struct Parts {
    memory: Option<Memory>,
    folder: Option<Folder>,
    smallest: usize,
    warnings: Mutex<Vec<CacheWarning>>,
}

impl Cache {
    /// Smallest number of elements a side, N, for which a table of coefficients is kept on disk.
    ///
    /// *Measured* with `cargo bench -p pellicle-influence --bench cache`: µs to have the table, the fastest of 20 samples, one thread, a
    /// 2-core machine with other work on it, files in the system's page cache.
    ///
    /// | N | computed, coated body | computed, homogeneous body | read |
    /// |---|---|---|---|
    /// | 4 | 43 | 2.9 | 7.3 |
    /// | 8 | 70 | 8.6 | 7.7 |
    /// | 16 | 89 | 20 | 8.9 |
    /// | 32 | 147 | 50 | 13 |
    /// | 128 | 1,130 | 160 | 39 |
    /// | 512 | 14,000 | 1,600 | 420 |
    /// | 1024 | 67,000 | 5,600 | 1,900 |
    /// | 2048 | 270,000 | 30,000 | 9,000 |
    ///
    /// So the border of a homogeneous body lies at N = 8. A coated body has none, but below N = 16 its tables take no longer than creating a
    /// file does, 40 to 150 µs. Radial tables take 11,000 µs to build and 68 µs to read; those of a homogeneous body are empty and never
    /// written.
    pub const SMALLEST_STORED: usize = 16;

    /// Keeps nothing.
    #[must_use]
    pub fn none() -> Self {
        Self::new(None, None, Self::SMALLEST_STORED)
    }

    /// Keeps up to 256 MB in memory for as long as it or a clone lives; what was not used for longest goes first.
    #[must_use]
    pub fn in_memory() -> Self {
        Self::new(Some(Memory::default()), None, Self::SMALLEST_STORED)
    }

    /// Keeps in memory and in this folder, which is created when there is something to write.
    ///
    /// If the folder or the disk refuses something, there is a warning, and the folder is not written to again.
    #[must_use]
    pub fn at(folder: impl Into<PathBuf>) -> Self {
        Self::storing_from(Self::SMALLEST_STORED, folder)
    }

    /// As [`Self::at`], with another border than [`Self::SMALLEST_STORED`]: to find out where it lies on other machines.
    #[must_use]
    pub fn storing_from(smallest: usize, folder: impl Into<PathBuf>) -> Self {
        let folder = Folder::new(folder.into());
        Self::new(Some(Memory::default()), Some(folder), smallest)
    }

    fn new(memory: Option<Memory>, folder: Option<Folder>, smallest: usize) -> Self {
        Self(Arc::new(Parts {
            memory,
            folder,
            smallest,
            warnings: Mutex::default(),
        }))
    }

    /// The radial tables of a foundation.
    ///
    /// # Errors
    ///
    /// As [`RadialTables::build`]; the cache adds none.
    pub fn radial_tables(
        &self,
        foundation: &Foundation,
    ) -> Result<Cached<Arc<RadialTables>>, InfluenceError> {
        self.get(&TablesOf(foundation))
    }

    /// The coefficients of the `size` × `size` elements of side `element_side` (m) of one grid.
    ///
    /// # Errors
    ///
    /// As [`CoefficientTable::assemble`]; the cache adds none.
    pub fn coefficients(
        &self,
        tables: &RadialTables,
        element_side: f64,
        size: usize,
    ) -> Result<Cached<Arc<CoefficientTable>>, InfluenceError> {
        let recipe = CoefficientsOf::new(tables, element_side, size)?;
        if tables.is_perturbed() {
            let value = Arc::new(recipe.compute()?);
            let origin = Origin::Computed;
            return Ok(Cached { value, origin });
        }
        self.get(&recipe)
    }

    /// The folder on disk, if there is to be one.
    #[must_use]
    pub fn folder(&self) -> Option<&Path> {
        self.0.folder.as_ref().map(Folder::path)
    }

    /// What has gone wrong on disk since this was last asked, in order.
    #[must_use]
    pub fn take_warnings(&self) -> Vec<CacheWarning> {
        std::mem::take(
            &mut *self
                .0
                .warnings
                .lock()
                .unwrap_or_else(PoisonError::into_inner),
        )
    }

    /// Files and bytes on disk.
    ///
    /// # Errors
    ///
    /// What the system says if the folder cannot be listed; a folder that is not there yet is empty.
    pub fn usage(&self) -> std::io::Result<Usage> {
        self.0
            .folder
            .as_ref()
            .map_or(Ok(Usage::default()), Folder::usage)
    }

    /// Removes the cache's own files from the folder, and nothing else; says what was removed. What is in memory stays.
    ///
    /// # Errors
    ///
    /// What the system says if a file cannot be removed.
    pub fn clear(&self) -> std::io::Result<Usage> {
        self.0
            .folder
            .as_ref()
            .map_or(Ok(Usage::default()), Folder::clear)
    }

    fn get<R: Recipe>(&self, recipe: &R) -> Result<Cached<Arc<R::Product>>, InfluenceError> {
        let key = recipe.key();
        let shelf = self.0.memory.as_ref().map(R::shelf);
        if let Some(value) = shelf.and_then(|shelf| shelf.take_down(&key)) {
            return Ok(Cached {
                value,
                origin: Origin::Memory,
            });
        }
        let found = self.read_or_compute(recipe, &key)?.map(Arc::new);
        if let Some(shelf) = shelf {
            shelf.put_up(key, &found.value, recipe.largest_payload());
        }
        Ok(found)
    }

    fn read_or_compute<R: Recipe>(
        &self,
        recipe: &R,
        key: &Key,
    ) -> Result<Cached<R::Product>, InfluenceError> {
        if recipe.is_immediate(self.0.smallest) {
            return Ok(Cached {
                value: recipe.compute()?,
                origin: Origin::Immediate,
            });
        }
        if let Some(value) = self.read(recipe, key) {
            return Ok(Cached {
                value,
                origin: Origin::Disk,
            });
        }
        let value = recipe.compute()?;
        self.write(key, || R::encode(&value));
        Ok(Cached {
            value,
            origin: Origin::Computed,
        })
    }

    fn read<R: Recipe>(&self, recipe: &R, key: &Key) -> Option<R::Product> {
        let folder = self.0.folder.as_ref()?;
        let decode = |decoder: &mut Decoder<'_>| recipe.decode(decoder);
        let read = folder.read(key, recipe.largest_payload(), decode);
        read.unwrap_or_else(|warning| {
            self.warn(warning);
            None
        })
    }

    fn write(&self, key: &Key, payload: impl FnOnce() -> Vec<u8>) {
        if let Some(Err(warning)) = self
            .0
            .folder
            .as_ref()
            .map(|folder| folder.write(key, payload))
        {
            self.warn(warning);
        }
    }

    fn warn(&self, warning: CacheWarning) {
        self.0
            .warnings
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .push(warning);
    }
}
