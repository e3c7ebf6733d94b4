"""Cases and results as HTML, for notebooks."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from html import escape
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .step import Step


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
