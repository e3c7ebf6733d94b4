"""Unloadings evaluated by Oliver and Pharr, without a model of the body."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable
from functools import cached_property
from typing import Any

from . import _pellicle, show, toml
from .curve import Curve
from .errors import ArgumentError
from .fit import data_tables
from .judgement import ResultWarning
from .measurement import Data
from .oliver_pharr import OliverPharr


class Evaluation:
    """What unloadings give by Oliver and Pharr, as in `fit.json` of `pellicle identify`."""

    def __init__(self, found: dict[str, Any], table: str, calibration: str | None, text: str) -> None:
        self._state = (found, table, calibration, text)
        self.calibration = calibration
        """The text of the file of a calibration, which another evaluation reads as its `area_function`; None if none
        was asked for."""

    def to_dict(self) -> dict[str, Any]:
        """The content of the results file: only numbers, strings, lists and dicts."""
        found: dict[str, Any] = json.loads(json.dumps(self._state[0]))
        return found

    @property
    def title(self) -> str:
        """The title, or else the name of the file."""
        title: str = self._state[0]["title"]
        return title

    @property
    def verdict(self) -> str:
        """`"evaluated"`, or `"not-evaluated"` if a curve has no numbers: its warning says why."""
        verdict: str = self._state[0]["verdict"]
        return verdict

    @cached_property
    def table(self) -> Curve:
        """The columns of `indentation.csv`, a row for each contact: every number in SI units with its standard
        uncertainty."""
        return Curve.of_csv(self._state[1])

    @property
    def repeats(self) -> list[dict[str, Any]]:
        """Means over curves under one largest force, each with the standard deviation of single curves."""
        repeats: list[dict[str, Any]] = self._state[0]["repeats"]
        return repeats

    @cached_property
    def warnings(self) -> list[ResultWarning]:
        """Warnings about the result."""
        return [ResultWarning(**warning) for warning in self._state[0]["warnings"]]

    def __eq__(self, other: object) -> bool:
        return self._state == other._state if isinstance(other, Evaluation) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._state[1:])

    def __reduce__(self) -> tuple[type[Evaluation], tuple[Any, ...]]:
        return type(self), self._state

    def __str__(self) -> str:
        return self._state[3].rstrip()

    def __repr__(self) -> str:
        return f"<Evaluation {self.title!r}: {len(self.table['curve'])} contacts, {self.verdict}>"

    def _repr_html_(self) -> str:
        table = self.table
        columns = [name for name in table if " sd [" not in name]
        rows = zip(*(table[name] for name in columns), strict=True)
        return show.table(columns, ([f"{cell:.5g}" if isinstance(cell, float) else str(cell) for cell in row] for row in rows))


def evaluate(
    data: Data | Iterable[Data] | str | os.PathLike[str],
    evaluation: OliverPharr | None = None,
    *,
    title: str | None = None,
) -> Evaluation:
    """Evaluates unloadings by Oliver and Pharr, or those of a file with an `[evaluation]` alone, as
    `pellicle identify` does: contact depth, area, modulus, hardness and the rest of ISO 14577.

    What is observed is an unloading unless the data say otherwise; stiffnesses (`observe="stiffness at depth"`) give a contact for each reading.
    """
    if isinstance(data, (str, os.PathLike)):
        folder, file = os.path.split(os.path.abspath(data))
        found = _pellicle.evaluate(_pellicle.read_text(data), os.fspath(data), os.path.splitext(file)[0], folder, {})
        if found is None:
            raise ArgumentError(f"{os.fspath(data)}: found a fit, wanted an [evaluation] alone; pellicle.identify fits it")
    else:
        if not isinstance(evaluation, OliverPharr):
            raise ArgumentError(f"evaluation: found {type(evaluation).__name__}, wanted a pellicle.OliverPharr")
        written, texts = data_tables(data)
        written = [{"observe": "unloading", **table} for table in written]
        document = {
            **({} if title is None else {"title": title}),
            "data": written,
            "evaluation": evaluation.as_table(),
        }
        found = _pellicle.evaluate(toml.text(document), "evaluation", "evaluation", os.getcwd(), texts)
        assert found is not None, "a document without a model is no fit"
    text, table, calibration, words = found
    return Evaluation(json.loads(text), table, calibration, words)
