//! Radial tables and coefficients, kept in memory for this run and on disk for the next.
//!
//! The name of a file is a hash (BLAKE3) of everything that determines the data: every bit of the bodies and of the
//! side of an element, the size of the grid, and the version of the algorithm. A file is written under a temporary name
//! and renamed, and has a checksum. So any number of threads and processes may share one folder, and data in a damaged,
//! truncated or foreign file are computed again. The cache never causes an error: at worst nothing is cached.

mod disk;
mod memory;
mod report;
mod shape;

use std::fmt::Debug;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use blake3::Hash;
use pellicle_kernel::Foundation;
use serde::Serialize;
use serde::de::DeserializeOwned;

use self::disk::Disk;
use self::memory::Memory;
use crate::radial::{RadialFunctions, accurate_functions};
use crate::{CoefficientTable, ElasticBodies, ElasticBody, InfluenceError, RadialTables};

pub use report::{CacheWarning, Cached, Origin, Usage};

/// Version of the cached numbers and structs. Raise it whenever either changes: when a coefficient or a number of the
/// radial tables may change by a single bit, because the arithmetic, tolerances or panels of this crate or of the
/// kernel change, or when a struct gains a field. The test `changed_numbers_need_a_new_version` in this
/// crate's `tests/cache/contents.rs` detects most such changes.
const VERSION: u32 = 4;

/// Bytes in memory for each kind of data: enough for the coefficients of grids of up to 8000² elements together, for
/// which a solver needs a hundred times as much.
const LIMIT: usize = 1 << 28;

/// Largest size of radial tables in bytes: twenty times the largest seen.
const LARGEST_TABLES: usize = 1 << 21;

/// A cache of [`RadialTables`] and [`CoefficientTable`]s; clones share their contents.
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
    functions: Memory<RadialFunctions>,
    coefficients: Memory<CoefficientTable>,
    disk: Option<Disk>,
    smallest: usize,
    /// Whether radial tables are shared by foundations of the same shape.
    by_shape: bool,
    warnings: Mutex<Vec<CacheWarning>>,
}

impl Cache {
    /// Smallest number of elements per side, N, for which tables of coefficients are kept on disk.
    ///
    /// Measured with `cargo bench -p pellicle-influence --bench cache`: below N = 8 computing a homogeneous body's
    /// table is faster than reading it. A coated body's is always faster to read, but below N = 16 computing it takes
    /// no longer than creating a file.
    pub const SMALLEST_STORED: usize = 16;

    /// A cache that keeps nothing.
    #[must_use]
    pub fn none() -> Self {
        Self::new(0, None, Self::SMALLEST_STORED, false)
    }

    /// A cache that keeps up to 256 MB in memory while it or a clone lives; the least recently used
    /// data are dropped first.
    #[must_use]
    pub fn in_memory() -> Self {
        Self::new(LIMIT, None, Self::SMALLEST_STORED, false)
    }

    /// As [`Self::in_memory`], for many foundations of few shapes, as in a fit: radial tables depend only on the ratios
    /// of moduli and thicknesses and on Poisson's ratios, so a foundation of another size or stiffness finds them in
    /// memory. The ratios, and with them the coefficients, are rounded to a relative 1e-12; coefficients are not kept.
    #[must_use]
    pub fn of_shapes() -> Self {
        Self::new(LIMIT, None, Self::SMALLEST_STORED, true)
    }

    /// A cache in memory and in this folder, which is created at the first write.
    ///
    /// If the folder or the disk refuses a write, there is a warning, and the folder is not written to again.
    #[must_use]
    pub fn at(folder: impl Into<PathBuf>) -> Self {
        Self::storing_from(Self::SMALLEST_STORED, folder)
    }

    /// As [`Self::at`], with another threshold than [`Self::SMALLEST_STORED`]: to find the best one on other machines.
    #[must_use]
    pub fn storing_from(smallest: usize, folder: impl Into<PathBuf>) -> Self {
        Self::storing_at_most(u64::MAX, smallest, folder)
    }

    /// As [`Self::storing_from`], and never writes more than so many bytes: for many foundations, each of which leaves
    /// some 100 kB of radial tables.
    #[must_use]
    pub fn storing_at_most(bytes: u64, smallest: usize, folder: impl Into<PathBuf>) -> Self {
        let disk = Disk::new(folder.into(), bytes);
        Self::new(LIMIT, Some(disk), smallest, false)
    }

    fn new(limit: usize, disk: Option<Disk>, smallest: usize, by_shape: bool) -> Self {
        Self(Arc::new(Parts {
            functions: Memory::new(limit),
            coefficients: Memory::new(if by_shape { 0 } else { limit }),
            disk,
            smallest,
            by_shape,
            warnings: Mutex::default(),
        }))
    }

    /// The radial tables of a foundation.
    ///
    /// # Errors
    ///
    /// Those of [`RadialTables::build`]; the cache adds none.
    pub fn radial_tables(
        &self,
        foundation: &Foundation,
    ) -> Result<Cached<Arc<RadialTables>>, InfluenceError> {
        self.radial_tables_of(&foundation.clone().into())
    }

    /// The radial tables of a foundation under a counterbody.
    ///
    /// # Errors
    ///
    /// Those of [`RadialTables::of_bodies`]; the cache adds none.
    pub fn radial_tables_of(
        &self,
        bodies: &ElasticBodies,
    ) -> Result<Cached<Arc<RadialTables>>, InfluenceError> {
        let [foundation, counterbody] = bodies.each();
        let [own, other] = [self.functions(foundation)?, self.functions(counterbody)?];
        Ok(Cached {
            value: Arc::new(RadialTables::new(bodies, [own.value, other.value])?),
            origin: own.origin.max(other.origin),
        })
    }

    /// The same, without tabulating a body again that is one of these tables'.
    ///
    /// # Errors
    ///
    /// As [`Self::radial_tables_of`].
    pub fn radial_tables_like(
        &self,
        known: &RadialTables,
        bodies: &ElasticBodies,
    ) -> Result<Arc<RadialTables>, InfluenceError> {
        let functions = |body: ElasticBody| {
            if known.bodies().of(body) == bodies.of(body) {
                return Ok(known.functions(body).cloned());
            }
            self.functions(bodies.of(body)).map(|found| found.value)
        };
        let [own, other] = ElasticBody::ALL.map(functions);
        Ok(Arc::new(RadialTables::new(bodies, [own?, other?])?))
    }

    /// The radial functions of one body; none if it is homogeneous or rigid.
    fn functions(
        &self,
        body: &Foundation,
    ) -> Result<Cached<Option<Arc<RadialFunctions>>>, InfluenceError> {
        if !RadialTables::has_functions(body) {
            let (value, origin) = (None, Origin::Immediate);
            return Ok(Cached { value, origin });
        }
        let shape = self.0.by_shape.then(|| shape::of(body)).transpose()?;
        let tabulated = shape.as_ref().unwrap_or(body);
        let request = Request {
            key: key("radial tables", tabulated),
            bytes: LARGEST_TABLES,
            is_immediate: false,
        };
        let compute = || accurate_functions(tabulated);
        let functions = self.get(&self.0.functions, &request, compute)?;
        Ok(functions.map(Some))
    }

    /// The coefficients of the `size` × `size` elements of side `element_side` (m) of one grid.
    ///
    /// # Errors
    ///
    /// Those of [`CoefficientTable::assemble`]; the cache adds none.
    pub fn coefficients(
        &self,
        tables: &RadialTables,
        element_side: f64,
        size: usize,
    ) -> Result<Cached<Arc<CoefficientTable>>, InfluenceError> {
        let bytes = CoefficientTable::bytes(element_side, size)?;
        let compute = || CoefficientTable::assemble(tables, element_side, size);
        if tables.is_perturbed() {
            let (value, origin) = (Arc::new(compute()?), Origin::Computed);
            return Ok(Cached { value, origin });
        }
        let grid = format!("coefficients, {size} elements of {element_side:?}");
        let request = Request {
            key: key(&grid, tables.bodies()),
            bytes,
            is_immediate: size < self.0.smallest,
        };
        self.get(&self.0.coefficients, &request, compute)
    }

    /// The folder on disk, if there is one.
    #[must_use]
    pub fn folder(&self) -> Option<&Path> {
        self.0.disk.as_ref().map(Disk::path)
    }

    /// The warnings since the last call, in order.
    #[must_use]
    pub fn take_warnings(&self) -> Vec<CacheWarning> {
        std::mem::take(&mut self.warnings())
    }

    /// Files and bytes on disk.
    ///
    /// # Errors
    ///
    /// The system's error if the folder cannot be listed; a missing folder counts as empty.
    pub fn usage(&self) -> std::io::Result<Usage> {
        let disk = self.0.disk.as_ref();
        disk.map_or(Ok(Usage::default()), Disk::usage)
    }

    /// Removes the cache's own files from the folder, and nothing else, and returns their number and size.
    /// Memory is not affected.
    ///
    /// # Errors
    ///
    /// The system's error if a file cannot be removed.
    pub fn clear(&self) -> std::io::Result<Usage> {
        let disk = self.0.disk.as_ref();
        disk.map_or(Ok(Usage::default()), Disk::clear)
    }

    fn get<T: Serialize + DeserializeOwned>(
        &self,
        memory: &Memory<T>,
        request: &Request,
        compute: impl FnOnce() -> Result<T, InfluenceError>,
    ) -> Result<Cached<Arc<T>>, InfluenceError> {
        if let Some(value) = memory.get(&request.key) {
            let origin = Origin::Memory;
            return Ok(Cached { value, origin });
        }
        let found = self.read_or_compute(request, compute)?.map(Arc::new);
        memory.insert(request.key, &found.value, request.bytes);
        Ok(found)
    }

    fn read_or_compute<T: Serialize + DeserializeOwned>(
        &self,
        request: &Request,
        compute: impl FnOnce() -> Result<T, InfluenceError>,
    ) -> Result<Cached<T>, InfluenceError> {
        if request.is_immediate {
            let (value, origin) = (compute()?, Origin::Immediate);
            return Ok(Cached { value, origin });
        }
        let Some(disk) = &self.0.disk else {
            let (value, origin) = (compute()?, Origin::Computed);
            return Ok(Cached { value, origin });
        };
        if let Some(value) = self.or_warn(disk.read(&request.key, request.bytes)) {
            let origin = Origin::Disk;
            return Ok(Cached { value, origin });
        }
        let (value, origin) = (compute()?, Origin::Computed);
        self.or_warn(disk.write(&request.key, &value));
        Ok(Cached { value, origin })
    }

    /// The result of a disk operation, or the default if it failed; then a warning is kept for [`Self::take_warnings`].
    fn or_warn<T: Default>(&self, outcome: Result<T, CacheWarning>) -> T {
        outcome.unwrap_or_else(|warning| {
            self.warnings().push(warning);
            T::default()
        })
    }

    fn warnings(&self) -> MutexGuard<'_, Vec<CacheWarning>> {
        let warnings = self.0.warnings.lock();
        warnings.unwrap_or_else(PoisonError::into_inner)
    }
}

/// Data that may be cached.
struct Request {
    key: Hash,
    /// Their size in bytes, or a bound.
    bytes: usize,
    /// Whether computing them takes no longer than reading.
    is_immediate: bool,
}

/// The key of data: a hash of everything that determines them, every bit of the bodies (`Debug` writes the
/// shortest digits that identify one `f64`), the release, and the platform, whose exponentials and logarithms may
/// differ in the last bit.
fn key(data: &str, bodies: &impl Debug) -> Hash {
    const RELEASE: &str = concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION"));
    let platform = [std::env::consts::ARCH, std::env::consts::OS];
    let text = format!("{RELEASE}, {VERSION}, {platform:?}, {data}, {bodies:?}");
    blake3::hash(text.as_bytes())
}

#[cfg(test)]
mod tests {
    use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};

    use super::key;

    /// One layer on a half-space or a rigid base, with these parameters.
    fn foundation(numbers: [f64; 5], interface: Interface, is_rigid: bool) -> Foundation {
        let [thickness, e1, nu1, e2, nu2] = numbers;
        let material = |e, nu| Material::new(e, nu).unwrap();
        let layer = Layer::new(thickness, material(e1, nu1), interface).unwrap();
        let base = if is_rigid {
            Base::Rigid
        } else {
            Base::HalfSpace(material(e2, nu2))
        };
        Foundation::new(vec![layer], base).unwrap()
    }

    #[test]
    fn any_bit_of_the_foundation_changes_the_key() {
        let numbers = [1e-6, 400e9, 0.25, 210e9, 0.3];
        let mut foundations = vec![
            foundation(numbers, Interface::Bonded, false),
            foundation(numbers, Interface::Frictionless, false),
            foundation(numbers, Interface::Bonded, true),
        ];
        for i in 0..numbers.len() {
            let mut other = numbers;
            other[i] = other[i].next_up();
            foundations.push(foundation(other, Interface::Bonded, false));
        }
        let keys: Vec<_> = foundations.iter().map(|of| key("tables", of)).collect();
        for (i, key) in keys.iter().enumerate() {
            assert!(!keys[..i].contains(key), "{i}");
        }
        assert_eq!(key("tables", &foundations[0].clone()), keys[0]);
        assert_ne!(key("coefficients", &foundations[0]), keys[0]);
    }
}
