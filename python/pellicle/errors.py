"""Exceptions: one class for each kind of error of the program, all of them an `Error`."""

from __future__ import annotations

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


class FitWarning(UserWarning):
    """A fit should not be used: its model does not fit the measurements, or it has not converged."""


class StudyWarning(UserWarning):
    """Cases of a study are invalid, have failed, or are not certified."""


class NotCertifiedWarning(UserWarning):
    """A solution is not certified: not converged, or cut off by the domain or the end of a map."""
