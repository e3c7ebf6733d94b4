"""Error classes: their attributes match their documentation, and they survive pickling."""

from __future__ import annotations

import ast
import pickle
import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import pellicle as pl
from pellicle import _pellicle

PYTHON = Path(__file__).resolve().parents[1]

# The program's enums whose fields become attributes of each class; an error may pass on those of its inner errors.
ENUMS = {
    "KernelError": ["KernelError"],
    "InfluenceError": ["InfluenceError", "KernelError"],
    "TextureError": ["TextureError"],
    "IndenterError": ["IndenterError"],
    "ContactError": ["ContactError", "TextureError", "IndenterError", "InfluenceError", "KernelError"],
    "IdentifyError": ["IdentifyError"],
    "RunError": ["Failure", "FileError", "Error"],
}


def documented(kind: type[Exception]) -> set[str]:
    """The attributes that the docstring names."""
    return set(re.findall(r"`(\w+)`", kind.__doc__ or ""))


def declared() -> dict[str, set[str]]:
    """The attributes of each class in the stub."""
    stub = ast.parse((PYTHON / "pellicle" / "_pellicle.pyi").read_text(encoding="utf-8"))
    classes = [node for node in stub.body if isinstance(node, ast.ClassDef)]
    return {
        node.name: {part.target.id for part in node.body if isinstance(part, ast.AnnAssign) and isinstance(part.target, ast.Name)}
        for node in classes
    }


def set_by_the_module() -> dict[str, set[str]]:
    """The fields of each enum that the module sets as attributes."""
    source = (PYTHON / "src" / "error" / "attributes.rs").read_text(encoding="utf-8")
    found: dict[str, set[str]] = {}
    for enum, variants in re.findall(r"fields!\(py, value, \w+, (\w+) \{\n(.*?)\n\s*\}\)", source, re.DOTALL):
        fields = re.findall(r"\w+ \{ ([\w, ]+) \}", variants)
        found[enum] = {name for names in fields for name in names.split(", ")}
    found["Failure"] |= set(re.findall(r'value\.setattr\("(\w+)"', source))
    return found


@pytest.mark.parametrize("name", [*ENUMS, "CaseError"])
def test_an_error_documents_all_of_its_attributes(name: str) -> None:
    names = documented(getattr(pl, name))
    assert names and names == declared()[name]
    if name in ENUMS:
        fields = set_by_the_module()
        assert names == set().union(*(fields[enum] for enum in ENUMS[name]))


def test_every_error_belongs_to_the_package_and_has_a_docstring() -> None:
    kinds = [kind for kind in vars(pl).values() if isinstance(kind, type) and issubclass(kind, Exception)]
    errors = [kind for kind in kinds if not issubclass(kind, Warning)]
    assert len(errors) == 11
    for kind in errors:
        assert issubclass(kind, pl.Error) and kind.__doc__ and kind.__module__.startswith("pellicle")


GLASS = pl.Foundation(pl.Material("70 GPa", 0.22))


def few_points() -> None:
    data = pl.Data.of_arrays(force=[1e-3, 2e-3, 3e-3], depth=[1e-8, 2e-8, 3e-8])
    unknown = {
        "foundation.substrate.young_modulus": ("1 GPa", "1 TPa"),
        "indenter.radius": ("1 um", "1 mm"),
    }
    pl.identify(pl.Fit(pl.Case(GLASS, pl.Paraboloid("10 um"), force=1e-3), data, unknown=unknown))


RAISED: list[tuple[Callable[[], object], type[pl.Error], set[str]]] = [
    (lambda: pl.Case.from_string("[foundation]"), pl.CaseError, {"key", "line", "found", "wanted", "help"}),
    (lambda: pl.ElasticOperator(GLASS, -1e-6, 4), pl.InfluenceError, {"found"}),
    (
        lambda: _pellicle.DiscreteProblem(pl.Case(GLASS, pl.Sphere(1.0), force=1.0, elements=8)._case).displacement(np.zeros((2, 2))),
        pl.ContactError,
        {"field", "found", "wanted"},
    ),
    (few_points, pl.IdentifyError, {"points", "wanted"}),
    (lambda: pl.Case.from_toml("none.toml"), pl.RunError, {"path"}),
]


@pytest.mark.parametrize(("fails", "kind", "names"), RAISED, ids=[kind.__name__ for _, kind, _ in RAISED])
def test_an_error_has_its_numbers_as_attributes_and_preserves_them_in_a_pickle(
    fails: Callable[[], object], kind: type[pl.Error], names: set[str]
) -> None:
    with pytest.raises(pl.Error) as raised:
        fails()
    error = raised.value
    assert type(error) is kind
    attributes = {name: value for name, value in vars(error).items() if not name.startswith("__")}
    assert attributes.keys() == names <= documented(kind)
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is kind and str(again) == str(error)
    assert {name: getattr(again, name) for name in names} == attributes
