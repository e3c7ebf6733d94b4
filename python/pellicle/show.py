"""Cases and results as others want to see them: HTML for notebooks, data sets of xarray, pictures of matplotlib."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from html import escape
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import xarray

    from .step import Step

FIELDS = {
    "pressure": ("Pa", "pressure p, compression positive"),
    "displacement": ("m", "displacement u of the body's surface, positive into the body"),
    "gap": ("m", "gap g between the indenter and the surface"),
    "shortening": ("m", "shortening w* of the relief"),
    "profile": ("m", "profile f* of the relief: 0 on the tops, negative between them"),
    "mask": (None, "whether the element belongs to the relief"),
    "contact": (None, "whether the element carries pressure"),
}
"""Unit and meaning of each field of a step."""


def dataset(step: Step) -> xarray.Dataset:
    """The fields of a step over x and y."""
    import xarray

    def attributes(unit: str | None, meaning: str) -> dict[str, str]:
        return {"long_name": meaning} | ({} if unit is None else {"units": unit if step.is_si else "case units"})

    fields = {name: (("x", "y"), getattr(step, name), attributes(*about)) for name, about in FIELDS.items()}
    axes = {axis: (axis, step.x, attributes("m", f"{axis} of the element's centre")) for axis in ("x", "y")}
    return xarray.Dataset(fields, axes, {"force": step.force, "penetration": step.penetration, "status": step.status})


def pressure_map(step: Step, ax: Any) -> Any:
    """The pressure seen from above, x to the right and y upwards."""
    import matplotlib.pyplot as plt
    from matplotlib.ticker import EngFormatter, MaxNLocator

    ax = plt.subplots()[1] if ax is None else ax
    half = 0.5 * step.x.size * (step.x[1] - step.x[0]) if step.x.size > 1 else 0.5
    image = ax.imshow(step.pressure.T, origin="lower", extent=(-half, half, -half, half), cmap="viridis")
    bar = ax.figure.colorbar(image, ax=ax, label="pressure")
    force, penetration = (quantity(value, unit, step) for value, unit in ((step.force, "N"), (step.penetration, "m")))
    ax.set(xlabel="x", ylabel="y", title=f"Q = {force}, D = {penetration}")
    if step.is_si:
        for axis, unit in ((ax.xaxis, "m"), (ax.yaxis, "m"), (bar.ax.yaxis, "Pa")):
            axis.set_major_formatter(EngFormatter(unit))
        # Numbers with units are wide.
        ax.xaxis.set_major_locator(MaxNLocator(4))
    return ax


def quantity(value: float, unit: str, step: Step) -> str:
    """A number with a prefix and its unit, if the step is in SI units."""
    from matplotlib.ticker import EngFormatter

    return str(EngFormatter(unit, places=2).format_data(value)) if step.is_si else f"{value:.4g}"


def table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """An HTML table of texts."""
    head = "".join(f"<th>{escape(cell)}</th>" for cell in header)
    body = "".join(f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in row)}</tr>" for row in rows)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def step_rows(step: Step) -> list[tuple[str, str]]:
    """The main numbers of a step."""
    return [
        ("force", f"{step.force:.6g}"),
        ("penetration", f"{step.penetration:.6g}"),
        ("max pressure", f"{step.max_pressure:.6g}"),
        ("contact area", f"{step.contact_area:.6g}"),
        ("certificate", f"{step.certificate.worst:.1e}"),
        ("status", step.status),
    ]


def keys(tables: Mapping[str, Any], prefix: str = "") -> list[tuple[str, str]]:
    """Dotted keys and values of nested tables."""
    rows: list[tuple[str, str]] = []
    for key, value in tables.items():
        name = f"{prefix}{key}"
        if isinstance(value, Mapping):
            rows += keys(value, f"{name}.")
        elif isinstance(value, list) and value and isinstance(value[0], Mapping):
            for i, item in enumerate(value):
                rows += keys(item, f"{name}[{i}].")
        else:
            rows.append((name, str(value)))
    return rows
