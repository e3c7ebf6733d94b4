"""Indenters and surfaces in a case: their tables, and the maps and functions that no table holds."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from . import toml
from .errors import ArgumentError
from .function import CheckedFunction, Function, IndenterFunction, ReliefFunction, as_part
from .given import part
from .height_map import HeightMap
from .indenter import Indenter
from .surface import Surface
from .table import Table, value_of

Arrays: TypeAlias = dict[str, npt.NDArray[np.float64]]
"""Height maps by the names of their files."""

SHAPES: dict[str, tuple[type[Table], Callable[[Function], Table], tuple[str, ...]]] = {
    "indenter": (Indenter, IndenterFunction, ("indenter",)),
    "surface": (Surface, ReliefFunction, ("profile", "compliance")),
}
"""The parts of a case that may be maps or functions: their class, that of a function, and the names of functions."""


def shape_table(
    name: str, value: Any, arrays: Arrays, functions: dict[str, CheckedFunction]
) -> Mapping[str, toml.Value]:
    """The table of an indenter or a surface, whose array and functions take the place of others of its name; or a
    table itself, for a map of the same array."""
    kind, of_function, its_functions = SHAPES[name]
    for function in its_functions:
        functions.pop(function, None)
    if isinstance(value, Mapping):
        return dict(value_of(name, value))
    shape: Any = part(name, as_part(value, kind, of_function), kind)
    file = f"{name}.npy"
    arrays.pop(file, None)
    if isinstance(shape, (IndenterFunction, ReliefFunction)):
        functions |= shape.functions()
    table: dict[str, toml.Value] = shape.as_table()
    if isinstance(shape, HeightMap):
        table["file"], array = shape.file_or_array(file)
        if array is not None:
            arrays[file] = array
    return table


def refuse_functions(functions: Mapping[str, CheckedFunction]) -> None:
    """Refuses functions, which cannot be written."""
    if functions:
        found = " and ".join(functions)
        wanted = "a map, such as HeightMap.sampled"
        raise ArgumentError(f"{found}: found a function, which cannot be written to a file, wanted {wanted}")


def with_files(text: str, renamed: Callable[[str], str]) -> str:
    """The text of the case with other paths for its maps; the same text if it has none."""
    document = tomllib.loads(text)
    tables = [document[name] for name in ("surface", "indenter") if "file" in document.get(name, {})]
    for table in tables:
        table["file"] = renamed(table["file"])
    return toml.text(document) if tables else text
