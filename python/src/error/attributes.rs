//! The fields of an error as attributes of its exception, by their names.

use std::path::PathBuf;

use pellicle_cli::Failure;
use pellicle_contact::{ContactError, IndenterError, IndenterQuantity};
use pellicle_files::FileError;
use pellicle_identify::IdentifyError;
use pellicle_influence::InfluenceError;
use pellicle_kernel::KernelError;
use pellicle_texture::{Quantity, TextureError};
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;

/// A field of an error that Python can hold.
trait Attribute {
    fn object(&self, py: Python<'_>) -> PyResult<Py<PyAny>>;
}

/// Implements `Attribute` for types with a direct Python equivalent.
macro_rules! known {
    ($($kind:ty),*) => {$(
        impl Attribute for $kind {
            fn object(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
                self.clone().into_py_any(py)
            }
        }
    )*};
}

known!(f64, usize, u64, &'static str, String, PathBuf);

/// Implements `Attribute` for types that are converted to strings.
macro_rules! words {
    ($($kind:ty),*) => {$(
        impl Attribute for $kind {
            fn object(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
                self.to_string().into_py_any(py)
            }
        }
    )*};
}

words!(Quantity, IndenterQuantity);

impl Attribute for [usize; 2] {
    fn object(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        (self[0], self[1]).into_py_any(py)
    }
}

/// Sets the named fields of each variant; none of other variants.
macro_rules! fields {
    ($py:ident, $value:ident, $error:expr, $kind:ident { $($variant:ident { $($field:ident),+ }),+ $(,)? }) => {
        match $error {
            $($kind::$variant { $($field,)+ .. } => {
                $($value.setattr(stringify!($field), $field.object($py)?)?;)+
            })+
            _ => {}
        }
    };
}

/// Sets the attributes of a failure.
pub fn set(py: Python<'_>, value: &Bound<'_, PyAny>, failure: &Failure) -> PyResult<()> {
    match failure {
        Failure::Case(error) => of_case(py, value, error)?,
        Failure::File(error) => fields!(py, value, error, FileError {
            Write { path },
            Damaged { path, reason },
        }),
        Failure::Inside(error) => of_influence(py, value, error)?,
        Failure::Identify(error) => of_identify(py, value, error)?,
        other => fields!(py, value, other, Failure {
            InRigidBase { found, bottom },
            NoStep { found, last },
        }),
    }
    Ok(())
}

fn of_case(py: Python<'_>, value: &Bound<'_, PyAny>, error: &pellicle::Error) -> PyResult<()> {
    use pellicle::Error;
    match error {
        Error::Kernel(error) => of_kernel(py, value, error)?,
        Error::Influence(error) => of_influence(py, value, error)?,
        Error::Texture(error) => of_texture(py, value, error)?,
        Error::Indenter(error) => of_indenter(py, value, error)?,
        Error::Contact(error) => of_contact(py, value, error)?,
        other => fields!(py, value, other, Error {
            Unreadable { path },
            Memory { needed, available },
        }),
    }
    Ok(())
}

fn of_kernel(py: Python<'_>, value: &Bound<'_, PyAny>, error: &KernelError) -> PyResult<()> {
    fields!(py, value, error, KernelError {
        YoungModulus { found },
        PoissonRatio { found },
        Thickness { found },
        NormalCompliance { found },
        ShearCompliance { found },
        TotalThickness { layers, found },
        ModulusRatio { layer, found, smallest, largest },
        Wavenumber { found },
        Singular { s },
        Grading { sublayers, reached, wanted },
        NoBody { found, layers },
    });
    Ok(())
}

fn of_influence(py: Python<'_>, value: &Bound<'_, PyAny>, error: &InfluenceError) -> PyResult<()> {
    if let InfluenceError::Kernel(error) = error {
        return of_kernel(py, value, error);
    }
    fields!(py, value, error, InfluenceError {
        ElementSide { found },
        Depth { found, largest },
        TableSize { found, largest },
        CoefficientNotFinite { offset, found },
        IntegrandNotFinite { at, lower, upper },
        IntegrationLimits { lower, upper },
        QuadratureTolerance { lower, upper, wanted, found },
        TooManyOscillations { found, largest },
        LayerThicknesses { found, largest },
        TableAccuracy { wanted, found, radius },
    });
    Ok(())
}

fn of_texture(py: Python<'_>, value: &Bound<'_, PyAny>, error: &TextureError) -> PyResult<()> {
    fields!(py, value, error, TextureError {
        NotPositive { quantity, found },
        Negative { quantity, found },
        NoHeight { found },
        NotFinite { quantity, found },
        GridSize { found, largest },
        Overlap { radius, period },
        MapShape { shape, found },
        MapSample { index, found },
    });
    Ok(())
}

fn of_indenter(py: Python<'_>, value: &Bound<'_, PyAny>, error: &IndenterError) -> PyResult<()> {
    fields!(py, value, error, IndenterError {
        NotPositive { quantity, found },
        Negative { quantity, found },
        Angle { quantity, found },
        FaceCount { found, least, most },
    });
    Ok(())
}

fn of_contact(py: Python<'_>, value: &Bound<'_, PyAny>, error: &ContactError) -> PyResult<()> {
    match error {
        ContactError::Texture(error) => return of_texture(py, value, error),
        ContactError::Indenter(error) => return of_indenter(py, value, error),
        ContactError::Influence(error) => return of_influence(py, value, error),
        other => fields!(py, value, other, ContactError {
            Force { force },
            Penetration { penetration },
            ContactRadius { radius },
            Tolerance { tolerance },
            FieldLength { field, found, wanted },
            FieldValue { field, element, wanted, found },
            ElementArea { area },
            TooLargeForActiveSet { elements, largest },
            NotPositiveDefinite { elements },
            NothingCanTouch { elements },
            Cancelled { step },
            ElementsTooLarge { side, element_side, radius, wanted },
            DomainTooSmall { side, trials },
            NotCertified { force, worst },
        }),
    }
    Ok(())
}

fn of_identify(py: Python<'_>, value: &Bound<'_, PyAny>, error: &IdentifyError) -> PyResult<()> {
    fields!(py, value, error, IdentifyError {
        Number { quantity, found, wanted },
        NumberOf { name, quantity, found, wanted },
        Length { list, found, wanted },
        Point { list, point, found, wanted },
        NoTime { curve },
        Twice { name },
        TooFewPoints { points, wanted },
        NoStart { starts },
        Stopped { predictions },
        Decomposition { size },
    });
    Ok(())
}
