"""Writes the tables of a case or a fit as TOML, laid out as a person would."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any, TypeAlias

from .errors import ArgumentError

Value: TypeAlias = Any
"""A string, an integer, a float, a truth value, a list of values or a table of them."""


def text(document: Mapping[str, Value]) -> str:
    """The document as TOML: plain values first, then each table under its own header."""
    return "\n".join(_sections(document)).lstrip("\n") + "\n"


def _sections(document: Mapping[str, Value]) -> Iterator[str]:
    for key, value in document.items():
        if not (isinstance(value, Mapping) or _is_list_of_tables(value)):
            yield f"{_key(key)} = {_inline(value)}"
    for key, value in document.items():
        if isinstance(value, Mapping):
            yield from _table(_key(key), value)
        elif _is_list_of_tables(value):
            yield from _list(_key(key), value)


def _table(name: str, table: Mapping[str, Value]) -> Iterator[str]:
    """A table under its header, and lists of tables in it under theirs."""
    yield f"\n[{name}]"
    lists = {key: value for key, value in table.items() if _is_list_of_tables(value)}
    for key, value in table.items():
        if key not in lists:
            yield f"{_key(key)} = {_inline(value)}"
    for key, items in lists.items():
        yield from _list(f"{name}.{_key(key)}", items)


def _list(name: str, items: list[Mapping[str, Value]]) -> Iterator[str]:
    for item in items:
        yield f"\n[[{name}]]"
        yield from (f"{_key(key)} = {_inline(value)}" for key, value in item.items())


def _key(key: str) -> str:
    """A key, in quotes unless it is one word."""
    is_bare = key.isascii() and key.replace("_", "a").replace("-", "a").isalnum()
    return key if is_bare else _inline(key)


def _is_list_of_tables(value: Value) -> bool:
    return isinstance(value, list) and bool(value) and all(isinstance(item, Mapping) for item in value)


def _inline(value: Value) -> str:
    match value:
        case bool():
            return "true" if value else "false"
        case str():
            # JSON escapes like TOML, except for the control character DEL.
            return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007F")
        case Mapping():
            pairs = ", ".join(f"{_key(key)} = {_inline(item)}" for key, item in value.items())
            return f"{{ {pairs} }}"
        case list():
            return f"[{', '.join(map(_inline, value))}]"
        case int() | float():
            # The shortest digits that restore the same number.
            return repr(value)
        case _:
            raise ArgumentError(f"found {type(value).__name__}, wanted a value that a case file can hold")
