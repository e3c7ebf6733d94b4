"""Shapes given by functions: sampled at element centres, checked, compared, pickled, called without deadlock."""

from __future__ import annotations

import gc
import pickle
import threading
import weakref
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import pellicle as pl

Array = npt.NDArray[np.float64]

RADIUS = 0.5e-3
PERIOD, TOP, HEIGHT, MODULUS = 6e-6, 2e-6, 1e-6, 3e9


def paraboloid(x: Array, y: Array) -> Array:
    """The heights of `pl.Paraboloid`, with the same order of summation."""
    return (x * x + y * y) / (2 * RADIUS)


def plane(x: Array, y: Array) -> Array:
    """A surface without relief."""
    return 0 * x


@dataclass
class Cylinders:
    """A value on periodic cylinders and another between them."""

    between: float
    on: float
    offset: float

    def __call__(self, x: Array, y: Array) -> Array:
        distances = [z - PERIOD * np.rint(z / PERIOD) for z in (x - self.offset, y)]
        return np.where(np.hypot(*distances) <= TOP, self.on, self.between)


def relief(offset: float = 0.3e-6) -> pl.ReliefFunction:
    """Cylinders as functions, off the axis by default, so that neither is solved on a quadrant."""
    compliance = Cylinders(0.0, HEIGHT / MODULUS, offset)
    return pl.ReliefFunction(Cylinders(-HEIGHT, 0.0, offset), compliance=compliance)


LOAD: dict[str, Any] = {"force": "20 mN", "side": "60 um", "elements": 64, "tolerance": 1e-12}


def test_a_function_gives_the_same_problem_as_its_shape(body: pl.Foundation) -> None:
    # A surface given by a function has no known symmetry, so both are solved on the whole grid.
    load: dict[str, Any] = {"forces": ["5 mN", "50 mN"], "side": "40 um", "elements": 64, "surface": plane}
    cases = [pl.Case(body, shape, **load, tolerance=1e-13) for shape in (paraboloid, pl.Paraboloid(RADIUS))]
    assert np.array_equal(pl.DiscreteProblem(cases[0]).initial_gap, pl.DiscreteProblem(cases[1]).initial_gap)
    for found, wanted in zip(*(case.solve() for case in cases), strict=True):
        # The initial guesses differ in their last bits.
        assert found.penetration == pytest.approx(wanted.penetration, rel=1e-12)
        np.testing.assert_allclose(found.pressure, wanted.pressure, atol=2e-11 * wanted.max_pressure)


def test_with_an_automatic_side_a_function_is_solved_like_its_shape(body: pl.Foundation) -> None:
    found, wanted = (
        pl.Case(body, indenter, force="50 mN", elements=64, tolerance=1e-12).solve()[0]
        for indenter in (paraboloid, pl.Paraboloid(RADIUS))
    )
    # The side comes from numerical means over circles, and one is solved on a quadrant: rounding, and the tolerance.
    assert found.x[0] == pytest.approx(wanted.x[0], rel=1e-12)
    assert found.penetration == pytest.approx(wanted.penetration, rel=1e-11)
    np.testing.assert_allclose(found.pressure, wanted.pressure, atol=1e-8 * wanted.max_pressure)


def test_periodic_functions_of_cylinders_are_solved_like_cylinders(body: pl.Foundation) -> None:
    cylinders = pl.Cylinders(TOP, HEIGHT, PERIOD, young_modulus=MODULUS, offset=(0.3e-6, 0.0))
    found, wanted = (
        pl.Case(body, pl.Paraboloid(RADIUS), surface=surface, **LOAD).solve()[0] for surface in (relief(), cylinders)
    )
    assert found.contact_elements == wanted.contact_elements and wanted.contact_elements < 64 * 64 / 4
    assert found.penetration == pytest.approx(wanted.penetration, rel=1e-12)
    # The effect of a tolerance of 1e-12.
    np.testing.assert_allclose(found.pressure, wanted.pressure, atol=1e-11 * wanted.max_pressure)
    assert np.array_equal(found.profile, wanted.profile)
    np.testing.assert_allclose(found.shortening, wanted.shortening, atol=1e-11 * wanted.penetration)


def test_a_compliance_may_be_a_single_number_with_unit(body: pl.Foundation) -> None:
    film = pl.Film("1 um", "3 GPa")
    function = pl.ReliefFunction(plane, compliance=f"{1e-6 / 3e9 * 1e18!r} nm/GPa")
    found, wanted = (pl.Case(body, paraboloid, surface=surface, **LOAD).solve()[0] for surface in (function, film))
    assert found.penetration == pytest.approx(wanted.penetration, rel=1e-12)
    resolved = pl.Case(body, paraboloid, surface=function, **LOAD).resolved
    assert resolved["indenter"] == {"kind": "function"}
    assert resolved["surface"] == {"kind": "function", "compliance": pytest.approx(1e-6 / 3e9, rel=1e-14)}
    with pytest.raises(pl.CaseError, match="surface.compliance"):
        pl.Case(body, paraboloid, surface=pl.ReliefFunction(plane, compliance="-1 nm/GPa"), **LOAD)


def test_an_indenter_function_may_be_elastic_and_of_finite_extent(body: pl.Foundation) -> None:
    def punch(x: Array, y: Array) -> Array:
        return np.where(np.hypot(x, y) < 8e-6, 0.0, np.inf)

    elastic: dict[str, Any] = {"young_modulus": "1141 GPa", "poisson_ratio": 0.07}
    load: dict[str, Any] = {"force": "5 mN", "side": "40 um", "elements": 64, "surface": plane}
    found = pl.Case(body, pl.IndenterFunction(punch, **elastic), **load).solve()[0]
    wanted = pl.Case(body, pl.FlatPunch("8 um", **elastic), **load).solve()[0]
    np.testing.assert_allclose(found.pressure, wanted.pressure, atol=1e-6 * wanted.max_pressure)
    assert found.penetration == pytest.approx(wanted.penetration, rel=1e-9)
    assert np.isinf(found.gap[0, 0]) and found.certificate


def test_a_function_is_evaluated_once_per_element_and_grid_and_once_more_for_fields(body: pl.Foundation) -> None:
    seen: list[bytes] = []

    def counted(x: Array, y: Array) -> Array:
        assert x.dtype == y.dtype == np.float64 and x.shape == y.shape and x.ndim == 1
        points = np.stack([x, y], axis=1)
        assert len(np.unique(points, axis=0)) == len(points)
        if x.size in (32**2, 16**2, 64**2):
            seen.append(points.tobytes())
        return paraboloid(x, y)

    path = pl.Case(body, counted, forces=["5 mN", "50 mN"], side="40 um", elements=64).solve()
    assert len(seen) == len(set(seen)) == 3
    finest = max(seen, key=len)
    for step in path:
        assert step.gap.shape == step.shortening.shape == step.profile.shape
    assert seen[3:] == [finest]
    # In the order of the elements, exactly at their centres.
    points = np.frombuffer(finest).reshape(64, 64, 2)
    assert np.array_equal(points[:, 5, 0], path[0].x) and np.array_equal(points[7, :, 1], path[0].y)


def test_an_estimate_calls_a_function_a_bounded_number_of_times(body: pl.Foundation) -> None:
    calls = 0

    def counted(x: Array, y: Array) -> Array:
        nonlocal calls
        calls += 1
        return paraboloid(x, y)

    pl.Case(body, counted, forces=pl.Range("1 mN", "50 mN", 20), elements=32).solve()
    # 190 radii of circles, which are cached, and the grids and surroundings of a few trials; for each of 20 loads the
    # slope at up to 12 points of the contact's edge, from 8 heights each.
    assert calls < 400 + 20 * 12 * 8


WRONG: list[tuple[Callable[[Array, Array], Any], str]] = [
    (lambda x, y: x[:2], "found values of shape"),
    (lambda x, y: 0.0, "found values of shape"),
    (lambda x, y: x[:, None] + y, "found values of shape"),
    (lambda x, y: x + 1j, "found values of complex128"),
    (lambda x, y: x > 0, "found values of bool"),
    (lambda x, y: x.astype(str), "found values of <U32"),
    (lambda x, y: np.where(x > 0, np.nan, abs(x)), "found nan at"),
    (lambda x, y: x - np.inf, "found -inf at"),
    (lambda x, y: None, "found values of shape"),
]


@pytest.mark.parametrize(("function", "found"), WRONG)
def test_invalid_values_of_a_function_are_refused_naming_the_function(
    body: pl.Foundation, function: Callable[[Array, Array], Any], found: str
) -> None:
    with pytest.raises(pl.ArgumentError, match=f"^indenter: {found}"):
        pl.Case(body, function, **LOAD).solve()
    with pytest.raises(pl.ArgumentError, match=f"^profile: {found}"):
        pl.Case(body, paraboloid, surface=function, **LOAD).solve()
    with pytest.raises(pl.ArgumentError, match=f"^compliance: {found}"):
        pl.Case(body, paraboloid, surface=pl.ReliefFunction(plane, compliance=function), **LOAD).solve()


def test_only_an_indenter_may_end_and_compliances_are_not_negative(body: pl.Foundation) -> None:
    with pytest.raises(pl.ArgumentError, match="^profile: found inf at .* wanted a finite number"):
        pl.Case(body, paraboloid, surface=lambda x, y: x + np.inf, **LOAD).solve()
    pulling = pl.ReliefFunction(plane, compliance=lambda x, y: 0 * x - 1e-18)
    with pytest.raises(pl.ArgumentError, match="^compliance: found -1e-18 at .* wanted a finite number of zero or more"):
        pl.Case(body, paraboloid, surface=pulling, **LOAD).solve()


@pytest.mark.parametrize("value", [pl.Sphere, 3, "sphere"])
def test_an_object_that_is_not_a_function_is_refused_when_the_case_is_built(body: pl.Foundation, value: Any) -> None:
    with pytest.raises(pl.ArgumentError, match="indenter: found .*, wanted a pellicle.Indenter"):
        pl.Case(body, value, force=1.0)
    with pytest.raises(pl.ArgumentError, match="function: found .*, wanted a function of x and y"):
        pl.IndenterFunction(value)


def test_a_function_may_be_nan_far_outside_the_domain(body: pl.Foundation) -> None:
    def ball(x: Array, y: Array) -> Array:
        height = RADIUS - np.sqrt(RADIUS**2 - x * x - y * y)  # NaN beyond the ball
        return np.asarray(height)

    load: dict[str, Any] = {"force": "50 mN", "elements": 64, "surface": plane}
    found, wanted = (pl.Case(body, indenter, **load).solve()[0] for indenter in (ball, pl.Sphere(RADIUS)))
    assert found.penetration == pytest.approx(wanted.penetration, rel=1e-4)


class Lost(KeyError):
    """An exception defined by the caller."""


def fails_when(condition: Callable[[Array], bool]) -> Callable[[Array, Array], Array]:
    """A paraboloid that fails for arrays satisfying the condition."""

    def failing(x: Array, y: Array) -> Array:
        if condition(x):
            raise Lost("the way")
        return paraboloid(x, y)

    return failing


@pytest.mark.parametrize("size", [360, 4, 16**2, 64**2, 3 * 64**2], ids=["guess", "axis", "coarse", "fine", "outside"])
def test_an_exception_of_a_function_reaches_the_caller_unchanged(body: pl.Foundation, size: int) -> None:
    case = pl.Case(body, fails_when(lambda x: x.size == size), force="5 mN", side="40 um", elements=64)
    with pytest.raises(Lost, match="the way") as error:
        case.solve()
    assert type(error.value) is Lost and error.traceback[-1].name == "failing"
    # Nothing is left behind that would prevent other solutions.
    assert pl.Case(body, paraboloid, force="5 mN", side="40 um", elements=64).solve().status == "certified"


def test_exceptions_of_fields_problems_and_fits_reach_the_caller_too(body: pl.Foundation) -> None:
    is_wrong = False
    case = pl.Case(body, fails_when(lambda x: is_wrong), force="5 mN", side="40 um", elements=32)
    step = case.solve()[0]
    data = pl.Data.of_arrays(
        force=np.array([0.5, 0.75, 1.0]) * step.force,
        depth=np.array([0.6, 0.8, 1.0]) * step.penetration,
        noise=pl.Noise(depth="1 nm"),
    )
    fit = pl.Fit(case, data, unknown={"foundation.layer[0].young_modulus": ("100 GPa", "400 GPa")})
    is_wrong = True
    for fails in (lambda: step.gap, lambda: pl.DiscreteProblem(case), lambda: pl.identify(fit)):
        with pytest.raises(Lost):
            fails()
    is_wrong = False
    assert (step.gap[step.contact] <= 1e-6 * step.penetration).all()


def test_an_interrupt_in_a_function_interrupts_the_solution(body: pl.Foundation) -> None:
    def interrupted(x: Array, y: Array) -> Array:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        pl.Case(body, interrupted, **LOAD).solve()


def test_functions_enter_the_discrete_problem(body: pl.Foundation) -> None:
    case = pl.Case(body, paraboloid, surface=relief(), **LOAD)
    step, problem = case.solve()[0], pl.DiscreteProblem(case)
    assert problem.judge(step.pressure, force=step.force).certificate
    x, y = np.meshgrid(step.x, step.y, indexing="ij")
    assert np.array_equal(problem.initial_gap, paraboloid(x, y) - step.profile)
    assert np.array_equal(problem.relief_compliance, Cylinders(0.0, HEIGHT / MODULUS, 0.3e-6)(x, y))


def test_stresses_and_derivatives_of_a_function_match_its_shape(body: pl.Foundation) -> None:
    strong = pl.Foundation(pl.Material("3 GPa", 0.35, yield_strength="20 MPa"), body.layers)
    output: dict[str, Any] = {"sensitivities": True, "stress": pl.Stress(), "surface": plane}
    load: dict[str, Any] = {"forces": ["5 mN", "50 mN"], "side": "40 um", "elements": 32}
    found, wanted = (pl.Case(strong, shape, **load, **output).solve() for shape in (paraboloid, pl.Paraboloid(RADIUS)))
    critical, other = (path.summary["critical"][0] for path in (found, wanted))
    assert critical["force"] == pytest.approx(other["force"], rel=1e-9)
    of_mises, of_others = (path[1].stress(["1 um"])["von_mises"] for path in (found, wanted))
    np.testing.assert_allclose(of_mises, of_others, rtol=1e-9)
    derivatives, others = found[1].sensitivities(), wanted[1].sensitivities()
    # A function has no parameters.
    assert others.keys() - derivatives.keys() == {"indenter.radius"}
    for key, derivative in derivatives.items():
        assert derivative.penetration == pytest.approx(others[key].penetration, rel=1e-9), key


def test_a_fit_with_a_function_gives_the_result_of_its_shape(body: pl.Foundation) -> None:
    load: dict[str, Any] = {"forces": np.geomspace(5e-3, 5e-2, 6), "elements": 32, "surface": plane}
    curve = pl.Case(body, pl.Paraboloid(RADIUS), **load).solve().curve
    data = pl.Data.of_arrays(
        force=curve["force"], depth=curve["penetration"], noise=pl.Noise(depth="0.2 nm", correlation="none")
    )
    unknown = {"foundation.layer[0].young_modulus": ("50 GPa", "500 GPa")}
    fits = [pl.Fit(pl.Case(body, shape, **load), data, unknown=unknown) for shape in (paraboloid, pl.Paraboloid(RADIUS))]
    found, wanted = (pl.identify(fit).unknowns[0] for fit in fits)
    # The sides are chosen from means that are numerical for one and exact for the other: negligible beside the
    # interval.
    low, high = wanted.interval
    assert found.value == pytest.approx(wanted.value, abs=1e-4 * (high - low))
    assert pickle.loads(pickle.dumps(fits[0])) == fits[0] != fits[1]
    with pytest.raises(pl.ArgumentError, match="^profile and indenter: found a function, which cannot be written"):
        fits[0].to_toml()
    with pytest.raises(pl.CaseError, match="key `unknown.indenter.radius`: found an unknown key"):
        pl.Fit(pl.Case(body, paraboloid, **load), data, unknown={"indenter.radius": ("1 um", "1 mm")})


def test_a_function_cannot_be_written_to_a_file(body: pl.Foundation, tmp_path: Any) -> None:
    case = pl.Case(body, paraboloid, surface=relief(), **LOAD)
    for path in (None, tmp_path / "case.toml"):
        with pytest.raises(pl.ArgumentError, match="^profile and compliance and indenter: found a function, which cannot"):
            case.to_toml(path)
    assert not list(tmp_path.iterdir())
    with pytest.raises(pl.CaseError, match='"function"'):
        pl.Case.from_string(pl.Case(body, pl.FlatPunch(1.0), force=1.0).to_toml().replace("flat-punch", "function"))


def test_cases_of_functions_are_compared_and_pickled(body: pl.Foundation) -> None:
    case = pl.Case(body, paraboloid, surface=relief(), **LOAD)
    again = pickle.loads(pickle.dumps(case))
    assert again == case == pl.Case(body, paraboloid, surface=relief(), **LOAD)
    assert again.solve() == case.solve() == pickle.loads(pickle.dumps(case.solve()))
    assert repr(case) == "<Case 'case': function on 1 layer, 64 × 64 elements>"
    assert case != pl.Case(body, paraboloid, surface=relief(0.2e-6), **LOAD)
    assert case != pl.Case(body, plane, surface=relief(), **LOAD)
    assert case != pl.Case(body, paraboloid, **LOAD)
    assert case != pl.Case(body, paraboloid, surface=relief(), **LOAD | {"force": "21 mN"})
    assert case.replaced({"load.force": "21 mN"}) == pl.Case(body, paraboloid, surface=relief(), **LOAD | {"force": "21 mN"})
    # The function itself reports that it cannot be pickled.
    with pytest.raises((AttributeError, pickle.PicklingError)):
        pickle.dumps(pl.Case(body, lambda x, y: x * x + y * y, **LOAD))


def test_functions_and_shapes_are_solved_by_many_threads_at_once(body: pl.Foundation) -> None:
    load: dict[str, Any] = {"forces": ["5 mN", "50 mN"], "elements": 32}
    cases = [pl.Case(body, shape, **load) for shape in (paraboloid, pl.Sphere(RADIUS), paraboloid, pl.Paraboloid(RADIUS))]
    wanted = [case.solve() for case in cases]
    with ThreadPoolExecutor(8) as pool:
        found = [pool.submit(case.solve, threads=threads) for threads in (None, 1, 2, 3) for case in cases]
        paths = [future.result(timeout=120) for future in found]
    assert paths == wanted * 4


def test_a_function_that_waits_for_another_threads_solution_does_not_deadlock(body: pl.Foundation) -> None:
    other = pl.Case(body, pl.Sphere(RADIUS), force="50 mN", elements=32)
    wanted = other.solve()
    solved: list[pl.Path] = []

    def waiting(x: Array, y: Array) -> Array:
        if not solved:
            # One solution inside another, and one on a thread for which the function waits.
            solved.append(other.solve())
            thread = threading.Thread(target=lambda: solved.append(other.solve()))
            thread.start()
            thread.join(60)
        return paraboloid(x, y)

    assert pl.Case(body, waiting, force="50 mN", elements=32).solve().status == "certified"
    assert solved == [wanted, wanted]


def test_other_python_threads_run_while_a_case_of_functions_is_solved(body: pl.Foundation) -> None:
    case = pl.Case(body, paraboloid, forces=pl.Range("5 mN", "50 mN", 20), elements=128)
    done = threading.Event()
    turns = 0

    def solve() -> None:
        case.solve()
        done.set()

    solving = threading.Thread(target=solve)
    solving.start()
    while not done.wait(0.001):
        turns += 1
    solving.join()
    # It takes a few tenths of a second. If it held the interpreter throughout, there would be one or two turns.
    assert turns > 20


def test_functions_are_released_with_their_case(body: pl.Foundation) -> None:
    class Ball:
        """A paraboloid that allows weak references."""

        def __call__(self, x: Array, y: Array) -> Array:
            return paraboloid(x, y)

    function = Ball()
    gone = weakref.ref(function)
    case = pl.Case(body, function, force="5 mN", side="40 um", elements=16)
    path = case.solve()
    gap = path[0].gap
    del case, function, path
    gc.collect()
    assert gone() is None and gap.shape == (16, 16)
