"""`import pellicle` loads NumPy and little else, so that a script starts at once."""

from __future__ import annotations

import json
import subprocess
import sys

# Of the standard library, what takes long to load and is needed by few scripts, if any.
SLOW = {"asyncio", "concurrent.futures", "email", "importlib.metadata", "multiprocessing", "sqlite3", "unittest", "urllib.request", "xml"}

LOADED = """
import json, sys, numpy
before = set(sys.modules)
import pellicle
print(json.dumps(sorted(set(sys.modules) - before)))
"""


def test_an_import_loads_no_other_package_than_numpy_and_nothing_slow() -> None:
    ran = subprocess.run([sys.executable, "-c", LOADED], capture_output=True, text=True, check=True)
    loaded = set(json.loads(ran.stdout))
    packages = {name.partition(".")[0] for name in loaded} - sys.stdlib_module_names
    assert {"pellicle"} <= packages <= {"pellicle", "numpy"}
    assert not loaded & SLOW
