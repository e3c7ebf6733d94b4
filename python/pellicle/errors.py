"""Exceptions: one class for each kind of error of the program, all of them an `Error`."""

from __future__ import annotations

import os
import pathlib
from collections.abc import Iterator
from contextlib import contextmanager

from ._pellicle import (
    CaseError,
    ContactError,
    Error,
    IdentifyError,
    IndenterError,
    InfluenceError,
    InternalError,
    KernelError,
    RunError,
    TextureError,
)

__all__ = [
    "ArgumentError",
    "CaseError",
    "ContactError",
    "Error",
    "FitWarning",
    "IdentifyError",
    "IndenterError",
    "InfluenceError",
    "InternalError",
    "KernelError",
    "NotCertifiedWarning",
    "RunError",
    "StudyWarning",
    "TextureError",
]


class ArgumentError(Error, ValueError):
    """An argument has the wrong type, shape or value; the message begins with its name."""


@contextmanager
def writing(path: str | os.PathLike[str]) -> Iterator[None]:
    """Raises a `RunError` with the `path` if the system refuses to write there."""
    try:
        yield
    except OSError as error:
        refused = RunError(f"{os.fspath(path)}: cannot be written: {error.strerror or error}")
        refused.path = pathlib.Path(path)
        raise refused from error


class _CodedWarning(UserWarning):
    """A warning with a code for programs."""

    def __init__(self, message: str, code: str) -> None:
        super().__init__(message)
        self.code = code
        """A word for programs."""

    def __reduce__(self) -> tuple[type[UserWarning], tuple[str, str]]:
        return type(self), (str(self), self.code)


class FitWarning(_CodedWarning):
    """A fit should not be used: its model does not fit the measurements, or it has not converged. Its `code` is the
    status of the fit, or that of the warning."""


class StudyWarning(_CodedWarning):
    """Cases of a study are invalid, have failed, or are not certified, or a search has no answer. Its `code` is
    `invalid`, `not-certified`, that of a warning of a case, or the verdict of the search."""


class NotCertifiedWarning(_CodedWarning):
    """A solution is not certified: not converged, beyond the model, or cut off by the domain or the end of a map. Its
    `code` is the status of the path."""
