//! The program's errors as exceptions: one class for each error enum, with the program's message and the fields as
//! attributes.

mod attributes;

use std::any::Any;

use pellicle::input::diagnosis::Diagnosis;
use pellicle_cli::Failure;
use pyo3::exceptions::PyException;
use pyo3::prelude::*;
use pyo3::{IntoPyObjectExt, create_exception};

create_exception!(
    pellicle,
    Error,
    PyException,
    "Any error in reading or solving a case."
);
create_exception!(
    pellicle,
    CaseError,
    Error,
    "A case is wrong at one place: `key`, `line`, `found`, `wanted` and `help` state where and how."
);
create_exception!(
    pellicle,
    KernelError,
    Error,
    "The elastic body is refused, or has no compliance. Its attributes, as far as its message states them, are \
     `found`, `largest`, `layer`, `layers`, `reached`, `s`, `smallest`, `sublayers` and `wanted`."
);
create_exception!(
    pellicle,
    InfluenceError,
    Error,
    "The influence coefficients cannot be computed. Its attributes, as far as its message states them, are `at`, \
     `found`, `largest`, `layer`, `layers`, `lower`, `offset`, `radius`, `reached`, `s`, `smallest`, \
     `sublayers`, `upper` and `wanted`."
);
create_exception!(
    pellicle,
    TextureError,
    Error,
    "The surface is refused. Its attributes, as far as its message states them, are `found`, `index`, `largest`, \
     `period`, `quantity`, `radius` and `shape`."
);
create_exception!(
    pellicle,
    IndenterError,
    Error,
    "The indenter is refused. Its attributes, as far as its message states them, are `found`, `least`, `most` \
     and `quantity`."
);
create_exception!(
    pellicle,
    ContactError,
    Error,
    "The contact cannot be posed or solved. Its attributes, as far as its message states them, are `area`, `at`, \
     `element`, `element_side`, `elements`, `field`, `force`, `found`, `index`, `largest`, `layer`, `layers`, \
     `least`, `lower`, `most`, `offset`, `penetration`, `period`, `quantity`, `radius`, `reached`, `s`, \
     `shape`, `side`, `smallest`, `step`, `sublayers`, `tolerance`, `trials`, `upper`, `wanted` and `worst`."
);
create_exception!(
    pellicle,
    IdentifyError,
    Error,
    "A fit cannot be posed or made. Its attributes, as far as its message states them, are `curve`, `found`, \
     `list`, `name`, `point`, `points`, `predictions`, `quantity`, `size`, `starts` and `wanted`."
);
create_exception!(
    pellicle,
    RunError,
    Error,
    "A case cannot be run: a file cannot be read, or there is too little memory. Its attributes, as far as its message \
     states them, are `available`, `bottom`, `found`, `last`, `needed`, `path` and `reason`."
);
create_exception!(
    pellicle,
    InternalError,
    Error,
    "An error of the program itself, which should not occur."
);

/// A failure of the program, to be raised in Python.
#[derive(Debug)]
pub struct Refusal(Failure);

impl<E: Into<Failure>> From<E> for Refusal {
    fn from(error: E) -> Self {
        Self(error.into())
    }
}

impl From<Refusal> for PyErr {
    fn from(Refusal(failure): Refusal) -> Self {
        Python::attach(|py| {
            let error = exception(&failure);
            match &failure {
                Failure::Case(pellicle::Error::Case(diagnosis)) => describe(py, &error, diagnosis),
                other => attributes::set(py, error.value(py), other),
            }
            // The error matters more than an attribute that cannot be set.
            .unwrap_or_default();
            error
        })
    }
}

/// The exception of the failure's class, with the program's message.
fn exception(failure: &Failure) -> PyErr {
    let message = failure.to_string();
    match failure {
        Failure::Case(error) => exception_of_case(error, message),
        Failure::Inside(_) => InfluenceError::new_err(message),
        Failure::Identify(_) | Failure::NotPlanned(_) => IdentifyError::new_err(message),
        _ => RunError::new_err(message),
    }
}

fn exception_of_case(error: &pellicle::Error, message: String) -> PyErr {
    use pellicle::Error;
    match error {
        Error::Case(_) => CaseError::new_err(message),
        Error::Kernel(_) => KernelError::new_err(message),
        Error::Influence(_) => InfluenceError::new_err(message),
        Error::Texture(_) => TextureError::new_err(message),
        Error::Indenter(_) => IndenterError::new_err(message),
        Error::Contact(_) => ContactError::new_err(message),
        _ => RunError::new_err(message),
    }
}

fn describe(py: Python<'_>, error: &PyErr, diagnosis: &Diagnosis) -> PyResult<()> {
    let (found, wanted) = (diagnosis.fault.found(), diagnosis.fault.wanted());
    let attributes = [
        ("key", diagnosis.key.as_ref().into_py_any(py)?),
        ("line", diagnosis.span.line().into_py_any(py)?),
        ("found", found.into_py_any(py)?),
        ("wanted", wanted.into_py_any(py)?),
        ("help", diagnosis.help.as_ref().into_py_any(py)?),
    ];
    let value = error.value(py);
    for (name, attribute) in attributes {
        value.setattr(name, attribute)?;
    }
    if let Some(help) = &diagnosis.help {
        value.call_method1("add_note", (format!("help: {help}"),))?;
    }
    Ok(())
}

/// The exception from a caller's function that unwound the work, or else an exception with the message of a panic.
pub fn of_panic(panic: Box<dyn Any + Send>) -> PyErr {
    let exception = panic.downcast::<PyErr>().map(|error| *error);
    exception.unwrap_or_else(|panic| of_mistake(&*panic))
}

fn of_mistake(panic: &(dyn Any + Send)) -> PyErr {
    let message = panic.downcast_ref::<String>().map(String::as_str);
    let message = message.or_else(|| panic.downcast_ref::<&str>().copied());
    let message = message.unwrap_or("unknown");
    InternalError::new_err(format!(
        "an error of the program itself, please report it: {message}"
    ))
}
