"""The tables of a case or fit file, as frozen dataclasses whose fields are the table's keys."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any, ClassVar

from . import _pellicle, toml
from .given import taken
from .quantity import SI_UNITS, written


@dataclasses.dataclass(frozen=True)
class Table:
    """A table of a case file. Fields that are None are left out."""

    _kind: ClassVar[str | None] = None
    _names: ClassVar[Mapping[str, str]] = {}
    """Keys of fields that go by another name in Python, where the key is a word of the language."""
    _hidden: ClassVar[frozenset[str]] = frozenset()
    """Fields that are no keys."""
    _apart: ClassVar[frozenset[str]] = frozenset()
    """Fields that their class takes itself."""
    _units: ClassVar[Mapping[str, str]] = {}
    """Units of keys that have another one in other tables."""
    _part: ClassVar[str | None] = None
    """The part of a case that the table is, by which it is checked as soon as it is made; None for others."""

    def __post_init__(self) -> None:
        self._take()
        if self._part is not None:
            self._check(self._part, self.as_table())

    def _take(self) -> None:
        """Takes what was given, once: no caller can change it later."""
        for field in dataclasses.fields(self):
            if field.name not in self._hidden | self._apart:
                object.__setattr__(self, field.name, taken(field.name, getattr(self, field.name)))

    def _check(self, part: str, table: Mapping[str, toml.Value]) -> None:
        """Checks the table as this part of a case; a `CaseError` names the class and the key."""
        if table:
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
                found[self._names.get(field.name, field.name)] = value_of(field.name, value, unit, self._units)
        return found


def value_of(name: str, value: Any, unit: str | None = None, units: Mapping[str, str] = {}) -> toml.Value:
    """One value of a table as in the file; `unit` applies to quantities whose key has none, in `units` or at all."""
    value, key = taken(name, value), name.partition("[")[0]
    unit = units.get(key) or SI_UNITS.get(key, unit)
    if isinstance(value, Table):
        return value.as_value(unit)
    if isinstance(value, Mapping):
        return {key: value_of(key, item) for key, item in value.items()}
    if isinstance(value, tuple):
        return [value_of(f"{name}[{i}]", item, unit, units) for i, item in enumerate(value)]
    if unit is None or isinstance(value, bool):
        return value
    return written(value, name, unit)
