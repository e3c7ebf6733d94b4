"""Fits and plans from files and from arrays, the same as those of the command."""

from __future__ import annotations

import dataclasses
import json
import os
import pickle
import signal
import subprocess
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import pellicle as pl
from pellicle.measurement import UNITS

Array = npt.NDArray[np.float64]
Program = Callable[..., "subprocess.CompletedProcess[str]"]

COATING = "foundation.layer[0].young_modulus"
BASE = "foundation.substrate.young_modulus"


@pytest.fixture(scope="module")
def model() -> pl.Case:
    """A ball on a hard coating."""
    coating = pl.Layer("0.5 um", pl.Material("100 GPa", 0.25))
    return pl.Case(pl.Foundation(pl.Material("10 GPa", 0.3), [coating]), pl.Paraboloid("10 um"), force="1 mN")


@pytest.fixture(scope="module")
def measured(model: pl.Case) -> tuple[Array, Array]:
    """Forces and depths of the model with a noise of 0.2 nm."""
    loads = pl.Range("0.1 mN", "10 mN", 40, "log")
    path = model.replaced({"load": {"forces": loads.as_value("N")}, "grid.elements": 64}).solve()
    noise = np.random.default_rng(7).normal(0, 2e-10, 40)
    return np.array(path.curve["force"]), path.curve["penetration"] + noise


@pytest.fixture(scope="module")
def fit(model: pl.Case, measured: tuple[Array, Array]) -> pl.Fit:
    force, depth = measured
    data = pl.Data.of_arrays(force=force, depth=depth, noise=pl.Noise(depth="0.2 nm", correlation="none"))
    unknown: dict[str, Any] = {COATING: ("20 GPa", "500 GPa"), BASE: pl.Unknown(2e9, 50e9)}
    return pl.Fit(model, data, unknown=unknown, title="coating")


@pytest.fixture(scope="module")
def result(fit: pl.Fit) -> pl.Identification:
    return pl.identify(fit)


def timeless(found: dict[str, Any]) -> dict[str, Any]:
    return {**found, "work": {**found["work"], "seconds": None}}


def test_the_true_values_are_found(result: pl.Identification) -> None:
    assert result.verdict == "fitted" and result.is_whole
    # The 95 % intervals for this seed.
    for key, truth in ((COATING, 100e9), (BASE, 10e9)):
        low, high = result[key].interval
        assert low < truth < high and result[key].verdict == "identified"
    assert [estimate.key for estimate in result] == [COATING, BASE]
    with pytest.raises(KeyError):
        result["indenter.radius"]


def test_results_are_arrays_and_numbers(result: pl.Identification, measured: tuple[Array, Array]) -> None:
    force, depth = measured
    assert np.array_equal(result.curve["force"], force) and np.array_equal(result.curve["depth"], depth)
    model, residual = result.curve["model"], result.curve["residual"]
    # Rounding of numbers up to 3e-7.
    assert np.abs(depth - model - residual).max() < 1e-21
    assert result.correlation.shape == (2, 2) and result.covariance.shape == (2, 2)
    deviations = np.sqrt(np.diag(result.covariance))
    correlation = result.covariance[0, 1] / deviations.prod()
    assert correlation == pytest.approx(result.correlation[0, 1], abs=1e-12)
    exact = {number["key"]: number["exponents"] for number in result.taken_as_exact}
    assert all(len(exponents) == 2 for exponents in exact.values()) and "indenter.radius" in exact
    assert set(result.profiles["parameter"]) == {COATING, BASE}
    assert result.excluded is None and result.goodness["points"] == 40


def test_a_fit_written_to_a_file_gives_the_same_bits_in_the_program(
    fit: pl.Fit, result: pl.Identification, program: Program, tmp_path: Path
) -> None:
    fit.to_toml(tmp_path / "coating.toml")
    found = json.loads(program("identify", tmp_path / "coating.toml", "--json").stdout)
    assert found["curves"][0].pop("file").endswith("coating-data-0.csv")
    mine = result.to_dict()
    assert mine["curves"][0].pop("file") == "data-0.csv"
    assert timeless(mine) == timeless(found)
    again = pl.identify(tmp_path / "coating.toml", threads=1)
    assert again.unknowns == result.unknowns


def test_a_fit_file_gives_the_same_bits_as_in_the_program(program: Program, tmp_path: Path) -> None:
    text = """
[model]
foundation = { substrate = { young_modulus = "10 GPa", poisson_ratio = 0.3 } }
indenter = { kind = "paraboloid", radius = "10 um" }
[[data]]
file = "ball.csv"
columns = { depth = "h", force = "F" }
units = { depth = "nm", force = "mN" }
segment = { from = "0.1 mN", to = "10 mN" }
noise = { depth = "0.2 nm", relative = 0.01 }
[unknown.foundation.substrate]
young_modulus = { from = "2 GPa", to = "50 GPa" }
[report]
design = { forces = ["5 mN"] }
"""
    (tmp_path / "ball.toml").write_text(text)
    program("identify", tmp_path / "ball.toml", "--simulate", "--seed", 3, "--out", tmp_path / "ball.csv")
    folder = tmp_path / "results"
    program("identify", tmp_path / "ball.toml", "--quiet", "--out", folder)
    result = pl.identify(str(tmp_path / "ball.toml"))
    assert timeless(result.to_dict()) == timeless(json.loads((folder / "fit.json").read_text()))
    assert result.unknowns[0].key == BASE


def test_the_likelihood_falls_to_that_of_an_interval_at_its_ends(fit: pl.Fit, result: pl.Identification) -> None:
    likelihood = pl.Likelihood(fit)
    assert likelihood.keys == [COATING, BASE]
    assert np.array_equal(likelihood.best, [result[COATING].value, result[BASE].value])
    assert likelihood(likelihood.best) == 0
    # With the other modulus free it is -1.92 at the end, with the other one held it is lower.
    low, _ = result[COATING].interval
    assert -40 < likelihood([low, result[BASE].value]) < -1.9
    assert likelihood([1e9, result[BASE].value]) == -np.inf
    with pytest.raises(pl.IdentifyError) as error:
        likelihood([1e9])
    assert (error.value.found, error.value.wanted) == (1, 2)
    assert pickle.loads(pickle.dumps(likelihood))(likelihood.best) == 0


def test_a_plan_equals_that_of_the_program(model: pl.Case, program: Program, tmp_path: Path) -> None:
    design = pl.Design(forces=["1 mN", "10 mN"], radii=["1 um"])
    fit = pl.Fit(model, unknown={COATING: ("10 GPa", "1 TPa")}, report=pl.Report(design=design))
    with pytest.raises(pl.CaseError, match="data"):
        pl.identify(fit)
    reports: list[pl.FitProgress] = []
    plan = pl.plan(fit, progress=reports.append)
    assert reports[-1].planned == 2 and reports[-1].solved is None
    fit.to_toml(tmp_path / "design.toml")
    found = json.loads(program("identify", tmp_path / "design.toml", "--plan", "--json").stdout)
    mine = plan.to_dict()
    assert mine.pop("title") == "fit" and found.pop("title") == "design"
    assert timeless(mine) == timeless(found)
    assert [len(design.curves) for design in plan.designs] == [2, 1, 1]
    assert plan.designs[0].unknowns[0].factor > 1 and str(plan).startswith("fit: expected")
    assert len(plan.table[next(iter(plan.table))]) >= 3
    assert pickle.loads(pickle.dumps(plan)) == plan


def test_a_misfit_gives_a_result_with_a_warning(model: pl.Case, measured: tuple[Array, Array]) -> None:
    force, depth = measured
    bare = model.replaced({"foundation.layer": []})
    data = pl.Data.of_arrays(force=force, depth=depth, noise=pl.Noise(depth="0.2 nm", correlation="none"))
    with pytest.warns(pl.FitWarning, match="does not fit"):
        result = pl.identify(pl.Fit(bare, data, unknown={BASE: ("1 GPa", "100 GPa")}))
    assert result.verdict == "misfit" and result.goodness["misfit_p"] < 1e-6


def test_fits_and_results_survive_a_pickle(fit: pl.Fit, result: pl.Identification) -> None:
    assert pickle.loads(pickle.dumps(fit)) == fit
    again = pickle.loads(pickle.dumps(result))
    assert again == result and again[COATING] == result[COATING]
    assert "identified" in str(result) and "coating" in repr(result) and COATING in result._repr_html_()


def test_an_unidentifiable_unknown_has_a_known_combination(model: pl.Case, measured: tuple[Array, Array]) -> None:
    force, depth = measured
    data = pl.Data.of_arrays(force=force, depth=depth, noise=pl.Noise(depth="0.2 nm", correlation="none"))
    unknown: dict[str, Any] = {"indenter.radius": ("1 um", "100 um"), BASE: ("1 GPa", "100 GPa")}
    case = model.replaced({"foundation.layer": []})
    with pytest.warns(pl.FitWarning):
        radius = pl.identify(pl.Fit(case, data, unknown=unknown))["indenter.radius"]
    assert radius.verdict == "not-identifiable" and radius.interval == (-np.inf, np.inf)
    assert radius.known_combination is not None and "indenter.radius" in radius.known_combination.expression


def test_ctrl_c_keeps_the_result_so_far(model: pl.Case, measured: tuple[Array, Array]) -> None:
    signal.signal(signal.SIGINT, signal.default_int_handler)
    force, depth = measured
    keys = ["foundation.layer[0].thickness", COATING, BASE]
    bounds = [("0.05 um", "5 um"), ("20 GPa", "500 GPa"), ("2 GPa", "50 GPa")]
    data = pl.Data.of_arrays(force=force, depth=depth)
    fit = pl.Fit(model, data, unknown=dict(zip(keys, bounds, strict=True)))
    reported = threading.Event()

    def interrupt() -> None:
        reported.wait(60)
        os.kill(os.getpid(), signal.SIGINT)

    threading.Thread(target=interrupt).start()

    def watch(progress: pl.FitProgress) -> None:
        if progress.solved is not None and progress.solved >= 4:
            reported.set()

    with pytest.raises(pl.Interrupted) as interrupted:
        pl.identify(fit, progress=watch)
    start = time.monotonic()
    result = interrupted.value.result
    # The current load is finished; the fit does not start again.
    assert time.monotonic() - start < 2
    assert isinstance(result, pl.Identification) and not result.is_whole
    assert interrupted.value.path is None


@pytest.mark.parametrize(
    ("arrays", "message"),
    [
        ({"force": [1e-3, 2e-3], "depth": [1e-9, 2e-9, 3e-9]}, "force: found 2 values, wanted 3, as many as of depth"),
        ({"force": [1e-3, np.nan], "depth": [1e-9, 2e-9]}, r"force: found nan at \[1\], wanted finite numbers"),
        ({"force": np.ones((2, 2)), "depth": [1e-9, 2e-9]}, r"force: found an array of shape \(2, 2\)"),
        ({"force": ["a"], "depth": [1.0]}, "force: found 'a' .*, wanted a number, or a quantity in N"),
    ],
)
def test_arrays_that_are_not_a_curve_are_refused_by_name(arrays: dict[str, Any], message: str) -> None:
    with pytest.raises(pl.ArgumentError, match=message):
        pl.Data.of_arrays(**arrays)


def test_faults_of_a_fit_are_reported_with_their_keys(model: pl.Case, measured: tuple[Array, Array]) -> None:
    force, depth = measured
    data = pl.Data.of_arrays(force=force, depth=depth)
    with pytest.raises(pl.CaseError) as error:
        pl.Fit(model, data, unknown={"foundation.layer[7].young_modulus": (1e9, 2e9)})
    assert error.value.key is not None and "layer[7]" in error.value.key
    with pytest.raises(pl.ArgumentError, match="wanted a pellicle.Unknown or a pair of bounds"):
        pl.Fit(model, data, unknown={COATING: 3e9})  # type: ignore[dict-item]
    with pytest.raises(pl.ArgumentError, match="model: found str"):
        pl.Fit("case.toml", data, unknown={COATING: (1e9, 2e9)})  # type: ignore[arg-type]
    short = pl.Data.of_arrays(force=force[:3], depth=depth[:3])
    with pytest.raises(pl.IdentifyError) as few:
        pl.identify(pl.Fit(model, short, unknown={COATING: ("1 GPa", "1 TPa"), BASE: ("1 GPa", "1 TPa")}))
    assert few.value.points == 3 and few.value.wanted == 3


def test_priors_nuisances_and_repeats_are_written_as_the_fit_file_has_them(
    model: pl.Case, measured: tuple[Array, Array]
) -> None:
    force, depth = measured
    repeats = [pl.Data.of_arrays(force=force, depth=depth + 1e-9 * k, name=f"{k}.csv") for k in range(2)]
    prior = pl.Unknown(prior="lognormal", median="10 GPa", factor=1.05)
    nuisance = pl.Nuisances(
        depth_zero=True,
        force_zero=pl.Unknown(prior="normal", mean="0 mN", sd="1 nN"),
        drift=False,
        frame_compliance=pl.Unknown(prior="normal", mean="0 nm/mN", sd="0.01 nm/mN"),
        parameters={BASE: prior},
    )
    fit = pl.Fit(model, repeats, unknown={COATING: ("20 GPa", "500 GPa")}, nuisance=nuisance)
    result = pl.identify(fit)
    assert [curve["file"] for curve in result.curves] == ["0.csv", "1.csv"]
    shifts = [curve["depth_zero"] for curve in result.curves]
    assert all(abs(curve["force_zero"]) < 3e-9 for curve in result.curves)
    # The same curve again, a nanometre deeper.
    assert shifts[1] - shifts[0] == pytest.approx(1e-9, rel=1e-6)
    assert BASE in {estimate.key for estimate in result.nuisances}
    with pytest.raises(pl.ArgumentError, match="two arrays named"):
        pl.Fit(model, [repeats[0], dataclasses.replace(repeats[1], file="0.csv")], unknown={COATING: (1e9, 2e9)})


def test_a_measured_tip_as_an_array_is_the_indenter_of_a_fit(program: Program, tmp_path: Path) -> None:
    x = np.linspace(-3e-6, 3e-6, 41)
    tip = (x[:, None] ** 2 + x[None, :] ** 2) / 20e-6
    body = pl.Foundation(pl.Material("10 GPa", 0.3))
    loads = pl.Range("0.2 mN", "0.4 mN", 16)
    case = pl.Case(body, pl.IndenterMap(tip, side="6.15 um"), forces=loads, side="4 um", elements=64)
    curve = case.solve().curve
    depth = curve["penetration"] + np.random.default_rng(2).normal(0, 1e-10, 16)
    data = pl.Data.of_arrays(force=curve["force"], depth=depth, noise=pl.Noise(depth="0.1 nm", correlation="none"))
    fit = pl.Fit(case, data, unknown={BASE: ("2 GPa", "50 GPa")})
    result = pl.identify(fit)
    low, high = result[BASE].interval
    assert low < 10e9 < high
    fit.to_toml(tmp_path / "tip.toml")
    found = json.loads(program("identify", tmp_path / "tip.toml", "--json").stdout)
    assert found["unknowns"] == result.to_dict()["unknowns"]


def known_keys(place: str) -> set[str]:
    """The keys that the reader of fit files accepts in a table."""
    text = """
[model]
foundation = { substrate = { young_modulus = 1e9, poisson_ratio = 0.3 } }
indenter = { kind = "paraboloid", radius = 1e-5 }
[unknown]
"foundation.substrate.young_modulus" = { from = 1e9, to = 2e9 }
[[data]]
file = "none.csv"
columns = { depth = 1, force = 2 }
"""
    table, _, inner = place.partition(".")
    addition = {
        "data": f"{inner} = {{ no_such_key = 1 }}\n" if inner else "no_such_key = 1\n",
        "report": f"[report]\n{inner} = {{ no_such_key = 1 }}\n" if inner else "[report]\nno_such_key = 1\n",
        "unknown": "[unknown.\"foundation.substrate.poisson_ratio\"]\nfrom = 0.1\nto = 0.4\nno_such_key = 1\n",
    }[table]
    with pytest.raises(pl.CaseError) as error:
        pl.Fit.from_string(text + addition)
    assert error.value.key is not None and error.value.key.endswith("no_such_key")
    assert error.value.wanted is not None
    return set(error.value.wanted.removeprefix("one of ").split(", "))


@pytest.mark.parametrize(
    ("place", "kind"),
    [
        ("data", pl.Data),
        ("data.text", pl.Text),
        ("data.segment", pl.Segment),
        ("data.noise", pl.Noise),
        ("unknown", pl.Unknown),
        ("report", pl.Report),
        ("report.design", pl.Design),
    ],
)
def test_no_table_of_the_fit_file_has_keys_that_its_class_lacks(place: str, kind: type[Any]) -> None:
    names = kind._names
    assert {names.get(field.name, field.name) for field in dataclasses.fields(kind)} == known_keys(place)


def test_columns_match_those_of_the_reader() -> None:
    text = "columns = { depth = 1, force = 2, no_such_key = 1 }\n"
    with pytest.raises(pl.CaseError) as error:
        pl.Fit.from_string(
            "[model]\nfoundation = { substrate = { young_modulus = 1e9, poisson_ratio = 0.3 } }\n"
            'indenter = { kind = "paraboloid", radius = 1e-5 }\n[unknown]\n'
            f'"foundation.substrate.young_modulus" = {{ from = 1e9, to = 2e9 }}\n[[data]]\nfile = "x"\n{text}'
        )
    assert error.value.wanted is not None
    assert set(error.value.wanted.removeprefix("one of ").split(", ")) - {"segment", "marker"} == UNITS.keys()
