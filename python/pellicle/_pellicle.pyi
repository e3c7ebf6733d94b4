"""The compiled module, which reads and solves cases."""

import os
import pathlib
from collections.abc import Callable, Mapping
from typing import Any, TypeAlias, final

import numpy as np
import numpy.typing as npt

_Function: TypeAlias = Callable[[npt.NDArray[np.float64], npt.NDArray[np.float64], bool], npt.NDArray[np.float64]]

__all__ = [
    "Case",
    "CaseError",
    "ContactError",
    "DiscreteProblem",
    "Error",
    "Field",
    "Fit",
    "FitRun",
    "Foundation",
    "IdentifyError",
    "IndenterError",
    "InfluenceError",
    "InternalError",
    "KernelError",
    "Likelihood",
    "LikelihoodRun",
    "Operator",
    "Planes",
    "Run",
    "RunError",
    "SearchRun",
    "Solution",
    "Study",
    "StudyRun",
    "Table",
    "TextureError",
    "__version__",
    "check_part",
    "evaluate",
    "find",
    "key_unit",
    "key_units",
    "number_text",
    "read_text",
    "si_value",
]

class Error(Exception):
    """Any error in reading or solving a case."""

class CaseError(Error):
    """A case is wrong in one place."""

    key: str | None
    line: int
    found: str | None
    wanted: str | None
    help: str | None

class KernelError(Error):
    """The elastic body is invalid, or has no compliance."""

    found: float
    largest: float
    layer: int
    layers: int
    reached: float
    s: float
    smallest: float
    sublayers: int
    wanted: Any

class InfluenceError(Error):
    """The influence coefficients cannot be computed."""

    at: float
    found: float
    largest: float
    layer: int
    layers: int
    lower: float
    offset: tuple[int, int]
    radius: float
    reached: float
    s: float
    smallest: float
    sublayers: int
    upper: float
    wanted: Any

class TextureError(Error):
    """The surface is invalid."""

    found: float
    index: tuple[int, int]
    largest: float
    period: float
    quantity: str
    radius: float
    shape: tuple[int, int]

class IndenterError(Error):
    """The indenter is invalid."""

    found: float
    least: int
    most: int
    quantity: str

class ContactError(Error):
    """The contact cannot be posed or solved."""

    area: float
    at: float
    element: int
    element_side: float
    elements: int
    field: str
    force: float
    found: float
    index: tuple[int, int]
    largest: float
    layer: int
    layers: int
    least: int
    lower: float
    most: int
    offset: tuple[int, int]
    penetration: float
    period: float
    quantity: str
    radius: float
    reached: float
    s: float
    shape: tuple[int, int]
    side: float
    smallest: float
    step: int
    sublayers: int
    tolerance: float
    trials: int
    upper: float
    wanted: Any
    worst: float

class IdentifyError(Error):
    """A fit cannot be posed or carried out."""

    curve: int
    found: float
    list: str
    name: str
    point: int
    points: int
    predictions: int
    quantity: str
    size: int
    starts: int
    wanted: Any

class RunError(Error):
    """A case cannot be run: a file cannot be read, or there is too little memory."""

    available: float
    bottom: float
    found: float
    last: int
    needed: float
    path: pathlib.Path
    reason: str

class InternalError(Error):
    """An error of the program itself, which should not occur."""


__version__: str

def check_part(part: str, call: str, text: str) -> None: ...
def evaluate(
    text: str, source: str, name: str, folder: str | os.PathLike[str], texts: Mapping[str, str]
) -> tuple[str, str, str | None, str] | None: ...
def find(
    case: tuple[
        str,
        str,
        str,
        str | os.PathLike[str],
        Mapping[str, npt.NDArray[np.float64]],
        Mapping[str, _Function],
    ],
    condition: str,
    key: str,
    between: tuple[str, str] | None,
    within: float,
    threads: int | None = None,
) -> SearchRun: ...
def key_unit(path: list[str]) -> str | None: ...
def key_units() -> dict[str, str]: ...
def number_text(value: float, unit: str, is_si: bool) -> str: ...
def read_text(path: str | os.PathLike[str]) -> str: ...
def si_value(text: str, unit: str) -> float: ...
@final
class Foundation:
    def __new__(cls, text: str, source: str) -> Foundation: ...
    def compliance(self, wavenumbers: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]: ...
    def stress(
        self, pressure: npt.NDArray[np.float64], side: float, contact_radius: float, text: str
    ) -> Planes: ...

@final
class Operator:
    def __new__(cls, foundation: Foundation, element_side: float, elements: int) -> Operator: ...
    def coefficients(self) -> npt.NDArray[np.float64]: ...
    def apply(self, pressure: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]: ...

@final
class Case:
    def __new__(
        cls,
        text: str,
        source: str,
        name: str,
        folder: str | os.PathLike[str],
        arrays: Mapping[str, npt.NDArray[np.float64]],
        functions: Mapping[str, _Function],
    ) -> Case: ...
    def is_si(self) -> bool: ...
    def resolved(self) -> str: ...
    def start(self, threads: int | None = None) -> Run: ...

@final
class DiscreteProblem:
    def __new__(cls, case: Case) -> DiscreteProblem: ...
    @property
    def side(self) -> float: ...
    @property
    def elements(self) -> int: ...
    def initial_gap(self) -> npt.NDArray[np.float64]: ...
    def relief_compliance(self) -> npt.NDArray[np.float64]: ...
    def displacement(self, pressure: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]: ...
    def judge(
        self, pressure: npt.NDArray[np.float64], force: float | None, penetration: float
    ) -> tuple[float, float, tuple[float, float, float, float, float, float, bool]]: ...

@final
class Run:
    def wait(self, milliseconds: int) -> bool: ...
    def cancel(self) -> None: ...
    def progress(self) -> tuple[int, int, int, int, int, float] | None: ...
    def result(self) -> Solution | None: ...

@final
class Fit:
    def __new__(
        cls,
        text: str,
        source: str,
        name: str,
        folder: str | os.PathLike[str],
        arrays: Mapping[str, npt.NDArray[np.float64]],
        functions: Mapping[str, _Function],
        texts: Mapping[str, str],
        is_measured: bool,
    ) -> Fit: ...
    def start_fit(self, threads: int | None = None) -> FitRun: ...
    def start_each(self, threads: int | None = None) -> FitRun: ...
    def start_likelihood(self, threads: int | None = None) -> LikelihoodRun: ...
    def start_plan(self, threads: int | None = None) -> FitRun: ...

@final
class FitRun:
    def wait(self, milliseconds: int) -> bool: ...
    def cancel(self) -> None: ...
    def progress(self) -> tuple[int | None, int | None] | None: ...
    def result(self) -> tuple[str, list[tuple[str, str]], bool] | None: ...

@final
class LikelihoodRun:
    def wait(self, milliseconds: int) -> bool: ...
    def cancel(self) -> None: ...
    def progress(self) -> tuple[int | None, int | None] | None: ...
    def result(self) -> Likelihood | None: ...

@final
class Likelihood:
    @property
    def keys(self) -> list[str]: ...
    @property
    def best(self) -> list[float]: ...
    def logarithm(self, values: list[float]) -> float: ...

@final
class SearchRun:
    def wait(self, milliseconds: int) -> bool: ...
    def cancel(self) -> None: ...
    def progress(self) -> int | None: ...
    def result(self) -> tuple[str, str] | None: ...

@final
class Study:
    def __new__(cls, path: str | os.PathLike[str], sets: list[str]) -> Study: ...
    def __len__(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def fingerprint(self) -> str: ...
    @property
    def refused(self) -> str | None: ...
    @property
    def record_bytes(self) -> int: ...
    def start(self, cases: list[int], threads: int) -> StudyRun: ...
    def table(self, folder: str | os.PathLike[str], fresh: bool) -> Table: ...

@final
class StudyRun:
    def wait(self, milliseconds: int) -> bool: ...
    def cancel(self) -> None: ...
    def progress(self) -> int | None: ...
    def result(self) -> tuple[list[tuple[int, str, str, bytes]], list[str]]: ...

@final
class Table:
    def remaining(self) -> list[int]: ...
    def add(self, solved: list[tuple[int, str, str, bytes]]) -> None: ...
    def force(self) -> None: ...
    def tally(self) -> tuple[int, int, int, int, int]: ...
    def path(self) -> pathlib.Path: ...
    def close(self) -> None: ...

@final
class Field:
    @property
    def __array_interface__(self) -> dict[str, Any]: ...

@final
class Planes:
    def centres(self) -> npt.NDArray[np.float64]: ...
    def depths(self) -> npt.NDArray[np.float64]: ...
    def bodies(self) -> list[str]: ...
    def fields(self) -> dict[str, tuple[str, str, npt.NDArray[np.float64]]]: ...

@final
class Solution:
    @property
    def is_whole(self) -> bool: ...
    def summary(self) -> str: ...
    def curve(self) -> str: ...
    def report(self) -> str: ...
    def warnings_of(self, step: int) -> list[tuple[str, str]]: ...
    def pressure(self, step: int) -> Field: ...
    def surface(self, step: int) -> list[npt.NDArray[np.float64]]: ...
    def stress(self, step: int, text: str) -> Planes: ...
    def geometry(self) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.bool_]]: ...
