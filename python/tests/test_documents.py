"""The Python examples in the documents run unchanged."""

from __future__ import annotations

import doctest
import importlib.metadata
import re
from pathlib import Path

import pytest

import pellicle

ROOT = Path(__file__).resolve().parents[2]


def blocks(document: str) -> list[str]:
    return re.findall(r"^```python\n(.*?)^```", (ROOT / document).read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)


@pytest.mark.parametrize("document", ["README.md", "docs/python.md", "python/README.md"])
def test_the_examples_of_a_document_run_in_order(
    document: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    # Some write files.
    monkeypatch.chdir(tmp_path)
    found = blocks(document)
    assert found
    names: dict[str, object] = {}
    for block in found:
        exec(compile(block, document, "exec"), names)


@pytest.mark.parametrize("licence", ["LICENSE-APACHE", "LICENSE-MIT"])
def test_the_wheel_contains_the_licences_of_the_repository(licence: str) -> None:
    text = (ROOT / licence).read_text(encoding="utf-8")
    assert (ROOT / "python" / licence).read_text(encoding="utf-8") == text
    files = importlib.metadata.files("pellicle") or []
    assert [file.read_text(encoding="utf-8") for file in files if file.name == licence] == [text]


def test_the_example_of_the_package_runs() -> None:
    failed, tried = doctest.testmod(pellicle)
    assert tried > 0 and failed == 0
