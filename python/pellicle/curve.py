"""The curve of a path: the columns of `curve.csv`."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt


class Curve(dict[str, npt.NDArray[Any]]):
    """Columns by their names in `curve.csv`, such as `"force [N]"`; `curve["force"]` finds it, too.

    `pandas.DataFrame(path.curve)` is a table of them.
    """

    def __missing__(self, name: str) -> npt.NDArray[Any]:
        found = [key for key in self if key.partition(" [")[0] == name]
        if len(found) != 1:
            raise KeyError(name)
        return self[found[0]]

    @classmethod
    def of_csv(cls, text: str) -> Curve:
        """The columns of the text of a `curve.csv`."""
        header, *rows = (line.split(",") for line in text.splitlines())
        cells = zip(*rows, strict=True) if rows else ((),) * len(header)
        return cls(zip(header, map(_column, cells), strict=True))


def _column(cells: tuple[str, ...]) -> npt.NDArray[Any]:
    """Truth values, integers, or floats, NaN where there is no number."""
    if all(cell in ("true", "false") for cell in cells):
        return np.array([cell == "true" for cell in cells], dtype=np.bool_)
    # A float is always written with an exponent, an integer never.
    if all(cell.isdecimal() for cell in cells):
        return np.array([int(cell) for cell in cells], dtype=np.int64)
    return np.array([float(cell or "nan") for cell in cells], dtype=np.float64)
