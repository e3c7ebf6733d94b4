"""A case (one contact problem: a case file and the arrays that it names), and the path of a solved case."""

from __future__ import annotations

import json
import os
import tomllib
import warnings
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar, Literal, TypeAlias, overload

import numpy as np
import numpy.typing as npt

from . import _pellicle, show, toml
from .body import Foundation
from .curve import Curve
from .errors import ArgumentError, NotCertifiedWarning, writing
from .fields import Fields, SolvedFields, StoredFields
from .function import CheckedFunction, Function
from .given import integer, mapping, part, switch
from .indenter import Indenter
from .judgement import ResultWarning
from .options import Output, Range, Stress, Wear
from .progress import Progress, Report, reporting
from .quantity import Quantity, unit_of, with_units
from .shapes import SHAPES, Arrays, refuse_functions, shape_table, with_files
from .step import Step, main_numbers
from .surface import Surface
from .table import value_of
from .waiting import finished

if TYPE_CHECKING:
    import pandas

Loads: TypeAlias = Sequence[Quantity] | npt.NDArray[np.float64] | Range
"""Several loads: a list, an array or a range."""


CALL = "Case(…)"
"""The source of a case that was built by a call."""

ORDER = ("foundation", "surface", "indenter", "load", "grid", "solver", "stress", "wear", "output")
"""The tables of a case file in their order."""


class Case:
    """One contact problem.

    Exactly one of `force`, `forces`, `pressure`, `pressures`, `penetration` and `penetrations` is the load; a pressure
    is the force over the area of a periodic cell. With a `work_of_adhesion` the steps are those of contact with
    adhesion. Numbers are in SI units (m, Pa, N, rad, m/Pa), or in any consistent system if no quantity has a unit;
    strings such as `"5 nm"` and quantities of pint carry units. Anything left out takes the default of the case file.

    An indenter or a surface may also be a function `f(x, y)` of two arrays (m) that returns heights (m), as in
    `IndenterFunction` and `ReliefFunction`.
    """

    def __init__(
        self,
        foundation: Foundation,
        indenter: Indenter | Function,
        *,
        surface: Surface | Function | None = None,
        force: Quantity | None = None,
        forces: Loads | None = None,
        pressure: Quantity | None = None,
        pressures: Loads | None = None,
        penetration: Quantity | None = None,
        penetrations: Loads | None = None,
        sensitivities: bool = False,
        work_of_adhesion: Quantity | None = None,
        adhesion: Literal["jkr", "dmt"] | None = None,
        side: Quantity | None = None,
        sides: Sequence[Quantity] | None = None,
        elements: int | Sequence[int] | None = None,
        boundary: Literal["free", "periodic"] | None = None,
        tolerance: float | None = None,
        method: Literal["gradient", "active-set"] | None = None,
        hardness: Quantity | None = None,
        stress: Stress | None = None,
        wear: Wear | None = None,
        output: Output | None = None,
        title: str | None = None,
    ) -> None:
        load = {
            "force": force,
            "forces": forces,
            "pressure": pressure,
            "pressures": pressures,
            "penetration": penetration,
            "penetrations": penetrations,
            "work_of_adhesion": work_of_adhesion,
            "adhesion": adhesion,
        }
        tables: dict[str, Mapping[str, Any] | None] = {
            "foundation": part("foundation", foundation, Foundation).as_table(),
            "load": _given(load) | ({"sensitivities": True} if switch("sensitivities", sensitivities) else {}),
            "grid": _given({"side": side, "sides": sides, "elements": elements, "boundary": boundary}) or None,
            "solver": _given({"tolerance": tolerance, "method": method, "hardness": hardness}) or None,
            "stress": None if stress is None else part("stress", stress, Stress).as_table(),
            "wear": None if wear is None else part("wear", wear, Wear).as_table(),
            "output": None if output is None else part("output", output, Output).as_table(),
        }
        arrays: Arrays = {}
        functions: dict[str, CheckedFunction] = {}
        if surface is not None:
            tables["surface"] = shape_table("surface", surface, arrays, functions)
        tables["indenter"] = shape_table("indenter", indenter, arrays, functions)
        document = {name: tables[name] for name in ORDER if tables.get(name) is not None}
        text = toml.text(_given({"title": title}) | document)
        self._read(text, CALL, "case", os.getcwd(), arrays, functions)

    def _read(
        self,
        text: str,
        source: str,
        name: str,
        folder: str,
        arrays: Mapping[str, npt.NDArray[np.float64]],
        functions: Mapping[str, CheckedFunction],
    ) -> None:
        self._state = (text, source, name, folder, dict(arrays), dict(functions))
        self._case = _pellicle.Case(*self._state)

    @classmethod
    def _restored(cls, *state: Any) -> Case:
        case = cls.__new__(cls)
        case._read(*state)
        return case

    @classmethod
    def from_toml(cls, path: str | os.PathLike[str]) -> Case:
        """Reads a case from a file, as `pellicle run` does."""
        folder, file = os.path.split(os.path.abspath(path))
        return cls._restored(_pellicle.read_text(path), os.fspath(path), os.path.splitext(file)[0], folder, {}, {})

    @classmethod
    def from_string(cls, text: str, folder: str | os.PathLike[str] = ".") -> Case:
        """Reads a case from the text of a case file, whose maps have paths relative to `folder`."""
        return cls._restored(text, "case", "case", os.path.abspath(folder), {}, {})

    def to_toml(self, path: str | os.PathLike[str] | None = None) -> str:
        """Returns the text of the case file, and writes it to `path` if given, with its arrays beside it as `.npy`
        files.

        `pellicle run` gives the same bits for it as `solve` does. Cases with functions are refused, since no file can
        hold them.
        """
        _, _, _, folder, arrays, functions = self._state
        refuse_functions(functions)
        text = self._with_units()
        if path is None:
            return text
        target, file = os.path.split(os.path.abspath(path))
        stem = os.path.splitext(file)[0]
        moved = {name: f"{stem}-{name}" for name in arrays}
        if arrays or target != folder:
            text = with_files(text, lambda name: moved.get(name) or os.path.join(folder, name))
        for name, array in arrays.items():
            with writing(path):
                np.save(os.path.join(target, moved[name]), array)
        with writing(path), open(path, "w", encoding="utf-8", newline="\n") as to:
            to.write(text)
        return text

    def _with_units(self) -> str:
        """The text of the case; the numbers of a call among values with units have theirs, since a file warns of bare
        ones."""
        text, source = self._state[:2]
        return toml.text(with_units(tomllib.loads(text))) if source == CALL and self._case.is_si() else text

    def replaced(self, values: Mapping[str, Any]) -> Case:
        """Returns the case with some keys replaced, as by `--set`: `{"load.force": "3 mN"}`.

        A whole part may be replaced as well: `{"surface": Rough(heights, side="1 um")}`. Items of lists are numbered
        from 0, as in `foundation.layer[0].thickness`; missing keys are added.
        """
        text, source, name, folder, arrays, functions = self._state
        document = tomllib.loads(text)
        arrays, functions = dict(arrays), dict(functions)
        for key, value in mapping("values", values, "a dict of values by their keys").items():
            if key in SHAPES:
                _put(document, key, shape_table(key, value, arrays, functions))
            else:
                last, unit = key.rpartition(".")[2], unit_of(key)
                _put(document, key, value_of(last, value, units={last.partition("[")[0]: unit} if unit else {}))
        return Case._restored(toml.text(document), source, name, folder, arrays, functions)

    @cached_property
    def resolved(self) -> dict[str, Any]:
        """The case with every default filled in and every quantity in SI units or the case's own."""
        resolved: dict[str, Any] = json.loads(self._case.resolved())
        return resolved

    @property
    def foundation_table(self) -> str:
        """The text of the table `[foundation]`."""
        return toml.text({"foundation": tomllib.loads(self._state[0])["foundation"]})

    @property
    def title(self) -> str:
        """The title, or else the name of the file."""
        title: str = self.resolved["title"]
        return title

    def solve(self, *, progress: bool | Report = False, threads: int | None = None) -> Path:
        """Solves the case.

        `progress` shows a bar, or is a function that receives a `Progress` a few times a second. `threads` is the
        number of threads; by default that of `RAYON_NUM_THREADS`, or of cores. The result has the same bits for any
        number of threads.

        Other Python threads continue to run meanwhile. Ctrl-C raises `Interrupted`, whose `path` holds the steps
        finished so far. A solution that is not certified is returned with a `NotCertifiedWarning`.
        """
        run = self._case.start(checked_threads(threads))
        return finished(run, lambda solution: _path(self, solution), reporting(progress, self, Progress))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Case):
            return NotImplemented
        return self._case == other._case and self._state[-1] == other._state[-1]

    __hash__: ClassVar[None]  # type: ignore[assignment]

    def __copy__(self) -> Case:
        return self

    def __deepcopy__(self, memo: object) -> Case:
        return self

    def __reduce__(self) -> tuple[Any, tuple[Any, ...]]:
        return Case._restored, self._state

    def __repr__(self) -> str:
        kind, grid = self.resolved["indenter"]["kind"], self.resolved["grid"]
        elements = f"{grid['elements']} × {grid['elements']} elements"
        if grid.get("sides"):
            elements = f"{grid['elements']} elements along the longer side"
        layers = len(self.resolved["foundation"]["layer"])
        counted = f"{layers} layer{'' if layers == 1 else 's'}"
        return f"<Case {self.title!r}: {kind} on {counted}, {elements}>"

    def _repr_html_(self) -> str:
        return show.table(["key", "value"], show.keys(self.resolved))


class Path(Sequence[Step]):
    """The loading steps of a solved case, in the order of its loads."""

    def __init__(self, case: Case, summary: dict[str, Any], curve: Curve, fields: Fields, is_whole: bool) -> None:
        self.case = case
        """The case as it was given."""
        self.summary = summary
        """The numbers of the run, as `summary.json` has them."""
        self.curve = curve
        """The columns of `curve.csv` as arrays; `pandas.DataFrame(path.curve)` is a table of them."""
        self.is_whole = is_whole
        """Whether everything that the case requests is here; otherwise it was interrupted."""
        self._fields = fields

    @property
    def status(self) -> str:
        """The worst status of the steps: `"certified"`, `"cut-off"`, `"beyond-model"` or `"not-converged"`."""
        status: str = self.summary["status"]
        return status

    @cached_property
    def warnings(self) -> list[ResultWarning]:
        """Warnings about the numbers."""
        return [ResultWarning(**warning) for warning in self.summary["warnings"]]

    def report(self, path: str | os.PathLike[str] | None = None) -> str:
        """The page of the run, as `report.html` of `pellicle run`, with the pictures of the last step; also written to
        `path` if given."""
        page = self._fields.report()
        if path is not None:
            with writing(path), open(path, "w", encoding="utf-8", newline="\n") as to:
                to.write(page)
        return page

    def to_pandas(self) -> pandas.DataFrame:
        """The columns of `curve.csv` as a table with a row per step; needs pandas."""
        return self.curve.to_pandas()

    def plot(self, ax: Any = None) -> Any:
        """Draws force over penetration with matplotlib on `ax` or on new axes, and returns the axes; of a single step
        its pressure."""
        import matplotlib.pyplot as plt

        if len(self) == 1:
            return self[0].plot(ax)
        ax = plt.subplots()[1] if ax is None else ax
        force, penetration = self.curve["force"], self.curve["penetration"]
        ax.errorbar(penetration, force, xerr=np.nan_to_num(self.curve["penetration error"]), marker="o", capsize=2)
        ax.set(xlabel="penetration D", ylabel="force Q", title=self.case.title)
        if "force [N]" in self.curve:
            from matplotlib.ticker import EngFormatter

            ax.xaxis.set_major_formatter(EngFormatter("m"))
            ax.yaxis.set_major_formatter(EngFormatter("N"))
        return ax

    def __len__(self) -> int:
        return len(self.summary["steps"])

    @overload
    def __getitem__(self, index: int) -> Step: ...
    @overload
    def __getitem__(self, index: slice) -> list[Step]: ...
    def __getitem__(self, index: int | slice) -> Step | list[Step]:
        found = range(len(self))[index]
        return [self._step(i) for i in found] if isinstance(found, range) else self._step(found)

    def __iter__(self) -> Iterator[Step]:
        return map(self._step, range(len(self)))

    def _step(self, index: int) -> Step:
        is_si = "force [N]" in self.curve
        return Step(self.summary["steps"][index], self.summary["grid"], index, self._fields, is_si)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Path):
            return NotImplemented
        return self.case == other.case and list(self) == list(other)

    __hash__: ClassVar[None]  # type: ignore[assignment]

    def __copy__(self) -> Path:
        return self

    def __deepcopy__(self, memo: object) -> Path:
        return self

    def __reduce__(self) -> tuple[type[Path], tuple[Any, ...]]:
        radii = {step.index: step.contact_radius for step in self}
        stored = StoredFields.of(self._fields, range(len(self)), self.summary["grid"]["side"], radii)
        return Path, (self.case, self.summary, self.curve, stored, self.is_whole)

    def __repr__(self) -> str:
        steps = f"{len(self)} step{'' if len(self) == 1 else 's'}"
        return f"<Path {self.case.title!r}: {steps}, {self.status}>"

    def _repr_html_(self) -> str:
        names = [name for name, _ in main_numbers(self[0])] if len(self) else []
        return show.table(names, [[value for _, value in main_numbers(step)] for step in self])


def _path(case: Case, solution: _pellicle.Solution) -> Path:
    """Makes the path of a solution; warns if it is not certified."""
    summary = json.loads(solution.summary())
    curve = Curve.of_csv(solution.curve())
    path = Path(case, summary, curve, SolvedFields(solution, case.foundation_table), solution.is_whole)
    if path.status != "certified":
        reasons = [str(warning) for warning in path.warnings if warning.code == path.status]
        message = "; ".join([f"the solution is {path.status}, do not use these numbers", *reasons])
        warnings.warn(NotCertifiedWarning(message, path.status), stacklevel=3)
    return path


def _given(values: Mapping[str, Any]) -> dict[str, toml.Value]:
    return {name: value_of(name, value) for name, value in values.items() if value is not None}


def checked_threads(threads: int | None) -> int | None:
    """Checks a number of threads."""
    return None if threads is None else integer("threads", threads, 1, 4096)


def _put(document: dict[str, Any], key: str, value: toml.Value) -> None:
    """Sets a dotted key in nested tables, and creates missing tables."""
    *parents, last = key.replace("[", ".").replace("]", "").split(".")
    place: Any = document
    try:
        for part in parents:
            place = place[int(part)] if isinstance(place, list) else place.setdefault(part, {})
        place[int(last) if isinstance(place, list) else last] = value
    except (AttributeError, IndexError, TypeError, ValueError) as error:
        raise ArgumentError(f"values: found {key!r}, wanted a key of the case") from error
