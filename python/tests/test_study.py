"""Studies on Python engines: the same table as on one machine, to the byte, whichever workers solve or die."""

from __future__ import annotations

import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pellicle as pl

Program = Callable[..., object]

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"

# Two loads per case. Cases with a Poisson's ratio of 0.6 are invalid, and their rows give the reason.
STUDY = """
[study.vary]
foundation.substrate.poisson_ratio = [0.1, 0.2, 0.3, 0.6]
"foundation.layer[0].thickness" = { from = "0.5 um", to = "4 um", count = 10, spacing = "log" }

[foundation]
layer = [{ thickness = "1 um", young_modulus = "200 GPa", poisson_ratio = 0.25 }]
substrate = { young_modulus = "3 GPa", poisson_ratio = 0.35 }

[indenter]
kind = "sphere"
radius = "0.5 mm"

[load]
forces = ["5 mN", "50 mN"]

[grid]
elements = 32
"""

pytestmark = [
    pytest.mark.filterwarnings("ignore::pellicle.StudyWarning"),
    pytest.mark.filterwarnings("ignore:This process:DeprecationWarning"),
]


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A study of 40 cases, of which 10 are invalid."""
    file = tmp_path_factory.mktemp("study") / "layers.toml"
    file.write_text(STUDY)
    return file


@pytest.fixture(scope="module")
def wanted(file: Path, program: Program) -> bytes:
    """The table from one machine."""
    out = file.parent / "program"
    program("study", file, "--out", out, "--quiet", "--tolerate-failures")
    return (out / "results.csv").read_bytes()


class Maps:
    """An engine that can only map, like many pools."""

    def map(self, function: Callable[[Any], Any], tasks: Any, /) -> Iterator[Any]:
        with multiprocessing.get_context("spawn").Pool(2) as pool:
            yield from pool.map(function, tasks)


def processes(method: str) -> Callable[[], Executor]:
    return lambda: ProcessPoolExecutor(2, mp_context=multiprocessing.get_context(method))


@pytest.mark.parametrize("chunk", [None, 7])
@pytest.mark.parametrize(
    "executor",
    [lambda: ThreadPoolExecutor(3), processes("fork"), processes("spawn"), multiprocessing.get_context("fork").Pool],
    ids=["threads", "fork", "spawn", "pool"],
)
def test_an_executor_gives_the_table_of_one_machine(
    executor: Callable[[], Any], chunk: int | None, file: Path, wanted: bytes, tmp_path: Path
) -> None:
    with executor() as engine:
        table = pl.study(file).map(engine, out=tmp_path, chunk=chunk)
    assert (tmp_path / "results.csv").read_bytes() == wanted
    assert (table.cases, table.certified, table.failed) == (40, 30, 10)
    # As the program leaves it: only the table, its page and the identity of the study.
    assert sorted(path.name for path in tmp_path.iterdir()) == ["report.html", "results.csv", "study.json"]


def test_an_engine_with_only_map_gives_the_same_table(file: Path, wanted: bytes, tmp_path: Path) -> None:
    pl.study(file).map(Maps(), out=tmp_path, chunk=5, threads=2)
    assert (tmp_path / "results.csv").read_bytes() == wanted


def test_failed_cases_have_nan_results_and_a_message(file: Path, tmp_path: Path) -> None:
    with ThreadPoolExecutor(2) as pool, pytest.warns(pl.StudyWarning, match="40 cases, 30 certified, 10 failed"):
        table = pl.study(file).map(pool, out=tmp_path)
    failed = table.columns["status"] == "failed"
    assert failed.sum() == 10 and np.isnan(table.columns["penetration [m]"][failed]).all()
    assert all("poisson" in message for message in table.columns["message"][failed])
    assert (table.columns["penetration [m]"][~failed] > 0).all()


# Two grids, all loading steps, and a surface field; for a Poisson's ratio of 0.6 the fields are NaN.
KEEPING = STUDY.replace("[study.vary]", '[study]\nkeep = ["pressure", "gap"]\n\n[study.vary]\ngrid.elements = [16, 32]')
KEEPING = KEEPING.replace("[grid]\nelements = 32", '[output]\nfields = "all"').replace("count = 10", "count = 3")


@pytest.fixture(scope="module")
def keeping(tmp_path_factory: pytest.TempPathFactory, program: Program) -> Path:
    """A study of 24 cases with kept fields, solved by one machine in the folder `program`."""
    file = tmp_path_factory.mktemp("keeping") / "keeping.toml"
    file.write_text(KEEPING)
    program("study", file, "--out", file.parent / "program", "--quiet", "--tolerate-failures")
    return file


def are_those_of_one_machine(out: Path, keeping: Path) -> None:
    for name in ("results.csv", "fields-n16.nc", "fields-n32.nc"):
        assert (out / name).read_bytes() == (keeping.parent / "program" / name).read_bytes(), name


@pytest.mark.parametrize("chunk", [None, 7])
@pytest.mark.parametrize("executor", [lambda: ThreadPoolExecutor(3), processes("spawn")], ids=["threads", "spawn"])
def test_kept_fields_equal_those_of_one_machine(
    executor: Callable[[], Any], chunk: int | None, keeping: Path, tmp_path: Path
) -> None:
    with executor() as engine:
        table = pl.study(keeping).map(engine, out=tmp_path, chunk=chunk)
    assert (table.cases, table.failed) == (24, 6)
    are_those_of_one_machine(tmp_path, keeping)


def test_kept_fields_are_resumed_by_engines_and_the_program(
    keeping: Path, program: Program, tmp_path: Path
) -> None:
    def stop(progress: pl.StudyProgress) -> None:
        if progress.finished >= 5:
            raise KeyboardInterrupt

    study = pl.study(keeping)
    with ThreadPoolExecutor(2) as pool, pytest.raises(KeyboardInterrupt) as stopped:
        study.map(pool, out=tmp_path, chunk=1, progress=stop)
    assert "5 of 24 cases are in" in stopped.value.__notes__[0]
    # Until all cases are there, the file declares that it holds none.
    assert (tmp_path / "fields-n32.nc").read_bytes()[4:8] == bytes(4)
    program("study", keeping, "--out", tmp_path, "--quiet", "--tolerate-failures")
    are_those_of_one_machine(tmp_path, keeping)


def test_progress_is_reported_and_finished_cases_are_not_solved_again(
    file: Path, wanted: bytes, program: Program, tmp_path: Path
) -> None:
    reports: list[pl.StudyProgress] = []

    def stop(progress: pl.StudyProgress) -> None:
        reports.append(progress)
        if progress.finished >= 10:
            raise KeyboardInterrupt

    study = pl.study(file)
    with ThreadPoolExecutor(2) as pool, pytest.raises(KeyboardInterrupt) as stopped:
        study.map(pool, out=tmp_path, progress=stop)
    assert "10 of 40 cases are in" in stopped.value.__notes__[0]
    assert [progress.finished for progress in reports] == list(range(1, 11))
    with ThreadPoolExecutor(1) as pool:
        study.map(pool, out=tmp_path, progress=reports.append, chunk=30)
    assert reports[10:] == [pl.StudyProgress(40, 40)]
    assert (tmp_path / "results.csv").read_bytes() == wanted
    # Neither the program nor then Python finds anything left to do.
    program("study", file, "--out", tmp_path, "--quiet", "--tolerate-failures")
    study.map(Maps(), out=tmp_path, progress=reports.append)
    assert len(reports) == 11 and (tmp_path / "results.csv").read_bytes() == wanted


def test_ctrl_c_ends_a_map_on_threads_at_once(file: Path, tmp_path: Path) -> None:
    large = tmp_path / "large.toml"
    large.write_text(STUDY.replace("elements = 32", "elements = 512"))
    signal.signal(signal.SIGINT, signal.default_int_handler)
    threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT)).start()
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt), ThreadPoolExecutor(2) as pool:
        pl.study(large).map(pool, out=tmp_path / "out", chunk=40)
    # 1 s to the signal; tables and the current iteration are waited for.
    assert time.monotonic() - start < 5


def test_a_killed_worker_breaks_the_pool_and_a_new_pool_resumes(file: Path, wanted: bytes, tmp_path: Path) -> None:
    def kill(progress: pl.StudyProgress) -> None:
        if progress.finished == 5:
            os.kill(next(iter(pool._processes)), signal.SIGKILL)

    with ProcessPoolExecutor(2) as pool, pytest.raises(BrokenProcessPool) as broken:
        pl.study(file).map(pool, out=tmp_path, chunk=1, progress=kill)
    assert "of 40 cases are in" in broken.value.__notes__[0]
    assert 5 <= len({row.split(",")[0] for row in (tmp_path / "results.csv").read_text().splitlines()[1:]}) < 40
    with ProcessPoolExecutor(2) as pool:
        pl.study(file).map(pool, out=tmp_path)
    assert (tmp_path / "results.csv").read_bytes() == wanted


def test_a_study_is_pickled_as_its_file_and_another_file_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "study.toml"
    file.write_text(STUDY)
    study = pl.study(file)
    assert pickle.loads(pickle.dumps(study)) == study
    assert (len(study), repr(study)) == (40, "<Study 'study': 40 cases>")
    file.write_text(STUDY.replace("0.5 mm", "0.6 mm"))
    with processes("spawn")() as pool, pytest.raises(pl.RunError, match="found another study"):
        study.map(pool, out=tmp_path / "out")
    assert pl.study(file) != study


def test_invalid_arguments_are_refused_in_one_sentence(file: Path, tmp_path: Path) -> None:
    study = pl.study(file)
    with pytest.raises(pl.ArgumentError, match="executor: found int, wanted an object with submit or map"):
        study.map(3, out=tmp_path)  # type: ignore[arg-type]
    with ThreadPoolExecutor(1) as pool:
        with pytest.raises(pl.ArgumentError, match="chunk: found 0"):
            study.map(pool, out=tmp_path, chunk=0)
        with pytest.raises(pl.ArgumentError, match="threads: found 0"):
            study.map(pool, out=tmp_path, threads=0)
        study.map(pool, out=tmp_path)
        other = tmp_path / "other.toml"
        other.write_text(STUDY.replace("0.5 mm", "0.6 mm"))
        with pytest.raises(pl.RunError, match="another study"):
            pl.study(other).map(pool, out=tmp_path)
        pl.study(other).map(pool, out=tmp_path, fresh=True)
    with pytest.raises(pl.CaseError, match="study"):
        pl.study(EXAMPLES.parents[1] / "cases" / "hertz.toml")


def workers_of(process: subprocess.Popen[str], name: str) -> list[Any]:
    """The descendants of a process whose command line contains `name`."""
    import psutil

    below = psutil.Process(process.pid).children(recursive=True)
    return [worker for worker in below if name in " ".join(worker.cmdline())]


@pytest.mark.parametrize(
    ("example", "package", "worker"),
    [
        ("processes", None, "processes.py"),
        ("on_joblib", "joblib", "popen_loky_posix"),
        ("on_dask", "distributed", "spawn_main"),
        ("on_ray", "ray", "ray::call"),
    ],
)
def test_an_example_resumes_after_its_worker_is_killed(
    example: str, package: str | None, worker: str, file: Path, wanted: bytes, tmp_path: Path
) -> None:
    pytest.importorskip("psutil")
    if package is not None:
        pytest.importorskip(package, reason=f"{package} is not installed: the example is not tried")
    out = tmp_path / "out"
    command = [sys.executable, str(EXAMPLES / f"{example}.py"), str(file), str(out)]
    table = out / "results.csv"
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        # Waits until the first case is written.
        while process.poll() is None and not (table.exists() and table.read_bytes().count(b"\n") > 1):
            time.sleep(0.01)
        killed = workers_of(process, worker)[:1] if process.poll() is None else []
        for one in killed:
            one.kill()
        said, errors = process.communicate(timeout=120)
    finally:
        process.kill()
    assert killed, errors
    if process.returncode != 0:
        # Engines that cannot replace a worker report it; a second run finishes the study.
        assert "cases are in" in errors and example in ("processes", "on_joblib"), errors
        said = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    assert said.splitlines()[-1] == "40 cases, 30 certified, 10 failed"
    assert table.read_bytes() == wanted
