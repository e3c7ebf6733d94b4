"""The tables of a case or fit file, as frozen dataclasses whose fields are the table's keys."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any, ClassVar

from . import _pellicle, toml
from .quantity import SI_UNITS, written


@dataclasses.dataclass(frozen=True)
class Table:
    """A table of a case file. Fields that are None are left out."""

    _kind: ClassVar[str | None] = None
    _names: ClassVar[Mapping[str, str]] = {}
    """Keys of fields that go by another name in Python, where the key is a word of the language."""
    _hidden: ClassVar[frozenset[str]] = frozenset()
    """Fields that are no keys."""
    _part: ClassVar[str | None] = None
    """The part of a case that the table is, by which it is checked as soon as it is made; None for others."""

    def __post_init__(self) -> None:
        if self._part is not None:
            self._check(self._part, self.as_table())

    def _check(self, part: str, table: Mapping[str, toml.Value]) -> None:
        """Checks the table as this part of a case; a `CaseError` names the class and the key."""
        _pellicle.check_part(part, type(self).__name__, toml.text(table))

    def as_table(self) -> dict[str, toml.Value]:
        """The keys and values of the table as in the file."""
        return self._given(None)

    def as_value(self, unit: str | None) -> toml.Value:
        """The table as a value in another; values without their own unit are in `unit`."""
        return self.as_table() if unit is None else self._given(unit)

    def _given(self, unit: str | None) -> dict[str, toml.Value]:
        found: dict[str, toml.Value] = {} if self._kind is None else {"kind": self._kind}
        for field in dataclasses.fields(self):
            value = getattr(self, field.name)
            if value is not None and field.name not in self._hidden:
                found[self._names.get(field.name, field.name)] = value_of(field.name, value, unit)
        return found


def value_of(name: str, value: Any, unit: str | None = None) -> toml.Value:
    """One value of a table as in the file; `unit` applies to quantities whose key has no unit."""
    unit = SI_UNITS.get(name.partition("[")[0], unit)
    if isinstance(value, Table):
        return value.as_value(unit)
    if isinstance(value, Mapping):
        return {key: value_of(key, item) for key, item in value.items()}
    if hasattr(value, "tolist") and not hasattr(value, "to"):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return [value_of(f"{name}[{i}]", item, unit) for i, item in enumerate(value)]
    if unit is None or isinstance(value, bool):
        return value
    return written(value, name, unit)
