"""Solving: progress, threads, Ctrl-C, forks and many solutions."""

from __future__ import annotations

import multiprocessing
import os
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor

import numpy as np
import pytest

import pellicle as pl


def pressures(case: pl.Case) -> bytes:
    """The bits of all pressures of a case."""
    return b"".join(step.pressure.tobytes() for step in case.solve())


def test_every_number_of_threads_gives_the_same_bits(case: pl.Case) -> None:
    paths = [case.solve(threads=threads) for threads in (1, 2, 3, None)]
    assert all(path == paths[0] for path in paths)
    assert [path.summary["timing"]["threads"] for path in paths[:3]] == [1, 2, 3]


@pytest.mark.parametrize("threads", [0, -1, 5000, True])
def test_an_invalid_number_of_threads_is_refused(case: pl.Case, threads: int) -> None:
    with pytest.raises(pl.ArgumentError, match="threads: found"):
        case.solve(threads=threads)


def test_the_environment_sets_the_number_of_threads(case: pl.Case) -> None:
    code = f"import pellicle as pl; print(pl.Case.from_string({case.to_toml()!r}).solve().summary['timing']['threads'])"
    environment = os.environ | {"RAYON_NUM_THREADS": "3"}
    found = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True)
    assert found.stdout.strip() == "3"


def test_many_python_threads_solve_at_the_same_time(case: pl.Case) -> None:
    wanted = pressures(case)
    with ThreadPoolExecutor(8) as pool:
        assert set(pool.map(pressures, [case] * 32)) == {wanted}


@pytest.mark.filterwarnings("ignore:This process:DeprecationWarning")
@pytest.mark.parametrize("method", ["fork", "spawn", "forkserver"])
def test_a_pool_of_processes_solves(case: pl.Case, method: str) -> None:
    with multiprocessing.get_context(method).Pool(2) as pool:
        paths = pool.map_async(pl.Case.solve, [case] * 4).get(timeout=60)
    assert paths == [case.solve()] * 4


@pytest.mark.filterwarnings("ignore:This process:DeprecationWarning")
@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_a_pool_of_processes_returns_complete_results_and_errors(body: pl.Foundation, method: str) -> None:
    x = np.linspace(-1e-5, 1e-5, 21)
    waves = pl.Rough(1e-9 * np.cos(1e6 * x)[:, None] * np.cos(2e6 * x), side="20 um")
    cases = [
        pl.Case(body, pl.Sphere("0.5 mm"), force=force, surface=waves, side="20 um", elements=32, sensitivities=True)
        for force in ("1 mN", "5 mN", "10 mN")
    ]
    wanted = [case.solve() for case in cases]
    with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context(method)) as pool:
        paths = list(pool.map(pl.Case.solve, cases, timeout=60))
        refused = pool.submit(pl.Case.from_toml, "none.toml").exception(timeout=60)
    assert paths == wanted
    for path, own in zip(paths, wanted, strict=True):
        assert path[0].sensitivities() == own[0].sensitivities()
        assert np.array_equal(path[0].gap, own[0].gap)
        assert np.array_equal(path[0].stress(["1 um"])["szz"], own[0].stress(["1 um"])["szz"])
    assert isinstance(refused, pl.RunError) and str(refused.path) == "none.toml"


def test_a_summary_has_the_roughness_of_its_maps_and_the_area_of_their_contact(body: pl.Foundation) -> None:
    x = np.linspace(-1e-5, 1e-5, 21)
    heights = 1e-9 * np.cos(1e6 * x)[:, None] * np.cos(2e6 * x)
    waves = pl.Rough(heights, side="20 um")
    path = pl.Case(body, pl.Sphere("0.5 mm"), force="5 mN", surface=waves, side="20 um", elements=32).solve()
    assert path.summary["roughness"]["surface"]["rms_height"] == pytest.approx(np.std(heights), rel=1e-9)
    area, rough = path[0].summary["area_law"], path[0].rough_contact
    assert rough and area["kappa"] * area["reduced_pressure"] == pytest.approx(rough["contact_fraction"], rel=1e-12)


def test_a_process_forked_while_another_thread_solves_can_solve(body: pl.Foundation, case: pl.Case) -> None:
    large = pl.Case(body, pl.Sphere("0.5 mm"), forces=pl.Range("5 mN", "50 mN", 40), elements=256)
    solving = threading.Thread(target=large.solve)
    solving.start()
    time.sleep(0.1)
    process = multiprocessing.get_context("fork").Process(target=case.solve)
    process.start()
    process.join(60)
    assert process.exitcode == 0
    solving.join()


def test_progress_is_reported_to_a_function_up_to_the_last_step(case: pl.Case) -> None:
    reports: list[pl.Progress] = []
    case.solve(progress=reports.append)
    assert reports[-1].steps == 2 and reports[-1].finished >= 1 and reports[-1].elements == 32


def test_a_bar_is_shown(case: pl.Case, capsys: pytest.CaptureFixture[str]) -> None:
    case.solve(progress=True)
    assert "two loads: 100%" in capsys.readouterr().err


def test_a_line_is_shown_without_tqdm(
    case: pl.Case, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    case.solve(progress=True)
    assert "/2, grid 32 × 32, iteration" in capsys.readouterr().err


def test_an_error_in_the_progress_function_ends_the_solution(case: pl.Case) -> None:
    def fail(progress: pl.Progress) -> None:
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        case.solve(progress=fail)


def interrupt_in(seconds: float) -> None:
    # A process started in the background ignores the signal by default.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    threading.Timer(seconds, os.kill, (os.getpid(), signal.SIGINT)).start()


def test_ctrl_c_returns_at_once_with_what_is_finished(body: pl.Foundation) -> None:
    case = pl.Case(body, pl.Sphere("0.5 mm"), forces=pl.Range("5 mN", "50 mN", 2000), elements=256)
    case.replaced({"load.forces": [0.005]}).solve()  # Computes the coefficients, which cannot be interrupted.
    start = time.monotonic()
    interrupt_in(1.0)
    with pytest.raises(pl.Interrupted) as interrupted:
        case.solve()
    # 0.2 s from the signal, and as much again for a busy machine.
    assert time.monotonic() - start < 1.4
    path = interrupted.value.path
    assert path is not None and 0 < len(path) < 2000 and not path.is_whole
    assert path.status == "certified"
    assert path.warnings[-1].message == f"stopped by the user after {len(path)} of 2000 loading steps"
    assert interrupted.value.path is path


def test_ctrl_c_before_the_first_step_leaves_no_path(body: pl.Foundation) -> None:
    case = pl.Case(body, pl.Sphere("0.5 mm"), force="50 mN", elements=2048)
    interrupt_in(0.3)
    with pytest.raises(KeyboardInterrupt) as interrupted:
        case.solve()
    assert isinstance(interrupted.value, pl.Interrupted)
    assert interrupted.value.path is None


SOLVE_MANY = """
import resource, sys, pellicle as pl
case = pl.Case.from_string(sys.argv[1])
other = pl.Case(pl.Foundation(pl.Material(1e9, 0.3)), lambda x, y: (x * x + y * y) / 1e-3, force=1e-3, elements=16)
def peak_after(solutions):
    for number in range(solutions):
        case.solve(threads=1)[0].gap.sum()
        if number % 20 == 0:
            other.solve(threads=2)[0].gap.sum()
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
before = peak_after(200)
print(peak_after(2000) - before)
"""


def test_memory_does_not_grow_with_the_number_of_solutions(body: pl.Foundation) -> None:
    case = pl.Case(body, pl.Sphere("0.5 mm"), force="5 mN", elements=16)
    # In a separate process, whose peak memory is not that of other tests.
    command = [sys.executable, "-c", SOLVE_MANY, case.to_toml()]
    found = subprocess.run(command, capture_output=True, text=True, check=True)
    # In kB: a leak of a tenth of a field per solution would be 2000 × 0.2 kB.
    assert int(found.stdout) < 400


def test_too_little_memory_is_an_error_with_its_numbers(case: pl.Case) -> None:
    code = (
        "import resource, pellicle as pl\n"
        "resource.setrlimit(resource.RLIMIT_AS, (2 << 30, 2 << 30))\n"
        f"case = pl.Case.from_string({case.to_toml()!r}).replaced({{'grid.elements': 8192}})\n"
        "try: case.solve()\n"
        "except pl.RunError as error: print(error.needed > error.available > 0, error)\n"
    )
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout.startswith("True found ") and "fewer elements" in found.stdout


def test_the_largest_average_is_a_number_of_a_step_if_a_length_is_given() -> None:
    body = pl.Foundation(pl.Material("210 GPa", 0.3))
    dimples = pl.Dimples("20 um", "2 um", area_fraction=0.2, edge_radius="30 um", rotation="15 deg")
    output = pl.Output(mean_pressure_over="20 um")
    case = pl.Case(body, pl.Paraboloid("5 mm"), surface=dimples, force="20 N", elements=64, output=output)
    step = case.solve()[0]
    average = step.max_averaged_pressure
    assert average is not None and step.mean_pressure < average < step.max_pressure
    assert step.grid_error.max_averaged_pressure is not None
    plain = pl.Case(body, pl.Paraboloid("5 mm"), surface=dimples, force="20 N", elements=64).solve()[0]
    assert plain.max_averaged_pressure is None and plain.max_pressure == step.max_pressure
