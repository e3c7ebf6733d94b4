"""Views of fits: rows of tables, and figures of matplotlib."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any

import numpy as np

from .curve import Curve
from .errors import ArgumentError
from .estimates import ExpectedDesign, FitEstimate


def cells(estimate: FitEstimate) -> list[str]:
    """An estimate as a row of a table."""
    low, high = (f"{end:.4g}" if np.isfinite(end) else "open" for end in estimate.interval)
    value = f"{estimate.value:.4g} {estimate.unit}"
    return [estimate.key, value, f"[{low}, {high}]", estimate.verdict, estimate.why]


def design_cells(design: ExpectedDesign) -> list[str]:
    """A design as a row of a table: its curves, and the factor within which each unknown would lie."""
    named = " + ".join(
        ", ".join(f"{key} {value:.3g}" if isinstance(value, float) else f"{key} {value}" for key, value in curve.items())
        for curve in design.curves
    )
    factors = (expected.factor for expected in design.unknowns)
    return [named, *(f"factor {factor:.3g}" if np.isfinite(factor) else "open" for factor in factors)]


def curve(table: Curve, title: str) -> Any:
    """Draws all points with the model, and below them the residuals over their standard deviations."""
    import matplotlib.pyplot as plt

    heights = {"height_ratios": [3, 1]}
    figure, (above, below) = plt.subplots(2, 1, sharex=True, figsize=(6.4, 5.6), gridspec_kw=heights)
    _, abscissa, observed, model, _, whitened = table
    files = list(dict.fromkeys(table["file"]))
    for file in files:
        at = table["file"] == file
        order = np.argsort(table[abscissa][at], kind="stable")
        x = table[abscissa][at][order]
        (points,) = above.plot(x, table[observed][at][order], ".", ms=4, label=os.path.basename(str(file)))
        above.plot(x, table[model][at][order], "-", lw=1, color=points.get_color())
        below.plot(x, table[whitened][at][order], ".", ms=3, color=points.get_color())
    below.axhline(0, color="0.5", lw=1)
    below.set_ylabel("residual / σ")
    _quantity(below.xaxis, *_split(abscissa))
    _quantity(above.yaxis, *_split(observed))
    above.set_title(title)
    if len(files) > 1:
        above.legend(fontsize="small")
    figure.tight_layout()
    return figure


def profiles(estimates: Sequence[FitEstimate], table: Curve) -> Any:
    """Draws the rise of χ² along each unknown, with its interval."""
    import matplotlib.pyplot as plt

    name, value, rise, *_ = table
    unknowns = [estimate for estimate in estimates if np.any(table[name] == estimate.key)]
    if not unknowns:
        raise ArgumentError("profiles: found none, wanted a fit whose intervals come from profiles")
    count = len(unknowns)
    figure, axes = plt.subplots(1, count, squeeze=False, figsize=(4 * count, 3.4))
    for ax, estimate in zip(axes[0], unknowns, strict=False):
        at = table[name] == estimate.key
        order = np.argsort(table[value][at])
        x, y = table[value][at][order], table[rise][at][order]
        # The root of the rise is nearly linear between two points.
        root = np.sqrt(np.maximum(y, 0)) * np.sign(x - estimate.value)
        along = np.linspace(x[0], x[-1], 200)
        (line,) = ax.plot(along, np.interp(along, x, root) ** 2, lw=1)
        ax.plot(x, y, ".", color=line.get_color())
        for end in estimate.interval:
            if np.isfinite(end):
                ax.axvline(end, color="0.5", lw=1, ls="--")
        ax.axvline(estimate.value, color="0.2", lw=1)
        ax.set(ylabel="rise of χ²", title=estimate.verdict)
        _quantity(ax.xaxis, _short(estimate.key), estimate.unit)
    figure.tight_layout()
    return figure


def _quantity(axis: Any, label: str, unit: str) -> None:
    """Labels an axis for a quantity in SI units, with prefixes on its numbers."""
    from matplotlib.ticker import EngFormatter

    axis.set_label_text(label)
    if unit != "1":
        axis.set_major_formatter(EngFormatter(unit))


def _split(head: str) -> tuple[str, str]:
    """Name and unit of a column."""
    name, _, unit = head.partition(" [")
    return name, unit.rstrip("]")


def _short(key: str) -> str:
    """A key on two lines."""
    place, _, name = key.rpartition(".")
    return f"{place}\n{name}" if place else name
