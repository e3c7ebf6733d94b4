"""Tables of results: the columns of `curve.csv` and others."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    import pandas


class Curve(dict[str, npt.NDArray[Any]]):
    """Columns by their names in the file, such as `"force [N]"`; `curve["force"]` works, too.

    `pandas.DataFrame(path.curve)` is a table of them.
    """

    def __missing__(self, name: str) -> npt.NDArray[Any]:
        found = [key for key in self if key.partition(" [")[0] == name]
        if len(found) != 1:
            raise KeyError(name)
        return self[found[0]]

    def to_pandas(self) -> pandas.DataFrame:
        """The columns as a table; needs pandas."""
        import pandas

        return pandas.DataFrame(self)

    @classmethod
    def of_csv(cls, text: str) -> Curve:
        """Reads the columns from the text of a table."""
        header, *rows = csv.reader(io.StringIO(text, newline=""))
        cells = zip(*rows, strict=True) if rows else ((),) * len(header)
        return cls(zip(header, map(_column, cells), strict=True))


def _column(cells: Sequence[str]) -> npt.NDArray[Any]:
    """Converts a column to booleans, integers, floats (NaN for missing numbers) or strings."""
    if all(cell in ("true", "false") for cell in cells):
        return np.array([cell == "true" for cell in cells], dtype=np.bool_)
    # Floats are always written with an exponent, integers never.
    if all(cell.isdecimal() for cell in cells):
        return np.array([int(cell) for cell in cells], dtype=np.int64)
    try:
        return np.array([float(cell or "nan") for cell in cells], dtype=np.float64)
    except ValueError:
        return np.array(cells, dtype=np.str_)
