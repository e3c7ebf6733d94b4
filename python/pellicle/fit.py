"""A fit: measurements, a model and its unknowns, as a fit file and the arrays that it names."""

from __future__ import annotations

import os
import tomllib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from . import _pellicle, toml
from .case import Case
from .errors import ArgumentError, writing
from .function import CheckedFunction
from .given import mapping, part, parts, switch, taken
from .height_map import is_same
from .measurement import Data
from .oliver_pharr import OliverPharr
from .options import Range
from .quantity import SI_UNITS, Quantity, unit_of
from .shapes import Arrays, refuse_functions, with_files
from .table import Table, value_of


@dataclass(frozen=True)
class Unknown(Table):
    """A parameter to be determined: between bounds, with a prior, or both.

    A lognormal prior has a `median` and a `factor` equal to one standard deviation, a normal one a `mean` and an `sd`.
    """

    _names: ClassVar[Mapping[str, str]] = {"low": "from", "high": "to"}

    low: Quantity | None = None
    high: Quantity | None = None
    prior: Literal["lognormal", "normal"] | None = None
    median: Quantity | None = None
    factor: float | None = None
    mean: Quantity | None = None
    sd: Quantity | None = None


Bounds: TypeAlias = Unknown | tuple[Quantity, Quantity]
"""An `Unknown`, or its bounds."""


@dataclass(frozen=True)
class Nuisances(Table):
    """Other influences on the measurements: the zeros and a drift of each curve, the frame compliance in m/N, and
    inexactly known numbers of the model, by their keys.

    A zero or a drift is True for one of each curve, False or `"off"` for an exact reading, or an `Unknown` with a
    normal prior. By default that of the depth is sought, and that of the force where a file shows a stretch before
    contact. `shift` is the old name of `depth_zero`.
    """

    depth_zero: bool | Literal["off"] | Unknown | None = None
    force_zero: bool | Literal["off"] | Unknown | None = None
    shift: bool | Literal["off"] | None = None
    frame_compliance: Literal["off", "free"] | Unknown | None = None
    drift: bool | Literal["off"] | None = None
    parameters: Mapping[str, Bounds] | None = None

    def __post_init__(self) -> None:
        self._take()
        self.as_table()

    def as_table(self) -> dict[str, toml.Value]:
        """The keys of `[nuisance]`, with those of the numbers of the model beside the others."""
        found: dict[str, toml.Value] = {}
        for name in ("depth_zero", "force_zero", "shift", "drift"):
            given = getattr(self, name)
            if isinstance(given, Unknown):
                found[name] = {"per": "curve"} | given.as_value(SI_UNITS[name])
            elif given is not None:
                is_on = not _is_off(given) and switch(name, given, ', "off" or a pellicle.Unknown')
                found[name] = {"per": "curve"} if is_on else "off"
        if self.frame_compliance is not None:
            found["frame_compliance"] = value_of("frame_compliance", self.frame_compliance)
        return found | _bounds("parameters", {} if self.parameters is None else self.parameters)


@dataclass(frozen=True)
class Design(Table):
    """Curves that could be measured: each indenter radius (m) with each largest force (N)."""

    forces: Sequence[Quantity] | npt.NDArray[np.float64] | Range | None = None
    radii: Sequence[Quantity] | npt.NDArray[np.float64] | Range | None = None
    points: int | None = None


@dataclass(frozen=True)
class Report(Table):
    """Options of the report: level and kind of the intervals, the seed of simulated noise, and the design of a plan."""

    level: float | None = None
    intervals: Literal["profile", "wald"] | None = None
    seed: int | None = None
    design: Design | None = None
    outside: Literal["leave out", "keep"] | None = None


class Fit:
    """Measurements, a model, and its unknowns.

    `model` is a case that provides fixed values and starts; its loads are ignored. `unknown` maps the keys of the
    numbers sought, such as `"foundation.layer[0].young_modulus"`, to bounds or priors. A fit without `data` can only be
    planned. `evaluation` tells how unloadings are evaluated by Oliver and Pharr, for data observed as `"unloading"`.
    """

    def __init__(
        self,
        model: Case,
        data: Data | Iterable[Data] = (),
        *,
        unknown: Mapping[str, Bounds],
        nuisance: Nuisances | None = None,
        evaluation: OliverPharr | None = None,
        report: Report | None = None,
        title: str | None = None,
    ) -> None:
        part("model", model, Case)
        written, texts = data_tables(data)
        text, _, _, folder, arrays, functions = model._state
        document = {
            **({} if title is None else {"title": title}),
            "model": tomllib.loads(with_files(text, lambda name: name if name in arrays else os.path.join(folder, name))),
            **({"data": written} if written else {}),
            "unknown": _bounds("unknown", unknown),
            **_optional("nuisance", nuisance, Nuisances),
            **_optional("evaluation", evaluation, OliverPharr),
            **_optional("report", report, Report),
        }
        self._read(toml.text(document), "Fit(…)", "fit", os.getcwd(), arrays, functions, texts)

    def _read(self, *state: Any) -> None:
        self._state: tuple[str, str, str, str, Arrays, dict[str, CheckedFunction], dict[str, str]] = state
        document = tomllib.loads(state[0])
        if "evaluation" in document and not {"model", "unknown"} & document.keys():
            raise ArgumentError(
                f"{state[1]}: found an [evaluation] alone, wanted a [model] with [unknown]; pellicle.evaluate evaluates it"
            )
        # Raises errors where the fit is created, not where it is used.
        self.begun(is_measured=self.is_measured)

    def begun(self, *, is_measured: bool) -> _pellicle.Fit:
        """Reads the fit again, for a single use."""
        return _pellicle.Fit(*self._state, is_measured)

    @property
    def is_measured(self) -> bool:
        """Whether the fit has measurements."""
        return "data" in tomllib.loads(self._state[0])

    @property
    def title(self) -> str:
        """The title, or else the name of the file."""
        title: str = tomllib.loads(self._state[0]).get("title", self._state[2])
        return title

    @classmethod
    def _restored(cls, *state: Any) -> Fit:
        fit = cls.__new__(cls)
        fit._read(*state)
        return fit

    @classmethod
    def from_toml(cls, path: str | os.PathLike[str]) -> Fit:
        """Reads a fit from a file, as `pellicle identify` does."""
        folder, file = os.path.split(os.path.abspath(path))
        text = _pellicle.read_text(path)
        return cls._restored(text, os.fspath(path), os.path.splitext(file)[0], folder, {}, {}, {})

    @classmethod
    def from_string(cls, text: str, folder: str | os.PathLike[str] = ".") -> Fit:
        """Reads a fit from the text of a fit file, whose files have paths relative to `folder`."""
        return cls._restored(text, "fit", "fit", os.path.abspath(folder), {}, {}, {})

    def to_toml(self, path: str | os.PathLike[str] | None = None) -> str:
        """Returns the text of the fit file, and writes it to `path` if given, with its arrays beside it.

        `pellicle identify` gives the same bits for it as `identify` does. Fits with functions are refused, since they
        cannot be written to a file.
        """
        text, _, _, folder, arrays, functions, texts = self._state
        refuse_functions(functions)
        if path is None:
            return str(text)
        target, file = os.path.split(os.path.abspath(path))
        stem = os.path.splitext(file)[0]
        own = {name: f"{stem}-{name}" for name in (*arrays, *texts)}
        document = tomllib.loads(text)
        moved = own if target == folder else _Elsewhere(own, folder)
        for table in (document.get("model", {}).get("surface"), document.get("model", {}).get("indenter")):
            if table is not None and "file" in table:
                table["file"] = moved.get(table["file"], table["file"])
        for table in document.get("data", []):
            table["file"] = moved.get(table["file"], table["file"])
        if "case" in document.get("model", {}):
            document["model"]["case"] = moved.get(document["model"]["case"], document["model"]["case"])
        written = toml.text(document) if own or target != folder else str(text)
        for name, array in arrays.items():
            with writing(path):
                np.save(os.path.join(target, own[name]), array)
        for name, rows in texts.items():
            _write(os.path.join(target, own[name]), rows)
        _write(os.fspath(path), written)
        return written

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Fit):
            return NotImplemented
        mine, others = self._state, other._state
        same = mine[0] == others[0] and mine[3] == others[3] and mine[5:] == others[5:]
        return same and mine[4].keys() == others[4].keys() and all(
            is_same(array, others[4][name]) for name, array in mine[4].items()
        )

    __hash__: ClassVar[None]  # type: ignore[assignment]

    def __copy__(self) -> Fit:
        return self

    def __deepcopy__(self, memo: object) -> Fit:
        return self

    def __reduce__(self) -> tuple[Any, tuple[Any, ...]]:
        return Fit._restored, self._state

    def __repr__(self) -> str:
        document = tomllib.loads(self._state[0])
        tables = len(document.get("data", []))
        return f"<Fit {self.title!r}: {len(_flattened(document['unknown']))} unknown, {tables} of data>"


def data_tables(data: Data | Iterable[Data]) -> tuple[list[toml.Value], dict[str, str]]:
    """The tables `[[data]]` of a fit file, and the texts of its arrays by their names."""
    texts: dict[str, str] = {}
    written: list[toml.Value] = []
    for number, table in enumerate(parts("data", data, Data)):
        values, rows = table.as_table(), table.rows_or_none()
        if rows is not None:
            values["file"] = table.file or f"data-{number}.csv"
            if texts.setdefault(values["file"], rows) != rows:
                raise ArgumentError(f"data: found two arrays named {table.file!r}, wanted a name for each")
        written.append(values)
    return written, texts


class _Elsewhere(dict[str, str]):
    """New paths for the files in a folder, and new names for arrays."""

    def __init__(self, own: Mapping[str, str], folder: str) -> None:
        super().__init__(own)
        self._folder = folder

    def get(self, name: str, default: Any = None) -> Any:
        return self[name] if name in self else os.path.join(self._folder, name)


def _write(path: str, text: str) -> None:
    with writing(path), open(path, "w", encoding="utf-8", newline="\n") as to:
        to.write(text)


def _optional(name: str, value: Table | None, kind: type[Table]) -> dict[str, toml.Value]:
    if value is None:
        return {}
    return {name: part(name, value, kind).as_table()}


def _is_off(value: object) -> bool:
    return isinstance(value, str) and value == "off"


def _bounds(name: str, unknown: Mapping[str, Bounds]) -> dict[str, toml.Value]:
    """The tables for numbers of the model, by their keys."""
    found: dict[str, toml.Value] = {}
    for key, given in mapping(name, unknown, "a dict of a pellicle.Unknown or a pair of bounds by keys").items():
        bounds = taken(key, given)
        if isinstance(bounds, tuple) and len(bounds) == 2:
            bounds = Unknown(*bounds)
        if not isinstance(bounds, Unknown):
            raise ArgumentError(f"{key}: found {given!r}, wanted a pellicle.Unknown or a pair of bounds")
        found[key] = bounds.as_value(unit_of(key))
    return found


def _flattened(table: Mapping[str, Any]) -> list[str]:
    """The keys of the unknowns, at any level of nesting."""
    kinds = {"from", "to", "prior"}
    keys: list[str] = []
    for key, value in table.items():
        if isinstance(value, Mapping) and not kinds & value.keys():
            keys += [f"{key}.{inner}" for inner in _flattened(value)]
        else:
            keys.append(key)
    return keys
