"""The parts of a case that are tables of its file: each a frozen dataclass whose fields are the table's keys."""

from __future__ import annotations

import dataclasses
from typing import Any, ClassVar

from . import toml
from .quantity import SI_UNITS, written


@dataclasses.dataclass(frozen=True)
class Table:
    """A table of a case file. A field that is None is a key that is left out."""

    _kind: ClassVar[str | None] = None

    def table(self) -> dict[str, toml.Value]:
        """The keys and values of the table as the case file has them."""
        fields = ((field.name, getattr(self, field.name)) for field in dataclasses.fields(self))
        kind = {} if self._kind is None else {"kind": self._kind}
        return kind | {name: value_of(name, value) for name, value in fields if value is not None}

    def value(self, unit: str | None) -> toml.Value:
        """The table as a value in another, where values are in this unit."""
        return self.table()


def value_of(name: str, value: Any) -> toml.Value:
    """One value of a table as the case file has it."""
    unit = SI_UNITS.get(name.partition("[")[0])
    if isinstance(value, Table):
        return value.value(unit)
    if hasattr(value, "tolist") and not hasattr(value, "to"):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return [value_of(f"{name}[{i}]", item) for i, item in enumerate(value)]
    return value if unit is None else written(value, name, unit)
