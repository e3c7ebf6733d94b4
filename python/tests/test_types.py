"""The package's types are complete, and the examples in the documents pass type checking."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("basedpyright", reason="pyright as a package with a Node.js of its own")

ROOT = Path(__file__).resolve().parents[2]
DOCUMENTS = ["README.md", "docs/python.md", "python/README.md"]


def pyright(*arguments: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """Runs pyright with only the installed packages."""
    environment = os.environ | {"VIRTUAL_ENV": sys.prefix, "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"}
    command = [sys.executable, "-m", "basedpyright", *arguments]
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)


def test_every_public_name_has_a_type(tmp_path: Path) -> None:
    ran = pyright("--verifytypes", "pellicle", "--ignoreexternal", folder=tmp_path)
    assert ran.returncode == 0 and "Type completeness score: 100%" in ran.stdout, ran.stdout


def test_the_examples_in_the_documents_are_strictly_typed(tmp_path: Path) -> None:
    for document in DOCUMENTS:
        text = (ROOT / document).read_text(encoding="utf-8")
        blocks = re.findall(r"^```python\n(.*?)^```", text, re.DOTALL | re.MULTILINE)
        assert blocks
        (tmp_path / f"{document.replace('/', '_')}.py").write_text("\n".join(blocks), encoding="utf-8")
    # A block may repeat an import of another, and functions in examples need no type annotations.
    lax = ["DuplicateImport", "MissingParameterType", *(f"Unknown{of}Type" for of in ("Parameter", "Argument", "Variable"))]
    settings = {"typeCheckingMode": "strict"} | {f"report{rule}": False for rule in lax}
    (tmp_path / "pyrightconfig.json").write_text(json.dumps(settings))
    ran = pyright(folder=tmp_path)
    assert ran.returncode == 0, ran.stdout
    (tmp_path / "wrong.py").write_text("import pellicle as pl\npl.Sphere([1.0])\n")
    assert "wrong.py" in pyright(folder=tmp_path).stdout
