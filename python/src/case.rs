//! A case, read by the program's own reader.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use numpy::{PyReadonlyArray2, PyUntypedArrayMethods};
use pellicle::case::map_sources::MapSources;
use pellicle::case::parts::Part;
use pellicle::declare::Shape;
use pellicle::declare::keys;
use pellicle::display::{self, Unit};
use pellicle::input::dimension::Dimension;
use pellicle::input::quantity;
use pellicle::input::source_file::read as read_source;
use pellicle::input::span::{CALL, Source};
use pellicle::input::units::Units;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::error::Refusal;
use crate::function::{Functions, with_functions};
use crate::process::Threads;
use crate::run::Run;

/// Reads the text of a case file.
#[pyfunction]
#[expect(
    clippy::needless_pass_by_value,
    reason = "Python hands over a path of its own"
)]
pub fn read_text(path: PathBuf) -> Result<String, Refusal> {
    Ok(read_source(&path)?.inner().clone())
}

/// The data that a case refers to but does not contain: maps, as named arrays or else files of the folder, and shapes
/// given by functions.
pub fn map_sources(
    folder: &Path,
    arrays: BTreeMap<String, PyReadonlyArray2<'_, f64>>,
    functions: &Functions,
) -> MapSources {
    let mut maps = MapSources::in_folder(folder);
    for (name, array) in arrays {
        let shape = [array.shape()[0], array.shape()[1]];
        // Row by row, whatever their order in memory.
        let heights = array.as_array().iter().copied().collect();
        maps = maps.with_array(&name, shape, heights);
    }
    with_functions(maps, functions)
}

/// Checks the text of the table of a part of a case, made by a call named `call`.
#[pyfunction]
pub fn check_part(part: &str, call: &str, text: String) -> Result<(), Refusal> {
    let mut names = Part::NAMES.iter();
    if let Some((_, part)) = names.find(|(name, _)| *name == part) {
        part.check(&Arc::new(Source::new(format!("{call}{CALL}"), text)))?;
    }
    Ok(())
}

/// The SI unit of each key of a case that is a quantity.
#[pyfunction]
pub fn key_units() -> BTreeMap<&'static str, &'static str> {
    keys::si_units(&pellicle::Case::shape())
}

/// The SI unit of the key at a path of a case, such as `foundation.layer.0.thickness`; `None` if it is no quantity.
#[pyfunction]
#[expect(
    clippy::needless_pass_by_value,
    reason = "Python hands over a list of its own"
)]
pub fn key_unit(path: Vec<String>) -> Option<&'static str> {
    let shape = pellicle::Case::shape();
    let mut shapes = keys::at(&shape, &path).into_iter();
    shapes.find_map(Shape::dimension).map(Dimension::si_unit)
}

/// The number of SI units `unit` in a quantity with a unit, or else the reason why it is none.
#[pyfunction]
pub fn si_value(text: &str, unit: &str) -> PyResult<f64> {
    let dimension = Dimension::ALL
        .into_iter()
        .find(|dimension| dimension.si_unit() == unit);
    let dimension = dimension.ok_or_else(|| PyValueError::new_err("no string has this unit"))?;
    quantity::parse(text, dimension).map_err(|error| PyValueError::new_err(error.to_string()))
}

/// A number with its unit, rounded for reading.
#[pyfunction]
pub fn number_text(value: f64, unit: &str, is_si: bool) -> String {
    let units = if is_si { Units::Si } else { Units::Consistent };
    let unit = Unit::ALL.iter().find(|of| of.ascii() == unit);
    match unit {
        Some(unit) => display::quantity(value, *unit, units),
        None => display::significant(value, 5),
    }
}

/// A case, read and checked.
#[pyclass(frozen, module = "pellicle._pellicle")]
pub struct Case {
    case: Arc<pellicle::Case>,
    has_functions: bool,
}

impl Case {
    /// The case itself.
    pub fn inner(&self) -> &pellicle::Case {
        &self.case
    }
}

#[pymethods]
impl Case {
    /// Reads a text named `source`; `name` is the default title. Maps are taken from `arrays`, or else from files of
    /// `folder`, and shapes of kind `function` from `functions`.
    #[new]
    #[expect(
        clippy::needless_pass_by_value,
        reason = "Python hands over a path of its own"
    )]
    fn new(
        py: Python<'_>,
        text: String,
        source: String,
        name: &str,
        folder: PathBuf,
        arrays: BTreeMap<String, PyReadonlyArray2<'_, f64>>,
        functions: Functions,
    ) -> PyResult<Self> {
        let maps = map_sources(&folder, arrays, &functions);
        let source = Arc::new(Source::new(source, text));
        let case = Threads::work(py, || pellicle::Case::parse_with(&source, name, &maps))?
            .map_err(Refusal::from)?;
        Ok(Self {
            case: Arc::new(case),
            has_functions: !functions.is_empty(),
        })
    }

    /// Whether a value has a unit, so that numbers are in SI units.
    fn is_si(&self) -> bool {
        Units::of(self.case.document.root()) == Units::Si
    }

    /// The resolved case, with every default filled in, as JSON.
    fn resolved(&self) -> Result<String, Refusal> {
        Ok(serde_json::to_string(&*self.case)?)
    }

    /// Whether the cases are equal, ignoring functions.
    fn __eq__(&self, other: &Self) -> bool {
        self.case == other.case
    }

    /// Starts solving the case, on this many threads.
    #[pyo3(signature = (threads = None))]
    fn start(&self, threads: Option<u16>) -> Result<Run, Refusal> {
        let case = Arc::clone(&self.case);
        Ok(Run::start(case, self.has_functions, threads)?)
    }
}
