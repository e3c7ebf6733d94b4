"""Runs the README's Python example in an environment with only the wheel and NumPy; for tests of wheels."""

from __future__ import annotations

import importlib.metadata
import re
import sys
import threading
from pathlib import Path

import pellicle as pl

OTHERS = {"matplotlib", "tqdm", "xarray", "scipy", "pandas", "pint"}


def example() -> str:
    """The README's Python block."""
    readme = Path(__file__).resolve().parents[2] / "README.md"
    found = re.findall(r"^```python\n(.*?)^```", readme.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)
    assert len(found) == 1, f"found {len(found)} blocks of Python in the README, wanted one"
    return str(found[0])


def main() -> None:
    installed = {package.name.lower() for package in importlib.metadata.distributions()}
    assert not installed & OTHERS, f"found {installed & OTHERS}, wanted NumPy alone"
    names: dict[str, pl.Path] = {}
    exec(compile(example(), "README.md", "exec"), names)
    path = names["path"]
    assert path.status == "certified" and path[-1].pressure.shape == (256, 256)

    found: list[pl.Path] = []
    threads = [threading.Thread(target=lambda: found.append(path.case.solve())) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [path] * 4
    # The module must leave a free-threaded interpreter free-threaded.
    has_lock = getattr(sys, "_is_gil_enabled", lambda: True)()
    wants_lock = "free-threading" not in sys.version
    assert has_lock == wants_lock, "the module has switched the interpreter's lock on"
    print(f"pellicle {importlib.metadata.version('pellicle')} on Python {sys.version}: as it should be")


if __name__ == "__main__":
    main()
