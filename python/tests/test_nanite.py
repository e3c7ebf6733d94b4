"""The model for nanite: by itself, and as nanite loads and fits it where nanite is installed."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from typing import Any

import numpy as np
import pytest

MODEL = Path(__file__).parents[1] / "examples" / "nanite_layer.py"

DELTA = np.linspace(0.8e-6, -0.4e-6, 150)
GLASS = {"E_base": 70e9, "nu_base": 0.22}


@pytest.fixture(scope="module")
def model() -> Any:
    """The module as nanite imports it."""
    spec = importlib.util.spec_from_file_location("nanite_layer", MODEL)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def hertz(modulus: float) -> Any:
    """Hertz on a half-space of Poisson's ratio 0.5 under a ball of 10 µm."""
    return 4 / 3 * modulus / 0.75 * np.sqrt(10e-6) * np.maximum(-DELTA, 0) ** 1.5


def test_a_layer_like_its_base_gives_hertz(model: Any) -> None:
    force = model.layer(DELTA, 3e3, 10e-6, 0.5, 5e-6, 3e3, 0.5, baseline=1e-10)
    touching = DELTA < 0
    assert np.abs((force - 1e-10)[touching] / hertz(3e3)[touching] - 1).max() < 5e-4
    assert np.all(force[~touching] == 1e-10)


def test_a_bonded_incompressible_layer_on_glass_is_stiffer_as_in_the_thin_layer_series(model: Any) -> None:
    force = model.layer(DELTA, 3e3, 10e-6, 0.5, 20e-6, 70e9, 0.22)
    # Dimitriadis et al. (2002), bonded, ν = 0.5; its error at χ = 0.1 is a few 1e-3.
    chi = np.sqrt(10e-6 * np.maximum(-DELTA, 0)) / 20e-6
    series = hertz(3e3) * (1 + 1.133 * chi + 1.283 * chi**2 + 0.769 * chi**3 + 0.0975 * chi**4)
    touching = DELTA < -0.05e-6
    assert np.abs(force[touching] / series[touching] - 1).max() < 5e-3


# The search also tries contact points so far away that the layer would be pressed through.
@pytest.mark.filterwarnings("default::pellicle.NotCertifiedWarning")
def test_nanite_loads_the_model_and_finds_the_modulus() -> None:
    lmfit = pytest.importorskip("lmfit")
    models = pytest.importorskip("nanite.model")
    loaded = models.load_model_from_file(MODEL, register=True)
    # On a base of its own kind nanite's formula by Hertz gives the same.
    theirs = models.models_available["hertz_para"].module.model_func(DELTA, 3e3, 10e-6, 0.5)
    ours = loaded.module.model_func(DELTA, 3e3, 10e-6, 0.5, 5e-6, 3e3, 0.5)
    assert np.abs(ours - theirs).max() < 5e-4 * theirs.max()
    truth = loaded.get_parameter_defaults()
    truth["E"].value, truth["contact_point"].value, truth["baseline"].value = 2200, 5e-8, 2e-10
    force = loaded.model(truth, DELTA) + np.random.default_rng(0).normal(0, 1e-11, DELTA.size)
    sought = loaded.get_parameter_defaults()
    found = lmfit.minimize(loaded.residual, sought, args=(DELTA, force), kws={"weight_cp": 0})
    assert abs(found.params["E"].value - 2200) < 4 * found.params["E"].stderr < 40
