"""The notebooks run from top to bottom, draw the announced figures, and are stored without outputs."""

from __future__ import annotations

import ast
import json
from pathlib import Path
from typing import Any

import pytest

FOLDER = Path(__file__).resolve().parents[1] / "notebooks"
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))


def code_cells(notebook: Path) -> list[str]:
    document = json.loads(notebook.read_text(encoding="utf-8"))
    return ["".join(cell["source"]) for cell in document["cells"] if cell["cell_type"] == "code"]


def run_cell(code: str, names: dict[str, Any]) -> Any:
    """Runs a cell; returns the value of its last line as shown by a notebook, None without one."""
    tree = ast.parse(code)
    last = tree.body[-1]
    if not isinstance(last, ast.Expr):
        exec(compile(tree, "cell", "exec"), names)
        return None
    exec(compile(ast.Module(tree.body[:-1], []), "cell", "exec"), names)
    return eval(compile(ast.Expression(last.value), "cell", "eval"), names)


def test_there_are_four_notebooks() -> None:
    assert [notebook.stem for notebook in NOTEBOOKS] == ["coating-thickness", "first-curve", "measured-tip", "rough-contact"]


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda notebook: notebook.stem)
def test_notebooks_are_stored_without_outputs(notebook: Path) -> None:
    text = notebook.read_text(encoding="utf-8")
    document = json.loads(text)
    assert document["nbformat"] == 4 and text.endswith("}\n")
    for cell in document["cells"]:
        assert cell["cell_type"] in ("code", "markdown") and cell["id"]
        if cell["cell_type"] == "code":
            assert cell["outputs"] == [] and cell["execution_count"] is None


PICTURES = {"coating-thickness": 2, "first-curve": 4, "measured-tip": 3, "rough-contact": 2}


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda notebook: notebook.stem)
def test_a_notebook_runs_and_draws(notebook: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib").use("agg")
    import matplotlib.pyplot as plt

    monkeypatch.chdir(notebook.parent)
    plt.close("all")
    pictures: list[Path] = []

    def show() -> None:
        for number in plt.get_fignums():
            figure = plt.figure(number)
            assert all(ax.has_data() for ax in figure.axes)
            pictures.append(tmp_path / f"{notebook.stem}-{len(pictures)}.png")
            figure.savefig(pictures[-1])
            plt.close(figure)

    monkeypatch.setattr(plt, "show", show)
    names: dict[str, Any] = {}
    for code in code_cells(notebook):
        shown = run_cell(code, names)
        assert shown is None or shown._repr_html_()
    assert len(pictures) == PICTURES[notebook.stem]
    assert all(picture.stat().st_size > 5000 for picture in pictures)
    check(names, notebook.stem)


def check(names: dict[str, Any], notebook: str) -> None:
    """Checks the numbers stated in the text of a notebook."""
    if notebook == "first-curve":
        ratio, felt = names["radius"] / 2e-6, names["felt"]
        half = felt[abs(ratio - 0.5).argmin()] / 213.3e9
        far = felt[abs(ratio - 9).argmin()] / 3.419e9
        assert 0.07 < half < 0.13 and 1.2 < far < 1.35
        assert names["path"].status == "certified"
    elif notebook == "coating-thickness":
        assert names["found"] == pytest.approx(names["hertz"], rel=3e-3)
        order = [name for _, name in names["first"]]
        assert order[0] == "steel yields" and order[3] == "interface shears off" and order[-1] == "coating yields"
        loads = [load for load, _ in names["first"]]
        assert loads[3] < loads[2] and loads[-1] > 5 * loads[0]
    elif notebook == "rough-contact":
        assert names["path"].status == "certified"
        assert names["case"].solve()[0].summary["area_law"]["reduced_pressure"] == pytest.approx(
            names["reduced"][0], rel=2e-2
        )
        assert 1.6 < names["kappa"][0] < 2.5
    else:
        low, high = names["eight"]["indenter.radius"].interval
        assert low < names["one"]["indenter.radius"].value < high and high / low < 1.3
        assert [warning.code for warning in names["eight"].warnings] == ["common-misfit"]
        assert {unknown.verdict for unknown in names["two"]} == {"not-identifiable"}
